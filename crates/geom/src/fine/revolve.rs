//! Cylinders and cones along +y: a profile with rounded corners, turned about the axis.

use super::mesh::{ARC, FineMesh, ROUND};
use crate::vector::{Vec3, vec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A point of the profile: distance from the axis, height, and the normal's angle above the horizon.
struct Stop {
    radius: f64,
    height: f64,
    angle: f64,
}

/// A cylinder with the radii `bottom` at -y and `top` at +y, its rims rounded by `bevel` in `[0, 1]`.
pub fn rounded(bottom: f64, top: f64, length: f64, bevel: f64) -> FineMesh {
    let half = 0.5 * length;
    let slant = (bottom - top).atan2(length); // the angle of the side's normal above the horizon
    let mut stops = Vec::new();
    corner(&mut stops, bottom, half, length, bevel, slant, -1.0);
    corner(&mut stops, top, half, length, bevel, slant, 1.0);
    turned(&stops, half)
}

/// Rounds one corner: the arc touches the cap (normal straight up or down) and the side (normal at `slant`).
fn corner(stops: &mut Vec<Stop>, radius: f64, half: f64, length: f64, bevel: f64, slant: f64, sign: f64) {
    let turn = FRAC_PI_2 - sign * slant; // angle between the two normals
    let tangent = (0.5 * turn).tan();
    // The arc takes at most the cap's radius and half of the side.
    let side = length / slant.cos();
    let round = (bevel * radius.min(half)).min(radius / tangent).min(0.5 * side / tangent);
    let steps = if round > 0.0 { ((turn / FRAC_PI_2 * ARC as f64).ceil() as usize).max(1) } else { 1 };
    let inset = radius - round * tangent;
    let mut arc: Vec<Stop> = (0..=steps)
        .map(|k| {
            let angle = sign * FRAC_PI_2 + (slant - sign * FRAC_PI_2) * k as f64 / steps as f64;
            Stop {
                radius: inset + round * angle.cos(),
                height: sign * (half - round) + round * angle.sin(),
                angle,
            }
        })
        .collect();
    // The first stop lies on the cap; the exact place avoids rounding errors.
    arc[0].radius = inset;
    arc[0].height = sign * half;
    if sign > 0.0 {
        arc.reverse();
    }
    stops.extend(arc);
}

fn turned(stops: &[Stop], half: f64) -> FineMesh {
    let mut mesh = FineMesh::default();
    let around: Vec<(f64, f64)> = (0..ROUND).map(|k| (TAU * k as f64 / ROUND as f64).sin_cos()).collect();
    for stop in stops {
        let (up, out) = stop.angle.sin_cos();
        for &(sin, cos) in &around {
            let at = vec3(stop.radius * sin, stop.height, stop.radius * cos);
            mesh.point(at, vec3(out * sin, up, out * cos));
        }
    }
    let number = |row: usize, k: usize| (row * ROUND + k % ROUND) as u32;
    for row in 0..stops.len() - 1 {
        for k in 0..ROUND {
            mesh.quad([number(row, k), number(row, k + 1), number(row + 1, k + 1), number(row + 1, k)]);
        }
    }
    let down: Vec3 = vec3(0.0, -1.0, 0.0);
    let (low, high) = (mesh.point(down * half, down), mesh.point(down * -half, down * -1.0));
    let last = stops.len() - 1;
    for k in 0..ROUND {
        mesh.face([low, number(0, k + 1), number(0, k)]);
        mesh.face([high, number(last, k), number(last, k + 1)]);
    }
    mesh
}

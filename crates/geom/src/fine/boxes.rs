//! Boxes with rounded edges and corners.
//!
//! Each point of the sharp box is clamped to a smaller box and pushed out again by the rounding radius along the
//! direction from the clamped point, which is also the normal there. Differs from chapter 5's programs: they round
//! the cube and then stretch it; here the radius is the same on every edge, a share of the *smallest* half length.

use super::mesh::{ARC, FineMesh, unit_or};
use crate::vector::{Vec3, vec3};
use std::collections::HashMap;

/// Smallest scale of the tapered end: a pyramid's tip keeps directions for its normals.
const TIP: f64 = 1e-6;

/// Vertices by their place on the sharp box and their normal. Two faces share the vertices of a rounded edge.
type Vertices = HashMap<([u64; 3], [u64; 3]), u32>;

/// A box of full side lengths `size`, its +z face scaled by `taper`, edges rounded by `bevel` in `[0, 1]`.
pub fn rounded(size: Vec3, taper: f64, bevel: f64) -> FineMesh {
    let half = size * 0.5;
    let narrow = half.x.min(half.y) * taper.clamp(0.25, 1.0);
    let radius = bevel * narrow.min(half.z);
    let mut mesh = FineMesh::default();
    let mut vertices = Vertices::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            side(&mut mesh, &mut vertices, half, radius, axis, sign);
        }
    }
    if taper != 1.0 {
        pinch(&mut mesh, half.z, taper);
    }
    mesh
}

/// A face with its share of the rounded edges.
fn side(mesh: &mut FineMesh, vertices: &mut Vertices, half: Vec3, radius: f64, axis: usize, sign: f64) {
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let (along_a, along_b) = (grid(half[a], radius), grid(half[b], radius));
    let inner = [half.x - radius, half.y - radius, half.z - radius];
    let mut numbers = Vec::with_capacity(along_a.len() * along_b.len());
    for &p in &along_a {
        for &q in &along_b {
            let mut at = [0.0; 3];
            (at[axis], at[a], at[b]) = (sign * half[axis], p, q);
            let [x, y, z] = [0, 1, 2].map(|k| at[k].clamp(-inner[k], inner[k]));
            let mut flat = [0.0; 3];
            flat[axis] = sign;
            let outward = vec3(at[0] - x, at[1] - y, at[2] - z);
            let normal = unit_or(outward, vec3(flat[0], flat[1], flat[2]));
            let key = (at.map(f64::to_bits), normal.to_array().map(f64::to_bits));
            let number =
                vertices.entry(key).or_insert_with(|| mesh.point(vec3(x, y, z) + normal * radius, normal));
            numbers.push(*number);
        }
    }
    let wide = along_b.len();
    for i in 0..along_a.len() - 1 {
        for j in 0..wide - 1 {
            let k = i * wide + j;
            let corners = [k, k + wide, k + wide + 1, k + 1].map(|k| numbers[k]);
            mesh.quad(if sign > 0.0 { corners } else { [corners[0], corners[3], corners[2], corners[1]] });
        }
    }
}

/// Places of grid lines from `-half` to `half`: dense on the rounding, where they meet equal angles up to the edge.
fn grid(half: f64, radius: f64) -> Vec<f64> {
    if radius <= 0.0 {
        return vec![-half, half];
    }
    let steps = ARC / 2;
    let angle = |k: usize| std::f64::consts::FRAC_PI_4 * k as f64 / steps as f64;
    let mut rim: Vec<f64> = (0..steps).map(|k| half - radius + radius * angle(k).tan()).collect();
    rim.push(half); // to the bit, so that neighbouring faces agree on their common edge
    let mut lines: Vec<f64> = rim.iter().rev().map(|&p| -p).chain(rim.iter().copied()).collect();
    lines.dedup();
    lines
}

/// Scales x and y linearly from 1 at `-half` to `taper` at `half`; normals by the inverse transpose.
fn pinch(mesh: &mut FineMesh, half: f64, taper: f64) {
    let slope = (taper - 1.0) / (2.0 * half);
    for (p, n) in mesh.vertices.iter_mut().zip(&mut mesh.normals) {
        let scale = (1.0 + slope * (p.z + half)).max(TIP);
        let lifted = n.z * scale - slope * (p.x * n.x + p.y * n.y);
        *n = unit_or(vec3(n.x, n.y, lifted), *n);
        *p = vec3(p.x * scale, p.y * scale, p.z);
    }
}

//! Prisms along +y over any polygon, with rounded edges; they may turn and grow on the way.
//!
//! The straight prism is rounded, and then each row of its vertices is turned and scaled. Normals of straight prisms are exact, those of
//! twisted ones are of their faces, because a strong twist turns the normals of a surface faster than any number of its faces.

use super::corners::{Rounded, room, rounded as corners_of};
use super::crease::{SHARP, creased};
use super::mesh::{ARC, FineMesh, ROUND, unit_or};
use crate::mesh::TriMesh;
use crate::polygon::{Pair, triangles};
use crate::vector::vec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// How the section of a prism turns and grows from y = 0 up to its height. Coordinates of sections are z and x.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    height: f64,
    twist: f64,
    taper: f64,
}

/// A section at a height.
#[derive(Clone, Copy, Debug)]
pub struct Turned {
    scale: f64,
    sin: f64,
    cos: f64,
}

impl Section {
    /// Of a prism of this height, whose upper end is turned by `twist` (radians) and scaled by `taper`.
    pub fn of(height: f64, twist: f64, taper: f64) -> Section {
        Section { height, twist, taper }
    }

    /// At this share of the height.
    pub fn at(&self, share: f64) -> Turned {
        // Both ends are exact, because parts are attached there.
        let scale = if share == 1.0 { self.taper } else { 1.0 + (self.taper - 1.0) * share };
        let (sin, cos) = (self.twist * share).sin_cos();
        Turned { scale, sin, cos }
    }
}

impl Turned {
    /// The place of a point of the section.
    pub fn apply(&self, [z, x]: Pair) -> Pair {
        [z * self.cos - x * self.sin, z * self.sin + x * self.cos].map(|x| x * self.scale)
    }
}

/// A row of vertices: its height, how far out it is on the rounding (from 0 to 1), and the sine and cosine of its normals' angle above
/// the horizon.
struct Row {
    height: f64,
    reach: f64,
    up: f64,
    out: f64,
}

/// A prism over a counter-clockwise polygon, its edges rounded by `bevel` in `[0, 1]`.
pub fn rounded(corners: &[Pair], section: &Section, bevel: f64) -> FineMesh {
    let height = section.height;
    let width = bevel * room(corners).min(0.5 * height);
    let pieces = if section.twist == 0.0 { corners.to_vec() } else { divided(corners, width) };
    let outline = corners_of(&pieces, width, ARC, &|_| true);
    let width = if outline.iter().any(|v| v.out != [0.0; 2]) { width } else { 0.0 };
    let mut mesh = FineMesh::default();
    let rows = rows(section, width);
    for row in &rows {
        add_row(&mut mesh, &outline, section, row, width);
    }
    let count = outline.len();
    let number = |row: usize, k: usize| (row * count + k % count) as u32;
    for row in 0..rows.len() - 1 {
        for k in 0..count {
            let next = (k + 1) % count;
            // Between the two normals of one corner there is nothing.
            if width == 0.0 && outline[k].corner == outline[next].corner {
                continue;
            }
            let [a, b] = [number(row, k), number(row, next)];
            let [c, d] = [number(row + 1, next), number(row + 1, k)];
            // Twisted faces are not flat: one diagonal bulges out, the next one in.
            mesh.quad(if (row + k) % 2 == 0 { [a, b, c, d] } else { [b, c, d, a] });
        }
    }
    let firsts: Vec<&Rounded> = (0..count)
        .filter(|k| outline[*k].corner != outline[(k + count - 1) % count].corner)
        .map(|k| &outline[k])
        .collect();
    let inner: Vec<Pair> = firsts.iter().map(|v| v.core).collect();
    let faces = triangles(&inner);
    for (share, up) in [(0.0, -1.0), (1.0, 1.0)] {
        if share * section.taper == 0.0 && share == 1.0 {
            continue;
        }
        let turned = section.at(share);
        let start = mesh.vertices.len() as u32;
        for p in &inner {
            let [z, x] = turned.apply(*p);
            mesh.point(vec3(x, share * height, z), vec3(0.0, up, 0.0));
        }
        for [a, b, c] in &faces {
            mesh.face(if up > 0.0 { [*a, *b, *c] } else { [*a, *c, *b] }.map(|k| start + k));
        }
    }
    if section.twist == 0.0 {
        return mesh;
    }
    let faces = TriMesh::new(mesh.vertices, mesh.faces);
    creased(&faces.expect("finite points and numbers of points"), SHARP)
}

/// A polygon with points within its sides, at most three on each and not within the rounding of corners.
fn divided(corners: &[Pair], width: f64) -> Vec<Pair> {
    let count = corners.len();
    let side = |k: usize| {
        let ([a, b], [c, d]) = (corners[k], corners[(k + 1) % count]);
        let pieces = match width > 0.0 {
            true => ((c - a).hypot(d - b) / (3.0 * width)).clamp(1.0, 4.0) as usize,
            false => 4,
        };
        (0..pieces).map(move |piece| {
            let share = piece as f64 / pieces as f64;
            [a + (c - a) * share, b + (d - b) * share]
        })
    };
    (0..count).flat_map(side).collect()
}

/// Rows from the bottom to the top: an arc, the side in layers where it is twisted, and an arc; a tip has none.
fn rows(section: &Section, width: f64) -> Vec<Row> {
    let height = section.height;
    let arc = |sign: f64, k: usize| {
        let (sin, cos) = (FRAC_PI_2 * k as f64 / ARC as f64).sin_cos();
        // At its ends the arc meets the cap and the side to the bit.
        let (up, out) = if k == ARC { (1.0, 0.0) } else { (sin, cos) };
        let low = width * (1.0 - up);
        Row { height: if sign < 0.0 { low } else { height - low }, reach: out, up: sign * up, out }
    };
    let is_pointed = section.taper == 0.0;
    let mut rows: Vec<Row> = match width > 0.0 {
        true => (1..=ARC).rev().map(|k| arc(-1.0, k)).collect(),
        false => Vec::new(),
    };
    let (low, high) = (width, if is_pointed { height } else { height - width });
    let layers = ((section.twist.abs() / (TAU / ROUND as f64)).ceil() as usize).max(1);
    rows.extend((0..=layers).map(|layer| {
        let at = if layer == layers { high } else { low + (high - low) * layer as f64 / layers as f64 };
        Row { height: at, reach: 1.0, up: 0.0, out: 1.0 }
    }));
    if width > 0.0 && !is_pointed {
        rows.extend((1..=ARC).map(|k| arc(1.0, k)));
    }
    rows
}

fn add_row(mesh: &mut FineMesh, outline: &[Rounded], section: &Section, row: &Row, width: f64) {
    let turned = section.at(row.height / section.height);
    // The slope of the scale, by height.
    let grow = (section.taper - 1.0) / section.height;
    for v in outline {
        let reach = row.reach * width;
        let p = [v.core[0] + v.out[0] * reach, v.core[1] + v.out[1] * reach];
        let [z, x] = turned.apply(p);
        // By the inverse transpose.
        let [nz, nx] = v.normal.map(|n| n * row.out);
        let up = row.up * turned.scale - grow * (p[0] * nz + p[1] * nx);
        let flat = vec3(0.0, if row.up < 0.0 { -1.0 } else { 1.0 }, 0.0);
        mesh.point(vec3(x, row.height, z), unit_or(vec3(nx, up, nz), flat));
    }
}

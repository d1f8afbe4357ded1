//! Segments of a tree: three rings, the second after the bend, and optionally a base on a parent's bark.
//!
//! ```text
//!        ___ end            From the split ring to the end the segment is an exact cone, on which branches start.
//!       /  /                From the start to the split it bends: a wedge that is thin on the inside of the bend.
//!      /  / ___ split       The start ring is the end ring of the segment below, or is moved down onto the parent's
//!     /__/--                cone (the weld).
//!     |__| start
//! ```
//!
//! The coarse mesh is the tube over the three rings (dissertation 2.3.3 and 5.5, the tree). It is nearly convex, and voxels
//! use its hull, which bulges by a few hundredths of the radius, and over the hollow of a welded base that the parent fills.
//! Intersections need the exact shape, because a branch starts on the cone without any gap. So a segment also has convex
//! *pieces* that do not overlap what they touch: the wedge and the cone. A welded base has a wedge for each of its strips.

use crate::once::Once;
use crate::polytope::Hull;
use crate::ring::ring;
use crate::topology::Topology;
use crate::tube::Tube;
use crate::vector::Vec3;
use std::sync::{Arc, OnceLock};

/// Sides of a segment's rings (dissertation chapter 5's coarse mesh). Its remainder by four is two: see `strips`.
pub const SEGMENT_SIDES: usize = 10;

/// Corners of the three rings, start first. The start lies on the bark, if the segment has one.
pub(crate) fn corners(tube: &Tube) -> Option<Vec<Vec3>> {
    let (frames, onto) = (tube.frames(), tube.onto());
    static TURNS: OnceLock<Vec<(f64, f64)>> = OnceLock::new();
    let turns = TURNS.once(|| ring(SEGMENT_SIDES).collect());
    let mut corners = Vec::with_capacity(3 * SEGMENT_SIDES);
    frames.iter().for_each(|f| corners.extend(turns.iter().map(|turn| f.at(*turn))));
    if let Some(bark) = onto {
        let down = bark.down(frames[0].center)?;
        // Chords between points at this distance stay outside of the parent's inscribed polygon.
        let swell = 1.0 / (std::f64::consts::PI / SEGMENT_SIDES as f64).cos();
        for corner in &mut corners[..SEGMENT_SIDES] {
            *corner = *corner + down * bark.drop(*corner, down, swell);
        }
    }
    Some(corners)
}

/// The tube over three rings: both caps, and two bands of quadrangles.
pub(crate) fn tube() -> Arc<Topology> {
    static TUBE: OnceLock<Arc<Topology>> = OnceLock::new();
    let build = || {
        let n = SEGMENT_SIDES as u32;
        let next = |k: u32| (k + 1) % n;
        let band =
            |row: u32| (0..n).map(move |k| vec![row + k, row + next(k), row + n + next(k), row + n + k]);
        let caps = [(0..n).rev().collect(), (2 * n..3 * n).collect()];
        let faces: Vec<Vec<u32>> = band(0).chain(band(n)).chain(caps).collect();
        let mut tube = Topology::from_faces(3 * SEGMENT_SIDES, faces);
        // The wedge's quadrangles are twisted: their diagonals may be outside the hull.
        tube.edges.extend((0..n).map(|k| [k, n + next(k)]));
        // Caps are cut along strips that run like the mark: on a welded base they lie along the parent.
        tube.triangles.truncate(4 * SEGMENT_SIDES);
        for [a, b, c, d] in strips() {
            tube.triangles.extend([[a, c, b], [a, d, c]]);
            tube.triangles.extend([[2 * n + a, 2 * n + b, 2 * n + c], [2 * n + a, 2 * n + c, 2 * n + d]]);
        }
        Arc::new(tube)
    };
    TUBE.once(build).clone()
}

/// A ring cut into quadrangles by lines parallel to the diagonal from the mark.
fn strips() -> impl Iterator<Item = [u32; 4]> {
    const { assert!(SEGMENT_SIDES % 4 == 2) };
    let (n, half) = (SEGMENT_SIDES as u32, SEGMENT_SIDES as u32 / 2);
    [0, half].into_iter().flat_map(move |first| {
        (0..half / 2).map(move |j| [first + j, first + j + 1, first + half - j - 1, (first + half - j) % n])
    })
}

/// The convex pieces: the cone, and below the bend a wedge, or a wedge over each strip of a welded base.
pub(crate) fn pieces(corners: &[Vec3], welded: bool) -> Box<[Hull]> {
    let n = SEGMENT_SIDES;
    let wedge = |strip: [u32; 4]| {
        let low = strip.iter().map(|k| corners[*k as usize]);
        low.chain(strip.iter().map(|k| corners[n + *k as usize])).collect::<Vec<Vec3>>()
    };
    // A piece without volume is skipped.
    let solid = |points: Vec<Vec3>, sides: usize| Hull::nearly(points, Topology::frustum(sides));
    let cone = solid(corners[n..].to_vec(), n);
    let below: Vec<Hull> = match welded {
        true => strips().filter_map(|strip| solid(wedge(strip), 4)).collect(),
        false => solid(corners[..2 * n].to_vec(), n).into_iter().collect(),
    };
    cone.into_iter().chain(below).collect()
}

#[cfg(test)]
mod tests {
    //! Claim: a tube is closed; a welded base lies on its parent, and its pieces do not overlap it.
    use super::*;
    use crate::intersect::{Rule, intersects};
    use crate::look::Look;
    use crate::solids::shape::Shape;
    use crate::tube::{Bark, Frame};
    use crate::vector::vec3;

    const UP: Vec3 = vec3(0.0, 1.0, 0.0);

    fn frame(center: Vec3, forward: Vec3, up: Vec3, radius: f64) -> Frame {
        Frame { center, forward, up, radius }
    }

    /// A cone along +y, and a branch at its middle whose base is as wide as `share` of it.
    fn fork(share: f64) -> (Shape, Shape) {
        let look = Look::default();
        let x = vec3(1.0, 0.0, 0.0);
        let trunk = [(0.0, 1.0), (0.2, 0.98), (4.0, 0.8)].map(|(y, r)| frame(UP * y, UP, x, r));
        let bark = |y: f64| 0.98 + (0.8 - 0.98) * (y - 0.2) / 3.8;
        let wide = share * bark(2.0);
        let out = bark(2.0) / (std::f64::consts::PI / 10.0).cos();
        let start = frame(x * out + UP * 2.0, x, UP, wide);
        let split = frame(start.center + x * 0.3, x, UP, wide * 0.95);
        let end = frame(start.center + x * 3.0, x, UP, wide * 0.8);
        let onto = Bark {
            low: UP * (2.0 - wide),
            low_radius: bark(2.0 - wide),
            high: UP * (2.0 + wide),
            high_radius: bark(2.0 + wide),
        };
        let trunk = Shape::segment(trunk, None, &look).unwrap();
        (trunk, Shape::segment([start, split, end], Some(onto), &look).unwrap())
    }

    #[test]
    fn a_tube_keeps_its_frames_to_the_bit() {
        let x = vec3(1.0, -0.0, 0.0);
        let start = frame(vec3(1.0, 2.0, 3.0), UP, x, 0.5);
        let (straight, turned) = (frame(UP, UP, x, 0.4), frame(UP, UP, vec3(1.0, 0.0, 0.0), 0.4));
        let end = frame(UP * 2.0, UP, x, 0.3);
        let bark = Bark { low: x, low_radius: 0.7, high: UP, high_radius: 0.6 };
        for split in [straight, turned, frame(UP, x, UP, 0.4)] {
            for onto in [None, Some(bark)] {
                let tube = Tube::new([start, split, end], onto);
                let text = |frames: [Frame; 3]| format!("{frames:?}");
                assert_eq!(text(tube.frames()), text([start, split, end]));
                assert_eq!((tube.onto(), tube.is_welded()), (onto, onto.is_some()));
                let bytes = 8
                    * (24
                        + 6 * usize::from(split != straight || split.up.y.to_bits() == 0)
                        + 8 * usize::from(onto.is_some()));
                assert!(tube.bytes() == bytes && tube == tube.clone());
            }
        }
    }

    #[test]
    fn a_welded_branch_touches_its_parent_by_both_rules() {
        for share in [0.2, 0.5, 0.8, 0.9] {
            let (trunk, branch) = fork(share);
            assert_eq!((trunk.world_mesh().open_edges(), branch.world_mesh().open_edges()), (0, 0));
            for rule in [Rule::Solid, Rule::Surface] {
                assert!(!intersects(&trunk, &branch, rule), "{share} {rule:?}");
            }
            // The base is on the bark, not above it: a tenth of the branch's radius lower, it is inside.
            let lower: Vec<Vec3> =
                branch.world_mesh().vertices().iter().map(|v| *v - vec3(0.12, 0.0, 0.0)).collect();
            let mesh = crate::TriMesh::new(lower, tube().triangles.clone()).unwrap();
            let lower = Shape::mesh(&Arc::new(mesh), Vec3::ZERO, 1.0, &Look::default()).unwrap();
            for rule in [Rule::Solid, Rule::Surface] {
                assert!(intersects(&trunk, &lower, rule), "{share} {rule:?}");
            }
        }
    }

    /// A segment whose start is turned by `bend` against its end, split as the tree of chapter 5 splits it.
    fn bent(bend: f64) -> Shape {
        let (back, inward, (s, c)) = (vec3(0.0, 0.0, -1.0), vec3(1.0, 0.0, 0.0), bend.sin_cos());
        let ahead = vec3(s, c, 0.0);
        let tip = ahead * 4.0 - vec3(c, -s, 0.0) * 0.8;
        let along = tip + inward;
        let level = along * ((inward * 2.0).dot(ahead) / along.dot(ahead)) - inward;
        let radius = 0.5 * (level - inward).norm();
        let split = (inward + ahead * (0.1 * radius) + level) * 0.5;
        let frames = [
            frame(Vec3::ZERO, UP, back, 1.0),
            frame(split, ahead, back, radius),
            frame(ahead * 4.0, ahead, back, 0.8),
        ];
        Shape::segment(frames, None, &Look::default()).unwrap()
    }

    #[test]
    fn voxels_are_those_of_the_mesh_and_few_more() {
        // A bend of 0.26 is one standard deviation of the tree's. Measured at 0.5: 0.031.
        for (bend, most) in [(0.0, 0.02), (0.1, 0.02), (0.25, 0.02), (0.5, 0.04)] {
            let shape = bent(bend);
            let grid = crate::Grid::around(shape.aabb(), 0.1).unwrap();
            let ours = crate::Voxels::of(&shape, &grid).unwrap();
            let mesh = crate::Voxels::of_mesh(&shape.world_mesh(), &grid).unwrap();
            let [nx, ny, nz] = grid.dims();
            let cells = || (0..nx * ny * nz).map(|i| [i % nx, i / nx % ny, i / nx / ny]);
            assert!(cells().filter(|cell| mesh.contains(*cell)).all(|cell| ours.contains(cell)), "{bend}");
            let more = ours.count() as f64 / mesh.count() as f64 - 1.0;
            assert!(more < most, "{bend}: {more}");
        }
    }

    #[test]
    fn a_branch_through_a_welded_branch_intersects_it() {
        let (_, branch) = fork(0.5);
        let across =
            Shape::cylinder(vec3(2.0, 2.0, 0.0), 0.2, 4.0, vec3(0.0, 0.0, 1.0), None, &Look::default());
        for rule in [Rule::Solid, Rule::Surface] {
            assert!(intersects(&branch, across.as_ref().unwrap(), rule));
        }
    }
}

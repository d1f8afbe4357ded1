//! The surface of a cut: each face of each leaf, divided by the other leaves, where its two sides differ.
//!
//! A face is divided by one leaf after the other, and only as long as the tree leaves its sides open. Of faces that lie on one
//! another the first leaf's remains. The pieces of an edge are divided at the same points on both sides only by chance, so the
//! pieces of the surface meet without gaps, but not corner to corner.

use super::cut::Cut;
use super::leaf::Leaf;
use super::sides::Sides;
use crate::bounds::Aabb;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::FineMesh;
use crate::mesh::TriMesh;
use crate::vector::Vec3;
use std::cell::OnceCell;
use std::ops::ControlFlow;

/// The distance, as a share of the size, below which points are at one place.
const SAME: f64 = 1e-9;
/// This distance for coordinates far from the origin, as a share of them: 32 steps of a 64-bit number.
const STEP: f64 = 8e-15;

/// A piece of a leaf's face that is on the surface of the cut.
struct Facet {
    points: Vec<Vec3>,
    leaf: usize,
    /// The number of the face of the leaf.
    face: usize,
    /// True if the cut is where the leaf is not: the face looks the other way.
    turned: bool,
}

/// The distance below which points of a cut are at one place.
pub(super) fn tolerance(cut: &Cut) -> f64 {
    let aabb = cut.around_solids();
    let most = |v: Vec3| v.x.max(v.y).max(v.z);
    let farthest = most(aabb.high.max(aabb.low * -1.0));
    (SAME * most(aabb.extent())).max(STEP * farthest)
}

/// The leaves as scores see them.
pub(super) fn coarse_leaves(cut: &Cut) -> Vec<Leaf> {
    let tolerance = tolerance(cut);
    cut.solids().iter().map(|shape| Leaf::coarse(shape, tolerance)).collect()
}

/// Refuses a cut of which nothing is left. The first facet decides, so this is cheap beside the surface.
///
/// # Errors
/// `bad-shape`.
pub(crate) fn check(cut: &Cut) -> Result<(), GeomError> {
    match each_coarse_facet(cut, |_| ControlFlow::Break(())) {
        ControlFlow::Break(()) => Ok(()),
        ControlFlow::Continue(()) => bad("nothing is left of the solid".to_string()),
    }
}

/// The surface as scores see it.
///
/// # Errors
/// `bad-shape` if nothing is left.
pub(crate) fn mesh(cut: &Cut) -> Result<TriMesh, GeomError> {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    let _ = each_coarse_facet(cut, |facet| {
        let start = vertices.len() as u32;
        let count = facet.points.len() as u32;
        vertices.extend(facet.points);
        triangles.extend((1..count - 1).map(|k| [start, start + k, start + k + 1]));
        ControlFlow::Continue(())
    });
    TriMesh::new(vertices, triangles)
}

/// The surface of pictures, in the world. A solid without a bevel of its own has sharp edges here: rounded edges of a cutter
/// would bulge at the rim of its hole.
pub(crate) fn fine(cut: &Cut) -> FineMesh {
    let tolerance = tolerance(cut);
    let meshes: Vec<FineMesh> = cut.solids().iter().map(|shape| shape.sharp_mesh()).collect();
    let leaves: Vec<Leaf> = meshes.iter().map(|mesh| Leaf::fine(mesh, tolerance)).collect();
    let mut all = FineMesh::default();
    let boxes: Vec<Aabb> = leaves.iter().map(|leaf| leaf.aabb).collect();
    let _ = each_facet(
        cut,
        &boxes,
        |leaf| &leaves[leaf],
        |facet| {
            if !cut.shows(facet.leaf) {
                return ControlFlow::Continue(());
            }
            let mesh = &meshes[facet.leaf];
            let corners = mesh.faces[leaves[facet.leaf].sources[facet.face]].map(|corner| corner as usize);
            let sign = if facet.turned { -1.0 } else { 1.0 };
            let flat = leaves[facet.leaf].faces[facet.face].normal;
            let numbers: Vec<u32> = facet
                .points
                .iter()
                .map(|p| {
                    let shares = shares(corners.map(|corner| mesh.vertices[corner]), *p);
                    let sum = (0..3).fold(Vec3::ZERO, |sum, k| sum + mesh.normals[corners[k]] * shares[k]);
                    all.point(*p, sum.unit().unwrap_or(flat) * sign)
                })
                .collect();
            (1..numbers.len() - 1).for_each(|k| all.face([numbers[0], numbers[k], numbers[k + 1]]));
            ControlFlow::Continue(())
        },
    );
    all.without_unused()
}

/// The barycentric coordinates of a point of a triangle.
fn shares([a, b, c]: [Vec3; 3], p: Vec3) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let whole = normal.dot(normal);
    let part = |q: Vec3, r: Vec3| ((q - p).cross(r - p).dot(normal) / whole).clamp(0.0, 1.0);
    [part(b, c), part(c, a), part(a, b)]
}

/// [`each_facet`] of the surface that scores see. A leaf is made when it is first needed.
fn each_coarse_facet(cut: &Cut, each: impl FnMut(Facet) -> ControlFlow<()>) -> ControlFlow<()> {
    let (solids, tolerance) = (cut.solids(), tolerance(cut));
    let leaves = vec![OnceCell::new(); solids.len()];
    let boxes: Vec<Aabb> = solids.iter().map(|shape| *shape.aabb()).collect();
    each_facet(cut, &boxes, |at| leaves[at].get_or_init(|| Leaf::coarse(&solids[at], tolerance)), each)
}

/// Calls `each` with the facets, in the order of the leaves and of their faces, until it breaks. The `boxes` are around the leaves.
fn each_facet<'a>(
    cut: &Cut,
    boxes: &[Aabb],
    leaf: impl Fn(usize) -> &'a Leaf,
    mut each: impl FnMut(Facet) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let tolerance = tolerance(cut);
    let mut open: Vec<(Vec<Vec3>, Vec<Sides>, usize)> = Vec::new();
    for number in 0..boxes.len() {
        for (at, face) in leaf(number).faces.iter().enumerate() {
            let reach = face.aabb.grown(tolerance);
            let mut sides: Vec<Sides> = boxes
                .iter()
                .map(|other| if other.meets(&reach) { Sides::UNKNOWN } else { Sides::OUT })
                .collect();
            sides[number] = Sides::ON;
            let dividers: Vec<usize> = (0..boxes.len()).filter(|other| !sides[*other].is_known()).collect();
            open.push((face.points.clone(), sides, 0));
            while let Some((points, sides, next)) = open.pop() {
                let outcome = cut.evaluate(&sides);
                if outcome.is_known() && !outcome.is_on() {
                    continue;
                }
                // A face of an earlier leaf may lie below a piece whose sides are known.
                let is_first = dividers[next..].first().is_none_or(|other| *other > number);
                if outcome.is_known() && is_first {
                    let turned = outcome.front();
                    let points = if turned { points.into_iter().rev().collect() } else { points };
                    each(Facet { points, leaf: number, face: at, turned })?;
                    continue;
                }
                let other = dividers[next];
                leaf(other).divide(points, face.normal, |piece, there| {
                    if !(there.is_on() && other < number) {
                        let mut sides = sides.clone();
                        sides[other] = there;
                        open.push((piece, sides, next + 1));
                    }
                });
            }
        }
    }
    ControlFlow::Continue(())
}

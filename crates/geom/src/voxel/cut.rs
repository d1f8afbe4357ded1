//! The cells of a grid that a cut fills: those that it meets, as for every solid.
//!
//! The cells of the leaves decide most of them. With the cells that a solid *may* meet and those that it *does* meet, word by
//! word:
//!
//! ```text
//!               may meet                does meet
//! leaf          its cells               its cells
//! a | b         may a or may b          does a or does b
//! a & b         may a and may b         none
//! a - b         may a                   does a and not may b
//! ```
//!
//! A cell in between is filled if the surface of the cut meets it. If not, it lies on one side of that surface, as do all its
//! neighbours of this kind, so one point decides for a whole region.

use super::surface::{Bits, mark_among};
use super::{CellBox, Grid, Voxels, run};
use crate::mesh::TriMesh;
use crate::solids::cut::{Cut, Operation};
use crate::vector::vec3;

/// The place in a cell of the point that decides for a region: away from planes on which faces often lie.
const POINT: [f64; 3] = [0.437, 0.561, 0.523];

/// The cells that a cut with this surface fills, and the box around them; `None` when it fills none.
pub(super) fn cells(cut: &Cut, mesh: &TriMesh, grid: &Grid) -> Option<(CellBox, Bits)> {
    let cells = grid.cells_of(&mesh.aabb())?;
    let leaves: Vec<Option<Voxels>> = cut.solids().iter().map(|shape| Voxels::of(shape, grid)).collect();
    let [low, high] = [cells.low, cells.high].map(|corner| corner.map(|i| i as i64));
    let (mut filled, mut open) = (Bits::empty(low, high), Bits::empty(low, high));
    let mut any_open = false;
    for z in cells.low[2]..=cells.high[2] {
        for y in cells.low[1]..=cells.high[1] {
            for column in cells.low[0] / 64..=cells.high[0] / 64 {
                let mut next = leaves.iter();
                let leaf = || {
                    let voxels = next.next().and_then(Option::as_ref);
                    let is_near = |voxels: &&Voxels| {
                        let CellBox { low, high } = voxels.cells;
                        (low[1]..=high[1]).contains(&y) && (low[2]..=high[2]).contains(&z)
                    };
                    let word = voxels.filter(is_near).map_or(0, |voxels| voxels.word(column, y, z));
                    [word, word]
                };
                let within = run(column, cells.low[0], cells.high[0]);
                let [may, does] = cut.fold(leaf, combine).map(|word| word & within);
                filled.put(column, y, z, does);
                open.put(column, y, z, may & !does);
                any_open |= may & !does != 0;
            }
        }
    }
    if any_open {
        mark_among(mesh, grid, &open, &mut filled);
        settle(cut, grid, &mut open, &mut filled);
    }
    Some((cells, filled))
}

fn combine(operation: Operation, [may_a, does_a]: [u64; 2], [may_b, does_b]: [u64; 2]) -> [u64; 2] {
    match operation {
        Operation::Union => [may_a | may_b, does_a | does_b],
        Operation::Intersection => [may_a & may_b, 0],
        Operation::Difference => [may_a, does_a & !may_b],
    }
}

/// Decides the open cells that the surface does not meet, region by region.
fn settle(cut: &Cut, grid: &Grid, open: &mut Bits, filled: &mut Bits) {
    open.remove(filled);
    let mut interior = None;
    let mut region = Vec::new();
    while let Some(first) = open.first() {
        let [x, y, z] = std::array::from_fn(|a| first[a] as f64 + POINT[a]);
        let is_inside = interior.get_or_insert_with(|| cut.interior()).contains(grid.to_world(vec3(x, y, z)));
        open.clear(first);
        region.push(first);
        while let Some(cell) = region.pop() {
            if is_inside {
                filled.set(cell[0], cell[1], cell[2]);
            }
            for a in 0..3 {
                for step in [-1, 1] {
                    let mut near = cell;
                    near[a] += step;
                    if open.get(near[0], near[1], near[2]) {
                        open.clear(near);
                        region.push(near);
                    }
                }
            }
        }
    }
}

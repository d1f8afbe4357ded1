//! Voxels of a convex solid, row by row, without looking at cells.
//!
//! A row of cells along x is a prism: one slab of z and one of y. The solid's slice in a z slab, seen along z, is
//! the convex hull of its corners in the slab and of its edges' crossings with the slab's two planes. The x extent
//! of that polygon over the y slab is the row's first and last cell, since both sides of a convex polygon are
//! concave: the farthest point of the slab is the side's apex, or else the slab's border nearer to it.
//!
//! When the solid stands upright (all corners on two heights) the slabs are cut along y instead, so that all slices
//! in the middle are one polygon and computed once.

use super::CellBox;
use super::grid::{Grid, TOUCH};
use crate::convex::Convex;
use crate::vector::Vec3;

const NOTHING: (u32, u32) = (1, 0);

/// First and last x for each (y, z) of `cells`, y fastest. `cells` must be the cells of the solid's box.
pub fn rows(convex: &Convex<'_>, grid: &Grid, cells: &CellBox) -> Vec<(u32, u32)> {
    let corners: Vec<Vec3> = convex.corners().iter().map(|p| grid.to_grid(*p)).collect();
    let upright = {
        let first = corners[0].y;
        let mut others = corners.iter().map(|p| p.y).filter(|y| *y != first);
        others.next().is_none_or(|second| others.all(|y| y == second))
    };
    let (outer, inner) = if upright { (1, 2) } else { (2, 1) };
    let count = |a: usize| cells.high[a] - cells.low[a] + 1;
    let (ny, limit) = (count(1), grid.dims()[0]);
    let place = |o: usize, i: usize| if upright { i * ny + o } else { o * ny + i };

    let mut rows = vec![NOTHING; ny * count(2)];
    let mut slice: Vec<[f64; 2]> = Vec::with_capacity(2 * convex.topology().edges.len());
    let mut before: Vec<[f64; 2]> = Vec::with_capacity(slice.capacity());
    let mut polygon = Polygon::default();
    let ends = straight_between(&corners, convex, (outer, inner));
    let mut in_the_middle = false;
    for o in 0..count(outer) {
        let low = (cells.low[outer] + o) as f64 - TOUCH;
        let was_in_the_middle = in_the_middle;
        in_the_middle = ends.is_some_and(|(first, last)| first < low && low + 1.0 + 2.0 * TOUCH < last);
        if in_the_middle && was_in_the_middle {
            for i in 0..count(inner) {
                rows[place(o, i)] = rows[place(o - 1, i)];
            }
            continue;
        }
        slice_of(&corners, convex, (outer, inner), (low, low + 1.0 + 2.0 * TOUCH), &mut slice);
        if o > 0 && slice == before {
            for i in 0..count(inner) {
                rows[place(o, i)] = rows[place(o - 1, i)];
            }
            continue;
        }
        before.clone_from(&slice);
        polygon.enclose(&mut slice);
        for i in 0..count(inner) {
            let low = (cells.low[inner] + i) as f64 - TOUCH;
            if let Some((left, right)) = polygon.extent(low, low + 1.0 + 2.0 * TOUCH) {
                let (first, last) = ((left - TOUCH).floor(), (right + TOUCH).floor());
                if last >= 0.0 && first < limit as f64 {
                    rows[place(o, i)] = (first.max(0.0) as u32, (last as u32).min(limit as u32 - 1));
                }
            }
        }
    }
    rows
}

/// Where a prism along `outer` begins and ends; between them all its slices are one. `None` for other solids.
fn straight_between(corners: &[Vec3], convex: &Convex<'_>, (outer, inner): (usize, usize)) -> Option<(f64, f64)> {
    let heights = || corners.iter().map(|p| p[outer]);
    let (first, last) =
        (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
    let at_ends = heights().all(|h| h == first || h == last);
    let straight = |&[a, b]: &[u32; 2]| {
        let (a, b) = (corners[a as usize], corners[b as usize]);
        a[outer] == b[outer] || (a[inner] == b[inner] && a.x == b.x)
    };
    (at_ends && convex.topology().edges.iter().all(straight)).then_some((first, last))
}

/// Points `[inner, x]` whose hull is the solid between the two planes across `outer`, seen along it.
fn slice_of(
    corners: &[Vec3],
    convex: &Convex<'_>,
    (outer, inner): (usize, usize),
    (low, high): (f64, f64),
    slice: &mut Vec<[f64; 2]>,
) {
    slice.clear();
    slice.extend(corners.iter().filter(|p| low <= p[outer] && p[outer] <= high).map(|p| [p[inner], p.x]));
    for [a, b] in &convex.topology().edges {
        let (a, b) = (corners[*a as usize], corners[*b as usize]);
        let rise = b[outer] - a[outer];
        for plane in [low, high] {
            if (a[outer] < plane) != (b[outer] < plane) {
                let t = (plane - a[outer]) / rise;
                slice.push([a[inner] + t * (b[inner] - a[inner]), a.x + t * (b.x - a.x)]);
            }
        }
    }
}

/// Both sides of a convex polygon, x as a function of v.
#[derive(Default)]
struct Polygon {
    left: Vec<[f64; 2]>,
    right: Vec<[f64; 2]>,
}

impl Polygon {
    /// Becomes the hull of `points` (monotone chain, Andrew 1979). Sorts them.
    fn enclose(&mut self, points: &mut [[f64; 2]]) {
        points.sort_unstable_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
        for (side, sign) in [(&mut self.left, 1.0), (&mut self.right, -1.0)] {
            side.clear();
            for p in points.iter() {
                while let [.., a, b] = side[..] {
                    let turn = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
                    if turn * sign > 0.0 {
                        break;
                    }
                    side.pop();
                }
                side.push(*p);
            }
        }
    }

    /// Smallest and largest x where v is in `[low, high]`.
    fn extent(&self, low: f64, high: f64) -> Option<(f64, f64)> {
        let (first, last) = (self.left.first()?[0], self.left.last()?[0]);
        let (low, high) = (low.max(first), high.min(last));
        if low > high {
            return None;
        }
        Some((-extreme(&self.left, -1.0, low, high), extreme(&self.right, 1.0, low, high)))
    }
}

/// Largest `sign * x` of a side over `[low, high]`.
fn extreme(side: &[[f64; 2]], sign: f64, low: f64, high: f64) -> f64 {
    let mut best = (sign * at(side, low)).max(sign * at(side, high));
    for p in side {
        if low <= p[0] && p[0] <= high {
            best = best.max(sign * p[1]);
        }
    }
    best
}

fn at(side: &[[f64; 2]], v: f64) -> f64 {
    let next = side.partition_point(|p| p[0] < v).min(side.len() - 1);
    let (a, b) = (side[next.max(1) - 1], side[next]);
    if b[0] == a[0] {
        return b[1];
    }
    // Kept between the ends: a steep side must not overshoot by rounding.
    let t = ((v - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0);
    a[1] + t * (b[1] - a[1])
}

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
    let edges: Vec<Edge> = convex
        .topology()
        .edges
        .iter()
        .map(|[a, b]| Edge::new(corners[*a as usize], corners[*b as usize], (outer, inner)))
        .collect();
    let mut slice: Vec<[f64; 2]> = Vec::with_capacity(2 * edges.len());
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
        slice_of(&corners, &edges, (outer, inner), (low, low + 1.0 + 2.0 * TOUCH), &mut slice);
        if o > 0 && slice == before {
            for i in 0..count(inner) {
                rows[place(o, i)] = rows[place(o - 1, i)];
            }
            continue;
        }
        before.clone_from(&slice);
        polygon.enclose(&slice);
        let bands = (0..count(inner)).map(|i| (cells.low[inner] + i) as f64 - TOUCH);
        polygon.extents(bands.map(|low| (low, low + 1.0 + 2.0 * TOUCH)), |i, left, right| {
            let (first, last) = ((left - TOUCH).floor(), (right + TOUCH).floor());
            if last >= 0.0 && first < limit as f64 {
                rows[place(o, i)] = (first.max(0.0) as u32, (last as u32).min(limit as u32 - 1));
            }
        });
    }
    rows
}

/// An edge, as the slabs see it.
struct Edge {
    /// The ends of its extent along `outer`.
    low: f64,
    high: f64,
    /// One end and the way to the other: along `outer`, along `inner`, along x.
    start: [f64; 3],
    way: [f64; 3],
}

impl Edge {
    fn new(a: Vec3, b: Vec3, (outer, inner): (usize, usize)) -> Edge {
        let start = [a[outer], a[inner], a.x];
        let way = [b[outer] - a[outer], b[inner] - a[inner], b.x - a.x];
        Edge { low: a[outer].min(b[outer]), high: a[outer].max(b[outer]), start, way }
    }
}

/// Where a prism along `outer` begins and ends; between them all its slices are one. `None` for other solids.
fn straight_between(
    corners: &[Vec3],
    convex: &Convex<'_>,
    (outer, inner): (usize, usize),
) -> Option<(f64, f64)> {
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
    edges: &[Edge],
    (outer, inner): (usize, usize),
    (low, high): (f64, f64),
    slice: &mut Vec<[f64; 2]>,
) {
    slice.clear();
    slice.extend(corners.iter().filter(|p| low <= p[outer] && p[outer] <= high).map(|p| [p[inner], p.x]));
    for edge in edges.iter().filter(|edge| edge.low < high && low <= edge.high) {
        for plane in [low, high] {
            if edge.low < plane && plane <= edge.high {
                let t = (plane - edge.start[0]) / edge.way[0];
                slice.push([edge.start[1] + t * edge.way[1], edge.start[2] + t * edge.way[2]]);
            }
        }
    }
}

/// Above zero where the way from `a` by `b` to `p` turns towards higher x, below where it turns away.
#[inline]
fn turn(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// Both sides of a convex polygon, x as a function of v.
#[derive(Default)]
struct Polygon {
    left: Vec<[f64; 2]>,
    right: Vec<[f64; 2]>,
}

impl Polygon {
    /// Becomes the hull of `points`: those on either side of the line from the lowest to the highest, each side by the
    /// monotone chain (Andrew 1979).
    fn enclose(&mut self, points: &[[f64; 2]]) {
        let order = |p: &[f64; 2], q: &[f64; 2]| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]));
        let ends = points.iter().min_by(|p, q| order(p, q)).zip(points.iter().max_by(|p, q| order(p, q)));
        self.left.clear();
        self.right.clear();
        let Some((first, last)) = ends else { return };
        self.left.push(*first);
        self.right.push(*first);
        for p in points {
            let side = turn(*first, *last, *p);
            if side < 0.0 {
                self.left.push(*p);
            } else if side > 0.0 {
                self.right.push(*p);
            }
        }
        for (side, sign) in [(&mut self.left, 1.0), (&mut self.right, -1.0)] {
            side[1..].sort_unstable_by(order);
            side.push(*last);
            let mut kept = 1;
            for at in 1..side.len() {
                let p = side[at];
                while kept > 1 && turn(side[kept - 2], side[kept - 1], p) * sign <= 0.0 {
                    kept -= 1;
                }
                side[kept] = p;
                kept += 1;
            }
            side.truncate(kept);
        }
    }

    /// Tells the smallest and largest x in each band `[low, high]` of v that the polygon meets, with the band's number.
    /// Bands come from low to high.
    fn extents(&self, bands: impl Iterator<Item = (f64, f64)>, mut each: impl FnMut(usize, f64, f64)) {
        let (Some(first), Some(last)) = (self.left.first(), self.left.last()) else { return };
        let (mut left, mut right) = (0, 0);
        for (i, (low, high)) in bands.enumerate() {
            let (low, high) = (low.max(first[0]), high.min(last[0]));
            if low <= high {
                let smallest = -extreme(&self.left, -1.0, low, high, &mut left);
                each(i, smallest, extreme(&self.right, 1.0, low, high, &mut right));
            }
        }
    }
}

/// Largest `sign * x` of a side over `[low, high]`. No point before the `begin`-th lies at `low` or above; afterwards
/// `begin` is the first that does.
#[inline]
fn extreme(side: &[[f64; 2]], sign: f64, low: f64, high: f64, begin: &mut usize) -> f64 {
    while *begin < side.len() && side[*begin][0] < low {
        *begin += 1;
    }
    let (mut end, mut best) = (*begin, sign * at(side, low, *begin));
    while end < side.len() && side[end][0] < high {
        best = best.max(sign * side[end][1]);
        end += 1;
    }
    best = best.max(sign * at(side, high, end));
    side[end..].iter().take_while(|p| p[0] <= high).fold(best, |best, p| best.max(sign * p[1]))
}

/// x of a side at `v`, where `next` is the first point that does not lie below.
#[inline]
fn at(side: &[[f64; 2]], v: f64, next: usize) -> f64 {
    let next = next.min(side.len() - 1);
    let (a, b) = (side[next.max(1) - 1], side[next]);
    if b[0] == a[0] {
        return b[1];
    }
    // Kept between the ends: a steep side must not overshoot by rounding.
    let t = ((v - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0);
    a[1] + t * (b[1] - a[1])
}

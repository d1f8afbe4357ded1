//! Voxels of a convex solid, row by row, without looking at cells.
//!
//! A row of cells along x is a prism: one slab of z and one of y. The solid's slice in a z slab, seen along z, is
//! the convex hull of its corners in the slab and of its edges' crossings with the slab's two planes. The x extent
//! of that polygon over the y slab is the row's first and last cell, since both sides of a convex polygon are
//! concave: the farthest point of the slab is the side's apex, or else the slab's border nearer to it.
//!
//! The slabs are cut along y instead when the solid is upright (all corners on two heights). A prism along either
//! axis is cut once: all its slices are one polygon.

use super::cells::CellBox;
use super::grid::{Grid, TOUCH};
use crate::convex::Convex;

const NOTHING: (u32, u32) = (1, 0);

/// The first and last x of each row of a box of cells. A row is empty when first is above last.
#[derive(Clone, Debug)]
pub struct Rows {
    rows: Vec<(u32, u32)>,
    /// Strides from one y to the next, and from one z to the next: zero where all slices are equal.
    steps: [usize; 2],
}

impl Rows {
    /// The first and last x of the row that is the `y`-th and `z`-th of the box.
    #[inline]
    pub fn get(&self, y: usize, z: usize) -> (usize, usize) {
        let (first, last) = self.rows[y * self.steps[0] + z * self.steps[1]];
        (first as usize, last as usize)
    }

    /// The rows of the `z`-th layer of the box from the `y`-th on, as far as they reach.
    #[inline]
    pub fn along_y(&self, y: usize, z: usize) -> impl Iterator<Item = (usize, usize)> {
        let mut at = y * self.steps[0] + z * self.steps[1];
        std::iter::from_fn(move || {
            let (first, last) = *self.rows.get(at)?;
            at += self.steps[0];
            Some((first as usize, last as usize))
        })
    }
}

/// A corner: its coordinates along the cut axis, along the other of y and z, and along x.
type Corner = [f64; 3];

/// The rows of `cells`, which must be the cells of the solid's box.
pub fn rows(convex: &Convex<'_>, grid: &Grid, cells: &CellBox) -> Rows {
    let laid = |outer: usize| {
        let corner = |p: &_| {
            let [x, y, z] = grid.to_grid(*p).to_array();
            if outer == 1 { [y, z, x] } else { [z, y, x] }
        };
        convex.corners().iter().map(corner).collect::<Vec<Corner>>()
    };
    let count = |a: usize| cells.high[a] - cells.low[a] + 1;
    let mut corners = laid(2);
    let mut end = end_of_prism(&corners, convex);
    let mut outer = 2;
    if end.is_none() {
        let upright: Vec<Corner> = corners.iter().map(|[z, y, x]| [*y, *z, *x]).collect();
        if has_two_heights(&upright) {
            end = end_of_prism(&upright, convex);
            (corners, outer) = (upright, 1);
        }
    }
    let inner = 3 - outer;
    let room = 2 * corners.len();
    let mut polygon = Polygon { left: Vec::with_capacity(room), right: Vec::with_capacity(room) };
    let slices = if end.is_some() { 1 } else { count(outer) };
    let edges = if end.is_some() { vec![] } else { edges_of(&corners, convex) };
    let mut rows = vec![NOTHING; slices * count(inner)];
    let mut slice: Vec<[f64; 2]> = Vec::with_capacity(room);
    for (o, rows) in rows.chunks_exact_mut(count(inner)).enumerate() {
        match end {
            Some(end) => slice.extend(corners.iter().filter(|p| p[0] == end).map(|p| [p[1], p[2]])),
            None => {
                let low = (cells.low[outer] + o) as f64 - TOUCH;
                slice_of(&corners, &edges, (low, low + 1.0 + 2.0 * TOUCH), &mut slice);
            }
        }
        polygon.enclose(&slice);
        polygon.fill(cells.low[inner], grid.dims()[0], rows);
    }
    let along_outer = if end.is_some() { 0 } else { count(inner) };
    Rows { rows, steps: if outer == 1 { [along_outer, 1] } else { [1, along_outer] } }
}

/// True when the first coordinate has at most two values.
fn has_two_heights(corners: &[Corner]) -> bool {
    let end = corners[0][0];
    let mut heights = corners.iter().map(|p| p[0]).filter(|at| *at != end);
    heights.next().is_none_or(|other| heights.all(|at| at == other))
}

/// The ends of a prism along the first coordinate; `None` for other solids.
fn end_of_prism(corners: &[Corner], convex: &Convex<'_>) -> Option<f64> {
    let straight = |&[a, b]: &[u32; 2]| {
        let (a, b) = (corners[a as usize], corners[b as usize]);
        a[0] == b[0] || a[1..] == b[1..]
    };
    let is_prism = has_two_heights(corners) && convex.topology().edges.iter().all(straight);
    is_prism.then_some(corners[0][0])
}

/// An edge, and the ends of what it crosses of the first coordinate.
struct Edge {
    first: f64,
    last: f64,
    ends: [Corner; 2],
}

/// The edges of the solid between these corners.
fn edges_of(corners: &[Corner], convex: &Convex<'_>) -> Vec<Edge> {
    let edge = |&[a, b]: &[u32; 2]| {
        let ends @ [a, b] = [corners[a as usize], corners[b as usize]];
        let (first, last) = if a[0] < b[0] { (a[0], b[0]) } else { (b[0], a[0]) };
        Edge { first, last, ends }
    };
    convex.topology().edges.iter().map(edge).collect()
}

/// Points whose hull is the slice of the solid between two planes across the first coordinate, seen along it.
fn slice_of(corners: &[Corner], edges: &[Edge], (low, high): (f64, f64), slice: &mut Vec<[f64; 2]>) {
    slice.clear();
    slice.extend(corners.iter().filter(|p| low <= p[0] && p[0] <= high).map(|p| [p[1], p[2]]));
    for &Edge { first, last, ends: [a, b] } in
        edges.iter().filter(|edge| edge.first < high && edge.last >= low)
    {
        for plane in [low, high] {
            if first < plane && plane <= last {
                let t = (plane - a[0]) / (b[0] - a[0]);
                slice.push([a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])]);
            }
        }
    }
}

/// The turn of the path from `a` by `b` to `p`: above zero towards higher x, below zero away from it.
#[inline]
fn turn(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// True when `p` comes before `q`: along v, then along x.
#[inline]
fn is_before(p: &[f64; 2], q: &[f64; 2]) -> bool {
    p[0] < q[0] || (p[0] == q[0] && p[1] < q[1])
}

/// Both sides of a convex polygon, x as a function of v.
#[derive(Default)]
struct Polygon {
    left: Vec<[f64; 2]>,
    right: Vec<[f64; 2]>,
}

impl Polygon {
    /// Sets the sides to the hull of `points`: the points on either side of the line from the lowest to the highest, by the
    /// monotone chain (Andrew 1979).
    fn enclose(&mut self, points: &[[f64; 2]]) {
        self.left.clear();
        self.right.clear();
        let Some(mut first) = points.first() else { return };
        let mut last = first;
        for p in points {
            first = if is_before(p, first) { p } else { first };
            last = if is_before(last, p) { p } else { last };
        }
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
            side[1..].sort_unstable_by(|p, q| is_before(q, p).cmp(&is_before(p, q)));
            side.push(*last);
            let mut length = 1;
            for at in 1..side.len() {
                let p = side[at];
                while length > 1 && turn(side[length - 2], side[length - 1], p) * sign <= 0.0 {
                    length -= 1;
                }
                side[length] = p;
                length += 1;
            }
            side.truncate(length);
        }
    }

    /// Cells of x below `limit` in each row of v, the first at `low`.
    fn fill(&self, low: usize, limit: usize, rows: &mut [(u32, u32)]) {
        let (Some(first), Some(last)) = (self.left.first(), self.left.last()) else { return };
        let (mut left, mut right) = (Side::new(&self.left, -1.0), Side::new(&self.right, 1.0));
        for (i, row) in rows.iter_mut().enumerate() {
            let from = (low + i) as f64 - TOUCH;
            let to = from + 1.0 + 2.0 * TOUCH;
            let (from, to) = (larger(from, first[0]), if to < last[0] { to } else { last[0] });
            if from <= to {
                let (first, last) = (-left.farthest(from, to), right.farthest(from, to));
                // What is at least zero is rounded down where it becomes a whole number.
                let (first, last) = (first - TOUCH, last + TOUCH);
                if last >= 0.0 && first < limit as f64 {
                    *row = (first.max(0.0) as u32, (last as u32).min(limit as u32 - 1));
                }
            }
        }
    }
}

/// The larger of two numbers, in an instruction: unlike `f64::max` it is for numbers alone.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// A side that is visited along v.
struct Side<'a> {
    points: &'a [[f64; 2]],
    sign: f64,
    next: usize,
}

impl<'a> Side<'a> {
    fn new(points: &'a [[f64; 2]], sign: f64) -> Side<'a> {
        Side { points, sign, next: 0 }
    }

    /// Largest `sign * x` over `[low, high]`; `low` may only rise from call to call.
    fn farthest(&mut self, low: f64, high: f64) -> f64 {
        while self.next < self.points.len() && self.points[self.next][0] < low {
            self.next += 1;
        }
        let mut best = self.sign * self.at(self.next, low);
        let mut beyond = self.next;
        let mut reaches_high = None;
        while beyond < self.points.len() && self.points[beyond][0] <= high {
            if self.points[beyond][0] == high {
                reaches_high.get_or_insert(beyond);
            }
            best = larger(best, self.sign * self.points[beyond][1]);
            beyond += 1;
        }
        larger(best, self.sign * self.at(reaches_high.unwrap_or(beyond), high))
    }

    /// x at `v`, where `next` is the first point not before it.
    fn at(&self, next: usize, v: f64) -> f64 {
        let next = next.min(self.points.len() - 1);
        let (a, b) = (self.points[next.max(1) - 1], self.points[next]);
        if b[0] == a[0] {
            return b[1];
        }
        // Clamped to the ends: a steep side must not overshoot by rounding.
        let t = ((v - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0);
        a[1] + t * (b[1] - a[1])
    }
}

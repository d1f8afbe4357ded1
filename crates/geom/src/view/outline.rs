//! Outlines: the projection of a convex piece of a shape to the plane of a family of rays, a convex polygon with a depth.
//!
//! A point lies in the polygon when it is on the inner side of every edge, border included. The order of the ends
//! of an edge is the same for both directions, so that two pieces that share an edge leave no gap between them, to the last
//! bit. Planes decide about a ray that begins in the piece or beyond it: if its line meets the piece, then the ray does when
//! its start is behind every plane that faces along the ray.

use super::rays::{BUNDLE, Bundle, Node, Projection, ROW};
use crate::convex::Convex;
use crate::polytope::span;
use crate::vector::Vec3;
use std::cell::OnceCell;
use wide::f64x4;

/// The most edges of an outline: one bit for each. Larger polygons are cut into fans.
pub const MOST_EDGES: usize = 64;

/// An edge: inside is where `cross(along, p - a)` is not negative.
///
/// There the first of the product's two terms, a function of the point's v, is not below the second, a function of its u. A
/// difference of numbers is never rounded to the other side of zero.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    a: [f64; 2],
    along: [f64; 2],
}

impl Edge {
    /// The edge from a corner of a polygon to the next, counter-clockwise.
    fn new(from: [f64; 2], to: [f64; 2]) -> Edge {
        // The ends have one order for both directions; the sign that turns the edge is exact.
        let (a, b, sign) =
            if (from[0], from[1]) <= (to[0], to[1]) { (from, to, 1.0) } else { (to, from, -1.0) };
        Edge { a, along: [sign * (b[0] - a[0]), sign * (b[1] - a[1])] }
    }
}

/// Four edges, side by side.
#[derive(Clone, Copy, Debug)]
struct Four {
    a: [f64x4; 2],
    along: [f64x4; 2],
}

impl Four {
    /// Up to four edges. Everything is on the inner side of missing edges.
    fn new(edges: &[Edge]) -> Four {
        let of = |k: usize| edges.get(k).copied().unwrap_or_default();
        let lanes = |f: &dyn Fn(Edge) -> f64| f64x4::from([f(of(0)), f(of(1)), f(of(2)), f(of(3))]);
        Four {
            a: [lanes(&|edge| edge.a[0]), lanes(&|edge| edge.a[1])],
            along: [lanes(&|edge| edge.along[0]), lanes(&|edge| edge.along[1])],
        }
    }

    /// The edges with a point of a box on their inner side, and the edges with the whole box there.
    #[inline]
    fn sides_of(&self, [u, v]: &[[f64; 2]; 2]) -> (u32, u32) {
        let of_v = v.map(|v| self.along[0] * (f64x4::splat(v) - self.a[1]));
        let of_u = u.map(|u| self.along[1] * (f64x4::splat(u) - self.a[0]));
        let (least_v, most_v) = (of_v[0].fast_min(of_v[1]), of_v[0].fast_max(of_v[1]));
        let (least_u, most_u) = (of_u[0].fast_min(of_u[1]), of_u[0].fast_max(of_u[1]));
        (most_v.simd_ge(least_u).to_bitmask(), least_v.simd_ge(most_u).to_bitmask())
    }
}

/// The checks that remain for a piece in a node of the tree of rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Checks {
    /// Edges that cut the node's box, one bit for each.
    edges: u64,
    /// True if rays may begin inside of the piece or beyond it.
    starts: bool,
}

impl Checks {
    /// True when no check remains: every ray meets the piece.
    pub fn is_empty(&self) -> bool {
        self.edges == 0 && !self.starts
    }
}

/// The piece of an outline.
#[derive(Clone, Copy)]
enum Piece<'a> {
    Convex(&'a Convex<'a>),
    Triangle(&'a [Vec3; 3]),
}

/// A convex piece, projected to a plane.
pub(super) struct Outline<'a> {
    piece: Piece<'a>,
    projection: &'a Projection,
    edges: Vec<Edge>,
    fours: Vec<Four>,
    low: [f64; 2],
    high: [f64; 2],
    depth: [f64; 2],
    /// Normals that face along the rays, and the reach of the piece in their direction, computed at the first use.
    planes: OnceCell<Vec<(Vec3, f64)>>,
}

impl<'a> Outline<'a> {
    fn new(piece: Piece<'a>, projection: &'a Projection, depth: [f64; 2]) -> Outline<'a> {
        let (low, high) = ([0.0; 2], [0.0; 2]);
        let (edges, fours, planes) = (Vec::new(), Vec::new(), OnceCell::new());
        Outline { piece, projection, edges, fours, low, high, depth, planes }
    }

    /// Sets the polygon by its corners, counter-clockwise.
    fn set_polygon(&mut self, polygon: &[[f64; 2]]) {
        (self.low, self.high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        self.edges.clear();
        self.edges.reserve(polygon.len());
        let mut from = polygon[polygon.len() - 1];
        for to in polygon {
            self.edges.push(Edge::new(from, *to));
            self.low = [self.low[0].min(to[0]), self.low[1].min(to[1])];
            self.high = [self.high[0].max(to[0]), self.high[1].max(to[1])];
            from = *to;
        }
        self.fours.clear();
        self.fours.extend(self.edges.chunks(4).map(Four::new));
    }

    /// The checks of the whole outline.
    pub fn all_checks(&self) -> Checks {
        let edges = if self.edges.len() == MOST_EDGES { u64::MAX } else { (1 << self.edges.len()) - 1 };
        Checks { edges, starts: !self.projection.perspective }
    }

    /// The checks that remain in a node; `None` when no ray of it meets the piece.
    #[inline]
    pub fn remaining(&self, node: &Node, mut checks: Checks) -> Option<Checks> {
        let [u, v] = &node.ends;
        if u[1] < self.low[0] || u[0] > self.high[0] || v[1] < self.low[1] || v[0] > self.high[1] {
            return None;
        }
        if checks.starts {
            if node.depth[0] >= self.depth[1] {
                return None;
            }
            checks.starts = node.depth[1] >= self.depth[0];
        }
        if u[0] < self.low[0] && u[1] > self.high[0] && v[0] < self.low[1] && v[1] > self.high[1] {
            // The whole polygon is in the node: every edge cuts it.
            return Some(checks);
        }
        for (k, four) in self.fours.iter().enumerate() {
            let (some, all) = four.sides_of(&node.ends);
            if some != 0b1111 {
                return None;
            }
            checks.edges &= !(u64::from(all) << (4 * k));
        }
        Some(checks)
    }

    /// The rays of a bundle that meet the piece.
    pub fn meets(&self, bundle: &Bundle, checks: Checks) -> u64 {
        let mut yes = bundle.live;
        let mut rest = checks.edges;
        while rest != 0 {
            let edge = &self.edges[rest.trailing_zeros() as usize];
            rest &= rest - 1;
            yes &= if bundle.is_raster { edge.inside_raster(bundle) } else { edge.inside(bundle) };
        }
        if checks.starts {
            let [x, y, z] = &bundle.start;
            for (n, reach) in self.planes.get_or_init(|| self.planes()) {
                let [nx, ny, nz] = n.to_array().map(f64x4::splat);
                let reach = f64x4::splat(*reach);
                yes &=
                    bits_of(|four| (nx * x[four] + ny * y[four] + nz * z[four]).simd_lt(reach).to_bitmask());
            }
        }
        yes
    }

    fn planes(&self) -> Vec<(Vec3, f64)> {
        let forward = self.projection.forward;
        match self.piece {
            Piece::Convex(convex) => {
                let facing = |n: &Vec3| {
                    let facing = n.dot(forward);
                    let (low, high) = span(convex.corners(), *n);
                    match facing {
                        facing if facing > 0.0 => Some((*n, high)),
                        facing if facing < 0.0 => Some((-*n, -low)),
                        _ => None,
                    }
                };
                convex.normals().iter().filter_map(facing).collect()
            }
            Piece::Triangle([a, b, c]) => {
                let normal = (*b - *a).cross(*c - *a);
                let normal = if normal.dot(forward) < 0.0 { -normal } else { normal };
                vec![(normal, normal.dot(*a))]
            }
        }
    }
}

impl Edge {
    /// The rays of a bundle on the inner side.
    fn inside(&self, bundle: &Bundle) -> u64 {
        let [u, v] = &bundle.at;
        let ([from_u, from_v], [along_u, along_v]) = (self.a.map(f64x4::splat), self.along.map(f64x4::splat));
        bits_of(|four| {
            let (of_v, of_u) = (along_u * (v[four] - from_v), along_v * (u[four] - from_u));
            of_v.simd_ge(of_u).to_bitmask()
        })
    }

    /// The rays of a bundle on the inner side, if it has rows and columns: a product for each of them, not for each ray.
    fn inside_raster(&self, bundle: &Bundle) -> u64 {
        let [u, v] = &bundle.at;
        let from = f64x4::splat(self.a[0]);
        let along = f64x4::splat(self.along[1]);
        let of_u = [along * (u[0] - from), along * (u[1] - from)];
        let rows: [f64; ROW] =
            std::array::from_fn(|row| self.along[0] * (v[2 * row].to_array()[0] - self.a[1]));
        let mut bits = 0;
        for (row, of_v) in rows.into_iter().enumerate() {
            let of_v = f64x4::splat(of_v);
            let eight = of_v.simd_ge(of_u[0]).to_bitmask() | of_v.simd_ge(of_u[1]).to_bitmask() << 4;
            bits |= u64::from(eight) << (ROW * row);
        }
        bits
    }
}

/// Sixty-four bits, four at a time.
#[inline]
fn bits_of(four: impl Fn(usize) -> u32) -> u64 {
    (0..BUNDLE / 4).fold(0, |bits, k| bits | u64::from(four(k)) << (4 * k))
}

/// A maker of the outlines of convex pieces. Its buffers serve many pieces.
pub(super) struct Outliner<'a> {
    projection: &'a Projection,
    near: Option<f64>,
    fallen: Vec<[f64; 2]>,
    polygon: Vec<[f64; 2]>,
}

impl<'a> Outliner<'a> {
    /// An outliner for a projection, and rays that begin at the depth `near`, if it is the same for all.
    pub fn new(projection: &'a Projection, near: Option<f64>) -> Outliner<'a> {
        Outliner { projection, near, fallen: Vec::new(), polygon: Vec::new() }
    }

    /// Calls `each` with the outline of a convex solid, or with several that share edges if it has very many edges.
    pub fn of_convex(&mut self, convex: &Convex<'_>, each: impl FnMut(&Outline<'_>)) {
        let corners = convex.corners();
        let edges = convex.topology().edges.iter().map(|[a, b]| [corners[*a as usize], corners[*b as usize]]);
        self.outlines(Piece::Convex(convex), corners, edges, each);
    }

    /// Calls `each` with the outline of a triangle, unless it is edge-on.
    pub fn of_triangle(&mut self, corners: &[Vec3; 3], each: impl FnMut(&Outline<'_>)) {
        let [a, b, c] = *corners;
        self.outlines(Piece::Triangle(corners), corners, [[a, b], [b, c], [c, a]].into_iter(), each);
    }

    fn outlines(
        &mut self,
        piece: Piece<'_>,
        corners: &[Vec3],
        edges: impl Iterator<Item = [Vec3; 2]>,
        mut each: impl FnMut(&Outline<'_>),
    ) {
        let Outliner { projection, near, fallen, polygon } = self;
        let (low, high) = span(corners, projection.forward);
        let zero = projection.forward.dot(projection.origin);
        let depth = [low - zero, high - zero];
        fallen.clear();
        match *near {
            Some(near) if projection.perspective => {
                if depth[1] < near {
                    return;
                }
                let is_ahead = |p: &Vec3| projection.depth(*p) >= near;
                fallen.extend(corners.iter().filter(|p| is_ahead(p)).map(|p| projection.fall(*p)));
                if depth[0] < near {
                    // A part is behind the camera: the rest ends where edges cross the near plane.
                    fallen.extend(edges.filter(|[a, b]| is_ahead(a) != is_ahead(b)).map(|[a, b]| {
                        let (a, b) = if is_ahead(&a) { (a, b) } else { (b, a) };
                        let (from, to) = (projection.depth(a), projection.depth(b));
                        projection.fall_at(a + (b - a) * ((from - near) / (from - to)), near)
                    }));
                }
            }
            _ => fallen.extend(corners.iter().map(|p| projection.fall(*p))),
        }
        hull(fallen, polygon);
        if polygon.len() < 3 {
            return;
        }
        let mut outline = Outline::new(piece, projection, depth);
        if polygon.len() <= MOST_EDGES {
            outline.set_polygon(polygon);
            return each(&outline);
        }
        let mut first = 1;
        while first + 1 < polygon.len() {
            let last = (first + MOST_EDGES - 2).min(polygon.len() - 1);
            let fan: Vec<[f64; 2]> =
                std::iter::once(polygon[0]).chain(polygon[first..=last].iter().copied()).collect();
            outline.set_polygon(&fan);
            each(&outline);
            first = last;
        }
    }
}

/// The convex hull of `points`, counter-clockwise (monotone chain, Andrew 1979). Sorts them.
fn hull(points: &mut [[f64; 2]], hull: &mut Vec<[f64; 2]>) {
    points.sort_unstable_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    hull.clear();
    hull.reserve(points.len() + 1);
    for pass in 0..2 {
        let start = hull.len();
        let mut push = |p: [f64; 2]| {
            while hull.len() >= start + 2 {
                let (a, b) = (hull[hull.len() - 2], hull[hull.len() - 1]);
                if (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(p);
        };
        if pass == 0 {
            points.iter().for_each(|p| push(*p));
        } else {
            points.iter().rev().for_each(|p| push(*p));
        }
        hull.pop();
    }
}

#[cfg(test)]
mod tests {
    //! A hull turns left at every corner; rows of rays have the bits that each ray has by itself.
    use super::{BUNDLE, Edge, hull};
    use crate::vec3;
    use crate::view::rays::{Ray, bundle};

    #[test]
    fn a_hull_goes_around_counter_clockwise() {
        let mut points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5], [0.5, 0.0]];
        let mut corners = Vec::new();
        hull(&mut points, &mut corners);
        assert_eq!(corners, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        hull(&mut [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], &mut corners);
        assert!(corners.len() < 3);
    }

    #[test]
    fn rows_of_rays_have_the_bits_of_each_ray() {
        let ray = |k: usize, u: f64, v: f64| Ray { at: [u, v], start: vec3(u, v, 0.0), pixel: k as u32 };
        let rows: Vec<Ray> =
            (0..BUNDLE).map(|k| ray(k, (k % 8) as f64 * 0.1, 1.0 - (k / 8) as f64 * 0.3)).collect();
        let mut bent = rows.clone();
        bent[63].at[0] += 1e-9;
        let (raster, other) = (bundle(&rows), bundle(&bent));
        assert!(raster.is_raster && !other.is_raster && !bundle(&rows[..60]).is_raster);
        let mut seed = 5u64;
        let mut unit = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut mixed = 0;
        for _ in 0..2000 {
            // Through rays exactly, one time in two.
            let mut end = || match unit() < 0.5 {
                true => rows[(unit() * 64.0) as usize].at,
                false => [unit() * 2.0 - 0.5, 1.5 - unit() * 4.0],
            };
            let (from, to) = (end(), end());
            let edge = Edge::new(from, to);
            let one_by_one = (0..).zip(&rows).fold(0, |bits, (k, ray)| {
                let sign = if from <= to { 1.0 } else { -1.0 };
                let (a, b) = if from <= to { (from, to) } else { (to, from) };
                let side = (b[0] - a[0]) * (ray.at[1] - a[1]) - (b[1] - a[1]) * (ray.at[0] - a[0]);
                bits | u64::from(sign * side >= 0.0) << k
            });
            assert_eq!((edge.inside_raster(&raster), edge.inside(&raster)), (one_by_one, one_by_one));
            mixed += usize::from(one_by_one != 0 && one_by_one != u64::MAX);
        }
        assert!(mixed > 500);
    }
}

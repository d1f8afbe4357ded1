//! A convex piece of a shape as it falls on the plane of a family of rays: a convex polygon, and how deep it lies.
//!
//! A point lies in the polygon when it is on the inner side of every edge, border included. An edge is kept with its
//! ends in one order for both directions, so that two pieces that share an edge leave no gap between them, to the last
//! bit. A ray that begins beside the piece or beyond it is detected by planes: its line meets the piece, so the ray
//! does when its start is behind every plane that faces along the ray.

use super::rays::{BUNDLE, Bundle, Node, Projection};
use crate::convex::{Convex, span};
use crate::vector::Vec3;

/// Most edges of one outline: one bit for each. Larger polygons are cut into fans.
pub const MOST_EDGES: usize = 64;

/// An edge: inside is where `sign * cross(b - a, p - a)` is not negative.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    a: [f64; 2],
    along: [f64; 2],
    sign: f64,
}

impl Edge {
    fn new(from: [f64; 2], to: [f64; 2]) -> Edge {
        let (a, b, sign) =
            if (from[0], from[1]) <= (to[0], to[1]) { (from, to, 1.0) } else { (to, from, -1.0) };
        Edge { a, along: [b[0] - a[0], b[1] - a[1]], sign }
    }

    #[inline]
    fn side(&self, u: f64, v: f64) -> f64 {
        self.sign * (self.along[0] * (v - self.a[1]) - self.along[1] * (u - self.a[0]))
    }
}

/// The checks that remain for a piece in a node of the tree of rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Checks {
    /// Edges that cut the node's box, one bit for each.
    edges: u64,
    /// Rays may begin inside of the piece or beyond it.
    starts: bool,
}

impl Checks {
    /// No check remains: every ray meets the piece.
    pub fn is_empty(&self) -> bool {
        self.edges == 0 && !self.starts
    }
}

/// A convex piece, projected to a plane.
#[derive(Clone, Debug, Default)]
pub(super) struct Outline {
    edges: Vec<Edge>,
    low: [f64; 2],
    high: [f64; 2],
    depth: [f64; 2],
    /// Normals that face along the rays, with how far the piece reaches in their direction.
    planes: Vec<(Vec3, f64)>,
}

impl Outline {
    /// The polygon with these corners, counter-clockwise; empty when it has no inside.
    fn of_polygon(polygon: &[[f64; 2]], depth: [f64; 2], planes: &[(Vec3, f64)]) -> Outline {
        let mut outline = Outline { depth, planes: planes.to_vec(), ..Outline::default() };
        (outline.low, outline.high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for (i, corner) in polygon.iter().enumerate() {
            outline.edges.push(Edge::new(*corner, polygon[(i + 1) % polygon.len()]));
            outline.low = [outline.low[0].min(corner[0]), outline.low[1].min(corner[1])];
            outline.high = [outline.high[0].max(corner[0]), outline.high[1].max(corner[1])];
        }
        outline
    }

    /// All checks.
    pub fn all_checks(&self) -> Checks {
        let edges = if self.edges.len() == MOST_EDGES { u64::MAX } else { (1 << self.edges.len()) - 1 };
        Checks { edges, starts: !self.planes.is_empty() }
    }

    /// The checks that remain in a node; `None` when no ray of it meets the piece.
    pub fn remaining(&self, node: &Node, mut checks: Checks) -> Option<Checks> {
        if (0..2).any(|a| node.high[a] < self.low[a] || node.low[a] > self.high[a]) {
            return None;
        }
        if checks.starts {
            if node.depth[0] >= self.depth[1] {
                return None;
            }
            checks.starts = node.depth[1] >= self.depth[0];
        }
        let mut rest = checks.edges;
        while rest != 0 {
            let k = rest.trailing_zeros() as usize;
            rest &= rest - 1;
            let edge = &self.edges[k];
            // The inner side grows along (-along.v, along.u), turned by the sign.
            let toward = [-edge.sign * edge.along[1], edge.sign * edge.along[0]];
            let corner = |most: bool| {
                let end = |a: usize| if (toward[a] > 0.0) == most { node.high[a] } else { node.low[a] };
                edge.side(end(0), end(1))
            };
            if corner(true) < 0.0 {
                return None;
            }
            if corner(false) >= 0.0 {
                checks.edges &= !(1 << k);
            }
        }
        Some(checks)
    }

    /// The rays of a bundle that meet the piece.
    pub fn meets(&self, bundle: &Bundle, checks: Checks) -> u64 {
        let mut yes = [1u8; BUNDLE];
        let mut rest = checks.edges;
        while rest != 0 {
            let edge = &self.edges[rest.trailing_zeros() as usize];
            rest &= rest - 1;
            for ((yes, u), v) in yes.iter_mut().zip(&bundle.at[0]).zip(&bundle.at[1]) {
                *yes &= u8::from(edge.side(*u, *v) >= 0.0);
            }
        }
        if checks.starts {
            let [x, y, z] = &bundle.start;
            for (n, reach) in &self.planes {
                for (((yes, x), y), z) in yes.iter_mut().zip(x).zip(y).zip(z) {
                    *yes &= u8::from(n.x * x + n.y * y + n.z * z < *reach);
                }
            }
        }
        packed(&yes) & bundle.live
    }
}

/// Zeros and ones as bits, the first the lowest.
#[inline]
fn packed(ones: &[u8; 64]) -> u64 {
    let mut word = 0;
    for (k, eight) in ones.as_chunks::<8>().0.iter().enumerate() {
        // Each product has one term for each byte, which this factor moves to its place in the top byte.
        word |= (u64::from_le_bytes(*eight).wrapping_mul(0x0102_0408_1020_4080) >> 56) << (8 * k);
    }
    word
}

/// The outlines of a convex solid: one, or several that share edges when it has very many.
pub(super) fn of_convex(
    convex: &Convex<'_>,
    projection: &Projection,
    near: Option<f64>,
    each: impl FnMut(&Outline),
) {
    let corners = convex.corners();
    let edges = convex.topology().edges.iter().map(|[a, b]| [corners[*a as usize], corners[*b as usize]]);
    let mut planes = Vec::new();
    if !projection.perspective {
        for n in convex.normals() {
            let facing = n.dot(projection.forward);
            let (low, high) = span(corners, *n);
            if facing > 0.0 {
                planes.push((*n, high));
            } else if facing < 0.0 {
                planes.push((-*n, -low));
            }
        }
    }
    outlines(corners, edges, &planes, projection, near, each);
}

/// The outline of a triangle, if it is not seen edge-on.
pub(super) fn of_triangle(
    corners: &[Vec3; 3],
    projection: &Projection,
    near: Option<f64>,
    each: impl FnMut(&Outline),
) {
    let [a, b, c] = *corners;
    let mut planes = Vec::new();
    if !projection.perspective {
        let normal = (b - a).cross(c - a);
        let normal = if normal.dot(projection.forward) < 0.0 { -normal } else { normal };
        planes.push((normal, normal.dot(a)));
    }
    outlines(corners, [[a, b], [b, c], [c, a]].into_iter(), &planes, projection, near, each);
}

fn outlines(
    corners: &[Vec3],
    edges: impl Iterator<Item = [Vec3; 2]>,
    planes: &[(Vec3, f64)],
    projection: &Projection,
    near: Option<f64>,
    mut each: impl FnMut(&Outline),
) {
    let (low, high) = span(corners, projection.forward);
    let zero = projection.forward.dot(projection.origin);
    let depth = [low - zero, high - zero];
    let mut fallen: Vec<[f64; 2]> = Vec::with_capacity(2 * corners.len());
    match near {
        Some(near) if projection.perspective => {
            if depth[1] < near {
                return;
            }
            let seen = |p: &Vec3| projection.depth(*p) >= near;
            fallen.extend(corners.iter().filter(|p| seen(p)).map(|p| projection.fall(*p)));
            if depth[0] < near {
                // Part of it is behind the camera: what is in front ends where edges cross the near plane.
                fallen.extend(edges.filter(|[a, b]| seen(a) != seen(b)).map(|[a, b]| {
                    let (a, b) = if seen(&a) { (a, b) } else { (b, a) };
                    let (from, to) = (projection.depth(a), projection.depth(b));
                    projection.fall_at(a + (b - a) * ((from - near) / (from - to)), near)
                }));
            }
        }
        _ => fallen.extend(corners.iter().map(|p| projection.fall(*p))),
    }
    let polygon = hull(&mut fallen);
    if polygon.len() < 3 {
        return;
    }
    if polygon.len() <= MOST_EDGES {
        return each(&Outline::of_polygon(&polygon, depth, planes));
    }
    let mut first = 1;
    while first + 1 < polygon.len() {
        let last = (first + MOST_EDGES - 2).min(polygon.len() - 1);
        let fan: Vec<[f64; 2]> =
            std::iter::once(polygon[0]).chain(polygon[first..=last].iter().copied()).collect();
        each(&Outline::of_polygon(&fan, depth, planes));
        first = last;
    }
}

/// The convex hull of `points`, counter-clockwise (monotone chain, Andrew 1979). Sorts them.
fn hull(points: &mut [[f64; 2]]) -> Vec<[f64; 2]> {
    points.sort_unstable_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    let mut hull: Vec<[f64; 2]> = Vec::with_capacity(points.len() + 1);
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
    hull
}

#[cfg(test)]
mod tests {
    //! Bits are packed in order, and a hull turns left at every corner.
    use super::{hull, packed};

    #[test]
    fn bits_are_packed_in_order() {
        let mut seed = 7u64;
        for _ in 0..100 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let ones: [u8; 64] = std::array::from_fn(|k| (seed >> k & 1) as u8);
            assert_eq!(packed(&ones), seed);
        }
    }

    #[test]
    fn a_hull_goes_around_counter_clockwise() {
        let mut points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5], [0.5, 0.0]];
        assert_eq!(hull(&mut points), [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert!(hull(&mut [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]).len() < 3);
    }
}

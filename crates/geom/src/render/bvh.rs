//! Which triangle does a ray meet first?  A tree of boxes over triangles.
//!
//! Built top-down by the binned surface-area heuristic (Wald 2007), visited nearest child first; triangles are
//! intersected by the test of Möller & Trumbore 1997. Our own hundred lines rather than the `bvh` crate, which would
//! bring `nalgebra` with it. The tree and the answers depend on the triangles only, never on threads.

use super::v3::{V3, least, most, v3};

/// Bins for each axis; more than this no longer makes better trees.
const BINS: usize = 16;
/// Triangles in a leaf at most, unless their centres coincide.
const LEAF: usize = 4;
/// Below this depth the build halves instead of using the heuristic, so that `STACK` can never overflow.
const DEPTH: usize = 48;
/// Depth of the visit: `DEPTH` plus the halvings of 2^32 triangles.
const STACK: usize = DEPTH + 36;

/// A triangle as its first corner and two edges.
#[derive(Clone, Copy, Debug)]
struct Triangle {
    corner: V3,
    edge1: V3,
    edge2: V3,
}

/// A box over triangles `first..first + count`; when `count` is 0, over the children `self + 1` and `first`.
#[derive(Clone, Copy, Debug)]
struct Node {
    lo: V3,
    hi: V3,
    first: u32,
    count: u32,
}

/// Where a ray met a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in lengths of its direction.
    pub t: f32,
    /// Number of the triangle as it was given to `Bvh::new`.
    pub triangle: u32,
    /// Weight of the triangle's second corner.
    pub u: f32,
    /// Weight of the triangle's third corner.
    pub v: f32,
}

/// The tree.
#[derive(Debug, Default)]
pub struct Bvh {
    nodes: Vec<Node>,
    triangles: Vec<Triangle>,
    names: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Bounds {
    lo: V3,
    hi: V3,
}

impl Bounds {
    const EMPTY: Bounds = Bounds { lo: V3::splat(f32::INFINITY), hi: V3::splat(f32::NEG_INFINITY) };

    fn with(self, o: Bounds) -> Bounds {
        Bounds { lo: self.lo.min(o.lo), hi: self.hi.max(o.hi) }
    }

    fn half_area(self) -> f32 {
        let d = (self.hi - self.lo).max(V3::ZERO);
        d.x * d.y + d.y * d.z + d.z * d.x
    }
}

/// One triangle during the build.
struct Item {
    bounds: Bounds,
    centre: V3,
    name: u32,
}

impl Bvh {
    /// A tree over triangles given by their corners, all finite.
    pub fn new(corners: &[[V3; 3]]) -> Bvh {
        let mut items: Vec<Item> = corners
            .iter()
            .zip(0..)
            .map(|(&[a, b, c], name)| {
                let bounds = Bounds { lo: a.min(b).min(c), hi: a.max(b).max(c) };
                Item { bounds, centre: (bounds.lo + bounds.hi) * 0.5, name }
            })
            .collect();
        let mut nodes = Vec::with_capacity(corners.len());
        if !items.is_empty() {
            build(&mut nodes, &mut items, 0, 0);
        }
        let names: Vec<u32> = items.iter().map(|item| item.name).collect();
        let triangles = names
            .iter()
            .map(|&name| {
                let [a, b, c] = corners[name as usize];
                Triangle { corner: a, edge1: b - a, edge2: c - a }
            })
            .collect();
        Bvh { nodes, triangles, names }
    }

    /// The nearest hit nearer than `reach`.
    pub fn hit(&self, origin: V3, direction: V3, reach: f32) -> Option<Hit> {
        let mut nearest = Hit { t: reach, triangle: u32::MAX, u: 0.0, v: 0.0 };
        self.visit(
            origin,
            direction,
            |triangles, names, limit| {
                for (triangle, &name) in triangles.iter().zip(names) {
                    if let Some((t, u, v)) = meet(triangle, origin, direction) {
                        // Equal distances go to the smaller number, so that the answer does not depend on the tree.
                        if t < nearest.t || (t == nearest.t && name < nearest.triangle) {
                            nearest = Hit { t, triangle: name, u, v };
                        }
                    }
                }
                *limit = nearest.t;
                false
            },
            reach,
        );
        (nearest.triangle != u32::MAX).then_some(nearest)
    }

    /// Is anything nearer than `reach`?
    pub fn blocked(&self, origin: V3, direction: V3, reach: f32) -> bool {
        self.visit(
            origin,
            direction,
            |triangles, _, _| {
                triangles
                    .iter()
                    .any(|triangle| matches!(meet(triangle, origin, direction), Some((t, ..)) if t < reach))
            },
            reach,
        )
    }

    /// Visits the leaves that the ray meets, nearest first, until `leaf` returns true.
    fn visit(
        &self,
        origin: V3,
        direction: V3,
        mut leaf: impl FnMut(&[Triangle], &[u32], &mut f32) -> bool,
        reach: f32,
    ) -> bool {
        if self.nodes.is_empty() {
            return false;
        }
        let inverse = v3(1.0 / direction.x, 1.0 / direction.y, 1.0 / direction.z);
        let mut limit = reach;
        let root = entry(&self.nodes[0], origin, inverse);
        if root >= limit {
            return false; // most rays from the floor; they need no stack
        }
        let mut stack = [(0u32, 0.0f32); STACK];
        let mut height = 1;
        stack[0] = (0, root);
        while height > 0 {
            height -= 1;
            let (index, near) = stack[height];
            if near >= limit {
                continue;
            }
            let node = self.nodes[index as usize];
            if node.count > 0 {
                let range = node.first as usize..(node.first + node.count) as usize;
                if leaf(&self.triangles[range.clone()], &self.names[range], &mut limit) {
                    return true;
                }
                continue;
            }
            let (mut a, mut b) = (index + 1, node.first);
            let mut ta = entry(&self.nodes[a as usize], origin, inverse);
            let mut tb = entry(&self.nodes[b as usize], origin, inverse);
            if tb < ta {
                (a, b, ta, tb) = (b, a, tb, ta);
            }
            if tb < limit {
                stack[height] = (b, tb);
                height += 1;
            }
            if ta < limit {
                stack[height] = (a, ta);
                height += 1;
            }
        }
        false
    }
}

/// Distance at which the ray enters the box; infinite when it misses.
fn entry(node: &Node, origin: V3, inverse: V3) -> f32 {
    let a = (node.lo - origin).tint(inverse);
    let b = (node.hi - origin).tint(inverse);
    let (lo, hi) = (a.min(b), a.max(b));
    let near = most(most(lo.x, lo.y), most(lo.z, 0.0));
    // A little slack keeps rays from slipping between boxes that touch.
    let far = least(least(hi.x, hi.y), hi.z) * 1.000_001;
    if near <= far { near } else { f32::INFINITY }
}

/// Distance and barycentric weights, from either side.
fn meet(triangle: &Triangle, origin: V3, direction: V3) -> Option<(f32, f32, f32)> {
    let p = direction.cross(triangle.edge2);
    let determinant = triangle.edge1.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let inverse = 1.0 / determinant;
    let s = origin - triangle.corner;
    let u = s.dot(p) * inverse;
    let q = s.cross(triangle.edge1);
    let v = direction.dot(q) * inverse;
    let t = triangle.edge2.dot(q) * inverse;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some((t, u, v))
}

/// Appends the subtree over `items`, which start at `first` in the final order.
fn build(nodes: &mut Vec<Node>, items: &mut [Item], first: usize, depth: usize) {
    let bounds = items.iter().fold(Bounds::EMPTY, |b, item| b.with(item.bounds));
    let here = nodes.len();
    nodes.push(Node { lo: bounds.lo, hi: bounds.hi, first: first as u32, count: items.len() as u32 });
    if items.len() <= LEAF {
        return;
    }
    let middle = match split(items) {
        Some((axis, plane)) if depth < DEPTH => partition(items, |item| item.centre.axis(axis) < plane),
        _ => items.len() / 2,
    };
    let middle = if middle == 0 || middle == items.len() { items.len() / 2 } else { middle };
    let (left, right) = items.split_at_mut(middle);
    build(nodes, left, first, depth + 1);
    nodes[here].first = nodes.len() as u32;
    nodes[here].count = 0;
    build(nodes, right, first + middle, depth + 1);
}

/// The axis and plane of least expected cost, or nothing when all centres coincide.
fn split(items: &[Item]) -> Option<(usize, f32)> {
    let centres =
        items.iter().fold(Bounds::EMPTY, |b, item| b.with(Bounds { lo: item.centre, hi: item.centre }));
    let mut best = None;
    let mut least = f32::INFINITY;
    for axis in 0..3 {
        let (lo, hi) = (centres.lo.axis(axis), centres.hi.axis(axis));
        if hi <= lo {
            continue;
        }
        let scale = BINS as f32 / (hi - lo);
        let mut bins = [(Bounds::EMPTY, 0usize); BINS];
        for item in items {
            let bin = (((item.centre.axis(axis) - lo) * scale) as usize).min(BINS - 1);
            bins[bin].0 = bins[bin].0.with(item.bounds);
            bins[bin].1 += 1;
        }
        let mut above = [0.0f32; BINS];
        let (mut bounds, mut count) = (Bounds::EMPTY, 0);
        for k in (1..BINS).rev() {
            bounds = bounds.with(bins[k].0);
            count += bins[k].1;
            above[k] = if count == 0 { f32::INFINITY } else { bounds.half_area() * count as f32 };
        }
        let (mut bounds, mut count) = (Bounds::EMPTY, 0);
        for k in 1..BINS {
            bounds = bounds.with(bins[k - 1].0);
            count += bins[k - 1].1;
            let cost = if count == 0 { f32::INFINITY } else { bounds.half_area() * count as f32 + above[k] };
            if cost < least {
                least = cost;
                best = Some((axis, lo + k as f32 / scale));
            }
        }
    }
    best
}

/// Brings the items that satisfy `front` to the front and counts them.
fn partition(items: &mut [Item], front: impl Fn(&Item) -> bool) -> usize {
    let mut count = 0;
    for k in 0..items.len() {
        if front(&items[k]) {
            items.swap(k, count);
            count += 1;
        }
    }
    count
}

#[cfg(test)]
mod tests {
    //! Claim: the tree gives the same nearest triangle as a test of every triangle.
    use super::*;

    fn noise(seed: &mut u32) -> f32 {
        *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (*seed >> 8) as f32 / (1 << 24) as f32
    }

    #[test]
    fn agrees_with_brute_force() {
        let mut seed = 7;
        let mut point =
            |s: f32| v3(noise(&mut seed) - 0.5, noise(&mut seed) - 0.5, noise(&mut seed) - 0.5) * s;
        let corners: Vec<[V3; 3]> = (0..400)
            .map(|_| {
                let c = point(4.0);
                [c + point(0.6), c + point(0.6), c + point(0.6)]
            })
            .collect();
        let tree = Bvh::new(&corners);
        let mut met = 0;
        for _ in 0..2000 {
            let origin = point(10.0);
            let direction = point(3.0) - origin;
            let plain = corners
                .iter()
                .zip(0..)
                .filter_map(|(&[a, b, c], name)| {
                    let triangle = Triangle { corner: a, edge1: b - a, edge2: c - a };
                    meet(&triangle, origin, direction).map(|(t, u, v)| Hit { t, triangle: name, u, v })
                })
                .min_by(|a, b| a.t.total_cmp(&b.t));
            assert_eq!(tree.hit(origin, direction, f32::INFINITY), plain);
            assert_eq!(tree.blocked(origin, direction, f32::INFINITY), plain.is_some());
            met += plain.is_some() as usize;
        }
        assert!(met > 300, "the rays should meet something: {met}");
    }

    #[test]
    fn coincident_and_absent_triangles() {
        assert!(Bvh::new(&[]).hit(V3::ZERO, v3(0., 0., 1.), 9.0).is_none());
        let same = [[v3(0., 0., 0.), v3(1., 0., 0.), v3(0., 1., 0.)]; 100];
        let hit = Bvh::new(&same).hit(v3(0.2, 0.2, -1.), v3(0., 0., 1.), 9.0).map(|h| h.triangle);
        assert_eq!(hit, Some(0));
    }
}

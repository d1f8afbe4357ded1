//! The first triangle on a ray, by a tree of boxes over triangles with four children to a node.
//!
//! The binned surface-area heuristic (Wald 2007) builds a binary tree top-down, whose nodes are then merged. The boxes of a
//! node, and the triangles of a leaf, are tested four at once (Dammertz, Hanika & Keller 2008), triangles by the test of
//! Möller & Trumbore 1997. On meshes of the gallery, rays take half of the time of the `obvhs` crate (0.4). The tree and the answers depend on the triangles only, never on threads.

use super::v3::{V3, most, v3};
use wide::f32x4;

/// The most boxes of a node, and triangles of a leaf.
const LANES: usize = 4;
/// Bins for each axis; more than this no longer makes better trees.
const BINS: usize = 16;
/// Below this depth the build halves instead of using the heuristic, so that `STACK` can never overflow.
const DEPTH: usize = 48;
/// The most children that wait during a visit: all but one of each node on the way down. Merging halves the depth at least.
const STACK: usize = (LANES - 1) * (DEPTH + 36);
/// Marks the number of a leaf among the children of a node.
const LEAF: u32 = 1 << 31;

/// Four vectors.
type Vectors = [f32x4; 3];

/// The triangles of a leaf, each as its first corner and two edges. A missing triangle has no area, so that no ray meets it.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    corner: Vectors,
    edge1: Vectors,
    edge2: Vectors,
    names: [u32; LANES],
}

/// The boxes of up to four children.
#[derive(Clone, Copy, Debug)]
struct Node {
    lo: Vectors,
    hi: Vectors,
    children: [u32; LANES],
    /// A bit for each child that exists.
    present: u32,
}

/// The meeting point of a ray and a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in lengths of its direction.
    pub t: f32,
    /// Number of the triangle in `Bvh::new`.
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
    leaves: Vec<Leaf>,
}

#[derive(Clone, Copy, Debug)]
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

/// A triangle during the build.
struct Item {
    bounds: Bounds,
    centre: V3,
    name: u32,
}

/// Triangles that will share a node or a leaf: the box over them, and how often the whole was divided to get them.
type Group<'a> = (Bounds, &'a mut [Item], usize);

/// A ray with its numbers four times.
struct Ray {
    origin: Vectors,
    direction: Vectors,
    inverse: Vectors,
}

impl Ray {
    fn new(origin: V3, direction: V3) -> Ray {
        // 1 / 0 would make the distance of a plane that the ray lies in NaN.
        let over = |d: f32| if d.abs() < 1e-30 { 1e30f32.copysign(d) } else { 1.0 / d };
        let four = |v: V3| [f32x4::splat(v.x), f32x4::splat(v.y), f32x4::splat(v.z)];
        Ray {
            origin: four(origin),
            direction: four(direction),
            inverse: four(v3(over(direction.x), over(direction.y), over(direction.z))),
        }
    }
}

impl Bvh {
    /// A tree over triangles given by their corners, all finite.
    pub fn new(corners: &[[V3; 3]]) -> Bvh {
        let farthest = corners.iter().flatten().fold(0.0, |far, p| most(far, p.norm()));
        // A little slack keeps rays from slipping between boxes that touch, also rays in the plane where they do.
        let slack = V3::splat(most(1e-6 * farthest, f32::MIN_POSITIVE));
        let mut items: Vec<Item> = corners
            .iter()
            .zip(0..)
            .map(|(&[a, b, c], name)| {
                let bounds = Bounds { lo: a.min(b).min(c) - slack, hi: a.max(b).max(c) + slack };
                Item { bounds, centre: (bounds.lo + bounds.hi) * 0.5, name }
            })
            .collect();
        let mut tree = Bvh::default();
        if !items.is_empty() {
            tree.build(corners, vec![group(&mut items, 0)]);
        }
        tree
    }

    /// The nearest hit nearer than `reach`.
    pub fn hit(&self, origin: V3, direction: V3, reach: f32) -> Option<Hit> {
        let mut nearest = Hit { t: reach, triangle: u32::MAX, u: 0.0, v: 0.0 };
        let ray = Ray::new(origin, direction);
        self.visit(&ray, reach, |leaf, limit| {
            let (met, t, u, v) = meet(leaf, &ray);
            if met == 0 {
                return false;
            }
            let (t, u, v) = (t.to_array(), u.to_array(), v.to_array());
            for k in 0..LANES {
                // Equal distances go to the smaller number, so that the answer does not depend on the tree.
                if met & (1 << k) != 0
                    && (t[k] < nearest.t || (t[k] == nearest.t && leaf.names[k] < nearest.triangle))
                {
                    nearest = Hit { t: t[k], triangle: leaf.names[k], u: u[k], v: v[k] };
                }
            }
            *limit = nearest.t;
            false
        });
        (nearest.triangle != u32::MAX).then_some(nearest)
    }

    /// True if a triangle is nearer than `reach`.
    pub fn blocked(&self, origin: V3, direction: V3, reach: f32) -> bool {
        let ray = Ray::new(origin, direction);
        self.visit(&ray, reach, |leaf, _| {
            let (met, t, ..) = meet(leaf, &ray);
            met & t.simd_lt(f32x4::splat(reach)).to_bitmask() != 0
        })
    }

    /// Visits the leaves that the ray meets, nearest first, until `leaf` returns true.
    #[inline(always)]
    fn visit(&self, ray: &Ray, reach: f32, mut leaf: impl FnMut(&Leaf, &mut f32) -> bool) -> bool {
        if self.nodes.is_empty() {
            return false;
        }
        let mut limit = reach;
        if entry(&self.nodes[0], ray, limit).0 == 0 {
            return false; // most rays from the floor; they need no stack
        }
        let mut stack = [(0u32, 0.0f32); STACK];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (index, near) = stack[height];
            if near > limit {
                continue;
            }
            if index & LEAF != 0 {
                if leaf(&self.leaves[(index ^ LEAF) as usize], &mut limit) {
                    return true;
                }
                continue;
            }
            let node = &self.nodes[index as usize];
            let (mut met, near) = entry(node, ray, limit);
            let near = near.to_array();
            let bottom = height;
            while met != 0 {
                let k = met.trailing_zeros() as usize;
                met &= met - 1;
                // The farthest first, so that the nearest is visited next.
                let mut place = height;
                while place > bottom && stack[place - 1].1 < near[k] {
                    stack[place] = stack[place - 1];
                    place -= 1;
                }
                stack[place] = (node.children[k], near[k]);
                height += 1;
            }
        }
        false
    }

    /// Appends the node over up to four groups of items, each with its box and depth, and all below; returns its number.
    fn build(&mut self, corners: &[[V3; 3]], mut groups: Vec<Group>) -> u32 {
        while groups.len() < LANES {
            // The largest box that is not yet a leaf is divided.
            let largest = (0..groups.len())
                .filter(|&k| groups[k].1.len() > LANES)
                .max_by(|&a, &b| groups[a].0.half_area().total_cmp(&groups[b].0.half_area()));
            let Some(largest) = largest else { break };
            let (_, items, depth) = groups.swap_remove(largest);
            groups.extend(halves(items, depth));
        }
        let here = self.nodes.len();
        let boxes: [Bounds; LANES] = std::array::from_fn(|k| groups.get(k).map_or(Bounds::EMPTY, |g| g.0));
        self.nodes.push(Node {
            lo: lanes(|k| boxes[k].lo),
            hi: lanes(|k| boxes[k].hi),
            children: [0; LANES],
            present: (1 << groups.len()) - 1,
        });
        for (k, (_, items, depth)) in groups.into_iter().enumerate() {
            self.nodes[here].children[k] = if items.len() > LANES {
                self.build(corners, halves(items, depth).into())
            } else {
                self.leaves.push(Leaf::new(items, corners));
                LEAF | (self.leaves.len() - 1) as u32
            };
        }
        here as u32
    }
}

impl Leaf {
    fn new(items: &[Item], corners: &[[V3; 3]]) -> Leaf {
        let corner =
            |k: usize, c: usize| items.get(k).map_or(V3::ZERO, |item| corners[item.name as usize][c]);
        Leaf {
            corner: lanes(|k| corner(k, 0)),
            edge1: lanes(|k| corner(k, 1) - corner(k, 0)),
            edge2: lanes(|k| corner(k, 2) - corner(k, 0)),
            names: std::array::from_fn(|k| items.get(k).map_or(u32::MAX, |item| item.name)),
        }
    }
}

fn lanes(of: impl Fn(usize) -> V3) -> Vectors {
    let four: [V3; LANES] = std::array::from_fn(of);
    [four.map(|v| v.x).into(), four.map(|v| v.y).into(), four.map(|v| v.z).into()]
}

/// The boxes that the ray enters before `limit`, as bits, and the distances.
#[inline(always)]
fn entry(node: &Node, ray: &Ray, limit: f32) -> (u32, f32x4) {
    let mut near = f32x4::ZERO;
    let mut far = f32x4::splat(f32::INFINITY);
    for axis in 0..3 {
        let a = (node.lo[axis] - ray.origin[axis]) * ray.inverse[axis];
        let b = (node.hi[axis] - ray.origin[axis]) * ray.inverse[axis];
        near = near.fast_max(a.fast_min(b));
        far = far.fast_min(a.fast_max(b));
    }
    let met = near.simd_le(far) & near.simd_le(f32x4::splat(limit));
    (met.to_bitmask() & node.present, near)
}

/// The triangles that the ray meets, from either side, as bits; distances and barycentric weights.
#[inline(always)]
fn meet(leaf: &Leaf, ray: &Ray) -> (u32, f32x4, f32x4, f32x4) {
    let p = cross(&ray.direction, &leaf.edge2);
    let determinant = dot(&leaf.edge1, &p);
    let inverse = f32x4::ONE / determinant;
    let s = std::array::from_fn(|k| ray.origin[k] - leaf.corner[k]);
    let u = dot(&s, &p) * inverse;
    let q = cross(&s, &leaf.edge1);
    let v = dot(&ray.direction, &q) * inverse;
    let t = dot(&leaf.edge2, &q) * inverse;
    // A determinant of zero makes all of these NaN or infinite, and fails one of the tests.
    let met = u.simd_ge(f32x4::ZERO)
        & v.simd_ge(f32x4::ZERO)
        & (u + v).simd_le(f32x4::ONE)
        & t.simd_gt(f32x4::ZERO)
        & determinant.simd_ne(f32x4::ZERO);
    (met.to_bitmask(), t, u, v)
}

fn dot(a: &Vectors, b: &Vectors) -> f32x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &Vectors, b: &Vectors) -> Vectors {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Divides at least two items where the expected cost is least.
fn halves(items: &mut [Item], depth: usize) -> [Group<'_>; 2] {
    let middle = match split(items) {
        Some((axis, plane)) if depth < DEPTH => partition(items, |item| item.centre.axis(axis) < plane),
        _ => items.len() / 2,
    };
    let middle = if middle == 0 || middle == items.len() { items.len() / 2 } else { middle };
    let (left, right) = items.split_at_mut(middle);
    [left, right].map(|half| group(half, depth + 1))
}

fn group(items: &mut [Item], depth: usize) -> Group<'_> {
    (items.iter().fold(Bounds::EMPTY, |b, item| b.with(item.bounds)), items, depth)
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

    /// The meeting point of a ray and a triangle.
    fn meeting([a, b, c]: [V3; 3], origin: V3, direction: V3) -> Option<(f32, f32, f32)> {
        let (edge1, edge2) = (b - a, c - a);
        let p = direction.cross(edge2);
        let inverse = 1.0 / edge1.dot(p);
        let s = origin - a;
        let u = s.dot(p) * inverse;
        let q = s.cross(edge1);
        let v = direction.dot(q) * inverse;
        let t = edge2.dot(q) * inverse;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some((t, u, v))
    }

    #[test]
    fn rays_within_the_planes_of_boxes() {
        // A grid of squares in z = 0, seen straight on along the lines where boxes touch.
        let corners: Vec<[V3; 3]> = (0..64)
            .flat_map(|k| {
                let (x, y) = ((k % 8) as f32, (k / 8) as f32);
                let at = |dx: f32, dy: f32| v3(x + dx, y + dy, 0.0);
                [[at(0., 0.), at(1., 0.), at(1., 1.)], [at(0., 0.), at(1., 1.), at(0., 1.)]]
            })
            .collect();
        let tree = Bvh::new(&corners);
        for k in 0..=8 {
            for l in 0..=8 {
                for z in [-1.0, 1.0] {
                    let hit = tree.hit(v3(k as f32, l as f32, -z), v3(0., 0., z), f32::INFINITY);
                    assert_eq!(hit.map(|h| h.t), Some(1.0), "{k} {l} {z}");
                }
            }
        }
        assert_eq!(tree.hit(v3(-2., 3., 0.), v3(1., 0., 0.), f32::INFINITY), None);
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
                .filter_map(|(&triangle, name)| {
                    meeting(triangle, origin, direction).map(|(t, u, v)| Hit { t, triangle: name, u, v })
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

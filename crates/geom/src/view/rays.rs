//! Families of rays in bundles of 64, ordered so that near rays are in one bundle, in a tree over their plane.
//!
//! The rays of a camera meet at its position; rays to a light are parallel. Each projects to a point of a
//! plane, and a convex solid to a convex polygon: a ray's line meets the solid when the point lies in the polygon. A
//! bundle is a word of bits in every set of rays; 64 bundles make a tile.

use crate::vector::Vec3;
use wide::f64x4;

/// The number of rays of a bundle.
pub const BUNDLE: usize = 64;
/// The number of rays of a row, if the rays of a bundle are in rows.
pub(super) const ROW: usize = 8;

/// The projection of points of space to the plane of a family of rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// A point of depth zero: the eye, or any point.
    pub origin: Vec3,
    /// Unit direction of the first coordinate of the plane.
    pub right: Vec3,
    /// Unit direction of the second coordinate of the plane.
    pub up: Vec3,
    /// Unit direction in which depth grows.
    pub forward: Vec3,
    /// True if rays leave the origin, so that plane coordinates are divided by depth; otherwise rays are parallel.
    pub perspective: bool,
}

impl Projection {
    /// Depth of a point, scene units along `forward`.
    #[inline]
    pub fn depth(&self, p: Vec3) -> f64 {
        self.forward.dot(p - self.origin)
    }

    /// The projection of a point. In perspective its depth must be positive.
    #[inline]
    pub fn fall(&self, p: Vec3) -> [f64; 2] {
        let q = p - self.origin;
        let (u, v) = (self.right.dot(q), self.up.dot(q));
        if self.perspective {
            let depth = self.forward.dot(q);
            [u / depth, v / depth]
        } else {
            [u, v]
        }
    }

    /// The projection of a point at a known depth.
    #[inline]
    pub fn fall_at(&self, p: Vec3, depth: f64) -> [f64; 2] {
        let q = p - self.origin;
        [self.right.dot(q) / depth, self.up.dot(q) / depth]
    }

    /// Direction of the ray at a point of the plane; depth grows by one along it.
    #[inline]
    pub fn direction(&self, at: [f64; 2]) -> Vec3 {
        if self.perspective { self.forward + self.right * at[0] + self.up * at[1] } else { self.forward }
    }

    /// The point at a depth whose projection is a point of the plane.
    pub fn point(&self, at: [f64; 2], depth: f64) -> Vec3 {
        let spread = if self.perspective { depth } else { 1.0 };
        self.origin + self.forward * depth + self.right * (at[0] * spread) + self.up * (at[1] * spread)
    }
}

/// A ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The point on the plane.
    pub at: [f64; 2],
    /// The start, world space.
    pub start: Vec3,
    /// The number of the pixel.
    pub pixel: u32,
}

/// Sixty-four rays, coordinate by coordinate; rays beyond `live` repeat another.
#[derive(Clone, Debug)]
pub(super) struct Bundle {
    pub at: [Coordinates; 2],
    pub start: [Coordinates; 3],
    pub live: u64,
    /// True for eight rows of eight: the rays of a row have the same v, and the rays of a column the same u.
    pub is_raster: bool,
}

/// A coordinate of the rays of a bundle, four by four.
type Coordinates = [f64x4; BUNDLE / 4];

/// A box of the plane and the range of depths at which its rays begin, over the bundles `first..first + count`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// The least and the largest u and v.
    pub ends: [[f64; 2]; 2],
    pub depth: [f64; 2],
    pub first: u32,
    pub count: u32,
    /// The first child is the next node; zero at a leaf.
    pub second: u32,
}

/// A family of rays.
#[derive(Clone, Debug)]
pub struct Rays {
    projection: Projection,
    /// The depth at which all rays begin, if it is the same.
    pub(super) near: Option<f64>,
    pub(super) nodes: Vec<Node>,
    pub(super) bundles: Vec<Bundle>,
    pixels: Vec<u32>,
}

impl Rays {
    /// The family of `rays`; `near` is the depth at which all of them begin, if it is the same.
    pub fn new(projection: Projection, near: Option<f64>, mut rays: Vec<Ray>) -> Rays {
        let mut family =
            Rays { projection, near, nodes: Vec::new(), bundles: Vec::new(), pixels: Vec::new() };
        if !rays.is_empty() {
            family.build(&mut rays);
        }
        family.pixels = rays.iter().map(|r| r.pixel).collect();
        family
    }

    fn build(&mut self, rays: &mut [Ray]) -> u32 {
        let index = self.nodes.len();
        let first = self.bundles.len() as u32;
        let mut node = Node {
            ends: [[f64::INFINITY, f64::NEG_INFINITY]; 2],
            depth: [f64::INFINITY, f64::NEG_INFINITY],
            first,
            count: 1,
            second: 0,
        };
        for ray in rays.iter() {
            let depth = self.projection.depth(ray.start);
            node.depth = [node.depth[0].min(depth), node.depth[1].max(depth)];
            for a in 0..2 {
                let [low, high] = node.ends[a];
                node.ends[a] = [low.min(ray.at[a]), high.max(ray.at[a])];
            }
        }
        self.nodes.push(node);
        if rays.len() <= BUNDLE {
            // The order from left to right, top to bottom is a function of the set of rays.
            rays.sort_unstable_by_key(|r| r.pixel);
            self.bundles.push(bundle(rays));
            return index as u32;
        }
        let [u, v] = node.ends;
        let axis = usize::from(v[1] - v[0] > u[1] - u[0]);
        // Full bundles, and full tiles above them.
        let unit = if rays.len() > BUNDLE * BUNDLE { BUNDLE * BUNDLE } else { BUNDLE };
        let half = rays.len().div_ceil(unit).div_ceil(2) * unit;
        let order = |r: &Ray, s: &Ray| r.at[axis].total_cmp(&s.at[axis]).then(r.pixel.cmp(&s.pixel));
        rays.select_nth_unstable_by(half, order);
        let (left, right) = rays.split_at_mut(half);
        self.build(left);
        self.nodes[index].second = self.build(right);
        self.nodes[index].count = self.bundles.len() as u32 - first;
        index as u32
    }

    /// The projection to the rays' plane.
    pub fn projection(&self) -> &Projection {
        &self.projection
    }

    /// True for the rays of a camera, one for each pixel of a picture. Rays to a light begin at different depths.
    pub(crate) fn are_of_camera(&self) -> bool {
        self.near.is_some()
    }

    /// Number of rays.
    pub fn len(&self) -> usize {
        self.pixels.len()
    }

    /// True when there is no ray.
    pub fn is_empty(&self) -> bool {
        self.pixels.is_empty()
    }

    /// Number of words of a set of rays.
    pub fn words(&self) -> usize {
        self.bundles.len()
    }

    /// The pixel of each ray, in the order of bits: word by word, lowest bit first. Only the last word has fewer
    /// than 64.
    pub fn pixels(&self) -> &[u32] {
        &self.pixels
    }

    /// The ray with this number, in the order of bits.
    pub fn ray(&self, number: usize) -> Ray {
        let (bundle, k) = (&self.bundles[number / BUNDLE], number % BUNDLE);
        let of = |c: &Coordinates| c[k / 4].to_array()[k % 4];
        let [x, y, z] = bundle.start.each_ref().map(of);
        Ray { at: bundle.at.each_ref().map(of), start: Vec3::from([x, y, z]), pixel: self.pixels[number] }
    }
}

pub(super) fn bundle(rays: &[Ray]) -> Bundle {
    let of = |k: usize| rays[k.min(rays.len() - 1)];
    let fours = |coordinate: &dyn Fn(Ray) -> f64| -> Coordinates {
        std::array::from_fn(|four| f64x4::from([0, 1, 2, 3].map(|k| coordinate(of(4 * four + k)))))
    };
    let is_raster = (0..BUNDLE).all(|k| of(k).at == [of(k % ROW).at[0], of(k / ROW * ROW).at[1]]);
    Bundle {
        at: [fours(&|ray| ray.at[0]), fours(&|ray| ray.at[1])],
        start: [fours(&|ray| ray.start.x), fours(&|ray| ray.start.y), fours(&|ray| ray.start.z)],
        live: u64::MAX >> (BUNDLE - rays.len()),
        is_raster: is_raster && rays.len() == BUNDLE,
    }
}

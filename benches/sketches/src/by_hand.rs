//! Loops by hand, for one case each: no sharing, no undo, one answer.

use niwaki_geom::{Aabb, Convex, Grid, TriMesh, Vec3};
use wide::f64x4;

/// A grid of bits, rows of words along x.
pub struct Bits {
    dims: [usize; 3],
    across: usize,
    words: Vec<u64>,
}

impl Bits {
    /// An empty grid.
    pub fn new(dims: [usize; 3]) -> Bits {
        let across = dims[0].div_ceil(64);
        Bits { dims, across, words: vec![0; across * dims[1] * dims[2]] }
    }

    /// A grid whose cells are set where `is_set` says so.
    pub fn of(dims: [usize; 3], is_set: impl Fn([usize; 3]) -> bool) -> Bits {
        let mut bits = Bits::new(dims);
        for z in 0..dims[2] {
            for y in 0..dims[1] {
                for x in (0..dims[0]).filter(|x| is_set([*x, y, z])) {
                    bits.words[(z * dims[1] + y) * bits.across + x / 64] |= 1 << (x % 64);
                }
            }
        }
        bits
    }

    /// Becomes a copy of another of the same size.
    pub fn copy(&mut self, other: &Bits) {
        self.words.copy_from_slice(&other.words);
    }

    /// Sets the cells from `first` to `last` of a row; counts those that were not set, and those of them in `target`.
    #[inline(always)]
    fn set(&mut self, target: &Bits, row: usize, first: usize, last: usize, new: &mut [u32; 2]) {
        for word in first / 64..=last / 64 {
            let low = if word == first / 64 { !0 << (first % 64) } else { !0 };
            let high = if word == last / 64 { !0 >> (63 - last % 64) } else { !0 };
            let at = row * self.across + word;
            let fresh = low & high & !self.words[at];
            self.words[at] |= fresh;
            new[0] += fresh.count_ones();
            new[1] += (fresh & target.words[at]).count_ones();
        }
    }
}

/// Sets the cells that a box along the axes touches.
pub fn aligned_box(bits: &mut Bits, target: &Bits, grid: &Grid, aabb: &Aabb) -> [u32; 2] {
    let mut new = [0; 2];
    let (low, high) = (grid.to_grid(aabb.low).to_array(), grid.to_grid(aabb.high).to_array());
    if (0..3).any(|a| high[a] < 0.0 || low[a] >= bits.dims[a] as f64) {
        return new;
    }
    let first = low.map(|at| at.max(0.0) as usize);
    let last = [0, 1, 2].map(|a| (high[a] as usize).min(bits.dims[a] - 1));
    for z in first[2]..=last[2] {
        for y in first[1]..=last[1] {
            bits.set(target, z * bits.dims[1] + y, first[0], last[0], &mut new);
        }
    }
    new
}

/// Sets the cells whose middle is in a closed mesh: each triangle turns over the rest of the rows behind it. `rows` is empty before and after.
pub fn closed(bits: &mut Bits, target: &Bits, grid: &Grid, mesh: &TriMesh, rows: &mut Bits) -> [u32; 2] {
    let mut new = [0; 2];
    let points: Vec<[f64; 3]> = mesh.vertices().iter().map(|p| grid.to_grid(*p).to_array()).collect();
    let span = |a: usize, of: &[[f64; 3]]| {
        of.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p[a]), high.max(p[a])))
    };
    // Middles of cells from `low` to `high`.
    let middles = |(low, high): (f64, f64), count: usize| {
        (low - 0.5).ceil().max(0.0) as usize
            ..((high - 0.5).floor().min(count as f64 - 1.0) + 1.0).max(0.0) as usize
    };
    let (across, dims) = (bits.across, bits.dims);
    for t in mesh.triangles() {
        let [p, q, r] = t.map(|v| points[v as usize]);
        let (u, v) = ([q[1] - p[1], q[2] - p[2]], [r[1] - p[1], r[2] - p[2]]);
        let area = u[0] * v[1] - u[1] * v[0];
        if area == 0.0 {
            continue;
        }
        for z in middles(span(2, &[p, q, r]), dims[2]) {
            for y in middles(span(1, &[p, q, r]), dims[1]) {
                let w = [y as f64 + 0.5 - p[1], z as f64 + 0.5 - p[2]];
                let (b, c) = ((w[0] * v[1] - w[1] * v[0]) / area, (u[0] * w[1] - u[1] * w[0]) / area);
                if b < 0.0 || c < 0.0 || b + c > 1.0 {
                    continue;
                }
                let x = p[0] + b * (q[0] - p[0]) + c * (r[0] - p[0]);
                let start = (x - 0.5).ceil().max(0.0) as usize;
                if start >= dims[0] {
                    continue;
                }
                let row = (z * dims[1] + y) * across;
                rows.words[row + start / 64] ^= !0 << (start % 64);
                rows.words[row + start / 64 + 1..row + across].iter_mut().for_each(|word| *word = !*word);
            }
        }
    }
    for z in middles(span(2, &points), dims[2]) {
        for y in middles(span(1, &points), dims[1]) {
            let row = (z * dims[1] + y) * across;
            for (word, at) in (row..row + across).enumerate() {
                let cells = dims[0].saturating_sub(64 * word).min(64);
                let within = if cells == 64 { !0 } else { (1 << cells) - 1 };
                let fresh = std::mem::take(&mut rows.words[at]) & within & !bits.words[at];
                bits.words[at] |= fresh;
                new[0] += fresh.count_ones();
                new[1] += (fresh & target.words[at]).count_ones();
            }
        }
    }
    new
}

/// Sets the cells whose middle is in a convex solid: four rows at a time, each between all pairs of planes.
pub fn convex(bits: &mut Bits, target: &Bits, grid: &Grid, solid: &Convex<'_>) -> [u32; 2] {
    let mut new = [0; 2];
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let mut corners = [[0.0; 3]; 64];
    let count = solid.corners().len();
    for (to, from) in corners.iter_mut().zip(solid.corners()) {
        *to = grid.to_grid(*from).to_array();
        for a in 0..3 {
            low[a] = low[a].min(to[a]);
            high[a] = high[a].max(to[a]);
        }
    }
    if (0..3).any(|a| high[a] < 0.0 || low[a] >= bits.dims[a] as f64) {
        return new;
    }
    let first = low.map(|at| at.max(0.0) as usize);
    let last = [0, 1, 2].map(|a| (high[a] as usize).min(bits.dims[a] - 1));
    let cell = grid.cell().to_array();
    let mut slabs = [([0.0; 3], 0.0, 0.0); 32];
    let faces = solid.normals().len();
    for (slab, normal) in slabs.iter_mut().zip(solid.normals()) {
        let n = normal.to_array();
        let n = [n[0] * cell[0], n[1] * cell[1], n[2] * cell[2]];
        let along = |p: &[f64; 3]| n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for p in &corners[..count] {
            from = from.min(along(p));
            to = to.max(along(p));
        }
        *slab = (n, from, to);
    }
    let lanes = f64x4::from([0.5, 1.5, 2.5, 3.5]);
    for z in first[2]..=last[2] {
        let mut y = first[1];
        while y <= last[1] {
            let ys = lanes + f64x4::splat(y as f64);
            let (mut from, mut to) = (f64x4::splat(f64::NEG_INFINITY), f64x4::splat(f64::INFINITY));
            for (n, least, most) in &slabs[..faces] {
                let rest = f64x4::splat(n[1]) * ys + f64x4::splat(n[2] * (z as f64 + 0.5));
                let (a, b) = (f64x4::splat(*least) - rest, f64x4::splat(*most) - rest);
                if n[0].abs() > 1e-12 {
                    let scale = f64x4::splat(1.0 / n[0]);
                    let (a, b) = (a * scale, b * scale);
                    from = from.max(a.min(b));
                    to = to.min(a.max(b));
                } else {
                    let (a, b) = (a.to_array(), b.to_array());
                    let out: [f64; 4] = [0, 1, 2, 3]
                        .map(|i| if a[i] > 0.0 || b[i] < 0.0 { f64::INFINITY } else { f64::NEG_INFINITY });
                    from = from.max(f64x4::from(out));
                }
            }
            let (from, to) = (from.to_array(), to.to_array());
            for lane in 0..4.min(last[1] + 1 - y) {
                let start = (from[lane] - 0.5).ceil().max(0.0);
                let end = (to[lane] - 0.5).floor().min(bits.dims[0] as f64 - 1.0);
                if start <= end {
                    bits.set(target, z * bits.dims[1] + y + lane, start as usize, end as usize, &mut new);
                }
            }
            y += 4;
        }
    }
    new
}

/// Sets the pixels whose middle is in the hull of points of a picture: the ends of each row from the edges.
pub fn outline(bits: &mut Bits, target: &Bits, points: &[[f64; 2]], edges: &[[u32; 2]]) -> [u32; 2] {
    let [width, height, _] = bits.dims;
    let mut ends = [(f64::INFINITY, f64::NEG_INFINITY); 1024];
    let (mut top, mut bottom) = (height, 0);
    for [a, b] in edges {
        let (mut a, mut b) = (points[*a as usize], points[*b as usize]);
        if a[1] > b[1] {
            (a, b) = (b, a);
        }
        let first = (a[1] - 0.5).ceil().max(0.0) as usize;
        let end = ((b[1] - 0.5).floor() + 1.0).clamp(0.0, height as f64) as usize;
        if first >= end {
            continue;
        }
        (top, bottom) = (top.min(first), bottom.max(end));
        let slope = (b[0] - a[0]) / (b[1] - a[1]);
        for (row, ends) in ends.iter_mut().enumerate().take(end).skip(first) {
            let x = a[0] + slope * (row as f64 + 0.5 - a[1]);
            *ends = (ends.0.min(x), ends.1.max(x));
        }
    }
    let mut new = [0; 2];
    for (row, (from, to)) in ends.iter().enumerate().take(bottom).skip(top) {
        let (start, end) = ((from - 0.5).ceil().max(0.0), (to - 0.5).floor().min(width as f64 - 1.0));
        if start <= end {
            bits.set(target, row, start as usize, end as usize, &mut new);
        }
    }
    new
}

/// A box in any direction: middle, unit axes, half lengths.
pub struct Oriented {
    middle: Vec3,
    axes: [Vec3; 3],
    half: [f64; 3],
}

impl Oriented {
    /// Of the eight corners of a box, bit 0, 1 and 2 of the index choosing the high x, y and z.
    pub fn of(corners: &[Vec3]) -> Oriented {
        let sides = [1, 2, 4].map(|bit| corners[bit] - corners[0]);
        let middle = (corners[0] + corners[7]) * 0.5;
        let half = sides.map(|side| 0.5 * side.norm());
        Oriented { middle, axes: [0, 1, 2].map(|a| sides[a] * (0.5 / half[a])), half }
    }

    /// Whether two boxes overlap, by fifteen axes (Gottschalk, Lin & Manocha 1996).
    pub fn meets(&self, other: &Oriented) -> bool {
        let mut turn = [[0.0; 3]; 3];
        let mut size = [[0.0; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                turn[i][j] = self.axes[i].dot(other.axes[j]);
                size[i][j] = turn[i][j].abs() + 1e-12;
            }
        }
        let apart = other.middle - self.middle;
        let t = self.axes.map(|axis| axis.dot(apart));
        let (a, b) = (&self.half, &other.half);
        for i in 0..3 {
            if t[i].abs() > a[i] + b[0] * size[i][0] + b[1] * size[i][1] + b[2] * size[i][2] {
                return false;
            }
            let along = t[0] * turn[0][i] + t[1] * turn[1][i] + t[2] * turn[2][i];
            if along.abs() > b[i] + a[0] * size[0][i] + a[1] * size[1][i] + a[2] * size[2][i] {
                return false;
            }
        }
        for i in 0..3 {
            let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
            for j in 0..3 {
                let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
                let along = t[i2] * turn[i1][j] - t[i1] * turn[i2][j];
                let reach =
                    a[i1] * size[i2][j] + a[i2] * size[i1][j] + b[j1] * size[i][j2] + b[j2] * size[i][j1];
                if along.abs() > reach {
                    return false;
                }
            }
        }
        true
    }
}

/// Boxes along the axes, side by side, so that four are tested at once.
#[derive(Default)]
pub struct Boxes {
    low: [Vec<f64x4>; 3],
    high: [Vec<f64x4>; 3],
}

impl Boxes {
    /// Of some boxes.
    pub fn of(boxes: &[Aabb]) -> Boxes {
        let mut found = Boxes::default();
        for four in boxes.chunks(4) {
            for a in 0..3 {
                let at = |end: fn(&Aabb) -> Vec3, none: f64| {
                    f64x4::from([0, 1, 2, 3].map(|i| four.get(i).map_or(none, |one| end(one).to_array()[a])))
                };
                found.low[a].push(at(|one| one.low, f64::INFINITY));
                found.high[a].push(at(|one| one.high, f64::NEG_INFINITY));
            }
        }
        found
    }

    /// Calls `f` with the number of each box that meets this one, until `f` says true; whether it did.
    #[inline(always)]
    pub fn any(&self, aabb: &Aabb, mut f: impl FnMut(usize) -> bool) -> bool {
        let (low, high) = (aabb.low.to_array().map(f64x4::splat), aabb.high.to_array().map(f64x4::splat));
        for group in 0..self.low[0].len() {
            let mut meets = 15;
            for a in 0..3 {
                let one = self.low[a][group].simd_lt(high[a]) & self.high[a][group].simd_gt(low[a]);
                meets &= one.to_bitmask();
            }
            while meets != 0 {
                if f(4 * group + meets.trailing_zeros() as usize) {
                    return true;
                }
                meets &= meets - 1;
            }
        }
        false
    }
}

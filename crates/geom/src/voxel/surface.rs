//! Conservative surface voxels: every cell whose closed cube a triangle touches.
//!
//! Triangle against box by separating axes (Akenine-Moeller 2001): the box's three normals, the triangle's, and the
//! nine products of edges, in grid coordinates where the cell is a unit cube.
//!
//! The triangulation of a flat part makes no difference, even where triangles lie over one another (`folds`).

use super::cells::CellBox;
use super::grid::{Grid, TOUCH};
use crate::folds::Fold;
use crate::mesh::TriMesh;
use crate::vector::{Vec3, vec3};

/// Tolerance of the tests against the triangle's plane and edges, cells.
pub const PLANE: f64 = 1e-5;
/// The number of cells up to which all cells of a row are tested.
const SHORT_ROW: i64 = 4;
/// The component along x from which the first direction bounds a row.
const LEAST_SLOPE: f64 = 1e-6;

/// A dense set of cells in a box, x in the bits of words. Unlike a grid, the box may start below zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Bits {
    low: [i64; 3],
    dims: [usize; 3],
    columns: usize,
    pub(super) words: Vec<u64>,
}

impl Bits {
    /// The empty set over cells `low..=high`. The first x is rounded down to a whole word.
    pub fn empty(low: [i64; 3], high: [i64; 3]) -> Bits {
        let low = [low[0].div_euclid(64) * 64, low[1], low[2]];
        let dims: [usize; 3] = std::array::from_fn(|a| (high[a] - low[a] + 1).max(0) as usize);
        let columns = dims[0].div_ceil(64);
        Bits { low, dims, columns, words: vec![0; columns * dims[1] * dims[2]] }
    }

    /// Words of one row.
    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    /// Rows along y and z.
    pub(super) fn rows(&self) -> [usize; 2] {
        [self.dims[1], self.dims[2]]
    }

    /// First cell of the box.
    pub(super) fn low(&self) -> [i64; 3] {
        self.low
    }

    fn place(&self, x: i64, y: i64, z: i64) -> Option<(usize, u32)> {
        let [x, y, z] = [x - self.low[0], y - self.low[1], z - self.low[2]];
        let inside = x >= 0 && y >= 0 && z >= 0;
        if !inside || x as usize >= self.dims[0] || y as usize >= self.dims[1] || z as usize >= self.dims[2] {
            return None;
        }
        let row = z as usize * self.dims[1] + y as usize;
        Some((row * self.columns + x as usize / 64, x as u32 % 64))
    }

    /// True when the cell is in the set.
    pub fn get(&self, x: i64, y: i64, z: i64) -> bool {
        self.place(x, y, z).is_some_and(|(word, bit)| self.words[word] >> bit & 1 == 1)
    }

    /// Puts a cell into the set; cells outside of the box are ignored.
    pub fn set(&mut self, x: i64, y: i64, z: i64) {
        if let Some((word, bit)) = self.place(x, y, z) {
            self.words[word] |= 1 << bit;
        }
    }

    /// Takes a cell out of the set.
    pub(super) fn clear(&mut self, [x, y, z]: [i64; 3]) {
        if let Some((word, bit)) = self.place(x, y, z) {
            self.words[word] &= !(1 << bit);
        }
    }

    /// Takes the cells of another set over the same box out of this one.
    pub(super) fn remove(&mut self, other: &Bits) {
        self.words.iter_mut().zip(&other.words).for_each(|(word, other)| *word &= !other);
    }

    /// Puts cells `64 * column ..` of a row of the box into the set.
    pub(super) fn put(&mut self, column: usize, y: usize, z: usize, cells: u64) {
        if let Some((word, _)) = self.place(column as i64 * 64, y as i64, z as i64) {
            self.words[word] |= cells;
        }
    }

    /// A cell of the set.
    pub(super) fn first(&self) -> Option<[i64; 3]> {
        let at = self.words.iter().position(|word| *word != 0)?;
        let (row, x) = (at / self.columns, at % self.columns * 64 + self.words[at].trailing_zeros() as usize);
        let (y, z) = (row % self.dims[1], row / self.dims[1]);
        Some([self.low[0] + x as i64, self.low[1] + y as i64, self.low[2] + z as i64])
    }

    /// Cells `64 * column ..` of a row.
    #[inline]
    pub fn word(&self, column: usize, y: usize, z: usize) -> u64 {
        self.place(column as i64 * 64, y as i64, z as i64).map_or(0, |(word, _)| self.words[word])
    }

    /// The part of the box inside `limits`; `None` when there is none.
    pub fn cells_within(&self, limits: &CellBox) -> Option<CellBox> {
        let mut cells = *limits;
        for a in 0..3 {
            let last = self.low[a] + self.dims[a] as i64 - 1;
            if last < limits.low[a] as i64 || self.low[a] > limits.high[a] as i64 {
                return None;
            }
            cells.low[a] = cells.low[a].max(self.low[a].max(0) as usize);
            cells.high[a] = cells.high[a].min(last as usize);
        }
        Some(cells)
    }
}

/// The largest whole number up to `x`. `f64::floor` is a call, because not every processor rounds.
#[inline]
fn floor(x: f64) -> i64 {
    let whole = x as i64;
    whole.saturating_sub(i64::from(whole as f64 > x))
}

/// Corners of a triangle in grid coordinates, with the cells of its box.
pub(super) fn in_grid(corners: [Vec3; 3], grid: &Grid) -> ([Vec3; 3], [i64; 3], [i64; 3]) {
    let t = corners.map(|p| grid.to_grid(p));
    let low = t[0].min(t[1]).min(t[2]);
    let high = t[0].max(t[1]).max(t[2]);
    let first = low.to_array().map(|x| floor(x - TOUCH));
    let last = high.to_array().map(|x| floor(x + TOUCH));
    (t, first, last)
}

/// Sets every cell of `bits` that the surface of `mesh` touches: the cells of its triangles, and the cells that the border of
/// a flat part that lies over itself encloses.
pub fn mark(mesh: &TriMesh, grid: &Grid, bits: &mut Bits) {
    let mut folded = vec![false; if mesh.folds().is_empty() { 0 } else { mesh.triangles().len() }];
    mesh.folds().iter().flat_map(|fold| &fold.triangles).for_each(|i| folded[*i as usize] = true);
    for (i, corners) in mesh.corners().enumerate() {
        if !folded.get(i).is_some_and(|folded| *folded) {
            visit(corners, grid, bits, |bits, _, [x, y, z]| bits.set(x, y, z));
        }
    }
    for fold in mesh.folds() {
        mark_fold(mesh, fold, grid, bits);
    }
}

/// Sets every cell of `marked` that is in `among` and that a triangle of `mesh` touches. The two sets are over one box.
pub(super) fn mark_among(mesh: &TriMesh, grid: &Grid, among: &Bits, marked: &mut Bits) {
    let end: [i64; 3] = std::array::from_fn(|a| among.low[a] + among.dims[a] as i64 - 1);
    for corners in mesh.corners() {
        let (t, first, last) = in_grid(corners, grid);
        let mut axes = None;
        let [x, last_x] = [first[0].max(among.low[0]), last[0].min(end[0])].map(|x| x - among.low[0]);
        if x > last_x {
            continue;
        }
        for z in first[2].max(among.low[2])..=last[2].min(end[2]) {
            for y in first[1].max(among.low[1])..=last[1].min(end[1]) {
                let row = ((z - among.low[2]) as usize * among.dims[1] + (y - among.low[1]) as usize)
                    * among.columns;
                for column in x / 64..=last_x / 64 {
                    let at = row + column as usize;
                    let mut open =
                        among.words[at] & !marked.words[at] & cells_between(x, last_x, column * 64);
                    while open != 0 {
                        let bit = open.trailing_zeros();
                        open &= open - 1;
                        let across = (among.low[0] + column * 64 + i64::from(bit)) as f64;
                        let middle = vec3(across + 0.5, y as f64 + 0.5, z as f64 + 0.5);
                        let axes = axes.get_or_insert_with(|| separating_axes(&t));
                        if axes.meet(middle) {
                            marked.words[at] |= 1 << bit;
                        }
                    }
                }
            }
        }
    }
}

/// The bits of a word that begins at `base` for the cells `first..=last`.
fn cells_between(first: i64, last: i64, base: i64) -> u64 {
    let (low, high) = ((first - base).clamp(0, 63), (last - base).clamp(0, 63));
    (u64::MAX >> (63 - high)) & (u64::MAX << low)
}

/// Calls `f` with each cell of the box of `bits` that a triangle touches, and the triangle in grid coordinates.
fn visit(
    corners: [Vec3; 3],
    grid: &Grid,
    bits: &mut Bits,
    mut f: impl FnMut(&mut Bits, &[Vec3; 3], [i64; 3]),
) {
    let end: [i64; 3] = std::array::from_fn(|a| bits.low[a] + bits.dims[a] as i64 - 1);
    let (t, first, last) = in_grid(corners, grid);
    let axes = separating_axes(&t);
    let row = [first[0].max(bits.low[0]), last[0].min(end[0])];
    for z in first[2].max(bits.low[2])..=last[2].min(end[2]) {
        for y in first[1].max(bits.low[1])..=last[1].min(end[1]) {
            let [from, to] = axes.part_of_row(row, y as f64 + 0.5, z as f64 + 0.5);
            for x in from..=to {
                let middle = vec3(x as f64 + 0.5, y as f64 + 0.5, z as f64 + 0.5);
                if axes.meet(middle) {
                    f(bits, &t, [x, y, z]);
                }
            }
        }
    }
}

/// Sets the cells of a flat part by its border. In a cell that the border does not touch, it winds around every point of the
/// part's plane equally often.
fn mark_fold(mesh: &TriMesh, fold: &Fold, grid: &Grid, bits: &mut Bits) {
    let at = |v: u32| mesh.vertices()[v as usize];
    for [a, b] in &fold.border {
        visit([at(*a), at(*b), at(*b)], grid, bits, |bits, _, [x, y, z]| bits.set(x, y, z));
    }
    let border: Vec<[Vec3; 2]> = fold.border.iter().map(|edge| edge.map(|v| grid.to_grid(at(v)))).collect();
    // The border's area, seen from anywhere.
    let area =
        border.iter().fold(Vec3::ZERO, |sum, [a, b]| sum + (*a - border[0][0]).cross(*b - border[0][0]));
    let axis = (0..3).max_by(|i, j| area[*i].abs().total_cmp(&area[*j].abs())).unwrap_or(0);
    for i in &fold.triangles {
        visit(mesh.triangles()[*i as usize].map(at), grid, bits, |bits, t, [x, y, z]| {
            if !bits.get(x, y, z) && point_in(t, [x, y, z]).is_none_or(|p| winds(&border, p, axis)) {
                bits.set(x, y, z);
            }
        });
    }
}

/// A point of a triangle in a cell, in grid coordinates: the mean of the corners of the clipped triangle (Sutherland &
/// Hodgman 1974).
fn point_in(t: &[Vec3; 3], cell: [i64; 3]) -> Option<Vec3> {
    let mut corners = t.to_vec();
    for a in 0..3 {
        for (sign, at) in [(1.0, cell[a] as f64), (-1.0, -(cell[a] + 1) as f64)] {
            let inside = |p: &Vec3| sign * p[a] - at + PLANE;
            let mut clipped = Vec::with_capacity(corners.len() + 1);
            for (k, p) in corners.iter().enumerate() {
                let q = &corners[(k + 1) % corners.len()];
                let (from, to) = (inside(p), inside(q));
                if from >= 0.0 {
                    clipped.push(*p);
                }
                if (from >= 0.0) != (to >= 0.0) {
                    clipped.push(*p + (*q - *p) * (from / (from - to)));
                }
            }
            corners = clipped;
        }
    }
    let count = corners.len() as f64;
    (count > 0.0).then(|| corners.into_iter().fold(Vec3::ZERO, |sum, p| sum + p) * (1.0 / count))
}

/// True when a border winds around a point, seen along an axis.
fn winds(border: &[[Vec3; 2]], p: Vec3, axis: usize) -> bool {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut turns = 0;
    for [a, b] in border {
        let side = (b[u] - a[u]) * (p[v] - a[v]) - (b[v] - a[v]) * (p[u] - a[u]);
        match (a[v] <= p[v], b[v] <= p[v]) {
            (true, false) if side > 0.0 => turns += 1,
            (false, true) if side < 0.0 => turns -= 1,
            _ => (),
        }
    }
    turns != 0
}

/// A direction, with the triangle's extent along it, widened by a unit cube's half extent.
#[derive(Clone, Copy, Default)]
struct Axis {
    direction: Vec3,
    low: f64,
    high: f64,
}

impl Axis {
    #[inline]
    fn meets(&self, middle: Vec3) -> bool {
        let along = self.direction.dot(middle);
        self.low <= along && along <= self.high
    }
}

/// The directions along which a triangle and a cell may be apart.
#[derive(Default)]
struct Axes {
    /// The triangle's normal is the first, where the triangle has a plane.
    axes: [Axis; 10],
    count: usize,
    /// Cells along x for a step along the first direction; zero where it hardly leads along x.
    cells: f64,
}

impl Axes {
    /// True when no direction separates the triangle from the cell with this middle.
    #[inline]
    fn meet(&self, middle: Vec3) -> bool {
        self.axes[..self.count].iter().all(|axis| axis.meets(middle))
    }

    /// The cells of a row along x that the plane of the triangle may meet: all that it does, and at most two more.
    #[inline]
    fn part_of_row(&self, [first, last]: [i64; 2], y: f64, z: f64) -> [i64; 2] {
        let Axis { direction, low, high } = self.axes[0];
        if last - first < SHORT_ROW || self.cells == 0.0 {
            return [first, last];
        }
        let rest = direction.y * y + direction.z * z;
        let [a, b] = [low, high].map(|end| (end - rest) * self.cells - 0.5);
        // Rounding moves a bound by less than a cell.
        [(a.min(b) - 1.0).max(first as f64).ceil() as i64, floor((a.max(b) + 1.0).min(last as f64))]
    }
}

/// The triangle's normal and the nine products of its edges with the cube's (the cube's own normals are the box
/// of candidate cells). Directions that vanish separate nothing and are skipped.
fn separating_axes(t: &[Vec3; 3]) -> Axes {
    let edges = [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    let products = edges.iter().flat_map(|e| Vec3::AXES.map(|a| a.cross(*e)));
    let mut all = Axes::default();
    for direction in std::iter::once(edges[0].cross(edges[1])).chain(products).filter_map(Vec3::unit) {
        let along = t.map(|p| direction.dot(p));
        let half = 0.5 * (direction.x.abs() + direction.y.abs() + direction.z.abs()) + PLANE;
        let low = along[0].min(along[1]).min(along[2]) - half;
        let high = along[0].max(along[1]).max(along[2]) + half;
        all.axes[all.count] = Axis { direction, low, high };
        all.count += 1;
    }
    let slope = all.axes[0].direction.x;
    all.cells = if slope.abs() > LEAST_SLOPE { 1.0 / slope } else { 0.0 };
    all
}

/// True when the triangle (grid coordinates) touches the closed cell.
pub fn touches(t: &[Vec3; 3], cell: [i64; 3]) -> bool {
    let low = t[0].min(t[1]).min(t[2]);
    let high = t[0].max(t[1]).max(t[2]);
    let boxed = (0..3).all(|a| low[a] - TOUCH <= (cell[a] + 1) as f64 && high[a] + TOUCH >= cell[a] as f64);
    let middle = vec3(cell[0] as f64 + 0.5, cell[1] as f64 + 0.5, cell[2] as f64 + 0.5);
    boxed && separating_axes(t).meet(middle)
}

//! Flat parts of a mesh whose triangles lie on both sides of one another.
//!
//! A program that cuts a polygon with an inner corner into a fan makes triangles that reach beyond its border, and others,
//! facing the other way, that lie over them. Front less back, they still cover the polygon once and all other places not at
//! all. So the cells of such a part are the cells of its *border*, and of the places that this border winds around. The
//! border has the edges that no two of its triangles share in opposite directions. The cells do not depend on the cut.
//!
//! A part whose sides cancel everywhere is a sheet with two sides, such as a leaf, and does not change.

use crate::mesh::TriMesh;
use crate::vector::Vec3;

/// The largest distance of points from their plane, as a share of the largest coordinate: 16 roundings of 32-bit numbers.
const FLAT: f64 = 1.0 / (1 << 20) as f64;
/// The largest area that counts as zero, as a share of a part's area.
const NOTHING: f64 = 1e-6;
/// Area of a triangle that is nearly a line, as a share of the square of its longest side.
const LINE: f64 = 1e-5;
/// The most triangles at an edge that joins them: more are no polygon, and the time would grow with the square of their
/// number.
const MOST: usize = 16;

/// A flat part that lies over itself.
#[derive(Clone, Debug)]
pub(crate) struct Fold {
    /// The numbers of its triangles.
    pub triangles: Vec<u32>,
    /// The edges of the border in their direction. An edge may come several times.
    pub border: Vec<[u32; 2]>,
}

/// The triangles of each edge: its vertices, the lower number first, and a triangle, in order.
struct Edges(Vec<(u64, u32)>);

impl Edges {
    fn of(triangles: &[[u32; 3]]) -> Edges {
        let mut rows: Vec<_> =
            (0..).zip(triangles).flat_map(|(i, t)| sides(t).map(|e| (key(e), i))).collect();
        rows.sort_unstable();
        Edges(rows)
    }

    fn at(&self, edge: [u32; 2]) -> &[(u64, u32)] {
        let edge = key(edge);
        let first = self.0.partition_point(|row| row.0 < edge);
        let count = self.0[first..].iter().take(MOST + 1).take_while(|row| row.0 == edge).count();
        if count > MOST { &[] } else { &self.0[first..first + count] }
    }

    /// True when two triangles of some edge may lie over one another.
    fn any(&self, may: impl Fn(u32, u32) -> bool) -> bool {
        self.0.chunk_by(|a, b| a.0 == b.0).filter(|alike| alike.len() <= MOST).any(|alike| {
            alike.iter().enumerate().any(|(k, (_, i))| alike[..k].iter().any(|(_, j)| may(*i, *j)))
        })
    }
}

fn key(edge: [u32; 2]) -> u64 {
    let [a, b] = ordered(edge);
    u64::from(a) << 32 | u64::from(b)
}

fn sides([a, b, c]: &[u32; 3]) -> [[u32; 2]; 3] {
    [[*a, *b], [*b, *c], [*c, *a]]
}

fn ordered([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The flat parts of a mesh that lie over themselves.
pub(crate) fn folds(mesh: &TriMesh) -> Vec<Fold> {
    let (points, merged) = (mesh.vertices(), mesh.merged());
    let triangles: Vec<[u32; 3]> = mesh.triangles().iter().map(|t| t.map(|v| merged[v as usize])).collect();
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| points[v as usize]);
        (b - a).cross(c - a)
    };
    let areas: Vec<Vec3> = triangles.iter().map(area).collect();
    let edges = Edges::of(&triangles);
    // In a flat part with two sides, two triangles that face away from each other share an edge, or a triangle that is nearly a
    // line is between them. Few meshes have such an edge.
    let is_line = |i: u32| {
        let t = &triangles[i as usize];
        let longest = sides(t).map(|[a, b]| points[a as usize] - points[b as usize]).map(|d| d.dot(d));
        areas[i as usize].norm() <= LINE * longest.into_iter().fold(0.0, f64::max)
    };
    let face_away = |i: u32, j: u32| areas[i as usize].dot(areas[j as usize]) < 0.0;
    if !edges.any(|i, j| face_away(i, j) || is_line(i) || is_line(j)) {
        return Vec::new();
    }
    let largest =
        mesh.corners().flatten().flat_map(Vec3::to_array).fold(0.0, |most: f64, x| most.max(x.abs()));
    // The largest triangle comes first, because its plane is the most accurate.
    let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
    let size = |i: &u32| areas[*i as usize].dot(areas[*i as usize]);
    order.sort_by(|i, j| size(j).total_cmp(&size(i)));
    let mut is_visited = vec![false; triangles.len()];
    let mut folds = Vec::new();
    for seed in order {
        let Some(normal) = areas[seed as usize].unit().filter(|_| !is_visited[seed as usize]) else {
            continue;
        };
        let level = normal.dot(points[triangles[seed as usize][0] as usize]);
        let is_flat = |i: u32| {
            let near = |v: u32| (normal.dot(points[v as usize]) - level).abs() <= FLAT * largest;
            triangles[i as usize].into_iter().all(near)
        };
        is_visited[seed as usize] = true;
        let mut part = vec![seed];
        let mut next = 0;
        while next < part.len() {
            for edge in sides(&triangles[part[next] as usize]) {
                for (_, other) in edges.at(edge) {
                    if !is_visited[*other as usize] && is_flat(*other) {
                        is_visited[*other as usize] = true;
                        part.push(*other);
                    }
                }
            }
            next += 1;
        }
        let facing = || part.iter().map(|i| normal.dot(areas[*i as usize]));
        let (front, back) =
            (facing().map(|a| a.max(0.0)).sum::<f64>(), facing().map(|a| (-a).max(0.0)).sum::<f64>());
        let threshold = NOTHING * (front + back);
        if back > threshold && front > threshold && (front - back).abs() > threshold {
            let border = border(part.iter().map(|i| &triangles[*i as usize]));
            folds.push(Fold { triangles: part, border });
        }
    }
    folds
}

/// The edges of triangles that no two of them share in opposite directions.
fn border<'a>(triangles: impl Iterator<Item = &'a [u32; 3]>) -> Vec<[u32; 2]> {
    let mut uses: Vec<([u32; 2], i32)> =
        triangles.flat_map(sides).map(|e| (ordered(e), if e[0] < e[1] { 1 } else { -1 })).collect();
    uses.sort_unstable();
    let mut border = Vec::new();
    for alike in uses.chunk_by(|a, b| a.0 == b.0) {
        let ([a, b], count) = (alike[0].0, alike.iter().map(|edge| edge.1).sum::<i32>());
        let edge = if count > 0 { [a, b] } else { [b, a] };
        border.extend(std::iter::repeat_n(edge, count.unsigned_abs() as usize).filter(|_| a != b));
    }
    border
}

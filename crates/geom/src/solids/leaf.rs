//! A leaf of a cut: its faces, how they divide a piece of another face, and whether it contains a point.

use super::shape::Shape;
use super::sides::Sides;
use crate::bounds::Aabb;
use crate::fine::FineMesh;
use crate::vector::{Vec3, vec3};
use crate::winding::winds_around;

/// A plane: the points `p` with `normal . p = at`. Its front is where the unit normal points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    pub normal: Vec3,
    pub at: f64,
}

impl Plane {
    fn through(point: Vec3, normal: Vec3) -> Plane {
        Plane { normal, at: normal.dot(point) }
    }

    /// The distance in front of the plane.
    #[inline]
    fn height(&self, p: Vec3) -> f64 {
        self.normal.dot(p) - self.at
    }
}

/// A convex polygon, counter-clockwise seen from where its normal points.
#[derive(Clone, Debug)]
pub(super) struct Face {
    pub points: Vec<Vec3>,
    pub normal: Vec3,
    pub aabb: Aabb,
}

impl Face {
    /// `None` for a face without area.
    fn new(points: Vec<Vec3>) -> Option<Face> {
        let origin = points[0];
        let pairs = points[1..].windows(2);
        let normal =
            pairs.fold(Vec3::ZERO, |sum, pair| sum + (pair[0] - origin).cross(pair[1] - origin)).unit()?;
        let aabb = Aabb::around(points.iter().copied());
        Some(Face { points, normal, aabb })
    }

    fn plane(&self) -> Plane {
        Plane::through(self.points[0], self.normal)
    }

    fn turned(mut self) -> Face {
        self.points.reverse();
        self.normal = self.normal * -1.0;
        self
    }
}

/// A leaf. Of a convex leaf the planes are known, so that no face is looked at one by one.
#[derive(Clone, Debug)]
pub(super) struct Leaf {
    pub aabb: Aabb,
    pub faces: Vec<Face>,
    /// For each face the number of the triangle from which it was made.
    pub sources: Vec<usize>,
    planes: Option<Vec<Plane>>,
    tolerance: f64,
}

impl Leaf {
    /// The coarse solid of a shape; points closer than `tolerance` to a plane are on it.
    pub fn coarse(shape: &Shape, tolerance: f64) -> Leaf {
        if let Some(convex) = shape.convex() {
            let (vertices, topology) = (convex.vertices(), convex.topology());
            let faces =
                topology.faces.iter().map(|face| face.iter().map(|v| vertices[*v as usize]).collect());
            let leaf = Leaf::new(faces, Some(convex.corners()), tolerance);
            // The faces of a nearly convex solid may be bent: then only its triangles are its surface.
            if leaf.planes.is_some() && leaf.is_flat() {
                return leaf;
            }
        }
        Leaf::new(shape.world_mesh().corners().map(Vec::from), None, tolerance)
    }

    /// The solid of pictures.
    pub fn fine(mesh: &FineMesh, tolerance: f64) -> Leaf {
        let corner = |v: u32| mesh.vertices[v as usize];
        Leaf::new(mesh.faces.iter().map(|face| face.map(corner).to_vec()), None, tolerance)
    }

    /// A leaf of these faces. `corners` are all of their corners, each once, where these are known.
    fn new(faces: impl Iterator<Item = Vec<Vec3>>, corners: Option<&[Vec3]>, tolerance: f64) -> Leaf {
        let (mut all, mut sources) = (Vec::new(), Vec::new());
        for (source, face) in faces.enumerate().filter_map(|(at, points)| Some((at, Face::new(points)?))) {
            all.push(face);
            sources.push(source);
        }
        // A mesh may be inside out.
        let volume: f64 = all.iter().flat_map(fan).map(|[a, b, c]| a.dot(b.cross(c))).sum();
        if volume < 0.0 {
            all = all.into_iter().map(Face::turned).collect();
        }
        let aabb = all.iter().fold(Aabb::EMPTY, |all, face| all.union(&face.aabb));
        let planes = convex_planes(&all, corners, tolerance);
        Leaf { aabb, faces: all, sources, planes, tolerance }
    }

    fn is_flat(&self) -> bool {
        self.faces.iter().all(|face| {
            let plane = face.plane();
            face.points.iter().all(|p| plane.height(*p).abs() <= self.tolerance)
        })
    }

    /// True if the leaf contains a point, which must not be close to its surface.
    pub fn contains(&self, p: Vec3) -> bool {
        if !self.aabb.meets(&Aabb { low: p, high: p }) {
            return false;
        }
        match &self.planes {
            Some(planes) => planes.iter().all(|plane| plane.height(p) <= 0.0),
            None => winds_around(self.faces.iter().flat_map(fan), p),
        }
    }

    /// Divides a piece of a face with this normal: calls `each` with the pieces and their sides in this leaf.
    pub fn divide(&self, points: Vec<Vec3>, normal: Vec3, mut each: impl FnMut(Vec<Vec3>, Sides)) {
        if !Aabb::around(points.iter().copied()).grown(self.tolerance).meets(&self.aabb) {
            return each(points, Sides::OUT);
        }
        match &self.planes {
            Some(planes) => self.divide_by_planes(planes, points, normal, each),
            None => self.divide_by_faces(points, normal, each),
        }
    }

    /// Cuts off what is in front of each plane in turn; the rest is inside.
    fn divide_by_planes(
        &self,
        planes: &[Plane],
        points: Vec<Vec3>,
        normal: Vec3,
        mut each: impl FnMut(Vec<Vec3>, Sides),
    ) {
        let (mut inner, mut pieces, mut sides) = (None, Vec::new(), Sides::IN);
        for plane in planes {
            let rest = inner.as_ref().unwrap_or(&points);
            match reaches(rest, plane, self.tolerance) {
                [false, false] if plane.normal.dot(normal) > 0.0 => sides = Sides::ON,
                [false, false] => sides = Sides::AGAINST,
                // All of it is outside: the cuts so far were not needed.
                [true, false] => return each(points, Sides::OUT),
                [false, true] => {}
                [true, true] => {
                    let [front, back] = split(rest, plane, self.tolerance);
                    pieces.push(front);
                    inner = Some(back);
                }
            }
        }
        pieces.into_iter().for_each(|piece| each(piece, Sides::OUT));
        each(inner.unwrap_or(points), sides);
    }

    /// Cuts along each face that crosses the piece, or that lies on it.
    fn divide_by_faces(&self, points: Vec<Vec3>, normal: Vec3, mut each: impl FnMut(Vec<Vec3>, Sides)) {
        let tolerance = self.tolerance;
        let limits = Aabb::around(points.iter().copied()).grown(tolerance);
        let near = self.faces.iter().filter(|face| face.aabb.meets(&limits));
        let base = Plane::through(points[0], normal);
        let is_on = |face: &Face| face.points.iter().all(|p| base.height(*p).abs() <= tolerance);
        let mut below: Vec<&Face> = Vec::new();
        let mut pieces = vec![points];
        for face in near {
            if is_on(face) {
                below.push(face);
            }
            let knives = knives(face, &base, is_on(face), tolerance);
            for (plane, from, to) in &knives {
                let whole = std::mem::take(&mut pieces);
                for piece in whole {
                    let is_cut = runs_inside(&piece, normal, [*from, *to], tolerance)
                        && reaches(&piece, plane, tolerance) == [true, true];
                    match is_cut {
                        true => pieces.extend(split(&piece, plane, tolerance)),
                        false => pieces.push(piece),
                    }
                }
            }
        }
        for piece in pieces {
            let middle = piece.iter().fold(Vec3::ZERO, |sum, p| sum + *p) * (1.0 / piece.len() as f64);
            let sides = match below.iter().find(|face| covers(face, middle, tolerance)) {
                Some(face) if face.normal.dot(normal) > 0.0 => Sides::ON,
                Some(_) => Sides::AGAINST,
                None if self.contains(middle) => Sides::IN,
                None => Sides::OUT,
            };
            each(piece, sides);
        }
    }
}

/// The triangles of a convex polygon.
fn fan(face: &Face) -> impl Iterator<Item = [Vec3; 3]> + '_ {
    let points = &face.points;
    (1..points.len() - 1).map(move |k| [points[0], points[k], points[k + 1]])
}

/// The planes of the faces, each once; `None` if a corner is in front of one of them.
fn convex_planes(faces: &[Face], corners: Option<&[Vec3]>, tolerance: f64) -> Option<Vec<Plane>> {
    let mut planes: Vec<Plane> = Vec::new();
    for face in faces {
        let plane = face.plane();
        let is_new = |known: &Plane| known.normal != plane.normal || (known.at - plane.at).abs() > tolerance;
        if planes.last().is_none_or(is_new) {
            planes.push(plane);
        }
    }
    let has_below =
        |points: &[Vec3]| planes.iter().all(|plane| points.iter().all(|p| plane.height(*p) <= tolerance));
    let is_convex = corners.map_or_else(|| faces.iter().all(|face| has_below(&face.points)), has_below);
    is_convex.then_some(planes)
}

/// Whether a convex polygon reaches in front of a plane and behind it. A point closer than `tolerance` is on the plane.
fn reaches(points: &[Vec3], plane: &Plane, tolerance: f64) -> [bool; 2] {
    let mut heights = [f64::NEG_INFINITY, f64::INFINITY];
    for p in points {
        let height = plane.height(*p);
        heights = [heights[0].max(height), heights[1].min(height)];
    }
    [heights[0] > tolerance, heights[1] < -tolerance]
}

/// The parts of a convex polygon that reaches to both sides of a plane: in front of it and behind it.
fn split(points: &[Vec3], plane: &Plane, tolerance: f64) -> [Vec<Vec3>; 2] {
    let height_of = |p: &Vec3| {
        let height = plane.height(*p);
        if height.abs() <= tolerance { 0.0 } else { height }
    };
    let mut parts = [Vec::with_capacity(points.len() + 1), Vec::with_capacity(points.len() + 1)];
    let mut there = height_of(&points[0]);
    for (k, p) in points.iter().enumerate() {
        let q = &points[(k + 1) % points.len()];
        let here = std::mem::replace(&mut there, height_of(q));
        if here >= 0.0 {
            parts[0].push(*p);
        }
        if here <= 0.0 {
            parts[1].push(*p);
        }
        if here * there < 0.0 {
            // From the point behind the plane, whichever comes first: a face on the other side of the edge gets the same bits.
            let (low, high, depth, height) =
                if here < 0.0 { (p, q, here, there) } else { (q, p, there, here) };
            let crossing = *low + (*high - *low) * (depth / (depth - height));
            parts.iter_mut().for_each(|part| part.push(crossing));
        }
    }
    parts
}

/// The planes that cut a piece in the plane `base` along a face, with the stretch of the line where each cuts.
fn knives(face: &Face, base: &Plane, is_on: bool, tolerance: f64) -> Vec<(Plane, Vec3, Vec3)> {
    let points = &face.points;
    let edges = (0..points.len()).map(|k| (points[k], points[(k + 1) % points.len()]));
    if is_on {
        let across = |(a, b): (Vec3, Vec3)| Some((Plane::through(a, face.normal.cross(b - a).unit()?), a, b));
        return edges.filter_map(across).collect();
    }
    let mut ends: Vec<Vec3> = Vec::with_capacity(4);
    for (a, b) in edges {
        let (here, there) = (base.height(a), base.height(b));
        if here.abs() <= tolerance {
            ends.push(a);
        } else if there.abs() > tolerance && here * there < 0.0 {
            ends.push(a + (b - a) * (here / (here - there)));
        }
    }
    let Some((&from, rest)) = ends.split_first() else { return Vec::new() };
    let far = |p: &&Vec3| (**p - from).norm();
    let to = rest.iter().max_by(|p, q| far(p).total_cmp(&far(q)));
    to.map(|to| (face.plane(), from, *to)).into_iter().collect()
}

/// True if a stretch in the plane of a convex polygon runs inside of it, and not only along its border.
fn runs_inside(points: &[Vec3], normal: Vec3, [from, to]: [Vec3; 2], tolerance: f64) -> bool {
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (k, p) in points.iter().enumerate() {
        let Some(inwards) = normal.cross(points[(k + 1) % points.len()] - *p).unit() else { continue };
        let (start, end) = (inwards.dot(from - *p) - tolerance, inwards.dot(to - *p) - tolerance);
        match (start > 0.0, end > 0.0) {
            (false, false) => return false,
            (true, true) => {}
            (false, true) => first = first.max(start / (start - end)),
            (true, false) => last = last.min(start / (start - end)),
        }
    }
    (last - first) * (to - from).norm() > tolerance
}

/// True if a face covers a point of its plane.
fn covers(face: &Face, p: Vec3, tolerance: f64) -> bool {
    let points = &face.points;
    (0..points.len()).all(|k| {
        let (a, b) = (points[k], points[(k + 1) % points.len()]);
        let inwards = face.normal.cross(b - a).unit().unwrap_or(vec3(0.0, 0.0, 0.0));
        inwards.dot(p - a) >= -tolerance
    })
}

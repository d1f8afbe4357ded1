//! Solids of revolution, as turned on a lathe: `revolve`.

use super::cylinder::BEVEL;
use super::measured::{Checks, Form, Measured, Tone, frame_within};
use super::word::kinds::{Axis, Pairs, Point, Turn};
use super::word::{Word, direction, laid_along, placed, plain};
use crate::convex::Coarse;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::corners::{room, rounded};
use crate::fine::{ARC, FineMesh, ROUND};
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::polygon::{MOST, Pair, check_points, check_simple, is_convex, note_simple};
use crate::polytope::Hull as Polytope;
use crate::ring::ring;
use crate::topology::Topology;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use niwaki_math::polygon::twice_signed;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::sync::Arc;

/// Sides of the coarse mesh around the axis.
const SIDES: usize = 12;

/// A solid of revolution: a line encloses it with the axis y when it is turned about it.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Revolution {
    /// Points of the line: the distance from the axis and the height, in either direction. An end that is not on the axis
    /// is joined to it; a line that ends where it begins makes a ring.
    pub profile: Box<[Pair]>,
}

/// The line of a half section, counter-clockwise; the area is to its left.
struct Line {
    points: Vec<Pair>,
    /// True if its last point is joined to its first by another side; otherwise by the axis.
    is_ring: bool,
}

impl Revolution {
    fn is_ring(&self) -> bool {
        is_ring(&self.profile)
    }

    fn line(&self) -> Line {
        let (mut points, is_ring) = (corners(&self.profile), self.is_ring());
        if twice_signed(&points) < 0.0 {
            points.reverse();
        }
        // The first point is the one at which the axis ends; for a ring, the nearest to the axis, so that the direction of the list
        // makes no difference.
        let count = points.len();
        let is_first = |k: usize| points[k][0] == 0.0 && points[(k + count - 1) % count][0] == 0.0;
        let nearer = |a: &usize, b: &usize| points[*a].partial_cmp(&points[*b]).unwrap_or(Ordering::Equal);
        let first = if is_ring { (0..count).min_by(nearer) } else { (0..count).find(|k| is_first(*k)) };
        points.rotate_left(first.unwrap_or(0));
        Line { points, is_ring }
    }
}

impl Revolution {
    /// Vertices of the coarse mesh and its faces, of three or four corners.
    fn faces(&self, placement: &Placement) -> (Vec<Vec3>, Vec<Vec<u32>>) {
        let line = self.line();
        // A row on the axis is a single point.
        let mut numbers = Vec::with_capacity(line.points.len() * SIDES);
        let mut vertices = Vec::new();
        for &[radius, height] in &line.points {
            for (sin, cos) in ring(SIDES) {
                if radius > 0.0 || numbers.len() % SIDES == 0 {
                    vertices.push(placement.apply(vec3(radius * sin, height, radius * cos)));
                }
                numbers.push((vertices.len() - 1) as u32);
            }
        }
        let corners = |quad: [u32; 4]| {
            let mut corners = quad.map(|k| numbers[k as usize]).to_vec();
            corners.dedup();
            if corners.first() == corners.last() {
                corners.pop();
            }
            corners
        };
        let faces = Line::quads(line.points.len(), line.is_ring, SIDES).map(corners).collect();
        (vertices, faces)
    }
}

fn is_ring<S: Scalar>(profile: &[[S; 2]]) -> bool {
    profile.len() > 3 && profile.first() == profile.last()
}

/// The corners of the half section in the order of the profile, with those on the axis.
fn corners<S: Scalar>(profile: &[[S; 2]]) -> Vec<[S; 2]> {
    let ([low, .., high], false) = (profile, is_ring(profile)) else {
        return profile[..profile.len().saturating_sub(1)].to_vec();
    };
    let zero = S::from_f64(0.0);
    let joined = [high, low].into_iter().filter(|end| end[0] > zero).map(|end| [zero, end[1]]);
    profile.iter().copied().chain(joined).collect()
}

impl Line {
    /// Numbers of the vertices of each quadrilateral, counter-clockwise seen from outside, where each point has a row of `sides`.
    fn quads(count: usize, is_ring: bool, sides: usize) -> impl Iterator<Item = [u32; 4]> {
        let number = move |k: usize, j: usize| (k % count * sides + j % sides) as u32;
        let rows = if is_ring { count } else { count - 1 };
        (0..rows).flat_map(move |k| {
            (0..sides).map(move |j| [number(k, j), number(k, j + 1), number(k + 1, j + 1), number(k + 1, j)])
        })
    }
}

impl Measured for Arc<Revolution> {
    const KIND: &'static str = "revolution";
    const FORM: Form = Form::Mesh;
    const TONE: Tone = Tone::Round;

    fn check(&self, _checks: Checks) -> Result<(), GeomError> {
        let subject = "profile of a revolution";
        check_points(subject, &self.profile, (2, MOST))?;
        if let Some(k) = self.profile.iter().position(|p| p[0] < 0.0) {
            let radius = self.profile[k][0];
            return bad(format!(
                "point {k} of the {subject} has the radius {radius}, expected 0 or more: the axis is at 0"
            ));
        }
        let (is_ring, last) = (self.is_ring(), self.profile.len() - 1);
        let within = if is_ring { 0..last } else { 1..last };
        if let Some(k) = self.profile[within.clone()].iter().position(|p| p[0] == 0.0) {
            let k = k + within.start;
            return bad(format!(
                "point {k} of the {subject} is on the axis, where only the ends of a line may be"
            ));
        }
        let ends = [self.profile[0], self.profile[last]];
        if !is_ring && ends[0][1] == ends[1][1] {
            return bad(format!(
                "the {subject} begins and ends at the same height; a line that makes a ring ends with its first point"
            ));
        }
        let corners = corners(&self.profile);
        if twice_signed(&corners) == 0.0 {
            return bad(format!("the {subject} lies on the axis, and encloses nothing with it"));
        }
        check_simple(subject, &corners, &|k| match k % corners.len() {
            k if k < last => format!("the line from point {k} to point {}", k + 1),
            _ => "the line from an end to the axis".to_string(),
        })
    }

    fn bytes(&self) -> usize {
        size_of::<Revolution>() + size_of_val(&*self.profile)
    }

    fn form(&self) -> Form {
        if !self.is_ring() && is_convex(&corners(&self.profile)) { Form::Convex } else { Form::Mesh }
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        let (vertices, faces) = self.faces(placement);
        let topology = Topology::from_faces(vertices.len(), faces);
        Polytope::new(vertices, Arc::new(topology)).map(Coarse::new)
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        let (vertices, faces) = self.faces(placement);
        TriMesh::new(vertices.clone(), Topology::from_faces(vertices.len(), faces).triangles)
    }

    fn frame(&self, placement: &Placement) -> Placement {
        frame_within(self, placement)
    }

    fn fine(&self, bevel: Option<f64>) -> FineMesh {
        let line = self.line();
        let count = line.points.len();
        let width = bevel.unwrap_or(BEVEL) * room(&line.points);
        let is_round = |k: usize| line.is_ring || (k > 0 && k + 1 < count);
        let outline = rounded(&line.points, width, ARC, &is_round);
        // The axis is no side: each end has the normal of its side of the line.
        let (from, to) = if line.is_ring { (0, outline.len()) } else { (1, outline.len() - 1) };
        let outline = &outline[from..to];
        let mut mesh = FineMesh::default();
        for v in outline {
            let [radius, height] = [0, 1].map(|k| v.core[k] + v.out[k] * width);
            let [out, up] = v.normal;
            for (sin, cos) in ring(ROUND) {
                mesh.point(vec3(radius * sin, height, radius * cos), vec3(out * sin, up, out * cos));
            }
        }
        for quad in Line::quads(outline.len(), line.is_ring, ROUND) {
            mesh.quad(quad);
        }
        mesh
    }
}

word! {
    /// A solid of revolution, such as a vase.
    "revolve" RevolveWord {
        /// Points of a line, in either direction: pairs (radius, height), the radius from the axis. Ends that are not on
        /// the axis are closed by discs; a line that ends where it begins makes a ring.
        profile: Pairs,
        /// Where the point of the axis at height 0 goes.
        center: Point = (0.0, 0.0, 0.0),
        /// The axis: "x", "y", "z" or a direction.
        axis: Axis = "y",
        /// Turns it about this point.
        rotation: Option<Turn>,
        ..BEVELLED
    }
}

impl<S: Scalar> Word<S> for RevolveWord<S> {
    type Solid = Arc<Revolution>;

    fn solid(&self) -> Result<(Arc<Revolution>, Placement), GeomError> {
        for pair in &self.profile {
            let _ = pair[0] > S::from_f64(0.0);
        }
        note_simple(&corners(&self.profile));
        let profile = self.profile.iter().map(|pair| pair.map(Scalar::value)).collect();
        let laid = Mat3::between(Vec3::AXES[1], direction(plain(self.axis), "axis")?);
        Ok((Arc::new(Revolution { profile }), placed(self.center, laid, self.rotation)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        let unity = S::from_f64(1.0);
        let [.., axis, _] = laid_along(self.center, self.axis, self.rotation, unity);
        let heights = self.profile.iter().map(|pair| pair[1]);
        let low = heights.clone().reduce(|a, b| a.min(b)).unwrap_or(unity);
        let high = heights.reduce(|a, b| a.max(b)).unwrap_or(unity);
        let middle = S::from_f64(0.5) * (low + high);
        let center = [0, 1, 2].map(|k| self.center[k] + axis[k] * middle);
        laid_along(center, self.axis, self.rotation, high - low)
    }
}

#[cfg(test)]
mod tests {
    //! Solids of revolution have the volume of Pappus, whichever way the line is given; a vase is hollow.
    use super::super::shape::Shape;
    use super::super::testing::sound;
    use super::*;
    use crate::intersect::{Rule, intersects};
    use crate::look::Look;
    use std::f64::consts::PI;

    const VASE: [Pair; 6] = [[0.0, 0.0], [1.0, 0.0], [1.5, 2.0], [1.3, 2.0], [0.85, 0.2], [0.0, 0.2]];
    const RING: [Pair; 5] = [[2.0, 0.0], [3.0, 0.5], [3.0, 1.0], [2.0, 1.0], [2.0, 0.0]];

    fn turned(profile: &[Pair], bevel: f64) -> Result<Shape, GeomError> {
        let solid = Arc::new(Revolution { profile: profile.into() });
        let look = Look { bevel: Some(bevel), ..Look::default() };
        Shape::placed(solid.into(), vec3(1.0, 2.0, 3.0), Mat3::IDENTITY, &look)
    }

    /// The volume of a stack of frustums; the sign is that of the direction.
    fn volume(profile: &[Pair]) -> f64 {
        let frustum = |p: Pair, q: Pair| PI / 3.0 * (p[0] * p[0] + p[0] * q[0] + q[0] * q[0]) * (q[1] - p[1]);
        profile.windows(2).map(|pair| frustum(pair[0], pair[1])).sum::<f64>().abs()
    }

    #[test]
    fn solids_of_revolution_have_their_volume_and_their_box() {
        let open: &[Pair] = &[[1.0, 0.0], [2.0, 1.0], [0.5, 3.0]];
        let (cone, rod): (&[Pair], &[Pair]) = (&[[1.0, 0.0], [0.0, 2.0]], &[[1.0, 3.0], [1.0, 1.0]]);
        for profile in [&VASE[..], &RING, open, cone, rod] {
            let back: Vec<Pair> = profile.iter().rev().copied().collect();
            for bevel in [0.0, 0.2] {
                let shape = turned(profile, bevel).unwrap();
                sound(&shape, volume(profile), if bevel > 0.0 { 0.04 } else { 0.005 });
                let other = turned(&back, bevel).unwrap();
                assert_eq!(*shape.world_mesh(), *other.world_mesh());
                assert_eq!(shape.fine_mesh(), other.fine_mesh());
            }
        }
        for (profile, is_convex) in
            [(&VASE[..], false), (&RING, false), (open, true), (cone, true), (rod, true)]
        {
            assert_eq!(turned(profile, 0.0).unwrap().is_convex(), is_convex);
        }
        let shape = turned(&VASE, 0.0).unwrap();
        assert_eq!((shape.aabb().low, shape.aabb().high), (vec3(-0.5, 2.0, 1.5), vec3(2.5, 4.0, 4.5)));
    }

    #[test]
    fn a_flower_goes_into_the_vase() {
        let rod = |radius: f64| {
            Shape::cylinder(vec3(1.0, 3.5, 3.0), radius, 2.5, Vec3::AXES[1], None, &Look::default()).unwrap()
        };
        let vase = turned(&VASE, 0.0).unwrap();
        assert!(!intersects(&vase, &rod(0.7), Rule::Solid));
        assert!(intersects(&vase, &rod(1.0), Rule::Solid));
        assert!(!intersects(&turned(&RING, 0.0).unwrap(), &rod(1.5), Rule::Solid));
    }

    #[test]
    fn lines_that_enclose_nothing_are_refused() {
        let message =
            |profile: &[Pair]| turned(profile, 0.0).map_or_else(|error| error.message, |_| String::new());
        for (profile, expected) in [
            (&[[1.0, 0.0], [-0.5, 1.0]][..], "point 1 of the profile of a revolution has the radius -0.5"),
            (&[[0.0, 0.0], [0.0, 1.0]], "lies on the axis"),
            (&[[0.0, 1.0], [2.0, 1.0]], "begins and ends at the same height"),
            (&[[1.0, 1.0], [2.0, 2.0], [3.0, 1.0]], "begins and ends at the same height"),
            (
                &[[0.0, 0.0], [1.0, 0.5], [0.0, 1.0], [1.0, 2.0]],
                "point 2 of the profile of a revolution is on the axis",
            ),
            (
                &[[1.0, 0.0], [2.0, 2.0], [2.0, 0.0], [1.0, 2.0]],
                "from point 0 to point 1 meets the line from point 2",
            ),
            (&[[1.0, 0.0]], "has 1 points, expected 2 to 1024"),
        ] {
            assert!(message(profile).contains(expected), "{}", message(profile));
        }
    }
}

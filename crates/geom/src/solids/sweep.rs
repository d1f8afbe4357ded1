//! Sections that are drawn along a path, such as handrails and handles: `sweep`.

use super::measured::{Checks, Form, Measured};
use super::word::kinds::{Length, Pairs, Points};
use super::word::{Word, plain, spread};
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, crease};
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::polygon::{Pair, check_points, check_section, counter_clockwise, triangles};
use crate::vector::{Mat3, Vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The most points of the profile and of the path.
const MOST: usize = 256;
/// Cosine of the sharpest bend of a path: 170 degrees.
const BACK: f64 = -0.985;
/// Cosine to the y axis above which a direction is too close to it for the y axis to be up, as for the word `look`.
const STEEP: f64 = 0.9;

/// A polygon drawn along a path, at right angles to it, and mitred where the path bends.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Sweep {
    /// Corners of the polygon, sideways and up; in either direction. Its origin follows the path.
    pub profile: Box<[Pair]>,
    /// Points of the path.
    pub path: Box<[Vec3]>,
    /// Scale of the polygon at the end; it grows with the length of the path.
    pub scale: f64,
}

/// The directions of a section: sideways, up, and along the path. Sideways is up times along.
#[derive(Clone, Copy)]
struct Section([Vec3; 3]);

impl Section {
    /// At the start of a path: up is as near to the y axis as can be, on a steep path to the z axis.
    fn first(along: Vec3) -> Section {
        let up = Vec3::AXES[if along.y.abs() > STEEP { 2 } else { 1 }];
        let up = (up - along * up.dot(along)).unit().unwrap_or(up);
        Section([up.cross(along), up, along])
    }

    /// After a bend: turned by the smallest turn, so that it does not spin about the path (Bishop 1975).
    fn bent(self, along: Vec3) -> Section {
        let turn = Mat3::between(self.0[2], along);
        let up = turn.apply(self.0[1]);
        let up = (up - along * up.dot(along)).unit().unwrap_or(up);
        Section([up.cross(along), up, along])
    }
}

impl Sweep {
    fn along(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.path.windows(2).map(|ends| (ends[1] - ends[0]).unit().unwrap_or(Vec3::AXES[1]))
    }

    /// The corners of the section at each point of the path, counter-clockwise seen against it.
    fn rings(&self) -> Vec<Vec<Vec3>> {
        let corners = counter_clockwise(self.profile.to_vec());
        let mut sections = Vec::with_capacity(self.path.len());
        for along in self.along() {
            let next =
                sections.last().map_or_else(|| Section::first(along), |last: &Section| last.bent(along));
            sections.push(next);
        }
        let lengths: Vec<f64> = self.path.windows(2).map(|ends| (ends[1] - ends[0]).norm()).collect();
        let whole: f64 = lengths.iter().sum();
        let mut gone = 0.0;
        let ring = |k: usize| {
            let last = self.path.len() - 1;
            let (before, after) = (sections[k.saturating_sub(1)], sections[k.min(last - 1)]);
            let scale = if k == last { self.scale } else { 1.0 + (self.scale - 1.0) * gone / whole };
            gone += lengths.get(k).copied().unwrap_or(0.0);
            let [sideways, up, along] = before.0;
            // The plane of the mitre is as steep to one side of the bend as to the other.
            let across = along + after.0[2];
            let depth = across.dot(along);
            let moved = move |[x, y]: Pair| {
                let flat = (sideways * x + up * y) * scale;
                let slide = if k == 0 || k == last { 0.0 } else { flat.dot(across) / depth };
                self.path[k] + flat - along * slide
            };
            corners.iter().map(|p| moved(*p)).collect()
        };
        (0..self.path.len()).map(ring).collect()
    }

    /// The closed surface, its points moved by `apply`.
    fn surface(&self, apply: impl Fn(Vec3) -> Vec3) -> Result<TriMesh, GeomError> {
        let mut rings = self.rings();
        let (count, last) = (self.profile.len(), rings.len() - 1);
        let is_pointed = self.scale == 0.0;
        if is_pointed {
            rings[last].truncate(1);
        }
        let caps = triangles(&counter_clockwise(self.profile.to_vec()));
        let mut faces: Vec<[u32; 3]> = caps.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        let number = |ring: usize, k: usize| (ring * count + k % count) as u32;
        for ring in 0..last {
            for k in 0..count {
                let [a, b] = [number(ring, k), number(ring, k + 1)];
                if is_pointed && ring + 1 == last {
                    faces.push([a, b, number(last, 0)]);
                    continue;
                }
                let [d, c] = [number(ring + 1, k), number(ring + 1, k + 1)];
                faces.extend([[a, b, c], [a, c, d]]);
            }
        }
        if !is_pointed {
            faces.extend(caps.iter().map(|cap| cap.map(|k| number(last, k as usize))));
        }
        TriMesh::new(rings.into_iter().flatten().map(apply).collect(), faces)
    }
}

impl Measured for Arc<Sweep> {
    const KIND: &'static str = "sweep";
    const FORM: Form = Form::Mesh;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        check_section("profile of a sweep", &self.profile, MOST)?;
        let path = self.path.iter().map(|p| p.to_array()).collect::<Vec<_>>();
        check_points("path of a sweep", &path, (2, MOST))?;
        checks.not_negative("scale", self.scale)?;
        let along: Vec<Vec3> = self.along().collect();
        if let Some(k) = along.windows(2).position(|pair| pair[0].dot(pair[1]) < BACK) {
            return bad(format!("the path of a sweep turns back on itself at point {}", k + 1));
        }
        let rings = self.rings();
        for (k, along) in along.iter().enumerate() {
            let is_turned = |(p, q): (&Vec3, &Vec3)| (*q - *p).dot(*along) <= 0.0;
            if rings[k].iter().zip(&rings[k + 1]).any(is_turned) {
                return bad(format!(
                    "the profile of a sweep is too wide for the bend of its path between points {k} and {}: \
                     draw the path with a gentler bend there, or with points that are farther apart",
                    k + 1
                ));
            }
        }
        Ok(())
    }

    fn bytes(&self) -> usize {
        size_of::<Sweep>() + size_of_val(&*self.profile) + size_of_val(&*self.path)
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        self.surface(|p| placement.apply(p))
    }

    /// A frame in the middle of the first section; y along the path.
    fn frame(&self, placement: &Placement) -> Placement {
        let along = self.along().next().unwrap_or(Vec3::AXES[1]);
        let [sideways, _, along] = Section::first(along).0;
        let first = self.rings().swap_remove(0);
        let middle = first.iter().fold(Vec3::ZERO, |sum, p| sum + *p) / first.len() as f64;
        let rotation = Mat3 { columns: [sideways, along, sideways.cross(along)] };
        placement.after(&Placement { rotation, translation: middle })
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        let mesh = self.surface(|p| p);
        crease::creased(&mesh.expect("finite points and numbers of points"), crease::SHARP)
    }
}

word! {
    /// A polygon that is drawn along a path of straight lines, such as a handrail.
    "sweep" SweepWord {
        /// Corners of the polygon in order, in either direction: pairs (sideways, up) about the path. Up is as near to the y axis as can be where
        /// the path starts, or to the z axis if it starts steeply.
        profile: Pairs,
        /// Points of the path, at least two.
        path: Points,
        /// How much the polygon is scaled at the end of the path; 0 for a tip.
        scale: Length = 1.0,
        ..PAINTED
    }
}

impl<S: Scalar> Word<S> for SweepWord<S> {
    type Solid = Arc<Sweep>;

    fn solid(&self) -> Result<(Arc<Sweep>, Placement), GeomError> {
        let sweep = Sweep {
            profile: self.profile.iter().map(|pair| pair.map(Scalar::value)).collect(),
            path: self.path.iter().map(|p| plain(*p)).collect(),
            scale: self.scale.value(),
        };
        Ok((Arc::new(sweep), Placement::IDENTITY))
    }

    fn at(&self) -> [[S; 3]; 4] {
        spread(&self.path)
    }
}

#[cfg(test)]
mod tests {
    //! Sweeps have the volume of their polygon times the length of their path; the polygon does not spin about it.
    use super::super::shape::Shape;
    use super::super::testing::sound;
    use super::*;
    use crate::intersect::{Rule, intersects};
    use crate::look::Look;
    use crate::vector::vec3;

    const BAR: [Pair; 4] = [[-0.2, -0.1], [0.2, -0.1], [0.2, 0.1], [-0.2, 0.1]];

    fn swept(profile: &[Pair], path: &[Vec3], scale: f64) -> Result<Shape, GeomError> {
        let solid = Sweep { profile: profile.into(), path: path.into(), scale };
        Shape::new(Arc::new(solid).into(), Placement::IDENTITY, &Look::default())
    }

    fn helix() -> Vec<Vec3> {
        (0..40).map(|k| 0.2 * f64::from(k)).map(|t| vec3(2.0 * t.cos(), 0.3 * t, 2.0 * t.sin())).collect()
    }

    #[test]
    fn sweeps_have_their_volume_and_their_box() {
        let bend = [vec3(0.0, 0.0, 0.0), vec3(3.0, 0.0, 0.0), vec3(3.0, 0.0, 2.0), vec3(3.0, 4.0, 2.0)];
        let hook = [[-0.3, -0.1], [0.3, -0.1], [0.3, 0.1], [0.0, 0.0], [-0.3, 0.1]];
        for (profile, path, scale, volume) in [
            (&BAR[..], &bend[..2], 1.0, 0.08 * 3.0),
            (&BAR, &bend[..], 1.0, 0.08 * 9.0),
            (&hook, &bend[..3], 1.0, 0.09 * 5.0),
            (&BAR, &bend[..2], 0.0, 0.08),
            (&BAR, &bend[..2], 2.0, 0.08 * 7.0),
            (&BAR, &helix(), 1.0, 0.08 * 39.0 * (16.0 * 0.1_f64.sin().powi(2) + 0.0036).sqrt()),
        ] {
            let shape = swept(profile, path, scale).unwrap();
            // The origin of the hook is not in its middle: the outer side of a bend is longer.
            sound(&shape, volume, if profile.len() > 4 { 0.01 } else { 1e-3 });
            let back: Vec<Pair> = profile.iter().rev().copied().collect();
            assert_eq!(*shape.world_mesh(), *swept(&back, path, scale).unwrap().world_mesh());
        }
        let rail = swept(&BAR, &bend[..3], 1.0).unwrap();
        assert_eq!((rail.aabb().low, rail.aabb().high), (vec3(0.0, -0.1, -0.2), vec3(3.2, 0.1, 2.0)));
    }

    #[test]
    fn a_section_stays_upright_on_level_ground() {
        let level: Vec<Vec3> = helix().into_iter().map(|p| vec3(p.x, 5.0, p.z)).collect();
        let rail = swept(&BAR, &level, 1.0).unwrap();
        for p in rail.world_mesh().vertices() {
            assert!(((p.y - 5.0).abs() - 0.1).abs() < 1e-12);
        }
    }

    #[test]
    fn a_rod_goes_through_a_coil() {
        let rod = |radius: f64| {
            let look = Look::default();
            Shape::cylinder(vec3(0.0, 1.0, 0.0), radius, 9.0, Vec3::AXES[1], None, &look).unwrap()
        };
        let coil = swept(&BAR, &helix(), 1.0).unwrap();
        assert!(!intersects(&coil, &rod(1.75), Rule::Solid));
        assert!(intersects(&coil, &rod(2.0), Rule::Solid));
    }

    #[test]
    fn paths_that_no_section_follows_are_refused() {
        let message =
            |path: &[Vec3]| swept(&BAR, path, 1.0).map_or_else(|error| error.message, |_| String::new());
        let at = |x: f64, y: f64| vec3(x, y, 0.0);
        for (path, expected) in [
            (&[at(0.0, 0.0)][..], "the path of a sweep has 1 points, expected 2 to 256"),
            (&[at(0.0, 0.0), at(0.0, 0.0)], "points 0 and 1 of the path of a sweep are the same"),
            (&[at(0.0, 0.0), at(1.0, 0.0), at(0.0, 0.1)], "turns back on itself at point 1"),
            (
                &[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 0.1), at(0.0, 0.1)],
                "too wide for the bend of its path between points 1",
            ),
            (&[at(0.0, 0.0), at(f64::INFINITY, 0.0)], "point 1 of the path of a sweep is [inf"),
        ] {
            assert!(message(path).contains(expected), "{}", message(path));
        }
    }
}

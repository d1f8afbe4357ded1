//! Sections that are drawn along a path, such as handrails and handles: `sweep`.

use super::measured::{Checks, Form, Measured};
use super::word::kinds::{Length, Pairs, Points};
use super::word::{Word, plain, spread};
use crate::convex::Coarse;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, crease};
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::polygon::{
    Pair, check_points, check_section, counter_clockwise, is_convex, note_simple, triangles,
};
use crate::polytope::Hull as Polytope;
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

type Three<S> = [S; 3];

fn dot<S: Scalar>(a: Three<S>, b: Three<S>) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<S: Scalar>(a: Three<S>, b: Three<S>) -> Three<S> {
    [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

/// `a + b * by`.
fn plus<S: Scalar>(a: Three<S>, b: Three<S>, by: S) -> Three<S> {
    [0, 1, 2].map(|i| a[i] + b[i] * by)
}

fn unit<S: Scalar>(a: Three<S>) -> Three<S> {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// The directions of the lines of a path.
fn directions<S: Scalar>(path: &[Three<S>]) -> Vec<Three<S>> {
    path.windows(2).map(|ends| unit(plus(ends[1], ends[0], S::from_f64(-1.0)))).collect()
}

/// The directions of a section: sideways, up, and along the path. Sideways is up times along.
#[derive(Clone, Copy)]
struct Section<S>([Three<S>; 3]);

impl<S: Scalar> Section<S> {
    fn upright(up: Three<S>, along: Three<S>) -> Section<S> {
        let up = unit(plus(up, along, -dot(up, along)));
        Section([cross(up, along), up, along])
    }

    /// At the start of a path: up is as near to the y axis as can be, on a steep path to the z axis.
    fn first(along: Three<S>) -> Section<S> {
        let is_steep = along[1].abs() > S::from_f64(STEEP);
        Section::upright(Vec3::AXES[if is_steep { 2 } else { 1 }].to_array().map(S::from_f64), along)
    }

    /// After a bend: turned by the smallest turn, so that it does not spin about the path (Bishop 1975).
    fn bent(self, along: Three<S>) -> Section<S> {
        let [_, up, before] = self.0;
        // The turn is two reflections; up is at right angles to the path before.
        let between = plus(before, along, S::from_f64(1.0));
        let part = -dot(up, between) / (S::from_f64(1.0) + dot(before, along));
        Section::upright(plus(up, between, part), along)
    }
}

/// The corners of a profile at each point of a path, scaled by `scale` at its end.
fn rings<S: Scalar>(profile: &[[S; 2]], path: &[Three<S>], scale: S) -> Vec<Vec<Three<S>>> {
    let mut sections: Vec<Section<S>> = Vec::with_capacity(path.len());
    for along in directions(path) {
        let next = sections.last().map_or_else(|| Section::first(along), |last| last.bent(along));
        sections.push(next);
    }
    let (zero, unity) = (S::from_f64(0.0), S::from_f64(1.0));
    let mut lengths = vec![zero];
    for (k, section) in sections.iter().enumerate() {
        lengths.push(lengths[k] + dot(plus(path[k + 1], path[k], -unity), section.0[2]));
    }
    let last = path.len() - 1;
    let ring = |k: usize| -> Vec<Three<S>> {
        let (before, after) = (sections[k.saturating_sub(1)], sections[k.min(last - 1)]);
        // The ends are exact, because parts are attached there.
        let scale = match k {
            _ if k == last => scale,
            0 => unity,
            _ => unity + (scale - unity) * lengths[k] / lengths[last],
        };
        let [sideways, up, along] = before.0;
        // The plane of the mitre is as steep to one side of the bend as to the other.
        let across = plus(along, after.0[2], unity);
        let depth = dot(across, along);
        let corner = |[x, y]: &[S; 2]| {
            let flat = plus(sideways.map(|part| part * *x), up, *y).map(|part| part * scale);
            let slide = if k == 0 || k == last { zero } else { dot(flat, across) / depth };
            plus(plus(path[k], flat, unity), along, -slide)
        };
        profile.iter().map(corner).collect()
    };
    (0..path.len()).map(ring).collect()
}

/// The first point at which a path turns back on itself.
fn turn_back<S: Scalar>(path: &[Three<S>]) -> Option<usize> {
    directions(path).windows(2).position(|pair| dot(pair[0], pair[1]) < S::from_f64(BACK)).map(|k| k + 1)
}

/// The first line of a path on which a corner of the profile would go back.
fn narrow_bend<S: Scalar>(profile: &[[S; 2]], path: &[Three<S>], scale: S) -> Option<usize> {
    let rings = rings(profile, path, scale);
    let is_back = |p: &Three<S>, q: &Three<S>, along: Three<S>| {
        dot(plus(*q, *p, S::from_f64(-1.0)), along) <= S::from_f64(0.0)
    };
    directions(path)
        .into_iter()
        .enumerate()
        .find(|(k, along)| rings[*k].iter().zip(&rings[k + 1]).any(|(p, q)| is_back(p, q, *along)))
        .map(|(k, _)| k)
}

impl Sweep {
    fn path(&self) -> Vec<Three<f64>> {
        self.path.iter().map(|p| p.to_array()).collect()
    }

    /// The corners of the section at each point of the path, counter-clockwise seen against it.
    fn rings(&self) -> Vec<Vec<Vec3>> {
        let rings = rings(&counter_clockwise(self.profile.to_vec()), &self.path(), self.scale);
        rings.into_iter().map(|ring| ring.into_iter().map(Vec3::from).collect()).collect()
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
        let path = self.path();
        check_points("path of a sweep", &path, (2, MOST))?;
        checks.not_negative("scale", self.scale)?;
        if let Some(k) = turn_back(&path) {
            return bad(format!("the path of a sweep turns back on itself at point {k}"));
        }
        match narrow_bend(&self.profile, &path, self.scale) {
            Some(k) => bad(format!(
                "the profile of a sweep is too wide for the bend of its path between points {k} and {}: \
                 draw the path with a gentler bend there, or with points that are farther apart",
                k + 1
            )),
            None => Ok(()),
        }
    }

    fn form(&self) -> Form {
        if self.path.len() == 2 && is_convex(&self.profile) { Form::Convex } else { Form::Mesh }
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        let ends =
            self.rings().into_iter().map(|ring| ring.into_iter().map(|p| placement.apply(p)).collect());
        let [start, mut end]: [Vec<Vec3>; 2] = ends.collect::<Vec<_>>().try_into().ok()?;
        end.truncate(if self.scale == 0.0 { 1 } else { end.len() });
        Polytope::between(start, &end).map(Coarse::new)
    }

    fn bytes(&self) -> usize {
        size_of::<Sweep>() + size_of_val(&*self.profile) + size_of_val(&*self.path)
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        self.surface(|p| placement.apply(p))
    }

    /// A frame in the middle of the first section; y along the path.
    fn frame(&self, placement: &Placement) -> Placement {
        let ends = [self.path[0], self.path[1]].map(|p| p.to_array());
        let [sideways, _, along] = Section::first(directions(&ends)[0]).0.map(Vec3::from);
        let first = self.rings().swap_remove(0);
        let middle = first.iter().fold(Vec3::ZERO, |sum, p| sum + *p) / first.len() as f64;
        let rotation = Mat3 { columns: [sideways, along, sideways.cross(along)] };
        placement.after(&Placement { rotation, translation: middle })
    }

    fn mirrored(&self) -> Arc<Sweep> {
        // Sideways is a product of two directions, so the reflection turns it over.
        let profile = self.profile.iter().map(|[x, y]| [-x, *y]).collect();
        let path = self.path.iter().map(|point| point.mirrored()).collect();
        Arc::new(Sweep { profile, path, scale: self.scale })
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        let mesh = self.surface(|p| p);
        crease::creased(&mesh.expect("finite points and numbers of points"), crease::SHARP)
    }
}

word! {
    /// A polygon that is drawn along a path of straight lines, such as a handrail.
    "sweep" SweepWord {
        /// Corners of the polygon in order, in either direction: pairs (sideways, up) about the path. Up is as near to
        /// the y axis as can be where the path starts, or to the z axis if it starts steeply.
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
        note_simple(&self.profile);
        let numbers = self.profile.iter().flatten().chain(self.path.iter().flatten()).chain([&self.scale]);
        if self.path.len() > 1 && numbers.into_iter().any(|x| x.varies()) {
            let _ = turn_back(&self.path);
            let _ = narrow_bend(&self.profile, &self.path, self.scale);
        }
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
            assert_eq!(shape.is_convex(), path.len() == 2);
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

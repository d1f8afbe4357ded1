//! Ellipses and discs, which are flat: `ellipse` and `disc`.

use super::measured::{Checks, Form, Measured};
use super::plate::{self, Flat};
use super::word::kinds::{Length, Number, Point};
use super::word::{Word, plain, turned};
use crate::bounds::Aabb;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::FineMesh;
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::ring::ring;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};

/// An ellipse on a plane parallel to z = 0.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Ellipse {
    /// Full lengths along its own x and y.
    pub size: [f64; 2],
}

impl Flat for Ellipse {
    fn half_width(&self) -> f64 {
        0.5 * self.size[0].min(self.size[1])
    }

    fn reach(&self, placement: &Placement) -> Aabb {
        let [long, wide] = self.size;
        // Half the extent along an axis is the length of the vector of both half axes' components along it.
        let u = placement.rotation.apply(vec3(0.5 * long, 0.0, 0.0));
        let v = placement.rotation.apply(vec3(0.0, 0.5 * wide, 0.0));
        let half = vec3((u.x * u.x + v.x * v.x).sqrt(), (u.y * u.y + v.y * v.y).sqrt(), 0.0);
        Aabb { low: placement.translation - half, high: placement.translation + half }
    }

    fn corners(&self, sides: usize) -> Vec<Vec3> {
        let [long, wide] = self.size;
        ring(sides).map(|(sin, cos)| vec3(0.5 * long * cos, 0.5 * wide * sin, 0.0)).collect()
    }
}

impl Measured for Ellipse {
    const KIND: &'static str = "ellipse";
    const FORM: Form = Form::Flat;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        self.size.iter().try_for_each(|s| checks.positive("size", *s))
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        plate::coarse(self, placement)
    }

    fn aabb(&self, placement: &Placement) -> Result<Aabb, GeomError> {
        plate::aabb(self, placement)
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        plate::fine(self)
    }
}

/// An ellipse of a length and a width around `center`, its length turned by `angle` (radians) from +x to +y.
pub(super) fn at_angle(
    center: Vec3,
    size: (f64, f64),
    angle: f64,
) -> Result<(Ellipse, Placement), GeomError> {
    if !angle.is_finite() {
        return bad(format!("the angle of an ellipse is {angle}, expected a finite number"));
    }
    let placement = Placement { rotation: Mat3::rotation(Vec3::AXES[2], angle), translation: center };
    Ok((Ellipse { size: [size.0, size.1] }, placement))
}

word! {
    /// An ellipse. Flat: z says only what lies in front of what.
    "ellipse" EllipseWord {
        /// Its middle.
        center: Point,
        /// Its full lengths, greater than 0.
        length: Length,
        /// Its full lengths, greater than 0.
        width: Length,
        /// Of the length, radians from +x to +y.
        angle: Number = 0.0,
        ..COLORED
    }
}

impl<S: Scalar> Word<S> for EllipseWord<S> {
    type Solid = Ellipse;

    fn solid(&self) -> Result<(Ellipse, Placement), GeomError> {
        let size = (self.length.value(), self.width.value());
        at_angle(plain(self.center), size, self.angle.value())
    }

    fn at(&self) -> [[S; 3]; 4] {
        let (c, s, zero) = (self.angle.cos(), self.angle.sin(), S::from_f64(0.0));
        let rows = [[c, -s, zero], [s, c, zero], [zero; 3]];
        turned(self.center, Some(rows), [self.length, self.width, zero])
    }
}

word! {
    /// A disc. Flat: z says only what lies in front of what.
    "disc" DiscWord {
        /// Its middle.
        center: Point,
        /// Greater than 0.
        radius: Length,
        ..COLORED
    }
}

impl<S: Scalar> Word<S> for DiscWord<S> {
    type Solid = Ellipse;

    fn solid(&self) -> Result<(Ellipse, Placement), GeomError> {
        let width = 2.0 * self.radius.value();
        at_angle(plain(self.center), (width, width), 0.0)
    }

    fn at(&self) -> [[S; 3]; 4] {
        let (radius, zero) = (self.radius, S::from_f64(0.0));
        let rows = [[radius, zero, zero], [zero, radius, zero], [zero; 3]];
        turned(self.center, Some(rows), [S::from_f64(1.0); 3])
    }
}

//! The look of a shape: its arguments beside the measures, and their part for pictures.

use crate::error::{GeomError, bad_shape as bad};
use crate::vector::Mat3;
use std::sync::Arc;

/// The arguments of every shape besides its measures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// Turn about the centre, after the shape was aligned with its axis.
    pub rotation: Option<Mat3>,
    /// Rounding of edges in pictures.
    pub bevel: Option<f64>,
    /// Linear colour in `[0, 1]`.
    pub color: Option<[f32; 3]>,
    /// From 0 (paint, wood, stone) to 1 (metal).
    pub metalness: Option<f32>,
    /// From 0 (a mirror) to 1 (chalk).
    pub roughness: Option<f32>,
    /// The name of a material, which files keep.
    pub material: Option<Arc<str>>,
}

/// The paint of a shape in pictures.
#[derive(Clone, Debug)]
pub(crate) struct Paint {
    pub bevel: Option<f64>,
    /// Linear colour; NaN for none.
    pub color: [f32; 3],
    /// Metalness and roughness; NaN for none.
    pub finish: [f32; 2],
    /// The name of the material.
    pub material: Option<Arc<str>>,
}

impl Paint {
    pub const NONE: Paint =
        Paint { bevel: None, color: [f32::NAN; 3], finish: [f32::NAN; 2], material: None };

    /// The paint of a look, or `None` for an empty look.
    ///
    /// # Errors
    /// `bad-shape` for a look that is out of range.
    #[inline]
    pub fn of(look: &Look) -> Result<Option<Box<Paint>>, GeomError> {
        let Look { bevel, color, metalness, roughness, .. } = *look;
        let material = &look.material;
        if let Some(name) = material.as_deref().filter(|name| !is_name(name)) {
            return bad(format!("the material is {name:?}, expected a name of 1 to 100 characters"));
        }
        if let Some(b) = bevel.filter(|b| !(*b >= 0.0 && b.is_finite())) {
            return bad(format!("the bevel is {b}, expected zero or more"));
        }
        if let Some(c) = color.filter(|c| !c.iter().all(|c| (0.0..=1.0).contains(c))) {
            return bad(format!("the color is {c:?}, expected three numbers from 0 to 1"));
        }
        for (name, value) in [("metalness", metalness), ("roughness", roughness)] {
            if let Some(share) = value.filter(|share| !(0.0..=1.0).contains(share)) {
                return bad(format!("the {name} is {share}, expected a number from 0 to 1"));
            }
        }
        let is_surfaced = metalness.is_some() || roughness.is_some() || material.is_some();
        let is_painted = bevel.is_some() || color.is_some() || is_surfaced;
        Ok(is_painted.then(|| {
            let finish = [metalness, roughness].map(|share| share.unwrap_or(f32::NAN));
            let color = color.unwrap_or([f32::NAN; 3]);
            Box::new(Paint { bevel, color, finish, material: material.clone() })
        }))
    }

    /// This paint, with the colour and the surface of another where it has none; a flat shape has no surface.
    pub fn over(&self, other: &Paint, is_flat: bool) -> Paint {
        let first = |own: f32, other: f32| if own.is_nan() { other } else { own };
        let color = if self.color[0].is_nan() { other.color } else { self.color };
        let [metalness, roughness] = [0, 1].map(|k| first(self.finish[k], other.finish[k]));
        let material = self.material.clone().or_else(|| other.material.clone());
        match is_flat {
            true => Paint { color, ..self.clone() },
            false => Paint { bevel: self.bevel, color, finish: [metalness, roughness], material },
        }
    }
}

/// Whether files can keep the name of a material.
fn is_name(name: &str) -> bool {
    (1..=100).contains(&name.chars().count()) && !name.chars().any(char::is_control)
}

impl PartialEq for Paint {
    fn eq(&self, other: &Paint) -> bool {
        let same_color = self.color == other.color || (self.color[0].is_nan() && other.color[0].is_nan());
        let bits = |p: &Paint| (p.bevel.map(f64::to_bits), p.finish.map(f32::to_bits));
        same_color && bits(self) == bits(other) && self.material == other.material
    }
}

//! Lessons: a choice's prior and value as numbers, and the quotient of the guide's density to the prior's.

use super::Number;
use super::bells::Bells;
use super::classes::Classes;
use super::line::Place;
use niwaki_math::log_sums::log_add_exp;
use serde::{Deserialize, Serialize};

/// A choice as training needs it: its prior and its value, without the distribution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Lesson {
    /// A real number, as its coordinate.
    Normal {
        /// The coordinate.
        z: f64,
        /// Log of the prior's density of the coordinate, nats.
        log_prior: f64,
        /// The coordinate holds between these limits.
        limits: (f64, f64),
    },
    /// A value of finitely many.
    Finite {
        /// The index of the value.
        value: usize,
        /// Log probabilities of all values, nats.
        log_priors: Box<[f64]>,
    },
    /// A whole number, as its piece of the line.
    Count {
        /// The piece.
        between: (f64, f64),
        /// Log of the prior's probability, nats.
        log_prior: f64,
    },
}

/// A lesson whose list is borrowed: the form for computations.
#[derive(Clone, Copy)]
pub(crate) enum Known<'a> {
    /// A real number.
    Normal(Place),
    /// A value of finitely many.
    Finite { value: usize, log_priors: &'a [f64] },
    /// A whole number.
    Count { between: (f64, f64), log_prior: f64 },
}

impl Lesson {
    /// `ln(q / p)`, nats, of a guide with these outputs and this share of the prior. With `slope`, the derivatives by the
    /// outputs are added to it.
    pub fn log_quotient(&self, outputs: &[f64], share: f64, slope: Option<&mut [f64]>) -> f64 {
        self.known().log_quotient(outputs, share, slope)
    }

    /// The form for computations.
    pub(crate) fn known(&self) -> Known<'_> {
        match self {
            Lesson::Normal { z, log_prior, limits } => Known::normal(*z, *log_prior, *limits),
            Lesson::Finite { value, log_priors } => Known::Finite { value: *value, log_priors },
            Lesson::Count { between, log_prior } => Known::Count { between: *between, log_prior: *log_prior },
        }
    }
}

impl Known<'_> {
    /// A real number, from the parts of its lesson.
    pub(crate) fn normal(z: f64, log_prior: f64, limits: (f64, f64)) -> Self {
        Known::Normal(Place { z, log_prior, limits })
    }

    /// `ln(q / p)`, nats, of a guide with this share of the prior. With `slope`, the derivatives by the outputs are
    /// added to it.
    pub(crate) fn log_quotient<N: Number>(
        &self,
        outputs: &[N],
        share: f64,
        slope: Option<&mut [f64]>,
    ) -> f64 {
        match *self {
            Known::Normal(place) => of_real(&Bells::new(outputs), place, share, slope),
            Known::Finite { value, log_priors } => {
                Classes::new(outputs, log_priors).log_quotient(value, share, slope)
            }
            Known::Count { between, log_prior } => {
                of_count(&Bells::new(outputs), between, log_prior, share, slope)
            }
        }
    }
}

/// `ln(q / p)` of a real number. With the quotient `r` of the network's density of the coordinate to the prior's, and the
/// mass `m` outside the coordinate's limits, which the prior keeps:
///
/// ```text
/// q / p = (1 - s) (r + m) + s
/// ```
pub(super) fn of_real(bells: &Bells, place: Place, share: f64, slope: Option<&mut [f64]>) -> f64 {
    let floor = (1.0 - share) * bells.mass_outside(place.limits, 0.0, None) + share;
    // A NaN coordinate is not inside.
    let inside = place.z > place.limits.0 && place.z < place.limits.1;
    let density = if inside { bells.density(place.z, 0.0, None) } else { 0.0 };
    let net = if density > 0.0 { (1.0 - share) * density * (-place.log_prior).exp() } else { 0.0 };
    let quotient = net + floor;
    let small = quotient < f64::INFINITY;
    if let Some(slope) = slope {
        bells.density(place.z, if small { net / quotient } else { 1.0 }, Some(&mut *slope));
        bells.mass_outside(place.limits, (1.0 - share) / quotient, Some(slope));
    }
    if small { quotient.ln() } else { (-share).ln_1p() + density.ln() - place.log_prior }
}

/// `ln(q / p)` of a whole number: `q = (1 - s) n + s p`, where `n` is the mass between two numbers.
pub(super) fn of_count(
    bells: &Bells,
    (a, b): (f64, f64),
    log_prior: f64,
    share: f64,
    slope: Option<&mut [f64]>,
) -> f64 {
    let mass = bells.mass(a, b, 0.0, None);
    let quotient = log_add_exp((-share).ln_1p() + mass.ln() - log_prior, share.ln());
    if let Some(slope) = slope {
        bells.mass(a, b, ((-share).ln_1p() - log_prior - quotient).exp(), Some(slope));
    }
    quotient
}

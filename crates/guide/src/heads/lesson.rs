//! What a density needs of a choice's prior and value, and the quotient of the guide's density to the prior's.

use super::bells::Bells;
use super::classes;
use super::line::Place;
use niwaki_math::log_sums::log_add_exp;

/// What training needs of a choice: its prior and its value, without the distribution.
#[derive(Clone, Debug, PartialEq)]
pub enum Lesson {
    /// A real number, by its coordinate.
    Normal {
        /// The coordinate.
        z: f64,
        /// Log of the prior's density of the coordinate, nats.
        log_prior: f64,
        /// The coordinate holds between these.
        limits: (f64, f64),
    },
    /// One of finitely many values.
    Finite {
        /// Which.
        value: usize,
        /// Log probabilities of all values, nats.
        log_priors: Box<[f64]>,
    },
    /// A whole number, by its piece of the line.
    Count {
        /// The piece.
        between: (f64, f64),
        /// Log of the prior's probability, nats.
        log_prior: f64,
    },
}

/// A lesson whose list is borrowed: the form in which it is computed with.
#[derive(Clone, Copy)]
pub(crate) enum Known<'a> {
    /// A real number.
    Normal(Place),
    /// One of finitely many values.
    Finite { value: usize, log_priors: &'a [f64] },
    /// A whole number.
    Count { between: (f64, f64), log_prior: f64 },
}

impl Lesson {
    /// `ln(q / p)`, nats, of a guide with these outputs and this share of the prior. With `slope`, its derivatives by the
    /// outputs are added there.
    pub fn log_quotient(&self, outputs: &[f64], share: f64, slope: Option<&mut [f64]>) -> f64 {
        self.known().log_quotient(outputs, share, slope)
    }

    /// The form in which it is computed with.
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

    /// `ln(q / p)`, nats, of the guide with this share of the prior. With `slope`, its derivatives by the outputs are
    /// added there.
    ///
    /// With the network's density over the prior's as `exp(r)`, and outside of a coordinate's limits the mass `m`
    /// that is left to the prior:
    ///
    /// ```text
    /// q / p = (1 - s) (exp(r) + m) + s
    /// ```
    pub(crate) fn log_quotient(&self, outputs: &[f64], share: f64, slope: Option<&mut [f64]>) -> f64 {
        let log_net = (-share).ln_1p();
        match *self {
            Known::Normal(place) => {
                let bells = Bells::new(outputs);
                let left = bells.mass_outside(place.limits, 0.0, None);
                let floor = (1.0 - share) * left + share;
                let inside = place.z > place.limits.0 && place.z < place.limits.1;
                if !inside {
                    // Also a coordinate that is not a number.
                    if let Some(slope) = slope {
                        bells.mass_outside(place.limits, (1.0 - share) / floor, Some(slope));
                    }
                    return floor.ln();
                }
                let log = log_net + bells.density(place.z, 0.0, None).ln() - place.log_prior;
                let quotient = log_add_exp(log, floor.ln());
                if let Some(slope) = slope {
                    bells.density(place.z, (log - quotient).exp(), Some(slope));
                    bells.mass_outside(place.limits, (1.0 - share) * (-quotient).exp(), Some(slope));
                }
                quotient
            }
            Known::Finite { value, log_priors } => {
                let outputs = &outputs[..log_priors.len()];
                let log = log_net + classes::log_quotient(outputs, log_priors, value);
                let quotient = log_add_exp(log, share.ln());
                if let Some(slope) = slope {
                    classes::add_slope(outputs, log_priors, value, (log - quotient).exp(), slope);
                }
                quotient
            }
            Known::Count { between: (a, b), log_prior } => {
                let bells = Bells::new(outputs);
                let mass = bells.mass(a, b, 0.0, None);
                let quotient = log_add_exp(log_net + mass.ln() - log_prior, share.ln());
                if let Some(slope) = slope {
                    let scale = (log_net - log_prior - quotient).exp();
                    bells.mass(a, b, scale, Some(slope));
                }
                quotient
            }
        }
    }
}

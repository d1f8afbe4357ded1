//! The densities of sites; drawing and scoring.

use super::bells::{self, Bells};
use super::classes::{self, Classes};
use super::lesson::{Known, Lesson, of_count, of_real};
use super::line::Line;
use niwaki_math::{Dist, Draw, Stream};
use serde::{Deserialize, Serialize};

/// The map from a network's outputs to a density of a choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Head {
    /// Real numbers: a mixture of Gaussians in a coordinate in which the prior is near the standard Gaussian.
    Normal {
        /// The number of Gaussians.
        components: usize,
    },
    /// A value of at most this many, with a logit for each.
    Finite {
        /// The number of values.
        values: usize,
    },
    /// Whole numbers: the masses of a mixture of Gaussians on the pieces of the line that the values have
    /// under the prior.
    Count {
        /// The number of Gaussians.
        components: usize,
    },
}

/// A choice that a guide drew.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The value.
    pub value: Draw,
    /// Its log density under the prior, nats.
    pub log_prior: f64,
    /// Its log density under the guide, nats.
    pub log_drawn: f64,
}

/// The number of a finite distribution's values, and the first of whole numbers.
fn listed(dist: &Dist) -> Option<(usize, i64)> {
    let (count, first) = match dist {
        Dist::Bernoulli { .. } => (2, 0),
        Dist::Categorical(weights) => (weights.len(), 0),
        Dist::DiscreteUniform { lo, hi } => {
            (usize::try_from(hi.checked_sub(*lo)?).ok()?.checked_add(1)?, *lo)
        }
        _ => return None,
    };
    (count <= classes::MOST).then_some((count, first))
}

/// Writes logs of the prior's probabilities of a finite distribution's values.
fn log_priors<'a>(
    dist: &Dist,
    (count, first): (usize, i64),
    logs: &'a mut [f64; classes::MOST],
) -> &'a [f64] {
    let logs = &mut logs[..count];
    logs.iter_mut().zip(first..).for_each(|(log, k)| *log = dist.log_density_of_int(k));
    logs
}

/// The piece of the line of a whole number.
fn piece(dist: &Dist, k: i64) -> Option<(f64, f64)> {
    let before = k.checked_sub(1).map_or(Some(f64::NEG_INFINITY), |k| dist.normal_score(k));
    Some((before?, dist.normal_score(k)?))
}

impl Head {
    /// The head of a site whose choices have this prior. `None` if the prior itself draws: vectors, angles, mixtures,
    /// fixed values, and more than 64 categories.
    pub fn of(dist: &Dist, components: usize) -> Option<Head> {
        let components = components.clamp(1, bells::MOST);
        if let Some((values, _)) = listed(dist) {
            Some(Head::Finite { values })
        } else if dist.normal_score(0).is_some() {
            Some(Head::Count { components })
        } else {
            Line::new(dist).map(|_| Head::Normal { components })
        }
    }

    /// Widens the head to another prior of the site: categories may grow in number, and whole numbers
    /// whose bounds vary become counts. `None` if no head fits both priors.
    pub fn widen(self, dist: &Dist, components: usize) -> Option<Head> {
        if self.fits(dist) {
            return Some(self);
        }
        match (self, dist) {
            (Head::Finite { .. }, Dist::Categorical(weights)) if weights.len() <= classes::MOST => {
                Some(Head::Finite { values: weights.len() })
            }
            (Head::Finite { .. }, Dist::DiscreteUniform { .. }) => {
                Some(Head::Count { components: components.clamp(1, bells::MOST) })
            }
            _ => None,
        }
    }

    /// The number of a network's outputs for this head.
    pub fn outputs(&self) -> usize {
        match self {
            Head::Normal { components } | Head::Count { components } => 3 * components,
            Head::Finite { values } => *values,
        }
    }

    /// Whether the head has at least one output, and no more than the code can handle.
    pub(crate) fn is_sound(&self) -> bool {
        match self {
            Head::Normal { components } | Head::Count { components } => {
                (1..=bells::MOST).contains(components)
            }
            Head::Finite { values } => (1..=classes::MOST).contains(values),
        }
    }

    /// Outputs with which the guide equals the prior, or nearly so.
    pub(crate) fn start(&self) -> Vec<f64> {
        match self {
            Head::Normal { components } | Head::Count { components } => bells::start(*components),
            Head::Finite { values } => vec![0.0; *values],
        }
    }

    /// Whether the head can draw from this prior; if not, the prior draws.
    pub fn fits(&self, dist: &Dist) -> bool {
        match self {
            Head::Normal { .. } => Line::new(dist).is_some(),
            Head::Finite { .. } => self.listed(dist).is_some(),
            Head::Count { .. } => dist.normal_score(0).is_some(),
        }
    }

    /// A draw from `(1 - share) n + share p`, where `n` is the network's density and `p` the prior, with its log
    /// densities. If the head does not fit the prior, the prior draws.
    ///
    /// # Panics
    ///
    /// If there are fewer outputs than [`Head::outputs`].
    pub fn draw(&self, outputs: &[f32], dist: &Dist, share: f64, rng: &mut Stream) -> Drawn {
        let drawn = match self {
            Head::Normal { .. } => self.draw_real(outputs, dist, share, rng),
            Head::Finite { .. } => self.draw_listed(outputs, dist, share, rng),
            Head::Count { .. } => self.draw_count(outputs, dist, share, rng),
        };
        drawn.unwrap_or_else(|| {
            let (value, log_prior) = dist.sample_and_score(rng);
            Drawn { value, log_prior, log_drawn: log_prior }
        })
    }

    /// A draw of a real number; `None` for another prior.
    fn draw_real(&self, outputs: &[f32], dist: &Dist, share: f64, rng: &mut Stream) -> Option<Drawn> {
        let line = Line::new(dist)?;
        let bells = Bells::new(&outputs[..self.outputs()]);
        let mut drawn = None;
        if rng.uniform() >= share {
            let (u, normal) = (rng.uniform(), rng.normal());
            // Rounding can reach an end that the prior excludes.
            drawn = line.value(bells.number(u, normal)).map(|x| (x, dist.log_density_of_real(x)));
        }
        let (x, log_prior) = match drawn {
            Some(scored) if scored.1 > f64::NEG_INFINITY => scored,
            _ => {
                let (value, log_prior) = dist.sample_and_score(rng);
                (value.as_real()?, log_prior)
            }
        };
        let log_drawn = log_prior
            + if log_prior == f64::NEG_INFINITY {
                0.0
            } else {
                of_real(&bells, line.place(x, log_prior), share, None)
            };
        Some(Drawn { value: Draw::Real(x), log_prior, log_drawn })
    }

    /// A draw of a value of finitely many; `None` for another prior.
    fn draw_listed(&self, outputs: &[f32], dist: &Dist, share: f64, rng: &mut Stream) -> Option<Drawn> {
        let (count, first) = self.listed(dist)?;
        let mut logs = [0.0; classes::MOST];
        let logs = log_priors(dist, (count, first), &mut logs);
        let classes = Classes::new(&outputs[..count], logs);
        let k = classes.choose(share, rng.uniform());
        let value = match dist {
            Dist::Bernoulli { .. } => Draw::Bool(k == 1),
            _ => Draw::Int(first + k as i64),
        };
        let log_prior = logs[k];
        Some(Drawn { value, log_prior, log_drawn: log_prior + classes.log_quotient(k, share, None) })
    }

    /// A draw of a whole number; `None` for another prior.
    fn draw_count(&self, outputs: &[f32], dist: &Dist, share: f64, rng: &mut Stream) -> Option<Drawn> {
        dist.normal_score(0)?;
        let bells = Bells::new(&outputs[..self.outputs()]);
        let mut drawn = None;
        if rng.uniform() >= share {
            let (u, normal) = (rng.uniform(), rng.normal());
            let k = dist.at_normal_score(bells.number(u, normal))?;
            drawn = Some((k, dist.log_density_of_int(k)));
        }
        let (k, log_prior) = match drawn {
            Some(scored) if scored.1 > f64::NEG_INFINITY => scored,
            _ => {
                let (value, log_prior) = dist.sample_and_score(rng);
                (value.as_int()?, log_prior)
            }
        };
        let log_drawn = log_prior
            + if log_prior == f64::NEG_INFINITY {
                0.0
            } else {
                of_count(&bells, piece(dist, k)?, log_prior, share, None)
            };
        Some(Drawn { value: Draw::Int(k), log_prior, log_drawn })
    }

    /// Log density of a value, nats, with respect to the measure of its prior. For a value of [`Head::draw`] the bits equal
    /// those of the draw. Minus infinity if the prior's density is zero.
    ///
    /// # Panics
    ///
    /// If there are fewer outputs than [`Head::outputs`].
    pub fn log_drawn(&self, outputs: &[f32], dist: &Dist, share: f64, value: &Draw) -> f64 {
        let log_prior = dist.log_density(value);
        if log_prior == f64::NEG_INFINITY {
            return log_prior;
        }
        let mut logs = [0.0; classes::MOST];
        match self.known(dist, value, log_prior, &mut logs) {
            Some(known) => log_prior + known.log_quotient(&outputs[..self.outputs()], share, None),
            None => log_prior,
        }
    }

    /// The number of values of a finite distribution that the head fits, and the first value.
    fn listed(&self, dist: &Dist) -> Option<(usize, i64)> {
        let Head::Finite { values } = self else { return None };
        listed(dist).filter(|(count, _)| match dist {
            Dist::Categorical(_) => count <= values,
            // Whole numbers are identified by their distance from the first, so another count is another choice.
            _ => count == values,
        })
    }

    /// Writes the log probabilities of a finite prior that the head fits, nats; `None` for another prior.
    pub(crate) fn log_priors<'a>(
        &self,
        dist: &Dist,
        logs: &'a mut [f64; classes::MOST],
    ) -> Option<&'a [f64]> {
        Some(log_priors(dist, self.listed(dist)?, logs))
    }

    /// The lesson of a value that the prior does not exclude, with a borrowed list; `None` if the head does not fit.
    fn known<'a>(
        &self,
        dist: &Dist,
        value: &Draw,
        log_prior: f64,
        logs: &'a mut [f64; classes::MOST],
    ) -> Option<Known<'a>> {
        Some(match self {
            Head::Normal { .. } => Known::Normal(Line::new(dist)?.place(value.as_real()?, log_prior)),
            Head::Finite { .. } => {
                let (count, first) = self.listed(dist)?;
                let log_priors = log_priors(dist, (count, first), logs);
                let value = usize::try_from(value.as_int()?.checked_sub(first)?).ok()?;
                Known::Finite { value, log_priors }
            }
            Head::Count { .. } => Known::Count { between: piece(dist, value.as_int()?)?, log_prior },
        })
    }

    /// The lesson of a choice; `None` if the head does not fit or the prior excludes the value, so that nothing can
    /// be learnt.
    pub fn lesson(&self, dist: &Dist, value: &Draw) -> Option<Lesson> {
        let log_prior = dist.log_density(value);
        if !log_prior.is_finite() {
            return None;
        }
        let mut logs = [0.0; classes::MOST];
        Some(match self.known(dist, value, log_prior, &mut logs)? {
            Known::Normal(place) => {
                Lesson::Normal { z: place.z, log_prior: place.log_prior, limits: place.limits }
            }
            Known::Finite { value, log_priors } => Lesson::Finite { value, log_priors: log_priors.into() },
            Known::Count { between, log_prior } => Lesson::Count { between, log_prior },
        })
    }
}

//! Which density a site has; drawing and scoring.

use super::lesson::{Known, Lesson};
use super::line::Line;
use super::{bells, classes};
use bells::Bells;
use niwaki_math::{Dist, Draw, Stream};
use serde::{Deserialize, Serialize};

/// How a network's outputs are a density of a choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Head {
    /// Real numbers: a mixture of so many Gaussians in a coordinate in which the prior is near the standard Gaussian.
    Normal {
        /// How many Gaussians.
        components: usize,
    },
    /// One of at most so many values, with a logit for each.
    Finite {
        /// How many values.
        values: usize,
    },
    /// Whole numbers: the masses that a mixture of so many Gaussians has on the pieces of the line that the values have
    /// under the prior.
    Count {
        /// How many Gaussians.
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

/// A network's outputs as `f64`, on the stack.
struct Outputs {
    numbers: [f64; classes::MOST],
    count: usize,
}

impl Outputs {
    fn new(outputs: &[f32], count: usize) -> Outputs {
        let mut numbers = [0.0; classes::MOST];
        numbers.iter_mut().zip(&outputs[..count]).for_each(|(to, from)| *to = f64::from(*from));
        Outputs { numbers, count }
    }

    fn all(&self) -> &[f64] {
        &self.numbers[..self.count]
    }
}

/// The values of a finite distribution: how many, and the first of whole numbers.
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

/// Logs of the prior's probabilities of a finite distribution's values.
fn log_priors(dist: &Dist, (count, first): (usize, i64)) -> [f64; classes::MOST] {
    let mut logs = [f64::NEG_INFINITY; classes::MOST];
    for (log, k) in logs[..count].iter_mut().zip(first..) {
        *log = dist.log_density_of_int(k);
    }
    logs
}

impl Head {
    /// The head of a site whose choices have this prior; `None` where the prior draws: vectors, angles, mixtures,
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

    /// The head that also fits another prior that was met at the site: categories may grow in number, and whole numbers
    /// whose bounds vary become counts. `None` where no head fits both.
    pub fn also(self, dist: &Dist, components: usize) -> Option<Head> {
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

    /// How many outputs of a network it reads.
    pub fn outputs(&self) -> usize {
        match self {
            Head::Normal { components } | Head::Count { components } => 3 * components,
            Head::Finite { values } => *values,
        }
    }

    /// Whether it has at least one output and not more than can be computed with.
    pub(crate) fn is_sound(&self) -> bool {
        match self {
            Head::Normal { components } | Head::Count { components } => {
                (1..=bells::MOST).contains(components)
            }
            Head::Finite { values } => (1..=classes::MOST).contains(values),
        }
    }

    /// Outputs with which the guide is the prior, or near it.
    pub(crate) fn start(&self) -> Vec<f64> {
        match self {
            Head::Normal { components } | Head::Count { components } => bells::start(*components),
            Head::Finite { values } => vec![0.0; *values],
        }
    }

    /// Whether it can draw from this prior. Where it cannot, the prior draws.
    pub fn fits(&self, dist: &Dist) -> bool {
        match self {
            Head::Normal { .. } => Line::new(dist).is_some(),
            // Whole numbers are known by their distance from the first: another count is another choice.
            Head::Finite { values } => listed(dist).is_some_and(|(count, _)| match dist {
                Dist::Categorical(_) => count <= *values,
                _ => count == *values,
            }),
            Head::Count { .. } => dist.normal_score(0).is_some(),
        }
    }

    /// A draw from `(1 - share) n + share p`, `n` being the network's density and `p` the prior, with its log
    /// densities. A prior that the head does not fit draws itself.
    ///
    /// # Panics
    ///
    /// If there are fewer outputs than [`Head::outputs`].
    pub fn draw(&self, outputs: &[f32], dist: &Dist, share: f64, rng: &mut Stream) -> Drawn {
        let outputs = Outputs::new(outputs, self.outputs());
        let prior = |rng: &mut Stream| dist.sample(rng);
        let value = match self {
            _ if !self.fits(dist) => prior(rng),
            Head::Finite { .. } => {
                let Some((count, first)) = listed(dist) else {
                    return self.scored(&outputs, dist, share, prior(rng));
                };
                let logs = log_priors(dist, (count, first));
                let k = classes::choose(&outputs.all()[..count], &logs[..count], share, rng.uniform());
                match dist {
                    Dist::Bernoulli { .. } => Draw::Bool(k == 1),
                    _ => Draw::Int(first + k as i64),
                }
            }
            Head::Normal { .. } | Head::Count { .. } => {
                if rng.uniform() < share {
                    prior(rng)
                } else {
                    let (u, normal) = (rng.uniform(), rng.normal());
                    let z = Bells::new(outputs.all()).number(u, normal);
                    let value = if let Head::Normal { .. } = self {
                        Line::new(dist).and_then(|line| line.value(z)).map(Draw::Real)
                    } else {
                        dist.at_normal_score(z).map(Draw::Int)
                    };
                    // Rounding can reach an end that the prior excludes.
                    let possible = |x: &Draw| dist.log_density(x) > f64::NEG_INFINITY;
                    value.filter(possible).unwrap_or_else(|| prior(rng))
                }
            }
        };
        self.scored(&outputs, dist, share, value)
    }

    /// A value with its log densities.
    fn scored(&self, outputs: &Outputs, dist: &Dist, share: f64, value: Draw) -> Drawn {
        let log_prior = dist.log_density(&value);
        let log_drawn = self.score(outputs, dist, share, &value, log_prior);
        Drawn { value, log_prior, log_drawn }
    }

    /// Log density of a value, nats, with respect to the measure of its prior; the same bits as [`Head::draw`] gives
    /// for a value that it drew. Minus infinity where the prior's density is zero.
    ///
    /// # Panics
    ///
    /// If there are fewer outputs than [`Head::outputs`].
    pub fn log_drawn(&self, outputs: &[f32], dist: &Dist, share: f64, value: &Draw) -> f64 {
        let outputs = Outputs::new(outputs, self.outputs());
        self.score(&outputs, dist, share, value, dist.log_density(value))
    }

    fn score(&self, outputs: &Outputs, dist: &Dist, share: f64, value: &Draw, log_prior: f64) -> f64 {
        if log_prior == f64::NEG_INFINITY || !self.fits(dist) {
            return log_prior;
        }
        let mut logs = [0.0; classes::MOST];
        match self.known(dist, value, log_prior, &mut logs) {
            Some(known) => log_prior + known.log_quotient(outputs.all(), share, None),
            None => log_prior,
        }
    }

    /// What the density needs of a value that the prior does not exclude.
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
                let (count, first) = listed(dist)?;
                *logs = log_priors(dist, (count, first));
                let value = usize::try_from(value.as_int()?.checked_sub(first)?).ok()?;
                Known::Finite { value, log_priors: &logs[..count] }
            }
            Head::Count { .. } => {
                let k = value.as_int()?;
                let before = k.checked_sub(1).map_or(Some(f64::NEG_INFINITY), |k| dist.normal_score(k))?;
                Known::Count { between: (before, dist.normal_score(k)?), log_prior }
            }
        })
    }

    /// What training needs of a choice; `None` where the head does not fit or the prior excludes the value: nothing can
    /// be learned there.
    pub fn lesson(&self, dist: &Dist, value: &Draw) -> Option<Lesson> {
        let log_prior = dist.log_density(value);
        if !log_prior.is_finite() || !self.fits(dist) {
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

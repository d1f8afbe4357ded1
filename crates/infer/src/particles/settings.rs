//! What can be set.

use super::Resampling;
use niwaki_vm::fault::Fault;

/// Which future runs next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Futures run where they are created: ordinary SMC.
    DepthFirst,
    /// A uniform draw among all runnable futures after each barrier (SOSMC, dissertation 5.3).
    Stochastic,
}

impl Order {
    /// The policy of a name: `depth-first`, `stochastic`.
    pub fn from_name(name: &str) -> Option<Order> {
        match name {
            "depth-first" => Some(Order::DepthFirst),
            "stochastic" => Some(Order::Stochastic),
            _ => None,
        }
    }
}

/// How scores become weights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weights {
    /// The ratio of successive scores: the final law is the posterior.
    Ratio,
    /// The whole score at every step, resampled at every step: what the original did. No evidence.
    Absolute,
}

impl Weights {
    /// The weighting of a name: `ratio`, `absolute`.
    pub fn from_name(name: &str) -> Option<Weights> {
        match name {
            "ratio" => Some(Weights::Ratio),
            "absolute" => Some(Weights::Absolute),
            _ => None,
        }
    }
}

/// When to resample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// At every barrier.
    Always,
    /// When the effective sample size falls below this share of the particles.
    EffectiveBelow(f64),
}

/// What can be set.
#[derive(Clone, Debug)]
pub struct Settings {
    /// How many particles.
    pub particles: usize,
    /// Order policy.
    pub order: Order,
    /// Weighting.
    pub weights: Weights,
    /// The power to which the score is raised while searching (1: the posterior).
    pub temper: f64,
    /// Resampling method.
    pub resampling: Resampling,
    /// When to resample.
    pub when: When,
    /// Seed.
    pub seed: u64,
    /// Deliberate errors that the statistical tests must reject.
    #[cfg(test)]
    pub mutant: Option<super::tests::Mutant>,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            particles: 100,
            order: Order::Stochastic,
            weights: Weights::Ratio,
            temper: 1.0,
            resampling: Resampling::Systematic,
            when: When::Always,
            seed: 0,
            #[cfg(test)]
            mutant: None,
        }
    }
}

impl Settings {
    /// Refuses settings that make no sense.
    ///
    /// # Errors
    /// No particles, a temperature that is not positive, or a threshold outside `[0, 1]`.
    pub fn check(&self) -> Result<(), Fault> {
        if self.particles == 0 {
            return Err(
                Fault::new("no-particles", "zero particles were asked for").with_help("use at least one")
            );
        }
        if !(self.temper > 0.0 && self.temper.is_finite()) {
            return Err(Fault::new("bad-temper", format!("the temperature is {}", self.temper))
                .with_help("use a positive number: 1 for the posterior, more to sharpen the search"));
        }
        if let When::EffectiveBelow(share) = self.when
            && !(0.0..=1.0).contains(&share)
        {
            return Err(Fault::new("bad-threshold", format!("the resampling threshold is {share}"))
                .with_help("use a share of the particles between 0 and 1"));
        }
        Ok(())
    }

    #[cfg(test)]
    pub(super) fn is(&self, mutant: super::tests::Mutant) -> bool {
        self.mutant == Some(mutant)
    }
}

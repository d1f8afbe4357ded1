//! The settings of SMC.

use niwaki_chain::kernel::Kernel;
use niwaki_propose::look_ahead::LookAhead;
use niwaki_propose::proposal::Proposal;
use niwaki_run::order::Order;
use niwaki_run::resampling::Resampling;
use niwaki_vm::fault::Fault;
use serde::{Deserialize, Deserializer};
use std::sync::{Arc, LazyLock};

/// The rule that turns scores into weights.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Weights {
    /// The ratio of successive scores: the final law is the posterior.
    Ratio,
    /// The whole score at every step, with resampling at every step, as in the original system. There is no evidence.
    Absolute,
}

/// The rule that triggers resampling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// At every barrier.
    Always,
    /// When the effective sample size falls below this share of the particles.
    EffectiveBelow(f64),
}

/// The schedule of the power from barrier to barrier. The final law is always that of the declared
/// power: the weights correct for the power of each barrier.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(untagged)]
pub enum Anneal {
    /// The declared power at every barrier.
    Constant,
    /// The power at each barrier; the last power is for all later barriers.
    Schedule(Vec<f64>),
    /// From zero up to the declared power, at each barrier as far as the conditional effective sample size
    /// (Zhou, Johansen & Aston 2016, eq. 13) stays at this share of the particles.
    Adaptive(f64),
}

/// The rule that triggers moves: a number of barriers, or a word.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Moment {
    /// After each resampling, and once when all have ended.
    Resampled,
    /// Once, when all have ended.
    End,
    /// After each given number of barriers, and once when all have ended.
    #[serde(untagged)]
    Every(usize),
}

/// The settings of rejuvenation.
#[derive(Clone, Debug)]
pub struct Rejuvenation {
    /// The kernel of the moves.
    pub kernel: Kernel,
    /// The number of proposals for each particle and time.
    pub moves: u64,
    /// The rule that triggers moves.
    pub at: Moment,
    /// The chains that replace the final set; `None` to move every particle of the set.
    pub final_chains: Option<FinalChains>,
}

impl Rejuvenation {
    /// Refuses settings that make no sense.
    fn check(&self, weights: Weights) -> Result<(), Fault> {
        if weights == Weights::Absolute {
            return Err(Fault::new(
                "bad-setting",
                "absolute weights have no target distribution, which a move needs",
            )
            .with_help("use ratio weights"));
        }
        let none = self.final_chains.is_some_and(|wanted| wanted.chains == 0 || wanted.draws == 0);
        if self.moves == 0 || self.at == Moment::Every(0) || none {
            return Err(Fault::new("bad-setting", "a number of moves, barriers, chains or draws is 0")
                .with_help("use at least one"));
        }
        if self.kernel.any(&|part| matches!(part, Kernel::Anneal { .. })) {
            let what = "an annealing kernel changes the distribution of the particles";
            return Err(Fault::new("bad-kernel", what)
                .with_help("anneal the particles, and move them by the kernel inside `anneal`"));
        }
        let follows = |part: &Kernel| matches!(part, Kernel::Leaf(own) if own.trajectory().is_some());
        if self.at != Moment::End && self.kernel.any(&follows) {
            let what = "a particle that still runs has no gradient to follow";
            return Err(Fault::new("bad-kernel", what)
                .with_help("move the particles at the end, or without `hmc_step()` and `nuts_step()`"));
        }
        Ok(())
    }
}

/// Chains that start from a few particles of the final set, instead of moves of all particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FinalChains {
    /// The number of chains.
    pub chains: usize,
    /// The number of states of each chain, `moves` proposals apart.
    pub draws: usize,
}

/// Read the share of effective particles below which to resample; null for every barrier.
fn when<'de, D: Deserializer<'de>>(from: D) -> Result<When, D::Error> {
    Ok(Option::deserialize(from)?.map_or(When::Always, When::EffectiveBelow))
}

/// The settings of SMC.
#[derive(Clone, Debug, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// The number of particles.
    #[serde(skip)]
    pub particles: usize,
    /// The order policy.
    pub order: Order,
    /// The rule that turns scores into weights.
    pub weights: Weights,
    /// The power to which the score is raised in the final law (1: the posterior).
    pub power: f64,
    /// The schedule of the power before the end.
    pub anneal: Anneal,
    /// The resampling method.
    pub resampling: Resampling,
    /// When to resample.
    #[serde(rename = "ess", deserialize_with = "when")]
    pub when: When,
    /// How particles are moved; none where they are not.
    #[serde(skip)]
    pub rejuvenate: Option<Rejuvenation>,
    /// The proposal for the choices that the prior does not draw.
    #[serde(skip)]
    pub proposal: Option<Arc<Proposal>>,
    /// The look-ahead that weights count, if any.
    #[serde(skip)]
    pub look_ahead: Option<LookAhead>,
    /// Whether particles at the same place run together, in lanes. This setting changes only the time.
    #[serde(skip, default = "lanes")]
    pub lanes: bool,
    /// The seed.
    #[serde(skip)]
    pub seed: u64,
}

/// Lanes are used, unless the environment has `NIWAKI_LANES=0`.
fn lanes() -> bool {
    static USED: LazyLock<bool> =
        LazyLock::new(|| std::env::var_os("NIWAKI_LANES").is_none_or(|set| set != "0"));
    *USED
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            particles: 100,
            order: Order::Stochastic,
            weights: Weights::Ratio,
            power: 1.0,
            anneal: Anneal::Constant,
            resampling: Resampling::Systematic,
            when: When::Always,
            rejuvenate: None,
            proposal: None,
            look_ahead: None,
            lanes: lanes(),
            seed: 0,
        }
    }
}

impl Settings {
    /// Refuses settings that make no sense.
    ///
    /// # Errors
    /// No particles, a power that is not positive, a threshold outside `[0, 1]`, a schedule of powers that is
    /// empty; beside absolute weights a schedule, a proposal, moves, tempered resampling or look-ahead; beside look-ahead moves
    /// of particles that still run.
    pub fn check(&self) -> Result<(), Fault> {
        if self.particles == 0 {
            return Err(
                Fault::new("no-particles", "the number of particles is 0").with_help("use at least one")
            );
        }
        if !(self.power > 0.0 && self.power.is_finite()) {
            return Err(Fault::new("bad-power", format!("the power is {}", self.power))
                .with_help("use a positive number: 1 for the posterior, more to sharpen the search"));
        }
        if let When::EffectiveBelow(share) = self.when
            && !(0.0..=1.0).contains(&share)
        {
            return Err(Fault::new("bad-threshold", format!("the resampling threshold is {share}"))
                .with_help("use a share of the particles between 0 and 1"));
        }
        if self.proposal.is_some() && self.weights == Weights::Absolute {
            return Err(Fault::new("bad-setting", "absolute weights do not count what a proposal drew")
                .with_help("use ratio weights, or no proposal"));
        }
        if self.resampling == Resampling::Tempered && self.weights == Weights::Absolute {
            return Err(Fault::new(
                "bad-setting",
                "absolute weights carry nothing from one barrier to the next",
            )
            .with_help("use ratio weights, or another resampling than \"tempered\""));
        }
        if let Some(own) = &self.look_ahead {
            self.check_look_ahead(own)?;
        }
        if let Some(policy) = self.order.policy() {
            policy.check()?;
        }
        if let Some(rejuvenation) = &self.rejuvenate {
            rejuvenation.check(self.weights)?;
        }
        let (fits, given) = match &self.anneal {
            Anneal::Constant => return Ok(()),
            Anneal::Schedule(powers) => {
                let fits = !powers.is_empty() && powers.iter().all(|t| *t >= 0.0 && t.is_finite());
                (fits, format!("{powers:?}"))
            }
            Anneal::Adaptive(share) => (*share > 0.0 && *share < 1.0, share.to_string()),
        };
        if !fits {
            return Err(Fault::new("bad-anneal", format!("the schedule of powers is {given}"))
                .with_help("give the power at each barrier, or a share of the particles between 0 and 1"));
        }
        if self.weights == Weights::Absolute {
            return Err(Fault::new("bad-anneal", "absolute weights have no schedule of powers")
                .with_help("use ratio weights"));
        }
        Ok(())
    }

    fn check_look_ahead(&self, own: &LookAhead) -> Result<(), Fault> {
        if !(own.strength > 0.0 && own.strength.is_finite()) {
            return Err(Fault::new(
                "bad-setting",
                format!("the strength of the look-ahead is {}", own.strength),
            )
            .with_help("use a positive number, such as 0.2"));
        }
        if self.weights == Weights::Absolute {
            return Err(Fault::new(
                "bad-setting",
                "absolute weights carry nothing on that a forecast could be taken back from",
            )
            .with_help("use ratio weights, or no look-ahead"));
        }
        if self.rejuvenate.as_ref().is_some_and(|moves| moves.at != Moment::End) {
            let what = "particles that still run are not moved under a look-ahead";
            return Err(Fault::new("bad-setting", what)
                .with_help("move the particles at the end, or do not look ahead"));
        }
        Ok(())
    }
}

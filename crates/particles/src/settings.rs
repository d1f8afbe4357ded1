//! The settings of SMC.

use niwaki_chain::kernel::Kernel;
use niwaki_propose::look_ahead::LookAhead;
use niwaki_propose::proposal::Proposal;
use niwaki_run::order::Order;
use niwaki_run::resampling::Resampling;
use niwaki_run::setting::{BETWEEN, FROM_ZERO, POSITIVE, Range, Ranges, SHARE};
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

impl Settings {
    /// Ranges of the settings that are read as data.
    pub const RANGES: Ranges = &[
        ("order", Range::Either(&[Range::Words(&["stochastic", "depth-first"]), Range::Table(None)])),
        ("weights", Range::Words(&["ratio", "absolute"])),
        ("power", POSITIVE),
        ("anneal", Range::Optional(&Range::Either(&[BETWEEN, Range::List(&FROM_ZERO)]))),
        ("resampling", Range::Words(&["systematic", "residual", "stratified", "multinomial", "tempered"])),
        ("ess", Range::Optional(&SHARE)),
    ];
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

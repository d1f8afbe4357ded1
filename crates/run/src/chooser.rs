//! Choosers: the sources of the values of choices, the same for every algorithm.
//!
//! A chooser answers a choice with a value and two log densities of the value: under the prior of the choice, `p`, and under
//! the distribution from which the value was drawn, `q`. An algorithm that draws from `q` and targets `p` weighs a run by
//!
//! ```text
//! log p(x) - log q(x)        summed over the choices of a run
//! ```
//!
//! [`Prior`] draws from `p` itself, [`Known`] uses known values, `ByProposal` (in `niwaki-propose`) draws from a user's proposal
//! or a guide. The last two pass all remaining choices to another chooser. A chooser may use the scene so far ([`Context`]).

use niwaki_geom::Aabb;
use niwaki_geom::sketch::product::Sketches;
use niwaki_math::{Dist, StreamKey};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::value::{Value, log_density};
use std::collections::HashMap;

/// A value for a choice.
#[derive(Clone, Debug)]
pub struct Chosen {
    /// The value.
    pub value: Value,
    /// The log density under the prior of the choice, nats.
    pub log_prior: f64,
    /// The log density under the distribution from which the value was drawn, nats; 0 for a known value.
    pub log_drawn: f64,
}

impl Chosen {
    /// Answer with a value from the prior. `log` is its log density, nats.
    #[inline(always)]
    pub fn from_prior(value: impl Into<Value>, log: f64) -> Chosen {
        Chosen { value: value.into(), log_prior: log, log_drawn: log }
    }

    /// Answer with a known value.
    ///
    /// # Errors
    /// A value that no distribution can draw.
    pub fn given(value: Value, dist: &Dist) -> Result<Chosen, Fault> {
        Ok(Chosen { log_prior: log_density(dist, &value)?, value, log_drawn: 0.0 })
    }
}

/// The context of a choice: data that a chooser may use beside the choice.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// The address of the choice.
    pub address: u128,
    /// The sketches of the scene so far. `None` for a task without sketches, and where they are not up to date at this
    /// choice (in a replay or in a Markov chain).
    pub sketches: Option<&'a Sketches>,
    /// The number of primitives of the scene.
    pub primitives: usize,
    /// The last part that was emitted on the call path, where the run itself does not record it (in a Markov chain).
    pub part: Option<Aabb>,
}

impl Context<'_> {
    /// The context of a choice without a scene.
    #[inline(always)]
    pub fn of(at: &At<'_, f64>) -> Self {
        Context { address: at.address(), sketches: None, primitives: 0, part: None }
    }
}

/// A source of the values of choices.
pub trait Chooser {
    /// Whether every value is drawn from the prior, so that all log weights are zero.
    const IS_PRIOR: bool = false;

    /// The key of the random bits from which every value is drawn by its prior; `None` where that is not so.
    fn key(&self) -> Option<StreamKey> {
        None
    }

    /// Whether the chooser uses the scene, so that windows and last parts must be kept.
    fn looks(&self) -> bool {
        false
    }

    /// Choose a value; `None` pauses the run before the choice.
    ///
    /// # Errors
    /// A fault ends the run.
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault>;

    /// Choose the same value without its densities, in a run without a scene.
    ///
    /// # Errors
    /// The errors of [`Chooser::choose`].
    #[inline]
    fn draw(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Option<Value>, Fault> {
        Ok(self.choose(at, dist, Context::of(at))?.map(|chosen| chosen.value))
    }
}

impl<C: Chooser> Chooser for &mut C {
    const IS_PRIOR: bool = C::IS_PRIOR;

    fn key(&self) -> Option<StreamKey> {
        (**self).key()
    }

    fn looks(&self) -> bool {
        (**self).looks()
    }

    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        (**self).choose(at, dist, seen)
    }
}

/// Chooser that draws from the prior, with the random bits of a stream at the address of the choice.
#[derive(Clone, Copy)]
pub struct Prior(pub StreamKey);

impl Chooser for Prior {
    const IS_PRIOR: bool = true;

    #[inline(always)]
    fn key(&self) -> Option<StreamKey> {
        Some(self.0)
    }

    #[inline(always)]
    fn choose(&mut self, _: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let (draw, log) = dist.sample_and_score(&mut self.0.at(seen.address));
        Ok(Some(Chosen::from_prior(draw, log)))
    }

    #[inline(always)]
    fn draw(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Option<Value>, Fault> {
        Ok(Some(dist.sample(&mut self.0.at(at.address())).into()))
    }
}

/// Chooser of known values by address; another chooser has all remaining choices.
pub struct Known<'a, C> {
    /// The known values.
    pub values: Option<&'a HashMap<u128, Value>>,
    /// The chooser of all remaining choices.
    pub fallback: C,
}

impl<C> Known<'_, C> {
    #[inline]
    fn find(&self, address: u128) -> Option<&Value> {
        self.values?.get(&address)
    }
}

impl<C: Chooser> Chooser for Known<'_, C> {
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        match self.find(seen.address) {
            Some(value) => Chosen::given(value.clone(), dist).map(Some),
            None => self.fallback.choose(at, dist, seen),
        }
    }

    #[inline]
    fn draw(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Option<Value>, Fault> {
        match self.find(at.address()) {
            Some(value) => Ok(Some(value.clone())),
            None => self.fallback.draw(at, dist),
        }
    }
}

/// Chooser without values: any choice is a fault with this help.
pub struct Refuse(pub &'static str);

impl Chooser for Refuse {
    fn choose(&mut self, at: &At<'_, f64>, _: &Dist, _: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let path = at.path();
        let message = format!("there is no value for the choice `{path}`");
        Err(Fault::new("missing-choice", message).about(path).with_help(self.0))
    }
}

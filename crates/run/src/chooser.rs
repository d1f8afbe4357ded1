//! How a choice gets its value, in one place for every algorithm.
//!
//! A chooser answers a choice with a value and with two log densities of it: under the choice's own distribution, `p`,
//! and under the one that the value was drawn from, `q`. An algorithm that draws from `q` and wants `p` weighs by
//!
//! ```text
//! log p(x) - log q(x)        summed over the choices of a run
//! ```
//!
//! [`Prior`] draws from `p` itself, [`Known`] uses given values, `ByProposal` (in `niwaki-propose`) draws from a
//! user's proposal or a guide; the last two pass other choices to another chooser. A chooser may look at the scene so far ([`Context`]).

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
    /// Its log density under the choice's own distribution, nats.
    pub log_prior: f64,
    /// Its log density under the distribution that it was drawn from, nats; 0 for a given value.
    pub log_drawn: f64,
}

impl Chosen {
    /// A value from the prior with its log density, nats.
    #[inline(always)]
    pub fn from_prior(value: impl Into<Value>, log: f64) -> Chosen {
        Chosen { value: value.into(), log_prior: log, log_drawn: log }
    }

    /// A given value.
    ///
    /// # Errors
    /// A value that no distribution can draw.
    pub fn given(value: Value, dist: &Dist) -> Result<Chosen, Fault> {
        Ok(Chosen { log_prior: log_density(dist, &value)?, value, log_drawn: 0.0 })
    }
}

/// What a chooser may use beside the choice.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// The address of the choice.
    pub address: u128,
    /// The sketches of the scene so far. `None` for a task without sketches, and where they are not up to date at this
    /// choice (a run that is followed again, a Markov chain).
    pub sketches: Option<&'a Sketches>,
    /// How many primitives the scene has.
    pub primitives: usize,
    /// The part that was emitted last on the call path, where the run itself does not note it (a Markov chain).
    pub part: Option<Aabb>,
}

impl Context<'_> {
    /// That of a choice without a scene.
    #[inline(always)]
    pub fn of(at: &At<'_, f64>) -> Self {
        Context { address: at.address(), sketches: None, primitives: 0, part: None }
    }
}

/// Gives choices their values.
pub trait Chooser {
    /// Whether every value is drawn from the choice's own distribution, so that all weights are zero.
    const IS_PRIOR: bool = false;

    /// Whether it looks at the scene, so that windows and the last parts must be kept.
    fn looks(&self) -> bool {
        false
    }

    /// A value for the choice; `None` where the run is to pause before it.
    ///
    /// # Errors
    /// A fault ends the run.
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault>;

    /// The same value, where its densities are not needed and there is no scene.
    ///
    /// # Errors
    /// As for [`Chooser::choose`].
    #[inline]
    fn draw(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Option<Value>, Fault> {
        Ok(self.choose(at, dist, Context::of(at))?.map(|chosen| chosen.value))
    }
}

impl<C: Chooser> Chooser for &mut C {
    const IS_PRIOR: bool = C::IS_PRIOR;

    fn looks(&self) -> bool {
        (**self).looks()
    }

    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        (**self).choose(at, dist, seen)
    }
}

/// From the choice's own distribution, with the random bits of this stream at the choice's address.
#[derive(Clone, Copy)]
pub struct Prior(pub StreamKey);

impl Chooser for Prior {
    const IS_PRIOR: bool = true;

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

/// Values by address, where some are known; else another chooser.
pub struct Known<'a, C> {
    /// The values.
    pub values: Option<&'a HashMap<u128, Value>>,
    /// The chooser of all other choices.
    pub otherwise: C,
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
            None => self.otherwise.choose(at, dist, seen),
        }
    }

    #[inline]
    fn draw(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Option<Value>, Fault> {
        match self.find(at.address()) {
            Some(value) => Ok(Some(value.clone())),
            None => self.otherwise.draw(at, dist),
        }
    }
}

/// No values: any choice is a fault, with this help.
pub struct Refuse(pub &'static str);

impl Chooser for Refuse {
    fn choose(&mut self, at: &At<'_, f64>, _: &Dist, _: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let path = at.path();
        let message = format!("there is no value for the choice `{path}`");
        Err(Fault::new("missing-choice", message).about(path).with_help(self.0))
    }
}

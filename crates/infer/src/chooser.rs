//! How a choice gets its value, in one place for every algorithm.
//!
//! A chooser answers a choice with a value and with two log densities of it: under the choice's own distribution, `p`,
//! and under the one that the value was drawn from, `q`. An algorithm that draws from `q` and wants `p` weighs by
//!
//! ```text
//! log p(x) - log q(x)        summed over the choices of a run
//! ```
//!
//! [`Prior`] draws from `p` itself, [`Known`] uses given values, [`Guided`] draws from a user's [`Proposal`]; the
//! last two pass other choices to another chooser. A chooser may look at the scene so far ([`Context`]).

use crate::chain::glob::{last, matches};
use crate::chain::kernel::{Kernel, Selection};
use crate::chain::leaf::Proposer;
use crate::chain::select::{labels, no_choice};
use crate::chain::user::User;
use crate::record::log_density;
use niwaki_geom::sketch::product::Sketches;
use niwaki_math::{Dist, StreamKey};
use niwaki_vm::builtins::draw_to_value;
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::value::{Value, repr};
use std::collections::HashMap;
use std::sync::Arc;

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
}

impl Context<'_> {
    /// That of a choice without a scene.
    #[inline(always)]
    pub fn of(at: &At<'_, f64>) -> Self {
        Context { address: at.address(), sketches: None }
    }
}

/// Gives choices their values.
pub trait Chooser {
    /// Whether every value is drawn from the choice's own distribution, so that all weights are zero.
    const IS_PRIOR: bool = false;

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
        Ok(Some(Chosen { value: draw_to_value(draw), log_prior: log, log_drawn: log }))
    }

    #[inline(always)]
    fn draw(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Option<Value>, Fault> {
        Ok(Some(draw_to_value(dist.sample(&mut self.0.at(at.address())))))
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

/// From a user's proposal, at the choices that it is for; else another chooser.
pub struct Guided<'a, C> {
    /// The proposal.
    pub proposal: &'a Proposal,
    /// The stream of its random bits.
    pub stream: StreamKey,
    /// The chooser of all other choices.
    pub otherwise: C,
}

impl<C: Chooser> Chooser for Guided<'_, C> {
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let Some(own) = self.proposal.dist(at, dist)? else {
            return self.otherwise.choose(at, dist, seen);
        };
        let (draw, log_drawn) = own.sample_and_score(&mut self.stream.at(seen.address));
        Ok(Some(Chosen { log_drawn, ..Chosen::given(draw_to_value(draw), dist)? }))
    }
}

/// A user's proposals for the choices of a run that begins: of those whose patterns match a choice's address the first.
#[derive(Clone, Debug)]
pub struct Proposal {
    parts: Vec<(Selection, Arc<User>)>,
}

impl Proposal {
    /// The proposals of a kernel that consists of `proposal`, of `on` around it, and of `cycle` around those.
    ///
    /// # Errors
    /// Any other kernel; a function that needs the value before, which a new run does not have.
    pub fn of(kernel: &Kernel) -> Result<Proposal, Fault> {
        let mut proposal = Proposal { parts: vec![] };
        proposal.add(kernel, &Selection::default())?;
        Ok(proposal)
    }

    fn add(&mut self, kernel: &Kernel, selection: &Selection) -> Result<(), Fault> {
        match kernel {
            Kernel::Leaf(Proposer::Proposal(user)) if user.needs_old() => Err(Fault::new(
                "bad-proposal",
                format!(
                    "the proposal `{}` asks for `old`, the value before, which a new run has not",
                    user.name()
                ),
            )
            .with_help("name variables of the model instead, or nothing; `old` is for `mh`")),
            Kernel::Leaf(Proposer::Proposal(user)) => {
                self.parts.push((selection.clone(), user.clone()));
                Ok(())
            }
            Kernel::On(own, inner) if own.is_by_pattern() => self.add(inner, &selection.and(own)),
            Kernel::Cycle(parts) => parts.iter().try_for_each(|part| self.add(part, selection)),
            _ => Err(Fault::new("bad-proposal", "a run that begins cannot be proposed by this kernel")
                .with_help("use `proposal(function)`, `on(pattern, ...)` around it, or a `cycle` of those")),
        }
    }

    /// Refuses a pattern that no choice of the program can match.
    ///
    /// # Errors
    /// Such a pattern, with those that are nearest.
    pub fn check(&self, program: &Program) -> Result<(), Fault> {
        let labels = labels(program);
        let patterns = self.parts.iter().flat_map(|(selection, _)| selection.sites.iter().flatten());
        for pattern in patterns.filter(|pattern| !pattern.contains("**")) {
            if !labels.iter().any(|label| matches(last(pattern), label)) {
                return Err(no_choice(pattern, &labels));
            }
        }
        Ok(())
    }

    /// Whether a pattern uses more of an address than its last component; futures must then remember their origin.
    pub fn needs_origins(&self) -> bool {
        self.parts.iter().any(|(selection, _)| selection.sites.iter().flatten().any(|p| is_deep(p)))
    }

    /// The log density with which it draws that value at a choice, nats; `None` where the prior draws.
    ///
    /// # Errors
    /// A fault of the proposal; a value that it never draws.
    pub fn log_drawn(&self, at: &At<'_, f64>, dist: &Dist, value: &Value) -> Result<Option<f64>, Fault> {
        let Some(own) = self.dist(at, dist)? else { return Ok(None) };
        let log = log_density(&own, value)?;
        if log == f64::NEG_INFINITY {
            let message =
                format!("the proposal of the choice `{}` never draws the value {}", at.path(), repr(value)?);
            return Err(Fault::new("proposal-support", message).with_help(WIDER));
        }
        Ok(Some(log))
    }

    /// The distribution that it proposes for a choice; `None` where it has none, or there is only one value.
    fn dist(&self, at: &At<'_, f64>, dist: &Dist) -> Result<Option<Arc<Dist>>, Fault> {
        if matches!(dist, Dist::Delta(_)) {
            return Ok(None);
        }
        let Some((_, user)) = self.parts.iter().find(|(selection, _)| takes(selection, at)) else {
            return Ok(None);
        };
        let own = user.dist(at, None)?;
        let (name, site, family) = (user.name(), at.path(), dist.family());
        if !own.compares_with(dist) {
            let message = format!(
                "the proposal `{name}` draws from `{}` for the choice `{site}`, which draws from `{family}`: values of \
                 another kind",
                own.family()
            );
            return Err(Fault::new("proposal-kind", message)
                .with_help("propose values of the kind that the choice's own distribution draws"));
        }
        if let Some(missing) = own.lacks(dist) {
            let message = format!(
                "the proposal `{name}` of the choice `{site}` never draws {missing}, which its `{family}` does"
            );
            return Err(Fault::new("proposal-support", message).with_help(WIDER));
        }
        Ok(Some(own))
    }
}

/// The help for a proposal that leaves values out.
const WIDER: &str = "propose from a distribution that reaches all values of the choice's own";

/// Whether a pattern uses more of an address than its last component.
fn is_deep(pattern: &str) -> bool {
    pattern.contains('/') || pattern.contains("**")
}

/// Whether a selection by patterns takes the choice. The whole address is built only where a pattern needs it.
fn takes(selection: &Selection, at: &At<'_, f64>) -> bool {
    let mut path = None;
    selection.sites.iter().all(|patterns| {
        patterns.iter().any(|pattern| {
            if is_deep(pattern) {
                matches(pattern, path.get_or_insert_with(|| at.path()))
            } else {
                matches(pattern, &at.site.label)
            }
        })
    })
}

//! The most frequent questions of a run: choices and factors. All other sites are in `suspend`.
//!
//! Each question is one call from the loop over instructions, with all that it needs inlined. Inlined into the
//! loop itself, questions are no faster and slow down every other instruction.

use super::Machine;
use super::address::join;
use super::answers::{Answer, Answers, At, Factor};
use super::budget;
use super::keep::Dropped;
use super::outcome::Halt;
use super::registers::Registers;
use super::state::{NodeId, State};
use crate::builtins::{make_dist, quick_dist};
use crate::code::{Args, Site, SiteKind, Source};
use crate::fault::Fault;
use crate::value::{Value, index, log_density, ops};
use niwaki_math::{Dist, Family, Scalar};

/// Bytes of a choice in a log: its address and value, and a share of the blocks that store them.
pub(super) const LOGGED: usize = 36;

#[cold]
fn no_dist<S: Scalar>(value: &Value<S>) -> Fault {
    Fault::new("not-a-distribution", format!("expected a distribution, found {}", value.described()))
}

#[cold]
fn no_number<S: Scalar>(value: &Value<S>) -> Fault {
    Fault::new("type-mismatch", format!("expected a number, found {}", value.described()))
}

/// The distribution in a value.
#[inline(always)]
pub(super) fn as_dist<S: Scalar>(value: &Value<S>) -> Result<&Dist<S>, Fault> {
    match value {
        Value::Dist(dist) => Ok(dist),
        other => Err(no_dist(other)),
    }
}

/// A real number for `factor`.
#[inline(always)]
pub(super) fn as_real<S: Scalar>(value: &Value<S>) -> Result<S, Fault> {
    match value {
        Value::Real(x) => Ok(*x),
        Value::Int(i) => Ok(S::from_f64(*i as f64)),
        Value::Bool(b) => Ok(S::from_f64(f64::from(u8::from(*b)))),
        other => Err(no_number(other)),
    }
}

impl<S: Scalar> Machine<'_, S> {
    /// Builds a distribution of a known family from its parameters.
    #[inline(always)]
    fn dist_of_family(
        &mut self,
        state: &State<S>,
        r: Registers<'_, S>,
        args: Args,
        family: Family,
    ) -> Result<Dist<S>, Fault> {
        let quick = match r.f.operands[args.range()] {
            [a, b] => {
                let a = r.get(state, &self.scratch, a);
                quick_dist(family, a, r.get(state, &self.scratch, b))
            }
            _ => None,
        };
        match quick {
            Some(dist) => Ok(dist),
            None => {
                r.gather(state, &self.scratch, args, &mut self.buffer);
                make_dist(family, &self.buffer)
            }
        }
    }

    /// The distribution of a choice or observation: from a register, or built from the parameters `args`.
    #[inline(always)]
    pub(super) fn dist<'b>(
        &'b mut self,
        state: &'b State<S>,
        r: Registers<'b, S>,
        site: &Site,
        args: Args,
        built: &'b mut Option<Dist<S>>,
    ) -> Result<&'b Dist<S>, Fault> {
        macro_rules! get {
            ($i:expr) => {
                r.get(state, &self.scratch, r.f.operands[args.start as usize + $i])
            };
        }
        let source = match site.kind {
            SiteKind::Sample(source) | SiteKind::Observe(source) => source,
            _ => Source::Value,
        };
        match source {
            Source::Value => as_dist(get!(0)),
            Source::Family(family) => {
                if let [only] = r.f.operands[args.range()]
                    && let Some(index) = self.cache.index(r.get(state, &self.scratch, only))
                {
                    let value = r.get(state, &self.scratch, only);
                    if self.cache.holds(index, family, value) {
                        return Ok(self.cache.at(index));
                    }
                    if self.cache.is_room_for(value) {
                        return self.cache.build(index, family, value);
                    }
                }
                Ok(built.insert(self.dist_of_family(state, r, args, family)?))
            }
            Source::Element => match index::index_ref(get!(0), get!(1)) {
                Some(value) => as_dist(value),
                None => Ok(built.insert(as_dist(&index::index(get!(0), get!(1))?)?.clone())),
            },
        }
    }

    /// Runs a random choice: gets its value and stores it in its register.
    #[inline(never)]
    pub(super) fn choose<A: Answers<S>>(
        &mut self,
        state: &mut State<S>,
        answers: &mut A,
        r: Registers<'_, S>,
        node: NodeId,
        site: &Site,
    ) -> Result<(), Halt> {
        let args = site.parameters();
        if let SiteKind::Sample(Source::Family(family)) = site.kind {
            self.charge_rows(state, &Dropped, r, args, family)?;
        }
        let (program, mut built) = (self.program, None);
        let held = self.held;
        let dist = self.dist(state, r, site, args, &mut built)?;
        if let Some(held) = held
            && let Some((number, value)) = held.find(join(state.nodes[node.0 as usize].path, site.key))
        {
            let at = At { site, function: r.f, node, state, program };
            let value = at.own_value(value)?;
            let log = log_density(dist, &value)?;
            if A::WATCHES {
                answers.observes(&at, dist);
            }
            let answer = answers.held(&at, dist, &value, log)?;
            state.unmet.remove(number);
            state.registers[r.base + site.to.index()].store(value.into_owned());
            return if answer == Answer::Pause { Err(Halt::PausedAfter) } else { Ok(()) };
        }
        match answers.choice(&At { site, function: r.f, node, state, program }, dist)? {
            Answer::Go(value) => {
                if A::LOGS {
                    state.logged += LOGGED;
                }
                if !value.is_plain() {
                    self.charge_choice::<A>(state, &value)?;
                }
                state.registers[r.base + site.to.index()].store(value);
                Ok(())
            }
            Answer::Pause => Err(Halt::Paused),
        }
    }

    /// Charges a chosen value that takes memory, with its entry in the log.
    #[inline(never)]
    fn charge_choice<A: Answers<S>>(&self, state: &mut State<S>, value: &Value<S>) -> Result<(), Fault> {
        let bytes = budget::of_result(value);
        if A::LOGS {
            state.logged += bytes;
        } else {
            state.charged += bytes;
        }
        self.afford(state, &Dropped)
    }

    /// Leaves an activation: a held choice in it that was not met never will be.
    #[inline(always)]
    pub(super) fn leave<A: Answers<S>>(&self, state: &State<S>, answers: &mut A, node: NodeId) {
        if let Some(held) = self.held
            && let Some(number) =
                held.first_lost(state.nodes[node.0 as usize].path, &state.unmet, state.depth_first)
        {
            answers.unmet(held.name(number));
        }
    }

    /// Reports a factor.
    #[inline(never)]
    pub(super) fn factor<A: Answers<S>>(
        &mut self,
        state: &mut State<S>,
        answers: &mut A,
        r: Registers<'_, S>,
        node: NodeId,
        site: &Site,
    ) -> Result<(), Halt> {
        let last = site.args.len as usize - 1;
        macro_rules! get {
            ($i:expr) => {
                r.get(state, &self.scratch, r.f.operands[site.args.start as usize + $i])
            };
        }
        let (factor, log) = match site.kind {
            SiteKind::Factor => (Factor::Factor, as_real(get!(last))?),
            SiteKind::Condition => {
                let log = if ops::truth(get!(last))? { 0.0 } else { f64::NEG_INFINITY };
                (Factor::Condition, S::from_f64(log))
            }
            _ => {
                // The result of `observe` is the observed value, so that an observation can replace a choice.
                let value = get!(last).clone();
                let mut built = None;
                let args = site.parameters();
                if let SiteKind::Observe(Source::Family(family)) = site.kind {
                    self.charge_rows(state, &Dropped, r, args, family)?;
                }
                let program = self.program;
                let dist = self.dist(state, r, site, args, &mut built)?;
                if A::WATCHES {
                    answers.observes(&At { site, function: r.f, node, state, program }, dist);
                }
                let log = log_density(dist, &value)?;
                if site.is_read {
                    state.registers[r.base + site.to.index()].store(value);
                }
                (Factor::Observe, log)
            }
        };
        match answers.score(&At { site, function: r.f, node, state, program: self.program }, factor, log)? {
            Answer::Go(()) => Ok(()),
            Answer::Pause => Err(Halt::Paused),
        }
    }
}

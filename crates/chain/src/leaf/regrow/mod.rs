//! Regrowth: conditional SMC grows a part of the run again in place, and holds everything else.
//!
//! Regrowth is particle Gibbs of a block: the block `B` has the choices of the part, `R` all other choices. Particles grow the part
//! from its inputs, in a scene that already has all parts of `R`. One particle holds the present values, under a redrawn order
//! of its futures. A particle is drawn by weight, and its values replace those of the part. This leaves
//! `p(B | R)` invariant for any number of particles (Andrieu, Doucet & Holenstein 2010, section 4.5).
//!
//! * `pick`: the choice of the part. The pick is an auxiliary variable: its probability in each particle's run multiplies the last
//!   weight of the particle.
//! * [`afresh()`]: regrowth of a named part by particles without the present values;
//! * Values come from their priors, or from a proposal: a user's or a guide. The weights count prior over proposal then,
//!   also those of the particle that holds the present values.
//! * Particles are compared in the scene around the part, and a guide sees it; it must be the same on the way back. So a
//!   particle whose result moves shapes outside of the part has weight zero: the posterior is invariant within the runs that
//!   share that scene.
//! * `reach`: whether a chain of such moves alone reaches every run; `sweep`: SMC of a part; `turn`: other values of a discrete choice.
//! * If a part returns a different value, the run outside of the part is evaluated again: the change of the densities of held
//!   choices and of the score multiplies the weight. A run whose choices outside of the part are not exactly `R` has weight zero.
//! * *Turn and regrow*: a discrete choice of the part's own activation gets another value `v'`, drawn from `g(v' | v)`.
//!   Conditional SMC with the old value estimates the normalising constant `Z`, free SMC with the new one estimates `Z'`,
//!   and the probabilities of the pick, of the choice and of `g` are in both. The new part is kept with probability
//!   `min(1, Z' / Z)`, else one is drawn from the conditional particles: a step of particle marginal
//!   Metropolis-Hastings after one of particle Gibbs.

mod afresh;
mod pick;
mod reach;
mod sweep;
mod turn;

pub use afresh::{Afresh, afresh};
pub use pick::Pick;
pub use reach::is_apart;

use crate::walk::Walk;
use crate::walk::accept::{Decision, accepts};
use crate::walk::state::State;
use crate::walk::{ChainMove, Proposing};
use niwaki_geom::sketch::product::Sketches;
use niwaki_math::{RngCore, Stream, Total};
use niwaki_propose::proposal::Proposal;
use niwaki_run::fresh::Fresh;
use niwaki_run::select::Selection;
use niwaki_run::setting::{Ranges, SHARE, whole};
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::kept::part::{Part, Piece};
use niwaki_vm::machine::kept::{Change, Trace};
use niwaki_vm::value::{Value, identical};
use pick::Picked;
use serde::Deserialize;
use std::collections::HashMap;
use std::sync::Arc;
use sweep::{Block, Grown, Set};

/// A regrowth move.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Regrow {
    /// The number of particles, including the particle with the present values.
    particles: usize,
    /// The probability of turning a discrete choice of the part, if it has one.
    turn: f64,
    /// The rule that picks the part.
    pick: Pick,
    /// Whether the move keeps the best of fresh particles if it is better: an optimising move, which leaves no distribution
    /// invariant.
    #[serde(default)]
    best: bool,
    /// The proposal that draws values in place of the prior.
    #[serde(skip)]
    proposal: Option<Arc<Proposal>>,
    /// The selection of choices that may change.
    #[serde(skip)]
    selection: Selection,
}

impl Regrow {
    /// An optimising move of the activations whose paths have these hashes. No choice is turned.
    pub fn best_of(paths: Vec<u128>, particles: usize, proposal: Option<Arc<Proposal>>) -> Regrow {
        let (pick, selection) = (Pick::Paths(paths), Selection::default());
        Regrow { particles, turn: 0.0, pick, best: true, proposal, selection }
    }

    /// Ranges of its settings.
    pub(crate) const RANGES: Ranges = &[("particles", whole(2)), ("turn", SHARE)];

    /// Set the proposal that draws the values of the particles.
    pub(crate) fn draw_by(&mut self, proposal: Arc<Proposal>) {
        self.proposal = Some(proposal);
    }

    /// Whether the move uses the scene.
    pub(crate) fn looks(&self) -> bool {
        self.proposal.as_ref().is_some_and(|proposal| proposal.looks())
    }

    /// Whether addresses of a part must be readable from the root.
    fn needs_paths(&self) -> bool {
        !self.selection.is_all() || self.proposal.as_ref().is_some_and(|proposal| proposal.needs_origins())
    }

    /// Set the selection of choices that may change.
    ///
    /// # Errors
    /// Selection weights.
    pub(crate) fn prepare(&mut self, selection: &Selection) -> Result<(), Failure> {
        if !selection.is_by_pattern() {
            return Err(Fault::new("bad-kernel", "`regrow` has no selection weights")
                .with_help("put it under `on` with patterns, not under `weighted`")
                .into());
        }
        self.selection = selection.clone();
        Ok(())
    }
}

/// A choice that is turned: its address, its value, and the new one.
struct Turned {
    address: u128,
    old: Value,
    new: Value,
}

/// The choices of a part.
struct Contents {
    /// The choices that may change: address and value.
    held: HashMap<u128, Value>,
    /// The choices that may not change.
    rest: HashMap<u128, Value>,
    /// The numbers of the choices that may change.
    numbers: Vec<usize>,
}

impl Contents {
    /// The choices of a part of a run, and the sketches of the scene without the part. `None` if that scene is impossible, so that no
    /// particle can start.
    fn of(
        state: &State,
        program: &Program,
        part: Part,
        is_selected: &dyn Fn(usize) -> bool,
    ) -> Option<(Contents, Sketches)> {
        let trace = &state.trace;
        let mut contents = Contents { held: HashMap::new(), rest: HashMap::new(), numbers: vec![] };
        let mut removed = vec![];
        trace.all_pieces(program, part, |piece| match piece {
            Piece::Choice(n) => {
                let (address, value) = (trace.address(program, n), trace.choice(program, n).0.clone());
                if is_selected(n) {
                    contents.numbers.push(n);
                    contents.held.insert(address, value);
                } else {
                    contents.rest.insert(address, value);
                }
            }
            Piece::Emit(primitive) => removed.push(primitive),
            Piece::Part(_) | Piece::Held(_) => {}
        });
        let mut sketches = state.sketches.fork();
        if !removed.is_empty() {
            let kept = sketches.exchange(removed.iter().copied(), std::iter::empty());
            debug_assert!(kept, "the sketches and the trace hold the same scene");
        }
        sketches.forbidden_by().is_none().then_some((contents, sketches))
    }
}

/// Calls of memoised functions are shared by the parts of a run, so none of these can be run apart.
///
/// # Errors
/// The program has memoised functions.
fn refuse_memoised(program: &Program) -> Result<(), Failure> {
    if !program.memoises() {
        return Ok(());
    }
    let problem = "the parts of a model with memoised functions cannot be grown again";
    Err(Fault::new("memo-regrow", problem).into())
}

impl ChainMove for Regrow {
    fn apply(&mut self, proposing: Proposing<'_, '_>) -> Result<(), Failure> {
        let Proposing { chain, task, machine, table, beta } = proposing;
        let (kernel, visit, program) = (&*self, chain.visit, &*task.program);
        chain.visit += 1;
        refuse_memoised(program)?;
        let mut rng = chain.streams.decisions(visit);
        let trace = &chain.state.trace;
        let is_selected = |choice: usize| table.is_none_or(|t| chain.tables[t].weight(choice) > 0);
        let Some(picked) = kernel.pick.draw(trace, program, &is_selected, &mut rng) else {
            return Ok(());
        };
        let Some((Contents { held, rest, numbers }, sketches)) =
            Contents::of(&chain.state, program, picked.part, &is_selected)
        else {
            return Ok(());
        };
        let moves = chain.streams.moves(visit);
        let seed = |purpose: u128| moves.at(purpose).next_u64();
        let mut start = trace.start_part(program, picked.part, kernel.needs_paths());
        if kernel.looks() {
            trace.note_parts(program, picked.part, &mut start);
        }
        let block = Block {
            task,
            start,
            path: trace.part_path(picked.part),
            sketches,
            held: &held,
            rest: &rest,
            selection: &kernel.selection,
            proposal: kernel.proposal.as_deref(),
            beta,
            particles: kernel.particles,
        };
        let is_turned = rng.uniform() < kernel.turn;
        let turned = if is_turned { block.turned(machine, &mut rng)? } else { None };
        if kernel.best {
            let set = block.free(machine, turned.as_ref(), seed(1))?;
            chain.grown += set.steps;
            return chain.keep_best(machine, &block, &set, &numbers, &mut rng);
        }
        let mut set = block.conditional(machine, turned.as_ref(), seed(0))?;
        let held_result = set.grown[0].result();
        chain.grown += set.steps;
        let emits = Some(chain.state.trace.emits_of(program, picked.part));
        let weighing = Weighing { task, kernel, picked: &picked, block: &block, numbers: &numbers, emits };
        chain.weigh_last(machine, &weighing, &mut set, None)?;
        debug_assert!(set.log_mean > f64::NEG_INFINITY, "the present values are possible");
        let mut log_ratio = 0.0;
        if let Some(turned) = &turned {
            let mut other = block.free(machine, Some(turned), seed(1))?;
            chain.grown += other.steps;
            chain.weigh_last(machine, &weighing, &mut other, Some((&set.grown[0], held_result)))?;
            log_ratio = other.log_mean - set.log_mean;
            if accepts(log_ratio, &mut rng) {
                set = other;
            }
        }
        let values = set.grown[set.weights.index(rng.uniform())].values(&block);
        let is_same = values.len() == held.len()
            && values
                .iter()
                .all(|(address, value)| held.get(address).is_some_and(|old| identical(old, value)));
        chain.last = Decision { is_same, accepted: !is_same, log_ratio };
        chain.count_many(chain.last);
        if is_same {
            return Ok(());
        }
        if chain.replace(task, machine, &numbers, &values)? == Change::Done {
            chain.show(program)?;
            chain.keep(program, held);
        } else {
            debug_assert!(false, "a particle that was drawn is possible");
            chain.state.trace.rollback(program);
        }
        Ok(())
    }
}

/// The inputs of the last weights of the particles.
struct Weighing<'a> {
    task: &'a Task,
    kernel: &'a Regrow,
    picked: &'a Picked,
    block: &'a Block<'a>,
    /// The numbers of the part's choices that may change.
    numbers: &'a [usize],
    /// The numbers of the primitives of the part, ascending; `None` if it may move shapes around it, as in an optimising move.
    emits: Option<Vec<u32>>,
}

impl Weighing<'_> {
    /// Whether the open transaction leaves the scene around the part as it is. Particles are compared, and drawn by what a
    /// guide sees, in that scene: a kernel that changed it would have to come back by another one, and would be biased.
    fn keeps_scene(&self, trace: &Trace) -> bool {
        let Some(before) = &self.emits else { return true };
        let (removed, added) = trace.exchanged();
        let inside =
            |numbers: &[u32], all: &[u32]| numbers.iter().all(|number| all.binary_search(number).is_ok());
        inside(removed, before)
            && (added.is_empty() || inside(added, &trace.emits_of(&self.task.program, self.picked.part)))
    }
}

impl Walk {
    /// Open a transaction that gives choices of a part the values of a particle.
    fn replace(
        &mut self,
        task: &Task,
        machine: &mut Machine<'_>,
        numbers: &[usize],
        values: &HashMap<u128, Value>,
    ) -> Result<Change, Failure> {
        let mut answers = Fresh::of(self.streams.fresh(self.visit), Some(values), &*task.hosts);
        match machine.redraw(&mut self.state.trace, numbers, self.strategy, &mut answers) {
            Ok(change) => Ok(change),
            Err(met) => self.give_up(task, met),
        }
    }

    /// Replace a part by the best of fresh particles if the score is higher; otherwise with the probability that the power of the score
    /// gives to a lower score.
    fn keep_best(
        &mut self,
        machine: &mut Machine<'_>,
        block: &Block<'_>,
        set: &Set,
        numbers: &[usize],
        rng: &mut Stream,
    ) -> Result<(), Failure> {
        let (task, program) = (block.task, &*block.task.program);
        let Some(values) = set.best(block) else { return Ok(()) };
        let change = self.replace(task, machine, numbers, &values)?;
        if change == Change::Impossible {
            self.state.trace.rollback(program);
            return Ok(());
        }
        self.show(program)?;
        let mut gain = self.state.trace.change().log_factors.clone();
        if let Some(sketches) = self.state.sketch_change() {
            gain.add_total(&sketches);
        }
        let is_possible = !self.state.trace.change().is_impossible() && !gain.is_impossible();
        let log_ratio = block.beta * gain.value();
        let accepted = is_possible && accepts(log_ratio, rng);
        self.last = Decision { is_same: false, accepted, log_ratio };
        self.count_many(self.last);
        if accepted {
            self.keep(program, block.held.clone());
        } else {
            self.state.restore_sketches();
            self.state.trace.rollback(program);
        }
        Ok(())
    }

    /// The last weights of a set: the probability of the pick, and what the rest of the run says to what a part returns.
    /// A set without present values is compared with the particle that has them, and what that returned.
    fn weigh_last(
        &mut self,
        machine: &mut Machine<'_>,
        with: &Weighing<'_>,
        set: &mut Set,
        present: Option<(&Grown, Value)>,
    ) -> Result<(), Failure> {
        let (first, returned) = present.unwrap_or_else(|| (&set.grown[0], set.grown[0].result()));
        let (score, is_turned) = (first.particle.record.score(), first.seen.log_turn.is_some());
        let barriers = first.barriers;
        let mut logs = Vec::with_capacity(set.grown.len());
        for grown in &set.grown {
            let mut log = grown.particle.log_weight;
            if grown.is_complete(with.block, is_turned) && log > f64::NEG_INFINITY {
                log +=
                    with.picked.log_probability(&grown.seen) + turn::log_form(with.kernel.turn, &grown.seen);
            } else {
                log = f64::NEG_INFINITY;
            }
            if log > f64::NEG_INFINITY && !identical(&grown.result(), &returned) {
                log += self.answer(machine, with, grown, &score)?;
            } else if self.barriers.is_some() && grown.barriers != barriers {
                log = f64::NEG_INFINITY;
            }
            logs.push(log);
        }
        set.close(&logs);
        Ok(())
    }

    /// Add the contribution of the rest of the run to the log weight of a particle that returned another value: the change
    /// of the densities of held choices and of the score, beyond that of the part itself. `score` is that of the part with
    /// the present values.
    fn answer(
        &mut self,
        machine: &mut Machine<'_>,
        with: &Weighing<'_>,
        grown: &Grown,
        score: &Total,
    ) -> Result<f64, Failure> {
        let (block, values) = (with.block, grown.values(with.block));
        let change = self.replace(with.task, machine, with.numbers, &values)?;
        let program = &*with.task.program;
        if change == Change::Impossible {
            self.state.trace.rollback(program);
            return Ok(f64::NEG_INFINITY);
        }
        self.show(program)?;
        let trace = &self.state.trace;
        let changed = trace.change();
        // The choices of the rest are the same ones, and none was drawn.
        let is_own = |address: &u128| values.contains_key(address) || block.held.contains_key(address);
        let keeps_rest = trace.births(program).all(|place| is_own(&place.address()))
            && trace.deaths().iter().all(|dead| is_own(&trace.address(program, *dead as usize)))
            && trace.drawn_anew().iter().all(|(address, old)| {
                // The one value of a delta is drawn again whenever its activation runs.
                let now = || trace.numbers().find(|n| trace.address(program, *n) == *address);
                is_own(address) || now().is_some_and(|n| identical(trace.choice(program, n).0, old))
            });
        let barriers = self.state.primitives as i64 + trace.totals().factors + changed.factors;
        let fits = self.barriers.is_none_or(|n| barriers == n as i64);
        let mut log = f64::NEG_INFINITY;
        if keeps_rest && fits && with.keeps_scene(trace) && !changed.is_impossible() {
            let (fresh, stale) = trace.fresh_and_stale();
            let mut prior = changed.log_prior.less(fresh);
            prior.add_total(stale);
            let mut more = changed.log_factors.less(&grown.particle.record.score());
            more.add_total(score);
            if let Some(sketches) = self.state.sketch_change() {
                more.add_total(&sketches);
            }
            let scored = if block.beta == 0.0 { 0.0 } else { block.beta * more.value() };
            log = prior.value() + scored;
        }
        self.state.restore_sketches();
        self.state.trace.rollback(program);
        Ok(if log.is_nan() { f64::NEG_INFINITY } else { log })
    }
}

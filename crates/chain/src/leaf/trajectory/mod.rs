//! Trajectories: the continuous choices of a trace move together along their gradient, within a chain whose other kernels
//! move the discrete ones (dissertation 7.1).
//!
//! One transition, of fixed length or without a U-turn, in the coordinates of [`niwaki_grad::coordinates`]:
//!
//! 1. the trace's structure (which choices there are, and the values of the discrete ones) has a graph of its density,
//!    which is recorded where it is new: `structures`;
//! 2. a Hamiltonian transition goes from `x` to `x'`, with one step and one set of scales for all structures: `scales`;
//! 3. the values at `x'` are written as one block, through the same transaction as every other proposal, so that scores,
//!    scene and queries stay exact.
//!
//! The second step leaves the recorded density `g` invariant. So it is a proposal that is reversible under `g`, and the
//! transaction is kept with probability `min(1, p(x') g(x) / (p(x) g(x')))`, where `p` is the density of the trace
//! itself. This is 1 up to rounding, as the two are the same density (Liu 2001, section 9.4.3, calls a `g` that is not
//! `p` a surrogate). A trajectory that reaches another structure, a density of zero or a NaN is rejected, and counted.

pub mod counts;
pub(crate) mod scales;
pub(crate) mod structures;

use crate::walk::Walk;
use crate::walk::accept::Decision;
use crate::walk::{ChainMove, Proposing};
use counts::TrajectoryCounts;
use niwaki_continuous::hamiltonian::chains::{Length, MAX_ENERGY_ERROR};
use niwaki_continuous::hamiltonian::step_size::first_guess;
use niwaki_continuous::hamiltonian::{Cause, Kernel};
use niwaki_grad::{Continuous, Model, Transform};
use niwaki_propose::gradient;
use niwaki_propose::gradient::follow::reason;
use niwaki_run::setting::{BETWEEN, POSITIVE, Range, Ranges, SHARE, SMALL_COUNT};
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::kept::{Changed, Proposed};
use scales::Scales;
use serde::{Deserialize, Deserializer, Serialize};
use structures::{Moving, Structures};

/// Trajectories of one leaf of a kernel.
pub struct Trajectory {
    kernel: Kernel,
    scales: Scales,
    structures: Structures,
    model: Option<Model>,
    /// Their counts.
    pub(crate) counts: TrajectoryCounts,
}

/// The adaptation of trajectories, as data.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Learnt {
    scales: scales::Stored,
    counts: TrajectoryCounts,
    /// Structures met, and runs recorded.
    recorded: (u64, u64),
}

/// Ranges of the settings of one of fixed length.
pub(crate) const HMC_RANGES: Ranges =
    &[("steps", SMALL_COUNT), ("step", POSITIVE), ("jitter", SHARE), ("target", BETWEEN)];

/// Ranges of the settings of one without a U-turn.
pub(crate) const NUTS_RANGES: Ranges = &[("max_depth", DOUBLINGS), ("step", POSITIVE), ("target", BETWEEN)];

/// Most doublings of a trajectory without a U-turn.
pub const DOUBLINGS: Range = Range::Whole { least: 1, most: 20 };

/// One of fixed length, from its settings.
pub(crate) fn hmc_step<'de, D: Deserializer<'de>>(from: D) -> Result<Box<Trajectory>, D::Error> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Settings {
        steps: u32,
        jitter: f64,
        step: f64,
        target: f64,
    }
    let Settings { steps, jitter, step, target } = Settings::deserialize(from)?;
    Ok(Box::new(Trajectory::new(Length::Fixed { steps, jitter }, step, target)))
}

/// One without a U-turn, from its settings.
pub(crate) fn nuts_step<'de, D: Deserializer<'de>>(from: D) -> Result<Box<Trajectory>, D::Error> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Settings {
        max_depth: u32,
        step: f64,
        target: f64,
    }
    let Settings { max_depth, step, target } = Settings::deserialize(from)?;
    Ok(Box::new(Trajectory::new(Length::NoUTurn { max_depth }, step, target)))
}

impl Clone for Trajectory {
    /// Copies what was adapted; graphs are recorded anew.
    fn clone(&self) -> Self {
        Trajectory {
            kernel: self.kernel.clone(),
            scales: self.scales.clone(),
            structures: Structures::default(),
            model: self.model.clone(),
            counts: TrajectoryCounts::default(),
        }
    }
}

impl std::fmt::Debug for Trajectory {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Trajectory").field("kernel", &self.kernel).field("counts", &self.counts).finish()
    }
}

impl Trajectory {
    fn new(length: Length, step: f64, target: f64) -> Trajectory {
        Trajectory {
            kernel: length.kernel(MAX_ENERGY_ERROR),
            scales: Scales::new(step, target),
            structures: Structures::default(),
            model: None,
            counts: TrajectoryCounts::default(),
        }
    }

    /// Prepares the recording; once for a task.
    ///
    /// # Errors
    /// Sketches, which have no gradient.
    pub(crate) fn prepare(&mut self, task: &Task) -> Result<(), Failure> {
        if self.model.is_none() {
            self.model = Some(gradient::model(task)?);
        }
        Ok(())
    }

    /// The adaptation and the counts so far, as data.
    pub(crate) fn learnt(&self) -> Learnt {
        let (counts, recorded) = (self.counts.clone(), self.recorded());
        Learnt { scales: self.scales.stored(), counts, recorded }
    }

    /// Restore the adaptation and the counts. Graphs are recorded anew, and count again.
    pub(crate) fn restore(&mut self, learnt: Learnt) {
        self.scales = Scales::restored(learnt.scales);
        self.counts = learnt.counts;
        self.structures.count_from(learnt.recorded);
    }

    /// The step in use.
    pub(crate) fn step(&self) -> f64 {
        self.scales.step(1)
    }

    /// Graphs recorded: structures met, and runs recorded for them.
    pub(crate) fn recorded(&self) -> (u64, u64) {
        self.structures.recorded()
    }
}

impl ChainMove for Trajectory {
    /// One transition of the continuous choices that a table gives weight; all of them, where there is none.
    fn apply(&mut self, proposing: Proposing<'_, '_>) -> Result<(), Failure> {
        let (leaf, Proposing { chain, task, machine, table, beta }) = (self, proposing);
        let (visit, program) = (chain.visit, &*task.program);
        let warming = chain.warming(visit);
        chain.visit += 1;
        chain.last = Decision { is_same: true, accepted: true, log_ratio: 0.0 };
        leaf.prepare(task)?;
        let Some(model) = &leaf.model else { return Ok(()) };
        if warming.is_none() {
            leaf.scales.freeze();
        }
        // The structure, its graph, and the coordinates of the trace.
        let (trace, tables) = (&chain.state.trace, &chain.tables);
        let moves = |choice: usize| table.is_none_or(|t| tables[t].weight(choice) > 0);
        let mut label = |number: usize, choice: &Continuous, place: usize| {
            let site = chain.counts.number(trace.site_of(number));
            let is_plain = matches!(choice.transform, Transform::Line | Transform::Vector);
            let scale = if is_plain { chain.spreads[site] / choice.unit } else { 1.0 };
            leaf.scales.label(site as u32, place as u32, scale)
        };
        leaf.structures.find(model, trace, program, beta, &moves, &mut label)?;
        let Some(Moving { target, labels, numbers }) = leaf.structures.present() else { return Ok(()) };
        if target.is_still() {
            return Ok(());
        }
        chain.last = Decision { is_same: false, accepted: false, log_ratio: f64::NEG_INFINITY };
        let mut last = chain.streams.moves(visit).at(2);
        let mut phase = match target.start_phase(trace, program, numbers, beta, &mut last) {
            Ok(phase) => phase,
            Err(stop) => {
                let fault = || reason(target.live(), &target.all(&[]));
                leaf.counts.refused(stop, warming.is_some(), fault);
                chain.count_many(chain.last);
                return Ok(());
            }
        };
        let (backward, _) = target.values(&phase.x, phase.log_density);

        // From x to x'.
        let (key, dim) = (chain.streams.moves(visit), phase.x.len());
        let metric = leaf.scales.metric(labels);
        if warming.is_some() && leaf.scales.wants_a_guess() {
            let guess = first_guess(target, &metric, &phase, leaf.scales.step(dim), &mut key.at(1));
            leaf.scales.guessed(guess, dim);
        }
        let step = leaf.scales.step(dim);
        let transition = leaf.kernel.step(target, &metric, step, &mut phase, &mut key.at(0));
        if let Some(share) = warming {
            leaf.scales.learn(labels, &phase.gradient, transition.accept, share);
        }
        let faulty =
            transition.divergence.as_ref().filter(|d| d.stop.is_some_and(|s| s.cause == Cause::NotFinite));
        let faulty = faulty.map(|divergence| target.all(&divergence.end));
        leaf.counts.count(&transition, warming.is_some(), || reason(target.live(), &faulty?));
        chain.last.log_ratio = transition.accept.ln();
        // The last point that was evaluated may be on another path than x'.
        let there = if transition.moved { target.log_density(&phase.x).ok() } else { None };
        let Some(log_density) = there else {
            chain.count_many(chain.last);
            return Ok(());
        };

        // The values there, as one block. The first choice carries the whole density of the proposal.
        let (forward, values) = target.values(&phase.x, log_density);
        let noting = chain.best.is_noting();
        let (mut moved, mut changes) = (Vec::new(), Vec::with_capacity(values.len()));
        for (place, value) in values {
            let choice = numbers[place];
            if noting {
                moved.push((trace.address(program, choice), trace.choice(program, choice).0.clone()));
            }
            let (forward, backward) = if changes.is_empty() { (forward, backward) } else { (0.0, 0.0) };
            changes.push(Changed { choice, proposed: Proposed { value, forward, backward } });
        }
        let change = chain.change(task, machine, visit, changes)?;
        let selection = |chain: &Walk| {
            let trace = &chain.state.trace;
            // New draws are not part of the recorded density: the reverse trajectory would not lead back here.
            let anew = trace.drawn_anew().iter().any(|(address, _)| leaf.structures.contains(*address));
            let is_other = trace.births(program).len() > 0 || !trace.deaths().is_empty() || anew;
            if is_other { f64::NEG_INFINITY } else { 0.0 }
        };
        let mut rng = chain.streams.decisions(visit);
        let decision = chain.decide(task, change, beta, &mut rng, selection, moved)?;
        leaf.counts.moved += u64::from(decision.accepted);
        leaf.counts.unwritten += u64::from(!decision.accepted);
        chain.count_many(decision);
        Ok(())
    }
}

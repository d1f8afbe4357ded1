//! SMC of a part, from its inputs to its result. Weights count the score of the scene, which contains everything outside of the part
//! from the start, and the densities of choices that do not change.

use super::{Turned, turn};
use niwaki_geom::sketch::product::Sketches;
use niwaki_math::{Dist, Stream, StreamKey};
use niwaki_propose::guide::bound::Sight;
use niwaki_propose::particle::Particle;
use niwaki_propose::proposal::{ByProposal, Proposal, as_if_drawn};
use niwaki_propose::sweep::{Particles, sweep};
use niwaki_run::chooser::{Chooser, Chosen, Context, Prior};
use niwaki_run::record::Record;
use niwaki_run::resampling::{Resampling, further_copies, pair};
use niwaki_run::select::Selection;
use niwaki_run::streams::Reserved;
use niwaki_run::weights::Normalised;
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::state::State;
use niwaki_vm::value::{Value, identical};
use std::collections::HashMap;

/// The effective sample size, as a share of the particles, below which particles are resampled.
const LOW: f64 = 0.5;

/// A part to grow, with its held choices.
pub(super) struct Block<'a> {
    pub task: &'a Task,
    /// The state of the part before its start.
    pub start: State,
    /// The path of its first activation.
    pub path: u128,
    /// The scene without the part.
    pub sketches: Sketches,
    /// The present values of the choices that may change.
    pub held: &'a HashMap<u128, Value>,
    /// The values of the part's remaining choices.
    pub rest: &'a HashMap<u128, Value>,
    /// The selection of choices that may change.
    pub selection: &'a Selection,
    /// The proposal that draws values in place of the prior.
    pub proposal: Option<&'a Proposal>,
    /// The power of the score.
    pub beta: f64,
    pub particles: usize,
}

/// Counts of the choices of a particle, on which the probability of the pick depends.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    /// The number of choices that may change.
    pub selected: u64,
    /// The number of changeable choices of the part's first activation.
    pub direct: u64,
    /// The number of these choices that have other values.
    pub turnable: u64,
    /// The number of remaining choices.
    rest: usize,
    /// Log probability of turning the turned choice to its value on the other side.
    pub log_turn: Option<f64>,
}

/// A particle of a part.
pub(super) struct Grown {
    pub particle: Particle,
    pub seen: Seen,
    /// The number of pauses at barriers.
    pub barriers: usize,
}

/// The particles of a part after their ends.
pub(super) struct Set {
    pub grown: Vec<Grown>,
    pub weights: Normalised,
    /// The log of the estimated normalising constant, nats.
    pub log_mean: f64,
    /// The number of particle steps.
    pub steps: u64,
}

/// Chooser of the values of a part.
struct Grow<'a> {
    block: &'a Block<'a>,
    seen: &'a mut Seen,
    /// The present values, if the particle holds them.
    held: Option<&'a HashMap<u128, Value>>,
    /// The address of the turned choice, its value in this set and on the other side.
    turned: Option<(u128, &'a Value, &'a Value)>,
    /// The stream of new values.
    stream: StreamKey,
    /// The view of the proposal since the last barrier of this particle.
    sight: &'a mut Sight,
}

impl Chooser for Grow<'_> {
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let address = at.address();
        let impossible = Chosen { value: Value::None, log_prior: f64::NEG_INFINITY, log_drawn: 0.0 };
        let all = self.block.selection.is_all();
        if !all && self.block.selection.weigh(|| at.path(), || 0) == 0 {
            // A choice that may not change and was not made before: the run is not one of those with this rest.
            let Some(value) = self.block.rest.get(&address) else { return Ok(Some(impossible)) };
            self.seen.rest += 1;
            return Chosen::given(value.clone(), dist).map(Some);
        }
        let turned = self.turned.filter(|(turned_address, ..)| *turned_address == address);
        let chosen = match (turned, self.held.and_then(|held| held.get(&address))) {
            (Some((_, value, _)), _) => Chosen::given(value.clone(), dist)?,
            (None, Some(value)) => as_if_drawn(self.block.proposal, at, dist, value, seen, self.sight)?,
            (None, None) => {
                let mut fresh = Prior(self.stream);
                let drawn = match self.block.proposal {
                    None => fresh.choose(at, dist, seen)?,
                    Some(proposal) => {
                        let (stream, sight) = (self.stream, &mut *self.sight);
                        ByProposal { proposal, stream, sight, fallback: fresh }.choose(at, dist, seen)?
                    }
                };
                let Some(chosen) = drawn else { return Ok(None) };
                chosen
            }
        };
        self.seen.selected += 1;
        if at.activation() == self.block.path && chosen.log_prior > f64::NEG_INFINITY {
            self.seen.direct += 1;
            let alternatives = turn::alternatives(dist, &chosen.value)?;
            self.seen.turnable += u64::from(!alternatives.is_empty());
            if let Some((_, _, other)) = turned {
                self.seen.log_turn =
                    alternatives.iter().find(|(value, _)| identical(value, other)).map(|(_, log)| *log);
            }
        }
        Ok(Some(chosen))
    }
}

impl Grown {
    /// Whether the run can be drawn: it has ended, with all held choices and the turned choice.
    pub fn is_complete(&self, block: &Block<'_>, is_turned: bool) -> bool {
        let has_ended = self.particle.state.has_ended() && self.particle.record.cause.is_none();
        has_ended && self.seen.rest == block.rest.len() && self.seen.log_turn.is_some() == is_turned
    }

    /// The result of the part.
    pub fn result(&self) -> Value {
        self.particle.state.result()
    }

    /// The choices that may change.
    pub fn values(&self, block: &Block<'_>) -> HashMap<u128, Value> {
        let entries = self.particle.record.log.entries();
        let selected =
            entries.into_iter().filter(|e| !e.is_order() && !block.rest.contains_key(&e.address()));
        selected.map(|entry| (entry.address(), entry.value)).collect()
    }

    fn copy_from(&mut self, parent: &mut Grown, lineage: u64, seed: u64) {
        self.particle.copy_from(&mut parent.particle, lineage, seed);
        self.seen = parent.seen.clone();
        self.barriers = parent.barriers;
    }
}

impl Block<'_> {
    /// Draw a choice of the part's first activation to turn, uniformly; `None` if no choice can be turned.
    pub fn turned(&self, machine: &mut Machine<'_>, rng: &mut Stream) -> Result<Option<Turned>, Failure> {
        /// Collects the choices with other values while the present run is followed.
        struct Turnable<'a> {
            block: &'a Block<'a>,
            met: Vec<(u128, Value, turn::Alternatives)>,
        }
        impl Chooser for Turnable<'_> {
            fn choose(
                &mut self,
                at: &At<'_, f64>,
                dist: &Dist,
                _: Context<'_>,
            ) -> Result<Option<Chosen>, Fault> {
                let address = at.address();
                let held = self.block.held.get(&address);
                let Some(value) = held.or_else(|| self.block.rest.get(&address)) else { return Ok(None) };
                if held.is_some() && at.activation() == self.block.path {
                    let alternatives = turn::alternatives(dist, value)?;
                    if !alternatives.is_empty() {
                        self.met.push((address, value.clone(), alternatives));
                    }
                }
                Chosen::given(value.clone(), dist).map(Some)
            }
        }
        let mut all = Turnable { block: self, met: vec![] };
        let mut particle = Particle::start(self.start.clone(), Record::default(), 0, 0);
        particle.finish_by(machine, self.task, |_| 0, &mut all)?;
        if all.met.is_empty() {
            return Ok(None);
        }
        let at = ((rng.uniform() * all.met.len() as f64) as usize).min(all.met.len() - 1);
        let (address, old, alternatives) = all.met.swap_remove(at);
        Ok(turn::draw(alternatives, rng).map(|new| Turned { address, old, new }))
    }

    /// Conditional SMC: the first particle holds the present values. A choice that will be turned keeps its value in all.
    pub fn conditional(
        &self,
        machine: &mut Machine<'_>,
        turned: Option<&Turned>,
        seed: u64,
    ) -> Result<Set, Failure> {
        let turned = turned.map(|t| (t.address, &t.old, &t.new));
        self.sweep(machine, turned, Some(0), seed)
    }

    /// SMC in which no particle holds the present values, with a choice turned or with all of them fresh.
    pub fn free(
        &self,
        machine: &mut Machine<'_>,
        turned: Option<&Turned>,
        seed: u64,
    ) -> Result<Set, Failure> {
        self.sweep(machine, turned.map(|t| (t.address, &t.new, &t.old)), None, seed)
    }

    fn sweep(
        &self,
        machine: &mut Machine<'_>,
        turned: Option<(u128, &Value, &Value)>,
        held: Option<usize>,
        seed: u64,
    ) -> Result<Set, Failure> {
        let mut first = Record {
            log_sketches: self.sketches.total(),
            sketches: self.sketches.fork(),
            ..Record::default()
        };
        let member = |lineage| Grown {
            particle: Particle::start(self.start.clone(), first.fork(), lineage, seed),
            seen: Seen::default(),
            barriers: 0,
        };
        let lineages = self.particles as u64;
        let set = Set {
            grown: (0..lineages).map(member).collect(),
            weights: Normalised::default(),
            log_mean: 0.0,
            steps: 0,
        };
        let sight = Sight::default();
        let mut growing = Growing { block: self, set, machine, turned, seed, sight, lineages, barriers: 0 };
        let lived = sweep(&mut growing, held, &mut |_, is_possible| is_possible)?;
        let log_mean = if lived { growing.set.log_mean } else { f64::NEG_INFINITY };
        Ok(Set { log_mean, ..growing.set })
    }
}

/// The running particles of a part.
struct Growing<'a, 'm> {
    block: &'a Block<'a>,
    set: Set,
    machine: &'a mut Machine<'m>,
    turned: Option<(u128, &'a Value, &'a Value)>,
    seed: u64,
    sight: Sight,
    lineages: u64,
    barriers: u128,
}

impl Particles for Growing<'_, '_> {
    /// Whether a particle is possible.
    type Seen = bool;

    fn running(&mut self) -> usize {
        let running = self.set.grown.iter().filter(|member| member.particle.is_running()).count();
        self.set.steps += running as u64;
        running
    }

    fn advance(&mut self, held: Option<usize>) -> Result<(), Failure> {
        for (index, member) in self.set.grown.iter_mut().enumerate() {
            self.sight.forget();
            let chooser = Grow {
                block: self.block,
                seen: &mut member.seen,
                held: (held == Some(index)).then_some(self.block.held),
                turned: self.turned,
                stream: member.particle.stream,
                sight: &mut self.sight,
            };
            let paused = member.particle.advance(self.machine, self.block.task, self.seed, chooser)?;
            member.barriers += usize::from(paused);
        }
        Ok(())
    }

    fn weigh(&mut self) -> Result<bool, Failure> {
        let beta = self.block.beta;
        self.barriers += 1;
        for Grown { particle: p, .. } in &mut self.set.grown {
            let score = p.record.score();
            p.log_weight += std::mem::take(&mut p.pending);
            p.log_weight += p.log_step(beta, &score, beta);
            p.weighed = score;
        }
        Ok(self.set.weights.read(self.set.grown.iter().map(|member| member.particle.log_weight)))
    }

    /// The last weights are those of [`Set::close`].
    fn is_low(&self) -> bool {
        let grown = &self.set.grown;
        self.set.weights.effective < LOW * grown.len() as f64
            && grown.iter().any(|member| member.particle.is_running())
    }

    fn resample(&mut self, held: Option<usize>) -> Result<Option<usize>, Failure> {
        let Growing { set, seed, lineages, barriers, .. } = self;
        let mut random = Reserved::Resampling.stream(*seed, *barriers - 1, 0);
        let copies = Resampling::Systematic.copies_with(held, &set.weights.relative, &mut random);
        set.log_mean += set.weights.log_mean;
        for (parent, to) in further_copies(&copies) {
            let [from, copy] = pair(&mut set.grown, parent, to);
            copy.copy_from(from, *lineages, *seed);
            *lineages += 1;
        }
        set.grown.iter_mut().for_each(|member| member.particle.log_weight = 0.0);
        Ok(held)
    }
}

impl Set {
    /// The choices of the particle with the highest score, of those with a run that can be drawn; `None` without any.
    pub fn best(&self, block: &Block<'_>) -> Option<HashMap<u128, Value>> {
        let possible = self.grown.iter().filter(|member| {
            member.is_complete(block, member.seen.log_turn.is_some())
                && !member.particle.record.score().is_impossible()
        });
        let score = |member: &&Grown| member.particle.record.log_score();
        possible.max_by(|a, b| score(a).total_cmp(&score(b))).map(|member| member.values(block))
    }

    /// Normalise the last log weights, which completes the estimate of the constant.
    pub fn close(&mut self, logs: &[f64]) {
        if self.log_mean > f64::NEG_INFINITY && self.weights.read(logs.iter().copied()) {
            self.log_mean += self.weights.log_mean;
        } else {
            self.log_mean = f64::NEG_INFINITY;
        }
    }
}

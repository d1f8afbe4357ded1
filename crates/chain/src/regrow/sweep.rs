//! SMC of a part, from its inputs to its result. Weights count the score of the scene, which has the rest of the run from the
//! start, and the densities of choices that do not change.

use super::{Turned, turn};
use niwaki_geom::sketch::product::Sketches;
use niwaki_math::{Dist, Stream, StreamKey};
use niwaki_propose::guide::bound::Sight;
use niwaki_propose::particle::Particle;
use niwaki_propose::proposal::{ByProposal, Proposal, as_if_drawn};
use niwaki_run::chooser::{Chooser, Chosen, Context, Prior};
use niwaki_run::record::Record;
use niwaki_run::resampling::{Resampling, conditional_multinomial, further_copies, pair};
use niwaki_run::select::Selection;
use niwaki_run::streams::Reserved;
use niwaki_run::weights::{Normalised, log_step};
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::state::State;
use niwaki_vm::value::{Value, same};
use std::collections::HashMap;

/// Resampling follows where the effective sample size is below this share of the particles.
const LOW: f64 = 0.5;

/// A part that is to be grown, and what is held.
pub(super) struct Block<'a> {
    pub task: &'a Task,
    /// A run of the part that has not begun.
    pub start: State,
    /// The path of its first activation.
    pub path: u128,
    /// The scene without the part.
    pub sketches: Sketches,
    /// The present values of the choices that may change.
    pub held: &'a HashMap<u128, Value>,
    /// Those of the part's other choices.
    pub rest: &'a HashMap<u128, Value>,
    /// Which choices may change.
    pub selection: &'a Selection,
    /// What draws values in place of the prior.
    pub proposal: Option<&'a Proposal>,
    /// The power of the score.
    pub beta: f64,
    pub particles: usize,
}

/// What a particle chose, as far as the probability of the pick depends on it.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    /// How many choices that may change.
    pub selected: u64,
    /// Those of the part's first activation itself.
    pub direct: u64,
    /// Those of them that have other values.
    pub turnable: u64,
    /// How many of the others.
    rest: usize,
    /// Log probability of turning the turned choice to its value on the other side.
    pub log_turn: Option<f64>,
}

/// A particle of a part.
pub(super) struct Grown {
    pub particle: Particle,
    pub seen: Seen,
    /// How often it paused at a barrier.
    pub barriers: usize,
}

/// The particles of a part, grown to their ends.
pub(super) struct Set {
    pub grown: Vec<Grown>,
    pub weights: Normalised,
    /// Log of the estimate of the normalising constant, nats.
    pub log_mean: f64,
    /// How often a particle ran to a barrier or to its end.
    pub steps: u64,
}

/// Gives the choices of a part their values.
struct Grow<'a> {
    block: &'a Block<'a>,
    seen: &'a mut Seen,
    /// Of the particle that holds the present values: these.
    held: Option<&'a HashMap<u128, Value>>,
    /// The address of the turned choice, its value in this set and on the other side.
    turned: Option<(u128, &'a Value, &'a Value)>,
    /// The stream of new values.
    stream: StreamKey,
    /// What the proposal has seen of this particle's run since its last barrier.
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
        let turned = self.turned.filter(|(which, ..)| *which == address);
        let chosen = match (turned, self.held.and_then(|held| held.get(&address))) {
            (Some((_, value, _)), _) => Chosen::given(value.clone(), dist)?,
            (None, Some(value)) => as_if_drawn(self.block.proposal, at, dist, value, seen, self.sight)?,
            (None, None) => {
                let mut fresh = Prior(self.stream);
                let drawn = match self.block.proposal {
                    None => fresh.choose(at, dist, seen)?,
                    Some(proposal) => {
                        let (stream, sight) = (self.stream, &mut *self.sight);
                        ByProposal { proposal, stream, sight, otherwise: fresh }.choose(at, dist, seen)?
                    }
                };
                let Some(chosen) = drawn else { return Ok(None) };
                chosen
            }
        };
        self.seen.selected += 1;
        if at.activation() == self.block.path && chosen.log_prior > f64::NEG_INFINITY {
            self.seen.direct += 1;
            let others = turn::others(dist, &chosen.value)?;
            self.seen.turnable += u64::from(!others.is_empty());
            if let Some((_, _, other)) = turned {
                self.seen.log_turn = others.iter().find(|(value, _)| same(value, other)).map(|(_, log)| *log);
            }
        }
        Ok(Some(chosen))
    }
}

impl Grown {
    /// Whether its run is one of those that can be drawn: it ended, made all of the held choices and the turned one.
    pub fn is_complete(&self, block: &Block<'_>, is_turned: bool) -> bool {
        let has_ended = self.particle.state.has_ended() && self.particle.record.cause.is_none();
        has_ended && self.seen.rest == block.rest.len() && self.seen.log_turn.is_some() == is_turned
    }

    /// What the part returned.
    pub fn result(&self) -> Value {
        self.particle.state.result()
    }

    /// Its choices that may change.
    pub fn values(&self, block: &Block<'_>) -> HashMap<u128, Value> {
        let entries = self.particle.record.log.entries();
        let own = entries.into_iter().filter(|e| !e.is_order() && !block.rest.contains_key(&e.address()));
        own.map(|entry| (entry.address(), entry.value)).collect()
    }

    fn copy_from(&mut self, parent: &mut Grown, lineage: u64, seed: u64) {
        self.particle.copy_from(&mut parent.particle, lineage, seed);
        self.seen = parent.seen.clone();
        self.barriers = parent.barriers;
    }
}

impl Block<'_> {
    /// A choice of the part's first activation that is turned, evenly among those that can be; `None` where none can.
    pub fn turned(&self, machine: &mut Machine<'_>, rng: &mut Stream) -> Result<Option<Turned>, Failure> {
        /// Collects the choices with other values while the present run is followed.
        struct Turnable<'a> {
            block: &'a Block<'a>,
            met: Vec<(u128, Value, turn::Others)>,
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
                    let others = turn::others(dist, value)?;
                    if !others.is_empty() {
                        self.met.push((address, value.clone(), others));
                    }
                }
                Chosen::given(value.clone(), dist).map(Some)
            }
        }
        let mut one = Particle::start(self.start.clone(), Record::default(), 0, 0);
        let mut all = Turnable { block: self, met: vec![] };
        while one.is_running() {
            one.run(machine, self.task, 0, &mut all)?;
        }
        if all.met.is_empty() {
            return Ok(None);
        }
        let at = ((rng.uniform() * all.met.len() as f64) as usize).min(all.met.len() - 1);
        let (address, old, others) = all.met.swap_remove(at);
        Ok(turn::draw(others, rng).map(|new| Turned { address, old, new }))
    }

    /// Conditional SMC: the first particle holds the present values. A choice that will be turned keeps its value in all.
    pub fn conditional(
        &self,
        machine: &mut Machine<'_>,
        turned: Option<&Turned>,
        seed: u64,
    ) -> Result<Set, Failure> {
        let turned = turned.map(|t| (t.address, &t.old, &t.new));
        self.sweep(machine, turned, Some(self.held), seed)
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
        held: Option<&HashMap<u128, Value>>,
        seed: u64,
    ) -> Result<Set, Failure> {
        let mut first = Record {
            log_sketches: self.sketches.total(),
            sketches: self.sketches.fork(),
            ..Record::default()
        };
        let one = |lineage| Grown {
            particle: Particle::start(self.start.clone(), first.fork(), lineage, seed),
            seen: Seen::default(),
            barriers: 0,
        };
        let mut grown: Vec<Grown> = (0..self.particles as u64).map(one).collect();
        let (mut weights, mut log_mean, mut lineages, mut step) =
            (Normalised::default(), 0.0, self.particles as u64, 0);
        let (mut steps, mut sight) = (0, Sight::default());
        while grown.iter().any(|one| one.particle.is_running()) {
            steps += grown.iter().filter(|one| one.particle.is_running()).count() as u64;
            for (index, one) in grown.iter_mut().enumerate() {
                let held = held.filter(|_| index == 0);
                sight.forget();
                self.advance(machine, one, turned, held, seed, &mut sight)?;
            }
            for one in &mut grown {
                self.weigh(&mut one.particle);
            }
            if !weights.read(grown.iter().map(|one| one.particle.log_weight)) {
                return Ok(Set { grown, weights, log_mean: f64::NEG_INFINITY, steps });
            }
            let is_low = weights.effective < LOW * self.particles as f64;
            if is_low && grown.iter().any(|one| one.particle.is_running()) {
                let mut random = Reserved::Resampling.stream(seed, step, 0);
                let copies = if held.is_some() {
                    conditional_multinomial(&weights.relative, 0, &mut random)
                } else {
                    Resampling::Systematic.copies(&weights.relative, &mut random)
                };
                log_mean += weights.log_mean;
                resample(&mut grown, &copies, &mut lineages, seed);
            }
            step += 1;
        }
        Ok(Set { grown, weights, log_mean, steps })
    }

    /// Runs a particle to its next barrier, or to its end.
    fn advance(
        &self,
        machine: &mut Machine<'_>,
        one: &mut Grown,
        turned: Option<(u128, &Value, &Value)>,
        held: Option<&HashMap<u128, Value>>,
        seed: u64,
        sight: &mut Sight,
    ) -> Result<(), Failure> {
        let stream = one.particle.stream;
        let chooser = Grow { block: self, seen: &mut one.seen, held, turned, stream, sight };
        one.barriers += usize::from(one.particle.advance(machine, self.task, seed, chooser)?);
        Ok(())
    }

    /// Counts the score at this barrier in the weight.
    fn weigh(&self, p: &mut Particle) {
        let score = p.record.score();
        p.log_weight += std::mem::take(&mut p.pending);
        p.log_weight += log_step(self.beta, &score, self.beta, &p.weighed);
        p.weighed = score;
    }
}

impl Set {
    /// The choices of the particle with the highest score, of those with a run that can be drawn; `None` without any.
    pub fn best(&self, block: &Block<'_>) -> Option<HashMap<u128, Value>> {
        let possible = self.grown.iter().filter(|one| {
            one.is_complete(block, one.seen.log_turn.is_some())
                && !one.particle.record.score().is_impossible()
        });
        let score = |one: &&Grown| one.particle.record.log_score();
        possible.max_by(|a, b| score(a).total_cmp(&score(b))).map(|one| one.values(block))
    }

    /// Reads the last log weights; the estimate of the constant is then complete.
    pub fn close(&mut self, logs: &[f64]) {
        if self.log_mean > f64::NEG_INFINITY && self.weights.read(logs.iter().copied()) {
            self.log_mean += self.weights.log_mean;
        } else {
            self.log_mean = f64::NEG_INFINITY;
        }
    }
}

/// Particle `i` survives `copies[i]` times; weights are reset.
fn resample(grown: &mut [Grown], copies: &[usize], lineages: &mut u64, seed: u64) {
    for (parent, to) in further_copies(copies) {
        let [from, copy] = pair(grown, parent, to);
        copy.copy_from(from, *lineages, seed);
        *lineages += 1;
    }
    grown.iter_mut().for_each(|one| one.particle.log_weight = 0.0);
}

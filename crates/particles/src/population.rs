//! The population and its steps: advance, weigh, resample. A [`sweep`](niwaki_propose::sweep) takes them in turn; so does
//! one of conditional SMC, with one particle held.

use crate::copies::{Copies, Indexed, copy};
use crate::in_lanes::{InLanes, LEAST};
use crate::rejuvenation::{MoveCounts, Mover};
use crate::resident::{Growth, Resident, counted, too_large};
use crate::settings::{Anneal, Settings, Weights, When};
use crate::shared::share;
use crate::smc::Progress;
use crate::tempered::Tempered;
use niwaki_math::Total;
use niwaki_propose::guide::bound::Sight;
use niwaki_propose::particle::Particle;
use niwaki_propose::proposal::ByProposal;
use niwaki_propose::sweep::Particles;
use niwaki_run::blame::RUNS;
use niwaki_run::chooser::Prior;
use niwaki_run::failure::Dead;
use niwaki_run::losses::Losses;
use niwaki_run::order::{Order, Past};
use niwaki_run::record::{AllInvalid, Record};
use niwaki_run::resampling::Resampling;
use niwaki_run::streams::Reserved;
use niwaki_run::weights::{Normalised, conditional_share, log_step};
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::{Limits, Machine};
use std::collections::HashSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Most particles that one task of the thread pool advances.
pub(super) const BATCH: usize = 16;
/// Tasks for each thread: particles differ in what they cost, and those that have ended cost nothing.
const TASKS: usize = 8;

/// Halvings in the search for a power.
const HALVINGS: u32 = 20;

/// Particles, and what is kept of their past.
pub(super) struct Population<'a> {
    pub task: Task,
    pub settings: &'a Settings,
    pub particles: Vec<Particle>,
    /// The particle index at the first barrier that each particle descends from.
    pub ancestor: Vec<usize>,
    pub lineages: u64,
    pub barriers: usize,
    pub steps: u64,
    /// How many particles were possible before they ran to this barrier.
    possible: usize,
    pub resampled: usize,
    /// Log of the estimate of the normalising constant so far.
    pub log_normaliser: f64,
    /// The power that the weights count now.
    pub power: f64,
    /// The power at each barrier so far, where it is not constant.
    pub powers: Vec<f64>,
    /// The weights since the last resampling.
    pub weights: Normalised,
    /// How it is rejuvenated.
    pub mover: Option<Mover>,
    /// Moves so far.
    pub moved: MoveCounts,
    /// Particles that became impossible so far.
    pub losses: Losses,
    /// Whether it uses several threads.
    pub parallel: bool,
    /// The task for each thread, with its own copy of the program.
    apart: Vec<Task>,
    /// The copies of the last resampling that are not made yet.
    copies: Copies,
    /// The memory that they take.
    resident: Resident,
    /// The log weights at a barrier; kept from one to the next, so that none allocates.
    logs: Vec<f64>,
    /// The particles, while they run together; `particles` then means nothing.
    lanes: Option<InLanes>,
    /// When they may line up next.
    rest: Rest,
}

/// When particles that went apart try to line up again: after one barrier where they stayed together for longer than they had
/// waited, else after twice as many as before.
#[derive(Default)]
struct Rest {
    /// The barrier from which on they may.
    until: usize,
    /// How many barriers they wait the next time.
    length: usize,
    /// The barrier at which they lined up last.
    since: usize,
}

impl Rest {
    /// The shortest rest after a failure, and the longest, barriers.
    const SHORTEST: usize = 4;
    const LONGEST: usize = 256;

    /// They went apart at this barrier, or could not line up.
    fn begin(&mut self, barrier: usize) {
        let stayed = barrier - self.since;
        self.length =
            if stayed > self.length { 1 } else { (2 * self.length).clamp(Rest::SHORTEST, Rest::LONGEST) };
        self.until = barrier + self.length;
    }
}

impl<'a> Population<'a> {
    /// A population that has not begun. `serial` keeps it on one thread, because other populations use the others.
    pub fn start(task: &Task, settings: &'a Settings, serial: bool) -> Result<Self, Failure> {
        settings.check()?;
        let mut first = task.start(&task.machine(), settings.order == Order::DepthFirst)?;
        if let Some(proposal) = &settings.proposal {
            proposal.check(&task.program)?;
            if proposal.needs_origins() {
                first.remember_origins();
            }
        }
        let mut empty = Record::start(&task.sketches);
        if settings.proposal.as_ref().is_some_and(|proposal| proposal.looks()) {
            empty.sketches.expect_windows();
            first.note_parts();
        }
        let past = Past::start(&settings.order);
        Population::of(
            task,
            settings,
            serial,
            Particle { past, ..Particle::start(first, empty, 0, settings.seed) },
        )
    }

    /// A population whose particles go on from a paused one.
    pub fn go_on(task: &Task, settings: &'a Settings, from: &mut Particle) -> Result<Self, Failure> {
        settings.check()?;
        let (state, past) = (from.state.clone(), from.past.clone());
        let first = Particle::start(state, from.record.fork(), 0, settings.seed);
        Population::of(task, settings, true, Particle { past, ..first })
    }

    /// A population of copies of a particle, of weight one.
    fn of(task: &Task, settings: &'a Settings, serial: bool, mut first: Particle) -> Result<Self, Failure> {
        let n = settings.particles;
        let task = task.clone();
        let score = first.record.score();
        let particles: Vec<Particle> = (0..n as u64)
            .map(|lineage| Particle {
                home: lineage as usize % rayon::current_num_threads(),
                past: first.past.clone(),
                ..Particle::start(first.state.clone(), first.record.fork(), lineage, settings.seed)
            })
            .collect();
        let power = match &settings.anneal {
            Anneal::Constant => settings.power,
            Anneal::Schedule(_) | Anneal::Adaptive(_) => 0.0,
        };
        let threads = rayon::current_num_threads();
        let parallel = !serial && n > BATCH && threads > 1;
        let own = |program| Task { program: Arc::new(program), ..one(&task, n) };
        Ok(Population {
            settings,
            particles,
            ancestor: (0..n).collect(),
            lineages: n as u64,
            barriers: 0,
            steps: 0,
            possible: n,
            resampled: 0,
            log_normaliser: power * score.value(),
            power,
            powers: Vec::new(),
            weights: Normalised::default(),
            mover: Mover::of(&task, settings)?,
            moved: MoveCounts::default(),
            losses: Losses::default(),
            parallel,
            apart: task.program.apart(if parallel { threads } else { 0 }).into_iter().map(own).collect(),
            copies: Copies::default(),
            resident: Resident::default(),
            logs: Vec::with_capacity(n),
            lanes: None,
            rest: Rest::default(),
            task,
        })
    }

    /// Whether its particles may run together at all: with all else than numbers, weights and copies they run one by one.
    fn has_lanes(&self) -> bool {
        let (own, task) = (self.settings, &self.task);
        own.lanes
            && own.particles >= LEAST
            && own.proposal.is_none()
            && own.rejuvenate.is_none()
            && own.look_ahead.is_none()
            && own.order.policy().is_none()
            && own.weights == Weights::Ratio
            && !matches!(own.anneal, Anneal::Adaptive(_))
            && task.sketches.is_empty()
            && task.held.is_none()
            && task.together.is_none()
    }

    /// Runs the particles together to the next barrier; false where they are, or have gone, apart.
    fn advance_together(&mut self) -> bool {
        if self.lanes.is_none() {
            if self.barriers < self.rest.until || !self.has_lanes() {
                return false;
            }
            self.settle();
            self.rest.since = self.barriers;
            self.lanes = InLanes::line_up(&mut self.particles);
            if self.lanes.is_none() {
                self.rest.begin(self.barriers);
            }
        }
        let Some(lanes) = &mut self.lanes else { return false };
        let limit = self.task.limits.bytes;
        let own = one(&self.task, self.particles.len());
        let resident = &mut self.resident;
        if lanes.advance(&mut own.machine(), |growth| resident.grown_together(growth, limit)) {
            return true;
        }
        self.part();
        self.rest.begin(self.barriers);
        false
    }

    /// Whether its particles run together now.
    #[cfg(test)]
    pub fn is_in_lanes(&self) -> bool {
        self.lanes.is_some()
    }

    /// The particles go on one by one.
    fn part(&mut self) {
        if let Some(lanes) = self.lanes.take() {
            lanes.part(&mut self.particles);
        }
    }

    /// Makes the copies of the last resampling.
    pub fn settle(&mut self) {
        self.part();
        self.copies.make(&mut self.particles, self.settings.seed);
    }

    /// How many run, and how many have ended. One pass, because a population does not fit into the cache.
    pub fn count(&self) -> (usize, usize) {
        if let Some(lanes) = &self.lanes {
            return if lanes.have_ended() { (0, lanes.len()) } else { (lanes.len(), 0) };
        }
        self.particles.iter().enumerate().fold((0, 0), |(running, ended), (index, p)| {
            let times = self.copies.count(index);
            (running + times * usize::from(p.is_running()), ended + times * usize::from(p.state.has_ended()))
        })
    }

    /// The power at this barrier.
    fn next_power(&self) -> f64 {
        match &self.settings.anneal {
            Anneal::Constant => self.power,
            Anneal::Schedule(powers) => powers[(self.barriers - 1).min(powers.len() - 1)],
            Anneal::Adaptive(share) => self.adapted(*share),
        }
    }

    /// The largest power up to the declared one with which this barrier's step keeps the conditional effective
    /// sample size at `share`; never below the power now.
    fn adapted(&self, share: f64) -> f64 {
        let keeps = |next: f64| {
            let old = self.particles.iter().map(|p| p.log_weight);
            let steps = self.particles.iter().map(|p| step(p, next, &p.record.score(), self.power));
            conditional_share(old, steps) >= share
        };
        let (mut low, mut high) = (self.power, self.settings.power);
        if high <= low || keeps(high) {
            return high.max(low);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if keeps(middle) { low = middle } else { high = middle }
        }
        low
    }

    /// Weighs the final set by the declared power, and reads its weights; false when no particle is possible.
    pub fn finish(&mut self) -> bool {
        self.settle();
        // Those that ended have no twist; of a search that was stopped others are left.
        for p in self.particles.iter_mut().filter(|p| p.is_running() && p.foreseen != 0.0) {
            p.log_weight -= self.power * std::mem::take(&mut p.foreseen);
        }
        if self.power != self.settings.power {
            let change = self.settings.power - self.power;
            for p in &mut self.particles {
                if !p.weighed.is_impossible() {
                    p.log_weight += change * p.weighed.value();
                }
            }
            self.power = self.settings.power;
        }
        let possible = self.weights.read(self.particles.iter().map(|p| p.log_weight));
        if possible {
            self.log_normaliser += self.weights.log_mean;
        }
        possible
    }

    /// How many particles of the first barrier the final set descends from.
    pub fn ancestors(&self) -> usize {
        self.ancestor.iter().collect::<HashSet<_>>().len()
    }
}

impl Particles for Population<'_> {
    type Seen = Progress;

    fn running(&mut self) -> usize {
        let (running, ended) = self.count();
        self.possible = running + ended;
        running
    }

    /// The `held` one is left to its caller.
    fn advance(&mut self, held: Option<usize>) -> Result<(), Failure> {
        if held.is_none() && self.advance_together() {
            return Ok(());
        }
        self.part();
        let (task, settings, seed) = (&self.task, self.settings, self.settings.seed);
        let limit = task.limits.bytes;
        let room = self.resident.room(limit);
        let mut growth = Growth::default();
        if !self.parallel {
            self.copies.make(&mut self.particles, seed);
            let own = one(task, self.particles.len());
            let (mut machine, mut sight) = (own.machine(), Sight::default());
            let others = self.particles.iter_mut().enumerate().filter(|(index, _)| Some(*index) != held);
            for (_, p) in others {
                let run = |p: &mut Particle, machine: &mut Machine<'_>| {
                    advance(p, machine, &own, settings, &mut sight)
                };
                counted(p, &mut machine, limit, &mut growth, run)?;
                if growth.up > room {
                    return Err(too_large(task));
                }
            }
            return self.resident.grown(growth, task, &self.particles);
        }
        // Of several faults, that of the first particle is reported, so that threads do not matter. Particles after
        // a failed one need not run: an endless model would use up its budget once for each.
        let (failed, fault) = (AtomicUsize::new(usize::MAX), Mutex::new(None));
        let all = Mutex::new(growth);
        let threads = self.apart.len();
        let size = (self.particles.len() / (TASKS * threads)).clamp(1, BATCH);
        let batches = self.copies.batches(&mut self.particles, seed, size, threads);
        let apart = &self.apart;
        share(batches, |thread| {
            let task = &apart[thread];
            let (mut machine, mut sight) = (task.machine(), Sight::default());
            let (failed, fault, all) = (&failed, &fault, &all);
            move |mut batch: Vec<Indexed<'_>>| {
                copy(&mut batch, seed);
                let mut growth = Growth::default();
                for Indexed { index, particle, .. } in batch {
                    particle.home = thread;
                    if Some(index) == held || index > failed.load(Ordering::Relaxed) || growth.up > room {
                        continue;
                    }
                    let run = |p: &mut Particle, machine: &mut Machine<'_>| {
                        advance(p, machine, task, settings, &mut sight)
                    };
                    match counted(particle, &mut machine, limit, &mut growth, run) {
                        Ok(()) => {}
                        Err(own) if failed.fetch_min(index, Ordering::Relaxed) > index => {
                            let mut first = fault.lock().unwrap_or_else(PoisonError::into_inner);
                            if first.as_ref().is_none_or(|(before, _)| *before > index) {
                                *first = Some((index, own));
                            }
                        }
                        Err(_) => {}
                    }
                }
                let mut all = all.lock().unwrap_or_else(PoisonError::into_inner);
                all.add(growth);
                if all.up > room {
                    // The others need not run.
                    failed.store(0, Ordering::Relaxed);
                }
            }
        });
        self.copies.clear();
        let growth = all.into_inner().unwrap_or_else(PoisonError::into_inner);
        if growth.up > room {
            return Err(too_large(task));
        }
        match fault.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some((_, own)) => Err(own),
            None => self.resident.grown(growth, task, &self.particles),
        }
    }

    fn weigh(&mut self) -> Result<Progress, Failure> {
        self.barriers += 1;
        // The ratios of proposed choices since the last barrier. They are not raised to a power, as the prior is not; the
        // power is chosen after they count.
        if self.settings.proposal.is_some() {
            self.particles.iter_mut().for_each(|p| p.log_weight += std::mem::take(&mut p.pending));
        }
        let next = self.next_power();
        let (mut best, mut ended) = (f64::NEG_INFINITY, 0);
        self.logs.clear();
        if let Some(lanes) = &mut self.lanes {
            ended = if lanes.have_ended() { lanes.len() } else { 0 };
            best = lanes.weigh(next, self.power);
            self.logs.extend(&lanes.log_weight);
        }
        let alone = if self.lanes.is_some() { &mut [] } else { &mut self.particles[..] };
        for p in alone {
            let score = p.record.score();
            best = best.max(score.value());
            ended += usize::from(p.state.has_ended());
            if score.is_impossible() && !p.weighed.is_impossible() {
                self.losses.note(&p.record);
            }
            match self.settings.weights {
                Weights::Ratio => p.log_weight += step(p, next, &score, self.power),
                Weights::Absolute => p.log_weight = self.settings.power * score.value(),
            }
            p.weighed = score;
            p.foreseen = p.ahead;
            self.logs.push(p.log_weight);
        }
        self.power = next;
        if self.settings.anneal != Anneal::Constant {
            self.powers.push(next);
        }
        if !self.weights.read(self.logs.iter().copied()) {
            self.part();
            AllInvalid::check_all(self.particles.iter().map(|p| p.record.invalid.as_ref()))?;
            return Err(impossible(&self.particles, self.barriers));
        }
        // Particles that ended now reached no barrier.
        self.steps += (self.possible - ended) as u64;
        Ok(Progress { barriers: self.barriers, ended, best })
    }

    fn is_low(&self) -> bool {
        match self.settings.when {
            _ if self.settings.weights == Weights::Absolute => true,
            When::Always => true,
            When::EffectiveBelow(share) => self.weights.effective < share * self.particles.len() as f64,
        }
    }

    /// Resamples by the declared method; the `held` particle survives at its index. Weights are reset, to what tempering
    /// leaves of them. The copies themselves wait for [`Population::settle`].
    fn resample(&mut self, held: Option<usize>) -> Result<Option<usize>, Failure> {
        let mut random = Reserved::Resampling.stream(self.settings.seed, self.barriers as u128, 0);
        let tempered = match self.settings.resampling {
            Resampling::Tempered => Tempered::of(self.logs.iter().copied()),
            _ => None,
        };
        let weights = tempered.as_ref().map_or(&self.weights, |tempered| &tempered.weights);
        let copies = self.settings.resampling.copies_with(held, &weights.relative, &mut random);
        let log_mean = self.weights.log_mean;
        let carried = |log_weight| tempered.as_ref().map_or(0.0, |own| own.carried(log_weight, log_mean));
        match &mut self.lanes {
            Some(lanes) => lanes.log_weight.iter_mut().for_each(|log| *log = carried(*log)),
            None => self.particles.iter_mut().for_each(|p| p.log_weight = carried(p.log_weight)),
        }
        self.log_normaliser += log_mean;
        self.resampled += 1;
        self.copies = Copies::plan(&copies, &mut self.ancestor, &mut self.lineages);
        if let Some(lanes) = &mut self.lanes {
            lanes.copy(&self.copies, self.settings.seed);
            self.copies.clear();
        } else if self.parallel {
            self.copies.share_out(&mut self.particles, self.apart.len());
        }
        // The first copy keeps the index of its parent.
        Ok(held)
    }

    fn rejuvenate(&mut self, resampled: bool) -> Result<(), Failure> {
        self.move_particles(Some(resampled))
    }
}

/// The log weight of a particle's step to a score at the next power, nats: its forecast is counted, and the one before
/// taken back.
#[inline(always)]
fn step(p: &Particle, next: f64, score: &Total, power: f64) -> f64 {
    log_step(next, score, power, &p.weighed) + (next * p.ahead - power * p.foreseen)
}

/// Runs a particle to its next barrier, or to its end: choices are drawn by the proposal, where there is one for them.
fn advance(
    particle: &mut Particle,
    machine: &mut Machine<'_>,
    task: &Task,
    settings: &Settings,
    sight: &mut Sight,
) -> Result<(), Failure> {
    let (stream, otherwise) = (particle.stream, Prior(particle.stream));
    match settings.proposal.as_deref() {
        None => particle.advance(machine, task, settings.seed, otherwise)?,
        Some(proposal) => {
            sight.recall(&particle.glance);
            particle.advance(
                machine,
                task,
                settings.seed,
                ByProposal { proposal, stream, sight, otherwise },
            )?
        }
    };
    particle.foresee(settings.look_ahead.as_ref(), task, machine, sight);
    Ok(())
}

/// Parts of a population's budget of memory that one particle may use while it runs, if its own share is smaller.
const PARTS: usize = 64;

/// The task of one particle: between two barriers it may grow to its share of the memory, or to a small part of all. What
/// all have together is counted at barriers ([`Resident`]).
fn one(task: &Task, n: usize) -> Task {
    let bytes = (task.limits.bytes / n).max(task.limits.bytes / PARTS);
    Task { limits: Limits { bytes, ..task.limits }, ..task.clone() }
}

fn impossible(particles: &[Particle], barrier: usize) -> Failure {
    let named = particles.iter().map(|p| p.record.cause.as_deref().unwrap_or("weights"));
    let mut failure = Failure::impossible(barrier, named.clone().map(|cause| (cause, 1)));
    if let Failure::Impossible { dead, .. } = &mut failure {
        let of = |(p, cause): (&Particle, &str)| Dead {
            cause: cause.to_string(),
            entries: p.record.log.entries(),
        };
        *dead = particles.iter().zip(named).take(RUNS).map(of).collect();
    }
    failure
}

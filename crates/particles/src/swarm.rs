//! The particles of a population, and how they run from barrier to barrier: one by one, in a batch on this thread or in batches
//! on all threads, or together in lanes. Which of these it is changes time only.

use crate::copies::{Copies, Indexed, copy};
use crate::in_lanes::{InLanes, LEAST};
use crate::resident::{Growth, Resident, counted, too_large};
use crate::settings::{Anneal, Settings, Weights};
use crate::shared::share;
use niwaki_propose::guide::bound::Sight;
use niwaki_propose::particle::Particle;
use niwaki_propose::proposal::ByProposal;
use niwaki_run::chooser::Prior;
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::{Limits, Machine};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Most particles that one task of the thread pool advances.
const BATCH: usize = 16;
/// Tasks for each thread: particles differ in what they cost, and those that have ended cost nothing.
const TASKS: usize = 8;
/// Parts of a population's budget of memory that one particle may use while it runs, if its own share is smaller.
const PARTS: usize = 64;

/// The particles of a population.
pub(super) struct Swarm {
    pub particles: Vec<Particle>,
    /// The particles, while they run together; `particles` then means nothing.
    pub lanes: Option<InLanes>,
    /// When they may line up next.
    rest: Rest,
    /// The copies of the last resampling that are not made yet.
    copies: Copies,
    /// The memory that they take.
    resident: Resident,
    /// The task of one particle for each thread; with its own copy of the program where there are several.
    tasks: Vec<Task>,
}

impl Swarm {
    /// Copies of a particle. `serial` keeps them on one thread, because other populations use the others.
    pub fn of(task: &Task, settings: &Settings, serial: bool, mut first: Particle) -> Swarm {
        let (n, threads) = (settings.particles, rayon::current_num_threads());
        let particles = (0..n as u64).map(|lineage| Particle {
            home: lineage as usize % threads,
            past: first.past.clone(),
            ..Particle::start(first.state.clone(), first.record.fork(), lineage, settings.seed)
        });
        let particles = particles.collect();
        // Between two barriers a particle may grow to its share of the memory, or to a small part of all. What all have
        // together is counted at barriers.
        let bytes = (task.limits.bytes / n).max(task.limits.bytes / PARTS);
        let own = Task { limits: Limits { bytes, ..task.limits }, ..task.clone() };
        let tasks = if serial || n <= BATCH || threads == 1 {
            vec![own]
        } else {
            let apart = task.program.apart(threads).into_iter();
            apart.map(|program| Task { program: Arc::new(program), ..own.clone() }).collect()
        };
        let (rest, copies, resident) = (Rest::default(), Copies::default(), Resident::default());
        Swarm { particles, lanes: None, rest, copies, resident, tasks }
    }

    /// Whether they run on several threads.
    pub fn is_parallel(&self) -> bool {
        self.tasks.len() > 1
    }

    /// The particles one by one, without the copies that are not made yet.
    pub fn alone(&mut self) -> &mut [Particle] {
        if let Some(lanes) = self.lanes.take() {
            lanes.part(&mut self.particles);
        }
        &mut self.particles
    }

    /// The particles one by one, all copies made.
    pub fn settled(&mut self, seed: u64) -> &mut Vec<Particle> {
        self.alone();
        self.copies.make(&mut self.particles, seed);
        &mut self.particles
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

    /// Runs every particle to its next barrier, except the one whose index is `held`; so many `barriers` were before.
    pub fn advance(
        &mut self,
        task: &Task,
        settings: &Settings,
        held: Option<usize>,
        barriers: usize,
    ) -> Result<(), Failure> {
        if held.is_none() && self.advance_together(task, settings, barriers) {
            return Ok(());
        }
        self.alone();
        let (seed, limit, tasks) = (settings.seed, task.limits.bytes, &self.tasks);
        let (room, failed, met) = (self.resident.room(limit), AtomicUsize::new(usize::MAX), Mutex::default());
        let step = Step { settings, held, limit, room, failed, met };
        if let [own] = &tasks[..] {
            self.copies.make(&mut self.particles, seed);
            let particles = self.particles.iter_mut().enumerate();
            step.run(own, &mut own.machine(), &mut Sight::default(), particles);
        } else {
            let size = (self.particles.len() / (TASKS * tasks.len())).clamp(1, BATCH);
            let batches = self.copies.batches(&mut self.particles, seed, size, tasks.len());
            share(batches, |thread| {
                let (step, own) = (&step, &tasks[thread]);
                let (mut machine, mut sight) = (own.machine(), Sight::default());
                move |mut batch: Vec<Indexed<'_>>| {
                    copy(&mut batch, seed);
                    let particles = batch.into_iter().map(|Indexed { index, particle, .. }| {
                        particle.home = thread;
                        (index, particle)
                    });
                    step.run(own, &mut machine, &mut sight, particles);
                }
            });
            self.copies.clear();
        }
        self.resident.grown(step.growth(task)?, task, &self.particles)
    }

    /// Runs the particles together to the next barrier; false where they are, or have gone, apart.
    fn advance_together(&mut self, task: &Task, settings: &Settings, barriers: usize) -> bool {
        if self.lanes.is_none() {
            if barriers < self.rest.until || !may_line_up(task, settings) {
                return false;
            }
            self.settled(settings.seed);
            self.rest.since = barriers;
            self.lanes = InLanes::line_up(&mut self.particles);
            if self.lanes.is_none() {
                self.rest.begin(barriers);
            }
        }
        let Some(lanes) = &mut self.lanes else { return false };
        let (resident, limit) = (&mut self.resident, task.limits.bytes);
        if lanes.advance(&mut self.tasks[0].machine(), |growth| resident.grown_together(growth, limit)) {
            return true;
        }
        self.alone();
        self.rest.begin(barriers);
        false
    }

    /// Changes every log weight.
    pub fn reweigh(&mut self, change: impl Fn(f64) -> f64) {
        match &mut self.lanes {
            Some(lanes) => lanes.log_weight.iter_mut().for_each(|log| *log = change(*log)),
            None => self.particles.iter_mut().for_each(|p| p.log_weight = change(p.log_weight)),
        }
    }

    /// Takes the copies of a resampling. They are made when the particles run again.
    pub fn copy(&mut self, copies: Copies, seed: u64) {
        self.copies = copies;
        if let Some(lanes) = &mut self.lanes {
            lanes.copy(&self.copies, seed);
            self.copies.clear();
        } else if self.is_parallel() {
            self.copies.share_out(&mut self.particles, self.tasks.len());
        }
    }

    /// What `work` says of the particles, batch by batch: one batch on this thread, or many on all threads.
    ///
    /// # Errors
    /// The first that it has.
    pub fn in_batches<T: Send>(
        &mut self,
        work: impl Fn(&mut [Particle]) -> Result<T, Failure> + Sync + Send,
    ) -> Result<Vec<T>, Failure> {
        let is_parallel = self.is_parallel();
        let particles = self.alone();
        if !is_parallel {
            return Ok(vec![work(particles)?]);
        }
        let all: Vec<Result<T, Failure>> = particles.par_chunks_mut(BATCH).map(work).collect();
        all.into_iter().collect()
    }
}

/// Whether the particles of such a search may run together at all: with all else than numbers, weights and copies they run
/// one by one.
fn may_line_up(task: &Task, settings: &Settings) -> bool {
    settings.lanes
        && settings.particles >= LEAST
        && settings.proposal.is_none()
        && settings.rejuvenate.is_none()
        && settings.look_ahead.is_none()
        && settings.order.policy().is_none()
        && settings.weights == Weights::Ratio
        && !matches!(settings.anneal, Anneal::Adaptive(_))
        && task.sketches.is_empty()
        && task.held.is_none()
        && task.together.is_none()
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

/// A step of all particles to their next barriers, in batches. Of several faults that of the first particle is reported, so that
/// threads do not matter. Particles after a failed one need not run: an endless model would use up its budget once for each.
struct Step<'a> {
    settings: &'a Settings,
    held: Option<usize>,
    /// The memory of all particles together, and by how much they may grow now, bytes.
    limit: usize,
    room: usize,
    /// The first particle with a fault; the first of all where they have grown too much.
    failed: AtomicUsize,
    /// By how much they have grown, and the fault of the first particle with one.
    met: Mutex<(Growth, Option<(usize, Failure)>)>,
}

impl Step<'_> {
    /// Runs the particles of a batch, with their indices.
    fn run<'p>(
        &self,
        task: &Task,
        machine: &mut Machine<'_>,
        sight: &mut Sight,
        batch: impl Iterator<Item = (usize, &'p mut Particle)>,
    ) {
        let (mut growth, mut fault) = (Growth::default(), None);
        for (index, particle) in batch {
            let is_late = index > self.failed.load(Ordering::Relaxed) || growth.up > self.room;
            if is_late || Some(index) == self.held {
                continue;
            }
            let run =
                |p: &mut Particle, machine: &mut Machine<'_>| advance(p, machine, task, self.settings, sight);
            if let Err(own) = counted(particle, machine, self.limit, &mut growth, run)
                && self.failed.fetch_min(index, Ordering::Relaxed) > index
            {
                fault = Some((index, own));
            }
        }
        let mut met = self.met.lock().unwrap_or_else(PoisonError::into_inner);
        met.0.add(growth);
        met.1 = met.1.take().into_iter().chain(fault).min_by_key(|fault| fault.0);
        if met.0.up > self.room {
            // The others need not run.
            self.failed.store(0, Ordering::Relaxed);
        }
    }

    /// By how much all have grown.
    fn growth(self, task: &Task) -> Result<Growth, Failure> {
        match self.met.into_inner().unwrap_or_else(PoisonError::into_inner) {
            (growth, _) if growth.up > self.room => Err(too_large(task)),
            (_, Some((_, own))) => Err(own),
            (growth, None) => Ok(growth),
        }
    }
}

/// Runs a particle to its next barrier, or to its end: choices are drawn by the proposal, where there is one for them.
fn advance(
    particle: &mut Particle,
    machine: &mut Machine<'_>,
    task: &Task,
    settings: &Settings,
    sight: &mut Sight,
) -> Result<(), Failure> {
    let (stream, fallback) = (particle.stream, Prior(particle.stream));
    match settings.proposal.as_deref() {
        None => particle.advance(machine, task, settings.seed, fallback)?,
        Some(proposal) => {
            sight.recall(&particle.glance);
            let chooser = ByProposal { proposal, stream, sight, fallback };
            particle.advance(machine, task, settings.seed, chooser)?
        }
    };
    particle.foresee(settings.look_ahead.as_ref(), task, machine, sight);
    Ok(())
}

//! Swarms: the particles of a population, which run from barrier to barrier: separately in a batch on this thread, separately in
//! batches on all threads, or together in lanes. The results are the same; only the time differs.

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

/// The most particles of a task of the thread pool.
const BATCH: usize = 16;
/// The number of tasks for each thread: the costs of particles differ, and ended particles cost nothing.
const TASKS: usize = 8;
/// The divisor of a population's memory budget that gives the budget of a running particle, if its own share is smaller.
const PARTS: usize = 64;

/// The particles of a population.
pub(super) struct Swarm {
    pub particles: Vec<Particle>,
    /// The lanes of particles that run together; `particles` is then unused.
    pub lanes: Option<InLanes>,
    /// The time of the next attempt to run together.
    rest: Rest,
    /// The pending copies of the last resampling.
    copies: Copies,
    /// The memory of the particles.
    resident: Resident,
    /// The task of a particle for each thread, with separate copies of the program for several threads.
    tasks: Vec<Task>,
}

impl Swarm {
    /// Create a swarm of copies of a particle. `serial` keeps it on a single thread, because other populations use the remaining threads.
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
        let limited = Task { limits: Limits { bytes, ..task.limits }, ..task.clone() };
        let tasks = if serial || n <= BATCH || threads == 1 {
            vec![limited]
        } else {
            let apart = task.program.copies_for_threads(threads).into_iter();
            apart.map(|program| Task { program: Arc::new(program), ..limited.clone() }).collect()
        };
        let (rest, copies, resident) = (Rest::default(), Copies::default(), Resident::default());
        Swarm { particles, lanes: None, rest, copies, resident, tasks }
    }

    /// Whether the particles run on several threads.
    pub fn is_parallel(&self) -> bool {
        self.tasks.len() > 1
    }

    /// Separate the particles; pending copies stay pending.
    pub fn alone(&mut self) -> &mut [Particle] {
        if let Some(lanes) = self.lanes.take() {
            lanes.part(&mut self.particles);
        }
        &mut self.particles
    }

    /// Separate the particles and make all pending copies.
    pub fn settled(&mut self, seed: u64) -> &mut Vec<Particle> {
        self.alone();
        self.copies.make(&mut self.particles, seed);
        &mut self.particles
    }

    /// The numbers of running and of ended particles, in a single pass, because a population does not fit into the cache.
    pub fn count(&self) -> (usize, usize) {
        if let Some(lanes) = &self.lanes {
            return if lanes.have_ended() { (0, lanes.len()) } else { (lanes.len(), 0) };
        }
        self.particles.iter().enumerate().fold((0, 0), |(running, ended), (index, p)| {
            let times = self.copies.count(index);
            (running + times * usize::from(p.is_running()), ended + times * usize::from(p.state.has_ended()))
        })
    }

    /// Run every particle to its next barrier, except the `held` particle. `barriers` is the number of barriers before.
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
        if let [thread_task] = &tasks[..] {
            self.copies.make(&mut self.particles, seed);
            let particles = self.particles.iter_mut().enumerate();
            step.run(thread_task, &mut thread_task.machine(), &mut Sight::default(), particles);
        } else {
            let size = (self.particles.len() / (TASKS * tasks.len())).clamp(1, BATCH);
            let batches = self.copies.batches(&mut self.particles, seed, size, tasks.len());
            share(batches, |thread| {
                let (step, thread_task) = (&step, &tasks[thread]);
                let (mut machine, mut sight) = (thread_task.machine(), Sight::default());
                move |mut batch: Vec<Indexed<'_>>| {
                    copy(&mut batch, seed);
                    let particles = batch.into_iter().map(|Indexed { index, particle, .. }| {
                        particle.home = thread;
                        (index, particle)
                    });
                    step.run(thread_task, &mut machine, &mut sight, particles);
                }
            });
            self.copies.clear();
        }
        self.resident.grown(step.growth(task)?, task, &self.particles)
    }

    /// Run the particles together to the next barrier; return false if they are or become separate.
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

    /// Change every log weight.
    pub fn reweigh(&mut self, change: impl Fn(f64) -> f64) {
        match &mut self.lanes {
            Some(lanes) => lanes.log_weight.iter_mut().for_each(|log| *log = change(*log)),
            None => self.particles.iter_mut().for_each(|p| p.log_weight = change(p.log_weight)),
        }
    }

    /// Register the copies of a resampling, which are made when the particles run again.
    pub fn copy(&mut self, copies: Copies, seed: u64) {
        self.copies = copies;
        if let Some(lanes) = &mut self.lanes {
            lanes.copy(&self.copies, seed);
            self.copies.clear();
        } else if self.is_parallel() {
            self.copies.share_out(&mut self.particles, self.tasks.len());
        }
    }

    /// Collect the results of `work` for batches of particles: a single batch on this thread, or many batches on all threads.
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

/// The waiting time until separate particles try to run together again: a single barrier if they stayed together for longer than they
/// had waited, otherwise twice the previous time.
#[derive(Default)]
struct Rest {
    /// The first barrier at which they may run together.
    until: usize,
    /// The next waiting time, barriers.
    length: usize,
    /// The barrier at which they last began to run together.
    since: usize,
}

impl Rest {
    /// The shortest rest after a failure, and the longest, barriers.
    const SHORTEST: usize = 4;
    const LONGEST: usize = 256;

    /// Register that the particles are separate at a barrier.
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
    /// The first particle with a fault; the first particle of all if their memory has grown too much.
    failed: AtomicUsize,
    /// The growth of the particles, and the fault of the first failed particle.
    met: Mutex<(Growth, Option<(usize, Failure)>)>,
}

impl Step<'_> {
    /// Run the particles of a batch, with their indices.
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
            if let Err(failure) = counted(particle, machine, self.limit, &mut growth, run)
                && self.failed.fetch_min(index, Ordering::Relaxed) > index
            {
                fault = Some((index, failure));
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

    /// The growth of all particles.
    fn growth(self, task: &Task) -> Result<Growth, Failure> {
        match self.met.into_inner().unwrap_or_else(PoisonError::into_inner) {
            (growth, _) if growth.up > self.room => Err(too_large(task)),
            (_, Some((_, failure))) => Err(failure),
            (growth, None) => Ok(growth),
        }
    }
}

/// Run a particle to its next barrier or to its end. The proposal draws the choices that it covers.
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

//! The population and its steps: advance, weigh, resample. A [`sweep`](niwaki_propose::sweep) takes them in turn, also
//! with a held particle in conditional SMC.

use crate::copies::{Ancestry, Copies};
use crate::powers::Powers;
use crate::rejuvenation::{MoveCounts, Mover, Moves};
use crate::settings::{Anneal, Settings, Weights, When};
use crate::smc::Progress;
use crate::swarm::Swarm;
use crate::tempered::Tempered;
use niwaki_propose::particle::Particle;
use niwaki_propose::sweep::Particles;
use niwaki_run::blame::RUNS;
use niwaki_run::failure::Dead;
use niwaki_run::losses::Losses;
use niwaki_run::order::{Order, Past};
use niwaki_run::record::{AllInvalid, Record};
use niwaki_run::resampling::Resampling;
use niwaki_run::streams::Reserved;
use niwaki_run::weights::Normalised;
use niwaki_run::{Failure, Task};

/// A population: particles, and records of their past.
pub(super) struct Population<'a> {
    pub task: Task,
    pub settings: &'a Settings,
    /// The particles.
    pub swarm: Swarm,
    pub ancestry: Ancestry,
    pub powers: Powers,
    pub estimate: Estimate,
    pub moves: Moves,
    pub barriers: usize,
    pub counts: Counts,
    /// Losses: particles that became impossible so far.
    pub losses: Losses,
}

/// The state of the weights.
pub(super) struct Estimate {
    /// The weights since the last resampling.
    pub weights: Normalised,
    /// The log of the estimated normalising constant so far.
    pub log_normaliser: f64,
    /// The log weights at a barrier, in a buffer that is reused at each barrier.
    logs: Vec<f64>,
}

/// Counters of a population.
#[derive(Default)]
pub(super) struct Counts {
    /// The number of particle steps: runs of a particle to a barrier.
    pub steps: u64,
    /// The number of barriers with resampling.
    pub resampled: usize,
    /// The number of particles that were possible before this barrier.
    possible: usize,
}

impl<'a> Population<'a> {
    /// Create a population before its start. `serial` keeps it on a single thread, because other populations use the remaining threads.
    pub fn start(task: &Task, settings: &'a Settings, serial: bool) -> Result<Self, Failure> {
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
        let first = Particle { past, ..Particle::start(first, empty, 0, settings.seed) };
        Population::of(task, settings, serial, first)
    }

    /// Create a population whose particles resume from a paused particle.
    pub fn go_on(task: &Task, settings: &'a Settings, from: &mut Particle) -> Result<Self, Failure> {
        let (state, past) = (from.state.clone(), from.past.clone());
        let first = Particle::start(state, from.record.fork(), 0, settings.seed);
        Population::of(task, settings, true, Particle { past, ..first })
    }

    /// Create a population of copies of a particle, of weight 1.
    fn of(task: &Task, settings: &'a Settings, serial: bool, first: Particle) -> Result<Self, Failure> {
        let (n, powers) = (settings.particles, Powers::start(settings));
        let log_normaliser = powers.now * first.record.log_score();
        Ok(Population {
            swarm: Swarm::of(task, settings, serial, first),
            ancestry: Ancestry::of(n),
            powers,
            estimate: Estimate {
                weights: Normalised::default(),
                log_normaliser,
                logs: Vec::with_capacity(n),
            },
            moves: Moves { mover: Mover::of(task, settings)?, counts: MoveCounts::default() },
            barriers: 0,
            counts: Counts { possible: n, ..Counts::default() },
            losses: Losses::default(),
            task: task.clone(),
            settings,
        })
    }

    /// Separate the particles, and make the copies of the last resampling.
    pub fn settled(&mut self) -> &mut Vec<Particle> {
        self.swarm.settled(self.settings.seed)
    }

    /// Add the scores of separate particles to their weights. Returns the best score and the number of ended particles.
    fn weigh_alone(&mut self, next: f64) -> (f64, usize) {
        let (mut best, mut ended) = (f64::NEG_INFINITY, 0);
        for p in self.swarm.alone() {
            let score = p.record.score();
            best = best.max(score.value());
            ended += usize::from(p.state.has_ended());
            if score.is_impossible() && !p.weighed.is_impossible() {
                self.losses.note(&p.record);
            }
            match self.settings.weights {
                Weights::Ratio => p.log_weight += p.log_step(next, &score, self.powers.now),
                Weights::Absolute => p.log_weight = self.settings.power * score.value(),
            }
            p.weighed = score;
            p.foreseen = p.ahead;
            self.estimate.logs.push(p.log_weight);
        }
        (best, ended)
    }

    /// Weigh the final set by the declared power, and normalise its weights; return false if no particle is possible.
    pub fn finish(&mut self) -> bool {
        let (power, declared) = (self.powers.now, self.settings.power);
        let particles = self.swarm.settled(self.settings.seed);
        // Those that ended have no twist; of a search that was stopped others are left.
        for p in particles.iter_mut().filter(|p| p.is_running() && p.foreseen != 0.0) {
            p.log_weight -= power * std::mem::take(&mut p.foreseen);
        }
        if power != declared {
            for p in particles.iter_mut().filter(|p| !p.weighed.is_impossible()) {
                p.log_weight += (declared - power) * p.weighed.value();
            }
            self.powers.now = declared;
        }
        let possible = self.estimate.weights.read(particles.iter().map(|p| p.log_weight));
        if possible {
            self.estimate.log_normaliser += self.estimate.weights.log_mean;
        }
        possible
    }
}

impl Particles for Population<'_> {
    type Seen = Progress;

    fn running(&mut self) -> usize {
        let (running, ended) = self.swarm.count();
        self.counts.possible = running + ended;
        running
    }

    /// The caller runs the `held` particle.
    fn advance(&mut self, held: Option<usize>) -> Result<(), Failure> {
        self.swarm.advance(&self.task, self.settings, held, self.barriers)
    }

    fn weigh(&mut self) -> Result<Progress, Failure> {
        self.barriers += 1;
        self.estimate.logs.clear();
        let (next, best, ended);
        if let Some(lanes) = &mut self.swarm.lanes {
            next = self.powers.next(self.settings, self.barriers, &[]);
            best = lanes.weigh(next, self.powers.now);
            ended = if lanes.have_ended() { lanes.len() } else { 0 };
            self.estimate.logs.extend(&lanes.log_weight);
        } else {
            let particles = self.swarm.alone();
            // The ratios of proposed choices since the last barrier. They are not raised to a power, as the prior is not; the
            // power is chosen after they count.
            if self.settings.proposal.is_some() {
                particles.iter_mut().for_each(|p| p.log_weight += std::mem::take(&mut p.pending));
            }
            next = self.powers.next(self.settings, self.barriers, particles);
            (best, ended) = self.weigh_alone(next);
        }
        self.powers.now = next;
        if self.settings.anneal != Anneal::Constant {
            self.powers.each.push(next);
        }
        if !self.estimate.weights.read(self.estimate.logs.iter().copied()) {
            let particles = self.swarm.alone();
            AllInvalid::check_all(particles.iter().map(|p| p.record.invalid.as_ref()))?;
            return Err(impossible(particles, self.barriers));
        }
        // Particles that ended now reached no barrier.
        self.counts.steps += (self.counts.possible - ended) as u64;
        Ok(Progress { barriers: self.barriers, ended, best })
    }

    fn is_low(&self) -> bool {
        match self.settings.when {
            _ if self.settings.weights == Weights::Absolute => true,
            When::Always => true,
            When::EffectiveBelow(share) => {
                self.estimate.weights.effective < share * self.settings.particles as f64
            }
        }
    }

    /// Weights are reset, or keep their tempered remainder. Copies are made when the particles run again.
    fn resample(&mut self, held: Option<usize>) -> Result<Option<usize>, Failure> {
        let (method, seed) = (self.settings.resampling, self.settings.seed);
        let mut random = Reserved::Resampling.stream(seed, self.barriers as u128, 0);
        let tempered = match method {
            Resampling::Tempered => Tempered::of(self.estimate.logs.iter().copied()),
            _ => None,
        };
        let weights = tempered.as_ref().map_or(&self.estimate.weights, |tempered| &tempered.weights);
        let copies = method.copies_with(held, &weights.relative, &mut random);
        let log_mean = self.estimate.weights.log_mean;
        self.swarm.reweigh(|log_weight| {
            tempered.as_ref().map_or(0.0, |weights| weights.carried(log_weight, log_mean))
        });
        self.estimate.log_normaliser += log_mean;
        self.counts.resampled += 1;
        self.swarm.copy(Copies::plan(copies, &mut self.ancestry), seed);
        // The first copy keeps the index of its parent.
        Ok(held)
    }

    fn rejuvenate(&mut self, resampled: bool) -> Result<(), Failure> {
        self.move_particles(Some(resampled))
    }
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

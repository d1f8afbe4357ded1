//! Particles: runs that stop at barriers, of a population or of a part that is grown again.

use crate::guide::bound::Glance;
use niwaki_math::{Stream, StreamKey, Total};
use niwaki_run::Failure;
use niwaki_run::chooser::Chooser;
use niwaki_run::forward::Forward;
use niwaki_run::order::Past;
use niwaki_run::record::Record;
use niwaki_run::task::Task;
use niwaki_run::weights::log_step;
use niwaki_vm::machine::state::State;
use niwaki_vm::machine::{Machine, Stop};
use niwaki_vm::value::Census;

/// The visit of the particle's stream for order choices.
const ORDER: u64 = 1;

/// A particle.
pub struct Particle {
    /// The activations of the run.
    pub state: State,
    /// The choices, scores and scene so far.
    pub record: Record,
    /// The number of the random stream; no other particle has or had it.
    pub lineage: u64,
    /// The key of the random stream, for the choices of the model.
    pub stream: StreamKey,
    /// The number of order choices so far.
    pub picks: u64,
    /// The past of the run, as the order policy sees it.
    pub past: Past,
    /// Whether the run had ended before the last barrier.
    pub was_ended: bool,
    /// The score that the weight already counts.
    pub weighed: Total,
    /// The log weight since the last resampling, including the weight that the resampling left.
    pub log_weight: f64,
    /// The log of prior over proposal of the choices since the last barrier, which the weight does not count yet.
    pub pending: f64,
    /// The view of the guide at the last pause.
    pub glance: Glance,
    /// The log twist at this barrier, at power 1, nats ([`LookAhead`](crate::look_ahead::LookAhead)).
    pub ahead: f64,
    /// The log twist that the weight counts.
    pub foreseen: f64,
    /// The thread that ran the particle last.
    pub home: usize,
    /// The bytes of the activations at the last count.
    pub bytes: isize,
}

/// A turn: the moment before a future of a particle runs.
#[derive(Clone, Copy)]
pub struct Turn<'a> {
    /// The activations of the particle.
    pub state: &'a State,
    /// The past of the run, as the order policy sees it.
    pub past: &'a Past,
    /// How many order choices it has drawn.
    pub picks: u64,
}

impl Turn<'_> {
    /// Draw the place of a future by the order policy, with the random stream of the lineage.
    #[inline(always)]
    pub fn pick(self, seed: u64, lineage: u64) -> usize {
        if self.state.runnable().len() < 2 { 0 } else { self.draw(seed, lineage) }
    }

    // Inlined, the key of the stream would be made for each run of a particle.
    #[inline(never)]
    fn draw(self, seed: u64, lineage: u64) -> usize {
        let u = Stream::new(seed, lineage, u128::from(self.picks + 1), ORDER).uniform();
        self.past.pick(self.state, u)
    }
}

impl Particle {
    /// Create a particle of weight 1 before its start, with the score of its scene so far.
    pub fn start(state: State, record: Record, lineage: u64, seed: u64) -> Particle {
        Particle {
            state,
            weighed: record.score(),
            record,
            lineage,
            stream: StreamKey::new(seed, lineage, 0),
            picks: 0,
            past: Past::default(),
            was_ended: false,
            log_weight: 0.0,
            pending: 0.0,
            glance: Glance::default(),
            ahead: 0.0,
            foreseen: 0.0,
            home: 0,
            bytes: 0,
        }
    }

    /// Whether the particle still runs.
    pub fn is_running(&self) -> bool {
        !self.state.has_ended() && self.record.cause.is_none()
    }

    /// Run to the next barrier or to the end. A chooser gives the new choices, and the order policy picks the futures. Returns
    /// whether the particle paused.
    pub fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        task: &Task,
        seed: u64,
        chooser: impl Chooser,
    ) -> Result<bool, Failure> {
        self.was_ended = self.state.has_ended();
        let lineage = self.lineage;
        let pick = |_: &mut _, turn: Turn<'_>| Some(turn.pick(seed, lineage));
        self.advance_by(machine, task, pick, chooser)
    }

    /// Like [`Particle::advance`], but `pick` gives the place of the future that runs next; `None` stops the particle.
    #[inline(always)]
    pub fn advance_by<C: Chooser>(
        &mut self,
        machine: &mut Machine<'_>,
        task: &Task,
        mut pick: impl FnMut(&mut C, Turn<'_>) -> Option<usize>,
        chooser: C,
    ) -> Result<bool, Failure> {
        let (past, picks, program) = (&mut self.past, &mut self.picks, machine.program());
        let (record, hosts, log_ratio) = (&mut self.record, &*task.hosts, self.pending);
        let mut answers = Forward { record, chooser, log_ratio, hosts, barriers: true, complete: false };
        let mut has_paused = false;
        let driven = machine.drive(&mut self.state, &mut answers, |answers, state, last| {
            if let Some((future, stop)) = last {
                has_paused = stop == Stop::Paused;
                past.ran(future, state);
            }
            if has_paused || answers.record.cause.is_some() {
                return None;
            }
            past.look(program, state);
            let place = pick(&mut answers.chooser, Turn { state, past, picks: *picks })?;
            if state.runnable().len() > 1 {
                *picks += 1;
                let future = state.runnable().get(place)?;
                answers.record.log.push_order(state.path_of(future), place);
            }
            Some(place)
        });
        self.pending = answers.log_ratio;
        match driven {
            Ok(()) => Ok(has_paused),
            Err(met) => self.record.forgive(task, met).map(|()| false),
        }
    }

    /// Run to the end, across all barriers. `pick` gives the place of the future that runs next.
    pub fn finish_by<C: Chooser>(
        &mut self,
        machine: &mut Machine<'_>,
        task: &Task,
        mut pick: impl FnMut(&State) -> usize,
        mut chooser: C,
    ) -> Result<(), Failure> {
        while self.is_running() {
            self.advance_by(machine, task, |_, turn| Some(pick(turn.state)), &mut chooser)?;
        }
        Ok(())
    }

    /// The log weight of a step to a score at the power `next`, nats: the new forecast counts in place of the previous forecast.
    #[inline(always)]
    pub fn log_step(&self, next: f64, score: &Total, power: f64) -> f64 {
        log_step(next, score, power, &self.weighed) + (next * self.ahead - power * self.foreseen)
    }

    /// Count the values of the particle and its choices.
    pub fn count<'v>(&'v self, census: &mut Census<'v>) {
        self.state.count(census);
        self.record.log.count(census);
    }

    /// Copy the particle for a trial. The copy has the same lineage, so it must not draw random numbers.
    pub fn fork(&mut self) -> Particle {
        Particle {
            state: self.state.clone(),
            record: self.record.fork(),
            past: self.past.clone(),
            weighed: self.weighed.clone(),
            glance: self.glance.clone(),
            ..*self
        }
    }

    /// Become a copy of `parent`, with a new random stream.
    pub fn copy_from(&mut self, parent: &mut Particle, lineage: u64, seed: u64) {
        self.state.clone_from(&parent.state);
        self.record.become_copy(&mut parent.record);
        self.lineage = lineage;
        self.stream = StreamKey::new(seed, lineage, 0);
        self.picks = parent.picks;
        self.past.clone_from(&parent.past);
        self.was_ended = parent.was_ended;
        self.weighed.clone_from(&parent.weighed);
        self.log_weight = parent.log_weight;
        self.pending = parent.pending;
        self.glance.become_copy(&parent.glance);
        self.ahead = parent.ahead;
        self.foreseen = parent.foreseen;
        self.home = parent.home;
    }
}

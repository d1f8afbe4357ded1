//! One particle, and how it runs to its next barrier: of a population, or of a part that is grown again.

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
    /// Its activations.
    pub state: State,
    /// Its choices, scores and scene so far.
    pub record: Record,
    /// Number of its random stream; no other particle has or had it.
    pub lineage: u64,
    /// That stream's key, for the choices of the model.
    pub stream: StreamKey,
    /// How many order choices it has drawn.
    pub picks: u64,
    /// What the order policy has seen of its run.
    pub past: Past,
    /// Whether it had ended before the last barrier.
    pub was_ended: bool,
    /// The score that is already in its weight.
    pub weighed: Total,
    /// Log weight since the last resampling, with what that one left of the weight before.
    pub log_weight: f64,
    /// Log of prior over proposal of the choices since the last barrier: not yet in its weight.
    pub pending: f64,
    /// What its guide saw when it paused.
    pub glance: Glance,
    /// Log of its twist at this barrier, at power 1, nats ([`LookAhead`](crate::look_ahead::LookAhead)).
    pub ahead: f64,
    /// The log twist that is in its weight.
    pub foreseen: f64,
    /// The thread that ran it last.
    pub home: usize,
    /// Bytes of its activations when they were counted last.
    pub bytes: isize,
}

/// The moment before one of the futures of a particle runs.
#[derive(Clone, Copy)]
pub struct Turn<'a> {
    /// The particle's activations.
    pub state: &'a State,
    /// What the order policy has seen of its run.
    pub past: &'a Past,
    /// How many order choices it has drawn.
    pub picks: u64,
}

impl Turn<'_> {
    /// The place of a future drawn by the order policy, for the particle with this random stream.
    #[inline(always)]
    pub fn pick(self, seed: u64, lineage: u64) -> usize {
        match self.state.runnable().len() {
            0 | 1 => 0,
            _ => {
                let u = Stream::new(seed, lineage, u128::from(self.picks + 1), ORDER).uniform();
                self.past.pick(self.state, u)
            }
        }
    }
}

impl Particle {
    /// A particle that has not begun, of weight one: it has the score of its scene so far.
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

    /// Whether it still runs.
    pub fn is_running(&self) -> bool {
        !self.state.has_ended() && self.record.cause.is_none()
    }

    /// Runs to the next barrier, or to the end; a chooser gives the new choices, and the seed picks the futures. Returns
    /// whether it paused.
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

    /// Like [`Particle::advance`], but `pick` gives the place of the future that runs next; `None` leaves the particle where it
    /// is.
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
            let which = pick(&mut answers.chooser, Turn { state, past, picks: *picks })?;
            if state.runnable().len() > 1 {
                *picks += 1;
                let future = state.runnable().get(which)?;
                answers.record.log.push_order(state.path_of(future), which);
            }
            Some(which)
        });
        self.pending = answers.log_ratio;
        match driven {
            Ok(()) => Ok(has_paused),
            Err(met) => self.record.forgive(task, met).map(|()| false),
        }
    }

    /// Runs to the end, over all barriers.
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

    /// The log weight of its step from the score weighed before at a power to a score at the next power, nats: its forecast is
    /// counted, and the one before taken back.
    #[inline(always)]
    pub fn log_step(&self, next: f64, score: &Total, power: f64) -> f64 {
        log_step(next, score, power, &self.weighed) + (next * self.ahead - power * self.foreseen)
    }

    /// Counts the values that it holds, and its choices.
    pub fn count<'v>(&'v self, census: &mut Census<'v>) {
        self.state.count(census);
        self.record.log.count(census);
    }

    /// A copy for a trial. It has the same lineage, so it must not draw random numbers.
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

    /// Becomes a copy of `parent`, with a new random stream.
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

//! Rounds of edits: an edit of the run, moves that improve it, and a comparison with the run that it comes from.

use super::edits::{self, Edit, Values};
use super::part_seed;
use super::rounds::Search;
use niwaki_chain::kernel::Kernel;
use niwaki_chain::leaf::Proposer;
use niwaki_chain::leaf::regrow::Regrow;
use niwaki_chain::plan::Plan;
use niwaki_chain::walk::state::State;
use niwaki_chain::walk::streams::Streams;
use niwaki_chain::{Chain, Settings};
use niwaki_math::RngCore;
use niwaki_run::streams::Reserved;
use niwaki_run::{Failure, Task};

/// The most runs that are tried for an edit.
const TRIES: u64 = 4;
/// The work of the first stage of moves that improve an edited run, as proposals for each of its choices; each further stage has twice as
/// much.
const FIRST: u64 = 1;
/// The most stages.
const STAGES: u32 = 6;
/// An edited run that lacks more than this share of what it lacked before a stage is given up.
const LACKING: f64 = 0.6;
/// The number of proposals between two looks at the work.
const LOOK: u64 = 8;

impl Search<'_> {
    /// Makes edits of the present run, each improved by proposals of `kernel`. Returns their work, and how many were kept.
    ///
    /// # Errors
    /// A fault of the program.
    pub(super) fn levels(
        &mut self,
        kernel: &Kernel,
        number: u64,
        may_continue: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(u64, u64), Failure> {
        self.prepare(kernel)?;
        let Some(mut present) = self.state.take() else { return Ok((self.slice, 0)) };
        let seed = part_seed(self.seed, number, 9);
        let (mut work, mut kept) = (0, 0);
        for visit in 0.. {
            if work >= self.slice || !may_continue(self.best.log_score) {
                break;
            }
            let mut rng = Reserved::Improve.stream(seed, visit, 0);
            let length = present.primitives as u64 + 1;
            let Some(edit) = edits::draw(self.task, &present, &self.tries, &mut rng)? else {
                work = self.slice;
                break;
            };
            let Edit { values, form, runs } = edit;
            work += runs * length;
            let chain_seed = rng.next_u64();
            let Some((edited, tries)) = possible(self.task, &values, chain_seed)? else {
                work += TRIES * length;
                self.tries.note(form, false);
                continue;
            };
            work += tries * length;
            let new = edits::new_parts(self.task, &edited, &values);
            let so_far = present.log_score();
            let mut chain = self.chain(kernel, edited, chain_seed, 0)?;
            if !new.is_empty() && !self.task.program.memoises() {
                let regrow = Regrow::best_of(new.clone(), self.improve.regrow, self.improve.drawn_by.clone());
                let grow = Kernel::Leaf(Proposer::Regrow(Box::new(regrow)));
                let mut grown = self.chain(&grow, chain.into_state(), chain_seed, 1)?;
                grown.advance(self.task, new.len() as u64, &mut |_, _| true)?;
                work += grown.work();
                chain = self.chain(kernel, grown.into_state(), chain_seed, 2)?;
            }
            let before = chain.work();
            let (mut stage, mut lack) = (FIRST * chain.state.trace.len() as u64, f64::INFINITY);
            for _ in 0..STAGES {
                let lacking = so_far - chain.best.score();
                if lacking < 0.0 || lacking > LACKING * lack {
                    break;
                }
                lack = lacking;
                let end = chain.work() + stage;
                while chain.work() < end && may_continue(self.best.log_score.max(chain.best.score())) {
                    chain.advance(self.task, LOOK, &mut |_, _| true)?;
                }
                stage *= 2;
            }
            work += chain.work() - before;
            let score = chain.best.score();
            if score > self.best.log_score {
                self.best = chain.best.get(&chain.state, self.task)?;
            }
            self.tries.note(form, score > so_far);
            if score > so_far {
                kept += 1;
                present = chain.into_state();
            }
        }
        self.state = Some(present);
        Ok((work, kept))
    }

    /// A chain from a state.
    fn chain(&self, kernel: &Kernel, state: State, seed: u64, number: u64) -> Result<Chain, Failure> {
        let settings = Settings { seed, thin: 0, ..Settings::default() };
        let mut chain = Chain::at(self.task, &settings, number, Plan::new(kernel)?, state, &self.spreads)?;
        chain.restrict(self.improve.power, None);
        Ok(chain)
    }
}

/// The state of a possible run with these values, and the number of runs. `None` if there was none.
fn possible(task: &Task, values: &Values, seed: u64) -> Result<Option<(State, u64)>, Failure> {
    match State::tried(task, Streams::new(seed, 0), TRIES, Some(values)) {
        Ok((state, _, tries)) => Ok(Some((state, tries))),
        Err(Failure::NoStart { .. }) => Ok(None),
        Err(failure) if failure.is_impossible() => Ok(None),
        Err(failure) => Err(failure),
    }
}

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

/// The number of runs after which an edit without a possible one is given up.
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
            let most = self.improve.regrow;
            let Some(edit) = edits::draw(self.task, &present, &self.tries, most, &mut rng)? else {
                work = self.slice;
                break;
            };
            let Edit { mut ways, form, runs, slide } = edit;
            let chain_seed = rng.next_u64();
            if let Some(choice) = slide {
                let mut chain = self.chain(kernel, present, chain_seed, 3)?;
                let slides = chain.slides(self.task, choice, most, &mut rng)?;
                work += chain.work();
                present = chain.into_state();
                let slid = |moves| ways[0].clone().into_iter().chain(moves).collect();
                ways = slides.into_iter().map(slid).collect::<Vec<Values>>();
                if ways.is_empty() {
                    self.tries.note(form, false);
                    continue;
                }
            }
            let (edited, tries) = self.best_way(&ways, chain_seed)?;
            work += (runs + tries) * length;
            let Some(Way { state: edited, new }) = edited else {
                self.tries.note(form, false);
                continue;
            };
            let so_far = present.log_score();
            if new.is_empty() && edited.log_score().to_bits() == so_far.to_bits() {
                self.tries.note(form, false);
                continue;
            }
            let mut chain = self.chain(kernel, edited, chain_seed, 0)?;
            if !new.is_empty() && !self.task.program.memoises() {
                let regrow = Regrow::best_of(new.clone(), self.improve.regrow, self.improve.drawn_by.clone());
                let grow = Kernel::Leaf(Proposer::Regrow(Box::new(regrow)));
                let mut grown = self.chain(&grow, chain.into_state(), chain_seed, 1)?;
                grown.advance(self.task, new.len() as u64, &mut |_, _| true)?;
                work += grown.work();
                chain = self.chain(kernel, grown.into_state(), chain_seed, 2)?;
            }
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
            work += chain.work();
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

    /// The best of several runs of an edit, and the number of runs. Runs differ in the ways of the edit, and in their new values;
    /// where new values have a scene of their own, particles draw them later, and the first possible run is enough.
    fn best_way(&self, ways: &[Values], seed: u64) -> Result<(Option<Way>, u64), Failure> {
        let mut best: Option<Way> = None;
        let most = TRIES.max(self.improve.regrow as u64);
        for number in 0..most {
            let values = &ways[number as usize % ways.len()];
            let Some(state) = possible(self.task, values, seed, number)? else {
                if best.is_none() && number + 1 >= TRIES.max(ways.len() as u64) {
                    return Ok((None, number + 1));
                }
                continue;
            };
            let new = edits::new_parts(self.task, &state, values);
            let is_known =
                || state.choices(&self.task.program).all(|(address, _)| values.contains_key(&address));
            let is_enough = !new.is_empty() || number as usize + 1 >= ways.len() && is_known();
            if best.as_ref().is_none_or(|best| state.log_score() > best.state.log_score()) {
                best = Some(Way { state, new });
            }
            if is_enough {
                return Ok((best, number + 1));
            }
        }
        Ok((best, most))
    }

    /// A chain from a state.
    fn chain(&self, kernel: &Kernel, state: State, seed: u64, number: u64) -> Result<Chain, Failure> {
        let settings = Settings { seed, thin: 0, ..Settings::default() };
        let mut chain = Chain::at(self.task, &settings, number, Plan::new(kernel)?, state, &self.spreads)?;
        chain.restrict(self.improve.power, None);
        Ok(chain)
    }
}

/// A run of an edit, and its parts that are new and have a scene of their own.
struct Way {
    state: State,
    new: Vec<u128>,
}

/// The state of a run with these values. `None` if it is impossible or invalid.
fn possible(task: &Task, values: &Values, seed: u64, number: u64) -> Result<Option<State>, Failure> {
    match State::tried(task, Streams::new(seed, number), 1, Some(values)) {
        Ok((state, ..)) => Ok(Some(state)),
        Err(Failure::NoStart { .. }) => Ok(None),
        Err(failure) if failure.is_impossible() => Ok(None),
        Err(failure) => Err(failure),
    }
}

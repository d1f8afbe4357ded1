//! Walks: what a final set of copies becomes when a few of it are followed further. So many particles are drawn by
//! weight, a chain that keeps the final law starts from each, and its states, so many proposals apart, take the place of
//! the final set.
//!
//! Each state is one of a particle that was drawn by weight and then moved a number of times that is fixed beforehand:
//! the first states of all chains once `moves`, the second ones twice, and so on. So each keeps expectations as they are,
//! as moves of every particle do, and the evidence is not touched. What makes walks cheaper is that a run is built once for a
//! chain and not once for a copy, and what makes them go further is that states of one chain stand on each other.

use super::moves::CHAINS;
use super::population::Population;
use super::smc::{Outcome, Progress};
use crate::Failure;
use crate::chain::state::State as ChainState;
use crate::chain::{Chain, Settings as ChainSettings};
use crate::record::Record;
use crate::replay::by_address;
use niwaki_math::Stream;
use niwaki_math::streams::RngCore;
use rayon::prelude::*;

/// The stream of the draw of the particles that walk: no lineage has this number.
const STARTS: u64 = u64::MAX - 9;

/// Chains from a few particles of the final set, instead of moves of all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Walks {
    /// How many chains.
    pub chains: usize,
    /// States of each that are kept, `moves` proposals apart.
    pub draws: usize,
}

impl Population<'_> {
    /// The states of the walks where they are asked for, those of the first chain first, all of equal weight, and whether
    /// `watch` stopped them. It is told after every state of each chain.
    ///
    /// # Errors
    /// A fault of the program, or a kernel that makes no sense for it.
    pub fn walk(
        &mut self,
        watch: &mut dyn FnMut(Progress) -> bool,
    ) -> Result<Option<(Vec<Outcome>, bool)>, Failure> {
        let Some(rejuvenation) = &self.settings.rejuvenate else { return Ok(None) };
        let (Some(walks), Some(mover)) = (rejuvenation.walks, self.mover.clone()) else { return Ok(None) };
        if self.weights.relative.is_empty() {
            return Ok(None);
        }
        let (seed, moves, temper) = (self.settings.seed, rejuvenation.moves, self.temper);
        let mut chains: Vec<(Chain, Vec<Outcome>)> = Vec::with_capacity(walks.chains);
        for (number, row) in self.starts(walks.chains).into_iter().enumerate() {
            let p = &mut self.particles[row];
            let known = by_address(&p.record.log.entries());
            let state =
                ChainState::of_run(&self.task, &known, p.record.sketches.fork(), p.record.primitives)?;
            let seed = Stream::new(seed, CHAINS, u128::from(u64::MAX), number as u64).next_u64();
            let settings = ChainSettings { seed, thin: 0, ..ChainSettings::default() };
            let mut chain = Chain::at(&self.task, &settings, 0, mover.plan.clone(), state, &mover.spreads)?;
            chain.restrict(temper, None);
            chains.push((chain, Vec::with_capacity(walks.draws)));
        }
        let (task, first) = (&self.task, self.lineages);
        let on = |(number, (chain, states)): (usize, &mut (Chain, Vec<Outcome>))| -> Result<(), Failure> {
            if !chain.state.trace.is_empty() {
                chain.advance(task, moves, &mut |_, _| true)?;
            }
            let lineage = first + (number * walks.draws + states.len()) as u64;
            states.push(state_of(chain, &task.program, lineage));
            Ok(())
        };
        let mut going_on = true;
        for _ in 0..walks.draws {
            if self.parallel && chains.len() > 1 {
                chains.par_iter_mut().enumerate().map(on).collect::<Result<Vec<()>, _>>()?;
            } else {
                chains.iter_mut().enumerate().try_for_each(on)?;
            }
            let best = chains.iter().map(|(chain, _)| chain.best.score()).fold(f64::NEG_INFINITY, f64::max);
            going_on = watch(Progress { barriers: self.barriers, ended: self.particles.len(), best });
            if !going_on {
                break;
            }
        }
        for (chain, _) in &chains {
            let mut count = chain.counts.many;
            chain.counts.sites.iter().for_each(|site| count += *site);
            count.outside = 0;
            self.moved.ended += count;
        }
        let states = chains.into_iter().flat_map(|(_, states)| states).collect();
        Ok(Some((states, !going_on)))
    }

    /// Rows drawn by weight, evenly spread (systematic resampling to another number of rows).
    fn starts(&self, chains: usize) -> Vec<usize> {
        #[cfg(test)]
        if self.settings.is(super::tests::Mutant::StartsAtBest) {
            let score = |row: &usize| self.particles[*row].record.log_score();
            let best = (0..self.particles.len()).max_by(|a, b| score(a).total_cmp(&score(b)));
            return vec![best.unwrap_or(0); chains];
        }
        let u = Stream::new(self.settings.seed, STARTS, 0, 0).uniform();
        (0..chains).map(|number| self.weights.row((number as f64 + u) / chains as f64)).collect()
    }
}

/// Where a chain is, as one of the final set.
fn state_of(chain: &mut Chain, program: &niwaki_vm::code::Program, lineage: u64) -> Outcome {
    let state = &mut chain.state;
    let totals = state.trace.totals();
    Outcome {
        record: Record {
            log: state.choices(program).collect(),
            log_prior: totals.log_prior.clone(),
            log_factors: totals.log_factors.clone(),
            log_sketches: state.log_sketches.clone(),
            primitives: state.primitives,
            sketches: state.sketches.fork(),
            cause: None,
            invalid: None,
        },
        value: state.trace.result(),
        log_weight: 0.0,
        has_ended: true,
        lineage,
    }
}

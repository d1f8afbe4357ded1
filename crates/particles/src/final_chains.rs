//! Final chains replace a final set that is full of copies. A fixed number of particles is drawn by
//! weight. A chain that leaves the final law invariant starts from each, and the states of the chains, a fixed number of
//! proposals apart, replace the final set.
//!
//! Each state is that of a particle that was drawn by weight and then moved a number of times that is fixed beforehand:
//! the first states of all chains once `moves`, the second ones twice, and so on. So each keeps expectations as they are,
//! as moves of every particle do, and the evidence is not touched. Final chains are cheaper, because a run is built once for
//! a chain and not once for a copy, and they move further, because each state of a chain starts from the one before.

use crate::moves::chain_from;
use crate::population::Population;
use crate::smc::Progress;
use niwaki_chain::Chain;
use niwaki_math::streams::RngCore;
use niwaki_run::Failure;
use niwaki_run::run::Run;
use niwaki_run::streams::Reserved;
use rayon::prelude::*;

impl Population<'_> {
    /// The states of final chains, where these are set, and whether `watch` stopped them. The states of the first chain
    /// come first; all have equal weight. `watch` is called after every state of each chain.
    ///
    /// # Errors
    /// A fault of the program, or a kernel that makes no sense for it.
    pub fn final_chains(
        &mut self,
        watch: &mut dyn FnMut(Progress) -> bool,
    ) -> Result<Option<(Vec<Run>, bool)>, Failure> {
        let Some(rejuvenation) = &self.settings.rejuvenate else { return Ok(None) };
        let (Some(lengths), Some(mover)) = (rejuvenation.final_chains, &self.moves.mover) else {
            return Ok(None);
        };
        if self.estimate.weights.relative.is_empty() {
            return Ok(None);
        }
        let (seed, moves) = (self.settings.seed, rejuvenation.moves);
        let mut chains: Vec<(Chain, Vec<Run>)> = Vec::with_capacity(lengths.chains);
        for (number, index) in self.starts(lengths.chains).into_iter().enumerate() {
            let record = &mut self.swarm.alone()[index].record;
            let seed = Reserved::ChainSeed.stream(seed, u128::from(u64::MAX), number as u64).next_u64();
            let sketches = record.sketches.fork();
            let mut chain = chain_from(record, sketches, &self.task, mover, seed)?;
            chain.restrict(self.powers.now, None);
            chains.push((chain, Vec::with_capacity(lengths.draws)));
        }
        let task = &self.task;
        let next = |(chain, states): &mut (Chain, Vec<Run>)| -> Result<(), Failure> {
            if !chain.state.trace.is_empty() {
                chain.advance(task, moves, &mut |_, _| true)?;
            }
            states.push(chain.state.run(&task.program, 0));
            Ok(())
        };
        let mut stopped = false;
        for _ in 0..lengths.draws {
            if self.swarm.is_parallel() && chains.len() > 1 {
                chains.par_iter_mut().map(next).collect::<Result<Vec<()>, _>>()?;
            } else {
                chains.iter_mut().try_for_each(next)?;
            }
            let best = chains.iter().map(|(chain, _)| chain.best.score()).fold(f64::NEG_INFINITY, f64::max);
            stopped = !watch(Progress { barriers: self.barriers, ended: self.settings.particles, best });
            if stopped {
                break;
            }
        }
        chains.iter().for_each(|(chain, _)| self.moves.counts.ended += chain.counts.all());
        Ok(Some((chains.into_iter().flat_map(|(_, states)| states).collect(), stopped)))
    }

    /// Particle indices drawn by weight, evenly spread (systematic resampling to another number of particles).
    fn starts(&self, chains: usize) -> Vec<usize> {
        let u = Reserved::ChainStart.stream(self.settings.seed, 0, 0).uniform();
        (0..chains).map(|number| self.estimate.weights.index((number as f64 + u) / chains as f64)).collect()
    }
}

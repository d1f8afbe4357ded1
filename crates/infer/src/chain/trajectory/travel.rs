//! What became of trajectories.

use crate::hamiltonian::{Cause, Transition};
use niwaki_vm::machine::stack::RunFault;

/// Counts over the transitions of one leaf.
#[derive(Clone, Debug, Default)]
pub struct Travel {
    /// Transitions, those of the warm-up included.
    pub made: u64,
    /// Those whose end point the trace took.
    pub moved: u64,
    /// Those whose end point it did not take, though the trajectory did: the run there is another than the recorded one.
    pub unwritten: u64,
    /// Transitions after the warm-up.
    pub settled: u64,
    /// Sum over them of the mean acceptance of the trajectory's points.
    pub accept: f64,
    /// Gradients, without those of first guesses of a step.
    pub gradients: u64,
    /// Trajectories after the warm-up that the target refused, by [`Cause`].
    pub refused: [u64; Cause::COUNT],
    /// Trajectories after the warm-up whose energy drifted too far.
    pub drifted: u64,
    /// Trajectories of the warm-up that broke off.
    pub warmup_divergences: u64,
    /// What the first of them met that came to a point without a finite gradient.
    pub fault: Option<Box<RunFault>>,
}

impl Travel {
    /// Counts a transition; `fault` tells why its gradient was no number, where it was none.
    pub(crate) fn count(
        &mut self,
        made: &Transition,
        warming: bool,
        fault: impl FnOnce() -> Option<Box<RunFault>>,
    ) {
        self.made += 1;
        self.gradients += u64::from(made.steps);
        if !warming {
            self.settled += 1;
            self.accept += made.accept;
        }
        let Some(divergence) = &made.divergence else { return };
        match divergence.stop {
            Some(stop) => self.broke_off(stop.cause, warming, fault),
            None if warming => self.warmup_divergences += 1,
            None => self.drifted += 1,
        }
    }

    /// Counts a transition that could not begin: the density has no finite gradient where the trace stands.
    pub(crate) fn refused(
        &mut self,
        cause: Cause,
        warming: bool,
        fault: impl FnOnce() -> Option<Box<RunFault>>,
    ) {
        self.made += 1;
        self.settled += u64::from(!warming);
        self.broke_off(cause, warming, fault);
    }

    fn broke_off(&mut self, cause: Cause, warming: bool, fault: impl FnOnce() -> Option<Box<RunFault>>) {
        if warming {
            self.warmup_divergences += 1;
        } else {
            self.refused[cause as usize] += 1;
            if cause == Cause::NotFinite && self.fault.is_none() {
                self.fault = fault();
            }
        }
    }
}

impl std::ops::AddAssign<&Travel> for Travel {
    fn add_assign(&mut self, other: &Travel) {
        self.made += other.made;
        self.moved += other.moved;
        self.unwritten += other.unwritten;
        self.settled += other.settled;
        self.accept += other.accept;
        self.gradients += other.gradients;
        self.refused.iter_mut().zip(other.refused).for_each(|(sum, one)| *sum += one);
        self.drifted += other.drifted;
        self.warmup_divergences += other.warmup_divergences;
        if self.fault.is_none() {
            self.fault.clone_from(&other.fault);
        }
    }
}

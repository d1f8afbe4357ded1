//! What became of trajectories.

use crate::hamiltonian::{BrokenOff, Cause, Stop, Transition};
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
    /// Those that broke off.
    pub broken: BrokenOff,
    /// What the first of them met that came to a point without a finite gradient.
    pub fault: Option<Box<RunFault>>,
}

impl Travel {
    /// Counts a transition; `fault` says why its gradient was no number, where it was none.
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
        if let Some(divergence) = &made.divergence {
            self.broke_off(divergence.stop, warming, fault);
        }
    }

    /// Counts a transition that could not begin: the density has no finite gradient where the trace stands.
    pub(crate) fn refused(
        &mut self,
        stop: Stop,
        warming: bool,
        fault: impl FnOnce() -> Option<Box<RunFault>>,
    ) {
        self.made += 1;
        self.settled += u64::from(!warming);
        self.broke_off(Some(stop), warming, fault);
    }

    fn broke_off(
        &mut self,
        stop: Option<Stop>,
        warming: bool,
        fault: impl FnOnce() -> Option<Box<RunFault>>,
    ) {
        self.broken.count(stop, warming);
        let is_faulty = !warming && stop.is_some_and(|stop| stop.cause == Cause::NotFinite);
        if is_faulty && self.fault.is_none() {
            self.fault = fault();
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
        self.broken += other.broken;
        if self.fault.is_none() {
            self.fault.clone_from(&other.fault);
        }
    }
}

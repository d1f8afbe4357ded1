//! Counts of trajectories.

use niwaki_continuous::hamiltonian::{BrokenOff, Cause, Stop, Transition};
use niwaki_vm::machine::stack::RunFault;
use serde::{Deserialize, Serialize};

/// Counts over the transitions of one leaf.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct TrajectoryCounts {
    /// Transitions, those of the warm-up included.
    pub transitions: u64,
    /// Those whose end point the trace took.
    pub moved: u64,
    /// Those whose end point the trajectory accepted and the trace did not: the run there differs from the recorded one.
    pub unwritten: u64,
    /// Transitions after the warm-up.
    pub settled: u64,
    /// Sum over them of the mean acceptance of the trajectory's points.
    #[serde(with = "niwaki_math::bits")]
    pub accept: f64,
    /// Gradients, without those of first guesses of a step.
    pub gradients: u64,
    /// Those that broke off.
    pub broken: BrokenOff,
    /// The fault of the first one that reached a point without a finite gradient; not stored.
    #[serde(skip)]
    pub fault: Option<Box<RunFault>>,
}

impl TrajectoryCounts {
    /// Counts a transition; `fault` gives the reason where its gradient was not finite.
    pub(crate) fn count(
        &mut self,
        transition: &Transition,
        warming: bool,
        fault: impl FnOnce() -> Option<Box<RunFault>>,
    ) {
        self.transitions += 1;
        self.gradients += u64::from(transition.steps);
        if !warming {
            self.settled += 1;
            self.accept += transition.accept;
        }
        if let Some(divergence) = &transition.divergence {
            self.broke_off(divergence.stop, warming, fault);
        }
    }

    /// Counts a transition that could not begin: the density has no finite gradient at the trace.
    pub(crate) fn refused(
        &mut self,
        stop: Stop,
        warming: bool,
        fault: impl FnOnce() -> Option<Box<RunFault>>,
    ) {
        self.transitions += 1;
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

impl std::ops::AddAssign<&TrajectoryCounts> for TrajectoryCounts {
    fn add_assign(&mut self, other: &TrajectoryCounts) {
        self.transitions += other.transitions;
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

//! A kernel ready to run: its leaves with their adapted steps, and a cursor to the next one.
//!
//! The cursor is a stack of places in the tree, so a chain can stop between any two proposals.

use crate::kernel::Kernel;
use crate::leaf::trajectory::Trajectory;
use crate::leaf::{Leaf, Learnt, Proposer};
use crate::walk::state::State;
use niwaki_math::Stream;
use niwaki_propose::gradient::nothing_continuous;
use niwaki_run::select::Selection;
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use serde::{Deserialize, Serialize};

#[derive(Clone, Debug)]
enum Branch {
    Leaf(usize),
    Cycle(Vec<usize>),
    /// Cumulative weights, and the branches.
    Mixture(Vec<f64>, Vec<usize>),
    Repeat(u64, usize),
    Anneal {
        start: f64,
        end: f64,
        steps: u64,
        done: u64,
        inner: usize,
    },
}

/// Where a plan is, as data: branches that are being applied, proposals of each annealing, what the leaves have learnt.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Stored {
    cursor: Vec<(usize, u64)>,
    annealed: Vec<u64>,
    learnt: Vec<Learnt>,
}

/// A kernel ready to run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The leaves, in the order of the kernel.
    pub leaves: Vec<Leaf>,
    branches: Vec<Branch>,
    root: usize,
    /// The cumulative weights and the leaves, if the kernel is a mixture of leaves alone.
    flat: Option<(Vec<f64>, Vec<usize>)>,
    /// Branches that are being applied, each with the number of applications begun inside.
    cursor: Vec<(usize, u64)>,
}

fn bad(problem: &str) -> Failure {
    Fault::new("bad-kernel", format!("this kernel {problem}")).with_help("see `niwaki.kernels`").into()
}

/// A place by cumulative weights.
#[inline]
fn picked(sums: &[f64], rng: &mut Stream) -> usize {
    let at = rng.uniform() * sums[sums.len() - 1];
    sums.iter().filter(|sum| **sum <= at).count().min(sums.len() - 1)
}

impl Plan {
    /// The plan of a kernel.
    pub fn new(kernel: &Kernel) -> Result<Plan, Failure> {
        let mut plan = Plan { leaves: vec![], branches: vec![], root: 0, flat: None, cursor: vec![] };
        plan.root = plan.add(kernel, &Selection::default())?;
        if let Branch::Mixture(sums, inner) = &plan.branches[plan.root] {
            let leaf = |branch: &usize| match &plan.branches[*branch] {
                Branch::Leaf(leaf) => Some(*leaf),
                _ => None,
            };
            plan.flat = inner.iter().map(leaf).collect::<Option<_>>().map(|leaves| (sums.clone(), leaves));
        }
        Ok(plan)
    }

    fn add(&mut self, kernel: &Kernel, selection: &Selection) -> Result<usize, Failure> {
        let branch = match kernel {
            Kernel::Leaf(proposer) => {
                let (proposer, selection) = (proposer.clone(), selection.clone());
                self.leaves.push(Leaf { proposer, selection, table: None });
                Branch::Leaf(self.leaves.len() - 1)
            }
            Kernel::On(inner, kernel) => return self.add(kernel, &selection.and(inner)),
            Kernel::Cycle(kernels) => {
                if kernels.is_empty() {
                    return Err(bad("has nothing to do"));
                }
                let inner: Result<Vec<_>, _> = kernels.iter().map(|k| self.add(k, selection)).collect();
                Branch::Cycle(inner?)
            }
            Kernel::Mixture(kernels) => {
                let (mut sum, mut sums, mut inner) = (0.0, vec![], vec![]);
                for (weight, kernel) in kernels {
                    sum += weight;
                    sums.push(sum);
                    inner.push(self.add(kernel, selection)?);
                }
                if inner.is_empty() {
                    return Err(bad("has nothing to do"));
                }
                Branch::Mixture(sums, inner)
            }
            Kernel::Repeat(times, kernel) => Branch::Repeat(*times, self.add(kernel, selection)?),
            Kernel::Anneal { start, end, steps, kernel } => {
                let inner = self.add(kernel, selection)?;
                Branch::Anneal { start: *start, end: *end, steps: *steps, done: 0, inner }
            }
        };
        self.branches.push(branch);
        Ok(self.branches.len() - 1)
    }

    /// Refuses leaves that have nothing to move from this state on.
    ///
    /// # Errors
    /// A pattern that matches no choice of the program; a gradient, and no continuous choice.
    pub fn check(&self, state: &State, task: &Task) -> Result<(), Failure> {
        for Leaf { selection, proposer, .. } in &self.leaves {
            if !selection.is_all() {
                selection.check(&state.trace, &task.program)?;
            }
            if proposer.trajectory().is_some() && !selection.may_be_continuous(&state.trace, &task.program) {
                return Err(nothing_continuous().into());
            }
        }
        Ok(())
    }

    /// The place in the plan and the adaptation of its leaves, as data.
    pub(crate) fn stored(&self) -> Stored {
        let progress = |branch: &Branch| match branch {
            Branch::Anneal { done, .. } => *done,
            _ => 0,
        };
        Stored {
            cursor: self.cursor.clone(),
            annealed: self.branches.iter().map(progress).collect(),
            learnt: self.leaves.iter().map(|leaf| leaf.proposer.learnt()).collect(),
        }
    }

    /// Goes on from there; false where that is not of this plan.
    pub(crate) fn restore(&mut self, stored: Stored) -> bool {
        let fits = stored.annealed.len() == self.branches.len() && stored.learnt.len() == self.leaves.len();
        if !fits || stored.cursor.iter().any(|(branch, _)| *branch >= self.branches.len()) {
            return false;
        }
        self.cursor = stored.cursor;
        for (branch, before) in self.branches.iter_mut().zip(stored.annealed) {
            if let Branch::Anneal { done, .. } = branch {
                *done = before;
            }
        }
        self.leaves.iter_mut().zip(stored.learnt).all(|(leaf, learnt)| leaf.proposer.restore(learnt))
    }

    /// The leaves that follow the gradient.
    pub fn trajectories(&self) -> impl Iterator<Item = &Trajectory> {
        self.leaves.iter().filter_map(|leaf| leaf.proposer.trajectory())
    }

    /// Whether it is one leaf that draws from the prior, all choices alike.
    pub fn is_plain(&self) -> bool {
        self.leaves.len() == 1
            && matches!(self.leaves[0], Leaf { proposer: Proposer::Prior {}, table: None, .. })
            && !self.branches.iter().any(|branch| matches!(branch, Branch::Anneal { .. }))
    }

    /// The next leaf, and the power of the score under which it proposes. Mixtures draw from `rng`.
    #[inline]
    pub fn next(&mut self, rng: &mut Stream) -> (usize, f64) {
        match &self.flat {
            Some((sums, leaves)) => (leaves[picked(sums, rng)], 1.0),
            None => self.next_of_any(rng),
        }
    }

    /// The next leaf of any plan.
    fn next_of_any(&mut self, rng: &mut Stream) -> (usize, f64) {
        loop {
            let Some((branch, turn)) = self.cursor.last_mut() else {
                self.cursor.push((self.root, 0));
                continue;
            };
            let inner = match &self.branches[*branch] {
                Branch::Leaf(leaf) => {
                    let leaf = *leaf;
                    self.cursor.pop();
                    return (leaf, self.power());
                }
                Branch::Cycle(inner) => inner.get(*turn as usize).copied(),
                Branch::Repeat(times, inner) => (*turn < *times).then_some(*inner),
                Branch::Mixture(sums, inner) => (*turn == 0).then(|| inner[picked(sums, rng)]),
                Branch::Anneal { inner, .. } => (*turn == 0).then_some(*inner),
            };
            *turn += 1;
            match inner {
                Some(inner) => self.cursor.push((inner, 0)),
                None => {
                    self.cursor.pop();
                }
            }
        }
    }

    /// The product of the powers of the annealings around the next proposal; each of them advances by one.
    fn power(&mut self) -> f64 {
        let mut power = 1.0;
        for (branch, _) in &self.cursor {
            if let Branch::Anneal { start, end, steps, done, .. } = &mut self.branches[*branch] {
                let share = (*done as f64 / (*steps).max(1) as f64).min(1.0);
                *done += 1;
                power *= *start * (*end / *start).powf(share);
            }
        }
        power
    }
}

#[cfg(test)]
mod tests {
    //! Applications have the order of the tree, at any depth.
    use super::*;

    fn order(kernel: &Kernel, n: usize) -> Vec<usize> {
        let mut plan = Plan::new(kernel).unwrap();
        let mut rng = Stream::new(1, 2, 3, 4);
        (0..n).map(|_| plan.next(&mut rng).0).collect()
    }

    #[test]
    fn cycles_and_repeats_nest() {
        let inner = Kernel::Cycle(vec![Kernel::PRIOR, Kernel::Repeat(2, Box::new(Kernel::PRIOR))]);
        let kernel = Kernel::Cycle(vec![Kernel::Repeat(2, Box::new(inner)), Kernel::PRIOR]);
        assert_eq!(order(&kernel, 9), [0, 1, 1, 0, 1, 1, 2, 0, 1]);
    }

    #[test]
    fn mixtures_choose_by_weight() {
        let kernel = Kernel::Mixture(vec![(1.0, Kernel::PRIOR), (3.0, Kernel::PRIOR)]);
        let second = order(&kernel, 4000).into_iter().filter(|leaf| *leaf == 1).count();
        // Mean 3000, standard deviation 27.4: five of them once in 1.7 million.
        assert!((2863..=3137).contains(&second), "{second}");
    }

    #[test]
    fn annealing_ends_at_its_last_power() {
        let kernel =
            Kernel::Anneal { start: 1.0 / 16.0, end: 4.0, steps: 2, kernel: Box::new(Kernel::PRIOR) };
        let mut plan = Plan::new(&kernel).unwrap();
        let mut rng = Stream::new(1, 2, 3, 4);
        let powers: Vec<f64> = (0..4).map(|_| plan.next(&mut rng).1).collect();
        assert_eq!(powers, [1.0 / 16.0, 0.5, 4.0, 4.0]);
        assert!(Plan::new(&Kernel::Cycle(vec![])).is_err());
    }
}

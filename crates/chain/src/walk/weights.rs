//! Selection weights: the probability of picking a choice for a proposal is proportional to its weight.
//!
//! Weights are whole numbers (in units of [`UNIT`](niwaki_run::select::UNIT)), so that their sums are exact for any births and deaths.
//! A tree of partial sums (Fenwick 1994) finds, adds and drops a choice in O(log n).

use niwaki_run::select::Selection;
use niwaki_vm::code::Program;
use niwaki_vm::machine::kept::Trace;
use niwaki_vm::machine::kept::inspect::Place;

/// A function from the place of a choice in the trace to its weight.
pub trait Weigh: Send + Sync {
    /// The weight of a choice. It must not depend on any value.
    fn weight(&self, place: &Place<'_, f64>) -> u64;
}

impl Weigh for Selection {
    fn weight(&self, place: &Place<'_, f64>) -> u64 {
        self.weigh(|| place.path(), || place.depth())
    }
}

/// The weights of all choices, in the order of the trace's table.
pub struct Table {
    weigh: Box<dyn Weigh>,
    weights: Vec<u64>,
    /// `sums[i]` covers the `lowbit(i + 1)` weights up to `i`.
    sums: Vec<u64>,
    total: u64,
    /// The common weight and its choices, if all weights above zero are equal and no choice was added or removed.
    alike: Option<(u64, Vec<u32>)>,
}

impl Table {
    /// Compute the weights of the choices of a trace.
    pub fn new(weigh: Box<dyn Weigh>, trace: &Trace, program: &Program) -> Table {
        let mut table = Table { weigh, weights: vec![], sums: vec![], total: 0, alike: None };
        for choice in trace.numbers() {
            let weight = table.weigh.weight(&trace.place(program, choice));
            table.push(weight);
        }
        table.alike = table.all_alike();
        table
    }

    fn all_alike(&self) -> Option<(u64, Vec<u32>)> {
        let weight = *self.weights.iter().find(|weight| **weight > 0)?;
        let choices =
            (0u32..).zip(&self.weights).filter(|(_, w)| **w > 0).map(|(choice, _)| choice).collect();
        self.weights.iter().all(|w| *w == 0 || *w == weight).then_some((weight, choices))
    }

    /// The sum of all weights.
    pub fn total(&self) -> u64 {
        self.total
    }

    /// The weight of a choice.
    pub fn weight(&self, choice: usize) -> u64 {
        self.weights[choice]
    }

    /// The weight of a choice at this place.
    pub fn weigh(&self, place: &Place<'_, f64>) -> u64 {
        self.weigh.weight(place)
    }

    /// The choice whose part of the cumulative weights contains `at`, from 0 to below the total.
    #[inline]
    pub fn find(&self, at: u64) -> usize {
        debug_assert!(at < self.total);
        match &self.alike {
            Some((weight, choices)) => choices[(at / weight) as usize] as usize,
            None => self.descend(at),
        }
    }

    fn descend(&self, mut at: u64) -> usize {
        let (mut below, mut step) = (0, self.sums.len().next_power_of_two());
        while step > 0 {
            if below + step <= self.sums.len() && self.sums[below + step - 1] <= at {
                at -= self.sums[below + step - 1];
                below += step;
            }
            step >>= 1;
        }
        below
    }

    /// The sum of all weights after the open transaction is kept.
    pub fn total_after(&self, trace: &Trace, program: &Program) -> u64 {
        let removed: u64 = trace.deaths().iter().map(|dead| self.weights[*dead as usize]).sum();
        let come: u64 = trace.births(program).map(|place| self.weigh(&place)).sum();
        self.total - removed + come
    }

    /// Update the weights, just before the open transaction is kept.
    #[inline]
    pub fn follow(&mut self, trace: &Trace, program: &Program) {
        if !trace.deaths().is_empty() || trace.births(program).len() > 0 {
            self.alike = None;
            self.change(trace, program);
        }
    }

    fn change(&mut self, trace: &Trace, program: &Program) {
        let mut deaths = trace.deaths().to_vec();
        deaths.sort_unstable();
        for dead in deaths.into_iter().rev() {
            let last = self.weights.len() - 1;
            if (dead as usize) < last {
                self.set(dead as usize, self.weights[last]);
            }
            self.pop();
        }
        let mut births: Vec<(u128, u64)> =
            trace.births(program).map(|place| (place.address(), self.weigh(&place))).collect();
        births.sort_unstable_by_key(|birth| birth.0);
        for (_, weight) in births {
            self.push(weight);
        }
    }

    fn push(&mut self, weight: u64) {
        self.weights.push(weight);
        self.total += weight;
        let i = self.weights.len();
        let (mut sum, mut step) = (weight, 1);
        while step < lowest_bit(i) {
            sum += self.sums[i - step - 1];
            step <<= 1;
        }
        self.sums.push(sum);
    }

    fn pop(&mut self) {
        self.sums.pop();
        self.total -= self.weights.pop().unwrap_or(0);
    }

    fn set(&mut self, choice: usize, weight: u64) {
        let old = std::mem::replace(&mut self.weights[choice], weight);
        self.total = self.total - old + weight;
        let mut i = choice + 1;
        while i <= self.sums.len() {
            self.sums[i - 1] = self.sums[i - 1] - old + weight;
            i += lowest_bit(i);
        }
    }
}

fn lowest_bit(i: usize) -> usize {
    i & i.wrapping_neg()
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Constant;
    impl Weigh for Constant {
        fn weight(&self, _: &Place<'_, f64>) -> u64 {
            1
        }
    }

    #[test]
    fn find_agrees_with_a_linear_search() {
        let mut table =
            Table { weigh: Box::new(Constant), weights: vec![], sums: vec![], total: 0, alike: None };
        let mut state = 1u64;
        let mut next = |n: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % n
        };
        for round in 0..600 {
            match next(4) {
                0 if !table.weights.is_empty() => table.pop(),
                1 if !table.weights.is_empty() => {
                    let at = next(table.weights.len() as u64) as usize;
                    table.set(at, next(5));
                }
                _ => table.push(next(5)),
            }
            assert_eq!(table.total, table.weights.iter().sum::<u64>());
            if round % 10 == 0 {
                let mut expected = Vec::new();
                for (i, weight) in table.weights.iter().enumerate() {
                    expected.extend(std::iter::repeat_n(i, *weight as usize));
                }
                for alike in [table.all_alike(), None] {
                    table.alike = alike;
                    let picks: Vec<usize> = (0..table.total).map(|at| table.find(at)).collect();
                    assert_eq!(picks, expected);
                }
            }
        }
    }
}

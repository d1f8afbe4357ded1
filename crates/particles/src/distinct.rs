//! Distinct results: results that share at most half of their choices with any other result. A choice is an (address, value)
//! pair. Order choices do not count.

use niwaki_run::log::{Entry, Log};
use niwaki_vm::value::Value;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Runs as sorted sets of numbered (address, value) pairs.
pub struct Choices {
    runs: Vec<Vec<u32>>,
}

impl Choices {
    /// Collect the choices of runs.
    pub fn of<'a>(logs: impl Iterator<Item = &'a Log>) -> Choices {
        let mut numbers: HashMap<(u128, u64), u32> = HashMap::new();
        let mut number = |entry: &Entry| {
            let next = numbers.len() as u32;
            *numbers.entry((entry.address(), fingerprint(&entry.value))).or_insert(next)
        };
        let runs = logs.map(|log| {
            let entries = log.entries();
            let mut choices: Vec<u32> = entries.iter().filter(|e| !e.is_order()).map(&mut number).collect();
            choices.sort_unstable();
            choices
        });
        Choices { runs: runs.collect() }
    }

    /// Whether run `b` has more than half of the choices of run `a`. A run without choices shares them with another
    /// such run only.
    pub fn has_most_of(&self, b: usize, a: usize) -> bool {
        let (a, b) = (&self.runs[a], &self.runs[b]);
        if a.is_empty() {
            return b.is_empty();
        }
        let enough = a.len() / 2 + 1;
        if b.len() < enough {
            return false;
        }
        let (mut i, mut j, mut common) = (0, 0, 0);
        // Ends as soon as the answer is known.
        while i < a.len() && j < b.len() && common + (a.len() - i) >= enough {
            match a[i].cmp(&b[j]) {
                std::cmp::Ordering::Less => i += 1,
                std::cmp::Ordering::Greater => j += 1,
                std::cmp::Ordering::Equal => {
                    (i, j, common) = (i + 1, j + 1, common + 1);
                    if common >= enough {
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Whether two runs differ: neither has more than half of the other's choices.
    pub fn differ(&self, a: usize, b: usize) -> bool {
        !self.has_most_of(a, b) && !self.has_most_of(b, a)
    }

    /// The number of distinct runs.
    pub fn unique(&self) -> usize {
        let n = self.runs.len();
        // Copies are usually next to each other, so neighbours are compared first.
        let mut partner = 0;
        (0..n)
            .filter(|&a| {
                let first = (partner != a && self.has_most_of(partner, a)).then_some(partner);
                let other = first.or_else(|| (0..n).find(|&b| b != a && self.has_most_of(b, a)));
                partner = other.unwrap_or(partner);
                other.is_none()
            })
            .count()
    }

    /// Up to `k` runs that differ from each other, taken greedily in the order `ranked`.
    pub fn choose(&self, ranked: &[usize], k: usize) -> Vec<usize> {
        let mut chosen: Vec<usize> = Vec::new();
        for &run in ranked {
            if chosen.len() == k {
                break;
            }
            if chosen.iter().all(|&other| self.differ(run, other)) {
                chosen.push(run);
            }
        }
        chosen
    }
}

/// A number for a value; equal for values that are the same to the bit.
fn fingerprint(value: &Value) -> u64 {
    let mut hasher = DefaultHasher::new();
    match value {
        Value::Real(x) => (1, x.to_bits()).hash(&mut hasher),
        Value::Int(k) => (2, k).hash(&mut hasher),
        Value::Bool(b) => (3, b).hash(&mut hasher),
        // Every drawn value can be written as text.
        other => niwaki_vm::value::repr(other).ok().hash(&mut hasher),
    }
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn logs(runs: &[&[(u128, i64)]]) -> Vec<Log> {
        let log = |run: &&[(u128, i64)]| {
            let mut log = Log::default();
            run.iter().for_each(|(address, value)| log.push(*address, Value::Int(*value)));
            log.push_order(99, 0);
            log
        };
        runs.iter().map(log).collect()
    }

    #[test]
    fn more_than_half_is_what_makes_two_runs_one() {
        let logs = logs(&[
            &[(1, 0), (2, 0), (3, 0), (4, 0)],
            &[(1, 0), (2, 0), (3, 9), (4, 9)],
            &[(1, 0), (2, 0), (3, 0), (4, 9)],
            &[(1, 7)],
            &[],
            &[],
        ]);
        let choices = Choices::of(logs.iter());
        assert!(choices.differ(0, 1));
        assert!(!choices.differ(0, 2));
        assert!(choices.has_most_of(1, 2) && choices.has_most_of(2, 1));
        assert!(choices.differ(0, 3) && choices.differ(3, 4));
        assert!(!choices.differ(4, 5));
        // 2 has most of 0 and of 1; both empty runs are one.
        assert_eq!(choices.unique(), 1);
        assert_eq!(choices.choose(&[0, 1, 2, 3, 4, 5], 10), [0, 1, 3, 4]);
        assert_eq!(choices.choose(&[2, 1, 0, 3], 2), [2, 3]);
    }

    /// A short run may be part of a long one without the long one being part of it.
    #[test]
    fn a_part_is_not_different_from_the_whole() {
        let logs = logs(&[&[(1, 0), (2, 0), (3, 0), (4, 0)], &[(1, 0)]]);
        let choices = Choices::of(logs.iter());
        assert!(choices.has_most_of(0, 1) && !choices.has_most_of(1, 0));
        assert!(!choices.differ(0, 1));
        assert_eq!(choices.unique(), 1);
    }
}

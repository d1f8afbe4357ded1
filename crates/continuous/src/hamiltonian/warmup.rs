//! Warm-up: the step size is adapted throughout, the metric in windows that double in length; then both are frozen.
//!
//! The schedule is Stan's (Stan reference manual, "automatic parameter tuning"): a first stretch in which the chain
//! finds the target, windows each of whose draws fit the metric of the next, and a last stretch that settles the
//! step size for the final metric. After warm-up the kernel no longer changes, so the draws come from one kernel.

use super::chains::{Chain, Settings};
use super::estimate::Window;
use super::potential::Potential;
use super::step_size::DualAveraging;
use super::transition::Transition;

/// The lengths of the first stretch, the first window and the last stretch, where the warm-up is long enough for them.
const FIRST: u32 = 75;
const WINDOW: u32 = 25;
const LAST: u32 = 50;

/// After which transitions of a warm-up a window ends, counted from 1; draws up to `first` are in no window.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Schedule {
    /// Transitions before the first window.
    pub first: u32,
    /// The last transition of each window.
    pub ends: Vec<u32>,
}

impl Schedule {
    /// The windows of a warm-up of this length; none when it is shorter than 20.
    pub fn new(warmup: u32) -> Schedule {
        if warmup < 20 {
            return Schedule { first: warmup, ends: Vec::new() };
        }
        let (first, mut length, last) = if warmup < FIRST + WINDOW + LAST {
            let (first, last) = (warmup * 15 / 100, warmup / 10);
            (first, warmup - first - last, last)
        } else {
            (FIRST, WINDOW, LAST)
        };
        let (mut end, stop) = (first, warmup - last);
        let mut ends = Vec::new();
        while end < stop {
            // A window takes the rest of the warm-up when its successor would not fit.
            end = if end + 3 * length > stop { stop } else { end + length };
            ends.push(end);
            length *= 2;
        }
        Schedule { first, ends }
    }
}

/// A chain's warm-up in progress.
pub struct Adaptation {
    schedule: Schedule,
    window: Window,
    average: DualAveraging,
    done: u32,
    settings: Settings,
}

impl Adaptation {
    /// Guesses a step size for the chain and starts adapting it.
    pub fn new<P: Potential>(chain: &mut Chain<P>, settings: &Settings) -> Adaptation {
        if settings.step_size.is_none() {
            chain.guess_step(1.0);
        }
        Adaptation {
            schedule: Schedule::new(settings.warmup),
            window: Window::new(chain.phase.x.len()),
            average: DualAveraging::new(chain.step_size, settings.target_accept),
            done: 0,
            settings: settings.clone(),
        }
    }

    /// Adapts to the last transition of the chain.
    pub fn learn<P: Potential>(&mut self, chain: &mut Chain<P>, transition: &Transition) {
        self.done += 1;
        let adapts_step = self.settings.step_size.is_none();
        if adapts_step {
            self.average.update(transition.accept);
            chain.step_size = self.average.current();
        }
        let in_window = self.done > self.schedule.first
            && self.schedule.ends.last().is_some_and(|last| self.done <= *last);
        if in_window {
            self.window.push(&chain.phase.x, &chain.phase.gradient);
        }
        if self.schedule.ends.contains(&self.done) {
            if let Some(metric) = self.window.metric(self.settings.shape) {
                chain.metric = metric;
                if adapts_step {
                    // The new metric has another scale: what was learnt about the old step does not hold for it.
                    chain.guess_step(chain.step_size);
                    self.average = DualAveraging::new(chain.step_size, self.settings.target_accept);
                }
            }
            self.window.clear();
        }
        if self.done == self.settings.warmup && adapts_step {
            chain.step_size = self.average.settled();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_windows_are_stans() {
        // Stan reference manual: for 1000 transitions, windows of 25, 50, 100, 200 and 500 after 75 and before 50.
        assert_eq!(Schedule::new(1000), Schedule { first: 75, ends: vec![100, 150, 250, 450, 950] });
        assert_eq!(Schedule::new(150), Schedule { first: 75, ends: vec![100] });
        assert_eq!(Schedule::new(100), Schedule { first: 15, ends: vec![90] });
        assert_eq!(Schedule::new(10), Schedule { first: 10, ends: vec![] });
        for warmup in 0..3000 {
            let Schedule { first, ends } = Schedule::new(warmup);
            assert!(ends.windows(2).all(|pair| pair[0] < pair[1]), "{warmup}");
            assert!(ends.iter().all(|end| *end > first && *end <= warmup), "{warmup}");
        }
    }
}

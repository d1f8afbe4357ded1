//! Step and scales of trajectories, shared by all structures.
//!
//! A coordinate belongs to a *label*: the site of its choice, and its place in the choice's value. So a structure that was
//! never seen has scales where its sites have. The scale of a label is `1 / sqrt(E[slope^2])` over its coordinates: the
//! mean squared slope is the mean curvature of the log density (Fisher's identity), whatever else the structure
//! contains. The variance of the draws cannot serve: components that swap their labels vary by the distance between them.
//!
//! Scales are learnt in windows that double in length, each of them a prior for the next, in the first three quarters of
//! the warm-up; the step by dual averaging all along, begun anew with each window. A structure of `d` coordinates takes
//! `d^(-1/4)` of the step of one (Neal 2011, section 5.4.4). Afterwards nothing changes.

use niwaki_continuous::hamiltonian::Metric;
use niwaki_continuous::hamiltonian::step_size::DualAveraging;
use niwaki_math::bits;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Transitions of the first window.
const FIRST_WINDOW: u32 = 16;
/// The number of slopes that the estimate before a window counts for.
const PRIOR_SLOPES: f64 = 5.0;
/// The share of the warm-up after which scales stay.
const SCALES_UNTIL: f64 = 0.75;

/// The estimate for one label.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Label {
    /// The square of its scale.
    #[serde(with = "bits")]
    variance: f64,
    /// Sum of squared slopes in this window, and their number.
    #[serde(with = "bits")]
    squares: f64,
    #[serde(with = "bits")]
    count: f64,
}

/// A label's number.
pub(crate) type LabelId = u32;

/// Step and scales.
#[derive(Clone, Debug)]
pub(crate) struct Scales {
    numbers: HashMap<(u32, u32), LabelId>,
    labels: Vec<Label>,
    steps: Steps,
}

/// The step, and how far the warm-up is.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Steps {
    /// The step for one coordinate.
    #[serde(with = "bits")]
    step: f64,
    #[serde(with = "bits")]
    target: f64,
    average: Option<DualAveraging>,
    /// Transitions in this window, and how many it has.
    done: u32,
    window: u32,
    /// Whether the step must be guessed before the next transition of the warm-up.
    unguessed: bool,
}

/// Step and scales, as data: sites and places with their labels, in the order of these.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Stored {
    labels: Vec<((u32, u32), Label)>,
    steps: Steps,
}

impl Scales {
    /// A first step, for one coordinate, and the acceptance that it is adapted to.
    pub fn new(step: f64, target: f64) -> Scales {
        Scales {
            numbers: HashMap::new(),
            labels: vec![],
            steps: Steps { step, target, average: None, done: 0, window: FIRST_WINDOW, unguessed: true },
        }
    }

    /// As data.
    pub fn stored(&self) -> Stored {
        let mut sites: Vec<((u32, u32), LabelId)> =
            self.numbers.iter().map(|(site, label)| (*site, *label)).collect();
        sites.sort_unstable_by_key(|(_, label)| *label);
        let sites = sites.into_iter().map(|(site, _)| site);
        Stored { labels: sites.zip(self.labels.iter().cloned()).collect(), steps: self.steps.clone() }
    }

    /// Restore scales from data.
    pub fn restored(Stored { labels, steps }: Stored) -> Scales {
        let numbers = (0..).zip(&labels).map(|(number, (site, _))| (*site, number)).collect();
        Scales { numbers, labels: labels.into_iter().map(|(_, label)| label).collect(), steps }
    }

    /// The number of a label, which starts with a scale.
    pub fn label(&mut self, site: u32, place: u32, scale: f64) -> LabelId {
        *self.numbers.entry((site, place)).or_insert_with(|| {
            let variance = if scale.is_finite() && scale > 0.0 { scale * scale } else { 1.0 };
            self.labels.push(Label { variance, squares: 0.0, count: 0.0 });
            self.labels.len() as LabelId - 1
        })
    }

    /// The metric of coordinates with these labels.
    pub fn metric(&self, labels: &[LabelId]) -> Metric {
        Metric::diagonal(labels.iter().map(|label| self.labels[*label as usize].variance).collect())
    }

    /// The step of a structure with so many coordinates.
    pub fn step(&self, dim: usize) -> f64 {
        self.steps.step * (dim as f64).powf(-0.25)
    }

    /// Whether a guess is wanted, in the warm-up.
    pub fn wants_a_guess(&self) -> bool {
        self.steps.unguessed
    }

    /// Starts from a step that suits so many coordinates.
    pub fn guessed(&mut self, step: f64, dim: usize) {
        self.steps.unguessed = false;
        self.steps.step = step * (dim as f64).powf(0.25);
        self.steps.average = Some(DualAveraging::new(self.steps.step, self.steps.target));
    }

    /// Learns from a transition of the warm-up, of which a share is over.
    pub fn learn(&mut self, labels: &[LabelId], slopes: &[f64], accept: f64, share: f64) {
        if let Some(average) = &mut self.steps.average {
            average.update(accept);
            self.steps.step = average.current();
        }
        for (label, slope) in labels.iter().zip(slopes) {
            let label = &mut self.labels[*label as usize];
            label.squares += slope * slope;
            label.count += 1.0;
        }
        self.steps.done += 1;
        if self.steps.done < self.steps.window || share > SCALES_UNTIL {
            return;
        }
        (self.steps.done, self.steps.window, self.steps.unguessed) = (0, 2 * self.steps.window, true);
        for label in &mut self.labels {
            let known = PRIOR_SLOPES / label.variance;
            let variance = (PRIOR_SLOPES + label.count) / (known + label.squares);
            if variance.is_finite() && variance > 0.0 {
                label.variance = variance;
            }
            (label.squares, label.count) = (0.0, 0.0);
        }
    }

    /// From now on nothing changes.
    pub fn freeze(&mut self) {
        if let Some(average) = self.steps.average.take() {
            self.steps.step = average.settled();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use niwaki_math::Stream;

    #[test]
    fn a_scale_is_that_of_the_slopes() {
        // Slopes of a normal of deviation s are x / s^2: their mean square is 1 / s^2.
        let mut scales = Scales::new(0.1, 0.8);
        let labels = [scales.label(3, 0, 1.0), scales.label(4, 0, 1.0), scales.label(3, 0, 1.0)];
        assert_eq!(labels, [0, 1, 0]);
        let mut stream = Stream::new(1, 0, 0, 0);
        for _ in 0..(16 + 32 + 64 + 128 + 256 + 512) {
            let slopes = [stream.normal() / 10.0, stream.normal() / 0.01, stream.normal() / 10.0];
            scales.learn(&labels, &slopes, 0.8, 0.1);
        }
        let Metric::Diagonal { variance, .. } = scales.metric(&labels) else { panic!("a diagonal") };
        // 512 slopes and more: a standard error of 6 % and less.
        assert!((variance[0] / 100.0 - 1.0).abs() < 0.35, "{variance:?}");
        assert!((variance[1] / 1e-4 - 1.0).abs() < 0.35, "{variance:?}");
        let late = scales.clone();
        (0..5000).for_each(|_| scales.learn(&labels, &[1.0, 1.0, 1.0], 0.8, 0.9));
        assert_eq!(scales.labels[0].variance, late.labels[0].variance);
    }
}

//! A mixture of Gaussians: a new mean or deviation visits the points of its component.
use super::{Groups, Model, SAME, Step, decide, draw, log_normal, normal, numbers, simplex};
use crate::population::{Random, uniform};
use serde_json::Value;

/// Bounds of the deviations.
const LOW: f64 = 0.1;
const HIGH: f64 = 4.0;
/// Step of a mean.
const DRIFT: f64 = 0.2;

pub struct Gmm {
    components: usize,
    points: Vec<f64>,
    weights: Vec<f64>,
    means: Vec<f64>,
    deviations: Vec<f64>,
    log_deviations: Vec<f64>,
    z: Vec<u32>,
    groups: Groups,
    fresh: Vec<f64>,
}

impl Gmm {
    pub fn new(data: &Value, random: &mut Random) -> Self {
        let points = numbers(&data["points"]);
        let k = data["components"].as_u64().expect("a number") as usize;
        let mut weights = vec![0.0; k];
        simplex(random, &mut weights);
        let means = (0..k).map(|_| 10.0 * normal(random)).collect();
        let deviations: Vec<f64> = (0..k).map(|_| LOW + (HIGH - LOW) * uniform(random)).collect();
        let (mut groups, mut z) = (Groups::new(k), vec![]);
        for _ in &points {
            let one = draw(random, &weights);
            z.push(one as u32);
            groups.push(one);
        }
        let log_deviations = deviations.iter().map(|sd| sd.ln()).collect();
        Self {
            components: k,
            points,
            weights,
            means,
            deviations,
            log_deviations,
            z,
            groups,
            fresh: vec![0.0; k],
        }
    }
}

impl Model for Gmm {
    fn choices(&self) -> usize {
        1 + 2 * self.components + self.points.len()
    }

    fn globals(&self) -> std::ops::Range<usize> {
        1..1 + self.components
    }

    fn readers(&self, choice: usize) -> usize {
        self.groups.members[choice - 1].len()
    }

    #[inline]
    fn propose<const CHECKED: bool>(&mut self, choice: usize, random: &mut Random, forced: bool) -> Step {
        let k = self.components;
        if choice > 2 * k {
            let i = choice - 1 - 2 * k;
            let (old, new) = (self.z[i] as usize, draw(random, &self.weights));
            if new == old {
                return SAME;
            }
            let there = (self.points[i] - self.means[new]) / self.deviations[new];
            let here = (self.points[i] - self.means[old]) / self.deviations[old];
            let log_ratio =
                0.5 * (here * here - there * there) + self.log_deviations[old] - self.log_deviations[new];
            let accepted = decide(random, log_ratio, forced);
            if accepted {
                self.z[i] = new as u32;
                self.groups.relocate(i, old, new);
            }
            let own_prior = if CHECKED { (self.weights[new] / self.weights[old]).ln() } else { 0.0 };
            return Step { accepted, log_ratio, own_prior };
        }
        let (log_ratio, accepted);
        if choice == 0 {
            simplex(random, &mut self.fresh);
            let term =
                |t: usize| self.groups.members[t].len() as f64 * (self.fresh[t] / self.weights[t]).ln();
            log_ratio = (0..k).map(term).sum();
            accepted = decide(random, log_ratio, forced);
            if accepted {
                self.weights.copy_from_slice(&self.fresh);
            }
        } else if choice <= k {
            let t = choice - 1;
            let (old, sd) = (self.means[t], self.deviations[t]);
            let new = old + DRIFT * normal(random);
            let term = |&i: &u32| {
                let x = self.points[i as usize];
                (x - old) * (x - old) - (x - new) * (x - new)
            };
            let sum: f64 = self.groups.members[t].iter().map(term).sum();
            log_ratio = 0.5 * sum / (sd * sd) + (old * old - new * new) / 200.0;
            accepted = decide(random, log_ratio, forced);
            if accepted {
                self.means[t] = new;
            }
        } else {
            let t = choice - 1 - k;
            let (mean, old) = (self.means[t], self.deviations[t]);
            let new = LOW + (HIGH - LOW) * uniform(random);
            let term = |&i: &u32| (self.points[i as usize] - mean) * (self.points[i as usize] - mean);
            let sum: f64 = self.groups.members[t].iter().map(term).sum();
            let (log_new, count) = (new.ln(), self.groups.members[t].len() as f64);
            log_ratio = 0.5 * sum * (1.0 / (old * old) - 1.0 / (new * new))
                + count * (self.log_deviations[t] - log_new);
            accepted = decide(random, log_ratio, forced);
            if accepted {
                (self.deviations[t], self.log_deviations[t]) = (new, log_new);
            }
        }
        Step { accepted, log_ratio, own_prior: 0.0 }
    }

    fn log_joint(&self) -> f64 {
        let point = |i: usize| {
            let t = self.z[i] as usize;
            self.weights[t].ln() + log_normal(self.points[i], self.means[t], self.deviations[t])
        };
        self.means.iter().map(|&mean| log_normal(mean, 0.0, 10.0)).sum::<f64>()
            + (0..self.points.len()).map(point).sum::<f64>()
    }
}

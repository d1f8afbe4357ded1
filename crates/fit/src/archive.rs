//! The evaluations, in the order of asking, with the dot products of their features.

use crate::linear::dot;
use crate::space::Point;
use std::cmp::Ordering;

/// An outcome of an evaluation.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// The log score, nats; minus infinity for a scene that is forbidden and for an evaluation that failed.
    pub score: f64,
    /// The errors of the scene; None for an evaluation that failed. Empty for goals without features.
    pub features: Option<Vec<f64>>,
}

/// The evaluations so far.
#[derive(Clone, Debug, Default)]
pub struct Archive {
    points: Vec<Point>,
    evaluations: Vec<Evaluation>,
    /// For each evaluation, the dot products of its features with those of all up to itself; empty if it failed.
    products: Vec<Vec<f64>>,
    has_features: bool,
}

impl Archive {
    /// The number of evaluations.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether nothing is evaluated yet.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// A point.
    pub fn point(&self, number: usize) -> &Point {
        &self.points[number]
    }

    /// The score of a point.
    pub fn score(&self, number: usize) -> f64 {
        self.evaluations[number].score
    }

    /// The features of a point; None if it failed.
    pub fn features(&self, number: usize) -> Option<&[f64]> {
        self.evaluations[number].features.as_deref()
    }

    /// Whether an evaluation gave a scene.
    pub fn is_seen(&self, number: usize) -> bool {
        self.evaluations[number].features.is_some()
    }

    /// Whether evaluations have features, beside their score.
    pub fn has_features(&self) -> bool {
        self.has_features
    }

    /// The dot product of the features of two evaluations that gave scenes.
    pub fn product(&self, a: usize, b: usize) -> f64 {
        self.products[a.max(b)][a.min(b)]
    }

    /// The squared length of the features of an evaluation; infinite if it failed.
    pub fn square(&self, number: usize) -> f64 {
        self.products[number].last().copied().unwrap_or(f64::INFINITY)
    }

    /// Adds an evaluation.
    pub fn push(&mut self, point: Point, evaluation: Evaluation) {
        let products = match &evaluation.features {
            None => vec![],
            Some(features) => {
                let with = |other: &Evaluation| other.features.as_ref().map_or(0.0, |f| dot(f, features));
                self.evaluations.iter().map(with).chain([dot(features, features)]).collect()
            }
        };
        self.has_features |= evaluation.features.as_ref().is_some_and(|features| !features.is_empty());
        self.points.push(point);
        self.evaluations.push(evaluation);
        self.products.push(products);
    }

    /// The squared distance of the features of two evaluations that gave scenes.
    fn square_between(&self, a: usize, b: usize) -> f64 {
        (self.square(a) + self.square(b) - 2.0 * self.product(a, b)).max(0.0)
    }

    /// The archive of a search whose target was the scene of an evaluation: without it, and with features less its own.
    ///
    /// Evaluations that are nearer to this target than the squared distance `least` are left out: a search that stands so
    /// far from its target has none. Scores are those of features alone. The features themselves are left out, since their
    /// products are enough.
    pub fn about(&self, target: usize, least: f64) -> Archive {
        let is_far = |k: usize| !self.is_seen(k) || self.square_between(k, target) >= least;
        let rows: Vec<usize> = (0..self.len()).filter(|k| *k != target && is_far(*k)).collect();
        let mut out = Archive { has_features: self.has_features, ..Archive::default() };
        for (place, number) in rows.iter().enumerate() {
            let seen = self.is_seen(*number);
            let shifted = |other: &usize| match self.is_seen(*other) {
                false => 0.0,
                true => {
                    self.product(*number, *other)
                        - self.product(*number, target)
                        - self.product(*other, target)
                        + self.product(target, target)
                }
            };
            let products: Vec<f64> = if seen { rows[..=place].iter().map(shifted).collect() } else { vec![] };
            let score = products.last().map_or(f64::NEG_INFINITY, |square| -0.5 * square);
            out.points.push(self.points[*number].clone());
            out.evaluations.push(Evaluation { score, features: seen.then(Vec::new) });
            out.products.push(products);
        }
        out
    }

    /// The better evaluation first: by score, then by the length of the features, then the earlier one.
    pub fn compare(&self, a: usize, b: usize) -> Ordering {
        let by_score = self.score(b).total_cmp(&self.score(a));
        by_score.then(self.square(a).total_cmp(&self.square(b))).then(a.cmp(&b))
    }

    /// The evaluations from a number on that gave scenes, best first.
    pub fn ranked(&self, from: usize) -> Vec<usize> {
        let mut out: Vec<usize> = (from..self.len()).filter(|k| self.is_seen(*k)).collect();
        out.sort_by(|a, b| self.compare(*a, *b));
        out
    }
}

#[cfg(test)]
mod tests {
    //! The archive about a pseudo-target is that of features less its own; ranks follow scores.
    use super::*;
    use crate::dice::{Dice, Purpose};

    fn archive(count: usize) -> Archive {
        let mut dice = Dice::new(8, Purpose::Design, 0);
        let mut out = Archive::default();
        for k in 0..count {
            let features = (k != 3).then(|| (0..10).map(|_| dice.normal()).collect());
            let point = Point { row: vec![dice.uniform()], used: vec![true] };
            out.push(point, Evaluation { score: -((k * 7 % 5) as f64), features });
        }
        out
    }

    #[test]
    fn about_a_pseudo_target_features_are_less_its_own() {
        let all = archive(12);
        let about = all.about(5, 0.0);
        assert_eq!(about.len(), 11);
        let features = |k: usize| -> Vec<f64> {
            all.features(k).unwrap().iter().zip(all.features(5).unwrap()).map(|(x, y)| x - y).collect()
        };
        let rows: Vec<usize> = (0..12).filter(|k| *k != 5).collect();
        for (i, a) in rows.iter().enumerate().filter(|(_, k)| **k != 3) {
            assert_eq!(about.point(i), all.point(*a));
            for (j, b) in rows.iter().enumerate().filter(|(_, k)| **k != 3) {
                assert!((about.product(i, j) - dot(&features(*a), &features(*b))).abs() < 1e-12);
            }
        }
        assert!(!about.is_seen(3));
        let least = 1.0 + about.ranked(0).iter().map(|k| about.square(*k)).fold(f64::INFINITY, f64::min);
        let far = all.about(5, least);
        assert!(far.len() < 11 && far.ranked(0).iter().all(|k| far.square(*k) >= least));
    }

    #[test]
    fn the_best_comes_first_and_failures_not_at_all() {
        let all = archive(12);
        let ranked = all.ranked(2);
        assert!(ranked.windows(2).all(|pair| all.score(pair[0]) >= all.score(pair[1])));
        assert_eq!(ranked.len(), 9);
    }
}

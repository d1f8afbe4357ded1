//! The evaluations, in the order of asking, with the dot products of their features.

use crate::linear::dot;
use crate::space::Point;
use std::cmp::Ordering;

/// What an evaluation gave.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// The log score, nats; minus infinity for a scene that is forbidden and for an evaluation that failed.
    pub score: f64,
    /// What the scene gets wrong; None for an evaluation that failed. Empty for goals without features.
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
        let others: Vec<usize> = (0..self.len()).filter(|k| *k != target && is_far(*k)).collect();
        let mut out = Archive { has_features: self.has_features, ..Archive::default() };
        for (place, number) in others.iter().enumerate() {
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
            let products: Vec<f64> =
                if seen { others[..=place].iter().map(shifted).collect() } else { vec![] };
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

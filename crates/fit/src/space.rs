//! Parameters, the conditions under which they are used, and points.
//!
//! A point is a row of the unit cube. A parameter with levels stands at the middle of its level, and a parameter that is
//! not used at 0.5. This form is *canonical*: two points are equal when their rows are.
//!
//! Conditions may be unknown: a model that draws parameters as it runs tells only afterwards which it used. A parameter
//! that was once told unused against its condition is *learnt*: whether it is used is taken from the most similar levels
//! that were told.

use crate::dice::Dice;
use serde::Deserialize;

/// Kinds of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Real numbers.
    Real,
    /// Whole numbers: levels in order.
    Whole,
    /// A choice, or a switch: levels without order.
    Choice,
}

/// A condition: of several lists one must hold; a list holds when all of its parameters are used with one of these levels.
pub type When = Vec<Vec<(usize, Vec<usize>)>>;

/// A parameter.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Axis {
    /// The kind of its values.
    pub kind: Kind,
    /// The number of levels; 0 for real numbers.
    #[serde(default)]
    pub levels: usize,
    /// Probabilities of the levels; None if they are equal.
    #[serde(default)]
    pub weights: Option<Vec<f64>>,
    /// When it is used: always, if empty. It names only parameters before its own.
    #[serde(default)]
    pub when: When,
}

/// A point in canonical form.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// The place on each axis, from 0 to 1.
    pub row: Vec<f64>,
    /// The parameters that are used.
    pub used: Vec<bool>,
}

impl Point {
    /// The bits of the row: equal for equal points.
    pub fn key(&self) -> Vec<u64> {
        self.row.iter().zip(&self.used).map(|(x, used)| x.to_bits() ^ u64::from(*used)).collect()
    }
}

/// Levels that were told, and which parameters were used with them.
#[derive(Clone, Debug, PartialEq)]
struct Usage {
    levels: Vec<Option<usize>>,
    used: Vec<bool>,
}

/// The parameters of a model.
#[derive(Clone, Debug)]
pub struct Space {
    axes: Vec<Axis>,
    /// The parameters that depend on each, directly or not.
    dependents: Vec<Vec<usize>>,
    learnt: Vec<bool>,
    usages: Vec<Usage>,
}

/// The most different sets of levels that are remembered for parameters with unknown conditions.
const MEMORY: usize = 400;

impl Space {
    /// The space of these parameters.
    ///
    /// # Errors
    /// A text, when a condition names a parameter that is not before its own, or a level that is missing.
    pub fn new(axes: Vec<Axis>) -> Result<Space, String> {
        if axes.is_empty() {
            return Err("a space needs a parameter".into());
        }
        for (number, axis) in axes.iter().enumerate() {
            if (axis.kind == Kind::Real) != (axis.levels == 0) {
                return Err(format!("parameter {number} has {} levels", axis.levels));
            }
            if axis.weights.as_ref().is_some_and(|weights| weights.len() != axis.levels) {
                return Err(format!(
                    "parameter {number} needs a weight for each of its {} levels",
                    axis.levels
                ));
            }
            for (other, levels) in axis.when.iter().flatten() {
                let fits = *other < number && levels.iter().all(|level| *level < axes[*other].levels);
                if !fits {
                    return Err(format!("parameter {number} depends on levels that parameter {other} lacks"));
                }
            }
        }
        let mut dependents: Vec<Vec<usize>> = vec![vec![]; axes.len()];
        for (number, axis) in axes.iter().enumerate() {
            for (parent, of_parent) in dependents[..number].iter_mut().enumerate() {
                let names = |k: usize| k == parent || of_parent.contains(&k);
                if axis.when.iter().flatten().any(|(other, _)| names(*other)) {
                    of_parent.push(number);
                }
            }
        }
        let learnt = vec![false; axes.len()];
        Ok(Space { axes, dependents, learnt, usages: vec![] })
    }

    /// The parameters.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The number of parameters.
    pub fn len(&self) -> usize {
        self.axes.len()
    }

    /// Never: a space has a parameter.
    pub fn is_empty(&self) -> bool {
        self.axes.is_empty()
    }

    /// Whether a parameter has levels.
    pub fn has_levels(&self, axis: usize) -> bool {
        self.axes[axis].levels > 0
    }

    /// The parameters that depend on one, directly or not.
    pub fn dependents(&self, axis: usize) -> &[usize] {
        &self.dependents[axis]
    }

    /// The level at a place of an axis with levels.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and the levels")]
    pub fn level(&self, axis: usize, place: f64) -> usize {
        let levels = self.axes[axis].levels;
        ((place * levels as f64) as usize).min(levels - 1)
    }

    /// The place of a level.
    pub fn place(&self, axis: usize, level: usize) -> f64 {
        (level as f64 + 0.5) / self.axes[axis].levels as f64
    }

    /// The level whose part of the unit interval has this number, by the probabilities of the levels.
    pub fn level_of_share(&self, axis: usize, share: f64) -> usize {
        let Some(weights) = &self.axes[axis].weights else { return self.level(axis, share) };
        let mut left = share * weights.iter().sum::<f64>();
        for (level, weight) in weights.iter().enumerate() {
            left -= weight;
            if left < 0.0 {
                return level;
            }
        }
        weights.len() - 1
    }

    /// A place drawn from the range of a parameter.
    pub fn draw(&self, axis: usize, dice: &mut Dice) -> f64 {
        let share = dice.uniform();
        if self.has_levels(axis) { self.place(axis, self.level_of_share(axis, share)) } else { share }
    }

    /// A point drawn from the ranges of all parameters.
    pub fn draw_point(&self, dice: &mut Dice) -> Point {
        let row: Vec<f64> = (0..self.len()).map(|axis| self.draw(axis, dice)).collect();
        self.snap(&row)
    }

    /// The point at a row of the unit cube, in canonical form.
    pub fn snap(&self, row: &[f64]) -> Point {
        let mut out = Point { row: row.to_vec(), used: vec![true; row.len()] };
        for (axis, x) in row.iter().enumerate() {
            let x = if x.is_nan() { 0.5 } else { x.clamp(0.0, 1.0) };
            let used = self.holds(axis, &out);
            out.used[axis] = used;
            out.row[axis] = match (used, self.has_levels(axis)) {
                (false, _) => 0.5,
                (true, true) => self.place(axis, self.level(axis, x)),
                (true, false) => x,
            };
        }
        if self.learnt.contains(&true) {
            self.apply_learnt(&mut out);
        }
        out
    }

    /// Whether the condition of a parameter holds at a point whose earlier parameters are known.
    fn holds(&self, axis: usize, point: &Point) -> bool {
        let when = &self.axes[axis].when;
        let fits = |(other, levels): &(usize, Vec<usize>)| {
            point.used[*other] && levels.contains(&self.level(*other, point.row[*other]))
        };
        when.is_empty() || when.iter().any(|rule| rule.iter().all(fits))
    }

    /// The levels of a point; None for real numbers and for what is not used.
    pub fn structure(&self, point: &Point) -> Vec<Option<usize>> {
        let level = |axis: usize| {
            (self.has_levels(axis) && point.used[axis]).then(|| self.level(axis, point.row[axis]))
        };
        (0..self.len()).map(level).collect()
    }

    /// Sets parameters with unknown conditions to unused, as they were with the most similar levels that were told.
    fn apply_learnt(&self, point: &mut Point) {
        let levels = self.structure(point);
        let differing = |usage: &&Usage| usage.levels.iter().zip(&levels).filter(|(a, b)| a != b).count();
        // Of equally similar ones the latest.
        let Some(nearest) = self.usages.iter().rev().min_by_key(differing) else { return };
        for axis in 0..self.len() {
            if self.learnt[axis] && !nearest.used[axis] {
                point.used[axis] = false;
                point.row[axis] = 0.5;
            }
        }
    }

    /// Stores which parameters an evaluation used.
    pub fn learn(&mut self, point: &Point, used: &[bool]) {
        for (axis, is_used) in used.iter().enumerate() {
            self.learnt[axis] |= point.used[axis] && !is_used;
        }
        let usage = Usage { levels: self.structure(point), used: used.to_vec() };
        self.usages.retain(|other| other.levels != usage.levels);
        self.usages.push(usage);
        if self.usages.len() > MEMORY {
            self.usages.remove(0);
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    //! Canonical points, by known and by learnt conditions.
    use super::*;
    use crate::dice::Purpose;

    pub fn axis(kind: Kind, levels: usize, when: When) -> Axis {
        Axis { kind, levels, weights: None, when }
    }

    /// A width, feet or not, their height if so, a web of three, a size if it is not the first and there are feet.
    pub fn example() -> Space {
        Space::new(vec![
            axis(Kind::Real, 0, vec![]),
            axis(Kind::Choice, 2, vec![]),
            axis(Kind::Real, 0, vec![vec![(1, vec![1])]]),
            axis(Kind::Choice, 3, vec![]),
            axis(Kind::Real, 0, vec![vec![(1, vec![1]), (3, vec![1, 2])]]),
            axis(Kind::Whole, 5, vec![]),
        ])
        .unwrap()
    }

    #[test]
    fn unused_parameters_stand_in_the_middle() {
        let space = example();
        let point = space.snap(&[0.3, 0.2, 0.9, 0.9, 0.1, 0.99]);
        assert_eq!(point.row, [0.3, 0.25, 0.5, 2.5 / 3.0, 0.5, 0.9]);
        assert_eq!(point.used, [true, true, false, true, false, true]);
        let point = space.snap(&[0.3, 0.7, 0.9, 0.9, 0.1, -4.0]);
        assert_eq!(point.row, [0.3, 0.75, 0.9, 2.5 / 3.0, 0.1, 0.1]);
        assert_eq!(space.snap(&point.row), point);
        assert_eq!(space.dependents(1), [2, 4]);
    }

    #[test]
    fn one_of_several_conditions_is_enough() {
        let either = vec![vec![(0, vec![1])], vec![(1, vec![1, 2])]];
        let axes =
            vec![axis(Kind::Whole, 2, vec![]), axis(Kind::Whole, 3, vec![]), axis(Kind::Real, 0, either)];
        let space = Space::new(axes).unwrap();
        let used = |a, b| space.snap(&[space.place(0, a), space.place(1, b), 0.7]).used[2];
        assert!(!used(0, 0) && used(1, 0) && used(0, 1) && used(1, 2));
    }

    #[test]
    fn unknown_conditions_are_learnt_from_what_was_used() {
        let axes =
            vec![axis(Kind::Choice, 2, vec![]), axis(Kind::Whole, 4, vec![]), axis(Kind::Real, 0, vec![])];
        let mut space = Space::new(axes).unwrap();
        let point = |space: &Space, a, b| space.snap(&[space.place(0, a), space.place(1, b), 0.7]);
        space.learn(&point(&space, 0, 2), &[true, true, false]);
        assert!(!point(&space, 0, 2).used[2]);
        space.learn(&point(&space, 1, 2), &[true, true, true]);
        assert!(point(&space, 1, 3).used[2] && !point(&space, 0, 3).used[2]);
    }

    #[test]
    fn conditions_must_name_earlier_levels() {
        assert!(Space::new(vec![axis(Kind::Real, 0, vec![vec![(0, vec![0])]])]).is_err());
        assert!(Space::new(vec![]).is_err());
    }

    #[test]
    fn levels_follow_their_weights() {
        let mut switch = axis(Kind::Choice, 2, vec![]);
        switch.weights = Some(vec![0.0, 1.0]);
        let space = Space::new(vec![switch]).unwrap();
        let mut dice = Dice::new(1, Purpose::Design, 0);
        assert!((0..50).all(|_| space.draw(0, &mut dice) == 0.75));
    }
}

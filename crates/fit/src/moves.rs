//! New points from good ones: crossover, differences, mutations; and what evaluations teach about them.
//!
//! Parents are among the best points, or the best of the best structures; a structure is a set of levels. What a change of
//! level brings into use takes its value from a good point that has it, or from its range.

use crate::archive::Archive;
use crate::dice::Dice;
use crate::kernel::Scales;
use crate::kernel::distance;
use crate::space::{Kind, Point, Space};

/// The best points that are parents, and that lend values of parameters that become used.
const PARENTS: usize = 12;
const DONORS: usize = 20;
/// The best points of this many structures are parents, too.
const STRUCTURES: usize = 6;

/// Experience with changes: the usual step of each real parameter, and the gain from changing each level.
#[derive(Clone, Debug, PartialEq)]
pub struct Habits {
    /// The standard deviation of a step, as a share of the range.
    pub steps: Vec<f64>,
    /// A weight for the choice of the level that changes.
    pub gains: Vec<f64>,
}

/// The first step, its range, and its change when a point of few changes wins or does not.
const STEP: f64 = 0.12;
const STEPS: [f64; 2] = [0.01, 0.3];
const LONGER: f64 = 1.25;
const SHORTER: f64 = 0.97;
/// The memory of gains, the gain of a win, and the least weight.
const KEPT: f64 = 0.9;
const WIN: f64 = 10.0;
const LEAST_GAIN: f64 = 0.15;

impl Habits {
    /// Nothing is learnt yet.
    pub fn new(axes: usize) -> Habits {
        Habits { steps: vec![STEP; axes], gains: vec![1.0; axes] }
    }

    /// Learns from a point: `base` was the best before it, `is_plain` says that no emulator chose it.
    pub fn learn(&mut self, space: &Space, base: &Point, point: &Point, has_won: bool, is_plain: bool) {
        let changed = |axis: &usize| (point.row[*axis] - base.row[*axis]).abs() > 1e-9;
        let (levels, reals): (Vec<usize>, Vec<usize>) =
            (0..space.len()).filter(changed).partition(|axis| space.has_levels(*axis));
        if is_plain && (1..=3).contains(&reals.len()) {
            for axis in reals {
                let step = self.steps[axis] * if has_won { LONGER } else { SHORTER };
                self.steps[axis] = step.clamp(STEPS[0], STEPS[1]);
            }
        }
        if levels.len() <= 2 {
            for axis in levels {
                let gain = KEPT * self.gains[axis] + (1.0 - KEPT) * if has_won { WIN } else { 0.0 };
                self.gains[axis] = gain.max(LEAST_GAIN);
            }
        }
    }
}

/// The material of moves: the archive, its best points, and the experience.
#[derive(Debug)]
pub struct Moves<'a> {
    /// The parameters.
    pub space: &'a Space,
    /// The evaluations.
    pub archive: &'a Archive,
    /// The experience.
    pub habits: &'a Habits,
    /// The best points, best first.
    elite: Vec<usize>,
    /// The best point of each of the best structures, best first.
    niches: Vec<usize>,
}

impl<'a> Moves<'a> {
    /// From evaluations that may be parents, best first.
    pub fn new(space: &'a Space, archive: &'a Archive, habits: &'a Habits, ranked: &[usize]) -> Moves<'a> {
        let mut seen = vec![];
        let mut niches = vec![];
        for number in ranked {
            let structure = space.structure(archive.point(*number));
            if !seen.contains(&structure) {
                seen.push(structure);
                niches.push(*number);
                if niches.len() == STRUCTURES {
                    break;
                }
            }
        }
        let elite = ranked.iter().take(DONORS).copied().collect();
        Moves { space, archive, habits, elite, niches }
    }

    /// A parent.
    fn parent(&self, dice: &mut Dice) -> &'a Point {
        let best = &self.elite[..self.elite.len().min(PARENTS)];
        let from = if dice.chance(0.6) { best } else { &self.niches };
        self.archive.point(from[dice.early(2.0, from.len() - 1)])
    }

    /// A new point.
    pub fn propose(&self, dice: &mut Dice) -> Point {
        let parent = self.parent(dice);
        if dice.chance(0.25) {
            return self.crossed(parent, dice);
        }
        if dice.chance(0.2) {
            let (a, b, share) = (self.parent(dice), self.parent(dice), dice.between(0.3, 1.0));
            return self.shifted(parent, a, b, share);
        }
        self.mutant(parent, 1.0, dice)
    }

    /// A parent with some parameters of another: each with probability a half, or one with what depends on it.
    fn crossed(&self, parent: &Point, dice: &mut Dice) -> Point {
        let other = self.parent(dice);
        let mut row = parent.row.clone();
        if dice.chance(0.5) {
            let axis = dice.below(self.space.len());
            for moved in std::iter::once(axis).chain(self.space.dependents(axis).iter().copied()) {
                row[moved] = other.row[moved];
            }
        } else {
            for (x, y) in row.iter_mut().zip(&other.row) {
                if dice.chance(0.5) {
                    *x = *y;
                }
            }
        }
        let child = self.space.snap(&row);
        if dice.chance(0.5) { self.mutant(&child, 0.5, dice) } else { child }
    }

    /// A point moved along the difference of two others; levels stay.
    pub fn shifted(&self, point: &Point, a: &Point, b: &Point, share: f64) -> Point {
        let mut row = point.row.clone();
        for (axis, x) in row.iter_mut().enumerate() {
            if point.used[axis] && !self.space.has_levels(axis) {
                *x = (*x + share * (a.row[axis] - b.row[axis])).clamp(0.0, 1.0);
            }
        }
        self.space.snap(&row)
    }

    /// A point with a changed level, or with some real parameters moved by `wide` times the usual step, or with both.
    pub fn mutant(&self, point: &Point, wide: f64, dice: &mut Dice) -> Point {
        let mut point = point.clone();
        let levelled: Vec<usize> = self.used(&point, true);
        if !levelled.is_empty() && dice.chance(0.3) {
            let weights: Vec<f64> = levelled.iter().map(|axis| self.habits.gains[*axis]).collect();
            let axis = levelled[dice.weighted(&weights)];
            let mut row = point.row.clone();
            row[axis] = self.space.place(axis, self.other_level(axis, point.row[axis], dice));
            let before = point.used.clone();
            point = self.space.snap(&row);
            for new in 0..self.space.len() {
                if point.used[new] && !before[new] {
                    row[new] = self.lent(new, dice);
                    point = self.space.snap(&row);
                }
            }
            if dice.chance(0.5) {
                return point;
            }
        }
        let reals = self.used(&point, false);
        if !reals.is_empty() {
            let count = if dice.chance(0.4) { 1 } else { 1 + dice.below(reals.len()) };
            // One size for all: small and large steps are tried alike.
            let size = wide * niwaki_math::portable::exp(std::f64::consts::LN_10 * dice.between(-1.3, 0.3));
            let mut row = point.row.clone();
            for place in dice.some(count, reals.len()) {
                let axis = reals[place];
                row[axis] = reflect(row[axis] + size * self.habits.steps[axis] * dice.normal());
            }
            point = self.space.snap(&row);
        }
        point
    }

    /// The used parameters that have levels, or that have not.
    fn used(&self, point: &Point, with_levels: bool) -> Vec<usize> {
        let is_meant = |axis: &usize| point.used[*axis] && self.space.has_levels(*axis) == with_levels;
        (0..self.space.len()).filter(is_meant).collect()
    }

    /// Another level: of a whole number mostly one more or less.
    fn other_level(&self, axis: usize, place: f64, dice: &mut Dice) -> usize {
        let (levels, level) = (self.space.axes()[axis].levels, self.space.level(axis, place));
        if self.space.axes()[axis].kind == Kind::Whole && dice.chance(0.7) {
            let step = if dice.chance(0.15) { 2 } else { 1 };
            let next = if dice.chance(0.5) { Some(level + step) } else { level.checked_sub(step) };
            return next.filter(|next| *next < levels).unwrap_or(level);
        }
        dice.below(levels)
    }

    /// A place for a parameter that becomes used: near that of a good point, or anywhere in its range.
    fn lent(&self, axis: usize, dice: &mut Dice) -> f64 {
        let have: Vec<usize> =
            self.elite.iter().copied().filter(|number| self.archive.point(*number).used[axis]).collect();
        if have.is_empty() || !dice.chance(0.6) {
            return self.space.draw(axis, dice);
        }
        let place = self.archive.point(have[dice.early(2.0, have.len() - 1)]).row[axis];
        if self.space.has_levels(axis) { place } else { reflect(place + 0.1 * dice.normal()) }
    }

    /// Whether two points are too near to be both worth an evaluation.
    pub fn are_close(&self, scales: &Scales, a: &Point, b: &Point, least: f64) -> bool {
        distance(self.space, scales, &a.row, &b.row) <= least
    }
}

/// A number reflected at 0 and 1.
fn reflect(x: f64) -> f64 {
    let x = x.abs();
    (if x > 1.0 { 2.0 - x } else { x }).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    //! Moves stay canonical, change levels by one mostly, and fill what becomes used from good points.
    use super::*;
    use crate::archive::Evaluation;
    use crate::dice::Purpose;
    use crate::space::tests::example;

    #[test]
    fn moves_give_canonical_points_that_differ() {
        let space = example();
        let mut dice = Dice::new(1, Purpose::Candidates, 0);
        let mut archive = Archive::default();
        for k in 0..20 {
            let point = space.draw_point(&mut dice);
            archive.push(point, Evaluation { score: -f64::from(k), features: Some(vec![f64::from(k)]) });
        }
        let habits = Habits::new(space.len());
        let moves = Moves::new(&space, &archive, &habits, &archive.ranked(0));
        let mut equal = 0;
        for _ in 0..500 {
            let point = moves.propose(&mut dice);
            assert_eq!(space.snap(&point.row), point);
            equal += usize::from((0..20).any(|k| archive.point(k) == &point));
        }
        assert!(equal < 150, "{equal}");
    }

    #[test]
    fn steps_grow_by_wins_and_gains_follow_levels() {
        let space = example();
        let base = space.snap(&[0.3, 0.2, 0.5, 0.1, 0.5, 0.5]);
        let moved = space.snap(&[0.4, 0.2, 0.5, 0.1, 0.5, 0.5]);
        let mut habits = Habits::new(space.len());
        habits.learn(&space, &base, &moved, true, true);
        assert_eq!(habits.steps[0], STEP * LONGER);
        assert_eq!(habits.steps[2], STEP);
        habits.learn(&space, &base, &space.snap(&[0.3, 0.2, 0.5, 0.9, 0.5, 0.5]), true, false);
        assert!(habits.gains[3] > 1.0 && habits.gains[1] == 1.0);
    }
}

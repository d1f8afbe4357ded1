//! The first points: a Latin hypercube, the best of several by the least distance between two of its points.
//!
//! Each parameter takes every part of its range once (McKay, Beckman & Conover 1979); levels are met in proportion to their
//! probabilities.

use crate::dice::Dice;
use crate::kernel::{Scales, distance};
use crate::space::{Point, Space};

/// Hypercubes that are compared.
const TRIES: usize = 20;

/// The number of first points: four more than there are parameters, within bounds.
pub fn size(space: &Space) -> usize {
    (space.len() + 4).clamp(12, 28)
}

/// The first points.
pub fn points(space: &Space, count: usize, dice: &mut Dice) -> Vec<Point> {
    let scales = Scales::start(space);
    let mut best = (f64::NEG_INFINITY, vec![]);
    for _ in 0..TRIES {
        let points = hypercube(space, count, dice);
        let mut least = f64::INFINITY;
        for (k, point) in points.iter().enumerate() {
            for other in &points[..k] {
                least = least.min(distance(space, &scales, &point.row, &other.row));
            }
        }
        if least > best.0 || best.1.is_empty() {
            best = (least, points);
        }
    }
    best.1
}

fn hypercube(space: &Space, count: usize, dice: &mut Dice) -> Vec<Point> {
    let mut rows = vec![vec![0.0; space.len()]; count];
    for axis in 0..space.len() {
        for (row, part) in rows.iter_mut().zip(dice.some(count, count)) {
            let share = (part as f64 + dice.uniform()) / count as f64;
            row[axis] = if space.has_levels(axis) {
                space.place(axis, space.level_of_share(axis, share))
            } else {
                share
            };
        }
    }
    rows.iter().map(|row| space.snap(row)).collect()
}

#[cfg(test)]
mod tests {
    //! Every part of a range is met once, every level as often as it should be.
    use super::*;
    use crate::dice::Purpose;
    use crate::space::{Kind, tests::axis};

    #[test]
    fn each_part_of_a_range_has_a_point() {
        let space = Space::new(vec![axis(Kind::Real, 0, vec![]), axis(Kind::Choice, 4, vec![])]).unwrap();
        let design = points(&space, 12, &mut Dice::new(7, Purpose::Design, 0));
        let mut parts: Vec<usize> = design.iter().map(|point| (point.row[0] * 12.0) as usize).collect();
        parts.sort_unstable();
        assert_eq!(parts, (0..12).collect::<Vec<_>>());
        let with = |level| design.iter().filter(|point| space.level(1, point.row[1]) == level).count();
        assert_eq!([with(0), with(1), with(2), with(3)], [3; 4]);
    }
}

//! A target at several draws at once, in the lanes of one vector; and what becomes of draws that it refuses.
//!
//! Coordinate `k` of draw `l` is `x[k][l]`, shapes are (dim, lanes). Where the wide density does not cover a draw, the
//! target itself evaluates it.

use super::LANES;
use crate::hamiltonian::lanes::{Wide, finite};
use crate::hamiltonian::potential::evaluate;
use crate::hamiltonian::{Cause, Potential};

/// One number of each draw.
pub type Row = [f64; LANES];

/// `y += a x`.
#[inline(always)]
pub fn add(y: &mut Row, a: f64, x: &Row) {
    for l in 0..LANES {
        y[l] += a * x[l];
    }
}

/// The inner product of a vector with every draw.
#[inline(always)]
pub fn dot(a: &[f64], x: &[Row]) -> Row {
    let mut sum = [0.0; LANES];
    a.iter().zip(x).for_each(|(a, x)| add(&mut sum, *a, x));
    sum
}

/// A draw at which the program makes other choices.
#[derive(Clone, Debug, PartialEq)]
pub struct Elsewhere;

/// A target, evaluated many times.
pub struct Batch<'a, P, W> {
    /// The target.
    pub target: &'a mut P,
    wide: &'a mut W,
    point: (Vec<f64>, Vec<f64>),
    /// Its coordinates that are angles: with them its density repeats every turn.
    pub angles: Vec<usize>,
    /// Gradients taken.
    pub gradients: u64,
    /// The last draw without a finite density or gradient.
    pub refused: Option<Vec<f64>>,
}

impl<'a, P: Potential, W: Wide<LANES>> Batch<'a, P, W> {
    /// A batch of draws of a target, with its density over lanes.
    pub fn new(target: &'a mut P, wide: &'a mut W) -> Self {
        let none = vec![0.0; target.dim()];
        let point = (none.clone(), none);
        Batch { target, wide, point, angles: vec![], gradients: 0, refused: None }
    }

    /// The batch, in which these coordinates are angles.
    #[must_use]
    pub fn around(self, angles: Vec<usize>) -> Self {
        Batch { angles, ..self }
    }

    /// Log densities of the first `count` draws, nats, with gradients in `g`. Of a draw with density zero the value is
    /// minus infinity, of one without a finite density or gradient it is NaN; both have zeros for a gradient.
    ///
    /// # Errors
    /// A draw at which the program makes other choices.
    pub fn evaluate(&mut self, x: &[Row], g: &mut [Row], count: usize) -> Result<Row, Elsewhere> {
        let (mut values, covered) = self.wide.value_and_gradient(x, g);
        let finite = finite(g);
        self.gradients += count as u64;
        for l in 0..count {
            if covered[l] && finite[l] && values[l].is_finite() {
                continue;
            }
            let (at, slope) = &mut self.point;
            at.iter_mut().zip(x).for_each(|(at, row)| *at = row[l]);
            values[l] = match evaluate(self.target, at, slope) {
                Ok(value) => value,
                Err(stop) => {
                    slope.fill(0.0);
                    match stop.cause {
                        Cause::Guard => return Err(Elsewhere),
                        Cause::Impossible => f64::NEG_INFINITY,
                        Cause::NotFinite => {
                            self.refused = Some(at.clone());
                            f64::NAN
                        }
                    }
                }
            };
            g.iter_mut().zip(slope).for_each(|(row, slope)| row[l] = *slope);
        }
        Ok(values)
    }
}

#[cfg(test)]
pub(super) mod tests {
    //! Draws that a target refuses have no gradient, and the others are those of the target.
    use super::*;
    use crate::hamiltonian::Stop;
    use crate::hamiltonian::potential::tests::By;

    /// A wide density that covers nothing, so that the target evaluates every draw.
    pub struct Uncovered;

    impl Wide<LANES> for Uncovered {
        fn value_and_gradient(&mut self, _: &[Row], g: &mut [Row]) -> (Row, [bool; LANES]) {
            g.fill([0.0; LANES]);
            ([0.0; LANES], [false; LANES])
        }
        fn gradient(&mut self, _: &[Row], _: &mut [Row]) -> [bool; LANES] {
            [false; LANES]
        }
    }

    #[test]
    fn refused_draws_are_marked_and_other_choices_are_an_error() {
        let mut halves = By(1, |x: &[f64], g: &mut [f64]| {
            g[0] = x[0];
            match x[0] {
                x if x < -1.0 => Err(Stop { cause: Cause::Guard, place: 0 }),
                x if x < 0.0 => Ok(f64::NEG_INFINITY),
                x if x > 9.0 => Ok(f64::NAN),
                x => Ok(x),
            }
        });
        let (mut wide, mut g) = (Uncovered, [[0.0; LANES]]);
        let mut batch = Batch::new(&mut halves, &mut wide);
        let mut x = [[3.0; LANES]];
        (x[0][1], x[0][2]) = (-0.5, 10.0);
        let values = batch.evaluate(&x, &mut g, 4).expect("one structure");
        assert_eq!((values[0], values[1], values[2].is_nan()), (3.0, f64::NEG_INFINITY, true));
        assert_eq!((g[0][..4].to_vec(), batch.refused.clone()), (vec![3.0, 0.0, 0.0, 3.0], Some(vec![10.0])));
        x[0][3] = -2.0;
        assert_eq!(batch.evaluate(&x, &mut g, 3).map(|v| v[0]), Ok(3.0));
        assert_eq!(batch.evaluate(&x, &mut g, 4), Err(Elsewhere));
    }
}

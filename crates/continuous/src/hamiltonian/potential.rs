//! The target of a gradient sampler: a log density and its gradient over real coordinates.
//!
//! Coordinates are unconstrained: a bounded choice enters through its transform, and the log density has the
//! transform's Jacobian (dissertation 4.3, "bounded variables"). The target may refuse a point; the trajectory that
//! reached it then ends and is rejected, which leaves the target distribution as it is.

use niwaki_grad::Rolling;

/// A log density over `dim` real coordinates, with its gradient.
pub trait Potential {
    /// The number of coordinates.
    fn dim(&self) -> usize;

    /// The log density at `x`, nats, upward; its gradient is written to `gradient`. Both slices have `dim` elements.
    ///
    /// # Errors
    /// A point that the target refuses; `gradient` is then unspecified.
    fn value_and_gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<f64, Stop>;

    /// The gradient alone, to the bit that of [`Potential::value_and_gradient`]: all that is needed
    /// inside of a trajectory.
    ///
    /// # Errors
    /// The errors of [`Potential::value_and_gradient`]; a density of zero may remain undetected.
    #[inline]
    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Stop> {
        self.value_and_gradient(x, gradient).map(|_| ())
    }

    /// Takes up to `steps` leapfrog steps with a diagonal metric and gives how many were taken, to the bit those that
    /// [`super::leapfrog::leapfrog`] takes one by one: `p += kick g`, `x += (step variance) p`, `g` the gradient at `x`,
    /// with `step` for the kick of all but the first. Stops before a step that the target would refuse. A target without
    /// a faster method takes none.
    #[inline]
    fn roll(&mut self, _at: Rolling<'_>, _kick: f64, _step: f64, _steps: u32) -> u32 {
        0
    }
}

impl<P: Potential + ?Sized> Potential for &mut P {
    fn dim(&self) -> usize {
        (**self).dim()
    }
    fn value_and_gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<f64, Stop> {
        (**self).value_and_gradient(x, gradient)
    }
    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Stop> {
        (**self).gradient(x, gradient)
    }
    fn roll(&mut self, at: Rolling<'_>, kick: f64, step: f64, steps: u32) -> u32 {
        (**self).roll(at, kick, step, steps)
    }
}

impl<P: Potential + ?Sized> Potential for Box<P> {
    fn dim(&self) -> usize {
        (**self).dim()
    }
    fn value_and_gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<f64, Stop> {
        (**self).value_and_gradient(x, gradient)
    }
    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Stop> {
        (**self).gradient(x, gradient)
    }
    fn roll(&mut self, at: Rolling<'_>, kick: f64, step: f64, steps: u32) -> u32 {
        (**self).roll(at, kick, step, steps)
    }
}

/// The reason why a trajectory ended early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stop {
    /// The kind of reason.
    pub cause: Cause,
    /// The number of the guard, operation or coordinate in the target.
    pub place: u32,
}

/// The kind of reason why a trajectory ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The program would take a different path, with a different set of choices.
    Guard,
    /// The density is zero.
    Impossible,
    /// The density or its gradient is not a number, or infinite.
    NotFinite,
}

impl Cause {
    /// The number of kinds.
    pub const COUNT: usize = 3;
}

/// The log density and gradient at `x`, both finite.
///
/// # Errors
/// The target's own refusal, a density of zero, a value or gradient that is not finite (its coordinate is the place).
#[inline]
pub fn evaluate(target: &mut (impl Potential + ?Sized), x: &[f64], g: &mut [f64]) -> Result<f64, Stop> {
    let value = target.value_and_gradient(x, g)?;
    if value == f64::NEG_INFINITY {
        return Err(Stop { cause: Cause::Impossible, place: 0 });
    }
    if value.is_finite() && all_finite(g) { Ok(value) } else { Err(not_finite(g)) }
}

/// The gradient at `x`, finite.
///
/// # Errors
/// The target's own refusal, a gradient that is not finite.
#[inline]
pub fn evaluate_gradient(
    target: &mut (impl Potential + ?Sized),
    x: &[f64],
    g: &mut [f64],
) -> Result<(), Stop> {
    target.gradient(x, g)?;
    if all_finite(g) { Ok(()) } else { Err(not_finite(g)) }
}

/// A sum of zeros is a zero only where every term was finite; which one was not is looked up afterwards.
#[inline]
pub(super) fn all_finite(g: &[f64]) -> bool {
    let mut sums = [0.0; 8];
    let (eights, rest) = g.as_chunks::<8>();
    for eight in eights {
        for (sum, slope) in sums.iter_mut().zip(eight) {
            *sum += slope * 0.0;
        }
    }
    let sum: f64 = rest.iter().map(|slope| slope * 0.0).sum();
    sum + sums.iter().sum::<f64>() == 0.0
}

#[cold]
pub(super) fn not_finite(g: &[f64]) -> Stop {
    let place = g.iter().position(|slope| !slope.is_finite()).unwrap_or(0);
    Stop { cause: Cause::NotFinite, place: place as u32 }
}

#[cfg(test)]
pub(crate) mod tests {
    //! A number that is not finite is a stop with its coordinate.
    use super::*;

    /// A target given by a function of (x, gradient).
    pub struct By<F>(pub usize, pub F);

    impl<F: FnMut(&[f64], &mut [f64]) -> Result<f64, Stop>> Potential for By<F> {
        fn dim(&self) -> usize {
            self.0
        }
        fn value_and_gradient(&mut self, x: &[f64], g: &mut [f64]) -> Result<f64, Stop> {
            (self.1)(x, g)
        }
    }

    /// Independent normals with these standard deviations.
    pub fn normals(deviations: Vec<f64>) -> impl Potential + Clone {
        #[derive(Clone)]
        struct Normals(Vec<f64>);
        impl Potential for Normals {
            fn dim(&self) -> usize {
                self.0.len()
            }
            fn value_and_gradient(&mut self, x: &[f64], g: &mut [f64]) -> Result<f64, Stop> {
                let mut value = 0.0;
                for ((x, g), s) in x.iter().zip(g).zip(&self.0) {
                    *g = -x / (s * s);
                    value += 0.5 * x * *g;
                }
                Ok(value)
            }
        }
        Normals(deviations)
    }

    #[test]
    fn what_is_not_finite_stops() {
        let mut g = [0.0; 3];
        let mut slopes = By(3, |x: &[f64], g: &mut [f64]| {
            g.copy_from_slice(x);
            Ok(1.0)
        });
        assert_eq!(evaluate(&mut slopes, &[1.0, -1e308, 3.0], &mut g), Ok(1.0));
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let stop = Stop { cause: Cause::NotFinite, place: 1 };
            assert_eq!(evaluate(&mut slopes, &[1.0, bad, 3.0], &mut g), Err(stop));
            assert_eq!(evaluate_gradient(&mut slopes, &[1.0, bad, 3.0], &mut g), Err(stop));
        }
        let mut many = [1.0; 21];
        assert!(all_finite(&many));
        for place in 0..21 {
            many[place] = f64::INFINITY;
            assert!(!all_finite(&many) && not_finite(&many).place == place as u32);
            many[place] = 1.0;
        }
        let mut values = By(1, |x: &[f64], g: &mut [f64]| {
            g[0] = 0.0;
            Ok(x[0])
        });
        let mut cause = |x: f64| evaluate(&mut values, &[x], &mut [0.0]).map_err(|stop| stop.cause);
        assert_eq!(cause(f64::NAN), Err(Cause::NotFinite));
        assert_eq!(cause(f64::INFINITY), Err(Cause::NotFinite));
        assert_eq!(cause(f64::NEG_INFINITY), Err(Cause::Impossible));
    }
}

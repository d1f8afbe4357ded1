//! The dissertation's outputs, which predict a choice itself, for any prior (dissertation 6.4).
//!
//! These outputs follow the dissertation's code, which differs from its text in part:
//!
//! - a real number is a mixture of Gaussians of the number itself: its weights are sigmoids of outputs, over their sum;
//!   then come a mean and the log of a deviation for each component;
//! - a truth value, or a choice of two values, has one output, whose sigmoid is the probability of the second value;
//! - a choice of more values has an output for each value: the probabilities are sigmoids over their sum.
//!
//! [`Head`] gives densities from outputs relative to the prior. So the dissertation's outputs are translated to outputs of the head
//! with an equal density, with the share of the prior and the limits of every guide. Whole numbers, and
//! real numbers of families other than the Gaussian, have their mixture in the coordinate of the head: the dissertation
//! has no such choices.

use super::{Head, Number};
use niwaki_math::Dist;

/// The numbers of a prior that the translation needs.
#[derive(Clone, Copy)]
pub enum Natural<'a> {
    /// Mean and deviation of a Gaussian; 0 and 1 of another family.
    Line {
        /// The zero of the head's coordinate.
        mean: f64,
        /// The unit of the head's coordinate.
        sd: f64,
    },
    /// Log probabilities of all values, nats.
    Values(&'a [f64]),
}

/// Mean and deviation for [`Natural::Line`].
pub fn unit(dist: &Dist) -> (f64, f64) {
    match dist {
        Dist::Gaussian { mean, sd } => (*mean, *sd),
        _ => (0.0, 1.0),
    }
}

/// The number of a network's outputs for a head.
pub(crate) fn outputs(head: &Head) -> usize {
    if head.outputs() == 2 && matches!(head, Head::Finite { .. }) { 1 } else { head.outputs() }
}

/// Log of the sigmoid.
fn log_sigmoid(x: f64) -> f64 {
    if x > 0.0 { -(-x).exp().ln_1p() } else { x - x.exp().ln_1p() }
}

fn sigmoid(x: f64) -> f64 {
    log_sigmoid(x).exp()
}

/// Translates the outputs of a network to outputs for `head`.
pub(crate) fn translate<N: Number>(raw: &[N], natural: Natural<'_>, to: &mut Vec<f64>) {
    to.clear();
    match natural {
        Natural::Line { mean, sd } => {
            let count = raw.len() / 3;
            let (weights, pairs) = raw.split_at(count);
            to.extend(weights.iter().map(|x| log_sigmoid((*x).into())));
            to.extend(pairs.chunks_exact(2).map(|pair| (pair[0].into() - mean) / sd));
            to.extend(pairs.chunks_exact(2).map(|pair| pair[1].into() - sd.ln()));
        }
        Natural::Values(logs) => {
            // An excluded value of the prior stays excluded, for any output.
            let relative = |x: f64, log: f64| log_sigmoid(x) - if log.is_finite() { log } else { 0.0 };
            match *raw {
                [x] => {
                    to.extend([-1.0, 1.0].iter().zip(logs).map(|(sign, log)| relative(sign * x.into(), *log)))
                }
                _ => to.extend(raw.iter().zip(logs).map(|(x, log)| relative((*x).into(), *log))),
            }
        }
    }
}

/// Derivatives by a network's outputs, from those by the head's outputs.
pub(crate) fn back(raw: &[f64], natural: Natural<'_>, slopes: &[f64], to: &mut Vec<f64>) {
    to.clear();
    match natural {
        Natural::Line { sd, .. } => {
            let count = raw.len() / 3;
            to.extend((0..count).map(|k| slopes[k] * sigmoid(-raw[k])));
            to.extend((0..count).flat_map(|k| [slopes[count + k] / sd, slopes[2 * count + k]]));
        }
        Natural::Values(_) => match *raw {
            [x] => to.push(slopes[1] * sigmoid(-x) - slopes[0] * sigmoid(x)),
            _ => to.extend(raw.iter().zip(slopes).map(|(x, slope)| slope * sigmoid(-x))),
        },
    }
}

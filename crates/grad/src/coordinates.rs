//! Coordinates: maps of continuous choices to numbers without bounds, and back.
//!
//! Numbers use [`Interval`], with the transform's log Jacobian in the density. Other supports:
//!
//! | support | value | log Jacobian |
//! | --- | --- | --- |
//! | line | `u v`; the unit `u` is 1 (see [`unit`]) | `ln u` |
//! | circle (von Mises) | `v` less whole turns, within half a turn of zero | 0: the line winds around the circle |
//! | simplex of `n` | `n - 1` sticks: `z_k = s(v_k - ln(n - 1 - k))` of the rest | `sum ln(z_k (1 - z_k) left_k)` |
//! | vectors | `v` | 0 |
//!
//! Values stay inside their interval if the coordinate leaves the range of numbers of 64 bits: the program sees the last number,
//! and the density is that of the coordinate, which has no end (`niwaki_math`, `distributions/ends.rs`). The circle is for
//! targets that may repeat: over the line its density has infinite mass, over one turn its mass is one.
//!
//! The bounds may depend on other choices. The stick breaking is centred, so that zeros are the middle of the simplex
//! (Stan reference manual, "Unit simplexes"). A held choice is on the line, or a vector, for any support.

use crate::graph::{Graph, Id};
use crate::operation::apply;
use crate::record::{Recorded, Recorder, no_coordinates};
use crate::scalar::Var;
use niwaki_math::{COORDINATES, Dist, Draw, Family, Interval, LEAST, Scalar, Space, Support, logistic};
use niwaki_vm::fault::Fault;
use niwaki_vm::value::Value;
use std::f64::consts::{PI, TAU};

/// The map from coordinates to a choice's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transform {
    /// The coordinate itself.
    Line,
    /// A lower bound and an exponential.
    Above,
    /// Two bounds and a logistic.
    Between,
    /// The coordinate less whole turns.
    Circle,
    /// Sticks broken off the rest of a stick.
    Simplex,
    /// The coordinates themselves.
    Vector,
}

impl Transform {
    /// The name in Python.
    pub const fn name(self) -> &'static str {
        match self {
            Transform::Line => "line",
            Transform::Above => "above",
            Transform::Between => "between",
            Transform::Circle => "circle",
            Transform::Simplex => "simplex",
            Transform::Vector => "vector",
        }
    }

    /// Whether a value is a list of numbers rather than a number.
    pub fn is_vector(self) -> bool {
        matches!(self, Transform::Simplex | Transform::Vector)
    }

    /// The value of a choice that has these numbers.
    ///
    /// # Panics
    /// Without numbers, for a value that is one.
    pub fn value<S: Scalar>(self, numbers: &[S]) -> Value<S> {
        if self.is_vector() { Draw::Vector(numbers.into()).into() } else { Value::Real(numbers[0]) }
    }
}

/// A continuous choice.
#[derive(Clone, Debug)]
pub struct Continuous {
    /// Hash of the address.
    pub address: u128,
    /// Readable address.
    pub path: String,
    /// The family of the choice.
    pub family: Family,
    /// The map from coordinates to the value.
    pub transform: Transform,
    /// The first coordinate.
    pub first: usize,
    /// The number of coordinates.
    pub coordinates: usize,
    /// The size of a unit step of the coordinate on the line, in units of the value; 1 for other transforms.
    pub unit: f64,
    /// Whether the choice keeps its value: its coordinates are its value, and do not move.
    pub is_held: bool,
    /// Nodes of the value: one for each number.
    pub(crate) values: Vec<Id>,
    /// The bounds, if the choice has some.
    pub(crate) edges: [Edge; 2],
}

/// A bound of a choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Edge {
    /// No bound.
    Open,
    /// A number.
    At(f64),
    /// A node that computes the bound from other choices, before the choice's own coordinate.
    Node(Id),
}

impl Edge {
    pub fn of(bound: Option<Var>, graph: &mut Graph) -> Edge {
        match bound {
            None => Edge::Open,
            Some(bound) if !bound.varies() => Edge::At(bound.value()),
            Some(bound) => Edge::Node(bound.id(graph)),
        }
    }
}

/// A choice with its coordinates in a run.
pub(crate) struct Placed {
    pub transform: Transform,
    /// The numbers of the value.
    pub values: Vec<Var>,
    /// Log density of the choice over its coordinates.
    pub log: Var,
    /// The log Jacobian, which is a part of `log`.
    pub slope: Var,
    pub bounds: [Option<Var>; 2],
    pub unit: f64,
}

impl Placed {
    fn plain(transform: Transform, values: Vec<Var>, log: Var) -> Placed {
        Placed { transform, values, log, slope: Var::from_f64(0.0), bounds: [None, None], unit: 1.0 }
    }
}

impl Continuous {
    /// The number of numbers in the value.
    pub fn width(&self) -> usize {
        self.values.len()
    }

    /// The direction beyond an open interval's last number, if the coordinate belongs to this number, which stands for all
    /// coordinates beyond.
    pub fn beyond(&self, v: f64) -> Option<f64> {
        let is_open = matches!(self.family.space(), Space::Positive | Space::Unit | Space::Components);
        let high = match self.transform {
            Transform::Above => COORDINATES.1,
            Transform::Between => HIGHEST_BUT_ONE,
            _ => return None,
        };
        (is_open && v <= COORDINATES.0 + 1e-6)
            .then_some(-1.0)
            .or((is_open && v >= high - 1e-3).then_some(1.0))
    }
}

/// Scales between this number and its inverse need no unit: gradient methods can learn them.
const NEAR: f64 = 1e18;
/// Squares of scales between this number and its inverse are normal numbers.
const FAR: f64 = 1e140;

/// The unit of a choice on the line. It is a power of two near the choice's scale, if that scale is so far from 1 that its
/// squares, and steps to it, leave the range of numbers.
///
/// # Errors
/// A scale that depends on other choices and is too far from 1 to be learnt, since a unit is a constant.
fn unit(dist: &Dist<Var>) -> Result<f64, Fault> {
    let Some(scale) = dist.scale() else { return Ok(1.0) };
    if scale.varies() {
        return check_learnable(dist, scale.value());
    }
    let near = (1.0 / NEAR..=NEAR).contains(&scale.value());
    Ok(if near { 1.0 } else { scale.value().log2().round().exp2() })
}

/// Refuses a scale that a method would have to learn but that is too far from 1.
fn check_learnable(dist: &Dist<Var>, scale: f64) -> Result<f64, Fault> {
    if (1.0 / FAR..=FAR).contains(&scale) {
        return Ok(1.0);
    }
    let message =
        format!("a choice from a `{}` of scale {scale:.0e}, which has to be learnt", dist.family().name());
    Err(Fault::new("extreme-scale", message)
        .with_help("draw from a scale of 1, and multiply: `mean + spread * gaussian(0, 1)`"))
}

impl Recorder<'_> {
    pub(crate) fn coordinate(&mut self, v: f64) -> Var {
        self.start.push(v);
        Var::input(v)
    }

    /// A continuous choice with its value; `None` if it has no coordinates of this kind.
    pub(crate) fn place(
        &mut self,
        dist: &Dist<Var>,
        draw: &Draw,
        held: bool,
    ) -> Result<Option<Placed>, Fault> {
        Ok(Some(match (dist.family().space(), draw) {
            (Space::Simplex, Draw::Vector(x)) if !held && dist.dimension() == Some(x.len()) => match dist {
                Dist::Dirichlet(a) => self.simplex(a, x),
                _ => return Err(no_coordinates(dist)),
            },
            (Space::Simplex | Space::Vectors, Draw::Vector(x)) => {
                if let Dist::MultivariateGaussian(g) = dist {
                    for (i, row) in g.covariance.iter().enumerate() {
                        check_learnable(dist, row[i].value().sqrt())?;
                    }
                }
                if let Dist::DiagonalGaussian(g) = dist {
                    g.sd.iter().try_for_each(|sd| check_learnable(dist, sd.value()).map(|_| ()))?;
                }
                let values: Vec<Var> = x.iter().map(|x| self.coordinate(*x)).collect();
                let log = dist.log_density(&Draw::Vector(values.clone().into()));
                Placed::plain(Transform::Vector, values, log)
            }
            (Space::Counts | Space::Truths, _) | (_, Draw::Counts(_) | Draw::Truths(_)) => return Ok(None),
            (_, Draw::Vector(_)) => return Err(no_coordinates(dist)),
            (_, Draw::Real(_) | Draw::Int(_) | Draw::Bool(_)) => {
                let (support, Some(x)) = (dist.support(), draw.as_real()) else { return Ok(None) };
                match support {
                    Support::Reals(_) | Support::Circle if held => {
                        let value = self.coordinate(x);
                        Placed::plain(Transform::Line, vec![value], dist.log_density_of_real(value))
                    }
                    Support::Reals(interval) => self.real(dist, interval, x)?,
                    Support::Circle => {
                        let v = self.coordinate(x);
                        let turns = (v * Var::from_f64(1.0 / TAU)).round();
                        let value = (v - Var::from_f64(TAU) * turns).within(-PI, PI).at(x);
                        Placed::plain(Transform::Circle, vec![value], dist.log_density_of_real(value))
                    }
                    Support::Booleans | Support::Categories(_) | Support::Integers { .. } => return Ok(None),
                    Support::Points { .. } | Support::VectorPoints(_) => return Ok(None),
                    Support::Simplex(_) | Support::Vectors(_) => return Ok(None),
                    Support::Counts(_) | Support::Truths(_) => return Ok(None),
                }
            }
        }))
    }

    /// A real choice on its coordinate.
    fn real(&mut self, dist: &Dist<Var>, interval: Interval<Var>, x: f64) -> Result<Placed, Fault> {
        let at = |value: Var| dist.log_density_of_real(value);
        let placed = |transform, value, log, slope| Placed {
            transform,
            values: vec![value],
            log,
            slope,
            bounds: [interval.lo, interval.hi],
            unit: 1.0,
        };
        if interval == Interval::LINE {
            let unit = unit(dist)?;
            if unit == 1.0 {
                let v = self.coordinate(x);
                return Ok(Placed::plain(Transform::Line, vec![v], at(v)));
            }
            let value = (self.coordinate(x / unit) * Var::from_f64(unit)).at(x);
            let slope = Var::from_f64(unit.ln());
            return Ok(Placed { unit, ..placed(Transform::Line, value, at(value) + slope, slope) });
        }
        let v = self.coordinate(interval.coordinate(x));
        let c = Var::from_f64;
        match dist.open_space() {
            Some(Space::Positive) => {
                let number = v.max(c(COORDINATES.0)).min(c(COORDINATES.1)).exp();
                let value = number.at(x);
                let log = dist.log_density_by_log(value, v) + v;
                let slope = slope_within(v, COORDINATES, log - at(value), v);
                return Ok(placed(Transform::Above, value, log, slope));
            }
            Some(Space::Unit) => {
                let number = interval.value(v.max(c(COORDINATES.0)));
                let share = number.value.within(0.0, 1.0).min(c(1.0_f64.next_down()));
                let value = share.at(x);
                let log_share = number.value.ln() + (v - c(COORDINATES.0)).min(c(0.0));
                let plain = c(2.0) * log_share - v;
                let Some(log) = dist.log_density_by_shares(log_share, log_share - v) else {
                    return Ok(placed(Transform::Between, value, at(value) + plain, plain));
                };
                let slope = slope_within(v, (COORDINATES.0, HIGHEST), log - at(value), plain);
                return Ok(placed(Transform::Between, value, log, slope));
            }
            _ => {}
        }
        let number = interval.value(v);
        let mut value = number.value.at(x);
        let Some((log_width, _)) = number.between else {
            return Ok(placed(Transform::Above, value, at(value) + number.log_slope, number.log_slope));
        };
        if let (Some(lo), Some(hi)) = (interval.lo, interval.hi)
            && !lo.varies()
            && !hi.varies()
        {
            value = value.within(lo.value(), hi.value());
        }
        let log = match dist {
            Dist::Uniform { .. } => number.log_slope,
            _ => at(value) + log_width + number.log_slope,
        };
        Ok(placed(Transform::Between, value, log, log_width + number.log_slope))
    }

    /// A point of the simplex on its coordinates.
    fn simplex(&mut self, concentrations: &[Var], x: &[f64]) -> Placed {
        let c = Var::from_f64;
        let n = concentrations.len();
        let (mut left, mut log_left, mut left_at) = (c(1.0), c(0.0), 1.0);
        let (mut values, mut log, mut slope) = (Vec::with_capacity(n), c(0.0), c(0.0));
        let total = concentrations.iter().fold(c(0.0), |sum, a| sum + *a);
        for (k, a) in concentrations.iter().enumerate() {
            log = log - a.ln_gamma();
            if k + 1 == n {
                values.push(left.max(c(LEAST)).at(x[k]));
                log = log + (*a - c(1.0)) * log_left;
                break;
            }
            let v = self.coordinate(stick(&x[k..], left_at, n, k));
            let centred = v - c(shift(n, k));
            let near = centred.max(c(COORDINATES.0));
            let z = logistic(near);
            let log_z = z.ln() + (centred - c(COORDINATES.0)).min(c(0.0));
            values.push((left * z).within(0.0, 1.0).max(c(LEAST)).at(x[k]));
            // ln x_k = ln left + ln z; the Jacobian of this stick is z (1 - z) left.
            let term = (log_z + log_z - centred) + log_left;
            log = log + (*a - c(1.0)) * (log_left + log_z) + term;
            slope = slope + term;
            log_left = log_left + (log_z - centred);
            // Near one, the exponential gives the digits of the rest.
            let rest = near.above(NEAR_ONE, || z * (-near).exp(), || c(1.0) - z);
            left = (left * rest).within(0.0, 1.0);
            left_at -= x[k];
        }
        let log = log + total.ln_gamma();
        Placed { slope, ..Placed::plain(Transform::Simplex, values, log) }
    }
}

/// The log Jacobian: `inside` between the two limits, else `beyond`, the coordinate's log density less the value's score.
fn slope_within(v: Var, (least, most): (f64, f64), beyond: Var, inside: Var) -> Var {
    v.above(most, || beyond, || v.above(least, || inside, || beyond))
}

/// The offset that centres the `k`-th stick of a simplex of `n`.
fn shift(n: usize, k: usize) -> f64 {
    ((n - 1 - k) as f64).ln()
}

/// The coordinate from which on a share rounds to one.
const HIGHEST: f64 = 36.7;
/// The coordinate of the last number below one.
const HIGHEST_BUT_ONE: f64 = 36.736;
/// The coordinate above which one less a share has few digits.
const NEAR_ONE: f64 = 20.0;
/// Least rest of a stick that has digits.
const LEFT: f64 = 1e-6;

/// The coordinate of the `k`-th stick of a rest; `x` holds the shares from this one on.
fn stick(x: &[f64], left: f64, n: usize, k: usize) -> f64 {
    let share = x[0] / left;
    let v = share.ln() - (-share).ln_1p();
    let is_near = left > LEFT && v.abs() < NEAR_ONE;
    let rest = || x[1..].iter().sum::<f64>().max(LEAST).ln();
    (if is_near { v } else { x[0].max(LEAST).ln() - rest() }) + shift(n, k)
}

impl Recorded {
    /// The coordinates of other values of the same choices: the inverse of [`Recorded::numbers`]. `value` returns the
    /// value of each choice, in order; coordinates that belong to no choice are those of the recorded run.
    /// `None` if a value is of another kind, or outside its bounds.
    pub fn coordinates<'a>(
        &self,
        mut value: impl FnMut(&Continuous) -> Option<&'a Value>,
    ) -> Option<Vec<f64>> {
        let mut x = self.start.clone();
        let mut nodes: Vec<f64> = Vec::new();
        for choice in &self.choices {
            let draw = value(choice)?.draw()?;
            let place = choice.first..choice.first + choice.coordinates;
            let mut edge = |edge: Edge| match edge {
                Edge::Open => None,
                Edge::At(bound) => Some(bound),
                // The node of the bound is before the choice's coordinate, so it depends only on known coordinates.
                Edge::Node(id) => Some(self.node(id, &x, &mut nodes)),
            };
            let interval = Interval { lo: edge(choice.edges[0]), hi: edge(choice.edges[1]) };
            match (choice.transform, &draw) {
                (Transform::Simplex, Draw::Vector(shares)) if shares.len() == choice.width() => {
                    let mut left = 1.0;
                    for (k, (x, share)) in x[place].iter_mut().zip(shares.iter()).enumerate() {
                        *x = stick(&shares[k..], left, shares.len(), k);
                        left -= share;
                    }
                }
                (Transform::Vector, Draw::Vector(all)) if all.len() == choice.width() => {
                    x[place].copy_from_slice(all);
                }
                (Transform::Simplex | Transform::Vector, _) => return None,
                (_, draw) => {
                    let value = draw.as_real()?;
                    if interval.lo.is_some_and(|lo| value < lo) || interval.hi.is_some_and(|hi| value > hi) {
                        return None;
                    }
                    x[choice.first] = interval.coordinate(value) / choice.unit;
                }
            }
        }
        Some(x)
    }

    /// The value of a node at `x`; `known` holds the values of the first nodes.
    fn node(&self, id: Id, x: &[f64], known: &mut Vec<f64>) -> f64 {
        for (_, node) in self.density.graph().nodes().take(id.index() + 1).skip(known.len()) {
            let number = match (node.constant(), node.input()) {
                (Some(c), _) => c,
                (_, Some(k)) => x[k],
                _ => {
                    let mut args = [0.0; 3];
                    args.iter_mut().zip(node.args()).for_each(|(slot, arg)| *slot = known[arg.index()]);
                    apply(node.op, args[0], args[1], args[2])
                }
            };
            known.push(number);
        }
        known[id.index()]
    }
}

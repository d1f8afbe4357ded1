//! Coordinates: maps a continuous choice to numbers without bounds, and back.
//!
//! Numbers use [`Interval`], with the transform's log Jacobian in the density. Beyond these:
//!
//! | support | value | log Jacobian |
//! | --- | --- | --- |
//! | line | `u v`; the unit `u` is 1 (see [`unit`]) | `ln u` |
//! | circle (von Mises) | `v` less whole turns, within half a turn of zero | 0: the line winds around the circle |
//! | simplex of `n` | `n - 1` sticks: `z_k = s(v_k - ln(n - 1 - k))` of what is left | `sum ln(z_k (1 - z_k) left_k)` |
//! | vectors | `v` | 0 |
//!
//! Values stay inside their interval where the coordinate leaves the numbers of 64 bits: the program sees the last number,
//! and the density is that of the coordinate, which has no end (`niwaki_math`, `distributions/ends.rs`). The circle is for
//! targets that may repeat: over the line its density has no finite mass, over one turn its mass is one.
//!
//! The bounds may depend on other choices. The stick breaking is centred, so that zeros are the middle of the simplex
//! (Stan reference manual, "Unit simplexes"). A choice that is held is the line, or vectors, whatever its support.

use crate::graph::{Graph, Id};
use crate::operation::apply;
use crate::record::{Recorded, Recorder, no_coordinates};
use crate::scalar::Var;
use niwaki_math::{COORDINATES, Dist, Draw, Family, Interval, LEAST, Scalar, Space, Support, logistic};
use niwaki_vm::fault::Fault;
use niwaki_vm::value::Value;
use std::f64::consts::{PI, TAU};

/// How a choice's value follows from its coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transform {
    /// The coordinate itself.
    Line,
    /// A lower bound and an exponential.
    Above,
    /// Two bounds and a logistic.
    Between,
    /// Whole turns taken off.
    Circle,
    /// Sticks broken off what is left.
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
    /// Hash of its address.
    pub address: u128,
    /// Readable address.
    pub path: String,
    /// Its family.
    pub family: Family,
    /// From coordinates to value.
    pub transform: Transform,
    /// Its first coordinate.
    pub first: usize,
    /// How many coordinates it has.
    pub coordinates: usize,
    /// The size of one step of its coordinate on the line, in units of its value; 1 for other transforms.
    pub unit: f64,
    /// Whether it keeps its value: its coordinates are its value, and do not move.
    pub is_held: bool,
    /// Nodes of its value: one, or one for each entry of a vector.
    pub(crate) values: Vec<Id>,
    /// Its bounds, where it has some.
    pub(crate) edges: [Edge; 2],
}

/// A bound of a choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Edge {
    /// There is none.
    Open,
    /// A number.
    At(f64),
    /// Computed from other choices: a node before the choice's own coordinate.
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
    /// The value: one number, or one for each entry of a vector.
    pub values: Vec<Var>,
    /// Log density of the choice over its coordinates.
    pub log: Var,
    /// The part of that which is the log Jacobian.
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
    /// How many numbers its value has.
    pub fn width(&self) -> usize {
        self.values.len()
    }

    /// Whether a coordinate belongs to the last number inside an open interval, which stands for all coordinates beyond:
    /// the direction of these.
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

/// Scales between these and their inverses are coordinates as they are: gradient methods can learn them.
const NEAR: f64 = 1e18;
/// Squares of scales between these and their inverses are normal numbers.
const FAR: f64 = 1e140;

/// The unit of a choice on the line: a power of two near its scale, if that scale is so far from 1 that squares of it,
/// and the steps to it, leave the range of numbers.
///
/// # Errors
/// A scale that depends on other choices and is too far from 1 to be learnt: a unit is a constant.
fn unit(dist: &Dist<Var>) -> Result<f64, Fault> {
    let Some(scale) = dist.scale() else { return Ok(1.0) };
    if scale.varies() {
        return learnt(dist, scale.value());
    }
    let near = (1.0 / NEAR..=NEAR).contains(&scale.value());
    Ok(if near { 1.0 } else { scale.value().log2().round().exp2() })
}

/// Refuses a scale that would have to be learnt but is too far from 1.
fn learnt(dist: &Dist<Var>, scale: f64) -> Result<f64, Fault> {
    if (1.0 / FAR..=FAR).contains(&scale) {
        return Ok(1.0);
    }
    let what =
        format!("a choice from a `{}` of scale {scale:.0e}, which has to be learnt", dist.family().name());
    Err(Fault::new("extreme-scale", what)
        .with_help("draw from a scale of 1, and multiply: `mean + spread * gaussian(0, 1)`"))
}

impl Recorder<'_> {
    pub(crate) fn coordinate(&mut self, v: f64) -> Var {
        self.start.push(v);
        Var::input(v)
    }

    /// A continuous choice with its value; `None` where it has no coordinates of this kind.
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
                        learnt(dist, row[i].value().sqrt())?;
                    }
                }
                if let Dist::DiagonalGaussian(g) = dist {
                    g.sd.iter().try_for_each(|sd| learnt(dist, sd.value()).map(|_| ()))?;
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

    /// A real choice.
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

    /// A point of the simplex.
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
            let own = (log_z + log_z - centred) + log_left;
            log = log + (*a - c(1.0)) * (log_left + log_z) + own;
            slope = slope + own;
            log_left = log_left + (log_z - centred);
            // Near one the rest has its digits from the exponential.
            let rest = near.above(NEAR_ONE, || z * (-near).exp(), || c(1.0) - z);
            left = (left * rest).within(0.0, 1.0);
            left_at -= x[k];
        }
        let log = log + total.ln_gamma();
        Placed { slope, ..Placed::plain(Transform::Simplex, values, log) }
    }
}

/// The log Jacobian: beyond the numbers that whose density of the value is the one that the value is scored with.
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
/// What is left of a stick has digits above this.
const LEFT: f64 = 1e-6;

/// The coordinate of the `k`-th stick, of what is left; `x` are the shares from this one on.
fn stick(x: &[f64], left: f64, n: usize, k: usize) -> f64 {
    let share = x[0] / left;
    let v = share.ln() - (-share).ln_1p();
    let is_near = left > LEFT && v.abs() < NEAR_ONE;
    let rest = || x[1..].iter().sum::<f64>().max(LEAST).ln();
    (if is_near { v } else { x[0].max(LEAST).ln() - rest() }) + shift(n, k)
}

impl Recorded {
    /// The coordinates of other values of the same choices: the inverse of [`Recorded::numbers`]. `value` gives the
    /// value of each choice, in their order; the coordinates that are none of a choice are those of the recorded run.
    /// `None` where a value is of another kind, or outside its bounds.
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
                // Its node is before the choice's coordinate, so it depends only on known coordinates.
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

    /// A node's number at `x`; `known` holds those of the first nodes.
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

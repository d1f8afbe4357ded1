//! Recording: one run of a program, its continuous choices as coordinates, becomes a [`Density`].
//!
//! Coordinates are unconstrained. With `s(v) = 1 / (1 + exp(-v))`, and each transform's log Jacobian in the density:
//!
//! | support | value | log Jacobian |
//! | --- | --- | --- |
//! | line | `v` | 0 |
//! | above `lo` | `lo + exp(v)` | `v` |
//! | `lo` to `hi` | `lo + (hi - lo) s(v)` | `ln(hi - lo) + 2 ln s(v) - v` |
//! | circle (von Mises) | `v` less whole turns, within half a turn of zero | 0: the line winds around the circle |
//! | simplex of `n` | `n - 1` sticks: `z_k = s(v_k - ln(n - 1 - k))` of what is left | `sum ln(z_k (1 - z_k) left_k)` |
//! | vectors | `v` | 0 |
//!
//! The bounds may depend on other choices. The stick breaking is centred, so that zeros are the middle of the simplex
//! (Stan reference manual, "Unit simplexes"). Discrete choices keep their values; their probabilities belong to the
//! density. Scores of a scene are no part of it: see the caller.

use crate::density::Density;
use crate::graph::Id;
use crate::scalar::{Var, with_sheet};
use crate::tape::{Lanes, Tape};
use niwaki_geom::Shape;
use niwaki_math::{Dist, Draw, Family, Scalar};
use niwaki_vm::builtins::{draw_to_value, value_to_draw};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::machine::{Limits, Machine};
use niwaki_vm::value::Value;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

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
    /// Nodes of its value: one, or one for each entry of a vector.
    values: Vec<Id>,
}

/// A recorded run.
#[derive(Clone)]
pub struct Recorded {
    /// The log density over the coordinates.
    pub density: Arc<Density>,
    /// The continuous choices, in the order of the run.
    pub choices: Vec<Continuous>,
    /// Addresses and values of the choices held fixed.
    pub fixed: Vec<(u128, Value)>,
    /// The coordinates of the recorded run.
    pub start: Vec<f64>,
    /// Hash of the addresses, supports and fixed values: runs of one key differ in coordinates and guards only.
    pub structure: u128,
    /// How many primitives the run emitted. Their scores are no part of the density.
    pub emitted: usize,
    /// From coordinates to values.
    unpack: Tape,
}

/// A call of a pure host function, by the number of the constant that names it.
pub type HostCall<'a> = dyn Fn(u16, &[Value]) -> Result<Value, Fault> + Send + Sync + 'a;

/// What is recorded.
pub struct Run<'a> {
    /// The program, over recording numbers: [`Program::over`].
    pub program: &'a Program<Var>,
    /// The arguments of its entry function.
    pub args: &'a [Value<Var>],
    /// How much the run may use.
    pub limits: Limits,
    /// Pure functions of the host, by the number of the constant that names them.
    pub host: &'a HostCall<'a>,
}

struct Recorder<'a> {
    run: &'a Run<'a>,
    choices: &'a HashMap<u128, Value>,
    density: Var,
    continuous: Vec<(Continuous, Vec<Var>)>,
    fixed: Vec<(u128, Value)>,
    start: Vec<f64>,
    structure: u128,
    emitted: usize,
}

/// Lower and upper bound of a family of reals.
fn bounds(dist: &Dist<Var>) -> Option<(Option<Var>, Option<Var>)> {
    let c = Var::from_f64;
    Some(match dist {
        Dist::Gaussian { .. } | Dist::Laplace { .. } | Dist::Cauchy { .. } | Dist::StudentT { .. } => {
            (None, None)
        }
        Dist::LogNormal { .. }
        | Dist::Gamma { .. }
        | Dist::InverseGamma { .. }
        | Dist::Exponential { .. } => (Some(c(0.0)), None),
        Dist::Beta { .. } => (Some(c(0.0)), Some(c(1.0))),
        Dist::Uniform { lo, hi } | Dist::TruncatedGaussian { lo, hi, .. } => (Some(*lo), Some(*hi)),
        Dist::VonMises { .. } => (Some(c(-PI)), Some(c(PI))),
        Dist::Mixture(m) => {
            let mut all = m.components.iter().map(bounds);
            let first = all.next()??;
            all.try_fold(first, |(lo, hi), next| {
                let (lo2, hi2) = next?;
                Some((lo.zip(lo2).map(|(a, b)| a.min(b)), hi.zip(hi2).map(|(a, b)| a.max(b))))
            })?
        }
        _ => return None,
    })
}

/// Coordinates beyond lose the digits of the bound that they approach.
const FARTHEST: f64 = 36.0;

fn logistic(v: Var) -> Var {
    let one = Var::from_f64(1.0);
    one / (one + (-v).exp())
}

fn log_odds(share: f64) -> f64 {
    (share.ln() - (-share).ln_1p()).clamp(-FARTHEST, FARTHEST)
}

impl Recorder<'_> {
    fn coordinate(&mut self, v: f64) -> Var {
        self.start.push(v);
        Var::input(v)
    }

    /// A real choice: its transform, its value and the log density over the coordinate.
    fn real(&mut self, dist: &Dist<Var>, x: f64) -> Result<(Transform, Var, Var), Fault> {
        let two = Var::from_f64(2.0);
        let at = |value: Var| dist.log_density_of_real(value);
        if let Dist::VonMises { .. } = dist {
            let v = self.coordinate(x);
            let turns = (v * Var::from_f64(1.0 / TAU)).round();
            let value = (v - Var::from_f64(TAU) * turns).within(-PI, PI).at(x);
            return Ok((Transform::Circle, value, at(value)));
        }
        let (lo, hi) = bounds(dist).ok_or_else(|| no_coordinates(dist))?;
        Ok(match (lo, hi) {
            (None, None) => {
                let v = self.coordinate(x);
                (Transform::Line, v, at(v))
            }
            (Some(lo), None) => {
                let v = self.coordinate((x - lo.value()).max(f64::MIN_POSITIVE).ln());
                let value = (lo + v.exp()).at(x);
                (Transform::Above, value, at(value) + v)
            }
            (None, Some(hi)) => {
                let v = self.coordinate((hi.value() - x).max(f64::MIN_POSITIVE).ln());
                let value = (hi - v.exp()).at(x);
                (Transform::Above, value, at(value) + v)
            }
            (Some(lo), Some(hi)) => {
                let v = self.coordinate(log_odds((x - lo.value()) / (hi.value() - lo.value())));
                let s = logistic(v);
                let log = s.ln();
                let width = hi - lo;
                let mut value = (lo + width * s).at(x);
                if !lo.varies() && !hi.varies() {
                    value = value.within(lo.value(), hi.value());
                }
                let slope = two * log - v;
                // Where the density is one of the share, its logarithms are at hand, and nothing cancels.
                let log_density = match dist {
                    Dist::Uniform { .. } => slope,
                    Dist::Beta { a, b } => {
                        let norm = a.ln_gamma() + b.ln_gamma() - (*a + *b).ln_gamma();
                        *a * log + *b * (log - v) - norm
                    }
                    _ => at(value) + width.ln() + slope,
                };
                (Transform::Between, value, log_density)
            }
        })
    }

    /// A point of the simplex, and the log density over its coordinates.
    fn simplex(&mut self, concentrations: &[Var], x: &[f64]) -> (Vec<Var>, Var) {
        let c = Var::from_f64;
        let n = concentrations.len();
        let (mut left, mut log_left, mut left_at) = (c(1.0), c(0.0), 1.0);
        let (mut values, mut log) = (Vec::with_capacity(n), c(0.0));
        let total = concentrations.iter().fold(c(0.0), |sum, a| sum + *a);
        for (k, a) in concentrations.iter().enumerate() {
            log = log - a.ln_gamma();
            if k + 1 == n {
                values.push(left.at(x[k]));
                log = log + (*a - c(1.0)) * log_left;
                break;
            }
            let shift = ((n - 1 - k) as f64).ln();
            let v = self.coordinate(log_odds(x[k] / left_at) + shift);
            let centred = v - c(shift);
            let z = logistic(centred);
            let log_z = z.ln();
            values.push((left * z).within(0.0, 1.0).at(x[k]));
            // ln x_k = ln left + ln z; the Jacobian of this stick is z (1 - z) left.
            log = log + (*a - c(1.0)) * (log_left + log_z) + (log_z + log_z - centred) + log_left;
            log_left = log_left + (log_z - centred);
            left = (left * (c(1.0) - z)).within(0.0, 1.0);
            left_at -= x[k];
        }
        (values, log + total.ln_gamma())
    }

    fn mix(&mut self, part: u128) {
        const ODD: u128 = 0x9E37_79B9_7F4A_7C15_F39C_C060_5CED_C835;
        self.structure = (self.structure.rotate_left(41) ^ part).wrapping_mul(ODD);
        self.structure ^= self.structure >> 61;
    }
}

#[cold]
fn no_coordinates(dist: &Dist<Var>) -> Fault {
    let name = dist.family().name();
    Fault::new("no-derivative", format!("a choice from this `{name}` has no continuous coordinates"))
        .with_help("a mixture must have components that are all of one kind")
}

#[cold]
fn impossible(what: &str) -> Fault {
    Fault::new("impossible-trace", format!("{what} makes this run impossible: it has no gradient to follow"))
        .with_help("start from a run that is possible, for example one found by particles or rejection")
}

impl Answers<Var> for Recorder<'_> {
    fn choice(&mut self, at: &At<'_, Var>, dist: &Dist<Var>) -> Result<Answer<Value<Var>>, Fault> {
        let address = at.address();
        let Some(given) = self.choices.get(&address) else {
            let path = at.path();
            return Err(Fault::new("missing-choice", format!("there is no value for the choice `{path}`"))
                .with_help("record with the same model that made the choices"));
        };
        let unfit = || Fault::type_mismatch(format!("no distribution draws {}", given.described()));
        let draw = value_to_draw(given).ok_or_else(unfit)?;
        self.mix(address);
        let first = self.start.len();
        let family = dist.family();
        let (transform, values, log, draw) = match (dist, &draw) {
            (Dist::Delta(value), _) => {
                // A fixed value may vary with other choices.
                let value = value.clone();
                return Ok(Answer::Go(draw_to_value(value)));
            }
            (Dist::Dirichlet(a), Draw::Vector(x)) if a.len() == x.len() => {
                let (values, log) = self.simplex(a, x);
                (Transform::Simplex, values.clone(), log, Draw::Vector(values.into()))
            }
            (Dist::MultivariateGaussian(_), Draw::Vector(x)) => {
                let values: Vec<Var> = x.iter().map(|x| self.coordinate(*x)).collect();
                let draw = Draw::Vector(values.clone().into());
                (Transform::Vector, values, dist.log_density(&draw), draw)
            }
            (_, Draw::Real(_) | Draw::Int(_) | Draw::Bool(_)) if bounds(dist).is_some() => {
                let Some(x) = draw.as_real() else { return Err(unfit()) };
                let (transform, value, log) = self.real(dist, x)?;
                (transform, vec![value], log, Draw::Real(value))
            }
            (_, Draw::Vector(_)) => return Err(no_coordinates(dist)),
            _ => {
                let value = draw.convert(&Var::from_f64);
                let log = dist.log_density(&value);
                if log.value() == f64::NEG_INFINITY {
                    return Err(impossible("a choice of probability zero"));
                }
                self.density = self.density + log;
                let kept = match &draw {
                    Draw::Bool(b) => u128::from(*b),
                    Draw::Int(i) => *i as u128,
                    Draw::Real(x) => u128::from(x.to_bits()),
                    Draw::Vector(_) => 0,
                };
                self.mix(kept);
                self.fixed.push((address, given.clone()));
                return Ok(Answer::Go(draw_to_value(value)));
            }
        };
        if log.value() == f64::NEG_INFINITY {
            return Err(impossible("a choice outside its support"));
        }
        self.mix(1 + transform as u128);
        self.density = self.density + log;
        let coordinates = self.start.len() - first;
        let choice =
            Continuous { address, path: at.path(), family, transform, first, coordinates, values: vec![] };
        self.continuous.push((choice, values));
        Ok(Answer::Go(draw_to_value(draw)))
    }

    fn score(&mut self, _: &At<'_, Var>, factor: Factor, log: Var) -> Result<Answer<()>, Fault> {
        let x = log.value();
        if x.is_nan() || x == f64::INFINITY {
            return Err(Fault::new("non-finite-score", format!("a factor of {x} nats"))
                .with_help("a log factor is a finite number, or minus infinity for what is impossible"));
        }
        if x == f64::NEG_INFINITY {
            return Err(impossible(match factor {
                Factor::Observe => "this observation",
                Factor::Factor => "this factor",
                Factor::Condition => "this condition",
            }));
        }
        self.density = self.density + log;
        Ok(Answer::Go(()))
    }

    fn emit(&mut self, _: &At<'_, Var>, _: &[Shape]) -> Result<Answer<()>, Fault> {
        self.emitted += 1;
        Ok(Answer::Go(()))
    }

    fn query(&mut self, _: &At<'_, Var>, _: &Value<Var>, _: &Value<Var>) -> Result<(), Fault> {
        Ok(())
    }

    fn host(&mut self, constant: u16, args: &[Value<Var>]) -> Result<Value<Var>, Fault> {
        let varying = std::cell::Cell::new(false);
        let note = |x: Var| {
            varying.set(varying.get() || x.varies());
            x.value()
        };
        let given: Vec<Value> = args.iter().map(|arg| arg.convert(&note)).collect();
        if varying.get() {
            return Err(Fault::no_derivative("a host function"));
        }
        Ok((self.run.host)(constant, &given)?.convert(&Var::from_f64))
    }
}

/// Records the run in which each choice has the value that `choices` gives its address.
///
/// # Errors
/// A fault with the model's call stack: a missing choice, an impossible run, an operation without a derivative on
/// the way to the score, or whatever the program meets.
pub fn record(run: &Run<'_>, choices: &HashMap<u128, Value>) -> Result<Recorded, Box<RunFault>> {
    let mut recorder = Recorder {
        run,
        choices,
        density: Var::from_f64(0.0),
        continuous: vec![],
        fixed: vec![],
        start: vec![],
        structure: 0,
        emitted: 0,
    };
    let (finished, sheet) = with_sheet(|| {
        let mut machine = Machine::new(run.program, run.limits);
        let bare = |fault| Box::new(RunFault { fault, stack: vec![], omitted: 0, path: String::new() });
        let mut state = machine.start(run.args, true).map_err(bare)?;
        state.remember_origins();
        machine.finish(&mut state, &mut recorder)
    });
    finished?;
    let mut graph = sheet.graph;
    let value = recorder.density.id(&mut graph);
    let choices: Vec<Continuous> = recorder
        .continuous
        .into_iter()
        .map(|(choice, vars)| Continuous {
            values: vars.into_iter().map(|var| var.id(&mut graph)).collect(),
            ..choice
        })
        .collect();
    let density = Density::new(graph, value, &sheet.guards);
    let outputs: Vec<Id> = choices.iter().flat_map(|choice| choice.values.iter().copied()).collect();
    let unpack = Tape::of(density.graph(), &outputs, &[]);
    Ok(Recorded {
        density: Arc::new(density),
        choices,
        fixed: recorder.fixed,
        start: recorder.start,
        structure: recorder.structure,
        emitted: recorder.emitted,
        unpack,
    })
}

impl Recorded {
    /// How many coordinates there are.
    pub fn dim(&self) -> usize {
        self.start.len()
    }

    /// The values of all choices at these coordinates, fixed ones included.
    ///
    /// # Panics
    /// When there is not one number for each coordinate.
    pub fn values(&self, x: &[f64]) -> HashMap<u128, Value> {
        let mut lanes: Lanes<1> = self.unpack.lanes();
        let numbers = lanes.outputs(&self.unpack, x);
        let mut all: HashMap<u128, Value> = self.fixed.iter().cloned().collect();
        let mut at = 0;
        for choice in &self.choices {
            let n = choice.values.len();
            let part = &numbers[at..at + n];
            at += n;
            let draw = match choice.transform {
                Transform::Simplex | Transform::Vector => Draw::Vector(part.into()),
                _ => Draw::Real(part[0]),
            };
            all.insert(choice.address, draw_to_value(draw));
        }
        all
    }
}

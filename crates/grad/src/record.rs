//! Recording: a run of a program, with its continuous choices as coordinates, becomes a [`Density`].
//!
//! Coordinates are unconstrained: see [`crate::coordinates`]. Discrete choices keep their values; their probabilities
//! belong to the density. Scores of a scene do not belong to it; the caller adds them. A [`Scope`] names the continuous
//! choices that also keep their values, and the power of the score.

use crate::coordinates::{Continuous, Edge, Placed};
use crate::density::Density;
use crate::graph::Id;
use crate::scalar::{Var, with_sheet};
use crate::tape::{Lanes, Tape};
use niwaki_geom::Shape;
use niwaki_math::{Dist, Draw, Scalar};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::address::join;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::held::Held;
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::machine::{Limits, Machine};
use niwaki_vm::value::Value;
use niwaki_vm::value::draw::not_drawn;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

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
    /// Hash of the addresses, supports and fixed values: runs with equal hashes differ in coordinates and guards only.
    pub structure: u128,
    /// The number of primitives that the run emitted. Their scores are not in the density.
    pub emitted: usize,
    /// The coordinates that move: all except those of held choices and of the power.
    pub moving: Vec<usize>,
    /// The tape from coordinates to values, and last the log Jacobian.
    unpack: Tape,
}

/// A call of a pure host function, by the number of the constant that names it. The last argument is the number of steps of the
/// run so far, to which the call adds its steps. For arguments that vary, the function has a derivative or refuses the call.
pub type HostCall<'a> = dyn Fn(u16, &[Value<Var>], &mut u64) -> Result<Value<Var>, Fault> + Send + Sync + 'a;

/// A run to be recorded.
pub struct Run<'a> {
    /// The program, over recording numbers: [`Program::over`].
    pub program: &'a Program<Var>,
    /// The arguments of its entry function.
    pub args: &'a [Value<Var>],
    /// Choices with fixed values, which are observed; not those of the scope, which have coordinates.
    pub held: Option<&'a Held<Var>>,
    /// The limits of the run.
    pub limits: Limits,
    /// Pure functions of the host, by the number of the constant that names them.
    pub host: &'a HostCall<'a>,
    /// The choices that vary.
    pub scope: &'a Scope,
}

/// The choices of a run that vary, and the power of its score.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    /// Continuous choices that keep their values, by address: they have coordinates, which do not move.
    pub held: Option<Arc<HashSet<u128>>>,
    /// The power of factors and observations, as the first coordinate, which does not move; without it, the power is 1.
    pub power: Option<f64>,
}

pub(crate) struct Recorder<'a> {
    run: &'a Run<'a>,
    choices: &'a HashMap<u128, Value>,
    density: Var,
    power: Option<Var>,
    slope: Var,
    continuous: Vec<(Continuous, Placed)>,
    fixed: Vec<(u128, Value)>,
    pub(crate) start: Vec<f64>,
    structure: u128,
    emitted: usize,
    /// A held choice that the run never makes.
    unmet: Option<String>,
    /// Whether each term must have a finite gradient.
    strict: bool,
}

impl<'a> Recorder<'a> {
    fn new(run: &'a Run<'a>, choices: &'a HashMap<u128, Value>, strict: bool) -> Self {
        Recorder {
            run,
            choices,
            density: Var::from_f64(0.0),
            power: None,
            slope: Var::from_f64(0.0),
            continuous: vec![],
            fixed: vec![],
            start: vec![],
            structure: 0,
            emitted: 0,
            unmet: None,
            strict,
        }
    }

    /// Runs the program, and records on the sheet of this thread.
    fn finish(&mut self) -> Result<(), Box<RunFault>> {
        let run = self.run;
        let mut machine = Machine::new(run.program, run.limits).holding(run.held);
        let bare = |fault| Box::new(RunFault { fault, stack: vec![], omitted: 0, path: String::new() });
        let mut state = machine.start(run.args, true).map_err(bare)?;
        state.remember_origins();
        self.power = run.scope.power.map(|power| self.coordinate(power));
        machine.finish(&mut state, self)?;
        if let Some(path) = self.unmet.take() {
            return Err(bare(impossible(&format!(
                "the held choice `{path}`, which this run does not make,"
            ))));
        }
        Ok(())
    }

    /// Adds a term to the log density.
    fn add(&mut self, log: Var) -> Result<(), Fault> {
        self.density = self.density + log;
        if Var::met_nan() {
            return Err(Fault::new("non-finite-score", "a comparison before this term has nan on one side")
                .with_help("keep the arguments of roots, logarithms and quotients where these are numbers"));
        }
        if self.strict
            && let Some(bad) = log.slopes(&self.start).into_iter().find(|slope| !slope.is_finite())
        {
            return Err(Fault::new("non-finite-gradient", format!("a gradient of {bad}")));
        }
        Ok(())
    }

    fn mix(&mut self, part: u128) {
        const ODD: u128 = 0x9E37_79B9_7F4A_7C15_F39C_C060_5CED_C835;
        self.structure = (self.structure.rotate_left(41) ^ part).wrapping_mul(ODD);
        self.structure ^= self.structure >> 61;
    }
}

#[cold]
pub(crate) fn no_coordinates(dist: &Dist<Var>) -> Fault {
    let name = dist.family().name();
    Fault::new("no-derivative", format!("a choice from this `{name}` has no continuous coordinates"))
        .with_help("a mixture must have components that are all of one kind")
}

#[cold]
fn impossible(cause: &str) -> Fault {
    Fault::new("impossible-trace", format!("{cause} makes this run impossible: it has no gradient to follow"))
        .with_help("start from a run that is possible, for example a result of particles or of rejection")
}

/// The value of a choice that is recorded, and as a draw.
///
/// # Errors
/// There is none, or no distribution draws it.
pub(crate) fn known<'c>(
    choices: &'c HashMap<u128, Value>,
    at: &At<'_, Var>,
) -> Result<(&'c Value, Draw), Fault> {
    let Some(value) = choices.get(&at.address()) else {
        let path = at.path();
        return Err(Fault::new("missing-choice", format!("there is no value for the choice `{path}`"))
            .about(path)
            .with_help("record with the model that the choices are from"));
    };
    Ok((value, value.draw().ok_or_else(|| not_drawn(value))?))
}

impl Answers<Var> for Recorder<'_> {
    fn choice(&mut self, at: &At<'_, Var>, dist: &Dist<Var>) -> Result<Answer<Value<Var>>, Fault> {
        let address = at.address();
        if let Dist::Delta(value) = dist {
            // The distribution may vary with other choices.
            self.mix(address);
            return Ok(Answer::Go(value.clone().into()));
        }
        let (stored, draw) = known(self.choices, at)?;
        self.mix(address);
        let (first, family) = (self.start.len(), dist.family());
        let is_held = self.run.scope.held.as_ref().is_some_and(|held| held.contains(&address));
        let Some(placed) = self.place(dist, &draw, is_held)? else {
            let value = draw.convert(&Var::from_f64);
            let log = dist.log_density(&value);
            if log.value() == f64::NEG_INFINITY {
                return Err(impossible("a choice of probability zero"));
            }
            self.add(log)?;
            let hash = match &draw {
                Draw::Bool(b) => u128::from(*b),
                Draw::Int(i) => *i as u128,
                Draw::Real(x) => u128::from(x.to_bits()),
                Draw::Vector(v) => v.iter().fold(0, |hash, x| join(hash, u128::from(x.to_bits()))),
                Draw::Counts(v) => v.iter().fold(0, |hash, k| join(hash, *k as u128)),
                Draw::Truths(v) => v.iter().fold(0, |hash, b| join(hash, u128::from(*b))),
            };
            self.mix(hash);
            self.fixed.push((address, stored.clone()));
            // The stored itself: for a list of counts, the draw would be a vector of real numbers.
            return Ok(Answer::Go(stored.convert(&Var::from_f64)));
        };
        if placed.log.value() == f64::NEG_INFINITY {
            return Err(impossible("a choice outside its support"));
        }
        let transform = placed.transform;
        self.mix(1 + transform as u128);
        self.add(placed.log)?;
        self.slope = self.slope + placed.slope;
        let coordinates = self.start.len() - first;
        let value = transform.value(&placed.values);
        let (path, unit, values, edges) = (at.path(), placed.unit, vec![], [Edge::Open; 2]);
        let choice =
            Continuous { address, path, family, transform, first, coordinates, unit, is_held, values, edges };
        self.continuous.push((choice, placed));
        Ok(Answer::Go(value))
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
                Factor::Held => "the value of this held choice",
            }));
        }
        self.add(self.power.map_or(log, |power| power * log))?;
        Ok(Answer::Go(()))
    }

    fn emit(&mut self, _: &At<'_, Var>, _: &[Shape]) -> Result<Answer<()>, Fault> {
        self.emitted += 1;
        Ok(Answer::Go(()))
    }

    fn unmet(&mut self, path: &str) {
        self.unmet = Some(path.to_string());
    }

    fn host(&mut self, constant: u16, args: &[Value<Var>], steps: &mut u64) -> Result<Value<Var>, Fault> {
        (self.run.host)(constant, args, steps)
    }
}

/// Records the run in which each choice has the value that `choices` gives its address.
///
/// # Errors
/// A fault with the model's call stack: a missing choice, an impossible run, an operation without a derivative that
/// the score depends on, or a fault of the program.
pub fn record(run: &Run<'_>, choices: &HashMap<u128, Value>) -> Result<Recorded, Box<RunFault>> {
    let mut recorder = Recorder::new(run, choices, false);
    let (finished, sheet) = with_sheet(|| recorder.finish());
    finished?;
    let mut graph = sheet.graph;
    let value = recorder.density.id(&mut graph);
    let choices: Vec<Continuous> = recorder
        .continuous
        .into_iter()
        .map(|(choice, placed)| Continuous {
            values: placed.values.into_iter().map(|var| var.id(&mut graph)).collect(),
            edges: placed.bounds.map(|bound| Edge::of(bound, &mut graph)),
            ..choice
        })
        .collect();
    let mut moves = vec![true; recorder.start.len()];
    if run.scope.power.is_some() {
        moves[0] = false;
    }
    for choice in choices.iter().filter(|choice| choice.is_held) {
        moves[choice.first..choice.first + choice.coordinates].fill(false);
    }
    let slope = recorder.slope.id(&mut graph);
    let density = Density::along(graph, value, &sheet.guards, &moves);
    let outputs: Vec<Id> =
        choices.iter().flat_map(|choice| choice.values.iter().copied()).chain([slope]).collect();
    let unpack = Tape::of(density.graph(), &outputs, &[]);
    Ok(Recorded {
        density: Arc::new(density),
        choices,
        fixed: recorder.fixed,
        moving: (0..moves.len()).filter(|k| moves[*k]).collect(),
        start: recorder.start,
        structure: recorder.structure,
        emitted: recorder.emitted,
        unpack,
    })
}

/// The first term of the log density whose gradient is not finite, as a fault of its line; or the fault of the run, if
/// it has one.
pub fn blame(run: &Run<'_>, choices: &HashMap<u128, Value>) -> Option<Box<RunFault>> {
    let mut recorder = Recorder::new(run, choices, true);
    with_sheet(|| recorder.finish()).0.err()
}

impl Recorded {
    /// The number of coordinates.
    pub fn dim(&self) -> usize {
        self.start.len()
    }

    /// The values of all choices at these coordinates, fixed ones included.
    ///
    /// # Panics
    /// If there is not one number for each coordinate.
    pub fn values(&self, x: &[f64]) -> HashMap<u128, Value> {
        self.values_of(&self.numbers(x))
    }

    /// The values of the continuous choices at these coordinates, in order: [`Continuous::width`] numbers for each.
    ///
    /// # Panics
    /// If there is not one number for each coordinate.
    pub fn numbers(&self, x: &[f64]) -> Vec<f64> {
        self.numbers_and_slope(x).0
    }

    /// The values of the continuous choices as [`Recorded::numbers`], and the log Jacobian of values by coordinates, nats.
    ///
    /// # Panics
    /// If there is not one number for each coordinate.
    pub fn numbers_and_slope(&self, x: &[f64]) -> (Vec<f64>, f64) {
        let mut lanes: Lanes<1> = self.unpack.lanes();
        let mut numbers = lanes.outputs(&self.unpack, x).to_vec();
        let slope = numbers.pop().unwrap_or(0.0);
        (numbers, slope)
    }

    /// The values of all choices by address, from the numbers of the continuous choices.
    ///
    /// # Panics
    /// If there are fewer numbers than [`Recorded::numbers`] returns.
    pub fn values_of(&self, numbers: &[f64]) -> HashMap<u128, Value> {
        let mut all: HashMap<u128, Value> = self.fixed.iter().cloned().collect();
        let mut at = 0;
        for choice in &self.choices {
            let n = choice.width();
            let part = &numbers[at..at + n];
            at += n;
            all.insert(choice.address, choice.transform.value(part));
        }
        all
    }
}

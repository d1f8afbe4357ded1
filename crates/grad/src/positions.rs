//! Positions of the shapes of a run, as functions of its continuous choices.
//!
//! The coordinates are the values of the choices themselves, within their supports. The point of a shape is its middle
//! plus a sum of the three directions with which the shape was made (`niwaki_vm::builtins::shapes`), so a point fixed to a
//! shape moves, turns and stretches with it. Its derivatives are three reverse sweeps over the recorded graph. Factors,
//! observations and scores of the scene are ignored: an impossible run has positions, too.
//!
//! Numbers of the program may move, too. A choice whose distribution they change then keeps its place in the distribution:
//! its distance from the mean in deviations, or its share of the way between two bounds.

use crate::graph::{Graph, Id};
use crate::operation::Op;
use crate::record::{HostCall, known};
use crate::reverse;
use crate::scalar::{Var, with_notes};
use crate::tape::{Lanes, Tape};
use niwaki_geom::Shape;
use niwaki_math::{Dist, Draw, Scalar, Support};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At};
use niwaki_vm::machine::held::Held;
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::machine::{Limits, Machine};
use niwaki_vm::value::Value;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// A number that may move: a real choice, or an input of the program.
#[derive(Clone, Debug)]
pub struct Movable {
    /// Hash of the choice's address; for an input, its number.
    pub address: u128,
    /// Readable address of the choice; empty for an input.
    pub path: String,
    /// Value of the number in the run.
    pub value: f64,
    /// Lower bound of the support; infinite if there is none.
    pub low: f64,
    /// Upper bound of the support; infinite if there is none.
    pub high: f64,
    /// Typical variation of the number: the deviation of a uniform number between two bounds, the scale of a family on the
    /// line, the distance from a single bound, a radian for an angle; in units of the value.
    pub spread: f64,
    /// Whether the number is an angle, without bounds.
    pub is_angle: bool,
}

/// A shape of a part: the nodes of its middle and three directions; none if they do not vary.
type Framed = Option<[Id; 12]>;

/// The positions of a run's shapes.
pub struct Positions {
    /// The numbers that the positions depend on, in the order of the run.
    pub movables: Vec<Movable>,
    /// The parts of the scene: their readable addresses, and their shapes; of a cut, its solids.
    pub parts: Vec<(String, Vec<Framed>)>,
    /// Choices that keep their place in a distribution while inputs change it: their addresses and values.
    followed: Vec<(u128, Id)>,
    graph: Graph,
}

/// Builds the program of a run and its arguments from the inputs.
pub type Build<'a> = dyn Fn(&[Var]) -> Result<(Arc<Program<Var>>, Vec<Value<Var>>), Fault> + 'a;

/// A run whose positions are recorded.
pub struct Placed<'a> {
    /// Builds the program and its arguments while the run is recorded.
    pub build: &'a Build<'a>,
    /// Numbers of the arguments or of the source, not choices, that may move.
    pub inputs: Vec<Movable>,
    /// Choices with fixed values, which are observed.
    pub held: Option<&'a Held<Var>>,
    /// The limits of the run.
    pub limits: Limits,
    /// Pure functions of the host.
    pub host: &'a HostCall<'a>,
    /// The values of all choices, by address.
    pub choices: &'a HashMap<u128, Value>,
    /// The addresses of the real choices that may move.
    pub free: &'a HashSet<u128>,
}

struct Placer<'a> {
    run: &'a Placed<'a>,
    movables: Vec<Movable>,
    parts: Vec<(String, Vec<Vec<Var>>)>,
    followed: Vec<(u128, Var)>,
}

/// Records the positions of a run.
///
/// # Errors
/// A missing choice, or a fault of the program.
pub fn positions(run: &Placed<'_>) -> Result<Positions, Box<RunFault>> {
    let mut placer = Placer { run, movables: run.inputs.clone(), parts: vec![], followed: vec![] };
    let (finished, sheet) = with_notes(|| {
        let inputs: Vec<Var> = run.inputs.iter().map(|input| Var::input(input.value)).collect();
        let bare = |fault| Box::new(RunFault { fault, stack: vec![], omitted: 0, path: String::new() });
        let (program, args) = (run.build)(&inputs).map_err(bare)?;
        let mut machine = Machine::new(&program, run.limits).holding(run.held);
        let mut state = machine.start(&args, true).map_err(bare)?;
        state.remember_origins();
        machine.finish(&mut state, &mut placer)?;
        Ok::<(), Box<RunFault>>(())
    });
    finished?;
    let mut graph = sheet.graph;
    let mut framed = |numbers: Vec<Var>| -> Framed {
        let numbers: [Var; 12] = numbers.try_into().ok()?;
        numbers.iter().any(|x| x.varies()).then(|| numbers.map(|x| x.id(&mut graph)))
    };
    let parts = placer.parts.into_iter();
    let parts = parts.map(|(path, shapes)| (path, shapes.into_iter().map(&mut framed).collect())).collect();
    let followed = placer.followed.into_iter().map(|(address, x)| (address, x.id(&mut graph))).collect();
    Ok(Positions { movables: placer.movables, parts, followed, graph })
}

impl Placer<'_> {
    /// A real choice that may move; `None` for any other choice.
    fn moving(&mut self, at: &At<'_, Var>, dist: &Dist<Var>, x: f64) -> Option<Var> {
        let (address, number) = (at.address(), |bound: Option<Var>, or: f64| bound.map_or(or, Scalar::value));
        let (low, high, is_angle) = match dist.support() {
            _ if !self.run.free.contains(&address) => return None,
            Support::Reals(bounds) => {
                (number(bounds.lo, f64::NEG_INFINITY), number(bounds.hi, f64::INFINITY), false)
            }
            Support::Circle => (f64::NEG_INFINITY, f64::INFINITY, true),
            _ => return None,
        };
        let spread = match (low.is_finite(), high.is_finite()) {
            (true, true) => (high - low) / 12.0_f64.sqrt(),
            (true, false) => x - low,
            (false, true) => high - x,
            (false, false) => dist.scale().map_or(1.0, Scalar::value),
        };
        let path = at.path();
        self.movables.push(Movable { address, path, value: x, low, high, spread, is_angle });
        Some(Var::input(x))
    }
}

/// The value whose place in the distribution is that of `x` in the recorded distribution; `None` for families without places.
fn keeping_its_place(dist: &Dist<Var>, x: f64) -> Option<Var> {
    let c = Var::from_f64;
    let scaled = |from: Var, by: Var| from + c((x - from.value()) / by.value()) * by;
    match dist {
        Dist::Gaussian { mean, sd } => Some(scaled(*mean, *sd)),
        Dist::Laplace { loc, scale } => Some(scaled(*loc, *scale)),
        Dist::Uniform { lo, hi } => Some(scaled(*lo, *hi - *lo)),
        _ => None,
    }
}

impl Answers<Var> for Placer<'_> {
    fn choice(&mut self, at: &At<'_, Var>, dist: &Dist<Var>) -> Result<Answer<Value<Var>>, Fault> {
        if let Dist::Delta(value) = dist {
            return Ok(Answer::Go(value.clone().into()));
        }
        let (_, draw) = known(self.run.choices, at)?;
        if let Draw::Real(x) = draw
            && let Some(moving) = self.moving(at, dist, x)
        {
            return Ok(Answer::Go(Value::Real(moving)));
        }
        if let Draw::Real(x) = draw
            && let Some(shifted) = keeping_its_place(dist, x).filter(|shifted| shifted.varies())
        {
            self.followed.push((at.address(), shifted));
            return Ok(Answer::Go(Value::Real(shifted.at(x))));
        }
        Ok(Answer::Go(draw.convert(&Var::from_f64).into()))
    }

    fn emit(&mut self, at: &At<'_, Var>, shapes: &[Shape]) -> Result<Answer<()>, Fault> {
        // The solids of a cut have places of their own: a hole is dragged without its wall.
        let solids = shapes.iter().flat_map(Shape::leaves);
        let noted = solids.map(|solid| Var::noted(solid.address())).collect();
        self.parts.push((at.path(), noted));
        Ok(Answer::Go(()))
    }

    /// Calls a host function; its result does not vary, since its derivative is unknown.
    fn host(&mut self, constant: u16, args: &[Value<Var>], steps: &mut u64) -> Result<Value<Var>, Fault> {
        let fixed = |x: Var| Var::from_f64(x.value());
        let plain_args: Vec<Value<Var>> = args.iter().map(|arg| arg.convert(&fixed)).collect();
        (self.run.host)(constant, &plain_args, steps)
    }
}

impl Positions {
    /// The middle of a shape and its three directions, scene units; `None` if they depend on no movable number.
    ///
    /// # Panics
    /// If there is no such part or shape.
    pub fn frame(&self, part: usize, shape: usize) -> Option<Vec<f64>> {
        self.parts[part].1[shape].map(|frame| self.numbers(&self.graph, &frame))
    }

    /// The derivatives of the point `middle + sum(share * direction)` by all movables, scene units for each unit of a
    /// value: the three rows in order. `None` as for [`Positions::frame`].
    ///
    /// # Panics
    /// See [`Positions::frame`].
    pub fn slopes(&self, part: usize, shape: usize, shares: [f64; 3]) -> Option<Vec<f64>> {
        let frame = self.parts[part].1[shape]?;
        let mut graph = self.graph.clone();
        let mut rows = Vec::with_capacity(3 * self.movables.len());
        for axis in 0..3 {
            let mut root = frame[axis];
            for (k, share) in shares.into_iter().enumerate() {
                let share = graph.constant(share);
                let term = graph.binary(Op::Mul, share, frame[3 + 3 * k + axis]);
                root = graph.add(root, term);
            }
            rows.extend(reverse::gradient(&mut graph, root));
        }
        Some(self.numbers(&graph, &rows))
    }

    /// The values of the choices that keep their places, by address, at the values `x` of the movables.
    ///
    /// # Panics
    /// If there is not one number for each movable.
    pub fn followed(&self, x: &[f64]) -> HashMap<u128, f64> {
        let nodes: Vec<Id> = self.followed.iter().map(|(_, id)| *id).collect();
        let addresses = self.followed.iter().map(|(address, _)| *address);
        addresses.zip(numbers(&self.graph, &nodes, x)).collect()
    }

    /// Values of nodes at the numbers of the run.
    fn numbers(&self, graph: &Graph, nodes: &[Id]) -> Vec<f64> {
        let x: Vec<f64> = self.movables.iter().map(|movable| movable.value).collect();
        numbers(graph, nodes, &x)
    }
}

fn numbers(graph: &Graph, nodes: &[Id], x: &[f64]) -> Vec<f64> {
    let tape = Tape::of(graph, nodes, &[]);
    let mut lanes: Lanes<1> = tape.lanes();
    lanes.outputs(&tape, x)
}

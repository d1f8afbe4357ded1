//! A density that follows its program: outside the guards of a path the run is recorded again.
//!
//! A path is the branches of a recording. As long as the choices are equal (their addresses, supports and fixed
//! values), another path is the same density at other points, and paths are stored. If the choices change, the point
//! is refused: a gradient cannot move to other choices.

pub mod compiled;

use crate::record::{HostCall, Recorded, Run, Scope, blame, record};
use crate::scalar::Var;
use compiled::{Compiled, WARM};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Limits;
use niwaki_vm::machine::held::Held;
use niwaki_vm::machine::invalid::Invalid;
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::value::Value;
use std::collections::HashMap;
use std::sync::Arc;

/// Pure functions of the host.
pub type Host = Arc<HostCall<'static>>;

/// The subject of a recording: a program with its arguments.
#[derive(Clone)]
pub struct Model {
    /// The program, over recording numbers.
    pub program: Arc<Program<Var>>,
    /// The arguments of its entry function.
    pub args: Vec<Value<Var>>,
    /// Choices with fixed values, which are observed.
    pub held: Option<Arc<Held<Var>>>,
    /// The limits of a run.
    pub limits: Limits,
    /// The host functions.
    pub host: Host,
    /// The choices that vary.
    pub scope: Scope,
    /// The number of points that are refused because the run is invalid there.
    pub invalid: Arc<Invalid>,
}

impl Model {
    /// Records the run with these choices.
    ///
    /// # Errors
    /// See [`record`].
    pub fn record(&self, choices: &HashMap<u128, Value>) -> Result<Recorded, Box<RunFault>> {
        record(&self.run(), choices)
    }

    /// The first term of the log density whose gradient is not finite in the run with these choices, as a fault of its
    /// line; or the fault of the run, if it has one.
    pub fn blame(&self, choices: &HashMap<u128, Value>) -> Option<Box<RunFault>> {
        blame(&self.run(), choices)
    }

    fn run(&self) -> Run<'_> {
        Run {
            program: &self.program,
            args: &self.args,
            held: self.held.as_deref(),
            limits: self.limits,
            host: &*self.host,
            scope: &self.scope,
        }
    }
}

/// The reason why a point is refused.
#[derive(Debug)]
pub enum Refused {
    /// The run has other choices there.
    Structure,
    /// The run fails there, or is impossible.
    Fault(Box<RunFault>),
    /// A comparison holds in the run but not in its recording, by rounding.
    Rounding,
}

/// Most recordings before a point is refused.
const DETOURS: usize = 4;

/// Most stored paths; the oldest is removed first.
const PATHS: usize = 64;

struct Path {
    recorded: Arc<Recorded>,
    compiled: Compiled,
}

impl Path {
    fn of(recorded: Recorded, warm: u32) -> Path {
        Path { compiled: Compiled::after(recorded.density.clone(), warm), recorded: Arc::new(recorded) }
    }
}

/// A density that follows its program.
pub struct Live {
    model: Model,
    paths: Vec<Path>,
    now: usize,
    recordings: usize,
    /// Gradients of a path before machine code is compiled.
    warm: u32,
}

impl Live {
    /// The density around a recorded run.
    pub fn new(model: Model, recorded: Recorded) -> Live {
        Live::after(model, recorded, WARM)
    }

    /// As [`Live::new`], with machine code of a path after `warm` gradients: for runs that soon leave many paths.
    pub fn after(model: Model, recorded: Recorded, warm: u32) -> Live {
        let mut live = Live { model, paths: vec![], now: 0, recordings: 1, warm };
        live.keep(Path::of(recorded, warm));
        live
    }

    /// The density around another run of this model, with its coordinates, without a recording. `None` unless that
    /// run is on the current path.
    pub fn beside(&self, choices: &HashMap<u128, Value>) -> Option<(Live, Vec<f64>)> {
        let here = &self.paths[self.now];
        if !here.recorded.fixed.iter().all(|(address, value)| choices.get(address) == Some(value)) {
            return None;
        }
        let x = here.recorded.coordinates(|choice| choices.get(&choice.address))?;
        let mut path = Path { recorded: here.recorded.clone(), compiled: here.compiled.beside() };
        // Inside the guards the run takes this path and has these choices.
        path.compiled.inside(&x, &mut vec![0.0; x.len()])?;
        let (model, paths) = (self.model.clone(), vec![path]);
        Some((Live { model, paths, now: 0, recordings: 0, warm: self.warm }, x))
    }

    fn keep(&mut self, path: Path) {
        if self.paths.len() == PATHS {
            self.paths.remove(0);
        }
        self.paths.push(path);
        self.now = self.paths.len() - 1;
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The number of coordinates.
    pub fn dim(&self) -> usize {
        self.recorded().dim()
    }

    /// The recording of the last point's path.
    pub fn recorded(&self) -> &Arc<Recorded> {
        &self.paths[self.now].recorded
    }

    /// The number of operations of all paths together.
    pub fn size(&self) -> usize {
        self.paths.iter().map(|path| path.recorded.density.graph().len()).sum()
    }

    /// The number of recordings of the program.
    pub fn recordings(&self) -> usize {
        self.recordings
    }

    /// The evaluator of the last point's path.
    pub fn compiled(&mut self) -> &mut Compiled {
        &mut self.paths[self.now].compiled
    }

    /// The log density at `x`, with its gradient in `g`.
    ///
    /// # Errors
    /// A point at which the run has other choices, fails or is impossible; `g` is then invalid.
    ///
    /// # Panics
    /// If `x` or `g` does not have one number for each coordinate.
    #[inline]
    pub fn value_and_gradient(&mut self, x: &[f64], g: &mut [f64]) -> Result<f64, Refused> {
        match self.paths[self.now].compiled.inside(x, g) {
            Some(value) => Ok(value),
            None => self.elsewhere(x, g),
        }
    }

    /// The gradient at `x`, equal to that of [`Live::value_and_gradient`] to the bit.
    ///
    /// # Errors
    /// See [`Live::value_and_gradient`].
    ///
    /// # Panics
    /// See [`Live::value_and_gradient`].
    #[inline]
    pub fn gradient(&mut self, x: &[f64], g: &mut [f64]) -> Result<(), Refused> {
        if self.paths[self.now].compiled.gradient(x, g) { Ok(()) } else { self.elsewhere(x, g).map(|_| ()) }
    }

    #[cold]
    fn elsewhere(&mut self, x: &[f64], g: &mut [f64]) -> Result<f64, Refused> {
        for at in 0..self.paths.len() {
            if at != self.now
                && let Some(value) = self.paths[at].compiled.inside(x, g)
            {
                self.now = at;
                return Ok(value);
            }
        }
        if let Some(bad) = x.iter().position(|x| !x.is_finite()) {
            let fault = Fault::new("non-finite-score", format!("coordinate {bad} is {}", x[bad]));
            let bare = RunFault { fault, stack: vec![], omitted: 0, path: String::new() };
            return Err(Refused::Fault(Box::new(bare)));
        }
        // Values follow from coordinates by the path, since a bound may depend on a branch. So a recording at the values of
        // one path may be another path, whose values count from then on.
        let mut at = self.recorded().clone();
        for _ in 0..DETOURS {
            self.recordings += 1;
            let recorded = match self.model.record(&at.values(x)) {
                Ok(recorded) => recorded,
                Err(fault) if fault.fault.code == "missing-choice" => return Err(Refused::Structure),
                Err(fault) => {
                    self.model.invalid.count(&fault);
                    return Err(Refused::Fault(fault));
                }
            };
            if recorded.structure != at.structure {
                return Err(Refused::Structure);
            }
            let mut path = Path::of(recorded, self.warm);
            if let Some(value) = path.compiled.inside(x, g) {
                self.keep(path);
                return Ok(value);
            }
            at = path.recorded;
        }
        Err(Refused::Rounding)
    }

    /// Switches to the path of a run with these choices, and returns its coordinates. `coordinates` computes them by a
    /// path, if possible. `None` if the run has other choices, fails, or is on no path.
    pub fn locate(
        &mut self,
        coordinates: &mut dyn FnMut(&Recorded) -> Option<Vec<f64>>,
        choices: &mut dyn FnMut() -> HashMap<u128, Value>,
    ) -> Option<Vec<f64>> {
        let mut slopes = vec![0.0; self.dim()];
        let rest = (0..self.paths.len()).filter(|at| *at != self.now);
        for at in std::iter::once(self.now).chain(rest).collect::<Vec<_>>() {
            if let Some(x) = coordinates(&self.paths[at].recorded)
                && self.paths[at].compiled.inside(&x, &mut slopes).is_some()
            {
                self.now = at;
                return Some(x);
            }
        }
        self.recordings += 1;
        let recorded = self.model.record(&choices()).ok()?;
        if recorded.structure != self.recorded().structure {
            return None;
        }
        let x = coordinates(&recorded)?;
        self.keep(Path::of(recorded, self.warm));
        Some(x)
    }

    /// The values of all choices at `x`, fixed ones included.
    ///
    /// # Errors
    /// See [`Live::value_and_gradient`].
    ///
    /// # Panics
    /// If there is not one number for each coordinate.
    pub fn values(&mut self, x: &[f64]) -> Result<HashMap<u128, Value>, Refused> {
        self.value_and_gradient(x, &mut vec![0.0; x.len()])?;
        Ok(self.recorded().values(x))
    }
}

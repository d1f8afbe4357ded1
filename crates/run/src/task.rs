//! The task of a search: a program with its arguments, and the sketches that score its scene.

use crate::inside::Inside;
use niwaki_geom::sketch::SketchSpec;
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::Answers;
use niwaki_vm::machine::held::Held;
use niwaki_vm::machine::invalid::Invalid;
use niwaki_vm::machine::kept::{Change, Trace};
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::machine::state::State;
use niwaki_vm::machine::{Limits, Machine, SharedSteps};
use niwaki_vm::value::{Closure, Value};
use std::any::Any;
use std::sync::Arc;

/// Pure functions of the host, by the number of their constant.
pub trait Hosts: Send + Sync {
    /// Calls a function. `steps` are those of the run that calls it so far; the function adds its own where it runs models.
    ///
    /// # Errors
    /// The exception of the function, as a fault.
    fn call(&self, constant: u16, args: &[Value], steps: &mut u64) -> Result<Value, Fault>;

    /// Take an exception that is no fault of the model and ends the search, for example an exit of the interpreter. It is
    /// returned once.
    fn raised(&self) -> Option<Box<dyn Any + Send>> {
        None
    }

    /// The kind of inference of a call of this constant; `None` where the call is no inference.
    fn inference(&self, _: u16) -> Option<Inside> {
        None
    }
}

/// No host functions.
pub struct NoHosts;

impl Hosts for NoHosts {
    fn call(&self, _: u16, _: &[Value], _: &mut u64) -> Result<Value, Fault> {
        Err(Fault::new("host-function", "this program has no host functions"))
    }
}

/// The task of a search.
#[derive(Clone)]
pub struct Task {
    /// The compiled model.
    pub program: Arc<Program>,
    /// The model of an `infer`; `None` to run the entry function of the program.
    pub model: Option<Arc<Closure>>,
    /// The arguments of that function.
    pub args: Vec<Value>,
    /// The sketches that score its scene; log scores add.
    pub sketches: Vec<Arc<dyn SketchSpec>>,
    /// Held choices, which count as observations.
    pub held: Option<Arc<Held>>,
    /// The host functions.
    pub hosts: Arc<dyn Hosts>,
    /// The limits of one run.
    pub limits: Limits,
    /// The step budget of all runs together, for a search inside a model.
    pub together: Option<Arc<SharedSteps>>,
    /// The counter of invalid runs; clones of the task share it.
    pub invalid: Arc<Invalid>,
}

impl Task {
    /// Create a task without arguments, sketches and host functions.
    pub fn new(program: Arc<Program>) -> Self {
        Task {
            program,
            model: None,
            args: vec![],
            sketches: vec![],
            held: None,
            hosts: Arc::new(NoHosts),
            limits: Limits::default(),
            together: None,
            invalid: Arc::default(),
        }
    }

    /// Copy the task with a new counter of invalid runs.
    pub fn uncounted(&self) -> Task {
        Task { invalid: Arc::default(), ..self.clone() }
    }

    /// Copy the task for each of `count` concurrent searches, which share its memory budget.
    pub fn shared_by(&self, count: usize) -> Task {
        let bytes = self.limits.bytes / count.max(1);
        Task { limits: Limits { bytes, ..self.limits }, ..self.clone() }
    }

    /// Create a machine for the program.
    pub fn machine(&self) -> Machine<'_> {
        Machine::new(&self.program, self.limits)
            .holding(self.held.as_deref())
            .within(self.together.as_deref())
    }

    /// Create the state of a run before its start.
    ///
    /// # Errors
    /// The wrong number of arguments.
    pub fn start(&self, machine: &Machine<'_>, depth_first: bool) -> Result<State, Fault> {
        match &self.model {
            None => machine.start(&self.args, depth_first),
            Some(model) => machine.start_closure(model, &self.args, depth_first),
        }
    }

    /// Run the program from the start, keeping its activations.
    ///
    /// # Errors
    /// The wrong number of arguments, or a fault of the program.
    pub fn begin<A: Answers<f64>>(
        &self,
        machine: &mut Machine<'_>,
        answers: &mut A,
    ) -> Result<(Trace, Change), Box<RunFault>> {
        match &self.model {
            None => machine.begin(&self.args, answers),
            Some(model) => machine.begin_closure(model, &self.args, answers),
        }
    }
}

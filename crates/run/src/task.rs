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

    /// What a function raised that is no fault of the model, and ends the search whatever became of the run: an exit, say. It is
    /// given once.
    fn raised(&self) -> Option<Box<dyn Any + Send>> {
        None
    }

    /// What the inference does that a call of this constant is, where it is one.
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
    /// The function to run, where it is not the program's entry: the model of an `infer`.
    pub model: Option<Arc<Closure>>,
    /// The arguments of that function.
    pub args: Vec<Value>,
    /// The sketches that score its scene; log scores add.
    pub sketches: Vec<Arc<dyn SketchSpec>>,
    /// Choices whose values are given, and observed.
    pub held: Option<Arc<Held>>,
    /// Its host functions.
    pub hosts: Arc<dyn Hosts>,
    /// The limits of one run.
    pub limits: Limits,
    /// The steps that all of its runs may take together: of a search inside of a model.
    pub together: Option<Arc<SharedSteps>>,
    /// Counts the runs of its searches that are invalid; clones count together.
    pub invalid: Arc<Invalid>,
}

impl Task {
    /// A task without arguments, sketches and host functions.
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

    /// The same task, with no run counted yet.
    pub fn uncounted(&self) -> Task {
        Task { invalid: Arc::default(), ..self.clone() }
    }

    /// The same task for each of so many searches at once, which share its memory.
    pub fn shared_by(&self, count: usize) -> Task {
        let bytes = self.limits.bytes / count.max(1);
        Task { limits: Limits { bytes, ..self.limits }, ..self.clone() }
    }

    /// A machine for its program.
    pub fn machine(&self) -> Machine<'_> {
        Machine::new(&self.program, self.limits)
            .holding(self.held.as_deref())
            .within(self.together.as_deref())
    }

    /// A run that has not begun.
    ///
    /// # Errors
    /// The wrong number of arguments.
    pub fn start(&self, machine: &Machine<'_>, depth_first: bool) -> Result<State, Fault> {
        match &self.model {
            None => machine.start(&self.args, depth_first),
            Some(model) => machine.start_closure(model, &self.args, depth_first),
        }
    }

    /// A run from the start that keeps its activations.
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

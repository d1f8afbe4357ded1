//! The host functions of a recorded run, and the inferences inside of it.
//!
//! A call whose arguments do not vary is that of a plain run. Of arguments that vary, an inference by enumeration has a
//! derivative (`nested`); a function of Python has none, and an inference that draws numbers has none either.

use super::nested::enumerated;
use niwaki_grad::Var;
use niwaki_math::Scalar;
use niwaki_run::inside::Inside;
use niwaki_run::task::Hosts;
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Limits;
use niwaki_vm::value::Value;
use std::sync::Arc;

/// The functions that a recorded run calls.
#[derive(Clone)]
pub(super) struct Hosted {
    /// The program, whose functions are the inner models.
    pub program: Arc<Program<Var>>,
    /// The functions over plain numbers.
    pub hosts: Arc<dyn Hosts>,
    /// How much a run may use.
    pub limits: Limits,
    /// How many `infer` the run is inside of.
    pub depth: usize,
}

impl Hosted {
    /// The functions of a run that is inside of no `infer`.
    pub fn new(program: Arc<Program<Var>>, hosts: Arc<dyn Hosts>, limits: Limits) -> Hosted {
        Hosted { program, hosts, limits, depth: 0 }
    }

    /// Calls a function by the number of its constant.
    ///
    /// # Errors
    /// The fault of the function, or arguments that vary where the derivative is not known.
    pub fn call(&self, constant: u16, args: &[Value<Var>], steps: &mut u64) -> Result<Value<Var>, Fault> {
        if !args.iter().any(Value::varies) {
            let numbers: Vec<Value> = args.iter().map(|arg| arg.convert(&Var::value)).collect();
            return Ok(self.hosts.call(constant, &numbers, steps)?.convert(&Var::from_f64));
        }
        match self.hosts.inference(constant) {
            None => Err(Fault::no_derivative("a host function")),
            Some(Inside::Enumeration { max_runs }) => enumerated(self, args, max_runs, steps),
            Some(Inside::Random) => Err(Fault::no_derivative("an `infer` whose method draws random numbers")
                .with_help("search inside by `enumerate_all()`, whose result has a derivative; or search the whole model by `mh()` or particles, which need none")),
        }
    }
}

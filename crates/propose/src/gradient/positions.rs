//! Where the shapes of a task's runs are, with their derivatives.

use super::recordable;
use niwaki_grad::{Model, Movable, Placed, Positions, Var, positions};
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::value::Value;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Compiles a program with numbers in its table of constants.
pub type Compile<'a> = dyn Fn(&[(usize, Var)]) -> Result<Program<Var>, Fault> + Sync + 'a;

/// Numbers of a program that may move beside choices.
#[derive(Default)]
pub struct Lifted<'a> {
    /// Arguments, by their place.
    pub arguments: Vec<(usize, f64)>,
    /// Numbers of the table of constants, by their place.
    pub constants: Vec<(usize, f64)>,
    /// Compiles the program with these constants in their places; without it the task's own program runs.
    pub compile: Option<&'a Compile<'a>>,
}

/// A task whose shapes are placed. Create it once for many runs: it copies the program.
pub struct Placer {
    model: Model,
}

impl Placer {
    /// A placer of the shapes of a task; the task's sketches do not matter.
    ///
    /// # Errors
    /// The model of an `infer` within another.
    pub fn new(task: &Task) -> Result<Placer, Failure> {
        Ok(Placer { model: recordable(task)? })
    }

    /// The positions of the run with these choices, of which the real ones among `free` may move.
    ///
    /// # Errors
    /// A missing choice, or a fault of the program.
    pub fn positions(
        &self,
        choices: &HashMap<u128, Value>,
        free: &HashSet<u128>,
        lifted: &Lifted<'_>,
    ) -> Result<Positions, Failure> {
        let input = |(place, value): &(usize, f64)| Movable {
            address: *place as u128,
            path: String::new(),
            value: *value,
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
            spread: value.abs().max(f64::MIN_POSITIVE),
            is_angle: false,
        };
        let build = |inputs: &[Var]| {
            let (arguments, constants) = inputs.split_at(lifted.arguments.len());
            let mut args = self.model.args.clone();
            for ((place, _), x) in lifted.arguments.iter().zip(arguments) {
                if *place >= args.len() {
                    return Err(Fault::new("bad-setting", format!("there is no argument {place}")));
                }
                args[*place] = Value::Real(*x);
            }
            let places: Vec<(usize, Var)> =
                lifted.constants.iter().map(|(place, _)| *place).zip(constants.iter().copied()).collect();
            let program = match lifted.compile {
                Some(compile) => Arc::new(compile(&places)?),
                None => self.model.program.clone(),
            };
            Ok((program, args))
        };
        let run = Placed {
            build: &build,
            inputs: lifted.arguments.iter().chain(&lifted.constants).map(input).collect(),
            held: self.model.held.as_deref(),
            limits: self.model.limits,
            host: &*self.model.host,
            choices,
            free,
        };
        Ok(positions(&run)?)
    }
}

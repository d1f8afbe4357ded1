//! Tasks with held choices: see [`niwaki_vm::machine::held`].

use crate::Task;
use crate::select::{labels, no_choice};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::held::Held;
use niwaki_vm::value::Value;
use std::sync::Arc;

/// Replace the held choices of a task. `choices` are readable addresses with values.
///
/// # Errors
/// An address that no run of the program can have; the message names the nearest addresses.
pub fn hold(task: &Task, choices: Vec<(String, Value)>) -> Result<Task, Fault> {
    let held = Held::new(&task.program, choices);
    let held = held.map_err(|path| no_choice(&path, &labels(&task.program)))?;
    Ok(Task { held: (!held.is_empty()).then(|| Arc::new(held)), ..task.clone() })
}

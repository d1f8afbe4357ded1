//! The machine's own programs, as tasks.

#[path = "../../../vm/tests/kept/programs.rs"]
mod of_the_machine;

pub use of_the_machine::PROGRAMS;

use niwaki_infer::Task;
use of_the_machine::compiled;
use std::sync::Arc;

pub fn task(text: &str) -> Task {
    Task::new(Arc::new(compiled(text)))
}

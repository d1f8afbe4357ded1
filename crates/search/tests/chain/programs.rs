//! The machine's own programs, as tasks.

#[path = "../../../vm/tests/kept/programs.rs"]
mod of_the_machine;

pub use of_the_machine::PROGRAMS;

use niwaki_chain::kernel::Kernel;
use niwaki_run::Task;
use of_the_machine::compiled;
use serde_json::Value;
use std::sync::Arc;

pub fn task(text: &str) -> Task {
    Task::new(Arc::new(compiled(text)))
}

/// A kernel that proposes, by its name and settings.
pub fn leaf(name: &str, settings: Value) -> Kernel {
    Kernel::leaf(name, settings).expect("a kernel")
}

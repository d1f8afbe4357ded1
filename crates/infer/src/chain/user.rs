//! A proposal of the user's own: a model function that makes a distribution of a choice's value.
//!
//! ```text
//! x' ~ f(x)        forward = log f(x)(x')        backward = log f(x')(x)
//! ```

use super::single::Move;
use super::state::Fresh;
use crate::Task;
use niwaki_math::{Dist, Stream, StreamKey, grid};
use niwaki_vm::builtins::{draw_to_value, value_to_draw};
use niwaki_vm::code::Mode;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::kept::Proposed;
use niwaki_vm::value::Value;
use std::sync::Arc;

/// A function of one value that gives a distribution, and its name.
pub struct User {
    task: Task,
    name: String,
}

impl std::fmt::Debug for User {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "User({})", self.name)
    }
}

impl User {
    /// The entry function of a task's program.
    ///
    /// # Errors
    /// It makes choices itself.
    pub fn new(task: Task) -> Result<User, Fault> {
        let entry = task.program.function(task.program.entry);
        let name = entry.name.to_string();
        if entry.mode != Mode::Pure {
            return Err(Fault::new(
                "bad-proposal",
                format!("the proposal `{name}` makes choices or scores itself"),
            )
            .with_help("give back the distribution instead of drawing from it"));
        }
        Ok(User { task, name })
    }

    fn dist(&self, value: &Value) -> Result<Arc<Dist>, Fault> {
        let wrong = |found: String| {
            Fault::new("bad-proposal", format!("the proposal `{}` {found}", self.name))
                .with_help("a proposal takes the old value and gives a distribution over new ones")
        };
        let mut machine = self.task.machine();
        let mut state = machine.start(std::slice::from_ref(value), true)?;
        let mut answers =
            Fresh { key: StreamKey::new(0, 0, 0), known: None, hosts: &*self.task.hosts, spreads: None };
        machine
            .finish(&mut state, &mut answers)
            .map_err(|run| wrong(format!("failed: {}", run.fault.message)))?;
        match state.result() {
            Value::Dist(dist) => Ok(Arc::new((*dist).clone())),
            other => Err(wrong(format!("gave {}, not a distribution", other.described()))),
        }
    }
}

/// The move that asks it.
pub(crate) struct Asking<'a>(pub &'a User);

impl Move for Asking<'_> {
    fn propose(
        &mut self,
        _: usize,
        dist: &Dist,
        old: &Value,
        _: f64,
        rng: &mut Stream,
    ) -> Result<Proposed<f64>, Fault> {
        let there = self.0.dist(old)?;
        let draw = there.sample(rng);
        let value = draw_to_value(draw.clone());
        if value.kind() != old.kind() {
            let (name, family) = (&self.0.name, dist.family());
            let found = format!(
                "the proposal `{name}` drew {}, where a choice of `{family}` holds {}",
                value.described(),
                old.described()
            );
            return Err(Fault::new("proposal-kind", found)
                .with_help("propose values of the kind that the choice's own distribution draws"));
        }
        let back = self.0.dist(&value)?;
        let backward = value_to_draw(old).map_or(f64::NEG_INFINITY, |old| back.log_density(&old));
        Ok(Proposed { value, forward: grid(there.log_density(&draw)), backward: grid(backward) })
    }
}

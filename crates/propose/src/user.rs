//! User proposals: model functions that return a distribution for a new value.
//!
//! The parameter `old` receives the previous value; any other parameter receives the variable of its name in scope at the choice.
//! With `s` for these variables, which a change of the choice itself does not affect,
//!
//! ```text
//! x' ~ f(x, s)        forward = log f(x, s)(x')        backward = log f(x', s)(x)
//! ```

use niwaki_math::{Dist, StreamKey};
use niwaki_run::Task;
use niwaki_run::fresh::Fresh;
use niwaki_vm::code::Mode;
use niwaki_vm::core::Name;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::value::Value;
use std::sync::{Arc, OnceLock};

/// The parameter that receives the previous value.
const OLD: &str = "old";

/// A user proposal: a function that returns a distribution.
pub struct User {
    task: Task,
    name: String,
    /// The distribution of a function without parameters.
    constant: OnceLock<Arc<Dist>>,
}

impl std::fmt::Debug for User {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "User({})", self.name)
    }
}

impl User {
    /// Create a proposal from the entry function of a task's program.
    ///
    /// # Errors
    /// The function makes choices itself.
    pub fn new(task: Task) -> Result<User, Fault> {
        let entry = task.program.function(task.program.entry);
        let name = entry.name.to_string();
        if entry.mode != Mode::Pure {
            return Err(Fault::new(
                "bad-proposal",
                format!("the proposal `{name}` makes choices or scores itself"),
            )
            .with_help("return the distribution instead of drawing from it"));
        }
        Ok(User { task, name, constant: OnceLock::new() })
    }

    /// The name of the function.
    pub fn name(&self) -> &str {
        &self.name
    }

    fn parameters(&self) -> &[Name] {
        &self.task.program.function(self.task.program.entry).parameters
    }

    /// Whether the function needs the previous value.
    pub fn needs_old(&self) -> bool {
        self.parameters().iter().any(|name| &**name == OLD)
    }

    /// The variables that the function needs. A program must be compiled to keep them
    /// ([`compile_with_scope`](niwaki_vm::passes::compile_with_scope)).
    pub fn variables(&self) -> impl Iterator<Item = &Name> {
        self.parameters().iter().filter(|name| &***name != OLD)
    }

    /// The distribution for a choice. `old` is the previous value, if there is a previous value.
    ///
    /// # Errors
    /// A variable that is not in scope, or that is neither a number nor a truth value; a function that fails, or that does not
    /// return a distribution.
    pub fn dist(&self, at: &At<'_, f64>, old: Option<&Value>) -> Result<Arc<Dist>, Fault> {
        if self.parameters().is_empty() {
            if let Some(known) = self.constant.get() {
                return Ok(known.clone());
            }
            let dist = Arc::new(self.evaluate(&[])?);
            return Ok(self.constant.get_or_init(|| dist).clone());
        }
        let value = |name: &Name| match (&**name, old) {
            (OLD, Some(old)) => Ok(old.clone()),
            _ => self.variable(name, at),
        };
        let args = self.parameters().iter().map(value).collect::<Result<Vec<_>, _>>()?;
        Ok(Arc::new(self.evaluate(&args)?))
    }

    /// A variable in scope at a choice.
    fn variable(&self, name: &Name, at: &At<'_, f64>) -> Result<Value, Fault> {
        let wrong = |problem: String| {
            Fault::new(
                "proposal-scope",
                format!("the proposal `{}` asks for `{name}` at the choice `{}`, {problem}", self.name, at.path()),
            )
            .with_help(
                "name variables of the choice's function that are assigned before the choice on every path and \
                 hold a number or a truth value; `old` is the value before",
            )
        };
        match at.scope(name) {
            Some(value @ (Value::Real(_) | Value::Int(_) | Value::Bool(_))) => Ok(value),
            Some(other) => Err(wrong(format!("where it is {}", other.described()))),
            None => Err(wrong("where it is not in scope".into())),
        }
    }

    /// The distribution for these arguments.
    fn evaluate(&self, args: &[Value]) -> Result<Dist, Fault> {
        let wrong = |problem: String| {
            Fault::new("bad-proposal", format!("the proposal `{}` {problem}", self.name)).with_help(
                "a proposal takes `old` or variables in scope, and gives a distribution over new values",
            )
        };
        let mut machine = self.task.machine();
        let mut state = machine.start(args, true)?;
        let mut answers = Fresh::plain(StreamKey::new(0, 0, 0), &*self.task.hosts);
        machine
            .finish(&mut state, &mut answers)
            .map_err(|run| wrong(format!("failed: {}", run.fault.message)))?;
        match state.result() {
            Value::Dist(dist) => Ok((*dist).clone()),
            other => Err(wrong(format!("gave {}, not a distribution", other.described()))),
        }
    }
}

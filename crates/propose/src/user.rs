//! A user's proposal: a model function that returns a distribution for a new value.
//!
//! Its parameters are names: `old` is the value before, any other name is a variable in scope at the choice. With
//! `s` for those variables, which a change of the choice itself does not touch,
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

/// The parameter that receives the value before.
const OLD: &str = "old";

/// A function that returns a distribution, and its name.
pub struct User {
    task: Task,
    name: String,
    /// Its distribution, where it has no parameters.
    constant: OnceLock<Arc<Dist>>,
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
            .with_help("return the distribution instead of drawing from it"));
        }
        Ok(User { task, name, constant: OnceLock::new() })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    fn parameters(&self) -> &[Name] {
        &self.task.program.function(self.task.program.entry).parameters
    }

    /// Whether it needs the value before.
    pub fn needs_old(&self) -> bool {
        self.parameters().iter().any(|name| &**name == OLD)
    }

    /// The variables that it needs. A program must be compiled to keep them
    /// ([`compile_with_scope`](niwaki_vm::passes::compile_with_scope)).
    pub fn variables(&self) -> impl Iterator<Item = &Name> {
        self.parameters().iter().filter(|name| &***name != OLD)
    }

    /// The distribution for a choice, given its value before where there is one.
    ///
    /// # Errors
    /// A variable that is not in scope there, or is no number and no truth value; a function that fails or gives
    /// something else.
    pub fn dist(&self, at: &At<'_, f64>, old: Option<&Value>) -> Result<Arc<Dist>, Fault> {
        if self.parameters().is_empty() {
            if let Some(known) = self.constant.get() {
                return Ok(known.clone());
            }
            let dist = Arc::new(self.given(&[])?);
            return Ok(self.constant.get_or_init(|| dist).clone());
        }
        let value = |name: &Name| match (&**name, old) {
            (OLD, Some(old)) => Ok(old.clone()),
            _ => self.variable(name, at),
        };
        let args = self.parameters().iter().map(value).collect::<Result<Vec<_>, _>>()?;
        Ok(Arc::new(self.given(&args)?))
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
    fn given(&self, args: &[Value]) -> Result<Dist, Fault> {
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

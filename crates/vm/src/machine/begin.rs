//! The state of a run that has not begun: the call of the program's entry function, or of any closure of the program.

use super::held::Held;
use super::numbers::Numbers;
use super::state::{NodeId, State, Status};
use super::{Machine, address};
use crate::code::{FunctionId, Mode, Place};
use crate::fault::Fault;
use crate::value::{Closure, Value};
use niwaki_math::Scalar;
use std::sync::Arc;

impl<S: Scalar> Machine<'_, S> {
    /// The state of a run of a closure of the program; otherwise as [`Machine::start`].
    ///
    /// # Errors
    /// The wrong number of arguments.
    pub fn start_closure(
        &self,
        closure: &Closure<S>,
        args: &[Value<S>],
        depth_first: bool,
    ) -> Result<State<S>, Fault> {
        self.start_call(FunctionId(closure.function), &closure.captures, args, depth_first)
    }

    /// One runnable future: the call of a function, which finds its arguments, defaults and captures in its registers.
    pub(super) fn start_call(
        &self,
        function: FunctionId,
        captures: &[Value<S>],
        args: &[Value<S>],
        depth_first: bool,
    ) -> Result<State<S>, Fault> {
        let f = self.program.function(function);
        let needed = f.params as usize;
        let optional = f.defaults.len();
        if args.len() > needed || args.len() + optional < needed {
            return Err(Fault::new(
                "wrong-arity",
                format!("`{}` takes {needed} arguments, {} given", f.name, args.len()),
            ));
        }
        let default = |i: usize| {
            let default = f.defaults[i + optional - needed];
            match default.place() {
                Place::Constant => f.constants[default.index()].clone(),
                _ => captures[default.index() - needed].clone(),
            }
        };
        let inputs =
            args.iter().cloned().chain((args.len()..needed).map(default)).chain(captures.iter().cloned());
        let unmet = Numbers::below(self.held.map_or(0, Held::len));
        let given = self.given(args, captures);
        let mut state = State { depth_first, unmet, given, ..State::empty() };
        let root = state.new_node(self.program, function, NodeId::NONE, 0, address::ROOT);
        let at = state.nodes[root.0 as usize].registers as usize;
        // A pure function has its inputs in scratch: it is given them when it runs.
        if f.mode == Mode::Pure {
            state.registers.extend(inputs);
        } else {
            for (i, value) in inputs.enumerate() {
                state.registers[at + i] = value;
            }
        }
        let id = state.new_future(Status::Runnable(root), false);
        state.runnable.push(id);
        Ok(state)
    }

    /// What a run is given, where that takes memory.
    fn given(&self, args: &[Value<S>], captures: &[Value<S>]) -> Option<Arc<[Value<S>]>> {
        let given = args.iter().chain(captures).filter(|value| !value.is_plain());
        let given: Arc<[Value<S>]> = given.cloned().collect();
        (!given.is_empty()).then_some(given)
    }
}

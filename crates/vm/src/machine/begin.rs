//! The state of a run that has not begun: a call of the program's entry function, or of any closure of the
//! program.

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
    /// The state of a run of a closure of the program; otherwise like [`Machine::start`].
    ///
    /// # Errors
    /// The number of arguments is wrong.
    pub fn start_closure(
        &self,
        closure: &Closure<S>,
        args: &[Value<S>],
        depth_first: bool,
    ) -> Result<State<S>, Fault> {
        self.start_call(FunctionId(closure.function), &closure.captures, args, depth_first)
    }

    /// The state with one runnable future: the call of a function, with its arguments, defaults and captures in
    /// its registers.
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
        // The entry function of a program that places calls is given no frame.
        let count = needed + f.captures as usize;
        let inputs = args.iter().cloned().chain((args.len()..needed).map(default));
        let inputs = inputs.chain(captures.iter().cloned()).chain(std::iter::repeat(Value::None)).take(count);
        let unmet = Numbers::below(self.held.map_or(0, Held::len));
        let shared_inputs = self.shared_inputs(args, captures);
        let mut state = State { depth_first, unmet, inputs: shared_inputs, ..State::empty() };
        let root = state.new_node(self.program, function, NodeId::NONE, 0, address::ROOT);
        let at = state.nodes[root.0 as usize].registers as usize;
        // A pure function has its inputs in scratch: it gets them when it runs.
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

    /// The arguments and captures of a run that take memory.
    fn shared_inputs(&self, args: &[Value<S>], captures: &[Value<S>]) -> Option<Arc<[Value<S>]>> {
        let values = args.iter().chain(captures).filter(|value| !value.is_plain());
        let values: Arc<[Value<S>]> = values.cloned().collect();
        (!values.is_empty()).then_some(values)
    }
}

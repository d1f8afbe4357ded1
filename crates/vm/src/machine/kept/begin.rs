//! The first run of a trace.

use super::super::Machine;
use super::super::address;
use super::super::answers::Answers;
use super::super::held::Held;
use super::super::stack::RunFault;
use super::super::state::{NodeId, State};
use super::strategy::{Change, Strategy};
use super::trace::{Kept, Trace};
use crate::code::{FunctionId, Mode};
use crate::value::{Closure, Value};
use niwaki_math::Scalar;

impl<'p, S: Scalar> Machine<'p, S> {
    /// Runs the program from the start and keeps its activations. The transaction that created them is open
    /// afterwards. A start with a score of minus infinity cannot be used.
    ///
    /// # Errors
    /// The number of arguments is wrong, or the program has a fault.
    pub fn begin<A: Answers<S>>(
        &mut self,
        args: &[Value<S>],
        answers: &mut A,
    ) -> Result<(Trace<S>, Change), Box<RunFault>> {
        self.begin_call(self.program.entry, &[], args, answers)
    }

    /// Like [`Machine::begin`], for a closure of the program.
    ///
    /// # Errors
    /// As for [`Machine::begin`].
    pub fn begin_closure<A: Answers<S>>(
        &mut self,
        closure: &Closure<S>,
        args: &[Value<S>],
        answers: &mut A,
    ) -> Result<(Trace<S>, Change), Box<RunFault>> {
        self.begin_call(FunctionId(closure.function), &closure.captures, args, answers)
    }

    fn begin_call<A: Answers<S>>(
        &mut self,
        entry: FunctionId,
        captures: &[Value<S>],
        args: &[Value<S>],
        answers: &mut A,
    ) -> Result<(Trace<S>, Change), Box<RunFault>> {
        let bare = |fault| Box::new(RunFault { fault, stack: vec![], omitted: 0, path: String::new() });
        let template = self.start_call(entry, captures, args, true).map_err(bare)?;
        let mut trace = Trace { state: State::empty(), kept: Kept::new(self.program) };
        let (state, kept) = (&mut trace.state, &mut trace.kept);
        state.depth_first = true;
        state.inputs = template.inputs;
        kept.unmet = self.held.map_or(0, Held::len);
        kept.met = vec![0; kept.unmet];
        kept.open();
        let root = kept.new_node(self.program, state, entry, NodeId::NONE, 0, address::ROOT);
        if self.program.function(entry).mode == Mode::Pure {
            // A pure entry function reads its arguments at the start of the register file.
            state.registers.extend(template.registers.iter().cloned());
        } else {
            let f = self.program.function(entry);
            let count = usize::from(f.params) + usize::from(f.captures);
            for (i, value) in template.registers.iter().take(count).enumerate() {
                state.registers[i] = value.clone();
            }
        }
        kept.prepare(Strategy::Rerun);
        let change = self.run_kept(&mut trace, root, 0, answers)?;
        let change = trace.kept.with_all_held(change);
        Ok((trace, change))
    }
}

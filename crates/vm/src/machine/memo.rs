//! Memoised functions: one activation for each value of the arguments in a run, whichever caller is first.
//!
//! A function value from `mem` has an identity ([`Memo`]): the address of the place where it was made, and the
//! function. The address of a call consists of that identity and of the text of the arguments, `color(3)`. So
//! the address is the same in every order of running, and its choices have the same random numbers, whichever
//! caller is first. The first caller runs the call as a part of its own future. Callers during that run wait
//! for it as for a future; later callers have the value at once.
//!
//! Arguments are equal if their texts by `repr` are equal: numbers, truth values, strings, `None`, and tuples
//! and lists of them. So 1, 1.0 and `True` are three arguments.
//!
//! Source: `mem` of Church (Goodman et al. 2008, section 2.1). differs: the table belongs to the run and is copied with it.

use super::Machine;
use super::address::join;
use super::memos::{identity, path_of};
use super::outcome::{Continuation, Stop};
use super::registers::Registers;
use super::state::{FutureId, NodeId, State, Status};
use crate::code::{FunctionId, Program, Site, SiteId};
use crate::fault::Fault;
use crate::machine::keep::Dropped;
use crate::value::{Closure, Memo, Value, print};
use niwaki_math::Scalar;
use std::sync::Arc;

/// The number of characters of a call's address that cost one step.
pub(super) const TEXT: u64 = 64;

/// The text of arguments, by which they are compared. No component of an address contains a slash.
///
/// # Errors
/// A value cannot be an argument of a memoised function.
fn text_of<S: Scalar>(args: &[Value<S>]) -> Result<String, Fault> {
    let mut work: Vec<Value<S>> = args.to_vec();
    while let Some(value) = work.pop() {
        match &value {
            Value::None | Value::Bool(_) | Value::Int(_) | Value::Str(_) => {}
            Value::Real(x) if x.varies() => {
                let message =
                    "an argument of a memoised function depends on a choice that follows a gradient";
                return Err(Fault::new("memo-argument-varies", message).with_help(
                    "use a method without gradients, or do not compute the argument from that choice",
                ));
            }
            Value::Real(_) => {}
            Value::Tuple(tuple) => work.extend(tuple.items().iter().cloned()),
            Value::List(list) => work.extend(list.iter().cloned()),
            Value::Future(_) | Value::Returned(_) => {
                return Err(Fault::not_forced("a future cannot be an argument of a memoised function"));
            }
            other => {
                let kind = other.described();
                let message = format!("{kind} cannot be an argument of a memoised function");
                return Err(Fault::new("memo-argument", message));
            }
        }
    }
    let texts = args.iter().map(print::repr).collect::<Result<Vec<_>, Fault>>()?;
    Ok(format!("({})", texts.join(", ")).replace('/', "\\x2f"))
}

/// The address of a call of a memoised function with these arguments, and its readable address.
pub(super) fn call_of<S: Scalar>(memo: &Memo, args: &[Value<S>]) -> Result<(u128, String), Fault> {
    let text = text_of(args)?;
    Ok((path_of(memo.path, &text), memo.name.clone() + &text))
}

/// The memoised function of a function value.
///
/// # Errors
/// The value is not a function.
pub(super) fn memoised<S: Scalar>(
    state: &State<S>,
    program: &Program<S>,
    node: NodeId,
    site: &Site,
    of: Option<u128>,
    value: &Value<S>,
) -> Result<Value<S>, Fault> {
    let Value::Function(closure) = value else {
        let kind = value.described();
        return Err(Fault::new("not-callable", format!("`mem` takes a function, found {kind}")));
    };
    if closure.memo.is_some() {
        return Ok(value.clone());
    }
    let called = FunctionId(closure.function);
    let memo = match of {
        Some(place) => Memo { path: identity(place, program, called), name: site.label.to_string() },
        None => {
            let above = state.path(program, node);
            let name =
                if above.is_empty() { site.label.to_string() } else { format!("{above}/{}", site.label) };
            let place = join(state.nodes[node.0 as usize].path, site.key);
            Memo { path: identity(place, program, called), name }
        }
    };
    let captures = closure.captures.clone();
    Ok(Value::Function(Arc::new(Closure {
        function: closure.function,
        memo: Some(Arc::new(memo)),
        captures,
    })))
}

/// The fault for a memoised call that needs its own value.
pub(super) fn cycle(name: &str) -> Fault {
    Fault::new("memo-cycle", format!("the memoised call `{name}` needs its base value"))
        .with_help("let it call itself only with other arguments, which end")
}

impl<S: Scalar> Machine<'_, S> {
    /// Calls a memoised function whose arguments and captures are in the buffer. The result is the value, if it
    /// is known; otherwise the activation, or a wait for it. `deferred` is set if a future of the call is
    /// needed, and says whether its handle is read.
    #[allow(clippy::too_many_arguments)] // the registers of the loop in `interpret`, by value
    pub(super) fn recall(
        &mut self,
        state: &mut State<S>,
        future: FutureId,
        r: Registers<'_, S>,
        (node, site_id, pc): (NodeId, SiteId, usize),
        site: &Site,
        function: FunctionId,
        memo: &Memo,
        deferred: Option<bool>,
    ) -> Result<Continuation, Fault> {
        let deferred = deferred.filter(|_| !state.depth_first);
        let place = r.base + site.to.index();
        let params = self.program.function(function).params as usize;
        let (path, name) = call_of(memo, &self.buffer[..params])?;
        state.steps = state.steps.saturating_add(name.len() as u64 / TEXT);
        if let Some(known) = state.memos.find(path) {
            if let Some(detached) = deferred {
                state.registers[place].store(if detached { Value::None } else { Value::Future(known.0) });
                return Ok(Continuation::Next);
            }
            if let Status::Returned(value) = &state.futures[known.0 as usize].status {
                let value = value.clone();
                let value = if site.kind.gives_future() { Value::returned(value) } else { value };
                state.registers[place].store(value);
                return Ok(Continuation::Next);
            }
            if state.depth_first || state.runs_inside(node, known) {
                return Err(cycle(&name));
            }
            state.nodes[node.0 as usize].pc = pc as u32;
            state.futures[future.0 as usize].receives = place as u32;
            state.wait(future, node, known);
            return Ok(Continuation::Stop(Stop::Waiting));
        }
        let parent = if deferred.is_some() { NodeId::NONE } else { node };
        let created = state.new_node(self.program, function, parent, u32::from(site_id.0), path);
        let at = state.nodes[created.0 as usize].registers as usize;
        for (i, value) in self.buffer.drain(..).enumerate() {
            state.registers[at + i].store(value);
        }
        let status = if deferred.is_some() { Status::Runnable(created) } else { Status::Inside(created) };
        let id = state.new_future(status, false);
        state.nodes[created.0 as usize].set_memo(id.0);
        state.memos.add(path, id, &name);
        self.afford(state, &Dropped)?;
        let Some(detached) = deferred else { return Ok(Continuation::Enter(created, 0)) };
        state.nodes[created.0 as usize].site = id.0;
        state.runnable.push(id);
        state.registers[place].store(if detached { Value::None } else { Value::Future(id.0) });
        Ok(Continuation::Next)
    }
}

impl<S: Scalar> State<S> {
    /// Whether a node belongs to a memoised call that has not returned.
    fn runs_inside(&self, node: NodeId, call: FutureId) -> bool {
        let mut at = node;
        while at != NodeId::NONE {
            let n = &self.nodes[at.0 as usize];
            if n.memo() == Some(call.0) {
                return true;
            }
            at = n.parent;
        }
        false
    }
}

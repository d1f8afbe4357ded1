//! The suspension sites that are neither choices nor factors: calls, emits, queries, futures.

use super::Machine;
use super::address::join;
use super::answers::{Answer, Answers, At};
use super::budget;
use super::keep::Dropped;
use super::memo;
use super::outcome::{Continuation, Stop};
use super::registers::Registers;
use super::state::{FutureId, NodeId, State, Status};
use crate::code::{Function, FunctionId, Mode, Op, Operand, Place, Site, SiteId, SiteKind};
use crate::fault::Fault;
use crate::value::{Closure, Memo, Value, index, iter_get, iter_len, ops};
use niwaki_math::Scalar;
use std::sync::Arc;

/// The steps of an emission: a search takes about as long to add a primitive to its sketches.
const EMISSION: u64 = 256;

/// The function in a function value.
pub(super) struct Callee {
    pub function: FunctionId,
    pub pure: bool,
    /// The identity of a memoised function.
    pub memo: Option<Arc<Memo>>,
}

/// The defaults of the parameters that a call with `given` arguments leaves out.
///
/// # Errors
/// The number of arguments is too large or too small.
pub(super) fn defaults<'a, S: Scalar>(
    f: &'a Function<S>,
    closure: &'a Closure<S>,
    count: usize,
) -> Result<impl Iterator<Item = &'a Value<S>>, Fault> {
    let (needed, optional) = (f.params as usize, f.defaults.len());
    if count > needed || count + optional < needed {
        let plural = if needed == 1 { "" } else { "s" };
        return Err(Fault::new(
            "wrong-arity",
            format!("`{}` takes {needed} argument{plural}, {count} given", f.name),
        ));
    }
    Ok(f.defaults[count + optional - needed..].iter().map(move |default| match default.place() {
        Place::Constant => &f.constants[default.index()],
        _ => &closure.captures[default.index() - needed],
    }))
}

/// Stores the result of a call in the activation that waits for it.
#[inline(always)]
fn receive<S: Scalar>(state: &mut State<S>, node: NodeId, base: usize, site: &Site, value: Value<S>) {
    // Depth first, a future has returned before its handle exists.
    let value = if site.kind.gives_future() { Value::returned(value) } else { value };
    let register = &mut state.registers[base + site.to.index()];
    // The most frequent case is a function that returns nothing, in a repeated call.
    if !matches!((&value, &register), (Value::None, Value::None)) {
        let is_plain = value.is_plain();
        register.store(value);
        if !is_plain {
            state.fill(node);
        }
    }
}

/// The operand that a caller returns after a call that comes last, unless it has to take a step for that.
#[inline]
fn returned<S: Scalar>(f: &Function<S>, site: &Site) -> Option<Operand> {
    let mut at = site.next;
    loop {
        match f.code[at as usize] {
            Op::Jump { target } if target > at => at = target,
            Op::Return { a } => return Some(a),
            _ => return None,
        }
    }
}

impl<S: Scalar> Machine<'_, S> {
    /// The first registers of a node and, for an iteration, of the loop node above it.
    #[inline]
    pub(super) fn bases(&self, state: &State<S>, f: &Function<S>, node: NodeId) -> (usize, usize) {
        let n = &state.nodes[node.0 as usize];
        let outer =
            if f.mode == Mode::Iteration { state.nodes[n.parent.0 as usize].registers as usize } else { 0 };
        (n.registers as usize, outer)
    }

    /// Runs a site that is neither a choice nor a factor (those are in `question`).
    #[allow(clippy::too_many_arguments)] // the registers of the loop in `interpret`, by value
    #[inline(never)]
    pub(super) fn suspend<A: Answers<S>>(
        &mut self,
        state: &mut State<S>,
        answers: &mut A,
        future: FutureId,
        node: NodeId,
        r: Registers<'_, S>,
        site_id: SiteId,
        pc: usize,
    ) -> Result<Continuation, Fault> {
        let (program, f) = (self.program, r.f);
        let site = &f.sites[site_id.0 as usize];
        macro_rules! get {
            ($i:expr) => {
                r.get(state, &self.scratch, f.operands[site.args.start as usize + $i])
            };
        }
        macro_rules! at {
            () => {
                At { site, function: f, node, state, program }
            };
        }
        match &site.kind {
            SiteKind::Query => {
                get!(0).refuse_futures("the key of a query")?;
                get!(0).refuse_as_key()?;
                answers.query(&at!(), get!(0), get!(1))?;
                Ok(Continuation::Next)
            }
            SiteKind::Emit => {
                self.collect_shapes(state, r, site)?;
                state.note_part(program, node, &self.shapes);
                match answers.emit(&at!(), &self.shapes)? {
                    Answer::Go(()) => Ok(Continuation::Next),
                    Answer::Pause => {
                        state.pause(future, node, site.resumes_at(pc));
                        Ok(Continuation::Stop(Stop::Paused))
                    }
                }
            }
            SiteKind::Apply => {
                r.gather(state, &self.scratch, site.args, &mut self.buffer);
                let Callee { function, pure, memo } = self.unwrap_callee()?;
                if pure {
                    return Ok(Continuation::Pure { function, to: site.to, as_future: false });
                }
                if let Some(memo) = memo {
                    return self.recall(state, future, r, (node, site_id, pc), site, function, &memo, None);
                }
                self.call(state, node, site_id, site, function, None)
            }
            SiteKind::Future { function, detached } => {
                r.gather(state, &self.scratch, site.args, &mut self.buffer);
                if program.function(*function).mode == Mode::Pure {
                    return Ok(Continuation::Pure { function: *function, to: site.to, as_future: !detached });
                }
                self.call(state, node, site_id, site, *function, Some(*detached))
            }
            SiteKind::FutureApply { detached } => {
                r.gather(state, &self.scratch, site.args, &mut self.buffer);
                let Callee { function, pure, memo } = self.unwrap_callee()?;
                if pure {
                    return Ok(Continuation::Pure { function, to: site.to, as_future: !detached });
                }
                if let Some(memo) = memo {
                    let deferred = Some(*detached);
                    return self.recall(
                        state,
                        future,
                        r,
                        (node, site_id, pc),
                        site,
                        function,
                        &memo,
                        deferred,
                    );
                }
                self.call(state, node, site_id, site, function, Some(*detached))
            }
            SiteKind::Force => {
                let (awaited, value) = match get!(0) {
                    Value::Future(id) => match &state.futures[*id as usize].status {
                        Status::Returned(value) => (*id, Some(value)),
                        _ => (*id, None),
                    },
                    Value::Returned(value) => (0, Some(&value.items()[0])),
                    other => (0, Some(other)),
                };
                if let Some(value) = value.cloned() {
                    state.registers[r.base + site.to.index()].store(value);
                    return Ok(Continuation::Next);
                }
                state.nodes[node.0 as usize].pc = site.resumes_at(pc) as u32;
                state.wait(future, node, FutureId(awaited));
                Ok(Continuation::Stop(Stop::Waiting))
            }
            SiteKind::Memoise { of } => {
                let value = memo::memoised(state, program, node, site, *of, get!(0))?;
                state.registers[r.base + site.to.index()].store(value);
                Ok(Continuation::Next)
            }
            SiteKind::Cell { .. } => {
                let value = get!(0).clone();
                state.registers[r.base + site.to.index()].store(value);
                Ok(Continuation::Next)
            }
            SiteKind::Append { .. } => {
                let list = ops::append(get!(0).clone(), get!(1).clone())?;
                state.charged += budget::of_append(&list);
                self.afford(state, &Dropped)?;
                state.registers[r.base + site.to.index()].store(list);
                Ok(Continuation::Next)
            }
            SiteKind::Read => {
                let value = index::index(get!(0), get!(1))?;
                state.registers[r.base + site.to.index()].store(value);
                Ok(Continuation::Next)
            }
            SiteKind::Loop(l) => self.begin_loop(state, r, node, site_id, site, l),
            other => unreachable!("`interpret` runs {other:?} itself"),
        }
    }

    /// Collects the shapes of an `emit`: its arguments, with lists and tuples of shapes flattened. It costs the
    /// steps that a search takes to add a primitive to its sketches.
    pub(super) fn collect_shapes(
        &mut self,
        state: &mut State<S>,
        r: Registers<'_, S>,
        site: &Site,
    ) -> Result<(), Fault> {
        self.shapes.clear();
        state.steps = state.steps.saturating_add(EMISSION);
        r.gather(state, &self.scratch, site.args, &mut self.buffer);
        self.buffer.reverse();
        while let Some(value) = self.buffer.pop() {
            match &value {
                Value::Shape(shape) => self.shapes.push(shape.clone()),
                Value::List(_) | Value::Tuple(_) => {
                    for i in (0..iter_len(&value)?).rev() {
                        self.buffer.push(iter_get(&value, i));
                    }
                }
                other => {
                    let kind = other.described();
                    return Err(Fault::new("type-mismatch", format!("`emit` takes shapes, found {kind}")));
                }
            }
        }
        Ok(())
    }

    /// Takes the function value from the front of the buffer, and adds its defaults and captures after the
    /// arguments. In a program that places calls, the last argument is the frame.
    pub(super) fn unwrap_callee(&mut self) -> Result<Callee, Fault> {
        let callee = self.buffer.remove(0);
        let Value::Function(closure) = &callee else {
            let kind = callee.described();
            return Err(Fault::new("not-callable", format!("{kind} cannot be called")));
        };
        let id = FunctionId(closure.function);
        let f = self.program.function(id);
        let frame = if self.program.frames { self.buffer.pop() } else { None };
        self.buffer.extend(defaults(f, closure, self.buffer.len())?.cloned());
        self.buffer.extend(closure.captures.iter().cloned());
        if let Some(frame) = frame.filter(|_| f.mode != Mode::Pure && closure.memo.is_none()) {
            self.buffer.truncate(usize::from(f.params + f.captures) - 1);
            self.buffer.push(frame);
        }
        Ok(Callee { function: id, pure: f.mode == Mode::Pure, memo: closure.memo.clone() })
    }

    /// Calls a known function: its arguments go from register to register.
    #[inline]
    pub(super) fn call_known(
        &mut self,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
        site: &Site,
        function: FunctionId,
    ) -> Result<NodeId, Fault> {
        let path = join(state.nodes[node.0 as usize].path, site.key);
        let places = state.places();
        if site.is_tail && state.is_deep() && state.nodes[node.0 as usize].function == function {
            r.gather(state, &self.scratch, site.args, &mut self.buffer);
            let created = state.new_node_in_place(self.program, node, u32::from(number.0), path);
            let at = state.nodes[created.0 as usize].registers as usize;
            for (i, value) in self.buffer.drain(..).enumerate() {
                state.registers[at + i].store(value);
            }
            if state.places() > places {
                self.afford(state, &Dropped)?;
            }
            return Ok(created);
        }
        let created = state.new_node(self.program, function, node, u32::from(number.0), path);
        // A node that was used before takes no further bytes.
        if state.places() > places {
            self.afford(state, &Dropped)?;
        }
        let at = state.nodes[created.0 as usize].registers as usize;
        for (i, o) in r.f.operands[site.args.range()].iter().enumerate() {
            // Most arguments are numbers, which are copied without a second test.
            match *r.get(state, &self.scratch, *o) {
                Value::Real(x) => state.registers[at + i].store_real(x),
                Value::Int(n) => state.registers[at + i].store_int(n),
                ref other => {
                    let value = other.clone();
                    state.registers[at + i].store(value);
                }
            }
        }
        if site.is_tail {
            state.drop_before_return(node, r.f.node_registers.into());
        }
        Ok(created)
    }

    /// Creates an activation with the arguments in the buffer: a call, or (`Some(detached)`) a future.
    fn call(
        &mut self,
        state: &mut State<S>,
        node: NodeId,
        site_id: SiteId,
        site: &Site,
        function: FunctionId,
        future: Option<bool>,
    ) -> Result<Continuation, Fault> {
        let n = state.nodes[node.0 as usize];
        let path = join(n.path, site.key);
        let deferred = future.filter(|_| !state.depth_first);
        let parent = if deferred.is_some() { NodeId::NONE } else { node };
        let places = state.places();
        let created = state.new_node(self.program, function, parent, u32::from(site_id.0), path);
        let at = state.nodes[created.0 as usize].registers as usize;
        for (i, value) in self.buffer.drain(..).enumerate() {
            state.registers[at + i].store(value);
        }
        if state.places() > places {
            self.afford(state, &Dropped)?;
        }
        if site.is_tail && deferred.is_none() {
            state.drop_values(self.program, node);
        }
        let Some(detached) = deferred else { return Ok(Continuation::Enter(created, 0)) };
        if state.origins.is_some() {
            let above = state.path(self.program, node);
            let origin =
                if above.is_empty() { site.label.to_string() } else { format!("{above}/{}", site.label) };
            state.origins.as_mut().map(|origins| origins.insert(created, origin));
        }
        state.inherit_part(node, created);
        let id = state.new_future(Status::Runnable(created), detached);
        state.nodes[created.0 as usize].site = id.0;
        state.runnable.push(id);
        let base = n.registers as usize;
        state.registers[base + site.to.index()].store(if detached {
            Value::None
        } else {
            Value::Future(id.0)
        });
        Ok(Continuation::Next)
    }

    /// Returns from an activation, and returns where to continue, if its future continues. Callers that do nothing more
    /// than to return are passed, unless held choices have to be looked for in each.
    #[inline]
    pub(super) fn give_back(
        &mut self,
        state: &mut State<S>,
        future: FutureId,
        mut node: NodeId,
        mut value: Value<S>,
    ) -> Option<(NodeId, u32)> {
        loop {
            let (above, number, memo) = {
                let n = &state.nodes[node.0 as usize];
                (n.parent, n.site as usize, n.memo())
            };
            state.release(self.program, node);
            if above == NodeId::NONE {
                state.returned(future, value);
                return None;
            }
            if let Some(memo) = memo {
                state.settle(FutureId(memo), value.clone());
            }
            let (function, base) = {
                let parent = &state.nodes[above.0 as usize];
                (parent.function, parent.registers as usize)
            };
            let f = self.program.function(function);
            let site = &f.sites[number];
            if site.is_tail
                && self.held.is_none()
                && let Some(a) = returned(f, site)
            {
                if a.is_constant() {
                    value = f.constants[a.index()].clone();
                } else if site.kind.gives_future() {
                    value = Value::returned(value);
                }
                node = above;
                continue;
            }
            receive(state, above, base, site, value);
            return Some((above, site.next));
        }
    }
}

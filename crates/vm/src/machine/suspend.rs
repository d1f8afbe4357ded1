//! What happens at a suspension site: calls, loops, questions, futures.

use super::address::{iteration_key, join};
use super::answers::{Answer, Answers, At, Factor};
use super::state::{FutureId, NodeId, State, Status};
use super::{Machine, Stop};
use crate::builtins::{make_dist, value_to_draw};
use crate::code::{Args, Function, FunctionId, Loop, Mode, Operand, Place, Site, SiteId, SiteKind, exit};
use crate::fault::Fault;
use crate::value::{Value, index, iter_get, iter_len, ops};
use niwaki_math::{Dist, Draw, Scalar};

/// How to go on after a site.
pub(super) enum After {
    /// At the next instruction.
    Next,
    /// In a new activation.
    Enter(NodeId),
    /// In a pure function, its arguments in the buffer.
    Pure { function: FunctionId, to: Operand, as_future: bool },
    /// Not now.
    Stop(Stop),
}

/// The registers of the activation in hand, and its function.
struct Registers<'a, S: Scalar> {
    f: &'a Function<S>,
    own: usize,
    outer: usize,
}

impl<'a, S: Scalar> Registers<'a, S> {
    #[inline(always)]
    fn get<'b>(&self, state: &'b State<S>, scratch: &'b [Value<S>], o: Operand) -> &'b Value<S>
    where
        'a: 'b,
    {
        match o.place() {
            Place::Node => &state.registers[self.own + o.index()],
            Place::Scratch => &scratch[o.index()],
            Place::Constant => &self.f.constants[o.index()],
            Place::Outer => &state.registers[self.outer + o.index()],
        }
    }

    fn gather(&self, state: &State<S>, scratch: &[Value<S>], args: Args, into: &mut Vec<Value<S>>) {
        into.clear();
        for o in &self.f.operands[args.range()] {
            into.push(self.get(state, scratch, *o).clone());
        }
    }
}

/// The distribution that a value is.
fn as_dist<S: Scalar>(value: &Value<S>) -> Result<&Dist<S>, Fault> {
    match value {
        Value::Dist(dist) => Ok(dist),
        other => {
            Err(Fault::new("type-mismatch", format!("expected a distribution, found {}", other.described())))
        }
    }
}

/// The draw that a value is.
fn as_draw<S: Scalar>(value: &Value<S>) -> Result<Draw<S>, Fault> {
    value_to_draw(value)
        .ok_or_else(|| Fault::new("type-mismatch", format!("no distribution draws {}", value.described())))
}

/// A real number for `factor`.
fn as_real<S: Scalar>(value: &Value<S>) -> Result<S, Fault> {
    match value {
        Value::Real(x) => Ok(*x),
        Value::Int(i) => Ok(S::from_f64(*i as f64)),
        Value::Bool(b) => Ok(S::from_f64(f64::from(u8::from(*b)))),
        other => Err(Fault::new("type-mismatch", format!("expected a number, found {}", other.described()))),
    }
}

impl<S: Scalar> Machine<'_, S> {
    /// First registers of a node and, for an iteration, of the loop node above it.
    #[inline]
    pub(super) fn bases(&self, state: &State<S>, node: NodeId) -> (usize, usize) {
        let n = &state.nodes[node.0 as usize];
        let outer = if self.program.function(n.function).mode == Mode::Iteration {
            state.nodes[n.parent.0 as usize].registers as usize
        } else {
            0
        };
        (n.registers as usize, outer)
    }

    /// Carries out a site of an effectful function. Scratch registers of such a function start at zero.
    #[allow(clippy::too_many_arguments)] // the registers of the loop in `interpret`, by value
    #[inline]
    pub(super) fn suspend<A: Answers<S>>(
        &mut self,
        state: &mut State<S>,
        answers: &mut A,
        future: FutureId,
        node: NodeId,
        id: FunctionId,
        site_id: SiteId,
        pc: usize,
        own: usize,
        outer: usize,
    ) -> Result<After, Fault> {
        let program = self.program;
        let f = program.function(id);
        let site = &f.sites[site_id.0 as usize];
        let r = Registers { f, own, outer };
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
        macro_rules! answer {
            ($answer:expr) => {
                match $answer? {
                    Answer::Go(()) => Ok(After::Next),
                    Answer::Pause => Ok(self.pause(state, future, node, pc + 1)),
                }
            };
        }
        // The value of `observe` is the value observed, so that it can stand where a choice stood.
        macro_rules! observed {
            ($log:expr) => {{
                let value = get!(site.args.len as usize - 1).clone();
                self.put(state, own, site.to, value);
                answer!(answers.score(&at!(), Factor::Observe, $log))
            }};
        }
        match &site.kind {
            SiteKind::Sample { .. } | SiteKind::SampleDist | SiteKind::SampleIndexed => {
                let answer = match &site.kind {
                    SiteKind::SampleDist => answers.choice(&at!(), as_dist(get!(0))?)?,
                    SiteKind::Sample { family } => {
                        r.gather(state, &self.scratch, site.args, &mut self.buffer);
                        let dist = make_dist(*family, &self.buffer)?;
                        answers.choice(&at!(), &dist)?
                    }
                    _ => match index::index_ref(get!(0), get!(1)) {
                        Some(value) => answers.choice(&at!(), as_dist(value)?)?,
                        None => answers.choice(&at!(), as_dist(&index::index(get!(0), get!(1))?)?)?,
                    },
                };
                match answer {
                    Answer::Go(value) => {
                        self.put(state, own, site.to, value);
                        Ok(After::Next)
                    }
                    Answer::Pause => Ok(self.pause(state, future, node, pc)),
                }
            }
            SiteKind::Observe { family } => {
                let n = site.args.len as usize - 1;
                r.gather(state, &self.scratch, Args { len: n as u16, ..site.args }, &mut self.buffer);
                let dist = make_dist(*family, &self.buffer)?;
                let log = dist.log_density(&as_draw(get!(n))?);
                observed!(log)
            }
            SiteKind::ObserveDist => {
                let log = as_dist(get!(0))?.log_density(&as_draw(get!(1))?);
                observed!(log)
            }
            SiteKind::ObserveIndexed => {
                let draw = as_draw(get!(2))?;
                let log = match index::index_ref(get!(0), get!(1)) {
                    Some(value) => as_dist(value)?.log_density(&draw),
                    None => as_dist(&index::index(get!(0), get!(1))?)?.log_density(&draw),
                };
                observed!(log)
            }
            SiteKind::Factor => {
                let log = as_real(get!(0))?;
                answer!(answers.score(&at!(), Factor::Factor, log))
            }
            SiteKind::Condition => {
                let holds = ops::truth(get!(0));
                let log = S::from_f64(if holds { 0.0 } else { f64::NEG_INFINITY });
                answer!(answers.score(&at!(), Factor::Condition, log))
            }
            SiteKind::Query => {
                answers.query(&at!(), get!(0), get!(1))?;
                Ok(After::Next)
            }
            SiteKind::Emit => {
                self.collect_shapes(state, &r, site)?;
                answer!(answers.emit(&at!(), &self.shapes))
            }
            SiteKind::Call { function } => {
                r.gather(state, &self.scratch, site.args, &mut self.buffer);
                self.call(state, node, site_id, site, *function, None)
            }
            SiteKind::Apply => {
                r.gather(state, &self.scratch, site.args, &mut self.buffer);
                let (function, pure) = self.unwrap_callee()?;
                if pure {
                    return Ok(After::Pure { function, to: site.to, as_future: false });
                }
                self.call(state, node, site_id, site, function, None)
            }
            SiteKind::Future { function, detached } => {
                r.gather(state, &self.scratch, site.args, &mut self.buffer);
                if program.function(*function).mode == Mode::Pure {
                    return Ok(After::Pure { function: *function, to: site.to, as_future: true });
                }
                self.call(state, node, site_id, site, *function, Some(*detached))
            }
            SiteKind::FutureApply { detached } => {
                r.gather(state, &self.scratch, site.args, &mut self.buffer);
                let (function, pure) = self.unwrap_callee()?;
                if pure {
                    return Ok(After::Pure { function, to: site.to, as_future: true });
                }
                self.call(state, node, site_id, site, function, Some(*detached))
            }
            SiteKind::Force => {
                let Value::Future(wanted) = *get!(0) else {
                    let value = get!(0).clone();
                    self.put(state, own, site.to, value);
                    return Ok(After::Next);
                };
                if let Status::Returned(value) = &state.futures[wanted as usize].status {
                    let value = value.clone();
                    self.put(state, own, site.to, value);
                    return Ok(After::Next);
                }
                state.futures[wanted as usize].has_waiters = true;
                state.nodes[node.0 as usize].pc = pc as u32;
                state.futures[future.0 as usize].status = Status::Waiting(node, FutureId(wanted));
                state.runnable.retain(|f| *f != future);
                Ok(After::Stop(Stop::Waiting))
            }
            SiteKind::Loop(l) => self.begin_loop(state, &r, node, site_id, site, l),
        }
    }

    #[inline(always)]
    fn put(&mut self, state: &mut State<S>, own: usize, to: Operand, value: Value<S>) {
        if to.place() == Place::Node {
            state.registers[own + to.index()].store(value);
        } else {
            self.scratch[to.index()].store(value);
        }
    }

    fn pause(&mut self, state: &mut State<S>, future: FutureId, node: NodeId, pc: usize) -> After {
        state.nodes[node.0 as usize].pc = pc as u32;
        state.futures[future.0 as usize].status = Status::Runnable(node);
        After::Stop(Stop::Paused)
    }

    /// The shapes of an `emit`: its arguments, lists and tuples of them taken apart.
    fn collect_shapes(&mut self, state: &State<S>, r: &Registers<'_, S>, site: &Site) -> Result<(), Fault> {
        self.shapes.clear();
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
                    let found = other.described();
                    return Err(Fault::new("type-mismatch", format!("`emit` takes shapes, found {found}")));
                }
            }
        }
        Ok(())
    }

    /// Takes the function value off the front of the buffer; adds its defaults and captures behind the arguments.
    fn unwrap_callee(&mut self) -> Result<(FunctionId, bool), Fault> {
        let callee = self.buffer.remove(0);
        let Value::Function(closure) = &callee else {
            let found = callee.described();
            return Err(Fault::new("not-callable", format!("{found} cannot be called")));
        };
        let id = FunctionId(closure.function);
        let f = self.program.function(id);
        let (given, needed, optional) = (self.buffer.len(), f.params as usize, f.defaults.len());
        if given > needed || given + optional < needed {
            let plural = if needed == 1 { "" } else { "s" };
            return Err(Fault::new(
                "wrong-arity",
                format!("`{}` takes {needed} argument{plural}, {given} given", f.name),
            ));
        }
        for i in given..needed {
            let default = f.defaults[i + optional - needed];
            self.buffer.push(match default.place() {
                Place::Constant => f.constants[default.index()].clone(),
                _ => closure.captures[default.index() - needed].clone(),
            });
        }
        self.buffer.extend(closure.captures.iter().cloned());
        Ok((id, f.mode == Mode::Pure))
    }

    /// A new activation with the arguments in the buffer: a call, or (`Some(detached)`) a future.
    fn call(
        &mut self,
        state: &mut State<S>,
        node: NodeId,
        site_id: SiteId,
        site: &Site,
        function: FunctionId,
        future: Option<bool>,
    ) -> Result<After, Fault> {
        let n = state.nodes[node.0 as usize];
        let path = join(n.path, site.key);
        let deferred = future.filter(|_| !state.depth_first);
        let parent = if deferred.is_some() { NodeId::NONE } else { node };
        let made = state.new_node(self.program, function, parent, u32::from(site_id.0), path);
        let at = state.nodes[made.0 as usize].registers as usize;
        for (i, value) in self.buffer.drain(..).enumerate() {
            state.registers[at + i].store(value);
        }
        if state.bytes() > self.limits.bytes {
            return Err(self.out_of_memory());
        }
        let Some(detached) = deferred else { return Ok(After::Enter(made)) };
        if state.origins.is_some() {
            let above = state.path(self.program, node);
            let origin =
                if above.is_empty() { site.label.to_string() } else { format!("{above}/{}", site.label) };
            state.origins.as_mut().map(|origins| origins.insert(made, origin));
        }
        let id = state.new_future(Status::Runnable(made), detached);
        state.nodes[made.0 as usize].site = id.0;
        state.runnable.push(id);
        let own = n.registers as usize;
        self.put(state, own, site.to, if detached { Value::None } else { Value::Future(id.0) });
        Ok(After::Next)
    }

    /// An activation returns. Where to go on, if its future goes on.
    #[inline]
    pub(super) fn give_back(
        &mut self,
        state: &mut State<S>,
        future: FutureId,
        node: NodeId,
        value: Value<S>,
    ) -> Option<(NodeId, u32)> {
        let n = state.nodes[node.0 as usize];
        state.release(self.program, node);
        if n.parent == NodeId::NONE {
            state.returned(future, value);
            return None;
        }
        let parent = state.nodes[n.parent.0 as usize];
        let site = &self.program.function(parent.function).sites[n.site as usize];
        let value = match site.kind {
            // Depth first: the future has returned before anyone sees its handle.
            SiteKind::Future { detached, .. } | SiteKind::FutureApply { detached } if !detached => {
                Value::Future(state.new_future(Status::Returned(value), false).0)
            }
            _ => value,
        };
        state.registers[parent.registers as usize + site.to.index()].store(value);
        Some((n.parent, site.next))
    }

    fn begin_loop(
        &mut self,
        state: &mut State<S>,
        r: &Registers<'_, S>,
        node: NodeId,
        site_id: SiteId,
        site: &Site,
        l: &Loop,
    ) -> Result<After, Fault> {
        let over = l.over.map(|o| r.get(state, &self.scratch, o).clone());
        let first = match &over {
            Some(over) if iter_len(over)? == 0 => {
                r.gather(state, &self.scratch, l.carried, &mut self.buffer);
                self.leave_loop(state, node, site_id, exit::NEXT);
                return Ok(After::Next);
            }
            Some(over) => Some(iter_get(over, 0)),
            None => None,
        };
        let path = join(state.nodes[node.0 as usize].path, site.key);
        let header = state.new_node(self.program, l.header, node, u32::from(site_id.0), path);
        let at = state.nodes[header.0 as usize].registers as usize;
        r.gather(state, &self.scratch, l.captures, &mut self.buffer);
        state.registers[at].store(over.unwrap_or_default());
        for (i, value) in self.buffer.drain(..).enumerate() {
            state.registers[at + 1 + i].store(value);
        }
        let inner = state.new_node(self.program, l.body, header, 0, join(path, iteration_key(0)));
        let at = state.nodes[inner.0 as usize].registers as usize;
        r.gather(state, &self.scratch, l.carried, &mut self.buffer);
        for (i, value) in first.into_iter().chain(self.buffer.drain(..)).enumerate() {
            state.registers[at + i].store(value);
        }
        if state.bytes() > self.limits.bytes {
            return Err(self.out_of_memory());
        }
        Ok(After::Enter(inner))
    }

    /// An iteration ends with its carried values (and a returned value) in the buffer. Where to go on.
    pub(super) fn end_iteration(
        &mut self,
        state: &mut State<S>,
        node: NodeId,
        kind: i64,
    ) -> Result<(NodeId, u32), Fault> {
        let n = state.nodes[node.0 as usize];
        let header = state.nodes[n.parent.0 as usize];
        if kind == exit::NEXT {
            let i = header.iteration + 1;
            let over = &state.registers[header.registers as usize];
            let element = match over {
                Value::None => None,
                over if (i as usize) < iter_len(over)? => Some(iter_get(over, i as usize)),
                _ => return Ok(self.end_loop(state, node, n.parent, header.parent, header.site, kind)),
            };
            state.nodes[n.parent.0 as usize].iteration = i;
            state.nodes[node.0 as usize].path = join(header.path, iteration_key(i));
            let at = n.registers as usize;
            for (k, value) in element.into_iter().chain(self.buffer.drain(..)).enumerate() {
                state.registers[at + k].store(value);
            }
            return Ok((node, 0));
        }
        Ok(self.end_loop(state, node, n.parent, header.parent, header.site, kind))
    }

    fn end_loop(
        &mut self,
        state: &mut State<S>,
        node: NodeId,
        header: NodeId,
        owner: NodeId,
        site: u32,
        kind: i64,
    ) -> (NodeId, u32) {
        state.release(self.program, node);
        state.release(self.program, header);
        let next = self.leave_loop(state, owner, SiteId(site as u16), kind);
        (owner, next)
    }

    /// Writes what came out of a loop, in the buffer, to the registers of its owner.
    fn leave_loop(&mut self, state: &mut State<S>, owner: NodeId, site: SiteId, kind: i64) -> u32 {
        let n = &state.nodes[owner.0 as usize];
        let (f, own) = (self.program.function(n.function), n.registers as usize);
        let site = &f.sites[site.0 as usize];
        if let SiteKind::Loop(l) = &site.kind {
            if let Some((how, value)) = l.exit {
                if kind == exit::RETURN {
                    state.registers[own + value.index()].store(self.buffer.pop().unwrap_or_default());
                }
                state.registers[own + how.index()].store(Value::Int(kind));
            }
            for (o, value) in f.operands[l.out.range()].iter().zip(self.buffer.drain(..)) {
                state.registers[own + o.index()].store(value);
            }
        }
        site.next
    }
}

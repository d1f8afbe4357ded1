//! The loop over instructions. Long for one reason: it is one table.

use super::answers::Answers;
use super::state::{FutureId, State, Status};
use super::suspend::After;
use super::{Here, Machine, PureCall, Stop};
use crate::builtins;
use crate::code::{Binary, FunctionId, Mode, Op, Operand, Place};
use crate::fault::Fault;
use crate::value::{Closure, Dict, Record, Value, equal, index, iter_get, iter_len, ops};
use niwaki_math::Scalar;
use std::sync::Arc;

/// The value of a comparison or arithmetic operation.
#[inline(always)]
fn binary<S: Scalar>(op: Binary, a: &Value<S>, b: &Value<S>) -> Result<Value<S>, Fault> {
    match op {
        Binary::Add => ops::add(a, b),
        Binary::Sub => ops::sub(a, b),
        Binary::Mul => ops::mul(a, b),
        Binary::Div => ops::div(a, b),
        Binary::FloorDiv => ops::floordiv(a, b),
        Binary::Mod => ops::mod_(a, b),
        Binary::Pow => ops::pow(a, b),
        Binary::Index => index::index(a, b),
        Binary::In => index::contains(b, a).map(Value::Bool),
        _ => compare(op, a, b).map(Value::Bool),
    }
}

/// The truth of a comparison.
#[inline(always)]
fn compare<S: Scalar>(op: Binary, a: &Value<S>, b: &Value<S>) -> Result<bool, Fault> {
    match op {
        Binary::Eq => equal(a, b),
        Binary::Ne => equal(a, b).map(|same| !same),
        Binary::Lt => ops::lt(a, b).map(|v| ops::truth(&v)),
        Binary::Le => ops::le(a, b).map(|v| ops::truth(&v)),
        Binary::Gt => ops::gt(a, b).map(|v| ops::truth(&v)),
        _ => ops::ge(a, b).map(|v| ops::truth(&v)),
    }
}

impl<S: Scalar> Machine<'_, S> {
    pub(super) fn interpret<A: Answers<S>>(
        &mut self,
        state: &mut State<S>,
        future: FutureId,
        answers: &mut A,
    ) -> Result<Stop, Fault> {
        let program = self.program;
        let Status::Runnable(mut node) = state.futures[future.0 as usize].status else {
            return Err(Fault::new("not-runnable", "this future cannot run now"));
        };
        let mut id = state.nodes[node.0 as usize].function;
        let mut f = program.function(id);
        let mut pc = state.nodes[node.0 as usize].pc as usize;
        let mut scratch = 0;
        // First registers of this node, and of the loop node above an iteration.
        let (mut own, mut outer) = self.bases(state, node);
        self.room(scratch + f.scratch_registers as usize);
        if f.mode == Mode::Pure {
            // A pure entry function: its arguments wait in the state.
            let args = f.params as usize;
            for i in 0..args {
                self.scratch[i] = state.registers[i].clone();
            }
        }

        macro_rules! get {
            ($o:expr) => {{
                let o: Operand = $o;
                match o.place() {
                    Place::Node => &state.registers[own + o.index()],
                    Place::Scratch => &self.scratch[scratch + o.index()],
                    Place::Constant => &f.constants[o.index()],
                    Place::Outer => &state.registers[outer + o.index()],
                }
            }};
        }
        macro_rules! put {
            ($o:expr, $v:expr) => {{
                let (o, v): (Operand, Value<S>) = ($o, $v);
                if o.place() == Place::Node {
                    state.registers[own + o.index()].store(v);
                } else {
                    self.scratch[scratch + o.index()].store(v);
                }
            }};
        }
        macro_rules! check {
            ($e:expr) => {
                match $e {
                    Ok(value) => value,
                    Err(fault) => {
                        self.here = Here { node, function: id, pc };
                        return Err(fault);
                    }
                }
            };
        }
        macro_rules! gather {
            ($args:expr) => {{
                self.buffer.clear();
                for i in $args.range() {
                    let value = get!(f.operands[i]).clone();
                    self.buffer.push(value);
                }
            }};
        }
        macro_rules! step {
            () => {{
                state.steps += 1;
                if state.steps > self.limits.steps {
                    check!(Err(self.out_of_steps()));
                }
            }};
        }
        macro_rules! goto {
            ($target:expr) => {{
                let target = $target as usize;
                if target <= pc {
                    step!();
                }
                pc = target;
                continue;
            }};
        }
        // Go on in another activation.
        macro_rules! enter {
            ($node:expr, $pc:expr) => {{
                node = $node;
                id = state.nodes[node.0 as usize].function;
                f = program.function(id);
                pc = $pc as usize;
                (own, outer) = self.bases(state, node);
                self.room(scratch + f.scratch_registers as usize);
                continue;
            }};
        }
        macro_rules! call_pure {
            ($function:expr, $to:expr, $as_future:expr) => {{
                step!();
                let function: FunctionId = $function;
                self.pure.push(PureCall { caller: id, pc: pc + 1, scratch, to: $to, as_future: $as_future });
                scratch += f.scratch_registers as usize;
                id = function;
                f = program.function(id);
                self.room(scratch + f.scratch_registers as usize);
                for (i, value) in self.buffer.drain(..).enumerate() {
                    self.scratch[scratch + i].store(value);
                }
                if self.scratch.len() * size_of::<Value<S>>() > self.limits.bytes {
                    check!(Err(self.out_of_memory()));
                }
                pc = 0;
                continue;
            }};
        }

        loop {
            match f.code[pc] {
                Op::Move { to, from } => {
                    let value = get!(from).clone();
                    put!(to, value);
                }
                Op::Binary { op, to, a, b } => {
                    let value = check!(binary(op, get!(a), get!(b)));
                    put!(to, value);
                }
                Op::Neg { to, a } => {
                    let value = check!(ops::neg(get!(a)));
                    put!(to, value);
                }
                Op::Not { to, a } => {
                    let value = ops::truth(get!(a));
                    put!(to, Value::Bool(!value));
                }
                Op::Jump { target } => goto!(target),
                Op::JumpIf { a, target } => {
                    if ops::truth(get!(a)) {
                        goto!(target);
                    }
                }
                Op::JumpUnless { a, target } => {
                    if !ops::truth(get!(a)) {
                        goto!(target);
                    }
                }
                Op::JumpUnlessCompare { op, a, b, target } => {
                    if !check!(compare(op, get!(a), get!(b))) {
                        goto!(target);
                    }
                }
                Op::Site { site } => {
                    match check!(self.suspend(state, answers, future, node, id, site, pc, own, outer)) {
                        After::Next => {}
                        After::Enter(inner) => {
                            step!();
                            enter!(inner, 0);
                        }
                        After::Pure { function, to, as_future } => call_pure!(function, to, as_future),
                        After::Stop(stop) => return Ok(stop),
                    }
                }
                Op::Builtin { to, id: builtin, args } => {
                    gather!(args);
                    let value = check!(builtins::builtin::<S>(builtin).call(&self.buffer));
                    put!(to, value);
                }
                Op::List { to, args } => {
                    gather!(args);
                    let items = self.buffer.drain(..).collect();
                    put!(to, Value::list(items));
                }
                Op::Tuple { to, args } => {
                    gather!(args);
                    let items = self.buffer.drain(..).collect();
                    put!(to, Value::tuple(items));
                }
                Op::Dict { to, args } => {
                    gather!(args);
                    let values = self.buffer.split_off(self.buffer.len() / 2);
                    let pairs = self.buffer.drain(..).zip(values).collect();
                    put!(to, Value::Dict(Arc::new(Dict::new(pairs))));
                }
                Op::Record { to, class, args } => {
                    gather!(args);
                    let fields = self.buffer.drain(..).collect();
                    let class = program.classes[class as usize].clone();
                    put!(to, Value::Record(Arc::new(Record { class, fields })));
                }
                Op::Field { to, a, name } => {
                    let value = check!(index::field(get!(a), &f.names[name as usize]));
                    put!(to, value);
                }
                Op::Unpack { from, to } => {
                    let value = get!(from).clone();
                    let n = check!(iter_len(&value));
                    if n != to.len as usize {
                        check!(Err(Fault::new(
                            "unpack-length",
                            format!("cannot unpack {n} values into {} names", to.len)
                        )));
                    }
                    for (k, i) in to.range().enumerate() {
                        put!(f.operands[i], iter_get(&value, k));
                    }
                }
                Op::UnpackStar { from, to, star } => {
                    let value = get!(from).clone();
                    let n = check!(iter_len(&value));
                    let (count, star) = (to.len as usize, star as usize);
                    if n + 1 < count {
                        check!(Err(Fault::new(
                            "unpack-length",
                            format!("cannot unpack {n} values into {} names and a rest", count - 1)
                        )));
                    }
                    let rest = n + 1 - count;
                    for (k, i) in to.range().enumerate() {
                        let item = match k.cmp(&star) {
                            std::cmp::Ordering::Less => iter_get(&value, k),
                            std::cmp::Ordering::Greater => iter_get(&value, k - 1 + rest),
                            std::cmp::Ordering::Equal => {
                                Value::list((star..star + rest).map(|j| iter_get(&value, j)).collect())
                            }
                        };
                        put!(f.operands[i], item);
                    }
                }
                Op::Closure { to, function, args } => {
                    gather!(args);
                    let captures = self.buffer.drain(..).collect();
                    put!(to, Value::Function(Arc::new(Closure { function: u32::from(function), captures })));
                }
                Op::Dist { to, family, args } => {
                    gather!(args);
                    let value = check!(builtins::make_dist(family, &self.buffer));
                    put!(to, Value::Dist(Arc::new(value)));
                }
                Op::Host { to, constant, args } => {
                    gather!(args);
                    let value = check!(answers.host(constant, &self.buffer));
                    put!(to, value);
                }
                Op::CallPure { to, function, args } => {
                    gather!(args);
                    call_pure!(FunctionId(u32::from(function)), to, false);
                }
                Op::Length { to, a } => {
                    let n = check!(iter_len(get!(a)));
                    put!(to, Value::Int(n as i64));
                }
                Op::Next { to, over, index, length, target } => {
                    let (Value::Int(i), Value::Int(n)) = (get!(index), get!(length)) else {
                        check!(Err(Fault::new("type-mismatch", "a loop lost its count")))
                    };
                    let i = *i;
                    if i >= *n {
                        goto!(target);
                    }
                    let item = iter_get(get!(over), i as usize);
                    put!(to, item);
                    put!(index, Value::Int(i + 1));
                }
                Op::CheckSet { a, name } => {
                    if matches!(get!(a), Value::Unset) {
                        let name = &f.names[name as usize];
                        check!(Err(Fault::new(
                            "unassigned-variable",
                            format!("the variable `{name}` is read before it is assigned")
                        )));
                    }
                }
                Op::Assert { a, message } => {
                    if !ops::truth(get!(a)) {
                        let text = check!(crate::value::str_of(get!(message)));
                        check!(Err(Fault::new("assertion", text.to_string())));
                    }
                }
                Op::Return { a } => {
                    let value = get!(a).clone();
                    if let Some(call) = self.pure.pop() {
                        id = call.caller;
                        f = program.function(id);
                        scratch = call.scratch;
                        pc = call.pc;
                        let value = if call.as_future {
                            Value::Future(state.new_future(Status::Returned(value), false).0)
                        } else {
                            value
                        };
                        put!(call.to, value);
                        continue;
                    }
                    match self.give_back(state, future, node, value) {
                        Some((parent, next)) => enter!(parent, next),
                        None => return Ok(Stop::Returned),
                    }
                }
                Op::ReturnIteration { exit, args } => {
                    gather!(args);
                    match check!(self.end_iteration(state, node, i64::from(exit))) {
                        (same, 0) if same == node => {
                            step!();
                            pc = 0;
                            continue;
                        }
                        (parent, next) => enter!(parent, next),
                    }
                }
            }
            pc += 1;
        }
    }

    /// Makes room for that many scratch registers.
    #[inline]
    fn room(&mut self, registers: usize) {
        if self.scratch.len() < registers {
            self.scratch.resize(registers.max(64), Value::None);
        }
    }
}

//! The loop over instructions. Long for one reason: it is one table.

use super::answers::{Answer, Answers};
use super::registers::Registers;
use super::state::{FutureId, State, Status};
use super::suspend::After;
use super::{Here, Machine, PureCall, Stop};
use crate::builtins;
use crate::code::{Binary, FunctionId, Mode, Op, SiteKind, exit};
use crate::fault::Fault;
use crate::value::{Value, equal, index, iter_get, iter_len, ops};
use niwaki_math::Scalar;

/// The value of a comparison or arithmetic operation.
#[inline(never)]
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

/// The operations of two reals that cannot fail, by far the most frequent.
#[inline(always)]
fn of_reals<S: Scalar>(op: Binary, a: &Value<S>, b: &Value<S>) -> Option<S> {
    let (Value::Real(a), Value::Real(b)) = (a, b) else { return None };
    match op {
        Binary::Add => Some(*a + *b),
        Binary::Sub => Some(*a - *b),
        Binary::Mul => Some(*a * *b),
        _ => None,
    }
}

/// The truth of a comparison.
#[inline(never)]
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

        macro_rules! r {
            () => {
                Registers { f, own, outer, scratch }
            };
        }
        macro_rules! get {
            ($o:expr) => {
                r!().get(state, &self.scratch, $o)
            };
        }
        macro_rules! put {
            ($o:expr, $v:expr) => {{
                let value = $v;
                r!().put(state, &mut self.scratch, $o, value);
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
            ($args:expr) => {
                r!().gather(state, &self.scratch, $args, &mut self.buffer)
            };
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
                    let (a, b) = (get!(a), get!(b));
                    match of_reals(op, a, b) {
                        Some(x) => put!(to, Value::Real(x)),
                        None => put!(to, check!(binary(op, a, b))),
                    }
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
                Op::Site { site: number } => {
                    let site = &f.sites[number.0 as usize];
                    match site.kind {
                        SiteKind::Sample { .. } | SiteKind::SampleDist | SiteKind::SampleIndexed => {
                            match check!(self.choose(state, answers, r!(), node, site)) {
                                Answer::Go(value) => state.registers[own + site.to.index()].store(value),
                                Answer::Pause => {
                                    state.pause(future, node, pc);
                                    return Ok(Stop::Paused);
                                }
                            }
                        }
                        SiteKind::Observe { .. }
                        | SiteKind::ObserveDist
                        | SiteKind::ObserveIndexed
                        | SiteKind::Factor
                        | SiteKind::Condition => {
                            match check!(self.factor(state, answers, r!(), node, site)) {
                                Answer::Go(()) => {}
                                Answer::Pause => {
                                    state.pause(future, node, pc + 1);
                                    return Ok(Stop::Paused);
                                }
                            }
                        }
                        SiteKind::Call { function } => {
                            let inner = check!(self.call_known(state, r!(), node, number, site, function));
                            step!();
                            enter!(inner, 0);
                        }
                        _ => match check!(self.suspend(state, answers, future, node, r!(), number, pc)) {
                            After::Next => {}
                            After::Enter(inner) => {
                                step!();
                                enter!(inner, 0);
                            }
                            After::Pure { function, to, as_future } => call_pure!(function, to, as_future),
                            After::Stop(stop) => return Ok(stop),
                        },
                    }
                }
                Op::Builtin { to, id: builtin, args } => {
                    let builtin = builtins::builtin::<S>(builtin);
                    let value = if let [a] = f.operands[args.range()] {
                        // One argument, as of `sqrt`, is read where it lies.
                        check!(builtin.call(std::slice::from_ref(get!(a))))
                    } else {
                        gather!(args);
                        check!(builtin.call(&self.buffer))
                    };
                    put!(to, value);
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
                Op::ReturnIteration { exit: kind, args } => {
                    let kind = i64::from(kind);
                    if kind == exit::NEXT && check!(self.next_iteration(state, r!(), node, args)) {
                        step!();
                        pc = 0;
                        continue;
                    }
                    gather!(args);
                    let (parent, next) = self.end_loop(state, node, kind);
                    enter!(parent, next);
                }
                op => check!(self.construct(state, r!(), op)),
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

//! The loop over instructions. It is long because it is one table of all instructions.

use super::answers::Answers;
use super::budget::{self, Price};
use super::buffers::make_room;
use super::keep::{Keep, put};
use super::operate;
use super::outcome::Continuation;
use super::outcome::Halt;
use super::outcome::Stop;
use super::registers::{Registers, proven};
use super::state::{FutureId, NodeId, State};
use super::workspace::{Here, Machine, PureCall};
use crate::builtins;
use crate::code::routine::Then;
use crate::code::{Binary, FunctionId, Mode, Op, SiteKind, exit};
use crate::core::readable;
use crate::fault::Fault;
use crate::value::index::index_ref;
use crate::value::{Value, iter_get, iter_len, ops};
use niwaki_math::Scalar;

impl<S: Scalar> Machine<'_, S> {
    /// Continues from an instruction of a node. `future` is the future that runs; where activations are kept
    /// there are no futures.
    pub(super) fn interpret<A: Answers<S>, K: Keep<S>>(
        &mut self,
        state: &mut State<S>,
        keep: &mut K,
        future: FutureId,
        (mut node, mut pc): (NodeId, usize),
        answers: &mut A,
    ) -> Result<Stop, Fault> {
        let program = self.program;
        let mut id = state.nodes[node.0 as usize].function;
        let mut f = program.function(id);
        let mut code = f.code.as_slice();
        let mut executed = 0u64;
        // Held choices are observed, and those of kept activations recorded.
        let chooses = A::DRAWS && !K::KEEPS && self.held.is_none();
        if K::KEEPS {
            keep.enter(state, node);
        }
        let mut scratch = 0;
        // The first registers of this node, and of the loop node above an iteration.
        let (mut base, mut outer) = self.bases(state, f, node);
        self.reserve(scratch + f.scratch_registers as usize);
        if f.mode == Mode::Pure {
            // A run that begins with a pure function: its arguments and captures wait in the state.
            let args = usize::from(f.params) + usize::from(f.captures);
            for i in 0..args {
                self.scratch[i] = state.registers[i].clone();
            }
            self.holds_shared = true;
        }

        macro_rules! r {
            () => {
                Registers { f, base, outer, scratch }
            };
        }
        macro_rules! get {
            ($o:expr) => {
                r!().get(state, &self.scratch, $o)
            };
        }
        macro_rules! slot {
            ($o:expr, $store:ident, $as:expr, $x:expr) => {{
                let (o, x) = ($o, $x);
                if K::KEEPS && o.is_node() {
                    keep.write(state, base + o.index(), $as(x));
                } else {
                    r!().slot(state, &mut self.scratch, o).$store(x);
                }
            }};
        }
        macro_rules! put {
            ($o:expr, $v:expr) => {{
                let value = $v;
                put(keep, state, (&mut self.scratch, &mut self.holds_shared), r!(), $o, value);
            }};
        }
        macro_rules! check {
            ($e:expr) => {
                match $e {
                    Ok(value) => value,
                    Err(fault) => {
                        if K::KEEPS {
                            keep.count(executed);
                        }
                        self.here = Here { node, function: id, pc, scratch };
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
        // Stops the run: the answer to a question was not a value.
        macro_rules! stop {
            ($halt:expr, $site:expr) => {
                match $halt {
                    Halt::Paused => {
                        state.pause(future, node, $site.resumes_at(pc));
                        return Ok(Stop::Paused);
                    }
                    Halt::PausedAfter => {
                        state.pause(future, node, pc + 1);
                        return Ok(Stop::Paused);
                    }
                    Halt::Impossible => {
                        keep.count(executed);
                        self.here = Here { node, function: id, pc, scratch };
                        return Ok(Stop::Impossible);
                    }
                    Halt::Fault(fault) => check!(Err(fault)),
                }
            };
        }
        macro_rules! step {
            () => {{
                state.steps += 1;
                if state.steps > state.alarm {
                    check!(self.check_limits(state, keep));
                }
            }};
        }
        // Continues at the start of an activation, or where it waits for a call.
        macro_rules! continue_in {
            ($node:expr, $pc:expr) => {{
                node = $node;
                id = state.nodes[node.0 as usize].function;
                f = program.function(id);
                code = &f.code;
                pc = $pc as usize;
                (base, outer) = self.bases(state, f, node);
                self.reserve(scratch + f.scratch_registers as usize);
            }};
        }
        // Runs the machine code that begins there, if it exists, and that of the activations that it calls, and
        // continues where it leaves.
        macro_rules! native {
            ($pc:expr) => {{
                let (mut at, mut has_run) = ($pc, false);
                while let Some(entry) = f.native.at(at)
                    && entry.is_open(chooses)
                    && let Some((on, instructions)) =
                        self.enter(state, r!(), (id, entry), keep.writes_plainly(), (chooses, node, answers))
                {
                    has_run = true;
                    if K::KEEPS {
                        executed += instructions;
                    }
                    id = on.function;
                    f = program.function(id);
                    code = &f.code;
                    scratch += on.base as usize;
                    pc = on.pc as usize;
                    match on.then {
                        Then::Continues => break,
                        Then::Pauses if self.pauses => {
                            state.pause(future, node, pc);
                            return Ok(Stop::Paused);
                        }
                        Then::Pauses => {}
                        Then::Enters => {
                            step!();
                            continue_in!(self.called, 0);
                        }
                    }
                    at = pc;
                }
                has_run
            }};
        }
        macro_rules! goto {
            ($target:expr) => {{
                let target = $target as usize;
                if target <= pc {
                    step!();
                    if native!(target) {
                        continue;
                    }
                }
                pc = target;
                continue;
            }};
        }
        // Continues in another activation.
        macro_rules! enter {
            ($node:expr, $pc:expr) => {{
                continue_in!($node, $pc);
                if K::KEEPS {
                    keep.enter(state, node);
                }
                native!(pc);
                continue;
            }};
        }
        // Charges a new value.
        macro_rules! charged {
            ($value:expr) => {{
                let value = $value;
                if !value.is_plain() {
                    let price = Price { steps: 0, bytes: budget::of_result(&value) };
                    check!(self.charge(state, keep, price));
                }
                value
            }};
        }
        // The compiler knows the operation, so it removes the cases of `operate` for the others.
        macro_rules! arithmetic {
            ($op:expr, $to:expr, $a:expr, $b:expr) => {{
                let (a, b) = (get!($a), get!($b));
                // Most operands are two real numbers, which are looked for first.
                if let (Value::Real(x), Value::Real(y)) = (a, b)
                    && let Some(z) = operate::reals($op, *x, *y)
                {
                    slot!($to, store_real, Value::Real, z);
                } else if let Some(z) = operate::mixed($op, a, b) {
                    slot!($to, store_real, Value::Real, z);
                } else if let (Value::Int(x), Value::Int(y)) = (a, b)
                    && let Some(z) = operate::ints($op, *x, *y)
                {
                    slot!($to, store_int, Value::Int, z);
                } else {
                    put!($to, check!(self.operate(state, keep, r!(), $op, ($a, $b))));
                }
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
                code = &f.code;
                let deeper = self.reserve(scratch + f.scratch_registers as usize);
                for (i, value) in self.buffer.drain(..).enumerate() {
                    self.holds_shared |= !value.is_plain();
                    self.scratch[scratch + i].store(value);
                }
                if deeper {
                    check!(self.afford(state, keep));
                }
                if native!(0) {
                    continue;
                }
                pc = 0;
                continue;
            }};
        }

        native!(pc);
        loop {
            if K::KEEPS {
                executed += 1;
            }
            match *proven(code, pc) {
                Op::Move { to, from } => {
                    let value = get!(from).clone();
                    put!(to, value);
                }
                Op::Add { to, a, b } => arithmetic!(Binary::Add, to, a, b),
                Op::Sub { to, a, b } => arithmetic!(Binary::Sub, to, a, b),
                Op::Mul { to, a, b } => arithmetic!(Binary::Mul, to, a, b),
                Op::Div { to, a, b } => arithmetic!(Binary::Div, to, a, b),
                Op::Binary { op, to, a, b } => {
                    let (x, y) = (get!(a), get!(b));
                    if let (Value::Int(x), Value::Int(y)) = (x, y)
                        && let Some(z) = operate::ints(op, *x, *y)
                    {
                        slot!(to, store_int, Value::Int, z);
                    } else if op == Binary::Index {
                        // Most elements are numbers, which are not moved through memory.
                        match index_ref(x, y) {
                            Some(&Value::Real(x)) => slot!(to, store_real, Value::Real, x),
                            Some(&Value::Int(n)) => slot!(to, store_int, Value::Int, n),
                            _ => put!(to, check!(operate::values(op, x, y))),
                        }
                    } else {
                        put!(to, check!(self.operate(state, keep, r!(), op, (a, b))));
                    }
                }
                Op::Field { to, a, name } => check!(self.field(state, keep, r!(), (to, a, name))),
                Op::Neg { to, a } => {
                    let value = check!(ops::neg(get!(a)));
                    put!(to, charged!(value));
                }
                Op::Not { to, a } => {
                    let value = check!(ops::truth(get!(a)));
                    put!(to, Value::Bool(!value));
                }
                Op::Jump { target } => goto!(target),
                Op::JumpIf { a, target } => {
                    if check!(ops::truth(get!(a))) {
                        goto!(target);
                    }
                }
                Op::JumpUnless { a, target } => {
                    if !check!(ops::truth(get!(a))) {
                        goto!(target);
                    }
                }
                Op::JumpUnlessCompare { op, a, b, target } => {
                    let (x, y) = (get!(a), get!(b));
                    let holds = if x.is_plain() || y.is_plain() {
                        check!(operate::holds(op, x, y))
                    } else {
                        check!(self.compare(state, keep, r!(), op, (a, b)))
                    };
                    if !holds {
                        goto!(target);
                    }
                }
                Op::Site { site: number } if K::KEEPS => {
                    keep.at(pc);
                    let site = &f.sites[number.0 as usize];
                    match site.kind {
                        SiteKind::Sample(_) => match keep.choose(self, state, answers, r!(), node, number) {
                            Ok(next) if next == pc + 1 => {}
                            Ok(next) => {
                                pc = next;
                                continue;
                            }
                            Err(halt) => stop!(halt, site),
                        },
                        SiteKind::Observe(_) | SiteKind::Factor | SiteKind::Condition => {
                            match keep.factor(self, state, r!(), node, number) {
                                Ok(()) => {}
                                Err(halt) => stop!(halt, site),
                            }
                        }
                        _ => match keep.suspend(self, state, r!(), node, number) {
                            Ok(Continuation::Next) => {}
                            Ok(Continuation::Enter(inner, at)) => {
                                step!();
                                enter!(inner, at);
                            }
                            Ok(Continuation::Goto(next)) => {
                                pc = next as usize;
                                continue;
                            }
                            Ok(Continuation::Pure { function, to, as_future }) => {
                                call_pure!(function, to, as_future)
                            }
                            Ok(Continuation::Stop(stop)) => return Ok(stop),
                            Ok(Continuation::Entered) => {
                                unreachable!("only lanes enter a function by themselves")
                            }
                            Err(halt) => stop!(halt, site),
                        },
                    }
                    if native!(pc + 1) {
                        continue;
                    }
                }
                Op::Site { site: number } => {
                    let site = &f.sites[number.0 as usize];
                    match site.kind {
                        SiteKind::Sample(_) => match self.choose(state, answers, r!(), node, site) {
                            Ok(()) => {}
                            Err(halt) => stop!(halt, site),
                        },
                        SiteKind::Observe(_) | SiteKind::Factor | SiteKind::Condition => {
                            match self.factor(state, answers, r!(), node, site) {
                                Ok(()) => {}
                                Err(halt) => stop!(halt, site),
                            }
                        }
                        SiteKind::Call { function } => {
                            let inner = check!(self.call_known(state, r!(), node, number, site, function));
                            step!();
                            enter!(inner, 0);
                        }
                        _ => match check!(self.suspend(state, answers, future, node, r!(), number, pc)) {
                            Continuation::Next => {}
                            Continuation::Enter(inner, at) => {
                                step!();
                                enter!(inner, at);
                            }
                            Continuation::Goto(next) => {
                                pc = next as usize;
                                continue;
                            }
                            Continuation::Pure { function, to, as_future } => {
                                call_pure!(function, to, as_future)
                            }
                            Continuation::Stop(stop) => return Ok(stop),
                            Continuation::Entered => {
                                unreachable!("only lanes enter a function by themselves")
                            }
                        },
                    }
                    if native!(pc + 1) {
                        continue;
                    }
                }
                Op::Builtin { to, id: builtin, args } => {
                    let builtin = builtins::builtin::<S>(builtin);
                    let answer = if let [a] = f.operands[args.range()] {
                        // A single argument, as for `sqrt`, is read in place.
                        if !get!(a).is_plain() {
                            check!(self.charge_argument(state, keep, r!(), builtin, a));
                        }
                        builtin.call(std::slice::from_ref(get!(a)))
                    } else {
                        gather!(args);
                        if !self.buffer.iter().all(Value::is_plain) {
                            check!(self.charge_arguments(state, keep, builtin));
                        }
                        builtin.call(&self.buffer)
                    };
                    let value = check!(answer);
                    if let Value::Real(x) = value {
                        // There is nothing to drop, but the compiler does not know that.
                        std::mem::forget(value);
                        slot!(to, store_real, Value::Real, x);
                    } else {
                        if !value.is_plain() {
                            check!(self.charge_answer(state, keep, builtin, &value));
                        }
                        put!(to, value);
                    }
                }
                Op::Host { to, constant, args } => {
                    gather!(args);
                    for value in &self.buffer {
                        check!(value.refuse_futures("passed to code outside of the model"));
                    }
                    let value = check!(answers.host(constant, &self.buffer, &mut state.steps));
                    put!(to, charged!(value));
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
                        check!(Err(Fault::new("type-mismatch", "the counter of a loop is not an int")))
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
                        let name = readable(&f.names[name as usize]);
                        check!(Err(Fault::new(
                            "unassigned-variable",
                            format!("the variable `{name}` is read before it is assigned")
                        )));
                    }
                }
                Op::Clear { from, to } => {
                    if K::KEEPS {
                        keep.clear(self, state, node, from, to);
                    }
                }
                Op::Return { a } => {
                    let value = get!(a).clone();
                    if let Some(call) = self.pure.pop() {
                        id = call.caller;
                        f = program.function(id);
                        code = &f.code;
                        scratch = call.scratch;
                        pc = call.pc;
                        let value = if call.as_future { Value::returned(value) } else { value };
                        put!(call.to, value);
                        continue;
                    }
                    if !K::KEEPS {
                        self.leave(state, answers, node);
                    }
                    let next = if K::KEEPS {
                        keep.give_back(self, state, node, value).place()
                    } else {
                        self.give_back(state, future, node, value)
                    };
                    match next {
                        Some((parent, next)) => enter!(parent, next),
                        None => {
                            if K::KEEPS {
                                keep.count(executed);
                            }
                            return Ok(Stop::Returned);
                        }
                    }
                }
                Op::ReturnIteration { exit: kind, args } => {
                    let kind = i64::from(kind);
                    if K::KEEPS {
                        match check!(keep.end_iteration(self, state, r!(), node, kind, args)).place() {
                            Some((next, at)) => {
                                step!();
                                enter!(next, at);
                            }
                            None => {
                                keep.count(executed);
                                return Ok(Stop::Returned);
                            }
                        }
                    }
                    self.leave(state, answers, node);
                    if kind == exit::NEXT && check!(self.next_iteration(state, r!(), node, args)) {
                        step!();
                        pc = 0;
                        continue;
                    }
                    gather!(args);
                    self.leave(state, answers, state.nodes[node.0 as usize].parent);
                    match self.end_loop(state, future, node, kind) {
                        Some((parent, next)) => enter!(parent, next),
                        None => return Ok(Stop::Returned),
                    }
                }
                Op::Pass { site, arg } => {
                    if K::KEEPS {
                        keep.at(pc);
                        if let Continuation::Enter(inner, at) = keep.pass(self, state, r!(), node, site, arg)
                        {
                            step!();
                            enter!(inner, at);
                        }
                    }
                }
                Op::Done => {
                    if K::KEEPS {
                        if let Some((next, at)) = check!(keep.done(self, state, node)).place() {
                            let (this, that) = (&state.nodes[node.0 as usize], &state.nodes[next.0 as usize]);
                            if that.parent == this.parent && that.function == id {
                                // The next iteration has the same code below the same loop.
                                (node, pc, base) = (next, at as usize, that.registers as usize);
                                keep.enter(state, node);
                                continue;
                            }
                            enter!(next, at);
                        }
                        keep.count(executed);
                        return Ok(Stop::Returned);
                    }
                }
                Op::Unpack { from, to } => {
                    // Most unpacked values are pairs of numbers.
                    if let Value::Tuple(tuple) = get!(from)
                        && let [Value::Real(x), Value::Real(y)] = tuple.items()
                        && let [a, b] = f.operands[to.range()]
                        && !(K::KEEPS && (a.is_node() || b.is_node()))
                    {
                        let (x, y) = (*x, *y);
                        r!().slot(state, &mut self.scratch, a).store_real(x);
                        r!().slot(state, &mut self.scratch, b).store_real(y);
                    } else {
                        check!(self.construct(state, keep, r!(), code[pc]));
                    }
                }
                op => check!(self.construct(state, keep, r!(), op)),
            }
            pc += 1;
        }
    }

    /// Reserves scratch registers, and returns whether the run must be charged for more than before.
    #[inline]
    pub(super) fn reserve(&mut self, registers: usize) -> bool {
        self.high < registers && self.grow_scratch(registers)
    }

    #[inline(never)]
    fn grow_scratch(&mut self, registers: usize) -> bool {
        self.high = registers;
        let len = self.scratch.len();
        if len < registers {
            make_room(&mut self.scratch, registers - len, || self.limits.bytes);
            make_room(&mut self.pure, 1, || self.limits.bytes);
            self.scratch.resize(registers.max(64), Value::None);
        }
        registers > budget::SCRATCH
    }
}

//! The instructions that have machine code.

use super::calls::{self, NOT};
use super::kinds::{Form, Kind, Made};
use super::words;
use super::write::{ARGUMENTS, Call, Got, Now, Number, PLAIN, Then, Typed, Writer};
use crate::builtins::builtin;
use crate::code::{Args, Binary, FunctionId, Op, Operand};
use crate::value::{Value as Model, index};
use niwaki_native::codegen::ir::condcodes::{FloatCC, IntCC};
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{InstBuilder, Value};

/// Whole numbers up to this size are real numbers without loss.
const EXACT: i64 = 1 << 53;

/// Most calls of pure functions inside each other that a routine follows.
const DEPTH: usize = 6;

impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    /// Writes one instruction. What cannot be done is found before any register is written.
    pub(super) fn instruction(&mut self, now: &mut Now<'v>, pc: usize) -> Then {
        let f = self.f(now);
        self.carry_out(now, pc, f.code[pc]).unwrap_or(Then::Leave)
    }

    fn carry_out(&mut self, now: &mut Now<'v>, pc: usize, op: Op) -> Option<Then> {
        match op {
            Op::Move { to, from } => {
                let Got { typed, sample } = self.get(now, from)?;
                if matches!(typed, Typed::Opaque) {
                    return None;
                }
                self.put(now, to, typed, sample);
            }
            Op::Add { to, a, b } => return self.binary(now, pc, Binary::Add, to, (a, b)),
            Op::Sub { to, a, b } => return self.binary(now, pc, Binary::Sub, to, (a, b)),
            Op::Mul { to, a, b } => return self.binary(now, pc, Binary::Mul, to, (a, b)),
            Op::Div { to, a, b } => return self.binary(now, pc, Binary::Div, to, (a, b)),
            Op::Binary { op, to, a, b } => return self.binary(now, pc, op, to, (a, b)),
            Op::Neg { to, a } => {
                let typed = match self.get(now, a)?.typed {
                    Typed::Real(x) => Typed::Real(self.b.ins().fneg(x)),
                    Typed::Int(n) => {
                        let least = self.b.ins().icmp_imm_s(IntCC::Equal, n, i64::MIN);
                        self.leave_if(now, pc, least);
                        Typed::Int(self.b.ins().ineg(n))
                    }
                    other => self.negated(now, pc, other)?,
                };
                self.put(now, to, typed, None);
            }
            Op::Not { to, a } => {
                let got = self.get(now, a)?;
                let holds = self.truth(got.typed)?;
                let not = self.b.ins().icmp_imm_s(IntCC::Equal, holds, 0);
                let not = self.b.ins().uextend(I64, not);
                self.put(now, to, Typed::Bool(not), None);
            }
            Op::Jump { target } => {
                self.jump(now, pc, target as usize);
                return Some(Then::Ended);
            }
            Op::JumpIf { a, target } => {
                let got = self.get(now, a)?;
                let holds = self.truth(got.typed)?;
                self.branch(now, pc, holds, true, target as usize);
            }
            Op::JumpUnless { a, target } => {
                let got = self.get(now, a)?;
                let holds = self.truth(got.typed)?;
                self.branch(now, pc, holds, false, target as usize);
            }
            Op::JumpUnlessCompare { op, a, b, target } => {
                let (a, b) = (self.get(now, a)?.typed, self.get(now, b)?.typed);
                let holds = self.compare(now, pc, op, a, b)?;
                self.branch(now, pc, holds, false, target as usize);
            }
            Op::Length { to, a } => return self.length_of_operand(now, pc, to, a),
            Op::Next { to, over, index, length, target } => {
                return self.next(now, pc, to, over, index, length, target as usize);
            }
            Op::Tuple { to, args } => {
                let operands = &self.f(now).operands[args.range()];
                if !(1..=4).contains(&operands.len()) {
                    return None;
                }
                let numbers: Vec<Number> =
                    operands.iter().map(|o| self.get(now, *o)?.typed.number()).collect::<Option<_>>()?;
                let typed = self.make(now, pc, Made::Tuple, &numbers);
                self.put(now, to, typed, None);
            }
            Op::Field { to, a, name } => {
                let typed = self.get(now, a)?.typed;
                let name_of = &self.f(now).names[name as usize];
                if let Some(at) = ["x", "y", "z", "w"].iter().position(|own| *own == &**name_of)
                    && !matches!(typed, Typed::Fresh { made: Made::Tuple, .. })
                    && let Some(part) = self.part(typed, at)
                {
                    self.put(now, to, part, None);
                    return Some(Then::Next);
                }
                let Got { typed: Typed::Object(object, _), sample: Some(sample) } = self.get(now, a)? else {
                    return None;
                };
                let name = &self.f(now).names[name as usize];
                let like = match sample {
                    Model::Record(record) => Like::of(record.field(name)?),
                    _ => return None,
                };
                let name = self.keep_name(name);
                let typed = self.ask(now, pc, calls::field as *const u8, &[object, name], like)?;
                self.put(now, to, typed, like.sample);
            }
            Op::Unpack { from, to } => return self.unpack(now, pc, from, to),
            Op::CheckSet { a, .. } => {
                if matches!(self.get(now, a)?.typed, Typed::Unset) {
                    return None;
                }
            }
            Op::Builtin { to, id, args } => return self.builtin(now, pc, to, id, args),
            Op::CallPure { to, function, args } => {
                return self.call(now, pc, to, FunctionId(u32::from(function)), args);
            }
            Op::Return { a } => {
                if now.calls.is_empty() {
                    return None;
                }
                let Got { typed, sample } = self.get(now, a)?;
                if matches!(typed, Typed::Opaque) {
                    return None;
                }
                now.count();
                let call = now.calls.pop()?;
                (now.function, now.base) = (call.caller, call.base);
                self.put(now, call.to, typed, sample);
                self.go(now, call.back as usize);
                return Some(Then::Ended);
            }
            _ => return None,
        }
        Some(Then::Next)
    }

    /// Jumps where a condition holds (or does not), and goes on with the next instruction elsewhere.
    fn branch(&mut self, now: &mut Now<'v>, pc: usize, holds: Value, when: bool, target: usize) {
        let (taken, on) = (self.b.create_block(), self.b.create_block());
        let (yes, no) = if when { (taken, on) } else { (on, taken) };
        self.b.ins().brif(holds, yes, &[], no, &[]);
        self.b.switch_to_block(taken);
        self.jump(&mut now.clone(), pc, target);
        self.b.switch_to_block(on);
    }

    /// Python's truth of a plain value.
    fn truth(&mut self, typed: Typed) -> Option<Value> {
        Some(match typed {
            Typed::Bool(x) => x,
            Typed::Int(n) => self.b.ins().icmp_imm_s(IntCC::NotEqual, n, 0),
            Typed::Real(x) => {
                let zero = self.b.ins().f64const(0.0);
                self.b.ins().fcmp(FloatCC::NotEqual, x, zero)
            }
            Typed::None => self.int(0),
            // It has parts.
            Typed::Fresh { made: Made::Vector | Made::Tuple, .. } => self.int(1),
            _ => return None,
        })
    }

    /// A number as a real one.
    pub(super) fn real(&mut self, typed: Typed) -> Option<Value> {
        match typed {
            Typed::Real(x) => Some(x),
            Typed::Int(n) => Some(self.b.ins().fcvt_from_sint(F64, n)),
            _ => None,
        }
    }

    fn binary(
        &mut self,
        now: &mut Now<'v>,
        pc: usize,
        op: Binary,
        to: Operand,
        (a, b): (Operand, Operand),
    ) -> Option<Then> {
        let (x, y) = (self.get(now, a)?, self.get(now, b)?);
        let typed = match op {
            Binary::Add | Binary::Sub | Binary::Mul | Binary::Div => {
                match self.arithmetic(now, pc, op, x.typed, y.typed) {
                    Some(typed) => typed,
                    None => self.of_vectors(now, pc, op, x.typed, y.typed)?,
                }
            }
            Binary::Mod | Binary::FloorDiv | Binary::Pow => match (x.typed, y.typed) {
                (Typed::Int(x), Typed::Int(y)) if op != Binary::Pow => self.divide(now, pc, op, x, y),
                (Typed::Int(n), Typed::Int(_)) if op == Binary::Pow && self.is_two(now, b) => {
                    self.arithmetic(now, pc, Binary::Mul, Typed::Int(n), Typed::Int(n))?
                }
                (x, y) => {
                    let name = match op {
                        Binary::Mod => "mod",
                        Binary::FloorDiv => "floordiv",
                        _ => "pow",
                    };
                    let kind =
                        if x.kind() == Kind::Int && y.kind() == Kind::Int { Kind::Int } else { Kind::Real };
                    let id = crate::builtins::builtin_id(name)?;
                    self.call_builtin(now, pc, id, &[x, y], kind)?
                }
            },
            Binary::Index => {
                if Self::count_of_parts(x.typed).is_some() {
                    let at = now.constant_int(self.f(now), b)?;
                    let part = self.part(x.typed, usize::try_from(at).ok()?)?;
                    self.put(now, to, part, None);
                    return Some(Then::Next);
                }
                let (Typed::Object(object, _), Typed::Int(at)) = (x.typed, y.typed) else { return None };
                let place = match now.constant_int(self.f(now), b) {
                    Some(at) => usize::try_from(at).ok()?,
                    None => 0,
                };
                let like = Like::element(x.sample?, place)?;
                let typed = self.ask(now, pc, calls::element as *const u8, &[object, at], like)?;
                self.put(now, to, typed, like.sample);
                return Some(Then::Next);
            }
            Binary::In => return None,
            _ => {
                let holds = self.compare(now, pc, op, x.typed, y.typed)?;
                Typed::Bool(self.b.ins().uextend(I64, holds))
            }
        };
        self.put(now, to, typed, None);
        Some(Then::Next)
    }

    fn is_two(&self, now: &Now<'v>, o: Operand) -> bool {
        now.constant_int(self.f(now), o) == Some(2)
    }

    fn arithmetic(&mut self, now: &Now<'v>, pc: usize, op: Binary, a: Typed, b: Typed) -> Option<Typed> {
        if let (Typed::Int(a), Typed::Int(b)) = (a, b) {
            return Some(self.whole(now, pc, op, a, b));
        }
        let (a, b) = (self.real(a)?, self.real(b)?);
        Some(Typed::Real(match op {
            Binary::Add => self.b.ins().fadd(a, b),
            Binary::Sub => self.b.ins().fsub(a, b),
            Binary::Mul => self.b.ins().fmul(a, b),
            _ => {
                self.leave_if_zero(now, pc, b);
                self.b.ins().fdiv(a, b)
            }
        }))
    }

    /// Arithmetic of whole numbers: leaves where the result has no 64 bits.
    fn whole(&mut self, now: &Now<'v>, pc: usize, op: Binary, a: Value, b: Value) -> Typed {
        match op {
            Binary::Add | Binary::Sub => {
                // It overflows where the result's sign is not the one that both operands ask for.
                let (result, other) = if op == Binary::Add {
                    (self.b.ins().iadd(a, b), self.b.ins().bxor(a, b))
                } else {
                    let other = self.b.ins().bxor(a, b);
                    (self.b.ins().isub(a, b), self.b.ins().bnot(other))
                };
                let turned = self.b.ins().bxor(a, result);
                let over = self.b.ins().band_not(turned, other);
                let over = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, over, 0);
                self.leave_if(now, pc, over);
                Typed::Int(result)
            }
            Binary::Mul => {
                let (low, high) = (self.b.ins().imul(a, b), self.b.ins().smulhi(a, b));
                let sign = self.b.ins().sshr_imm_s(low, 63);
                let over = self.b.ins().icmp(IntCC::NotEqual, high, sign);
                self.leave_if(now, pc, over);
                Typed::Int(low)
            }
            _ => {
                let zero = self.b.ins().icmp_imm_s(IntCC::Equal, b, 0);
                self.leave_if(now, pc, zero);
                for n in [a, b] {
                    self.leave_unless_exact(now, pc, n);
                }
                let (a, b) = (self.b.ins().fcvt_from_sint(F64, a), self.b.ins().fcvt_from_sint(F64, b));
                Typed::Real(self.b.ins().fdiv(a, b))
            }
        }
    }

    /// Leaves where a whole number is no real one without loss.
    fn leave_unless_exact(&mut self, now: &Now<'v>, pc: usize, n: Value) {
        let shifted = self.b.ins().iadd_imm_s(n, EXACT);
        let large = self.b.ins().icmp_imm_s(IntCC::UnsignedGreaterThan, shifted, 2 * EXACT);
        self.leave_if(now, pc, large);
    }

    /// Quotient or remainder of whole numbers, rounded down. Leaves unless the divisor is positive.
    fn divide(&mut self, now: &Now<'v>, pc: usize, op: Binary, a: Value, b: Value) -> Typed {
        let refused = self.b.ins().icmp_imm_s(IntCC::SignedLessThanOrEqual, b, 0);
        self.leave_if(now, pc, refused);
        let rest = self.b.ins().srem(a, b);
        let below = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, rest, 0);
        Typed::Int(if op == Binary::Mod {
            let raised = self.b.ins().iadd(rest, b);
            self.b.ins().select(below, raised, rest)
        } else {
            let quotient = self.b.ins().sdiv(a, b);
            let below = self.b.ins().uextend(I64, below);
            self.b.ins().isub(quotient, below)
        })
    }

    /// The truth of a comparison, in eight bits.
    fn compare(&mut self, now: &Now<'v>, pc: usize, op: Binary, a: Typed, b: Typed) -> Option<Value> {
        let reals = match op {
            Binary::Eq => FloatCC::Equal,
            Binary::Ne => FloatCC::NotEqual,
            Binary::Lt => FloatCC::LessThan,
            Binary::Le => FloatCC::LessThanOrEqual,
            Binary::Gt => FloatCC::GreaterThan,
            Binary::Ge => FloatCC::GreaterThanOrEqual,
            _ => return None,
        };
        let wholes = match op {
            Binary::Eq => IntCC::Equal,
            Binary::Ne => IntCC::NotEqual,
            Binary::Lt => IntCC::SignedLessThan,
            Binary::Le => IntCC::SignedLessThanOrEqual,
            Binary::Gt => IntCC::SignedGreaterThan,
            _ => IntCC::SignedGreaterThanOrEqual,
        };
        Some(match (a, b) {
            (Typed::Int(a), Typed::Int(b)) => self.b.ins().icmp(wholes, a, b),
            (Typed::Bool(a), Typed::Bool(b)) => self.b.ins().icmp(wholes, a, b),
            (Typed::Real(a), Typed::Real(b)) => self.b.ins().fcmp(reals, a, b),
            (Typed::Int(n), Typed::Real(x)) => {
                self.leave_unless_exact(now, pc, n);
                let n = self.b.ins().fcvt_from_sint(F64, n);
                self.b.ins().fcmp(reals, n, x)
            }
            (Typed::Real(x), Typed::Int(n)) => {
                self.leave_unless_exact(now, pc, n);
                let n = self.b.ins().fcvt_from_sint(F64, n);
                self.b.ins().fcmp(reals, x, n)
            }
            _ => return None,
        })
    }

    fn length_of_operand(&mut self, now: &mut Now<'v>, pc: usize, to: Operand, a: Operand) -> Option<Then> {
        let typed = self.get(now, a)?.typed;
        let n = match (Self::count_of_parts(typed), typed) {
            (Some(n), _) => self.int(n as i64),
            (None, Typed::Fresh { parts, .. }) => {
                let given: Vec<Value> = parts.iter().flatten().map(|part| part.value()).collect();
                self.call_address(calls::range_length as *const u8, &given, I64)
            }
            (None, Typed::Object(object, _) | Typed::Range { object, .. }) => self.length(now, pc, object),
            _ => return None,
        };
        self.put(now, to, Typed::Int(n), None);
        Some(Then::Next)
    }

    /// How many elements a loop over an object visits.
    fn length(&mut self, now: &Now<'v>, pc: usize, object: Value) -> Value {
        let n = self.call_address(calls::length as *const u8, &[object], I64);
        let none = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, n, 0);
        self.leave_if(now, pc, none);
        n
    }

    #[allow(clippy::too_many_arguments)] // the operands of one instruction
    fn next(
        &mut self,
        now: &mut Now<'v>,
        pc: usize,
        to: Operand,
        over: Operand,
        index: Operand,
        length: Operand,
        target: usize,
    ) -> Option<Then> {
        let (Typed::Int(i), Typed::Int(n)) = (self.get(now, index)?.typed, self.get(now, length)?.typed)
        else {
            return None;
        };
        let got = self.get(now, over)?;
        let like = match got.typed {
            Typed::Range { .. } | Typed::Fresh { made: Made::Range, .. } => Like::INT,
            Typed::Object(_, Form::List | Form::Tuple | Form::Vector2 | Form::Vector3 | Form::Vector4) => {
                Like::element(got.sample?, 0).unwrap_or(Like::REAL)
            }
            _ => return None,
        };
        let ended = self.b.ins().icmp(IntCC::SignedGreaterThanOrEqual, i, n);
        self.branch(now, pc, ended, true, target);
        let typed = match got.typed {
            Typed::Range { first, step, .. } => {
                let far = self.b.ins().imul(step, i);
                Typed::Int(self.b.ins().iadd(first, far))
            }
            Typed::Fresh { parts: [Some(Number::Int(first)), _, Some(Number::Int(step)), _], .. } => {
                let far = self.b.ins().imul(step, i);
                Typed::Int(self.b.ins().iadd(first, far))
            }
            Typed::Object(object, _) => self.ask(now, pc, calls::element as *const u8, &[object, i], like)?,
            _ => return None,
        };
        self.put(now, to, typed, like.sample);
        let i = self.b.ins().iadd_imm_s(i, 1);
        self.put(now, index, Typed::Int(i), None);
        Some(Then::Next)
    }

    fn unpack(&mut self, now: &mut Now<'v>, pc: usize, from: Operand, to: Args) -> Option<Then> {
        let names = &self.f(now).operands[to.range()];
        let typed = self.get(now, from)?.typed;
        if let Some(n) = Self::count_of_parts(typed) {
            if n != names.len() {
                return None;
            }
            let parts: Vec<Typed> = (0..n).map(|k| self.part(typed, k)).collect::<Option<_>>()?;
            for (o, part) in names.iter().zip(parts) {
                self.put(now, *o, part, None);
            }
            return Some(Then::Next);
        }
        let Got { typed: Typed::Object(object, Form::Tuple), sample: Some(sample) } = self.get(now, from)?
        else {
            return None;
        };
        let likes: Vec<Like<'v>> =
            (0..names.len()).map(|k| Like::element(sample, k)).collect::<Option<_>>()?;
        let n = self.length(now, pc, object);
        let other = self.b.ins().icmp_imm_s(IntCC::NotEqual, n, names.len() as i64);
        self.leave_if(now, pc, other);
        let mut all = vec![];
        for (k, like) in likes.iter().enumerate() {
            let at = self.int(k as i64);
            all.push(self.ask(now, pc, calls::element as *const u8, &[object, at], *like)?);
        }
        for ((o, typed), like) in names.iter().zip(all).zip(likes) {
            self.put(now, *o, typed, like.sample);
        }
        Some(Then::Next)
    }

    /// Goes on in a pure function.
    fn call(
        &mut self,
        now: &mut Now<'v>,
        pc: usize,
        to: Operand,
        function: FunctionId,
        args: Args,
    ) -> Option<Then> {
        let f = self.f(now);
        let callee = self.program.function(function);
        let recurs = function == now.function || now.calls.iter().any(|call| call.caller == function);
        if recurs || now.calls.len() >= DEPTH {
            return None;
        }
        let operands = &f.operands[args.range()];
        let given: Vec<Got<'v>> = operands.iter().map(|o| self.get(now, *o)).collect::<Option<_>>()?;
        if given.iter().any(|got| matches!(got.typed, Typed::Opaque)) {
            return None;
        }
        let base = now.base + u32::from(f.scratch_registers);
        let end = base + u32::from(callee.scratch_registers);
        let room = self.word(words::ROOM);
        let deeper = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, room, i64::from(end));
        self.leave_if(now, pc, deeper);
        self.take_step(now, pc);
        now.count();
        now.calls.push(Call { caller: now.function, base: now.base, back: pc as u32 + 1, to });
        (now.function, now.base) = (function, base);
        for (k, Got { typed, sample }) in given.into_iter().enumerate() {
            let parameter = Operand::new(crate::code::Place::Scratch, k);
            self.put(now, parameter, typed, sample);
        }
        self.go(now, 0);
        Some(Then::Ended)
    }

    /// Asks a called function for a value like another; leaves where it is not like it.
    fn ask(
        &mut self,
        now: &Now<'v>,
        pc: usize,
        function: *const u8,
        given: &[Value],
        like: Like<'_>,
    ) -> Option<Typed> {
        let out = self.answer();
        let mark = self.call_address(function, &[given, &[out]].concat(), I64);
        self.answered(now, pc, mark, like.kind)
    }

    /// The answer of a called function that gave a mark.
    fn answered(&mut self, now: &Now<'v>, pc: usize, mark: Value, kind: Kind) -> Option<Typed> {
        debug_assert_ne!(kind.mark(), NOT);
        let other = self.b.ins().icmp_imm_s(IntCC::NotEqual, mark, kind.mark().cast_signed());
        self.leave_if(now, pc, other);
        let out = self.answer();
        Some(match kind {
            Kind::None => Typed::None,
            Kind::Real => Typed::Real(self.b.ins().load(F64, PLAIN, out, 0)),
            Kind::Int => Typed::Int(self.b.ins().load(I64, PLAIN, out, 0)),
            Kind::Bool => Typed::Bool(self.b.ins().load(I64, PLAIN, out, 0)),
            Kind::Object(form) => Typed::Object(self.b.ins().load(I64, PLAIN, out, 0), form),
            Kind::Range | Kind::Unset | Kind::Opaque | Kind::Fresh { .. } => return None,
        })
    }

    fn builtin(&mut self, now: &mut Now<'v>, pc: usize, to: Operand, id: u16, args: Args) -> Option<Then> {
        let operands = &self.f(now).operands[args.range()];
        let given: Vec<Typed> =
            operands.iter().map(|o| self.get(now, *o).map(|got| got.typed)).collect::<Option<_>>()?;
        let name = builtin::<f64>(id).name;
        let typed = if let ("len", [one]) = (name, operands) {
            return self.length_of_operand(now, pc, to, *one);
        } else if let Some(typed) = self.quick(now, pc, name, &given) {
            typed
        } else if let ("range", Some(typed)) = (name, self.range(now, pc, &given)) {
            typed
        } else if let Some(typed) = self.vector_function(now, pc, name, &given) {
            typed
        } else {
            let kind = kind_of_answer(name, &given)?;
            self.call_builtin(now, pc, id, &given, kind)?
        };
        self.put(now, to, typed, None);
        Some(Then::Next)
    }

    /// A built-in function that is a few instructions, or one call.
    fn quick(&mut self, now: &Now<'v>, pc: usize, name: &str, given: &[Typed]) -> Option<Typed> {
        match (name, given) {
            ("sqrt", [x]) => {
                let x = self.real(*x)?;
                let root = self.b.ins().sqrt(x);
                self.leave_unless_finite(now, pc, root);
                Some(Typed::Real(root))
            }
            ("abs", [Typed::Real(x)]) => Some(Typed::Real(self.b.ins().fabs(*x))),
            ("float", [x]) => Some(Typed::Real(self.real(*x)?)),
            ("int" | "floor" | "ceil" | "trunc" | "round", [Typed::Int(n)]) => Some(Typed::Int(*n)),
            ("int" | "floor" | "ceil" | "trunc" | "round", [Typed::Real(x)]) => {
                let whole = match name {
                    "floor" => self.b.ins().floor(*x),
                    "ceil" => self.b.ins().ceil(*x),
                    "round" => self.b.ins().nearest(*x),
                    _ => self.b.ins().trunc(*x),
                };
                let size = self.b.ins().fabs(whole);
                let most = self.b.ins().f64const(9.0e18);
                let fits = self.b.ins().fcmp(FloatCC::LessThan, size, most);
                let refused = self.b.ins().icmp_imm_s(IntCC::Equal, fits, 0);
                self.leave_if(now, pc, refused);
                Some(Typed::Int(self.b.ins().fcvt_to_sint_sat(I64, whole)))
            }
            ("min" | "max", [Typed::Real(a), Typed::Real(b)]) => {
                let (less, more) = if name == "min" { (*b, *a) } else { (*a, *b) };
                let second = self.b.ins().fcmp(FloatCC::LessThan, less, more);
                Some(Typed::Real(self.b.ins().select(second, *b, *a)))
            }
            ("min" | "max", [Typed::Int(a), Typed::Int(b)]) => {
                let (less, more) = if name == "min" { (*b, *a) } else { (*a, *b) };
                let second = self.b.ins().icmp(IntCC::SignedLessThan, less, more);
                Some(Typed::Int(self.b.ins().select(second, *b, *a)))
            }
            ("clip", [Typed::Real(x), Typed::Real(low), Typed::Real(high)]) => {
                let above = self.b.ins().fcmp(FloatCC::LessThan, *high, *x);
                let clipped = self.b.ins().select(above, *high, *x);
                let below = self.b.ins().fcmp(FloatCC::LessThan, *x, *low);
                Some(Typed::Real(self.b.ins().select(below, *low, clipped)))
            }
            ("lerp", [Typed::Real(a), Typed::Real(b), Typed::Real(t)]) => {
                let wide = self.b.ins().fsub(*b, *a);
                let part = self.b.ins().fmul(wide, *t);
                Some(Typed::Real(self.b.ins().fadd(*a, part)))
            }
            ("is_none", [x]) if !matches!(x, Typed::Opaque | Typed::Unset) => {
                Some(Typed::Bool(self.int(i64::from(matches!(x, Typed::None)))))
            }
            (name, [x]) => {
                let function = calls::real_function(name)?;
                let x = self.real(*x)?;
                let y = self.call_address(function, &[x], F64);
                self.leave_unless_finite(now, pc, y);
                Some(Typed::Real(y))
            }
            _ => None,
        }
    }

    /// A range; leaves where there is none.
    fn range(&mut self, now: &mut Now<'v>, pc: usize, given: &[Typed]) -> Option<Typed> {
        let (zero, one) = (self.int(0), self.int(1));
        let parts = match *given {
            [Typed::Int(stop)] => [zero, stop, one],
            [Typed::Int(start), Typed::Int(stop)] => [start, stop, one],
            [Typed::Int(start), Typed::Int(stop), Typed::Int(step)] => [start, stop, step],
            _ => return None,
        };
        let n = self.call_address(calls::range_length as *const u8, &parts, I64);
        let refused = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, n, 0);
        self.leave_if(now, pc, refused);
        Some(self.make(now, pc, Made::Range, &parts.map(Number::Int)))
    }

    fn leave_unless_finite(&mut self, now: &Now<'v>, pc: usize, x: Value) {
        let size = self.b.ins().fabs(x);
        let infinite = self.b.ins().f64const(f64::INFINITY);
        let is_finite = self.b.ins().fcmp(FloatCC::LessThan, size, infinite);
        let refused = self.b.ins().icmp_imm_s(IntCC::Equal, is_finite, 0);
        self.leave_if(now, pc, refused);
    }

    /// Calls a built-in function of plain values that is expected to give that kind.
    fn call_builtin(
        &mut self,
        now: &Now<'v>,
        pc: usize,
        id: u16,
        given: &[Typed],
        kind: Kind,
    ) -> Option<Typed> {
        if given.len() > ARGUMENTS as usize {
            return None;
        }
        let args = self.arguments();
        for (k, typed) in given.iter().enumerate() {
            let at = 16 * k as i32;
            match typed {
                Typed::Bool(x) | Typed::Int(x) | Typed::Real(x) => {
                    self.b.ins().store(PLAIN, *x, args, at + 8);
                }
                Typed::None => {}
                _ => return None,
            }
            let mark = self.int(typed.kind().mark().cast_signed());
            self.b.ins().store(PLAIN, mark, args, at);
        }
        let (id, n, out) = (self.int(i64::from(id)), self.int(given.len() as i64), self.answer());
        let mark = self.call_address(calls::call as *const u8, &[id, args, n, out], I64);
        self.answered(now, pc, mark, kind)
    }
}

/// The kind of what a built-in function of plain values is expected to give. It is only a guess: the code looks.
fn kind_of_answer(name: &str, given: &[Typed]) -> Option<Kind> {
    let all = |kind: Kind| given.iter().all(|typed| typed.kind() == kind);
    if !given.iter().all(|typed| matches!(typed.kind(), Kind::Real | Kind::Int | Kind::Bool | Kind::None)) {
        return None;
    }
    Some(match name {
        "sqrt" | "exp" | "log" | "log2" | "log10" | "log1p" | "expm1" | "sin" | "cos" | "tan" | "asin"
        | "acos" | "atan" | "atan2" | "sinh" | "cosh" | "tanh" | "hypot" | "fabs" | "degrees" | "radians"
        | "copysign" | "fmod" | "math_pow" | "lgamma" | "erf" | "softeq" | "soft_at_least"
        | "soft_at_most" | "smooth_max" | "smooth_min" | "smooth_abs" | "float" | "div" => Kind::Real,
        "int" | "floor" | "ceil" | "trunc" | "sign" | "gcd" | "factorial" | "comb" | "band" | "bor"
        | "bxor" | "invert" | "shl" | "shr" => Kind::Int,
        "round" => {
            if given.len() == 1 {
                Kind::Int
            } else {
                Kind::Real
            }
        }
        "bool" | "not" | "eq" | "ne" | "lt" | "le" | "gt" | "ge" | "is_none" | "isfinite" | "isnan"
        | "isinf" => Kind::Bool,
        "add" | "sub" | "mul" | "floordiv" | "mod" | "pow" | "neg" | "pos" | "abs" | "min" | "max"
        | "lerp" | "clip" => {
            if all(Kind::Int) {
                Kind::Int
            } else {
                Kind::Real
            }
        }
        _ => return None,
    })
}

/// What a value is expected to be like.
#[derive(Clone, Copy)]
pub(super) struct Like<'v> {
    kind: Kind,
    sample: Option<&'v Model>,
}

impl<'v> Like<'v> {
    const REAL: Like<'v> = Like { kind: Kind::Real, sample: None };
    const INT: Like<'v> = Like { kind: Kind::Int, sample: None };

    fn of(sample: &'v Model) -> Like<'v> {
        Like { kind: Kind::of(sample), sample: Some(sample) }
    }

    /// As the element of a sample is.
    fn element(sample: &'v Model, at: usize) -> Option<Like<'v>> {
        match sample {
            Model::Vector(_) => Some(Like::REAL),
            _ => index::index_ref(sample, &Model::Int(at as i64)).map(Like::of),
        }
    }
}

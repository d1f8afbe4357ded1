//! The instructions that have machine code.

use super::calls::{self, NOT};
use super::typed::{Got, Number, Typed};
use super::write::{Now, PLAIN, Then, Writer};
use crate::code::kinds::{Form, Kind, Made};
use crate::code::routine::Call;
use crate::code::routine::words;
use crate::code::{Args, Binary, FunctionId, Op, Operand};
use crate::value::{Value as Model, index};
use niwaki_native::codegen::ir::condcodes::IntCC;
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{InstBuilder, Value};

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
                let Got { typed, sample } = self.get(now, a)?;
                let name = &self.f(now).names[name as usize];
                if let Some(at) = ["x", "y", "z", "w"].iter().position(|own| *own == &**name)
                    && !matches!(typed, Typed::Fresh { made: Made::Tuple, .. })
                    && let Some(part) = self.part(typed, at)
                {
                    self.put(now, to, part, None);
                    return Some(Then::Next);
                }
                let (Typed::Object(object, _), Some(Model::Record(record))) = (typed, sample) else {
                    return None;
                };
                let like = Like::of(record.field(name)?);
                let [name, length] = self.keep_name(name);
                let typed = self.ask(now, pc, calls::field as *const u8, &[object, name, length], like)?;
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

    pub(super) fn length_of_operand(
        &mut self,
        now: &mut Now<'v>,
        pc: usize,
        to: Operand,
        a: Operand,
    ) -> Option<Then> {
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
    pub(super) fn answered(&mut self, now: &Now<'v>, pc: usize, mark: Value, kind: Kind) -> Option<Typed> {
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

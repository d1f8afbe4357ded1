//! The instructions that have machine code.

use super::calls;
use super::typed::{Number, Typed, TypedOperand};
use super::write::{Cursor, PLAIN, Progress, Writer};
use crate::code::register::{Form, FreshForm, Kind};
use crate::code::routine::{Call, Exchange, NO_ANSWER};
use crate::code::{Args, Binary, FunctionId, Op, Operand};
use crate::value::{Value as Model, index};
use niwaki_native::codegen::ir::condcodes::IntCC;
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{InstBuilder, Value};
use std::mem::offset_of;

/// The most nested calls of pure functions that a routine follows.
const MAX_DEPTH: usize = 6;

impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    /// Writes one instruction. Every reason to refuse an instruction is found before a register is written.
    pub(super) fn instruction(&mut self, cursor: &mut Cursor<'v>, pc: usize) -> Progress {
        let f = self.f(cursor);
        self.write_instruction(cursor, pc, f.code[pc]).unwrap_or(Progress::Leave)
    }

    fn write_instruction(&mut self, cursor: &mut Cursor<'v>, pc: usize, op: Op) -> Option<Progress> {
        match op {
            Op::Move { to, from } => {
                let TypedOperand { typed, sample } = self.get(cursor, from)?;
                if matches!(typed, Typed::Opaque) {
                    return None;
                }
                self.put(cursor, to, typed, sample);
            }
            Op::Add { to, a, b } => return self.binary(cursor, pc, Binary::Add, to, (a, b)),
            Op::Sub { to, a, b } => return self.binary(cursor, pc, Binary::Sub, to, (a, b)),
            Op::Mul { to, a, b } => return self.binary(cursor, pc, Binary::Mul, to, (a, b)),
            Op::Div { to, a, b } => return self.binary(cursor, pc, Binary::Div, to, (a, b)),
            Op::Binary { op, to, a, b } => return self.binary(cursor, pc, op, to, (a, b)),
            Op::Neg { to, a } => {
                let typed = match self.get(cursor, a)?.typed {
                    Typed::Real(x) => Typed::Real(self.b.ins().fneg(x)),
                    Typed::Int(n) => {
                        let least = self.b.ins().icmp_imm_s(IntCC::Equal, n, i64::MIN);
                        self.leave_if(cursor, pc, least);
                        Typed::Int(self.b.ins().ineg(n))
                    }
                    other => self.negated(cursor, pc, other)?,
                };
                self.put(cursor, to, typed, None);
            }
            Op::Not { to, a } => {
                let operand = self.get(cursor, a)?;
                let holds = self.truth(operand.typed)?;
                let not = self.b.ins().icmp_imm_s(IntCC::Equal, holds, 0);
                let not = self.b.ins().uextend(I64, not);
                self.put(cursor, to, Typed::Bool(not), None);
            }
            Op::Jump { target } => {
                self.jump(cursor, pc, target as usize);
                return Some(Progress::Ended);
            }
            Op::JumpIf { a, target } => {
                let operand = self.get(cursor, a)?;
                let holds = self.truth(operand.typed)?;
                self.branch(cursor, pc, holds, true, target as usize);
            }
            Op::JumpUnless { a, target } => {
                let operand = self.get(cursor, a)?;
                let holds = self.truth(operand.typed)?;
                self.branch(cursor, pc, holds, false, target as usize);
            }
            Op::JumpUnlessCompare { op, a, b, target } => {
                let (a, b) = (self.get(cursor, a)?.typed, self.get(cursor, b)?.typed);
                let holds = self.compare(cursor, pc, op, a, b)?;
                self.branch(cursor, pc, holds, false, target as usize);
            }
            Op::Length { to, a } => return self.length_of_operand(cursor, pc, to, a),
            Op::Next { to, over, index, length, target } => {
                return self.next(cursor, pc, to, over, index, length, target as usize);
            }
            Op::Tuple { to, args } => {
                let operands = &self.f(cursor).operands[args.range()];
                if !(1..=4).contains(&operands.len()) {
                    return None;
                }
                let numbers: Vec<Number> =
                    operands.iter().map(|o| self.get(cursor, *o)?.typed.number()).collect::<Option<_>>()?;
                let typed = self.make(cursor, pc, FreshForm::Tuple, &numbers);
                self.put(cursor, to, typed, None);
            }
            Op::Field { to, a, name } => {
                let TypedOperand { typed, sample } = self.get(cursor, a)?;
                let name = &self.f(cursor).names[name as usize];
                if let Some(at) = ["x", "y", "z", "w"].iter().position(|letter| *letter == &**name)
                    && !matches!(typed, Typed::Fresh { form: FreshForm::Tuple, .. })
                    && let Some(part) = self.part(typed, at)
                {
                    self.put(cursor, to, part, None);
                    return Some(Progress::Next);
                }
                let (Typed::Object(object, _), Some(Model::Record(record))) = (typed, sample) else {
                    return None;
                };
                let prediction = Prediction::of(record.field(name)?);
                let [name, length] = self.keep_name(name);
                let typed =
                    self.request(cursor, pc, calls::field as *const u8, &[object, name, length], prediction)?;
                self.put(cursor, to, typed, prediction.sample);
            }
            Op::Unpack { from, to } => return self.unpack(cursor, pc, from, to),
            Op::CheckSet { a, .. } => {
                if matches!(self.get(cursor, a)?.typed, Typed::Unset) {
                    return None;
                }
            }
            Op::Builtin { to, id, args } => return self.builtin(cursor, pc, to, id, args),
            Op::CallPure { to, function, args } => {
                return self.call(cursor, pc, to, FunctionId(u32::from(function)), args);
            }
            Op::Site { site } => return self.ask(cursor, pc, site),
            // Only runs that keep their activations have something to clear, and these ask nothing.
            Op::Clear { .. } => {
                self.leave_unless_asking(cursor, pc);
                cursor.asks = true;
            }
            Op::Return { a } => {
                if cursor.calls.is_empty() {
                    return None;
                }
                let TypedOperand { typed, sample } = self.get(cursor, a)?;
                if matches!(typed, Typed::Opaque) {
                    return None;
                }
                cursor.count();
                let call = cursor.calls.pop()?;
                (cursor.function, cursor.base) = (call.caller, call.base);
                self.put(cursor, call.to, typed, sample);
                self.enter_piece(cursor, call.back as usize);
                return Some(Progress::Ended);
            }
            _ => return None,
        }
        Some(Progress::Next)
    }

    /// Jumps if a condition equals `when`, and continues with the next instruction otherwise.
    fn branch(&mut self, cursor: &mut Cursor<'v>, pc: usize, holds: Value, when: bool, target: usize) {
        let (target_block, on) = (self.b.create_block(), self.b.create_block());
        let (yes, no) = if when { (target_block, on) } else { (on, target_block) };
        self.b.ins().brif(holds, yes, &[], no, &[]);
        self.b.switch_to_block(target_block);
        self.jump(&mut cursor.clone(), pc, target);
        self.b.switch_to_block(on);
    }

    fn binary(
        &mut self,
        cursor: &mut Cursor<'v>,
        pc: usize,
        op: Binary,
        to: Operand,
        (a, b): (Operand, Operand),
    ) -> Option<Progress> {
        let (x, y) = (self.get(cursor, a)?, self.get(cursor, b)?);
        let typed = match op {
            Binary::Add | Binary::Sub | Binary::Mul | Binary::Div => {
                match self.arithmetic(cursor, pc, op, x.typed, y.typed) {
                    Some(typed) => typed,
                    None => self.vector_operation(cursor, pc, op, x.typed, y.typed)?,
                }
            }
            Binary::Mod | Binary::FloorDiv | Binary::Pow => match (x.typed, y.typed) {
                (Typed::Int(x), Typed::Int(y)) if op != Binary::Pow => self.divide(cursor, pc, op, x, y),
                (Typed::Int(n), Typed::Int(_)) if op == Binary::Pow && self.is_two(cursor, b) => {
                    self.arithmetic(cursor, pc, Binary::Mul, Typed::Int(n), Typed::Int(n))?
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
                    self.call_builtin(cursor, pc, id, &[x, y], kind)?
                }
            },
            Binary::Index => {
                if Self::count_of_parts(x.typed).is_some() {
                    let at = cursor.constant_int(self.f(cursor), b)?;
                    let part = self.part(x.typed, usize::try_from(at).ok()?)?;
                    self.put(cursor, to, part, None);
                    return Some(Progress::Next);
                }
                let (Typed::Object(object, _), Typed::Int(at)) = (x.typed, y.typed) else { return None };
                let place = match cursor.constant_int(self.f(cursor), b) {
                    Some(at) => usize::try_from(at).ok()?,
                    None => 0,
                };
                let prediction = Prediction::element(x.sample?, place)?;
                let typed =
                    self.request(cursor, pc, calls::element as *const u8, &[object, at], prediction)?;
                self.put(cursor, to, typed, prediction.sample);
                return Some(Progress::Next);
            }
            Binary::In => return None,
            _ => {
                let holds = self.compare(cursor, pc, op, x.typed, y.typed)?;
                Typed::Bool(self.b.ins().uextend(I64, holds))
            }
        };
        self.put(cursor, to, typed, None);
        Some(Progress::Next)
    }

    fn is_two(&self, cursor: &Cursor<'v>, o: Operand) -> bool {
        cursor.constant_int(self.f(cursor), o) == Some(2)
    }

    pub(super) fn length_of_operand(
        &mut self,
        cursor: &mut Cursor<'v>,
        pc: usize,
        to: Operand,
        a: Operand,
    ) -> Option<Progress> {
        let typed = self.get(cursor, a)?.typed;
        let n = match (Self::count_of_parts(typed), typed) {
            (Some(n), _) => self.int(n as i64),
            (None, Typed::Fresh { parts, .. }) => {
                let bounds: Vec<Value> = parts.iter().flatten().map(|part| part.value()).collect();
                self.call_address(calls::range_length as *const u8, &bounds, I64)
            }
            (None, Typed::Object(object, _) | Typed::Range { object, .. }) => self.length(cursor, pc, object),
            _ => return None,
        };
        self.put(cursor, to, Typed::Int(n), None);
        Some(Progress::Next)
    }

    /// The number of elements that a loop over an object visits.
    fn length(&mut self, cursor: &Cursor<'v>, pc: usize, object: Value) -> Value {
        let n = self.call_address(calls::length as *const u8, &[object], I64);
        let none = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, n, 0);
        self.leave_if(cursor, pc, none);
        n
    }

    #[allow(clippy::too_many_arguments)] // the operands of one instruction
    fn next(
        &mut self,
        cursor: &mut Cursor<'v>,
        pc: usize,
        to: Operand,
        over: Operand,
        index: Operand,
        length: Operand,
        target: usize,
    ) -> Option<Progress> {
        let (Typed::Int(i), Typed::Int(n)) =
            (self.get(cursor, index)?.typed, self.get(cursor, length)?.typed)
        else {
            return None;
        };
        let operand = self.get(cursor, over)?;
        let prediction = match operand.typed {
            Typed::Range { .. } | Typed::Fresh { form: FreshForm::Range, .. } => Prediction::INT,
            Typed::Object(_, Form::List | Form::Tuple | Form::Vector2 | Form::Vector3 | Form::Vector4) => {
                Prediction::element(operand.sample?, 0).unwrap_or(Prediction::REAL)
            }
            _ => return None,
        };
        let ended = self.b.ins().icmp(IntCC::SignedGreaterThanOrEqual, i, n);
        self.branch(cursor, pc, ended, true, target);
        let typed = match operand.typed {
            Typed::Range { first, step, .. } => {
                let far = self.b.ins().imul(step, i);
                Typed::Int(self.b.ins().iadd(first, far))
            }
            Typed::Fresh { parts: [Some(Number::Int(first)), _, Some(Number::Int(step)), _], .. } => {
                let far = self.b.ins().imul(step, i);
                Typed::Int(self.b.ins().iadd(first, far))
            }
            Typed::Object(object, _) => {
                self.request(cursor, pc, calls::element as *const u8, &[object, i], prediction)?
            }
            _ => return None,
        };
        self.put(cursor, to, typed, prediction.sample);
        let i = self.b.ins().iadd_imm_s(i, 1);
        self.put(cursor, index, Typed::Int(i), None);
        Some(Progress::Next)
    }

    fn unpack(&mut self, cursor: &mut Cursor<'v>, pc: usize, from: Operand, to: Args) -> Option<Progress> {
        let names = &self.f(cursor).operands[to.range()];
        let typed = self.get(cursor, from)?.typed;
        if let Some(n) = Self::count_of_parts(typed) {
            if n != names.len() {
                return None;
            }
            let parts: Vec<Typed> = (0..n).map(|k| self.part(typed, k)).collect::<Option<_>>()?;
            for (o, part) in names.iter().zip(parts) {
                self.put(cursor, *o, part, None);
            }
            return Some(Progress::Next);
        }
        let TypedOperand { typed: Typed::Object(object, Form::Tuple), sample: Some(sample) } =
            self.get(cursor, from)?
        else {
            return None;
        };
        let likes: Vec<Prediction<'v>> =
            (0..names.len()).map(|k| Prediction::element(sample, k)).collect::<Option<_>>()?;
        let n = self.length(cursor, pc, object);
        let other = self.b.ins().icmp_imm_s(IntCC::NotEqual, n, names.len() as i64);
        self.leave_if(cursor, pc, other);
        let mut all = vec![];
        for (k, prediction) in likes.iter().enumerate() {
            let at = self.int(k as i64);
            all.push(self.request(cursor, pc, calls::element as *const u8, &[object, at], *prediction)?);
        }
        for ((o, typed), prediction) in names.iter().zip(all).zip(likes) {
            self.put(cursor, *o, typed, prediction.sample);
        }
        Some(Progress::Next)
    }

    /// Goes on in a pure function.
    fn call(
        &mut self,
        cursor: &mut Cursor<'v>,
        pc: usize,
        to: Operand,
        function: FunctionId,
        args: Args,
    ) -> Option<Progress> {
        let f = self.f(cursor);
        let callee = self.program.function(function);
        let recurs = function == cursor.function || cursor.calls.iter().any(|call| call.caller == function);
        if recurs || cursor.calls.len() >= MAX_DEPTH {
            return None;
        }
        let operands = &f.operands[args.range()];
        let arguments: Vec<TypedOperand<'v>> =
            operands.iter().map(|o| self.get(cursor, *o)).collect::<Option<_>>()?;
        if arguments.iter().any(|operand| matches!(operand.typed, Typed::Opaque)) {
            return None;
        }
        let base = cursor.base + u32::from(f.scratch_registers);
        let end = base + u32::from(callee.scratch_registers);
        let room = offset_of!(Exchange, room) as i32;
        let room = self.b.ins().load(I64, PLAIN, self.exchange, room);
        let deeper = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, room, i64::from(end));
        self.leave_if(cursor, pc, deeper);
        self.take_step(cursor, pc);
        cursor.count();
        cursor.calls.push(Call { caller: cursor.function, base: cursor.base, back: pc as u32 + 1, to });
        (cursor.function, cursor.base) = (function, base);
        for (k, TypedOperand { typed, sample }) in arguments.into_iter().enumerate() {
            let parameter = Operand::new(crate::code::Place::Scratch, k);
            self.put(cursor, parameter, typed, sample);
        }
        self.enter_piece(cursor, 0);
        Some(Progress::Ended)
    }

    /// Calls a function for a value that is predicted; leaves if the kind of the answer is another.
    fn request(
        &mut self,
        cursor: &Cursor<'v>,
        pc: usize,
        function: *const u8,
        inputs: &[Value],
        prediction: Prediction<'_>,
    ) -> Option<Typed> {
        let out = self.answer();
        let mark = self.call_address(function, &[inputs, &[out]].concat(), I64);
        self.read_answer(cursor, pc, mark, prediction.kind)
    }

    /// Reads the answer of a called function, which returned `mark`.
    pub(super) fn read_answer(
        &mut self,
        cursor: &Cursor<'v>,
        pc: usize,
        mark: Value,
        kind: Kind,
    ) -> Option<Typed> {
        debug_assert_ne!(kind.mark(), NO_ANSWER);
        let other = self.b.ins().icmp_imm_s(IntCC::NotEqual, mark, kind.mark().cast_signed());
        self.leave_if(cursor, pc, other);
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

/// The predicted kind of a value, with a sample of it if the kind is shared data.
#[derive(Clone, Copy)]
pub(super) struct Prediction<'v> {
    kind: Kind,
    sample: Option<&'v Model>,
}

impl<'v> Prediction<'v> {
    const REAL: Prediction<'v> = Prediction { kind: Kind::Real, sample: None };
    const INT: Prediction<'v> = Prediction { kind: Kind::Int, sample: None };

    fn of(sample: &'v Model) -> Prediction<'v> {
        Prediction { kind: Kind::of(sample), sample: Some(sample) }
    }

    /// The prediction for an element, from the element of a sample.
    fn element(sample: &'v Model, at: usize) -> Option<Prediction<'v>> {
        match sample {
            Model::Vector(_) => Some(Prediction::REAL),
            _ => index::index_ref(sample, &Model::Int(at as i64)).map(Prediction::of),
        }
    }
}

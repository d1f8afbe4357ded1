//! The registers of the model as variables of Cranelift's builder.

use super::typed::{Number, Typed, TypedOperand};
use super::write::{Cursor, PLAIN, Writer};
use crate::code::register::{Kind, Part, Reg};
use crate::code::{Operand, Place};
use crate::value::Value as Model;
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{AbiParam, Inst, InstBuilder, Signature, Type, Value};
use niwaki_native::frontend::Variable;

/// The first numbers of the variables for parts: whole parts, then real parts.
const WHOLE_PARTS: u8 = 4;
const REAL_PARTS: u8 = 8;

fn part_of(k: usize, kind: Part) -> u8 {
    k as u8 + if kind == Part::Real { REAL_PARTS } else { WHOLE_PARTS }
}

impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    fn variable(&mut self, reg: Reg, part: u8) -> Variable {
        let b = &mut self.b;
        *self
            .variables
            .entry((reg, part))
            .or_insert_with(|| b.declare_var(if part == 0 || part >= REAL_PARTS { F64 } else { I64 }))
    }

    /// Sets a register's variables.
    pub(super) fn define(&mut self, reg: Reg, typed: Typed) {
        let parts: &[(u8, Value)] = match typed {
            Typed::None | Typed::Unset | Typed::Opaque => &[],
            Typed::Real(x) => &[(0, x)],
            Typed::Bool(x) | Typed::Int(x) | Typed::Object(x, _) => &[(1, x)],
            Typed::Range { object, first, step } => &[(1, object), (2, first), (3, step)],
            Typed::Fresh { parts, .. } => {
                for (k, part) in parts.into_iter().flatten().enumerate() {
                    let variable = self.variable(reg, part_of(k, part.part()));
                    self.b.def_var(variable, part.value());
                }
                &[]
            }
        };
        for (part, value) in parts {
            let variable = self.variable(reg, *part);
            self.b.def_var(variable, *value);
        }
    }

    /// The value of a register of a known kind.
    pub(super) fn typed(&mut self, reg: Reg, kind: Kind) -> Typed {
        let mut part = |part| {
            let variable = self.variable(reg, part);
            self.b.use_var(variable)
        };
        match kind {
            Kind::None => Typed::None,
            Kind::Unset => Typed::Unset,
            Kind::Opaque => Typed::Opaque,
            Kind::Bool => Typed::Bool(part(1)),
            Kind::Int => Typed::Int(part(1)),
            Kind::Real => Typed::Real(part(0)),
            Kind::Range => Typed::Range { object: part(1), first: part(2), step: part(3) },
            Kind::Object(form) => Typed::Object(part(1), form),
            Kind::Fresh { form, parts, number } => {
                let mut all = [None; 4];
                for (k, (slot, kind)) in all.iter_mut().zip(parts).enumerate() {
                    *slot = kind.map(|kind| {
                        let x = part(part_of(k, kind));
                        match kind {
                            Part::Bool => Number::Bool(x),
                            Part::Int => Number::Int(x),
                            Part::Real => Number::Real(x),
                        }
                    });
                }
                Typed::Fresh { form, parts: all, number }
            }
        }
    }

    fn reg(cursor: &Cursor<'_>, o: Operand) -> Reg {
        match o.place() {
            Place::Node => Reg::Node(o.index() as u16),
            Place::Outer => Reg::Outer(o.index() as u16),
            Place::Scratch | Place::Constant => Reg::Scratch(cursor.base + o.index() as u32),
        }
    }

    /// The value of an operand; `None` if the code knows nothing about it.
    pub(super) fn get(&mut self, cursor: &Cursor<'v>, o: Operand) -> Option<TypedOperand<'v>> {
        if o.is_constant() {
            return self.constant(cursor, o);
        }
        let reg = Self::reg(cursor, o);
        let kind = *cursor.kinds.get(&reg)?;
        self.read.insert(reg);
        Some(TypedOperand { typed: self.typed(reg, kind), sample: cursor.samples.get(&reg).copied() })
    }

    fn constant(&mut self, cursor: &Cursor<'v>, o: Operand) -> Option<TypedOperand<'v>> {
        let value: &'v Model = &self.program.function(cursor.function).constants[o.index()];
        let typed = match value {
            Model::None => Typed::None,
            Model::Bool(b) => Typed::Bool(self.int(i64::from(*b))),
            Model::Int(n) => Typed::Int(self.int(*n)),
            Model::Real(x) => Typed::Real(self.b.ins().f64const(*x)),
            other => {
                let constant = (cursor.function, o.index() as u16);
                let copy = self.constants.entry(constant).or_insert_with(|| Box::new(other.clone()));
                let object = std::ptr::from_ref::<Model>(copy) as i64;
                let object = self.int(object);
                match (other, Kind::of(other)) {
                    (Model::Range(range), _) => {
                        Typed::Range { object, first: self.int(range.start), step: self.int(range.step) }
                    }
                    (_, Kind::Object(form)) => Typed::Object(object, form),
                    _ => return None,
                }
            }
        };
        Some(TypedOperand { typed, sample: Some(value) })
    }

    /// Writes a register.
    pub(super) fn put(
        &mut self,
        cursor: &mut Cursor<'v>,
        o: Operand,
        typed: Typed,
        sample: Option<&'v Model>,
    ) {
        let reg = Self::reg(cursor, o);
        self.written.insert(reg);
        self.writes_node |= matches!(reg, Reg::Node(_)) && !cursor.asks;
        self.define(reg, typed);
        cursor.kinds.insert(reg, typed.kind());
        match sample.filter(|_| !typed.kind().is_plain()) {
            Some(sample) => cursor.samples.insert(reg, sample),
            None => cursor.samples.remove(&reg),
        };
    }
}

/// Calls of functions outside of the machine code.
impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    /// Calls the function at an address for an answer.
    pub(super) fn call_address(&mut self, function: *const u8, args: &[Value], answer: Type) -> Value {
        let call = self.call_outside(function, args, Some(answer));
        self.b.inst_results(call)[0]
    }

    /// Calls the function at an address.
    pub(super) fn call_outside(&mut self, function: *const u8, args: &[Value], answer: Option<Type>) -> Inst {
        let address = self.int(function as i64);
        self.call_pointer(address, args, answer)
    }

    /// Calls the function whose address the code has found.
    pub(super) fn call_pointer(&mut self, address: Value, args: &[Value], answer: Option<Type>) -> Inst {
        let mut signature = Signature::new(self.convention);
        for value in args {
            let ty = self.b.func.dfg.value_type(*value);
            signature.params.push(AbiParam::new(ty));
        }
        signature.returns.extend(answer.map(AbiParam::new));
        let signature = self.b.import_signature(signature);
        self.b.ins().call_indirect(signature, address, args)
    }

    /// The address of the word for the answers of called functions.
    pub(super) fn answer(&mut self) -> Value {
        self.b.ins().stack_addr(I64, self.answer, 0)
    }

    /// Writes plain values to the array for arguments, and returns its address.
    pub(super) fn pass(&mut self, values: &[Typed]) -> Value {
        let args = self.b.ins().stack_addr(I64, self.arguments, 0);
        for (k, typed) in values.iter().enumerate() {
            let at = 16 * k as i32;
            if let Typed::Bool(x) | Typed::Int(x) | Typed::Real(x) = typed {
                self.b.ins().store(PLAIN, *x, args, at + 8);
            }
            let mark = self.int(typed.kind().mark().cast_signed());
            self.b.ins().store(PLAIN, mark, args, at);
        }
        args
    }

    /// The address and the length of a name, which exists as long as the code.
    pub(super) fn keep_name(&mut self, name: &str) -> [Value; 2] {
        let name: Box<str> = name.into();
        let [address, length] = [name.as_ptr() as i64, name.len() as i64];
        self.names.push(name);
        [self.int(address), self.int(length)]
    }
}

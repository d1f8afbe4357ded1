//! The registers of the model as variables of Cranelift's builder.

use super::typed::{Got, Number, Typed};
use super::write::{Now, Writer};
use crate::code::kinds::{Kind, Part, Reg};
use crate::code::routine::words;
use crate::code::{Operand, Place};
use crate::value::Value as Model;
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{AbiParam, InstBuilder, Signature, Type, Value};
use niwaki_native::frontend::Variable;

/// Numbers of variables of parts: whole ones, then real ones.
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

    /// The value of a register of that kind.
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
            Kind::Fresh { made, parts, number } => {
                let mut all = [None; 4];
                for (k, (own, kind)) in all.iter_mut().zip(parts).enumerate() {
                    *own = kind.map(|kind| {
                        let x = part(part_of(k, kind));
                        match kind {
                            Part::Bool => Number::Bool(x),
                            Part::Int => Number::Int(x),
                            Part::Real => Number::Real(x),
                        }
                    });
                }
                Typed::Fresh { made, parts: all, number }
            }
        }
    }

    fn reg(now: &Now<'_>, o: Operand) -> Reg {
        match o.place() {
            Place::Node => Reg::Node(o.index() as u16),
            Place::Outer => Reg::Outer(o.index() as u16),
            Place::Scratch | Place::Constant => Reg::Scratch(now.base + o.index() as u32),
        }
    }

    /// The value of an operand; `None` for one that the code knows nothing of.
    pub(super) fn get(&mut self, now: &Now<'v>, o: Operand) -> Option<Got<'v>> {
        if o.is_constant() {
            return self.constant(now, o);
        }
        let reg = Self::reg(now, o);
        let kind = *now.kinds.get(&reg)?;
        self.read.insert(reg);
        Some(Got { typed: self.typed(reg, kind), sample: now.samples.get(&reg).copied() })
    }

    fn constant(&mut self, now: &Now<'v>, o: Operand) -> Option<Got<'v>> {
        let value: &'v Model = &self.program.function(now.function).constants[o.index()];
        let typed = match value {
            Model::None => Typed::None,
            Model::Bool(b) => Typed::Bool(self.int(i64::from(*b))),
            Model::Int(n) => Typed::Int(self.int(*n)),
            Model::Real(x) => Typed::Real(self.b.ins().f64const(*x)),
            other => {
                let which = (now.function, o.index() as u16);
                let known = self.constants.iter().position(|known| *known == which);
                let at = known.unwrap_or(self.constants.len());
                if at >= words::MOST_CONSTANTS {
                    return None;
                }
                if known.is_none() {
                    self.constants.push(which);
                }
                let object = self.word(words::CONSTANTS + at);
                match (other, Kind::of(other)) {
                    (Model::Range(range), _) => {
                        Typed::Range { object, first: self.int(range.start), step: self.int(range.step) }
                    }
                    (_, Kind::Object(form)) => Typed::Object(object, form),
                    _ => return None,
                }
            }
        };
        Some(Got { typed, sample: Some(value) })
    }

    /// Writes a register.
    pub(super) fn put(&mut self, now: &mut Now<'v>, o: Operand, typed: Typed, sample: Option<&'v Model>) {
        let reg = Self::reg(now, o);
        self.written.insert(reg);
        self.define(reg, typed);
        now.kinds.insert(reg, typed.kind());
        match sample.filter(|_| !typed.kind().is_plain()) {
            Some(sample) => now.samples.insert(reg, sample),
            None => now.samples.remove(&reg),
        };
    }
}

/// Calls of functions that are not machine code of ours.
impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    /// Calls the function at an address.
    pub(super) fn call_address(&mut self, function: *const u8, given: &[Value], answer: Type) -> Value {
        let mut signature = Signature::new(self.convention);
        for value in given {
            let ty = self.b.func.dfg.value_type(*value);
            signature.params.push(AbiParam::new(ty));
        }
        signature.returns.push(AbiParam::new(answer));
        let signature = self.b.import_signature(signature);
        let address = self.int(function as i64);
        let call = self.b.ins().call_indirect(signature, address, given);
        self.b.inst_results(call)[0]
    }

    /// The address of the word that called functions answer to.
    pub(super) fn answer(&mut self) -> Value {
        self.b.ins().stack_addr(I64, self.answer, 0)
    }

    /// The address of the array for arguments.
    pub(super) fn arguments(&mut self) -> Value {
        self.b.ins().stack_addr(I64, self.arguments, 0)
    }

    /// The address and the length of a name, which lives as long as the code.
    pub(super) fn keep_name(&mut self, name: &str) -> [Value; 2] {
        let name: Box<str> = name.into();
        let [address, length] = [name.as_ptr() as i64, name.len() as i64];
        self.names.push(name);
        [self.int(address), self.int(length)]
    }
}

//! Machine code for built-in functions.

use super::calls;
use super::typed::{Number, Typed};
use super::write::{ARGUMENTS, Cursor, Progress, Writer};
use crate::builtins::builtin;
use crate::code::register::{FreshForm, Kind};
use crate::code::{Args, Operand};
use niwaki_native::codegen::ir::condcodes::{FloatCC, IntCC};
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{InstBuilder, Value};

impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    pub(super) fn builtin(
        &mut self,
        cursor: &mut Cursor<'v>,
        pc: usize,
        to: Operand,
        id: u16,
        args: Args,
    ) -> Option<Progress> {
        let operands = &self.f(cursor).operands[args.range()];
        let arguments: Vec<Typed> =
            operands.iter().map(|o| self.get(cursor, *o).map(|got| got.typed)).collect::<Option<_>>()?;
        let name = builtin::<f64>(id).name;
        let typed = if let ("len", [operand]) = (name, operands) {
            return self.length_of_operand(cursor, pc, to, *operand);
        } else if let Some(typed) = self.quick(cursor, pc, name, &arguments) {
            typed
        } else if name == "range" {
            self.range(cursor, pc, &arguments)?
        } else if let Some(typed) = self.vector_function(cursor, pc, name, &arguments) {
            typed
        } else {
            let kind = kind_of_answer(name, &arguments)?;
            self.call_builtin(cursor, pc, id, &arguments, kind)?
        };
        self.put(cursor, to, typed, None);
        Some(Progress::Next)
    }

    /// Writes a built-in function that needs a few instructions, or one call.
    pub(super) fn quick(
        &mut self,
        cursor: &Cursor<'v>,
        pc: usize,
        name: &str,
        arguments: &[Typed],
    ) -> Option<Typed> {
        match (name, arguments) {
            ("sqrt", [x]) => {
                let x = self.real(*x)?;
                let root = self.b.ins().sqrt(x);
                self.leave_unless_finite(cursor, pc, root);
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
                self.leave_if(cursor, pc, refused);
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
                self.leave_unless_finite(cursor, pc, y);
                Some(Typed::Real(y))
            }
            _ => None,
        }
    }

    /// Writes a range; leaves if there is no such range.
    pub(super) fn range(&mut self, cursor: &mut Cursor<'v>, pc: usize, bounds: &[Typed]) -> Option<Typed> {
        let (zero, unit) = (self.int(0), self.int(1));
        let parts = match *bounds {
            [Typed::Int(stop)] => [zero, stop, unit],
            [Typed::Int(start), Typed::Int(stop)] => [start, stop, unit],
            [Typed::Int(start), Typed::Int(stop), Typed::Int(step)] => [start, stop, step],
            _ => return None,
        };
        let n = self.call_address(calls::range_length as *const u8, &parts, I64);
        let refused = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, n, 0);
        self.leave_if(cursor, pc, refused);
        Some(self.make(cursor, pc, FreshForm::Range, &parts.map(Number::Int)))
    }

    pub(super) fn leave_unless_finite(&mut self, cursor: &Cursor<'v>, pc: usize, x: Value) {
        let size = self.b.ins().fabs(x);
        let infinite = self.b.ins().f64const(f64::INFINITY);
        let is_finite = self.b.ins().fcmp(FloatCC::LessThan, size, infinite);
        let refused = self.b.ins().icmp_imm_s(IntCC::Equal, is_finite, 0);
        self.leave_if(cursor, pc, refused);
    }

    /// Calls a built-in function of plain values; `kind` is the expected kind of its answer.
    pub(super) fn call_builtin(
        &mut self,
        cursor: &Cursor<'v>,
        pc: usize,
        id: u16,
        inputs: &[Typed],
        kind: Kind,
    ) -> Option<Typed> {
        let is_passed = |typed: &Typed| typed.number().is_some() || matches!(typed, Typed::None);
        if inputs.len() > ARGUMENTS as usize || !inputs.iter().all(is_passed) {
            return None;
        }
        let args = self.pass(inputs);
        let (id, n, out) = (self.int(i64::from(id)), self.int(inputs.len() as i64), self.answer());
        let mark = self.call_address(calls::call as *const u8, &[id, args, n, out], I64);
        self.read_answer(cursor, pc, mark, kind)
    }
}

/// The expected kind of the answer of a built-in function of plain values. It is only a guess: the code checks
/// it.
fn kind_of_answer(name: &str, arguments: &[Typed]) -> Option<Kind> {
    let all = |kind: Kind| arguments.iter().all(|typed| typed.kind() == kind);
    if !arguments.iter().all(|typed| matches!(typed.kind(), Kind::Real | Kind::Int | Kind::Bool | Kind::None))
    {
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
            if arguments.len() == 1 {
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

/// Whether there is machine code for a built-in function, if its arguments are of the right kinds.
pub(super) fn has_machine_code(name: &str) -> bool {
    let of_vectors = ["vec", "dot", "norm", "distance", "normalize", "cross", "rotate", "range", "len"];
    of_vectors.contains(&name) || kind_of_answer(name, &[]).is_some()
}

//! Arithmetic and comparisons of numbers.

use super::typed::Typed;
use super::write::{Cursor, Writer};
use crate::code::Binary;
use crate::code::register::FreshForm;
use niwaki_native::codegen::ir::condcodes::{FloatCC, IntCC};
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{InstBuilder, Value};

/// The largest whole numbers that convert to real numbers without loss.
const EXACT: i64 = 1 << 53;

impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    /// Python's truth of a plain value.
    pub(super) fn truth(&mut self, typed: Typed) -> Option<Value> {
        Some(match typed {
            Typed::Bool(x) => x,
            Typed::Int(n) => self.b.ins().icmp_imm_s(IntCC::NotEqual, n, 0),
            Typed::Real(x) => {
                let zero = self.b.ins().f64const(0.0);
                self.b.ins().fcmp(FloatCC::NotEqual, x, zero)
            }
            Typed::None => self.int(0),
            // A fresh vector or tuple has parts, so it is true.
            Typed::Fresh { form: FreshForm::Vector | FreshForm::Tuple, .. } => self.int(1),
            _ => return None,
        })
    }

    /// Converts a number to a real number.
    pub(super) fn real(&mut self, typed: Typed) -> Option<Value> {
        match typed {
            Typed::Real(x) => Some(x),
            Typed::Int(n) => Some(self.b.ins().fcvt_from_sint(F64, n)),
            _ => None,
        }
    }

    pub(super) fn arithmetic(
        &mut self,
        cursor: &Cursor<'v>,
        pc: usize,
        op: Binary,
        a: Typed,
        b: Typed,
    ) -> Option<Typed> {
        if let (Typed::Int(a), Typed::Int(b)) = (a, b) {
            return Some(self.whole(cursor, pc, op, a, b));
        }
        let (a, b) = (self.real(a)?, self.real(b)?);
        Some(Typed::Real(match op {
            Binary::Add => self.b.ins().fadd(a, b),
            Binary::Sub => self.b.ins().fsub(a, b),
            Binary::Mul => self.b.ins().fmul(a, b),
            _ => {
                self.leave_if_zero(cursor, pc, b);
                self.b.ins().fdiv(a, b)
            }
        }))
    }

    /// Writes arithmetic of whole numbers; leaves if the result does not fit in 64 bits.
    pub(super) fn whole(&mut self, cursor: &Cursor<'v>, pc: usize, op: Binary, a: Value, b: Value) -> Typed {
        match op {
            Binary::Add | Binary::Sub => {
                // The sum overflows if its sign differs from the sign that both operands require.
                let (result, other) = if op == Binary::Add {
                    (self.b.ins().iadd(a, b), self.b.ins().bxor(a, b))
                } else {
                    let other = self.b.ins().bxor(a, b);
                    (self.b.ins().isub(a, b), self.b.ins().bnot(other))
                };
                let turned = self.b.ins().bxor(a, result);
                let over = self.b.ins().band_not(turned, other);
                let over = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, over, 0);
                self.leave_if(cursor, pc, over);
                Typed::Int(result)
            }
            Binary::Mul => {
                let (low, high) = (self.b.ins().imul(a, b), self.b.ins().smulhi(a, b));
                let sign = self.b.ins().sshr_imm_s(low, 63);
                let over = self.b.ins().icmp(IntCC::NotEqual, high, sign);
                self.leave_if(cursor, pc, over);
                Typed::Int(low)
            }
            _ => {
                let zero = self.b.ins().icmp_imm_s(IntCC::Equal, b, 0);
                self.leave_if(cursor, pc, zero);
                for n in [a, b] {
                    self.leave_unless_exact(cursor, pc, n);
                }
                let (a, b) = (self.b.ins().fcvt_from_sint(F64, a), self.b.ins().fcvt_from_sint(F64, b));
                Typed::Real(self.b.ins().fdiv(a, b))
            }
        }
    }

    /// Leaves if a whole number has no exact real number.
    fn leave_unless_exact(&mut self, cursor: &Cursor<'v>, pc: usize, n: Value) {
        let shifted = self.b.ins().iadd_imm_s(n, EXACT);
        let large = self.b.ins().icmp_imm_s(IntCC::UnsignedGreaterThan, shifted, 2 * EXACT);
        self.leave_if(cursor, pc, large);
    }

    /// Writes the quotient or remainder of whole numbers, rounded down. Leaves unless the divisor is positive.
    pub(super) fn divide(&mut self, cursor: &Cursor<'v>, pc: usize, op: Binary, a: Value, b: Value) -> Typed {
        let refused = self.b.ins().icmp_imm_s(IntCC::SignedLessThanOrEqual, b, 0);
        self.leave_if(cursor, pc, refused);
        self.divides = true;
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

    /// Writes a comparison; the result has eight bits.
    pub(super) fn compare(
        &mut self,
        cursor: &Cursor<'v>,
        pc: usize,
        op: Binary,
        a: Typed,
        b: Typed,
    ) -> Option<Value> {
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
                self.leave_unless_exact(cursor, pc, n);
                let n = self.b.ins().fcvt_from_sint(F64, n);
                self.b.ins().fcmp(reals, n, x)
            }
            (Typed::Real(x), Typed::Int(n)) => {
                self.leave_unless_exact(cursor, pc, n);
                let n = self.b.ins().fcvt_from_sint(F64, n);
                self.b.ins().fcmp(reals, x, n)
            }
            _ => return None,
        })
    }
}

//! Vectors and tuples of numbers. Their parts are in the processor, and there is no object in memory before the
//! code leaves.

use super::calls;
use super::typed::{Number, Typed};
use super::write::{Cursor, PLAIN, Writer};
use crate::code::Binary;
use crate::code::register::FreshForm;
use crate::value::{Value as Model, Vector};
use niwaki_native::codegen::ir::condcodes::FloatCC;
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{InstBuilder, Value};
use std::sync::LazyLock;

/// The offset of shared data from the address in its value.
pub(super) static DATA: LazyLock<i32> = LazyLock::new(|| {
    let value: Model = Model::vector(&[1.0, 2.0, 3.0]);
    let Model::Vector(v) = &value else { return 0 };
    let data = std::sync::Arc::as_ptr(v) as u64;
    // SAFETY: a value is two words, and the second one of a vector is an address.
    #[allow(unsafe_code)]
    let address = unsafe { std::ptr::from_ref(&value).cast::<u64>().add(1).read() };
    i32::try_from(data.wrapping_sub(address)).unwrap_or(0)
});

/// The offsets of the components of a vector, and of their number, a byte.
const COMPONENTS: i32 = Vector::<f64>::COMPONENTS as i32;
pub(super) const LENGTH: i32 = Vector::<f64>::LENGTH as i32;

impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    /// The components of a vector.
    fn vector(&mut self, typed: Typed) -> Option<Vec<Value>> {
        match typed {
            Typed::Fresh { form: FreshForm::Vector, parts, .. } => {
                parts.iter().flatten().map(|part| real(*part)).collect()
            }
            Typed::Object(object, form) => {
                let n = i32::from(form.components()?);
                let body = self.b.ins().load(I64, PLAIN, object, 8);
                Some(
                    (0..n).map(|k| self.b.ins().load(F64, PLAIN, body, *DATA + COMPONENTS + 8 * k)).collect(),
                )
            }
            _ => None,
        }
    }

    /// A part of a fresh value, or a component of a vector.
    pub(super) fn part(&mut self, typed: Typed, at: usize) -> Option<Typed> {
        match typed {
            Typed::Fresh { form: FreshForm::Range, .. } => None,
            Typed::Fresh { parts, .. } => parts.get(at).copied().flatten().map(Typed::from),
            other => self.vector(other)?.get(at).map(|x| Typed::Real(*x)),
        }
    }

    /// The number of parts of a value.
    pub(super) fn count_of_parts(typed: Typed) -> Option<usize> {
        match typed {
            Typed::Fresh { form: FreshForm::Range, .. } => None,
            Typed::Fresh { parts, .. } => Some(parts.iter().flatten().count()),
            Typed::Object(_, form) => form.components().map(usize::from),
            _ => None,
        }
    }

    fn make_vector(&mut self, cursor: &mut Cursor<'v>, pc: usize, parts: &[Value]) -> Typed {
        let numbers: Vec<Number> = parts.iter().map(|x| Number::Real(*x)).collect();
        self.make(cursor, pc, FreshForm::Vector, &numbers)
    }

    /// Writes an operation with a vector as an operand.
    pub(super) fn vector_operation(
        &mut self,
        cursor: &mut Cursor<'v>,
        pc: usize,
        op: Binary,
        a: Typed,
        b: Typed,
    ) -> Option<Typed> {
        let parts = match (self.vector(a), self.vector(b), op) {
            (Some(v), Some(w), Binary::Add | Binary::Sub) if v.len() == w.len() => {
                self.componentwise(op, &v, &w)
            }
            (Some(v), None, Binary::Mul) => {
                let by = self.real(b)?;
                v.iter().map(|x| self.b.ins().fmul(*x, by)).collect()
            }
            (None, Some(v), Binary::Mul) => {
                let by = self.real(a)?;
                v.iter().map(|x| self.b.ins().fmul(*x, by)).collect()
            }
            (Some(v), None, Binary::Div) => {
                let by = self.real(b)?;
                self.leave_if_zero(cursor, pc, by);
                v.iter().map(|x| self.b.ins().fdiv(*x, by)).collect::<Vec<_>>()
            }
            _ => return None,
        };
        Some(self.make_vector(cursor, pc, &parts))
    }

    fn componentwise(&mut self, op: Binary, v: &[Value], w: &[Value]) -> Vec<Value> {
        let pairs = v.iter().zip(w);
        pairs
            .map(|(x, y)| match op {
                Binary::Add => self.b.ins().fadd(*x, *y),
                _ => self.b.ins().fsub(*x, *y),
            })
            .collect()
    }

    /// Negates a vector.
    pub(super) fn negated(&mut self, cursor: &mut Cursor<'v>, pc: usize, typed: Typed) -> Option<Typed> {
        let v = self.vector(typed)?;
        let parts: Vec<Value> = v.iter().map(|x| self.b.ins().fneg(*x)).collect();
        Some(self.make_vector(cursor, pc, &parts))
    }

    pub(super) fn leave_if_zero(&mut self, cursor: &Cursor<'v>, pc: usize, x: Value) {
        let zero = self.b.ins().f64const(0.0);
        let is_zero = self.b.ins().fcmp(FloatCC::Equal, x, zero);
        self.leave_if(cursor, pc, is_zero);
    }

    /// The sum of products, in the same order as the interpreter.
    fn product(&mut self, v: &[Value], w: &[Value]) -> Value {
        let mut sum = self.b.ins().f64const(0.0);
        for (x, y) in v.iter().zip(w) {
            let product = self.b.ins().fmul(*x, *y);
            sum = self.b.ins().fadd(sum, product);
        }
        sum
    }

    fn length_of(&mut self, v: &[Value]) -> Value {
        let squares = self.product(v, v);
        self.b.ins().sqrt(squares)
    }

    /// The vector of length one in a direction; leaves if the length is zero.
    fn unit(&mut self, cursor: &Cursor<'v>, pc: usize, v: &[Value]) -> Vec<Value> {
        let length = self.length_of(v);
        self.leave_if_zero(cursor, pc, length);
        v.iter().map(|x| self.b.ins().fdiv(*x, length)).collect()
    }

    /// Writes a built-in function of vectors.
    pub(super) fn vector_function(
        &mut self,
        cursor: &mut Cursor<'v>,
        pc: usize,
        name: &str,
        arguments: &[Typed],
    ) -> Option<Typed> {
        match (name, arguments) {
            ("vec", parts @ ([_, _] | [_, _, _] | [_, _, _, _])) => {
                let parts: Vec<Value> = parts.iter().map(|x| self.real(*x)).collect::<Option<_>>()?;
                Some(self.make_vector(cursor, pc, &parts))
            }
            ("dot", [a, b]) => {
                let (v, w) = (self.vector(*a)?, self.vector(*b)?);
                (v.len() == w.len()).then(|| Typed::Real(self.product(&v, &w)))
            }
            ("norm", [a]) => {
                let v = self.vector(*a)?;
                Some(Typed::Real(self.length_of(&v)))
            }
            ("distance", [a, b]) => {
                let (v, w) = (self.vector(*a)?, self.vector(*b)?);
                if v.len() != w.len() {
                    return None;
                }
                let apart = self.componentwise(Binary::Sub, &v, &w);
                Some(Typed::Real(self.length_of(&apart)))
            }
            ("normalize", [a]) => {
                let v = self.vector(*a)?;
                let unit = self.unit(cursor, pc, &v);
                Some(self.make_vector(cursor, pc, &unit))
            }
            ("cross", [a, b]) => {
                let (v, w) = (self.vector(*a)?, self.vector(*b)?);
                let (&[ax, ay, az], &[bx, by, bz]) = (&v[..], &w[..]) else { return None };
                let mut minor = |a, b, c, d| {
                    let (first, second) = (self.b.ins().fmul(a, b), self.b.ins().fmul(c, d));
                    self.b.ins().fsub(first, second)
                };
                let parts = [minor(ay, bz, az, by), minor(az, bx, ax, bz), minor(ax, by, ay, bx)];
                Some(self.make_vector(cursor, pc, &parts))
            }
            ("lerp", [a, b, t]) => {
                let (v, w, t) = (self.vector(*a)?, self.vector(*b)?, self.real(*t)?);
                if v.len() != w.len() {
                    return None;
                }
                let wide = self.componentwise(Binary::Sub, &w, &v);
                let part: Vec<Value> = wide.iter().map(|x| self.b.ins().fmul(*x, t)).collect();
                let parts = self.componentwise(Binary::Add, &v, &part);
                Some(self.make_vector(cursor, pc, &parts))
            }
            ("rotate", [a, axis, angle]) => {
                let (v, axis, angle) = (self.vector(*a)?, self.vector(*axis)?, self.real(*angle)?);
                if v.len() != 3 || axis.len() != 3 {
                    return None;
                }
                let axis = self.unit(cursor, pc, &axis);
                let rows = self.rotation(&axis, angle)?;
                let parts: Vec<Value> = rows.iter().map(|row| self.product(row, &v)).collect();
                Some(self.make_vector(cursor, pc, &parts))
            }
            _ => None,
        }
    }

    /// The rotation about an axis of length one, with the formula of `builtins::vectors`.
    fn rotation(&mut self, axis: &[Value], angle: Value) -> Option<[[Value; 3]; 3]> {
        let &[x, y, z] = axis else { return None };
        let [cos, sin] = ["cos", "sin"].map(calls::real_function);
        let (c, s) = (self.call_address(cos?, &[angle], F64), self.call_address(sin?, &[angle], F64));
        let unit = self.b.ins().f64const(1.0);
        let t = self.b.ins().fsub(unit, c);
        let b = &mut self.b;
        let mut entry = |a: Value, other: Value, add: bool, by: Value, part: Option<Value>| {
            let first = b.ins().fmul(t, a);
            let first = b.ins().fmul(first, other);
            let second = part.map_or(by, |part| b.ins().fmul(by, part));
            if add { b.ins().fadd(first, second) } else { b.ins().fsub(first, second) }
        };
        Some([
            [entry(x, x, true, c, None), entry(x, y, false, s, Some(z)), entry(x, z, true, s, Some(y))],
            [entry(x, y, true, s, Some(z)), entry(y, y, true, c, None), entry(y, z, false, s, Some(x))],
            [entry(x, z, false, s, Some(y)), entry(y, z, true, s, Some(x)), entry(z, z, true, c, None)],
        ])
    }
}

/// A part as a real number.
fn real(part: Number) -> Option<Value> {
    match part {
        Number::Real(x) => Some(x),
        Number::Bool(_) | Number::Int(_) => None,
    }
}

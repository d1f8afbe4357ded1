//! Functions that machine code calls for operations that it does not contain.
//!
//! Each function returns the kind of its answer as [`Kind::mark`] and stores the answer itself in `out`. If the
//! interpreter would raise a fault, or if no word can represent the answer, it returns [`NO_ANSWER`]: the code
//! then leaves, and the interpreter runs the instruction.

#![allow(unsafe_code)] // The code that `write` makes passes addresses.

use crate::builtins::builtin;
use crate::code::register::{FreshForm, Kind, Part, Parts, Reg};
use crate::code::routine::NO_ANSWER;
use crate::value::{Range, Value, index, iter_len};
use niwaki_math::Scalar;
use std::sync::Arc;

/// Stores the word of a value, and returns its mark.
fn store_word(value: &Value, out: &mut u64) -> u64 {
    let kind = Kind::of(value);
    *out = match value {
        Value::Real(x) => x.to_bits(),
        Value::Int(n) => n.cast_unsigned(),
        Value::Bool(b) => u64::from(*b),
        other if kind.is_plain() => {
            debug_assert!(other.is_plain());
            0
        }
        other => std::ptr::from_ref(other) as u64,
    };
    kind.mark()
}

/// An element of a list, tuple or vector, counted from the front.
///
/// # Safety
/// `value` points to a value that nobody changes meanwhile, `out` to a word.
pub(super) unsafe extern "C" fn element(value: *const Value, at: i64, out: *mut u64) -> u64 {
    // SAFETY: as above.
    let (value, out) = unsafe { (&*value, &mut *out) };
    if let Some(item) = index::index_ref(value, &Value::Int(at)) {
        return store_word(item, out);
    }
    if let (Value::Vector(v), Ok(at)) = (value, usize::try_from(at))
        && let Some(x) = v.components().get(at)
    {
        *out = x.to_bits();
        return Kind::Real.mark();
    }
    NO_ANSWER
}

/// A field of a record.
///
/// # Safety
/// As for [`element`]; `name` points to `bytes` bytes of text that the code keeps.
pub(super) unsafe extern "C" fn field(
    value: *const Value,
    name: *const u8,
    bytes: u64,
    out: *mut u64,
) -> u64 {
    // SAFETY: as above.
    let (value, name, out) =
        unsafe { (&*value, std::slice::from_raw_parts(name, bytes as usize), &mut *out) };
    let (Value::Record(record), Ok(name)) = (value, std::str::from_utf8(name)) else { return NO_ANSWER };
    record.field(name).map_or(NO_ANSWER, |value| store_word(value, out))
}

/// The number of elements that a loop visits; below zero for a value that cannot be looped over.
///
/// # Safety
/// As for [`element`].
pub(super) unsafe extern "C" fn length(value: *const Value) -> i64 {
    // SAFETY: as above.
    let value = unsafe { &*value };
    iter_len(value).ok().and_then(|n| i64::try_from(n).ok()).unwrap_or(-1)
}

/// The number of elements of a range; below zero if there is no such range.
pub(super) extern "C" fn range_length(start: i64, stop: i64, step: i64) -> i64 {
    if let (Some(n), 1) = (stop.checked_sub(start), step) {
        return n.max(0);
    }
    Range::new(start, stop, step).map_or(-1, |range| range.len as i64)
}

/// A built-in function of plain values.
///
/// # Safety
/// `args` points to `n` values, `out` to a word.
pub(super) unsafe extern "C" fn call(id: u64, args: *const Value, n: u64, out: *mut u64) -> u64 {
    // SAFETY: as above.
    let (args, out) = unsafe { (std::slice::from_raw_parts(args, n as usize), &mut *out) };
    match builtin::<f64>(id as u16).call(args) {
        Ok(value) if value.is_plain() => store_word(&value, out),
        _ => NO_ANSWER,
    }
}

/// The number of words for a value of this kind among those of [`store_shared`]: a value has two.
pub(super) fn words(kind: Kind) -> usize {
    match kind {
        Kind::Fresh { parts, .. } => parts.iter().flatten().count().max(2),
        _ => 2,
    }
}

/// A vector, tuple or range of the numbers in these words.
fn build(form: FreshForm, parts: Parts, words: &[u64]) -> Value {
    let numbers = parts.iter().flatten().zip(words).map(|(part, word)| match part {
        Part::Bool => Value::Bool(*word != 0),
        Part::Int => Value::Int(word.cast_signed()),
        Part::Real => Value::Real(f64::from_bits(*word)),
    });
    match form {
        FreshForm::Tuple => Value::tuple(numbers.collect()),
        FreshForm::Range => {
            let [start, stop, step] = [0, 1, 2].map(|k| words[k].cast_signed());
            Range::new(start, stop, step).map_or(Value::None, |range| Value::Range(Arc::new(range)))
        }
        FreshForm::Vector => {
            let n = parts.iter().flatten().count();
            let reals = [0, 1, 2, 3].map(|k| words.get(k).map_or(0.0, |word| f64::from_bits(*word)));
            Value::vector(&reals[..n])
        }
    }
}

/// Stores shared values in registers: `words` has the address of each value, or the parts of a value that the
/// code has made. A register of a plain kind becomes empty. All values are copied before a register is written,
/// because they may be in these registers.
///
/// # Safety
/// `list` points to `n` registers with their kinds, of which `node` and `scratch` have the first ones, and nobody
/// else accesses these. `words` has room for [`words`] of each kind, and the addresses point to values.
pub(super) unsafe extern "C" fn store_shared(
    list: *const (Reg, Kind),
    n: u64,
    words_at: *mut u64,
    node: *mut Value,
    scratch: *mut Value,
) {
    // SAFETY: as above.
    let list = unsafe { std::slice::from_raw_parts(list, n as usize) };
    let mut at = words_at;
    for (k, (_, kind)) in list.iter().enumerate() {
        // SAFETY: as above; each value takes the place of its own words.
        unsafe {
            let value = match *kind {
                Kind::Fresh { form, parts, number } => match same_before(list, k, number) {
                    Some(skipped) => (*words_at.add(skipped).cast::<Value>()).clone(),
                    None => build(form, parts, std::slice::from_raw_parts(at, words(*kind))),
                },
                kind if kind.is_plain() => Value::None,
                _ => (*(*at as *const Value)).clone(),
            };
            at.cast::<Value>().write(value);
            at = at.add(words(*kind));
        }
    }
    at = words_at;
    for (reg, kind) in list {
        // SAFETY: as above; the words hold the values now.
        unsafe {
            let register = match *reg {
                Reg::Node(i) | Reg::Outer(i) => node.add(i.into()),
                Reg::Scratch(i) => scratch.add(i as usize),
            };
            *register = at.cast::<Value>().read();
            at = at.add(words(*kind));
        }
    }
}

/// The words before those of an earlier register that holds the same value.
fn same_before(list: &[(Reg, Kind)], k: usize, number: u16) -> Option<usize> {
    let is_same = |(_, kind): &(Reg, Kind)| matches!(kind, Kind::Fresh { number: n, .. } if *n == number);
    let first = list[..k].iter().position(is_same)?;
    Some(list[..first].iter().map(|(_, kind)| words(*kind)).sum())
}

/// Drops the small values of some of the machine's registers, and returns whether these hold no shared data then.
///
/// # Safety
/// `list` points to `n` registers of the machine, from `scratch` on; nobody else accesses these.
pub(super) unsafe extern "C" fn drop_small(list: *const (Reg, Kind), n: u64, scratch: *mut Value) -> u64 {
    // SAFETY: as above.
    let list = unsafe { std::slice::from_raw_parts(list, n as usize) };
    let are_free = list.iter().all(|(reg, _)| {
        let Reg::Scratch(i) = reg else { return true };
        // SAFETY: as above.
        let register = unsafe { &mut *scratch.add(*i as usize) };
        if register.is_small() {
            *register = Value::None;
        }
        register.is_plain()
    });
    u64::from(are_free)
}

macro_rules! functions {
    ($($name:ident $method:ident;)*) => {
        $(extern "C" fn $name(x: f64) -> f64 {
            Scalar::$method(x)
        })*

        /// The function of one real number with this name. Its result is valid if it is finite.
        pub(super) fn real_function(name: &str) -> Option<*const u8> {
            match name {
                $(stringify!($name) => Some($name as *const u8),)*
                _ => None,
            }
        }
    };
}

functions! {
    exp exp;
    log ln;
    log1p ln_1p;
    expm1 exp_m1;
    sin sin;
    cos cos;
    tan tan;
    asin asin;
    acos acos;
    atan atan;
    sinh sinh;
    cosh cosh;
    tanh tanh;
    erf erf;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The claim behind values that the code builds: a word for the kind, and a word for the number.
    #[test]
    fn plain_values_are_two_words() {
        let words = |value: &Value| {
            // SAFETY: a value has sixteen bytes; all bytes of a number are written.
            unsafe { *std::ptr::from_ref(value).cast::<[u64; 2]>() }
        };
        assert_eq!(words(&Value::Real(0.5)), [Kind::Real.mark(), 0.5_f64.to_bits()]);
        assert_eq!(words(&Value::Int(-3)), [Kind::Int.mark(), (-3_i64).cast_unsigned()]);
        // SAFETY: as above, for the kind alone.
        let first = |value: &Value| unsafe { *std::ptr::from_ref(value).cast::<u64>() };
        assert_eq!(first(&Value::Bool(true)), Kind::Bool.mark());
        assert_eq!(first(&Value::None), Kind::None.mark());
        let truth = [Kind::Bool.mark(), 1];
        // SAFETY: this is the layout of a truth value that the code writes.
        let read = unsafe { std::ptr::from_ref(&truth).cast::<Value>().as_ref() };
        assert!(matches!(read, Some(Value::Bool(true))));
    }
}

//! The kinds of values, and their copies.

use super::aggregate::{Closure, Dict, Range, Record, Tuple, Vector};
use super::list::List;
use super::text::Text;
use niwaki_geom::Shape;
use niwaki_math::{Dist, Scalar};
use std::sync::Arc;

/// Largest number of elements, or of characters, that one value may have (2^26).
pub const MAX_ELEMENTS: usize = 1 << 26;

/// A value of the modelling language.
///
/// The tag is a whole word, so that every payload begins at the second word: a copy is two moves of eight
/// bytes. With a tag of one byte, a truth value would lie beside the tag. Then every copy of a value of unknown
/// kind would be taken apart into pieces of one, two and four bytes. Kinds without shared data come first, so
/// that one comparison recognises them.
#[derive(Default)]
#[repr(u64)]
pub enum Value<S: Scalar = f64> {
    /// `None`.
    #[default]
    None,
    /// `True`, `False`.
    Bool(bool),
    /// A 64-bit whole number.
    Int(i64),
    /// A real number.
    Real(S),
    /// A future that may still run, by its number.
    Future(u32),
    /// The content of a variable before it is assigned; no model ever sees it.
    Unset,
    /// A reference to an element of a kept collection; the element is in a register. Only lists hold cells, and
    /// no model ever sees a cell.
    Cell(Cell),
    /// A string.
    Str(Text),
    /// A future that has returned. The one element of the tuple is its value; only `force` looks at it.
    Returned(Tuple<S>),
    /// A tuple.
    Tuple(Tuple<S>),
    /// A persistent list.
    List(List<S>),
    /// A dictionary with constant keys.
    Dict(Arc<Dict<S>>),
    /// An instance of a frozen dataclass or a `NamedTuple`.
    Record(Arc<Record<S>>),
    /// `range(start, stop, step)`.
    Range(Arc<Range>),
    /// Two to four real components.
    Vector(Arc<Vector<S>>),
    /// A rotation matrix, row by row.
    Rotation(Arc<[S; 9]>),
    /// A solid, ready to be emitted.
    Shape(Shape),
    /// A distribution.
    Dist(Arc<Dist<S>>),
    /// A function with the values that it captured.
    Function(Arc<Closure<S>>),
}

impl<S: Scalar> Clone for Value<S> {
    #[inline(always)]
    fn clone(&self) -> Self {
        match self {
            // Nearly every copy is of a number.
            Value::Real(x) => Value::Real(*x),
            Value::Int(n) => Value::Int(*n),
            Value::None => Value::None,
            other => other.clone_other(),
        }
    }

    #[inline(always)]
    #[allow(unsafe_code)]
    fn clone_from(&mut self, source: &Self) {
        // Most registers of a copied run hold plain values, before and after.
        if !self.is_plain() {
            self.assign(source);
        } else if source.is_plain() {
            // SAFETY: both are valid and not the same, as one is borrowed for writing. A plain value owns nothing, so the
            // old one needs no drop, and the bits of the other are a copy of it.
            unsafe { std::ptr::copy_nonoverlapping(source, self, 1) };
        } else {
            self.replace(source.clone_other());
        }
    }
}

/// A reference to an element of a kept collection, by the machine's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// The register that holds the element.
    pub register: u32,
    /// The list of its readers.
    pub readers: u32,
}

impl<S: Scalar> Value<S> {
    #[inline(never)]
    fn clone_other(&self) -> Self {
        match self {
            Value::None => Value::None,
            Value::Bool(b) => Value::Bool(*b),
            Value::Int(n) => Value::Int(*n),
            Value::Real(x) => Value::Real(*x),
            Value::Future(id) => Value::Future(*id),
            Value::Unset => Value::Unset,
            Value::Cell(cell) => Value::Cell(*cell),
            Value::Str(text) => Value::Str(text.clone()),
            Value::Returned(value) => Value::Returned(value.clone()),
            Value::Tuple(tuple) => Value::Tuple(tuple.clone()),
            Value::List(list) => Value::List(list.clone()),
            Value::Dict(dict) => Value::Dict(dict.clone()),
            Value::Record(record) => Value::Record(record.clone()),
            Value::Range(range) => Value::Range(range.clone()),
            Value::Vector(vector) => Value::Vector(vector.clone()),
            Value::Rotation(rotation) => Value::Rotation(rotation.clone()),
            Value::Shape(shape) => Value::Shape(shape.clone()),
            Value::Dist(dist) => Value::Dist(dist.clone()),
            Value::Function(closure) => Value::Function(closure.clone()),
        }
    }

    #[inline(never)]
    fn assign(&mut self, source: &Self) {
        *self = source.clone();
    }

    /// Whether the value holds no shared data: a number, a truth value, `None`.
    #[inline(always)]
    pub fn is_plain(&self) -> bool {
        matches!(
            self,
            Value::None
                | Value::Bool(_)
                | Value::Int(_)
                | Value::Real(_)
                | Value::Future(_)
                | Value::Unset
                | Value::Cell(_)
        )
    }

    /// Whether the value is a vector, a range, or a tuple of up to four values without shared data. Such a
    /// value is so small that registers of the machine may hold it uncounted. Machine code keeps these values
    /// in the processor.
    pub fn is_small(&self) -> bool {
        match self {
            Value::Vector(_) | Value::Range(_) => true,
            Value::Tuple(tuple) => tuple.items().len() <= 4 && tuple.items().iter().all(Value::is_plain),
            _ => false,
        }
    }

    /// Assigns a value. A register nearly always holds a number and gets a number of the same kind: then one
    /// word is written.
    // Writing both words would use the stack, where a value stored as two words and loaded as sixteen
    // bytes delays the next instruction.
    #[inline(always)]
    pub fn store(&mut self, value: Value<S>) {
        match (&mut *self, &value) {
            (Value::Real(old), Value::Real(new)) => *old = *new,
            (Value::Int(old), Value::Int(new)) => *old = *new,
            (Value::Bool(old), Value::Bool(new)) => *old = *new,
            _ => return self.replace(value),
        }
        // The value is a number: there is nothing to drop, but the compiler does not know that.
        std::mem::forget(value);
    }

    /// Assigns a real number.
    #[inline(always)]
    pub fn store_real(&mut self, x: S) {
        match self {
            Value::Real(old) => *old = x,
            other => other.replace(Value::Real(x)),
        }
    }

    /// Assigns a whole number.
    #[inline(always)]
    pub fn store_int(&mut self, n: i64) {
        match self {
            Value::Int(old) => *old = n,
            other => other.replace(Value::Int(n)),
        }
    }

    #[inline(never)]
    fn replace(&mut self, value: Value<S>) {
        if self.is_plain() {
            std::mem::forget(std::mem::replace(self, value));
        } else {
            *self = value;
        }
    }

    /// A real number from an `f64`.
    #[inline]
    pub fn real(x: f64) -> Value<S> {
        Value::Real(S::from_f64(x))
    }

    /// A string.
    pub fn str(text: &str) -> Value<S> {
        Value::Str(Text::from(text))
    }

    /// A tuple.
    pub fn tuple(items: Vec<Value<S>>) -> Value<S> {
        Value::Tuple(Tuple::from(items))
    }

    /// A list.
    pub fn list(items: Vec<Value<S>>) -> Value<S> {
        Value::List(List::from_vec(items))
    }

    /// A vector of two to four components (no more, no fewer).
    pub fn vector(components: &[S]) -> Value<S> {
        Value::Vector(Arc::new(Vector::new(components)))
    }

    /// The name of the value's kind, as in Python.
    pub fn kind(&self) -> &'static str {
        match self {
            Value::None => "None",
            Value::Bool(_) => "bool",
            Value::Int(_) => "int",
            Value::Real(_) => "float",
            Value::Str(_) => "str",
            Value::Tuple(_) => "tuple",
            Value::List(_) => "list",
            Value::Dict(_) => "dict",
            Value::Record(_) => "record",
            Value::Range(_) => "range",
            Value::Vector(_) => "vector",
            Value::Rotation(_) => "rotation",
            Value::Shape(_) => "shape",
            Value::Dist(_) => "distribution",
            Value::Function(_) => "function",
            Value::Future(_) | Value::Returned(_) => "future",
            Value::Unset => "unassigned",
            Value::Cell(_) => "cell",
        }
    }

    /// The value's kind with an article, for messages: "a list", "an int", "a `Leaf`".
    pub fn described(&self) -> String {
        match self {
            Value::None => "None".into(),
            Value::Bool(_) => "a bool".into(),
            Value::Int(_) => "an int".into(),
            Value::Record(record) => format!("a `{}`", record.class.name),
            other => format!("a {}", other.kind()),
        }
    }

    /// Whether a number in the value varies with the coordinates of a recording; for a function, its captures
    /// count.
    pub fn varies(&self) -> bool {
        let any = |mut items: &mut dyn Iterator<Item = &Value<S>>| Iterator::any(&mut items, Value::varies);
        match self {
            Value::Real(x) => x.varies(),
            Value::Vector(v) => v.components().iter().any(|x| x.varies()),
            Value::Rotation(r) => r.iter().any(|x| x.varies()),
            Value::Tuple(items) | Value::Returned(items) => any(&mut items.items().iter()),
            Value::List(list) => any(&mut list.iter()),
            Value::Record(record) => any(&mut record.fields.iter()),
            Value::Function(f) => any(&mut f.captures.iter()),
            Value::Dict(dict) => any(&mut dict.values().iter()),
            Value::Dist(dist) => {
                let varies = std::cell::Cell::new(false);
                dist.convert::<S>(&|x: S| {
                    varies.set(varies.get() || x.varies());
                    x
                });
                varies.get()
            }
            _ => false,
        }
    }

    /// True when the value holds other values: the work lists of this module visit these.
    #[inline]
    pub fn holds_values(&self) -> bool {
        matches!(
            self,
            Value::Tuple(_)
                | Value::Returned(_)
                | Value::List(_)
                | Value::Dict(_)
                | Value::Record(_)
                | Value::Function(_)
        )
    }
}

//! The flat aggregates: tuples, records, dictionaries, closures, ranges and vectors.
//!
//! Each has one allocation behind one thin pointer (a tuple of up to four elements needs no second one).
//! Aggregates hand the values that they hold to `release` when they are dropped, so that nesting costs no host
//! stack.

use std::sync::Arc;

use super::blocks::{block, shared};
use super::census::Census;
use super::{Scalar, Value, compare, release};

/// An immutable tuple.
#[derive(Clone)]
pub struct Tuple<S: Scalar = f64>(pub(super) Arc<TupleBody<S>>);

/// The elements of a tuple. Most tuples of a model are points, pairs and colours: they are stored in place.
pub(super) enum TupleBody<S: Scalar> {
    Single([Value<S>; 1]),
    Two([Value<S>; 2]),
    Three([Value<S>; 3]),
    Four([Value<S>; 4]),
    Other(Vec<Value<S>>),
}

impl<S: Scalar> TupleBody<S> {
    pub(super) fn items_mut(&mut self) -> &mut [Value<S>] {
        match self {
            TupleBody::Single(items) => items,
            TupleBody::Two(items) => items,
            TupleBody::Three(items) => items,
            TupleBody::Four(items) => items,
            TupleBody::Other(items) => items,
        }
    }
}

impl<S: Scalar> Drop for TupleBody<S> {
    fn drop(&mut self) {
        release::release(self.items_mut());
    }
}

impl<S: Scalar> Tuple<S> {
    /// The elements.
    #[inline]
    pub fn items(&self) -> &[Value<S>] {
        match &*self.0 {
            TupleBody::Single(items) => items,
            TupleBody::Two(items) => items,
            TupleBody::Three(items) => items,
            TupleBody::Four(items) => items,
            TupleBody::Other(items) => items,
        }
    }

    pub(super) fn count<'v>(&'v self, census: &mut Census<'v, S>) {
        if census.add_shared(&self.0) {
            match &*self.0 {
                TupleBody::Other(items) => census.add_items(items, items.len()),
                _ => census.add_in_place(self.items()),
            }
        }
    }

    pub(super) fn own_bytes(&self) -> usize {
        let beside = if let TupleBody::Other(items) = &*self.0 { items.len() } else { 0 };
        shared::<TupleBody<S>>() + block(beside * size_of::<Value<S>>())
    }

    /// Its address in memory: no other tuple has it while this one exists.
    #[inline]
    pub fn address(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }

    /// True when both are the same tuple in memory.
    #[inline]
    pub fn ptr_eq(&self, other: &Tuple<S>) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// A tuple of these elements. A short one takes one allocation.
    #[inline]
    pub fn of(mut items: impl ExactSizeIterator<Item = Value<S>>) -> Tuple<S> {
        macro_rules! place {
            ($body:ident) => {
                TupleBody::$body(std::array::from_fn(|_| items.next().unwrap_or_default()))
            };
        }
        Tuple(Arc::new(match items.len() {
            1 => place!(Single),
            2 => place!(Two),
            3 => place!(Three),
            4 => place!(Four),
            _ => TupleBody::Other(items.collect()),
        }))
    }

    /// A tuple of two elements.
    pub fn pair(first: Value<S>, second: Value<S>) -> Tuple<S> {
        Tuple(Arc::new(TupleBody::Two([first, second])))
    }
}

impl<S: Scalar> From<Vec<Value<S>>> for Tuple<S> {
    fn from(items: Vec<Value<S>>) -> Tuple<S> {
        if items.len() > 4 { Tuple(Arc::new(TupleBody::Other(items))) } else { Tuple::of(items.into_iter()) }
    }
}

/// The kinds of record classes, by their behaviour beyond fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClassKind {
    /// A frozen dataclass: compared by class and fields.
    Dataclass,
    /// A `NamedTuple`: also a tuple (indexed, iterated and compared like a tuple).
    NamedTuple,
}

/// A class of records.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Class {
    /// Its number in the program.
    pub id: u32,
    /// Its name in the source.
    pub name: String,
    /// Field names in order.
    pub fields: Vec<String>,
    /// Whether its instances are tuples too.
    pub kind: ClassKind,
}

impl Class {
    /// Whether the class is `Frame`: a place and its directions, which the word `look` returns.
    pub fn is_frame(&self) -> bool {
        self.name == "Frame" && self.fields == ["center", "forward", "up", "radius"]
    }
}

/// An instance of a class.
pub struct Record<S: Scalar = f64> {
    /// The class.
    pub class: Arc<Class>,
    /// One value for each field, in order.
    pub fields: Vec<Value<S>>,
}

impl<S: Scalar> Record<S> {
    /// The value of a field.
    pub fn field(&self, name: &str) -> Option<&Value<S>> {
        let at = self.class.fields.iter().position(|field| field == name)?;
        self.fields.get(at)
    }
}

impl<S: Scalar> Drop for Record<S> {
    fn drop(&mut self) {
        release::release(&mut self.fields);
    }
}

/// The identity of a memoised function: it has one activation for each value of its arguments in a run.
#[derive(Debug, PartialEq, Eq)]
pub struct Memo {
    /// The address of the place where the function was memoised.
    pub path: u128,
    /// The readable form of that address.
    pub name: String,
}

/// A function value: the number of its code, and its captured values.
pub struct Closure<S: Scalar = f64> {
    /// Number of the function in the program.
    pub function: u32,
    /// The identity of a memoised function; `None` for other functions.
    pub memo: Option<Arc<Memo>>,
    /// Captured values, in the order of the function's captures.
    pub captures: Vec<Value<S>>,
}

impl<S: Scalar> Closure<S> {
    /// Bytes of the identity of a memoised function.
    pub(super) fn memo_bytes(&self) -> usize {
        self.memo.as_ref().map_or(0, |memo| size_of::<Memo>() + memo.name.len())
    }
}

impl<S: Scalar> Drop for Closure<S> {
    fn drop(&mut self) {
        release::release(&mut self.captures);
    }
}

/// A dictionary: distinct keys in the order in which they were written, and their values.
pub struct Dict<S: Scalar = f64> {
    pub(super) keys: Vec<Value<S>>,
    pub(super) values: Vec<Value<S>>,
    /// Hash and position of each key, sorted by hash; empty for a dictionary short enough to search.
    index: Vec<(u64, u32)>,
}

impl<S: Scalar> Dict<S> {
    /// The number of keys below which a search is as fast as an index.
    const MAX_WITHOUT_INDEX: usize = 8;

    pub(super) fn count<'v>(&'v self, census: &mut Census<'v, S>) {
        census.add_items(&self.keys, self.keys.len());
        census.add_items(&self.values, self.values.len());
        census.add_bytes(block(self.index.len() * size_of::<(u64, u32)>()));
    }

    /// A dictionary from pairs. A later pair with an equal key replaces the value of an earlier pair, as in
    /// Python. The keys must be hashable: lists and dictionaries are not.
    pub fn new(pairs: Vec<(Value<S>, Value<S>)>) -> Dict<S> {
        let mut dict = Dict { keys: Vec::new(), values: Vec::new(), index: Vec::new() };
        let mut hashed: Vec<(u64, usize)> =
            pairs.iter().enumerate().map(|(at, (key, _))| (compare::hash(key), at)).collect();
        hashed.sort_unstable();
        // `first[i]` is the earliest pair whose key equals that of pair i.
        let mut first: Vec<usize> = (0..pairs.len()).collect();
        for group in hashed.chunk_by(|a, b| a.0 == b.0) {
            for (later, &(_, at)) in group.iter().enumerate() {
                let twin = group[..later].iter().find(|&&(_, earlier)| pairs[earlier].0 == pairs[at].0);
                first[at] = twin.map_or(at, |&(_, earlier)| first[earlier]);
            }
        }
        let mut place = vec![0; pairs.len()];
        for (at, (key, value)) in pairs.into_iter().enumerate() {
            if first[at] == at {
                place[at] = dict.keys.len();
                dict.keys.push(key);
                dict.values.push(value);
            } else {
                dict.values[place[first[at]]] = value;
            }
        }
        if dict.keys.len() > Self::MAX_WITHOUT_INDEX {
            let hashes = dict.keys.iter().enumerate();
            dict.index = hashes.map(|(at, key)| (compare::hash(key), at as u32)).collect();
            dict.index.sort_unstable();
        }
        dict
    }

    /// Number of keys.
    pub fn len(&self) -> usize {
        self.keys.len()
    }

    /// True for a dictionary without keys.
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    /// The keys, in order.
    pub fn keys(&self) -> &[Value<S>] {
        &self.keys
    }

    /// The values, in the order of the keys.
    pub fn values(&self) -> &[Value<S>] {
        &self.values
    }

    /// The value of a key.
    pub fn get(&self, key: &Value<S>) -> Option<&Value<S>> {
        if self.index.is_empty() {
            let at = self.keys.iter().position(|present| present == key)?;
            return self.values.get(at);
        }
        let hash = compare::hash(key);
        let from = self.index.partition_point(|&(present, _)| present < hash);
        let twins = self.index[from..].iter().take_while(|&&(present, _)| present == hash);
        let at = twins.map(|&(_, at)| at as usize).find(|&at| self.keys[at] == *key)?;
        self.values.get(at)
    }
}

impl<S: Scalar> Drop for Dict<S> {
    fn drop(&mut self) {
        release::release(&mut self.keys);
        release::release(&mut self.values);
    }
}

/// `range(start, stop, step)`, with its length computed.
#[derive(Clone, Copy, Debug)]
pub struct Range {
    /// First number.
    pub start: i64,
    /// Where the range ends, exclusive.
    pub stop: i64,
    /// Difference between neighbours; never zero.
    pub step: i64,
    /// The number of elements.
    pub len: usize,
}

impl Range {
    /// A range, or `None` for a step of zero and for more elements than an `i64` counts.
    pub fn new(start: i64, stop: i64, step: i64) -> Option<Range> {
        let (start_, stop_, step_) = (i128::from(start), i128::from(stop), i128::from(step));
        let len = match step {
            0 => return None,
            1.. => (stop_ - start_ + step_ - 1) / step_,
            _ => (start_ - stop_ - step_ - 1) / -step_,
        };
        let len = i64::try_from(len.max(0)).ok()? as usize;
        Some(Range { start, stop, step, len })
    }

    /// The number at a position inside of the range.
    pub fn at(&self, position: usize) -> i64 {
        self.start.wrapping_add(self.step.wrapping_mul(position as i64))
    }

    /// True when both yield the same numbers.
    pub fn equals(&self, other: &Range) -> bool {
        self.len == other.len
            && (self.len == 0 || self.start == other.start)
            && (self.len < 2 || self.step == other.step)
    }
}

/// Two to four real components.
#[derive(Clone, Copy, Debug)]
pub struct Vector<S: Scalar = f64> {
    components: [S; 4],
    len: u8,
}

impl<S: Scalar> Vector<S> {
    /// The places of the components and of their number, a byte, for machine code.
    pub(crate) const COMPONENTS: usize = std::mem::offset_of!(Self, components);
    pub(crate) const LENGTH: usize = std::mem::offset_of!(Self, len);

    /// A vector of up to four components; further components are cut off.
    pub fn new(components: &[S]) -> Vector<S> {
        let mut padded = [S::from_f64(0.0); 4];
        let len = components.len().min(4);
        padded[..len].copy_from_slice(&components[..len]);
        Vector { components: padded, len: len as u8 }
    }

    /// The components.
    #[inline]
    pub fn components(&self) -> &[S] {
        &self.components[..usize::from(self.len)]
    }

    /// Applies a function to each component.
    #[inline]
    pub fn map(&self, f: impl FnMut(S) -> S) -> Vector<S> {
        Vector { components: self.components.map(f), len: self.len }
    }

    /// Combines the components with those of another vector; `None` unless it has as many.
    #[inline]
    pub fn with(&self, other: &Vector<S>, f: impl Fn(S, S) -> S) -> Option<Vector<S>> {
        let mut all = *self;
        let parts = &mut all.components[..usize::from(self.len)];
        parts.iter_mut().zip(&other.components).for_each(|(x, y)| *x = f(*x, *y));
        (self.len == other.len).then_some(all)
    }

    /// The component called `x`, `y`, `z` or `w`.
    pub fn field(&self, name: &str) -> Option<S> {
        let at = ["x", "y", "z", "w"].iter().position(|letter| *letter == name)?;
        self.components().get(at).copied()
    }
}

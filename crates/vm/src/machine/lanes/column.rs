//! The values of one register in all lanes.

use super::Apart;
use crate::value::Value;
use std::sync::Arc;

/// Values that differ from lane to lane.
#[derive(Clone, Debug)]
pub enum Column {
    /// Real numbers.
    Reals(Arc<Vec<f64>>),
    /// Whole numbers.
    Ints(Arc<Vec<i64>>),
    /// Truth values.
    Truths(Arc<Vec<bool>>),
    /// Values of any kinds.
    Values(Arc<Vec<Value>>),
}

impl Column {
    /// The values of a function of the lanes, stored by their kind where they have one.
    ///
    /// # Errors
    /// What the function says of a lane.
    pub(super) fn of(
        lanes: usize,
        mut value: impl FnMut(usize) -> Result<Value, Apart>,
    ) -> Result<Column, Apart> {
        macro_rules! gather {
            ($kind:path, $first:expr) => {{
                let mut all = Vec::with_capacity(lanes);
                all.push($first);
                for lane in 1..lanes {
                    match value(lane)? {
                        $kind(x) => all.push(x),
                        other => {
                            let before = all.into_iter().map($kind);
                            return Column::of_any(before.chain([other]).collect(), lanes, value);
                        }
                    }
                }
                Arc::new(all)
            }};
        }
        Ok(match value(0)? {
            Value::Real(x) => Column::Reals(gather!(Value::Real, x)),
            Value::Int(x) => Column::Ints(gather!(Value::Int, x)),
            Value::Bool(x) => Column::Truths(gather!(Value::Bool, x)),
            first => return Column::of_any(vec![first], lanes, value),
        })
    }

    /// The rest of a column whose kinds differ.
    fn of_any(
        mut all: Vec<Value>,
        lanes: usize,
        mut value: impl FnMut(usize) -> Result<Value, Apart>,
    ) -> Result<Column, Apart> {
        for lane in all.len()..lanes {
            all.push(value(lane)?);
        }
        Ok(Column::Values(Arc::new(all)))
    }

    /// The value in one lane.
    #[inline]
    pub fn get(&self, lane: usize) -> Value {
        match self {
            Column::Reals(all) => Value::Real(all[lane]),
            Column::Ints(all) => Value::Int(all[lane]),
            Column::Truths(all) => Value::Bool(all[lane]),
            Column::Values(all) => all[lane].clone(),
        }
    }

    /// The column whose lane `i` is lane `from[i]` of this one.
    pub fn picked(&self, from: &[u32]) -> Column {
        fn each<T: Clone>(all: &[T], from: &[u32]) -> Arc<Vec<T>> {
            Arc::new(from.iter().map(|lane| all[*lane as usize].clone()).collect())
        }
        match self {
            Column::Reals(all) => Column::Reals(each(all, from)),
            Column::Ints(all) => Column::Ints(each(all, from)),
            Column::Truths(all) => Column::Truths(each(all, from)),
            Column::Values(all) => Column::Values(each(all, from)),
        }
    }
}

/// An operand: a column, or one value for all lanes.
#[derive(Clone, Debug)]
pub(super) enum Side {
    Each(Column),
    All(Value),
}

impl Side {
    /// The value in one lane.
    #[inline]
    pub fn get(&self, lane: usize) -> Value {
        match self {
            Side::Each(column) => column.get(lane),
            Side::All(value) => value.clone(),
        }
    }

    /// Whether every value is stored without shared data.
    pub fn is_plain(&self) -> bool {
        match self {
            Side::Each(Column::Values(all)) => all.iter().all(Value::is_plain),
            Side::Each(_) => true,
            Side::All(value) => value.is_plain(),
        }
    }

    /// Its real numbers, where all are (a whole number that all lanes have counts as one).
    #[inline]
    pub fn reals(&self) -> Option<Numbers<'_, f64>> {
        match self {
            Side::Each(Column::Reals(all)) => Some(Numbers::Each(all)),
            Side::All(Value::Real(x)) => Some(Numbers::One(*x)),
            Side::All(Value::Int(n)) => Some(Numbers::One(*n as f64)),
            _ => None,
        }
    }

    /// Its whole numbers, where all are.
    #[inline]
    pub fn ints(&self) -> Option<Numbers<'_, i64>> {
        match self {
            Side::Each(Column::Ints(all)) => Some(Numbers::Each(all)),
            Side::All(Value::Int(n)) => Some(Numbers::One(*n)),
            _ => None,
        }
    }
}

/// Numbers of one kind.
#[derive(Clone, Copy)]
pub(super) enum Numbers<'a, T> {
    Each(&'a [T]),
    One(T),
}

impl<T: Copy> Numbers<'_, T> {
    /// The results of a function of two numbers. The cases are apart so that each is a loop over slices.
    #[inline(always)]
    pub fn with<U>(self, other: Numbers<'_, T>, lanes: usize, f: impl Fn(T, T) -> U) -> Vec<U> {
        match (self, other) {
            (Numbers::Each(a), Numbers::Each(b)) => a.iter().zip(b).map(|(a, b)| f(*a, *b)).collect(),
            (Numbers::Each(a), Numbers::One(b)) => a.iter().map(|a| f(*a, b)).collect(),
            (Numbers::One(a), Numbers::Each(b)) => b.iter().map(|b| f(a, *b)).collect(),
            (Numbers::One(a), Numbers::One(b)) => (0..lanes).map(|_| f(a, b)).collect(),
        }
    }
}

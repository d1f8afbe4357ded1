//! The values of a register in all lanes.

use super::Divergence;
use crate::value::Value;
use std::sync::Arc;

/// Values that differ between lanes.
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
    /// The values of a function of the lanes, stored by their kind if they have the same kind.
    ///
    /// # Errors
    /// An error of the function for a lane.
    pub(super) fn of(
        lanes: usize,
        mut value: impl FnMut(usize) -> Result<Value, Divergence>,
    ) -> Result<Column, Divergence> {
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

    /// The rest of a column with different kinds of values.
    fn of_any(
        mut all: Vec<Value>,
        lanes: usize,
        mut value: impl FnMut(usize) -> Result<Value, Divergence>,
    ) -> Result<Column, Divergence> {
        for lane in all.len()..lanes {
            all.push(value(lane)?);
        }
        Ok(Column::Values(Arc::new(all)))
    }

    /// The value in a lane.
    #[inline]
    pub fn get(&self, lane: usize) -> Value {
        match self {
            Column::Reals(all) => Value::Real(all[lane]),
            Column::Ints(all) => Value::Int(all[lane]),
            Column::Truths(all) => Value::Bool(all[lane]),
            Column::Values(all) => all[lane].clone(),
        }
    }

    /// A column whose lane `i` is lane `from[i]` of this column.
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
    /// The value in a lane.
    #[inline]
    pub fn get(&self, lane: usize) -> Value {
        match self {
            Side::Each(column) => column.get(lane),
            Side::All(value) => value.clone(),
        }
    }

    /// Whether all values are stored without shared data.
    pub fn is_plain(&self) -> bool {
        match self {
            Side::Each(Column::Values(all)) => all.iter().all(Value::is_plain),
            Side::Each(_) => true,
            Side::All(value) => value.is_plain(),
        }
    }

    /// The real numbers of the operand, if all values are real (a whole number that all lanes share counts as
    /// real).
    #[inline]
    pub fn reals(&self) -> Option<Numbers<'_, f64>> {
        match self {
            Side::Each(Column::Reals(all)) => Some(Numbers::Each(all)),
            Side::All(Value::Real(x)) => Some(Numbers::All(*x)),
            Side::All(Value::Int(n)) => Some(Numbers::All(*n as f64)),
            _ => None,
        }
    }

    /// The whole numbers of the operand, if all values are whole.
    #[inline]
    pub fn ints(&self) -> Option<Numbers<'_, i64>> {
        match self {
            Side::Each(Column::Ints(all)) => Some(Numbers::Each(all)),
            Side::All(Value::Int(n)) => Some(Numbers::All(*n)),
            _ => None,
        }
    }
}

/// Numbers of one kind.
#[derive(Clone, Copy)]
pub(super) enum Numbers<'a, T> {
    Each(&'a [T]),
    All(T),
}

impl<T: Copy> Numbers<'_, T> {
    /// Applies a function to pairs of numbers. The cases are separate so that each is a loop over slices.
    #[inline(always)]
    pub fn with<U>(self, other: Numbers<'_, T>, lanes: usize, f: impl Fn(T, T) -> U) -> Vec<U> {
        match (self, other) {
            (Numbers::Each(a), Numbers::Each(b)) => a.iter().zip(b).map(|(a, b)| f(*a, *b)).collect(),
            (Numbers::Each(a), Numbers::All(b)) => a.iter().map(|a| f(*a, b)).collect(),
            (Numbers::All(a), Numbers::Each(b)) => b.iter().map(|b| f(a, *b)).collect(),
            (Numbers::All(a), Numbers::All(b)) => (0..lanes).map(|_| f(a, b)).collect(),
        }
    }
}

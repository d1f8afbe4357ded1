//! Instructions on columns: loops over the lanes.
//!
//! Numbers of one kind have loops of their own; for other values, each lane does what a single run does. The
//! price of an instruction must be the same in all lanes, because they share one account.

use super::Divergence;
use super::column::{Column, Side};
use super::interpret::Run;
use crate::builtins::{Builtin, make_dist};
use crate::code::{Args, Binary, Op, Operand};
use crate::machine::budget::{self, Price};
use crate::machine::keep::Dropped;
use crate::machine::operate;
use crate::value::{Closure, Dict, Record, Value, index, iter_get, iter_len, ops};
use std::sync::Arc;

/// The result of a function on which all lanes agree.
fn shared<T: PartialEq>(
    lanes: usize,
    mut of: impl FnMut(usize) -> Result<T, Divergence>,
) -> Result<T, Divergence> {
    let first = of(0)?;
    for lane in 1..lanes {
        if of(lane)? != first {
            return Err(Divergence);
        }
    }
    Ok(first)
}

impl Run<'_, '_> {
    fn count(&self) -> usize {
        self.lanes.count
    }

    fn charge(&mut self, price: Price) -> Result<(), Divergence> {
        Ok(self.machine.charge(&mut self.lanes.state, &Dropped, price)?)
    }

    /// Charges bytes, which must be the same in each lane.
    pub fn charge_each(&mut self, bytes: impl Fn(usize) -> usize) -> Result<(), Divergence> {
        let bytes = shared(self.count(), |lane| Ok(bytes(lane)))?;
        if bytes > 0 { self.charge(Price { steps: 0, bytes }) } else { Ok(()) }
    }

    /// Charges the values that an instruction made.
    pub fn charge_results(&mut self, column: &Column) -> Result<(), Divergence> {
        match column {
            Column::Values(all) => self.charge_each(|lane| budget::of_result(&all[lane])),
            _ => Ok(()),
        }
    }

    /// The truth value on which all lanes agree.
    pub fn common_truth(&self, column: &Column) -> Result<bool, Divergence> {
        match column {
            Column::Truths(all) => match all.iter().filter(|truth| **truth).count() {
                0 => Ok(false),
                n if n == all.len() => Ok(true),
                _ => Err(Divergence),
            },
            _ => shared(self.count(), |lane| Ok(ops::truth(&column.get(lane))?)),
        }
    }

    /// The length on which all lanes agree.
    pub fn length(&self, column: &Column) -> Result<usize, Divergence> {
        shared(self.count(), |lane| Ok(iter_len(&column.get(lane))?))
    }

    /// Element `i` of the sequence in each lane.
    pub fn elements(&self, column: &Column, i: usize) -> Result<Column, Divergence> {
        Column::of(self.count(), |lane| Ok(iter_get(&column.get(lane), i)))
    }

    /// Runs an operation on two operands, at least one of which is a column.
    pub fn operate(&mut self, op: Binary, x: &Side, y: &Side) -> Result<Column, Divergence> {
        let lanes = self.count();
        if let (Some(a), Some(b)) = (x.ints(), y.ints()) {
            let overflowed = std::cell::Cell::new(false);
            let each = |f: fn(i64, i64) -> Option<i64>| {
                let all = a.with(b, lanes, |a, b| {
                    f(a, b).unwrap_or_else(|| {
                        overflowed.set(true);
                        0
                    })
                });
                Some(Column::Ints(Arc::new(all)))
            };
            let quick = match op {
                Binary::Add => each(i64::checked_add),
                Binary::Sub => each(i64::checked_sub),
                Binary::Mul => each(i64::checked_mul),
                Binary::Eq => Some(Column::Truths(Arc::new(a.with(b, lanes, |a, b| a == b)))),
                Binary::Lt => Some(Column::Truths(Arc::new(a.with(b, lanes, |a, b| a < b)))),
                _ => None,
            };
            if let Some(column) = quick.filter(|_| !overflowed.get()) {
                return Ok(column);
            }
        } else if let (Some(a), Some(b)) = (x.reals(), y.reals()) {
            let quick = match op {
                Binary::Add => Some(a.with(b, lanes, |a, b| a + b)),
                Binary::Sub => Some(a.with(b, lanes, |a, b| a - b)),
                Binary::Mul => Some(a.with(b, lanes, |a, b| a * b)),
                Binary::Div => {
                    let zero = std::cell::Cell::new(false);
                    let all = a.with(b, lanes, |a, b| {
                        zero.set(zero.get() | (b == 0.0));
                        a / b
                    });
                    if zero.get() {
                        return Err(Divergence);
                    }
                    Some(all)
                }
                _ => None,
            };
            if let Some(all) = quick {
                return Ok(Column::Reals(Arc::new(all)));
            }
        }
        if op != Binary::Index && !(x.is_plain() && y.is_plain()) {
            let price = shared(lanes, |lane| Ok(budget::of_binary(op, &x.get(lane), &y.get(lane))))?;
            self.charge(price)?;
        }
        // If all lanes share a list, its element is found without a copy of the list's handle.
        if let (Binary::Index, Side::All(list)) = (op, x) {
            return Column::of(lanes, |lane| Ok(operate::values(op, list, &y.get(lane))?));
        }
        Column::of(lanes, |lane| Ok(operate::values(op, &x.get(lane), &y.get(lane))?))
    }

    /// Runs a built-in function.
    pub fn builtin(&mut self, to: Operand, builtin: &Builtin, args: Args) -> Result<(), Divergence> {
        let sides = self.sides(args);
        let lanes = if sides.iter().any(|side| matches!(side, Side::Each(_))) { self.count() } else { 1 };
        let mut buffer: Vec<Value> = sides.iter().map(|side| side.get(0)).collect();
        let fill = |buffer: &mut [Value], lane: usize| {
            for (value, side) in buffer.iter_mut().zip(&sides) {
                if let Side::Each(column) = side {
                    *value = column.get(lane);
                }
            }
        };
        if !sides.iter().all(Side::is_plain) {
            let price = shared(lanes, |lane| {
                fill(&mut buffer, lane);
                Ok(budget::of_builtin(builtin, &buffer))
            })?;
            self.machine.charge_passing(&mut self.lanes.state, &Dropped, price)?;
        }
        let result = Column::of(lanes, |lane| {
            fill(&mut buffer, lane);
            Ok(builtin.call(&buffer)?)
        })?;
        if let Column::Values(all) = &result {
            // A longer list shares all but its end with the list before.
            let price = |value: &Value| match builtin.name {
                _ if value.is_plain() => 0,
                "append" => budget::of_append(value),
                _ => budget::of_result(value),
            };
            let bytes = shared(lanes, |lane| Ok(price(&all[lane])))?;
            if bytes > 0 {
                self.charge(Price { steps: 0, bytes })?;
            }
        }
        let is_shared = sides.iter().all(|side| matches!(side, Side::All(_)));
        self.put(to, if is_shared { Side::All(result.get(0)) } else { Side::Each(result) });
        Ok(())
    }

    /// Runs an instruction that builds an aggregate of values that differ.
    pub fn build(&mut self, op: Op, args: Args) -> Result<(), Divergence> {
        let (sides, lanes) = (self.sides(args), self.count());
        let program = self.machine.program;
        let items = |lane: usize| sides.iter().map(|side| side.get(lane)).collect::<Vec<Value>>();
        if let Op::Dist { family, .. } = op {
            let price = shared(lanes, |lane| Ok(budget::of_dist(family, &items(lane))))?;
            self.machine.charge_passing(&mut self.lanes.state, &Dropped, price)?;
        }
        let (to, column) = match op {
            Op::List { to, .. } => (to, Column::of(lanes, |lane| Ok(Value::list(items(lane))))?),
            Op::Tuple { to, .. } => (to, Column::of(lanes, |lane| Ok(Value::tuple(items(lane))))?),
            Op::Dict { to, .. } => {
                let dict = |lane| {
                    let mut keys = items(lane);
                    let values = keys.split_off(keys.len() / 2);
                    Ok(Value::Dict(Arc::new(Dict::new(keys.into_iter().zip(values).collect()))))
                };
                (to, Column::of(lanes, dict)?)
            }
            Op::Record { to, class, .. } => {
                let class = &program.classes[class as usize];
                let record = |lane: usize| {
                    let fields = items(lane).into_iter().collect();
                    Ok(Value::Record(Arc::new(Record { class: class.clone(), fields })))
                };
                (to, Column::of(lanes, record)?)
            }
            Op::Closure { to, function, .. } => {
                let closure = |lane: usize| {
                    let captures = items(lane).into_iter().collect();
                    let function = u32::from(function);
                    Ok(Value::Function(Arc::new(Closure { function, memo: None, captures })))
                };
                (to, Column::of(lanes, closure)?)
            }
            Op::Dist { to, family, .. } => {
                let dist = |lane| Ok(Value::Dist(Arc::new(make_dist(family, &items(lane))?)));
                (to, Column::of(lanes, dist)?)
            }
            _ => return Err(Divergence),
        };
        self.charge_each(|lane| column.get(lane).own_bytes())?;
        self.put(to, Side::Each(column));
        Ok(())
    }

    /// Reads a named field of the value in each lane.
    pub fn field(&mut self, to: Operand, column: &Column, name: u16) -> Result<(), Divergence> {
        let name = &self.f.names[name as usize];
        let column = Column::of(self.count(), |lane| Ok(index::field(&column.get(lane), name)?))?;
        self.put(to, Side::Each(column));
        Ok(())
    }

    /// Stores the elements of the sequence in each lane in registers.
    pub fn unpack(&mut self, column: &Column, to: Args) -> Result<(), Divergence> {
        if self.length(column)? != to.len as usize {
            return Err(Divergence);
        }
        let f = self.f;
        for (k, o) in f.operands[to.range()].iter().enumerate() {
            let element = self.elements(column, k)?;
            self.put(*o, Side::Each(element));
        }
        Ok(())
    }
}

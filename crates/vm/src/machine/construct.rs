//! Instructions that build or unpack an aggregate. They allocate, so a call costs them little. Inside of the
//! loop of `interpret` they would take processor registers from all other instructions.

use super::Machine;
use super::budget::{self, Price};
use super::keep::{Keep, put};
use super::registers::Registers;
use super::state::State;
use crate::builtins;
use crate::code::{Op, Operand};
use crate::fault::Fault;
use crate::value::{Closure, Dict, Record, Tuple, Value, index, iter_get, iter_len};
use niwaki_math::Scalar;
use std::cmp::Ordering;
use std::sync::Arc;

impl<S: Scalar> Machine<'_, S> {
    /// Reads a field of a record or a component of a vector.
    #[inline(never)]
    pub(super) fn field<K: Keep<S>>(
        &mut self,
        state: &mut State<S>,
        keep: &mut K,
        r: Registers<'_, S>,
        (to, a, name): (Operand, Operand, u16),
    ) -> Result<(), Fault> {
        let value = index::field(r.get(state, &self.scratch, a), &r.f.names[name as usize])?;
        put(keep, state, (&mut self.scratch, &mut self.holds_shared), r, to, value);
        Ok(())
    }

    /// Runs an instruction that `interpret` leaves to this file.
    #[inline(never)]
    pub(super) fn construct<K: Keep<S>>(
        &mut self,
        state: &mut State<S>,
        keep: &mut K,
        r: Registers<'_, S>,
        op: Op,
    ) -> Result<(), Fault> {
        let f = r.f;
        macro_rules! gather {
            ($args:expr) => {
                r.gather(state, &self.scratch, $args, &mut self.buffer)
            };
        }
        let (to, value) = match op {
            Op::Field { to, a, name } => return self.field(state, keep, r, (to, a, name)),
            Op::List { to, args } => {
                gather!(args);
                (to, Value::list(self.buffer.drain(..).collect()))
            }
            Op::Tuple { to, args } => {
                let items = f.operands[args.range()].iter();
                (to, Value::Tuple(Tuple::of(items.map(|o| r.get(state, &self.scratch, *o).clone()))))
            }
            Op::Dict { to, args } => {
                gather!(args);
                let values = self.buffer.split_off(self.buffer.len() / 2);
                let pairs = self.buffer.drain(..).zip(values).collect();
                (to, Value::Dict(Arc::new(Dict::new(pairs))))
            }
            Op::Record { to, class, args } => {
                gather!(args);
                let fields = self.buffer.drain(..).collect();
                let class = self.program.classes[class as usize].clone();
                (to, Value::Record(Arc::new(Record { class, fields })))
            }
            Op::Closure { to, function, args } => {
                gather!(args);
                let captures = self.buffer.drain(..).collect();
                (
                    to,
                    Value::Function(Arc::new(Closure {
                        function: u32::from(function),
                        memo: None,
                        captures,
                    })),
                )
            }
            Op::Dist { to, family, args } => {
                gather!(args);
                let price = budget::of_dist(family, &self.buffer);
                self.charge_passing(state, keep, price)?;
                (to, Value::Dist(Arc::new(builtins::make_dist(family, &self.buffer)?)))
            }
            Op::Unpack { from, to } => {
                let names = &f.operands[to.range()];
                if let Value::Tuple(tuple) = r.get(state, &self.scratch, from)
                    && tuple.items().len() == names.len()
                    && !names.contains(&from)
                {
                    // The tuple is read in place: no element is written to its register.
                    for (k, o) in names.iter().enumerate() {
                        let Value::Tuple(tuple) = r.get(state, &self.scratch, from) else { continue };
                        match &tuple.items()[k] {
                            // Most elements are numbers, which are copied as one word.
                            Value::Real(x) if !(K::KEEPS && o.is_node()) => {
                                let x = *x;
                                r.slot(state, &mut self.scratch, *o).store_real(x);
                            }
                            item => {
                                let item = item.clone();
                                put(keep, state, (&mut self.scratch, &mut self.holds_shared), r, *o, item);
                            }
                        }
                    }
                    return Ok(());
                }
                let value = r.get(state, &self.scratch, from).clone();
                let n = iter_len(&value)?;
                if n != to.len as usize {
                    return Err(Fault::new(
                        "unpack-length",
                        format!("cannot unpack {n} values into {} names", to.len),
                    ));
                }
                for (k, o) in f.operands[to.range()].iter().enumerate() {
                    put(keep, state, (&mut self.scratch, &mut self.holds_shared), r, *o, iter_get(&value, k));
                }
                return Ok(());
            }
            Op::UnpackStar { from, to, star } => {
                let value = r.get(state, &self.scratch, from).clone();
                let n = iter_len(&value)?;
                let (count, star) = (to.len as usize, star as usize);
                if n + 1 < count {
                    return Err(Fault::new(
                        "unpack-length",
                        format!("cannot unpack {n} values into {} names and a rest", count - 1),
                    ));
                }
                let rest = n + 1 - count;
                self.charge(state, keep, Price { steps: (rest / 8) as u64, bytes: 40 * rest })?;
                for (k, o) in f.operands[to.range()].iter().enumerate() {
                    let item = match k.cmp(&star) {
                        Ordering::Less => iter_get(&value, k),
                        Ordering::Greater => iter_get(&value, k - 1 + rest),
                        Ordering::Equal => {
                            Value::list((star..star + rest).map(|j| iter_get(&value, j)).collect())
                        }
                    };
                    put(keep, state, (&mut self.scratch, &mut self.holds_shared), r, *o, item);
                }
                return Ok(());
            }
            Op::Assert { a, message } => {
                if !crate::value::ops::truth(r.get(state, &self.scratch, a))? {
                    let text = crate::value::str_of(r.get(state, &self.scratch, message))?;
                    return Err(Fault::new("assertion", text.to_string()));
                }
                return Ok(());
            }
            other => unreachable!("`interpret` runs {other:?} itself"),
        };
        self.charge(state, keep, Price { steps: 0, bytes: value.own_bytes() })?;
        put(keep, state, (&mut self.scratch, &mut self.holds_shared), r, to, value);
        Ok(())
    }
}

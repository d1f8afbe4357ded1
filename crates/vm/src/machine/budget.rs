//! The price of operations, and whether a run may still afford them.
//!
//! New values are charged to the run ([`State::charged`]) and not given back when they are dropped: other
//! threads may decide who drops the last copy. When the sum reaches the ceiling, an audit counts what the run
//! really holds, each shared part once, and the sum begins anew from there. So the count is exact where it
//! decides, and it is the same on any number of threads. A run that drops what it makes is audited once for
//! each so many bytes.
//!
//! Operations on many elements are charged before they run: a value that does not fit is refused before it is
//! allocated.

use super::keep::Keep;
use super::operate;
use super::registers::Registers;
use super::state::State;
use super::workspace::{Machine, PureCall};
use crate::builtins::Builtin;
use crate::code::{Args, Binary, Operand};
use crate::fault::Fault;
use crate::value::{Census, Value, index, ops};
use niwaki_math::{Family, Scalar};

/// The number of elements that cost one step.
const ELEMENTS: usize = 8;

/// The factor by which more elements cost a step when a question builds a distribution.
const PARAMETERS_PER_STEP: u64 = 8;

/// The number of steps between two checks of the limits.
const CHECK_INTERVAL: u64 = 256;

/// The work with each solid of a cut, in elements.
const CUT: usize = 64;

/// The longest sequences without a price beyond that of the new value.
const SHORT: usize = 64;

/// The most bytes that are charged for one element of a value that a function made: a larger element existed
/// before.
const ELEMENT_BYTES: usize = 128;

/// The scratch registers that each run has, whether it uses them or not. A machine keeps as many from one run
/// to the next. If they were charged when they are used, the runs before would decide what a run may afford.
pub(super) const SCRATCH: usize = 256;

/// The price of an operation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Price {
    /// Steps.
    pub steps: u64,
    /// Bytes that are allocated at once.
    pub bytes: usize,
}

impl Price {
    fn of(elements: usize, bytes: usize) -> Price {
        Price { steps: (elements / ELEMENTS) as u64, bytes }
    }
}

/// The number of elements of a sequence, or the work with a cut solid, in elements; 0 for other values.
#[inline]
fn length<S: Scalar>(value: &Value<S>) -> usize {
    match value {
        Value::Str(text) => text.len() / 32,
        Value::Tuple(tuple) => tuple.items().len(),
        Value::List(list) => list.len(),
        Value::Range(range) => range.len,
        Value::Dict(dict) => dict.len(),
        Value::Record(record) => record.fields.len(),
        Value::Shape(shape) => shape.cut().map_or(0, |cut| CUT * cut.solids().len()),
        _ => 0,
    }
}

/// The price of an operation on two values that are not both numbers.
pub(super) fn of_binary<S: Scalar>(op: Binary, a: &Value<S>, b: &Value<S>) -> Price {
    let slot = size_of::<Value<S>>();
    match (op, a, b) {
        (Binary::Add, Value::List(xs), Value::List(ys)) => {
            let added = if xs.is_empty() { 0 } else { ys.len() };
            Price::of(added, b.own_bytes() + slot * (xs.len() % 32) + 64)
        }
        (Binary::Add, Value::Tuple(_) | Value::Str(_), Value::Tuple(_) | Value::Str(_)) => {
            Price::of(length(a) + length(b), a.own_bytes() + b.own_bytes())
        }
        (Binary::Mul, sequence, Value::Int(times)) | (Binary::Mul, Value::Int(times), sequence)
            if length(sequence) > 0 || matches!(sequence, Value::Str(_)) =>
        {
            let times = usize::try_from(*times).unwrap_or(0);
            let count = length(sequence).saturating_mul(times);
            let bytes = match sequence {
                Value::Str(text) => text.len().saturating_mul(times) + 64,
                // A list takes somewhat more than its elements, for the nodes of its trie.
                _ => count.saturating_mul(19).saturating_add(640),
            };
            Price::of(count, bytes)
        }
        (Binary::Add | Binary::Sub | Binary::Mul | Binary::Div, Value::Vector(_) | Value::Rotation(_), _)
        | (Binary::Add | Binary::Sub | Binary::Mul | Binary::Div, _, Value::Vector(_) | Value::Rotation(_)) => {
            Price { steps: 0, bytes: a.own_bytes().max(b.own_bytes()) }
        }
        (Binary::Sub, Value::Shape(_), Value::Shape(_)) => Price::of(2 * CUT + length(a) + length(b), 0),
        (Binary::In, _, sequence) => Price::of(length(sequence), 0),
        (Binary::Index, Value::Str(_), _) => Price { steps: 0, bytes: 64 },
        (Binary::Index, ..) => Price::default(),
        // Comparisons.
        _ => Price::of(length(a).min(length(b)), 0),
    }
}

/// The price of a call of a built-in function, without the value that it returns; zero for short arguments.
#[inline]
pub(super) fn of_builtin<S: Scalar>(builtin: &Builtin<S>, args: &[Value<S>]) -> Price {
    let longest = args.iter().map(length).max().unwrap_or(0);
    if longest <= SHORT { Price::default() } else { of_long(builtin, args, longest) }
}

#[inline(never)]
fn of_long<S: Scalar>(builtin: &Builtin<S>, args: &[Value<S>], longest: usize) -> Price {
    let all: usize = args.iter().map(length).sum();
    let each = |bytes: usize| Price::of(all, all.saturating_mul(bytes));
    match builtin.name {
        "append" | "len" | "options" | "is_none" | "not" | "bool" | "index" | "range" | "isnan" => {
            Price::default()
        }
        "in" | "eq" | "ne" | "lt" | "le" | "gt" | "ge" => Price::of(all, 0),
        "add" => of_binary(Binary::Add, &args[0], &args[1]),
        "mul" => of_binary(Binary::Mul, &args[0], &args[1]),
        "slice" => {
            let count = index::slice_len(&args[0], &args[1], &args[2], &args[3]).unwrap_or(0);
            Price::of(count, 40 * count)
        }
        "sum" | "min" | "max" | "any" | "all" | "hypot" | "gcd" => each(24),
        "zip" | "zip_strict" | "enumerate" => each(144),
        // The elements of a string are its characters.
        "sorted" | "reversed" | "to_list" | "to_tuple" if matches!(args[0], Value::Str(_)) => {
            Price::of(longest, longest.saturating_mul(32 * 96))
        }
        _ => each(80),
    }
}

/// Whether building a distribution from this parameter costs something: the parameter is long, or copied many
/// times.
#[inline(always)]
fn has_price<S: Scalar>(family: Family, value: &Value<S>) -> bool {
    length(value) > SHORT || matches!(family, Family::Mixture | Family::MultivariateGaussian)
}

/// The price of building a distribution from its parameters.
#[inline]
pub(super) fn of_dist<S: Scalar>(family: Family, args: &[Value<S>]) -> Price {
    if !args.iter().any(|value| has_price(family, value)) {
        return Price::default();
    }
    let longest = args.iter().map(length).max().unwrap_or(0);
    let all: usize = args.iter().map(length).sum();
    match family {
        // The covariance is copied and factored.
        Family::MultivariateGaussian => {
            let squared = longest.saturating_mul(longest);
            Price::of(squared.saturating_mul(1 + longest / 64), squared.saturating_mul(32))
        }
        Family::Mixture => Price::of(all, all.saturating_mul(160)),
        _ => Price::of(all, all.saturating_mul(64)),
    }
}

/// Whether distributions of a family have parameters of any length.
#[inline]
pub(super) const fn has_rows(family: Family) -> bool {
    matches!(
        family,
        Family::Categorical
            | Family::Dirichlet
            | Family::MultivariateGaussian
            | Family::DiagonalGaussian
            | Family::Multinomial
            | Family::MultivariateBernoulli
            | Family::Mixture
            | Family::Delta
    )
}

/// The bytes that appending an element to a list takes: a body, and a copy of the last leaf.
pub(super) fn of_append<S: Scalar>(longer: &Value<S>) -> usize {
    96 + (1 + length(longer) % 32) * size_of::<Value<S>>()
}

/// The bytes of the value that an operation made, with those of the elements that it may have made.
#[inline]
pub(super) fn of_result<S: Scalar>(value: &Value<S>) -> usize {
    if value.is_plain() { 0 } else { of_aggregate(value) }
}

#[inline(never)]
fn of_aggregate<S: Scalar>(value: &Value<S>) -> usize {
    let element = |item: &Value<S>| item.own_bytes().min(ELEMENT_BYTES);
    let of_elements = |items: &mut dyn Iterator<Item = &Value<S>>, count: usize| {
        let some: usize = items.take(SHORT).map(element).sum();
        if count <= SHORT { some } else { some.saturating_mul(count) / SHORT }
    };
    value.own_bytes()
        + match value {
            Value::List(list) => of_elements(&mut list.iter(), list.len()),
            Value::Tuple(tuple) => of_elements(&mut tuple.items().iter(), tuple.items().len()),
            _ => 0,
        }
}

impl<S: Scalar> Machine<'_, S> {
    /// The bytes that the machine itself holds for the run: scratch registers and calls of pure functions.
    #[inline]
    pub(super) fn own_bytes(&self) -> usize {
        self.high.max(SCRATCH) * size_of::<Value<S>>() + self.pure.len() * size_of::<PureCall>()
    }

    /// Sets the ceiling of a run that has not begun: it is audited only when it may have used up its memory.
    #[inline]
    pub(super) fn set_ceiling(&self, state: &mut State<S>) {
        if state.ceiling == 0 {
            state.ceiling = self.limits.bytes;
            self.set_alarm(state);
        }
    }

    /// Sets the step of the next check of the limits: slow growth has no other price.
    #[inline]
    pub(super) fn set_alarm(&self, state: &mut State<S>) {
        state.alarm = self.limits.steps.min(state.steps.saturating_add(CHECK_INTERVAL));
    }

    /// Checks both limits.
    ///
    /// # Errors
    /// The run has taken too many steps or bytes.
    #[cold]
    #[inline(never)]
    pub(super) fn check_limits<K: Keep<S>>(&self, state: &mut State<S>, keep: &K) -> Result<(), Fault> {
        if state.steps > self.limits.steps {
            return Err(self.out_of_steps());
        }
        self.set_alarm(state);
        self.afford(state, keep)
    }

    /// Drops what an earlier run left in the scratch registers: the memory of a run must not depend on it.
    #[inline]
    pub(super) fn empty_scratch(&mut self) {
        self.pure.clear();
        if self.holds_shared {
            self.holds_shared = false;
            let shared = self.scratch[..self.high].iter_mut().filter(|value| !value.is_plain());
            shared.for_each(|value| *value = Value::None);
        }
        // After a deep recursion, most of the registers are not needed again.
        self.high = self.high.min(SCRATCH);
    }

    /// Charges an operation before it makes its result.
    ///
    /// # Errors
    /// The run takes too many steps or bytes.
    #[inline]
    pub(super) fn charge<K: Keep<S>>(
        &self,
        state: &mut State<S>,
        keep: &K,
        price: Price,
    ) -> Result<(), Fault> {
        state.charged = state.charged.saturating_add(price.bytes);
        state.steps = state.steps.saturating_add(price.steps);
        if price.steps > 0 && state.steps > self.limits.steps {
            return Err(self.out_of_steps());
        }
        if state.bytes() > state.ceiling {
            return self.audit(state, keep, price.bytes);
        }
        Ok(())
    }

    /// Charges a price and gives its bytes back at once: they belong to the operation, not to its result.
    ///
    /// # Errors
    /// The run takes too many steps or bytes.
    #[inline]
    pub(super) fn charge_passing<K: Keep<S>>(
        &self,
        state: &mut State<S>,
        keep: &K,
        price: Price,
    ) -> Result<(), Fault> {
        if price == Price::default() {
            return Ok(());
        }
        self.charge(state, keep, price)?;
        state.charged -= price.bytes;
        Ok(())
    }

    /// Runs an operation on two values, and charges its price.
    ///
    /// # Errors
    /// The run takes too many steps or bytes, or an error of [`operate::values`].
    #[inline(never)]
    pub(super) fn operate<K: Keep<S>>(
        &self,
        state: &mut State<S>,
        keep: &K,
        r: Registers<'_, S>,
        op: Binary,
        (a, b): (Operand, Operand),
    ) -> Result<Value<S>, Fault> {
        let (x, y) = (r.get(state, &self.scratch, a), r.get(state, &self.scratch, b));
        if x.is_plain() && y.is_plain() {
            return operate::values(op, x, y);
        }
        let price = match (x, y) {
            // All vectors take the same memory.
            (Value::Vector(_), Value::Vector(_) | Value::Real(_)) | (Value::Real(_), Value::Vector(_))
                if matches!(op, Binary::Add | Binary::Sub | Binary::Mul | Binary::Div) =>
            {
                Price { steps: 0, bytes: Value::<S>::VECTOR_BYTES }
            }
            _ => of_binary(op, x, y),
        };
        self.charge(state, keep, price)?;
        operate::values(op, r.get(state, &self.scratch, a), r.get(state, &self.scratch, b))
    }

    /// Compares two values that are not plain, and charges the price.
    ///
    /// # Errors
    /// As for [`Machine::operate`].
    #[inline(never)]
    pub(super) fn compare<K: Keep<S>>(
        &self,
        state: &mut State<S>,
        keep: &K,
        r: Registers<'_, S>,
        op: Binary,
        operands: (Operand, Operand),
    ) -> Result<bool, Fault> {
        match self.operate(state, keep, r, op, operands)? {
            Value::Bool(holds) => Ok(holds),
            other => ops::truth(&other),
        }
    }

    /// Charges the price of a built-in function with one argument.
    ///
    /// # Errors
    /// The run takes too many steps or bytes.
    #[inline(never)]
    pub(super) fn charge_argument<K: Keep<S>>(
        &self,
        state: &mut State<S>,
        keep: &K,
        r: Registers<'_, S>,
        builtin: &Builtin<S>,
        a: Operand,
    ) -> Result<(), Fault> {
        let price = of_builtin(builtin, std::slice::from_ref(r.get(state, &self.scratch, a)));
        self.charge_passing(state, keep, price)
    }

    /// Charges the price of a built-in function with the arguments in the buffer.
    ///
    /// # Errors
    /// The run takes too many steps or bytes.
    #[inline(never)]
    pub(super) fn charge_arguments<K: Keep<S>>(
        &self,
        state: &mut State<S>,
        keep: &K,
        builtin: &Builtin<S>,
    ) -> Result<(), Fault> {
        self.charge_passing(state, keep, of_builtin(builtin, &self.buffer))
    }

    /// Charges the value that a built-in function made.
    ///
    /// # Errors
    /// The run takes too many bytes.
    #[inline(never)]
    pub(super) fn charge_answer<K: Keep<S>>(
        &self,
        state: &mut State<S>,
        keep: &K,
        builtin: &Builtin<S>,
        value: &Value<S>,
    ) -> Result<(), Fault> {
        // A longer list shares all but its end with the list before.
        let bytes = if builtin.name == "append" { of_append(value) } else { of_aggregate(value) };
        self.charge(state, keep, Price { steps: 0, bytes })
    }

    /// Charges the building of a distribution by a question. The cache has most of these distributions, so they
    /// cost fewer steps.
    ///
    /// # Errors
    /// The run takes too many steps or bytes.
    #[inline(always)]
    pub(super) fn charge_rows<K: Keep<S>>(
        &self,
        state: &mut State<S>,
        keep: &K,
        r: Registers<'_, S>,
        args: Args,
        family: Family,
    ) -> Result<(), Fault> {
        let operands = &r.f.operands[args.range()];
        let has_price = |o: &Operand| has_price(family, r.get(state, &self.scratch, *o));
        if has_rows(family) && operands.iter().any(has_price) {
            return self.charge_long_rows(state, keep, r, operands, family);
        }
        Ok(())
    }

    /// The rare part of [`Machine::charge_rows`].
    ///
    /// # Errors
    /// The run takes too many steps or bytes.
    #[cold]
    #[inline(never)]
    fn charge_long_rows<K: Keep<S>>(
        &self,
        state: &mut State<S>,
        keep: &K,
        r: Registers<'_, S>,
        operands: &[Operand],
        family: Family,
    ) -> Result<(), Fault> {
        let prices =
            operands.iter().map(|o| of_dist(family, std::slice::from_ref(r.get(state, &self.scratch, *o))));
        let price = prices.reduce(|a, b| Price { steps: a.steps.max(b.steps), bytes: a.bytes.max(b.bytes) });
        let price = price.unwrap_or_default();
        self.charge_passing(state, keep, Price { steps: price.steps / PARAMETERS_PER_STEP, ..price })
    }

    /// Audits a run that has grown, if an audit is due.
    ///
    /// # Errors
    /// The run takes too many bytes.
    #[inline]
    pub(super) fn afford<K: Keep<S>>(&self, state: &mut State<S>, keep: &K) -> Result<(), Fault> {
        if state.bytes() + self.own_bytes() > state.ceiling { self.audit(state, keep, 0) } else { Ok(()) }
    }

    /// Counts what a run holds between two questions, so that values that it has dropped no longer count.
    pub fn recount(&mut self, state: &mut State<S>) {
        self.empty_scratch();
        state.charged = self.values_of(state, &super::keep::Dropped);
    }

    fn values_of<K: Keep<S>>(&self, state: &State<S>, keep: &K) -> usize {
        let mut census = Census::new();
        self.leave_out_inputs(state, &mut census);
        state.count(&mut census);
        // Small values that are in no other value do not count: where machine code ran, they may not exist any
        // more.
        let scratch = self.scratch[..self.high].iter().filter(|value| !value.is_small());
        scratch.for_each(|value| census.add(value));
        keep.count_bytes(&mut census);
        census.bytes()
    }

    /// Excludes the values of the program and of the caller from a census.
    pub fn leave_out_inputs(&self, state: &State<S>, census: &mut Census<'_, S>) {
        self.program.leave_out(census);
        state.leave_out_inputs(census);
    }

    /// Counts what the run holds. `coming` of the charged bytes are not allocated yet.
    ///
    /// # Errors
    /// The run holds more bytes than it may.
    #[cold]
    #[inline(never)]
    pub(super) fn audit<K: Keep<S>>(
        &self,
        state: &mut State<S>,
        keep: &K,
        coming: usize,
    ) -> Result<(), Fault> {
        if self.in_lanes {
            // The values that differ between lanes are not in the state, so they cannot be counted here.
            return Err(self.out_of_memory());
        }
        let limit = self.limits.bytes;
        let values = self.values_of(state, keep);
        state.charged = values.saturating_add(coming);
        let total = state.bytes().saturating_add(self.own_bytes());
        if total > limit {
            return Err(self.out_of_memory());
        }
        state.ceiling = state.bytes() + (limit - total).max(limit / 32);
        Ok(())
    }
}

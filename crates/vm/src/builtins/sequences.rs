//! Functions that build, order and fold sequences.

use std::sync::Arc;

use super::answer::{Answer, less};
use super::arithmetic::{real, whole};
use crate::fault::Fault;
use crate::value::index::{iter_all, iter_len};
use crate::value::numbers::Number;
use crate::value::{Range, Scalar, Tuple, Value, ops};

/// `sum(xs)` or `sum(xs, start)`: added from left to right, beginning with the int 0.
pub fn sum<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let mut total = args.get(1).cloned().unwrap_or(Value::Int(0));
    if matches!(total, Value::Str(_)) {
        return Err(Fault::type_mismatch("cannot sum strings").with_help("write `\"\".join(xs)`"));
    }
    for item in iter_all(&args[0])? {
        total = ops::add(&total, &item)?;
    }
    Ok(total)
}

/// The first of the least (`min`) or greatest (`max`) items, in the order of the items or of their keys.
pub fn extreme<S: Scalar>(name: &str, items: &[Value<S>], keys: Option<&[Value<S>]>) -> Answer<S> {
    let keys = keys.unwrap_or(items);
    if keys.len() != items.len() {
        let (keys, items) = (keys.len(), items.len());
        return Err(Fault::bad_argument(format!("`{name}` has {keys} keys for {items} elements")));
    }
    if std::ptr::eq(keys, items) && items.iter().any(|item| matches!(item, Value::Real(x) if x.varies())) {
        // The result is recorded as one operation, which has a slope on either side. A comparison would add a
        // guard for the winner.
        let numbers: Option<Vec<S>> = items.iter().map(|item| Number::of(item).map(Number::real)).collect();
        if let Some(best) =
            numbers.and_then(|x| x.into_iter().reduce(if name == "min" { S::min } else { S::max }))
        {
            return Ok(Value::Real(best));
        }
    }
    let mut best = 0;
    for at in 1..items.len() {
        let (new, old) = (&keys[at], &keys[best]);
        if if name == "min" { less(new, old)? } else { less(old, new)? } {
            best = at;
        }
    }
    let empty = || Fault::bad_argument(format!("`{name}` of no elements")).with_help("test the length first");
    items.get(best).cloned().ok_or_else(empty)
}

/// `sorted(xs)` or `sorted(xs, reverse)`.
pub fn sorted<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let items = iter_all(&args[0])?;
    let order = stable_order(&items, args.get(1).map_or(Ok(false), ops::truth)?)?;
    Ok(Value::list(order.into_iter().map(|at| items[at].clone()).collect()))
}

/// `sorted_by(xs, keys)` or `sorted_by(xs, keys, reverse)`: the elements in the order of their keys.
pub fn sorted_by<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (items, keys) = (iter_all(&args[0])?, iter_all(&args[1])?);
    if keys.len() != items.len() {
        let (keys, items) = (keys.len(), items.len());
        return Err(Fault::bad_argument(format!("`sorted` has {keys} keys for {items} elements")));
    }
    let order = stable_order(&keys, args.get(2).map_or(Ok(false), ops::truth)?)?;
    Ok(Value::list(order.into_iter().map(|at| items[at].clone()).collect()))
}

/// The positions in ascending (or descending) order of the keys. Equal keys keep their order, also in reverse.
///
/// This is a merge sort of our own: it uses only `<`, may stop at a fault, and accepts NaN, for which the
/// standard library's sort may panic.
fn stable_order<S: Scalar>(keys: &[Value<S>], reverse: bool) -> Result<Vec<usize>, Fault> {
    let before =
        |a: usize, b: usize| if reverse { less(&keys[b], &keys[a]) } else { less(&keys[a], &keys[b]) };
    let mut order: Vec<usize> = (0..keys.len()).collect();
    let mut merged = Vec::with_capacity(order.len());
    let mut width = 1;
    while width < order.len() {
        merged.clear();
        for pair in order.chunks(2 * width) {
            let (mut left, mut right) = pair.split_at(width.min(pair.len()));
            while let (Some(&a), Some(&b)) = (left.first(), right.first()) {
                if before(b, a)? {
                    merged.push(b);
                    right = &right[1..];
                } else {
                    merged.push(a);
                    left = &left[1..];
                }
            }
            merged.extend_from_slice(left);
            merged.extend_from_slice(right);
        }
        std::mem::swap(&mut order, &mut merged);
        width *= 2;
    }
    Ok(order)
}

/// Whether an element has the truth value `truth`; later elements are not read.
pub fn has<S: Scalar>(items: &Value<S>, truth: bool) -> Result<bool, Fault> {
    for item in iter_all(items)? {
        if ops::truth(&item)? == truth {
            return Ok(true);
        }
    }
    Ok(false)
}

/// `reversed(xs)`, as a list.
pub fn reversed<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let mut items = iter_all(&args[0])?;
    items.reverse();
    Ok(Value::list(items))
}

/// `enumerate(xs)` or `enumerate(xs, start)`, as a list of pairs.
pub fn enumerate<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let items = iter_all(&args[0])?;
    let start = args.get(1).map_or(Ok(0), |start| whole("enumerate", start))?;
    if start.checked_add(items.len() as i64).is_none() {
        return Err(Fault::integer_overflow("the numbers of `enumerate` do not fit in 64 bits"));
    }
    let pairs = (start..).zip(items).map(|(n, item)| Value::Tuple(Tuple::pair(Value::Int(n), item)));
    Ok(Value::list(pairs.collect()))
}

/// `zip(xs, ys, ...)`, as a list of tuples that is as long as the shortest sequence.
pub fn zip<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let columns: Vec<Vec<Value<S>>> = args.iter().map(iter_all).collect::<Result<_, _>>()?;
    let rows = columns.iter().map(Vec::len).min().unwrap_or(0);
    let row = |at: usize| Value::tuple(columns.iter().map(|column| column[at].clone()).collect());
    Ok(Value::list((0..rows).map(row).collect()))
}

/// `zip(xs, ys, ..., strict=True)`: all sequences must have the same length.
pub fn zip_strict<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    for pair in args.windows(2) {
        let (first, second) = (iter_len(&pair[0])?, iter_len(&pair[1])?);
        if first != second {
            let message = format!("`zip` has sequences of {first} and {second} elements");
            return Err(Fault::bad_argument(message));
        }
    }
    zip(args)
}

/// `range(stop)`, `range(start, stop)`, `range(start, stop, step)`.
pub fn range<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let number = |at: usize| whole("range", &args[at]);
    let (start, stop, step) = match args.len() {
        1 => (0, number(0)?, 1),
        2 => (number(0)?, number(1)?, 1),
        _ => (number(0)?, number(1)?, number(2)?),
    };
    if step == 0 {
        return Err(Fault::bad_argument("the step of a range cannot be zero"));
    }
    let too_long = || Fault::integer_overflow("the length of this range does not fit in 64 bits");
    Range::new(start, stop, step).map(|range| Value::Range(Arc::new(range))).ok_or_else(too_long)
}

/// `linspace(lo, hi, count)`: numbers at equal distances, with both ends.
pub fn linspace<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (lo, hi) = (real("linspace", &args[0])?, real("linspace", &args[1])?);
    let count = whole("linspace", &args[2])?;
    if count < 1 {
        return Err(Fault::bad_argument(format!("`linspace` gives 1 number or more, not {count}")));
    }
    let last = count - 1;
    let number = |k: i64| match k {
        0 => lo,
        k if k == last => hi,
        k => lo + (hi - lo) * S::from_f64(k as f64 / last as f64),
    };
    // The numbers of a range are counted before they take memory.
    let places = iter_all(&range::<S>(&[Value::Int(count)])?)?;
    let place = |value: &Value<S>| if let Value::Int(k) = value { *k } else { 0 };
    Ok(Value::list(places.iter().map(|value| Value::Real(number(place(value)))).collect()))
}

/// `list(xs)`.
pub fn to_list<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    match args.first() {
        None => Ok(Value::list(Vec::new())),
        Some(Value::List(list)) => Ok(Value::List(list.clone())),
        Some(value) => iter_all(value).map(Value::list),
    }
}

/// `tuple(xs)`.
pub fn to_tuple<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    match args.first() {
        None => Ok(Value::tuple(Vec::new())),
        Some(Value::Tuple(tuple)) => Ok(Value::Tuple(tuple.clone())),
        Some(value) => iter_all(value).map(Value::tuple),
    }
}

/// The options of `choose`: any sequence as it is. A dict has weights, whose distribution is another one: it must be known
/// when the model is compiled.
pub fn options<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    match &args[0] {
        Value::Dict(_) => Err(Fault::type_mismatch(
            "`choose` takes a dict that is written at the call or is a constant of the module, and no other",
        )
        .with_help("pass the values and the weights: `choose(list(d), list(d.values()))`")),
        sequence => Ok(sequence.clone()),
    }
}

#[cfg(test)]
mod tests {
    use crate::builtins::tests::{V, call, code, ints, reals};

    #[test]
    fn sorting_is_stable_in_both_directions() {
        let mixed = || V::list(vec![V::Int(2), V::real(1.0), V::Int(1), V::Bool(true), V::Int(0)]);
        let text = |value: V| format!("{value:?}");
        assert_eq!(text(call("sorted", &[mixed()]).unwrap()), "[0, 1.0, 1, True, 2]");
        assert_eq!(text(call("sorted", &[mixed(), V::Bool(true)]).unwrap()), "[2, 1.0, 1, True, 0]");
        let words = V::list(["bb", "a", "cc", "d"].map(V::str).to_vec());
        let lengths = ints([2, 1, 2, 1]);
        let by = call("sorted_by", &[words.clone(), lengths.clone()]).unwrap();
        assert_eq!(text(by), "['a', 'd', 'bb', 'cc']");
        let by = call("sorted_by", &[words.clone(), lengths.clone(), V::Bool(true)]).unwrap();
        assert_eq!(text(by), "['bb', 'cc', 'a', 'd']");
        assert_eq!(call("argmax_by", &[words.clone(), lengths.clone()]), Ok(V::str("bb")));
        assert_eq!(call("argmin_by", &[words, lengths]), Ok(V::str("a")));
        assert_eq!(code("sorted", &[V::list(vec![V::Int(1), V::str("a")])]), "type-mismatch");
        let many: Vec<i64> = (0..1000).map(|n| n * 7919 % 1009).collect();
        let mut expected = many.clone();
        expected.sort_unstable();
        assert_eq!(call("sorted", &[ints(many)]), Ok(ints(expected)));
        let nans = reals((0..100).map(|n| if n % 3 == 0 { f64::NAN } else { 100.0 - f64::from(n) }));
        assert!(call("sorted", &[nans]).is_ok());
    }

    #[test]
    fn min_and_max_return_the_first_of_equals() {
        let text = |value: V| format!("{value:?}");
        assert_eq!(text(call("max", &[V::Int(1), V::real(1.0), V::Bool(true)]).unwrap()), "1");
        assert_eq!(text(call("min", &[V::list(vec![V::real(1.0), V::Int(1)])]).unwrap()), "1.0");
        assert_eq!(code("min", &[V::list(vec![])]), "bad-argument");
        assert_eq!(code("max", &[V::Int(1)]), "type-mismatch");
    }

    #[test]
    fn folds_and_pairs_agree_with_python() {
        assert_eq!(format!("{:?}", call("sum", &[V::list(vec![])]).unwrap()), "0");
        assert_eq!(call("sum", &[reals([0.1; 10])]), Ok(V::real(0.999_999_999_999_999_9)));
        assert_eq!(call("sum", &[V::list(vec![ints([1]), ints([2])]), V::list(vec![])]), Ok(ints([1, 2])));
        assert_eq!(code("sum", &[ints([i64::MAX, 1])]), "integer-overflow");
        assert_eq!(call("any", &[ints([0, 2])]), Ok(V::Bool(true)));
        assert_eq!(call("all", &[V::list(vec![])]), Ok(V::Bool(true)));
        let text = |name: &str, args: &[V]| format!("{:?}", call(name, args).unwrap());
        assert_eq!(text("enumerate", &[V::str("ab"), V::Int(1)]), "[(1, 'a'), (2, 'b')]");
        assert_eq!(text("zip", &[ints([1, 2, 3]), V::str("ab")]), "[(1, 'a'), (2, 'b')]");
        assert_eq!(code("zip_strict", &[ints([1, 2, 3]), V::str("ab")]), "bad-argument");
        assert_eq!(text("reversed", &[V::str("ab")]), "['b', 'a']");
        assert_eq!(text("range", &[V::Int(3)]), "range(0, 3)");
        let range = call("range", &[V::Int(5), V::Int(0), V::Int(-2)]).unwrap();
        assert_eq!(call("to_list", &[range]), Ok(ints([5, 3, 1])));
        assert_eq!(code("range", &[V::Int(0), V::Int(1), V::Int(0)]), "bad-argument");
        assert_eq!(code("to_list", &[call("range", &[V::Int(1 << 40)]).unwrap()]), "memory-budget");
    }
}

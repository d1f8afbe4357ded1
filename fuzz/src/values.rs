//! Built-in functions: any arguments give a value or a fault.

use crate::distributions::dist;
use crate::numbers::{below, byte, near, real, whole};
use crate::solids::shape;
use arbitrary::Unstructured;
use niwaki_geom::Mat3;
use niwaki_vm::builtins::builtins;
use niwaki_vm::fault::Fault;
use niwaki_vm::value::{Class, ClassKind, Dict, Range, Record, Value, equal, identical, order, repr, str_of};
use std::sync::Arc;

/// Whole numbers that count elements are seldom larger: a list of 2^26 elements takes a second.
const COUNT: i64 = 5000;

/// Calls built-in functions, the results of some as the arguments of others.
///
/// # Panics
/// When a fault has no message, or a value is not the same as itself.
pub fn check(bytes: &[u8]) {
    let u = &mut Unstructured::new(bytes);
    let table = builtins::<f64>();
    let mut known: Vec<Value> = vec![];
    for _ in 0..=below(u, 8) {
        let builtin = &table[below(u, table.len().min(256))];
        let most = builtin.max_args.min(builtin.min_args + 4);
        let count = builtin.min_args + below(u, most - builtin.min_args + 1);
        let args: Vec<Value> = (0..count)
            .map(|_| match known.len() {
                n if n > 0 && below(u, 3) == 0 => known[below(u, n)].clone(),
                _ => value(u, 3),
            })
            .collect();
        match builtin.call(&args) {
            Ok(answer) => {
                look_at(&answer, &known);
                known.push(answer);
            }
            Err(fault) => {
                assert!(Fault::CODES.contains(&fault.code) && !fault.message.is_empty(), "{fault:?}");
            }
        }
    }
}

/// What every value can be asked.
fn look_at(value: &Value, others: &[Value]) {
    assert!(identical(value, &value.clone()), "{value:?} is not itself");
    let _ = (repr(value), str_of(value));
    for other in others {
        let there = equal(value, other).ok();
        let back = equal(other, value).ok();
        assert_eq!(there, back, "{value:?} == {other:?}");
        let _ = order(value, other, "<");
    }
}

/// A value; its parts are nested at most so deep.
fn value(u: &mut Unstructured<'_>, deep: usize) -> Value {
    let items = |u: &mut Unstructured<'_>| -> Vec<Value> {
        (0..below(u, 5)).map(|_| value(u, deep.saturating_sub(1))).collect()
    };
    match below(u, if deep == 0 { 8 } else { 16 }) {
        0 => Value::None,
        1 => Value::Bool(byte(u) & 1 == 1),
        2 | 3 => Value::Int(bounded(whole(u), u)),
        4 | 5 => Value::Real(real(u)),
        6 => Value::str(text(u)),
        7 => {
            let numbers: Vec<f64> = (0..2 + below(u, 3)).map(|_| real(u)).collect();
            Value::vector(&numbers)
        }
        8 => Value::tuple(items(u)),
        9 => Value::list(items(u)),
        10 => {
            let pairs = items(u).into_iter().enumerate().map(|(k, item)| (Value::Int(k as i64), item));
            Value::Dict(Arc::new(Dict::new(pairs.collect())))
        }
        11 => {
            let range = Range::new(bounded(whole(u), u), bounded(whole(u), u), whole(u));
            range.map_or(Value::None, |range| Value::Range(Arc::new(range)))
        }
        12 => near(u).unit().map_or(Value::None, |axis| {
            let rows = Mat3::rotation(axis, real(u)).rows();
            Value::Rotation(Arc::new(std::array::from_fn(|k| rows[k / 3][k % 3])))
        }),
        13 => shape(u).map_or(Value::None, Value::Shape),
        14 => dist(u, 2).map_or(Value::None, |dist| Value::Dist(Arc::new(dist))),
        _ => {
            let fields = items(u);
            let names = (0..fields.len()).map(|k| format!("f{k}")).collect();
            let class = Class { id: 0, kind: ClassKind::Dataclass, name: "Part".into(), fields: names };
            Value::Record(Arc::new(Record { class: Arc::new(class), fields }))
        }
    }
}

/// Extreme numbers stay; of large ones that could count elements there are few.
fn bounded(n: i64, u: &mut Unstructured<'_>) -> i64 {
    if (COUNT..1 << 40).contains(&n) && byte(u) > 0 { n % COUNT } else { n }
}

/// A short text: of words that functions know, or of any characters.
fn text<'a>(u: &mut Unstructured<'a>) -> &'a str {
    const WORDS: [&str; 24] = [
        "",
        " ",
        "x",
        "a b",
        "\u{e9}\u{1F600}",
        "split",
        "join",
        "format",
        "index",
        "count",
        "upper",
        "strip",
        "get",
        "items",
        "keys",
        "values",
        ">10.3f",
        "{}",
        "{:,}",
        "0",
        "1e5",
        "nan",
        "replace",
        "05d",
    ];
    match byte(u) {
        0..160 => WORDS[below(u, WORDS.len())],
        _ => u.arbitrary().unwrap_or(""),
    }
}

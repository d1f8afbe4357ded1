//! `repr` and `str` as Python writes them, with a stack of our own and a limit on the length of the text.

use super::{List, MAX_ELEMENTS, Scalar, Value};
use crate::fault::{Fault, InvalidCall};

/// Python's `repr` of a float: the shortest digits that are read back, with an exponent below 1e-4 and from
/// 1e16 on.
pub fn float(x: f64) -> String {
    if !x.is_finite() {
        return if x.is_nan() {
            "nan".into()
        } else if x > 0.0 {
            "inf".into()
        } else {
            "-inf".into()
        };
    }
    // The standard library gives the fewest digits that are read back. If two such texts are equally near,
    // Python takes the even one: the result of rounding the exact value to that many digits.
    let shortest = format!("{x:e}");
    let places = shortest.bytes().take_while(|byte| *byte != b'e').filter(u8::is_ascii_digit).count();
    let even = format!("{x:.*e}", places.saturating_sub(1));
    let text = if even.parse() == Ok(x) { even } else { shortest };
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let size = x.abs();
    if size == 0.0 || (1e-4..1e16).contains(&size) {
        let decimals = (places as i32 - 1 - exponent).max(1) as usize;
        return format!("{x:.decimals$}");
    }
    // Rust writes 1e16 and 1.5e-7. Python adds a sign to the exponent and gives it two digits.
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{digits}e{sign}{:02}", exponent.abs())
}

/// Python's `repr` of a string: single quotes, unless the string holds single and no double quotes.
pub fn quoted(text: &str) -> String {
    let quote = if text.contains('\'') && !text.contains('"') { '"' } else { '\'' };
    let mut out = String::with_capacity(text.len() + 2);
    out.push(quote);
    for c in text.chars() {
        match c {
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            '\\' => out.push_str("\\\\"),
            c if c == quote => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() && (c as u32) < 0x100 => out.push_str(&format!("\\x{:02x}", c as u32)),
            c => out.push(c),
        }
    }
    out.push(quote);
    out
}

/// Python's `str(value)`.
pub fn str_of<S: Scalar>(value: &Value<S>) -> Result<String, Fault> {
    match value {
        Value::Str(text) => Ok(text.to_string()),
        other => repr(other),
    }
}

/// An aggregate that is being printed.
struct Open<'a, S: Scalar> {
    items: Items<'a, S>,
    next: usize,
    close: &'static str,
}

enum Items<'a, S: Scalar> {
    Flat(&'a [Value<S>]),
    List(&'a List<S>),
    /// Values with a label before each.
    Labelled(Labels<'a, S>, &'a [Value<S>]),
}

enum Labels<'a, S: Scalar> {
    Keys(&'a [Value<S>]),
    Fields(&'a [String]),
}

/// Python's `repr(value)`.
pub fn repr<S: Scalar>(value: &Value<S>) -> Result<String, Fault> {
    let (mut out, fixed) = (String::new(), |x: S| if x.varies() { None } else { Some(x.value()) });
    if write(value, &mut out, MAX_ELEMENTS, &fixed)? {
        return Ok(out);
    }
    Err(Fault::memory_budget("the text of this value has more than 67108864 characters"))
}

/// The longest text of a call, in bytes.
const CALL: usize = 240;

/// A call as text for a person, without `None` arguments at the end. A long text is cut off.
pub fn call_text<S: Scalar>(name: &str, args: &[Value<S>]) -> String {
    let last = args.iter().rposition(|arg| !matches!(arg, Value::None)).map_or(0, |at| at + 1);
    let mut out = format!("{name}(");
    for (at, arg) in args[..last].iter().enumerate() {
        if at > 0 {
            out.push_str(", ");
        }
        // A future that is not forced has no text.
        if !matches!(write(arg, &mut out, CALL, &|x| Some(x.value())), Ok(true)) || out.len() > CALL {
            let end = (0..=CALL.min(out.len())).rfind(|end| out.is_char_boundary(*end)).unwrap_or(0);
            out.truncate(end);
            out.push_str("...");
            break;
        }
    }
    out.push(')');
    out
}

/// Writes a value up to `most` bytes, with the numbers that `number` returns. Returns whether the text is
/// complete.
fn write<S: Scalar>(
    value: &Value<S>,
    out: &mut String,
    most: usize,
    number: &dyn Fn(S) -> Option<f64>,
) -> Result<bool, Fault> {
    let mut stack: Vec<Open<'_, S>> = Vec::new();
    let mut current = Some(value);
    loop {
        if out.len() > most {
            return Ok(false);
        }
        if let Some(value) = current.take() {
            stack.extend(begin(value, out, number)?);
        }
        let Some(open) = stack.last_mut() else { return Ok(true) };
        let at = open.next;
        open.next += 1;
        let item = match &open.items {
            Items::Flat(items) | Items::Labelled(_, items) => items.get(at),
            Items::List(list) => list.get(at),
        };
        let Some(item) = item else {
            out.push_str(open.close);
            stack.pop();
            continue;
        };
        if at > 0 {
            out.push_str(", ");
        }
        match &open.items {
            Items::Labelled(Labels::Fields(names), _) => {
                out.push_str(names.get(at).map_or("", |name| name));
                out.push('=');
            }
            Items::Labelled(Labels::Keys(keys), _) => {
                // Keys hold no dictionaries: so the call does not recurse further.
                out.push_str(&keys.get(at).map_or(Ok(String::new()), repr)?);
                out.push_str(": ");
            }
            _ => {}
        }
        current = Some(item);
    }
}

/// Writes a value without parts, or the beginning of a value with parts.
fn begin<'a, S: Scalar>(
    value: &'a Value<S>,
    out: &mut String,
    number: &dyn Fn(S) -> Option<f64>,
) -> Result<Option<Open<'a, S>>, Fault> {
    let open = |items, close| Ok(Some(Open { items, next: 0, close }));
    let scalars = |xs: &[S]| xs.iter().map(|x| float(x.value())).collect::<Vec<_>>().join(", ");
    match value {
        Value::None => out.push_str("None"),
        Value::Bool(b) => out.push_str(if *b { "True" } else { "False" }),
        Value::Int(n) => out.push_str(&n.to_string()),
        Value::Real(x) => match number(*x) {
            Some(x) => out.push_str(&float(x)),
            None => return Err(Fault::no_derivative("the text of a number")),
        },
        Value::Str(text) => out.push_str(&quoted(text)),
        Value::Tuple(tuple) => {
            out.push('(');
            return open(Items::Flat(tuple.items()), if tuple.items().len() == 1 { ",)" } else { ")" });
        }
        Value::List(list) => {
            out.push('[');
            return open(Items::List(list), "]");
        }
        Value::Dict(dict) => {
            out.push('{');
            return open(Items::Labelled(Labels::Keys(dict.keys()), dict.values()), "}");
        }
        Value::Record(record) => {
            out.push_str(&record.class.name);
            out.push('(');
            return open(Items::Labelled(Labels::Fields(&record.class.fields), &record.fields), ")");
        }
        Value::Range(r) if r.step == 1 => out.push_str(&format!("range({}, {})", r.start, r.stop)),
        Value::Range(r) => out.push_str(&format!("range({}, {}, {})", r.start, r.stop, r.step)),
        Value::Vector(v) => out.push_str(&format!("vec({})", scalars(v.components()))),
        Value::Rotation(r) => out.push_str(&format!("rotation[{}]", scalars(&r[..]))),
        Value::Shape(shape) => out.push_str(&format!("<{}>", shape.kind())),
        Value::Dist(dist) => out.push_str(&format!("<{} distribution>", dist.family().name())),
        Value::Function(closure) => out.push_str(&format!("<function {}>", closure.function)),
        Value::Future(_) | Value::Returned(_) => {
            return Err(Fault::not_forced("a future cannot be written as text"));
        }
        Value::Unset => out.push_str("<unassigned>"),
        Value::Cell(_) => out.push_str("<cell>"),
    }
    Ok(None)
}

impl<S: Scalar> std::fmt::Debug for Value<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match repr(self) {
            Ok(text) => f.write_str(&text),
            Err(fault) => write!(f, "<{fault}>"),
        }
    }
}

impl Fault {
    /// Marks the run as invalid by this call: its arguments are of the right kinds, but it has no result.
    #[cold]
    pub fn of_call<S: Scalar>(self, name: &str, args: &[Value<S>]) -> Fault {
        self.invalid_by(InvalidCall { name: name.to_string(), text: call_text(name, args) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::{Class, ClassKind, Dict, Record};
    use std::sync::Arc;

    type V = Value<f64>;

    #[test]
    fn floats_are_printed_like_pythons() {
        let cases = [
            (1.0, "1.0"),
            (1e16, "1e+16"),
            (9_999_999_999_999_998.0, "9999999999999998.0"),
            (1.5e300, "1.5e+300"),
            (1e-4, "0.0001"),
            (0.000_012_5, "1.25e-05"),
            (5e-324, "5e-324"),
            (-0.0, "-0.0"),
            (0.1 + 0.2, "0.30000000000000004"),
            (f64::NEG_INFINITY, "-inf"),
            (f64::NAN, "nan"),
            (123_456.789, "123456.789"),
            // The float is ...161.5625: both ...161.562 and ...161.563 read back, and Python takes the even one.
            (-18_132_414_447_161.563, "-18132414447161.562"),
        ];
        for (x, text) in cases {
            assert_eq!(float(x), text);
        }
    }

    #[test]
    fn aggregates_are_printed_like_pythons() {
        let class = Class {
            id: 0,
            name: "Leaf".into(),
            fields: vec!["x".into(), "tags".into()],
            kind: ClassKind::Dataclass,
        };
        let leaf =
            Record { class: Arc::new(class), fields: vec![V::real(2.0), V::tuple(vec![V::str("a'b")])] };
        let dict = Dict::new(vec![(V::str("k"), V::list(vec![])), (V::Int(2), V::None)]);
        let value = V::list(vec![
            V::Record(Arc::new(leaf)),
            V::Dict(Arc::new(dict)),
            V::tuple(vec![]),
            V::Bool(true),
        ]);
        let expected = "[Leaf(x=2.0, tags=(\"a'b\",)), {'k': [], 2: None}, (), True]";
        assert_eq!(repr(&value).as_deref(), Ok(expected));
        assert_eq!(str_of(&V::str("a\nb")).as_deref(), Ok("a\nb"));
        assert_eq!(repr(&V::str("a\n'\"\\\u{7}")).as_deref(), Ok("'a\\n\\'\"\\\\\\x07'"));
    }

    #[test]
    fn a_call_is_printed_as_written_and_a_long_text_is_cut() {
        let size = V::tuple(vec![V::real(1.0), V::real(-0.3), V::Int(1)]);
        assert_eq!(call_text("box", &[V::None, size, V::None, V::None]), "box(None, (1.0, -0.3, 1))");
        assert_eq!(call_text::<f64>("coin", &[]), "coin()");
        let long = call_text("mesh", &[V::list(vec![V::str("\u{e9}"); 1000]), V::Int(1)]);
        assert!(long.starts_with("mesh(['\u{e9}', ") && long.ends_with("...)") && long.len() < 250, "{long}");
        assert_eq!(call_text("f", &[V::Int(1), V::Future(0)]), "f(1, ...)");
    }

    #[test]
    fn a_chain_of_a_million_is_printed_and_a_doubling_value_is_refused() {
        let chain = (0..1_000_000).fold(V::Int(1), |inner, _| V::list(vec![inner]));
        assert_eq!(repr(&chain).map(|text| text.len()), Ok(2_000_001));
        let doubled = (0..60).fold(V::Int(1), |inner, _| V::tuple(vec![inner.clone(), inner]));
        assert_eq!(repr(&doubled).map_err(|fault| fault.code), Err("memory-budget"));
    }
}

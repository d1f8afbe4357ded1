//! Text: `str`, `repr`, formatting, and the methods of built-in values.

use std::sync::Arc;

use super::answer::{Answer, unfit};
use crate::fault::Fault;
use crate::value::index::iter_all;
use crate::value::{Dict, MAX_ELEMENTS, Scalar, Text, Tuple, Value, equal, format as spec, print};

fn text<S: Scalar>(text: String) -> Answer<S> {
    Ok(Value::Str(Text::from(text)))
}

/// `str(x)`.
pub fn str<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    match args.first() {
        None => Ok(Value::str("")),
        Some(Value::Str(text)) => Ok(Value::Str(text.clone())),
        Some(value) => print::str_of(value).and_then(text),
    }
}

/// `repr(x)`.
pub fn repr<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    print::repr(&args[0]).and_then(text)
}

/// `format(x, spec, conversion)`: one field of an f-string. The conversion is `""`, `"r"` or `"s"`.
pub fn format<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let string = |at: usize| match args.get(at) {
        None => Ok(""),
        Some(Value::Str(text)) => Ok(&**text),
        Some(other) => Err(unfit("format", "a str as specification", other)),
    };
    let (specification, conversion) = (string(1)?, string(2)?);
    let converted = match conversion {
        "r" => repr(&args[..1])?,
        "s" => str(&args[..1])?,
        _ => args[0].clone(),
    };
    spec::format(&converted, specification).and_then(text)
}

/// Joins the parts of an f-string.
pub fn fstr<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let mut out = String::new();
    for part in args {
        match part {
            Value::Str(text) => out.push_str(text),
            other => out.push_str(&print::str_of(other)?),
        }
        within_budget(out.len())?;
    }
    text(out)
}

fn within_budget(len: usize) -> Result<(), Fault> {
    if len <= MAX_ELEMENTS {
        return Ok(());
    }
    Err(Fault::memory_budget("the text has more than 67108864 characters"))
}

/// `x.name(args)` for a value that is not a record. The arguments are the value, the name, and the method's
/// arguments.
pub fn method<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (value, rest) = (&args[0], &args[2..]);
    let Value::Str(name) = &args[1] else { return Err(unfit("method", "a name", &args[1])) };
    rest.first().map_or(Ok(()), |item| item.refuse_futures("looked for"))?;
    let answer = match value {
        Value::Str(text) => of_text(text, name, rest),
        Value::Dict(dict) => of_dict(dict, name, rest),
        Value::List(_) | Value::Tuple(_) | Value::Record(_) | Value::Range(_) => {
            of_sequence(value, name, rest)
        }
        _ => None,
    };
    answer.unwrap_or_else(|| {
        let count = rest.len();
        let with = if count == 0 { String::new() } else { format!(" with {count} arguments") };
        Err(Fault::missing_method(format!("{} has no method `{}`{with}", value.described(), &**name)))
    })
}

fn of_sequence<S: Scalar>(value: &Value<S>, name: &str, rest: &[Value<S>]) -> Option<Answer<S>> {
    let [item] = rest else { return None };
    let places = || -> Result<Vec<usize>, Fault> {
        let mut places = Vec::new();
        for (at, element) in iter_all(value)?.iter().enumerate() {
            if equal(element, item)? {
                places.push(at);
            }
        }
        Ok(places)
    };
    match name {
        "count" => Some(places().map(|places| Value::Int(places.len() as i64))),
        "index" => Some(places().and_then(|places| match places.first() {
            Some(at) => Ok(Value::Int(*at as i64)),
            None => {
                let shown = print::repr(item).unwrap_or_else(|_| item.described());
                Err(Fault::missing_element(format!("{shown} is not in the {}", value.kind())))
            }
        })),
        _ => None,
    }
}

fn of_dict<S: Scalar>(dict: &Arc<Dict<S>>, name: &str, rest: &[Value<S>]) -> Option<Answer<S>> {
    match (name, rest) {
        ("get", [key]) => Some(Ok(dict.get(key).cloned().unwrap_or_default())),
        ("get", [key, default]) => Some(Ok(dict.get(key).unwrap_or(default).clone())),
        ("keys", []) => Some(Ok(Value::list(dict.keys().to_vec()))),
        ("values", []) => Some(Ok(Value::list(dict.values().to_vec()))),
        ("items", []) => {
            let pairs = dict.keys().iter().zip(dict.values());
            let pair = |(key, value): (&Value<S>, &Value<S>)| Tuple::pair(key.clone(), value.clone());
            Some(Ok(Value::list(pairs.map(pair).map(Value::Tuple).collect())))
        }
        _ => None,
    }
}

fn of_text<S: Scalar>(string: &Text, name: &str, rest: &[Value<S>]) -> Option<Answer<S>> {
    let strings: Vec<&str> =
        rest.iter().map_while(|arg| if let Value::Str(text) = arg { Some(&**text) } else { None }).collect();
    let list = |parts: Vec<&str>| Ok(Value::list(parts.into_iter().map(Value::str).collect()));
    Some(match (name, &strings[..], rest) {
        ("upper", _, []) => text(string.to_uppercase()),
        ("lower", _, []) => text(string.to_lowercase()),
        ("strip", _, [] | [Value::None]) => text(string.trim().to_string()),
        ("strip", [chars], [_]) => text(string.trim_matches(|c| chars.contains(c)).to_string()),
        ("split", _, [] | [Value::None]) => list(string.split_whitespace().collect()),
        ("split", [""], [_]) => Err(Fault::bad_argument("`split` with an empty separator")),
        ("split", [by], [_]) => list(string.split(by).collect()),
        ("join", _, [parts]) => joined(string, parts),
        ("replace", [old, new], [_, _]) => {
            let grown = string.matches(old).count().saturating_mul(new.len());
            within_budget(string.len().saturating_add(grown)).and_then(|()| text(string.replace(old, new)))
        }
        ("startswith", [start], [_]) => Ok(Value::Bool(string.starts_with(start))),
        ("endswith", [end], [_]) => Ok(Value::Bool(string.ends_with(end))),
        ("startswith" | "endswith", _, [Value::Tuple(choices)]) => {
            let each =
                choices.items().iter().map(|choice| of_text(string, name, std::slice::from_ref(choice)));
            let answers: Option<Result<Vec<Value<S>>, Fault>> = each.collect();
            answers?.map(|answers| Value::Bool(answers.contains(&Value::Bool(true))))
        }
        ("count", [""], [_]) => Ok(Value::Int(string.chars_len() as i64 + 1)),
        ("count", [part], [_]) => Ok(Value::Int(string.matches(part).count() as i64)),
        ("index", [part], [_]) => match string.find(part) {
            Some(byte) => Ok(Value::Int(string[..byte].chars().count() as i64)),
            None => Err(Fault::missing_element(format!("{} is not in the str", print::quoted(part)))),
        },
        ("replace" | "startswith" | "endswith" | "split" | "strip" | "count" | "index", _, [first, ..])
            if strings.len() < rest.len() =>
        {
            Err(unfit(name, "a str", rest.get(strings.len()).unwrap_or(first)))
        }
        _ => return None,
    })
}

fn joined<S: Scalar>(between: &str, parts: &Value<S>) -> Answer<S> {
    let mut out = String::new();
    for (at, part) in iter_all(parts)?.iter().enumerate() {
        let Value::Str(part) = part else {
            let message = format!("`join` takes strings, found {} at position {at}", part.described());
            return Err(Fault::type_mismatch(message).with_help("write `str(x)` for each element"));
        };
        if at > 0 {
            out.push_str(between);
        }
        out.push_str(part);
        within_budget(out.len())?;
    }
    text(out)
}

/// True for a name of a method of a built-in value.
pub fn is_method(name: &str) -> bool {
    const NAMES: &str =
        "index count upper lower strip split join replace startswith endswith get keys values items";
    NAMES.split(' ').any(|method| method == name)
}

#[cfg(test)]
mod tests {
    use super::is_method;
    use crate::builtins::tests::{V, call, code, ints};
    use crate::value::Dict;
    use std::sync::Arc;

    fn method(value: V, name: &str, rest: &[V]) -> Result<V, &'static str> {
        assert!(is_method(name) || name == "nope");
        let mut args = vec![value, V::str(name)];
        args.extend_from_slice(rest);
        call("method", &args).map_err(|fault| fault.code)
    }

    #[test]
    fn methods_of_text_agree_with_python() {
        let s = || V::str(" a,b,,a ");
        let list = |parts: &[&str]| V::list(parts.iter().copied().map(V::str).collect());
        assert_eq!(method(s(), "strip", &[]), Ok(V::str("a,b,,a")));
        assert_eq!(method(V::str("xaxx"), "strip", &[V::str("x")]), Ok(V::str("a")));
        assert_eq!(method(V::str("a,b,,a"), "split", &[V::str(",")]), Ok(list(&["a", "b", "", "a"])));
        assert_eq!(method(V::str(" a  b "), "split", &[]), Ok(list(&["a", "b"])));
        assert_eq!(method(V::str("-"), "join", &[list(&["a", "b"])]), Ok(V::str("a-b")));
        assert_eq!(method(V::str("-"), "join", &[ints([1])]), Err("type-mismatch"));
        assert_eq!(method(V::str("aba"), "replace", &[V::str("a"), V::str("xy")]), Ok(V::str("xybxy")));
        assert_eq!(method(V::str("aba"), "count", &[V::str("a")]), Ok(V::Int(2)));
        assert_eq!(method(V::str("\u{e9}ba"), "index", &[V::str("a")]), Ok(V::Int(2)));
        assert_eq!(method(V::str("aba"), "index", &[V::str("z")]), Err("missing-element"));
        assert_eq!(method(V::str("Ab"), "upper", &[]), Ok(V::str("AB")));
        assert_eq!(method(V::str("ab"), "startswith", &[V::str("a")]), Ok(V::Bool(true)));
        let either = V::tuple(vec![V::str("x"), V::str("b")]);
        assert_eq!(method(V::str("ab"), "endswith", &[either]), Ok(V::Bool(true)));
        assert_eq!(method(V::str("ab"), "startswith", &[V::Int(1)]), Err("type-mismatch"));
        assert_eq!(method(V::str("ab"), "nope", &[]), Err("missing-method"));
    }

    #[test]
    fn methods_of_sequences_and_dictionaries_agree_with_python() {
        assert_eq!(method(ints([3, 1, 3]), "count", &[V::real(3.0)]), Ok(V::Int(2)));
        assert_eq!(method(ints([3, 1, 3]), "index", &[V::Int(1)]), Ok(V::Int(1)));
        assert_eq!(method(ints([3]), "index", &[V::Int(1)]), Err("missing-element"));
        let dict = || V::Dict(Arc::new(Dict::new(vec![(V::str("k"), V::Int(1))])));
        assert_eq!(method(dict(), "get", &[V::str("k")]), Ok(V::Int(1)));
        assert_eq!(method(dict(), "get", &[V::str("z")]), Ok(V::None));
        assert_eq!(method(dict(), "get", &[V::str("z"), V::Int(7)]), Ok(V::Int(7)));
        let items = method(dict(), "items", &[]).unwrap();
        assert_eq!(format!("{items:?}"), "[('k', 1)]");
    }

    #[test]
    fn f_strings_agree_with_python() {
        let hole = call("format", &[V::real(2.0 / 3.0), V::str(".2f"), V::str("")]).unwrap();
        assert_eq!(call("fstr", &[V::str("x="), hole]), Ok(V::str("x=0.67")));
        assert_eq!(call("format", &[V::str("a"), V::str(">5"), V::str("r")]), Ok(V::str("  'a'")));
        assert_eq!(code("format", &[V::str("a"), V::str("d"), V::str("")]), "bad-format");
        assert_eq!(call("str", &[V::real(1e16)]), Ok(V::str("1e+16")));
        assert_eq!(call("repr", &[V::str("a")]), Ok(V::str("'a'")));
    }
}

//! Format specifications of f-strings: `[[fill]align][sign][0][width][,][.precision][type]`, type one of
//! `d f e g % s x`.
//!
//! Source: Python library reference, "Format Specification Mini-Language".

use super::numbers::Number;
use super::print;
use super::{Scalar, Value};
use crate::fault::Fault;

/// The parts of a specification.
#[derive(Debug, PartialEq)]
struct Spec {
    fill: Option<char>,
    /// `<`, `>`, `^` or `=`.
    align: Option<char>,
    /// `+`, `-` or a space.
    sign: Option<char>,
    width: usize,
    grouped: bool,
    /// Whether the alignment comes from a leading zero, which text takes as `<`.
    zero: bool,
    precision: Option<usize>,
    kind: Option<char>,
}

impl Spec {
    fn parse(text: &str) -> Option<Spec> {
        let mut rest: Vec<char> = text.chars().collect();
        rest.reverse();
        let mut spec = Spec {
            fill: None,
            align: None,
            sign: None,
            width: 0,
            grouped: false,
            zero: false,
            precision: None,
            kind: None,
        };
        let is_align = |c: Option<&char>| c.is_some_and(|c| "<>^=".contains(*c));
        if rest.len() > 1 && is_align(rest.get(rest.len() - 2)) {
            spec.fill = rest.pop();
            spec.align = rest.pop();
        } else if is_align(rest.last()) {
            spec.align = rest.pop();
        }
        if rest.last().is_some_and(|c| "+- ".contains(*c)) {
            spec.sign = rest.pop();
        }
        if rest.last() == Some(&'0') {
            rest.pop();
            spec.fill = spec.fill.or(Some('0'));
            spec.zero = spec.align.is_none();
            spec.align = spec.align.or(Some('='));
        }
        spec.width = number(&mut rest)?.unwrap_or(0);
        if rest.last() == Some(&',') {
            rest.pop();
            spec.grouped = true;
        }
        if rest.last() == Some(&'.') {
            rest.pop();
            spec.precision = Some(number(&mut rest)??);
        }
        spec.kind = rest.pop();
        rest.is_empty().then_some(spec)
    }

    /// Joins the sign and the body, and fills up to the width.
    fn layout(&self, sign: &str, body: &str, default: char) -> String {
        let used = sign.chars().count() + body.chars().count();
        let fill = |n: usize| self.fill.unwrap_or(' ').to_string().repeat(n);
        let missing = self.width.saturating_sub(used);
        match self.align.unwrap_or(default) {
            '<' => format!("{sign}{body}{}", fill(missing)),
            '^' => format!("{}{sign}{body}{}", fill(missing / 2), fill(missing - missing / 2)),
            '=' => format!("{sign}{}{body}", fill(missing)),
            _ => format!("{}{sign}{body}", fill(missing)),
        }
    }

    /// The text of a number: its sign as specified, thousands grouped, and zeros filled in by groups as well.
    fn number(&self, negative: bool, digits: &str) -> String {
        let sign = match (negative, self.sign) {
            (true, _) => "-",
            (false, Some('+')) => "+",
            (false, Some(' ')) => " ",
            _ => "",
        };
        if !self.grouped || !digits.starts_with(|c: char| c.is_ascii_digit()) {
            return self.layout(sign, digits, '>');
        }
        let whole = digits.chars().take_while(char::is_ascii_digit).count();
        let (head, tail) = digits.split_at(whole);
        let mut head = head.to_string();
        if self.fill == Some('0') && self.align == Some('=') {
            while grouped(&head).len() + tail.len() + sign.len() < self.width {
                head.insert(0, '0');
            }
        }
        self.layout(sign, &format!("{}{tail}", grouped(&head)), '>')
    }
}

/// Reads a sequence of decimal digits. The inner `None` means that there is none, the outer that the number is
/// too large.
fn number(rest: &mut Vec<char>) -> Option<Option<usize>> {
    let mut number: Option<usize> = None;
    while let Some(digit) = rest.last().and_then(|c| c.to_digit(10)) {
        rest.pop();
        number = Some(number.unwrap_or(0) * 10 + digit as usize);
        if number > Some(1000) {
            return None;
        }
    }
    Some(number)
}

fn grouped(digits: &str) -> String {
    let mut out = String::new();
    for (at, c) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            out.push(',');
        }
        out.push(c);
    }
    out
}

/// `f"{value:spec}"`.
pub fn format<S: Scalar>(value: &Value<S>, spec: &str) -> Result<String, Fault> {
    if spec.is_empty() {
        return print::str_of(value);
    }
    let Some(spec_) = Spec::parse(spec) else {
        return Err(Fault::bad_format(format!("`{spec}` is not a format specification"))
            .with_help("for example `.2f`, `8.3f`, `>10`, `+d`, `,`, `.1%`, `05d`, `x`"));
    };
    let refused = || Fault::bad_format(format!("the format `{spec}` does not fit {}", value.described()));
    match (value, spec_.kind) {
        (Value::Str(text), None | Some('s')) => {
            if spec_.grouped || spec_.sign.is_some() || spec_.align == Some('=') && !spec_.zero {
                return Err(refused());
            }
            let cut: String = text.chars().take(spec_.precision.unwrap_or(usize::MAX)).collect();
            let align = if spec_.align == Some('=') { Some('<') } else { spec_.align };
            Ok(Spec { align, ..spec_ }.layout("", &cut, '<'))
        }
        (Value::Bool(_), Some('s')) | (Value::Int(_) | Value::Real(_), Some('s')) => Err(refused()),
        _ => match Number::of(value) {
            Some(Number::Int(n)) if matches!(spec_.kind, None | Some('d' | 'x')) => {
                if spec_.precision.is_some() || spec_.grouped && spec_.kind == Some('x') {
                    return Err(refused());
                }
                let size = n.unsigned_abs();
                let digits = if spec_.kind == Some('x') { format!("{size:x}") } else { size.to_string() };
                Ok(spec_.number(n < 0, &digits))
            }
            Some(x) if x.real().varies() => Err(Fault::no_derivative("the text of a number")),
            Some(x) => {
                let x = x.real().value();
                let digits = real_digits(x.abs(), &spec_).ok_or_else(refused)?;
                Ok(spec_.number(x.is_sign_negative() && !x.is_nan(), &digits))
            }
            None => Err(refused()),
        },
    }
}

/// The digits of a non-negative number, in the style of a specification.
fn real_digits(x: f64, spec: &Spec) -> Option<String> {
    let percent = if spec.kind == Some('%') { "%" } else { "" };
    if let Some('d' | 'x') = spec.kind {
        return None;
    }
    if !x.is_finite() {
        return Some(format!("{}{percent}", if x.is_nan() { "nan" } else { "inf" }));
    }
    let precision = spec.precision.unwrap_or(6);
    match (spec.kind, spec.precision) {
        (Some('f'), _) => Some(format!("{x:.precision$}")),
        (Some('%'), _) => Some(format!("{:.precision$}%", x * 100.0)),
        (Some('e'), _) => Some(exponent(&format!("{x:.precision$e}"))),
        (Some('g'), _) => Some(general(x, precision, false)),
        (None, None) => Some(print::float(x)),
        (None, Some(precision)) => Some(general(x, precision, true)),
        _ => None,
    }
}

/// Python's exponent: signed, two digits or more.
fn exponent(text: &str) -> String {
    let (digits, power) = text.split_once('e').unwrap_or((text, "0"));
    let power: i32 = power.parse().unwrap_or(0);
    format!("{digits}e{}{:02}", if power < 0 { '-' } else { '+' }, power.abs())
}

/// The style `g`: `precision` significant digits, trailing zeros removed, and an exponent for very small and
/// very large numbers. With `keep_point` (no type letter) at least one digit stays behind the point.
fn general(x: f64, precision: usize, keep_point: bool) -> String {
    let precision = precision.max(1);
    let scientific = format!("{x:.*e}", precision - 1);
    let power: i32 = scientific.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0);
    // With `keep_point` one digit stays behind the point, so a number that fills the precision takes an
    // exponent.
    let limit = precision as i32 - i32::from(keep_point);
    if power < -4 || power >= limit.max(i32::from(!keep_point)) {
        let (digits, power) = scientific.split_once('e').unwrap_or((&scientific, "0"));
        let digits = trimmed(digits);
        return exponent(&format!("{digits}e{power}"));
    }
    let decimals = (precision as i32 - 1 - power).max(0) as usize;
    let text = format!("{x:.decimals$}");
    let text = trimmed(&text);
    if keep_point && !text.contains('.') { format!("{text}.0") } else { text.to_string() }
}

fn trimmed(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

#[cfg(test)]
mod tests {
    use super::*;

    type V = Value<f64>;

    /// Expected texts were checked against CPython 3.11.
    #[test]
    fn numbers_and_text_have_pythons_layout() {
        let cases: Vec<(V, &str, &str)> = vec![
            (V::real(3.14211), ".2f", "3.14"),
            (V::real(2.5), ".0f", "2"),
            (V::real(-3.14211), "8.3f", "  -3.142"),
            (V::real(3.14211), "<8.2f", "3.14    "),
            (V::real(3.14211), "^9.2f", "  3.14   "),
            (V::real(3.14211), "+.1f", "+3.1"),
            (V::real(3.14211), "08.2f", "00003.14"),
            (V::real(-3.14211), "08.2f", "-0003.14"),
            (V::real(15.375), "^+012.3g", "000+15.40000"),
            (V::real(-47.0), "= 012.8g", "-00000000047"),
            (V::real(0.256), ".1%", "25.6%"),
            (V::real(1_234_567.891), ",.2f", "1,234,567.89"),
            (V::real(12345.678), ".3e", "1.235e+04"),
            (V::real(0.00001234), "g", "1.234e-05"),
            (V::real(1_000_000.0), "g", "1e+06"),
            (V::real(100_000.0), "g", "100000"),
            (V::real(1234.5), ".2", "1.2e+03"),
            (V::real(12.0), ".3", "12.0"),
            (V::real(12.0), ".2", "1.2e+01"),
            (V::real(1.0), ".1", "1e+00"),
            (V::real(0.5), "", "0.5"),
            (V::real(0.5), "6", "   0.5"),
            (V::real(f64::INFINITY), "6.1f", "   inf"),
            (V::Int(42), "5d", "   42"),
            (V::Int(42), "05d", "00042"),
            (V::Int(-42), "05", "-0042"),
            (V::Int(42), "+", "+42"),
            (V::Int(1_234_567), ",", "1,234,567"),
            (V::Int(1234), "08,", "0,001,234"),
            (V::Int(255), "x", "ff"),
            (V::Int(-255), "x", "-ff"),
            (V::Int(3), ".2f", "3.00"),
            (V::Int(42), "*^7", "**42***"),
            (V::Bool(true), "d", "1"),
            (V::Bool(true), "", "True"),
            (V::str("ab"), "5", "ab   "),
            (V::str("ab"), ">5", "   ab"),
            (V::str("abcdef"), ".3", "abc"),
            (V::str("ab"), "*^6s", "**ab**"),
        ];
        for (value, spec, expected) in cases {
            assert_eq!(format(&value, spec).as_deref(), Ok(expected), "{value:?}:{spec}");
        }
    }

    #[test]
    fn a_format_that_does_not_fit_the_value_is_refused() {
        for (value, spec) in [
            (V::str("a"), "d"),
            (V::str("a"), "-5"),
            (V::Int(7), ",x"),
            (V::real(f64::INFINITY), "d"),
            (V::real(1.5), "d"),
            (V::real(1.5), "x"),
            (V::Int(1), ".2d"),
            (V::list(vec![]), "5"),
            (V::Int(1), "5q"),
            (V::Int(1), "99999999999999d"),
            (V::Int(1), "s"),
        ] {
            assert_eq!(format(&value, spec).map_err(|f| f.code), Err("bad-format"), "{value:?}:{spec}");
        }
    }
}

//! Checks of settings: values as JSON against ranges, which stand beside the fields that they are of.

use niwaki_vm::fault::Fault;
use niwaki_vm::refusal::Expected;
pub use niwaki_vm::refusal::Range;
use serde_json::{Map, Value};

/// Ranges of settings by name.
pub type Ranges = &'static [(&'static str, Range)];

/// A whole number above 0. Python's counts are signed.
pub const COUNT: Range = whole(1);

/// A count in 32 bits.
pub const SMALL_COUNT: Range = Range::Whole { least: 1, most: u32::MAX as u64 };

/// A finite number.
pub const FINITE: Range = Range::Real { low: f64::NEG_INFINITY, high: f64::INFINITY, ends: "()" };

/// A finite number above 0.
pub const POSITIVE: Range = Range::Real { low: 0.0, high: f64::INFINITY, ends: "()" };

/// A finite number from 0 on.
pub const FROM_ZERO: Range = Range::Real { low: 0.0, high: f64::INFINITY, ends: "[)" };

/// A number between 0 and 1.
pub const BETWEEN: Range = Range::Real { low: 0.0, high: 1.0, ends: "()" };

/// A number from 0 to 1.
pub const SHARE: Range = Range::Real { low: 0.0, high: 1.0, ends: "[]" };

/// A whole number from `least` on.
pub const fn whole(least: u64) -> Range {
    Range::Whole { least, most: i64::MAX as u64 }
}

/// Refuses the first setting outside its range. A setting that is missing is not looked at.
///
/// # Errors
/// The setting, its value and its range.
pub fn check(ranges: Ranges, settings: &Map<String, Value>) -> Result<(), Fault> {
    for (name, range) in ranges {
        let Some(value) = settings.get(*name) else { continue };
        if let (Range::Table(Some(range)), Value::Object(entries)) = (range, value) {
            if let Some((name, value)) = entries.iter().find(|(_, value)| !fits(range, value)) {
                return Err(refused(name, value, **range));
            }
        } else if !fits(range, value) {
            return Err(refused(name, value, *range));
        }
    }
    Ok(())
}

fn refused(name: &str, value: &Value, range: Range) -> Fault {
    Fault::refused(name, value.to_string(), Expected::Range(range))
}

/// Whether a value is in a range.
fn fits(range: &Range, value: &Value) -> bool {
    match range {
        Range::Whole { least, most } => value.as_u64().is_some_and(|n| (*least..=*most).contains(&n)),
        Range::Real { low, high, ends } => value.as_f64().is_some_and(|x| {
            let above = if ends.starts_with('[') { x >= *low } else { x > *low };
            x.is_finite() && above && if ends.ends_with(']') { x <= *high } else { x < *high }
        }),
        Range::Words(words) => value.as_str().is_some_and(|word| words.contains(&word)),
        Range::List(range) => value
            .as_array()
            .is_some_and(|values| !values.is_empty() && values.iter().all(|value| fits(range, value))),
        Range::Table(range) => value.as_object().is_some_and(|entries| {
            range.is_none_or(|range| entries.values().all(|value| fits(range, value)))
        }),
        Range::Optional(range) => value.is_null() || fits(range, value),
        Range::Either(ranges) => ranges.iter().any(|range| fits(range, value)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_outside_of_a_range_are_refused() {
        const SIZES: Range = Range::Either(&[COUNT, Range::List(&COUNT)]);
        const RANGES: Ranges = &[
            ("count", COUNT),
            ("small", SMALL_COUNT),
            ("share", SHARE),
            ("between", BETWEEN),
            ("finite", FINITE),
            ("word", Range::Words(&["a", "b"])),
            ("sizes", SIZES),
            ("none", Range::Optional(&POSITIVE)),
            ("table", Range::Table(Some(&FROM_ZERO))),
        ];
        let refusal = |text: &str| {
            let settings = serde_json::from_str(text).expect("an object");
            check(RANGES, &settings).err().map(|fault| fault.subject.clone().unwrap_or_default())
        };
        for good in [
            r#"{"count": 1, "small": 4294967295, "share": 0, "between": 0.5, "finite": -3, "word": "b"}"#,
            r#"{"sizes": 1, "none": null, "table": {"x": 0}}"#,
            r#"{"sizes": [1, 2], "none": 0.1, "share": 1, "other": "anything"}"#,
        ] {
            assert_eq!(refusal(good), None, "{good}");
        }
        for (bad, name) in [
            (r#"{"count": 0}"#, "count"),
            (r#"{"count": -1}"#, "count"),
            (r#"{"count": 1.5}"#, "count"),
            (r#"{"count": true}"#, "count"),
            (r#"{"count": 9223372036854775808}"#, "count"),
            (r#"{"small": 4294967296}"#, "small"),
            (r#"{"share": 1.001}"#, "share"),
            (r#"{"between": 0}"#, "between"),
            (r#"{"between": 1}"#, "between"),
            (r#"{"finite": "1"}"#, "finite"),
            (r#"{"word": "c"}"#, "word"),
            (r#"{"sizes": []}"#, "sizes"),
            (r#"{"sizes": [1, 0]}"#, "sizes"),
            (r#"{"none": 0}"#, "none"),
            (r#"{"table": {"x": 1, "y": -1}}"#, "y"),
            (r#"{"table": 1}"#, "table"),
        ] {
            assert_eq!(refusal(bad).as_deref(), Some(name), "{bad}");
        }
    }
}

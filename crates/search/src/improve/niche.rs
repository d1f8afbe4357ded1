//! The differences of niches of an archive: the kind of a run, or the values of choices or of a query, numbers in bins.

use super::structure::{Kind, Structure, is_finite, text};
use niwaki_run::glob::matches;
use niwaki_run::replay::{Choice, Trace};
use niwaki_run::select::no_choice;
use niwaki_vm::fault::Fault;
use niwaki_vm::value::{Value, repr};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The rule by which results differ, as data: a word, or addresses of choices.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub(in crate::improve) enum By {
    /// `kind`, `look`, the key of a query, or a pattern of addresses where no run has such a query.
    Word(String),
    /// Patterns of addresses.
    Choices(Vec<String>),
}

impl Default for By {
    fn default() -> By {
        By::Word("kind".into())
    }
}

impl By {
    /// Whether results differ by their looks alone.
    pub fn is_look(&self) -> bool {
        *self == By::Word("look".into())
    }

    /// Whether results differ by named values, so that each combination of values is wanted.
    pub fn is_named(&self) -> bool {
        !matches!(self, By::Word(word) if word == "kind" || word == "look")
    }
}

/// Values with names, and the ranges of those that are real.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Names {
    names: Vec<String>,
    is_query: bool,
    bins: usize,
    /// The smallest and the largest value of a name in the first runs, as bits.
    ranges: BTreeMap<String, (u64, u64)>,
}

/// The differences of niches, fixed after the first runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Niches {
    structure: Structure,
    named: Option<Names>,
}

impl Niches {
    /// Niches by this rule, from the first runs.
    ///
    /// # Errors
    /// A name that no run has.
    pub fn of(by: &By, bins: usize, structure: Structure, traces: &[&Trace]) -> Result<Niches, Fault> {
        let (names, is_query) = match by {
            By::Choices(patterns) => (patterns.clone(), false),
            By::Word(word) if by.is_named() => {
                let has = |trace: &&Trace| trace.queries.iter().any(|(key, _)| is_key(key, word));
                (vec![word.clone()], traces.iter().any(has))
            }
            By::Word(_) => return Ok(Niches { structure, named: None }),
        };
        let mut named = Names { names, is_query, bins, ranges: BTreeMap::new() };
        for name in &named.names {
            let values: Vec<Value> = traces.iter().flat_map(|trace| named.values(name, trace)).collect();
            if values.is_empty() && !traces.is_empty() {
                return Err(unknown(name, traces));
            }
            let reals =
                values.iter().filter_map(|value| if let Value::Real(x) = value { Some(*x) } else { None });
            let reals: Vec<f64> = reals.filter(|x| x.is_finite()).collect();
            if let Some(low) = reals.iter().copied().reduce(f64::min) {
                let high = reals.iter().copied().fold(low, f64::max);
                named.ranges.insert(name.clone(), (low.to_bits(), high.to_bits()));
            }
        }
        Ok(Niches { structure, named: Some(named) })
    }

    /// The niche of a run.
    pub fn niche(&self, trace: &Trace) -> Kind {
        match &self.named {
            None => self.structure.kind(trace),
            Some(named) => {
                let entry = |name: &String| {
                    let mut texts: Vec<String> =
                        named.values(name, trace).iter().map(|value| named.text(name, value)).collect();
                    texts.sort();
                    (name.clone(), if texts.is_empty() { "none".into() } else { texts.join(", ") })
                };
                named.names.iter().map(entry).collect()
            }
        }
    }

    /// Whether a choice is turned to come to another niche, and held to stay in one.
    pub fn has(&self, choice: &Choice) -> bool {
        match &self.named {
            Some(named) if !named.is_query => {
                is_finite(choice) && named.names.iter().any(|pattern| matches(pattern, &choice.path))
            }
            _ => self.structure.has(choice),
        }
    }
}

impl Names {
    /// The values of a name in a run.
    fn values(&self, name: &str, trace: &Trace) -> Vec<Value> {
        if self.is_query {
            let queries = trace.queries.iter().filter(|(key, _)| is_key(key, name));
            return queries.map(|(_, value)| value.clone()).collect();
        }
        let chosen = trace.choices.iter().filter(|choice| matches(name, &choice.path));
        chosen
            .map(|choice| match &choice.value {
                Value::Real(_) => choice.value.clone(),
                _ => Value::Str(text(choice).into()),
            })
            .collect()
    }

    /// A value as text: the bin of a real.
    fn text(&self, name: &str, value: &Value) -> String {
        match (value, self.ranges.get(name)) {
            (Value::Str(word), _) => word.to_string(),
            (Value::Real(x), Some((low, high))) => {
                let (low, high) = (f64::from_bits(*low), f64::from_bits(*high));
                let width = (high - low) / self.bins as f64;
                if width.is_nan() || width <= 0.0 {
                    return format!("{low:.4}");
                }
                // Values beyond the first runs have bins of the same width, but no more than as many again on each side.
                let most = self.bins as f64;
                let bin = ((x - low) / width).floor().clamp(-most, 2.0 * most);
                let bin = if *x == high { most - 1.0 } else { bin };
                format!("{:.4} to {:.4}", low + bin * width, low + (bin + 1.0) * width)
            }
            (other, _) => repr(other).unwrap_or_default(),
        }
    }
}

/// Whether this is the key of a query.
fn is_key(key: &Value, name: &str) -> bool {
    matches!(key, Value::Str(key) if **key == *name)
}

/// The fault of a name that no run has; queries of these runs are near as well.
fn unknown(name: &str, traces: &[&Trace]) -> Fault {
    let mut known: Vec<String> = vec![];
    for trace in traces {
        known.extend(trace.choices.iter().map(|choice| choice.path.clone()));
        known.extend(trace.queries.iter().filter_map(|(key, _)| repr(key).ok()));
    }
    known.sort();
    known.dedup();
    no_choice(name, &known)
}

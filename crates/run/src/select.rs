//! Selections as weights: patterns over addresses and weights by depth, computed once for each new choice.

use crate::Failure;
use crate::glob::{last, matches, nearest};
use niwaki_vm::code::{FunctionId, Program, SiteKind, Source};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::kept::Trace;
use std::collections::HashMap;

/// The unit of selection weights.
pub const UNIT: f64 = 65536.0;

/// The choices that a kernel may change, with their selection weights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Patterns over readable addresses: at least one pattern of each list must match.
    pub sites: Vec<Vec<String>>,
    /// Selection weights by number of calls above the choice; the last weight is for all deeper choices.
    pub depth: Vec<f64>,
    /// The names in addresses of the calls that count as depth; all calls where it is empty.
    pub calls: String,
    /// Selection weights by pattern over readable addresses; the first match counts. The weight is 1 where no pattern matches.
    pub weights: Vec<(String, f64)>,
}

impl Selection {
    /// Intersect two selections.
    pub fn and(&self, other: &Selection) -> Selection {
        let mut both = self.clone();
        both.sites.extend(other.sites.iter().cloned());
        if !other.depth.is_empty() {
            both.depth.clone_from(&other.depth);
            both.calls.clone_from(&other.calls);
        }
        both.weights.splice(0..0, other.weights.iter().cloned());
        both
    }

    /// Whether the selection has patterns but no weights.
    pub fn is_by_pattern(&self) -> bool {
        *self == Selection { sites: self.sites.clone(), ..Selection::default() }
    }

    /// Whether every choice is chosen with the same weight.
    pub fn is_all(&self) -> bool {
        let Selection { sites, depth, calls, weights } = self;
        sites.is_empty() && depth.is_empty() && calls.is_empty() && weights.is_empty()
    }

    /// Whether a selected site may draw real numbers. Where the program does not decide this, the trace does, if it reached
    /// the site.
    pub fn may_be_continuous(&self, trace: &Trace, program: &Program) -> bool {
        let mut seen: HashMap<_, bool> = HashMap::new();
        for choice in trace.numbers() {
            let is_real = trace.family(choice).is_some_and(|family| family.space().is_continuous());
            *seen.entry(trace.site_of(choice)).or_default() |= is_real;
        }
        let takes = |label: &str| {
            self.sites.iter().all(|patterns| patterns.iter().any(|pattern| matches(last(pattern), label)))
        };
        program.functions.iter().enumerate().any(|(f, function)| {
            function.sites.iter().enumerate().any(|(s, site)| {
                let may = match site.kind {
                    SiteKind::Sample(Source::Family(family)) => family.space().is_continuous(),
                    SiteKind::Sample(Source::Value | Source::Element) => {
                        seen.get(&(FunctionId(f as _), s as u16)).copied().unwrap_or(true)
                    }
                    _ => false,
                };
                may && takes(&site.label)
            })
        })
    }

    fn takes(&self, path: &str) -> bool {
        self.sites.iter().all(|patterns| patterns.iter().any(|pattern| matches(pattern, path)))
    }

    /// Check that each pattern matches an address of the trace, or a site that the program has and this run did not reach.
    ///
    /// # Errors
    /// A pattern that matches neither.
    pub fn check(&self, trace: &Trace, program: &Program) -> Result<(), Failure> {
        for patterns in self.sites.iter().chain(std::iter::once(
            &self.weights.iter().map(|(pattern, _)| pattern.clone()).collect::<Vec<_>>(),
        )) {
            for pattern in patterns {
                let mut known: Vec<String> = trace.numbers().map(|n| trace.path(program, n)).collect();
                if known.iter().any(|path| matches(pattern, path)) {
                    continue;
                }
                let labels = labels(program);
                if labels.iter().any(|label| matches(last(pattern), label)) && !trace_has(&known, pattern) {
                    continue;
                }
                let elsewhere: Vec<String> =
                    labels.into_iter().filter(|label| !trace_has(&known, label)).collect();
                known.extend(elsewhere);
                return Err(no_choice(pattern, &known).into());
            }
        }
        Ok(())
    }
}

/// Whether an address of the trace ends in the last component of the pattern.
fn trace_has(known: &[String], pattern: &str) -> bool {
    known.iter().any(|path| matches(last(pattern), last(path)))
}

/// The fault of a pattern that matches no known choice; the help names the nearest choices.
pub fn no_choice(pattern: &str, known: &[String]) -> Fault {
    let near: Vec<String> = nearest(pattern, known).iter().map(|p| format!("`{p}`")).collect();
    let near = if near.is_empty() { "the model has no choice".into() } else { near.join(", ") };
    Fault::new("no-address", format!("`{pattern}` matches no choice")).about(pattern).with_help(near)
}

/// The readable components of the program's choices.
pub fn labels(program: &Program) -> Vec<String> {
    let mut labels: Vec<String> = Vec::new();
    for site in program.functions.iter().flat_map(|f| &f.sites) {
        if matches!(site.kind, SiteKind::Sample(_)) && !labels.iter().any(|l| **l == *site.label) {
            labels.push(site.label.to_string());
        }
    }
    labels
}

impl Selection {
    /// The weight of a choice with this readable address and number of calls above it.
    pub fn weigh(&self, path: impl FnOnce() -> String, depth: impl FnOnce() -> usize) -> u64 {
        let mut weight = 1.0;
        let mut nested = None;
        if !self.sites.is_empty() || !self.weights.is_empty() || !self.calls.is_empty() {
            let path = path();
            nested = Some(path.split('/').filter(|part| *part == self.calls).count());
            if !self.takes(&path) {
                return 0;
            }
            weight *= self
                .weights
                .iter()
                .find(|(pattern, _)| matches(pattern, &path))
                .map_or(1.0, |weighted| weighted.1);
        }
        if let Some(deepest) = self.depth.last() {
            weight *= self
                .depth
                .get(nested.filter(|_| !self.calls.is_empty()).unwrap_or_else(depth))
                .unwrap_or(deepest);
        }
        // A weight above zero stays above zero.
        if weight > 0.0 { ((weight * UNIT).round() as u64).max(1) } else { 0 }
    }
}

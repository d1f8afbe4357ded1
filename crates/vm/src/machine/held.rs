//! Held choices: choices of a run with fixed values, which are observed and not drawn.
//!
//! When a run meets a held choice, the choice gets its held value, and its log density is a factor of the
//! score. A run that ends without having met all held choices is impossible: no held choice may be lost. So the
//! law of the runs is that of the program, under the condition that each held choice exists and has its value.
//!
//! A particle that has lost a held choice should not live on until its end: the lost choice may have been
//! improbable, so that the particle weighs more than the others. When an activation is left, all held choices
//! below it must have been met. Only choices in futures that it created may come later.

use super::address::{ROOT, iteration_key, join};
use super::memos::{identity, path_of};
use super::numbers::Numbers;
use crate::code::{FunctionId, Program, Site, SiteKind};
use crate::value::Value;
use niwaki_math::Scalar;
use std::collections::HashMap;

/// Held choices, numbered.
#[derive(Clone, Debug)]
pub struct Held<S: Scalar = f64> {
    /// The readable address and the value of each choice.
    choices: Vec<(String, Value<S>)>,
    /// The numbers of the choices by address.
    numbers: HashMap<u128, u32>,
    /// The choices below an activation, by its path: all of them, and those that are not in futures below it.
    below: HashMap<u128, Vec<u32>>,
    outside_futures: HashMap<u128, Vec<u32>>,
}

impl Held {
    /// Holds choices of a program; each is a readable address and a value.
    ///
    /// # Errors
    /// The first address that no run of the program can have.
    pub fn new(program: &Program, choices: Vec<(String, Value)>) -> Result<Held, String> {
        let (mut numbers, mut below, mut outside_futures) = (HashMap::new(), HashMap::new(), HashMap::new());
        for (number, (path, _)) in (0..).zip(&choices) {
            let candidates = addresses(program, path);
            if candidates.is_empty() {
                return Err(path.clone());
            }
            for (path, is_outside_futures) in common(&candidates) {
                below.entry(path).or_insert_with(Vec::new).push(number);
                if is_outside_futures {
                    outside_futures.entry(path).or_insert_with(Vec::new).push(number);
                }
            }
            numbers.extend(candidates.into_iter().map(|candidate| (candidate.address, number)));
        }
        Ok(Held { choices, numbers, below, outside_futures })
    }
}

impl<S: Scalar> Held<S> {
    /// The number of held choices.
    pub fn len(&self) -> usize {
        self.choices.len()
    }

    /// Whether no choice is held.
    pub fn is_empty(&self) -> bool {
        self.choices.is_empty()
    }

    /// The readable addresses and the values.
    pub fn choices(&self) -> &[(String, Value<S>)] {
        &self.choices
    }

    /// The number and the value of the held choice at an address.
    #[inline]
    pub fn find(&self, address: u128) -> Option<(u32, &Value<S>)> {
        let number = *self.numbers.get(&address)?;
        Some((number, &self.choices[number as usize].1))
    }

    /// The first held choice that can no longer be met when the activation with this path is left.
    /// `depth_first` says whether futures run at once.
    pub(crate) fn first_lost(&self, path: u128, unmet: &Numbers, depth_first: bool) -> Option<u32> {
        let below = if depth_first { &self.below } else { &self.outside_futures };
        below.get(&path)?.iter().copied().find(|number| unmet.contains(*number))
    }

    /// The readable address of a held choice.
    pub fn name(&self, number: u32) -> &str {
        &self.choices[number as usize].0
    }

    /// The choices with their values over another kind of number.
    pub fn convert<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Held<T> {
        let choices = self.choices.iter().map(|(path, value)| (path.clone(), value.convert(number)));
        Held {
            choices: choices.collect(),
            numbers: self.numbers.clone(),
            below: self.below.clone(),
            outside_futures: self.outside_futures.clone(),
        }
    }
}

/// An address that a choice may have, and the activations around the choice.
struct Candidate {
    address: u128,
    inside: Vec<Enclosing>,
}

/// An activation: its path, and whether it is a future, which may begin later than its call.
#[derive(Clone, Copy)]
struct Enclosing {
    path: u128,
    is_future: bool,
}

/// The activations around all of these addresses. For each, whether it lasts until the choice is met: no future
/// is between them.
fn common(candidates: &[Candidate]) -> Vec<(u128, bool)> {
    let Some((first, rest)) = candidates.split_first() else { return vec![] };
    let mut all = vec![];
    let mut is_outside_futures = true;
    for Enclosing { path, is_future } in first.inside.iter().rev() {
        if rest.iter().all(|other| other.inside.iter().any(|enclosing| enclosing.path == *path)) {
            all.push((*path, is_outside_futures));
        }
        is_outside_futures &= !is_future;
    }
    all
}

/// The ways in which a readable address may continue: the activations so far, the function of the last one, and
/// the rest of the text. The function is `None` after a call of a value, which may be any function.
struct Prefix<'a> {
    inside: Vec<Enclosing>,
    function: Option<FunctionId>,
    rest: &'a str,
}

/// The addresses of choices that may have this readable address. There are several if different functions may
/// be called at one place, or if a function gives one name to several choices.
fn addresses(program: &Program, path: &str) -> Vec<Candidate> {
    let mut candidates = Vec::new();
    let root = Enclosing { path: ROOT, is_future: true };
    let mut prefixes = vec![Prefix { inside: vec![root], function: Some(program.entry), rest: path }];
    // Memoised functions of modules do not belong to an activation.
    let sites = program.functions.iter().flat_map(|f| &f.sites);
    let of_module = sites.flat_map(|site| match site.kind {
        SiteKind::Memoise { of: Some(of) } => memoised_calls(program, of, &site.label, &prefixes[0]),
        _ => vec![],
    });
    let of_module: Vec<Prefix<'_>> = of_module.collect();
    prefixes.extend(of_module);
    while let Some(prefix) = prefixes.pop() {
        let functions = match &prefix.function {
            Some(id) => std::slice::from_ref(program.function(*id)),
            None => &program.functions[..],
        };
        for site in functions.iter().flat_map(|f| &f.sites) {
            if matches!(site.kind, SiteKind::Sample(_)) && *site.label == *prefix.rest {
                let address = join(prefix.path(), site.key);
                candidates.push(Candidate { address, inside: prefix.inside.clone() });
            }
            if let SiteKind::Memoise { of: None } = site.kind {
                prefixes.extend(memoised_calls(program, join(prefix.path(), site.key), &site.label, &prefix));
            }
            prefixes.extend(below(site, &prefix));
        }
    }
    candidates.sort_unstable_by_key(|candidate| candidate.address);
    candidates.dedup_by_key(|candidate| candidate.address);
    candidates
}

impl Prefix<'_> {
    /// The path of the activation that was entered last.
    fn path(&self) -> u128 {
        self.inside.last().map_or(ROOT, |inside| inside.path)
    }
}

/// The prefixes below a call of a memoised function, if that call is the next component: `color(3)`. Any
/// function may have been memoised at that place.
fn memoised_calls<'a>(program: &Program, place: u128, label: &str, prefix: &Prefix<'a>) -> Vec<Prefix<'a>> {
    let next = prefix.rest.strip_prefix(label).and_then(|text| text.split_once('/'));
    let Some((text, rest)) = next.filter(|(text, _)| text.starts_with('(')) else { return vec![] };
    let of = |function: FunctionId| {
        // The call lasts as long as it may be requested; choices inside of it are met before it is left.
        let call = Enclosing { path: path_of(identity(place, program, function), text), is_future: true };
        Prefix { inside: vec![prefix.inside[0], call], function: Some(function), rest }
    };
    (0..program.functions.len()).map(|number| of(FunctionId(number as u32))).collect()
}

/// The prefix below a site, if the next component belongs to the site.
fn below<'a>(site: &Site, prefix: &Prefix<'a>) -> Option<Prefix<'a>> {
    let path = join(prefix.path(), site.key);
    let after = |label: &str, text: &'a str| text.strip_prefix(label)?.strip_prefix('/');
    let (more, function, rest) = match &site.kind {
        SiteKind::Call { function } | SiteKind::Future { function, .. } => {
            (None, Some(*function), after(&site.label, prefix.rest)?)
        }
        SiteKind::Apply | SiteKind::FutureApply { .. } => (None, None, after(&site.label, prefix.rest)?),
        SiteKind::Loop(l) => {
            let (name, behind) = site.label.split_once("[]")?;
            let (number, rest) = prefix.rest.strip_prefix(name)?.strip_prefix('[')?.split_once(']')?;
            let path = join(path, iteration_key(number.parse().ok()?));
            (Some(Enclosing { path, is_future: false }), Some(l.body), after(behind, rest)?)
        }
        _ => return None,
    };
    let is_future = matches!(site.kind, SiteKind::Future { .. } | SiteKind::FutureApply { .. });
    let entered = [Enclosing { path, is_future }].into_iter().chain(more);
    Some(Prefix { inside: prefix.inside.iter().copied().chain(entered).collect(), function, rest })
}

//! Held choices: values that are given for choices of a run, which are then observed and not drawn.
//!
//! Where a run meets a held choice, its value is the given one, and its log density is a factor of the score. A run that
//! ends without having met all of them is impossible: nothing may lose what is held. So the law of the runs is that of the
//! program's, given that each held choice exists and has its value.
//!
//! A particle that has lost a held choice should not live on until its end, since what it lost may have been improbable, so
//! that it weighs more than the others. Where an activation is left, all held choices below it must have been met; only those
//! in futures that it created may come later.

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
    /// The readable address and the value of each.
    choices: Vec<(String, Value<S>)>,
    /// Their numbers by address.
    numbers: HashMap<u128, u32>,
    /// Those that are below an activation, by its path: all, and without those in futures below it.
    below: HashMap<u128, Vec<u32>>,
    at_once: HashMap<u128, Vec<u32>>,
}

impl Held {
    /// Holds choices of a program, given by their readable addresses.
    ///
    /// # Errors
    /// The first of them that no run of the program can have.
    pub fn new(program: &Program, choices: Vec<(String, Value)>) -> Result<Held, String> {
        let (mut numbers, mut below, mut at_once) = (HashMap::new(), HashMap::new(), HashMap::new());
        for (number, (path, _)) in (0..).zip(&choices) {
            let found = addresses(program, path);
            if found.is_empty() {
                return Err(path.clone());
            }
            for (path, is_at_once) in common(&found) {
                below.entry(path).or_insert_with(Vec::new).push(number);
                if is_at_once {
                    at_once.entry(path).or_insert_with(Vec::new).push(number);
                }
            }
            numbers.extend(found.into_iter().map(|found| (found.address, number)));
        }
        Ok(Held { choices, numbers, below, at_once })
    }
}

impl<S: Scalar> Held<S> {
    /// How many are held.
    pub fn len(&self) -> usize {
        self.choices.len()
    }

    /// Whether none is held.
    pub fn is_empty(&self) -> bool {
        self.choices.is_empty()
    }

    /// The number and the value of the choice at an address, where it is held.
    #[inline]
    pub fn find(&self, address: u128) -> Option<(u32, &Value<S>)> {
        let number = *self.numbers.get(&address)?;
        Some((number, &self.choices[number as usize].1))
    }

    /// The first of these choices that cannot be met any more when an activation with this path is left, where futures run at
    /// once or not.
    pub(crate) fn lost(&self, path: u128, unmet: &Numbers, depth_first: bool) -> Option<u32> {
        let below = if depth_first { &self.below } else { &self.at_once };
        below.get(&path)?.iter().copied().find(|number| unmet.contains(*number))
    }

    /// The readable address of a held choice.
    pub fn name(&self, number: u32) -> &str {
        &self.choices[number as usize].0
    }

    /// The same choices, their values over other numbers.
    pub fn convert<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Held<T> {
        let choices = self.choices.iter().map(|(path, value)| (path.clone(), value.convert(number)));
        Held {
            choices: choices.collect(),
            numbers: self.numbers.clone(),
            below: self.below.clone(),
            at_once: self.at_once.clone(),
        }
    }
}

/// An address that a choice may have, and the activations that it is in.
struct Found {
    address: u128,
    inside: Vec<Inside>,
}

/// An activation: its path, and whether it may begin later than where it is called, as a future.
#[derive(Clone, Copy)]
struct Inside {
    path: u128,
    is_future: bool,
}

/// The activations that all of these addresses are in, each with whether it lasts until the choice is met: no future is
/// between them.
fn common(found: &[Found]) -> Vec<(u128, bool)> {
    let Some((first, others)) = found.split_first() else { return vec![] };
    let mut all = vec![];
    let mut is_at_once = true;
    for Inside { path, is_future } in first.inside.iter().rev() {
        if others.iter().all(|other| other.inside.iter().any(|own| own.path == *path)) {
            all.push((*path, is_at_once));
        }
        is_at_once &= !is_future;
    }
    all
}

/// Where a readable address may go on: the activations so far, the function of the last (`None` where a value was called, so
/// that it may be any), and what is left of the text.
struct Front<'a> {
    inside: Vec<Inside>,
    function: Option<FunctionId>,
    rest: &'a str,
}

/// The addresses that choices with this readable address may have. There are several where different functions may be
/// called at one place, or where a function gives one name to several choices.
fn addresses(program: &Program, path: &str) -> Vec<Found> {
    let mut found = Vec::new();
    let root = Inside { path: ROOT, is_future: true };
    let mut fronts = vec![Front { inside: vec![root], function: Some(program.entry), rest: path }];
    // Memoised functions of modules, which belong to no activation.
    let sites = program.functions.iter().flat_map(|f| &f.sites);
    let of_module = sites.flat_map(|site| match site.kind {
        SiteKind::Memoise { of: Some(of) } => remembered(program, of, &site.label, &fronts[0]),
        _ => vec![],
    });
    let of_module: Vec<Front<'_>> = of_module.collect();
    fronts.extend(of_module);
    while let Some(front) = fronts.pop() {
        let functions = match &front.function {
            Some(id) => std::slice::from_ref(program.function(*id)),
            None => &program.functions[..],
        };
        for site in functions.iter().flat_map(|f| &f.sites) {
            if matches!(site.kind, SiteKind::Sample(_)) && *site.label == *front.rest {
                let address = join(front.path(), site.key);
                found.push(Found { address, inside: front.inside.clone() });
            }
            if let SiteKind::Memoise { of: None } = site.kind {
                fronts.extend(remembered(program, join(front.path(), site.key), &site.label, &front));
            }
            fronts.extend(below(site, &front));
        }
    }
    found.sort_unstable_by_key(|found| found.address);
    found.dedup_by_key(|found| found.address);
    found
}

impl Front<'_> {
    /// The path of the activation that was entered last.
    fn path(&self) -> u128 {
        self.inside.last().map_or(ROOT, |inside| inside.path)
    }
}

/// Where the address goes on below a call of a memoised function, if that is its next component: `color(3)`. Which function
/// was memoised at that place is not known.
fn remembered<'a>(program: &Program, place: u128, label: &str, front: &Front<'a>) -> Vec<Front<'a>> {
    let next = front.rest.strip_prefix(label).and_then(|text| text.split_once('/'));
    let Some((text, rest)) = next.filter(|(text, _)| text.starts_with('(')) else { return vec![] };
    let of = |function: FunctionId| {
        // It lasts as long as somebody may ask for it; what is inside of it is met before it is left.
        let own = Inside { path: path_of(identity(place, program, function), text), is_future: true };
        Front { inside: vec![front.inside[0], own], function: Some(function), rest }
    };
    (0..program.functions.len()).map(|number| of(FunctionId(number as u32))).collect()
}

/// Where the address goes on below a site, if its next component is that of the site.
fn below<'a>(site: &Site, front: &Front<'a>) -> Option<Front<'a>> {
    let path = join(front.path(), site.key);
    let after = |label: &str, text: &'a str| text.strip_prefix(label)?.strip_prefix('/');
    let (more, function, rest) = match &site.kind {
        SiteKind::Call { function } | SiteKind::Future { function, .. } => {
            (None, Some(*function), after(&site.label, front.rest)?)
        }
        SiteKind::Apply | SiteKind::FutureApply { .. } => (None, None, after(&site.label, front.rest)?),
        SiteKind::Loop(l) => {
            let (name, behind) = site.label.split_once("[]")?;
            let (number, rest) = front.rest.strip_prefix(name)?.strip_prefix('[')?.split_once(']')?;
            let path = join(path, iteration_key(number.parse().ok()?));
            (Some(Inside { path, is_future: false }), Some(l.body), after(behind, rest)?)
        }
        _ => return None,
    };
    let is_future = matches!(site.kind, SiteKind::Future { .. } | SiteKind::FutureApply { .. });
    let own = [Inside { path, is_future }].into_iter().chain(more);
    Some(Front { inside: front.inside.iter().copied().chain(own).collect(), function, rest })
}

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
        let mut addresses = Addresses::new(program);
        for (number, (path, _)) in (0..).zip(&choices) {
            let found = addresses.find(path);
            if found.is_empty() {
                return Err(path.clone());
            }
            for (path, is_outside_futures) in addresses.common(&found) {
                below.entry(path).or_insert_with(Vec::new).push(number);
                if is_outside_futures {
                    outside_futures.entry(path).or_insert_with(Vec::new).push(number);
                }
            }
            numbers.extend(found.into_iter().map(|(address, _)| (address, number)));
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

/// An activation that an address leads into.
#[derive(Clone, Copy)]
struct Activation {
    path: u128,
    /// Its function; `None` where a value was called, so that it may be any.
    function: Option<FunctionId>,
    /// Whether it may begin later than where it is called, as a future.
    is_future: bool,
    /// The number of the activation around it.
    parent: Option<usize>,
}

/// The activations that readable addresses lead into. Addresses with a common beginning share the search for it.
struct Addresses<'p> {
    program: &'p Program,
    activations: Vec<Activation>,
    /// The activations of each address, by number: several where different functions may be called at one place.
    numbers: HashMap<&'p str, Vec<usize>>,
    /// Memoised functions of modules, which belong to no activation, each with its name in addresses.
    of_modules: Vec<(u128, &'p str)>,
}

impl<'p> Addresses<'p> {
    fn new(program: &'p Program) -> Addresses<'p> {
        let root = Activation { path: ROOT, function: Some(program.entry), is_future: true, parent: None };
        let sites = program.functions.iter().flat_map(|f| &f.sites);
        let of_modules = sites.filter_map(|site| match site.kind {
            SiteKind::Memoise { of } => Some((of?, &*site.label)),
            _ => None,
        });
        Addresses {
            program,
            activations: vec![root],
            numbers: HashMap::from([("", vec![0])]),
            of_modules: of_modules.collect(),
        }
    }

    /// The addresses that choices with this readable address may have, each with its activation: several, too, where a
    /// function gives one name to several choices.
    fn find(&mut self, path: &'p str) -> Vec<(u128, usize)> {
        let (above, label) = split(path);
        // No component is empty; the empty beginning is the root.
        if path.starts_with('/') {
            return vec![];
        }
        self.enter(above);
        let mut found = Vec::new();
        for number in &self.numbers[above] {
            for site in self.sites(*number) {
                if matches!(site.kind, SiteKind::Sample(_)) && *site.label == *label {
                    found.push((join(self.activations[*number].path, site.key), *number));
                }
            }
        }
        found.sort_unstable();
        found.dedup_by_key(|(address, _)| *address);
        found
    }

    /// The sites of an activation.
    fn sites(&self, number: usize) -> impl Iterator<Item = &'p Site> + use<'p> {
        let functions = match self.activations[number].function {
            Some(id) => std::slice::from_ref(self.program.function(id)),
            None => &self.program.functions[..],
        };
        functions.iter().flat_map(|f| &f.sites)
    }

    /// Finds the activations of a readable address, component by component from the longest beginning that is known.
    fn enter(&mut self, path: &'p str) {
        let mut begin = path;
        while !self.numbers.contains_key(begin) {
            begin = split(begin).0;
        }
        while begin.len() < path.len() {
            let start = if begin.is_empty() { 0 } else { begin.len() + 1 };
            let end = path[start..].find('/').map_or(path.len(), |length| start + length);
            let component = &path[start..end];
            let mut numbers = Vec::new();
            for parent in self.numbers[begin].clone() {
                let of_modules = if begin.is_empty() { self.of_modules.clone() } else { vec![] };
                for (place, label) in of_modules {
                    self.remembered(place, label, component, &mut numbers);
                }
                for site in self.sites(parent) {
                    match site.kind {
                        SiteKind::Memoise { of: None } => {
                            let place = join(self.activations[parent].path, site.key);
                            self.remembered(place, &site.label, component, &mut numbers);
                        }
                        _ => numbers.extend(self.below(parent, site, component)),
                    }
                }
            }
            begin = &path[..end];
            self.numbers.insert(begin, numbers);
        }
    }

    /// Adds the calls of a memoised function, if they are called so: `color(3)`. Which function was memoised at that place is not
    /// known.
    fn remembered(&mut self, place: u128, label: &str, component: &str, numbers: &mut Vec<usize>) {
        let Some(text) = component.strip_prefix(label).filter(|text| text.starts_with('(')) else { return };
        for function in (0..self.program.functions.len()).map(|number| FunctionId(number as u32)) {
            // It lasts as long as somebody may ask for it; what is inside of it is met before it is left.
            let path = path_of(identity(place, self.program, function), text);
            let function = Some(function);
            numbers.push(self.add(Activation { path, function, is_future: true, parent: Some(0) }));
        }
    }

    /// Adds the activation below a site, if it is called so.
    fn below(&mut self, parent: usize, site: &Site, component: &str) -> Option<usize> {
        let path = join(self.activations[parent].path, site.key);
        let is_future = matches!(site.kind, SiteKind::Future { .. } | SiteKind::FutureApply { .. });
        let function = match &site.kind {
            SiteKind::Call { function } | SiteKind::Future { function, .. } => Some(*function),
            SiteKind::Apply | SiteKind::FutureApply { .. } => None,
            SiteKind::Loop(l) => {
                let (name, behind) = site.label.split_once("[]")?;
                let number = component.strip_prefix(name)?.strip_prefix('[')?.strip_suffix(behind)?;
                let iteration = iteration_key(number.strip_suffix(']')?.parse().ok()?);
                let whole = Activation { path, function: None, is_future: false, parent: Some(parent) };
                let parent = Some(self.add(whole));
                let (path, function) = (join(path, iteration), Some(l.body));
                return Some(self.add(Activation { path, function, is_future: false, parent }));
            }
            _ => return None,
        };
        let parent = Some(parent);
        (*site.label == *component).then(|| self.add(Activation { path, function, is_future, parent }))
    }

    fn add(&mut self, activation: Activation) -> usize {
        self.activations.push(activation);
        self.activations.len() - 1
    }

    /// The activations around a place, from the inside out.
    fn around(&self, number: usize) -> impl Iterator<Item = Activation> {
        let first = Some(self.activations[number]);
        std::iter::successors(first, |inner| inner.parent.map(|number| self.activations[number]))
    }

    /// The paths of the activations that all of these places are in, each with whether it lasts until the choice is met: no
    /// future is between them.
    fn common(&self, found: &[(u128, usize)]) -> Vec<(u128, bool)> {
        let Some(((_, first), others)) = found.split_first() else { return vec![] };
        let (mut all, mut is_outside_futures) = (vec![], true);
        for Activation { path, is_future, .. } in self.around(*first) {
            if others.iter().all(|(_, other)| self.around(*other).any(|around| around.path == path)) {
                all.push((path, is_outside_futures));
            }
            is_outside_futures &= !is_future;
        }
        all
    }
}

/// The address of the call around a component, and the component.
fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('/').unwrap_or(("", path))
}

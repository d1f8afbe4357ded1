//! The variables that can be read at choices.
//!
//! A variable is identified by its name in the model's source. The front end numbers the variables of the
//! source before its own, so the first of several variables with one readable name is the variable of the
//! source.

use crate::core::visit::{assigned, each_stmt};
use crate::core::{ExprKind, Function, LOOK, Name, PLACE, readable};
use std::collections::{HashMap, HashSet};

/// The variables that a program keeps readable at its choices.
#[derive(Clone, Copy, Debug)]
pub enum Scope<'a> {
    /// The variables with these readable names.
    Names(&'a [Name]),
    /// All variables with a readable name, and the place that the program looks from.
    All,
}

impl Scope<'_> {
    fn has(self, name: &str) -> bool {
        match self {
            Scope::Names(names) => names.iter().any(|listed| **listed == *name),
            Scope::All => !name.is_empty(),
        }
    }
}

/// The variables of one function that stay readable at choices, by their names in core form.
#[derive(Debug, Default)]
pub(crate) struct FunctionScope(HashSet<Name>);

impl FunctionScope {
    /// The scope of a function; empty for a function that makes no choices itself.
    pub fn of(f: &Function, scope: Scope<'_>) -> FunctionScope {
        if matches!(scope, Scope::Names([])) || !makes_choices(f) {
            return FunctionScope::default();
        }
        let number = |name: &Name| name.split_once('%').map_or(0, |(_, n)| n.parse().unwrap_or(u32::MAX));
        let set = assigned(&f.body);
        let mut first: HashMap<&str, &Name> = HashMap::new();
        for x in f.params.iter().chain(&f.captures).chain(&set).filter(|x| scope.has(readable(x))) {
            let chosen = first.entry(readable(x)).or_insert(x);
            if number(x) < number(chosen) {
                *chosen = x;
            }
        }
        let mut names: HashSet<Name> = first.into_values().cloned().collect();
        if matches!(scope, Scope::All) {
            names.extend([LOOK, PLACE].map(Name::from));
        }
        FunctionScope(names)
    }

    /// Whether choices can read a variable.
    pub fn has(&self, x: &Name) -> bool {
        self.0.contains(x)
    }
}

fn makes_choices(f: &Function) -> bool {
    let mut makes = false;
    each_stmt(&f.body, &mut |s| {
        for e in s.expressions() {
            e.each(&mut |e| makes |= matches!(e.kind, ExprKind::Sample(..)));
        }
    });
    makes
}

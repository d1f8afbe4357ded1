//! Which variables can be read at choices.
//!
//! A variable is meant by its name in the model's source. The front end numbers the variables of the source before its
//! own, so of several in one function with one readable name the first is meant.

use crate::core::visit::{assigned, each_stmt};
use crate::core::{ExprKind, Function, LOOK, Name, readable};
use std::collections::{HashMap, HashSet};

/// Which variables a program keeps for its choices.
#[derive(Clone, Copy, Debug)]
pub enum Kept<'a> {
    /// Those with these readable names.
    Names(&'a [Name]),
    /// All that have a readable name, and where the program looks from.
    All,
}

impl Kept<'_> {
    fn has(self, name: &str) -> bool {
        match self {
            Kept::Names(names) => names.iter().any(|own| **own == *name),
            Kept::All => !name.is_empty(),
        }
    }
}

/// The variables of one function to keep, by their names in core form.
#[derive(Debug, Default)]
pub(crate) struct Keeping(HashSet<Name>);

impl Keeping {
    /// Those of a function; none where it makes no choice itself.
    pub fn of(f: &Function, kept: Kept<'_>) -> Keeping {
        if matches!(kept, Kept::Names([])) || !makes_choices(f) {
            return Keeping::default();
        }
        let number = |name: &Name| name.split_once('%').map_or(0, |(_, n)| n.parse().unwrap_or(u32::MAX));
        let set = assigned(&f.body);
        let mut first: HashMap<&str, &Name> = HashMap::new();
        for x in f.params.iter().chain(&f.captures).chain(&set).filter(|x| kept.has(readable(x))) {
            let meant = first.entry(readable(x)).or_insert(x);
            if number(x) < number(meant) {
                *meant = x;
            }
        }
        let mut names: HashSet<Name> = first.into_values().cloned().collect();
        if matches!(kept, Kept::All) {
            names.insert(Name::from(LOOK));
        }
        Keeping(names)
    }

    /// Whether choices can read it.
    pub fn has(&self, x: &Name) -> bool {
        self.0.contains(x)
    }
}

fn makes_choices(f: &Function) -> bool {
    let mut makes = false;
    each_stmt(&f.body, &mut |s| {
        for e in s.expressions() {
            e.each(&mut |e| makes |= matches!(e.kind, ExprKind::Sample(_)));
        }
    });
    makes
}

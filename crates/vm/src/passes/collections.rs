//! Lists that are *collections*: lists that the program only builds, indexes, measures and returns.
//!
//! The elements of a collection are cells: references to registers of the activations that created them. When
//! an element changes, the list does not. Calls that received the list, loops that carry it and callers that it
//! was returned to see the same value, and only readers of the changed element run again. A list with any other
//! use (iterated over, compared, put into another value than a tuple) holds plain values.
//!
//! The analysis joins variables that may hold the same list into classes, over the whole program and without
//! regard to order. One use of another kind makes the whole class plain. Where activations are dropped, cells
//! are plain values from the start.

use super::effects::Effects;
use crate::core::{Expr, ExprKind, Function, Module, Name, Stmt, StmtKind};
use std::collections::HashMap;

/// The name that stands for a function's result among its variables.
const RESULT: &str = "";

/// The expressions that create or read elements of collections. They are identified by their addresses in
/// memory, which are stable while the module is borrowed.
#[derive(Default)]
pub struct Collections {
    class_of: HashMap<*const Expr, usize>,
    classes: Classes,
}

/// The classes of variables and lists.
#[derive(Default)]
struct Classes {
    parent: Vec<usize>,
    /// Whether a list of the class is built element by element.
    built: Vec<bool>,
    /// Whether a use of the class needs plain values.
    plain: Vec<bool>,
    /// The classes of the parts of a tuple.
    parts: Vec<Option<Vec<usize>>>,
    /// Classes that are indexed: the index, if it is a literal, and the class of the element.
    indexed: Vec<(usize, Option<i64>, usize)>,
    /// Classes that are indexed at places without sites: for a collection, such a use needs plain values.
    read_plainly: Vec<usize>,
    /// Classes that are unpacked, and the classes of the variables.
    unpacked: Vec<(usize, Vec<usize>)>,
}

impl Classes {
    fn fresh(&mut self) -> usize {
        self.parent.push(self.parent.len());
        self.built.push(false);
        self.plain.push(false);
        self.parts.push(None);
        self.parent.len() - 1
    }

    fn root(&self, mut class: usize) -> usize {
        while self.parent[class] != class {
            class = self.parent[class];
        }
        class
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        if a != b {
            self.parent[b] = a;
            self.built[a] |= self.built[b];
            self.plain[a] |= self.plain[b];
            match (self.parts[a].clone(), self.parts[b].take()) {
                (None, parts) => self.parts[a] = parts,
                (Some(_), None) => {}
                (Some(p), Some(q)) if p.len() == q.len() => {
                    p.iter().zip(q).for_each(|(p, q)| self.join(*p, q))
                }
                // The tuples have different lengths: nothing is known about either.
                (Some(p), Some(q)) => {
                    self.plain[a] = true;
                    p.iter().chain(&q).for_each(|part| {
                        let part = self.root(*part);
                        self.plain[part] = true;
                    });
                }
            }
        }
    }

    /// Propagates indexing and unpacking of tuples, and plain uses to the elements of tuples.
    fn settle(&mut self) {
        for (class, names) in std::mem::take(&mut self.unpacked) {
            let class = self.root(class);
            match self.parts[class].clone() {
                Some(parts) if parts.len() == names.len() => {
                    parts.iter().zip(names).for_each(|(part, name)| self.join(*part, name));
                }
                Some(_) => self.plain[class] = true,
                None => {
                    // The value is a collection, or a tuple that is built elsewhere, later in the order of
                    // reading.
                    self.parts[class] = Some(names);
                }
            }
        }
        loop {
            let before = (self.parent.clone(), self.plain.clone());
            for (class, place, part) in self.indexed.clone() {
                let class = self.root(class);
                let Some(parts) = self.parts[class].clone() else { continue };
                let at = place.map(|k| if k < 0 { k + parts.len() as i64 } else { k });
                match at.and_then(|k| parts.get(usize::try_from(k).ok()?)) {
                    Some(other) => self.join(*other, part),
                    None => parts.iter().for_each(|element| {
                        let element = self.root(*element);
                        self.plain[element] = true;
                    }),
                }
            }
            for class in self.read_plainly.clone() {
                let class = self.root(class);
                if self.parts[class].is_none() {
                    self.plain[class] = true;
                }
            }
            for class in 0..self.parent.len() {
                let root = self.root(class);
                let Some(parts) = self.parts[root].clone() else { continue };
                // The class has a list that is also a tuple, a tuple that holds itself, or an unknown use.
                self.plain[root] |= self.built[root] || self.holds_itself(root);
                if self.plain[root] {
                    for part in parts {
                        let part = self.root(part);
                        self.plain[part] = true;
                    }
                }
            }
            if before == (self.parent.clone(), self.plain.clone()) {
                return;
            }
        }
    }

    fn holds_itself(&self, class: usize) -> bool {
        let (mut work, mut seen) = (vec![class], vec![]);
        while let Some(at) = work.pop() {
            for part in self.parts[at].iter().flatten() {
                let part = self.root(*part);
                if part == class {
                    return true;
                }
                if !seen.contains(&part) {
                    seen.push(part);
                    work.push(part);
                }
            }
        }
        false
    }
}

/// Whether an expression consists of literals and data.
pub(super) fn is_constant(e: &Expr) -> bool {
    match &e.kind {
        ExprKind::Literal(_) | ExprKind::Data(_) => true,
        ExprKind::List(parts) | ExprKind::Tuple(parts) | ExprKind::Dist(_, parts) => {
            parts.iter().all(is_constant)
        }
        _ => false,
    }
}

struct Analysis<'m> {
    module: &'m Module,
    effects: &'m Effects,
    functions: HashMap<&'m Name, &'m Function>,
    variables: HashMap<(&'m str, &'m str), usize>,
    result: Collections,
    /// The current function.
    here: &'m Function,
    /// Whether a site is possible here: not in a pure function, and not in a loop that is not lifted.
    suspends: bool,
}

impl Collections {
    /// Analyses a module.
    pub fn of(module: &Module, effects: &Effects) -> Self {
        let Some(first) = module.functions.first() else { return Collections::default() };
        let mut analysis = Analysis {
            module,
            effects,
            functions: module.functions.iter().map(|f| (&f.name, f)).collect(),
            variables: HashMap::new(),
            result: Collections::default(),
            here: first,
            suspends: false,
        };
        for f in &analysis.module.functions {
            analysis.here = f;
            analysis.suspends = effects.function(&f.name);
            analysis.block(&f.body);
        }
        analysis.result.classes.settle();
        analysis.result
    }

    /// Whether the expression creates elements of a collection (a list, an `append`) or reads one (an `index`).
    pub fn contains(&self, e: &Expr) -> bool {
        self.class_of.get(&std::ptr::from_ref(e)).is_some_and(|class| {
            let class = self.classes.root(*class);
            self.classes.built[class] && !self.classes.plain[class]
        })
    }
}

impl<'m> Analysis<'m> {
    fn variable(&mut self, function: &'m str, x: &'m str) -> usize {
        let classes = &mut self.result.classes;
        *self.variables.entry((function, x)).or_insert_with(|| classes.fresh())
    }

    fn joined(&mut self, a: Option<usize>, b: Option<usize>) -> Option<usize> {
        if let (Some(a), Some(b)) = (a, b) {
            self.result.classes.join(a, b);
        }
        a.or(b)
    }

    fn plain(&mut self, class: Option<usize>) {
        if let Some(class) = class {
            let class = self.result.classes.root(class);
            self.result.classes.plain[class] = true;
        }
    }

    /// Marks the class of an expression for a use that needs plain values.
    fn escapes(&mut self, e: &'m Expr) {
        let class = self.expr(e);
        self.plain(class);
    }

    fn block(&mut self, block: &'m [Stmt]) {
        for s in block {
            let outside = self.suspends;
            match &s.kind {
                StmtKind::For(_, _, body) => {
                    self.statement(s);
                    self.suspends &= self.effects.in_block(body);
                }
                StmtKind::While(test, body) => {
                    self.suspends &= self.effects.in_block(body) || self.effects.in_expr(test);
                    self.statement(s);
                }
                _ => self.statement(s),
            }
            s.blocks().into_iter().for_each(|inner| self.block(inner));
            self.suspends = outside;
        }
    }

    fn statement(&mut self, s: &'m Stmt) {
        let here = &*self.here.name;
        match &s.kind {
            StmtKind::Set(x, e) => {
                let (to, from) = (self.variable(here, x), self.expr(e));
                self.joined(Some(to), from);
            }
            StmtKind::Return(e) => {
                let (to, from) = (self.variable(here, RESULT), self.expr(e));
                self.joined(Some(to), from);
            }
            StmtKind::Do(e) => {
                self.expr(e);
            }
            StmtKind::Unpack(names, e) => {
                let class = self.expr(e);
                let parts: Vec<usize> = names.iter().map(|x| self.variable(here, x)).collect();
                if let Some(class) = class {
                    self.result.classes.unpacked.push((class, parts));
                }
            }
            _ => s.expressions().into_iter().for_each(|e| self.escapes(e)),
        }
    }

    /// Joins arguments with the parameters and then the captures of a function.
    fn pass(&mut self, function: &'m Name, args: &'m [Expr], captures_only: bool) -> Option<usize> {
        let Some(f) = self.functions.get(function).copied() else {
            args.iter().for_each(|e| self.escapes(e));
            return None;
        };
        let names = f.params.iter().filter(|_| !captures_only).chain(&f.captures);
        for (x, e) in names.zip(args) {
            let (to, from) = (self.variable(&f.name, x), self.expr(e));
            self.joined(Some(to), from);
        }
        Some(self.variable(&f.name, RESULT))
    }

    fn built(&mut self, e: &'m Expr, class: usize) -> Option<usize> {
        if self.suspends {
            let root = self.result.classes.root(class);
            self.result.classes.built[root] = true;
            self.result.class_of.insert(std::ptr::from_ref(e), class);
        }
        Some(class)
    }

    /// The class of an expression's value, if it can be a collection.
    fn expr(&mut self, e: &'m Expr) -> Option<usize> {
        use ExprKind::*;
        match &e.kind {
            Literal(_) | Data(_) => None,
            Var(x) => Some(self.variable(&self.here.name, x)),
            Call(f, args) | Future(f, args) => self.pass(f, args, false),
            Closure(f, captures) => {
                self.pass(f, captures, true);
                // The callers, the arguments and the uses of the result are unknown.
                if let Some(f) = self.functions.get(f).copied() {
                    for x in f.params.iter().map(|x| &**x).chain([RESULT]) {
                        let class = self.variable(&f.name, x);
                        self.plain(Some(class));
                    }
                }
                None
            }
            Force(x) => self.expr(x),
            Cond(test, a, b) => {
                self.escapes(test);
                let (a, b) = (self.expr(a), self.expr(b));
                self.joined(a, b)
            }
            List(items) => {
                items.iter().for_each(|item| self.escapes(item));
                let class = self.result.classes.fresh();
                // A list of constants alone is not a collection.
                if items.iter().all(is_constant) { Some(class) } else { self.built(e, class) }
            }
            Tuple(items) => {
                let parts = items
                    .iter()
                    .map(|item| {
                        let part = self.expr(item);
                        part.unwrap_or_else(|| self.result.classes.fresh())
                    })
                    .collect();
                let class = self.result.classes.fresh();
                self.result.classes.parts[class] = Some(parts);
                Some(class)
            }
            Query(key, value) => {
                self.escapes(key);
                self.expr(value);
                None
            }
            Op(name, parts) => match (&**name, parts.as_slice()) {
                ("append", [list, item]) => {
                    self.escapes(item);
                    match self.expr(list) {
                        Some(class) => self.built(e, class),
                        None => None,
                    }
                }
                ("add", [a, b]) => {
                    let class = (self.expr(a), self.expr(b));
                    let class = self.joined(class.0, class.1);
                    if let (Some(class), List(_), true) = (class, &b.kind, self.suspends) {
                        self.result.class_of.insert(std::ptr::from_ref(e), class);
                    }
                    class
                }
                ("len", [list]) => {
                    self.expr(list);
                    None
                }
                ("index", [list, at]) => {
                    self.escapes(at);
                    let class = self.expr(list)?;
                    if !self.suspends {
                        self.result.classes.read_plainly.push(class);
                    } else {
                        self.result.class_of.insert(std::ptr::from_ref(e), class);
                    }
                    // The element of a tuple is known if the index is a literal.
                    let part = self.result.classes.fresh();
                    let place = match &at.kind {
                        Literal(crate::core::Literal::Int(k)) => Some(*k),
                        _ => None,
                    };
                    self.result.classes.indexed.push((class, place, part));
                    Some(part)
                }
                _ => {
                    parts.iter().for_each(|part| self.escapes(part));
                    None
                }
            },
            _ => {
                e.parts().into_iter().for_each(|part| self.escapes(part));
                None
            }
        }
    }
}

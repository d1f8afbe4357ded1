//! Visiting core form: the parts of an expression, and the names that statements read and assign.

use super::*;
use std::collections::BTreeSet;

/// A set of variables, in a fixed order so that compiling is deterministic.
pub type Names = BTreeSet<Name>;

impl Expr {
    /// The direct parts, in order of evaluation.
    pub fn parts(&self) -> Vec<&Expr> {
        use ExprKind::*;
        match &self.kind {
            Literal(_) | Data(_) | Var(_) => vec![],
            And(xs) | Or(xs) | Emit(xs) | List(xs) | Tuple(xs) => xs.iter().collect(),
            Call(_, xs)
            | Closure(_, xs)
            | Future(_, xs)
            | Dist(_, xs)
            | Host(_, xs)
            | Record(_, xs)
            | Op(_, xs) => xs.iter().collect(),
            Cond(c, a, b) => vec![c, a, b],
            Sample(x, options) => std::iter::once(&**x).chain(options.as_deref()).collect(),
            Factor(x) | Condition(x) | Force(x) | Field(x, _) | Mem(x, _) => vec![x],
            Observe(a, b) | Query(a, b) | Place(a, b) => vec![a, b],
            Apply(f, xs) | FutureApply(f, xs) | Method(f, _, xs) => std::iter::once(&**f).chain(xs).collect(),
            Dict(ks, xs) => ks.iter().chain(xs).collect(),
        }
    }

    /// The direct parts, to be changed.
    pub fn parts_mut(&mut self) -> Vec<&mut Expr> {
        use ExprKind::*;
        match &mut self.kind {
            Literal(_) | Data(_) | Var(_) => vec![],
            And(xs) | Or(xs) | Emit(xs) | List(xs) | Tuple(xs) => xs.iter_mut().collect(),
            Call(_, xs)
            | Closure(_, xs)
            | Future(_, xs)
            | Dist(_, xs)
            | Host(_, xs)
            | Record(_, xs)
            | Op(_, xs) => xs.iter_mut().collect(),
            Cond(c, a, b) => vec![c, a, b],
            Sample(x, options) => std::iter::once(&mut **x).chain(options.as_deref_mut()).collect(),
            Factor(x) | Condition(x) | Force(x) | Field(x, _) | Mem(x, _) => vec![x],
            Observe(a, b) | Query(a, b) | Place(a, b) => vec![a, b],
            Apply(f, xs) | FutureApply(f, xs) | Method(f, _, xs) => {
                std::iter::once(&mut **f).chain(xs).collect()
            }
            Dict(ks, xs) => ks.iter_mut().chain(xs).collect(),
        }
    }

    /// Calls `visit` on this expression and all expressions below it.
    pub fn each<'a>(&'a self, visit: &mut dyn FnMut(&'a Expr)) {
        visit(self);
        for part in self.parts() {
            part.each(visit);
        }
    }

    /// Adds the variables that the expression reads.
    pub fn reads(&self, into: &mut Names) {
        self.each(&mut |e| {
            if let ExprKind::Var(x) = &e.kind {
                into.insert(x.clone());
            }
        });
    }
}

impl Stmt {
    /// The expressions of the statement itself, without those of nested statements.
    pub fn expressions(&self) -> Vec<&Expr> {
        match &self.kind {
            StmtKind::Set(_, e)
            | StmtKind::Unpack(_, e)
            | StmtKind::UnpackStar(_, _, _, e)
            | StmtKind::If(e, _, _)
            | StmtKind::For(_, e, _)
            | StmtKind::While(e, _)
            | StmtKind::Return(e)
            | StmtKind::Do(e) => vec![e],
            StmtKind::Assert(c, m) => vec![c, m],
            StmtKind::Break | StmtKind::Continue => vec![],
        }
    }

    /// The nested blocks.
    pub fn blocks(&self) -> Vec<&[Stmt]> {
        match &self.kind {
            StmtKind::If(_, a, b) => vec![a, b],
            StmtKind::For(_, _, body) | StmtKind::While(_, body) => vec![body],
            _ => vec![],
        }
    }

    /// The variables that the statement itself assigns, without those of nested statements.
    pub fn targets(&self) -> Vec<&Name> {
        match &self.kind {
            StmtKind::Set(x, _) | StmtKind::For(x, _, _) => vec![x],
            StmtKind::Unpack(xs, _) => xs.iter().collect(),
            StmtKind::UnpackStar(a, r, c, _) => a.iter().chain(std::iter::once(r)).chain(c).collect(),
            _ => vec![],
        }
    }
}

/// Calls `visit` on every statement of a block, nested ones included.
pub fn each_stmt<'a>(block: &'a [Stmt], visit: &mut dyn FnMut(&'a Stmt)) {
    for s in block {
        visit(s);
        for inner in s.blocks() {
            each_stmt(inner, visit);
        }
    }
}

/// The variables that a block assigns anywhere.
pub fn assigned(block: &[Stmt]) -> Names {
    let mut names = Names::new();
    each_stmt(block, &mut |s| names.extend(s.targets().into_iter().cloned()));
    names
}

/// The given variables, in the order in which a block assigns each for the last time.
pub fn in_order_of_assignment(block: &[Stmt], names: &[Name]) -> Vec<Name> {
    let mut targets: Vec<&Name> = vec![];
    each_stmt(block, &mut |s| targets.extend(s.targets()));
    let mut names = names.to_vec();
    names.sort_by_key(|x| targets.iter().rposition(|target| *target == x));
    names
}

/// Whether a block contains a `return`.
pub fn returns(block: &[Stmt]) -> bool {
    let mut returns = false;
    each_stmt(block, &mut |s| returns |= matches!(s.kind, StmtKind::Return(_)));
    returns
}

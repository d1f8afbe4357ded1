//! Core form: what a model is after names are resolved and before it is compiled.
//!
//! Core form has about twenty kinds of expression and ten of statement, each with its place in the source.
//! Python sends it as text. [`read`] turns characters into nested lists, [`parse`] turns nested lists into the
//! types of this file, and [`mod@print`] writes them as text again. So tests, fuzzers and bug reports run real
//! programs without Python.

pub(crate) mod deep;
pub mod parse;
pub mod print;
pub mod read;
pub mod visit;

use crate::value::{Class, ClassKind};
use std::sync::Arc;

/// A name of a variable, function or field.
pub type Name = Arc<str>;

/// The name of a variable in the model's source: `x` for `x` and for `x%3`. Empty for names of the front end.
pub fn readable(name: &str) -> &str {
    name.split('%').next().unwrap_or(name)
}

/// The variable that a statement `look(...)` assigns: the place from which the choices after it are seen.
pub const LOOK: &str = "%look";

/// The capture with the frame of what a function emits, in programs that place calls: see `passes/frames.rs`.
pub const PLACE: &str = "%place";

/// A place in a source file: 1-based lines and columns, the end exclusive. All zero when unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// First line.
    pub line: u32,
    /// First column.
    pub column: u32,
    /// Last line.
    pub end_line: u32,
    /// Column after the last character.
    pub end_column: u32,
}

/// A whole program.
#[derive(Default)]
pub struct Module {
    /// Source files, by the number that functions refer to.
    pub files: Vec<String>,
    /// Record classes: name and field names, by number.
    pub classes: Vec<Class>,
    /// Constants that the text itself contains (programs without Python); others come beside the text.
    pub constants: Vec<(usize, Expr)>,
    /// Every function that can be reached.
    pub functions: Vec<Function>,
    /// Qualified name of the function where a run starts.
    pub entry: Name,
}

/// A function.
#[derive(Clone, Debug)]
pub struct Function {
    /// Qualified name, unique in the module.
    pub name: Name,
    /// Number of the source file.
    pub file: u32,
    /// The place of its definition.
    pub span: Span,
    /// Parameters in order.
    pub params: Vec<Name>,
    /// Values of the last parameters when a caller omits them: literals, constants or captured variables.
    pub defaults: Vec<Expr>,
    /// Variables of enclosing functions, whose values a closure carries.
    pub captures: Vec<Name>,
    /// The statements.
    pub body: Vec<Stmt>,
}

impl Function {
    /// Whether a captured variable holds the value of a default.
    pub fn is_default(&self, captured: &Name) -> bool {
        self.defaults.iter().any(|default| matches!(&default.kind, ExprKind::Var(x) if x == captured))
    }
}

/// A statement and its place.
#[derive(Clone, Debug)]
pub struct Stmt {
    /// Its place in the source.
    pub span: Span,
    /// The component of readable addresses that a loop adds: `i[]`, with the index to be put between the
    /// brackets.
    pub label: Option<Name>,
    /// The kind of statement, with its parts.
    pub kind: StmtKind,
}

/// The kinds of statement.
#[derive(Clone, Debug)]
pub enum StmtKind {
    /// Assign a variable.
    Set(Name, Expr),
    /// Assign the elements of a sequence of exactly that length.
    Unpack(Vec<Name>, Expr),
    /// Assign the first and last elements, and the list of those between.
    UnpackStar(Vec<Name>, Name, Vec<Name>, Expr),
    /// A branch with two arms.
    If(Expr, Vec<Stmt>, Vec<Stmt>),
    /// Run the body once for each element.
    For(Name, Expr, Vec<Stmt>),
    /// Run the body while the condition holds.
    While(Expr, Vec<Stmt>),
    /// Leave the innermost loop.
    Break,
    /// Go to the next iteration of the innermost loop.
    Continue,
    /// Return a value.
    Return(Expr),
    /// Evaluate for the effect.
    Do(Expr),
    /// Raise a fault with this message unless the condition holds.
    Assert(Expr, Expr),
}

/// An expression and its place.
#[derive(Clone, Debug)]
pub struct Expr {
    /// Its place in the source.
    pub span: Span,
    /// The component of readable addresses that a site adds. Programs without labels get it from their names.
    pub label: Option<Name>,
    /// The kind of expression, with its parts.
    pub kind: ExprKind,
}

/// A literal.
#[derive(Clone, Debug, PartialEq)]
pub enum Literal {
    /// `None`.
    None,
    /// A truth value.
    Bool(bool),
    /// A 64-bit integer.
    Int(i64),
    /// A real.
    Real(f64),
    /// A string.
    Str(String),
}

/// The kinds of expression.
#[derive(Clone, Debug)]
pub enum ExprKind {
    /// A literal.
    Literal(Literal),
    /// A constant of the table that comes beside the text.
    Data(usize),
    /// A variable.
    Var(Name),
    /// Python's `and`: the first value that is not true, else the last.
    And(Vec<Expr>),
    /// Python's `or`.
    Or(Vec<Expr>),
    /// `a if c else b`, in the order condition, then, else.
    Cond(Box<Expr>, Box<Expr>, Box<Expr>),
    /// Call of a known function with all its parameters.
    Call(Name, Vec<Expr>),
    /// A function value, with the values of its captures.
    Closure(Name, Vec<Expr>),
    /// Call of a function value.
    Apply(Box<Expr>, Vec<Expr>),
    /// A call whose shapes go into a frame: the frame, and a `Call` or an `Apply`.
    Place(Box<Expr>, Box<Expr>),
    /// A random choice; of a whole number with the list of its options, whose words name the number.
    Sample(Box<Expr>, Option<Box<Expr>>),
    /// A density factor of a distribution at a value.
    Observe(Box<Expr>, Box<Expr>),
    /// A log factor.
    Factor(Box<Expr>),
    /// A factor of one or zero.
    Condition(Box<Expr>),
    /// Write a value into the query table.
    Query(Box<Expr>, Box<Expr>),
    /// Add shapes to the scene as one primitive.
    Emit(Vec<Expr>),
    /// The value of a future.
    Force(Box<Expr>),
    /// A memoised function, made from a function value. A memoised function of a module also has a name: it is
    /// the same function in every activation.
    Mem(Box<Expr>, Option<Name>),
    /// A deferred call of a known function.
    Future(Name, Vec<Expr>),
    /// A deferred call of a function value.
    FutureApply(Box<Expr>, Vec<Expr>),
    /// A distribution value, by the name of its family.
    Dist(Name, Vec<Expr>),
    /// A call of a pure host function, by the number of the constant that holds it.
    Host(usize, Vec<Expr>),
    /// A record of the numbered class.
    Record(usize, Vec<Expr>),
    /// A field of a record, vector or shape.
    Field(Box<Expr>, Name),
    /// A list.
    List(Vec<Expr>),
    /// A tuple.
    Tuple(Vec<Expr>),
    /// A dictionary with constant keys.
    Dict(Vec<Expr>, Vec<Expr>),
    /// A method of a built-in value.
    Method(Box<Expr>, Name, Vec<Expr>),
    /// Any other operation, by its name in the table of operations.
    Op(Name, Vec<Expr>),
}

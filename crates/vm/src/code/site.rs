//! Suspension sites: where a call can stop, and what happens there.

use super::operand::{Args, FunctionId, Operand};
use crate::core::{Name, Span};
use niwaki_math::Family;

/// Where the distribution of a choice or an observation comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A known family; the arguments are its parameters.
    Family(Family),
    /// A distribution value, the first argument.
    Value,
    /// Element `args[1]` of the list of distributions `args[0]`.
    Element,
}

/// What happens at a suspension site.
#[derive(Clone, Debug, PartialEq)]
pub enum SiteKind {
    /// Call of a known effectful function.
    Call {
        /// The function that is called.
        function: FunctionId,
    },
    /// Call of a function value, the first argument.
    Apply,
    /// A lifted loop; see [`Loop`].
    Loop(Loop),
    /// A random choice.
    Sample(Source),
    /// A factor by the density of a value, the last argument.
    Observe(Source),
    /// A log factor.
    Factor,
    /// A factor of one or zero.
    Condition,
    /// A write to the query table: key and value.
    Query,
    /// One primitive: shapes, or lists of shapes.
    Emit,
    /// A deferred call of a known function. `detached`: nothing reads the handle.
    Future {
        /// The function that is called.
        function: FunctionId,
        /// Nothing reads the handle.
        detached: bool,
    },
    /// A deferred call of a function value, the first argument.
    FutureApply {
        /// Nothing reads the handle.
        detached: bool,
    },
    /// The value of a future.
    Force,
    /// A memoised function value, of a function value. Its identity is the address of the site, or the one given: that
    /// of a memoised function of a module.
    Memoise {
        /// The address of a memoised function of a module.
        of: Option<u128>,
    },
    /// An element of a collection: the register holds the element, the result refers to it. Where activations are
    /// dropped, the result is the element.
    Cell {
        /// Holds the element.
        content: Operand,
    },
    /// As `Cell`, with the list that it is appended to: the list, then the element; the result is the longer list.
    Append {
        /// Holds the element.
        content: Operand,
    },
    /// An element of a collection, read: `args[0]` at `args[1]`.
    Read,
}

impl SiteKind {
    /// Whether such a site creates an activation: of a call, a future or a loop.
    #[inline]
    pub fn makes_activation(&self) -> bool {
        match self {
            SiteKind::Call { .. } | SiteKind::Apply | SiteKind::Loop(_) => true,
            SiteKind::Future { .. } | SiteKind::FutureApply { .. } => true,
            SiteKind::Sample(_) | SiteKind::Observe(_) | SiteKind::Factor | SiteKind::Condition => false,
            SiteKind::Query | SiteKind::Emit | SiteKind::Force | SiteKind::Memoise { .. } => false,
            SiteKind::Cell { .. } | SiteKind::Append { .. } | SiteKind::Read => false,
        }
    }

    /// Whether a run that stops at such a site continues *at* it, and not after it: a choice is repeated, and a force
    /// tests again whether its future has returned.
    #[inline]
    pub fn is_met_again(&self) -> bool {
        match self {
            SiteKind::Sample(_) | SiteKind::Force => true,
            SiteKind::Call { .. } | SiteKind::Apply | SiteKind::Loop(_) => false,
            SiteKind::Future { .. } | SiteKind::FutureApply { .. } => false,
            SiteKind::Observe(_) | SiteKind::Factor | SiteKind::Condition => false,
            SiteKind::Query | SiteKind::Emit | SiteKind::Memoise { .. } => false,
            SiteKind::Cell { .. } | SiteKind::Append { .. } | SiteKind::Read => false,
        }
    }

    /// Whether its result is a future.
    #[inline]
    pub fn gives_future(&self) -> bool {
        matches!(self, SiteKind::Future { detached: false, .. } | SiteKind::FutureApply { detached: false })
    }

    /// Whether the arguments are read once more when other activations have run, so that they must outlive the site.
    /// Those of a site that is met again are; a proposal draws and scores from the node and the site alone; a query
    /// table is read likewise; an append identifies its list by its address, so the list must exist.
    pub fn is_read_again(&self) -> bool {
        self.is_met_again() || matches!(self, SiteKind::Query | SiteKind::Append { .. })
    }
}

/// A lifted loop: its iterations are activations of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// The function of the loop node, which has registers and no code.
    pub header: FunctionId,
    /// The function of one iteration: element (for `for`), carried values; captures are its outer operands.
    pub body: FunctionId,
    /// What a `for` loop iterates over.
    pub over: Option<Operand>,
    /// Carried values going in.
    pub carried: Args,
    /// Values captured by the loop node.
    pub captures: Args,
    /// Registers for the carried values coming out.
    pub out: Args,
    /// Register for the kind of exit, when the body contains `return`; the returned value goes into the next one.
    pub exit: Option<(Operand, Operand)>,
}

/// A suspension site.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// What happens.
    pub kind: SiteKind,
    /// Register for the result.
    pub to: Operand,
    /// Whether the result is read.
    pub is_read: bool,
    /// Of a call: the activation returns after it, with its result or with a constant. Where activations are dropped, such a call
    /// drops what its caller's registers hold, and one of the same function takes the registers: a recursion has those of its
    /// innermost activation alone.
    pub is_tail: bool,
    /// Arguments.
    pub args: Args,
    /// Hash of qualified function, what is called, the name assigned to, and the occurrence among equals:
    /// it does not depend on line numbers.
    pub key: u128,
    /// The readable component of an address.
    pub label: Name,
    /// Its place in the source.
    pub span: Span,
    /// The instruction after it.
    pub next: u32,
    /// Where a run continues when only its result has changed: a slice, or the instruction after it.
    pub again: u32,
    /// Its result is an angle, as [`Visible::is_angle`](super::Visible::is_angle) is.
    pub is_angle: bool,
    /// Of a choice: its part of [`Function::scope`](super::Function::scope), first and end.
    pub visible: (u32, u32),
    /// Of an observation: a hash of the text of what is observed; else 0.
    pub subject: u128,
}

impl Site {
    /// Where a run continues that stopped at the site, whose instruction is `pc`.
    #[inline]
    pub fn resumes_at(&self, pc: usize) -> usize {
        if self.kind.is_met_again() { pc } else { pc + 1 }
    }
}

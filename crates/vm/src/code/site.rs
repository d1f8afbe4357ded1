//! Suspension sites: where a call can stop, and what the machine does there.

use super::operand::{Args, FunctionId, Operand};
use crate::core::{Name, Span};
use niwaki_math::Family;

/// The source of the distribution of a choice or an observation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A known family; the arguments are its parameters.
    Family(Family),
    /// A distribution value, the first argument.
    Value,
    /// Element `args[1]` of the list of distributions `args[0]`.
    Element,
}

/// The kinds of suspension site.
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
    /// A deferred call of a known function.
    Future {
        /// The function that is called.
        function: FunctionId,
        /// Whether nothing reads the handle.
        detached: bool,
    },
    /// A deferred call of a function value, the first argument.
    FutureApply {
        /// Whether nothing reads the handle.
        detached: bool,
    },
    /// The value of a future.
    Force,
    /// A memoised function, made from a function value. Its identity is the address of the site, unless `of`
    /// has the address of a memoised function of a module.
    Memoise {
        /// The address of a memoised function of a module.
        of: Option<u128>,
    },
    /// An element of a collection. The register `content` holds the element, and the result refers to that
    /// register. Where activations are dropped, the result is the element itself.
    Cell {
        /// The register that holds the element.
        content: Operand,
    },
    /// Like `Cell`, for an element that is appended to a list. The arguments are the list and the element; the
    /// result is the longer list.
    Append {
        /// The register that holds the element.
        content: Operand,
    },
    /// A read of an element of a collection: `args[0]` at `args[1]`.
    Read,
}

impl SiteKind {
    /// Whether the site creates an activation: of a call, a future or a loop.
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

    /// Whether a run that stops at the site resumes *at* it, and not after it: a choice is repeated, and a
    /// force tests again whether its future has returned.
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

    /// Whether the site's result is a future.
    #[inline]
    pub fn gives_future(&self) -> bool {
        matches!(self, SiteKind::Future { detached: false, .. } | SiteKind::FutureApply { detached: false })
    }

    /// Whether the arguments are read again after other activations have run, so that they must outlive the
    /// site. A site that is met again reads its arguments again; a proposal draws and scores from the node and
    /// the site alone; a query table is read likewise; an append identifies its list by its address, so the
    /// list must exist.
    pub fn is_read_again(&self) -> bool {
        self.is_met_again() || matches!(self, SiteKind::Query | SiteKind::Append { .. })
    }
}

/// A lifted loop: each of its iterations is an activation of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// The function of the loop node, which has registers and no code.
    pub header: FunctionId,
    /// The function of one iteration. Its parameters are the element (of a `for` loop) and the carried values;
    /// its captures are outer operands.
    pub body: FunctionId,
    /// The sequence that a `for` loop iterates over.
    pub over: Option<Operand>,
    /// The carried values at the start of the loop.
    pub carried: Args,
    /// Values captured by the loop node.
    pub captures: Args,
    /// Registers for the carried values at the end of the loop.
    pub out: Args,
    /// Register for the kind of exit, when the body contains `return`. The returned value goes into the second
    /// register.
    pub exit: Option<(Operand, Operand)>,
}

/// A suspension site.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// The kind of site.
    pub kind: SiteKind,
    /// The register for the result.
    pub to: Operand,
    /// Whether the result is read.
    pub is_read: bool,
    /// Whether the site is a call after which the activation returns, with the call's result or with a
    /// constant. Where activations are dropped, such a call drops the contents of its caller's registers, and
    /// below a few activations a call of the same function reuses the registers: a deep recursion needs the
    /// registers of its innermost activation alone.
    pub is_tail: bool,
    /// The arguments.
    pub args: Args,
    /// Whether the last argument of a choice is the list of its options ([`At::words`](crate::machine::answers::At::words)).
    pub has_options: bool,
    /// A hash of the qualified function, the called function or family, the assigned name, and the occurrence
    /// among equals: it does not depend on line numbers.
    pub key: u128,
    /// The readable component of an address.
    pub label: Name,
    /// The place in the source.
    pub span: Span,
    /// The instruction after the site.
    pub next: u32,
    /// The instruction where a run continues when only the site's result has changed: a slice, or the
    /// instruction after the site.
    pub again: u32,
    /// Whether the result is an angle, as [`Visible::is_angle`](super::Visible::is_angle) is.
    pub is_angle: bool,
    /// The part of [`Function::scope`](super::Function::scope) that belongs to a choice: start and end.
    pub visible: (u32, u32),
    /// A hash of the text of the observed expression for an observation; else 0.
    pub subject: u128,
}

impl Site {
    /// The instruction where a run that stopped at the site resumes. `pc` is the instruction of the site.
    #[inline]
    pub fn resumes_at(&self, pc: usize) -> usize {
        if self.kind.is_met_again() { pc } else { pc + 1 }
    }

    /// The arguments that give the distribution of a choice or an observation.
    #[inline(always)]
    pub fn parameters(&self) -> Args {
        let is_last_other = self.has_options || matches!(self.kind, SiteKind::Observe(_));
        Args { len: self.args.len - u16::from(is_last_other), ..self.args }
    }
}

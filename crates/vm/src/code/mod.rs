//! Bytecode: the parts of a compiled program. Numbers in newtypes, layouts in one place.
//!
//! An operand is 16 bits: two of class, fourteen of index.
//!
//! | class | where it is stored | what it holds |
//! | --- | --- | --- |
//! | node | a register of the activation, kept as long as it | values needed after a suspension site |
//! | outer | a register of the enclosing loop node | what an iteration captures |
//! | scratch | a register of the machine, gone at the next suspension | everything else; all of a pure function |
//! | constant | the function's constant table | literals and data |

mod convert;
mod disassemble;
pub mod kinds;
mod verify;

pub use disassemble::disassemble;
pub use verify::{VerifyError, verify};

use crate::core::{Name, Span};
use crate::native::Entries;
use crate::value::{Census, Class, Value};
use niwaki_math::{Family, Scalar};

/// Where an instruction reads or writes a value.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Operand(pub u16);

/// The class of an [`Operand`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A register of the activation.
    Node,
    /// A register of the enclosing loop node.
    Outer,
    /// A register of the machine.
    Scratch,
    /// A constant of the function.
    Constant,
}

impl Operand {
    /// The largest index that fits.
    pub const MAX_INDEX: usize = (1 << 14) - 1;

    /// An operand from its class and index.
    pub fn new(place: Place, index: usize) -> Self {
        debug_assert!(index <= Self::MAX_INDEX);
        Operand(((place as u16) << 14) | index as u16)
    }

    /// Its class.
    #[inline]
    pub fn place(self) -> Place {
        match self.0 >> 14 {
            0 => Place::Node,
            1 => Place::Outer,
            2 => Place::Scratch,
            _ => Place::Constant,
        }
    }

    /// Whether it is a register of the activation.
    #[inline(always)]
    pub fn is_node(self) -> bool {
        self.0 < 1 << 14
    }

    /// Of an operand that is not in the node: whether it is in the loop node above.
    #[inline(always)]
    pub fn is_outer(self) -> bool {
        self.0 < 2 << 14
    }

    /// Of an operand of the machine: whether it is a constant.
    #[inline(always)]
    pub fn is_constant(self) -> bool {
        self.0 >= 3 << 14
    }

    /// Its index within the class.
    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 & 0x3FFF) as usize
    }

    /// Whether an instruction may write it.
    pub fn is_register(self) -> bool {
        matches!(self.place(), Place::Node | Place::Scratch)
    }
}

impl std::fmt::Debug for Operand {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let letter = match self.place() {
            Place::Node => 'n',
            Place::Scratch => 's',
            Place::Constant => 'k',
            Place::Outer => 'o',
        };
        write!(f, "{letter}{}", self.index())
    }
}

/// A run of operands in the function's operand list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Args {
    /// First place in [`Function::operands`].
    pub start: u32,
    /// How many.
    pub len: u16,
}

impl Args {
    /// The empty run.
    pub const NONE: Args = Args { start: 0, len: 0 };

    /// The places in the operand list.
    #[inline]
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.start as usize + self.len as usize
    }
}

/// Number of a function in its program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FunctionId(pub u32);

/// Number of a suspension site in its function, in program order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SiteId(pub u16);

/// How an iteration of a lifted loop ended, as a small integer in a register.
pub mod exit {
    /// It fell off its end or met `continue`.
    pub const NEXT: i64 = 0;
    /// It met `break`.
    pub const BREAK: i64 = 1;
    /// It met `return`; the value follows the carried variables.
    pub const RETURN: i64 = 2;
}

/// The two-operand operations with an instruction of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    FloorDiv,
    Mod,
    Pow,
    Eq,
    Ne,
    Lt,
    Le,
    Gt,
    Ge,
    Index,
    In,
}

/// One instruction.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // each instruction's line describes its fields
pub enum Op {
    /// Copy a value.
    Move { to: Operand, from: Operand },
    /// A sum. The four most frequent operations have instructions of their own.
    Add { to: Operand, a: Operand, b: Operand },
    /// A difference.
    Sub { to: Operand, a: Operand, b: Operand },
    /// A product.
    Mul { to: Operand, a: Operand, b: Operand },
    /// A quotient.
    Div { to: Operand, a: Operand, b: Operand },
    /// Any other two-operand operation.
    Binary { op: Binary, to: Operand, a: Operand, b: Operand },
    /// Arithmetic negation.
    Neg { to: Operand, a: Operand },
    /// Python's `not`.
    Not { to: Operand, a: Operand },
    /// A built-in function by number.
    Builtin { to: Operand, id: u16, args: Args },
    /// A list of the arguments.
    List { to: Operand, args: Args },
    /// A tuple of the arguments.
    Tuple { to: Operand, args: Args },
    /// A dictionary: keys, then values.
    Dict { to: Operand, args: Args },
    /// A record of the numbered class.
    Record { to: Operand, class: u16, args: Args },
    /// A named field.
    Field { to: Operand, a: Operand, name: u16 },
    /// The elements of a sequence of exactly that length into registers.
    Unpack { from: Operand, to: Args },
    /// As `Unpack`, the middle as a list into the register numbered `star` of the run.
    UnpackStar { from: Operand, to: Args, star: u16 },
    /// A function value.
    Closure { to: Operand, function: u16, args: Args },
    /// A distribution value.
    Dist { to: Operand, family: Family, args: Args },
    /// A pure host function, by constant number of the program.
    Host { to: Operand, constant: u16, args: Args },
    /// Call of a pure function: no node, no site.
    CallPure { to: Operand, function: u16, args: Args },
    /// Jump. Backward jumps count as steps.
    Jump { target: u32 },
    /// Jump when the value is true.
    JumpIf { a: Operand, target: u32 },
    /// Jump when the value is not true.
    JumpUnless { a: Operand, target: u32 },
    /// Jump unless `a < b` and the like, fused with the comparison.
    JumpUnlessCompare { op: Binary, a: Operand, b: Operand, target: u32 },
    /// Check that a value can be iterated over, and its length as an integer.
    Length { to: Operand, a: Operand },
    /// If `index < length`, put the element there into `to` and add one to `index`; else jump.
    Next { to: Operand, over: Operand, index: Operand, length: Operand, target: u32 },
    /// A fault unless the variable has been assigned.
    CheckSet { a: Operand, name: u16 },
    /// A fault with the message in `message` unless `a` is true.
    Assert { a: Operand, message: Operand },
    /// Carry out the numbered site, which may suspend.
    Site { site: SiteId },
    /// The sites numbered `from..to` are not on the path taken: what they hold is removed.
    Clear { from: u16, to: u16 },
    /// Return from the function.
    Return { a: Operand },
    /// Return from an iteration: how it ended, carried values (and the returned value).
    ReturnIteration { exit: i8, args: Args },
    /// In a slice: a repeated call of which only that argument may have changed.
    Pass { site: SiteId, arg: u16 },
    /// The end of a slice: what the activation returns has not changed.
    Done,
}

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
    /// Its result is an angle, as [`Visible::is_angle`] is.
    pub is_angle: bool,
    /// Of a choice: its part of [`Function::scope`], first and end.
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

/// How activations of a function are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// It can reach no effect: no node, registers on the machine's scratch stack.
    Pure,
    /// It can suspend: a node.
    Node,
    /// A lifted loop: a node without code that holds what the loop iterates over and what its iterations capture.
    Loop,
    /// One iteration of a lifted loop: a node whose parent is the loop's node.
    Iteration,
}

/// A compiled function.
#[derive(Clone, Debug)]
pub struct Function<S: Scalar = f64> {
    /// Qualified name.
    pub name: Name,
    /// Number of the source file.
    pub file: u32,
    /// Where it is defined.
    pub span: Span,
    /// How its activations are stored.
    pub mode: Mode,
    /// Number of parameters.
    pub params: u16,
    /// Values of the last parameters when left out: constants, or (`Node`/`Scratch` index) a captured register.
    pub defaults: Vec<Operand>,
    /// Captured values, placed in the registers after the parameters.
    pub captures: u16,
    /// Registers of a node (of a loop node for an iteration's captures: see [`Loop`]).
    pub node_registers: u16,
    /// Scratch registers.
    pub scratch_registers: u16,
    /// The instructions; from `body` on, slices of those before.
    pub code: Vec<Op>,
    /// How many instructions there are without slices.
    pub body: u32,
    /// Where an activation is entered of which one parameter (or capture, after the parameters) has changed.
    pub inputs: Vec<u32>,
    /// Where an iteration is entered when one register of the loop node above has changed, by its number.
    pub outers: Vec<u32>,
    /// Where each instruction comes from.
    pub spans: Vec<Span>,
    /// Operand lists.
    pub operands: Vec<Operand>,
    /// Constants.
    pub constants: Vec<Value<S>>,
    /// Names of fields, methods and variables used by instructions.
    pub names: Vec<Name>,
    /// Suspension sites in program order.
    pub sites: Vec<Site>,
    /// Readable names of the parameters.
    pub parameters: Vec<Name>,
    /// Where machine code may begin.
    pub(crate) native: Entries,
    /// Variables that can be read at choices, where the program was compiled to keep some: site by site, each site's
    /// in the order in which they were last assigned.
    pub scope: Vec<Visible>,
}

impl<S: Scalar> Function<S> {
    /// The registers and constants that an instruction reads.
    pub fn reads(&self, op: &Op) -> Vec<Operand> {
        crate::passes::place::reads_and_writes(self, op).0
    }

    /// The variables with names that can be read at a site, in the order in which they were last assigned.
    pub fn visible(&self, site: &Site) -> impl Iterator<Item = &Visible> {
        let (from, to) = site.visible;
        self.scope[from as usize..to as usize].iter().filter(|x| !x.name.is_empty())
    }
}

/// A variable that can be read at a choice.
#[derive(Clone, Debug)]
pub struct Visible {
    /// The choice.
    pub site: SiteId,
    /// The variable's name in the model's source; empty for where the program looks from.
    pub name: Name,
    /// Where its value is: never in scratch.
    pub at: Operand,
    /// Its value flows into an angle, or comes from one.
    pub is_angle: bool,
}

/// A compiled program.
#[derive(Clone, Debug)]
pub struct Program<S: Scalar = f64> {
    /// Source files.
    pub files: Vec<String>,
    /// Record classes.
    pub classes: Vec<std::sync::Arc<Class>>,
    /// Functions by number.
    pub functions: Vec<Function<S>>,
    /// Where a run starts.
    pub entry: FunctionId,
    /// Of a copy for a thread: the constants of all copies. A particle may hold those of the thread that ran it before.
    pub(crate) others: Vec<Value<S>>,
}

impl<S: Scalar> Program<S> {
    /// Its constants, which are not counted as what a run holds.
    pub fn leave_out(&self, census: &mut Census<'_, S>) {
        let constants = self.functions.iter().flat_map(|f| &f.constants);
        constants.chain(&self.others).for_each(|value| census.leave_out(value));
    }

    /// Whether it has memoised functions: calls that several activations share.
    pub fn memoises(&self) -> bool {
        let mut sites = self.functions.iter().flat_map(|f| &f.sites);
        sites.any(|site| matches!(site.kind, SiteKind::Memoise { .. }))
    }

    /// The program with machine code after so many visits of a place, and none for zero: for tests and measurements, which
    /// want it at once or not at all.
    #[must_use]
    pub fn with_machine_code_after(mut self, visits: u32) -> Self {
        self.functions.iter_mut().for_each(|f| f.native = Entries::after(f, visits));
        self
    }

    /// Bytes of the machine code that there is by now.
    pub fn machine_code(&self) -> usize {
        self.functions.iter().map(|f| f.native.bytes()).sum()
    }

    /// A function by its number.
    #[inline]
    pub fn function(&self, id: FunctionId) -> &Function<S> {
        &self.functions[id.0 as usize]
    }
}

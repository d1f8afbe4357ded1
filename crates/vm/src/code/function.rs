//! Compiled functions and programs.

use super::entries::Entries;
use super::op::Op;
use super::operand::{FunctionId, Operand, SiteId};
use super::site::{Site, SiteKind};
use crate::core::{Name, Span};
use crate::value::{Census, Class, Value};
use niwaki_math::Scalar;

/// The ways to store the activations of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// The function can reach no effect: it has no node, and its registers are on the machine's scratch stack.
    Pure,
    /// The function can suspend: its activation is a node.
    Node,
    /// A lifted loop: a node without code that holds the sequence to iterate over and the captures of the
    /// iterations.
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
    /// The place of its definition.
    pub span: Span,
    /// The way in which its activations are stored.
    pub mode: Mode,
    /// Number of parameters.
    pub params: u16,
    /// Values of the last parameters when a caller omits them: constants, or captured registers.
    pub defaults: Vec<Operand>,
    /// Captured values, placed in the registers after the parameters.
    pub captures: u16,
    /// Number of registers of a node.
    pub node_registers: u16,
    /// Number of scratch registers.
    pub scratch_registers: u16,
    /// The instructions; from index `body` on, slices of the instructions before.
    pub code: Vec<Op>,
    /// Number of instructions without slices.
    pub body: u32,
    /// The instruction where an activation is entered when one of its parameters (or captures, which follow the
    /// parameters) has changed.
    pub inputs: Vec<u32>,
    /// The instruction where an iteration is entered when one register of the loop node above has changed, by
    /// the register's number.
    pub outers: Vec<u32>,
    /// The place in the source of each instruction.
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
    /// The places where machine code may begin.
    pub(crate) native: Entries,
    /// Variables that can be read at choices, if the program was compiled to keep some: site by site, and for
    /// each site in the order in which they were last assigned.
    pub scope: Vec<Visible>,
}

impl<S: Scalar> Function<S> {
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
    /// The variable's name in the model's source; empty for the place that the program looks from.
    pub name: Name,
    /// The register or constant with the value: never a scratch register.
    pub at: Operand,
    /// Whether the value flows into an angle, or comes from an angle.
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
    /// The function where a run starts.
    pub entry: FunctionId,
    /// Whether the program places calls: then the last capture of each effectful function is the frame of what it emits, and
    /// the last argument of a call of a function value is that frame.
    pub frames: bool,
    /// In a copy for a thread: the constants of all copies. A particle may hold constants of the copy that ran
    /// it before.
    pub(crate) constants_of_copies: Vec<Value<S>>,
}

impl<S: Scalar> Program<S> {
    /// Excludes the program's constants from a census: they do not count as memory of a run.
    pub fn leave_out(&self, census: &mut Census<'_, S>) {
        let constants = self.functions.iter().flat_map(|f| &f.constants);
        constants.chain(&self.constants_of_copies).for_each(|value| census.leave_out(value));
    }

    /// Whether the program has memoised functions: calls that several activations share.
    pub fn memoises(&self) -> bool {
        let mut sites = self.functions.iter().flat_map(|f| &f.sites);
        sites.any(|site| matches!(site.kind, SiteKind::Memoise { .. }))
    }

    /// Bytes of the machine code that was written so far.
    pub fn machine_code(&self) -> usize {
        self.functions.iter().map(|f| f.native.bytes()).sum()
    }

    /// A function by its number.
    #[inline]
    pub fn function(&self, id: FunctionId) -> &Function<S> {
        &self.functions[id.0 as usize]
    }
}

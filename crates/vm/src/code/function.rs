//! Compiled functions and programs.

use super::entries::Entries;
use super::op::Op;
use super::operand::{FunctionId, Operand, SiteId};
use super::site::{Site, SiteKind};
use crate::core::{Name, Span};
use crate::value::{Census, Class, Value};
use niwaki_math::Scalar;

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
    /// Registers of a node (of a loop node for an iteration's captures: see [`Loop`](super::Loop)).
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

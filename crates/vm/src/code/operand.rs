//! Operands, and the numbers of functions and sites.

/// The place where an instruction reads or writes a value.
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
    /// The largest index that an operand can hold.
    pub const MAX_INDEX: usize = (1 << 14) - 1;

    /// Packs a class and an index into an operand.
    pub fn new(place: Place, index: usize) -> Self {
        debug_assert!(index <= Self::MAX_INDEX);
        Operand(((place as u16) << 14) | index as u16)
    }

    /// The class of the operand.
    #[inline]
    pub fn place(self) -> Place {
        match self.0 >> 14 {
            0 => Place::Node,
            1 => Place::Outer,
            2 => Place::Scratch,
            _ => Place::Constant,
        }
    }

    /// Whether the operand is a register of the activation.
    #[inline(always)]
    pub fn is_node(self) -> bool {
        self.0 < 1 << 14
    }

    /// Whether an operand outside of the node is a register of the enclosing loop node.
    #[inline(always)]
    pub fn is_outer(self) -> bool {
        self.0 < 2 << 14
    }

    /// Whether an operand outside of all nodes is a constant.
    #[inline(always)]
    pub fn is_constant(self) -> bool {
        self.0 >= 3 << 14
    }

    /// The index of the operand within its class.
    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 & 0x3FFF) as usize
    }

    /// Whether an instruction may write to the operand.
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

/// A sequence of operands in the function's operand list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Args {
    /// The first place in [`Function::operands`](super::Function::operands).
    pub start: u32,
    /// The number of operands.
    pub len: u16,
}

impl Args {
    /// The empty sequence.
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

//! Bytecode: the parts of a compiled program. Numbers in newtypes, layouts in one place.
//!
//! * `operand`, `op`, `site`, `function`: operands, instructions, suspension sites, functions and programs;
//! * `flow`: the registers that instructions read and write, and which registers are live; `verify`: the check
//!   of a program; `disassemble`: its text; `convert`: the program over another scalar;
//! * `entries`, `routine`, `register`: the places where machine code may begin, the code itself, and the registers
//!   that it reads;
//! * `observed`: whether observations mix probabilities and densities.
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
pub(crate) mod entries;
pub(crate) mod flow;
mod function;
pub mod observed;
mod op;
mod operand;
pub(crate) mod register;
pub(crate) mod routine;
mod site;
mod verify;

pub use disassemble::disassemble;
pub use function::{Function, Mode, Program, Visible};
pub use op::{Binary, Op, exit};
pub use operand::{Args, FunctionId, Operand, Place, SiteId};
pub use site::{Loop, Site, SiteKind, Source};
pub use verify::{VerifyError, verify};

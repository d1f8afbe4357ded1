//! What the code of a function needs to know of it: which registers are live where, and where jumps lead.

use crate::code::{Function, Op, Operand, Place};
use crate::passes::place::{Bits, live_before, successors};
use niwaki_math::Scalar;

/// The flow of one function.
pub(super) struct Flow {
    node: Vec<Bits>,
    scratch: Vec<Bits>,
    /// Instructions that some jump leads to.
    is_target: Vec<bool>,
}

impl Flow {
    pub(super) fn of(f: &Function) -> Flow {
        let mut is_target = vec![false; f.code.len() + 1];
        for (at, op) in f.code.iter().enumerate() {
            let (next, jump) = successors(op, at);
            for target in [next, jump].into_iter().flatten().filter(|to| *to != at + 1) {
                is_target[target] = true;
            }
        }
        Flow {
            node: live_before(f, Place::Node, f.node_registers as usize),
            scratch: live_before(f, Place::Scratch, f.scratch_registers as usize),
            is_target,
        }
    }

    /// Whether an operand is read at an instruction or after it, before it is written.
    pub(super) fn is_live(&self, at: usize, o: Operand) -> bool {
        match o.place() {
            Place::Node => self.node[at].has(o),
            Place::Scratch => self.scratch[at].has(o),
            Place::Outer | Place::Constant => true,
        }
    }

    /// Whether some jump leads to an instruction.
    pub(super) fn is_target(&self, at: usize) -> bool {
        self.is_target[at]
    }
}

/// Instructions where machine code may begin: where a pure function does, and where a loop goes back to.
pub(super) fn entries<S: Scalar>(f: &Function<S>) -> Vec<u32> {
    let back = f.code.iter().enumerate().filter_map(|(at, op)| match *op {
        Op::Jump { target }
        | Op::JumpIf { target, .. }
        | Op::JumpUnless { target, .. }
        | Op::JumpUnlessCompare { target, .. }
            if target as usize <= at =>
        {
            Some(target)
        }
        _ => None,
    });
    let first = (f.mode == crate::code::Mode::Pure).then_some(0);
    let mut all: Vec<u32> = back.chain(first).collect();
    all.sort_unstable();
    all.dedup();
    all
}

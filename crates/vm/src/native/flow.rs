//! The flow of a function whose code is written: the registers that are live at each place, and the targets of
//! jumps.

use super::choose::may_choose;
use super::functions::has_machine_code;
use crate::builtins::builtin;
use crate::code::entries::Place as At;
use crate::code::flow::{Bits, live_before, reads_and_writes, successors};
use crate::code::register::Reg;
use crate::code::{Function, Mode, Op, Operand, Place};
use niwaki_math::Scalar;
use std::collections::BTreeSet;

/// The fewest instructions that a straight piece must have to be worth machine code.
const MIN_STRAIGHT: usize = 5;

/// The flow of one function.
pub(super) struct Flow {
    node: Vec<Bits>,
    scratch: Vec<Bits>,
    /// Whether a jump leads to each instruction.
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

    /// Whether a jump leads to an instruction.
    pub(super) fn is_target(&self, at: usize) -> bool {
        self.is_target[at]
    }
}

/// The registers that code of a function may use: all registers of the function, and those that it reads from
/// the loop node above.
pub(super) fn registers(f: &Function) -> Vec<Reg> {
    let node = (0..f.node_registers).map(Reg::Node);
    let scratch = (0..f.scratch_registers).map(|i| Reg::Scratch(i.into()));
    let read = f.code.iter().flat_map(|op| reads_and_writes(f, op).0);
    let outer: BTreeSet<usize> = read.filter(|o| o.place() == Place::Outer).map(Operand::index).collect();
    node.chain(scratch).chain(outer.into_iter().map(|i| Reg::Outer(i as u16))).collect()
}

/// The instructions where machine code may begin: the start of a pure function, the targets of backward jumps,
/// and the places where a function that can suspend begins or continues after a site. A place after a site must
/// have enough instructions before the next site.
pub(super) fn entries<S: Scalar>(f: &Function<S>) -> Vec<At> {
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
    let first = (f.mode == Mode::Pure).then_some(0);
    let always = back.chain(first).map(|pc| At { pc, for_choices: false });
    let after = f.code.iter().enumerate().filter(|(_, op)| matches!(op, Op::Site { .. }));
    let after = after.map(|(at, _)| at + 1).chain((f.mode != Mode::Pure).then_some(0));
    let lines = after.filter_map(|at| {
        let for_choices = straight_length(f, at, false) < MIN_STRAIGHT;
        let is_worth = !for_choices || straight_length(f, at, true) >= MIN_STRAIGHT;
        is_worth.then_some(At { pc: at as u32, for_choices })
    });
    let mut all: Vec<At> = always.chain(lines).collect();
    all.sort_unstable();
    all.dedup_by_key(|place| place.pc);
    all.truncate(usize::from(u16::MAX));
    all
}

/// The number of instructions from `from` on that have machine code, without moves. A choice, if choices have code, is
/// worth as many as a straight piece must have.
fn straight_length<S: Scalar>(f: &Function<S>, from: usize, with_choices: bool) -> usize {
    let length_of = |op: &Op| match op {
        Op::Move { .. } | Op::CheckSet { .. } | Op::Jump { .. } => Some(0),
        Op::Add { .. } | Op::Sub { .. } | Op::Mul { .. } | Op::Div { .. } | Op::Binary { .. } => Some(1),
        Op::Neg { .. } | Op::Not { .. } | Op::Field { .. } | Op::Tuple { .. } | Op::Unpack { .. } => Some(1),
        Op::JumpIf { .. } | Op::JumpUnless { .. } | Op::JumpUnlessCompare { .. } => Some(1),
        Op::Length { .. } | Op::Next { .. } | Op::CallPure { .. } => Some(1),
        Op::Builtin { id, .. } => has_machine_code(builtin::<S>(*id).name).then_some(1),
        Op::Clear { .. } => with_choices.then_some(0),
        Op::Site { site } => {
            (with_choices && may_choose(&f.sites[usize::from(site.0)])).then_some(MIN_STRAIGHT)
        }
        _ => None,
    };
    f.code.iter().skip(from).map_while(length_of).sum()
}

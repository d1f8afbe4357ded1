//! The border between the interpreter and machine code: the tests and loads where code begins, and the stores
//! where it leaves.
//!
//! The code works on the registers where they are. A register is two words: a tag, and a number or an address.
//! Where the code begins, it tests the tags of its inputs and loads their numbers. Registers that it overwrites
//! without reading them hold no shared data then. Between its ends the code writes no register. So it stores
//! a tag at an exit only if the register held another kind where the code began.

use super::calls;
use super::typed::Typed;
use super::vectors::{DATA, LENGTH};
use super::write::{Cursor, PLAIN, PendingExit, Writer};
use crate::code::register::{Kind, PLAIN_TAGS, Reg};
use crate::code::routine::{Exchange, Exit, NOT_ENTERED, Then};
use crate::value::Range;
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{Block, InstBuilder, StackSlotData, StackSlotKind, Value};
use niwaki_native::frontend::Variable;
use std::collections::HashMap;
use std::mem::offset_of;

/// The bytes of a register, and the place of its number or address.
const REGISTER: i32 = 16;
const NUMBER: i32 = 8;

/// Numbers of [`Exchange`] that are variables of the code.
const STEPS: i32 = offset_of!(Exchange, steps) as i32;
const BYTES: i32 = offset_of!(Exchange, bytes) as i32;
const INSTRUCTIONS: i32 = offset_of!(Exchange, instructions) as i32;

impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    /// The base of a register, and its offset from there.
    fn place(&self, reg: Reg) -> (Value, i32) {
        match reg {
            Reg::Node(i) => (self.node, REGISTER * i32::from(i)),
            Reg::Outer(i) => (self.outer, REGISTER * i32::from(i)),
            Reg::Scratch(i) => (self.scratch, REGISTER * i.cast_signed()),
        }
    }

    fn address(&mut self, reg: Reg) -> Value {
        let (base, offset) = self.place(reg);
        self.b.ins().iadd_imm_s(base, i64::from(offset))
    }

    fn load(&mut self, reg: Reg, at: i32) -> Value {
        let (base, offset) = self.place(reg);
        self.b.ins().load(I64, PLAIN, base, offset + at)
    }

    /// Writes the block that tests and loads the inputs, and jumps to the first piece. `overwritten` are the
    /// registers that the code may write, and that are no inputs.
    pub(super) fn write_guards(&mut self, inputs: &[(Reg, Kind)], overwritten: &[Reg]) {
        let refused = self.b.create_block();
        self.b.set_cold_block(refused);
        self.b.switch_to_block(self.guards);
        self.guard(inputs, refused);
        self.refuse_shared(overwritten, refused);
        for (variable, at) in [(self.steps, STEPS), (self.bytes, BYTES)] {
            // A choice takes bytes also of code that charges nothing.
            let left = if self.counts { self.load_exchange(at) } else { self.int(0) };
            self.b.def_var(variable, left);
        }
        self.b.ins().jump(self.begin, &[]);
        self.b.switch_to_block(refused);
        let answer = self.int(NOT_ENTERED);
        self.b.ins().return_(&[answer]);
    }

    /// A number of the exchange.
    pub(super) fn load_exchange(&mut self, at: i32) -> Value {
        self.b.ins().load(I64, PLAIN, self.exchange, at)
    }

    /// The numbers of the exchange that the code changes.
    fn counters(&self) -> impl Iterator<Item = (Variable, i32)> + use<> {
        let all = [(self.steps, STEPS), (self.bytes, BYTES)];
        all.into_iter().take(if self.counts { 2 } else { 0 })
    }

    /// Continues elsewhere if a number is not zero.
    fn leave_for(&mut self, other: Block, number: Value) {
        let on = self.b.create_block();
        self.b.ins().brif(number, other, &[], on, &[]);
        self.b.switch_to_block(on);
    }

    /// Tests the kinds of the inputs, and loads their values.
    fn guard(&mut self, inputs: &[(Reg, Kind)], refused: Block) {
        let mut wrong = self.int(0);
        for (reg, kind) in inputs {
            let (tag, tags) = (self.load(*reg, 0), kind.tags());
            let differs = if tags.is_power_of_two() {
                self.b.ins().bxor_imm_u(tag, i64::from(tags.trailing_zeros()))
            } else {
                let wrong_tags = self.int((!tags).cast_signed());
                let bits = self.b.ins().ushr(wrong_tags, tag);
                self.b.ins().band_imm_u(bits, 1)
            };
            wrong = self.b.ins().bor(wrong, differs);
        }
        self.leave_for(refused, wrong);
        wrong = self.int(0);
        for (reg, kind) in inputs {
            if let Kind::Object(form) = kind
                && let Some(components) = form.components()
            {
                let body = self.load(*reg, NUMBER);
                let n = self.b.ins().uload8(I64, PLAIN, body, *DATA + LENGTH);
                let differs = self.b.ins().bxor_imm_u(n, i64::from(components));
                wrong = self.b.ins().bor(wrong, differs);
            }
            let typed = self.loaded(*reg, *kind);
            self.define(*reg, typed);
        }
        self.leave_for(refused, wrong);
    }

    /// The value of an input.
    fn loaded(&mut self, reg: Reg, kind: Kind) -> Typed {
        let (base, offset) = self.place(reg);
        match kind {
            Kind::None => Typed::None,
            Kind::Unset => Typed::Unset,
            Kind::Opaque | Kind::Fresh { .. } => Typed::Opaque,
            Kind::Bool => Typed::Bool(self.b.ins().uload8(I64, PLAIN, base, offset + NUMBER)),
            Kind::Int => Typed::Int(self.load(reg, NUMBER)),
            Kind::Real => Typed::Real(self.b.ins().load(F64, PLAIN, base, offset + NUMBER)),
            Kind::Range => {
                let body = self.load(reg, NUMBER);
                let [first, step] = [offset_of!(Range, start), offset_of!(Range, step)]
                    .map(|at| self.b.ins().load(I64, PLAIN, body, *DATA + at as i32));
                Typed::Range { object: self.address(reg), first, step }
            }
            Kind::Object(form) => Typed::Object(self.address(reg), form),
        }
    }

    /// Refuses if an overwritten register counts as memory of the run: a write would drop its data. Registers of
    /// the machine may hold small values, which nobody reads again: these are dropped now.
    fn refuse_shared(&mut self, overwritten: &[Reg], refused: Block) {
        let drop = self.b.create_block();
        let is_scratch = |reg: &&Reg| matches!(reg, Reg::Scratch(_));
        let (scratch, nodes): (Vec<&Reg>, Vec<&Reg>) = overwritten.iter().partition(is_scratch);
        for (registers, other) in [(&nodes, refused), (&scratch, drop)] {
            if registers.is_empty() {
                continue;
            }
            let mut all = self.int(0);
            for reg in registers {
                // One more than the tag of a plain value has three bits.
                let tag = self.load(**reg, 0);
                let more = self.b.ins().iadd_imm_s(tag, 1);
                all = self.b.ins().bor(all, more);
            }
            let shared = self.b.ins().band_imm_s(all, !PLAIN_TAGS);
            self.leave_for(other, shared);
        }
        if scratch.is_empty() {
            return;
        }
        let on = self.b.create_block();
        self.b.ins().jump(on, &[]);
        self.b.set_cold_block(drop);
        self.b.switch_to_block(drop);
        let registers = self.keep(scratch.iter().map(|reg| (**reg, Kind::None)).collect());
        let args = [&registers[..], &[self.scratch]].concat();
        let are_free = self.call_address(calls::drop_small as *const u8, &args, I64);
        self.b.ins().brif(are_free, on, &[], refused, &[]);
        self.b.switch_to_block(on);
    }

    /// The address and the length of a list of registers, which exists as long as the code.
    fn keep(&mut self, registers: Box<[(Reg, Kind)]>) -> [Value; 2] {
        let [at, n] = [registers.as_ptr() as i64, registers.len() as i64];
        self.lists.push(registers);
        [self.int(at), self.int(n)]
    }

    /// Writes the code of all exits.
    pub(super) fn write_exits(&mut self) -> Vec<Exit> {
        let pending = std::mem::take(&mut self.pending_exits);
        pending.into_iter().enumerate().map(|(number, exit)| self.write_exit(number, exit)).collect()
    }

    fn write_exit(&mut self, number: usize, pending: PendingExit) -> Exit {
        let PendingExit { block, mut exit, mut registers, instructions } = pending;
        self.b.switch_to_block(block);
        registers.retain(|(reg, _)| self.written.contains(reg));
        exit.has_shared = self.store_shared(&registers);
        let mut tags = HashMap::new();
        for (reg, kind) in registers.iter().filter(|(_, kind)| kind.is_plain()) {
            let (base, offset) = self.place(*reg);
            if self.inputs.get(reg) != Some(kind) {
                let mark = kind.mark().cast_signed();
                let tag = *tags.entry(mark).or_insert_with(|| self.b.ins().iconst(I64, mark));
                self.b.ins().store(PLAIN, tag, base, offset);
            }
            if let Typed::Bool(x) | Typed::Int(x) | Typed::Real(x) = self.typed(*reg, *kind) {
                self.b.ins().store(PLAIN, x, base, offset + NUMBER);
            }
        }
        let before = self.b.use_var(self.instructions);
        let instructions = self.b.ins().iadd_imm_s(before, instructions);
        self.b.ins().store(PLAIN, instructions, self.exchange, INSTRUCTIONS);
        for (variable, at) in self.counters() {
            let left = self.b.use_var(variable);
            self.b.ins().store(PLAIN, left, self.exchange, at);
        }
        let number = self.int(number as i64);
        self.b.ins().return_(&[number]);
        exit
    }

    /// Stores shared values, and drops those in registers that get a plain value. Returns whether a register of
    /// the machine has got a shared value.
    fn store_shared(&mut self, registers: &[(Reg, Kind)]) -> bool {
        let was_plain = |reg: &Reg| self.inputs.get(reg).is_none_or(|kind| kind.is_plain());
        let shared = registers.iter().filter(|(reg, kind)| !kind.is_plain() || !was_plain(reg));
        let shared: Box<[(Reg, Kind)]> = shared.copied().collect();
        if shared.is_empty() {
            return false;
        }
        let mut words = vec![];
        for (reg, kind) in &shared {
            let before = words.len();
            match self.typed(*reg, *kind) {
                Typed::Fresh { parts, .. } => words.extend(parts.iter().flatten().map(|part| part.value())),
                Typed::Object(object, _) | Typed::Range { object, .. } => words.push(object),
                _ => {}
            }
            // What fills the room up is never read.
            words.resize(before + calls::words(*kind), self.exchange);
        }
        let slot = StackSlotData::new(StackSlotKind::ExplicitSlot, 8 * words.len() as u32, 3);
        let slot = self.b.create_sized_stack_slot(slot);
        for (k, word) in words.into_iter().enumerate() {
            self.b.ins().stack_store(I64, word, slot, 8 * k as i32);
        }
        let has_shared = shared.iter().any(|(reg, kind)| matches!(reg, Reg::Scratch(_)) && !kind.is_plain());
        let list = self.keep(shared);
        let words = self.b.ins().stack_addr(I64, slot, 0);
        let args = [&list[..], &[words, self.node, self.scratch]].concat();
        self.call_outside(calls::store_shared as *const u8, &args, None);
        has_shared
    }

    /// An exit before an instruction. An instruction that may leave for several reasons has one.
    pub(super) fn exit(&mut self, cursor: &Cursor<'v>, pc: usize) -> Block {
        if let Some((_, block)) = self.exit_here.filter(|(at, _)| *at == pc) {
            return block;
        }
        let block = self.b.create_block();
        self.b.set_cold_block(block);
        self.exit_here = Some((pc, block));
        let mut cursor = cursor.clone();
        self.forget_dead(&mut cursor, pc);
        // A register that is only read keeps its content.
        let registers = cursor.kinds.into_iter();
        let registers =
            registers.filter(|(reg, kind)| !matches!(reg, Reg::Outer(_)) && *kind != Kind::Opaque);
        let exit = Exit {
            calls: cursor.calls,
            function: cursor.function,
            base: cursor.base,
            pc: pc as u32,
            has_shared: false,
            then: Then::Continues,
        };
        let (registers, instructions) = (registers.collect(), cursor.instructions);
        self.pending_exits.push(PendingExit { block, exit, registers, instructions });
        block
    }
}

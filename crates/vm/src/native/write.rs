//! Machine code from bytecode: a piece of code for each instruction and each combination of kinds.
//!
//! The registers of the model are variables of Cranelift's builder, which turns them into values of the
//! processor. A piece begins at a jump's target. Its *key* is that place, the calls of pure functions in
//! progress, and the kinds of the live registers. A jump leads to the piece with the current key, which is
//! written if it does not exist yet. So a variable that is a whole number in the first round of a loop and a
//! real number in the others has a piece for each kind. No instruction tests a kind that is known.

use super::flow::{Flow, registers};
use super::typed::{Number, Typed};
use crate::code::register::{FreshForm, Kind, Reg, is_counted};
use crate::code::routine::words;
use crate::code::routine::{Call, Exit, Input};
use crate::code::{Function, FunctionId, Operand, Place, Program};
use crate::value::{Range, Value as Model};
use niwaki_native::CompileResult;
use niwaki_native::codegen::ir::condcodes::IntCC;
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{
    Block, InstBuilder, MemFlagsData, StackSlot, StackSlotData, StackSlotKind, Value,
};
use niwaki_native::codegen::isa::CallConv;
use niwaki_native::frontend::{FunctionBuilder, Variable};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

/// The contents of the registers of a function where code begins.
pub(super) type Contents<'a, 'v> = &'a dyn Fn(Reg) -> Option<&'v Model>;

/// The most pieces of a routine; the interpreter runs the rest.
const MAX_PIECES: usize = 160;

/// The most registers that a routine exchanges with the machine.
const MAX_REGISTERS: usize = 200;

/// The number of values in the array for arguments of called functions.
pub(super) const ARGUMENTS: u32 = 8;

/// Flags of valid, aligned memory.
pub(super) const PLAIN: MemFlagsData = MemFlagsData::trusted();

/// The identity of a piece of code.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Key {
    calls: Vec<Call>,
    function: FunctionId,
    base: u32,
    pc: u32,
    kinds: Vec<(Reg, Kind)>,
}

/// The place of the writer in a piece, and what is known there.
#[derive(Clone)]
pub(super) struct Cursor<'v> {
    pub calls: Vec<Call>,
    pub function: FunctionId,
    pub base: u32,
    pub(super) kinds: BTreeMap<Reg, Kind>,
    pub(super) samples: HashMap<Reg, &'v Model>,
    /// The number of instructions since the last count.
    instructions: i64,
    /// The number of vectors, tuples and ranges that the code has made so far.
    fresh_count: u16,
}

/// The progress of the writing after an instruction.
pub(super) enum Progress {
    /// The next instruction follows.
    Next,
    /// The piece has ended.
    Ended,
    /// There is no code for this instruction.
    Leave,
}

/// An exit whose code is not written yet.
struct PendingExit {
    block: Block,
    exit: Exit,
    values: Vec<(Reg, Kind, Vec<Value>)>,
    instructions: i64,
}

/// A routine during its writing.
pub(super) struct Writer<'p, 'v, 'b> {
    pub program: &'p Program,
    pub b: FunctionBuilder<'b>,
    pub(super) convention: CallConv,
    flows: HashMap<FunctionId, Flow>,
    pieces: HashMap<Key, Block>,
    pending_pieces: Vec<(Block, usize, Cursor<'v>)>,
    pending_exits: Vec<PendingExit>,
    pub(super) variables: HashMap<(Reg, u8), Variable>,
    /// Registers that held shared data where the code begins.
    shared_at_start: BTreeSet<Reg>,
    pub(super) constants: Vec<(FunctionId, u16)>,
    pub(super) written: BTreeSet<Reg>,
    /// Registers that an instruction reads.
    pub(super) read: BTreeSet<Reg>,
    pub(super) names: Vec<Box<str>>,
    /// Whether the code divides whole numbers.
    pub(super) divides: bool,
    pub(super) words: usize,
    exchange: Value,
    pub(super) answer: StackSlot,
    pub(super) arguments: StackSlot,
    steps: Variable,
    bytes: Variable,
    instructions: Variable,
}

fn offset(word: usize) -> i32 {
    i32::try_from(8 * word).expect("there are few words")
}

impl<'p: 'v, 'v, 'b> Writer<'p, 'v, 'b> {
    pub(super) fn new(program: &'p Program, mut b: FunctionBuilder<'b>, convention: CallConv) -> Self {
        let slot = |words: u32| StackSlotData::new(StackSlotKind::ExplicitSlot, 8 * words, 3);
        let (answer, arguments) =
            (b.create_sized_stack_slot(slot(1)), b.create_sized_stack_slot(slot(2 * ARGUMENTS)));
        let [steps, bytes, instructions] = [(); 3].map(|()| b.declare_var(I64));
        Writer {
            program,
            b,
            convention,
            flows: HashMap::new(),
            pieces: HashMap::new(),
            pending_pieces: vec![],
            pending_exits: vec![],
            variables: HashMap::new(),
            shared_at_start: BTreeSet::new(),
            constants: vec![],
            written: BTreeSet::new(),
            read: BTreeSet::new(),
            names: vec![],
            divides: false,
            words: 0,
            exchange: Value::from_u32(0),
            answer,
            arguments,
            steps,
            bytes,
            instructions,
        }
    }

    pub(super) fn f(&self, cursor: &Cursor<'_>) -> &'p Function {
        self.program.function(cursor.function)
    }

    pub(super) fn flow(&mut self, id: FunctionId) -> &Flow {
        self.flows.entry(id).or_insert_with(|| Flow::of(self.program.function(id)))
    }

    /// Writes the code that reads all inputs, and the jump to the first piece. Returns the inputs.
    pub(super) fn write_start(
        &mut self,
        id: FunctionId,
        pc: usize,
        contents: Contents<'_, 'v>,
    ) -> CompileResult<Vec<Input>> {
        let f = self.program.function(id);
        let block = self.b.create_block();
        self.b.switch_to_block(block);
        self.b.append_block_params_for_function_params(block);
        self.exchange = self.b.block_params(block)[0];
        let steps = self.word(words::STEPS);
        self.b.def_var(self.steps, steps);
        let bytes = self.word(words::BYTES);
        self.b.def_var(self.bytes, bytes);
        let zero = self.int(0);
        self.b.def_var(self.instructions, zero);

        // Registers with shared data are inputs even if they are dead: a write to such a register drops its
        // data.
        let flow = self.flow(id);
        let mut inputs = registers(f);
        inputs.retain(|reg| {
            let o = match *reg {
                Reg::Node(i) => Operand::new(Place::Node, i.into()),
                Reg::Scratch(i) => Operand::new(Place::Scratch, i as usize),
                Reg::Outer(_) => return true,
            };
            flow.is_live(pc, o) || contents(*reg).is_some_and(|value| is_counted(*reg, value))
        });

        let mut cursor = Cursor {
            calls: vec![],
            function: id,
            base: 0,
            kinds: BTreeMap::new(),
            samples: HashMap::new(),
            instructions: 0,
            fresh_count: 0,
        };
        let mut known = vec![];
        let mut at = words::REGISTERS;
        for reg in inputs {
            let Some(value) = contents(reg) else { return Err("a register does not exist".into()) };
            let kind = Kind::of(value);
            if !kind.is_plain() {
                if kind.is_counted(reg) {
                    self.shared_at_start.insert(reg);
                }
                cursor.samples.insert(reg, value);
            }
            let typed = match kind {
                Kind::None => Typed::None,
                Kind::Unset => Typed::Unset,
                Kind::Opaque => Typed::Opaque,
                Kind::Bool => Typed::Bool(self.word(at)),
                Kind::Int => Typed::Int(self.word(at)),
                Kind::Real => Typed::Real(self.b.ins().load(F64, PLAIN, self.exchange, offset(at))),
                Kind::Range => {
                    Typed::Range { object: self.word(at), first: self.word(at + 1), step: self.word(at + 2) }
                }
                Kind::Object(form) => Typed::Object(self.word(at), form),
                Kind::Fresh { .. } => return Err("only machine code makes such values".into()),
            };
            self.define(reg, typed);
            cursor.kinds.insert(reg, kind);
            known.push(Input { reg, kind, word: at });
            at += kind.words();
        }
        if known.len() > MAX_REGISTERS {
            return Err("too many registers".into());
        }
        self.words = at;
        self.enter_piece(&mut cursor, pc);
        Ok(known)
    }

    /// Writes all pieces that other pieces lead to.
    pub(super) fn write_pieces(&mut self) {
        while let Some((block, first, mut cursor)) = self.pending_pieces.pop() {
            self.b.switch_to_block(block);
            let mut pc = first;
            loop {
                if pc != first && self.flow(cursor.function).is_target(pc) {
                    self.enter_piece(&mut cursor, pc);
                    break;
                }
                match self.instruction(&mut cursor, pc) {
                    Progress::Next => {
                        cursor.instructions += 1;
                        pc += 1;
                    }
                    Progress::Ended => break,
                    Progress::Leave => {
                        let exit = self.exit(&cursor, pc);
                        self.b.ins().jump(exit, &[]);
                        break;
                    }
                }
            }
        }
    }

    /// Writes the code of all exits.
    pub(super) fn write_exits(&mut self) -> Vec<Exit> {
        let mut exits = vec![];
        for PendingExit { block, mut exit, values, instructions } in std::mem::take(&mut self.pending_exits) {
            self.b.switch_to_block(block);
            let mut at = words::REGISTERS;
            for (reg, kind, values) in values {
                if !self.written.contains(&reg) {
                    continue;
                }
                for value in values {
                    self.b.ins().store(PLAIN, value, self.exchange, offset(at));
                    at += 1;
                }
                exit.has_objects |= matches!(kind, Kind::Object(_) | Kind::Range);
                exit.registers.push((reg, kind));
            }
            self.words = self.words.max(at);
            let steps = self.b.use_var(self.steps);
            self.b.ins().store(PLAIN, steps, self.exchange, offset(words::STEPS));
            let bytes = self.b.use_var(self.bytes);
            self.b.ins().store(PLAIN, bytes, self.exchange, offset(words::BYTES));
            let before = self.b.use_var(self.instructions);
            let instructions = self.b.ins().iadd_imm_s(before, instructions);
            self.b.ins().store(PLAIN, instructions, self.exchange, offset(words::INSTRUCTIONS));
            let number = self.int(exits.len() as i64);
            self.b.ins().return_(&[number]);
            exits.push(exit);
        }
        exits
    }

    /// Jumps to the piece that begins at an instruction with the current kinds.
    pub(super) fn enter_piece(&mut self, cursor: &mut Cursor<'v>, pc: usize) {
        let before = self.b.use_var(self.instructions);
        let instructions = self.b.ins().iadd_imm_s(before, cursor.instructions);
        self.b.def_var(self.instructions, instructions);
        cursor.instructions = 0;
        self.forget_dead(cursor, pc);
        cursor.renumber();
        let key = Key {
            calls: cursor.calls.clone(),
            function: cursor.function,
            base: cursor.base,
            pc: pc as u32,
            kinds: cursor.kinds.iter().map(|(reg, kind)| (*reg, *kind)).collect(),
        };
        let block = match self.pieces.get(&key) {
            Some(block) => *block,
            None if self.pieces.len() >= MAX_PIECES => self.exit(cursor, pc),
            None => {
                let block = self.b.create_block();
                self.pieces.insert(key, block);
                self.pending_pieces.push((block, pc, cursor.clone()));
                block
            }
        };
        self.b.ins().jump(block, &[]);
    }

    /// Forgets registers that nobody reads again. A register stays if it holds shared data, or did so where the
    /// code began: this data counts while the register holds it.
    fn forget_dead(&mut self, cursor: &mut Cursor<'v>, pc: usize) {
        let mut places: Vec<(FunctionId, u32, usize)> =
            cursor.calls.iter().map(|call| (call.caller, call.base, call.back as usize)).collect();
        places.push((cursor.function, cursor.base, pc));
        let innermost_end = cursor.base + u32::from(self.f(cursor).scratch_registers);
        let mut dead = vec![];
        for (reg, kind) in &cursor.kinds {
            if kind.is_counted(*reg) || self.shared_at_start.contains(reg) {
                continue;
            }
            let (id, at, o) = match *reg {
                // A slice may read the registers of the activation.
                Reg::Outer(_) | Reg::Node(_) => continue,
                Reg::Scratch(i) if i >= innermost_end => {
                    dead.push(*reg);
                    continue;
                }
                Reg::Scratch(i) => {
                    let (id, base, at) =
                        *places.iter().rev().find(|(_, base, _)| *base <= i).expect("the first base is zero");
                    (id, at, Operand::new(Place::Scratch, (i - base) as usize))
                }
            };
            let flow = self.flows.entry(id).or_insert_with(|| Flow::of(self.program.function(id)));
            if !flow.is_live(at, o) {
                dead.push(*reg);
            }
        }
        for reg in dead {
            cursor.kinds.remove(&reg);
            cursor.samples.remove(&reg);
        }
    }

    /// An exit before an instruction.
    pub(super) fn exit(&mut self, cursor: &Cursor<'v>, pc: usize) -> Block {
        let block = self.b.create_block();
        self.b.set_cold_block(block);
        let mut values = vec![];
        let mut cursor = cursor.clone();
        self.forget_dead(&mut cursor, pc);
        for (reg, kind) in &cursor.kinds {
            // A register that is only read keeps its content.
            if !matches!(reg, Reg::Outer(_)) && *kind != Kind::Opaque {
                let parts = match self.typed(*reg, *kind) {
                    Typed::None | Typed::Unset | Typed::Opaque => vec![],
                    Typed::Bool(x) | Typed::Int(x) | Typed::Real(x) | Typed::Object(x, _) => vec![x],
                    Typed::Range { object, .. } => vec![object],
                    Typed::Fresh { parts, .. } => parts.iter().flatten().map(|part| part.value()).collect(),
                };
                values.push((*reg, *kind, parts));
            }
        }
        let exit = Exit {
            calls: cursor.calls.clone(),
            function: cursor.function,
            base: cursor.base,
            pc: pc as u32,
            registers: vec![],
            has_objects: false,
        };
        self.pending_exits.push(PendingExit { block, exit, values, instructions: cursor.instructions });
        block
    }

    /// Leaves before the instruction if a condition holds.
    pub(super) fn leave_if(&mut self, cursor: &Cursor<'v>, pc: usize, condition: Value) {
        let (exit, on) = (self.exit(cursor, pc), self.b.create_block());
        self.b.ins().brif(condition, exit, &[], on, &[]);
        self.b.switch_to_block(on);
    }

    /// Jumps; a jump backwards is a step.
    pub(super) fn jump(&mut self, cursor: &mut Cursor<'v>, pc: usize, target: usize) {
        if target <= pc {
            self.take_step(cursor, pc);
        }
        cursor.instructions += 1;
        self.enter_piece(cursor, target);
    }

    /// Takes a step, or leaves before the instruction if no step is left.
    pub(super) fn take_step(&mut self, cursor: &Cursor<'v>, pc: usize) {
        let left = self.b.use_var(self.steps);
        let none = self.b.ins().icmp_imm_s(IntCC::SignedLessThanOrEqual, left, 0);
        self.leave_if(cursor, pc, none);
        let left = self.b.ins().iadd_imm_s(left, -1);
        self.b.def_var(self.steps, left);
    }

    /// Charges the memory that an instruction needs, or leaves before the instruction. This is the last check
    /// of an instruction.
    pub(super) fn charge(&mut self, cursor: &Cursor<'v>, pc: usize, bytes: usize) {
        let left = self.b.use_var(self.bytes);
        let none = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, left, bytes as i64);
        self.leave_if(cursor, pc, none);
        let left = self.b.ins().iadd_imm_s(left, -(bytes as i64));
        self.b.def_var(self.bytes, left);
    }

    /// A vector, tuple or range of these numbers. It is charged, but has no object in memory so far.
    pub(super) fn make(
        &mut self,
        cursor: &mut Cursor<'v>,
        pc: usize,
        form: FreshForm,
        numbers: &[Number],
    ) -> Typed {
        let numbers_of = || numbers.iter().map(|_| Model::real(0.0)).collect();
        let like: Model = match form {
            FreshForm::Vector => Model::vector(&[0.0; 3]),
            FreshForm::Tuple => Model::tuple(numbers_of()),
            FreshForm::Range => Model::Range(Arc::new(Range { start: 0, stop: 0, step: 1, len: 0 })),
        };
        self.charge(cursor, pc, like.own_bytes());
        let mut parts = [None; 4];
        parts.iter_mut().zip(numbers).for_each(|(part, number)| *part = Some(*number));
        cursor.fresh_count += 1;
        Typed::Fresh { form, parts, number: cursor.fresh_count }
    }

    /// Reads a word that the machine stored.
    pub(super) fn word(&mut self, at: usize) -> Value {
        self.b.ins().load(I64, PLAIN, self.exchange, offset(at))
    }

    pub(super) fn int(&mut self, n: i64) -> Value {
        self.b.ins().iconst(I64, n)
    }
}

impl Cursor<'_> {
    /// Renumbers the fresh values from one on, in the order of the registers: pieces that would differ only in
    /// these numbers become equal.
    fn renumber(&mut self) {
        let mut numbers: Vec<u16> = vec![];
        for kind in self.kinds.values_mut() {
            if let Kind::Fresh { number, .. } = kind {
                let at = numbers.iter().position(|known| known == number).unwrap_or(numbers.len());
                if at == numbers.len() {
                    numbers.push(*number);
                }
                *number = at as u16 + 1;
            }
        }
        self.fresh_count = numbers.len() as u16;
    }

    /// Counts an instruction that the writer of a piece does not count itself.
    pub(super) fn count(&mut self) {
        self.instructions += 1;
    }

    /// The value of an operand that is a constant whole number.
    pub(super) fn constant_int(&self, f: &Function, o: Operand) -> Option<i64> {
        match f.constants.get(o.index()) {
            Some(Model::Int(n)) if o.is_constant() => Some(*n),
            _ => None,
        }
    }
}

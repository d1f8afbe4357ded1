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
use crate::code::routine::{Call, Exit};
use crate::code::{Function, FunctionId, Operand, Place, Program};
use crate::value::{Range, Value as Model};
use niwaki_native::CompileResult;
use niwaki_native::codegen::ir::condcodes::IntCC;
use niwaki_native::codegen::ir::types::I64;
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

/// The most registers that may be inputs of a routine.
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
    asks: bool,
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
    /// Whether only a run that may ask comes here.
    pub(super) asks: bool,
    /// The number of instructions since the last count.
    pub(super) instructions: i64,
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
pub(super) struct PendingExit {
    pub block: Block,
    pub exit: Exit,
    /// The kinds of the registers there.
    pub registers: Vec<(Reg, Kind)>,
    pub instructions: i64,
}

/// A routine during its writing.
pub(super) struct Writer<'p, 'v, 'b> {
    pub program: &'p Program,
    pub b: FunctionBuilder<'b>,
    pub(super) convention: CallConv,
    flows: HashMap<FunctionId, Flow>,
    pieces: HashMap<Key, Block>,
    pending_pieces: Vec<(Block, usize, Cursor<'v>)>,
    pub(super) pending_exits: Vec<PendingExit>,
    /// The exit before the current instruction, if there is one.
    pub(super) exit_here: Option<(usize, Block)>,
    pub(super) variables: HashMap<(Reg, u8), Variable>,
    /// The kinds of registers where the code begins.
    pub(super) inputs: BTreeMap<Reg, Kind>,
    /// Copies of constants that are not numbers, which exist as long as the code.
    pub(super) constants: HashMap<(FunctionId, u16), Box<Model>>,
    pub(super) written: BTreeSet<Reg>,
    /// Registers that an instruction reads.
    pub(super) read: BTreeSet<Reg>,
    pub(super) names: Vec<Box<str>>,
    /// Lists of registers for functions that the code calls.
    pub(super) lists: Vec<Box<[(Reg, Kind)]>>,
    /// Whether the code takes steps or charges memory.
    pub(super) counts: bool,
    /// Whether a run that may not ask writes registers of the activation.
    pub(super) writes_node: bool,
    /// Whether the code divides whole numbers.
    pub(super) divides: bool,
    /// The block that tests and loads the inputs, and the block after it.
    pub(super) guards: Block,
    pub(super) begin: Block,
    /// The parameters of the code: see [`Start`](crate::code::routine::Start).
    pub(super) exchange: Value,
    pub(super) node: Value,
    pub(super) outer: Value,
    pub(super) scratch: Value,
    pub(super) answer: StackSlot,
    pub(super) arguments: StackSlot,
    pub(super) steps: Variable,
    pub(super) bytes: Variable,
    pub(super) instructions: Variable,
}

impl<'p: 'v, 'v, 'b> Writer<'p, 'v, 'b> {
    pub(super) fn new(program: &'p Program, mut b: FunctionBuilder<'b>, convention: CallConv) -> Self {
        let slot = |words: u32| StackSlotData::new(StackSlotKind::ExplicitSlot, 8 * words, 3);
        let (answer, arguments) =
            (b.create_sized_stack_slot(slot(1)), b.create_sized_stack_slot(slot(2 * ARGUMENTS)));
        let [steps, bytes, instructions] = [(); 3].map(|()| b.declare_var(I64));
        let [start, guards, begin] = [(); 3].map(|()| b.create_block());
        b.switch_to_block(start);
        b.append_block_params_for_function_params(start);
        let &[exchange, node, outer, scratch] = b.block_params(start) else {
            unreachable!("`Start` has four parameters")
        };
        b.ins().jump(guards, &[]);
        Writer {
            program,
            b,
            convention,
            flows: HashMap::new(),
            pieces: HashMap::new(),
            pending_pieces: vec![],
            pending_exits: vec![],
            exit_here: None,
            variables: HashMap::new(),
            inputs: BTreeMap::new(),
            constants: HashMap::new(),
            written: BTreeSet::new(),
            read: BTreeSet::new(),
            names: vec![],
            lists: vec![],
            counts: false,
            writes_node: false,
            divides: false,
            guards,
            begin,
            exchange,
            node,
            outer,
            scratch,
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

    /// Finds the inputs, and writes the jump to the first piece.
    pub(super) fn write_start(
        &mut self,
        id: FunctionId,
        pc: usize,
        contents: Contents<'_, 'v>,
    ) -> CompileResult<()> {
        let f = self.program.function(id);
        self.b.switch_to_block(self.begin);
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
            asks: false,
            instructions: 0,
            fresh_count: 0,
        };
        for reg in inputs {
            let Some(value) = contents(reg) else { return Err("a register does not exist".into()) };
            let kind = Kind::of(value);
            if !kind.is_plain() {
                cursor.samples.insert(reg, value);
            }
            cursor.kinds.insert(reg, kind);
        }
        if cursor.kinds.len() > MAX_REGISTERS {
            return Err("too many registers".into());
        }
        self.inputs = cursor.kinds.clone();
        self.enter_piece(&mut cursor, pc);
        Ok(())
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
                self.exit_here = None;
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

    /// Jumps to the piece that begins at an instruction with the current kinds.
    pub(super) fn enter_piece(&mut self, cursor: &mut Cursor<'v>, pc: usize) {
        let before = self.b.use_var(self.instructions);
        let instructions = self.b.ins().iadd_imm_s(before, cursor.instructions);
        self.b.def_var(self.instructions, instructions);
        cursor.instructions = 0;
        self.exit_here = None;
        self.forget_dead(cursor, pc);
        cursor.renumber();
        let key = Key {
            calls: cursor.calls.clone(),
            function: cursor.function,
            base: cursor.base,
            pc: pc as u32,
            asks: cursor.asks,
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
        self.exit_here = None;
        self.b.ins().jump(block, &[]);
    }

    /// Forgets registers that nobody reads again. A register stays if it holds shared data, or did so where the
    /// code began: this data counts while the register holds it.
    pub(super) fn forget_dead(&mut self, cursor: &mut Cursor<'v>, pc: usize) {
        let mut places: Vec<(FunctionId, u32, usize)> =
            cursor.calls.iter().map(|call| (call.caller, call.base, call.back as usize)).collect();
        places.push((cursor.function, cursor.base, pc));
        let innermost_end = cursor.base + u32::from(self.f(cursor).scratch_registers);
        let mut dead = vec![];
        for (reg, kind) in &cursor.kinds {
            let was_counted = self.inputs.get(reg).is_some_and(|kind| kind.is_counted(*reg));
            if kind.is_counted(*reg) || was_counted {
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
        self.counts = true;
        let left = self.b.use_var(self.steps);
        let none = self.b.ins().icmp_imm_s(IntCC::SignedLessThanOrEqual, left, 0);
        self.leave_if(cursor, pc, none);
        let left = self.b.ins().iadd_imm_s(left, -1);
        self.b.def_var(self.steps, left);
    }

    /// Charges the memory that an instruction needs, or leaves before the instruction. This is the last check
    /// of an instruction.
    pub(super) fn charge(&mut self, cursor: &Cursor<'v>, pc: usize, bytes: usize) {
        self.counts = true;
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

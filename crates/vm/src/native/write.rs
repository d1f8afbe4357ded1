//! Machine code from bytecode: a piece of code for each instruction and each combination of kinds.
//!
//! The registers of the model are variables of Cranelift's builder, which makes them values of the processor. A piece begins
//! at a jump's target; its *key* is where that is, the calls of pure functions that it is in, and the kinds of the registers
//! that are live. A jump leads to the piece with the key that it has by then, which is written if there is none yet. So
//! a variable that is a whole number in the first round of a loop and a real one in the others has a piece for each, and no
//! instruction tests a kind that is known.

use super::flow::{Flow, registers};
use super::typed::{Number, Typed};
use crate::code::kinds::{Kind, Made, Reg, is_counted};
use crate::code::routine::words;
use crate::code::routine::{Call, Exit, Input};
use crate::code::{Function, FunctionId, Operand, Place, Program};
use crate::value::{Range, Value as Model};
use niwaki_native::Written;
use niwaki_native::codegen::ir::condcodes::IntCC;
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{
    Block, InstBuilder, MemFlagsData, StackSlot, StackSlotData, StackSlotKind, Value,
};
use niwaki_native::codegen::isa::CallConv;
use niwaki_native::frontend::{FunctionBuilder, Variable};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

/// What the registers of a function hold where code begins.
pub(super) type Found<'a, 'v> = &'a dyn Fn(Reg) -> Option<&'v Model>;

/// Most pieces of a routine: what is beyond them is left to the interpreter.
const PIECES: usize = 160;

/// Most registers that a routine exchanges with the machine.
const REGISTERS: usize = 200;

/// Words of an array that a called function answers to, and of one for arguments.
pub(super) const ARGUMENTS: u32 = 8;

/// Flags of valid, aligned memory.
pub(super) const PLAIN: MemFlagsData = MemFlagsData::trusted();

/// What a piece of code is for.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Key {
    calls: Vec<Call>,
    function: FunctionId,
    base: u32,
    pc: u32,
    kinds: Vec<(Reg, Kind)>,
}

/// Where the writer is in a piece.
#[derive(Clone)]
pub(super) struct Now<'v> {
    pub calls: Vec<Call>,
    pub function: FunctionId,
    pub base: u32,
    pub(super) kinds: BTreeMap<Reg, Kind>,
    pub(super) samples: HashMap<Reg, &'v Model>,
    /// Instructions since they were counted.
    done: i64,
    /// How many vectors and tuples the code has made so far.
    made: u16,
}

/// How the writing goes on after an instruction.
pub(super) enum Then {
    /// With the next one.
    Next,
    /// The piece has ended.
    Ended,
    /// There is no code for this instruction.
    Leave,
}

/// An exit whose code is not written yet.
struct Leaving {
    block: Block,
    exit: Exit,
    values: Vec<(Reg, Kind, Vec<Value>)>,
    done: i64,
}

/// A routine while it is written.
pub(super) struct Writer<'p, 'v, 'b> {
    pub program: &'p Program,
    pub b: FunctionBuilder<'b>,
    pub(super) convention: CallConv,
    flows: HashMap<FunctionId, Flow>,
    pieces: HashMap<Key, Block>,
    waiting: Vec<(Block, usize, Now<'v>)>,
    leaving: Vec<Leaving>,
    pub(super) variables: HashMap<(Reg, u8), Variable>,
    /// What registers held where the code begins, if it was shared.
    began_with: BTreeSet<Reg>,
    pub(super) constants: Vec<(FunctionId, u16)>,
    pub(super) written: BTreeSet<Reg>,
    /// Registers that some instruction reads.
    pub(super) read: BTreeSet<Reg>,
    pub(super) names: Vec<Box<str>>,
    /// Whether whole numbers are divided.
    pub(super) divides: bool,
    pub(super) words: usize,
    exchange: Value,
    pub(super) answer: StackSlot,
    pub(super) arguments: StackSlot,
    steps: Variable,
    bytes: Variable,
    done: Variable,
}

fn offset(word: usize) -> i32 {
    i32::try_from(8 * word).expect("there are few words")
}

impl<'p: 'v, 'v, 'b> Writer<'p, 'v, 'b> {
    pub(super) fn new(program: &'p Program, mut b: FunctionBuilder<'b>, convention: CallConv) -> Self {
        let slot = |words: u32| StackSlotData::new(StackSlotKind::ExplicitSlot, 8 * words, 3);
        let (answer, arguments) =
            (b.create_sized_stack_slot(slot(1)), b.create_sized_stack_slot(slot(2 * ARGUMENTS)));
        let [steps, bytes, done] = [(); 3].map(|()| b.declare_var(I64));
        Writer {
            program,
            b,
            convention,
            flows: HashMap::new(),
            pieces: HashMap::new(),
            waiting: vec![],
            leaving: vec![],
            variables: HashMap::new(),
            began_with: BTreeSet::new(),
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
            done,
        }
    }

    pub(super) fn f(&self, now: &Now<'_>) -> &'p Function {
        self.program.function(now.function)
    }

    pub(super) fn flow(&mut self, id: FunctionId) -> &Flow {
        self.flows.entry(id).or_insert_with(|| Flow::of(self.program.function(id)))
    }

    /// The code that reads all inputs, and the first piece. Gives the inputs.
    pub(super) fn begin(&mut self, id: FunctionId, pc: usize, found: Found<'_, 'v>) -> Written<Vec<Input>> {
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
        self.b.def_var(self.done, zero);

        // Registers that hold something shared are inputs even where they are dead: when one is written, what it held
        // goes.
        let flow = self.flow(id);
        let mut inputs = registers(f);
        inputs.retain(|reg| {
            let o = match *reg {
                Reg::Node(i) => Operand::new(Place::Node, i.into()),
                Reg::Scratch(i) => Operand::new(Place::Scratch, i as usize),
                Reg::Outer(_) => return true,
            };
            flow.is_live(pc, o) || found(*reg).is_some_and(|value| is_counted(*reg, value))
        });

        let mut now = Now {
            calls: vec![],
            function: id,
            base: 0,
            kinds: BTreeMap::new(),
            samples: HashMap::new(),
            done: 0,
            made: 0,
        };
        let mut known = vec![];
        let mut at = words::REGISTERS;
        for reg in inputs {
            let Some(value) = found(reg) else { return Err("a register that is not there".into()) };
            let kind = Kind::of(value);
            if !kind.is_plain() {
                if kind.is_counted(reg) {
                    self.began_with.insert(reg);
                }
                now.samples.insert(reg, value);
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
                Kind::Fresh { .. } => return Err("only code makes these".into()),
            };
            self.define(reg, typed);
            now.kinds.insert(reg, kind);
            known.push(Input { reg, kind, word: at });
            at += kind.words();
        }
        if known.len() > REGISTERS {
            return Err("too many registers".into());
        }
        self.words = at;
        self.go(&mut now, pc);
        Ok(known)
    }

    /// Writes every piece that some other leads to.
    pub(super) fn all_pieces(&mut self) {
        while let Some((block, first, mut now)) = self.waiting.pop() {
            self.b.switch_to_block(block);
            let mut pc = first;
            loop {
                if pc != first && self.flow(now.function).is_target(pc) {
                    self.go(&mut now, pc);
                    break;
                }
                match self.instruction(&mut now, pc) {
                    Then::Next => {
                        now.done += 1;
                        pc += 1;
                    }
                    Then::Ended => break,
                    Then::Leave => {
                        let exit = self.exit(&now, pc);
                        self.b.ins().jump(exit, &[]);
                        break;
                    }
                }
            }
        }
    }

    /// Writes the code of every exit.
    pub(super) fn all_exits(&mut self) -> Vec<Exit> {
        let mut exits = vec![];
        for Leaving { block, mut exit, values, done } in std::mem::take(&mut self.leaving) {
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
            let before = self.b.use_var(self.done);
            let done = self.b.ins().iadd_imm_s(before, done);
            self.b.ins().store(PLAIN, done, self.exchange, offset(words::DONE));
            let number = self.int(exits.len() as i64);
            self.b.ins().return_(&[number]);
            exits.push(exit);
        }
        exits
    }

    /// Jumps to the piece that begins at an instruction with the kinds known now.
    pub(super) fn go(&mut self, now: &mut Now<'v>, pc: usize) {
        let before = self.b.use_var(self.done);
        let done = self.b.ins().iadd_imm_s(before, now.done);
        self.b.def_var(self.done, done);
        now.done = 0;
        self.forget_dead(now, pc);
        now.number_again();
        let key = Key {
            calls: now.calls.clone(),
            function: now.function,
            base: now.base,
            pc: pc as u32,
            kinds: now.kinds.iter().map(|(reg, kind)| (*reg, *kind)).collect(),
        };
        let block = match self.pieces.get(&key) {
            Some(block) => *block,
            None if self.pieces.len() >= PIECES => self.exit(now, pc),
            None => {
                let block = self.b.create_block();
                self.pieces.insert(key, block);
                self.waiting.push((block, pc, now.clone()));
                block
            }
        };
        self.b.ins().jump(block, &[]);
    }

    /// Forgets registers that nobody reads again. One that holds something shared, or did so where the code began, stays: what
    /// it holds counts as long as it holds it.
    fn forget_dead(&mut self, now: &mut Now<'v>, pc: usize) {
        let mut places: Vec<(FunctionId, u32, usize)> =
            now.calls.iter().map(|call| (call.caller, call.base, call.back as usize)).collect();
        places.push((now.function, now.base, pc));
        let innermost_end = now.base + u32::from(self.f(now).scratch_registers);
        let mut dead = vec![];
        for (reg, kind) in &now.kinds {
            if kind.is_counted(*reg) || self.began_with.contains(reg) {
                continue;
            }
            let (id, at, o) = match *reg {
                // What the activation holds may be read by a slice.
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
            now.kinds.remove(&reg);
            now.samples.remove(&reg);
        }
    }

    /// A place to leave at, before an instruction.
    pub(super) fn exit(&mut self, now: &Now<'v>, pc: usize) -> Block {
        let block = self.b.create_block();
        self.b.set_cold_block(block);
        let mut values = vec![];
        let mut now = now.clone();
        self.forget_dead(&mut now, pc);
        for (reg, kind) in &now.kinds {
            // A register that is only read stays as it is.
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
            calls: now.calls.clone(),
            function: now.function,
            base: now.base,
            pc: pc as u32,
            registers: vec![],
            has_objects: false,
        };
        self.leaving.push(Leaving { block, exit, values, done: now.done });
        block
    }

    /// Leaves before the instruction where a condition holds.
    pub(super) fn leave_if(&mut self, now: &Now<'v>, pc: usize, condition: Value) {
        let (exit, on) = (self.exit(now, pc), self.b.create_block());
        self.b.ins().brif(condition, exit, &[], on, &[]);
        self.b.switch_to_block(on);
    }

    /// A jump: one that goes back is a step.
    pub(super) fn jump(&mut self, now: &mut Now<'v>, pc: usize, target: usize) {
        if target <= pc {
            self.take_step(now, pc);
        }
        now.done += 1;
        self.go(now, target);
    }

    /// Takes a step, or leaves before the instruction where there is none left.
    pub(super) fn take_step(&mut self, now: &Now<'v>, pc: usize) {
        let left = self.b.use_var(self.steps);
        let none = self.b.ins().icmp_imm_s(IntCC::SignedLessThanOrEqual, left, 0);
        self.leave_if(now, pc, none);
        let left = self.b.ins().iadd_imm_s(left, -1);
        self.b.def_var(self.steps, left);
    }

    /// Charges what an instruction makes, or leaves before it: the last that it checks.
    pub(super) fn charge(&mut self, now: &Now<'v>, pc: usize, bytes: usize) {
        let left = self.b.use_var(self.bytes);
        let none = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, left, bytes as i64);
        self.leave_if(now, pc, none);
        let left = self.b.ins().iadd_imm_s(left, -(bytes as i64));
        self.b.def_var(self.bytes, left);
    }

    /// A vector or tuple of these numbers, which is charged and in no memory yet.
    pub(super) fn make(&mut self, now: &mut Now<'v>, pc: usize, made: Made, numbers: &[Number]) -> Typed {
        let numbers_of = || numbers.iter().map(|_| Model::real(0.0)).collect();
        let like: Model = match made {
            Made::Vector => Model::vector(&[0.0; 3]),
            Made::Tuple => Model::tuple(numbers_of()),
            Made::Range => Model::Range(Arc::new(Range { start: 0, stop: 0, step: 1, len: 0 })),
        };
        self.charge(now, pc, like.own_bytes());
        let mut parts = [None; 4];
        parts.iter_mut().zip(numbers).for_each(|(part, number)| *part = Some(*number));
        now.made += 1;
        Typed::Fresh { made, parts, number: now.made }
    }

    /// A word that the machine gave.
    pub(super) fn word(&mut self, at: usize) -> Value {
        self.b.ins().load(I64, PLAIN, self.exchange, offset(at))
    }

    pub(super) fn int(&mut self, n: i64) -> Value {
        self.b.ins().iconst(I64, n)
    }
}

impl Now<'_> {
    /// Numbers what the code has made from one on, in the order of the registers: so that pieces are alike where only these
    /// numbers would differ.
    fn number_again(&mut self) {
        let mut known: Vec<u16> = vec![];
        for kind in self.kinds.values_mut() {
            if let Kind::Fresh { number, .. } = kind {
                let at = known.iter().position(|own| own == number).unwrap_or(known.len());
                if at == known.len() {
                    known.push(*number);
                }
                *number = at as u16 + 1;
            }
        }
        self.made = known.len() as u16;
    }

    /// Counts an instruction that the writer of a piece does not count.
    pub(super) fn count(&mut self) {
        self.done += 1;
    }

    /// The whole number that an operand is, where it is a constant.
    pub(super) fn constant_int(&self, f: &Function, o: Operand) -> Option<i64> {
        match f.constants.get(o.index()) {
            Some(Model::Int(n)) if o.is_constant() => Some(*n),
            _ => None,
        }
    }
}

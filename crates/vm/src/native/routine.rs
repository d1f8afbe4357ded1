//! Machine code for one combination of kinds, and where it leaves.

use super::entries::Found;
use super::kinds::{Kind, Reg};
use super::write::Writer;
use crate::code::{FunctionId, Operand, Program};
use niwaki_native::codegen::ir::types::I64;
use niwaki_native::codegen::ir::{AbiParam, Signature, UserFuncName};
use niwaki_native::frontend::{FunctionBuilder, FunctionBuilderContext};
use niwaki_native::module::{Linkage, Module as _};
use niwaki_native::{Effort, Memory, Written};

/// `(words)`, as [`words`] says; gives the number of the exit taken.
type Code = unsafe extern "C" fn(*mut u64) -> u64;

/// Machine code for one combination of kinds.
pub(crate) struct Routine {
    /// Registers that it reads where it begins, and their kinds there.
    pub inputs: Vec<Input>,
    /// Constants that are no numbers: of which function, and which.
    pub constants: Vec<(FunctionId, u16)>,
    /// Other registers that it may write: they must hold nothing shared.
    pub overwritten: Vec<Reg>,
    /// How many of these are of the activation: they come first.
    pub overwritten_nodes: usize,
    /// One past the last of these that is of the machine.
    pub scratch_end: usize,
    /// Where it may leave.
    pub exits: Vec<Exit>,
    /// Whether it writes registers of the activation.
    pub writes_node: bool,
    /// Words that it exchanges with the machine.
    pub words: usize,
    code: Code,
    bytes: usize,
    _names: Vec<Box<str>>,
    _memory: Memory,
}

impl std::fmt::Debug for Routine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Routine({} bytes, {:?})", self.bytes, self.inputs)
    }
}

/// A register that machine code reads where it begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Input {
    pub reg: Reg,
    pub kind: Kind,
    /// Its first word.
    pub word: usize,
}

/// A place where machine code leaves.
#[derive(Debug)]
pub(crate) struct Exit {
    /// Calls of pure functions that are in progress, from the outermost: where each was called.
    pub calls: Vec<Call>,
    /// The function that the interpreter continues in.
    pub function: FunctionId,
    /// Its first scratch register, from that of the function where the code began.
    pub base: u32,
    /// The instruction that it continues at.
    pub pc: u32,
    /// Registers that have changed, in the order of their words.
    pub registers: Vec<(Reg, Kind)>,
    /// Whether some of them hold what is shared.
    pub has_objects: bool,
}

/// A call of a pure function in progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Call {
    /// Who calls.
    pub caller: FunctionId,
    /// The caller's first scratch register.
    pub base: u32,
    /// Where the caller continues.
    pub back: u32,
    /// The register for the result.
    pub to: Operand,
}

impl Routine {
    /// How much code it is.
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// Runs it: gives the exit that it took.
    ///
    /// # Panics
    /// When there are fewer than [`Routine::words`].
    #[inline]
    #[allow(unsafe_code)]
    pub fn run(&self, words: &mut [u64]) -> &Exit {
        assert!(words.len() >= self.words);
        // SAFETY: the code stays within so many words. The addresses among them are those of values of the kinds that it
        // was written for, as `enter` put them there, and nobody changes these meanwhile.
        let exit = unsafe { (self.code)(words.as_mut_ptr()) };
        &self.exits[exit as usize]
    }

    /// Writes the code of a function from an instruction on. `found` gives what a register holds there now.
    ///
    /// # Errors
    /// Too many registers, a processor that Cranelift does not know, or memory that may not be executed.
    pub fn write<'v>(
        program: &'v Program,
        function: FunctionId,
        pc: usize,
        found: Found<'_, 'v>,
    ) -> Written<Routine> {
        let mut module = niwaki_native::module(Effort::Plain)?;
        let mut context = module.make_context();
        let mut signature = Signature::new(module.target_config().default_call_conv);
        signature.params.push(AbiParam::new(I64));
        signature.returns.push(AbiParam::new(I64));
        let convention = signature.call_conv;
        context.func.signature = signature;
        context.func.name = UserFuncName::user(0, 0);
        let mut builder_context = FunctionBuilderContext::new();
        let b = FunctionBuilder::new(&mut context.func, &mut builder_context);
        let mut writer = Writer::new(program, b, convention);
        let mut inputs = writer.begin(function, pc, found)?;
        writer.all_pieces();
        let exits = writer.all_exits();
        let Writer { mut b, constants, written, read, names, divides, words, .. } = writer;
        inputs.retain(|input| read.contains(&input.reg) || written.contains(&input.reg));
        b.seal_all_blocks();
        b.finalize(module.target_config());
        if divides {
            // By a constant, it becomes a multiplication. Nothing else gains by the effort, which takes twice the time.
            module = niwaki_native::module(Effort::Quick)?;
        }
        let id = module.declare_function("routine", Linkage::Local, &context.func.signature)?;
        module.define_function(id, &mut context)?;
        let bytes = context.compiled_code().map_or(0, |code| code.code_info().total_size as usize);
        let memory = Memory::finish(module)?;
        let is_input = |reg: &Reg| inputs.iter().any(|input| input.reg == *reg);
        let writes_node = written.iter().any(|reg| matches!(reg, Reg::Node(_)));
        let overwritten: Vec<Reg> = written.into_iter().filter(|reg| !is_input(reg)).collect();
        let overwritten_nodes = overwritten.iter().filter(|reg| matches!(reg, Reg::Node(_))).count();
        let scratch_end = match overwritten.last() {
            Some(Reg::Scratch(last)) => *last as usize + 1,
            _ => 0,
        };
        // SAFETY: it was written with this signature.
        #[allow(unsafe_code)]
        let code = unsafe { std::mem::transmute::<*const u8, Code>(memory.address(id)) };
        Ok(Routine {
            inputs,
            constants,
            overwritten,
            overwritten_nodes,
            scratch_end,
            exits,
            writes_node,
            words,
            code,
            bytes,
            _names: names,
            _memory: memory,
        })
    }
}

//! Writes machine code for one combination of kinds.

use super::write::{Contents, Writer};
use crate::code::register::Reg;
use crate::code::routine::{Instructions, Routine, Start};
use crate::code::{FunctionId, Program};
use niwaki_native::codegen::ir::types::I64;
use niwaki_native::codegen::ir::{AbiParam, Signature, UserFuncName};
use niwaki_native::frontend::{FunctionBuilder, FunctionBuilderContext};
use niwaki_native::module::{Linkage, Module as _};
use niwaki_native::{CompileResult, Effort, Memory};

/// Writes the code of a function from an instruction on, for the current contents of the registers.
///
/// # Errors
/// There are too many registers, Cranelift does not know the processor, or memory may not be executed.
pub(super) fn routine<'v>(
    program: &'v Program,
    function: FunctionId,
    pc: usize,
    contents: Contents<'_, 'v>,
) -> CompileResult<Routine> {
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
    let mut inputs = writer.write_start(function, pc, contents)?;
    writer.write_pieces();
    let exits = writer.write_exits();
    let Writer { mut b, constants, written, read, names, divides, words, .. } = writer;
    inputs.retain(|input| read.contains(&input.reg) || written.contains(&input.reg));
    b.seal_all_blocks();
    b.finalize(module.target_config());
    if divides {
        // A division by a constant becomes a multiplication. Nothing else gains from the effort, which takes
        // twice the time.
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
    // SAFETY: the code was written with this signature, and it names no other texts. It stays within `words`
    // words, and reads its inputs by their kinds.
    #[allow(unsafe_code)]
    let code = unsafe {
        let start = std::mem::transmute::<*const u8, Start>(memory.address(id));
        Instructions::new(start, bytes, Box::new((memory, names)))
    };
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
    })
}

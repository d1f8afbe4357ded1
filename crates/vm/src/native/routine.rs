//! Writes machine code for one combination of kinds.

use super::write::{Contents, Writer};
use crate::code::register::{Kind, Reg};
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
    signature.params.extend([AbiParam::new(I64); 4]);
    signature.returns.push(AbiParam::new(I64));
    let convention = signature.call_conv;
    context.func.signature = signature;
    context.func.name = UserFuncName::user(0, 0);
    let mut builder_context = FunctionBuilderContext::new();
    let b = FunctionBuilder::new(&mut context.func, &mut builder_context);
    let mut writer = Writer::new(program, b, convention);
    writer.write_start(function, pc, contents)?;
    writer.write_pieces();
    let exits = writer.write_exits();
    let is_used = |reg: &Reg| writer.read.contains(reg) || writer.written.contains(reg);
    let inputs: Vec<(Reg, Kind)> =
        writer.inputs.iter().map(|(reg, kind)| (*reg, *kind)).filter(|(reg, _)| is_used(reg)).collect();
    let overwritten: Vec<Reg> =
        writer.written.iter().filter(|reg| !writer.inputs.contains_key(reg)).copied().collect();
    writer.write_guards(&inputs, &overwritten);
    let Writer { mut b, constants, written, names, lists, counts, divides, writes_node, .. } = writer;
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
    let registers_of_machine =
        inputs.iter().map(|(reg, _)| reg).chain(&written).filter_map(|reg| match reg {
            Reg::Scratch(i) => Some(*i as usize + 1),
            Reg::Node(_) | Reg::Outer(_) => None,
        });
    let scratch_end = registers_of_machine.max().unwrap_or(0);
    // SAFETY: the code was written with this signature, and it names no other memory than its owner has. It tests
    // the kinds of its inputs before it reads them.
    #[allow(unsafe_code)]
    let code = unsafe {
        let start = std::mem::transmute::<*const u8, Start>(memory.address(id));
        Instructions::new(start, bytes, Box::new((memory, names, lists, constants)))
    };
    Ok(Routine { inputs, scratch_end, exits, writes_node, counts, code })
}

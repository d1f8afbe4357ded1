//! Machine code: the module that functions are written into, and the memory that holds finished functions.
//!
//! Cranelift emits the instructions. Memory is first written and then made executable: it is never both at
//! once. The crates that write the functions decide what they compute: densities (`grad`), models (`vm`).

use cranelift_codegen::settings::{self, Configurable};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{FuncId, default_libcall_names};

pub use cranelift_codegen as codegen;
pub use cranelift_frontend as frontend;
pub use cranelift_jit as jit;
pub use cranelift_module as module;

/// The result of a step of compilation. It fails for a processor that Cranelift does not know, and for memory
/// that may not be executed.
pub type CompileResult<T> = Result<T, Box<dyn std::error::Error>>;

/// The amount of optimisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Registers are allocated and nothing else happens: for code whose instructions are in their best order
    /// already.
    Plain,
    /// Common subexpressions are computed once, and known constants are folded.
    Quick,
}

/// Creates an empty module for the processor that this program runs on.
///
/// # Errors
/// A processor that Cranelift does not know.
pub fn module(effort: Effort) -> CompileResult<JITModule> {
    let mut flags = settings::builder();
    let level = match effort {
        Effort::Plain => "none",
        Effort::Quick => "speed",
    };
    for (name, value) in [
        ("opt_level", level),
        ("enable_verifier", "false"),
        ("is_pic", "false"),
        ("use_colocated_libcalls", "false"),
    ] {
        flags.set(name, value)?;
    }
    let isa = cranelift_native::builder()?.finish(settings::Flags::new(flags))?;
    Ok(JITModule::new(JITBuilder::with_isa(isa, default_libcall_names())))
}

/// Finished machine code, freed with its last owner.
pub struct Memory(Option<JITModule>);

// SAFETY: the module is never touched again after compilation, except to be freed by its last owner; the code is only
// read.
#[allow(unsafe_code)]
unsafe impl Send for Memory {}
// SAFETY: as above.
#[allow(unsafe_code)]
unsafe impl Sync for Memory {}

impl Memory {
    /// Finishes the writing: from now on the functions can be called.
    /// # Errors
    /// Memory that may not be executed.
    pub fn finish(mut module: JITModule) -> CompileResult<Memory> {
        module.finalize_definitions()?;
        Ok(Memory(Some(module)))
    }

    /// Returns the address of a function of the module. It can be called as long as the memory exists.
    pub fn address(&self, function: FuncId) -> *const u8 {
        self.0.as_ref().map_or(std::ptr::null(), |module| module.get_finalized_function(function))
    }
}

impl Drop for Memory {
    #[allow(unsafe_code)]
    fn drop(&mut self) {
        if let Some(module) = self.0.take() {
            // SAFETY: callers of a function keep its memory alive.
            unsafe { module.free_memory() };
        }
    }
}

//! Machine code: a module to write functions into, and the memory that finished functions are in.
//!
//! Cranelift writes the instructions. Memory is written first and made executable afterwards: it is never both at once.
//! What the functions compute is the business of the crates that write them: densities (`grad`), models (`vm`).

use cranelift_codegen::settings::{self, Configurable};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{FuncId, default_libcall_names};

pub use cranelift_codegen as codegen;
pub use cranelift_frontend as frontend;
pub use cranelift_jit as jit;
pub use cranelift_module as module;

/// Errors of compilation: a processor that Cranelift does not know, memory that may not be executed.
pub type Written<T> = Result<T, Box<dyn std::error::Error>>;

/// How much is done to make the code quick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Registers are allocated, no more: for code whose instructions are in their best order already.
    Plain,
    /// Common parts are computed once, and constants where they are known.
    Quick,
}

/// An empty module for the processor that this program runs on.
///
/// # Errors
/// A processor that Cranelift does not know.
pub fn module(effort: Effort) -> Written<JITModule> {
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
    /// Ends the writing: the functions can be called from now on.
    ///
    /// # Errors
    /// Memory that may not be executed.
    pub fn finish(mut module: JITModule) -> Written<Memory> {
        module.finalize_definitions()?;
        Ok(Memory(Some(module)))
    }

    /// Where a function of the module begins. It can be called as long as the memory exists.
    pub fn address(&self, function: FuncId) -> *const u8 {
        self.0.as_ref().map_or(std::ptr::null(), |module| module.get_finalized_function(function))
    }
}

impl Drop for Memory {
    #[allow(unsafe_code)]
    fn drop(&mut self) {
        if let Some(module) = self.0.take() {
            // SAFETY: who calls a function keeps its memory.
            unsafe { module.free_memory() };
        }
    }
}

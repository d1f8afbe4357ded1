//! Core form: any bytes are a program or an error.

use niwaki_vm::core::Module;
use niwaki_vm::core::parse::parse;
use niwaki_vm::core::print::print;
use niwaki_vm::passes::compile;
use std::thread;

/// Lists that make a text deep enough to need more than the stack of a test's thread.
const DEEP: usize = 200;
/// Bytes of stack for such a text.
const STACK: usize = 512 << 20;

/// Reads, prints, reads again and compiles a text.
///
/// # Panics
/// When printing a module and reading it gives another one.
pub fn check(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    on_stack_for(text, || {
        let Ok(module) = parse(text) else { return };
        round_trip(&module);
        let _ = compile::<f64>(&module, vec![]);
    });
}

/// Runs on a thread with a stack that is large enough for this text.
///
/// # Panics
/// When the system has no memory for a stack.
pub fn on_stack_for(text: &str, work: impl FnOnce() + Send) {
    if text.bytes().filter(|byte| *byte == b'(').count() <= DEEP {
        return work();
    }
    thread::scope(|scope| {
        let thread = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
        thread.expect("a thread").join().expect("a panic ends the process");
    });
}

fn round_trip(module: &Module) {
    let text = print(module);
    match parse(&text) {
        Ok(again) => assert_eq!(print(&again), text, "printed and read again"),
        Err(error) => panic!("{error}\n{text}"),
    }
}

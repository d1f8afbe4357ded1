//! Built-in functions and their arguments.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| niwaki_fuzz::values::check(bytes));

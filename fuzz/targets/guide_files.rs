//! The bytes of guides.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| niwaki_fuzz::guides::check(bytes));

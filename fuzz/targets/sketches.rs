//! Shapes that come to sketches and go.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| niwaki_fuzz::sketches::check(bytes));

//! Core form, changed by its words and parentheses.
#![no_main]

use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use niwaki_fuzz::{core_text, mutate};

fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
    if seed.is_multiple_of(8) {
        fuzzer_mutate(data, size, most)
    } else {
        mutate::change(data, size, most, seed, 0)
    }
});

fuzz_target!(|bytes: &[u8]| core_text::check(bytes));

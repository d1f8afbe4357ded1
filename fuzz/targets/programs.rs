//! Programs by the text of others, changed by its words and parentheses.
#![no_main]

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use niwaki_fuzz::{mutate, programs};

fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
    mutate::change(data, size, most, seed, programs::HEAD)
});

fuzz_target!(|bytes: &[u8]| programs::check(bytes));

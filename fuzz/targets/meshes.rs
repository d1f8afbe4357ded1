//! Triangles of every kind.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| niwaki_fuzz::meshes::check(bytes));

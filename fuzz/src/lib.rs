//! Fuzzers of the engine: each is a function of bytes that must end quietly.
//!
//! A fuzzer panics where the engine breaks a promise: two answers that must be equal differ, a number is not one, a
//! damaged input is accepted. What the engine does by itself (a panic, an overflow, memory or time beyond the bounds) the
//! driver finds. The targets in `targets/` only pass on the bytes; `fuzzers.py` beside the tests runs them all.
//!
//! | part | bytes are | what must hold |
//! | --- | --- | --- |
//! | [`core_text`] | core form | a program or an error; printing and reading again changes nothing |
//! | [`programs`] | settings and core form | the four strategies agree to the bit; the same seed gives the same bits |
//! | [`grown`] | choices of a small grammar | the same, for programs that always compile |
//! | [`values`] | arguments of a built-in function | a value or a fault |
//! | [`distributions`] | a family and its parameters | draws are in the support; scores are numbers |
//! | [`sketches`] | shapes that come and go | the sketch of what stands, to the bit |
//! | [`meshes`] | triangles | voxels, rays and intersections, whatever they are |
//! | [`guides`] | a file | a network or an error |
//!
//! [`mutate`] changes core text by its words and parentheses; [`numbers`] draws from bytes, extremes among them;
//! [`solids`] makes shapes of such numbers.

pub mod core_text;
pub mod distributions;
#[cfg(feature = "search")]
pub mod grown;
pub mod guides;
pub mod meshes;
pub mod mutate;
pub mod numbers;
#[cfg(feature = "search")]
pub mod programs;
pub mod sketches;
pub mod solids;
pub mod values;

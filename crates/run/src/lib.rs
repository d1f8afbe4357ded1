//! A task and its runs: what every algorithm asks and answers.
//!
//! * [`task`]: what a search runs on: a program, its arguments, the sketches that score its scene; [`hold`]: with choices held;
//! * [`log`]: the choices of a run, shared between copies of a particle; [`record`]: choices and score of a run;
//! * [`chooser`]: where a choice gets its value; [`fresh`]: the new choices of a kept run;
//! * [`forward`]: a run of new choices; [`replay`]: take every choice from a log, and name it; [`run`]: a finished run;
//! * [`enumeration`], [`rejection`]: exact answers, the oracles for the rest;
//! * [`weights`], [`resampling`]: what runs weigh, and which of many survive; [`order`]: which future runs next;
//! * [`streams`]: the random streams that belong to no run;
//! * [`select`], [`glob`]: selections of choices by their addresses;
//! * [`checkpoint`]: what a search needs to go on after it was killed;
//! * [`failure`], [`blame`], [`losses`]: why a search gives no result, and which parts made runs impossible;
//! * [`mixed`]: observations that are probabilities in some runs and densities in others;
//! * [`inside`]: what a run with an inference inside keeps to.

pub mod blame;
pub mod checkpoint;
pub mod chooser;
pub mod enumeration;
pub mod failure;
pub mod forward;
pub mod fresh;
pub mod glob;
pub mod hold;
pub mod inside;
pub mod log;
pub mod losses;
pub mod mixed;
pub mod order;
pub mod record;
pub mod rejection;
pub mod replay;
pub mod resampling;
pub mod run;
pub mod select;
pub mod setting;
pub mod streams;
pub mod task;
pub mod weights;

pub use failure::Failure;
pub use task::Task;

//! A task and its runs, shared by every search algorithm.
//!
//! * [`task`]: a program, its arguments and the sketches that score its scene; [`hold`]: tasks with held choices;
//! * [`log`]: the choices of a run, shared between copies of a particle; [`record`]: the choices and the score of a run;
//! * [`chooser`]: the sources of the values of choices; [`fresh`]: the new choices of a kept run;
//! * [`forward`]: runs that draw all choices; [`replay`]: runs that take all choices from a log; [`run`]: finished runs;
//! * [`enumeration`], [`rejection`]: exact answers, which the tests of all other methods compare with;
//! * [`weights`], [`resampling`]: importance weights and resampling; [`order`]: the order policies of futures;
//! * [`streams`]: random streams that belong to no run;
//! * [`select`], [`glob`]: selections of choices by their addresses;
//! * [`checkpoint`]: the data from which a killed search resumes;
//! * [`failure`], [`blame`], [`losses`]: the reasons for a missing result, and the parts that made runs impossible;
//! * [`mixed`]: observations that are probabilities in some runs and densities in others;
//! * [`inside`]: limits and faults of nested inference.

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

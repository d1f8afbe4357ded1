//! The search: algorithms that answer the machine's questions.
//!
//! * [`task`]: what a search runs on: a program, its arguments, the sketches that score its scene;
//! * [`log`]: the choices of a run, shared between copies of a particle;
//! * [`record`]: choices and score of one run, the same for every algorithm;
//! * [`chooser`]: where a choice gets its value;
//! * [`forward`]: a run of new choices; [`replay`]: take every choice from a log, and name it;
//! * [`enumeration`], [`rejection`], [`importance`]: exact and direct answers, the oracles for the rest;
//! * [`annealed`]: annealed importance sampling, by chains at rising powers of the score;
//! * [`method`]: a search as data; [`run`]: a finished run;
//! * `kinds`: whether observations are probabilities or densities; [`mixed`]: those for which it depends on the run;
//! * `streams`: the random streams that belong to no run;
//! * `particle`, `weights`, [`resampling`]: a run that stops at barriers, what it weighs, and which of many survive;
//! * [`chain`]: Metropolis-Hastings over kept runs, kernels as values; parts of a run grown again by particles;
//! * [`checkpoint`]: what a search needs to go on after it was killed;
//! * [`blame`], [`losses`]: which parts made runs impossible;
//! * [`hold`]: a task with choices held;
//! * [`proposal`]: a user's proposals for a run that begins;
//! * [`particles`]: sequential Monte Carlo, in program order and in stochastic order;
//! * [`order`]: which future of a particle runs next;
//! * [`nested`]: inference inside a model;
//! * [`improve`]: a search for the best, by all of these;
//! * [`gradient`]: a task as a log density over its continuous choices, and chains that follow its slope;
//! * [`hamiltonian`]: such chains over any log density of real coordinates;
//! * [`variational`]: normals near such a density.
//!
//! Not here: opcodes, shapes, Python.

pub mod annealed;
pub mod blame;
pub mod chain;
pub mod checkpoint;
pub mod chooser;
pub mod enumeration;
pub mod failure;
pub mod forward;
pub mod fresh;
pub mod glob;
pub mod gradient;
pub mod guide;
pub mod hamiltonian;
pub mod hold;
pub mod importance;
pub mod improve;
pub mod inside;
mod kinds;
pub mod log;
pub mod look_ahead;
pub mod losses;
pub mod method;
pub mod mixed;
pub mod nested;
pub mod order;
mod particle;
pub mod particles;
pub mod proposal;
pub mod record;
pub mod rejection;
pub mod replay;
pub mod resampling;
pub mod run;
pub mod select;
mod streams;
pub mod task;
pub mod user;
pub mod variational;
mod weights;

pub use failure::Failure;
pub use task::Task;

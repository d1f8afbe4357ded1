//! Parts of methods against what they claim, on small programs.
//!
//! * `annealed`: annealed importance sampling is unbiased for the evidence;
//! * `gradients`: recorded densities and their slopes;
//! * `nested`: probabilities of an inner query, recorded;
//! * `spending`: how long a search for the best goes on;
//! * `totals`: sums are exact for terms of any size.
//!
//! One program, because each would compile the machine again. `memory` has an allocator of its own.

mod annealed;
mod gradients;
mod nested;
mod spending;
#[path = "../support/stopped.rs"]
mod stopped;
mod totals;

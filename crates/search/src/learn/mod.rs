//! Training of guides.
//!
//! * [`survey`]: what the traces of a model show, from which the form of its guide follows;
//! * [`lessons`]: traces as rows, by the code that draws; training; `drawings`: the same for the dissertation's architecture;
//! * [`climb`]: training by the evidence bound, on runs that the guide draws; [`credit`]: how much each run counts;
//! * [`rehearse`]: how a guide learns what a paused run will still gain; `ridge`: its line.

pub mod climb;
pub mod credit;
mod drawings;
pub mod lessons;
pub mod rehearse;
mod ridge;
pub mod survey;
#[cfg(test)]
mod tests;

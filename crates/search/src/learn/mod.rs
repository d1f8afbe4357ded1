//! Training of guides.
//!
//! * [`survey`]: the choices and variables in traces of a model, which determine the form of its guide;
//! * [`lessons`]: traces as rows, by the code that draws; training; `drawings`: training for the dissertation's architecture;
//! * [`climb`]: training by the evidence bound, on runs that the guide draws; [`credit`]: the weight of each run;
//! * [`rehearse`]: forecasts of a guide of the future gain of paused runs; `ridge`: the line of a forecast.

pub mod climb;
pub mod credit;
mod drawings;
pub mod lessons;
pub mod rehearse;
mod ridge;
pub mod survey;
#[cfg(test)]
mod tests;

//! Numbers in, numbers out: scalars, small vectors, random streams, distributions.
//!
//! | part | what it holds |
//! | --- | --- |
//! | [`scalar`] | the operations of a number, so that a run can compute with other scalars than `f64` |
//! | [`vector`] | points, directions and rotations of three dimensions |
//! | [`color`] | sRGB, HSV and CIELAB, and how different two colours look |
//! | [`polygon`] | simple polygons of the plane |
//! | [`portable`] | elementary functions with the same bits on every machine |
//! | [`streams`] | random bits as a function of seed, stream, address and visit |
//! | [`rounding`] | the grid on which log scores are added and subtracted exactly |
//! | [`fingerprint`] | a hash of the bits that this machine computes |
//! | [`total`] | exact sums of log scores of any size |
//! | [`log_sums`] | sums of numbers whose logarithms are known |
//! | [`special`] | special functions that the libraries in use lack |
//! | [`distributions`] | the families that a model may draw from: density, support, sampler, parameter checks |
//!
//! This crate does not know shapes, programs, searches or Python.

#![cfg_attr(not(test), warn(clippy::cast_possible_truncation))]

pub mod bits;
pub mod color;
pub mod distributions;
pub mod fingerprint;
pub mod log_sums;
pub mod polygon;
pub mod portable;
pub mod rounding;
pub mod scalar;
pub mod special;
pub mod streams;
pub mod total;
pub mod vector;

pub use distributions::{
    BadParameter, COORDINATES, Dist, Draw, Family, Interval, LEAST, MOST_NUMBERS, Param, Parameter, Placed,
    Space, Support, logistic,
};
pub use rounding::grid;
pub use scalar::{LastLog, LastLogs, Logs, Scalar};
pub use streams::{RngCore, Stream, StreamKey};
pub use total::Total;
pub use vector::{Mat3, Vec3, vec3};

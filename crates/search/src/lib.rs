//! Searches: methods as data, and what is built of several.
//!
//! * [`method`]: a search as data;
//! * [`direct`]: methods that are neither chains nor populations: annealed importance sampling, chains that follow a slope, normals;
//! * [`nested`]: inference inside a model;
//! * [`improve`]: a search for the best, by all of these;
//! * [`learn`]: training of guides.

pub mod direct;
pub mod improve;
pub mod learn;
pub mod method;
pub mod nested;

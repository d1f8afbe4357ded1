//! Searches: methods as data, and methods that combine others.
//!
//! * [`method`]: a search as data;
//! * [`direct`]: methods other than chains and populations: annealed importance sampling, chains that follow a slope, normals;
//! * [`nested`]: inference inside a model;
//! * [`improve`]: a search for the best run, which combines these methods;
//! * [`learn`]: training of guides.

pub mod direct;
pub mod improve;
pub mod learn;
pub mod method;
pub mod nested;

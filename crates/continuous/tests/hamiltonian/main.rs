//! Gradient samplers draw from the density that they are given: kernels exactly, whole chains within their error.
//!
//! * `densities`: bounded, simplex and hierarchical models written by hand, with their Jacobians;
//! * `kernels`: one transition leaves the target as it is (Gandy & Scott 2020), and mutants do not;
//! * `calibration`: warm-up and all, ranks are uniform (Talts et al. 2018);
//! * `known`: means that are known by conjugacy or quadrature;
//! * `lanes`: chains in lanes are chains alone, to the bit;
//! * `ranks`: the statistics that all of them use.

mod calibration;
mod densities;
mod kernels;
mod known;
mod lanes;
mod ranks;

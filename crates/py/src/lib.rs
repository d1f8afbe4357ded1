//! The binding between Python and the engine: the only crate that knows Python.
//!
//! One file for each part; this file only registers them.
//!
//! * `values`: Python's objects to the machine's values, and back; `faults`: faults as data;
//! * `model`: compiled models; `hosts`: the Python that they call; `search`: algorithms; `chains`: Markov chains;
//!   `runs`: finished runs; `gradients`: log densities with their gradients; `positions`: where shapes are, with theirs;
//!   `trajectories`: chains that follow them; `normals`: normals near a distribution;
//!   `networks`: networks of guides, for a comparison with other software;
//! * `machine`: what the engine finds on this machine; `threads`: the pools of threads;
//!   `shared`: values that several threads of Python use;
//! * `checkpoints`: what a search needs to go on after it was killed;
//! * `distributions`, `geometry`, `views`, `pictures`: parts of the lower crates.

#![cfg_attr(not(test), warn(clippy::cast_possible_truncation))]

mod chains;
mod checkpoints;
mod distributions;
mod faults;
mod forks;
mod geometry;
mod gradients;
mod guides;
mod hosts;
mod machine;
mod model;
mod networks;
mod normals;
mod pictures;
mod positions;
mod runs;
mod search;
mod shared;
mod threads;
mod trajectories;
mod values;
mod views;

use pyo3::prelude::*;

/// Searches copy many small objects on several threads, where the system's allocator is slow.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The compiled engine, imported by the package as `niwaki._engine`.
#[pymodule]
fn _engine(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    distributions::register(module)?;
    geometry::register(module)?;
    gradients::register(module)?;
    guides::register(module)?;
    machine::register(module)?;
    pictures::register(module)?;
    positions::register(module)?;
    views::register(module)?;
    values::register(module)?;
    faults::register(module)?;
    model::register(module)?;
    networks::register(module)?;
    normals::register(module)?;
    runs::register(module)?;
    search::register(module)?;
    chains::register(module)?;
    checkpoints::register(module)?;
    trajectories::register(module)
}

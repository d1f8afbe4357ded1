//! The binding between Python and the engine: the only crate that knows Python.
//!
//! This file registers the parts; each part is a file.
//!
//! * `values`: Python's objects to the machine's values, and back; `faults`: faults as data;
//! * `model`: compiled models; `hosts`: the Python that they call; `search`: algorithms; `chains`: Markov chains;
//!   `runs`: finished runs; `gradients`: log densities with gradients; `positions`: places of shapes with derivatives;
//!   `trajectories`: chains that follow a gradient; `normals`: normals near a distribution;
//!   `fits`: proposers of points for models of somebody else;
//!   `networks`: networks of guides, for a comparison with other software;
//! * `machine`: abilities of this machine; `threads`: the pools of threads;
//!   `shared`: values that several threads of Python use;
//! * `checkpoints`: parts from which a search resumes;
//! * `distributions`, `geometry`, `views`, `pictures`: parts of the lower crates.

#![cfg_attr(not(test), warn(clippy::cast_possible_truncation))]

mod chains;
mod checkpoints;
mod distributions;
mod faults;
mod fits;
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
    fits::register(module)?;
    model::register(module)?;
    networks::register(module)?;
    normals::register(module)?;
    runs::register(module)?;
    search::register(module)?;
    chains::register(module)?;
    checkpoints::register(module)?;
    trajectories::register(module)
}

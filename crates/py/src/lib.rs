//! The door between Python and the engine: the only crate that knows Python.
//!
//! One file for each room behind the door; this one only registers them.

mod geometry;
mod pictures;

use pyo3::prelude::*;

/// The compiled engine, imported by the package as `niwaki._engine`.
#[pymodule]
fn _engine(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    geometry::register(module)?;
    pictures::register(module)?;
    Ok(())
}

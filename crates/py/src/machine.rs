//! Abilities of this machine, for `niwaki doctor`: threads, vector instructions, machine code.

use crate::threads::Pool;
use niwaki_grad::kernels::Vectors;
use niwaki_grad::{Density, Graph, Native};
use pyo3::prelude::*;

/// The number of threads of a search; the vector instructions of gradients: `AVX-512`, `AVX2`, or `any` for
/// those of any processor; whether gradients are compiled to machine code.
#[pyfunction]
fn machine(py: Python<'_>) -> PyResult<(usize, &'static str, bool)> {
    let pool = Pool::borrow(py, None)?;
    let threads = pool.count();
    pool.give_back(py);
    let vectors = match Vectors::here() {
        Vectors::Avx512 => "AVX-512",
        Vectors::Avx2 => "AVX2",
        Vectors::Any => "any",
    };
    Ok((threads, vectors, compiles()))
}

/// Whether machine code can be made here; tries the density x² of one number.
fn compiles() -> bool {
    let mut graph = Graph::new();
    let x = graph.input();
    let value = graph.mul(x, x);
    Native::compile(&Density::new(graph, value, &[])).is_ok()
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(machine, module)?)
}

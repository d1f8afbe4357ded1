//! What the engine finds on this machine, for `niwaki doctor`: threads, vectors, machine code.

use crate::threads::Pool;
use niwaki_grad::kernels::Vectors;
use niwaki_grad::{Density, Graph, Native};
use pyo3::prelude::*;

/// How many threads a search takes, and the vector instructions that gradients use: `AVX-512`, `AVX2`, or `any` for
/// those of any processor; and whether gradients are compiled to machine code here.
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

/// Whether machine code can be made here: by the density x² of one number. The processor or the system may say no.
fn compiles() -> bool {
    let mut graph = Graph::new();
    let x = graph.input();
    let value = graph.mul(x, x);
    Native::compile(&Density::new(graph, value, &[])).is_ok()
}

/// Puts this part into the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(machine, module)?)
}

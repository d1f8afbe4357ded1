//! Kernels through the door: nested tuples, the name first.

use crate::faults;
use crate::search::PyTask;
use niwaki_infer::chain::kernel::{Kernel, Selection};
use niwaki_infer::chain::user::User;
use niwaki_infer::hamiltonian::chains::Length;
use niwaki_vm::fault::Fault;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::sync::Arc;

/// The kernel that a form stands for; `task` is where faults are told from.
pub fn kernel(task: &PyTask, form: &Bound<'_, PyAny>) -> PyResult<Kernel> {
    let py = form.py();
    let form = form.cast::<PyTuple>()?;
    let name: String = form.get_item(0)?.extract()?;
    let inner = |i: usize| kernel(task, &form.get_item(i)?);
    Ok(match name.as_str() {
        "prior" => Kernel::Prior,
        "drift" => Kernel::Drift { step: form.get_item(1)?.extract()?, target: form.get_item(2)?.extract()? },
        "by_family" => Kernel::ByFamily,
        "neighbour" => Kernel::Neighbour { reach: form.get_item(1)?.extract()? },
        "block" => Kernel::Block {
            step: form.get_item(1)?.extract()?,
            share: form.get_item(2)?.extract()?,
            target: form.get_item(3)?.extract()?,
        },
        "regenerate" => Kernel::Regenerate { levels: form.get_item(1)?.extract()? },
        "hmc" => Kernel::Trajectory {
            step: form.get_item(1)?.extract()?,
            length: Length::Fixed {
                steps: form.get_item(2)?.extract()?,
                jitter: form.get_item(3)?.extract()?,
            },
            target: form.get_item(4)?.extract()?,
        },
        "nuts" => Kernel::Trajectory {
            step: form.get_item(1)?.extract()?,
            length: Length::NoUTurn { max_depth: form.get_item(2)?.extract()? },
            target: form.get_item(3)?.extract()?,
        },
        "proposal" => {
            let own: Bound<'_, PyTask> = form.get_item(1)?.extract()?;
            let user = User::new(own.get().task.clone());
            Kernel::User(Arc::new(
                user.map_err(|fault| faults::raise(py, &fault.into(), &task.task.program))?,
            ))
        }
        "cycle" => {
            let parts: Vec<Bound<'_, PyAny>> = form.get_item(1)?.extract()?;
            Kernel::Cycle(parts.iter().map(|part| kernel(task, part)).collect::<PyResult<_>>()?)
        }
        "mixture" => {
            let parts: Vec<(f64, Bound<'_, PyAny>)> = form.get_item(1)?.extract()?;
            let part = |(weight, part): &(f64, Bound<'_, PyAny>)| Ok((*weight, kernel(task, part)?));
            Kernel::Mixture(parts.iter().map(part).collect::<PyResult<_>>()?)
        }
        "repeat" => Kernel::Repeat(form.get_item(1)?.extract()?, Box::new(inner(2)?)),
        "on" => {
            let selection = Selection {
                sites: form.get_item(1)?.extract()?,
                depth: form.get_item(2)?.extract()?,
                odds: form.get_item(3)?.extract()?,
                calls: form.get_item(4)?.extract()?,
            };
            Kernel::On(selection, Box::new(inner(5)?))
        }
        "anneal" => Kernel::Anneal {
            hot: form.get_item(1)?.extract()?,
            cold: form.get_item(2)?.extract()?,
            steps: form.get_item(3)?.extract()?,
            kernel: Box::new(inner(4)?),
        },
        other => {
            let fault = Fault::new("bad-kernel", format!("there is no kernel {other:?}"))
                .with_help("see `niwaki.kernels`");
            return Err(faults::raise(py, &fault.into(), &task.task.program));
        }
    })
}

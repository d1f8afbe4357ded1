//! Markov chains behind the door: they stay alive between two calls, so that a search goes on where it stopped.

use crate::outcome::PyOutcome;
use crate::search::{PyTask, detached};
use crate::settings::unknown;
use niwaki_infer::chain::Settings;
use niwaki_infer::chain::counts::{Count, Counts};
use niwaki_infer::chain::many::Chains;
use niwaki_vm::machine::kept::Strategy;
use niwaki_vm::value::Value;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

/// Several chains of one seed.
#[pyclass(frozen, name = "Chains", module = "niwaki._engine")]
pub struct PyChains {
    task: Py<PyTask>,
    chains: Mutex<Chains>,
}

fn strategy(py: Python<'_>, task: &PyTask, name: &str) -> PyResult<Strategy> {
    Ok(match name {
        "rerun" => Strategy::Rerun,
        "resume" => Strategy::Resume,
        "cache" => Strategy::Cache,
        "c3" => Strategy::C3,
        _ => {
            let known = "\"c3\", \"rerun\", \"resume\" or \"cache\"";
            return Err(unknown(py, &task.task.program, "strategy", name, known));
        }
    })
}

#[pymethods]
impl PyChains {
    /// Chains in their first states; ``known`` are first values by hash of the address. ``room`` is the most choices
    /// that the samples of one chain hold together.
    #[new]
    #[pyo3(signature = (task, seed, *, chains=1, strategy="c3", warmup=0, thin=1, room=1 << 22, tries=1000,
                        known=None, threads=None))]
    #[expect(clippy::too_many_arguments, reason = "the settings of the method")]
    fn new(
        py: Python<'_>,
        task: Py<PyTask>,
        seed: u64,
        chains: usize,
        strategy: &str,
        warmup: u64,
        thin: u64,
        room: usize,
        tries: u64,
        known: Option<HashMap<u128, Bound<'_, PyAny>>>,
        threads: Option<usize>,
    ) -> PyResult<PyChains> {
        let own = task.get();
        let settings =
            Settings { seed, strategy: self::strategy(py, own, strategy)?, warmup, thin, room, tries };
        let known = match known {
            None => None,
            Some(given) => {
                let value = |(address, value): (u128, Bound<'_, PyAny>)| {
                    Ok((address, own.model.get().classes.value(&value)?))
                };
                Some(given.into_iter().map(value).collect::<PyResult<HashMap<u128, Value>>>()?)
            }
        };
        let (made, _) = detached(py, &own.task.program, threads, None, |_| {
            Chains::start(&own.task, &settings, chains, known.as_ref())
        })?;
        Ok(PyChains { task, chains: Mutex::new(made) })
    }

    /// Makes ``steps`` proposals in each chain; whether it was interrupted.
    #[pyo3(signature = (steps, threads=None, watch=None))]
    fn advance(
        &self,
        py: Python<'_>,
        steps: u64,
        threads: Option<usize>,
        watch: Option<Py<PyAny>>,
    ) -> PyResult<bool> {
        let task = &self.task.get().task;
        let (stopped, pressed) = detached(py, &task.program, threads, watch.as_ref(), |watch| {
            let mut chains = self.chains.lock().unwrap_or_else(PoisonError::into_inner);
            chains.advance(task, steps, &|done, best| watch.look(done, 0, best))
        })?;
        Ok(stopped || pressed)
    }

    /// The best state of each chain.
    fn best(&self) -> Vec<PyOutcome> {
        let (program, chains) = (&self.task.get().task.program, self.lock());
        let best = chains.chains.iter().map(|chain| chain.harvest.best(&chain.state, program));
        best.map(|snapshot| self.outcome(&snapshot)).collect()
    }

    /// The samples of a chain from the ``start``-th on: (number of proposals before it, outcome).
    #[pyo3(signature = (chain, start=0))]
    fn samples(&self, chain: usize, start: usize) -> Vec<(u64, PyOutcome)> {
        let chains = self.lock();
        let Some(chain) = chains.chains.get(chain) else { return vec![] };
        chain.harvest.samples.iter().skip(start).map(|s| (s.facts.visit, self.outcome(s))).collect()
    }

    /// The present state of each chain.
    fn now(&self) -> Vec<PyOutcome> {
        let (program, chains) = (&self.task.get().task.program, self.lock());
        chains.chains.iter().map(|chain| self.outcome(&chain.now(program))).collect()
    }

    /// Proposals between two samples, of each chain.
    fn thin(&self) -> Vec<u64> {
        self.lock().chains.iter().map(|chain| chain.harvest.thin).collect()
    }

    /// Proposals by site: (function, readable component, line, proposed, accepted, outside the support).
    fn sites(&self) -> Vec<(String, String, u32, u64, u64, u64)> {
        let (program, chains) = (&self.task.get().task.program, self.lock());
        let mut all = Counts::new(program);
        for chain in &chains.chains {
            for (sum, count) in all.sites.iter_mut().zip(&chain.counts.sites) {
                *sum += *count;
            }
        }
        let row =
            |(f, c, line, n): (String, String, u32, Count)| (f, c, line, n.proposed, n.accepted, n.outside);
        all.named(program).into_iter().map(row).collect()
    }

    /// Sums over the chains: proposals, activations entered, calls skipped, instructions, and bytes that they hold.
    fn counters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let chains = self.lock();
        let facts = PyDict::new(py);
        let sum = |of: fn(&niwaki_infer::chain::Chain) -> u64| chains.chains.iter().map(of).sum::<u64>();
        facts.set_item("proposals", sum(|c| c.visit()))?;
        facts.set_item("entered", sum(|c| c.state.trace.counters().entered))?;
        facts.set_item("skipped", sum(|c| c.state.trace.counters().skipped))?;
        facts.set_item("instructions", sum(|c| c.state.trace.counters().instructions))?;
        facts.set_item("choices", sum(|c| c.state.trace.len() as u64))?;
        facts.set_item("bytes", sum(|c| c.state.trace.bytes() as u64))?;
        facts.set_item("many_proposed", sum(|c| c.counts.many.proposed))?;
        facts.set_item("many_accepted", sum(|c| c.counts.many.accepted))?;
        Ok(facts)
    }
}

impl PyChains {
    fn lock(&self) -> std::sync::MutexGuard<'_, Chains> {
        self.chains.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn outcome(&self, snapshot: &niwaki_infer::chain::harvest::Snapshot) -> PyOutcome {
        PyOutcome::of_snapshot(snapshot, self.task.get().model.get().classes.clone())
    }
}

/// Puts this room into the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyChains>()
}

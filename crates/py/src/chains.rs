//! Markov chains for Python. They stay alive between two calls, so that a search can continue.

use crate::checkpoints::PyCheckpoint;
use crate::faults;
use crate::runs::PyRun;
use crate::search::{PyTask, detached};
use crate::shared::Shared;
use crate::trajectories::broken_off;
use niwaki_agreement::compare;
use niwaki_chain::explain::Event;
use niwaki_chain::ladder::Ladder;
use niwaki_chain::leaf::trajectory::counts::TrajectoryCounts;
use niwaki_chain::many::Chains;
use niwaki_chain::walk::counts::{Count, Counts};
use niwaki_chain::{Chain, Settings};
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use niwaki_search::method::{Inputs, Method, Mh};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::collections::HashMap;
use std::sync::Arc;

/// Proposals at one site of the program.
#[pyclass(frozen, get_all, name = "Site", module = "niwaki._engine")]
pub struct PySite {
    /// The function.
    function: String,
    /// The readable component.
    site: String,
    /// The line in the source.
    line: u32,
    /// The number of proposals.
    proposed: u64,
    /// The number of accepted proposals.
    accepted: u64,
    /// The number of proposals outside the support of the choice's distribution.
    outside: u64,
}

/// Several chains of one seed.
#[pyclass(frozen, name = "Chains", module = "niwaki._engine")]
pub struct PyChains {
    task: Py<PyTask>,
    chains: Shared<Chains>,
}

#[pymethods]
impl PyChains {
    /// Chains in their first states, by the text of a method; ``start`` has values for their choices.
    /// ``attached`` are the users' proposals and guides that the kernel names by number; ``room`` is the most choices that the
    /// samples of one chain hold together. Chains in the ``checkpoint`` resume.
    #[new]
    #[pyo3(signature = (task, method, seed, *, attached=Vec::new(), room=1 << 22, start=None, threads=None, checkpoint=None))]
    #[expect(clippy::too_many_arguments, reason = "the settings of chains")]
    fn new(
        py: Python<'_>,
        task: Py<PyTask>,
        method: &str,
        seed: u64,
        attached: Vec<Bound<'_, PyAny>>,
        room: usize,
        start: Option<&PyRun>,
        threads: Option<usize>,
        checkpoint: Option<&PyCheckpoint>,
    ) -> PyResult<PyChains> {
        let py_task = task.get();
        let (method, settings, kept) = settings(py, py_task, method, seed, &attached)?;
        let settings = Settings { room, ..settings };
        let known = start.map(PyRun::by_address);
        let checkpoint = checkpoint.map(|stored| &stored.checkpoint);
        let (chains, _) = detached(py, &kept, threads, None, |_| {
            let mut chains = Chains::start_from(&kept, &settings, method.chains, known.as_ref(), checkpoint)?;
            chains.aim_anew(method.steps);
            Ok(chains)
        })?;
        let task = Py::new(py, PyTask { task: kept, model: py_task.model.clone_ref(py) })?;
        Ok(PyChains { task, chains: Shared::new(chains) })
    }

    /// Makes ``steps`` proposals in each chain; by default the proposals of the method that are not made yet. Returns whether
    /// the chains were interrupted.
    #[pyo3(signature = (steps=None, threads=None, watch=None, checkpoint=None))]
    fn advance(
        &self,
        py: Python<'_>,
        steps: Option<u64>,
        threads: Option<usize>,
        watch: Option<Py<PyAny>>,
        checkpoint: Option<&PyCheckpoint>,
    ) -> PyResult<bool> {
        let py_task = self.task.get();
        let (task, classes) = (&py_task.task, &py_task.model.get().classes);
        let caller = watch.as_ref().map(|callable| (callable, classes));
        let checkpoint = checkpoint.map(|stored| &stored.checkpoint);
        let mut using = self.chains.lock(py)?;
        let chains: &mut Chains = &mut using;
        let (stopped, pressed) = detached(py, task, threads, caller, |watch| {
            if let Some(steps) = steps {
                chains.aim(steps);
            }
            chains.go_on(task, &|done, best| watch.look(done, 0, best), checkpoint)
        })?;
        Ok(stopped || pressed)
    }

    /// Refuses chains whose user is gone: see [`Shared::check`].
    fn check(&self, py: Python<'_>) -> PyResult<()> {
        self.chains.check(py)
    }

    /// The best state of each chain.
    fn best(&self, py: Python<'_>) -> PyResult<Vec<PyRun>> {
        let (task, using) = (&self.task.get().task, self.chains.lock(py)?);
        let chains: &Chains = &using;
        let (best, _) = detached(py, task, None, None, |_| {
            let rungs = chains.chains.iter().filter_map(Ladder::best);
            rungs.map(|rung| rung.best.get(&rung.state, task)).collect::<Result<Vec<_>, _>>()
        })?;
        Ok(best.into_iter().map(|run| self.run(Arc::new(run))).collect())
    }

    /// The samples of each chain.
    fn samples(&self, py: Python<'_>) -> PyResult<Vec<Vec<PyRun>>> {
        let chains = self.chains.lock(py)?;
        let first = chains.chains.iter().filter_map(|ladder| ladder.rungs.first());
        Ok(first.map(|rung| rung.samples.all.iter().map(|run| self.run(run.clone())).collect()).collect())
    }

    /// The present state of each chain.
    fn now(&self, py: Python<'_>) -> PyResult<Vec<PyRun>> {
        let (program, chains) = (&self.task.get().task.program, self.chains.lock(py)?);
        let first = chains.chains.iter().filter_map(|ladder| ladder.rungs.first());
        Ok(first.map(|rung| self.run(Arc::new(rung.now(program)))).collect())
    }

    /// The number of proposals between two samples, by chain.
    fn thin(&self, py: Python<'_>) -> PyResult<Vec<u64>> {
        let chains = self.chains.lock(py)?;
        Ok(chains.chains.iter().filter_map(|ladder| Some(ladder.rungs.first()?.samples.thin)).collect())
    }

    /// Exchanges between neighbouring powers in all chains: (proposed, accepted).
    fn exchanges(&self, py: Python<'_>) -> PyResult<Vec<(u64, u64)>> {
        let chains = self.chains.lock(py)?;
        let mut all = vec![(0, 0); chains.chains.first().map_or(0, |ladder| ladder.exchanges.len())];
        for ladder in &chains.chains {
            for (sum, exchange) in all.iter_mut().zip(&ladder.exchanges) {
                *sum = (sum.0 + exchange.0, sum.1 + exchange.1);
            }
        }
        Ok(all)
    }

    /// Proposals of all chains by site.
    fn sites(&self, py: Python<'_>) -> PyResult<Vec<PySite>> {
        let (program, chains) = (&self.task.get().task.program, self.chains.lock(py)?);
        let mut all = Counts::new(program);
        for chain in chains.chains.iter().flat_map(|ladder| &ladder.rungs) {
            for (sum, count) in all.sites.iter_mut().zip(&chain.counts.sites) {
                *sum += *count;
            }
        }
        let site = |(function, site, line, Count { proposed, accepted, outside })| PySite {
            function,
            site,
            line,
            proposed,
            accepted,
            outside,
        };
        Ok(all.named(program).into_iter().map(site).collect())
    }

    /// Statistics of each leaf of the kernel that follows the gradient, in order, for all chains and powers: a dict with
    /// ``made``, ``moved``, ``unwritten``, ``settled`` (after the warm-up), ``acceptance`` (their mean), ``gradients``,
    /// ``structures``, ``recordings``, ``divergences`` (see [`broken_off`]), ``warmup_divergences``; ``step``, by chain;
    /// and ``fault``, an exception or None.
    fn trajectories<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let (program, chains) = (&self.task.get().task.program, self.chains.lock(py)?);
        let mut all: Vec<(TrajectoryCounts, Vec<f64>, u64, u64)> = Vec::new();
        for chain in chains.chains.iter().flat_map(|ladder| &ladder.rungs) {
            for (leaf, (counts, step, (structures, recordings))) in chain.trajectories().enumerate() {
                if all.len() == leaf {
                    all.push((TrajectoryCounts::default(), vec![], 0, 0));
                }
                let sum = &mut all[leaf];
                sum.0 += counts;
                sum.1.push(step);
                (sum.2, sum.3) = (sum.2 + structures, sum.3 + recordings);
            }
        }
        let row = |(counts, steps, structures, recordings): (TrajectoryCounts, Vec<f64>, u64, u64)| {
            let facts = PyDict::new(py);
            facts.set_item("made", counts.transitions)?;
            facts.set_item("moved", counts.moved)?;
            facts.set_item("unwritten", counts.unwritten)?;
            facts.set_item("settled", counts.settled)?;
            facts.set_item("acceptance", counts.accept / counts.settled as f64)?;
            facts.set_item("gradients", counts.gradients)?;
            facts.set_item("structures", structures)?;
            facts.set_item("recordings", recordings)?;
            facts.set_item("divergences", broken_off(py, &counts.broken)?)?;
            facts.set_item("warmup_divergences", counts.broken.in_warmup)?;
            facts.set_item("step", PyTuple::new(py, steps)?)?;
            facts.set_item(
                "fault",
                counts.fault.map(|fault| faults::raise(py, &Failure::Run(fault), program)),
            )?;
            Ok(facts)
        };
        all.into_iter().map(row).collect()
    }

    /// Sums over the chains: proposals, activations entered, calls skipped, instructions, primitives removed from the scene
    /// or added to it (`moved`); primitives, choices and bytes of the states.
    fn counters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let chains = self.chains.lock(py)?;
        let facts = PyDict::new(py);
        let sum = |of: fn(&Chain) -> u64| {
            chains.chains.iter().flat_map(|ladder| &ladder.rungs).map(of).sum::<u64>()
        };
        facts.set_item("proposals", sum(|c| c.visit()))?;
        facts.set_item("entered", sum(|c| c.state.trace.counters().entered))?;
        facts.set_item("skipped", sum(|c| c.state.trace.counters().skipped))?;
        facts.set_item("instructions", sum(|c| c.state.trace.counters().instructions))?;
        facts.set_item("moved", sum(|c| c.state.moved))?;
        facts.set_item("primitives", sum(|c| c.state.primitives as u64))?;
        facts.set_item("choices", sum(|c| c.state.trace.len() as u64))?;
        facts.set_item("bytes", sum(|c| c.state.trace.bytes() as u64))?;
        facts.set_item("many_proposed", sum(|c| c.counts.many.proposed))?;
        facts.set_item("many_accepted", sum(|c| c.counts.many.accepted))?;
        Ok(facts)
    }
}

/// Reads Metropolis-Hastings from a text: the method, the settings of its chains, and the task with the variables of proposals.
fn settings(
    py: Python<'_>,
    task: &PyTask,
    method: &str,
    seed: u64,
    attached: &[Bound<'_, PyAny>],
) -> PyResult<(Mh, Settings, Task)> {
    let (kept, attached) = task.attach(py, attached)?;
    let Method::Mh(method) = task.read(py, method)? else {
        return Err(PyTypeError::new_err("this method is not Metropolis-Hastings"));
    };
    let settings = method.settings(&Inputs { seed, attached: &attached, ..Inputs::default() });
    let settings = settings.map_err(|fault| faults::setting(py, &fault))?;
    Ok((method, settings, kept))
}

/// Runs ``steps`` proposals under each of the four strategies and compares everything to the bit. Returns the first
/// disagreement (or None), and the numbers of proposals of each strategy, of accepted ones, and of those with a fault.
#[pyfunction]
#[pyo3(signature = (task, method, seed, steps, every=20, attached=Vec::new()))]
fn agreement(
    py: Python<'_>,
    task: &Bound<'_, PyTask>,
    method: &str,
    seed: u64,
    steps: u64,
    every: u64,
    attached: Vec<Bound<'_, PyAny>>,
) -> PyResult<(Option<String>, u64, u64, u64)> {
    let py_task = task.get();
    let (_, settings, kept) = settings(py, py_task, method, seed, &attached)?;
    let settings = Settings { thin: 0, ..settings };
    let ((difference, compared), _) =
        detached(py, &kept, None, None, |_| compare(&kept, &settings, steps, every.max(1)))?;
    Ok((difference, compared.proposals, compared.accepted, compared.faults))
}

/// Makes one proposal to the choice at ``address`` by each strategy: a dict with ``activations`` (label, function, depth,
/// number of the caller), ``home``, ``path``, ``old``, ``new``, and ``runs`` by strategy: the events (name, number of the
/// activation), in order, and whether the run came to its end.
#[pyfunction]
#[pyo3(signature = (task, seed, address, tries=1000))]
fn explain<'py>(
    py: Python<'py>,
    task: &Bound<'py, PyTask>,
    seed: u64,
    address: &str,
    tries: u64,
) -> PyResult<Bound<'py, PyDict>> {
    let py_task = task.get();
    let (explained, _) = detached(py, &py_task.task, None, None, |_| {
        niwaki_chain::explain::explain(&py_task.task, seed, tries, address)
    })?;
    let number: HashMap<u128, usize> =
        explained.activations.iter().enumerate().map(|(i, a)| (a.key, i)).collect();
    let facts = PyDict::new(py);
    let rows = explained
        .activations
        .iter()
        .map(|a| (a.label.clone(), a.function.clone(), a.depth, number.get(&a.parent).copied()));
    facts.set_item("activations", rows.collect::<Vec<_>>())?;
    facts.set_item("home", explained.home)?;
    facts.set_item("path", &explained.path)?;
    facts.set_item("old", py_task.model.get().classes.object(py, &explained.old)?)?;
    facts.set_item("new", py_task.model.get().classes.object(py, &explained.new)?)?;
    let runs = PyDict::new(py);
    for run in explained.runs {
        let name = |event: Event| match event {
            Event::Created => "made",
            Event::Invoked => "invoked",
            Event::Unwound => "unwound",
            Event::Skipped => "skipped",
            Event::Removed => "removed",
        };
        let steps: Vec<(&str, usize)> = run.steps.iter().map(|(event, at)| (name(*event), *at)).collect();
        runs.set_item(run.strategy.name(), (steps, run.is_complete))?;
    }
    facts.set_item("runs", runs)?;
    Ok(facts)
}

impl PyChains {
    fn run(&self, run: Arc<Run>) -> PyRun {
        PyRun::new(run, self.task.get().model.get().classes.clone())
    }
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyChains>()?;
    module.add_class::<PySite>()?;
    module.add_function(wrap_pyfunction!(agreement, module)?)?;
    module.add_function(wrap_pyfunction!(explain, module)?)
}

//! Searches behind the door: a task and the algorithms that answer it.
//!
//! The interpreter's lock is released while the engine works. Whoever watches is called every [`PAUSE`]; if that
//! raises `KeyboardInterrupt` (or Ctrl-C was pressed), the search stops at its next barrier and gives what it has.

use crate::faults;
use crate::geometry::PySketchSpec;
use crate::gradients::PyDensity;
use crate::kernels::kernel;
use crate::model::PyProgram;
use crate::outcome::{PyOutcome, PyTrace};
use crate::settings::{At, Way, Words, settings, unknown};
use niwaki_infer::chain::counts::Count;
use niwaki_infer::enumeration::enumerate;
use niwaki_infer::forward::{Sample, forward};
use niwaki_infer::gradient::live;
use niwaki_infer::importance::importance;
use niwaki_infer::nested::Method;
use niwaki_infer::particles::{
    self, Ancestors, Chain, Progress, Rejuvenation, Walks, particle_gibbs, pimh, populations, within,
};
use niwaki_infer::rejection::rejection;
use niwaki_infer::replay::{Missing, Source, replay};
use niwaki_infer::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::machine::Limits;
use niwaki_vm::value::{Closure, Value};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::collections::{BTreeMap, HashMap};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time between two calls of whoever watches.
const PAUSE: Duration = Duration::from_millis(50);

/// What a search tells whoever watches, and whether it should stop.
#[derive(Default)]
pub(crate) struct Watch {
    stop: AtomicBool,
    /// Done, ended, best log score.
    now: Mutex<(u64, usize, f64)>,
}

impl Watch {
    /// Notes how far the search is; whether to go on.
    pub(crate) fn look(&self, done: u64, ended: usize, best: f64) -> bool {
        *self.now.lock().unwrap_or_else(PoisonError::into_inner) = (done, ended, best);
        !self.stop.load(Ordering::Relaxed)
    }

    /// Looks for Ctrl-C and calls `callable(done, ended, best)`, on the thread that Python lent us: only there are
    /// signals seen.
    fn tell(&self, callable: Option<&Py<PyAny>>) -> Result<(), PyErr> {
        let now = *self.now.lock().unwrap_or_else(PoisonError::into_inner);
        Python::attach(|py| {
            py.check_signals()?;
            callable.map_or(Ok(()), |c| c.call1(py, now).map(|_| ()))
        })
    }
}

/// Runs `work` without the interpreter's lock on a thread of its own, its parallel parts on so many threads (`None`:
/// all of the machine's); meanwhile this thread watches. Also answers whether Ctrl-C was pressed, be it too late to
/// stop anything.
pub(crate) fn detached<T: Send>(
    py: Python<'_>,
    program: &Program,
    threads: Option<usize>,
    callable: Option<&Py<PyAny>>,
    work: impl FnOnce(&Watch) -> Result<T, Failure> + Send,
) -> PyResult<(T, bool)> {
    let pool = match threads {
        Some(n) => Some(
            rayon::ThreadPoolBuilder::new()
                .num_threads(n.max(1))
                .build()
                .map_err(|error| PyRuntimeError::new_err(error.to_string()))?,
        ),
        None => None,
    };
    let (watch, mut raised) = (Watch::default(), None);
    let done = py.detach(|| {
        std::thread::scope(|scope| {
            let (finished, wait) = channel::<()>();
            let (watch, pool) = (&watch, &pool);
            let worker = scope.spawn(move || {
                let _dropped_at_the_end = finished;
                match pool {
                    Some(pool) => pool.install(|| work(watch)),
                    None => work(watch),
                }
            });
            while let Err(RecvTimeoutError::Timeout) = wait.recv_timeout(PAUSE) {
                if raised.is_none()
                    && let Err(error) = watch.tell(callable)
                {
                    raised = Some(error);
                    watch.stop.store(true, Ordering::Relaxed);
                }
            }
            worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        })
    });
    // However short the search was, whoever watches is told how it ended.
    if raised.is_none() && done.is_ok() {
        raised = watch.tell(callable).err();
    }
    let pressed = raised.is_some();
    match raised {
        // Stopped by Ctrl-C: what was found is a result.
        Some(error) if done.is_err() || !error.is_instance_of::<PyKeyboardInterrupt>(py) => Err(error),
        _ => done.map(|found| (found, pressed)).map_err(|failure| faults::raise(py, &failure, program)),
    }
}

/// A model with its arguments and the sketches that score its scene.
#[pyclass(frozen, name = "Task", module = "niwaki._engine")]
pub struct PyTask {
    pub(crate) task: Task,
    pub(crate) model: Py<PyProgram>,
}

#[pymethods]
impl PyTask {
    /// ``max_steps`` bounds one run, ``max_memory`` (bytes) a run or a whole population.
    #[new]
    #[pyo3(signature = (program, args=Vec::new(), sketches=Vec::new(), max_steps=20_000_000, max_memory=1 << 30))]
    fn new(
        py: Python<'_>,
        program: Py<PyProgram>,
        args: Vec<Bound<'_, PyAny>>,
        sketches: Vec<PySketchSpec>,
        max_steps: u64,
        max_memory: usize,
    ) -> PyResult<PyTask> {
        let own = program.get();
        let values: Vec<Value> = args.iter().map(|a| own.classes.value(a)).collect::<PyResult<_>>()?;
        let limits = Limits { steps: max_steps, bytes: max_memory };
        let task = Task {
            program: own.program.clone(),
            model: None,
            args: values,
            sketches: sketches.into_iter().map(|s| s.0).collect(),
            hosts: own.hosts(limits),
            limits,
            invalid: Arc::default(),
        };
        Ok(PyTask { task, model: program.clone_ref(py) })
    }

    /// The same task, with no run counted yet.
    fn uncounted(&self, py: Python<'_>) -> PyTask {
        PyTask { task: self.task.uncounted(), model: self.model.clone_ref(py) }
    }

    /// Runs of its searches in which a distribution was invalid, by the distribution and its line.
    fn invalid(&self) -> BTreeMap<String, u64> {
        self.task.invalid.counts().into_iter().collect()
    }

    /// ``n`` forward runs: one outcome each.
    #[pyo3(signature = (seed, n=1, watch=None))]
    fn forward(
        &self,
        py: Python<'_>,
        seed: u64,
        n: u64,
        watch: Option<Py<PyAny>>,
    ) -> PyResult<Vec<PyOutcome>> {
        let run = |stream| forward(&self.task, seed, stream, true);
        let samples = if n == 1 {
            vec![self.at_once(py, || run(0))?]
        } else {
            detached(py, &self.task.program, None, watch.as_ref(), |watch| {
                let mut samples = Vec::new();
                while (samples.len() as u64) < n && watch.look(samples.len() as u64, 0, f64::NEG_INFINITY) {
                    samples.push(run(samples.len() as u64)?);
                }
                Ok(samples)
            })?
            .0
        };
        Ok(self.outcomes(samples, true, |_| 0.0))
    }

    /// ``([(value, log probability)], log evidence, number of runs)``; probabilities are not normalised.
    #[pyo3(signature = (max_runs, watch=None))]
    fn enumerate<'py>(
        &self,
        py: Python<'py>,
        max_runs: usize,
        watch: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let (found, _) = detached(py, &self.task.program, None, watch.as_ref(), |watch| {
            enumerate(&self.task, max_runs, &mut |runs| watch.look(runs as u64, 0, f64::NEG_INFINITY))
        })?;
        let pair = |(value, log): &(Value, f64)| Ok((self.object(py, value)?, *log));
        let outcomes = found.outcomes.iter().map(pair).collect::<PyResult<Vec<_>>>()?;
        (outcomes, found.log_evidence, found.runs).into_pyobject(py)
    }

    /// ``(outcomes, number of tries, whether it was interrupted)``.
    #[pyo3(signature = (n, bound, max_tries, seed, watch=None))]
    fn rejection(
        &self,
        py: Python<'_>,
        n: usize,
        bound: f64,
        max_tries: u64,
        seed: u64,
        watch: Option<Py<PyAny>>,
    ) -> PyResult<(Vec<PyOutcome>, u64, bool)> {
        let (found, _) = detached(py, &self.task.program, None, watch.as_ref(), |watch| {
            let mut look = |tries| watch.look(tries, 0, f64::NEG_INFINITY);
            rejection(&self.task, n, bound, max_tries, seed, &mut look)
        })?;
        Ok((self.outcomes(found.samples, false, |_| 0.0), found.tries, found.interrupted))
    }

    /// ``(outcomes, log evidence)``; each outcome's weight is its score.
    #[pyo3(signature = (n, seed, threads=None, watch=None))]
    fn importance(
        &self,
        py: Python<'_>,
        n: usize,
        seed: u64,
        threads: Option<usize>,
        watch: Option<Py<PyAny>>,
    ) -> PyResult<(Vec<PyOutcome>, f64)> {
        let (found, _) = detached(py, &self.task.program, threads, watch.as_ref(), |watch| {
            importance(&self.task, n, seed, &mut |runs| watch.look(runs as u64, 0, f64::NEG_INFINITY))
        })?;
        Ok((self.outcomes(found.samples, false, |s| s.record.log_score()), found.log_evidence))
    }

    /// Sequential Monte Carlo: a dict with ``particles`` (outcomes), ``log_evidence`` (None where there is none),
    /// ``barriers``, ``steps``, ``resampled``, ``ancestors``, ``plan``, ``died``, ``temperatures``, ``interrupted``.
    /// ``plan`` holds the sizes of the populations; with ``seconds`` the measured costs decide them. ``rejuvenate`` is the
    /// form of a kernel, ``moves`` how many proposals each time, and ``at`` when: a number of barriers, ``"resampled"`` or
    /// ``"end"``; proposals and those kept are told as ``moved``, of particles that ran and of those that had ended.
    /// ``walks`` says how many chains start from the final set, and how many states of each take its place.
    #[pyo3(signature = (plan, seed, *, order="stochastic", weights="ratio", temper=1.0, anneal=None,
                        resampling="systematic", ess=None, rejuvenate=None, moves=1, at=At::Barriers(1), walks=None,
                        seconds=None, threads=None, watch=None))]
    #[expect(clippy::too_many_arguments, reason = "the settings of the method")]
    fn smc<'py>(
        &self,
        py: Python<'py>,
        plan: Vec<usize>,
        seed: u64,
        order: &str,
        weights: &str,
        temper: f64,
        anneal: Option<Way>,
        resampling: &str,
        ess: Option<f64>,
        rejuvenate: Option<Bound<'py, PyAny>>,
        moves: u64,
        at: At,
        walks: Option<(usize, usize)>,
        seconds: Option<f64>,
        threads: Option<usize>,
        watch: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let program = &*self.task.program;
        let particles = plan.first().copied().unwrap_or(1);
        let words = Words { particles, seed, order, weights, temper, anneal, resampling, ess };
        let mut settings = settings(py, program, words)?;
        if let Some(form) = rejuvenate {
            let kernel = kernel(self, &form)?;
            let walks = walks.map(|(chains, draws)| Walks { chains, draws });
            settings.rejuvenate = Some(Rejuvenation { kernel, moves, at: at.moment(py, program)?, walks });
        }
        let (found, pressed) = detached(py, program, threads, watch.as_ref(), |watch| {
            let mut look = |p: Progress| watch.look(p.barriers as u64, p.ended, p.best);
            match seconds {
                Some(time) => {
                    let time = Duration::try_from_secs_f64(time).unwrap_or(Duration::ZERO);
                    within(&self.task, &settings, time, &mut look)
                }
                None => populations(&self.task, &settings, &plan, &mut look),
            }
        })?;
        let facts = PyDict::new(py);
        facts.set_item("log_evidence", found.log_evidence)?;
        facts.set_item("barriers", found.barriers)?;
        facts.set_item("steps", found.steps)?;
        facts.set_item("resampled", found.resampled)?;
        facts.set_item("ancestors", found.ancestors)?;
        facts.set_item("plan", PyTuple::new(py, found.plan)?)?;
        facts.set_item("died", found.died)?;
        facts.set_item("temperatures", PyTuple::new(py, found.temperatures)?)?;
        let pair = |count: Count| (count.proposed, count.accepted);
        facts.set_item("moved", (pair(found.moved.running), pair(found.moved.ended)))?;
        facts.set_item("interrupted", found.interrupted || pressed)?;
        facts.set_item("particles", self.of_particles(found.particles))?;
        Ok(facts)
    }

    /// The value that an ``infer`` of this task gives to the model around it: ``method`` as the front end writes it.
    fn infer<'py>(
        &self,
        py: Python<'py>,
        method: &Bound<'py, PyAny>,
        seed: u64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let read = self.model.get().classes.value(method)?;
        let program = &self.task.program;
        let Some(method) = Method::read(&read) else {
            return Err(unknown(
                py,
                program,
                "method",
                &method.repr()?.to_string(),
                "what the front end writes",
            ));
        };
        let inner = self.model.get().inferences(self.task.limits);
        let entry = Arc::new(Closure { function: program.entry.0, captures: vec![] });
        let value = self.at_once(py, || Ok(inner.infer(&method, &entry, &self.task.args, seed)?))?;
        self.object(py, &value)
    }

    /// Particle Gibbs: a dict with ``particles`` (an outcome for each sweep), ``tries``, ``moves``, ``renewed``,
    /// ``interrupted``. It starts from ``start``, or from a run that SMC finds.
    #[pyo3(signature = (particles, sweeps, seed, *, order="stochastic", temper=1.0, anneal=None, ess=None,
                        ancestors=true, start=None, threads=None, watch=None))]
    #[expect(clippy::too_many_arguments, reason = "the settings of the method")]
    fn particle_gibbs<'py>(
        &self,
        py: Python<'py>,
        particles: usize,
        sweeps: usize,
        seed: u64,
        order: &str,
        temper: f64,
        anneal: Option<Way>,
        ess: Option<f64>,
        ancestors: bool,
        start: Option<Py<PyOutcome>>,
        threads: Option<usize>,
        watch: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (weights, resampling) = ("ratio", "multinomial");
        let words = Words { particles, seed, order, weights, temper, anneal, resampling, ess };
        let settings = settings(py, &self.task.program, words)?;
        let ancestors = if ancestors { Ancestors::Sampled } else { Ancestors::Kept };
        let from = start.map(|start| start.get().entries());
        self.chain(py, threads, watch.as_ref(), |look| {
            particle_gibbs(&self.task, &settings, ancestors, sweeps, from.as_deref(), look)
        })
    }

    /// Particle independent Metropolis-Hastings: as ``particle_gibbs``, and ``log_evidence``.
    #[pyo3(signature = (particles, sweeps, seed, *, order="stochastic", temper=1.0, anneal=None,
                        resampling="systematic", ess=None, threads=None, watch=None))]
    #[expect(clippy::too_many_arguments, reason = "the settings of the method")]
    fn pimh<'py>(
        &self,
        py: Python<'py>,
        particles: usize,
        sweeps: usize,
        seed: u64,
        order: &str,
        temper: f64,
        anneal: Option<Way>,
        resampling: &str,
        ess: Option<f64>,
        threads: Option<usize>,
        watch: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let words = Words { particles, seed, order, weights: "ratio", temper, anneal, resampling, ess };
        let settings = settings(py, &self.task.program, words)?;
        self.chain(py, threads, watch.as_ref(), |look| pimh(&self.task, &settings, sweeps, look))
    }

    /// The log density around the run with these choices, each an address with a value.
    fn density(&self, py: Python<'_>, choices: Vec<(u128, Bound<'_, PyAny>)>) -> PyResult<PyDensity> {
        let own = self.model.get();
        let values = choices
            .into_iter()
            .map(|(address, value)| Ok((address, own.classes.value(&value)?)))
            .collect::<PyResult<HashMap<u128, Value>>>()?;
        let live = self.at_once(py, || live(&self.task, &values))?;
        Ok(PyDensity::new(live, self.task.program.clone(), own.classes.clone()))
    }

    /// Runs once more with the choices of an outcome; one that had not ended as far as its choices go.
    fn trace(&self, py: Python<'_>, outcome: &PyOutcome) -> PyResult<PyTrace> {
        let missing = if outcome.ended() { Missing::Refuse } else { Missing::Stop };
        let source = Source::Addresses(outcome.by_address());
        let classes = &self.model.get().classes;
        let trace = self.at_once(py, || replay(&self.task, source, missing))?;
        PyTrace::new(py, trace, classes)
    }

    /// Runs with the choices of ``choices``, by readable address. Others are drawn from ``seed`` where there is one;
    /// else they are a fault, or with ``partial`` the end of the future that asks.
    #[pyo3(signature = (choices, seed=None, partial=false))]
    fn replay(
        &self,
        py: Python<'_>,
        choices: &Bound<'_, PyDict>,
        seed: Option<u64>,
        partial: bool,
    ) -> PyResult<PyTrace> {
        let classes = &self.model.get().classes;
        let mut paths: HashMap<String, Value> = HashMap::new();
        for (path, value) in choices {
            paths.insert(path.extract()?, classes.value(&value)?);
        }
        let missing = match seed {
            Some(seed) => Missing::Draw { seed, stream: 0 },
            None if partial => Missing::Stop,
            None => Missing::Refuse,
        };
        let trace = self.at_once(py, || replay(&self.task, Source::Paths(&paths), missing))?;
        PyTrace::new(py, trace, classes)
    }
}

impl PyTask {
    /// Runs something short without the interpreter's lock.
    fn at_once<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        py.detach(work).map_err(|failure| faults::raise(py, &failure, &self.task.program))
    }

    /// Runs a chain of whole runs: its facts.
    fn chain<'py>(
        &self,
        py: Python<'py>,
        threads: Option<usize>,
        callable: Option<&Py<PyAny>>,
        work: impl FnOnce(&mut particles::Watch<'_>) -> Result<Chain, Failure> + Send,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (found, pressed) = detached(py, &self.task.program, threads, callable, |watch| {
            work(&mut |p: Progress| watch.look(p.barriers as u64, p.ended, p.best))
        })?;
        let facts = PyDict::new(py);
        facts.set_item("tries", found.tries)?;
        facts.set_item("moves", found.moves)?;
        facts.set_item("renewed", found.renewed)?;
        facts.set_item("log_evidence", found.log_evidence)?;
        facts.set_item("interrupted", found.interrupted || pressed)?;
        facts.set_item("particles", self.of_particles(found.states))?;
        Ok(facts)
    }

    fn of_particles(&self, particles: Vec<particles::Outcome>) -> Vec<PyOutcome> {
        let classes = &self.model.get().classes;
        let made = |p: particles::Outcome| {
            PyOutcome::new(p.record, p.value, p.log_weight, p.has_ended, classes.clone())
        };
        particles.into_iter().map(made).collect()
    }

    fn object<'py>(&self, py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
        self.model.get().classes.object(py, value)
    }

    fn outcomes(
        &self,
        samples: Vec<Sample>,
        complete: bool,
        weight: impl Fn(&Sample) -> f64,
    ) -> Vec<PyOutcome> {
        let classes: &Arc<_> = &self.model.get().classes;
        let made = |sample: Sample| {
            let (log_weight, ended) = (weight(&sample), complete || sample.record.cause.is_none());
            PyOutcome::new(sample.record, sample.value, log_weight, ended, classes.clone())
        };
        samples.into_iter().map(made).collect()
    }
}

/// Puts this room into the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyTask>()
}

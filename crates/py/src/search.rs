//! Searches for Python: a task and the algorithms that answer it.
//!
//! The interpreter's lock is released while the engine works. The callback `watch` is called every [`PAUSE`], and the
//! memory that is left is looked at. If the callback raises `KeyboardInterrupt` (or Ctrl-C was pressed), the search
//! stops at its next barrier and returns its results so far.

use crate::checkpoints::PyCheckpoint;
use crate::faults;
use crate::forks::end_if_forked;
use crate::geometry::PySketchSpec;
use crate::gradients::PyDensity;
use crate::guides::PyGuide;
use crate::hosts::{self, WithProposals};
use crate::model::PyProgram;
use crate::positions::PyPlacer;
use crate::runs::{PyRun, PyTrace};
use crate::threads::Pool;
use crate::values::Classes;
use niwaki_chain::form::{Attached, Form};
use niwaki_chain::leaf::regrow::{Afresh, afresh, is_apart};
use niwaki_chain::walk::counts::Count;
use niwaki_math::log_sums::log_sum_exp;
use niwaki_particles::Share;
use niwaki_propose::gradient::live;
use niwaki_propose::gradient::positions::Placer;
use niwaki_propose::guide::bound::BoundGuide;
use niwaki_propose::user::User;
use niwaki_run::glob;
use niwaki_run::hold::hold;
use niwaki_run::mixed::{Place, mixed};
use niwaki_run::order::Policy;
use niwaki_run::record::Record;
use niwaki_run::replay::{Missing, Source, Trace, replay};
use niwaki_run::run::Shown;
use niwaki_run::setting;
use niwaki_run::{Failure, Task};
use niwaki_search::improve::{Outputs, Round};
use niwaki_search::method;
use niwaki_search::method::{Info, Inputs, Method};
use niwaki_search::nested::Inner;
use niwaki_vm::core::Name;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::invalid::{self, Count as InvalidCount};
use niwaki_vm::machine::{Limits, SharedSteps};
use niwaki_vm::value::{Closure, Value};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use serde::de::DeserializeOwned;
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time between two calls of the callback.
const PAUSE: Duration = Duration::from_millis(50);

/// Progress of a search, and whether it should stop.
#[derive(Default)]
pub(crate) struct Watch {
    stop: AtomicBool,
    /// Done, ended, best log score.
    now: Mutex<(u64, usize, f64)>,
    /// The best run so far, of a search that shows it.
    pub(crate) shown: Shown,
}

/// Callback of a user, with the classes of the model.
pub(crate) type Caller<'a> = (&'a Py<PyAny>, &'a Arc<Classes>);

impl Watch {
    /// Stores the progress of the search; returns whether to go on.
    pub(crate) fn look(&self, done: u64, ended: usize, best: f64) -> bool {
        *self.now.lock().unwrap_or_else(PoisonError::into_inner) = (done, ended, best);
        !self.stop.load(Ordering::Relaxed)
    }

    /// Checks for Ctrl-C and calls `callable(done, ended, best, run)`, on the thread of the Python caller, because only
    /// there are signals handled. The run is the best so far, or `None` where the search does not show it.
    fn tell(&self, caller: Option<Caller<'_>>) -> Result<(), PyErr> {
        let (done, ended, best) = *self.now.lock().unwrap_or_else(PoisonError::into_inner);
        let shown = self.shown.lock().unwrap_or_else(PoisonError::into_inner).clone();
        Python::attach(|py| {
            py.check_signals()?;
            caller.map_or(Ok(()), |(callable, classes)| {
                let run = shown.map(|run| PyRun::new(run, classes.clone()));
                callable.call1(py, (done, ended, best, run)).map(|_| ())
            })
        })
    }
}

/// Refuses to continue if nearly no memory is left, because the system would end the process.
fn check_left() -> PyResult<()> {
    Python::attach(|py| py.import("niwaki.errors.memory")?.call_method0("check_left").map(|_| ()))
}

/// Runs `work` without the interpreter's lock on a pool of `threads` threads (`None`: as many as the machine has);
/// meanwhile this thread watches. Also returns whether Ctrl-C was pressed, even if that was too late to stop anything.
///
/// A callback that forks may not come back in the child, where the search does not go on: the child then ends.
pub(crate) fn detached<T: Send>(
    py: Python<'_>,
    task: &Task,
    threads: Option<usize>,
    caller: Option<Caller<'_>>,
    work: impl FnOnce(&Watch) -> Result<T, Failure> + Send,
) -> PyResult<(T, bool)> {
    let pool = Pool::borrow(py, threads)?;
    let (watch, mut raised, process) = (Watch::default(), None, std::process::id());
    let done = py.detach(|| {
        let (finished, wait) = channel::<()>();
        let (watch, raised) = (&watch, &mut raised);
        let working = move || {
            let _dropped_at_the_end = finished;
            work(watch)
        };
        pool.beside(working, move || {
            while let Err(RecvTimeoutError::Timeout) = wait.recv_timeout(PAUSE) {
                if raised.is_none()
                    && let Err(error) = (hosts::check(&*task.hosts))
                        .and_then(|()| watch.tell(caller))
                        .and_then(|()| check_left())
                {
                    *raised = Some(error);
                    watch.stop.store(true, Ordering::Relaxed);
                }
                end_if_forked(process, "`progress`");
            }
        })
    });
    pool.give_back(py);
    let done = done.ok_or_else(|| PyRuntimeError::new_err("the search ended without a result"))?;
    if raised.is_none() {
        raised = hosts::check(&*task.hosts).err();
    }
    // The callback gets the final progress, however short the search was.
    if raised.is_none() && done.is_ok() {
        raised = watch.tell(caller).err();
    }
    let pressed = raised.is_some();
    match raised {
        // Stopped by Ctrl-C: the results so far are returned.
        Some(error) if done.is_err() || !error.is_instance_of::<PyKeyboardInterrupt>(py) => Err(error),
        _ => {
            done.map(|result| (result, pressed)).map_err(|failure| faults::raise(py, &failure, &task.program))
        }
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
    /// ``max_steps`` bounds one run, ``max_memory`` (bytes) a run, a whole population or several chains together.
    #[new]
    #[pyo3(signature = (program, args=Vec::new(), sketches=Vec::new(), max_steps=Limits::default().steps, max_memory=Limits::default().bytes))]
    fn new(
        py: Python<'_>,
        program: Py<PyProgram>,
        args: Vec<Bound<'_, PyAny>>,
        sketches: Vec<PySketchSpec>,
        max_steps: u64,
        max_memory: usize,
    ) -> PyResult<PyTask> {
        let model = program.get();
        let values: Vec<Value> = args.iter().map(|a| model.classes.value(a)).collect::<PyResult<_>>()?;
        let limits = Limits { steps: max_steps, bytes: max_memory };
        let task = Task {
            program: model.program.clone(),
            model: None,
            args: values,
            held: None,
            sketches: sketches.into_iter().map(|s| s.0).collect(),
            hosts: model.hosts(limits),
            limits,
            together: None,
            invalid: Arc::default(),
        };
        Ok(PyTask { task, model: program.clone_ref(py) })
    }

    /// Copies the task with held choices: ``lock`` has their values by readable address.
    fn holding(&self, py: Python<'_>, lock: &Bound<'_, PyDict>) -> PyResult<PyTask> {
        let mut choices: Vec<(String, Value)> = Vec::new();
        for (path, value) in lock {
            choices.push((path.extract()?, self.model.get().classes.value(&value)?));
        }
        let task = hold(&self.task, choices).map_err(|fault| faults::setting(py, &fault))?;
        Ok(PyTask { task, model: self.model.clone_ref(py) })
    }

    /// Copies the task with fresh counters of invalid runs.
    fn uncounted(&self, py: Python<'_>) -> PyTask {
        PyTask { task: self.task.uncounted(), model: self.model.clone_ref(py) }
    }

    /// Invalid runs of its searches by place: name of the callee, file, line, number, and for one of them the call and why it
    /// has no result.
    fn invalid(&self) -> Vec<(String, String, u32, u64, String, String)> {
        let of = |(place, count): (invalid::Place, InvalidCount)| {
            let file = self.task.program.files.get(place.file as usize).cloned().unwrap_or_default();
            (place.name, file, place.line, count.runs, count.call, count.reason)
        };
        self.task.invalid.counts().into_iter().map(of).collect()
    }

    /// An observation that has a probability in some runs and a density in others, if a few runs from the prior have one: path
    /// and line of each.
    fn mixed(&self, py: Python<'_>, seed: u64) -> PyResult<Option<[(String, u32); 2]>> {
        let task = &self.task;
        let places = py.detach(|| mixed(task, seed));
        hosts::check(&*task.hosts)?;
        let Some(places) = places else { return Ok(None) };
        let place = |(file, span): Place| {
            (task.program.files.get(file as usize).cloned().unwrap_or_default(), span.line)
        };
        Ok(Some([place(places.probability), place(places.density)]))
    }

    /// Whether chains that grow only the activations of choices again cannot reach all runs, as a few from the prior show.
    fn is_apart(&self, py: Python<'_>, seed: u64) -> PyResult<bool> {
        let apart = py.detach(|| is_apart(&self.task, seed));
        hosts::check(&*self.task.hosts)?;
        Ok(apart)
    }

    /// Searches by a method, given as its text: the finished runs, whether the search was interrupted, and a dict of
    /// further results of the method. ``attached`` are the users' proposals and guides that kernels name by number; ``start`` is the
    /// run from which a chain of whole runs or a search for the best starts; the latter resumes from its ``checkpoint``.
    #[pyo3(signature = (method, seed, *, attached=Vec::new(), start=None, threads=None, watch=None, checkpoint=None))]
    #[expect(clippy::too_many_arguments, reason = "the settings of a search")]
    fn search<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        seed: u64,
        attached: Vec<Bound<'py, PyAny>>,
        start: Option<&PyRun>,
        threads: Option<usize>,
        watch: Option<Py<PyAny>>,
        checkpoint: Option<&PyCheckpoint>,
    ) -> PyResult<(Vec<PyRun>, bool, Bound<'py, PyDict>)> {
        let method = self.read(py, method)?;
        let (task, attached) = self.attach(py, &attached)?;
        let classes = self.model.get().classes.clone();
        let start = start.map(PyRun::entries);
        let find = |shown: &Shown, watch: &mut method::Watch<'_>| {
            let outputs =
                Outputs { shown: Some(shown), checkpoint: checkpoint.map(|stored| &stored.checkpoint) };
            let inputs = Inputs { seed, attached: &attached, start: start.as_deref(), outputs };
            method.search(&task, &inputs, watch)
        };
        let (result, pressed) = if let Method::Forward { n: 1 } = method {
            (self.at_once(py, || find(&Shown::default(), &mut |_, _, _| true))?, false)
        } else {
            detached(py, &task, threads, watch.as_ref().map(|call| (call, &classes)), |watch| {
                find(&watch.shown, &mut |done, ended, best| watch.look(done, ended, best))
            })?
        };
        let runs = result.runs.into_iter().map(|run| PyRun::new(Arc::new(run), classes.clone())).collect();
        Ok((runs, result.interrupted || pressed, self.info(py, result.info)?))
    }

    /// The value that an ``infer`` of this task gives to the model around it; ``constant`` as the front end writes it.
    fn infer<'py>(
        &self,
        py: Python<'py>,
        constant: &Bound<'py, PyAny>,
        seed: u64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let program = &self.task.program;
        let read = Inner::read(&self.model.get().classes.value(constant)?);
        let unknown = || Fault::new("infer-method", "this constant is no inference");
        let inner = read.unwrap_or_else(|| Err(unknown())).map_err(|fault| faults::setting(py, &fault))?;
        let inferences = self.model.get().inferences(self.task.limits);
        let entry = Arc::new(Closure { function: program.entry.0, memo: None, captures: vec![] });
        let together = Arc::new(SharedSteps::new(self.task.limits.steps));
        let value =
            self.at_once(py, || Ok(inferences.infer(&inner, &entry, &self.task.args, seed, &together)?))?;
        self.object(py, &value)
    }

    /// Grows the one part of a run that a pattern matches again, by particles; everything else stays as it is. The possible
    /// runs, with their weights.
    #[pyo3(signature = (run, part, particles, power, seed, threads=None))]
    #[expect(clippy::too_many_arguments, reason = "the settings of a search")]
    fn regrow(
        &self,
        py: Python<'_>,
        run: &PyRun,
        part: &str,
        particles: usize,
        power: f64,
        seed: u64,
        threads: Option<usize>,
    ) -> PyResult<Vec<PyRun>> {
        let (task, known) = (&self.task, run.by_address());
        let with = Afresh { part, particles, power, seed };
        let (runs, pressed) = detached(py, task, threads, None, |_| afresh(task, &known, &with))?;
        if pressed {
            return Err(PyKeyboardInterrupt::new_err(()));
        }
        let classes = &self.model.get().classes;
        Ok(runs.into_iter().map(|run| PyRun::new(Arc::new(run), classes.clone())).collect())
    }

    /// The log density around a run.
    fn density(&self, py: Python<'_>, run: &PyRun) -> PyResult<PyDensity> {
        let live = self.at_once(py, || live(&self.task, &run.by_address()))?;
        Ok(PyDensity::new(live, self.task.clone(), self.model.get().classes.clone()))
    }

    /// Placer of the shapes of runs with the choices of this run, some of them moved.
    fn placer(&self, py: Python<'_>, run: &PyRun) -> PyResult<PyPlacer> {
        let placer = Placer::new(&self.task).map_err(|failure| faults::ended(py, &failure, &self.task))?;
        Ok(PyPlacer::new(placer, run.by_address(), self.task.clone(), self.model.clone_ref(py)))
    }

    /// Replays a run with its choices; a run that had not ended is replayed as far as its choices go. The scene is not scored
    /// again: the sketches' score is that of the run.
    fn trace(&self, py: Python<'_>, run: &PyRun) -> PyResult<PyTrace> {
        let mut trace = self.unscored(py, run)?;
        (trace.run.log_score, trace.run.similarity) = run.scores();
        PyTrace::new(py, trace, &self.model.get().classes)
    }

    /// By how much the scene of a run scores better than an empty one, nats; factors and observations left out.
    fn gain(&self, py: Python<'_>, run: &PyRun) -> PyResult<f64> {
        let trace = self.unscored(py, run)?;
        let empty = Record::start(&self.task.sketches).log_score();
        Ok(run.scores().0 - trace.sums.1.value() - empty)
    }

    /// Reads a run from ``Run.data``, without the returned value; ``shift`` is added to its log weight.
    #[pyo3(signature = (data, shift=0.0))]
    fn run_of_data(&self, data: &str, shift: f64) -> PyResult<PyRun> {
        PyRun::of_data(data, shift, self.model.get().classes.clone())
    }

    /// Runs the task with ``choices`` by readable address. ``seed`` draws missing choices; without it
    /// they are a fault, or with ``partial`` the end of their future.
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
        let trace = self.at_once(py, || {
            let outcome = replay(&self.task, Source::Paths(&paths), missing);
            if let Err(Failure::Run(met)) = &outcome {
                self.task.invalid.count(met);
            }
            outcome
        })?;
        PyTrace::new(py, trace, classes)
    }
}

impl PyTask {
    /// Replays a run with its choices, as far as it went, without its scene's score.
    fn unscored(&self, py: Python<'_>, run: &PyRun) -> PyResult<Trace> {
        let missing = if run.went_to_its_end() { Missing::Refuse } else { Missing::Stop };
        let source = Source::Addresses(run.by_address());
        let unscored = Task { sketches: vec![], ..self.task.clone() };
        self.at_once(py, || replay(&unscored, source, missing))
    }

    /// Runs a short function without the interpreter's lock. Only inferences inside of the model are parallel.
    fn at_once<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        let done = if self.model.get().has_inferences() { Pool::inside(py, work)? } else { py.detach(work) };
        done.map_err(|failure| faults::ended(py, &failure, &self.task))
    }

    /// The method of a text.
    pub(crate) fn read(&self, py: Python<'_>, method: &str) -> PyResult<Method> {
        Method::read(method).map_err(|fault| faults::setting(py, &fault))
    }

    /// The task with what kernels name by number: users' proposals, the entry functions of tasks, and guides. Its program
    /// is compiled to keep the variables that these read.
    pub(crate) fn attach(
        &self,
        py: Python<'_>,
        parts: &[Bound<'_, PyAny>],
    ) -> PyResult<(Task, Vec<Attached>)> {
        let (mut attached, mut proposals) = (Vec::new(), Vec::new());
        let mut task = None;
        for part in parts {
            if let Ok(guide) = part.cast::<PyGuide>() {
                let kept = match task.take() {
                    Some(task) => task,
                    None => self.keeping_all(py)?,
                };
                let guide = BoundGuide::new(guide.get().guide.clone(), &kept);
                attached.push(Attached::Guide(Arc::new(guide.map_err(|fault| faults::setting(py, &fault))?)));
                task = Some(kept);
            } else {
                let proposal = &part.cast::<PyTask>()?.get().task;
                proposals.push(proposal.hosts.clone());
                let function = User::new(proposal.clone());
                attached.push(Attached::Function(Arc::new(
                    function.map_err(|fault| faults::setting(py, &fault))?,
                )));
            }
        }
        let mut task = match task {
            Some(task) => task,
            None => self.keeping(py, &attached)?,
        };
        if !proposals.is_empty() {
            task.hosts = Arc::new(WithProposals { model: task.hosts, proposals });
        }
        Ok((task, attached))
    }

    /// The task, its program compiled to keep all variables.
    pub(crate) fn keeping_all(&self, py: Python<'_>) -> PyResult<Task> {
        Ok(Task { program: self.model.get().keeping_all(py)?, ..self.task.clone() })
    }

    /// The task, its program compiled to keep the variables of these proposals.
    fn keeping(&self, py: Python<'_>, attached: &[Attached]) -> PyResult<Task> {
        let functions = attached.iter().filter_map(|part| match part {
            Attached::Function(user) => Some(user),
            Attached::Guide(_) => None,
        });
        let mut names: Vec<Name> = functions.flat_map(|user| user.variables().cloned()).collect();
        names.sort();
        names.dedup();
        if names.is_empty() {
            return Ok(self.task.clone());
        }
        Ok(Task { program: self.model.get().keeping(py, &names)?, ..self.task.clone() })
    }

    /// Further results of a search, as a dict.
    fn info<'py>(&self, py: Python<'py>, info: Info) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        match info {
            Info::Forward => {}
            Info::Importance { log_evidence } => dict.set_item("log_evidence", log_evidence)?,
            Info::Annealed(result) => {
                dict.set_item("log_evidence", result.log_evidence)?;
                dict.set_item("effective", result.effective)?;
                dict.set_item("powers", PyTuple::new(py, result.powers)?)?;
                dict.set_item("tries", result.tries)?;
                dict.set_item("moved", (result.moved.proposed, result.moved.accepted))?;
            }
            Info::Rejection { tries } => dict.set_item("tries", tries)?,
            Info::Enumeration(result) => {
                let pair = |(value, log): &(Value, f64)| Ok((self.object(py, value)?, *log));
                let table = result.outcomes.iter().map(pair).collect::<PyResult<Vec<_>>>()?;
                dict.set_item("table", PyTuple::new(py, table)?)?;
                dict.set_item("log_evidence", result.log_evidence)?;
                dict.set_item("runs", result.runs)?;
                dict.set_item("unseen", result.unseen)?;
                dict.set_item("log_unseen", Some(result.log_unseen).filter(|log| log.is_finite()))?;
            }
            Info::Populations(result, lost) => {
                dict.set_item("log_evidence", result.log_evidence)?;
                dict.set_item("log_normaliser", result.log_normaliser)?;
                dict.set_item("barriers", result.barriers)?;
                dict.set_item("steps", result.steps)?;
                dict.set_item("resampled", result.resampled)?;
                dict.set_item("ancestors", result.ancestors)?;
                dict.set_item("plan", PyTuple::new(py, result.plan)?)?;
                dict.set_item("died", result.died)?;
                dict.set_item("losses", faults::losses(py, &lost, &self.task.program)?)?;
                dict.set_item("powers", PyTuple::new(py, result.powers)?)?;
                let pair = |count: Count| (count.proposed, count.accepted);
                dict.set_item("moved_running", pair(result.moved.running))?;
                dict.set_item("moved_ended", pair(result.moved.ended))?;
            }
            Info::Improved(result) => {
                let attempts =
                    result.attempts.iter().map(|attempt| (attempt.form, attempt.particles, attempt.died_at));
                dict.set_item("attempts", PyTuple::new(py, attempts)?)?;
                let rounds = result.rounds.iter();
                let of = |round: &Round| (round.step.name(), round.work, round.best, round.parts);
                dict.set_item("rounds", PyTuple::new(py, rounds.clone().map(of))?)?;
                dict.set_item("seconds", PyTuple::new(py, rounds.map(|round| round.time.as_secs_f64()))?)?;
                dict.set_item("searches", result.searches)?;
                dict.set_item("kinds", PyTuple::new(py, result.kinds)?)?;
                dict.set_item("niches", result.niches)?;
                dict.set_item("other_work", result.other_work)?;
                dict.set_item("generations", result.generations)?;
                dict.set_item("price", result.price)?;
                dict.set_item("losses", faults::losses(py, &result.lost, &self.task.program)?)?;
            }
            Info::Chain(result) => {
                dict.set_item("tries", result.tries)?;
                dict.set_item("moves", result.moves)?;
                dict.set_item("renewed", PyTuple::new(py, result.renewed)?)?;
                dict.set_item("died", result.died)?;
                dict.set_item("log_evidence", result.log_evidence)?;
            }
        }
        Ok(dict)
    }

    fn object<'py>(&self, py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
        self.model.get().classes.object(py, value)
    }
}

/// Refuses a method, given as its text, that makes no sense for an inference inside a model.
#[pyfunction]
fn check_inside(py: Python<'_>, method: &str) -> PyResult<()> {
    let checked = Method::read(method).and_then(|method| method.check_inside());
    checked.map_err(|fault| faults::setting(py, &fault))
}

/// Refuses a method, given as its text, with a setting that it cannot have.
#[pyfunction]
fn check_method(py: Python<'_>, method: &str) -> PyResult<()> {
    Method::read(method).map(|_| ()).map_err(|fault| faults::setting(py, &fault))
}

/// Refuses a kernel, given as its text, with a setting that it cannot have. Its parts are not checked.
#[pyfunction]
fn check_kernel(py: Python<'_>, kernel: &str) -> PyResult<()> {
    let form: Form = parsed(py, kernel)?;
    form.check().map_err(|fault| faults::setting(py, &fault))
}

/// Refuses an order of futures, given as its text, with a number that it cannot have.
#[pyfunction]
fn check_order(py: Python<'_>, order: &str) -> PyResult<()> {
    setting::check(Policy::RANGES, &parsed(py, order)?).map_err(|fault| faults::setting(py, &fault))
}

fn parsed<T: DeserializeOwned>(py: Python<'_>, text: &str) -> PyResult<T> {
    let fault = |error: serde_json::Error| Fault::new("bad-setting", error.to_string());
    serde_json::from_str(text).map_err(|error| faults::setting(py, &fault(error)))
}

/// Whether a pattern matches a readable address.
#[pyfunction]
fn matches(pattern: &str, address: &str) -> bool {
    glob::matches(pattern, address)
}

/// The three of these addresses that are nearest to a pattern.
#[pyfunction]
fn nearest(pattern: &str, addresses: Vec<String>) -> Vec<String> {
    glob::nearest(pattern, &addresses)
}

/// A hash of the bits that this machine's elementary functions give, in hexadecimal: where it is equal, so are results.
#[pyfunction]
fn fingerprint() -> String {
    format!("{:032x}", niwaki_math::fingerprint::fingerprint())
}

/// The seed of one of several populations, and the share of `max_memory` (bytes) that is its own of `count`.
#[pyfunction]
fn population(seed: u64, number: usize, count: usize, max_memory: usize) -> (u64, usize) {
    (niwaki_particles::population_seed(seed, number), max_memory / count.clamp(1, niwaki_particles::AT_ONCE))
}

/// Populations that lived as one of `total` particles. Each is its size, its own normalising constant (nats) and the log
/// weights of its particles. The constant of all, and what is added to the log weights of each.
#[pyfunction]
fn united(lived: Vec<(usize, Option<f64>, Vec<f64>)>, total: usize) -> (Option<f64>, Vec<f64>) {
    let shares: Vec<Share> = lived
        .into_iter()
        .map(|(size, log_normaliser, logs)| Share {
            size,
            log_normaliser,
            log_sum: log_sum_exp(logs.into_iter()),
        })
        .collect();
    niwaki_particles::united(&shares, total)
}

/// Puts this part into the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(check_inside, module)?)?;
    module.add_function(wrap_pyfunction!(check_kernel, module)?)?;
    module.add_function(wrap_pyfunction!(check_method, module)?)?;
    module.add_function(wrap_pyfunction!(check_order, module)?)?;
    module.add_function(wrap_pyfunction!(fingerprint, module)?)?;
    module.add_function(wrap_pyfunction!(population, module)?)?;
    module.add_function(wrap_pyfunction!(united, module)?)?;
    module.add_function(wrap_pyfunction!(matches, module)?)?;
    module.add_function(wrap_pyfunction!(nearest, module)?)?;
    module.add_class::<PyTask>()
}

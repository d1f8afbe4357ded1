//! Host functions: Python functions that a model calls.
//!
//! Host functions take turns: one of them runs at a time in a process, because libraries that were not written for threads break if two
//! threads run in them. A function with `@host(threads=True)` does not wait. While a host function searches
//! itself, the functions of that search have its turn ([`lend`]).
//!
//! An exception makes the run invalid. `KeyboardInterrupt`, `SystemExit`, other objects that are no `Exception`, and `MemoryError` are
//! not about the model: they end the search, which raises them ([`Hosts::raised`]).

use crate::forks::end_if_forked;
use crate::values::Classes;
use niwaki_run::inside::Inside;
use niwaki_run::task::Hosts;
use niwaki_vm::fault::Fault;
use niwaki_vm::value::Value;
use pyo3::exceptions::{PyException, PyMemoryError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::any::Any;
use std::cell::RefCell;
use std::sync::{Arc, Condvar, Mutex, PoisonError};

/// Function of the host.
struct Function {
    callable: Py<PyAny>,
    /// Whether it may run on several threads at once.
    threads: bool,
}

impl Function {
    fn name(&self, py: Python<'_>) -> String {
        let name = self.callable.bind(py).getattr("__name__");
        name.map_or_else(|_| "it".into(), |name| name.to_string())
    }
}

/// The functions of a program by the number of the constant that names them.
pub struct PyHosts {
    functions: Vec<Option<Function>>,
    classes: Arc<Classes>,
    /// The exception of a function that is not about the model.
    raised: Mutex<Option<PyErr>>,
}

impl PyHosts {
    /// The functions among these constants.
    ///
    /// # Errors
    /// The exception of an object, when its attribute about threads is read.
    pub fn new(constants: Vec<Option<Bound<'_, PyAny>>>, classes: Arc<Classes>) -> PyResult<PyHosts> {
        let function = |callable: Bound<'_, PyAny>| {
            let threads = callable
                .getattr_opt("threads")?
                .is_some_and(|attribute| attribute.extract().unwrap_or(false));
            Ok(Function { callable: callable.unbind(), threads })
        };
        let functions = constants.into_iter().map(|constant| constant.map(function).transpose());
        Ok(PyHosts { functions: functions.collect::<PyResult<_>>()?, classes, raised: Mutex::new(None) })
    }

    /// Converts an exception to a fault of the program; an exception that is not about the model is stored, and ends the search.
    fn failed(&self, py: Python<'_>, function: &Function, error: PyErr) -> (Fault, bool) {
        let name = function.name(py);
        let kind = error.get_type(py).name().map_or_else(|_| "an error".into(), |name| name.to_string());
        let text = error.value(py).to_string();
        let fault = Fault::new("host-function", format!("the host function `{name}` failed: {kind}: {text}"));
        let is_about_it =
            error.is_instance_of::<PyException>(py) && !error.is_instance_of::<PyMemoryError>(py);
        if !is_about_it {
            self.raised.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        }
        (fault, is_about_it)
    }
}

impl Hosts for PyHosts {
    fn call(&self, constant: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        let Some(Some(function)) = self.functions.get(constant as usize) else {
            return Err(Fault::new("host-function", format!("constant {constant} is not a function")));
        };
        let process = std::process::id();
        Python::attach(|py| {
            let arguments = args.iter().map(|a| self.classes.object(py, a)).collect::<PyResult<Vec<_>>>();
            let arguments = arguments.and_then(|arguments| PyTuple::new(py, arguments));
            let result = arguments.and_then(|arguments| {
                let _turn = if function.threads { None } else { Some(Turn::take(py)) };
                let result = function.callable.bind(py).call1(arguments);
                end_if_forked(process, "the host function");
                result
            });
            let value = result.map_err(|error| match self.failed(py, function, error) {
                (fault, true) => fault.of_call(&function.name(py), args),
                (fault, false) => fault,
            })?;
            // A value that a model cannot have is a fault of the program, in any run.
            self.classes.value(&value).map_err(|error| self.failed(py, function, error).0)
        })
    }

    fn raised(&self) -> Option<Box<dyn Any + Send>> {
        let error = self.raised.lock().unwrap_or_else(PoisonError::into_inner).take();
        error.map(|error| Box::new(error) as Box<dyn Any + Send>)
    }
}

/// The functions of a model, and those of the users' proposals that its search calls: whichever raises an exit ends the search.
pub struct WithProposals {
    /// Functions of the model.
    pub model: Arc<dyn Hosts>,
    /// Functions of each proposal.
    pub proposals: Vec<Arc<dyn Hosts>>,
}

impl Hosts for WithProposals {
    fn call(&self, constant: u16, args: &[Value], steps: &mut u64) -> Result<Value, Fault> {
        self.model.call(constant, args, steps)
    }

    fn raised(&self) -> Option<Box<dyn Any + Send>> {
        self.model.raised().or_else(|| self.proposals.iter().find_map(|hosts| hosts.raised()))
    }

    fn inference(&self, constant: u16) -> Option<Inside> {
        self.model.inference(constant)
    }
}

/// Raises the exception of a host function that is not about the model.
///
/// # Errors
/// The exception.
pub fn check(hosts: &dyn Hosts) -> PyResult<()> {
    match hosts.raised().map(|raised| raised.downcast::<PyErr>()) {
        Some(Ok(error)) => Err(*error),
        _ => Ok(()),
    }
}

/// Queue of a process for its turn.
struct Queue {
    process: u32,
    busy: Mutex<bool>,
    free: Condvar,
}

impl Queue {
    /// Whether this process was forked by the thread that has the turn: the threads of its queue do not exist here, and one of them may
    /// have held its locks.
    fn is_foreign(&self) -> bool {
        self.process != std::process::id()
    }

    fn take(&self) {
        if self.is_foreign() {
            return;
        }
        let busy = self.busy.lock().unwrap_or_else(PoisonError::into_inner);
        let mut busy = self.free.wait_while(busy, |busy| *busy).unwrap_or_else(PoisonError::into_inner);
        *busy = true;
    }

    fn try_take(&self) -> bool {
        !std::mem::replace(&mut *self.busy.lock().unwrap_or_else(PoisonError::into_inner), true)
    }

    fn leave(&self) {
        if !self.is_foreign() {
            *self.busy.lock().unwrap_or_else(PoisonError::into_inner) = false;
            self.free.notify_one();
        }
    }
}

/// The queue of this process. As for the pools of threads, this lock is taken only with the interpreter's lock, which a fork has,
/// too, so no child finds it locked. A child has a queue of its own.
static QUEUE: Mutex<Option<Arc<Queue>>> = Mutex::new(None);

thread_local! {
    /// The queue in which this thread has the turn.
    static MINE: RefCell<Option<Arc<Queue>>> = const { RefCell::new(None) };
}

/// Turn of a host function, which ends with the drop of this value.
struct Turn;

impl Turn {
    /// Waits for the turn without the interpreter's lock, because the thread that has the turn may need the lock.
    ///
    /// A thread that has the turn and calls another host function (a short search on the same thread) keeps it.
    fn take(py: Python<'_>) -> Option<Turn> {
        if MINE.with_borrow(Option::is_some) {
            return None;
        }
        let queue = {
            let mut queue = QUEUE.lock().unwrap_or_else(PoisonError::into_inner);
            let current = queue.take().filter(|queue| !queue.is_foreign());
            let new = || Queue { process: std::process::id(), busy: Mutex::new(false), free: Condvar::new() };
            queue.insert(current.unwrap_or_else(|| Arc::new(new()))).clone()
        };
        if !queue.try_take() {
            py.detach(|| queue.take());
        }
        MINE.set(Some(queue));
        Some(Turn)
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        if let Some(queue) = MINE.take() {
            queue.leave();
        }
    }
}

/// Lends the turn of this thread, if it has the turn, to the threads that run parts of `work`. The interpreter's lock is
/// not held: see [`Turn::take`].
pub fn lend<T>(work: impl FnOnce() -> T) -> T {
    /// Takes the turn again, also after a panic.
    struct Lent(Option<Arc<Queue>>);
    impl Drop for Lent {
        fn drop(&mut self) {
            if let Some(queue) = self.0.take() {
                queue.take();
                MINE.set(Some(queue));
            }
        }
    }
    let lent = Lent(MINE.take());
    if let Some(queue) = &lent.0 {
        queue.leave();
    }
    work()
}

//! Faults as data: one exception with all facts of the engine. Python draws the carets.
//!
//! `kind` is "run" (the model failed: message, help, stack), "setting" (a setting makes no sense), "impossible"
//! (every particle is, or at barrier 0 every run: barrier, causes, the parts to blame and the populations that were tried), "no-start" (every first state of a chain is: tries
//! and causes) or "compile" (a defect of the text or a limit of the machine).

use crate::hosts;
use niwaki_run::failure::{Blame, Emitted};
use niwaki_run::losses::Lost;
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::stack::Call;
use niwaki_vm::refusal::{Expected, Range};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

pyo3::create_exception!(
    _engine,
    EngineFault,
    PyRuntimeError,
    "A fault as data.\n\n\
     Attributes: `kind`, `code`, `message`, `subject` (the address or pattern that it is about), `help`, and by kind: `stack` (function, path, (line, column, end line, \
     end column)), `omitted`, `path`, `invalid` (every run was); `barrier` or `tries`, `causes`; `blame` (constraint, place, other \
     place or None, runs), `looked_at`, `attempts` (form, particles, barrier); `value` (JSON) and `expected` (a rule or a range) of a refused setting."
);

/// The exception for why a search gave no result.
pub fn raise(py: Python<'_>, failure: &Failure, program: &Program) -> PyErr {
    build(py, failure, program).unwrap_or_else(|other| other)
}

/// The exception for why a search gave no result, or the exception of a host function that ended the search.
pub fn ended(py: Python<'_>, failure: &Failure, task: &Task) -> PyErr {
    hosts::check(&*task.hosts).err().unwrap_or_else(|| raise(py, failure, &task.program))
}

fn build(py: Python<'_>, failure: &Failure, program: &Program) -> PyResult<PyErr> {
    let facts = PyDict::new(py);
    let about = |fault: &Fault, kind: &str| note(&facts, fault, kind);
    let all_impossible = |kind: &str, code: &str, causes: &[(String, usize)]| {
        facts.set_item("kind", kind)?;
        facts.set_item("code", code)?;
        facts.set_item("message", failure.to_string())?;
        facts.set_item("help", py.None())?;
        facts.set_item("causes", causes.to_vec())
    };
    let place = |call: &Call| {
        let path = program.files.get(call.file as usize).map_or("", String::as_str);
        let s = call.span;
        (call.function.to_string(), path, (s.line, s.column, s.end_line, s.end_column))
    };
    match failure {
        Failure::Run(run) => {
            about(&run.fault, "run")?;
            facts.set_item("stack", run.stack.iter().map(place).collect::<Vec<_>>())?;
            facts.set_item("omitted", run.omitted)?;
            facts.set_item("path", &run.path)?;
            facts.set_item("invalid", failure.is_impossible())?;
        }
        Failure::Setting(fault) => about(fault, "setting")?,
        Failure::Impossible { barrier, causes, blame: (blame, looked_at), attempts, .. } => {
            facts.set_item("barrier", barrier)?;
            facts.set_item("blame", blamed(py, blame, program)?)?;
            facts.set_item("looked_at", looked_at)?;
            let tried = attempts.iter().map(|one| (one.form, one.particles, one.died_at));
            facts.set_item("attempts", tried.collect::<Vec<_>>())?;
            all_impossible("impossible", "everything-impossible", causes)?;
        }
        Failure::NoStart { tries, causes } => {
            facts.set_item("tries", tries)?;
            all_impossible("no-start", "no-start", causes)?;
        }
    }
    with_facts(py, failure.to_string(), &facts)
}

/// Losses of a search that has a result: causes, the parts to blame, and the number of runs in which they were looked for.
pub fn losses<'py>(py: Python<'py>, lost: &Lost, program: &Program) -> PyResult<Bound<'py, PyTuple>> {
    let blame = blamed(py, &lost.blame, program)?;
    (lost.causes.clone(), blame, lost.looked_at).into_pyobject(py)
}

/// Constraint, part, other part and runs; a part as address, function, path and span.
fn blamed<'py>(py: Python<'py>, blame: &[Blame], program: &Program) -> PyResult<Bound<'py, PyList>> {
    let part = |one: &Emitted| {
        let path = program.files.get(one.file as usize).map_or("", String::as_str);
        (one.path.clone(), one.function.clone(), path.to_string(), <(u32, u32, u32, u32)>::from(one.span))
    };
    let found =
        blame.iter().map(|one| (&one.constraint, part(&one.part), one.other.as_ref().map(part), one.runs));
    PyList::new(py, found)
}

/// The condition of a setting: the name of a rule, or a range as `errors.settings.worded` reads it.
fn expected<'py>(py: Python<'py>, expected: &Expected) -> PyResult<Bound<'py, PyAny>> {
    match expected {
        Expected::Rule(rule) => rule.into_bound_py_any(py),
        Expected::Range(range) => range_as_tuple(py, range),
    }
}

fn range_as_tuple<'py>(py: Python<'py>, range: &Range) -> PyResult<Bound<'py, PyAny>> {
    match range {
        Range::Whole { least, most } => ("whole", *least, *most).into_bound_py_any(py),
        Range::Real { low, high, ends } => ("real", *low, *high, *ends).into_bound_py_any(py),
        Range::Words(words) => ("words", PyTuple::new(py, *words)?).into_bound_py_any(py),
        Range::List(range) => ("list", range_as_tuple(py, range)?).into_bound_py_any(py),
        Range::Table(_) => ("table",).into_bound_py_any(py),
        Range::Optional(range) => ("optional", range_as_tuple(py, range)?).into_bound_py_any(py),
        Range::Either([first, second]) => {
            ("either", range_as_tuple(py, first)?, range_as_tuple(py, second)?).into_bound_py_any(py)
        }
    }
}

fn note(facts: &Bound<'_, PyDict>, fault: &Fault, kind: &str) -> PyResult<()> {
    facts.set_item("kind", kind)?;
    facts.set_item("code", fault.code)?;
    facts.set_item("message", &fault.message)?;
    facts.set_item("subject", fault.subject.as_deref())?;
    if let Some(refusal) = &fault.refusal {
        facts.set_item("value", &refusal.value)?;
        facts.set_item("expected", expected(facts.py(), &refusal.expected)?)?;
    }
    facts.set_item("help", fault.help.as_deref())
}

/// The exception of a setting that makes no sense.
pub fn setting(py: Python<'_>, fault: &Fault) -> PyErr {
    let facts = PyDict::new(py);
    let error = note(&facts, fault, "setting").and_then(|()| with_facts(py, fault.message.clone(), &facts));
    error.unwrap_or_else(|other| other)
}

/// The exception of a program that cannot be compiled.
pub fn uncompiled(py: Python<'_>, message: String) -> PyErr {
    let facts = PyDict::new(py);
    let set = || -> PyResult<PyErr> {
        facts.set_item("kind", "compile")?;
        facts.set_item("code", "machine-limit")?;
        facts.set_item("message", &message)?;
        facts.set_item("help", py.None())?;
        with_facts(py, message.clone(), &facts)
    };
    set().unwrap_or_else(|other| other)
}

fn with_facts(py: Python<'_>, message: String, facts: &Bound<'_, PyDict>) -> PyResult<PyErr> {
    let error = EngineFault::new_err(message);
    for (name, value) in facts {
        error.value(py).setattr(name.extract::<String>()?.as_str(), value)?;
    }
    Ok(error)
}

/// Registers the exception.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("EngineFault", module.py().get_type::<EngineFault>())
}

//! Compiled models for Python, from the text of a core form and its constants.

use crate::faults;
use crate::hosts::PyHosts;
use crate::values::Classes;
use niwaki_grad::Var;
use niwaki_math::Scalar;
use niwaki_run::task::Hosts;
use niwaki_search::nested::{Inferences, Inner};
use niwaki_vm::code::{Mode, Program, SiteKind, disassemble};
use niwaki_vm::core::parse::parse;
use niwaki_vm::core::{Module, Name};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Limits;
use niwaki_vm::passes::{Scope, compile, compile_with_scope};
use niwaki_vm::value::Value;
use pyo3::prelude::*;
use pyo3::types::PyType;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};
use std::time::Instant;

/// Immutable compiled model, for any number of searches at once.
#[pyclass(frozen, name = "Program", module = "niwaki._engine")]
pub struct PyProgram {
    pub program: Arc<Program>,
    pub classes: Arc<Classes>,
    hosts: Arc<dyn Hosts>,
    methods: Arc<HashMap<u16, Inner>>,
    seconds: f64,
    /// The module of the core form.
    module: Module,
    data: Vec<Value>,
    /// The program that keeps all variables, compiled at its first use.
    observed: OnceLock<Arc<Program>>,
}

impl PyProgram {
    /// The host functions; inner runs have the limits of outer runs.
    pub fn hosts(&self, limits: Limits) -> Arc<dyn Hosts> {
        if self.has_inferences() { Arc::new(self.inferences(limits)) } else { self.hosts.clone() }
    }

    /// Whether the program has inferences inside.
    pub fn has_inferences(&self) -> bool {
        !self.methods.is_empty()
    }

    /// Compiles the program so that these variables can be read at choices.
    pub fn keeping(&self, py: Python<'_>, names: &[Name]) -> PyResult<Arc<Program>> {
        let compiled = compile_with_scope(&self.module, self.data.clone(), Scope::Names(names));
        compiled.map(Arc::new).map_err(|e| faults::uncompiled(py, e.to_string()))
    }

    /// The program over recording numbers, with these constants in their places.
    pub fn recorded(&self, constants: &[(usize, Var)]) -> Result<Program<Var>, Fault> {
        let mut data: Vec<Value<Var>> = self.data.iter().map(|value| value.convert(&Var::from_f64)).collect();
        for (place, x) in constants {
            let slot = data.get_mut(*place);
            *slot.ok_or_else(|| Fault::new("bad-setting", format!("there is no constant {place}")))? =
                Value::Real(*x);
        }
        compile(&self.module, data).map_err(|error| Fault::new("machine-limit", error.to_string()))
    }

    /// Compiles the program so that all variables can be read at choices, at the first call.
    pub fn keeping_all(&self, py: Python<'_>) -> PyResult<Arc<Program>> {
        if let Some(known) = self.observed.get() {
            return Ok(known.clone());
        }
        let compiled = compile_with_scope(&self.module, self.data.clone(), Scope::All);
        let program = compiled.map(Arc::new).map_err(|e| faults::uncompiled(py, e.to_string()))?;
        Ok(self.observed.get_or_init(|| program).clone())
    }

    /// The inferences inside of the program.
    pub fn inferences(&self, limits: Limits) -> Inferences {
        Inferences {
            program: self.program.clone(),
            methods: self.methods.clone(),
            hosts: self.hosts.clone(),
            limits,
            depth: 0,
            known: Arc::default(),
        }
    }
}

#[pymethods]
impl PyProgram {
    /// Compiles ``text``; ``constants`` are its data and host functions, ``classes`` its record classes, by number.
    #[new]
    #[pyo3(signature = (text, constants=Vec::new(), classes=Vec::new()))]
    fn new(
        py: Python<'_>,
        text: &str,
        constants: Vec<Bound<'_, PyAny>>,
        classes: Vec<Py<PyType>>,
    ) -> PyResult<PyProgram> {
        let start = Instant::now();
        let module = parse(text).map_err(|e| faults::uncompiled(py, e.to_string()))?;
        let table: Vec<Arc<_>> = module.classes.iter().cloned().map(Arc::new).collect();
        let classes = Arc::new(Classes::new(classes, &table));
        let (mut data, mut callables, mut methods) = (Vec::new(), Vec::new(), HashMap::new());
        for (number, constant) in constants.into_iter().enumerate() {
            let is_host = constant.is_callable();
            let value = if is_host { Value::None } else { classes.value(&constant)? };
            if let (Some(inner), Ok(number)) = (Inner::read(&value), u16::try_from(number)) {
                methods.insert(number, inner.map_err(|fault| faults::uncompiled(py, fault.message.clone()))?);
            }
            data.push(value);
            callables.push(is_host.then_some(constant));
        }
        let program = compile(&module, data.clone()).map_err(|e| faults::uncompiled(py, e.to_string()))?;
        Ok(PyProgram {
            program: Arc::new(program),
            hosts: Arc::new(PyHosts::new(callables, classes.clone())?),
            methods: Arc::new(methods),
            classes,
            seconds: start.elapsed().as_secs_f64(),
            module,
            data,
            observed: OnceLock::new(),
        })
    }

    /// The seconds of the compilation.
    #[getter]
    fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Functions: (name, "pure", "effects" or "loop", number of suspension sites).
    #[getter]
    fn functions(&self) -> Vec<(String, &'static str, usize)> {
        let kind = |mode: Mode| match mode {
            Mode::Pure => "pure",
            Mode::Node => "effects",
            _ => "loop",
        };
        self.program.functions.iter().map(|f| (f.name.to_string(), kind(f.mode), f.sites.len())).collect()
    }

    /// Readable components of the sites at which random choices are made: (function, component, line).
    #[getter]
    fn choices(&self) -> Vec<(String, String, u32)> {
        let mut sites = Vec::new();
        for f in &self.program.functions {
            for site in &f.sites {
                if matches!(site.kind, SiteKind::Sample(_)) {
                    sites.push((f.name.to_string(), site.label.to_string(), site.span.line));
                }
            }
        }
        sites
    }

    /// The bytecode, readable.
    fn disassemble(&self) -> String {
        disassemble(&self.program)
    }
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyProgram>()
}

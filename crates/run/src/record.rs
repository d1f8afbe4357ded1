//! Records: the choices and scores of a run so far, the same for every algorithm.
//!
//! `log_prior` is the sum of the log densities of its choices, `log_score` that of factors, observations and
//! sketches. The sums are exact, so their order does not matter.

use crate::log::Log;
use crate::{Failure, Task};
use niwaki_geom::sketch::SketchSpec;
use niwaki_geom::sketch::product::Sketches;
use niwaki_geom::{Primitive, Shape};
use niwaki_math::{Total, grid};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::value::Value;
use std::sync::Arc;

/// The choices and scores of a run so far.
#[derive(Default)]
pub struct Record {
    /// The choices.
    pub log: Log,
    /// Sum of the log densities of the choices, nats.
    pub log_prior: Total,
    /// Sum of factors and observations, nats.
    pub log_factors: Total,
    /// The sketches of the scene.
    pub sketches: Sketches,
    /// Sum of the sketches' log scores, nats.
    pub log_sketches: Total,
    /// The number of primitives of the scene.
    pub primitives: usize,
    /// The name of the factor or sketch that made the run impossible.
    pub cause: Option<String>,
    /// The fault of an invalid run.
    pub invalid: Option<Arc<RunFault>>,
}

impl Record {
    /// Start the record of a run, with the score of the empty scene.
    pub fn start(specs: &[Arc<dyn SketchSpec>]) -> Self {
        let sketches = Sketches::start(specs);
        Record { log_sketches: sketches.total(), sketches, ..Record::default() }
    }

    /// Copy the record; both copies share unchanged data.
    pub fn fork(&mut self) -> Record {
        Record {
            log: self.log.fork(),
            log_prior: self.log_prior.clone(),
            log_factors: self.log_factors.clone(),
            sketches: self.sketches.fork(),
            log_sketches: self.log_sketches.clone(),
            primitives: self.primitives,
            cause: self.cause.clone(),
            invalid: self.invalid.clone(),
        }
    }

    /// Become a copy of `other`; both records share unchanged data.
    pub fn become_copy(&mut self, other: &mut Record) {
        self.log.become_copy(&mut other.log);
        self.log_prior.clone_from(&other.log_prior);
        self.log_factors.clone_from(&other.log_factors);
        self.sketches.become_copy(&other.sketches);
        self.log_sketches.clone_from(&other.log_sketches);
        self.primitives = other.primitives;
        self.cause.clone_from(&other.cause);
        self.invalid.clone_from(&other.invalid);
    }

    /// The log score, nats: factors, observations and sketches. Minus infinity for an impossible run.
    #[inline]
    pub fn log_score(&self) -> f64 {
        self.score().value()
    }

    /// The log score as an exact sum.
    #[inline]
    pub fn score(&self) -> Total {
        self.log_factors.plus(&self.log_sketches)
    }

    /// Add a choice and its log density.
    #[inline(always)]
    pub fn choose(&mut self, address: u128, value: &Value, log_density: f64) {
        self.log_prior.add(grid(log_density));
        self.log.push(address, value.clone());
    }

    /// Add a factor. `name` gives the readable name of the factor; it is called only if the factor makes the run impossible.
    #[inline]
    pub fn factor(&mut self, log: f64, name: impl FnOnce() -> String) {
        self.log_factors.add(log);
        if log == f64::NEG_INFINITY {
            self.cause.get_or_insert_with(name);
        }
    }

    /// Handle a fault of the run. A fault that makes the run invalid gives the run a score of minus infinity, and counts it.
    ///
    /// # Errors
    /// Any other fault.
    #[cold]
    pub fn forgive(&mut self, task: &Task, met: Box<RunFault>) -> Result<(), Failure> {
        let Some(place) = task.invalid.count(&met) else { return Err(met.into()) };
        self.factor(f64::NEG_INFINITY, || place.to_string());
        self.invalid = Some(Arc::new(*met));
        Ok(())
    }

    /// Add a primitive to the scene. After a score of minus infinity, further sketches are not evaluated.
    pub fn emit(&mut self, shapes: &[Shape]) {
        self.primitives += 1;
        if self.sketches.is_empty() {
            return;
        }
        if let Some(name) = self.sketches.add(&Primitive::new(shapes)) {
            self.cause.get_or_insert_with(|| name.to_string());
        }
        self.log_sketches = self.sketches.total();
    }
}

/// A check whether all runs of a search were invalid. A fault in every run is a fault of the model, so the check reports the
/// first fault.
#[derive(Default)]
pub struct AllInvalid {
    first: Option<Arc<RunFault>>,
    has_valid: bool,
}

impl AllInvalid {
    /// Add a run, with its fault if the run is invalid.
    pub fn note(&mut self, invalid: Option<&Arc<RunFault>>) {
        match invalid {
            Some(met) => {
                self.first.get_or_insert_with(|| met.clone());
            }
            None => self.has_valid = true,
        }
    }

    /// Check that a run was valid, or that there was no run.
    ///
    /// # Errors
    /// The fault of the first run, where all runs were invalid.
    pub fn check(self) -> Result<(), Failure> {
        match self.first {
            Some(met) if !self.has_valid => Err(Failure::Run(Box::new((*met).clone()))),
            _ => Ok(()),
        }
    }

    /// Check all runs of a search; `invalid` has the fault of each invalid run.
    ///
    /// # Errors
    /// The errors of [`AllInvalid::check`].
    pub fn check_all<'a>(invalid: impl Iterator<Item = Option<&'a Arc<RunFault>>>) -> Result<(), Failure> {
        let mut all = AllInvalid::default();
        invalid.for_each(|met| all.note(met));
        all.check()
    }
}

/// The log score of sketches, nats.
///
/// # Errors
/// A sketch scores NaN.
pub fn score_of(sketches: &Sketches) -> Result<Total, Fault> {
    let total = sketches.total();
    if total.value().is_nan() {
        let guilty = sketches.iter().find(|(_, sketch)| sketch.log_score().is_nan());
        let name = guilty.map_or("a sketch", |(name, _)| name);
        return Err(Fault::new("non-finite-score", format!("the sketch `{name}` scores nan"))
            .with_help("look for shapes whose measures are not numbers"));
    }
    Ok(total)
}

/// Round a factor to the grid. A factor is a number below plus infinity.
///
/// # Errors
/// NaN or plus infinity.
pub fn check_factor(log: f64) -> Result<f64, Fault> {
    if log.is_nan() || log == f64::INFINITY {
        return Err(Fault::new("non-finite-score", format!("a factor of {log} nats"))
            .with_help("a log factor is a finite number, or minus infinity for what is impossible"));
    }
    Ok(grid(log))
}

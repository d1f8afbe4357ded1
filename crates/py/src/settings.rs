//! Settings of a population, from Python's words for them.

use crate::faults;
use niwaki_infer::particles::{Anneal, Moment, Order, Resampling, Settings, Weights, When};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use pyo3::prelude::*;

/// The way of the temperature: a share of the particles to keep, or the temperature at each barrier.
#[derive(FromPyObject)]
pub enum Way {
    Share(f64),
    Path(Vec<f64>),
}

/// When particles are moved: at every so-many-th barrier, or at a moment that has a name.
#[derive(FromPyObject)]
pub enum At {
    Barriers(usize),
    Named(String),
}

impl At {
    /// The moment, or an error that says which names are known.
    pub fn moment(self, py: Python<'_>, program: &Program) -> PyResult<Moment> {
        match self {
            At::Barriers(n) => Ok(Moment::Every(n)),
            At::Named(name) => match name.as_str() {
                "resampled" => Ok(Moment::Resampled),
                "end" => Ok(Moment::End),
                other => {
                    Err(unknown(py, program, "at", other, "a number of barriers, \"resampled\" or \"end\""))
                }
            },
        }
    }
}

/// What is asked for in words.
pub struct Words<'a> {
    pub particles: usize,
    pub seed: u64,
    pub order: &'a str,
    pub weights: &'a str,
    pub temper: f64,
    pub anneal: Option<Way>,
    pub resampling: &'a str,
    pub ess: Option<f64>,
}

/// The fault of a setting that is none of those known.
pub fn unknown(py: Python<'_>, program: &Program, name: &str, found: &str, known: &str) -> PyErr {
    let fault =
        Fault::new("bad-setting", format!("`{name}` cannot be {found:?}")).with_help(format!("use {known}"));
    faults::raise(py, &fault.into(), program)
}

/// The settings, or an error that says which word is not known.
pub fn settings(py: Python<'_>, program: &Program, words: Words<'_>) -> PyResult<Settings> {
    let unknown = |name: &str, found: &str, known: &str| unknown(py, program, name, found, known);
    Ok(Settings {
        particles: words.particles,
        seed: words.seed,
        temper: words.temper,
        order: Order::from_name(words.order)
            .ok_or_else(|| unknown("order", words.order, "\"stochastic\" or \"depth-first\""))?,
        weights: Weights::from_name(words.weights)
            .ok_or_else(|| unknown("weights", words.weights, "\"ratio\" or \"absolute\""))?,
        anneal: match words.anneal {
            None => Anneal::Constant,
            Some(Way::Share(share)) => Anneal::Adaptive(share),
            Some(Way::Path(path)) => Anneal::Schedule(path.into()),
        },
        resampling: Resampling::from_name(words.resampling).ok_or_else(|| {
            let known = "\"systematic\", \"residual\", \"stratified\" or \"multinomial\"";
            unknown("resampling", words.resampling, known)
        })?,
        rejuvenate: None,
        when: words.ess.map_or(When::Always, When::EffectiveBelow),
    })
}

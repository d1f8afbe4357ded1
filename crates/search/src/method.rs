//! Methods as data. The binding reads them, and `infer` inside a model.
//!
//! The fields equal those of Python's classes of the same names, which describe them.

use crate::direct::annealed;
use crate::direct::annealed::{Annealed, Powers, annealed};
use crate::direct::normals;
use crate::improve::{Improve, Improved, Outputs};
use niwaki_chain::form::{Attached, Form};
use niwaki_chain::kernel::Kernel;
use niwaki_chain::leaf::trajectory::DOUBLINGS;
use niwaki_continuous::hamiltonian;
use niwaki_continuous::hamiltonian::chains::Length;
use niwaki_continuous::hamiltonian::{Metric, Shape};
use niwaki_continuous::variational::family::Family;
use niwaki_particles::{
    Ancestors, Anneal, FinalChains, Moment, Progress, Rejuvenation, Settings, Weights, particle_gibbs, pimh,
    populations, within,
};
use niwaki_propose::importance::importance;
use niwaki_propose::look_ahead::LookAhead;
use niwaki_propose::proposal::Proposal;
use niwaki_run::blame::explained;
use niwaki_run::enumeration::{Visit, visit};
use niwaki_run::forward::forward;
use niwaki_run::log::Entry;
use niwaki_run::losses::Lost;
use niwaki_run::record::AllInvalid;
use niwaki_run::rejection::rejection;
use niwaki_run::resampling::Resampling;
use niwaki_run::run::Run;
use niwaki_run::setting;
use niwaki_run::setting::{
    BETWEEN, COUNT, FINITE, FROM_ZERO, POSITIVE, Range, Ranges, SHARE, SMALL_COUNT, whole,
};
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::kept::Strategy;
use niwaki_vm::refusal::Expected;
use niwaki_vm::value::Value;
use serde::Deserialize;
use serde_json::Map;
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// A count in 32 bits, or 0.
const SMALL: Range = Range::Whole { least: 0, most: u32::MAX as u64 };

/// Approximate number of samples that a chain keeps by default.
const KEPT: u64 = 1000;

/// The method of a search.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "method", rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the settings are described where people read them: in Python's classes")]
pub enum Method {
    Forward { n: u64 },
    EnumerateAll { max_runs: usize, likely: bool, rest: f64 },
    Rejection { n: usize, bound: f64, max_tries: u64 },
    Importance { n: usize, proposal: Option<Form> },
    Ais(Ais),
    Smc(Smc),
    ParticleGibbs(ParticleGibbs),
    Pimh(Pimh),
    Improve(Improve),
    Mh(Mh),
    Hmc(Hmc),
    Nuts(Nuts),
    Vi(Vi),
}

/// A setting and the rule about several settings that it breaks.
pub(crate) type BrokenRule = (&'static str, &'static str);

/// Unknown settings, which a method refuses.
type Rest = BTreeMap<String, serde_json::Value>;

/// Annealed importance sampling.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ais {
    particles: usize,
    powers: Powers,
    kernel: Option<Form>,
    moves: u64,
    tries: u64,
}

impl Ais {
    /// Ranges of its settings.
    const RANGES: Ranges = &[
        ("particles", whole(2)),
        ("powers", Range::Either(&[COUNT, Range::List(&POSITIVE)])),
        ("moves", COUNT),
        ("tries", COUNT),
    ];
}

/// Sequential Monte Carlo.
#[derive(Clone, Debug, Deserialize)]
pub struct Smc {
    particles: Sizes,
    populations: Option<usize>,
    diverse: Option<usize>,
    seconds: Option<f64>,
    rejuvenate: Option<Form>,
    moves: u64,
    at: Moment,
    draws: Option<usize>,
    chains: usize,
    #[serde(flatten)]
    common: Populations,
}

impl Smc {
    /// Ranges of its settings.
    const RANGES: Ranges = &[
        ("particles", Range::Either(&[COUNT, Range::List(&COUNT)])),
        ("populations", Range::Optional(&COUNT)),
        ("diverse", Range::Optional(&COUNT)),
        ("seconds", Range::Optional(&POSITIVE)),
        ("moves", COUNT),
        ("at", Range::Either(&[COUNT, Range::Words(&["resampled", "end"])])),
        ("draws", Range::Optional(&COUNT)),
        ("chains", COUNT),
    ];
}

/// Sizes of populations.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
enum Sizes {
    Each(usize),
    List(Vec<usize>),
}

/// Particle Gibbs.
#[derive(Clone, Debug, Deserialize)]
pub struct ParticleGibbs {
    particles: usize,
    sweeps: usize,
    ancestors: bool,
    #[serde(flatten)]
    common: Populations,
}

impl ParticleGibbs {
    /// Ranges of its settings.
    const RANGES: Ranges = &[
        ("particles", whole(2)),
        ("sweeps", COUNT),
        ("anneal", Range::Optional(&Range::List(&FROM_ZERO))),
        ("resampling", Range::Words(&["multinomial", "tempered"])),
    ];
}

/// Particle independent Metropolis-Hastings.
#[derive(Clone, Debug, Deserialize)]
pub struct Pimh {
    particles: usize,
    sweeps: usize,
    #[serde(flatten)]
    common: Populations,
}

impl Pimh {
    /// Ranges of its settings.
    const RANGES: Ranges =
        &[("particles", COUNT), ("sweeps", COUNT), ("anneal", Range::Optional(&Range::List(&FROM_ZERO)))];
}

/// The settings that the methods with populations share.
#[derive(Clone, Debug, Deserialize)]
struct Populations {
    proposal: Option<Form>,
    #[serde(default)]
    look_ahead: Option<f64>,
    #[serde(flatten)]
    settings: Settings,
    #[serde(flatten)]
    rest: Rest,
}

impl Populations {
    /// Ranges of its settings.
    const RANGES: Ranges = &[("look_ahead", Range::Optional(&POSITIVE))];
}

/// Metropolis-Hastings.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mh {
    /// Proposals of each chain.
    pub steps: u64,
    #[serde(deserialize_with = "strategy")]
    strategy: Strategy,
    kernel: Option<Form>,
    /// The number of chains.
    pub chains: usize,
    thin: Option<u64>,
    keep: Option<u64>,
    warmup: u64,
    tries: u64,
}

impl Mh {
    /// Ranges of its settings.
    const RANGES: Ranges = &[
        ("steps", COUNT),
        ("strategy", Range::Words(&["c3", "rerun", "resume", "cache"])),
        ("chains", COUNT),
        ("thin", Range::Optional(&COUNT)),
        ("keep", Range::Optional(&whole(0))),
        ("warmup", whole(0)),
        ("tries", COUNT),
    ];
}

/// Hamiltonian Monte Carlo.
#[derive(Clone, Debug, Deserialize)]
pub struct Hmc {
    steps: u32,
    jitter: f64,
    /// A setting for warnings in Python; unused here.
    #[serde(rename = "designs")]
    _designs: bool,
    #[serde(flatten)]
    common: Trajectories,
    #[serde(flatten)]
    rest: Rest,
}

impl Hmc {
    /// Ranges of its settings.
    const RANGES: Ranges = &[("steps", SMALL_COUNT), ("jitter", SHARE)];
}

/// The no-U-turn sampler.
#[derive(Clone, Debug, Deserialize)]
pub struct Nuts {
    max_depth: u32,
    #[serde(flatten)]
    common: Trajectories,
    #[serde(flatten)]
    rest: Rest,
}

impl Nuts {
    /// Ranges of its settings.
    const RANGES: Ranges = &[("max_depth", DOUBLINGS)];
}

/// The settings that HMC and NUTS share.
#[derive(Clone, Debug, Deserialize)]
struct Trajectories {
    draws: u32,
    chains: usize,
    warmup: u32,
    thin: u32,
    target_accept: f64,
    metric: MetricForm,
    step_size: Option<f64>,
    climb: u32,
    tries: u64,
}

impl Trajectories {
    /// Ranges of its settings.
    const RANGES: Ranges = &[
        ("draws", SMALL_COUNT),
        ("chains", COUNT),
        ("warmup", SMALL),
        ("thin", SMALL_COUNT),
        ("target_accept", BETWEEN),
        (
            "metric",
            Range::Either(&[
                Range::Words(&["diagonal", "dense", "low-rank", "unit"]),
                Range::Either(&[Range::List(&POSITIVE), Range::List(&Range::List(&FINITE))]),
            ]),
        ),
        ("step_size", Range::Optional(&POSITIVE)),
        ("climb", SMALL),
        ("tries", COUNT),
    ];
}

/// The metric of chains.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
enum MetricForm {
    /// A shape that the warm-up fits.
    Fitted(Shape),
    /// Variances of the coordinates, constant throughout.
    Variances(Vec<f64>),
    /// A covariance by rows, constant throughout.
    Covariance(Vec<Vec<f64>>),
}

impl MetricForm {
    /// The shape to fit, and the given metric; `None` for numbers that are no covariance.
    fn read(&self) -> Option<(Shape, Option<Metric>)> {
        let metric = match self {
            MetricForm::Fitted(shape) => return Some((*shape, None)),
            MetricForm::Variances(variances) => Metric::diagonal(variances.clone()),
            MetricForm::Covariance(rows) if rows.iter().all(|row| row.len() == rows.len()) => {
                Metric::dense(rows.concat())?
            }
            MetricForm::Covariance(_) => return None,
        };
        Some((Shape::Unit, Some(metric)))
    }
}

/// Variational inference.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vi {
    family: Normals,
    start: normals::Start,
    draws: usize,
    steps: u32,
    samples: usize,
    tolerance: f64,
    paths: usize,
    tries: u64,
}

impl Vi {
    /// Ranges of its settings.
    const RANGES: Ranges = &[
        ("family", Range::Words(&["mean-field", "full-rank", "pathfinder"])),
        ("start", Range::Words(&["pathfinder", "run"])),
        ("draws", COUNT),
        ("steps", SMALL_COUNT),
        ("samples", COUNT),
        ("tolerance", POSITIVE),
        ("paths", COUNT),
        ("tries", COUNT),
    ];
}

/// The normals of variational inference.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Normals {
    MeanField,
    FullRank,
    Pathfinder,
}

/// Reads the name of a strategy.
fn strategy<'de, D: serde::Deserializer<'de>>(from: D) -> Result<Strategy, D::Error> {
    let name = String::deserialize(from)?;
    Strategy::from_name(&name).ok_or_else(|| serde::de::Error::custom(format!("no strategy `{name}`")))
}

/// The inputs of a search besides its method.
#[derive(Clone, Copy, Default)]
pub struct Inputs<'a> {
    /// The seed of all random numbers.
    pub seed: u64,
    /// The users' proposals and the guides that the method's kernels name by number.
    pub attached: &'a [Attached],
    /// The first run of a chain of whole runs, or of a search for the best.
    pub start: Option<&'a [Entry]>,
    /// The outputs of a search for the best while it runs.
    pub outputs: Outputs<'a>,
}

/// The result of a search.
pub struct Results {
    /// Finished runs.
    pub runs: Vec<Run>,
    /// Whether the search was stopped before its end.
    pub interrupted: bool,
    /// Further results, by the kind of method.
    pub info: Info,
}

/// Further results of a search, by the kind of method.
pub enum Info {
    /// Results of forward runs.
    Forward,
    /// Results of likelihood weighting.
    Importance {
        /// Log of the mean weight, nats; `None` if the search was stopped.
        log_evidence: Option<f64>,
    },
    /// Results of rejection sampling.
    Rejection {
        /// The number of runs, with rejected ones.
        tries: u64,
    },
    /// Results of annealed importance sampling; the particles are the runs.
    Annealed(Annealed),
    /// Results of enumeration, whose runs are not stored.
    Enumeration(niwaki_run::enumeration::Enumerated),
    /// Results of populations, and their particles that became impossible; the other particles are the runs.
    Populations(niwaki_particles::Result, Lost),
    /// Results of a chain of whole runs; its states are the runs.
    Chain(niwaki_particles::Chain),
    /// Results of a search for the best.
    Improved(Improved),
}

/// A callback that gets the progress of a search (done, ended, best log score) and returns whether to continue.
pub type Watch<'a> = dyn FnMut(u64, usize, f64) -> bool + Send + 'a;

impl Method {
    /// Reads a method from its text.
    ///
    /// # Errors
    /// A text that is no method, or a setting that the method does not have.
    pub fn read(text: &str) -> Result<Method, Fault> {
        let unread = |error: serde_json::Error| bad(format!("the method {text}: {error}"));
        let settings: Map<String, serde_json::Value> = serde_json::from_str(text).map_err(unread)?;
        let name = settings.get("method").and_then(serde_json::Value::as_str).unwrap_or_default();
        for ranges in Method::ranges(name) {
            setting::check(ranges, &settings)?;
        }
        let method = Method::deserialize(serde_json::Value::Object(settings.clone())).map_err(unread)?;
        let unknown = match &method {
            Method::Smc(smc) => smc.common.rest.keys().next(),
            Method::ParticleGibbs(gibbs) => gibbs.common.rest.keys().next(),
            Method::Pimh(pimh) => pimh.common.rest.keys().next(),
            Method::Hmc(hmc) => hmc.rest.keys().next(),
            Method::Nuts(nuts) => nuts.rest.keys().next(),
            _ => None,
        };
        if let Some(name) = unknown {
            return Err(bad(format!("the method {text} has no setting `{name}`")));
        }
        match method.broken_rule() {
            None => Ok(method),
            Some((name, rule)) => Err(Fault::refused(name, settings[name].to_string(), Expected::Rule(rule))),
        }
    }

    /// Ranges of the settings of a method, by its name.
    fn ranges(name: &str) -> Vec<Ranges> {
        match name {
            "forward" => vec![&[("n", COUNT)]],
            "enumerate_all" => vec![&[("max_runs", COUNT), ("rest", FINITE)]],
            "rejection" => vec![&[("n", COUNT), ("bound", FINITE), ("max_tries", COUNT)]],
            "importance" => vec![&[("n", COUNT)]],
            "ais" => vec![Ais::RANGES],
            "smc" => vec![Smc::RANGES, Populations::RANGES, Settings::RANGES],
            "particle_gibbs" => vec![ParticleGibbs::RANGES, Populations::RANGES, Settings::RANGES],
            "pimh" => vec![Pimh::RANGES, Populations::RANGES, Settings::RANGES],
            "improve" => vec![Improve::RANGES],
            "mh" => vec![Mh::RANGES],
            "hmc" => vec![Hmc::RANGES, Trajectories::RANGES],
            "nuts" => vec![Nuts::RANGES, Trajectories::RANGES],
            "vi" => vec![Vi::RANGES],
            _ => vec![],
        }
    }

    /// The first setting that breaks a rule about several settings, and the rule.
    fn broken_rule(&self) -> Option<BrokenRule> {
        match self {
            Method::Ais(own) => own.broken_rule(),
            Method::Smc(own) => own.broken_rule(),
            Method::Improve(own) => own.broken_rule(),
            Method::Mh(own) => (own.warmup >= own.steps).then_some(("warmup", "warmup-steps")),
            Method::Hmc(Hmc { common, .. }) | Method::Nuts(Nuts { common, .. }) => {
                common.metric.read().is_none().then_some(("metric", "metric-numbers"))
            }
            Method::Vi(own) => {
                let is_path = matches!(own.family, Normals::Pathfinder);
                (is_path && own.start == normals::Start::Run).then_some(("start", "pathfinder-start"))
            }
            _ => None,
        }
    }

    /// Searches a task, by any method except those whose chains can continue afterwards: see
    /// [`Mh::settings`] and [`Method::trajectories`].
    ///
    /// # Errors
    /// The failure of the method.
    pub fn search(
        &self,
        task: &Task,
        inputs: &Inputs<'_>,
        watch: &mut Watch<'_>,
    ) -> Result<Results, Failure> {
        self.results(task, inputs, watch).map_err(|failure| explained(failure, task))
    }

    fn results(&self, task: &Task, inputs: &Inputs<'_>, watch: &mut Watch<'_>) -> Result<Results, Failure> {
        let seed = inputs.seed;
        let bare = |runs, interrupted, info| Results { runs, interrupted, info };
        let none = f64::NEG_INFINITY;
        let mut progress = |p: Progress| watch(p.barriers as u64, p.ended, p.best);
        match self {
            Method::Forward { n } => {
                let (mut runs, mut count, mut all) = (Vec::new(), 0, AllInvalid::default());
                while count < *n && watch(count, 0, none) {
                    match forward(task, seed, count, true) {
                        Err(Failure::Run(fault)) if task.invalid.count(&fault).is_some() => {
                            all.note(Some(&Arc::new(*fault)));
                        }
                        run => {
                            runs.push(run?);
                            all.note(None);
                        }
                    }
                    count += 1;
                }
                all.check()?;
                let interrupted = count < *n;
                Ok(bare(runs, interrupted, Info::Forward))
            }
            Method::Importance { n, proposal } => {
                let proposal = proposed(proposal.as_ref(), inputs)?;
                let result =
                    importance(task, proposal.as_deref(), *n, seed, &mut |runs| watch(runs as u64, 0, none))?;
                let interrupted = result.runs.len() < *n;
                let log_evidence = (!interrupted).then_some(result.log_evidence);
                Ok(bare(result.runs, interrupted, Info::Importance { log_evidence }))
            }
            Method::Rejection { n, bound, max_tries } => {
                let result =
                    rejection(task, *n, *bound, *max_tries, seed, &mut |tries| watch(tries, 0, none))?;
                Ok(bare(result.runs, result.interrupted, Info::Rejection { tries: result.tries }))
            }
            Method::EnumerateAll { max_runs, likely, rest } => {
                let visits = if *likely {
                    Visit::Likely { runs: *max_runs, rest: *rest }
                } else {
                    Visit::All(*max_runs)
                };
                let result = visit(task, visits, &mut |runs| watch(runs as u64, 0, none))?;
                Ok(bare(vec![], false, Info::Enumeration(result)))
            }
            Method::Ais(ais) => {
                let ended = Mutex::new((0, none, watch));
                let watch = |best: f64| {
                    let mut ended = ended.lock().unwrap_or_else(PoisonError::into_inner);
                    let (n, highest, watch) = &mut *ended;
                    *n += usize::from(best > none);
                    *highest = highest.max(best);
                    watch(*n as u64, *n, *highest)
                };
                let mut result = annealed(task, &ais.settings(inputs)?, &watch)?;
                let runs = std::mem::take(&mut result.runs);
                Ok(bare(runs, result.interrupted, Info::Annealed(result)))
            }
            Method::Smc(smc) => {
                let settings = smc.settings(inputs)?;
                let mut result = match smc.seconds {
                    Some(time) => {
                        let time = Duration::try_from_secs_f64(time).unwrap_or(Duration::ZERO);
                        within(task, &settings, time, &mut progress)?
                    }
                    None => populations(task, &settings, &smc.plan(), &mut progress)?,
                };
                let runs = std::mem::take(&mut result.particles);
                let lost = std::mem::take(&mut result.losses).explained(task);
                Ok(bare(runs, result.interrupted, Info::Populations(result, lost)))
            }
            Method::ParticleGibbs(gibbs) => {
                let settings = gibbs.settings(inputs)?;
                let ancestors = if gibbs.ancestors { Ancestors::Sampled } else { Ancestors::Kept };
                let result =
                    particle_gibbs(task, &settings, ancestors, gibbs.sweeps, inputs.start, &mut progress)?;
                Ok(of_chain(result))
            }
            Method::Pimh(method) => {
                let settings = method.common.settings(method.particles, inputs)?;
                Ok(of_chain(pimh(task, &settings, method.sweeps, &mut progress)?))
            }
            Method::Improve(improve) => {
                let proposal = proposed(improve.proposal.as_ref(), inputs)?;
                let (runs, result) =
                    improve.search(task, seed, proposal, inputs.start, inputs.outputs, &mut progress)?;
                Ok(bare(runs, result.interrupted, Info::Improved(result)))
            }
            Method::Mh(_) | Method::Hmc(_) | Method::Nuts(_) | Method::Vi(_) => {
                Err(bad("a method of chains or normals is started, not searched".into()).into())
            }
        }
    }

    /// The settings of chains that follow the gradient, the number of chains, and the most forward runs for
    /// the start of each. `None` for a method without a gradient.
    ///
    /// # Errors
    /// Numbers that are no metric.
    pub fn trajectories(&self) -> Result<Option<(hamiltonian::Settings, usize, u64)>, Fault> {
        let (length, common) = match self {
            Method::Hmc(hmc) => (Length::Fixed { steps: hmc.steps, jitter: hmc.jitter }, &hmc.common),
            Method::Nuts(nuts) => (Length::NoUTurn { max_depth: nuts.max_depth }, &nuts.common),
            _ => return Ok(None),
        };
        let read = common.metric.read();
        let (shape, metric) = read.ok_or_else(|| bad("`metric` is no covariance".into()))?;
        let settings = hamiltonian::Settings {
            length,
            climb: common.climb,
            warmup: common.warmup,
            draws: common.draws,
            thin: common.thin,
            target_accept: common.target_accept,
            shape,
            metric,
            step_size: common.step_size,
            ..hamiltonian::Settings::nuts()
        };
        Ok(Some((settings, common.chains, common.tries)))
    }

    /// The plan of a variational inference. `None` for any other method.
    pub fn normals<'a>(
        &self,
        seed: u64,
        known: Option<&'a HashMap<u128, Value>>,
    ) -> Option<normals::Plan<'a>> {
        let Method::Vi(vi) = self else { return None };
        let family = match vi.family {
            Normals::MeanField => Some(Family::MeanField),
            Normals::FullRank => Some(Family::FullRank),
            Normals::Pathfinder => None,
        };
        let Vi { start, draws, steps, samples, tolerance, paths, tries, .. } = *vi;
        Some(normals::Plan { family, start, draws, steps, samples, tolerance, paths, seed, tries, known })
    }

    /// Refuses settings that make no sense for an inference inside a model, which gives a single value for each seed.
    ///
    /// # Errors
    /// Such a setting, by name, or a method whose result is not a sample.
    pub fn check_inside(&self) -> Result<(), Fault> {
        let refuse = |name: &str, reason: &str| {
            Err(Fault::new(
                "infer-method",
                format!("inside a model {reason}, so `{name}` has no meaning there"),
            ))
        };
        match self {
            Method::Smc(smc) if smc.seconds.is_some() => refuse("seconds", "a clock may not decide a value"),
            Method::Smc(smc) if smc.diverse.is_some() => refuse("diverse", "`infer` gives one value"),
            Method::Mh(mh) if mh.thin.is_some() => refuse("thin", "the samples of a chain are not kept"),
            Method::Mh(mh) if mh.keep.is_some() => refuse("keep", "the samples of a chain are not kept"),
            Method::EnumerateAll { likely: true, .. } => {
                refuse("likely", "a part of the runs is no distribution")
            }
            Method::Hmc(_) => refuse("hmc", "chains cannot start along a gradient"),
            Method::Improve(_) => refuse("improve", "a search for the best is no sample"),
            Method::Nuts(_) => refuse("nuts", "chains cannot start along a gradient"),
            Method::Vi(_) => refuse("vi", "no gradient is followed"),
            Method::Importance { proposal, .. } => {
                proposed(proposal.as_ref(), &Inputs::default()).map(|_| ())
            }
            Method::Ais(ais) => ais.settings(&Inputs::default()).map(|_| ()),
            Method::Smc(smc) => smc.settings(&Inputs::default()).map(|_| ()),
            Method::ParticleGibbs(gibbs) => gibbs.settings(&Inputs::default()).map(|_| ()),
            Method::Pimh(pimh) => pimh.common.settings(pimh.particles, &Inputs::default()).map(|_| ()),
            Method::Mh(mh) => mh.settings(&Inputs::default()).map(|_| ()),
            _ => Ok(()),
        }
    }
}

impl Ais {
    fn broken_rule(&self) -> Option<BrokenRule> {
        let has_powers = |kernel: &Form| kernel.has(&["anneal", "tempering"]);
        if !self.powers.rise() {
            return Some(("powers", "powers-rising"));
        }
        self.kernel.as_ref().is_some_and(has_powers).then_some(("kernel", "kernel-powers"))
    }

    fn settings(&self, inputs: &Inputs<'_>) -> Result<annealed::Settings, Fault> {
        let kernel = self.kernel.as_ref().map(|form| form.kernel(inputs.attached)).transpose()?;
        Ok(annealed::Settings {
            particles: self.particles,
            powers: self.powers.ladder(),
            kernel: kernel.unwrap_or(Kernel::PRIOR),
            moves: self.moves,
            tries: self.tries,
            seed: inputs.seed,
        })
    }
}

impl Smc {
    fn broken_rule(&self) -> Option<BrokenRule> {
        let common = &self.common;
        let (is_absolute, has_sizes) =
            (common.settings.weights == Weights::Absolute, matches!(self.particles, Sizes::List(_)));
        let moved = self.rejuvenate.as_ref();
        let rules = [
            (self.seconds.is_some() && self.populations.is_some(), "populations", "seconds-alone"),
            (self.seconds.is_some() && has_sizes, "particles", "seconds-alone"),
            (self.populations.is_some() && has_sizes, "populations", "sizes-alone"),
            (
                is_absolute && common.settings.resampling == Resampling::Tempered,
                "resampling",
                "tempered-absolute",
            ),
            (is_absolute && common.proposal.is_some(), "proposal", "proposal-absolute"),
            (is_absolute && moved.is_some(), "rejuvenate", "moves-absolute"),
            (is_absolute && common.settings.anneal != Anneal::Constant, "anneal", "anneal-absolute"),
            (moved.is_none() && self.draws.is_some(), "draws", "draws-kernel"),
            (self.draws.is_none() && self.chains != 1, "chains", "chains-draws"),
            (moved.is_none() && self.moves != 1, "moves", "moves-kernel"),
            (moved.is_none() && self.at != Moment::Every(1), "at", "moves-kernel"),
            (moved.is_some_and(|form| form.has(&["anneal", "tempering"])), "rejuvenate", "moves-powers"),
            (
                self.at != Moment::End && moved.is_some_and(|form| form.has(&["hmc_step", "nuts_step"])),
                "rejuvenate",
                "gradient-end",
            ),
            (
                common.look_ahead.is_some() && moved.is_some() && self.at != Moment::End,
                "look_ahead",
                "look-ahead-moves",
            ),
        ];
        rules.into_iter().find(|(is_broken, ..)| *is_broken).map(|(_, name, rule)| (name, rule))
    }

    /// The settings of its populations.
    fn settings(&self, inputs: &Inputs<'_>) -> Result<Settings, Fault> {
        let rejuvenate = match &self.rejuvenate {
            None => None,
            Some(form) => Some(Rejuvenation {
                kernel: form.kernel(inputs.attached)?,
                moves: self.moves,
                at: self.at,
                final_chains: self.draws.map(|draws| FinalChains { chains: self.chains, draws }),
            }),
        };
        let particles = self.plan().first().copied().unwrap_or(0);
        Ok(Settings { rejuvenate, ..self.common.settings(particles, inputs)? })
    }

    /// Sizes of the populations without a time limit. Each different result needs a population, unless chains give the results.
    fn plan(&self) -> Vec<usize> {
        match &self.particles {
            Sizes::List(sizes) => sizes.clone(),
            Sizes::Each(size) => {
                let different = self.diverse.filter(|_| self.draws.is_none());
                vec![*size; self.populations.or(different).unwrap_or(1)]
            }
        }
    }
}

impl ParticleGibbs {
    fn settings(&self, inputs: &Inputs<'_>) -> Result<Settings, Fault> {
        let settings = self.common.settings(self.particles, inputs)?;
        // Only these kinds of resampling have a conditional form: see `particle_gibbs`.
        let resampling = match settings.resampling {
            Resampling::Tempered => Resampling::Tempered,
            _ => Resampling::Multinomial,
        };
        Ok(Settings { resampling, ..settings })
    }
}

impl Populations {
    /// The settings of a population of this size.
    fn settings(&self, particles: usize, inputs: &Inputs<'_>) -> Result<Settings, Fault> {
        let proposal = proposed(self.proposal.as_ref(), inputs)?;
        let look_ahead = ahead(self.look_ahead, proposal.as_deref())?;
        Ok(Settings { particles, seed: inputs.seed, proposal, look_ahead, ..self.settings.clone() })
    }
}

impl Mh {
    /// The settings of the chains.
    ///
    /// # Errors
    /// An unknown kernel.
    pub fn settings(&self, inputs: &Inputs<'_>) -> Result<niwaki_chain::Settings, Fault> {
        let plain = niwaki_chain::Settings::default();
        let tempered = self.kernel.as_ref().map(|form| form.tempered(inputs.attached)).transpose()?;
        let settings = niwaki_chain::Settings {
            seed: inputs.seed,
            strategy: self.strategy,
            warmup: self.warmup,
            thin: self.spacing(),
            tries: self.tries,
            ..plain
        };
        Ok(match tempered {
            None => settings,
            Some(tempered) => niwaki_chain::Settings {
                kernel: tempered.kernel,
                powers: tempered.powers,
                every: tempered.every,
                ..settings
            },
        })
    }

    /// Proposals between two samples; 0 for none.
    fn spacing(&self) -> u64 {
        match (self.keep.unwrap_or(KEPT), self.thin) {
            (0, _) => 0,
            (_, Some(thin)) => thin,
            (keep, None) => self.steps.saturating_sub(self.warmup).div_ceil(keep).max(1),
        }
    }
}

/// The proposal for the choices of new runs.
fn proposed(form: Option<&Form>, inputs: &Inputs<'_>) -> Result<Option<Arc<Proposal>>, Fault> {
    let Some(form) = form else { return Ok(None) };
    Ok(Some(Arc::new(form.kernel(inputs.attached)?.proposal()?)))
}

/// The look-ahead of weights: a share of the forecast by a guide of the proposal.
fn ahead(strength: Option<f64>, proposal: Option<&Proposal>) -> Result<Option<LookAhead>, Fault> {
    let Some(strength) = strength else { return Ok(None) };
    match proposal.and_then(Proposal::forecast) {
        Some(forecast) => Ok(Some(LookAhead { strength, forecast })),
        None => Err(Fault::new("guide-ahead", "no guide of this search has learned to look ahead")
            .with_help("teach its guide by `niwaki.guides.train_look_ahead`, or give no `look_ahead`")),
    }
}

fn of_chain(mut chain: niwaki_particles::Chain) -> Results {
    let runs = std::mem::take(&mut chain.states);
    Results { runs, interrupted: chain.interrupted, info: Info::Chain(chain) }
}

fn bad(message: String) -> Fault {
    Fault::new("bad-setting", message)
        .with_help("use the functions of `niwaki.methods`, which check the settings")
}

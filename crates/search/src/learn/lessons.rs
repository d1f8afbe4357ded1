//! Traces as rows for a network, and training.
//!
//! A trace is followed again, in its order, with its scene. At each choice the code that draws for guides looks at the run; its
//! inputs and the value of the trace are a row. So a guide is trained on the same bits that it gets later.

use super::credit::Objective;
use super::drawings;
use super::survey::Survey;
use niwaki_geom::WindowForm;
use niwaki_guide::{Net, NetForm, Progress, Rows, Stored, Training, Unfit, Way, train_along};
use niwaki_math::Dist;
use niwaki_propose::guide::bound::{BoundGuide, Sight};
use niwaki_propose::guide::form::GuideForm;
use niwaki_propose::guide::{Guide, Network};
use niwaki_propose::particle::Particle;
use niwaki_run::checkpoint::{Checkpoint, unfit};
use niwaki_run::chooser::{Chooser, Chosen, Context, Refuse};
use niwaki_run::log::Entry;
use niwaki_run::record::Record;
use niwaki_run::replay::{by_address, picks};
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::state::State;
use niwaki_vm::value::Value;
use rayon::prelude::*;
use serde::Deserialize;
use std::collections::HashMap;
use std::sync::Arc;

/// A trace: a task and the choices of a run of it.
pub struct Example {
    /// The task, its program compiled to keep all variables.
    pub task: Task,
    /// The choices.
    pub entries: Vec<Entry>,
    /// Whether the trace judges guides, and is not used for learning.
    pub held_out: bool,
}

/// The observer of the choices of a trace.
type Each<'a> = dyn FnMut(&At<'_, f64>, &Dist, Context<'_>, &Value) -> Result<(), Fault> + 'a;

/// Gives choices the values of a trace, and passes them to the observer.
struct Shown<'a, 'e> {
    values: &'a HashMap<u128, Value>,
    each: &'a mut Each<'e>,
}

impl Chooser for Shown<'_, '_> {
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let Some(value) = self.values.get(&seen.address) else {
            return Refuse("give traces of the model that is trained").choose(at, dist, seen);
        };
        (self.each)(at, dist, seen, value)?;
        Chosen::given(value.clone(), dist).map(Some)
    }
}

/// Follows a trace in its order, with its scene; `each` gets its choices.
pub(super) fn follow(example: &Example, each: &mut Each<'_>) -> Result<(), Failure> {
    let Example { task, entries, .. } = example;
    let (values, mut next) = (by_address(entries), picks(entries));
    let depth_first = !entries.iter().any(Entry::is_order);
    let mut machine = task.machine();
    let mut start = task.start(&machine, depth_first)?;
    start.note_parts();
    let mut record = Record::start(&task.sketches);
    record.sketches.expect_windows();
    let pick = |state: &State| next(state).unwrap_or(0);
    let shown = Shown { values: &values, each };
    Particle::start(start, record, 0, 0).finish_by(&mut machine, task, pick, shown)
}

/// The settings of a guide's training.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Making {
    /// The model's name.
    pub model: String,
    /// The kind of network.
    #[serde(default)]
    pub architecture: Architecture,
    /// The quantity that training raises.
    #[serde(default)]
    pub objective: Objective,
    /// Runs of a target in a step, if training raises a bound.
    #[serde(default = "usual_runs")]
    pub runs: usize,
    /// Units of the hidden layers.
    pub hidden: [usize; 2],
    /// Gaussians of each mixture.
    pub components: usize,
    /// The share of the prior.
    pub share: f64,
    /// The images that the guide sees.
    pub looks: Looks,
    /// The variables in scope that the guide reads.
    pub reads: Reads,
    /// Steps; if `None`, `passes` decides.
    pub steps: Option<u64>,
    /// Number of passes over the choices, but at least 1,500 steps and at most 12,000.
    pub passes: f64,
    /// Adam's rate.
    pub rate: f64,
    /// Adam's decays of mean and square.
    #[serde(default = "usual_decays")]
    pub decays: [f64; 2],
    /// Choices of a step; traces for the dissertation's architecture, targets for a bound.
    pub batch: usize,
    /// The share of the averaged weights that stays in a step.
    pub averaging: f64,
    /// The seed of all random numbers.
    pub seed: u64,
}

/// Adam's usual decays.
fn usual_decays() -> [f64; 2] {
    [0.9, 0.999]
}

/// The usual runs of a target in a step.
fn usual_runs() -> usize {
    16
}

/// A kind of network.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case")]
pub enum Architecture {
    /// One net for all choices, which sees windows.
    #[default]
    Shared,
    /// The dissertation's architecture.
    Dissertation,
}

/// The images that a guide sees.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged)]
pub enum Looks {
    /// Target and scene, or neither.
    Both(bool),
    /// Only the target, or only the scene.
    One(Image),
}

/// An image on a page.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case")]
pub enum Image {
    /// The image to match.
    Target,
    /// The image of the run.
    Scene,
}

impl Looks {
    /// Whether the guide sees the target.
    pub fn target(self) -> bool {
        matches!(self, Looks::Both(true) | Looks::One(Image::Target))
    }

    /// Whether the guide sees the scene.
    pub fn scene(self) -> bool {
        matches!(self, Looks::Both(true) | Looks::One(Image::Scene))
    }
}

/// The variables in scope that a guide reads.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Reads {
    /// All variables, with the parameters of priors, or none.
    All(bool),
    /// The variables of these names.
    Names(Vec<String>),
}

impl Reads {
    /// Whether the guide reads any variable.
    pub fn any(&self) -> bool {
        !matches!(self, Reads::All(false))
    }
}

/// Fewest and most steps of a training that is set in passes.
const LEAST: u64 = 1_500;
const MOST: u64 = 12_000;
/// Number of looks at the choices held out.
const LOOKS: u64 = 20;

impl Making {
    /// The training for this number of choices.
    pub(super) fn training(&self, rows: usize) -> Training {
        let steps = (self.passes * rows as f64 / self.batch as f64) as u64;
        let steps = self.steps.unwrap_or(steps.clamp(LEAST, MOST));
        Training {
            rate: self.rate,
            batch: self.batch,
            averaging: self.averaging,
            steps,
            every: steps.div_ceil(LOOKS).max(1),
            share: self.share,
            seed: self.seed,
        }
    }
}

/// The windows of a task's sketches, with names, for sketches that have a window.
fn windows(task: &Task) -> Vec<(String, WindowForm)> {
    let own = task.sketches.iter();
    own.filter_map(|sketch| sketch.window().map(|form| (sketch.name().to_string(), form))).collect()
}

/// The form of a guide for these traces.
///
/// # Errors
/// No traces; a trace that cannot be followed; no choice that a guide can draw.
pub fn survey(examples: &[Example], making: &Making) -> Result<GuideForm, Failure> {
    let Some(first) = examples.first() else {
        return Err(Fault::new("guide-traces", "there are no traces to learn from")
            .with_help("give targets that the model can reach")
            .into());
    };
    let mut survey = Survey::default();
    for example in examples {
        survey.add(example, making.components)?;
    }
    let windowed =
        making.architecture == Architecture::Shared && making.looks.target() && making.looks.scene();
    let windows = if windowed { windows(&first.task) } else { vec![] };
    let mut form = survey.form(&first.task.program, &making.model, making.share, windows)?;
    match &making.reads {
        Reads::All(true) => {}
        Reads::All(false) => form.keep_only(&[]),
        Reads::Names(names) => form.keep_only(names),
    }
    Ok(form)
}

/// The rows of traces; in the order of the traces, on all threads.
pub(super) fn rows(examples: &[&Example], guide: &Arc<Guide>, form: &NetForm) -> Result<Rows, Failure> {
    let one = |example: &&Example| -> Result<Rows, Failure> {
        let bound = BoundGuide::new(guide.clone(), &example.task)?;
        let (mut rows, mut sight) = (Rows::new(form), Sight::default());
        rows.trace();
        follow(example, &mut |at, dist, seen, value| {
            let Some(site) = bound.look(at, dist, seen, &mut sight, 0) else { return Ok(()) };
            if let Some(lesson) = bound.lesson(site, dist, value) {
                let (window, features) = sight.inputs();
                rows.push(site, window, features, &lesson);
            }
            Ok(())
        })?;
        Ok(rows)
    };
    let parts = examples.par_iter().map(one).collect::<Result<Vec<_>, Failure>>()?;
    let mut all = Rows::new(form);
    parts.iter().for_each(|part| all.append(part));
    Ok(all)
}

/// For each trace, the number of choices that a guide draws, and their sum of `ln(p / q)`, nats: how much less likely they are
/// under the guide than under the prior.
///
/// # Errors
/// A trace that cannot be followed; a guide that does not fit its task.
pub fn losses(examples: &[Example], guide: &Arc<Guide>) -> Result<Vec<(usize, f64)>, Failure> {
    let one = |example: &Example| -> Result<(usize, f64), Failure> {
        let bound = BoundGuide::new(guide.clone(), &example.task)?;
        let (mut sight, mut sum) = (Sight::default(), (0, 0.0));
        follow(example, &mut |at, dist, seen, value| {
            if let (Some(site), Some(draw)) = (bound.look(at, dist, seen, &mut sight, 0), value.draw()) {
                sum.0 += 1;
                sum.1 += dist.log_density(&draw) - bound.log_of(site, dist, &draw, &mut sight);
            }
            Ok(())
        })?;
        Ok(sum)
    };
    examples.par_iter().map(one).collect()
}

/// Trains a guide on traces, or trains the guide `start` further. `watch` returns false to stop with the best so far.
/// The training is part 0 of the `checkpoint`, stored between two steps; a resumed training makes its rows again.
///
/// # Errors
/// No traces; a trace that cannot be followed.
pub fn train(
    examples: &[Example],
    making: &Making,
    start: Option<&Guide>,
    watch: &mut dyn FnMut(Progress) -> bool,
    checkpoint: Option<&Checkpoint>,
) -> Result<Taught, Failure> {
    let mut border = |content: &dyn Fn() -> Stored| {
        checkpoint.inspect(|own| own.at_border(0, content));
    };
    let way = Way { left: checkpoint.map_or(Ok(None), |own| own.left(0))?, border: &mut border };
    let mut form = match start {
        Some(start) => start.form.to_train(),
        None => survey(examples, making)?,
    };
    let net = match (start.map(|start| &start.net), examples) {
        (Some(Network::Filtered(net)), _) => {
            return drawings::train(examples, making, form, net.clone(), watch, way);
        }
        (None, [first, ..]) if making.architecture == Architecture::Dissertation => {
            let net = drawings::network(&mut form, making, &first.task)?;
            return drawings::train(examples, making, form, net, watch, way);
        }
        (Some(Network::Shared(net)), _) => net.clone(),
        (None, _) => {
            let heads = form.sites.iter().map(|site| site.head).collect();
            let own = NetForm {
                hidden: making.hidden,
                ..NetForm::new(form.window_values(), form.features(), heads)
            };
            Net::start(own, making.seed)
        }
    };
    let blank = Arc::new(Guide { form, net: Network::Shared(net.clone()) });
    let (judging, learning): (Vec<&Example>, Vec<&Example>) = examples.iter().partition(|one| one.held_out);
    let learned = rows(&learning, &blank, net.form())?;
    let held_out = rows(&judging, &blank, net.form())?;
    let mut form = blank.form.clone();
    let rows = learned.len();
    // The history includes the looks from before the checkpoint.
    let mut history = way.left.as_ref().map_or_else(Vec::new, |left| left.history().to_vec());
    let mut seen = |now: Progress| {
        history.push(now);
        watch(now)
    };
    let trained = train_along(net, &learned, &held_out, &making.training(rows), &mut seen, way);
    let (net, diverged) = match trained.map_err(of_another)? {
        Ok(trained) => (trained.net, None),
        // The best weights before are kept and reported.
        Err(diverged) => {
            let site = diverged.site.map(|site| form.sites[site].label.clone());
            (*diverged.net, Some((diverged.step, site)))
        }
    };
    form.share = making.share;
    Ok(Taught {
        guide: Guide { form, net: Network::Shared(net) },
        rows,
        bytes: learned.bytes() + held_out.bytes(),
        history,
        diverged,
    })
}

/// The failure of a training that cannot resume.
pub(super) fn of_another(_: Unfit) -> Failure {
    unfit("it is of a network of another size")
}

/// The result of training.
pub struct Taught {
    /// The guide.
    pub guide: Guide,
    /// The number of choices for learning.
    pub rows: usize,
    /// Bytes of all rows.
    pub bytes: usize,
    /// The progress at every look at the choices held out.
    pub history: Vec<Progress>,
    /// The step at which training ended early, because of a loss or a slope that is not a finite number; and the label of the
    /// choice if a single choice is the cause.
    pub diverged: Option<(u64, Option<String>)>,
}

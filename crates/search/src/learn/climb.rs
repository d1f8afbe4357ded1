//! Training by the evidence bound: the guide is a family `q` of runs, whose bound is raised (dissertation 2.2.2, variational
//! inference; 6.3 has the other direction, [`train`](super::lessons::train)).
//!
//! ```text
//! log evidence  >=  E_q[log p(run) - log q(run)]
//! ```
//!
//! A step picks targets, draws runs of each by the present guide, depth first, and moves the weights by
//! [`credit`](super::credit). Neither the model nor its scores need a gradient, and every run may have another structure. The
//! inputs and draws of a guide are rows, as for traces, but each run has a signed weight.
//!
//! A run that is impossible, or that a fault ended, counts ten nats less than the worst possible run of its target, and is
//! counted. Random streams are keyed by step and run, so the number of threads changes nothing.

use super::credit::{Objective, bound, credit};
use super::lessons::{Architecture, Example, Making, survey};
use niwaki_guide::{Climb, Net, NetForm, Progress, Rows, Stored, Training};
use niwaki_math::streams::RngCore;
use niwaki_math::{Dist, Stream, StreamKey};
use niwaki_propose::guide::bound::{BoundGuide, Sight};
use niwaki_propose::guide::form::GuideForm;
use niwaki_propose::guide::{Guide, Network};
use niwaki_run::checkpoint::{Checkpoint, unfit};
use niwaki_run::chooser::{Chooser, Chosen, Context, Prior};
use niwaki_run::forward::{forward, forward_by};
use niwaki_run::record::AllInvalid;
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::stack::RunFault;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A target of the runs.
pub struct Case {
    /// The task, its program compiled to keep all variables.
    pub task: Task,
    /// Whether the target judges guides, and is not used for learning.
    pub held_out: bool,
}

/// The result of a climb.
pub struct Climbed {
    /// The best guide, by the bound of the targets that judge; without such targets, by the bound of the last runs.
    pub guide: Guide,
    /// The progress at the looks; losses are bounds with the other sign, nats for each run.
    pub history: Vec<Progress>,
    /// For each look, the number of impossible runs since the look before, and the number of runs that a fault ended.
    pub lost: Vec<[u64; 2]>,
    /// The step at which the climb ended early, because of a number that is not finite or because a fault ended every run of the
    /// step; and the label of the choice if a single choice is the cause.
    pub diverged: Option<(u64, Option<String>)>,
}

/// Steps of a climb without a number of steps.
const STEPS: u64 = 1_000;
/// Number of looks at the targets that judge.
const LOOKS: u64 = 20;
/// Least number of runs of a look; with fewer, an earlier guide could be kept by luck.
const JUDGING: usize = 512;
/// Number of runs that determine the form of a new guide, and means and deviations of its inputs.
const FIRST: usize = 256;

/// The uses of random numbers in a climb, as visits of their streams. Runs of the prior have visit 0.
#[derive(Clone, Copy)]
pub(super) enum Use {
    Scaling = 1,
    Step,
    Look,
    Pick,
}

/// Draws by a guide, and stores its inputs as rows.
struct Noting<'a> {
    guide: &'a BoundGuide,
    stream: StreamKey,
    sight: &'a mut Sight,
    rows: &'a mut Rows,
}

impl Chooser for Noting<'_> {
    fn looks(&self) -> bool {
        true
    }

    fn choose(
        &mut self,
        at: &At<'_, f64>,
        dist: &Dist,
        context: Context<'_>,
    ) -> Result<Option<Chosen>, Fault> {
        let Some(site) = self.guide.look(at, dist, context, self.sight, 0) else {
            return Prior(self.stream).choose(at, dist, context);
        };
        let chosen = self.guide.answer(site, dist, self.sight, &mut self.stream.at(context.address));
        if let Some(lesson) = self.guide.lesson(site, dist, &chosen.value) {
            let (window, features) = self.sight.inputs();
            self.rows.push(site, window, features, &lesson);
        }
        Ok(Some(chosen))
    }
}

/// A run that a guide drew.
pub(super) struct Drawn {
    rows: Rows,
    /// `log p - log q`, nats.
    log_weight: f64,
    /// The fault that makes the run invalid.
    invalid: Option<Arc<RunFault>>,
    /// Any other fault.
    fault: Option<Failure>,
}

/// Draws runs of some targets by a guide, `runs` of each, in order. `first` is the number of the first run's stream.
pub(super) fn draw(
    guide: &Arc<Guide>,
    form: &NetForm,
    tasks: &[&Task],
    runs: usize,
    (purpose, first): (Use, u64),
    seed: u64,
) -> Result<Vec<Vec<Drawn>>, Failure> {
    let bind = |task: &&Task| BoundGuide::new(guide.clone(), task);
    let bound = tasks.iter().map(bind).collect::<Result<Vec<_>, Fault>>()?;
    let all: Vec<(usize, usize)> = (0..tasks.len()).flat_map(|t| (0..runs).map(move |k| (t, k))).collect();
    let draw_run = |sight: &mut Sight, (target, run): &(usize, usize)| {
        let stream = StreamKey::new(seed, first + (target * runs + run) as u64, purpose as u64);
        let mut rows = Rows::new(form);
        rows.trace();
        sight.forget();
        let chooser = Noting { guide: &bound[*target], stream, sight, rows: &mut rows };
        match forward_by(tasks[*target], chooser, false) {
            Ok(run) => Ok(Drawn { rows, log_weight: run.log_weight, invalid: run.invalid, fault: None }),
            Err(Failure::Run(fault)) => {
                let log_weight = f64::NEG_INFINITY;
                Ok(Drawn { rows, log_weight, invalid: None, fault: Some(Failure::Run(fault)) })
            }
            Err(failure) => Err(failure),
        }
    };
    let mut all_runs =
        all.par_iter().map_init(Sight::default, draw_run).collect::<Result<Vec<Drawn>, Failure>>()?;
    let mut groups = Vec::new();
    while !all_runs.is_empty() {
        let rest = all_runs.split_off(all_runs.len().min(runs));
        groups.push(std::mem::replace(&mut all_runs, rest));
    }
    Ok(groups)
}

/// The log weights of a target's runs.
fn logs(group: &[Drawn]) -> Vec<f64> {
    group.iter().map(|run| run.log_weight).collect()
}

/// The first fault, if every run met a fault.
fn fault_of_all(groups: &mut [Vec<Drawn>]) -> Option<Failure> {
    let mut all = groups.iter_mut().flatten();
    if all.any(|run| run.fault.is_none()) { None } else { groups[0][0].fault.take() }
}

/// The rows of some targets' runs, and their weights in the gradient of the mean bound.
pub(super) fn signed(groups: &[Vec<Drawn>], form: &NetForm, objective: Objective) -> (Rows, Vec<f64>) {
    let (mut rows, mut weights) = (Rows::new(form), Vec::new());
    for group in groups {
        for (run, weight) in group.iter().zip(credit(objective, &logs(group))) {
            rows.append(&run.rows);
            weights.resize(rows.len(), weight / groups.len() as f64);
        }
    }
    (rows, weights)
}

/// The mean bound of some targets, nats; `None` if no run is possible.
fn mean_bound(groups: &[Vec<Drawn>], objective: Objective) -> Option<f64> {
    let bounds: Vec<f64> = groups.iter().filter_map(|group| bound(objective, &logs(group))).collect();
    (!bounds.is_empty()).then(|| bounds.iter().sum::<f64>() / bounds.len() as f64)
}

/// A climb between two steps, as data.
#[derive(Serialize, Deserialize)]
struct Left {
    stored: Stored,
    lost: Vec<[u64; 2]>,
    now: Tally,
}

/// Counts since the last look.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct Tally {
    /// The bits of the sum of the steps' bounds.
    sum: u64,
    steps: u64,
    lost: [u64; 2],
}

impl Tally {
    fn add(&mut self, groups: &[Vec<Drawn>], bound: Option<f64>) {
        for run in groups.iter().flatten() {
            let kind = usize::from(run.fault.is_some());
            self.lost[kind] += u64::from(run.log_weight == f64::NEG_INFINITY);
        }
        if let Some(bound) = bound {
            self.sum = (f64::from_bits(self.sum) + bound).to_bits();
            self.steps += 1;
        }
    }

    /// Minus the mean bound, nats.
    fn loss(&self) -> Option<f64> {
        (self.steps > 0).then(|| -f64::from_bits(self.sum) / self.steps as f64)
    }
}

/// The first network, and the form of its guide: those of `start`, or new ones from runs of the prior.
fn begin(learned: &[&Task], making: &Making, start: Option<&Guide>) -> Result<(GuideForm, Net), Failure> {
    let (form, net) = match start.map(|start| (&start.form, &start.net)) {
        Some((form, Network::Shared(net))) => (form.to_train(), net.clone()),
        None if making.architecture == Architecture::Shared => {
            let run = |k: usize| {
                let task = learned[k % learned.len()];
                let entries = forward(task, making.seed, k as u64, true)?.log.entries();
                Ok(Example { task: task.clone(), entries, held_out: false })
            };
            let runs: Vec<Result<Example, Failure>> = (0..FIRST).into_par_iter().map(run).collect();
            let (examples, failed): (Vec<_>, Vec<_>) = runs.into_iter().partition(Result::is_ok);
            let examples: Vec<Example> = examples.into_iter().flatten().collect();
            if let (true, Some(Err(failure))) = (examples.is_empty(), failed.into_iter().next()) {
                return Err(failure);
            }
            let form = survey(&examples, making)?;
            let heads = form.sites.iter().map(|site| site.head).collect();
            let net_form = NetForm {
                hidden: making.hidden,
                ..NetForm::new(form.window_values(), form.features(), heads)
            };
            (form, Net::start(net_form, making.seed))
        }
        _ => {
            return Err(Fault::new(
                "bad-setting",
                "a guide of the dissertation's architecture is trained by examples only",
            )
            .with_help("use `Training.bound()`, or begin with a guide of the usual architecture")
            .into());
        }
    };
    Ok((GuideForm { share: making.share, ..form }, net))
}

/// Raises the bound of a guide on targets, from the guide `start` or from the prior. `watch` sees every step, and returns
/// false to stop with the best so far. The climb is part 0 of the `checkpoint`, stored between two steps.
///
/// # Errors
/// No targets to learn from; a guide that fits none of them, or has the dissertation's architecture; runs that all meet a
/// fault, or are all impossible, before the first step.
pub fn climb(
    cases: &[Case],
    making: &Making,
    start: Option<&Guide>,
    watch: &mut dyn FnMut(Progress) -> bool,
    checkpoint: Option<&Checkpoint>,
) -> Result<Climbed, Failure> {
    let (judging, learning): (Vec<&Case>, Vec<&Case>) = cases.iter().partition(|case| case.held_out);
    let [learned, judged] =
        [learning, judging].map(|some| some.iter().map(|case| &case.task).collect::<Vec<_>>());
    if learned.is_empty() {
        return Err(Fault::new("guide-traces", "there are no targets to learn from").into());
    }
    let (form, net) = begin(&learned, making, start)?;
    let net_form = net.form().clone();
    let guide_of = |net: Net| Arc::new(Guide { form: form.clone(), net: Network::Shared(net) });
    let (objective, seed, runs) = (making.objective, making.seed, making.runs);

    // The runs of the first guide give means and deviations of inputs.
    let each = FIRST.div_ceil(learned.len());
    let mut first = draw(&guide_of(net.clone()), &net_form, &learned, each, (Use::Scaling, 0), seed)?;
    if let Some(failure) = fault_of_all(&mut first) {
        return Err(failure);
    }
    AllInvalid::check_all(first.iter().flatten().map(|run| run.invalid.as_ref()))?;
    if mean_bound(&first, objective).is_none() {
        let message = format!("none of {} runs of the first guide is possible", learned.len() * each);
        return Err(Fault::new("guide-traces", message)
            .with_help("begin with a guide that was trained by examples: `start=guide`")
            .into());
    }
    let (rows, _) = signed(&first, &net_form, objective);
    drop(first);
    let mut state = Climb::new(net, &rows);
    drop(rows);

    let looked_at = judged.repeat(JUDGING.div_ceil(runs * judged.len().max(1)));
    let steps = making.steps.unwrap_or(STEPS);
    let with = Training { every: steps.div_ceil(LOOKS).max(1), steps, ..making.training(0) };
    let (mut history, mut lost, mut now) = (Vec::new(), Vec::new(), Tally::default());
    if let Some(left) = checkpoint.map_or(Ok(None), |checkpoint| checkpoint.left::<Left>(0))? {
        history = state.resume(&left.stored).map_err(|_| unfit("it is of a network of another size"))?;
        (lost, now) = (left.lost, left.now);
    }
    let mut diverged = None;
    let label = |site: Option<usize>| site.map(|site| form.sites[site].label.clone());
    loop {
        let step = state.step();
        let has_looked = history.last().is_some_and(|progress: &Progress| progress.step == step);
        if !has_looked && (step.is_multiple_of(with.every) || step >= with.steps) {
            let guide = guide_of(state.averaged(with.averaging));
            // Each look uses the same random numbers, so that only the guide differs.
            let groups = draw(&guide, &net_form, &looked_at, runs, (Use::Look, 0), seed)?;
            let held_out = mean_bound(&groups, objective).map(|bound| -bound);
            let loss = now.loss().or(held_out).unwrap_or(f64::INFINITY);
            let held_out = if judged.is_empty() { loss } else { held_out.unwrap_or(f64::INFINITY) };
            // Without targets that judge, the last weights count as best.
            state.judge(if judged.is_empty() { -(step as f64) } else { held_out }, with.averaging);
            let (_, least, at) = state.best();
            let best = (if judged.is_empty() { held_out } else { least }, at);
            let progress = Progress { step, steps: with.steps, loss, held_out, best };
            history.push(progress);
            lost.push(now.lost);
            now = Tally::default();
        }
        let latest = *history.last().expect("the start was looked at");
        if !watch(Progress { step, ..latest }) || step >= with.steps {
            break;
        }
        if let Some(checkpoint) = checkpoint {
            checkpoint.at_border(0, || Left { stored: state.stored(&history), lost: lost.clone(), now });
        }
        let mut stream = Stream::new(seed, 0, u128::from(step), Use::Pick as u64);
        #[expect(clippy::cast_possible_truncation, reason = "less than the number of targets")]
        let mut pick = || ((u128::from(stream.next_u64()) * learned.len() as u128) >> 64) as usize;
        let picks: Vec<&Task> = (0..with.batch).map(|_| learned[pick()]).collect();
        let first = step * (with.batch * runs) as u64;
        let mut groups = draw(&guide_of(state.net()), &net_form, &picks, runs, (Use::Step, first), seed)?;
        now.add(&groups, mean_bound(&groups, objective));
        if fault_of_all(&mut groups).is_some() {
            diverged = Some((step + 1, None));
            break;
        }
        let (rows, weights) = signed(&groups, &net_form, objective);
        if let Err(site) = state.advance(&rows, &weights, &with) {
            diverged = Some((step + 1, label(site)));
            break;
        }
    }
    let (net, _, _) = state.best();
    Ok(Climbed { guide: Guide { form, net: Network::Shared(net) }, history, lost, diverged })
}

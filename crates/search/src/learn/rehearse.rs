//! Training of a guide to look ahead (dissertation 7.2.3): its line ([`AheadForm`]) is fitted to the gains of short searches from
//! paused particles (`particles::rises`).
//!
//! Searches by the guide take targets in turn. Each search keeps a few paused particles, and a short search from each particle
//! gives its rise. Ridge regression finds the line; rises of the targets that judge decide its strength. A rise of minus infinity
//! counts as the least finite rise.

use super::climb::Case;
use super::ridge::{Examples, ridge};
use niwaki_chain::kernel::Kernel;
use niwaki_math::streams::RngCore;
use niwaki_particles::Settings;
use niwaki_particles::rises::{paused, plainly, rise};
use niwaki_propose::guide::ahead::{AheadForm, OF_SCORE, inputs, root};
use niwaki_propose::guide::bound::{BoundGuide, Sight};
use niwaki_propose::guide::{Guide, Network};
use niwaki_propose::look_ahead::Paused;
use niwaki_run::Failure;
use niwaki_run::streams::Reserved;
use niwaki_vm::fault::Fault;
use rayon::prelude::*;
use serde::Deserialize;
use std::sync::Arc;

/// The settings of a training to look ahead.
#[derive(Clone, Debug, Deserialize)]
pub struct Rehearsal {
    /// The number of searches.
    pub searches: usize,
    /// Paused particles of each search.
    pub states: usize,
    /// Particles of a search, and of a short search from a paused particle.
    pub particles: [usize; 2],
    /// The settings of both searches.
    pub settings: Settings,
    /// Whether the line sees the network, and not the score alone.
    pub looks: bool,
    /// The seed of all random numbers.
    pub seed: u64,
}

/// The result of a training to look ahead.
pub struct Rehearsed {
    /// The guide, with its line.
    pub guide: Guide,
    /// The number of rises for learning, and of rises that judge.
    pub rises: [usize; 2],
    /// The number of searches from paused particles that died out.
    pub died: usize,
    /// The number of searches that a fault ended.
    pub failed: usize,
    /// Root of the mean square error of the line, for rises of learning and for rises that judge, nats.
    pub error: [f64; 2],
    /// Standard deviation of the rises that judge, nats: the error of the best constant.
    pub deviation: f64,
    /// The strength of the ridge.
    pub strength: f64,
}

/// Searches between two looks of the watch.
const AT_ONCE: usize = 32;
/// Fewest rises for learning.
const LEAST: usize = 20;

/// A paused particle: the inputs of the line, its log score, and its rise, nats.
struct Lesson {
    inputs: Vec<f64>,
    log_score: f64,
    rise: f64,
}

impl Lesson {
    /// The root of the log score that the searches from the particle reached.
    fn root(&self) -> f64 {
        root(self.log_score + self.rise)
    }
}

/// Trains a guide to look ahead. `watch` gets the numbers of searches so far and in total, and returns false to stop early.
///
/// # Errors
/// A guide that does not fit its tasks, or whose choices share no network; too few paused particles.
pub fn rehearse(
    cases: &[Case],
    guide: &Arc<Guide>,
    plan: &Rehearsal,
    watch: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<Rehearsed, Failure> {
    let Network::Shared(net) = &guide.net else {
        let message = "the dissertation's network has no layer that all choices share";
        return Err(Fault::new("bad-setting", message).with_help("train a guide with the shared one").into());
    };
    let width = inputs(net.form().hidden[1]);
    let bound = cases.iter().map(|case| BoundGuide::new(guide.clone(), &case.task).map(Arc::new));
    let bound = bound.collect::<Result<Vec<_>, Fault>>()?;
    let lessons_of = |number: usize| -> Result<Vec<Lesson>, Failure> {
        let case = number % cases.len();
        search(
            &cases[case],
            &bound[case],
            plan,
            Reserved::Paused.stream(plan.seed, number as u128, 2).next_u64(),
        )
    };
    let mut lessons_by_search = vec![];
    let (mut failed, mut fault) = (0, None);
    while lessons_by_search.len() < plan.searches && watch(lessons_by_search.len(), plan.searches) {
        let next: Vec<usize> =
            (lessons_by_search.len()..(lessons_by_search.len() + AT_ONCE).min(plan.searches)).collect();
        let results: Vec<_> = next.par_iter().map(|number| lessons_of(*number)).collect();
        for rises in results {
            match rises {
                Ok(rises) => lessons_by_search.push(rises),
                Err(failure) => {
                    (failed, fault) = (failed + 1, fault.or(Some(failure)));
                    lessons_by_search.push(vec![]);
                }
            }
        }
    }
    let all = || lessons_by_search.iter().flatten();
    let roots = all().map(Lesson::root).filter(|x| x.is_finite());
    let (low, high) =
        roots.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let (mut learned, mut judging) = (Examples::default(), Examples::default());
    for (number, lessons) in lessons_by_search.iter().enumerate() {
        let examples = if cases[number % cases.len()].held_out { &mut judging } else { &mut learned };
        for lesson in lessons {
            let inputs = lesson.inputs.iter().enumerate();
            examples
                .inputs
                .extend(inputs.map(|(k, x)| if plan.looks || OF_SCORE.contains(&k) { *x } else { 0.0 }));
            examples.labels.push(lesson.root().max(low));
        }
    }
    let few = |fault: Option<Failure>, count: usize| {
        let message = format!("{count} paused particles are too few to learn what a run will still gain");
        let few = Fault::new("guide-ahead", message).with_help("give more targets, or more searches");
        fault.unwrap_or_else(|| few.into())
    };
    let line = if learned.labels.len() < LEAST { None } else { ridge(&learned, &judging) };
    let Some(line) = line else { return Err(few(fault, learned.labels.len())) };
    debug_assert_eq!(line.weights.len(), width);
    let judges = if judging.labels.is_empty() { &learned } else { &judging };
    let mean = judges.labels.iter().sum::<f64>() / judges.labels.len() as f64;
    let around = judges.labels.iter().map(|y| (y - mean).powi(2)).sum::<f64>() / judges.labels.len() as f64;
    let error = [learned.error(&line).sqrt(), judges.error(&line).sqrt()];
    let ahead = AheadForm { constant: line.constant, weights: line.weights.clone(), range: (low, high) };
    let mut form = guide.form.clone();
    form.ahead = Some(ahead);
    Ok(Rehearsed {
        guide: Guide { form, net: guide.net.clone() },
        rises: [learned.labels.len(), judging.labels.len()],
        died: all().filter(|lesson| !lesson.rise.is_finite()).count(),
        failed,
        error,
        deviation: around.sqrt(),
        strength: line.strength,
    })
}

/// Inputs and rises of some paused particles of a search.
fn search(case: &Case, guide: &Arc<BoundGuide>, plan: &Rehearsal, seed: u64) -> Result<Vec<Lesson>, Failure> {
    let task = &case.task;
    let proposal = Some(Arc::new(Kernel::guided(guide.clone()).proposal()?));
    let [particles, few] = plan.particles;
    let settings = Settings { particles, seed, proposal, ..plainly(&plan.settings) };
    let (mut machine, mut sight) = (task.machine(), Sight::default());
    let mut lessons = vec![];
    for (number, particle) in paused(task, &settings, plan.states)?.iter_mut().enumerate() {
        let run = Paused { task, record: &particle.record, state: &particle.state };
        let inputs = guide.prospect(run, &mut machine, &mut sight, 0).to_vec();
        let rise = rise(task, &settings, few, particle, number)?;
        lessons.push(Lesson { inputs, log_score: particle.record.log_score(), rise });
    }
    Ok(lessons)
}

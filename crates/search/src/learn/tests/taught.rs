//! A guide that has learnt to look ahead, or whose line is absurd, leaves evidence and posterior right. It
//! foresees by its inputs at the next choices, and learns from right rises.
//!
//! Limits are those of the parent module; about 150 quantities are looked at.

use super::judges::*;
use super::{blank, limbs, trained};
use crate::learn::climb::Case;
use crate::learn::rehearse::{Rehearsal, Rehearsed, rehearse};
use niwaki_chain::kernel::Kernel;
use niwaki_geom::{Drawing, Page, match_drawing};
use niwaki_math::Dist;
use niwaki_particles::rises::{paused, rise};
use niwaki_particles::{Ancestors, Settings, When, smc};
use niwaki_propose::foresight::Foresight;
use niwaki_propose::guide::ahead::AheadForm;
use niwaki_propose::guide::bound::{BoundGuide, Sight};
use niwaki_propose::guide::{Guide, Network};
use niwaki_propose::look_ahead::{Forecast, LookAhead, Paused};
use niwaki_propose::particle::Particle;
use niwaki_propose::proposal::ByProposal;
use niwaki_run::Task;
use niwaki_run::chooser::{Chooser, Chosen, Context, Prior};
use niwaki_run::order::{Order, Past};
use niwaki_run::record::Record;
use niwaki_run::resampling::Resampling;
use niwaki_vm::core::parse::parse;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::passes::{Scope, compile_with_scope};
use std::sync::Arc;

/// Strokes to the left or to the right of a line that the drawing has on one side; where it goes on is a choice.
const STROKES: &str = r#"(module
  (fn "step" (params $x $y $d)
    (do (look (tuple $x $y) (tuple 0.0 1.0)))
    (set $k (sample (dist discrete_uniform -1 1)))
    (do (emit (stroke (tuple $x $y 0.0) (tuple (add $x $k) (add $y 1.0) 0.0) 0.4)))
    (do (look (tuple (add $x $k) (add $y 1.0)) (tuple 0.0 1.0)))
    (if (and (lt $d 2) (sample (dist bernoulli 0.6)))
      (then (return (add (mul 10 (call "step" (add $x $k) (add $y 1.0) (add $d 1))) (add $k 2)))))
    (return (add $k 2)))
  (fn "m" (params) (return (call "step" 0.0 -2.0 0))) (entry "m"))"#;

/// A program compiled to keep all variables.
fn kept(text: &str) -> Task {
    Task::new(Arc::new(compile_with_scope(&parse(text).unwrap(), vec![], Scope::All).unwrap()))
}

fn strokes() -> Task {
    let page = Page::new([-3.0, -3.0], [3.0, 3.0], [12, 12]).unwrap();
    let greys: Vec<u8> = (0..144).map(|pixel| if pixel % 12 > 6 { 0 } else { 255 }).collect();
    let sketch = match_drawing(Arc::new(Drawing::new(page, &greys).unwrap()), 0.4).unwrap();
    Task { sketches: vec![sketch], ..kept(STROKES) }
}

/// All programs, and one with a scene.
fn tasks() -> impl Iterator<Item = (&'static str, Task)> {
    let plain = PROGRAMS.into_iter().map(|(name, text)| (name, kept(text)));
    plain.chain([("strokes on a page", strokes())])
}

/// A particle before its first step, of a run whose scene a guide may see.
fn fresh(task: &Task, order: &Order, lineage: u64, seed: u64) -> Particle {
    let mut state = task.start(&task.machine(), *order == Order::DepthFirst).unwrap();
    state.note_parts();
    let mut record = Record::start(&task.sketches);
    record.sketches.expect_windows();
    Particle { past: Past::start(order), ..Particle::start(state, record, lineage, seed) }
}

/// A particle at its first barrier.
fn at_a_barrier(task: &Task, order: &Order, lineage: u64, seed: u64) -> Particle {
    let mut particle = fresh(task, order, lineage, seed);
    let chooser = Prior(particle.stream);
    particle.advance(&mut task.machine(), task, seed, chooser).unwrap();
    particle
}

fn plan(searches: usize, seed: u64) -> Rehearsal {
    let settings = settings(Order::Stochastic, Resampling::Tempered);
    Rehearsal { searches, states: 3, particles: [6, 5], settings, looks: true, seed }
}

fn learned(task: &Task, guide: &Arc<BoundGuide>, plan: &Rehearsal) -> Rehearsed {
    let case = |held_out| Case { task: task.clone(), held_out };
    rehearse(&[case(false), case(true)], guide.guide(), plan, &mut |_, _| true).unwrap()
}

/// The guide with another line.
fn with_line(guide: &Arc<BoundGuide>, task: &Task, ahead: AheadForm) -> Arc<BoundGuide> {
    let Guide { form, net } = &**guide.guide();
    let form = niwaki_propose::guide::form::GuideForm { ahead: Some(ahead), ..form.clone() };
    Arc::new(BoundGuide::new(Arc::new(Guide { form, net: net.clone() }), task).unwrap())
}

/// A guide with a learnt line, and one with a line that makes no sense.
fn guides(task: &Task) -> [Arc<BoundGuide>; 2] {
    let guide = blank(task);
    let line = learned(task, &guide, &plan(60, 1)).guide.form.ahead.unwrap();
    let absurd = (0..line.weights.len()).map(|k| 40.0 * (7.0 * k as f64).sin()).collect();
    let absurd = AheadForm { constant: 0.3, weights: absurd, range: (-1.5, 1.5) };
    [line, absurd].map(|line| with_line(&guide, task, line))
}

fn looking(guide: &Arc<BoundGuide>, settings: Settings) -> Settings {
    let proposal = Kernel::guided(guide.clone()).proposal().unwrap();
    let look_ahead = Some(LookAhead { strength: 0.6, forecast: proposal.forecast().unwrap() });
    Settings { proposal: Some(Arc::new(proposal)), look_ahead, ..settings }
}

#[test]
fn evidence_and_posterior_are_right_when_a_guide_looks_ahead() {
    let low = When::EffectiveBelow(0.5);
    for (name, task) in tasks() {
        for guide in guides(&task) {
            for (particles, order, resampling, when) in [
                (4, Order::Stochastic, Resampling::Tempered, When::Always),
                (8, Order::DepthFirst, Resampling::Multinomial, low),
            ] {
                let base = Settings { particles, when, ..settings(order.clone(), resampling) };
                let scores = z_scores(&task, &looking(&guide, base), 0..2500);
                let line = &guide.guide().form.ahead;
                assert!(worst(&scores) < LIMIT, "{name}, {order:?}, {line:?}: {scores:?}");
            }
        }
    }
}

#[test]
fn particle_gibbs_keeps_the_posterior_when_a_guide_looks_ahead() {
    for (name, task) in tasks().step_by(2) {
        let starts = exact_draws(&task, 3000);
        for guide in guides(&task) {
            let base = Settings { particles: 3, ..settings(Order::Stochastic, Resampling::Tempered) };
            let values = values_after(&task, &starts, &looking(&guide, base), Ancestors::Sampled, 2);
            let scores = counted(&task, &values);
            assert!(worst(&scores) < LIMIT, "{name}: {scores:?}");
        }
    }
}

/// Draws by a guide, and adds up the second hidden layers.
struct Noting<'a> {
    by: ByProposal<'a, Prior>,
    guide: &'a BoundGuide,
    layers: &'a mut Vec<Vec<f64>>,
}

impl Chooser for Noting<'_> {
    fn choose(
        &mut self,
        at: &At<'_, f64>,
        dist: &Dist,
        seen: Context<'_>,
    ) -> std::result::Result<Option<Chosen>, Fault> {
        let Network::Shared(net) = &self.guide.guide().net else { panic!("another network") };
        let mut sight = Sight::default();
        let site = self.guide.look(at, dist, seen, &mut sight, 0).expect("a site that it draws");
        let mut layer = vec![0.0; net.form().hidden[1]];
        sight.hidden(net, site, &mut layer);
        self.layers.push(layer);
        self.by.choose(at, dist, seen)
    }
}

#[test]
fn guides_foresee_by_the_inputs_of_the_next_choice() {
    let task = limbs();
    let guide = blank(&task);
    let proposal = Kernel::guided(guide.clone()).proposal().unwrap();
    let (mut machine, mut sight, mut compared) = (task.machine(), Sight::default(), 0);
    for lineage in 0..6 {
        let mut p = fresh(&task, &Order::DepthFirst, lineage, 3);
        let mut before: Option<Vec<f64>> = None;
        while p.is_running() {
            let (stream, otherwise) = (p.stream, Prior(p.stream));
            let (mut drawing, mut layers) = (Sight::default(), vec![]);
            let by = ByProposal { proposal: &proposal, stream, sight: &mut drawing, fallback: otherwise };
            p.advance(&mut machine, &task, 3, Noting { by, guide: &guide, layers: &mut layers }).unwrap();
            if let (Some(before), Some(layer)) = (before.take(), layers.first()) {
                assert_eq!(before[..2], [1.0, 0.0]);
                assert_eq!(&before[6..6 + layer.len()], layer);
                let scaled: Vec<f64> = layer.iter().map(|h| before[2] * h).collect();
                assert_eq!(before[6 + layer.len()..], scaled);
                compared += 1;
            }
            if p.is_running() {
                let run = Paused { task: &task, record: &p.record, state: &p.state };
                let seen = guide.prospect(run, &mut machine, &mut sight, 0).to_vec();
                assert!((seen[3] - p.record.log_score().abs()).abs() < 1e-12);
                before = Some(seen);
            }
        }
    }
    assert!(compared > 20, "{compared}");
}

#[test]
fn futures_are_foreseen_together() {
    // At the barrier after their creation, two futures come to a choice, one to a barrier, and one waits for a choice's future.
    let task = kept(
        r#"(module (fn "a" (params) (set $x (sample (dist bernoulli 0.5))) (do (factor 0.1)) (return $x))
            (fn "b" (params) (do (factor 0.2)) (return 1)) (fn "c" (params $h) (return (force $h)))
            (fn "m" (params) (set $h (future "a")) (do (future "b")) (do (future "c" $h)) (do (factor -4.0))
              (set $y (sample (dist bernoulli 0.3))) (do (factor (cond $y 0.0 1.0))) (return $y)) (entry "m"))"#,
    );
    let guide = blank(&task);
    let start = task.start(&task.machine(), false).unwrap();
    let mut particle = Particle::start(start, niwaki_run::record::Record::start(&[]), 0, 1);
    let prior = Prior(particle.stream);
    particle.advance_by(&mut task.machine(), &task, |_, _| Some(0), prior).unwrap();
    let run = Paused { task: &task, record: &particle.record, state: &particle.state };
    assert_eq!(run.state.runnable().len(), 4);
    let mut sight = Sight::default();
    let seen = guide.prospect(run, &mut task.machine(), &mut sight, 0);
    assert_eq!(seen[..6], [2.0, 1.0, -2.0, 4.0, -4.0, -2.0]);
    // The run itself has not moved.
    assert_eq!((particle.state.runnable().len(), particle.record.log.entries().len()), (4, 0));
}

#[test]
fn the_rise_is_from_the_score_now_to_the_foreseen_one() {
    let line = AheadForm { constant: -1.0, weights: vec![0.5, 2.0], range: (-3.0, 4.0) };
    assert_eq!(line.rise(&[1.0, 1.0], -10.0), 1.5 * 1.5 + 10.0);
    assert_eq!(line.rise(&[1.0, -1.0], -10.0), -2.5 * 2.5 + 10.0);
    assert_eq!(line.rise(&[0.0, -9.0], 2.0), -9.0 - 2.0);
    assert_eq!(line.rise(&[0.0, 9.0], 2.0), 16.0 - 2.0);
}

/// The inputs for the forecast are those of the draws; a forecast without strength changes no choice.
#[test]
fn a_glance_changes_no_draw() {
    for task in [strokes(), limbs()] {
        let guide = trained(&task);
        let line = AheadForm { constant: 1.0, weights: vec![0.1; inputs(&guide)], range: (-2.0, 2.0) };
        let guide = with_line(&guide, &task, line);
        let settings_ahead =
            Settings { particles: 40, seed: 9, ..settings(Order::Stochastic, Resampling::Tempered) };
        let settings_ahead = looking(&guide, settings_ahead);
        let weak = settings_ahead.look_ahead.clone().map(|ahead| LookAhead { strength: 1e-300, ..ahead });
        let choices = |look_ahead: Option<LookAhead>| {
            let result =
                smc(&task, &Settings { look_ahead, ..settings_ahead.clone() }, &mut |_| true).unwrap();
            let logs = result.particles.iter().map(|p| p.log.entries());
            logs.map(|log| log.iter().map(written).collect::<Vec<_>>()).collect::<Vec<_>>()
        };
        assert_eq!(choices(weak), choices(None));
        assert_ne!(choices(settings_ahead.look_ahead.clone()), choices(None));
    }
}

fn inputs(guide: &BoundGuide) -> usize {
    let Network::Shared(net) = &guide.guide().net else { return 0 };
    6 + 2 * net.form().hidden[1]
}

#[test]
fn guides_without_a_line_do_not_look_ahead() {
    let task = strokes();
    let [taught, _] = guides(&task);
    let plain = Kernel::guided(blank(&task));
    assert!(plain.proposal().unwrap().forecast().is_none());
    let both = Kernel::Cycle(vec![plain, Kernel::guided(taught.clone())]);
    let forecast = format!("{:?}", both.proposal().unwrap().forecast().unwrap());
    assert_eq!(forecast, format!("{:?}", Foresight { guide: taught.clone(), owner: 1 }));
    // Further training changes the network, for which the line was fitted.
    assert_eq!(taught.guide().form.to_train().ahead, None);
}

/// A coin after the first barrier: the rise is known.
const COIN: &str = r#"(module (fn "m" (params)
    (do (factor 0.4))
    (set $a (sample (dist bernoulli 0.3)))
    (do (factor (cond $a 0.7 -1.1)))
    (return $a)) (entry "m"))"#;

/// Mean of 4,000 estimates, within five standard errors: a false alarm once in 1.7 million.
#[test]
fn a_rise_is_an_estimate_without_bias() {
    let task = kept(COIN);
    let settings_of_rise = Settings { seed: 1, ..settings(Order::DepthFirst, Resampling::Systematic) };
    let mut particle = at_a_barrier(&task, &settings_of_rise.order, 0, settings_of_rise.seed);
    assert!((particle.record.log_score() - 0.4).abs() < 1e-9);
    let truth = 0.3 * 0.7_f64.exp() + 0.7 * (-1.1_f64).exp();
    let n = 4000;
    let errors: Vec<f64> = (0..n)
        .map(|number| rise(&task, &settings_of_rise, 3, &mut particle, number).unwrap().exp() - truth)
        .collect();
    let mean = errors.iter().sum::<f64>() / n as f64;
    let error = (errors.iter().map(|x| (x - mean).powi(2)).sum::<f64>()).sqrt() / n as f64;
    assert!(error > 1e-3 && mean.abs() < 5.0 * error, "{mean} {error}");
    // A particle that cannot continue never gains anything.
    let doomed = kept(
        r#"(module (fn "m" (params) (do (factor 0.4)) (set $a (sample (dist bernoulli 0.3)))
            (do (condition (and $a (not $a)))) (return $a)) (entry "m"))"#,
    );
    let mut particle = at_a_barrier(&doomed, &settings_of_rise.order, 0, settings_of_rise.seed);
    assert_eq!(rise(&doomed, &settings_of_rise, 3, &mut particle, 0).unwrap(), f64::NEG_INFINITY);
}

/// Eight barriers, of which the last is reached by ended particles only: seven are as likely. Each count is binomial; a z
/// beyond 5 once in 1.7 million.
#[test]
fn each_barrier_is_as_likely_to_be_kept() {
    let task = kept(
        r#"(module (fn "m" (params) (set $s 0) (for $i (range 7) (body
            (set $s (add $s (sample (dist discrete_uniform 0 1)))) (do (factor 0.1)))) (return $s)) (entry "m"))"#,
    );
    let mut counts = [0.0; 7];
    let n = 3000.0;
    for seed in 0..3000 {
        let base = Settings { seed, ..settings(Order::DepthFirst, Resampling::Systematic) };
        for particle in paused(&task, &base, 2).unwrap() {
            let at = (particle.record.log_score() / 0.1).round() as usize;
            counts[at - 1] += 1.0;
        }
    }
    let p: f64 = 2.0 / 7.0;
    for count in counts {
        assert!((count - n * p).abs() < 5.0 * (n * p * (1.0 - p)).sqrt(), "{counts:?}");
    }
}

#[test]
fn guides_learn_the_gain_of_paused_runs() {
    let task = strokes();
    let result = learned(&task, &blank(&task), &plan(400, 2));
    assert!(result.rises.iter().sum::<usize>() > 600 && result.rises[1] > 200, "{:?}", result.rises);
    assert_eq!((result.failed, result.died), (0, 0));
    assert!(result.error[1] < 0.8 * result.deviation, "{:?} {}", result.error, result.deviation);
}

/// A line in the score alone says the same whether it looks or not.
#[test]
fn the_score_alone_is_enough_for_a_line() {
    let task = strokes();
    let guide = blank(&task);
    let blind = learned(&task, &guide, &Rehearsal { looks: false, ..plan(60, 2) }).guide.form.ahead.unwrap();
    assert!(blind.weights.iter().enumerate().all(|(k, weight)| (2..4).contains(&k) || *weight == 0.0));
    let foresight = Foresight { guide: with_line(&guide, &task, blind.clone()), owner: 0 };
    let (mut machine, mut sight) = (task.machine(), Sight::default());
    for lineage in 0..8 {
        let p = at_a_barrier(&task, &Order::Stochastic, lineage, 0);
        let run = Paused { task: &task, record: &p.record, state: &p.state };
        let inputs = guide.prospect(run, &mut machine, &mut sight, 0).to_vec();
        let expected = blind.rise(&inputs, p.record.log_score());
        assert_eq!(foresight.rise(run, &mut machine, &mut sight), expected);
    }
}

#[test]
fn teaching_depends_on_the_seed_alone() {
    let task = strokes();
    let guide = blank(&task);
    let bytes = |threads: usize, seed| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| learned(&task, &guide, &plan(40, seed)).guide.bytes())
    };
    assert_eq!(bytes(1, 5), bytes(3, 5));
    assert_ne!(bytes(1, 5), bytes(1, 6));
    let whole = Guide::of_bytes(&bytes(1, 5)).unwrap();
    assert_eq!(whole.bytes(), bytes(1, 5));
    // A line of another length is no guide.
    let mut form = whole.form.clone();
    form.ahead.as_mut().unwrap().weights.pop();
    let bad = Guide { form, net: whole.net }.bytes();
    assert_eq!(Guide::of_bytes(&bad).unwrap_err().code, "bad-guide");
}

#[test]
fn too_few_paused_particles_are_a_message() {
    let task = kept(r#"(module (fn "m" (params) (return (sample (dist bernoulli 0.5)))) (entry "m"))"#);
    let guide = blank(&task);
    let case = Case { task: task.clone(), held_out: false };
    let failure = rehearse(&[case], guide.guide(), &plan(10, 1), &mut |_, _| true).err().unwrap();
    assert!(failure.to_string().contains("0 paused particles"), "{failure}");
}

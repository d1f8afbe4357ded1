//! The claim: under a learned order policy evidence, posterior, particle Gibbs and moves are as right as under the uniform
//! one, the policy has the probabilities that its formula says, and threads change nothing.
//!
//! Thresholds are those of the parent module: a z beyond 5 happens once in 1.7 million.

use super::rejuvenated::{draws, moved_draws};
use super::*;
use niwaki_chain::kernel::Kernel;
use niwaki_geom::Primitive;
use niwaki_geom::sketch::{Sketch, SketchSpec};
use niwaki_run::log::Entry;
use niwaki_run::rejection::rejection;
use niwaki_run::run::Run;

/// A policy far from uniform, on every program: whatever waited is left to wait, and names count.
fn skewed() -> Order {
    let functions = [("leaf", 0.7), ("late", -1.0), ("user", 0.8), ("branch", -0.5), ("m", -0.6)];
    Order::Learned(Arc::new(Policy {
        functions: functions.map(|(name, log)| (name.to_string(), log)).into(),
        depth: 1.0,
        turns: -0.8,
        waited: -0.7,
        stay: 1.2,
    }))
}

fn with_futures() -> impl Iterator<Item = (&'static str, &'static str)> {
    PROGRAMS.into_iter().filter(|(_, text)| text.contains("future"))
}

#[test]
fn evidence_and_posterior_are_right_under_a_learned_order() {
    for (name, text) in with_futures() {
        for resampling in [Resampling::Systematic, Resampling::Tempered] {
            let scores = z_scores(&task(text), &settings(skewed(), resampling), 0..4000);
            assert!(worst(&scores) < LIMIT, "{name}, {resampling:?}: {scores:?}");
        }
    }
}

#[test]
fn particle_gibbs_keeps_the_posterior_under_a_learned_order() {
    for (name, text) in with_futures() {
        let task = task(text);
        let starts = exact_draws(&task, 6000);
        for ancestors in [Ancestors::Kept, Ancestors::Sampled] {
            let scores = counted(&task, &values_after(&task, &starts, &small(4, skewed()), ancestors, 3));
            assert!(worst(&scores) < LIMIT, "{name}, {ancestors:?}: {scores:?}");
        }
    }
}

/// As for the uniform order, on the program in which prefixes differ in the futures that can run.
#[test]
fn ancestors_count_the_learned_order_of_what_follows() {
    let task = task(PROGRAMS[7].1);
    let starts = exact_draws(&task, 20_000);
    let scores = counted(&task, &values_after(&task, &starts, &small(3, skewed()), Ancestors::Sampled, 4));
    assert!(worst(&scores) < LIMIT, "{scores:?}");
}

/// Three leaves, of which two have names that the policy knows. (A future that neither draws nor scores has returned at once.)
const LEAVES: &str = r#"(module (fn "a" (params) (do (factor 0.0)) (return 0))
    (fn "b" (params) (return (sample (dist bernoulli 0.5)))) (fn "c" (params) (return (sample (dist bernoulli 0.5))))
    (fn "m" (params) (set $x (sample (dist bernoulli 0.0001))) (do (condition $x)) (do (future "a")) (do (future "b"))
      (do (future "c")) (return 0)) (entry "m"))"#;

/// `a` weighs 2, `c` 1/2, and one that has just run 3. Orders by the first three picks, where each is among more than one.
fn expected(order: &[usize]) -> f64 {
    // Which futures can run, in order; `a` needs two turns.
    let (mut can, mut p, mut last) = (vec!["a", "b", "c"], 1.0, "");
    let mut turned = false;
    for pick in order {
        let weigh = |name: &&str| match (*name, *name == last) {
            ("a", false) => 2.0,
            ("a", true) => 6.0,
            ("c", _) => 0.5,
            _ => 1.0,
        };
        p *= weigh(&can[*pick]) / can.iter().map(weigh).sum::<f64>();
        last = can[*pick];
        if last == "a" && !turned {
            turned = true;
        } else {
            can.remove(*pick);
        }
    }
    p
}

fn known() -> Order {
    let functions = [("a".to_string(), 2.0f64.ln()), ("c".to_string(), 0.5f64.ln())].into();
    Order::Learned(Arc::new(Policy { functions, stay: 3.0f64.ln(), ..Policy::default() }))
}

fn picks(entries: &[Entry]) -> Vec<usize> {
    entries.iter().filter_map(Entry::which).collect()
}

/// Chi-square of counts of orders against the formula; the false-alarm rate is 1e-6 for 11 degrees of freedom or fewer.
fn check_orders(all: &[Vec<usize>]) {
    let mut counts: HashMap<&[usize], f64> = HashMap::new();
    all.iter().for_each(|order| *counts.entry(order).or_insert(0.0) += 1.0);
    let n = all.len() as f64;
    let mass: f64 = counts.keys().map(|order| expected(order)).sum();
    assert!((mass - 1.0).abs() < 1e-9 && (6..=12).contains(&counts.len()), "{mass}: {counts:?}");
    let term =
        |(order, count): (&&[usize], &f64)| (count - n * expected(order)).powi(2) / (n * expected(order));
    let statistic: f64 = counts.iter().map(term).sum();
    assert!(statistic < 48.9, "{statistic}: {counts:?}");
}

#[test]
fn a_policy_has_the_probabilities_of_its_formula() {
    let text = LEAVES.replace("0.0001", "1.0");
    let settings = Settings {
        particles: 20_000,
        order: known(),
        seed: 3,
        when: When::EffectiveBelow(0.0),
        ..Settings::default()
    };
    let run = smc(&task(&text), &settings, &mut |_| true).unwrap();
    let all: Vec<_> = run.particles.iter().map(|p| picks(&p.log.entries())).collect();
    check_orders(&all);
}

/// All other particles die at once and none is resampled, so each sweep keeps the held run; only its order can change.
#[test]
fn the_held_run_is_ordered_anew_in_each_sweep() {
    let task = task(LEAVES);
    let accepted = rejection(&task, 1, 0.0, u64::MAX, 1, &mut |_| true).unwrap();
    let start = accepted.runs[0].log.entries();
    let when = When::EffectiveBelow(0.0);
    let settings = Settings { order: known(), when, seed: 5, ..small(2, Order::Stochastic) };
    let chain = particle_gibbs(&task, &settings, Ancestors::Kept, 4000, Some(&start), &mut |_| true).unwrap();
    let all: Vec<_> = chain.states.iter().map(|state| picks(&state.log.entries())).collect();
    check_orders(&all);
}

/// A post carries a beam: a scene with a beam alone is forbidden, so that only one of two orders is possible.
#[derive(Clone, Default)]
struct Carried {
    posts: usize,
    beams: usize,
}

impl Carried {
    fn count(&mut self, primitive: &Primitive) -> &mut usize {
        let extent = primitive.shapes()[0].aabb().high - primitive.shapes()[0].aabb().low;
        if extent.y > extent.x { &mut self.posts } else { &mut self.beams }
    }
}

impl Sketch for Carried {
    fn add(&mut self, primitive: &Primitive) {
        *self.count(primitive) += 1;
    }
    fn remove(&mut self, primitive: &Primitive) -> bool {
        let count = self.count(primitive);
        *count = count.saturating_sub(1);
        true
    }
    fn log_score(&self) -> f64 {
        if self.beams > self.posts { f64::NEG_INFINITY } else { 0.0 }
    }
    fn measures(&self) -> Vec<(&'static str, f64)> {
        vec![]
    }
}

impl SketchSpec for Carried {
    fn name(&self) -> &'static str {
        "carried"
    }
}

/// The held run keeps its order where the new one leads through a scene that is forbidden.
#[test]
fn an_order_that_is_impossible_is_not_taken() {
    let text = r#"(module (fn "post" (params) (do (emit (box (tuple 0.0 0.0 0.0) (tuple 0.2 2.0 0.2)))) (return 0))
        (fn "beam" (params) (do (emit (box (tuple 0.0 1.0 0.0) (tuple 2.0 0.2 0.2)))) (return 0))
        (fn "m" (params) (set $x (sample (dist bernoulli 0.5))) (do (future "beam")) (do (future "post"))
          (return $x)) (entry "m"))"#;
    let task = Task { sketches: vec![Arc::new(Carried::default())], ..task(text) };
    for order in [Order::Stochastic, skewed()] {
        let settings = Settings { seed: 4, ..small(3, order) };
        let chain = particle_gibbs(&task, &settings, Ancestors::Sampled, 200, None, &mut |_| true).unwrap();
        // The root has returned before the first pick; then the post runs, which was created second.
        let first = |state: &Run| *picks(&state.log.entries()).first().unwrap();
        assert_eq!(chain.states.len(), 200);
        assert!(chain.states.iter().all(|state| first(state) == 1));
    }
}

#[test]
fn threads_change_nothing_under_a_learned_order() {
    let task = task(PROGRAMS[5].1);
    let settings = Settings { particles: 100, seed: 5, order: skewed(), ..Settings::default() };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let run = smc(&task, &settings, &mut |_| true).unwrap();
            let logs: Vec<Vec<_>> = run
                .particles
                .iter()
                .map(|p| p.log.entries().iter().map(|e| (e.address(), written(e))).collect())
                .collect();
            (run.log_evidence.unwrap().to_bits(), logs)
        })
    };
    assert_eq!(run(1), run(2));
}

/// A coin decides which function a future calls, so how likely the order is depends on the coin: a move that turns it would
/// keep the futures, their paths and the barrier. (The uniform order does not see which function it is.)
const TURNED: &str = r#"(module (fn "leaf" (params) (do (factor -0.1)) (return 0)) (fn "late" (params) (do (factor 0.1))
      (return 1)) (fn "x" (params) (do (factor 0.0)) (return 2))
    (fn "m" (params) (set $c (sample (dist bernoulli 0.5))) (set $f (cond $c (closure "leaf") (closure "late")))
      (do (future_apply $f)) (do (future "x")) (do (future "x")) (return $c)) (entry "m"))"#;

#[test]
fn moves_keep_the_law_under_a_learned_order() {
    let texts = with_futures().map(|(_, text)| text).chain([TURNED]);
    for text in texts {
        let task = task(text);
        for barriers in 1..=3 {
            let (worst, states, _) =
                on_one_thread(|| moved_draws(&task, &draws(Kernel::PRIOR, skewed(), 1.7), barriers));
            assert!(worst < LIMIT, "barrier {barriers}: z {worst}, {states} states: {text}");
        }
    }
}

/// Particles with equal logs are copies of one another, so a policy has seen the same of each.
#[test]
fn a_copy_has_the_past_of_its_parent() {
    let task = task(PROGRAMS[5].1);
    let settings =
        Settings { particles: 60, order: skewed(), ..settings(Order::Stochastic, Resampling::Multinomial) };
    let mut population = Population::start(&task, &settings, true).unwrap();
    let (mut seen, mut copies) = (HashMap::new(), 0);
    for _ in 0..3 {
        population.advance(None).unwrap();
        population.weigh().unwrap();
        population.resample(None).unwrap();
        for p in population.settled() {
            p.past.look(&task.program, &p.state);
            let logs = p.past.logs(&p.state).unwrap();
            let choices: Vec<_> = p.record.log.entries().iter().map(|e| (e.address(), written(e))).collect();
            if !p.state.has_ended() {
                copies += 1;
                assert_eq!(
                    seen.entry((choices, p.state.suspension_hash())).or_insert_with(|| logs.clone()),
                    &logs
                );
            }
        }
    }
    assert!(copies > 100 && seen.len() > 3, "{copies} particles, {} states", seen.len());
}

/// A policy of zeros gives the same picks as the uniform order, from the same bits.
#[test]
fn a_policy_of_zeros_is_the_uniform_order() {
    for (_, text) in with_futures() {
        let seeded = |order| Settings { seed: 1, ..settings(order, Resampling::Systematic) };
        let orders = |order| -> Vec<_> {
            let result = smc(&task(text), &seeded(order), &mut |_| true).unwrap();
            result.particles.iter().map(|p| picks(&p.log.entries())).collect()
        };
        assert_eq!(orders(Order::Stochastic), orders(Order::Learned(Arc::default())));
    }
}

//! The claim: for any order policy and any resampling method, the evidence of ratio weights is unbiased and the
//! final set follows the posterior, on programs with and without changing structure. (The list of
//! deliberate errors has the common errors in particle filters, each with the test here that rejects it.)
//!
//! The answers come from enumeration. Each test averages `exp(log_evidence)` over 4,000 runs of 8 particles with
//! fixed seeds and compares with a z-score. A z beyond 5 happens once in 1.7 million runs of a correct program
//! (normal approximation); with about 60 quantities looked at, a re-seeded suite fails once in 29,000 runs.

use super::copies::{Copies, copy};
use super::population::Population;
use super::*;
use crate::enumeration::enumerate;
use crate::particle::Particle;
use crate::task::Task;
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use niwaki_vm::value::repr;
use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

mod annealed;
mod chains;
mod final_chains;
mod in_lanes;
mod look_ahead;
mod ordered;
mod proposed;
mod rejuvenated;
mod seeing;
mod several;
mod taught;
mod tempered;

fn task(text: &str) -> Task {
    Task::new(Arc::new(compile(&parse(text).unwrap(), vec![]).unwrap()))
}

/// The value of an entry as text; of an order choice, which future ran.
fn written(entry: &crate::log::Entry) -> String {
    entry.which().map_or_else(|| repr(&entry.value).unwrap(), |which| format!("future {which}"))
}

/// Programs whose answer is known by enumeration.
const PROGRAMS: [(&str, &str); 11] = [
    (
        "two coins and a condition on each",
        r#"(module (fn "m" (params)
            (set $a (sample (dist bernoulli 0.3)))
            (do (factor (cond $a -0.5 0.0)))
            (set $b (sample (dist bernoulli 0.6)))
            (do (factor (cond (or $a $b) 0.0 -1.5)))
            (return (tuple $a $b))) (entry "m"))"#,
    ),
    (
        "a chain of three states",
        r#"(module (const 0 (list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4))
              (dist categorical (list 0.3 0.3 0.4))))
            (const 1 (list (dist bernoulli 0.9) (dist bernoulli 0.5) (dist bernoulli 0.2)))
            (fn "m" (params)
            (set $s 0)
            (for $i (range 4) (body
              (set $s (sample (index (data 0) $s)))
              (do (observe (index (data 1) $s) (eq (mod $i 2) 0)))))
            (return $s)) (entry "m"))"#,
    ),
    (
        "as many choices as an earlier one says",
        r#"(module (fn "m" (params)
            (set $n (sample (dist discrete_uniform 0 3)))
            (set $sum 0)
            (for $i (range $n) (body
              (set $x (sample (dist discrete_uniform 0 2)))
              (set $sum (add $sum $x))
              (do (factor (mul -0.4 $x)))))
            (do (factor (cond (eq $sum 2) 0.5 -0.5)))
            (return (tuple $n $sum))) (entry "m"))"#,
    ),
    (
        "a random recursion that ends early or late",
        r#"(module (fn "grow" (params $d)
            (do (factor -0.3))
            (if (and (lt $d 4) (sample (dist bernoulli 0.6)))
              (then (return (add 1 (call "grow" (add $d 1))))) (else (return 0))))
            (fn "m" (params) (set $k (call "grow" 0)) (do (factor (mul 0.5 $k))) (return $k)) (entry "m"))"#,
    ),
    (
        "futures that grow side by side",
        r#"(module (fn "side" (params $p)
            (set $a (sample (dist bernoulli $p)))
            (do (factor (cond $a 0.4 -0.8)))
            (if $a (then (set $b (sample (dist bernoulli 0.5))) (do (factor (cond $b -1.0 0.3))) (return (cond $b 2 1))))
            (return 0))
            (fn "m" (params)
            (set $x (future "side" 0.4)) (set $y (future "side" 0.7))
            (set $c (sample (dist bernoulli 0.5)))
            (do (factor (cond $c -0.7 0.2)))
            (return (tuple (force $x) (force $y) $c))) (entry "m"))"#,
    ),
    (
        "a tree of futures",
        r#"(module (fn "branch" (params $d)
            (set $k (sample (dist discrete_uniform 0 2)))
            (do (factor (sub 0.3 (mul 0.4 $k))))
            (if (and (lt $d 1) (gt $k 0)) (then
              (set $l (future "branch" (add $d 1)))
              (set $r (future "branch" (add $d 1)))
              (return (add $k (add (force $l) (force $r)))) ))
            (return $k))
            (fn "m" (params) (return (call "branch" 0))) (entry "m"))"#,
    ),
    (
        "a wait for a future that is not yet there, and a hard constraint",
        r#"(module (fn "late" (params) (set $v (sample (dist discrete_uniform 1 3))) (do (factor (mul -0.2 $v)))
              (return $v))
            (fn "user" (params $h) (do (factor -0.1)) (set $v (force $h)) (set $w (sample (dist bernoulli 0.5)))
              (do (condition (or $w (lt $v 3)))) (return (add (mul 10 $v) (cond $w 1 0))))
            (fn "m" (params) (set $h (future "late")) (set $u (future "user" $h)) (do (factor 0.1))
              (return (force $u))) (entry "m"))"#,
    ),
    (
        "a wait that comes sooner or later: as many barriers, and other futures that can run",
        r#"(module (fn "early" (params $c) (if $c (then (do (factor 0.0))))
              (set $v (sample (dist bernoulli 0.4))) (do (factor (cond $v 0.3 -0.3))) (return $v))
            (fn "user" (params $h $c) (if (not $c) (then (do (factor -0.1)))) (set $v (force $h))
              (do (factor (cond $v -0.2 0.0))) (return $v))
            (fn "m" (params) (set $c (sample (dist bernoulli 0.5))) (set $h (future "early" $c))
              (set $u (future "user" $h $c)) (return $c)) (entry "m"))"#,
    ),
    (
        "futures that a branch, a list and an expression hold",
        r#"(module (fn "leaf" (params $p) (do (factor -0.1)) (set $v (sample (dist bernoulli $p)))
              (do (factor (cond $v 0.3 -0.3))) (return $v))
            (fn "m" (params) (set $f (cond (sample (dist bernoulli 0.5)) (future "leaf" 0.4) none))
              (set $fs (list (future "leaf" 0.7) $f)) (set $v (force $f)) (do (factor (cond (eq $v none) 0.0 1.0)))
              (set $n 0) (for $i (range 2) (body (set $w (force (index $fs $i)))
                (set $n (add (mul 2 $n) (cond $w 1 0))) (do (factor (cond $w 0.2 0.0)))))
              (return (tuple $v $n))) (entry "m"))"#,
    ),
    (
        "distributions that are invalid in a call, in a future and at an observation",
        r#"(module (fn "leaf" (params $k) (set $x (sample (dist binomial (sub $k 1) 0.5)))
              (do (factor (mul 0.2 $x))) (return $x))
            (fn "m" (params)
            (set $n (sample (dist discrete_uniform 0 3)))
            (do (factor (mul -0.3 $n)))
            (set $h (future "leaf" $n))
            (set $a (sample (dist bernoulli (div (sub 5 $n) 4.0))))
            (if $a (then (set $b (call "leaf" (sub $n 1)))) (else (set $b 0)))
            (do (observe (dist gaussian 0.0 (sub $n (cond $a 2.0 0.5))) 0.5))
            (return (tuple $n $a $b (force $h)))) (entry "m"))"#,
    ),
    (
        "shapes that cannot be in a future and in iterations",
        r#"(module (fn "leaf" (params $k) (set $x (sample (dist bernoulli 0.4)))
              (do (emit (disc (tuple 0.0 0.0 0.0) (sub $k 0.5)))) (do (factor (cond $x 0.2 0.0))) (return $x))
            (fn "m" (params)
            (set $n (sample (dist discrete_uniform 0 4)))
            (do (factor (mul -0.3 $n)))
            (set $h (future "leaf" $n))
            (set $c 0)
            (for $i (range 2) (body (if (sample (dist bernoulli 0.5))
              (then (set $c (add $c 1)) (do (emit (ellipse (tuple $i 0.0 0.0) 1.0 (sub 3.5 $n))))))))
            (return (tuple $n $c (force $h)))) (entry "m"))"#,
    ),
];

/// Mean and standard error of the evidence, relative to the truth, and of each outcome's share of it.
fn z_scores(task: &Task, settings: &Settings, seeds: std::ops::Range<u64>) -> Vec<(String, f64)> {
    z_scores_of(task, &|seed| smc(task, &Settings { seed, ..settings.clone() }, &mut |_| true), seeds)
}

/// The same of any search that has a seed.
fn z_scores_of(
    task: &Task,
    search: &(dyn Fn(u64) -> std::result::Result<Result, crate::Failure> + Sync),
    seeds: std::ops::Range<u64>,
) -> Vec<(String, f64)> {
    on_one_thread(|| z_scores_here(task, search, seeds))
}

/// For many small searches, which gain nothing from more threads; the same bits.
fn on_one_thread<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(work)
}

fn z_scores_here(
    task: &Task,
    search: &dyn Fn(u64) -> std::result::Result<Result, crate::Failure>,
    seeds: std::ops::Range<u64>,
) -> Vec<(String, f64)> {
    let n = (seeds.end - seeds.start) as f64;
    let exact = enumerate(task, 100_000, &mut |_| true).unwrap();
    let z = exact.log_evidence;
    let truth: Vec<(String, f64)> =
        exact.outcomes.iter().map(|(v, log)| (repr(v).unwrap(), (log - z).exp())).collect();
    // Estimates of Z p(outcome) / Z: the run's evidence times the outcome's share of the weight, unbiased.
    let mut sums: HashMap<&str, (f64, f64)> = HashMap::new();
    for seed in seeds {
        let run = match search(seed) {
            Ok(run) => run,
            // All impossible: an estimate of zero.
            Err(failure) if failure.is_impossible() => continue,
            Err(other) => panic!("{other}"),
        };
        let evidence = (run.log_evidence.unwrap() - z).exp();
        let weights: Vec<f64> = run.particles.iter().map(|p| p.log_weight.exp()).collect();
        let total: f64 = weights.iter().sum();
        let mut shares: HashMap<String, f64> = HashMap::new();
        for (p, w) in run.particles.iter().zip(&weights) {
            *shares.entry(repr(&p.value).unwrap()).or_insert(0.0) += w / total;
        }
        let mut add = |name, x: f64| {
            let s = sums.entry(name).or_insert((0.0, 0.0));
            (s.0, s.1) = (s.0 + x, s.1 + x * x);
        };
        add("evidence", evidence);
        for (name, _) in &truth {
            add(name, evidence * shares.get(name).copied().unwrap_or(0.0));
        }
    }
    let all = std::iter::once(("evidence".to_string(), 1.0)).chain(truth.clone());
    all.map(|(name, expected)| {
        let (sum, squares) = sums.get(name.as_str()).copied().unwrap_or((0.0, 0.0));
        let mean = sum / n;
        let error = ((squares / n - mean * mean) / n).sqrt().max(1e-12);
        (name, (mean - expected) / error)
    })
    .collect()
}

const LIMIT: f64 = 5.0;

fn worst(scores: &[(String, f64)]) -> f64 {
    scores.iter().map(|s| s.1.abs()).fold(0.0, f64::max)
}

/// The orders of a program: without futures both are the same to the bit.
fn orders(text: &str) -> impl Iterator<Item = Order> {
    let first = text.contains("future").then_some(Order::DepthFirst);
    first.into_iter().chain([Order::Stochastic])
}

fn settings(order: Order, resampling: Resampling) -> Settings {
    Settings { particles: 8, order, resampling, ..Settings::default() }
}

#[test]
fn evidence_and_posterior_are_right_for_every_order_and_resampling() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        for order in orders(text) {
            for resampling in Resampling::ALL {
                let scores = z_scores(&task, &settings(order.clone(), resampling), 0..4000);
                assert!(worst(&scores) < LIMIT, "{name}, {order:?}, {resampling:?}: {scores:?}");
            }
        }
    }
}

#[test]
fn adaptive_resampling_is_right_too() {
    for (name, text) in PROGRAMS {
        let settings = Settings {
            when: When::EffectiveBelow(0.5),
            ..settings(Order::Stochastic, Resampling::Systematic)
        };
        let scores = z_scores(&task(text), &settings, 0..4000);
        assert!(worst(&scores) < LIMIT, "{name}: {scores:?}");
    }
}

/// What fixed seeds hide: ten times the runs, from a fresh seed that is printed.
#[test]
#[ignore = "long; `make soak` runs it"]
fn fresh_seeds_agree_too() {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap();
    let first = now.as_secs() << 20;
    println!("seeds from {first}");
    for (name, text) in PROGRAMS {
        let task = task(text);
        for order in orders(text) {
            for resampling in Resampling::ALL {
                let scores = z_scores(&task, &settings(order.clone(), resampling), first..first + 40_000);
                assert!(worst(&scores) < LIMIT, "{name}, {order:?}, {resampling:?}: {scores:?}");
            }
        }
    }
}

/// Any order gives the right answer, so the tests above do not show which future is picked. Chi-square with 5 degrees of
/// freedom, false alarm 1e-6, threshold 35.9.
#[test]
fn every_order_is_as_likely_as_any_other() {
    let task = task(
        r#"(module (fn "leaf" (params) (return (sample (dist bernoulli 0.5))))
            (fn "m" (params) (do (future "leaf")) (do (future "leaf")) (do (future "leaf")) (return 0)) (entry "m"))"#,
    );
    let own = Settings { particles: 6000, seed: 3, ..Settings::default() };
    let mut counts: HashMap<Vec<usize>, f64> = HashMap::new();
    for p in smc(&task, &own, &mut |_| true).unwrap().particles {
        let picks = p.record.log.entries().iter().filter_map(crate::log::Entry::which).collect();
        *counts.entry(picks).or_insert(0.0) += 1.0;
    }
    let statistic: f64 = counts.values().map(|n| (n - 1000.0).powi(2) / 1000.0).sum();
    assert!(counts.len() == 6 && statistic < 35.9, "{counts:?}");
}

/// The same seed gives the same bits on any number of threads.
#[test]
fn threads_change_nothing() {
    let task = task(PROGRAMS[5].1);
    let settings = Settings { particles: 100, seed: 5, ..Settings::default() };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let run = smc(&task, &settings, &mut |_| true).unwrap();
            let values: Vec<String> = run.particles.iter().map(|p| repr(&p.value).unwrap()).collect();
            let logs: Vec<Vec<u128>> = run
                .particles
                .iter()
                .map(|p| p.record.log.entries().iter().map(|e| e.address()).collect())
                .collect();
            (run.log_evidence.unwrap().to_bits(), values, logs)
        })
    };
    assert_eq!(run(1), run(2));
    assert_eq!(run(1), run(8));
}

/// Copies in batches, by any thread, equal copies one by one; the large family is divided.
#[test]
fn copies_are_the_same_in_batches() {
    let task = task(PROGRAMS[5].1);
    let settings = Settings { particles: 40, seed: 5, ..Settings::default() };
    let mut counts = vec![0; 40];
    (counts[7], counts[8], counts[30], counts[39]) = (1, 25, 3, 11);
    let copied = |batches: Option<(usize, usize)>| {
        let mut population = Population::start(&task, &settings, true).unwrap();
        population.advance(None).unwrap();
        let (mut ancestor, mut lineages) = ((0..40).collect::<Vec<_>>(), 40);
        let mut copies = Copies::plan(&counts, &mut ancestor, &mut lineages);
        match batches {
            None => copies.make(&mut population.particles, 5),
            Some((size, threads)) => {
                population.particles.iter_mut().enumerate().for_each(|(index, p)| p.home = index % threads);
                copies.share_out(&mut population.particles, threads);
                let mut indices = Vec::new();
                for mut batch in
                    copies.batches(&mut population.particles, 5, size, threads).into_iter().flatten()
                {
                    assert!(batch.len() <= size);
                    copy(&mut batch, 5);
                    indices.extend(batch.iter().map(|one| one.index));
                }
                indices.sort_unstable();
                assert_eq!(indices, (0..40).collect::<Vec<_>>());
            }
        }
        let one = |p: &Particle| {
            let own = p.record.log.entries();
            (p.lineage, own.iter().map(|e| (e.address(), written(e))).collect::<Vec<_>>())
        };
        (population.particles.iter().map(one).collect::<Vec<_>>(), ancestor, lineages)
    };
    for batches in [(1, 2), (4, 1), (4, 3), (16, 2)] {
        assert_eq!(copied(None), copied(Some(batches)));
    }
}

#[test]
fn a_population_that_dies_says_where_and_why() {
    let task = task(
        r#"(module (fn "m" (params) (do (factor 0.0)) (set $x (sample (dist bernoulli 0.5)))
           (do (condition (and $x (not $x)))) (return 1)) (entry "m"))"#,
    );
    let Err(crate::Failure::Impossible { barrier, causes, .. }) =
        smc(&task, &Settings::default(), &mut |_| true)
    else {
        panic!("some particle lived")
    };
    assert_eq!(barrier, 2);
    assert_eq!(causes, [("`condition` at line 0".to_string(), 100)]);
}

#[test]
fn each_loss_is_counted_once() {
    let task = task(
        r#"(module (fn "m" (params) (do (factor 0.0)) (set $x (sample (dist bernoulli 0.5)))
           (do (condition $x)) (do (factor 0.0)) (set $y (sample (dist bernoulli 0.5))) (do (factor 0.0))
           (return 1)) (entry "m"))"#,
    );
    // Without resampling those that died are in the final set.
    let settings = Settings { when: When::EffectiveBelow(0.0), ..Settings::default() };
    let result = smc(&task, &settings, &mut |_| true).unwrap();
    let dead = result.particles.iter().filter(|p| p.record.score().is_impossible()).count();
    assert!(0 < dead && dead < 100);
    let lost = result.losses.explained(&task);
    assert_eq!((lost.causes, lost.looked_at), (vec![("`condition` at line 0".to_string(), dead)], dead));
}

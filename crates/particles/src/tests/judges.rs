//! Programs whose answer is known, and z-scores of what a search says of them. Also the tests of look-ahead that is learned include
//! this file, in the crate that trains guides; so it names its crate from outside.

use niwaki_agreement::{RARE, repetitions};
use niwaki_particles::{Ancestors, Result, Settings, particle_gibbs, smc};
use niwaki_run::Task;
use niwaki_run::enumeration::enumerate;
use niwaki_run::forward::forward;
use niwaki_run::log::Entry;
use niwaki_run::order::Order;
use niwaki_run::rejection::rejection;
use niwaki_run::resampling::Resampling;
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use niwaki_vm::value::repr;
use std::collections::HashMap;
use std::sync::Arc;

pub(crate) fn task(text: &str) -> Task {
    Task::new(Arc::new(compile(&parse(text).unwrap(), vec![]).unwrap()))
}

/// The value of an entry as text; of an order choice, which future ran.
pub(crate) fn written(entry: &niwaki_run::log::Entry) -> String {
    entry.which().map_or_else(|| repr(&entry.value).unwrap(), |future| format!("future {future}"))
}

/// Programs whose answer is known by enumeration.
pub(crate) const PROGRAMS: [(&str, &str); 11] = [
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

/// The outcomes that `n` repetitions can count, with their probabilities; the others are one outcome, [`REST`].
fn countable(outcomes: impl Iterator<Item = (String, f64)>, n: f64) -> Vec<(String, f64)> {
    let (mut shares, rare): (Vec<_>, Vec<_>) = outcomes.partition(|(_, p)| n * p >= RARE);
    if !rare.is_empty() {
        shares.push((REST.to_string(), rare.iter().map(|(_, p)| p).sum()));
    }
    shares
}

/// The name of all outcomes that are rare.
const REST: &str = "rest";

/// Mean and standard error of the evidence, relative to the truth, and of each outcome's share of it. Seeds are the
/// [`repetitions`] of the range.
pub(crate) fn z_scores(task: &Task, settings: &Settings, seeds: std::ops::Range<u64>) -> Vec<(String, f64)> {
    z_scores_of(task, &|seed| smc(task, &Settings { seed, ..settings.clone() }, &mut |_| true), seeds)
}

/// Z-scores, as [`z_scores`], of any search that has a seed.
pub(crate) fn z_scores_of(
    task: &Task,
    search: &(dyn Fn(u64) -> std::result::Result<Result, niwaki_run::Failure> + Sync),
    seeds: std::ops::Range<u64>,
) -> Vec<(String, f64)> {
    on_one_thread(|| z_scores_here(task, search, seeds))
}

/// For many small searches, which gain nothing from more threads; the same bits.
pub(crate) fn on_one_thread<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(work)
}

pub(crate) fn z_scores_here(
    task: &Task,
    search: &dyn Fn(u64) -> std::result::Result<Result, niwaki_run::Failure>,
    seeds: std::ops::Range<u64>,
) -> Vec<(String, f64)> {
    let seeds = seeds.start..seeds.start + repetitions(seeds.end - seeds.start);
    let n = (seeds.end - seeds.start) as f64;
    let exact = enumerate(task, 100_000, &mut |_| true).unwrap();
    let z = exact.log_evidence;
    let truth: Vec<(String, f64)> =
        countable(exact.outcomes.iter().map(|(v, log)| (repr(v).unwrap(), (log - z).exp())), n);
    let name_of = |value: String| match truth.iter().any(|(name, _)| *name == value) {
        true => value,
        false => REST.to_string(),
    };
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
            *shares.entry(name_of(repr(&p.value).unwrap())).or_insert(0.0) += w / total;
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

pub(crate) const LIMIT: f64 = 5.0;

pub(crate) fn worst(scores: &[(String, f64)]) -> f64 {
    scores.iter().map(|s| s.1.abs()).fold(0.0, f64::max)
}

/// The orders of a program: without futures both are the same to the bit.
pub(crate) fn orders(text: &str) -> impl Iterator<Item = Order> {
    let first = text.contains("future").then_some(Order::DepthFirst);
    first.into_iter().chain([Order::Stochastic])
}

pub(crate) fn settings(order: Order, resampling: Resampling) -> Settings {
    Settings { particles: 8, order, resampling, ..Settings::default() }
}

/// [`repetitions`] of exact draws from the posterior, by rejection. Their bound is the best score of five thousand runs; a better one would be
/// refused.
pub(crate) fn exact_draws(task: &Task, count: u64) -> Vec<Vec<Entry>> {
    let scores = (0..5000).map(|stream| forward(task, 2, stream, false).unwrap().log_score);
    let bound = scores.fold(f64::NEG_INFINITY, f64::max);
    let accepted = rejection(task, repetitions(count) as usize, bound, u64::MAX, 1, &mut |_| true).unwrap();
    accepted.runs.iter().map(|run| run.log.entries()).collect()
}

/// The values after `sweeps` sweeps of particle Gibbs from each start.
pub(crate) fn values_after(
    task: &Task,
    starts: &[Vec<Entry>],
    settings: &Settings,
    ancestors: Ancestors,
    sweeps: usize,
) -> Vec<String> {
    let after = |(seed, start): (u64, &Vec<Entry>)| {
        let settings = Settings { seed, ..settings.clone() };
        let chain = particle_gibbs(task, &settings, ancestors, sweeps, Some(start), &mut |_| true).unwrap();
        repr(&chain.states.last().unwrap().value).unwrap()
    };
    (0..).zip(starts).map(after).collect()
}

/// Z-scores of the counts of all outcomes.
pub(crate) fn counted(task: &Task, values: &[String]) -> Vec<(String, f64)> {
    let exact = enumerate(task, 100_000, &mut |_| true).unwrap();
    let n = values.len() as f64;
    let outcomes = exact.outcomes.iter();
    let shares =
        countable(outcomes.map(|(value, log)| (repr(value).unwrap(), (log - exact.log_evidence).exp())), n);
    let mut counts: HashMap<&str, f64> = HashMap::new();
    for value in values {
        let name = shares.iter().find(|(name, _)| name == value).map_or(REST, |(name, _)| name);
        *counts.entry(name).or_insert(0.0) += 1.0;
    }
    let z = |(name, p): &(String, f64)| {
        let count = counts.get(name.as_str()).copied().unwrap_or(0.0);
        // A certain outcome has no error.
        (name.clone(), (count - n * p) / (n * p * (1.0 - p)).sqrt().max(1e-9))
    };
    let impossible = counts.contains_key(REST) && shares.iter().all(|(name, _)| name != REST);
    let impossible = impossible.then(|| ("an impossible outcome".to_string(), f64::INFINITY));
    shares.iter().map(z).chain(impossible).collect()
}

pub(crate) fn small(particles: usize, order: Order) -> Settings {
    Settings { particles, ..settings(order, Resampling::Systematic) }
}

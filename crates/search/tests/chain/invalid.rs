//! An invalid run (a distribution's parameters are out of range, a shape is impossible, a host function fails) has
//! probability zero for every search. The posterior equals that of enumeration or of quadrature. The four strategies agree to the
//! bit and in their counts, and a rollback leaves nothing. A fault of every run is raised, and other faults are always raised.
//! Kernels start from an exact draw (by rejection) and make twelve proposals, so the result is again an exact draw, and
//! the draws of different seeds are independent: counts are binomial, and means have the standard error of the posterior.
//! A z beyond 5 happens once in 1.7 million; about 400 are looked at.

use super::programs;
use super::programs::leaf;
use super::{kernels, settings};
use niwaki_agreement::{RARE, compare, repetitions};
use niwaki_chain::kernel::Kernel;
use niwaki_chain::{Chain, Settings};
use niwaki_continuous::hamiltonian;
use niwaki_continuous::hamiltonian::Cause;
use niwaki_continuous::hamiltonian::chains::Length;
use niwaki_particles::{Ancestors, particle_gibbs, pimh, populations, smc};
use niwaki_propose::gradient::live;
use niwaki_propose::importance::importance;
use niwaki_run::enumeration::enumerate;
use niwaki_run::forward::forward;
use niwaki_run::rejection::rejection;
use niwaki_run::replay::by_address;
use niwaki_run::task::Hosts;
use niwaki_run::{Failure, Task};
use niwaki_search::direct::explore::{Plan, explore};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::kept::Strategy;
use niwaki_vm::value::{Value, repr};
use serde_json::json;
use std::collections::HashMap;
use std::sync::Arc;

const LIMIT: f64 = 5.0;

/// A function of two choices.
type Function = fn(f64, f64) -> f64;

/// Four invalid sites: in a call that comes and goes, in a call without choices, in a branch, at an observation.
const COUNTS: &str = r#"(module
  (fn "leaf" (params $k) (set $x (sample (dist binomial (sub $k 2) 0.5))) (do (factor (mul 0.3 $x))) (return $x))
  (fn "coin" (params $n) (return (dist bernoulli (div (sub 5 $n) 4.0))))
  (fn "m" (params)
    (set $n (sample (dist discrete_uniform 0 5)))
    (set $a (sample (call "coin" $n)))
    (if $a (then (set $b (call "leaf" $n)))
      (else (set $b (sample (dist discrete_uniform $n 3)))))
    (do (observe (dist gaussian 0.0 (sub (add $b 1) (div $n 3.0))) 0.5))
    (return (tuple $n $a $b))) (entry "m"))"#;

/// An element that is read below, while the run continues with the value from before. A run in program order has
/// both values, and is valid if they agree.
const ELEMENTS: &str = r#"(module
  (fn "seen" (params $xs) (do (factor (mul -0.1 (index $xs 0)))) (return (index $xs 0)))
  (fn "m" (params)
    (set $xs (list)) (set $a (sample (dist discrete_uniform 0 3)))
    (set $xs (append $xs $a))
    (set $r (call "seen" $xs))
    (set $d (sample (dist binomial (sub (add $a 2) $r) 0.5)))
    (do (observe (dist gaussian 0.0 (sub 1.5 (sub $r $a))) 0.3))
    (set $c (sample (dist bernoulli (div $a 2.0))))
    (return (tuple $a $c $d))) (entry "m"))"#;

/// Elements as in `ELEMENTS`, with a condition.
const CONDITION: &str = r#"(module
  (fn "seen" (params $xs) (do (factor (mul -0.1 (index $xs 0)))) (return (index $xs 0)))
  (fn "m" (params)
    (set $xs (list)) (set $a (sample (dist discrete_uniform 0 3)))
    (set $xs (append $xs $a))
    (set $r (call "seen" $xs))
    (do (condition (eq $r $a)))
    (set $c (sample (dist bernoulli (div $a 2.0))))
    (return (tuple $a $c))) (entry "m"))"#;

/// Two sites that may be invalid in one run, since a parameter is also an element of a list.
const READERS: &str = r#"(module
  (fn "one" (params $xs $i) (return (sample (dist bernoulli (div (index $xs $i) 3.0)))))
  (fn "m" (params)
    (set $xs (list))
    (for $i (range 3) (body (set $xs (append $xs (sample (dist discrete_uniform 0 4))))))
    (set $n 0)
    (for $i (range 3) (body (if (call "one" $xs $i) (then (set $n (add $n 1))))))
    (set $m (sample (dist discrete_uniform (index $xs 0) (add (index $xs 2) 1))))
    (return (tuple $n $m))) (entry "m"))"#;

/// Impossible shapes, in a future, and in iterations that come and go.
const SHAPES: &str = r#"(module
  (fn "leaf" (params $k) (set $x (sample (dist bernoulli 0.4)))
    (do (emit (disc (tuple 0.0 0.0 0.0) (sub $k 0.5)))) (return $x))
  (fn "m" (params)
    (set $n (sample (dist discrete_uniform 0 4)))
    (set $f (future "leaf" $n))
    (set $c 0)
    (for $i (range 2) (body (if (sample (dist bernoulli 0.5))
      (then (set $c (add $c 1)) (do (emit (ellipse (tuple $i 0.0 0.0) 1.0 (sub 3.5 $n))))))))
    (do (factor (mul -0.2 $n)))
    (return (tuple $n $c (force $f)))) (entry "m"))"#;

/// A host function that fails: in a call, and in a branch.
const HOSTS: &str = r#"(module
  (fn "look" (params $k) (set $x (sample (dist bernoulli 0.5))) (return (add (host 0 $k) (cond $x 1 0))))
  (fn "m" (params)
    (set $n (sample (dist discrete_uniform 0 5)))
    (set $a (call "look" $n))
    (set $b (sample (dist bernoulli 0.3)))
    (if $b (then (set $a (add $a (host 0 (add $n 2))))))
    (do (factor (mul -0.02 $a)))
    (return (tuple $n $a $b))) (entry "m"))"#;

const DISCRETE: [(&str, &str); 6] = [
    ("counts", COUNTS),
    ("elements", ELEMENTS),
    ("condition", CONDITION),
    ("readers", READERS),
    ("shapes", SHAPES),
    ("hosts", HOSTS),
];

/// Squares of whole numbers up to 4.
struct Squares;

impl Hosts for Squares {
    fn call(&self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        match args {
            [Value::Int(n)] if *n <= 4 => Ok(Value::Int(n * n)),
            _ => Err(Fault::new("host-function", "no such square").of_call("square", args)),
        }
    }
}

fn task(text: &str) -> Task {
    Task { hosts: Arc::new(Squares), ..programs::task(text) }
}

fn proposals(task: &Task, settings: &Settings, known: &HashMap<u128, Value>, n: u64) -> Value {
    let mut chain: Chain = Chain::start(task, settings, 0, Some(known)).expect("a chain");
    chain.advance(task, n, &mut |_, _| true).expect("proposals");
    chain.state.trace.result()
}

fn exact_draw(task: &Task, seed: u64, bound: f64) -> HashMap<u128, Value> {
    let draw = rejection(task, 1, bound, 100_000, seed, &mut |_| true).expect("a draw");
    by_address(&draw.runs[0].log.entries())
}

/// The largest z-score of the counts of outcomes, of which the rare ones are counted together; infinite for an impossible outcome.
fn counted(task: &Task, values: &[String]) -> f64 {
    let exact = enumerate(task, 100_000, &mut |_| true).expect("finitely many runs");
    let n = values.len() as f64;
    let share = |(value, log): &(Value, f64)| (repr(value).unwrap(), (log - exact.log_evidence).exp());
    let shares: HashMap<String, f64> = exact.outcomes.iter().map(share).collect();
    if values.iter().any(|value| !shares.contains_key(value)) {
        return f64::INFINITY;
    }
    let z = |count: f64, p: f64| ((count - n * p) / (n * p * (1.0 - p)).sqrt().max(1e-9)).abs();
    let count = |name| values.iter().filter(|value| *value == name).count() as f64;
    let (frequent, rare): (Vec<_>, Vec<_>) = shares.iter().partition(|(_, p)| n * **p >= RARE);
    let rest = rare.iter().fold((0.0, 0.0), |(seen, p), (name, share)| (seen + count(*name), p + **share));
    let worst = frequent.iter().map(|(name, p)| z(count(*name), **p)).fold(0.0, f64::max);
    if rare.is_empty() { worst } else { worst.max(z(rest.0, rest.1)) }
}

fn after(task: &Task, kernel: &Kernel, strategy: Strategy, seeds: u64) -> Vec<String> {
    let value = |seed| {
        let settings = Settings { seed, kernel: kernel.clone(), strategy, ..settings() };
        let known = exact_draw(task, seed + (1 << 32), 1.0);
        repr(&proposals(task, &settings, &known, 12)).unwrap()
    };
    (0..seeds).map(value).collect()
}

#[test]
fn every_kernel_keeps_the_posterior_of_the_valid_runs() {
    for (name, text) in DISCRETE {
        let task = task(text);
        for (kind, kernel) in kernels(&task) {
            // An annealed kernel keeps no law.
            if kind != "annealed" {
                let z = counted(&task, &after(&task, &kernel, Strategy::C3, repetitions(2000)));
                assert!(z < LIMIT, "{name}, {kind}: {z}");
            }
        }
        assert!(!task.invalid.counts().is_empty(), "{name}");
    }
}

#[test]
fn four_strategies_agree_and_count_the_same_sites() {
    for (name, text) in DISCRETE {
        let task = task(text);
        for (kind, kernel) in kernels(&task) {
            let (difference, compared) =
                compare(&task, &Settings { kernel, ..settings() }, 600, 20).expect("a chain");
            assert!(difference.is_none(), "{name}, {kind}: {}", difference.unwrap_or_default());
            assert!(
                compared.faults == 0 && compared.accepted > 0 && compared.invalid > 5,
                "{name}, {kind}: {compared:?}"
            );
        }
    }
}

#[test]
fn direct_methods_agree_with_enumeration() {
    for (name, text) in DISCRETE {
        let task = task(text);
        let exact = enumerate(&task, 100_000, &mut |_| true).unwrap();
        let runs = rejection(&task, 4000, 1.0, 1_000_000, 3, &mut |_| true).unwrap();
        let values: Vec<String> = runs.runs.iter().map(|s| repr(&s.value).unwrap()).collect();
        let z = counted(&task, &values);
        assert!(z < LIMIT, "{name}: {z}");
        // The mean of independent weights.
        let weighted = importance(&task, None, 20_000, 4, &mut |_| true).unwrap();
        let weights: Vec<f64> = weighted.runs.iter().map(|s| s.log_score.exp()).collect();
        let n = weights.len() as f64;
        let (mean, square) = weights.iter().fold((0.0, 0.0), |(m, s), w| (m + w / n, s + w * w / n));
        let z = (mean - exact.log_evidence.exp()) / ((square - mean * mean) / n).sqrt();
        assert!(z.abs() < LIMIT, "{name}: {z}");
        // The counted runs have no weight, except by conditions.
        let fresh = task.uncounted();
        let again = importance(&fresh, None, 20_000, 4, &mut |_| true).unwrap();
        let invalid = again.runs.iter().filter(|s| s.invalid.is_some()).count() as u64;
        assert_eq!(fresh.invalid.counts().iter().map(|place| place.1.runs).sum::<u64>(), invalid);
        assert!(invalid > 1000, "{name}: {invalid}");
    }
}

/// Bounds that cross if `x` is below 0.5, and a probability above 1 if `y` is far from it.
const BORDER: &str = r#"(module (fn "m" (params)
    (set $x (sample (dist uniform 0.0 1.0)))
    (set $y (sample (dist uniform 0.5 $x)))
    (do (observe (dist bernoulli (mul 4.0 (sub $x $y))) true))
    (do (observe (dist gaussian $y 0.3) 0.7))
    (return (tuple $x $y))) (entry "m"))"#;

/// The density of `BORDER`'s score.
fn border(x: f64, y: f64) -> f64 {
    let p = 4.0 * (x - y);
    if p <= 1.0 { p * normal(0.7 - y, 0.3) } else { 0.0 }
}

/// The bounds of `BORDER`, and a choice that comes and goes: its deviation is negative from 0.9 on.
const COMING: &str = r#"(module (fn "m" (params)
    (set $x (sample (dist uniform 0.0 1.0)))
    (set $w 0.0)
    (if (gt $x 0.7) (then (set $w (sample (dist gaussian 0.0 (sub 0.9 $x))))))
    (set $y (sample (dist uniform 0.5 $x)))
    (do (observe (dist gaussian (add $y $w) 0.4) 0.2))
    (return (tuple $x $y))) (entry "m"))"#;

/// The density of `COMING`'s score, the choice integrated out.
fn coming(x: f64, y: f64) -> f64 {
    match x {
        0.9.. => 0.0,
        0.7.. => normal(0.2 - y, 0.4f64.hypot(0.9 - x)),
        _ => normal(0.2 - y, 0.4),
    }
}

fn normal(d: f64, sd: f64) -> f64 {
    (-0.5 * d * d / (sd * sd)).exp() / (sd * std::f64::consts::TAU.sqrt())
}

/// The statistics: means of x, y and their product.
const MEANS: [Function; 3] = [|x, _| x, |_, y| y, |x, y| x * y];

/// Means and deviations by quadrature, under a density of the score: over `(y - 0.5) / (x - 0.5)` that of the choices is flat.
fn quadrature(score: Function) -> [(f64, f64); 3] {
    let (n, mut total, mut sums) = (2000, 0.0, [(0.0, 0.0); 3]);
    for i in 0..n {
        for j in 0..n {
            let x = 0.5 + 0.5 * (f64::from(i) + 0.5) / f64::from(n);
            let y = 0.5 + (x - 0.5) * (f64::from(j) + 0.5) / f64::from(n);
            let w = score(x, y);
            total += w;
            for (sum, f) in sums.iter_mut().zip(MEANS) {
                *sum = (sum.0 + w * f(x, y), sum.1 + w * f(x, y) * f(x, y));
            }
        }
    }
    sums.map(|(f, ff)| (f / total, (ff / total - (f / total) * (f / total)).sqrt()))
}

/// The worst z-score of the means of independent draws.
fn worst(draws: &[(f64, f64)], score: Function) -> f64 {
    let n = draws.len() as f64;
    let z = |(f, (mean, sd)): (Function, (f64, f64))| {
        let mean_of_draws = draws.iter().map(|(x, y)| f(*x, *y)).sum::<f64>() / n;
        ((mean_of_draws - mean) / (sd / n.sqrt())).abs()
    };
    MEANS.into_iter().zip(quadrature(score)).map(z).fold(0.0, f64::max)
}

fn pair(value: &Value) -> (f64, f64) {
    let Value::Tuple(both) = value else { panic!("{value:?}") };
    let [Value::Real(x), Value::Real(y)] = both.items() else { panic!("{value:?}") };
    (*x, *y)
}

const FIXED: Length = Length::Fixed { steps: 5, jitter: 0.4 };
const TURNING: Length = Length::NoUTurn { max_depth: 4 };

fn trajectory(length: Length) -> Kernel {
    match length {
        Length::Fixed { steps, jitter } => {
            leaf("hmc_step", json!({"steps": steps, "jitter": jitter, "step": 0.4, "target": 0.8}))
        }
        Length::NoUTurn { max_depth } => {
            leaf("nuts_step", json!({"max_depth": max_depth, "step": 0.4, "target": 0.8}))
        }
    }
}

#[test]
fn trajectories_in_a_chain_end_where_a_distribution_is_invalid() {
    for (text, score) in [(BORDER, border as Function), (COMING, coming)] {
        let task = task(text);
        for length in [FIXED, TURNING] {
            let kernel = Kernel::Cycle(vec![Kernel::PRIOR, Kernel::Repeat(3, Box::new(trajectory(length)))]);
            let draw = |seed| {
                let settings = Settings { seed, kernel: kernel.clone(), ..settings() };
                let known = exact_draw(&task, seed + (1 << 32), 0.3);
                pair(&proposals(&task, &settings, &known, 8))
            };
            let draws: Vec<(f64, f64)> = (0..1500).map(draw).collect();
            let z = worst(&draws, score);
            assert!(z < LIMIT, "{length:?}: {z}");
            let (difference, compared) =
                compare(&task, &Settings { kernel: kernel.clone(), ..settings() }, 300, 30).unwrap();
            assert!(difference.is_none(), "{}", difference.unwrap_or_default());
            assert!(compared.faults == 0 && compared.accepted > 60 && compared.invalid > 20, "{compared:?}");
        }
    }
    // The test rejects a wrong law: one in which the bounds may cross, and one that forgets one site.
    let task = task(BORDER);
    let draws: Vec<_> = (0..1500).map(|seed| exact_values(&task, seed)).collect();
    assert!(worst(&draws, border) < LIMIT);
    assert!(worst(&draws, |x, y| 4.0 * (x - y) * normal(0.7 - y, 0.3)) > LIMIT);
}

fn exact_values(task: &Task, seed: u64) -> (f64, f64) {
    pair(&rejection(task, 1, 0.3, 100_000, seed, &mut |_| true).expect("a draw").runs[0].value)
}

#[test]
fn chains_of_the_gradient_end_their_trajectories_there_too() {
    let task = task(BORDER);
    for length in [FIXED, TURNING] {
        let base = hamiltonian::Settings { length, step_size: Some(0.4), ..hamiltonian::Settings::nuts() };
        let draw = |seed| {
            let target = live(&task, &exact_draw(&task, seed + (1 << 32), 0.3)).expect("a density");
            let start = target.recorded().start.clone();
            let mut chain = hamiltonian::Chain::new(target, &start, &base, seed, 0).expect("a start");
            (0..6).for_each(|_| drop(chain.advance()));
            let x = chain.phase.x.clone();
            chain.target.value_and_gradient(&x, &mut [0.0; 2]).expect("a point of the density");
            let numbers = chain.target.recorded().numbers(&x);
            (numbers[0], numbers[1])
        };
        let draws: Vec<(f64, f64)> = (0..1500).map(draw).collect();
        let z = worst(&draws, border);
        assert!(z < LIMIT, "{length:?}: {z}");
    }
    let sites: Vec<String> = task.invalid.counts().iter().map(|place| place.0.to_string()).collect();
    assert_eq!(sites, ["`bernoulli` at line 0", "`uniform` at line 0"]);
    let settings = hamiltonian::Settings { warmup: 200, draws: 400, ..hamiltonian::Settings::nuts() };
    let plan = Plan { settings: &settings, seed: 1, chains: 2, tries: 1000, known: None };
    for chain in explore(&task, &plan, &|_| true).expect("chains") {
        let refused = chain.draws.broken.refused;
        assert!(refused[Cause::Impossible as usize] > 0, "{refused:?}");
        assert!(refused[Cause::NotFinite as usize] == 0 && chain.fault.is_none(), "{refused:?}");
    }
}

/// A disc whose radius is a choice that is seen.
const RADIUS: &str = r#"(module (fn "m" (params)
    (set $x (sample (dist gaussian 0.2 0.5)))
    (do (emit (disc (tuple 0.0 0.0 0.0) $x)))
    (do (observe (dist gaussian $x 0.8) -0.1))
    (return $x)) (entry "m"))"#;

#[test]
fn a_trajectory_ends_where_a_shape_cannot_be() {
    // The posterior without the disc is a normal; the disc leaves the part above zero.
    let (n, mut sums) = (200_000, [0.0; 3]);
    for i in 0..n {
        let x = 4.0 * (f64::from(i) + 0.5) / f64::from(n);
        let w = normal(x - 0.2, 0.5) * normal(-0.1 - x, 0.8);
        sums = [sums[0] + w, sums[1] + w * x, sums[2] + w * x * x];
    }
    let mean = sums[1] / sums[0];
    let sd = (sums[2] / sums[0] - mean * mean).sqrt();
    let task = task(RADIUS);
    let worst = |draws: &[f64]| {
        let n = draws.len() as f64;
        if draws.iter().any(|x| *x <= 0.0) {
            f64::INFINITY
        } else {
            ((draws.iter().sum::<f64>() / n - mean) / (sd / n.sqrt())).abs()
        }
    };
    let real = |value: &Value| if let Value::Real(x) = value { *x } else { panic!("{value:?}") };
    for length in [FIXED, TURNING] {
        let base = hamiltonian::Settings { length, step_size: Some(0.4), ..hamiltonian::Settings::nuts() };
        let alone = |seed| {
            let target = live(&task, &exact_draw(&task, seed + (1 << 32), 0.0)).expect("a density");
            let start = target.recorded().start.clone();
            let mut chain = hamiltonian::Chain::new(target, &start, &base, seed, 0).expect("a start");
            (0..6).for_each(|_| drop(chain.advance()));
            chain.target.recorded().numbers(&chain.phase.x)[0]
        };
        let z = worst(&(0..1500).map(alone).collect::<Vec<_>>());
        assert!(z < LIMIT, "{length:?}: {z}");
        let kernel = trajectory(length);
        let inside = |seed| {
            let settings = Settings { seed, kernel: kernel.clone(), ..settings() };
            real(&proposals(&task, &settings, &exact_draw(&task, seed + (1 << 32), 0.0), 8))
        };
        let z = worst(&(0..1500).map(inside).collect::<Vec<_>>());
        assert!(z < LIMIT, "{length:?} in a chain: {z}");
    }
    let counts = task.invalid.counts();
    assert!(counts.len() == 1 && counts[0].0.name == "disc" && counts[0].1.runs > 100, "{counts:?}");
    // The test rejects the law without the border, and one whose border is in another place.
    let draws: Vec<f64> = (0..1500)
        .map(|seed| {
            real(&rejection(&task, 1, 0.0, 100_000, seed, &mut |_| true).expect("a draw").runs[0].value)
        })
        .collect();
    assert!(worst(&draws) < LIMIT && worst(&draws.iter().map(|x| x + 0.1).collect::<Vec<_>>()) > LIMIT);
}

/// The result of every search for a program.
fn every_search(text: &str) -> Vec<Result<(), Failure>> {
    let task = task(text);
    let base = niwaki_particles::Settings { particles: 20, ..niwaki_particles::Settings::default() };
    let chain = || -> Result<Chain, Failure> { Chain::start(&task, &settings(), 0, None) };
    let plan = Plan { settings: &hamiltonian::Settings::nuts(), seed: 1, chains: 2, tries: 20, known: None };
    vec![
        chain().and_then(|mut chain| chain.advance(&task, 200, &mut |_, _| true)),
        smc(&task, &base, &mut |_| true).map(drop),
        populations(&task, &base, &[20, 20], &mut |_| true).map(drop),
        particle_gibbs(&task, &base, Ancestors::Sampled, 3, None, &mut |_| true).map(drop),
        pimh(&task, &base, 3, &mut |_| true).map(drop),
        importance(&task, None, 50, 1, &mut |_| true).map(drop),
        rejection(&task, 5, 0.0, 50, 1, &mut |_| true).map(drop),
        enumerate(&task, 1000, &mut |_| true).map(drop),
        explore(&task, &plan, &|_| true).map(drop),
    ]
}

#[test]
fn faults_of_every_run_are_raised_unchanged() {
    let always = r#"(module (fn "leaf" (params $s) (return (sample (dist gaussian 0.0 $s))))
        (fn "m" (params) (set $a (sample (dist bernoulli 0.5)))
          (return (call "leaf" (cond $a -1.0 -2.0)))) (entry "m"))"#;
    for (number, result) in every_search(always).into_iter().enumerate() {
        let Err(Failure::Run(met)) = result else { panic!("{number}: {result:?}") };
        assert_eq!((met.fault.code, met.stack.len()), ("bad-parameter", 2), "{number}");
        assert!(met.fault.message.contains("`sd` of gaussian is -"), "{number}: {met}");
    }
    let shape = r#"(module (fn "m" (params) (set $x (sample (dist uniform 1.0 2.0)))
        (do (emit (disc (tuple 0.0 0.0 0.0) (sub 0.5 $x)))) (return $x)) (entry "m"))"#;
    let host = r#"(module (fn "m" (params) (set $x (sample (dist uniform 1.0 2.0)))
        (return (host 0 5))) (entry "m"))"#;
    for (text, code) in [(shape, "bad-shape"), (host, "host-function")] {
        for (number, result) in every_search(text).into_iter().enumerate() {
            match result {
                // The choice cannot be enumerated.
                Err(_) if number == 7 => {}
                Err(Failure::Run(met)) => assert_eq!((met.fault.code, met.is_invalid()), (code, true)),
                other => panic!("{code}, {number}: {other:?}"),
            }
        }
    }
    // A message names all of several reasons.
    let both = r#"(module (fn "m" (params) (set $a (sample (dist bernoulli 0.5)))
        (if $a (then (do (condition false)))) (return (sample (dist poisson -1.0)))) (entry "m"))"#;
    let results = every_search(both);
    let Err(Failure::NoStart { causes, .. }) = &results[0] else { panic!("{results:?}") };
    assert_eq!(causes.len(), 2, "{causes:?}");
    let Err(Failure::Impossible { causes, .. }) = &results[1] else { panic!("{results:?}") };
    assert!(causes.iter().any(|(cause, n)| cause == "`poisson` at line 0" && *n > 0), "{causes:?}");
}

#[test]
fn other_faults_are_raised_always() {
    for (body, code) in [
        ("(set $b (sample (dist gaussian 0.0 (cond $a 1.0 none))))", "bad-parameter"),
        ("(set $b (sample (dist categorical (cond $a (list 1 2) (list)))))", "bad-parameter"),
        ("(set $b (sample (dist discrete_uniform 0 (cond $a 1 1.5))))", "bad-parameter"),
        ("(set $b (sample (dist gaussian 0.0 (div 1.0 (cond $a 1.0 0.0)))))", "division-by-zero"),
        ("(set $b (index (list 1.0) (cond $a 0 1)))", "list-index"),
        (
            "(set $b (box (tuple 0.0 0.0 0.0) (tuple 1.0 1.0 1.0) none 0.5 (cond $a \"x\" \"up\")))",
            "bad-shape",
        ),
        ("(set $b (disc (tuple 0.0 0.0 0.0) (cond $a 1.0 none)))", "bad-argument"),
        ("(set $i (mul 1e308 10.0)) (set $b 0) (do (factor (cond $a 0.0 (sub $i $i))))", "non-finite-score"),
    ] {
        let text = format!(
            r#"(module (fn "m" (params) (set $a (sample (dist bernoulli 0.5))) {body} (return $b)) (entry "m"))"#
        );
        for (number, result) in every_search(&text).into_iter().enumerate() {
            match result {
                Err(Failure::Run(met)) => assert_eq!((met.fault.code, &met.fault.invalid), (code, &None)),
                // Enumeration and gradients have errors of their own.
                Err(Failure::Setting(_)) if number >= 7 => {}
                other => panic!("{body}, {number}: {other:?}"),
            }
        }
    }
    // A plain run reports its fault.
    let once = task(r#"(module (fn "m" (params) (return (sample (dist poisson -1.0)))) (entry "m"))"#);
    assert!(matches!(forward(&once, 1, 0, true), Err(Failure::Run(_))));
}

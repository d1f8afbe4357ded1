//! Regrowth leaves the posterior as it is, in all its forms, alone and composed, on small discrete programs that
//! change their structure. (The list of deliberate errors has the terms that regrowth could forget, each with the row here that
//! rejects the error.)
//!
//! Exact draws from the posterior (from the prior, accepted by their score, which is never above zero) make a few moves
//! each; the results are independent exact draws again, whatever the kernel's mixing. Shares of each value are compared with
//! enumeration: beyond 5 standard errors a share lies once in 1.7 million; some 1,200 are looked at, so a re-seeded suite
//! fails once in 1,400 runs. The long form has a million starts, one move each.

use super::programs::{leaf, task};
use niwaki_chain::kernel::Kernel;
use niwaki_chain::leaf::regrow::is_apart;
use niwaki_chain::{Chain, Settings};
use niwaki_geom::{Aabb, no_overshoot, vec3};
use niwaki_math::Stream;
use niwaki_run::Task;
use niwaki_run::enumeration::enumerate;
use niwaki_run::forward::forward;
use niwaki_run::replay::by_address;
use niwaki_run::run::Run;
use niwaki_run::select::Selection;
use niwaki_vm::value::{Value as Held, repr};
use serde_json::{Value, json};
use std::borrow::Borrow;
use std::collections::{HashMap, HashSet};

pub const PROGRAMS: [(&str, &str); 11] = [
    (
        "strong scores on the way",
        r#"(module (fn "limb" (params $d) (set $a (sample (dist bernoulli 0.7))) (do (factor (cond $a -5.0 0.0)))
            (set $b (sample (dist bernoulli (cond $a 0.7 0.2)))) (do (factor (cond $a (cond $b 4.5 5.0) (cond $b -0.5 0.0))))
            (if (and (lt $d 1) $b) (then (do (future "limb" (add $d 1))) (do (future "limb" (add $d 1))))))
          (fn "m" (params) (do (future "limb" 0)) (do (future "limb" 0)) (return (tuple))) (entry "m"))"#,
    ),
    (
        "choices without another value",
        r#"(module (fn "one" (params) (set $a (sample (dist bernoulli 0.5))) (do (factor (cond $a -0.4 0.0))) (return $a))
          (fn "two" (params) (set $b (call "one")) (set $c (sample (dist bernoulli (cond $b 1.0 0.4)))) (set $e false)
            (if (and $c (not $b)) (then (set $e (sample (dist bernoulli 0.5))) (do (factor (cond $e -0.6 0.0)))))
            (return (tuple $b $c $e)))
          (fn "m" (params) (set $x (call "two")) (set $y (call "two")) (do (factor (cond (eq $x $y) -0.7 0.0)))
            (return (tuple $x $y))) (entry "m"))"#,
    ),
    (
        "calls that depend on each other",
        r#"(module (fn "one" (params $p) (set $a (sample (dist bernoulli $p))) (do (factor (cond $a 0.0 -0.9))) (return $a))
          (fn "two" (params $p) (set $b (call "one" $p)) (set $c (sample (dist bernoulli (cond $b 0.8 0.3))))
            (do (factor (cond (eq $b $c) -1.2 0.0))) (return (tuple $b $c)))
          (fn "m" (params) (unpack ($b $c) (call "two" 0.4)) (set $d (call "one" (cond $c 0.2 0.7)))
            (do (factor (cond (eq $b $d) 0.0 -0.8))) (return (tuple $b $c $d))) (entry "m"))"#,
    ),
    (
        "a recursion with an end that counts",
        r#"(module (fn "grow" (params $d)
            (do (factor -0.2)) (set $x (sample (dist categorical (list 0.5 0.3 0.2)))) (do (factor (mul -0.3 $x)))
            (if (and (lt $d 3) (sample (dist bernoulli 0.6))) (then (return (add (mul 4 (call "grow" (add $d 1))) $x))))
            (return $x))
          (fn "m" (params) (set $k (call "grow" 0)) (do (factor (cond (gt $k 20) 0.0 -0.7))) (return $k)) (entry "m"))"#,
    ),
    (
        "a tree of futures that return nothing",
        r#"(module (fn "branch" (params $d)
            (set $k (sample (dist categorical (list 0.3 0.4 0.3)))) (do (factor (cond (eq $k 1) -0.2 -0.9)))
            (do (query $d $k))
            (for $i (range $k) (body (if (and (lt $d 1) (sample (dist bernoulli 0.6))) (then (do (future "branch" (add $d 1))))))))
          (fn "m" (params) (do (future "branch" 0)) (do (future "branch" 1)) (return (tuple))) (entry "m"))"#,
    ),
    (
        "futures that wait for each other",
        r#"(module (fn "late" (params) (set $v (sample (dist discrete_uniform 1 3))) (do (factor (mul -0.2 $v))) (return $v))
          (fn "user" (params $h) (do (factor -0.1)) (set $v (force $h)) (set $w (sample (dist bernoulli 0.4)))
            (do (factor (cond (or $w (lt $v 3)) 0.0 -2.0))) (return (add (mul 10 $v) (cond $w 1 0))))
          (fn "both" (params $a) (set $h (future "late")) (set $u (future "user" $h)) (do (factor -0.1))
            (set $z (sample (dist bernoulli 0.5))) (do (factor (cond $z -0.5 0.0)))
            (return (add (mul $a (cond $z 100 200)) (force $u))))
          (fn "m" (params) (set $a (sample (dist discrete_uniform 1 2))) (set $r (call "both" $a))
            (do (factor (cond (gt $r 320) -1.0 0.0))) (return $r)) (entry "m"))"#,
    ),
    (
        "a loop that ends by chance",
        r#"(module (fn "m" (params) (set $n 0) (set $s 0)
            (while (and (lt $n 4) (sample (dist bernoulli 0.6)))
              (body (set $x (sample (dist categorical (list 0.6 0.4)))) (do (factor (cond (eq $x 0) -0.7 0.0)))
                (set $s (add (mul 2 $s) $x)) (set $n (add $n 1))))
            (set $y (sample (dist bernoulli (cond (gt $s 2) 0.8 0.3)))) (do (factor (cond $y 0.0 -0.6)))
            (return (tuple $n $s $y))) (entry "m"))"#,
    ),
    (
        "loops with break and a count",
        r#"(module (const 0 (list 0.3 0.6 0.2))
          (fn "part" (params $n) (set $t 0)
            (for $j (range $n) (body
              (if (sample (dist bernoulli (index (data 0) $j))) (then (do (factor -0.5)) (break)))
              (set $t (add $t (add 1 (sample (dist categorical (list 0.5 0.5))))))))
            (return $t))
          (fn "m" (params) (set $k (sample (dist binomial 3 0.5))) (do (factor (mul -0.2 $k)))
            (set $a (call "part" $k)) (set $b (call "part" (mod $a 3)))
            (do (factor (cond (eq $a $b) -1.0 0.0))) (return (tuple $k $a $b))) (entry "m"))"#,
    ),
    (
        "lists that are built, passed and read",
        r#"(module (fn "read" (params $xs $i) (set $z (sample (dist bernoulli (index $xs $i))))
            (do (factor (cond $z -0.4 0.0))) (return $z))
          (fn "m" (params) (set $xs (list)) (set $hits 0)
            (for $i (range 3) (body (set $xs (append $xs (cond (sample (dist bernoulli 0.4)) 0.2 0.7)))))
            (for $i (range 3) (body (if (call "read" $xs $i) (then (set $hits (add $hits 1))))))
            (do (factor (mul -0.3 $hits))) (return (tuple $xs $hits))) (entry "m"))"#,
    ),
    (
        "a count without a bound",
        r#"(module (fn "cluster" (params $i) (set $c (sample (dist geometric 0.7))) (set $c (min $c 3))
            (do (factor (mul -0.4 (mod (add $c $i) 3)))) (return $c))
          (fn "m" (params) (set $k (sample (dist binomial 2 0.6))) (set $s 0)
            (for $i (range $k) (body (set $s (add (mul 4 $s) (call "cluster" $i)))))
            (do (factor (cond (eq $s 0) -0.9 0.0))) (return (tuple $k $s))) (entry "m"))"#,
    ),
    (
        "shapes that a sketch weighs",
        r#"(module (fn "arm" (params $h $d)
            (set $w (cond (sample (dist bernoulli 0.5)) 0.2 0.5))
            (do (emit (box (tuple 0.0 $h 0.0) (tuple $w 0.2 $w))))
            (if (and (lt $d 2) (sample (dist bernoulli 0.5))) (then
              (set $a (future "arm" (add $h $w) (add $d 1))) (do (future "arm" (sub $h $w) (add $d 1)))
              (return (add (mul 0.1 $w) (force $a)))))
            (return $w))
          (fn "m" (params) (return (call "arm" 0.0 0))) (entry "m"))"#,
    ),
];

fn regrow(particles: usize, turn: f64, pick: Value) -> Kernel {
    leaf("regrow", json!({"particles": particles, "turn": turn, "pick": pick}))
}

fn on(pattern: &str, kernel: Kernel) -> Kernel {
    Kernel::On(Selection { sites: vec![vec![pattern.into()]], ..Selection::default() }, Box::new(kernel))
}

/// Every form of regrowth; the last form is for the choices at one site, that of the first choice of a run.
fn kernels(task: &Task) -> Vec<(&'static str, Kernel)> {
    let chain: Chain = Chain::start(task, &Settings::default(), 0, None).expect("a chain");
    let first = chain.state.trace.path(&task.program, 0);
    let site = first.rsplit('/').next().unwrap_or_default().to_string();
    vec![
        ("two particles", regrow(2, 0.0, json!("size"))),
        ("five particles", regrow(5, 0.0, json!("size"))),
        ("turned always, two particles", regrow(2, 1.0, json!("size"))),
        ("turned half the time, four particles", regrow(4, 0.5, json!("size"))),
        ("by choice", regrow(3, 0.5, json!("choice"))),
        ("named parts", regrow(3, 0.5, json!({"parts": ["**"]}))),
        ("named parts, five particles", regrow(5, 0.0, json!({"parts": ["**"]}))),
        (
            "in a cycle with single choices",
            Kernel::Cycle(vec![
                Kernel::PRIOR,
                regrow(3, 0.3, json!("size")),
                leaf("neighbour", json!({"reach": 1})),
            ]),
        ),
        ("a mixture", Kernel::Mixture(vec![(1.0, Kernel::PRIOR), (2.0, regrow(3, 0.5, json!("size")))])),
        ("some choices only", on(&site, regrow(3, 0.4, json!("size")))),
    ]
}

/// The text that distinguishes draws of a program: the value if there is one and no scene, else the number and
/// the sum of the choices.
fn outcome(task: &Task, run: &Run) -> String {
    let value = repr(&run.value).expect("a value");
    if value != "()" && task.sketches.is_empty() {
        return value;
    }
    let number = |value: &Held| match value {
        Held::Bool(b) => f64::from(u8::from(*b)),
        Held::Int(k) => *k as f64,
        _ => 0.0,
    };
    let values: Vec<f64> = run.log.entries().iter().map(|entry| number(&entry.value)).collect();
    format!("{} choices, sum {}", values.len(), values.iter().sum::<f64>())
}

/// Values by address.
type Known = HashMap<u128, Held>;

/// Exact draws from the posterior, each with its number: of the prior, accepted by their score.
fn draws(task: &Task, seed: u64) -> impl Iterator<Item = (u64, Run)> {
    let mut uniform = Stream::new(seed, 77, 0, 0);
    (1..).map(move |number| (number, forward(task, seed, number, false).expect("a run"))).filter(
        move |(_, run)| {
            assert!(run.log_score <= 0.0, "a score above zero");
            run.has_ended && uniform.uniform().ln() < run.log_score
        },
    )
}

/// The shares of each outcome, and the factor of the variance of their differences: exact shares, or shares of twenty times as
/// many draws if the program's value does not distinguish them.
struct Law {
    shares: HashMap<String, f64>,
    wider: f64,
}

impl Law {
    fn of(task: &Task, starts: usize) -> Law {
        let mut shares = HashMap::new();
        let enumerated = enumerate(task, 1_000_000, &mut |_| true).ok();
        let distinct = enumerated.filter(|all| all.outcomes.len() > 1 && task.sketches.is_empty());
        let Some(all) = distinct else {
            let n = 20 * starts;
            for (_, run) in draws(task, 1234).take(n) {
                *shares.entry(outcome(task, &run)).or_default() += 1.0 / n as f64;
            }
            return Law { shares, wider: 1.05 };
        };
        for (value, log) in &all.outcomes {
            *shares.entry(repr(value).expect("a value")).or_default() += (log - all.log_evidence).exp();
        }
        Law { shares, wider: 1.0 }
    }

    /// The largest |z| of the shares of outcomes after `moves` moves from each of `count` exact draws. Rare outcomes are
    /// counted together.
    fn furthest<S: Borrow<(u64, Known)>>(
        &self,
        task: &Task,
        kernel: &Kernel,
        starts: impl Iterator<Item = S>,
        count: usize,
        moves: u64,
        seed: u64,
    ) -> f64 {
        let mut shares: HashMap<String, f64> = HashMap::new();
        for start in starts {
            let (number, known) = start.borrow();
            let settings = Settings { seed, kernel: kernel.clone(), thin: 0, ..Settings::default() };
            let mut chain: Chain = Chain::start(task, &settings, *number, Some(known)).expect("a chain");
            chain.advance(task, moves, &mut |_, _| true).expect("a run");
            let end = outcome(task, &chain.now(&task.program));
            *shares.entry(end).or_default() += 1.0 / count as f64;
        }
        assert!(self.shares.len() > 2, "outcomes that are told apart");
        let (mut largest, mut rare): (f64, (f64, f64)) = (0.0, (0.0, 0.0));
        let z = |share: f64, p: f64| {
            (share - p).abs() / (self.wider * p * (1.0 - p) / count as f64).sqrt().max(1e-9)
        };
        for (value, &p) in &self.shares {
            let share = shares.remove(value).unwrap_or(0.0);
            if p * count as f64 > 25.0 {
                largest = largest.max(z(share, p));
            } else {
                rare = (rare.0 + share, rare.1 + p);
            }
        }
        rare.0 += shares.values().sum::<f64>();
        if rare.1 > 0.0 { largest.max(z(rare.0, rare.1)) } else { largest }
    }
}

/// Draws to start from.
fn starts(task: &Task, seed: u64) -> impl Iterator<Item = (u64, Known)> {
    draws(task, seed).map(|(number, run)| (number, by_address(&run.log.entries())))
}

/// The rows of one program that are further off than chance allows, after `moves` moves from each of `count` draws.
fn rejected(name: &str, count: usize, moves: u64) -> Vec<String> {
    let (_, text) = PROGRAMS.iter().find(|(program, _)| *program == name).expect("a program");
    let domain = Aabb { low: vec3(-0.2, -0.4, -0.2), high: vec3(0.2, 0.4, 0.2) };
    let mut task = task(text);
    if text.contains("emit") {
        task.sketches = vec![no_overshoot(domain, 0.5).expect("a sketch")];
    }
    let law = Law::of(&task, count);
    let starts: Vec<(u64, Known)> = starts(&task, 1).take(count).collect();
    let rows = kernels(&task)
        .into_iter()
        .map(|(kind, kernel)| (kind, law.furthest(&task, &kernel, starts.iter(), count, moves, 1)));
    rows.filter(|(_, z)| *z > 5.0).map(|(kind, z)| format!("{kind}: {z:.1}")).collect()
}

/// Every form of regrowth, on one program.
fn leaves_the_posterior_as_it_is(name: &str) {
    assert_eq!(rejected(name, 4000, 6), Vec::<String>::new());
}

#[test]
fn keeps_the_law_of_calls() {
    leaves_the_posterior_as_it_is("calls that depend on each other");
}

#[test]
fn keeps_the_law_of_a_recursion() {
    leaves_the_posterior_as_it_is("a recursion with an end that counts");
}

#[test]
fn keeps_the_law_of_futures() {
    leaves_the_posterior_as_it_is("a tree of futures that return nothing");
}

#[test]
fn keeps_the_law_of_waits() {
    leaves_the_posterior_as_it_is("futures that wait for each other");
}

#[test]
fn keeps_the_law_of_a_loop() {
    leaves_the_posterior_as_it_is("a loop that ends by chance");
}

#[test]
fn keeps_the_law_of_breaks() {
    leaves_the_posterior_as_it_is("loops with break and a count");
}

#[test]
fn keeps_the_law_of_lists() {
    leaves_the_posterior_as_it_is("lists that are built, passed and read");
}

#[test]
fn keeps_the_law_of_counts() {
    leaves_the_posterior_as_it_is("a count without a bound");
}

#[test]
fn keeps_the_law_of_shapes() {
    leaves_the_posterior_as_it_is("shapes that a sketch weighs");
}

#[test]
fn keeps_the_law_under_strong_scores() {
    leaves_the_posterior_as_it_is("strong scores on the way");
}

#[test]
fn keeps_the_law_where_nothing_can_turn() {
    leaves_the_posterior_as_it_is("choices without another value");
}

/// Long chains cannot tell bias from slow mixing; here a million exact draws make one move of two particles each.
#[test]
#[ignore = "a million starts; `make soak`"]
fn keeps_the_law_of_a_million_draws() {
    const COUNT: usize = 1_000_000;
    for name in [
        "a recursion with an end that counts",
        "futures that wait for each other",
        "a loop that ends by chance",
    ] {
        let (_, text) = PROGRAMS.iter().find(|(program, _)| *program == name).expect("a program");
        let task = task(text);
        let law = Law::of(&task, COUNT);
        for turn in [0.0, 1.0] {
            let kernel = regrow(2, turn, json!("size"));
            let z = law.furthest(&task, &kernel, starts(&task, 2).take(COUNT), COUNT, 1, 2);
            eprintln!("{name}, turned {turn}: {z:.2}");
            assert!(z < 5.0, "{name}, turned {turn}: {z:.1}");
        }
    }
}

/// Programs whose runs are disconnected for `pick="choice"`, and programs whose runs are connected.
const APART: [(&str, bool, &str); 7] = [
    (
        "loops that end at a choice",
        true,
        r#"(module (fn "m" (params) (set $n 0)
            (for $i (range 3) (body (for $j (range 3) (body
              (if (sample (dist bernoulli 0.2)) (then (break))) (set $n (add $n 1))))))
            (return $n)) (entry "m"))"#,
    ),
    (
        "a call that decides on another one",
        true,
        r#"(module (fn "one" (params) (return (sample (dist bernoulli 0.5))))
          (fn "m" (params) (if (call "one") (then (return (call "one")))) (return none)) (entry "m"))"#,
    ),
    (
        "a future that is begun or not",
        true,
        r#"(module (fn "one" (params) (return (sample (dist bernoulli 0.5))))
          (fn "m" (params) (set $a (call "one")) (set $f none) (if $a (then (set $f (future "one"))))
            (return (tuple $a (cond $a (force $f) 0)))) (entry "m"))"#,
    ),
    (
        "a choice of the whole run that decides",
        false,
        r#"(module (fn "one" (params) (return (sample (dist bernoulli 0.5))))
          (fn "m" (params) (if (sample (dist bernoulli 0.5)) (then (return (call "one")))) (return none)) (entry "m"))"#,
    ),
    (
        "a tree whose calls decide on what is below them",
        false,
        r#"(module (fn "grow" (params $d) (set $n 1)
            (if (and (lt $d 2) (sample (dist bernoulli 0.5))) (then (set $n (add (call "grow" (add $d 1)) 1))))
            (return $n))
          (fn "m" (params) (return (add (call "grow" 0) (call "grow" 0)))) (entry "m"))"#,
    ),
    (
        "calls that are always the same",
        false,
        r#"(module (fn "one" (params) (return (sample (dist bernoulli 0.5))))
          (fn "m" (params) (return (tuple (call "one") (call "one")))) (entry "m"))"#,
    ),
    (
        "loops that are always as long",
        false,
        r#"(module (fn "m" (params) (set $n 0)
            (for $i (range 3) (body (if (sample (dist bernoulli 0.4)) (then (set $n (add $n 1)))))) (return $n))
          (entry "m"))"#,
    ),
];

#[test]
fn runs_are_apart_where_chains_that_pick_choices_do_not_come_to_them() {
    for (name, apart, text) in APART {
        let task = task(text);
        assert_eq!(is_apart(&task, 7), apart, "{name}");
        let exact = enumerate(&task, 10_000, &mut |_| true).expect("finitely many runs");
        let likely =
            exact.outcomes.iter().filter(|outcome| (outcome.1 - exact.log_evidence).exp() > 0.02).count();
        let settings = Settings { kernel: regrow(4, 0.5, json!("choice")), ..Settings::default() };
        let mut chain: Chain = Chain::start(&task, &settings, 0, None).expect("a chain");
        let mut met = HashSet::new();
        for _ in 0..3000 {
            chain.advance(&task, 1, &mut |_, _| true).expect("a proposal");
            met.insert(repr(&chain.state.trace.result()).expect("text"));
        }
        // Of the outcomes that are likelier than 2 %, a chain that reaches all misses one in e^-60 of the cases.
        let reached = exact.outcomes.iter().filter(|outcome| {
            (outcome.1 - exact.log_evidence).exp() > 0.02 && met.contains(&repr(&outcome.0).expect("text"))
        });
        assert_eq!(reached.count() < likely, apart, "{name}: {met:?}");
    }
}

//! Every kernel and composition gives the answer of enumeration, on small discrete programs that change their
//! structure. (The list of deliberate errors has chains that forget a term of their acceptance ratio.)
//!
//! Each row runs 60,000 proposals with a fixed seed and takes the share of each value in 60 stretches of the chain; the
//! stretches' means are nearly independent, so (mean - exact) / (their standard error) is close to a t with 59 degrees of
//! freedom. Beyond 6 it lies once in 8 million; some 700 shares are looked at, so a re-seeded board fails once in ten
//! thousand runs.

use super::programs::leaf;
use super::programs::task;
use niwaki_chain::Settings;
use niwaki_chain::kernel::Kernel;
use niwaki_chain::ladder::Ladder;
use niwaki_chain::leaf::Proposer;
use niwaki_propose::user::User;
use niwaki_run::Task;
use niwaki_run::enumeration::enumerate;
use niwaki_run::select::Selection;
use niwaki_vm::value::repr;
use serde_json::json;
use std::collections::HashMap;
use std::sync::Arc;

/// Programs with few runs; `T` is replaced by the power of their factors.
const PROGRAMS: [(&str, &str); 6] = [
    (
        "two coins",
        r#"(module (fn "m" (params)
            (set $a (sample (dist bernoulli 0.3)))
            (set $b (sample (dist bernoulli (cond $a 0.9 0.2))))
            (do (factor (mul T (cond (eq $a $b) 0.0 -1.5))))
            (return (tuple $a $b))) (entry "m"))"#,
    ),
    (
        "a coin that decides how many more",
        r#"(module (fn "m" (params)
            (set $a (sample (dist bernoulli 0.6)))
            (set $n 0)
            (if $a (then
              (for $i (range 3) (body (set $b (sample (dist bernoulli 0.4))) (set $n (add $n (cond $b 1 0)))))))
            (do (factor (mul T (mul -0.7 $n))))
            (return (tuple $a $n))) (entry "m"))"#,
    ),
    (
        "a bounded recursion",
        r#"(module
          (fn "more" (params $k)
            (if (ge $k 4) (then (return $k)))
            (if (sample (dist bernoulli 0.6)) (then (return (call "more" (add $k 1)))))
            (return $k))
          (fn "m" (params) (set $k (call "more" 0)) (do (factor (mul T (mul 0.8 $k)))) (return $k)) (entry "m"))"#,
    ),
    (
        "a bound that is a choice",
        // The second value's support depends on the first: values outside it reject the proposal.
        r#"(module (fn "m" (params)
            (set $n (sample (dist discrete_uniform 1 3)))
            (set $k (sample (dist discrete_uniform 0 $n)))
            (do (factor (mul T (mul 0.5 $k))))
            (return (tuple $n $k))) (entry "m"))"#,
    ),
    (
        "a family that is a choice",
        r#"(module (fn "m" (params)
            (set $a (sample (dist bernoulli 0.4)))
            (set $d (cond $a (dist categorical (list 0.2 0.5 0.3)) (dist binomial 2 0.3)))
            (set $k (sample $d))
            (do (factor (mul T (cond (eq $k 1) 0.6 0.0))))
            (return (tuple $a $k))) (entry "m"))"#,
    ),
    (
        "a chain of states",
        r#"(module (const 0 (list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4))
            (dist categorical (list 0.3 0.3 0.4))))
          (fn "m" (params) (set $s 0)
            (for $i (range 3) (body (set $s (sample (index (data 0) $s)))
              (do (factor (mul T (cond (eq $s $i) 0.5 -0.5))))))
            (return $s)) (entry "m"))"#,
    ),
];

fn program(text: &str, power: &str) -> Task {
    task(&text.replace(" T ", &format!(" {power} ")))
}

/// A user's proposal: a distribution over whole numbers near the old one, skewed, so that its reverse matters.
fn skewed() -> Kernel {
    let text = r#"(module (fn "near" (params $old) (return (dist binomial 3 (cond (eq $old 0) 0.2 0.6)))) (entry "near"))"#;
    Kernel::Leaf(Proposer::Proposal(Arc::new(User::new(task(text)).expect("a proposal"))))
}

fn on(pattern: &str, kernel: Kernel) -> Kernel {
    Kernel::On(Selection { sites: vec![vec![pattern.into()]], ..Selection::default() }, Box::new(kernel))
}

struct Row {
    name: &'static str,
    kernel: Kernel,
    powers: Vec<f64>,
    /// The power of the score that the row's states follow.
    power: &'static str,
    /// The only program of the row; empty for all programs.
    only: &'static str,
}

fn rows() -> Vec<Row> {
    let prior = || Kernel::PRIOR;
    let row = |name, kernel| Row { name, kernel, powers: vec![1.0], power: "1.0", only: "" };
    let block = || leaf("block", json!({"step": 0.3, "share": 0.5, "target": 0.23}));
    let deep = Selection { depth: vec![1.0, 1.0, 3.0, 9.0, 27.0], ..Selection::default() };
    let sites = Selection { weights: vec![("b".into(), 3.0), ("a".into(), 0.5)], ..Selection::default() };
    vec![
        row("prior", prior()),
        row("neighbour", leaf("neighbour", json!({"reach": 2}))),
        row("by family", leaf("by_family", json!({}))),
        row("drift", leaf("drift", json!({"step": 0.5, "target": 0.44}))),
        row("regenerate 0", leaf("regenerate", json!({"levels": 0}))),
        row("regenerate 1", leaf("regenerate", json!({"levels": 1}))),
        row("block, all choices", leaf("block", json!({"step": 0.3, "share": 1.0, "target": 0.23}))),
        row("cycle", Kernel::Cycle(vec![prior(), block()])),
        row(
            "mixture",
            Kernel::Mixture(vec![
                (1.0, block()),
                (2.0, prior()),
                (1.0, leaf("regenerate", json!({"levels": 0}))),
            ]),
        ),
        row(
            "repeat",
            Kernel::Repeat(3, Box::new(Kernel::Cycle(vec![prior(), leaf("neighbour", json!({"reach": 1}))]))),
        ),
        row("weights by depth", Kernel::On(deep.clone(), Box::new(prior()))),
        Row {
            powers: vec![1.0, 0.5, 0.2],
            ..row("tempering, weights by depth", Kernel::On(deep, Box::new(prior())))
        },
        Row {
            only: "a coin that decides how many more",
            ..row("weights by site", Kernel::On(sites, Box::new(prior())))
        },
        row("on", Kernel::Cycle(vec![on("**", prior()), on("**", leaf("regenerate", json!({"levels": 0})))])),
        Row {
            power: "0.5",
            ..row(
                "anneal, held at a half",
                Kernel::Anneal { start: 0.5, end: 0.5, steps: 9, kernel: Box::new(prior()) },
            )
        },
        Row { powers: vec![1.0, 0.5, 0.2], ..row("tempering", prior()) },
        Row {
            only: "a bound that is a choice",
            ..row("own proposal", Kernel::Cycle(vec![prior(), on("k", skewed())]))
        },
    ]
}

/// The largest |z| over the values of a program.
fn worst(text: &str, row: &Row, seed: u64) -> f64 {
    furthest(&program(text, "1.0"), &program(text, row.power), &settings(row, seed))
}

fn settings(row: &Row, seed: u64) -> Settings {
    Settings {
        seed,
        kernel: row.kernel.clone(),
        thin: 0,
        powers: row.powers.clone(),
        every: 5,
        ..Settings::default()
    }
}

/// The largest |z| over the values of a task whose chain follows the posterior of `followed`.
pub fn furthest(task: &Task, followed: &Task, settings: &Settings) -> f64 {
    let exact = enumerate(followed, 100_000, &mut |_| true).expect("few runs");
    let shares = exact.outcomes.iter().map(|(value, log)| {
        let value = repr(value).expect("a value");
        (value, (log - exact.log_evidence).exp())
    });
    let shares: Vec<_> = shares.collect();
    // On one thread, since a step of a ladder is too short for more.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    pool.install(|| worst_of(task, &shares, settings))
}

/// The largest |z| for a task whose values have these probabilities.
fn worst_of(task: &Task, exact: &[(String, f64)], settings: &Settings) -> f64 {
    const STRETCHES: usize = 60;
    let mut chain = Ladder::start(task, settings, 0, None).expect("a chain");
    chain.advance(task, 500, &mut |_, _| true).expect("a run");
    let mut shares: Vec<HashMap<String, f64>> = vec![HashMap::new(); STRETCHES];
    for share in &mut shares {
        for _ in 0..1000 {
            chain.advance(task, 1, &mut |_, _| true).expect("a run");
            let value = repr(&chain.rungs[0].state.trace.result()).expect("a value");
            *share.entry(value).or_default() += 0.001;
        }
    }
    let mut largest: f64 = 0.0;
    for (value, probability) in exact {
        let shares_of_value: Vec<f64> =
            shares.iter().map(|share| share.get(value).copied().unwrap_or(0.0)).collect();
        let n = STRETCHES as f64;
        let mean = shares_of_value.iter().sum::<f64>() / n;
        let variance = shares_of_value.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
        largest = largest.max((mean - probability).abs() / (variance / n).sqrt().max(1e-4));
    }
    largest
}

#[test]
fn every_kernel_gives_the_exact_answer() {
    let mut wrong = String::new();
    for (name, text) in PROGRAMS {
        for row in rows().iter().filter(|row| row.only.is_empty() || row.only == name) {
            let z = worst(text, row, 11);
            if z > 6.0 {
                wrong += &format!("{name}, {}: z = {z}\n", row.name);
            }
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

/// A narrow peak and a wide one: a step that goes on adapting shrinks on the narrow one until it no longer leads away.
/// The value says on which side of 1 it is; of the wide peak's mass Phi(-2) is below.
#[test]
fn a_step_that_is_not_adapted_finds_both_peaks() {
    const BELOW: f64 = 0.5 + 0.5 * 0.022_750_131_948_179_2;
    let two = task(
        r#"(module (fn "m" (params)
            (set $x (sample (dist mixture (list 0.5 0.5) (list (dist gaussian 0.0 0.01) (dist gaussian 4.0 1.5)))))
            (return (lt $x 1.0))) (entry "m"))"#,
    );
    let exact = [("True".to_string(), BELOW), ("False".to_string(), 1.0 - BELOW)];
    for (name, kernel) in [
        ("drift", leaf("drift", json!({"step": 3.0, "target": 0.44}))),
        ("block", leaf("block", json!({"step": 3.0, "share": 1.0, "target": 0.44}))),
    ] {
        let row = Row { name, kernel, powers: vec![1.0], power: "1.0", only: "" };
        let z = worst_of(&two, &exact, &settings(&row, 11));
        assert!(z < 6.0, "{name}: z = {z}");
    }
}

//! Annealed importance sampling is unbiased for the evidence and for the evidence in each value, on finite programs: runs that
//! are impossible under the prior, structure that changes, few particles, short ladders, one proposal at each rung.
//!
//! Means over 20,000 searches of two particles, within 5 standard errors of enumeration: once in 1.7 million each, and about
//! twenty are looked at. Mutants in `tests/mutants`: moves by the rung before, the share of possible runs by all tries.

use niwaki_chain::kernel::Kernel;
use niwaki_run::Task;
use niwaki_run::enumeration::enumerate;
use niwaki_search::direct::annealed::{Powers, Settings, annealed};
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use niwaki_vm::value::repr;
use std::collections::HashMap;
use std::sync::Arc;

/// Half of the runs are impossible; of the others one value is twenty times as probable as it was.
const HALF: &str = r#"(module (fn "m" (params) (set $x (sample (dist categorical (list 0.5 0.3 0.2))))
    (do (condition (gt $x 0))) (do (factor (cond (eq $x 2) 3.0 0.0))) (return $x)) (entry "m"))"#;

/// A second choice if the first is heads, and a third if both are.
const GROWING: &str = r#"(module (fn "m" (params)
    (if (sample (dist bernoulli 0.3))
        (then (set $n (sample (dist discrete_uniform 0 2))) (do (factor (mul $n 1.5)))
              (if (eq $n 2) (then (set $n (add $n (sample (dist bernoulli 0.5)))) (do (factor (mul $n 0.4)))) (else))
              (return $n))
        (else (do (factor 0.5)) (return 7)))) (entry "m"))"#;

fn task(text: &str) -> Task {
    Task::new(Arc::new(compile(&parse(text).expect("core form"), vec![]).expect("a program")))
}

fn settings(powers: &[f64], seed: u64) -> Settings {
    Settings { particles: 2, powers: powers.to_vec(), kernel: Kernel::PRIOR, moves: 1, tries: 1000, seed }
}

/// The largest z-score of the evidence, and of the evidence in each value.
fn worst(text: &str, powers: &[f64]) -> f64 {
    const SEARCHES: u64 = 20_000;
    let task = task(text);
    let exact = enumerate(&task, 1000, &mut |_| true).expect("an enumeration");
    let mut truths: HashMap<String, f64> =
        exact.outcomes.iter().map(|(value, log)| (repr(value).expect("a text"), log.exp())).collect();
    truths.insert("all".into(), exact.log_evidence.exp());
    let mut sums: HashMap<String, (f64, f64)> = HashMap::new();
    for seed in 0..SEARCHES {
        let result = annealed(&task, &settings(powers, seed), &|_| true).expect("a search");
        let mut evidence_by_value: HashMap<String, f64> = HashMap::new();
        for run in &result.runs {
            *evidence_by_value.entry(repr(&run.value).expect("a text")).or_default() +=
                0.5 * run.log_weight.exp();
        }
        evidence_by_value.insert("all".into(), result.log_evidence.expect("an evidence").exp());
        for (name, x) in evidence_by_value {
            let (sum, squares) = sums.entry(name).or_default();
            *sum += x;
            *squares += x * x;
        }
    }
    let n = SEARCHES as f64;
    let z = |(name, truth): (&String, &f64)| {
        let (sum, squares) = sums.get(name).copied().unwrap_or_default();
        let mean = sum / n;
        ((mean - truth) / ((squares / n - mean * mean) / n).sqrt()).abs()
    };
    truths.iter().map(z).fold(0.0, f64::max)
}

#[test]
fn the_evidence_is_unbiased_where_runs_are_impossible() {
    for powers in [&[1.0][..], &[0.2, 1.0], &[0.1, 0.3, 0.6, 1.0]] {
        let z = worst(HALF, powers);
        assert!(z < 5.0, "{powers:?}: {z}");
    }
}

#[test]
fn the_evidence_is_unbiased_where_structure_changes() {
    for powers in [&[1.0][..], &[0.2, 1.0], &[0.1, 0.3, 0.6, 1.0]] {
        let z = worst(GROWING, powers);
        assert!(z < 5.0, "{powers:?}: {z}");
    }
}

#[test]
fn a_ladder_makes_weights_equal() {
    let effective = |powers: &[f64]| {
        let task = task(GROWING);
        annealed(&task, &Settings { particles: 400, moves: 20, ..settings(powers, 3) }, &|_| true)
            .expect("a search")
            .effective
    };
    let of = |rungs| effective(&Powers::Rungs(rungs).ladder());
    let effective = [1, 6, 60].map(of);
    assert!(effective.is_sorted_by(|a, b| a < b), "{effective:?}");
}

#[test]
fn a_ladder_rises_to_one() {
    assert_eq!(Powers::Rungs(2).ladder(), [1.0 / 16.0, 1.0]);
}

#[test]
fn stopped_searches_have_no_evidence() {
    let calls = std::sync::atomic::AtomicUsize::new(0);
    let watch = |_: f64| calls.fetch_add(1, std::sync::atomic::Ordering::Relaxed) < 40;
    let settings = Settings { particles: 1000, ..settings(&[0.5, 1.0], 1) };
    let result = annealed(&task(HALF), &settings, &watch).expect("a part");
    assert!(result.interrupted && result.log_evidence.is_none() && (1..1000).contains(&result.runs.len()));
    let none = annealed(&task(HALF), &settings, &|_| false);
    assert!(none.is_err());
}

#[test]
fn numbers_of_threads_change_no_bit() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let settings = Settings { particles: 50, ..settings(&[0.1, 0.5, 1.0], 9) };
        let result = pool.install(|| annealed(&task(GROWING), &settings, &|_| true).expect("a search"));
        (result.log_evidence.map(f64::to_bits), format!("{:?}", result.runs))
    };
    assert_eq!(run(1), run(3));
}

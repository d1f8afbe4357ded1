//! The claim: several populations are one estimate, unbiased and of the right posterior, with sizes that differ and
//! with populations that die; the plan repeats them; threads change nothing.

use super::*;
use crate::many::by_clock;
use std::sync::atomic::{AtomicU64, Ordering};

/// Z-scores as in the parent module, over 2,000 searches of three small populations each.
#[test]
fn populations_of_any_size_are_one_right_answer() {
    for (name, text) in PROGRAMS {
        let (task, settings) = (task(text), settings(Order::Stochastic, Resampling::Systematic));
        let search =
            |seed| populations(&task, &Settings { seed, ..settings.clone() }, &[2, 9, 4], &mut |_| true);
        let scores = z_scores_of(&task, &search, 0..2000);
        assert!(worst(&scores) < LIMIT, "{name}: {scores:?}");
    }
}

/// Populations of one particle die often here; one that died must count as zero, and sizes must count.
#[test]
fn a_population_that_died_counts_as_zero() {
    let text = r#"(module (fn "m" (params) (set $x (sample (dist bernoulli 0.3))) (do (condition $x))
        (set $y (sample (dist bernoulli 0.5))) (do (factor (cond $y 0.0 -1.0))) (return $y)) (entry "m"))"#;
    let settings = settings(Order::Stochastic, Resampling::Systematic);
    let search =
        |seed| populations(&task(text), &Settings { seed, ..settings.clone() }, &[1, 1, 3, 1], &mut |_| true);
    let scores = z_scores_of(&task(text), &search, 0..4000);
    assert!(worst(&scores) < LIMIT, "{scores:?}");
    let died = (0..100).filter_map(|seed| search(seed).ok()).map(|result| result.died).sum::<usize>();
    assert!(died > 100, "{died}");
}

/// A combination that gives populations equal weights is wrong, and the judge sees it.
#[test]
fn populations_that_weigh_alike_are_rejected() {
    let search = |text| {
        move |seed| {
            let settings = settings(Order::Stochastic, Resampling::Systematic);
            let mut result =
                populations(&task(text), &Settings { seed, ..settings }, &[2, 2, 2], &mut |_| true)?;
            // As if each population's particles were drawn from the posterior.
            let mut from = 0;
            for size in result.plan.clone() {
                let part = &mut result.particles[from..from + size];
                let sum = part.iter().map(|p| p.log_weight.exp()).sum::<f64>().ln();
                part.iter_mut().for_each(|p| p.log_weight -= sum);
                from += size;
            }
            Ok(result)
        }
    };
    let caught = |(_, text): &(&'static str, &'static str)| {
        worst(&z_scores_of(&task(text), &search(text), 0..4000)) > LIMIT
    };
    assert!(PROGRAMS.iter().any(caught));
}

#[test]
fn threads_change_nothing_in_populations() {
    let run = |threads: usize, plan: &[usize]| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let settings = Settings { seed: 3, ..Settings::default() };
        let result =
            pool.install(|| populations(&task(PROGRAMS[5].1), &settings, plan, &mut |_| true)).unwrap();
        let values: Vec<String> = result.particles.iter().map(|p| repr(&p.value).unwrap()).collect();
        let weights: Vec<u64> = result.particles.iter().map(|p| p.log_weight.to_bits()).collect();
        (result.log_evidence.unwrap().to_bits(), values, weights)
    };
    for plan in [&[40, 7, 64][..], &[200][..]] {
        assert_eq!(run(1, plan), run(2, plan));
        assert_eq!(run(1, plan), run(8, plan));
    }
}

/// A run with a high weight takes ten barriers, any other two; a barrier of a population takes one second.
const COSTLY: &str = r#"(module (fn "m" (params) (set $x (sample (dist bernoulli 0.005)))
    (do (factor (cond $x 6.0 0.0)))
    (if $x (then (for $i (range 8) (body (do (factor 0.0)))))) (return $x)) (entry "m"))"#;

fn by_barriers(
    task: &Task,
    settings: &Settings,
    seconds: u64,
) -> std::result::Result<Result, niwaki_run::Failure> {
    let barriers = AtomicU64::new(0);
    let clock = || Duration::from_secs(barriers.load(Ordering::Relaxed));
    let mut watch = |_: Progress| {
        barriers.fetch_add(1, Ordering::Relaxed);
        true
    };
    by_clock(task, settings, Duration::from_secs(seconds), &clock, &mut watch)
}

fn timed_scores(seconds: u64) -> Vec<(String, f64)> {
    let (task, settings) = (task(COSTLY), settings(Order::Stochastic, Resampling::Systematic));
    let search = |seed| by_barriers(&task, &Settings { seed, ..settings.clone() }, seconds);
    z_scores_of(&task, &search, 0..6000)
}

/// Z-scores as in the parent module, over 6,000 searches each. In eight seconds one to three populations count, some of them
/// alone and late; in twenty-five two to a dozen do.
#[test]
fn a_search_by_time_is_unbiased_though_runs_of_high_weight_cost_more() {
    for seconds in [8, 15, 25] {
        let scores = timed_scores(seconds);
        assert!(worst(&scores) < LIMIT, "{seconds}: {scores:?}");
    }
}

#[test]
fn a_search_by_time_is_repeated_by_its_plan() {
    let settings = Settings { seed: 11, ..Settings::default() };
    let task = task(PROGRAMS[5].1);
    let timed = by_barriers(&task, &settings, 30).unwrap();
    assert!(timed.plan.len() > 1 && timed.plan.iter().sum::<usize>() == timed.particles.len());
    assert!(timed.plan.iter().all(|size| *size == timed.plan[0]), "{:?}", timed.plan);
    let again = populations(&task, &settings, &timed.plan, &mut |_| true).unwrap();
    assert_eq!(timed.log_evidence.unwrap().to_bits(), again.log_evidence.unwrap().to_bits());
    let weights = |r: &Result| r.particles.iter().map(|p| p.log_weight.to_bits()).collect::<Vec<_>>();
    assert_eq!(weights(&timed), weights(&again));
}

/// By the machine's clock, however slow it is.
#[test]
fn a_search_by_time_ends() {
    let settings = Settings { seed: 11, ..Settings::default() };
    let timed = within(&task(PROGRAMS[5].1), &settings, Duration::from_millis(50), &mut |_| true).unwrap();
    assert!(!timed.interrupted && timed.log_evidence.is_some() && timed.plan[0] >= 16);
    let stopped = within(&task(PROGRAMS[5].1), &settings, Duration::from_secs(60), &mut |_| false).unwrap();
    assert!(stopped.interrupted && stopped.log_evidence.is_none());
}

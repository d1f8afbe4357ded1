//! Every method follows the law given the held choices, and no run loses a held choice.
//!
//! The oracle knows nothing of holding: it lists all runs of the free program by a script of values, selects those with
//! the held values at the held addresses, and sums up the rest. Enumeration must agree to 1e-9. Estimates of methods that draw,
//! with fixed seeds, are compared by their standard errors: (evidence times share) is unbiased, and a chain has the error of
//! 60 stretches. A share is beyond 6 once in 8 million; there are some 900.

use super::board::furthest;
use super::programs::{leaf, task};
use super::regrown::PROGRAMS;
use niwaki_agreement::{compare, repetitions};
use niwaki_chain::kernel::Kernel;
use niwaki_chain::leaf::regrow::{Afresh, afresh};
use niwaki_chain::{Chain, Settings as ChainSettings};
use niwaki_math::log_sums::log_sum_exp;
use niwaki_math::{Dist, Stream};
use niwaki_particles::{Ancestors, Anneal, Moment, Rejuvenation, Settings, When, particle_gibbs, pimh, smc};
use niwaki_propose::importance::importance;
use niwaki_run::chooser::{Chooser, Chosen, Context};
use niwaki_run::enumeration::enumerate;
use niwaki_run::forward::forward_by;
use niwaki_run::hold::hold;
use niwaki_run::order::Order;
use niwaki_run::rejection::rejection;
use niwaki_run::replay::{Missing, Source, by_address, replay};
use niwaki_run::resampling::Resampling;
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::value::{Value, identical, repr};
use serde_json::json;
use std::collections::HashMap;

/// Beside the programs of regrowth whose values distinguish their runs: functions as values, and observations.
const CLOSURES: &str = r#"(module
    (fn "few" (params $p) (set $x (sample (dist bernoulli $p))) (return (cond $x 1 0)))
    (fn "many" (params $p) (set $x (sample (dist binomial 3 $p))) (set $y (sample (dist bernoulli 0.5)))
      (return (add $x (cond $y 10 0))))
    (fn "m" (params) (set $c (sample (dist bernoulli 0.6))) (set $f (cond $c (closure "few") (closure "many")))
      (set $s 0) (for $i (range 2) (body (set $s (add (mul 20 $s) (apply $f (cond $c 0.3 0.6))))
        (do (observe (dist binomial 9 (cond (gt $s 3) 0.6 0.4)) 4))))
      (return $s)) (entry "m"))"#;

fn programs() -> Vec<(&'static str, &'static str)> {
    let is_distinct =
        |(_, text): &(&str, &str)| !text.contains("(return (tuple)))") && !text.contains("geometric");
    let mut all: Vec<_> =
        PROGRAMS.into_iter().filter(is_distinct).filter(|p| !p.1.contains("emit")).collect();
    all.push(("functions as values", CLOSURES));
    all
}

/// Gives choices the values of a script, and after its end the first value.
#[derive(Default)]
struct Scripted {
    script: Vec<usize>,
    widths: Vec<usize>,
    met: Vec<(String, Value)>,
}

impl Chooser for &mut Scripted {
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, _: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let mut draws = dist.enumerate().expect("few values");
        draws.retain(|draw| dist.log_density(draw) > f64::NEG_INFINITY);
        let index = self.script.get(self.widths.len()).copied().unwrap_or(0);
        self.widths.push(draws.len());
        let log = dist.log_density(&draws[index]);
        let value = Value::from(draws.swap_remove(index));
        self.met.push((at.path(), value.clone()));
        Ok(Some(Chosen { value, log_prior: log, log_drawn: log }))
    }
}

/// A run of the free program: choices, value, log joint.
type Listed = (Vec<(String, Value)>, String, f64);

/// All possible runs of a program.
fn listed(task: &Task) -> Vec<Listed> {
    let (mut all, mut script) = (vec![], vec![]);
    loop {
        let mut scripted = Scripted { script: script.clone(), ..Scripted::default() };
        let run = forward_by(task, &mut scripted, false).expect("a run");
        if run.has_ended {
            let value = repr(&run.value).expect("a value");
            all.push((scripted.met, value, run.log_prior + run.log_score));
        }
        script.resize(scripted.widths.len(), 0);
        while let Some(last) = script.pop() {
            if last + 1 < scripted.widths[script.len()] {
                script.push(last + 1);
                break;
            }
        }
        if script.is_empty() {
            return all;
        }
    }
}

/// Whether a choice has the held value: 1 and 0 are true and false, as in observations.
fn equal(a: &Value, b: &Value) -> bool {
    let number = |value: &Value| match value {
        Value::Bool(b) => Value::Int(i64::from(*b)),
        other => other.clone(),
    };
    identical(&number(a), &number(b))
}

/// The unnormalised law of the program's value given held choices: log of each value's sum.
fn conditioned(runs: &[Listed], held: &[(String, Value)]) -> HashMap<String, f64> {
    let mut sums: HashMap<String, Vec<f64>> = HashMap::new();
    for (choices, value, log) in runs {
        let has = |(path, value): &(String, Value)| choices.iter().any(|(p, v)| p == path && equal(v, value));
        if held.iter().all(has) {
            sums.entry(value.clone()).or_default().push(*log);
        }
    }
    sums.into_iter().map(|(value, logs)| (value, log_sum_exp(logs.into_iter()))).collect()
}

/// Locks of a program: a few choices of some runs, by a fixed seed.
fn locks(runs: &[Listed], count: usize) -> Vec<Vec<(String, Value)>> {
    let mut random = Stream::new(5, 0, 0, 0);
    let mut locks = vec![];
    while locks.len() < count {
        let choices = &runs[(random.uniform() * runs.len() as f64) as usize].0;
        let held: Vec<_> = choices.iter().filter(|_| random.uniform() < 0.3).cloned().collect();
        if !held.is_empty() && held.len() < choices.len() {
            locks.push(held);
        }
    }
    locks
}

#[test]
fn enumeration_gives_the_law_given_held_choices() {
    for (name, text) in programs() {
        let task = task(text);
        let runs = listed(&task);
        for held in locks(&runs, 40) {
            let exact = conditioned(&runs, &held);
            let locked = hold(&task, held.clone()).expect("a lock");
            let result = enumerate(&locked, 1_000_000, &mut |_| true).expect("possible runs");
            assert_eq!(result.outcomes.len(), exact.len(), "{name}: {held:?}");
            for (value, log) in result.outcomes {
                let expected = exact[&repr(&value).expect("a value")];
                assert!((log - expected).abs() < 1e-9, "{name}, {held:?}: {log} for {expected}");
            }
        }
    }
}

/// The largest |z| of unbiased estimates of the evidence times the share of each value, relative to the evidence.
fn worst(exact: &HashMap<String, f64>, estimates: &[(f64, Vec<(String, f64)>)]) -> f64 {
    let log_evidence = log_sum_exp(exact.values().copied());
    let n = estimates.len() as f64;
    let mut largest = 0.0f64;
    for (value, log) in exact {
        let (mut sum, mut squares) = (0.0, 0.0);
        for (log_mean, runs) in estimates {
            let total: f64 = runs.iter().map(|(_, w)| w).sum();
            let weight_of_value: f64 = runs.iter().filter(|(v, _)| v == value).map(|(_, w)| w).sum();
            let x = if total > 0.0 { (log_mean - log_evidence).exp() * weight_of_value / total } else { 0.0 };
            (sum, squares) = (sum + x, squares + x * x);
        }
        let (mean, p) = (sum / n, (log - log_evidence).exp());
        let error = ((squares / n - mean * mean) / n).sqrt().max(1e-6);
        // The error of a rare value is unknown.
        if p * n > 10.0 {
            largest = largest.max((mean - p).abs() / error);
        }
    }
    largest
}

/// Runs with their weights, by the text of the value.
fn weighed<'a>(runs: impl Iterator<Item = (&'a Value, f64)>) -> Vec<(String, f64)> {
    runs.map(|(value, log)| (repr(value).expect("a value"), log.exp())).collect()
}

/// Each program with two of its locks, and the exact law under it.
fn locked() -> Vec<(String, Task, HashMap<String, f64>)> {
    let mut all = vec![];
    for (name, text) in programs() {
        let task = task(text);
        let runs = listed(&task);
        for held in locks(&runs, 2) {
            let exact = conditioned(&runs, &held);
            all.push((format!("{name}, {held:?}"), hold(&task, held).expect("a lock"), exact));
        }
    }
    all
}

#[test]
fn populations_give_the_law_given_held_choices() {
    let seeds = repetitions(1500);
    let plain = |order, resampling| Settings { particles: 8, order, resampling, ..Settings::default() };
    let moved = |kernel| Rejuvenation { kernel, moves: 2, at: Moment::End, final_chains: None };
    let regrow = leaf("regrow", json!({"particles": 3, "turn": 0.5, "pick": "size"}));
    let rows = [
        plain(Order::DepthFirst, Resampling::Systematic),
        plain(Order::Stochastic, Resampling::Residual),
        plain(Order::Stochastic, Resampling::Tempered),
        Settings { when: When::EffectiveBelow(0.5), ..plain(Order::Stochastic, Resampling::Multinomial) },
        Settings {
            anneal: Anneal::Schedule(vec![0.3, 0.7, 1.0]),
            ..plain(Order::DepthFirst, Resampling::Systematic)
        },
        Settings {
            rejuvenate: Some(moved(Kernel::Cycle(vec![Kernel::PRIOR, regrow]))),
            ..plain(Order::Stochastic, Resampling::Systematic)
        },
    ];
    for (name, task, exact) in locked() {
        for (row, settings) in rows.iter().enumerate() {
            let mut estimates = vec![];
            for seed in 0..seeds {
                match smc(&task, &Settings { seed, ..settings.clone() }, &mut |_| true) {
                    Ok(result) => estimates.push((
                        result.log_evidence.expect("an estimate"),
                        weighed(result.particles.iter().map(|p| (&p.value, p.log_weight))),
                    )),
                    Err(failure) if failure.is_impossible() => estimates.push((f64::NEG_INFINITY, vec![])),
                    Err(other) => panic!("{other}"),
                }
            }
            let z = worst(&exact, &estimates);
            assert!(z < 6.0, "{name}, row {row}: z = {z}");
        }
    }
}

/// A call that passes on a future is left before the future begins, and the future may still make the held choice.
#[test]
fn a_future_may_begin_after_its_call_is_left() {
    let text = r#"(module
        (fn "late" (params) (set $x (sample (dist bernoulli 0.3))) (do (factor (cond $x 0.5 -0.5))) (return $x))
        (fn "early" (params) (set $later (future "late")) (return $later))
        (fn "m" (params) (set $later (call "early")) (set $y (sample (dist bernoulli 0.4)))
          (do (factor (cond $y -0.3 0.2))) (set $x (force $later)) (return (add (cond $x 10 0) (cond $y 1 0))))
        (entry "m"))"#;
    let free = task(text);
    let runs = listed(&free);
    let held: Vec<_> = runs[0].0.iter().filter(|(path, _)| path.ends_with("/x")).cloned().collect();
    assert_eq!(held.len(), 1);
    let (exact, locked) = (conditioned(&runs, &held), hold(&free, held).expect("a lock"));
    let mut estimates = vec![];
    for seed in 0..repetitions(1500) {
        let settings = Settings { particles: 8, seed, ..Settings::default() };
        let result = smc(&locked, &settings, &mut |_| true).expect("particles");
        assert!(
            result.particles.iter().all(|particle| particle.cause.is_none()),
            "a particle lost the held choice"
        );
        let log_evidence = result.log_evidence.expect("an estimate");
        estimates.push((log_evidence, weighed(result.particles.iter().map(|p| (&p.value, p.log_weight)))));
    }
    let z = worst(&exact, &estimates);
    assert!(z < 6.0, "z = {z}");
}

#[test]
fn direct_draws_give_the_law_given_held_choices() {
    for (name, task, exact) in locked() {
        let result = importance(&task, None, 20_000, 1, &mut |_| true).expect("possible runs");
        let estimates: Vec<_> = result
            .runs
            .iter()
            .map(|run| (run.log_weight, weighed(std::iter::once((&run.value, 0.0)))))
            .collect();
        let z = worst(&exact, &estimates);
        assert!(z < 6.0, "{name}, importance: z = {z}");
        let drawn = rejection(&task, 2000, 0.0, 10_000_000, 1, &mut |_| true);
        // A score above zero is refused, since factors of one program are not bounded by it.
        let Ok(drawn) = drawn else { continue };
        let log_evidence = log_sum_exp(exact.values().copied());
        let estimate = |run: &Run| (log_evidence, weighed(std::iter::once((&run.value, 0.0))));
        let z = worst(&exact, &drawn.runs.iter().map(estimate).collect::<Vec<_>>());
        assert!(z < 6.0, "{name}, rejection: z = {z}");
    }
}

#[test]
fn chains_of_whole_runs_give_the_law_given_held_choices() {
    const STRETCH: usize = 100;
    let settings = Settings { particles: 6, seed: 3, ..Settings::default() };
    let gibbs = Settings { resampling: Resampling::Multinomial, ..settings.clone() };
    for (name, task, exact) in locked() {
        let chains = [
            ("particle Gibbs", particle_gibbs(&task, &gibbs, Ancestors::Sampled, 6000, None, &mut |_| true)),
            ("pimh", pimh(&task, &settings, 6000, &mut |_| true)),
        ];
        for (method, chain) in chains {
            let states = chain.expect("a chain").states;
            let log_evidence = log_sum_exp(exact.values().copied());
            let stretch = |some: &[niwaki_run::run::Run]| {
                (log_evidence, weighed(some.iter().map(|state| (&state.value, 0.0))))
            };
            let estimates: Vec<_> = states.chunks_exact(STRETCH).map(stretch).collect();
            let z = worst_of_stretches(&exact, &estimates);
            assert!(z < 6.0, "{name}, {method}: z = {z}");
        }
    }
}

/// As [`worst`], for estimates that are means of many draws: no value is too rare.
fn worst_of_stretches(exact: &HashMap<String, f64>, estimates: &[(f64, Vec<(String, f64)>)]) -> f64 {
    let log_evidence = log_sum_exp(exact.values().copied());
    let common = exact.iter().filter(|(_, log)| (*log - log_evidence).exp() > 0.02);
    worst_among(&common.map(|(value, log)| (value.clone(), *log)).collect(), log_evidence, estimates)
}

fn worst_among(
    some: &HashMap<String, f64>,
    log_evidence: f64,
    estimates: &[(f64, Vec<(String, f64)>)],
) -> f64 {
    let n = estimates.len() as f64;
    let mut largest = 0.0f64;
    for (value, log) in some {
        let share = |runs: &[(String, f64)]| {
            runs.iter().filter(|(v, _)| v == value).count() as f64 / runs.len() as f64
        };
        let shares: Vec<f64> = estimates.iter().map(|(_, runs)| share(runs)).collect();
        let mean = shares.iter().sum::<f64>() / n;
        let variance = shares.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let p = (log - log_evidence).exp();
        largest = largest.max((mean - p).abs() / (variance / n).sqrt().max(1e-4));
    }
    largest
}

fn kernels() -> Vec<(&'static str, Kernel)> {
    let regrow = |turn, pick| leaf("regrow", json!({"particles": 3, "turn": turn, "pick": pick}));
    let regenerate = |levels| leaf("regenerate", json!({"levels": levels}));
    let block = || leaf("block", json!({"step": 0.3, "share": 0.5, "target": 0.23}));
    vec![
        ("prior", Kernel::PRIOR),
        ("regrow", regrow(0.5, "size")),
        (
            "all",
            Kernel::Cycle(vec![
                Kernel::PRIOR,
                leaf("drift", json!({"step": 0.5, "target": 0.44})),
                leaf("neighbour", json!({"reach": 1})),
                leaf("by_family", json!({})),
                Kernel::Mixture(vec![(1.0, block()), (1.0, regenerate(0)), (1.0, regenerate(1))]),
                regrow(0.3, "choice"),
            ]),
        ),
    ]
}

#[test]
fn chains_give_the_law_given_held_choices() {
    for (name, task, _) in locked().into_iter().step_by(2) {
        for (kind, kernel) in kernels().into_iter().skip(1) {
            let settings = ChainSettings { seed: 7, kernel, thin: 0, ..ChainSettings::default() };
            // The oracle above confirms enumeration of the same task.
            let z = furthest(&task, &task, &settings);
            assert!(z < 6.0, "{name}, {kind}: z = {z}");
        }
    }
}

#[test]
fn four_strategies_hold_alike() {
    for (name, task, _) in locked() {
        for (kind, kernel) in kernels() {
            let settings = ChainSettings { seed: 4, kernel, ..ChainSettings::default() };
            let (difference, _) = compare(&task, &settings, 300, 30).expect("a chain");
            assert!(difference.is_none(), "{name}, {kind}: {}", difference.unwrap_or_default());
        }
    }
}

/// Held words, whose places depend on another choice, and which some lists of options lack.
#[test]
fn held_words_keep_their_names_where_their_places_change() {
    let task = |options: &str| {
        task(&format!(
            r#"(module (fn "m" (params) (set $b (sample (dist bernoulli 0.5)))
              (set $names (cond $b {options}))
              (set $w (sample (dist categorical (cond $b (list 1 2 3) (list 3 2 1))) $names))
              (set $x (index $names $w)) (do (factor (cond (eq $x "a") 0.3 0.0)))
              (return (tuple $b $x))) (entry "m"))"#
        ))
    };
    let lock = |task: &Task| hold(task, vec![("w".into(), Value::str("a"))]).expect("a lock");
    let (moved, lacking) =
        (r#"(list "a" "b" "c") (list "c" "b" "a")"#, r#"(list "a" "b" "c") (list "c" "b" "d")"#);
    let locked = lock(&task(moved));
    for (kind, kernel) in kernels() {
        let settings = ChainSettings { seed: 4, kernel, ..ChainSettings::default() };
        let (difference, _) = compare(&locked, &settings, 100, 30).expect("a chain");
        assert!(difference.is_none(), "{kind}: {}", difference.unwrap_or_default());
        let mut chain: Chain = Chain::start(&locked, &settings, 0, None).expect("a chain");
        for _ in 0..20 {
            chain.advance(&locked, 2, &mut |_, _| true).expect("a run");
            let value = repr(&chain.now(&locked.program).value).expect("a value");
            assert!(["(True, 'a')", "(False, 'a')"].contains(&value.as_str()), "{kind}: {value}");
        }
    }
    // A run without the option is invalid, and the others have the whole probability.
    let some = enumerate(&lock(&task(lacking)), 100, &mut |_| true).expect("runs with the word");
    let values: Vec<String> = some.outcomes.iter().map(|(value, _)| repr(value).expect("a value")).collect();
    assert_eq!(values, ["(True, 'a')"]);
    // Equal strings are no words.
    let double = task(r#"(list "a" "b" "a") (list "a" "a" "a")"#);
    let fault = enumerate(&lock(&double), 100, &mut |_| true).err().expect("no words").to_string();
    assert!(fault.contains("the choice `w` does not draw words"), "{fault}");
}

/// The values that a run has, by readable address.
fn values(task: &Task, run: &Run) -> HashMap<String, Value> {
    let trace =
        replay(task, Source::Addresses(by_address(&run.log.entries())), Missing::Refuse).expect("a run");
    assert!(run.cause.is_some() || (trace.run.log_score - run.log_score).abs() < 1e-9);
    trace.choices.into_iter().map(|choice| (choice.path, choice.value)).collect()
}

#[test]
fn held_values_are_in_every_run_to_the_bit() {
    let text = r#"(module (fn "leg" (params $i) (set $long (sample (dist gaussian 1.0 0.3)))
          (if (sample (dist bernoulli 0.5)) (then (set $foot (sample (dist uniform 0.0 $long))) (return $foot)))
          (return $long))
        (fn "m" (params) (set $n (sample (dist discrete_uniform 1 3))) (set $all 0.0)
          (for $i (range $n) (body (set $all (add $all (call "leg" $i))))) (do (factor $all)) (return $all)) (entry "m"))"#;
    let task = task(text);
    let free: Chain = Chain::start(&task, &ChainSettings::default(), 0, None).expect("a chain");
    let paths: Vec<String> =
        free.state.trace.numbers().map(|n| free.state.trace.path(&task.program, n)).collect();
    let long = paths.iter().find(|path| path.ends_with("long")).expect("a leg").replacen("[0]", "[1]", 1);
    let foot = long.replace("long", "foot");
    let held = vec![(long, Value::Real(0.9)), (foot, Value::Real(0.1 + 0.2))];
    let locked = hold(&task, held.clone()).expect("a lock");
    let has = |run: &Run| {
        let values = values(&locked, run);
        held.iter().all(|(path, value)| values.get(path).is_some_and(|actual| identical(actual, value)))
    };
    let result = smc(&locked, &Settings::default(), &mut |_| true).expect("particles");
    let mut alive = result.particles.into_iter().filter(|p| p.log_weight > f64::NEG_INFINITY);
    assert!(alive.all(|run| has(&run)));
    for (kind, kernel) in kernels() {
        let settings = ChainSettings { kernel, ..ChainSettings::default() };
        let mut chain: Chain = Chain::start(&locked, &settings, 0, None).expect("a chain");
        for _ in 0..50 {
            chain.advance(&locked, 4, &mut |_, _| true).expect("a run");
            assert!(has(&chain.now(&task.program)), "{kind}");
        }
    }
}

#[test]
fn impossible_locks_are_named() {
    let task = task(CLOSURES);
    let fault = hold(&task, vec![("d".into(), Value::Bool(true))]).err().expect("no such choice");
    assert_eq!(fault.code, "no-address");
    // `y` belongs to the function that `c` does not choose.
    let runs = listed(&task);
    let y =
        runs.iter().flat_map(|run| &run.0).find(|(path, _)| path.ends_with("/y")).expect("a choice").clone();
    let none = hold(&task, vec![("c".into(), Value::Bool(true)), y.clone()]).expect("addresses that exist");
    let named = |failure: Option<Failure>| {
        let text = failure.expect("a failure").to_string();
        assert!(text.contains(&format!("the held choice `{}`: the run did not make it", y.0)), "{text}");
    };
    named(enumerate(&none, 10_000, &mut |_| true).err());
    named(smc(&none, &Settings::default(), &mut |_| true).err());
    named(importance(&none, None, 50, 1, &mut |_| true).err());
    named(Chain::start(&none, &ChainSettings::default(), 0, None).err());
    // A value outside of the support.
    let odd = hold(&task, vec![(y.0.replace("/y", "/x"), Value::Int(7))]).expect("addresses that exist");
    let text = enumerate(&odd, 10_000, &mut |_| true).err().expect("a failure").to_string();
    assert!(text.contains("outside of its support"), "{text}");
}

/// The law of the values given the choices outside of a part, from runs with equal choices outside.
fn given_the_rest(runs: &[Listed], choices: &[(String, Value)], part: &str) -> HashMap<String, f64> {
    let is_outside = |(path, _): &&(String, Value)| !path.starts_with(&format!("{part}/"));
    let outside: Vec<_> = choices.iter().filter(is_outside).cloned().collect();
    let same_number = |run: &&Listed| run.0.iter().filter(is_outside).count() == outside.len();
    conditioned(&runs.iter().filter(same_number).cloned().collect::<Vec<_>>(), &outside)
}

/// A part whose shape is free, with a held choice that only one of its shapes has: no particle loses it. The value of the
/// part may distinguish its shapes.
#[test]
fn a_part_grown_afresh_keeps_held_choices() {
    const PARTICLES: usize = 3000;
    for returned in ["$r", "0"] {
        let text = r#"(module
            (fn "leg" (params $p) (set $long (sample (dist bernoulli $p))) (set $r 0)
              (if $long (then (set $foot (sample (dist categorical (list 0.2 0.3 0.5))))
                (set $toe (sample (dist bernoulli 0.4))) (set $r (add 1 (add (mul 2 $foot) (cond $toe 10 0))))))
              (do (factor (cond (gt $r 4) -0.7 0.1))) (return RETURNED))
            (fn "m" (params) (set $a (call "leg" 0.5)) (set $b (call "leg" 0.3)) (return (add (mul 100 $a) $b)))
            (entry "m"))"#;
        let free = task(&text.replace("RETURNED", returned));
        let runs = listed(&free);
        let has_feet = |run: &&Listed| run.0.iter().filter(|(path, _)| path.ends_with("/foot")).count() == 2;
        let (choices, ..) = runs.iter().find(has_feet).expect("a run with both feet");
        let foot = choices.iter().find(|(path, _)| path.ends_with("/foot")).expect("a foot").clone();
        let part = foot.0.rsplit_once('/').expect("a leg").0;
        let paths: HashMap<String, Value> = choices.iter().cloned().collect();
        let locked = hold(&free, vec![foot.clone()]).expect("a lock");
        let known = replay(&locked, Source::Paths(&paths), Missing::Refuse).expect("a run").choices;
        let known = known.into_iter().map(|choice| (choice.address, choice.value)).collect();
        let with = Afresh { part, particles: PARTICLES, power: 1.0, seed: 9 };
        let grown = afresh(&locked, &known, &with).expect("runs with the foot");
        assert!(grown.iter().all(|run| equal(&values(&locked, run)[&foot.0], &foot.1)));
        let has_foot = |run: &&Listed| run.0.iter().any(|(path, v)| *path == foot.0 && equal(v, &foot.1));
        let with_foot: Vec<_> = runs.iter().filter(has_foot).cloned().collect();
        let exact = given_the_rest(&with_foot, choices, part);
        let all = weighed(grown.iter().map(|run| (&run.value, run.log_weight)));
        let total: f64 = all.iter().map(|(_, weight)| weight).sum();
        assert!(all.iter().all(|(value, _)| exact.contains_key(value)));
        let log_evidence = log_sum_exp(exact.values().copied());
        for (value, log) in &exact {
            let p = (log - log_evidence).exp();
            let weight_of_value: f64 = all.iter().filter(|(v, _)| v == value).map(|(_, weight)| weight).sum();
            let error = (p * (1.0 - p) / (PARTICLES as f64 / 3.0)).sqrt().max(1e-9);
            assert!(
                ((weight_of_value / total - p) / error).abs() < 6.0,
                "{value}: {} for {p}",
                weight_of_value / total
            );
        }
    }
}

/// Shares of weighted particles vary as those of a third as many independent draws or less; some 150 are looked at.
#[test]
fn a_part_grown_afresh_follows_the_law_given_the_rest() {
    const PARTICLES: usize = 3000;
    let mut looked = 0;
    for (name, text) in programs() {
        let task = task(text);
        let runs = listed(&task);
        for number in 0..3 {
            let (choices, ..) = &runs[(number * 7919 + 31) % runs.len()];
            let paths: HashMap<String, Value> = choices.iter().cloned().collect();
            let known = replay(&task, Source::Paths(&paths), Missing::Refuse).expect("a run").choices;
            let known = known.into_iter().map(|choice| (choice.address, choice.value)).collect();
            let mut parts: Vec<&str> = choices.iter().filter_map(|c| Some(c.0.rsplit_once('/')?.0)).collect();
            parts.sort_unstable();
            parts.dedup();
            for part in parts.into_iter().take(4) {
                let exact = given_the_rest(&runs, choices, part);
                let with = Afresh { part, particles: PARTICLES, power: 1.0, seed: 9 };
                // A name without a stroke is that of any call with this last component.
                let Ok(grown) = afresh(&task, &known, &with) else { continue };
                let log_evidence = log_sum_exp(exact.values().copied());
                let all = weighed(grown.iter().map(|run| (&run.value, run.log_weight)));
                let total: f64 = all.iter().map(|(_, weight)| weight).sum();
                for (value, log) in &exact {
                    let p = (log - log_evidence).exp();
                    let weight_of_value: f64 =
                        all.iter().filter(|(v, _)| v == value).map(|(_, weight)| weight).sum();
                    let error = (p * (1.0 - p) / (PARTICLES as f64 / 3.0)).sqrt().max(1e-9);
                    let z = (weight_of_value / total - p) / error;
                    looked += usize::from(p < 1.0 - 1e-9);
                    assert!(z.abs() < 6.0, "{name}, {part} of {choices:?}: {value} has z = {z}");
                }
                assert!(all.iter().all(|(value, _)| exact.contains_key(value)), "{name}, {part}");
            }
        }
    }
    assert!(looked > 50, "{looked} shares only");
}

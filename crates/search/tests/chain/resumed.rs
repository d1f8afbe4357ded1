//! A chain that is stored and restored in another process continues as if it had not ended. Its data at the end is
//! the same text, so choices and their numbers, scores, samples, the best state, learnt scales and counts are equal to the
//! bit. For every kernel, ladders and trajectories, after any number of proposals, on
//! programs that create and remove choices.

use super::mixed::{BRANCHES, MIXTURE, hmc, nuts};
use super::programs::{PROGRAMS, task};
use super::stopped::stopped;
use super::{kernels, settings};
use niwaki_chain::Settings;
use niwaki_chain::kernel::Kernel;
use niwaki_chain::many::Chains;
use niwaki_geom::{Aabb, no_overshoot, vec3};
use niwaki_run::Task;
use niwaki_run::checkpoint::Checkpoint;
use niwaki_search::method::Info;
use std::collections::HashMap;

const STEPS: u64 = 240;

/// Makes proposals, from stored data if there is some, and stores the chain.
fn proposed(
    task: &Task,
    settings: &Settings,
    left: HashMap<u64, String>,
    steps: u64,
) -> HashMap<u64, String> {
    let task = task.uncounted();
    let checkpoint = Checkpoint::of(left);
    let mut chains: Chains =
        Chains::start_from(&task, settings, 1, None, Some(&checkpoint)).expect("a chain");
    chains.aim(steps);
    chains.go_on(&task, &|_, _| true, Some(&checkpoint)).expect("proposals");
    checkpoint.collect().0
}

/// The data at the end, of a whole chain and of one in pieces. Graphs are recorded again in each piece, which is counted.
fn ends(task: &Task, settings: &Settings, pieces: &[u64]) -> [String; 2] {
    let whole = proposed(task, settings, HashMap::new(), STEPS);
    let mut left = HashMap::new();
    for steps in pieces {
        left = proposed(task, settings, left, *steps);
    }
    [whole, left].map(|mut parts| {
        let text = parts.remove(&0).expect("the chain");
        let mut data: serde_json::Value = serde_json::from_str(&text).expect("data");
        for rung in data["rungs"].as_array_mut().expect("rungs") {
            for learnt in rung["plan"]["learnt"].as_array_mut().expect("leaves") {
                if let Some(travels) = learnt.get_mut("Travels") {
                    travels["recorded"] = serde_json::Value::Null;
                }
            }
        }
        data.to_string()
    })
}

/// Pieces of 1 to 90 proposals.
const PIECES: [u64; 7] = [1, 7, 30, 2, 90, 47, 63];

fn settings_of(kernel: Kernel) -> Settings {
    Settings { kernel, warmup: 120, thin: 7, ..settings() }
}

#[test]
fn chains_go_on_with_the_same_bits() {
    assert_eq!(PIECES.iter().sum::<u64>(), STEPS);
    for (name, text) in PROGRAMS {
        let task = task(text);
        for (kind, kernel) in kernels(&task) {
            let [whole, pieces] = ends(&task, &settings_of(kernel), &PIECES);
            assert!(whole == pieces, "{name}, {kind}:\n{whole}\n{pieces}");
        }
    }
}

#[test]
fn ladders_go_on_with_the_same_bits() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        for (kind, kernel) in kernels(&task) {
            if matches!(kind, "drift" | "all" | "annealed" | "weights by depth") {
                let settings = Settings { powers: vec![1.0, 0.3, 0.0], every: 4, ..settings_of(kernel) };
                let [whole, pieces] = ends(&task, &settings, &PIECES);
                assert!(whole == pieces, "{name}, {kind}:\n{whole}\n{pieces}");
            }
        }
    }
}

#[test]
fn trajectories_go_on_with_the_same_bits() {
    for (name, text) in [("a mixture", MIXTURE), ("branches", BRANCHES)] {
        let (task, ..) = super::calibration::both(text, 1.0);
        for (kind, leaf) in [("hmc", hmc(0.4)), ("nuts", nuts(0.4))] {
            let settings = settings_of(Kernel::Cycle(vec![leaf, Kernel::PRIOR]));
            let [whole, pieces] = ends(&task, &settings, &PIECES);
            assert!(whole == pieces, "{name}, {kind}:\n{whole}\n{pieces}");
            assert!(whole.contains("Travels"));
        }
    }
}

/// The report of an `improve` and its best choices; it is stopped after `looks` looks, and stored in each round.
fn improved(task: &Task, left: HashMap<u64, String>, looks: u64) -> (Option<String>, HashMap<u64, String>) {
    let method = r#"{"method": "improve", "particles": 20, "regrow": 5, "power": 4.0, "rounds": 12,
                     "seconds": null, "effort": 1.0, "diverse": null, "proposal": null}"#;
    let (result, stored) = stopped(task, method, left, looks);
    let Info::Improved(info) = result.info else { panic!("of improve") };
    let rounds: Vec<_> =
        info.rounds.iter().map(|round| (round.step, round.work, round.parts, round.best)).collect();
    let report = format!("{rounds:?} {:?} {:?}", result.runs[0].log, result.runs[0].value);
    ((!result.interrupted).then_some(report), stored)
}

#[test]
fn improve_goes_on_with_the_same_bits() {
    for (_, text) in PROGRAMS.iter().filter(|(name, _)| name.contains("shapes")) {
        let domain = Aabb { low: vec3(-0.3, -0.5, -0.3), high: vec3(0.3, 0.5, 0.3) };
        let sketches = vec![no_overshoot(domain, 2.0).expect("a sketch")];
        let task = Task { sketches, ..task(text) };
        let (whole, _) = improved(&task, HashMap::new(), u64::MAX);
        let (mut left, mut stops, mut report) = (HashMap::new(), 0, None);
        while report.is_none() {
            let (ended, stored) = improved(&task, left.clone(), 8 * (1 + stops));
            report = ended;
            // A part that was not stored again keeps its earlier data.
            left.extend(stored);
            stops += 1;
        }
        assert!(stops > 2, "{stops} pieces");
        assert_eq!(whole, report);
    }
}

/// Data of another chain is refused, without any effect.
#[test]
fn the_data_of_another_chain_is_refused() {
    let (first, other) = (task(PROGRAMS[0].1), task(PROGRAMS[1].1));
    let left = proposed(&first, &settings_of(Kernel::PRIOR), HashMap::new(), 30);
    let refused = |task: &Task, settings: &Settings| {
        let checkpoint = Checkpoint::of(left.clone());
        Chains::start_from(task, settings, 1, None, Some(&checkpoint)).is_err()
    };
    assert!(!refused(&first, &settings_of(Kernel::PRIOR)));
    assert!(refused(&other, &settings_of(Kernel::PRIOR)));
    assert!(refused(&first, &settings_of(Kernel::Cycle(vec![Kernel::PRIOR, Kernel::PRIOR]))));
    assert!(refused(&first, &Settings { powers: vec![1.0, 0.5], ..settings_of(Kernel::PRIOR) }));
}

//! For every kernel the four strategies give equal chains to the bit, a rollback leaves nothing behind, and
//! the sums equal those of a run from the start; on programs that create, remove and re-enter calls in every combination.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

mod board;
mod calibration;
mod held;
mod invalid;
mod mixed;
mod programs;
mod regrown;
mod resumed;
mod scoped;
#[path = "../support/stopped.rs"]
mod stopped;

use niwaki_agreement::compare;
use niwaki_chain::kernel::Kernel;
use niwaki_chain::ladder::Ladder;
use niwaki_chain::leaf::Proposer;
use niwaki_chain::{Chain, Settings};
use niwaki_geom::{Aabb, no_overshoot, vec3};
use niwaki_propose::user::User;
use niwaki_run::Task;
use niwaki_run::select::Selection;
use niwaki_vm::machine::kept::inspect::Item;
use niwaki_vm::value::Value;
use programs::{PROGRAMS, leaf, task};
use serde_json::json;
use std::sync::Arc;

/// A kernel of every kind that suits the program, and all of them together.
fn kernels(task: &Task) -> Vec<(&'static str, Kernel)> {
    let drift = || leaf("drift", json!({"step": 0.7, "target": 0.44}));
    let neighbour = || leaf("neighbour", json!({"reach": 2}));
    let block = || leaf("block", json!({"step": 0.3, "share": 0.4, "target": 0.23}));
    let regenerate = |levels| leaf("regenerate", json!({"levels": levels}));
    let regrow = |turn, pick| leaf("regrow", json!({"particles": 4, "turn": turn, "pick": pick}));
    let deep = Selection { depth: vec![1.0, 3.0, 0.5], ..Selection::default() };
    let first = choices(task).swap_remove(0).0;
    let by_site = Selection { weights: vec![(first, 3.0)], ..Selection::default() };
    let mut parts = vec![
        Kernel::PRIOR,
        Kernel::Repeat(2, Box::new(drift())),
        Kernel::Mixture(vec![(1.0, neighbour()), (2.0, block())]),
        regenerate(0),
        Kernel::On(deep.clone(), Box::new(Kernel::PRIOR)),
    ];
    let mut regrown = vec![];
    // The parts of a run share its memoised calls.
    if !task.program.memoises() {
        parts.push(regrow(0.5, "size"));
        regrown = vec![("regrow", regrow(0.3, "size")), ("regrow by choice", regrow(1.0, "choice"))];
    }
    let all = Kernel::Cycle(parts);
    let mut kernels = vec![
        ("prior", Kernel::PRIOR),
        ("drift", drift()),
        ("neighbour", neighbour()),
        ("block", block()),
        ("regenerate 0", regenerate(0)),
        ("regenerate 2", regenerate(2)),
        ("weights by depth", Kernel::On(deep, Box::new(Kernel::Cycle(vec![Kernel::PRIOR, regenerate(1)])))),
        ("weights by site", Kernel::On(by_site, Box::new(Kernel::PRIOR))),
        ("own proposals", own_proposals(task)),
        ("annealed", Kernel::Anneal { start: 0.25, end: 2.0, steps: 200, kernel: Box::new(all.clone()) }),
        ("all", all),
    ];
    kernels.extend(regrown);
    kernels
}

/// Choices of a first state: the last part of the address, and the value.
fn choices(task: &Task) -> Vec<(String, Value)> {
    let chain: Chain = Chain::start(task, &settings(), 0, None).expect("a chain");
    let mut choices = vec![];
    chain.state.trace.visit(&task.program, |place, item| {
        if let Item::Choice(value, _) = item {
            choices.push((place.path().rsplit('/').next().expect("a part").to_string(), value.clone()));
        }
    });
    choices
}

/// A user's proposals for the kinds of choices in a first state: real numbers, whole numbers, booleans.
fn own_proposals(task: &Task) -> Kernel {
    let mut sites: [Vec<String>; 3] = Default::default();
    for (site, value) in choices(task) {
        match value {
            Value::Real(_) => sites[0].push(site),
            Value::Int(_) => sites[1].push(site),
            Value::Bool(_) => sites[2].push(site),
            _ => {}
        }
    }
    let dists = [
        "gaussian (mul 0.5 $old) 0.8",
        "poisson (add 0.5 (mul 0.5 (mul $old $old)))",
        "bernoulli (cond $old 0.3 0.8)",
    ];
    let proposals =
        sites.into_iter().zip(dists).filter(|(sites, _)| !sites.is_empty()).map(|(sites, dist)| {
            let text = format!(r#"(module (fn "near" (params $old) (return (dist {dist}))) (entry "near"))"#);
            let user = Kernel::Leaf(Proposer::Proposal(Arc::new(
                User::new(programs::task(&text)).expect("a proposal"),
            )));
            Kernel::On(Selection { sites: vec![sites], ..Selection::default() }, Box::new(user))
        });
    Kernel::Cycle(std::iter::once(Kernel::PRIOR).chain(proposals).collect())
}

#[test]
fn four_strategies_make_the_same_chain() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        for (kind, kernel) in kernels(&task) {
            let settings = Settings { kernel, warmup: 150, ..settings() };
            let (difference, compared) = compare(&task, &settings, 300, 30).expect("a chain");
            assert!(difference.is_none(), "{name}, {kind}: {}", difference.unwrap_or_default());
            assert!(compared.accepted > 0, "{name}, {kind}: nothing was accepted");
        }
    }
}

#[test]
fn four_strategies_make_the_same_ladder() {
    let mut exchanges = 0;
    for (name, text) in PROGRAMS {
        let task = task(text);
        for (kind, kernel) in kernels(&task) {
            if matches!(kind, "drift" | "all" | "weights by depth" | "own proposals") {
                let powers = vec![1.0, 0.3, 0.0];
                let settings = Settings { seed: 6, kernel, powers, every: 4, ..settings() };
                let (difference, compared) = compare(&task, &settings, 120, 30).expect("a ladder");
                assert!(difference.is_none(), "{name}, {kind}: {}", difference.unwrap_or_default());
                exchanges += compared.exchanges;
            }
        }
    }
    assert!(exchanges > 1000, "{exchanges} exchanges only");
}

/// A scene is scored as it is: with every kernel, the sketches follow moves that are kept and moves that are undone.
#[test]
fn four_strategies_score_the_same_scene() {
    let (_, text) = PROGRAMS.iter().find(|(name, _)| *name == "futures and shapes").expect("a program");
    let domain = Aabb { low: vec3(-0.3, -0.5, -0.3), high: vec3(0.3, 0.5, 0.3) };
    let sketches = vec![no_overshoot(domain, 2.0).expect("a sketch")];
    let task = Task { sketches, ..task(text) };
    for (kind, kernel) in kernels(&task) {
        let settings = Settings { kernel, ..settings() };
        let (difference, compared) = compare(&task, &settings, 300, 30).expect("a chain");
        assert!(difference.is_none(), "{kind}: {}", difference.unwrap_or_default());
        assert!(0 < compared.accepted && compared.accepted < 300, "{kind}: {compared:?}");
    }
}

fn settings() -> Settings {
    Settings { seed: 5, thin: 0, ..Settings::default() }
}

#[test]
fn rungs_of_a_ladder_draw_numbers_of_their_own() {
    let differ = |text: &str| {
        let task = task(text);
        // Equal powers and no exchange: with shared streams both chains would be the same.
        let settings = Settings { powers: vec![1.0, 1.0], every: 1000, ..settings() };
        let mut ladder: Ladder = Ladder::start(&task, &settings, 0, None).expect("a ladder");
        ladder.advance(&task, 100, &mut |_, _| true).expect("proposals");
        let [first, second] = [0, 1].map(|rung| format!("{:?}", ladder.rungs[rung].state.trace.result()));
        first != second
    };
    let count = PROGRAMS.iter().filter(|(_, text)| differ(text)).count();
    assert!(2 * count > PROGRAMS.len(), "in {count} of {} programs", PROGRAMS.len());
}

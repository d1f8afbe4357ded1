//! Chains: of whole runs that guided populations propose, and of single choices and parts that a guide draws.
//!
//! Exact draws from the posterior make a few moves each; the results are independent exact draws again, whatever the kernel's
//! mixing.

use super::guides::{MILD, WILD, random};
use super::law::Law;
use super::on_one_thread;
use super::populations::by;
use super::programs::{PROGRAMS, page, task};
use niwaki_agreement::repetitions;
use niwaki_chain::form::{Attached, Form};
use niwaki_chain::kernel::Kernel;
use niwaki_chain::{Chain, Settings};
use niwaki_particles::{Ancestors, particle_gibbs, pimh};
use niwaki_run::Task;
use niwaki_run::forward::forward;
use niwaki_run::log::Entry;
use niwaki_run::order::{Order, Policy};
use niwaki_run::rejection::rejection;
use niwaki_run::replay::by_address;
use niwaki_run::resampling::Resampling;
use niwaki_run::select::Selection;
use niwaki_search::method::{Inputs, Method};
use niwaki_vm::value::repr;
use serde_json::json;
use std::sync::Arc;

/// [`repetitions`] of exact draws from the posterior.
fn draws(task: &Task, count: u64) -> Vec<Vec<Entry>> {
    let scores = (0..2000).map(|stream| forward(task, 2, stream, false).expect("a run").log_score);
    let bound = scores.fold(f64::NEG_INFINITY, f64::max) + 0.5;
    let accepted =
        rejection(task, repetitions(count) as usize, bound, u64::MAX, 1, &mut |_| true).expect("draws");
    accepted.runs.iter().map(|run| run.log.entries()).collect()
}

/// The values after `moves` moves from each start.
fn moved(task: &Task, kernel: &Kernel, starts: &[Vec<Entry>], moves: u64) -> Vec<String> {
    let after = |(number, start): (u64, &Vec<Entry>)| {
        let settings = Settings { seed: 8, kernel: kernel.clone(), thin: 0, ..Settings::default() };
        let mut chain: Chain =
            Chain::start(task, &settings, number, Some(&by_address(start))).expect("a chain");
        chain.advance(task, moves, &mut |_, _| true).expect("a run");
        repr(&chain.state.trace.result()).expect("a value")
    };
    (0..).zip(starts).map(after).collect()
}

fn regrow(particles: usize, turn: f64) -> Kernel {
    Kernel::leaf("regrow", json!({"particles": particles, "turn": turn, "pick": "size"})).expect("a kernel")
}

fn on(pattern: &str, kernel: Kernel) -> Kernel {
    Kernel::On(Selection { sites: vec![vec![pattern.into()]], ..Selection::default() }, Box::new(kernel))
}

#[test]
fn guided_proposals_keep_the_posterior() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let (law, starts) = (Law::of(&task), draws(&task, 6000));
        let guided = |number| Kernel::guided(random(&task, number, WILD));
        let deep = Selection { depth: vec![1.0, 3.0, 0.5], ..Selection::default() };
        for (kind, kernel, moves) in [
            ("alone", guided(1), 5),
            ("alone, another", guided(2), 2),
            ("a mixture", Kernel::Mixture(vec![(2.0, guided(3)), (1.0, Kernel::PRIOR)]), 5),
            ("a cycle", Kernel::Cycle(vec![guided(1), on("**", guided(4))]), 4),
            ("weights by depth", Kernel::On(deep, Box::new(guided(2))), 5),
        ] {
            let far = law.wrong_counts(&moved(&task, &kernel, &starts, moves));
            assert!(far.is_empty(), "{name}, {kind}: {far:?}");
        }
    }
}

#[test]
fn guided_regrowth_keeps_the_posterior() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let (law, starts) = (Law::of(&task), draws(&task, 4000));
        for (number, particles, turn) in [(1, 2, 0.0), (2, 4, 0.5)] {
            let kernel = regrow(particles, turn).drawn_by(by(&task, number, WILD));
            let far = law.wrong_counts(&moved(&task, &kernel, &starts, 7));
            assert!(far.is_empty(), "{name}, {particles} particles: {far:?}");
        }
    }
}

/// The discs of the part are compared with the place of the third disc, which moves with the value of the part.
#[test]
fn regrowth_without_a_guide_keeps_the_posterior_of_parts_that_move_others() {
    let text = r#"(module (fn "pick" (params)
        (set $k (sample (dist categorical (list 0.3 0.25 0.25 0.2))))
        (do (emit (disc (tuple (sub (mul 1.2 $k) 1.8) 1.6 0.0) 0.9)))
        (set $b (sample (dist bernoulli 0.5)))
        (do (emit (disc (tuple (cond $b 1.8 -1.8) -2.2 0.0) 0.7)))
        (return $k))
      (fn "m" (params)
        (set $k (call "pick"))
        (do (emit (disc (tuple (sub (mul 1.2 $k) 1.8) 0.2 0.0) 1.2)))
        (return $k)) (entry "m"))"#;
    let task = Task { sketches: vec![page(0.15)], ..task(text) };
    let (law, starts) = (Law::of(&task), draws(&task, 12_000));
    for particles in [2, 4, 8] {
        let settings = json!({"particles": particles, "turn": 0.0, "pick": {"parts": ["pick"]}});
        let kernel = Kernel::leaf("regrow", settings).expect("a kernel");
        let far = law.wrong_counts(&moved(&task, &kernel, &starts, 6));
        assert!(far.is_empty(), "{particles} particles: {far:?}");
    }
}

fn settings(
    task: &Task,
    number: u64,
    spread: f64,
    particles: usize,
    order: Order,
) -> niwaki_particles::Settings {
    let proposal = Some(by(task, number, spread));
    niwaki_particles::Settings { particles, order, proposal, ..niwaki_particles::Settings::default() }
}

/// An order that is far from uniform. The held run is ordered anew in each sweep, and a guide sees another scene at the same
/// choice in another order.
fn learned() -> Order {
    Order::Learned(Arc::new(Policy { depth: 0.5, turns: -1.0, waited: -0.7, stay: 1.2, ..Policy::default() }))
}

#[test]
fn guided_sweeps_keep_the_posterior() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let (law, starts) = (Law::of(&task), draws(&task, 4000));
        let orders = if text.contains("future") {
            vec![Order::DepthFirst, learned(), Order::Stochastic]
        } else {
            vec![Order::Stochastic]
        };
        for order in orders {
            for (number, ancestors, resampling) in [
                (1, Ancestors::Kept, Resampling::Multinomial),
                (2, Ancestors::Sampled, Resampling::Multinomial),
                (1, Ancestors::Sampled, Resampling::Tempered),
            ] {
                let base = niwaki_particles::Settings {
                    resampling,
                    ..settings(&task, number, WILD, 3, order.clone())
                };
                let after = |(seed, start): (u64, &Vec<Entry>)| {
                    let base = niwaki_particles::Settings { seed, ..base.clone() };
                    let chain = particle_gibbs(&task, &base, ancestors, 2, Some(start), &mut |_| true);
                    repr(&chain.expect("a chain").states.last().expect("a state").value).expect("a value")
                };
                let values: Vec<String> = on_one_thread(|| (0..).zip(&starts).map(after).collect());
                let far = law.wrong_counts(&values);
                assert!(far.is_empty(), "{name}, {order:?}, {ancestors:?}: {far:?}");
            }
        }
    }
}

/// Populations that are accepted by their estimates have no exact start: forty of them.
#[test]
fn guided_populations_keep_the_posterior() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let base = settings(&task, 1, MILD, 4, Order::Stochastic);
        let last =
            |seed| match pimh(&task, &niwaki_particles::Settings { seed, ..base.clone() }, 40, &mut |_| true)
            {
                Ok(chain) => Some(repr(&chain.states.last().expect("a state").value).expect("a value")),
                Err(failure) if failure.is_impossible() => None,
                Err(other) => panic!("{other}"),
            };
        let values: Vec<String> = on_one_thread(|| (0..600).filter_map(last).collect());
        let far = Law::of(&task).wrong_counts(&values);
        assert!(far.is_empty(), "{name}: {far:?}");
    }
}

/// A kernel as data names its guide by number.
#[test]
fn a_kernel_as_data_names_its_guide() {
    let task = task(PROGRAMS[0].1);
    let attached = [Attached::Guide(random(&task, 1, WILD))];
    let form = |text: &str| serde_json::from_str::<Form>(text).expect("a form");
    let plain = r#"{"name": "regrow", "settings": {"particles": 3, "turn": 0.5, "pick": "size"}}"#;
    let kernels = [
        form(r#"{"name": "guided", "function": 0}"#).kernel(&attached),
        form(&plain.replace("\"regrow\"", "\"regrow\", \"function\": 0")).kernel(&attached),
        form(plain).kernel(&attached),
    ];
    let starts = draws(&task, 40);
    let values = kernels.map(|kernel| moved(&task, &kernel.expect("a kernel"), &starts, 3));
    assert!(values[0] != values[1] && values[1] != values[2], "guides draw");
    for text in [r#"{"name": "guided", "function": 1}"#, r#"{"name": "prior", "function": 0}"#] {
        assert_eq!(form(text).kernel(&attached).expect_err("no guide there").code, "bad-kernel");
    }
}

/// A search for the best draws its populations and its parts by a guide, and finds the best possible run.
#[test]
fn a_guided_search_finds_the_best() {
    let task = task(PROGRAMS[0].1);
    let scores = (0..3000).map(|stream| forward(&task, 2, stream, false).expect("a run").log_score);
    let best = scores.fold(f64::NEG_INFINITY, f64::max);
    let attached = [Attached::Guide(random(&task, 1, WILD))];
    let search = |proposal: &str| {
        let text = format!(
            r#"{{"method": "improve", "particles": 8, "regrow": 3, "power": 16.0, "rounds": 30, "seconds": null,
                "effort": 1.0, "diverse": null, "proposal": {proposal}}}"#
        );
        let inputs = Inputs { seed: 4, attached: &attached, ..Inputs::default() };
        let results = Method::read(&text).expect("a method").search(&task, &inputs, &mut |_, _, _| true);
        results.expect("a search").runs.swap_remove(0)
    };
    let guided = search(r#"{"name": "guided", "function": 0}"#);
    assert!(guided.log_score >= best, "{} of {best}", guided.log_score);
    assert_eq!(search(r#"{"name": "guided", "function": 0}"#).log_prior, guided.log_prior);
}

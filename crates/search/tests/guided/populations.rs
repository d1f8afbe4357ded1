//! Populations and independent runs that a guide draws.

use super::guides::{MILD, random};
use super::law::Law;
use super::on_one_thread;
use super::programs::{PROGRAMS, task};
use niwaki_chain::kernel::Kernel;
use niwaki_particles::{Moment, Rejuvenation, Settings, When, smc};
use niwaki_propose::importance::importance;
use niwaki_propose::proposal::Proposal;
use niwaki_run::Task;
use niwaki_run::order::Order;
use niwaki_run::resampling::Resampling;
use niwaki_vm::value::repr;
use std::sync::Arc;

/// The proposal of a guide.
pub fn by(task: &Task, number: u64, spread: f64) -> Arc<Proposal> {
    Arc::new(Kernel::guided(random(task, number, spread)).proposal().expect("a proposal"))
}

/// The wrong estimates of populations with these settings.
fn wrong(task: &Task, law: &Law, settings: &Settings, seeds: u64) -> Vec<String> {
    let population = |seed| match smc(task, &Settings { seed, ..settings.clone() }, &mut |_| true) {
        Ok(run) => {
            let values = run.particles.iter().map(|p| (repr(&p.value).expect("a value"), p.log_weight));
            (run.log_evidence.expect("an estimate"), values.collect())
        }
        Err(failure) if failure.is_impossible() => (f64::NEG_INFINITY, vec![]),
        Err(other) => panic!("{other}"),
    };
    on_one_thread(|| law.wrong_estimates((0..seeds).map(population)))
}

/// Guides that change nothing would be no test: the weights of their runs must differ from those of the prior's runs.
#[test]
fn the_guides_are_far_from_the_prior() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let runs = importance(&task, Some(&by(&task, 1, MILD)), 2000, 1, &mut |_| true).expect("runs").runs;
        let ratios: Vec<f64> = runs.iter().map(|run| run.log_weight - run.log_score).collect();
        let mean = ratios.iter().sum::<f64>() / 2000.0;
        let deviation = (ratios.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 2000.0).sqrt();
        println!("{name}: mean {mean:.2}, deviation {deviation:.2}");
        assert!(deviation > 0.25, "{name}: {deviation}");
    }
}

#[test]
fn evidence_and_posterior_do_not_depend_on_the_guide() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let law = Law::of(&task);
        let futures = text.contains("future").then_some(Order::DepthFirst);
        for order in futures.into_iter().chain([Order::Stochastic]) {
            for (number, particles, resampling, seeds) in [
                (1, 1, Resampling::Systematic, 6000),
                (2, 4, Resampling::Systematic, 2500),
                (1, 7, Resampling::Tempered, 1500),
                (2, 100, Resampling::Tempered, 100),
            ] {
                let proposal = Some(by(&task, number, MILD));
                let order = order.clone();
                let base = Settings { particles, order, resampling, proposal, ..Settings::default() };
                let far = wrong(&task, &law, &base, seeds);
                assert!(far.is_empty(), "{name}, {:?}, {particles} particles: {far:?}", base.order);
            }
        }
    }
}

/// Weights that wait for a resampling, and particles that kernels move, some of them guides.
#[test]
fn other_settings_keep_evidence_and_posterior() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let law = Law::of(&task);
        let plain = Settings { particles: 5, proposal: Some(by(&task, 3, MILD)), ..Settings::default() };
        let kernel =
            Kernel::Mixture(vec![(1.0, Kernel::PRIOR), (1.0, Kernel::guided(random(&task, 4, MILD)))]);
        let moved = Rejuvenation { kernel, moves: 2, at: Moment::Every(1), final_chains: None };
        for variant in [
            Settings { when: When::EffectiveBelow(0.5), ..plain.clone() },
            Settings { rejuvenate: Some(moved), ..plain.clone() },
        ] {
            let far = wrong(&task, &law, &variant, 1200);
            assert!(far.is_empty(), "{name}: {far:?}");
        }
    }
}

/// Equal seeds give equal bits on any number of threads: a particle's draws depend on its inputs alone.
#[test]
fn threads_change_nothing() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let base =
            Settings { particles: 100, seed: 3, proposal: Some(by(&task, 1, MILD)), ..Settings::default() };
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| {
                smc(&task, &base, &mut |_| true).expect("a run").log_evidence.expect("an estimate").to_bits()
            })
        };
        assert_eq!([run(1), run(1)], [run(2), run(5)], "{name}");
    }
}

#[test]
fn importance_sampling_weighs_what_a_guide_draws() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let result = importance(&task, Some(&by(&task, 1, MILD)), 12_000, 3, &mut |_| true).expect("runs");
        let weighted_value =
            |run: &niwaki_run::run::Run| (run.log_weight, vec![(repr(&run.value).expect("a value"), 0.0)]);
        let far = Law::of(&task).wrong_estimates(result.runs.iter().map(weighted_value));
        assert!(far.is_empty(), "{name}: {far:?}");
    }
}

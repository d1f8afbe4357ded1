//! The claim: states of chains that start from particles drawn by weight follow the posterior, with the evidence as
//! unbiased as without them.
//!
//! As in the parent module: z-scores over 4,000 searches, here of 8 particles, against enumeration.

use super::rejuvenated::every_kind;
use super::*;
use niwaki_chain::kernel::Kernel;

fn following(kernel: Kernel, moves: u64, chains: usize, draws: usize, at: Moment) -> Settings {
    let final_chains = Some(FinalChains { chains, draws });
    Settings {
        rejuvenate: Some(Rejuvenation { kernel, moves, at, final_chains }),
        ..settings(Order::Stochastic, Resampling::Systematic)
    }
}

#[test]
fn states_of_final_chains_follow_the_posterior() {
    for (name, text) in PROGRAMS {
        for (chains, draws, at) in [(1, 5, Moment::End), (3, 2, Moment::Every(2))] {
            let settings = following(every_kind(), 2, chains, draws, at);
            let scores = z_scores(&task(text), &settings, 0..2000);
            assert!(worst(&scores) < LIMIT, "{name}, {chains} chains: {scores:?}");
        }
        // Weights that are not equal in the end decide where the chains start.
        let settings =
            Settings { when: When::EffectiveBelow(0.2), ..following(Kernel::PRIOR, 1, 2, 2, Moment::End) };
        let scores = z_scores(&task(text), &settings, 0..4000);
        assert!(worst(&scores) < LIMIT, "{name}, unequal weights: {scores:?}");
        let scores = z_scores(&task(text), &following(Kernel::PRIOR, 1, 1, 2, Moment::End), 0..4000);
        assert!(worst(&scores) < LIMIT, "{name}, one chain: {scores:?}");
    }
}

/// As many results as chains have states, each with the score of its choices, on any number of threads.
#[test]
fn threads_change_nothing_in_final_chains() {
    let task = task(PROGRAMS[5].1);
    let settings = Settings { particles: 100, seed: 5, ..following(every_kind(), 3, 4, 6, Moment::End) };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let run = smc(&task, &settings, &mut |_| true).unwrap();
            let values: Vec<String> = run.particles.iter().map(|p| repr(&p.value).unwrap()).collect();
            (run.log_evidence.unwrap().to_bits(), run.moved, values)
        })
    };
    let serial = run(1);
    assert_eq!((serial.2.len(), serial.1.ended.proposed), (24, 72));
    assert_eq!(serial, run(8));
}

#[test]
fn final_chains_end_where_whoever_watches_says() {
    let task = task(PROGRAMS[5].1);
    let settings = following(Kernel::PRIOR, 3, 2, 1000, Moment::End);
    let mut looks = 0;
    let run = smc(&task, &settings, &mut |_| {
        looks += 1;
        looks < 20
    });
    let run = run.unwrap();
    assert!(run.interrupted && run.particles.len() < 40 && run.particles.len() >= 2);
}

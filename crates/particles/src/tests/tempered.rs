//! The claim: resampling by tempered weights changes neither evidence nor posterior, in populations of any size, in
//! either order, whenever it happens and at whatever powers; particle Gibbs and PIMH keep the posterior with it.
//!
//! It differs from plain resampling only where weights are far apart. So the programs here have scores that differ by
//! several nats at a barrier, some of which a later barrier takes back. Limits are those of the parent module and of
//! `chains`; PIMH, which has no exact start, takes 50 sweeps of 16 particles, on two of the programs.

use super::*;
use niwaki_run::run::Run;

const REVERSED: &str = r#"(module (fn "m" (params)
            (set $a (sample (dist categorical (list 0.1 0.3 0.6))))
            (do (factor (mul 2.5 (sub 1 $a))))
            (set $b (sample (dist bernoulli (cond (eq $a 0) 0.2 0.7))))
            (do (factor (cond $b 1.0 -3.0)))
            (do (factor (mul 3.0 (sub $a 1))))
            (return (tuple $a $b))) (entry "m"))"#;

const KEPT_OR_LOST: &str = r#"(module (fn "arm" (params $p)
            (set $a (sample (dist bernoulli $p)))
            (do (factor (cond $a -3.0 -0.5)))
            (if $a (then (set $b (sample (dist discrete_uniform 0 1))) (do (factor (mul 2.5 $b))) (return $b)))
            (do (condition (sample (dist bernoulli 0.4))))
            (return 0))
            (fn "m" (params)
            (set $x (future "arm" 0.4)) (set $y (future "arm" 0.7))
            (return (tuple (force $x) (force $y)))) (entry "m"))"#;

fn sharp() -> [(&'static str, String); 4] {
    let (states, grow) = (PROGRAMS[1].1, PROGRAMS[3].1);
    [
        ("what looked best is worst in the end", REVERSED.into()),
        (
            "a chain of three states, seen clearly",
            states.replace("bernoulli 0.9", "bernoulli 0.97").replace("bernoulli 0.2", "bernoulli 0.03"),
        ),
        ("futures that are kept or lost, with a hard constraint", KEPT_OR_LOST.into()),
        (
            "a recursion whose end pays",
            grow.replace("factor -0.3", "factor -1.2").replace("mul 0.5", "mul 2.1"),
        ),
    ]
}

fn tempered(particles: usize, order: Order) -> Settings {
    Settings { particles, ..settings(order, Resampling::Tempered) }
}

#[test]
fn evidence_and_posterior_are_right_for_any_number_of_particles() {
    let low = When::EffectiveBelow(0.5);
    for (name, text) in sharp() {
        let task = task(&text);
        // Each order and each time to resample, with few particles and with many.
        for (particles, seeds, order, when) in [
            (2, 12_000, Order::DepthFirst, When::Always),
            (3, 12_000, Order::Stochastic, low),
            (8, 4000, Order::Stochastic, When::Always),
            (30, 1500, Order::DepthFirst, low),
            (100, 600, Order::Stochastic, When::Always),
        ] {
            let settings = Settings { when, ..tempered(particles, order.clone()) };
            let scores = z_scores(&task, &settings, 0..seeds);
            assert!(worst(&scores) < LIMIT, "{name}, {particles}, {order:?}, {when:?}: {scores:?}");
        }
    }
}

#[test]
fn a_schedule_of_powers_and_moves_leave_them_right() {
    for (name, text) in sharp() {
        let task = task(&text);
        for at in [None, Some(Moment::Every(1)), Some(Moment::End)] {
            let kernel = niwaki_chain::kernel::Kernel::PRIOR;
            let rejuvenate = at.map(|at| Rejuvenation { kernel, moves: 1, at, final_chains: None });
            let anneal = Anneal::Schedule([0.5, 1.4, 0.8].as_slice().into());
            let settings = Settings { anneal, rejuvenate, ..tempered(12, Order::Stochastic) };
            let scores = z_scores(&task, &settings, 0..3000);
            assert!(worst(&scores) < LIMIT, "{name}, {at:?}: {scores:?}");
        }
    }
}

#[test]
fn several_populations_are_right_too() {
    for (name, text) in sharp() {
        let task = task(&text);
        let settings = tempered(1, Order::Stochastic);
        let of = |seed| populations(&task, &Settings { seed, ..settings.clone() }, &[3, 9], &mut |_| true);
        let scores = z_scores_of(&task, &of, 0..4000);
        assert!(worst(&scores) < LIMIT, "{name}: {scores:?}");
    }
}

#[test]
fn particle_gibbs_keeps_the_posterior_by_tempered_weights() {
    let low = When::EffectiveBelow(0.5);
    for (name, text) in sharp() {
        let task = task(&text);
        let starts = exact_draws(&task, 5000);
        for (particles, order, when, ancestors) in [
            (2, Order::Stochastic, When::Always, Ancestors::Sampled),
            (4, Order::DepthFirst, low, Ancestors::Kept),
            (5, Order::Stochastic, low, Ancestors::Sampled),
            (6, Order::DepthFirst, When::Always, Ancestors::Sampled),
        ] {
            let settings = Settings { when, ..tempered(particles, order.clone()) };
            let scores = counted(&task, &values_after(&task, &starts, &settings, ancestors, 3));
            assert!(worst(&scores) < LIMIT, "{name}, {particles}, {order:?}, {ancestors:?}: {scores:?}");
        }
    }
}

#[test]
fn pimh_finds_the_posterior_by_tempered_weights() {
    for (name, text) in sharp().into_iter().step_by(2) {
        let task = task(&text);
        let last = |seed| {
            let settings = Settings { seed, ..tempered(16, Order::Stochastic) };
            match pimh(&task, &settings, 50, &mut |_| true) {
                Ok(chain) => Some(repr(&chain.states.last().unwrap().value).unwrap()),
                Err(failure) if failure.is_impossible() => None,
                Err(other) => panic!("{other}"),
            }
        };
        let values: Vec<String> = (0..repetitions(1200)).filter_map(last).collect();
        let scores = counted(&task, &values);
        assert!(worst(&scores) < LIMIT, "{name}: {scores:?}");
    }
}

/// Weights, evidence and choices; and they are not those of plain resampling.
#[test]
fn threads_change_nothing_by_tempered_weights() {
    for (_, text) in sharp() {
        let task = task(&text);
        let run = |threads: usize, resampling: Resampling| {
            let settings = Settings { seed: 5, resampling, ..tempered(100, Order::Stochastic) };
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let result = smc(&task, &settings, &mut |_| true).unwrap();
                let outcome = |p: &Run| (repr(&p.value).unwrap(), p.log_weight.to_bits());
                (
                    result.log_evidence.unwrap().to_bits(),
                    result.particles.iter().map(outcome).collect::<Vec<_>>(),
                )
            })
        };
        let serial = run(1, Resampling::Tempered);
        assert!(serial == run(2, Resampling::Tempered) && serial == run(8, Resampling::Tempered));
        assert!(serial != run(1, Resampling::Systematic));
    }
}

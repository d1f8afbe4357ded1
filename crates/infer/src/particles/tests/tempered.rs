//! The claim: resampling by tempered weights changes neither evidence nor posterior, in populations of any size, in
//! either order, whenever it happens and at whatever powers; particle Gibbs and PIMH keep the posterior with it.
//!
//! It differs from plain resampling only where weights are far apart. So the programs here have scores that differ by
//! several nats at a barrier, some of which a later barrier takes back. Limits are those of the parent module and of
//! `chains`; PIMH, which has no exact start, takes 50 sweeps of 16 particles.

use super::chains::{counted, values_after};
use super::*;

const SHARP: [(&str, &str); 4] = [
    (
        "what looked best is worst in the end",
        r#"(module (fn "m" (params)
            (set $a (sample (dist categorical (list 0.1 0.3 0.6))))
            (do (factor (mul 2.5 (sub 1 $a))))
            (set $b (sample (dist bernoulli (cond (eq $a 0) 0.2 0.7))))
            (do (factor (cond $b 1.0 -3.0)))
            (do (factor (mul 3.0 (sub $a 1))))
            (return (tuple $a $b))) (entry "m"))"#,
    ),
    (
        "a chain of three states, seen clearly",
        r#"(module (const 0 (list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4))
              (dist categorical (list 0.3 0.3 0.4))))
            (const 1 (list (dist bernoulli 0.95) (dist bernoulli 0.4) (dist bernoulli 0.03)))
            (fn "m" (params)
            (set $s 0)
            (for $i (range 4) (body
              (set $s (sample (index (data 0) $s)))
              (do (observe (index (data 1) $s) (eq (mod $i 2) 0)))))
            (return $s)) (entry "m"))"#,
    ),
    (
        "futures that are kept or lost, with a hard constraint",
        r#"(module (fn "arm" (params $p)
            (set $a (sample (dist bernoulli $p)))
            (do (factor (cond $a -3.0 -0.5)))
            (if $a (then (set $b (sample (dist discrete_uniform 0 1))) (do (factor (mul 2.5 $b))) (return $b)))
            (do (condition (sample (dist bernoulli 0.4))))
            (return 0))
            (fn "m" (params)
            (set $x (future "arm" 0.4)) (set $y (future "arm" 0.7))
            (return (tuple (force $x) (force $y)))) (entry "m"))"#,
    ),
    (
        "a recursion whose end pays",
        r#"(module (fn "grow" (params $d)
            (do (factor -1.2))
            (if (and (lt $d 3) (sample (dist bernoulli 0.5)))
              (then (return (add 1 (call "grow" (add $d 1))))) (else (return 0))))
            (fn "m" (params) (set $k (call "grow" 0)) (do (factor (mul 2.1 $k))) (return $k)) (entry "m"))"#,
    ),
];

fn tempered(particles: usize, order: Order) -> Settings {
    Settings { particles, ..settings(order, Resampling::Tempered) }
}

#[test]
fn evidence_and_posterior_are_right_for_any_number_of_particles() {
    for (name, text) in SHARP {
        let task = task(text);
        for (particles, seeds) in [(2, 12_000), (3, 12_000), (8, 4000), (30, 1500), (100, 600)] {
            for order in [Order::DepthFirst, Order::Stochastic] {
                for when in [When::Always, When::EffectiveBelow(0.5)] {
                    let own = Settings { when, ..tempered(particles, order) };
                    let scores = z_scores(&task, &own, 0..seeds);
                    assert!(worst(&scores) < LIMIT, "{name}, {particles}, {order:?}, {when:?}: {scores:?}");
                }
            }
        }
    }
}

#[test]
fn a_schedule_of_powers_and_moves_leave_them_right() {
    for (name, text) in SHARP {
        let task = task(text);
        for at in [None, Some(Moment::Every(1)), Some(Moment::End)] {
            let kernel = crate::chain::kernel::Kernel::PRIOR;
            let rejuvenate = at.map(|at| Rejuvenation { kernel, moves: 1, at, final_chains: None });
            let anneal = Anneal::Schedule([0.5, 1.4, 0.8].as_slice().into());
            let own = Settings { anneal, rejuvenate, ..tempered(12, Order::Stochastic) };
            let scores = z_scores(&task, &own, 0..3000);
            assert!(worst(&scores) < LIMIT, "{name}, {at:?}: {scores:?}");
        }
    }
}

#[test]
fn several_populations_are_right_too() {
    for (name, text) in SHARP {
        let task = task(text);
        let own = tempered(1, Order::Stochastic);
        let of = |seed| populations(&task, &Settings { seed, ..own.clone() }, &[3, 9], &mut |_| true);
        let scores = z_scores_of(&task, &of, 0..4000);
        assert!(worst(&scores) < LIMIT, "{name}: {scores:?}");
    }
}

#[test]
fn particle_gibbs_keeps_the_posterior_by_tempered_weights() {
    let low = When::EffectiveBelow(0.5);
    for (name, text) in SHARP {
        let task = task(text);
        for (particles, order, when, ancestors) in [
            (2, Order::Stochastic, When::Always, Ancestors::Sampled),
            (4, Order::DepthFirst, low, Ancestors::Kept),
            (5, Order::Stochastic, low, Ancestors::Sampled),
            (6, Order::DepthFirst, When::Always, Ancestors::Sampled),
        ] {
            let own = Settings { when, ..tempered(particles, order) };
            let scores = counted(&task, &values_after(&task, &own, ancestors, 5000, 3));
            assert!(worst(&scores) < LIMIT, "{name}, {particles}, {order:?}, {ancestors:?}: {scores:?}");
        }
    }
}

#[test]
fn pimh_finds_the_posterior_by_tempered_weights() {
    for (name, text) in SHARP {
        let task = task(text);
        let last = |seed| {
            let own = Settings { seed, ..tempered(16, Order::Stochastic) };
            match pimh(&task, &own, 50, &mut |_| true) {
                Ok(chain) => Some(repr(&chain.states.last().unwrap().value).unwrap()),
                Err(failure) if failure.is_impossible() => None,
                Err(other) => panic!("{other}"),
            }
        };
        let values: Vec<String> = (0..1200).filter_map(last).collect();
        let scores = counted(&task, &values);
        assert!(worst(&scores) < LIMIT, "{name}: {scores:?}");
    }
}

/// Weights, evidence and choices; and they are not those of plain resampling.
#[test]
fn threads_change_nothing_by_tempered_weights() {
    for (_, text) in SHARP {
        let task = task(text);
        let run = |threads: usize, resampling: Resampling| {
            let own = Settings { seed: 5, resampling, ..tempered(100, Order::Stochastic) };
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let found = smc(&task, &own, &mut |_| true).unwrap();
                let one = |p: &Outcome| (repr(&p.value).unwrap(), p.log_weight.to_bits());
                (found.log_evidence.unwrap().to_bits(), found.particles.iter().map(one).collect::<Vec<_>>())
            })
        };
        let serial = run(1, Resampling::Tempered);
        assert!(serial == run(2, Resampling::Tempered) && serial == run(8, Resampling::Tempered));
        assert!(serial != run(1, Resampling::Systematic));
    }
}

#[test]
fn absolute_weights_are_refused() {
    let own = Settings { weights: Weights::Absolute, ..tempered(4, Order::Stochastic) };
    let failure = smc(&task(PROGRAMS[0].1), &own, &mut |_| true).err().unwrap();
    assert!(failure.to_string().contains("absolute weights"), "{failure}");
}

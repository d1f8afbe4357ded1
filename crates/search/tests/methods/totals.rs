//! Totals are exact for terms of any size. The totals of a chain equal those of a run from the start with its
//! choices. Terms that cancel do not change a chain or particles.

use niwaki_agreement::compare;
use niwaki_chain::kernel::Kernel;
use niwaki_chain::ladder::Ladder;
use niwaki_chain::many::Chains;
use niwaki_chain::{Chain, Settings};
use niwaki_math::Total;
use niwaki_particles::{Moment, Rejuvenation, smc};
use niwaki_run::Task;
use niwaki_run::log::Log;
use niwaki_run::replay::{Missing, Source, by_address, replay};
use niwaki_vm::core::parse::parse;
use niwaki_vm::machine::kept::Strategy;
use niwaki_vm::passes::compile;
use serde_json::{Value, json};
use std::sync::Arc;

const STRATEGIES: [Strategy; 4] = [Strategy::Rerun, Strategy::Resume, Strategy::Cache, Strategy::C3];

fn task(text: &str) -> Task {
    Task::new(Arc::new(compile(&parse(text).expect("core form"), vec![]).expect("a program")))
}

fn leaf(name: &str, settings: Value) -> Kernel {
    Kernel::leaf(name, settings).expect("a kernel")
}

/// The sums of a run from the start: log prior, log score.
fn replayed(task: &Task, log: &Log) -> (Total, Total) {
    let source = Source::Addresses(by_address(&log.entries()));
    replay(task, source, Missing::Refuse).expect("a run").sums
}

/// A first state of 10^17 nats below the last.
#[test]
fn a_chain_forgets_no_nat_of_a_start_far_away() {
    let task = task(
        r#"(module (fn "m" (params)
          (set $x (sample (dist uniform -1.0 1.0))) (set $y (sample (dist gaussian 0.0 1.0)))
          (do (observe (dist gaussian $x 0.000000001) 0.0))
          (do (observe (dist gaussian $y 1.0) 1.234))) (entry "m"))"#,
    );
    for strategy in STRATEGIES {
        let kernel = leaf("drift", json!({"step": 0.5, "target": 0.44}));
        let settings = Settings { seed: 3, kernel, strategy, warmup: 8000, thin: 0, ..Settings::default() };
        let mut chains: Chains = Chains::start(&task, &settings, 4, None).expect("chains");
        let first: Vec<f64> = chains.chains.iter().map(|chain| chain.rungs[0].state.log_score()).collect();
        chains.advance(&task, 28_000, &|_, _| true).expect("proposals");
        for (ladder, first) in chains.chains.iter().zip(first) {
            let chain = &ladder.rungs[0];
            assert!(first < -1e12, "{first}");
            let carried = (chain.state.trace.totals().log_prior.clone(), chain.state.score());
            assert_eq!(carried, replayed(&task, &chain.now(&task.program).log), "{strategy:?}");
            let best = chain.best.get(&chain.state, &task).expect("the best state");
            let (log_prior, score) = replayed(&task, &best.log);
            assert_eq!((best.log_prior, best.log_score), (log_prior.value(), score.value()));
            // The best state of a single state is that state.
            assert_eq!(chain.best.score(), score.value(), "{strategy:?}");
            assert!(best.log_score > 0.0);
        }
    }
}

/// Terms from 10^-9 nats to the sizes given, which cancel.
fn cancelling(large: f64, huge: f64) -> Task {
    let text = r#"(module
      (fn "part" (params $x)
        (set $z (sample (dist gaussian $x 1.0)))
        (do (factor (mul HUGE $z))) (do (factor (mul 0.000000001 $z))) (do (factor (mul HUGE (sub 0.0 $z))))
        (return $z))
      (fn "m" (params)
        (set $x (sample (dist gaussian 0.0 1.0))) (set $y (sample (dist gaussian 0.0 1.0)))
        (do (factor (mul LARGE $x)))
        (do (observe (dist gaussian $y 1.0) 1.234))
        (if (sample (dist bernoulli 0.5)) (then (set $z (call "part" $x)) (do (observe (dist gaussian $z 0.5) 0.3))))
        (do (factor (mul LARGE (sub 0.0 $x))))
        (return (tuple $x $y))) (entry "m"))"#;
    task(&text.replace("LARGE", &format!("{large:?}")).replace("HUGE", &format!("{huge:?}")))
}

#[test]
fn terms_that_cancel_leave_the_same_chain() {
    let sizes = [(1e6, 1e9), (1e18, 1e12), (1e18, 1e300)];
    let (drift, block) = (
        leaf("drift", json!({"step": 0.7, "target": 0.44})),
        leaf("block", json!({"step": 0.3, "share": 0.5, "target": 0.23})),
    );
    let kernel = Kernel::Cycle(vec![Kernel::PRIOR, drift, block, leaf("regenerate", json!({"levels": 1}))]);
    for powers in [vec![1.0], vec![1.0, 0.3]] {
        let settings = Settings {
            kernel: kernel.clone(),
            warmup: 200,
            thin: 0,
            powers,
            every: 4,
            ..Settings::default()
        };
        let run = |task: &Task| {
            let mut ladder: Ladder = Ladder::start(task, &settings, 0, None).expect("a chain");
            ladder.advance(task, 1000, &mut |_, _| true).expect("proposals");
            let state = |chain: &Chain| {
                let (now, best) =
                    (chain.now(&task.program), chain.best.get(&chain.state, task).expect("the best"));
                format!("{now:?} {best:?} {:?} {:?}", chain.state.trace.totals(), chain.counts.sites)
            };
            (ladder.rungs.iter().map(state).collect::<Vec<_>>(), ladder.exchanges)
        };
        let without = run(&cancelling(0.0, 0.0));
        for (large, huge) in sizes {
            let task = cancelling(large, huge);
            let (difference, compared) = compare(&task, &settings, 400, 20).expect("a chain");
            assert!(difference.is_none(), "{large} {huge}: {}", difference.unwrap_or_default());
            assert!(compared.accepted > 100 && compared.accepted < compared.proposals, "{compared:?}");
            assert_eq!(run(&task), without, "{large} {huge}");
        }
    }
}

#[test]
fn terms_that_cancel_leave_the_same_particles() {
    let text = r#"(module (fn "m" (params)
      (do (factor LARGE))
      (set $x (sample (dist gaussian 0.0 1.0))) (do (observe (dist gaussian $x 1.0) 1.234))
      (set $y (sample (dist gaussian $x 1.0))) (do (factor (mul 0.000000001 $y)))
      (do (observe (dist gaussian $y 0.5) 0.3))
      (do (factor (sub 0.0 LARGE)))
      (return (tuple $x $y))) (entry "m"))"#;
    let run = |large: f64, rejuvenate: &Option<Rejuvenation>| {
        let task = task(&text.replace("LARGE", &format!("{large:?}")));
        let settings = niwaki_particles::Settings {
            rejuvenate: rejuvenate.clone(),
            seed: 4,
            ..niwaki_particles::Settings::default()
        };
        let result = smc(&task, &settings, &mut |_| true).expect("particles");
        for p in &result.particles {
            let (log_prior, log_score) = replayed(&task, &p.log);
            assert_eq!((p.log_prior, p.log_score), (log_prior.value(), log_score.value()));
        }
        let of = |p: &niwaki_run::run::Run| {
            format!("{:?} {:?} {:?} {}", p.value, p.log_prior, p.log_score, p.log_weight)
        };
        result.particles.iter().map(of).collect::<Vec<_>>()
    };
    let drift = leaf("drift", json!({"step": 0.7, "target": 0.44}));
    for rejuvenate in
        [None, Some(Rejuvenation { kernel: drift, moves: 2, at: Moment::Resampled, final_chains: None })]
    {
        let without = run(0.0, &rejuvenate);
        for large in [1e9, 1e18, 1e300] {
            assert_eq!(run(large, &rejuvenate), without, "{large}");
        }
    }
}

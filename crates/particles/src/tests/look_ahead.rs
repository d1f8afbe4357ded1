//! The claim: evidence and posterior are right under any forecast, however wrong and large, in either order, whenever
//! particles are resampled, by tempered weights and at any powers; particle Gibbs and PIMH keep the posterior with it.
//!
//! The forecast here is a wave over what the run has chosen and scored so far, several nats high: it knows nothing, and
//! differs between particles at each barrier. Limits are those of the parent module and of `chains`; about 250 quantities are
//! looked at.

use super::*;
use niwaki_propose::guide::bound::Sight;
use niwaki_propose::look_ahead::{Forecast, LookAhead, Paused};
use niwaki_vm::machine::Machine;

/// Up to this many nats.
const HEIGHT: f64 = 2.0;

/// Some number that depends on the run so far.
#[derive(Debug)]
struct Wave;

impl Forecast for Wave {
    fn rise(&self, run: Paused<'_>, _: &mut Machine<'_>, _: &mut Sight) -> f64 {
        let record = run.record;
        let runnable = run.state.runnable().len() as f64;
        let so_far = 5.0 * record.log_prior.value() + 3.0 * record.score().value() + runnable;
        HEIGHT * so_far.sin()
    }
}

fn ahead(particles: usize, order: Order, resampling: Resampling) -> Settings {
    let look_ahead = Some(LookAhead { strength: 0.8, forecast: Arc::new(Wave) });
    Settings { particles, look_ahead, ..settings(order, resampling) }
}

#[test]
fn evidence_and_posterior_are_right_under_any_forecast() {
    let low = When::EffectiveBelow(0.5);
    for (name, text) in PROGRAMS {
        let task = task(text);
        for (particles, seeds, order, resampling, when) in [
            (3, 12_000, Order::Stochastic, Resampling::Tempered, low),
            (8, 4000, Order::DepthFirst, Resampling::Systematic, When::Always),
            (8, 4000, Order::Stochastic, Resampling::Multinomial, low),
            (30, 1500, Order::Stochastic, Resampling::Tempered, When::Always),
        ] {
            let settings = Settings { when, ..ahead(particles, order.clone(), resampling) };
            let scores = z_scores(&task, &settings, 0..seeds);
            assert!(worst(&scores) < LIMIT, "{name}, {particles}, {order:?}, {when:?}: {scores:?}");
        }
    }
}

#[test]
fn powers_final_moves_and_several_populations_leave_them_right() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let kernel = niwaki_chain::kernel::Kernel::PRIOR;
        let rejuvenate = Rejuvenation { kernel, moves: 1, at: Moment::End, final_chains: None };
        let anneal = Anneal::Schedule([0.5, 1.4, 0.8].as_slice().into());
        let settings = ahead(12, Order::Stochastic, Resampling::Tempered);
        let settings = Settings { anneal, rejuvenate: Some(rejuvenate), ..settings };
        let of = |seed| populations(&task, &Settings { seed, ..settings.clone() }, &[4, 9], &mut |_| true);
        let scores = z_scores_of(&task, &of, 0..3000);
        assert!(worst(&scores) < LIMIT, "{name}: {scores:?}");
    }
}

#[test]
fn particle_gibbs_keeps_the_posterior_under_any_forecast() {
    let low = When::EffectiveBelow(0.5);
    for (name, text) in PROGRAMS {
        let task = task(text);
        let starts = exact_draws(&task, 5000);
        for (particles, order, resampling, when, ancestors) in [
            (2, Order::Stochastic, Resampling::Multinomial, When::Always, Ancestors::Sampled),
            (4, Order::DepthFirst, Resampling::Tempered, low, Ancestors::Kept),
            (5, Order::Stochastic, Resampling::Tempered, When::Always, Ancestors::Sampled),
        ] {
            let settings = Settings { when, ..ahead(particles, order.clone(), resampling) };
            let scores = counted(&task, &values_after(&task, &starts, &settings, ancestors, 3));
            assert!(worst(&scores) < LIMIT, "{name}, {particles}, {order:?}, {ancestors:?}: {scores:?}");
        }
    }
}

#[test]
fn pimh_finds_the_posterior_under_any_forecast() {
    for (name, text) in PROGRAMS.into_iter().step_by(3) {
        let task = task(text);
        let last = |seed| {
            let settings = Settings { seed, ..ahead(8, Order::Stochastic, Resampling::Systematic) };
            match pimh(&task, &settings, 40, &mut |_| true) {
                Ok(chain) => Some(repr(&chain.states.last().unwrap().value).unwrap()),
                Err(failure) if failure.is_impossible() => None,
                Err(other) => panic!("{other}"),
            }
        };
        let values: Vec<String> = (0..repetitions(2000)).filter_map(last).collect();
        let scores = counted(&task, &values);
        assert!(worst(&scores) < LIMIT, "{name}: {scores:?}");
    }
}

/// By hand: one particle, whose weight at a barrier is its score and its forecast; in the end it is the score alone. What a
/// stopped search leaves has no forecast in its weight either.
#[test]
fn the_forecast_is_in_the_weight_on_the_way_only() {
    let task = task(PROGRAMS[1].1);
    let settings =
        Settings { when: When::EffectiveBelow(0.0), ..ahead(1, Order::DepthFirst, Resampling::Systematic) };
    let mut population = Population::start(&task, &settings, true).unwrap();
    let mut seen = 0;
    while population.running() > 0 {
        population.advance(None).unwrap();
        population.weigh().unwrap();
        let p = &population.swarm.alone()[0];
        let run = Paused { task: &task, record: &p.record, state: &p.state };
        let rise = Wave.rise(run, &mut task.machine(), &mut Sight::default());
        let expected = if p.is_running() { 0.8 * rise } else { 0.0 };
        assert!((p.log_weight - p.record.log_score() - expected).abs() < 1e-12);
        seen += usize::from(expected.abs() > 1e-3);
    }
    assert!(seen >= 3, "{seen}");
    let mut left = 1;
    let stopped = smc(&task, &settings, &mut |_| {
        left -= 1;
        left >= 0
    });
    let particle = &stopped.unwrap().particles[0];
    assert!(!particle.has_ended && (particle.log_weight - particle.log_score).abs() < 1e-12);
}

#[test]
fn threads_change_nothing_under_a_forecast_and_the_forecast_changes_much() {
    let task = task(PROGRAMS[4].1);
    let run = |threads: usize, settings: Settings| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let result = pool.install(|| smc(&task, &settings, &mut |_| true)).unwrap();
        let logs = result.particles.iter().map(|p| p.log_weight.to_bits());
        (result.log_evidence.unwrap().to_bits(), logs.collect::<Vec<_>>())
    };
    let settings = Settings { seed: 5, ..ahead(100, Order::Stochastic, Resampling::Tempered) };
    assert_eq!(run(1, settings.clone()), run(3, settings.clone()));
    assert_ne!(run(1, settings.clone()).0, run(1, Settings { look_ahead: None, ..settings }).0);
}

//! The claim: moves leave the particles' law at every barrier invariant, so that the evidence stays unbiased and the
//! final set follows the posterior.
//!
//! The law `F_n` is known to the bit: forward runs up to barrier n are collected until their probabilities sum to one.
//! 40,000 particles are then drawn from it independently, moved, and counted; each count is a binomial variable. About
//! 300 counts are looked at, and a z beyond 5 comes once in 1.7 million (normal approximation; states that are expected
//! fewer than 25 times are left out), so a re-seeded suite fails once in 5,000 runs.

use super::*;
use crate::population::Population;
use niwaki_chain::kernel::Kernel;
use niwaki_propose::particle::Turn;
use niwaki_run::chooser::Prior;
use serde_json::json;

/// Programs in which moves have more to do: choices whose existence changes between two barriers, and values in a
/// suspended activation.
const MORE: [(&str, &str); 3] = [
    (
        "a choice that comes and goes within its barrier",
        r#"(module (fn "m" (params)
            (set $a (sample (dist bernoulli 0.3)))
            (if $a (then (set $b (sample (dist discrete_uniform 0 2)))) (else (set $b 5)))
            (do (factor (cond (eq $b 1) 0.7 -0.4)))
            (set $c (sample (dist bernoulli (cond $a 0.8 0.3))))
            (do (factor (cond $c -0.5 0.1)))
            (return (tuple $a $b $c))) (entry "m"))"#,
    ),
    (
        "futures made or not made, and a family that changes",
        r#"(module (fn "twig" (params $p) (set $t (sample (dist bernoulli $p))) (do (factor (cond $t 0.5 -0.5))) (return $t))
            (fn "m" (params)
            (set $n (sample (dist discrete_uniform 0 2)))
            (set $x (future "twig" 0.6))
            (if (gt $n 0) (then (set $y (future "twig" 0.2))) (else (set $y (future "twig" 0.9))))
            (if (eq $n 2) (then (do (future "twig" 0.5))))
            (do (factor (mul 0.3 $n)))
            (set $z (sample (dist bernoulli (cond (eq $n 1) 0.9 0.2))))
            (do (factor (cond $z -0.3 0.2)))
            (return (tuple $n (force $x) (force $y) $z))) (entry "m"))"#,
    ),
    (
        "a value that is read two barriers later",
        r#"(module (fn "m" (params)
            (set $a (sample (dist discrete_uniform 0 2)))
            (do (factor (mul -0.2 $a)))
            (set $b (sample (dist bernoulli 0.5)))
            (do (factor (cond $b 0.2 0.0)))
            (set $c (sample (dist bernoulli (cond (eq $a 2) 0.9 0.1))))
            (do (factor (cond (and $c (eq $a 2)) 1.0 -0.5)))
            (return (tuple $a $b $c))) (entry "m"))"#,
    ),
];

fn programs() -> impl Iterator<Item = (&'static str, &'static str)> {
    PROGRAMS.into_iter().chain(MORE)
}

pub fn every_kind() -> Kernel {
    let leaf = |name, settings| Kernel::leaf(name, settings).unwrap();
    let block = leaf("block", json!({"step": 0.5, "share": 0.5, "target": 0.3}));
    Kernel::Mixture(vec![
        (2.0, Kernel::PRIOR),
        (1.0, leaf("neighbour", json!({"reach": 1}))),
        (1.0, leaf("by_family", json!({}))),
        (1.0, block),
        (1.0, leaf("drift", json!({"step": 0.5, "target": 0.4}))),
        (1.0, leaf("regenerate", json!({"levels": 1}))),
    ])
}

fn rejuvenation(kernel: Kernel, moves: u64, at: Moment) -> Option<Rejuvenation> {
    Some(Rejuvenation { kernel, moves, at, final_chains: None })
}

/// A run as text: in order while it runs, as a set once it has ended.
fn text(p: &Particle) -> String {
    let choice = |e: &niwaki_run::log::Entry| format!("{:x}={}", e.address(), written(e));
    let entries = p.record.log.entries();
    if !p.state.has_ended() {
        return entries
            .iter()
            .map(|e| if e.is_order() { format!("!{}", choice(e)) } else { choice(e) })
            .collect();
    }
    let mut choices: Vec<String> = entries.iter().filter(|e| !e.is_order()).map(choice).collect();
    choices.sort();
    format!("ended {}", choices.concat())
}

/// The worst z of the counts of moved draws from the law at a barrier, the number of states, and the moves.
pub(super) fn moved_draws(task: &Task, settings: &Settings, barriers: usize) -> (f64, usize, MoveCounts) {
    let mut population = Population::start(task, settings, false).unwrap();
    let (mut machine, mut log_orders) = (task.machine(), vec![0.0; settings.particles]);
    for _ in 0..barriers {
        for (p, log_order) in population.swarm.alone().iter_mut().zip(&mut log_orders) {
            p.was_ended = p.state.has_ended();
            let (prior, lineage) = (Prior(p.stream), p.lineage);
            let pick = |_: &mut Prior, turn: Turn<'_>| {
                let picked = turn.pick(settings.seed, lineage);
                *log_order += turn.past.log_probability(turn.state, picked);
                Some(picked)
            };
            p.advance_by(&mut machine, task, pick, prior).unwrap();
        }
        population.barriers += 1;
    }
    let (mut law, mut whole, mut mass) = (HashMap::new(), HashMap::new(), 0.0);
    for (p, log_order) in population.swarm.alone().iter_mut().zip(log_orders) {
        let entries = p.record.log.entries();
        let log_run = p.record.log_prior.value() + log_order;
        let log_law = log_run + settings.power * p.record.log_score();
        p.weighed = p.record.score();
        p.log_weight = f64::NEG_INFINITY;
        let choices: Vec<_> = entries.iter().map(|e| (e.address(), written(e))).collect();
        if whole.insert(choices, ()).is_none() {
            mass += log_run.exp();
            *law.entry(text(p)).or_insert(0.0) += log_law.exp();
            p.log_weight = log_law;
        }
    }
    assert!((mass - 1.0).abs() < 1e-9, "forward runs found {mass} of all");
    assert!(population.estimate.weights.read(population.swarm.alone().iter().map(|p| p.log_weight)));
    population.resample(None).unwrap();
    population.powers.now = settings.power;
    population.rejuvenate(true).unwrap();
    // Particles that ended earlier are not moved here; the law includes them.
    let n = settings.particles as f64;
    let total: f64 = law.values().sum();
    let mut counts: HashMap<String, f64> = HashMap::new();
    population.swarm.alone().iter().for_each(|p| *counts.entry(text(p)).or_insert(0.0) += 1.0);
    let mut worst: f64 =
        counts.keys().filter(|text| !law.contains_key(*text)).map(|_| 99.0).fold(0.0, f64::max);
    for (text, p) in &law {
        let p = p / total;
        if n * p >= RARE {
            let count = counts.get(text).copied().unwrap_or(0.0);
            worst = worst.max((count - n * p).abs() / (n * p * (1.0 - p)).sqrt().max(1e-9));
        }
    }
    (worst, law.len(), population.moves.counts)
}

pub(super) fn draws(kernel: Kernel, order: Order, power: f64) -> Settings {
    Settings {
        particles: 40_000,
        power,
        seed: 11,
        rejuvenate: rejuvenation(kernel, 4, Moment::Resampled),
        ..settings(order, Resampling::Multinomial)
    }
}

#[test]
fn moves_of_partial_programs_leave_their_law_as_it_is() {
    let mut all = MoveCounts::default();
    for (name, text) in programs() {
        let task = task(text);
        for order in orders(text) {
            let power = if order == Order::Stochastic { 1.7 } else { 1.0 };
            for barriers in 1..=3 {
                let settings = draws(every_kind(), order.clone(), power);
                let (worst, states, moved) = on_one_thread(|| moved_draws(&task, &settings, barriers));
                all += moved;
                assert!(worst < LIMIT, "{name}, {order:?}, barrier {barriers}: z {worst}, {states} states");
            }
        }
    }
    // Some proposals are accepted.
    assert!(
        all.running.accepted * 20 > all.running.proposed && all.ended.accepted * 20 > all.ended.proposed,
        "{all:?}"
    );
}

#[test]
fn evidence_and_posterior_stay_right() {
    for (name, text) in programs() {
        let task = task(text);
        let forms = orders(text).map(|order| (order, Moment::Every(1)));
        for (order, at) in forms.chain([(Order::Stochastic, Moment::End)]) {
            let settings = Settings {
                rejuvenate: rejuvenation(every_kind(), 2, at),
                ..settings(order.clone(), Resampling::Systematic)
            };
            let scores = z_scores(&task, &settings, 0..2000);
            assert!(worst(&scores) < LIMIT, "{name}, {order:?}, {at:?}: {scores:?}");
        }
        let settings = Settings {
            when: When::EffectiveBelow(0.5),
            rejuvenate: rejuvenation(Kernel::PRIOR, 2, Moment::Every(2)),
            ..settings(Order::Stochastic, Resampling::Systematic)
        };
        let scores = z_scores(&task, &settings, 0..2000);
        assert!(worst(&scores) < LIMIT, "{name}, adaptive resampling: {scores:?}");
    }
}

/// Runs that end at once, with a good or a bad score, and long ones: of two particles of which one is long, the other is bad
/// half of the time, and one time in five by its law. Coins without effect make moves of the other choices rare, so that
/// many moves are far from one.
const SOON: &str = r#"(module (fn "m" (params)
    (for $i (range 6) (body (set $coin (sample (dist bernoulli 0.5)))))
    (set $a (sample (dist discrete_uniform 0 2)))
    (do (factor (cond (eq $a 2) 1.4 0.0)))
    (if (eq $a 0) (then (for $i (range 12) (body (do (factor 0.0))))))
    (return $a)) (entry "m"))"#;

/// Two particles, so that one has a large effect on the other.
#[test]
fn who_is_moved_must_not_depend_on_the_others() {
    let settings = Settings {
        particles: 2,
        rejuvenate: rejuvenation(Kernel::PRIOR, 1, Moment::Every(1)),
        ..settings(Order::Stochastic, Resampling::Systematic)
    };
    let scores = z_scores(&task(SOON), &settings, 0..20_000);
    assert!(worst(&scores) < LIMIT, "{scores:?}");
}

#[test]
fn threads_change_nothing_with_moves() {
    let task = task(PROGRAMS[5].1);
    let settings = Settings {
        particles: 100,
        seed: 5,
        rejuvenate: rejuvenation(every_kind(), 3, Moment::Every(1)),
        ..Settings::default()
    };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let run = smc(&task, &settings, &mut |_| true).unwrap();
            let values: Vec<String> = run.particles.iter().map(|p| repr(&p.value).unwrap()).collect();
            (run.log_evidence.unwrap().to_bits(), run.moved, values)
        })
    };
    assert_eq!(run(1), run(8));
}

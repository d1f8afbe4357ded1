//! The claim: for every schedule of powers, the final law and the evidence are those of the declared power.
//!
//! A schedule keeps the evidence unbiased, so it is tested as in the parent module (z beyond 5 once in 1.7 million). Adapted
//! powers depend on the particles and are consistent only: they are adapted once by a pilot and then held, and the
//! direct estimate of 4,000 particles is compared within 2 %.

use super::*;

const UP_AND_DOWN: [f64; 3] = [0.3, 2.5, 0.7];

fn scheduled(powers: &[f64]) -> Settings {
    Settings {
        anneal: Anneal::Schedule(powers.into()),
        ..settings(Order::Stochastic, Resampling::Systematic)
    }
}

#[test]
fn a_schedule_changes_neither_evidence_nor_posterior() {
    for (name, text) in PROGRAMS {
        for when in [When::Always, When::EffectiveBelow(0.5)] {
            let scores = z_scores(&task(text), &Settings { when, ..scheduled(&UP_AND_DOWN) }, 0..16_000);
            assert!(worst(&scores) < LIMIT, "{name}, {when:?}: {scores:?}");
        }
    }
}

#[test]
fn adapted_powers_end_at_the_declared_one() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        let exact = enumerate(&task, 100_000, &mut |_| true).unwrap().log_evidence;
        let adaptive = Settings {
            particles: 4000,
            anneal: Anneal::Adaptive(0.9),
            ..settings(Order::Stochastic, Resampling::Systematic)
        };
        let result = smc(&task, &adaptive, &mut |_| true).unwrap();
        let log = result.log_evidence.unwrap();
        assert!((log - exact).abs() < 0.02, "{name}: {log} for {exact}");
        let powers = &result.powers;
        assert_eq!(powers.len(), result.barriers);
        assert!(
            powers.is_sorted() && powers[0] >= 0.0 && *powers.last().unwrap() <= 1.0,
            "{name}: {powers:?}"
        );
        // Held, it is a schedule like any other.
        let scores = z_scores(&task, &scheduled(powers), 0..2000);
        assert!(worst(&scores) < LIMIT, "{name}: {scores:?}");
    }
}

/// A constant in the score changes no posterior, so it must not change the powers, however large the weights become
/// where resampling is rare.
#[test]
fn adapted_powers_do_not_depend_on_a_constant_of_the_score() {
    let powers = |constant: f64| {
        let text = format!(
            r#"(module (fn "m" (params) (for $i (range 4) (body
            (set $x (sample (dist discrete_uniform 0 9)))
            (do (factor (sub {constant:?} (mul 2.0 $x)))))) (return 0)) (entry "m"))"#
        );
        let settings = Settings {
            particles: 200,
            anneal: Anneal::Adaptive(0.5),
            when: When::EffectiveBelow(0.0),
            ..Settings::default()
        };
        smc(&task(&text), &settings, &mut |_| true).unwrap().powers
    };
    let plain = powers(0.0);
    assert!(plain[0] < 1.0 && plain.last() > plain.first(), "{plain:?}");
    for constant in [-1e5, 1e5] {
        let shifted = powers(constant);
        let apart = plain.iter().zip(&shifted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-4, "{constant}: {shifted:?} for {plain:?}");
    }
}

/// A power other than one: the final law is `prior x score^T`, and its constant is reported beside the evidence.
#[test]
fn a_declared_power_is_that_of_the_final_law() {
    let hot = r#"(module (fn "m" (params)
        (set $a (sample (dist bernoulli 0.3))) (do (factor (cond $a -0.5 0.0)))
        (set $b (sample (dist bernoulli 0.6))) (do (factor (cond (or $a $b) 0.0 -1.5)))
        (return (tuple $a $b))) (entry "m"))"#;
    let squared = hot.replace("-0.5", "-1.0").replace("-1.5", "-3.0");
    let exact = enumerate(&task(&squared), 100, &mut |_| true).unwrap().log_evidence;
    for anneal in [Anneal::Constant, Anneal::Schedule([0.5, 3.0].as_slice().into())] {
        let (mut sum, mut squares, n) = (0.0, 0.0, 4000.0);
        for seed in 0..4000 {
            let settings =
                Settings { seed, power: 2.0, anneal: anneal.clone(), particles: 8, ..Settings::default() };
            let result = smc(&task(hot), &settings, &mut |_| true).unwrap();
            assert!(result.log_evidence.is_none());
            let z = (result.log_normaliser.unwrap() - exact).exp();
            (sum, squares) = (sum + z, squares + z * z);
        }
        let mean: f64 = sum / n;
        let error = ((squares / n - mean * mean) / n).sqrt();
        assert!(((mean - 1.0) / error).abs() < LIMIT, "{anneal:?}: {mean} +- {error}");
    }
}

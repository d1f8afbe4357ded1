//! The probabilities of an `infer` by enumeration, recorded: equal to those of the plain run to the bit, with derivatives.
//!
//! An inner coin has the prior 0.3 and heads score `x`, so that `p = 0.3 e^x / (0.3 e^x + 0.7)` and `dp/dx = p (1 - p)`. Mutant in
//! `tests/mutants`: a normaliser that does not vary, for which `dp/dx = p`. Log densities lie on a grid of 2^-32, so
//! probabilities are compared up to 1e-9.

use niwaki_propose::gradient::live;
use niwaki_run::Task;
use niwaki_run::forward::forward;
use niwaki_run::replay::{Missing, Source, by_address, replay};
use niwaki_run::task::NoHosts;
use niwaki_search::nested::{Inferences, Inner};
use niwaki_vm::core::parse::parse;
use niwaki_vm::machine::Limits;
use niwaki_vm::passes::compile;
use niwaki_vm::value::Value;
use std::collections::HashMap;
use std::sync::Arc;

/// A task whose host function 0 is an `infer` by this method.
fn task(method: &str, body: &str) -> Task {
    let text = format!(
        r#"(module
            (fn "coin" (params $more) (captures $x)
              (set $a (sample (dist bernoulli 0.3)))
              (do (factor (cond $a (mul $x $more) 0.0)))
              (return $a))
            (fn "m" (params) (set $x (sample (dist gaussian 0.0 1.0))) {body})
            (entry "m"))"#
    );
    let constant = Value::tuple(vec![Value::str("infer"), Value::str("sample"), Value::str(method)]);
    let inner = Inner::read(&constant).expect("an inference").expect("a method");
    let program = Arc::new(compile(&parse(&text).expect("core form"), vec![]).expect("a program"));
    let inferences = Inferences {
        program: program.clone(),
        methods: Arc::new(HashMap::from([(0, inner)])),
        hosts: Arc::new(NoHosts),
        limits: Limits::default(),
        depth: 0,
        known: Arc::default(),
    };
    Task { hosts: Arc::new(inferences), ..Task::new(program) }
}

const ENUMERATION: &str = r#"{"method": "enumerate_all", "max_runs": 100, "likely": false, "rest": 0.0}"#;

/// The score is the probability of the second value, the less probable one.
const SECOND: &str =
    r#"(set $r (host 0 (closure "coin" $x) 1.0 0)) (do (factor (index (index $r 1) 1))) (return $x)"#;

#[test]
fn a_probability_has_the_slope_of_a_logistic() {
    let task = task(ENUMERATION, SECOND);
    let run = forward(&task, 1, 0, true).expect("a run");
    let choices = by_address(&run.log.entries());
    let mut density = live(&task, &choices).expect("a density");
    for x in [-2.0f64, -0.3, 0.4, 0.8] {
        let p = 0.3 * x.exp() / (0.3 * x.exp() + 0.7);
        let mut slope = [0.0];
        let value = density.value_and_gradient(&[x], &mut slope).expect("a value");
        let normal = -0.5 * x * x - 0.5 * (2.0 * std::f64::consts::PI).ln();
        assert!((value - normal - p).abs() < 1e-9, "{x}: {value}");
        assert!((slope[0] + x - p * (1.0 - p)).abs() < 1e-9, "{x}: {}", slope[0]);
        let plain = density.values(&[x]).expect("values");
        let trace = replay(&task, Source::Addresses(plain), Missing::Refuse).expect("a run");
        assert!((trace.sums.0.plus(&trace.sums.1).value() - value).abs() < 1e-8);
    }
    assert_eq!(density.recordings(), 1);
    // From here on heads are more probable: another order, and the score is that of tails.
    let (x, mut slope) = (1.2f64, [0.0]);
    density.value_and_gradient(&[x], &mut slope).expect("a value");
    let p = 0.7 / (0.3 * x.exp() + 0.7);
    assert!((slope[0] + x + p * (1.0 - p)).abs() < 1e-9 && density.recordings() == 2);
}

#[test]
fn an_inference_that_draws_is_refused_where_its_arguments_vary() {
    let method = r#"{"method": "importance", "n": 5, "proposal": null}"#;
    let varies =
        task(method, r#"(do (factor (cond (host 0 (closure "coin" $x) 1.0 3) 1.0 0.0))) (return $x)"#);
    let choices = by_address(&forward(&varies, 1, 0, true).expect("a run").log.entries());
    let fault = live(&varies, &choices).err().expect("a refusal");
    assert!(format!("{fault:?}").contains("enumerate_all()"), "{fault:?}");
    let fixed =
        task(method, r#"(do (factor (cond (host 0 (closure "coin" 0.5) 1.0 3) $x 0.0))) (return $x)"#);
    let choices = by_address(&forward(&fixed, 1, 0, true).expect("a run").log.entries());
    assert!(live(&fixed, &choices).is_ok());
}

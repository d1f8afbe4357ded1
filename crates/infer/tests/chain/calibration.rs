//! The claim: a kernel leaves the posterior as it is, on continuous programs with bounds, simplexes and angles, and on
//! programs whose choices come and go; a chain that leaves out the reverse density of a drift does not.
//!
//! Gandy and Scott 2020, algorithm 1: draw parameters and data from the model, start a chain at those parameters with
//! those data, and make some proposals. What comes out is again a draw from the prior, exactly, whatever the number of
//! proposals; and the draws of different replicates are independent. So each coordinate is compared with fresh prior draws
//! by the two-sample test of Kolmogorov and Smirnov: 4,000 against 4,000, at 2.86 sqrt(2 / 4000), which the true kernel
//! exceeds once in 6 million (Smirnov's bound 2 exp(-2 d^2)); about 170 coordinates are looked at.

use super::board::NoReverse;
use super::programs::task;
use niwaki_infer::Task;
use niwaki_infer::chain::accept::{MetropolisHastings, Rules};
use niwaki_infer::chain::kernel::{Kernel, Selection};
use niwaki_infer::chain::user::User;
use niwaki_infer::chain::{Chain, Settings};
use niwaki_infer::forward::forward;
use niwaki_infer::replay::by_address;
use niwaki_vm::value::Value;
use std::sync::Arc;

const REPLICATES: u64 = 4000;
const PROPOSALS: u64 = 12;
pub const LIMIT: f64 = 2.86;

/// Each twice: drawing its data (`DATA` is a choice) and observing what it is given.
pub const PROGRAMS: [(&str, &str); 6] = [
    (
        "location and scale",
        r#"(set $x (sample (dist gaussian 0.0 1.0))) (set $s (sample (dist gamma 2.0 1.0)))
           (set $t (sample (dist log_normal 0.0 0.5)))
           DATA(gaussian $x (add (mul 0.5 $t) $s))
           (return (tuple $x $s $t (mul $x $y) $y))"#,
    ),
    (
        "bounds that move",
        r#"(set $p (sample (dist beta 2.0 3.0))) (set $u (sample (dist uniform 0.0 $p)))
           (set $v (sample (dist truncated_gaussian 0.5 1.0 $u 2.0)))
           DATA(gaussian (add $u $v) 0.3)
           (return (tuple $p $u $v (mul $u $y)))"#,
    ),
    (
        "a simplex and an index into it",
        r#"(set $w (sample (dist dirichlet (list 1.0 2.0 3.0)))) (set $z (sample (dist categorical $w)))
           DATA(gaussian (index $w $z) 0.2)
           (return (tuple (index $w 0) (index $w 1) $z (mul $z $y)))"#,
    ),
    (
        "a count of terms",
        r#"(set $k (sample (dist poisson 2.0))) (set $sum 0.0)
           (for $i (range $k) (body (set $g (sample (dist gaussian 0.5 1.0))) (set $sum (add $sum $g))))
           DATA(gaussian $sum 1.0)
           (return (tuple $k $sum (mul $sum $y)))"#,
    ),
    (
        "angles and tails",
        r#"(set $a (sample (dist von_mises 0.5 1.0))) (set $c (sample (dist laplace 0.0 1.0)))
           (set $e (sample (dist exponential 1.0)))
           DATA(gaussian (add (mul $a $e) $c) 1.0)
           (return (tuple $a $c $e (mul $a $y)))"#,
    ),
    (
        "two shapes of program",
        r#"(set $b (sample (dist bernoulli 0.4)))
           (if $b (then (set $h (sample (dist gaussian 0.0 1.0))) (set $m (sample (dist uniform 0.0 2.0))) (set $r (mul $h $m)))
             (else (set $h (sample (dist gamma 2.0 0.5))) (set $r $h)))
           DATA(gaussian $r 0.7)
           (return (tuple $b $r (mul $r $y)))"#,
    ),
];

/// The program that draws its data, the one that observes them (`$y`, `$y2`, ...), and how many there are.
fn both(text: &str) -> (Task, Task, usize) {
    let (mut drawing, mut observing, mut names) = (String::new(), String::new(), Vec::new());
    let mut rest = text;
    while let Some(from) = rest.find("DATA(") {
        let behind = &rest[from + 5..];
        let (mut open, mut end) = (1, 0);
        for (i, c) in behind.char_indices() {
            open += i32::from(c == '(') - i32::from(c == ')');
            if open == 0 {
                end = i;
                break;
            }
        }
        let number = names.len() + 1;
        let name = if number == 1 { "$y".to_string() } else { format!("$y{number}") };
        for body in [&mut drawing, &mut observing] {
            body.push_str(&rest[..from]);
        }
        drawing += &format!("(set {name} (sample (dist {})))", &behind[..end]);
        observing += &format!("(do (observe (dist {}) {name}))", &behind[..end]);
        names.push(name);
        rest = &behind[end + 1..];
    }
    let filled = |head: &str, body: &str| {
        task(&format!(r#"(module (fn "m" (params {head}) {body}{rest}) (entry "m"))"#))
    };
    (filled("", &drawing), filled(&names.join(" "), &observing), names.len())
}

fn numbers(value: &Value) -> Vec<f64> {
    let Value::Tuple(items) = value else { panic!("{value:?} is no tuple") };
    let number = |value: &Value| match value {
        Value::Real(x) => *x,
        Value::Int(n) => *n as f64,
        Value::Bool(b) => f64::from(u8::from(*b)),
        other => panic!("{other:?} is no number"),
    };
    items.items().iter().map(number).collect()
}

/// The largest of the coordinates' Kolmogorov distances, in units of sqrt(2 / n).
pub fn distance<R: Rules>(text: &str, kernel: &Kernel) -> f64 {
    distance_of::<R>(text, kernel, REPLICATES)
}

/// The same, of so many replicates.
pub fn distance_of<R: Rules>(text: &str, kernel: &Kernel, replicates: u64) -> f64 {
    let (drawing, observing, data) = both(text);
    let (mut fresh, mut kept): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (vec![], vec![]);
    for replicate in 0..replicates {
        fresh.push(numbers(&forward(&drawing, 1, replicate, true).expect("a run").value));
        let first = forward(&drawing, 2, replicate, true).expect("a run");
        let (choices, values) = (first.record.log.entries(), numbers(&first.value));
        let args = choices[choices.len() - data..].iter().map(|choice| choice.value.clone()).collect();
        let given = Task { args, ..observing.clone() };
        let settings =
            Settings { seed: 3 + replicate, kernel: kernel.clone(), thin: 0, ..Settings::default() };
        let mut chain = Chain::<R>::start(&given, &settings, 0, Some(&by_address(&choices)))
            .expect("the state that was drawn");
        let started = numbers(&chain.state.trace.result());
        assert_eq!(started[..started.len().min(2)], values[..started.len().min(2)], "the chain starts there");
        chain.advance(&given, PROPOSALS, &mut |_, _| true).expect("proposals");
        kept.push(numbers(&chain.state.trace.result()));
    }
    let scale = (replicates as f64 / 2.0).sqrt();
    (0..fresh[0].len())
        .map(|i| {
            let sorted = |rows: &[Vec<f64>]| {
                let mut column: Vec<f64> = rows.iter().map(|row| row[i]).collect();
                column.sort_by(f64::total_cmp);
                column
            };
            scale * smirnov(&sorted(&fresh), &sorted(&kept))
        })
        .fold(0.0, f64::max)
}

/// The largest distance between two empirical distribution functions.
fn smirnov(a: &[f64], b: &[f64]) -> f64 {
    let (mut i, mut j, mut largest) = (0, 0, 0.0_f64);
    while i < a.len() && j < b.len() {
        let x = a[i].min(b[j]);
        i += a[i..].iter().take_while(|y| **y <= x).count();
        j += b[j..].iter().take_while(|y| **y <= x).count();
        largest = largest.max((i as f64 / a.len() as f64 - j as f64 / b.len() as f64).abs());
    }
    largest
}

fn kernels() -> Vec<(&'static str, Kernel)> {
    let drift = |step| Kernel::Drift { step, target: 0.44 };
    let all = || Kernel::Cycle(vec![Kernel::Prior, drift(1.0), Kernel::Regenerate { levels: 0 }]);
    let odds = Selection { odds: vec![("g".into(), 5.0), ("k".into(), 0.5)], ..Selection::default() };
    vec![
        ("prior", Kernel::Prior),
        ("drift", drift(1.0)),
        ("neighbour", Kernel::Neighbour { reach: 2 }),
        ("block", Kernel::Block { step: 0.5, share: 0.7, target: 0.23 }),
        ("regenerate", Kernel::Regenerate { levels: 0 }),
        ("cycle", all()),
        (
            "mixture by weight",
            Kernel::On(odds, Box::new(Kernel::Mixture(vec![(1.0, Kernel::Prior), (2.0, drift(0.5))]))),
        ),
    ]
}

#[test]
fn kernels_leave_the_posterior_as_it_is() {
    let mut wrong = String::new();
    for (name, text) in PROGRAMS {
        for (kind, kernel) in kernels() {
            if kind == "mixture by weight" && name != "a count of terms" {
                continue;
            }
            let d = distance::<MetropolisHastings>(text, &kernel);
            if d > LIMIT {
                wrong += &format!("{name}, {kind}: {d}\n");
            }
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn a_proposal_of_ones_own_leaves_the_posterior_as_it_is() {
    // A scale that depends on the value: going there is not as likely as coming back.
    let text = r#"(module (fn "near" (params $x) (return (dist gaussian (mul 0.5 $x) (add 0.3 (mul $x $x))))) (entry "near"))"#;
    let own = Kernel::User(Arc::new(User::new(task(text)).expect("a proposal")));
    let sites = Selection { sites: vec![vec!["x".into()]], ..Selection::default() };
    let kernel = Kernel::Mixture(vec![(3.0, Kernel::On(sites, Box::new(own))), (1.0, Kernel::Prior)]);
    let d = distance::<MetropolisHastings>(PROGRAMS[0].1, &kernel);
    assert!(d < LIMIT, "{d}");
    let d = distance::<NoReverse>(PROGRAMS[0].1, &kernel);
    assert!(d > 2.0 * LIMIT, "the mutant without the reverse density: {d} only");
}

#[test]
fn a_drift_without_its_reverse_density_is_found_out() {
    for (at, kernel) in [
        (0, Kernel::Drift { step: 1.0, target: 0.44 }),
        (2, Kernel::Drift { step: 1.0, target: 0.44 }),
        (4, Kernel::Block { step: 0.5, share: 0.7, target: 0.23 }),
    ] {
        let d = distance::<NoReverse>(PROGRAMS[at].1, &kernel);
        assert!(d > 1.5 * LIMIT, "{}: {d} only", PROGRAMS[at].0);
    }
}

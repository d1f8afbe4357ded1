//! Kernels leave the posterior as it is, on continuous programs with bounds, simplexes and angles, and on
//! programs whose choices come and go. (The list of deliberate errors has chains that forget a term of their ratio.)
//!
//! Gandy and Scott 2020, algorithm 1: draw parameters and data from the model, start a chain at those parameters with
//! those data, and make some proposals. The result is again an exact draw from the prior, for any number of
//! proposals; and the draws of different replicates are independent. So each coordinate is compared with fresh prior draws
//! by the two-sample test of Kolmogorov and Smirnov: 4,000 against 4,000, at 2.86 sqrt(2 / 4000), which the true kernel
//! exceeds once in 6 million (Smirnov's bound 2 exp(-2 d^2)); about 300 coordinates are looked at.
//!
//! With several powers each rung must start where it belongs, in the posterior of its own power of the likelihood.
//! Such a state is a draw from the prior, taken with probability (likelihood / its largest value)^power: the data are
//! normal with a known deviation, so the largest value is known. A kernel that holds the score at one power is
//! given data whose deviation is as many times the root of the power.

use super::programs::leaf;
use super::programs::task;
use niwaki_chain::Settings;
use niwaki_chain::kernel::Kernel;
use niwaki_chain::ladder::Ladder;
use niwaki_chain::leaf::Proposer;
use niwaki_chain::walk::state::State;
use niwaki_chain::walk::streams::Streams;
use niwaki_math::StreamKey;
use niwaki_propose::user::User;
use niwaki_run::Task;
use niwaki_run::forward::forward;
use niwaki_run::replay::by_address;
use niwaki_run::select::Selection;
use niwaki_vm::value::Value;
use serde_json::json;
use std::collections::HashMap;
use std::sync::Arc;

const REPLICATES: u64 = 4000;
const PROPOSALS: u64 = 12;
pub const LIMIT: f64 = 2.86;

/// Values of choices by address.
type Known = HashMap<u128, Value>;

/// Each program in two forms: it draws its data (`DATA` is a choice), or observes the data in its arguments.
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

/// The program that draws its data, with so many times the deviation, the one that observes them (`$y`, `$y2`, ...), and how many there are.
pub fn both(text: &str, widened: f64) -> (Task, Task, usize) {
    let wide = |dist: &str| match dist.rsplit_once(' ') {
        Some((head, deviation)) if widened != 1.0 => format!("{head} (mul {widened} {deviation})"),
        _ => dist.to_string(),
    };
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
        drawing += &format!("(set {name} (sample (dist {})))", wide(&behind[..end]));
        observing += &format!("(do (observe (dist {}) {name}))", &behind[..end]);
        names.push(name);
        rest = &behind[end + 1..];
    }
    let filled = |head: &str, body: &str| {
        task(&format!(r#"(module (fn "m" (params {head}) {body}{rest}) (entry "m"))"#))
    };
    (filled("", &drawing), filled(&names.join(" "), &observing), names.len())
}

/// The deviation of the data, where it is constant.
fn deviation(text: &str) -> f64 {
    let data = text.split("DATA(").nth(1).expect("data").lines().next().expect("a line");
    let last = data.trim_end_matches(')').rsplit(' ').next().expect("a deviation");
    last.parse().expect("a constant")
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

/// A draw from the posterior of a power of the likelihood, for a rung of a ladder. The data are normal with a constant
/// deviation.
fn tempered(
    drawing: &Task,
    observing: &Task,
    deviation: f64,
    power: f64,
    replicate: u64,
    rung: u64,
) -> Known {
    let log_largest = -deviation.ln() - 0.5 * std::f64::consts::TAU.ln();
    for attempt in 0..100_000 {
        let seed = (rung << 32) + attempt;
        let run = forward(drawing, seed, replicate, true).expect("a run");
        let known = by_address(&run.log.entries());
        if power == 0.0 {
            return known;
        }
        let (state, _) =
            State::start(observing, Streams::new(4, replicate), 1, Some(&known)).expect("that state");
        let u = StreamKey::new(seed, replicate, 1).at(0).uniform();
        if u.ln() < power * (state.log_score() - log_largest) {
            return known;
        }
    }
    panic!("no draw was taken")
}

/// The largest of the coordinates' Kolmogorov distances, in units of sqrt(2 / n).
pub fn distance(text: &str, kernel: &Kernel) -> f64 {
    distance_of(text, kernel, REPLICATES)
}

/// The largest Kolmogorov distance with this number of replicates.
pub fn distance_of(text: &str, kernel: &Kernel, replicates: u64) -> f64 {
    distance_at(text, kernel, replicates, PROPOSALS, 1.0, &[1.0])
}

/// The largest distance for chains of `proposals` proposals: of a kernel that holds the score at one power, or of a ladder.
fn distance_at(
    text: &str,
    kernel: &Kernel,
    replicates: u64,
    proposals: u64,
    held: f64,
    powers: &[f64],
) -> f64 {
    let (drawing, observing, data) = both(text, (1.0 / held).sqrt());
    let (mut fresh, mut kept): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (vec![], vec![]);
    for replicate in 0..replicates {
        fresh.push(numbers(&forward(&drawing, 1, replicate, true).expect("a run").value));
        let first = forward(&drawing, 2, replicate, true).expect("a run");
        let (choices, values) = (first.log.entries(), numbers(&first.value));
        let args = choices[choices.len() - data..].iter().map(|choice| choice.value.clone()).collect();
        let observed = Task { args, ..observing.clone() };
        let settings = Settings {
            seed: 3 + replicate,
            kernel: kernel.clone(),
            thin: 0,
            powers: powers.to_vec(),
            every: 2,
            ..Settings::default()
        };
        let hotter = (1..)
            .zip(&powers[1..])
            .map(|(rung, power)| tempered(&drawing, &observed, deviation(text), *power, replicate, rung));
        let known: Vec<Known> = std::iter::once(by_address(&choices)).chain(hotter).collect();
        let mut ladder = Ladder::start_at(&observed, &settings, 0, |rung| Some(&known[rung]))
            .expect("the states that were drawn");
        let started = numbers(&ladder.rungs[0].state.trace.result());
        assert_eq!(started[..started.len().min(2)], values[..started.len().min(2)], "the chain starts there");
        ladder.advance(&observed, proposals, &mut |_, _| true).expect("proposals");
        kept.push(numbers(&ladder.rungs[0].state.trace.result()));
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
    let drift = |step| leaf("drift", json!({"step": step, "target": 0.44}));
    let all = || Kernel::Cycle(vec![Kernel::PRIOR, drift(1.0), leaf("regenerate", json!({"levels": 0}))]);
    let weights = Selection { weights: vec![("g".into(), 5.0), ("k".into(), 0.5)], ..Selection::default() };
    let deep = Selection { depth: vec![1.0, 4.0, 2.0], ..Selection::default() };
    vec![
        ("prior", Kernel::PRIOR),
        ("drift", drift(1.0)),
        ("neighbour", leaf("neighbour", json!({"reach": 2}))),
        ("block", leaf("block", json!({"step": 0.5, "share": 0.7, "target": 0.23}))),
        ("regenerate", leaf("regenerate", json!({"levels": 0}))),
        ("regenerate 1", leaf("regenerate", json!({"levels": 1}))),
        ("cycle", all()),
        ("mixture", mixture()),
        ("weights by depth", Kernel::On(deep, Box::new(mixture()))),
        ("weights by site", Kernel::On(weights, Box::new(mixture()))),
    ]
}

fn mixture() -> Kernel {
    let drift = leaf("drift", json!({"step": 0.5, "target": 0.44}));
    Kernel::Mixture(vec![(1.0, Kernel::PRIOR), (2.0, drift), (1.0, leaf("regenerate", json!({"levels": 0})))])
}

#[test]
fn kernels_leave_the_posterior_as_it_is() {
    let mut wrong = String::new();
    for (name, text) in PROGRAMS {
        for (kind, kernel) in kernels() {
            if kind == "weights by site" && name != "a count of terms" {
                continue;
            }
            let d = distance(text, &kernel);
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
    let text = r#"(module (fn "near" (params $old) (return (dist gaussian (mul 0.5 $old) (add 0.3 (mul $old $old))))) (entry "near"))"#;
    let proposal = Kernel::Leaf(Proposer::Proposal(Arc::new(User::new(task(text)).expect("a proposal"))));
    let sites = Selection { sites: vec![vec!["x".into()]], ..Selection::default() };
    let kernel = Kernel::Mixture(vec![(3.0, Kernel::On(sites, Box::new(proposal))), (1.0, Kernel::PRIOR)]);
    let d = distance(PROGRAMS[0].1, &kernel);
    assert!(d < LIMIT, "{d}");
}

#[test]
fn a_kernel_at_one_power_leaves_its_posterior_as_it_is() {
    let held = |power| Kernel::Anneal { start: power, end: power, steps: 9, kernel: Box::new(mixture()) };
    for (name, text) in &PROGRAMS[1..] {
        let d = distance_at(text, &held(0.5), REPLICATES, PROPOSALS, 0.5, &[1.0]);
        assert!(d < LIMIT, "{name}: {d}");
    }
    // A hot kernel, given data as if the power were 1.
    let d = furthest(&[1, 3, 5], &held(0.02));
    assert!(d > 1.1 * LIMIT, "another power: {d} only");
}

#[test]
fn tempering_leaves_the_posterior_as_it_is() {
    let powers = [1.0, 0.5, 0.0];
    for (name, text) in &PROGRAMS[1..] {
        let d = distance_at(text, &mixture(), REPLICATES, PROPOSALS, 1.0, &powers);
        assert!(d < LIMIT, "{name}: {d}");
    }
}

/// The largest distance over some of the programs.
fn furthest(programs: &[usize], kernel: &Kernel) -> f64 {
    programs.iter().map(|at| distance(PROGRAMS[*at].1, kernel)).fold(0.0, f64::max)
}

/// Outside of a warm-up nothing is adapted: a step that shrinks on the narrow peak would no longer lead away from it.
/// Forty proposals, so that it has time to.
#[test]
fn a_step_that_is_not_adapted_leaves_the_posterior_as_it_is() {
    let two = r#"
        (set $x (sample (dist mixture (list 0.5 0.5) (list (dist gaussian 0.0 0.2) (dist gaussian 4.0 1.5)))))
        DATA(gaussian $x 3.0)
        (return (tuple $x (mul $x $y)))"#;
    for kernel in [
        leaf("drift", json!({"step": 3.0, "target": 0.44})),
        leaf("block", json!({"step": 3.0, "share": 1.0, "target": 0.44})),
    ] {
        let d = distance_at(two, &kernel, REPLICATES, 40, 1.0, &[1.0]);
        assert!(d < LIMIT, "{kernel:?}: {d}");
    }
}

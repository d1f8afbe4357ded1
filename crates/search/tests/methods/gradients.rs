//! Recorded programs: the density over coordinates is the program's log joint times the Jacobian of the
//! transforms, its gradient agrees with central differences, and if a guard fails the program is recorded again.

use niwaki_grad::{Live, Native, Recorded, Refused};
use niwaki_propose::gradient::positions::{Lifted, Placer};
use niwaki_propose::gradient::{live, record};
use niwaki_run::forward::forward;
use niwaki_run::replay::{Missing, Source, by_address, replay};
use niwaki_run::{Failure, Task};
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use niwaki_vm::value::Value;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

fn task(body: &str) -> Task {
    let text = format!(r#"(module (fn "m" (params) {body}) (entry "m"))"#);
    let program = compile(&parse(&text).expect("core form"), vec![]).expect("a program");
    Task::new(Arc::new(program))
}

fn choices(task: &Task, seed: u64) -> HashMap<u128, Value> {
    by_address(&forward(task, seed, 0, true).expect("a run").log.entries())
}

/// Log joint of the program itself (each term on the grid of 2^-32).
fn log_joint(task: &Task, choices: HashMap<u128, Value>) -> f64 {
    let trace = replay(task, Source::Addresses(choices), Missing::Refuse).expect("a run");
    trace.sums.0.plus(&trace.sums.1).value()
}

/// The real numbers of a choice's value, except the last share of a simplex.
fn numbers(value: &Value, simplex: bool) -> Vec<f64> {
    let mut all: Vec<f64> = match value {
        Value::Real(x) => vec![*x],
        Value::List(list) => list.iter().map(|v| numbers(v, false)[0]).collect(),
        Value::Tuple(tuple) => tuple.items().iter().map(|v| numbers(v, false)[0]).collect(),
        Value::Vector(v) => v.components().to_vec(),
        other => panic!("{other:?}"),
    };
    if simplex {
        all.pop();
    }
    all
}

fn flat(recorded: &Recorded, x: &[f64]) -> Vec<f64> {
    let values = recorded.values(x);
    let numbers_of =
        |c: &niwaki_grad::Continuous| numbers(&values[&c.address], c.transform.name() == "simplex");
    recorded.choices.iter().flat_map(numbers_of).collect()
}

/// The derivative at 0, by differences of the fourth order.
fn slope(f: &dyn Fn(f64) -> f64, h: f64) -> f64 {
    (f(-2.0 * h) - 8.0 * f(-h) + 8.0 * f(h) - f(2.0 * h)) / (12.0 * h)
}

fn moved(x: &[f64], k: usize, by: f64) -> Vec<f64> {
    let mut point = x.to_vec();
    point[k] += by;
    point
}

/// `ln |det|` of the values' derivatives by the coordinates, from differences, by Gaussian elimination.
fn log_jacobian(recorded: &Recorded, x: &[f64]) -> f64 {
    let n = x.len();
    let entry = |k: usize, i: usize| slope(&|t| flat(recorded, &moved(x, k, t))[i], 1e-3);
    let mut rows: Vec<Vec<f64>> = (0..n).map(|k| (0..n).map(|i| entry(k, i)).collect()).collect();
    let mut log = 0.0;
    for k in 0..n {
        let best = (k..n).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs())).expect("rows");
        rows.swap(k, best);
        log += rows[k][k].abs().ln();
        let pivot = rows[k].clone();
        for row in &mut rows[k + 1..] {
            let share = row[k] / pivot[k];
            row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= share * p);
        }
    }
    log
}

/// Checks a program around a forward run: value, Jacobian, gradient, machine code. Returns the number of points inside.
fn check(body: &str, seed: u64) -> usize {
    let task = task(body);
    let recorded = record(&task, &choices(&task, seed)).unwrap_or_else(|failure| panic!("{body}: {failure}"));
    let (n, density) = (recorded.dim(), &recorded.density);
    assert!(n > 0, "{body}");
    // Near the run and not at it, so that recorded values cannot hide an error.
    let x: Vec<f64> = recorded.start.iter().enumerate().map(|(k, x)| x + 0.01 * (k as f64 + 1.0)).collect();
    let mut g = vec![0.0; n];
    let value = density.interpret(&x, &mut g);
    if density.broken(&x).is_some() {
        return 0;
    }
    let expected = log_joint(&task, recorded.values(&x)) + log_jacobian(&recorded, &x);
    assert!((value - expected).abs() < 1e-7 * expected.abs().max(1.0), "{body}: {value}, not {expected}");
    let size = g.iter().fold(1e-2, |m: f64, x| m.max(x.abs()));
    for (k, derivative) in g.iter().enumerate() {
        let difference = slope(&|t| density.interpret(&moved(&x, k, t), &mut vec![0.0; n]), 1e-3);
        // A step that leaves the guards tests nothing.
        let close = difference.is_nan() || (difference - derivative).abs() < 1e-6 * size;
        assert!(close, "{body}, seed {seed}: {} by differences {difference}", derivative);
    }
    let mut native = Native::compile(density).expect("machine code for this processor");
    let mut h = vec![0.0; n];
    let by_code = native.value_and_gradient(&x, &mut h);
    assert!((by_code - value).abs() < 1e-11 * value.abs().max(1.0), "{body}: {by_code} {value}");
    assert!(g.iter().zip(&h).all(|(a, b)| (a - b).abs() < 1e-11 * size), "{body}: {g:?} {h:?}");
    1
}

const FAMILIES: &[&str] = &[
    "uniform -1.5 2.5",
    "gaussian 0.3 1.7",
    "log_normal 0.2 0.6",
    "gamma 2.3 0.7",
    "inverse_gamma 2.3 0.7",
    "beta 2.2 3.1",
    "exponential 1.7",
    "laplace 0.3 1.2",
    "cauchy 0.2 0.9",
    "student_t 4.5 0.2 1.1",
    "von_mises 0.4 2.5",
    "truncated_gaussian 0.2 1.1 -0.7 1.9",
    "truncated_gaussian 0.2 1.1 1.0 1.9",
    "truncated_gaussian 0.2 1.1 -3.0 -0.4",
    "dirichlet (list 1.2 2.5 0.8 3.0)",
    "dirichlet (list 1.2 2.5)",
    "multivariate_gaussian (list 0.3 -0.5) (list (list 1.2 0.4) (list 0.4 0.9))",
    "diagonal_gaussian (list 0.3 -0.5) (list 1.2 0.4)",
    "mixture (list 0.3 0.7) (list (dist gaussian -1 0.8) (dist gaussian 1.5 1.2))",
    "mixture (list 0.3 0.7) (list (dist uniform -1 2) (dist uniform 0 3))",
    "mixture (list 0.3 0.7) (list (dist gamma 2 1) (dist exponential 1))",
    // Bounded below alone, and not open there as a whole.
    "mixture (list 0.3 0.7) (list (dist gamma 2 1) (dist uniform 0 3))",
];

#[test]
fn each_familys_density_over_coordinates_has_its_jacobian() {
    for family in FAMILIES {
        let body = format!("(set $x (sample (dist {family}))) (return $x)");
        assert!((1..6).map(|seed| check(&body, seed)).sum::<usize>() > 2, "{family}");
    }
}

#[test]
fn parameters_and_bounds_may_depend_on_other_choices() {
    let first = "(set $a (sample (dist uniform 0.5 2.5))) (set $b (sample (dist gamma 3 0.5)))";
    for family in [
        "uniform (neg $a) $b",
        "gaussian $a $b",
        "log_normal $a $b",
        "gamma $a $b",
        "inverse_gamma $a $b",
        "beta $a $b",
        "exponential $a",
        "laplace $a $b",
        "cauchy $a $b",
        "student_t $a $b 0.7",
        "von_mises $a $b",
        "truncated_gaussian $a $b 0.1 3.0",
        "truncated_gaussian 0.4 $b (neg $a) 2.0",
        "dirichlet (list $a $b 1.5)",
        "multivariate_gaussian (list $a $b) (list (list (add 1 $a) 0.4) (list 0.4 (add 0.2 $b)))",
        "diagonal_gaussian (list $a 0.5) (list $b $a)",
        "mixture (list $a $b) (list (dist gaussian $a 0.8) (dist gaussian 1.5 $b))",
    ] {
        let body = format!("{first} (set $x (sample (dist {family}))) (return $x)");
        assert!((1..6).map(|seed| check(&body, seed)).sum::<usize>() > 2, "{family}");
    }
    for seen in [
        "(dist poisson $a) 3",
        "(dist poisson $a) 0",
        "(dist poisson (mul $a 10)) 14",
        "(dist binomial 7 (div $a 3)) 2",
        "(dist geometric (div $a 3)) 4",
        "(dist categorical (list $a $b 0.3)) 1",
        "(dist bernoulli (div $a 3)) 1",
        "(dist bernoulli (div $a 3)) 0",
        "(dist multinomial 6 (list $a $b 0.3)) (tuple 3 1 2)",
        "(dist multinomial 6 (list $a 0.0 $b)) (tuple 6 0 0)",
        "(dist multivariate_bernoulli (list (div $a 3) 0.4)) (tuple true false)",
        "(dist diagonal_gaussian (list $a $b) (list 1.0 $a)) (tuple 0.3 0.7)",
        "(dist gaussian $a $b) 0.7",
        "(dist von_mises $a $b) 0.7",
        "(dist student_t $a 0.1 $b) 0.7",
        "(dist beta $a $b) 0.4",
    ] {
        let body = format!("{first} (do (observe {seen})) (return $a)");
        assert!((1..6).map(|seed| check(&body, seed)).sum::<usize>() > 2, "{seen}");
    }
}

const CORNER: &str = "(set $x (sample (dist gaussian 0 1))) (set $y (sample (dist gaussian 0 1)))
    (if (lt $x $y) (then (do (factor (mul -0.5 (mul $x $x)))))
        (else (do (factor (mul -2.0 (mul (sub $x $y) (sub $x $y)))))))
    (return $x)";

#[test]
fn where_a_guard_fails_the_program_is_recorded_again() {
    let task = task(CORNER);
    let mut live = live(&task, &choices(&task, 1)).expect("a density");
    let mut g = vec![0.0; 2];
    let recorded = record(&task, &choices(&task, 1)).expect("a density");
    assert_eq!(recorded.density.guards().len(), 1);
    for point in [[0.3, 0.9], [0.9, 0.3], [-2.0, 1.0], [2.0, 1.0]] {
        let value = live.value_and_gradient(&point, &mut g).expect("the same choices");
        let expected = log_joint(&task, live.recorded().values(&point));
        assert!((value - expected).abs() < 1e-8, "{point:?}: {value} {expected}");
    }
    assert_eq!(live.recordings(), 2, "each of two paths once");
    let mut native = Native::compile(&recorded.density).expect("machine code for this processor");
    let inside = [[0.3, 0.9], [0.9, 0.3]].map(|x| native.value_and_gradient(&x, &mut g).is_finite());
    assert!(inside[0] != inside[1], "a density holds on one side of its guard");
    assert!(!native.value_and_gradient(&[f64::NAN, 0.0], &mut g).is_finite());
}

#[test]
fn runs_on_a_known_path_need_no_recording() {
    let coin = task(&format!("(set $c (sample (dist bernoulli 0.5))) {CORNER}"));
    let first = live(&coin, &choices(&coin, 1)).expect("a density");
    let mut shared = 0;
    for seed in 2..40 {
        let (other, separate) =
            (choices(&coin, seed), record(&coin, &choices(&coin, seed)).expect("a density"));
        let alike = separate.structure == first.recorded().structure
            && separate.density.guards() == first.recorded().density.guards();
        match first.beside(&other) {
            Some((mut beside, x)) => {
                assert!(alike && beside.recordings() == 0, "{seed}");
                let (mut g, mut expected) = (vec![0.0; 2], vec![0.0; 2]);
                let value = beside.value_and_gradient(&x, &mut g).expect("inside");
                let near = |a: f64, b: f64| (a - b).abs() < 1e-12 * (1.0 + b.abs());
                assert!(near(value, separate.density.interpret(&separate.start, &mut expected)));
                assert!(g.iter().zip(&expected).all(|(a, b)| near(*a, *b)));
                shared += 1;
            }
            None => assert!(!alike, "{seed}"),
        }
    }
    assert!((3..25).contains(&shared), "one of two sides, and one of two coins: {shared}");
}

#[test]
fn where_the_choices_change_the_point_is_refused() {
    let task = task(
        "(set $x (sample (dist gaussian 0 1)))
         (if (lt $x 5) (then (do (factor $x))) (else (set $z (sample (dist gaussian 0 1)))))
         (return $x)",
    );
    let mut live = live(&task, &choices(&task, 1)).expect("a density");
    let refused = |live: &mut Live, x: f64| live.value_and_gradient(&[x], &mut [0.0]).err();
    assert!(refused(&mut live, 1.0).is_none());
    assert!(matches!(refused(&mut live, 6.0), Some(Refused::Structure)));
    assert!(refused(&mut live, 1.0).is_none());
}

#[test]
fn densities_without_gradient_fail_with_the_line() {
    let code = |body: &str| {
        let task = task(body);
        match record(&task, &choices(&task, 1)) {
            Ok(_) => "a density",
            Err(Failure::Run(fault)) => {
                assert!(!fault.stack.is_empty(), "{fault}");
                fault.fault.code
            }
            Err(other) => panic!("{other}"),
        }
    };
    let x = "(set $x (sample (dist gaussian 0 1)))";
    assert_eq!(code(&format!("{x} (do (condition (lt $x -20))) (return $x)")), "impossible-trace");
    assert_eq!(code(&format!("{x} (set $s (str $x)) (return $s)")), "no-derivative");
    assert_eq!(code(&format!("{x} (do (condition (lt $x 20))) (return $x)")), "a density");
}

#[test]
fn equal_rows_of_parameters_keep_slopes_of_their_own() {
    let task = task(
        "(set $a (sample (dist gaussian 0 1))) (set $b (sample (dist gaussian 0 1)))
         (do (observe (dist categorical (list 1.0 (exp $a))) 1))
         (do (observe (dist categorical (list 1.0 (exp $b))) 1)) (return $a)",
    );
    let equal = choices(&task, 1).into_keys().map(|address| (address, Value::Real(0.4))).collect();
    let recorded = record(&task, &equal).expect("a density");
    let mut g = [0.0; 2];
    recorded.density.interpret(&recorded.start, &mut g);
    // The log density of each choice is -x^2 / 2 + x - ln(1 + e^x), but for a constant.
    let slope = 1.0 - 0.4 - 1.0 / (1.0 + (-0.4_f64).exp());
    assert!(g.iter().all(|g| (g - slope).abs() < 1e-12), "{g:?}, expected {slope}");
}

#[test]
fn densities_are_equal_with_and_without_machine_code() {
    let task = task(CORNER);
    let mut live = live(&task, &choices(&task, 1)).expect("a density");
    let mut g = vec![0.0; 2];
    let point = live.recorded().start.clone();
    let before = live.value_and_gradient(&point, &mut g).expect("inside");
    let slope = g.clone();
    assert!(!live.compiled().is_native());
    live.compiled().finish();
    assert!(live.compiled().is_native());
    let after = live.value_and_gradient(&point, &mut g).expect("inside");
    assert!((before - after).abs() < 1e-13 && slope.iter().zip(&g).all(|(a, b)| (a - b).abs() < 1e-13));
}

/// The place of a point of each shape depends on a choice of the program: its derivative by the recorded graph agrees with
/// central differences of the recorded place, and the place with that of the shape.
#[test]
fn derivatives_of_positions_are_central_differences() {
    let task = task(
        r#"(set $a (sample (dist uniform -1.0 1.0)))
           (set $r (sample (dist gaussian 2.0 0.5)))
           (set $turn (rotation (tuple 0 0 1) $a))
           (set $side (mul $turn (vec $r 0.0 1.0)))
           (do (emit (box $side (tuple 1.0 $r 2.0) $turn none none none none)))
           (do (emit (cylinder $side 0.2 $r (vec $a 1.0 $r) none $turn none none)))
           (do (emit (limb (tuple 0 0 0) $side 0.2 0.1 none none none)))
           (do (emit (ellipse (tuple $a 0.0 0.0) $r 0.5 $a none)))
           (do (emit (stroke (tuple 0 0 0) (tuple $a $r 0.0) 0.1 none none)))
           (do (emit (disc (tuple $r $a 0.0) 0.5 none)))"#,
    );
    let (placer, known) = (Placer::new(&task).expect("a task"), choices(&task, 3));
    let free: HashSet<u128> = known.keys().copied().collect();
    let place = |known: &HashMap<u128, Value>, part: usize| {
        let frame = placer.positions(known, &free, &Lifted::default()).expect("a run").frame(part, 0);
        let frame = frame.expect("it moves");
        [0, 1, 2].map(|k| frame[k] + 0.3 * frame[3 + k] - 0.2 * frame[6 + k] + 0.1 * frame[9 + k])
    };
    let positions = placer.positions(&known, &free, &Lifted::default()).expect("a run");
    let count = positions.movables.len();
    assert_eq!((positions.parts.len(), count), (6, 2));
    for part in 0..positions.parts.len() {
        let slopes = positions.slopes(part, 0, [0.3, -0.2, 0.1]).expect("it moves");
        for (k, movable) in positions.movables.iter().enumerate() {
            for axis in 0..3 {
                let at = |by: f64| {
                    let mut known = known.clone();
                    known.insert(movable.address, Value::Real(movable.value + by));
                    place(&known, part)[axis]
                };
                let difference = slope(&at, 1e-4);
                let recorded = slopes[axis * count + k];
                assert!(
                    (difference - recorded).abs() < 1e-9,
                    "part {part}, axis {axis}: {recorded} and not {difference}"
                );
            }
        }
    }
    // The middle of a turned box is its centre, and its second direction the turned side of length r.
    let (a, r) = (positions.movables[0].value, positions.movables[1].value);
    let frame = positions.frame(0, 0).expect("it moves");
    let exact = [r * a.cos(), r * a.sin(), 1.0, a.cos(), a.sin(), 0.0, -r * a.sin(), r * a.cos(), 0.0];
    for (number, exact) in frame.iter().zip(exact) {
        assert!((number - exact).abs() < 1e-12, "{number} and not {exact}");
    }
}

/// If a number of the program moves, a choice that is drawn around it moves too.
#[test]
fn a_choice_keeps_its_place_in_a_distribution_that_moves() {
    let text = r#"(module (fn "m" (params $mean)
        (set $x (sample (dist gaussian $mean 0.5)))
        (set $y (sample (dist uniform 0.0 $x)))
        (do (emit (box (tuple $x $y 0.0) (tuple 1.0 1.0 1.0) none none none none none)))) (entry "m"))"#;
    let program = compile(&parse(text).expect("core form"), vec![]).expect("a program");
    let task = Task { args: vec![Value::Real(3.0)], ..Task::new(Arc::new(program)) };
    let known = choices(&task, 1);
    let lifted = Lifted { arguments: vec![(0, 3.0)], ..Lifted::default() };
    let placer = Placer::new(&task).expect("a task");
    let positions = placer.positions(&known, &HashSet::new(), &lifted).expect("a run");
    let frame = positions.frame(0, 0).expect("it moves");
    let slopes = positions.slopes(0, 0, [0.0; 3]).expect("it moves");
    // x moves by as much as the mean, and y by its share of that.
    assert!((slopes[0] - 1.0).abs() < 1e-12 && (slopes[1] - frame[1] / frame[0]).abs() < 1e-12);
    let moved = positions.followed(&[3.5]);
    let mut values: Vec<f64> = moved.values().copied().collect();
    values.sort_by(f64::total_cmp);
    let mut exact = [frame[0] + 0.5, frame[1] * (frame[0] + 0.5) / frame[0]];
    exact.sort_by(f64::total_cmp);
    assert!(values.iter().zip(exact).all(|(x, y)| (x - y).abs() < 1e-12), "{values:?}");
}

/// Far out on its line a coordinate has the density of its tail, and the program sees a number inside the interval.
#[test]
fn a_value_stays_inside_where_its_coordinate_leaves_the_numbers() {
    // The slopes far below and far above.
    for (dist, below, above) in [
        ("beta 0.2 0.3", 0.2, -0.3),
        ("gamma 0.001 1000.0", 0.001, f64::NEG_INFINITY),
        ("inverse_gamma 0.002 1.0", f64::INFINITY, -0.002),
        ("log_normal 0.0 900.0", 5000.0 / 810_000.0, -5000.0 / 810_000.0),
    ] {
        let task = task(&format!("(set $x (sample (dist {dist}))) (return $x)"));
        let recorded = record(&task, &choices(&task, 1)).expect("a density");
        for (v, slope) in [(-5000.0, below), (5000.0, above)] {
            if slope.is_finite() {
                let mut g = [0.0];
                let value = recorded.density.interpret(&[v], &mut g);
                assert!(value.is_finite() && (g[0] - slope).abs() < 1e-9, "{dist} at {v}: {value} {}", g[0]);
                assert!(recorded.density.broken(&[v]).is_none());
            }
            let (numbers, jacobian) = recorded.numbers_and_slope(&[v]);
            let top = if dist.starts_with("beta") { 1.0 } else { f64::MAX };
            assert!(numbers[0] > 0.0 && numbers[0] < top, "{dist} at {v}: {}", numbers[0]);
            assert!(!slope.is_finite() || jacobian.is_finite());
        }
    }
}

//! Every built-in function and a thousand random graphs against central differences, and every evaluator
//! against the interpreter.

use niwaki_grad::scalar::with_sheet;
use niwaki_grad::{Density, Graph, Id, Native, Op, Tape, Var};
use niwaki_math::Scalar;
use niwaki_vm::builtins::{builtin, builtin_id, builtins};
use niwaki_vm::fault::Fault;
use niwaki_vm::value::Value;

/// A number from 0 to 1 from a counter (splitmix64).
fn unit(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *seed;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Central differences with one step of Richardson's extrapolation: the error falls with the fourth power of `h`.
fn slope(f: &dyn Fn(f64) -> f64, x: f64) -> f64 {
    let h = 1e-3 * x.abs().max(0.1);
    let central = |h: f64| (f(x + h) - f(x - h)) / (2.0 * h);
    (4.0 * central(h / 2.0) - central(h)) / 3.0
}

/// The sum of the real numbers in a value.
fn total<S: Scalar>(value: &Value<S>) -> S {
    let zero = S::from_f64(0.0);
    match value {
        Value::Real(x) => *x,
        Value::Int(n) => S::from_f64(*n as f64),
        Value::Bool(b) => S::from_f64(f64::from(u8::from(*b))),
        Value::Vector(v) => {
            v.components().iter().fold(zero, |sum, x| sum + *x * S::from_f64(1.7) + sum * sum)
        }
        Value::Rotation(r) => r.iter().fold(zero, |sum, x| sum * S::from_f64(0.6) + *x),
        Value::List(list) => list.iter().fold(zero, |sum, x| sum * S::from_f64(0.9) + total(x)),
        Value::Tuple(tuple) => tuple.items().iter().fold(zero, |sum, x| sum * S::from_f64(0.9) + total(x)),
        _ => zero,
    }
}

fn call<S: Scalar>(name: &str, args: &[Value<S>]) -> Result<S, Fault> {
    let id = builtin_id(name).unwrap_or_else(|| panic!("`{name}` is in the table"));
    builtin::<S>(id).call(args).map(|value| total(&value))
}

type Build<S> = fn(&[S]) -> Vec<Value<S>>;

fn reals<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    x.iter().map(|x| Value::Real(*x)).collect()
}

fn listed<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    vec![Value::list(reals(x))]
}

fn vectors<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    x.chunks(3).map(Value::vector).collect()
}

fn turned<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    vec![Value::vector(&x[..3]), Value::Real(x[3])]
}

fn turned_about<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    vec![Value::vector(&x[..3]), Value::vector(&x[3..6]), Value::Real(x[6])]
}

/// A polygon of four corners, and what follows them.
fn cornered<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    vec![Value::list(x[..8].chunks(2).map(Value::vector).collect())]
}

fn around<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    let mut args = cornered(x);
    args.push(Value::vector(&x[8..10]));
    args
}

fn overlapping<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    let mut args = around(x);
    args.push(Value::Real(x[10]));
    args
}

fn shrunk<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    let mut args = cornered(x);
    args.push(Value::Real(x[8]));
    args
}

fn spaced<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    vec![Value::Real(x[0]), Value::Real(x[1]), Value::Int(4)]
}

/// Functions of real numbers, with points at which they have a slope.
macro_rules! cases {
    ($($name:literal $build:ident [$($x:expr),*];)*) => {
        &[$(($name, $build::<f64> as Build<f64>, $build::<Var> as Build<Var>, &[$($x),*] as &[f64])),*]
    };
}

type Case = (&'static str, Build<f64>, Build<Var>, &'static [f64]);

const CASES: &[Case] = cases! {
    "add" reals [0.3, -1.2]; "sub" reals [0.3, -1.2]; "mul" reals [0.3, -1.2]; "div" reals [0.3, -1.2];
    "floordiv" reals [7.3, 2.1]; "mod" reals [7.3, 2.1]; "mod" reals [-7.3, 2.1]; "pow" reals [1.7, 2.3];
    "neg" reals [0.4]; "pos" reals [0.4]; "abs" reals [-0.4]; "abs" reals [0.4]; "fabs" reals [-2.5];
    "divmod" reals [7.3, -2.1]; "clip" reals [0.4, -1.0, 1.0]; "clip" reals [3.4, -1.0, 1.0];
    "clip" reals [-3.0, -1.0, 1.0]; "lerp" reals [0.4, 1.5, 0.3]; "smoothstep" reals [0.7, 0.2, 1.5];
    "linspace" spaced [0.4, 2.0]; "sign" reals [-0.3]; "sign" reals [0.3];
    "float" reals [0.7]; "int" reals [2.7]; "int" reals [-0.7]; "round" reals [2.7]; "floor" reals [-2.3];
    "ceil" reals [2.3]; "trunc" reals [-2.3]; "bool" reals [0.7];
    "sqrt" reals [2.1]; "exp" reals [0.7]; "log" reals [0.7]; "log" reals [3.1, 2.2]; "log2" reals [3.1];
    "log10" reals [3.1]; "log1p" reals [-0.4]; "expm1" reals [0.6]; "sin" reals [0.7]; "cos" reals [0.7];
    "tan" reals [0.7]; "asin" reals [0.3]; "acos" reals [0.3]; "atan" reals [1.3]; "atan2" reals [-0.7, -1.1];
    "sinh" reals [0.8]; "cosh" reals [0.8]; "tanh" reals [0.8]; "hypot" reals [0.3, -0.8, 1.1];
    "degrees" reals [0.4]; "radians" reals [40.0]; "copysign" reals [2.3, -0.5]; "fmod" reals [-7.3, 2.1];
    "fmod" reals [7.3, 2.1]; "math_pow" reals [1.3, -2.2]; "lgamma" reals [2.7]; "lgamma" reals [0.2];
    "lgamma" reals [-1.4]; "erf" reals [0.6];
    "isfinite" reals [0.3]; "isnan" reals [0.3]; "isinf" reals [0.3];
    "eq" reals [0.3, 0.4]; "ne" reals [0.3, 0.4]; "lt" reals [0.3, 0.4]; "le" reals [0.3, 0.4];
    "gt" reals [0.3, 0.4]; "ge" reals [0.3, 0.4]; "not" reals [0.3];
    "sum" listed [0.3, 0.9, -2.0]; "min" listed [0.3, 0.9, -2.0]; "max" listed [0.3, 0.9, -2.0];
    "min" reals [0.3, 0.9]; "max" reals [0.3, 0.9]; "sorted" listed [0.3, 0.9, -2.0];
    "reversed" listed [0.3, 0.9, -2.0]; "any" listed [0.3, 0.9]; "all" listed [0.3, 0.9];
    "to_list" listed [0.3, 0.9]; "to_tuple" listed [0.3, 0.9]; "len" listed [0.3, 0.9];
    "vec" reals [0.3, 0.9, -2.0]; "dot" vectors [0.3, 0.9, -2.0, 1.0, 0.2, 0.4];
    "cross" vectors [0.3, 0.9, -2.0, 1.0, 0.2, 0.4]; "norm" vectors [0.3, 0.9, -2.0];
    "normalize" vectors [0.3, 0.9, -2.0]; "distance" vectors [0.3, 0.9, -2.0, 1.0, 0.2, 0.4];
    "add" vectors [0.3, 0.9, -2.0, 1.0, 0.2, 0.4]; "rotation" turned [0.3, 0.9, -2.0, 0.8];
    "rotate" turned_about [0.3, 0.9, -2.0, 1.0, 0.2, 0.4, 0.8];
    "look" vectors [0.3, 0.9, -2.0, 1.0, 0.2, 0.4]; "look" vectors [0.3, 0.9, -2.0, 1.0, 0.2, 0.4, 0.1, 2.0, 0.3];
    "softeq" reals [0.3, 0.5, 0.4]; "soft_at_least" reals [0.3, 0.5, 0.4]; "soft_at_least" reals [0.9, 0.5, 0.4];
    "soft_at_most" reals [0.3, 0.5, 0.4]; "soft_at_most" reals [0.9, 0.5, 0.4];
    "smooth_max" reals [0.3, 0.5, 0.4]; "smooth_min" reals [0.3, 0.5, 0.4]; "smooth_abs" reals [-0.3, 0.2];
    "hsv" reals [0.3, 0.5, 0.7]; "lab" reals [55.0, 12.0, -20.0]; "to_hsv" vectors [0.3, 0.5, 0.7];
    "to_lab" vectors [0.3, 0.5, 0.7]; "to_lab" vectors [0.02, 0.5, 0.01]; "rgb" vectors [0.3, 0.5, 0.7]; "color_difference" vectors [0.3, 0.5, 0.7, 0.6, 0.4, 0.2];
    "polygon_area" cornered [0.0, 0.1, 2.0, 0.0, 2.3, 1.9, -0.2, 1.7];
    "polygon_contains" around [0.0, 0.1, 2.0, 0.0, 2.3, 1.9, -0.2, 1.7, 0.8, 0.4];
    "polygon_distance" around [0.0, 0.1, 2.0, 0.0, 2.3, 1.9, -0.2, 1.7, 0.8, 0.4];
    "polygon_disc_area" overlapping [0.0, 0.1, 2.0, 0.0, 2.3, 1.9, -0.2, 1.7, 0.8, 0.4, 0.7];
    "polygon_inset" shrunk [0.0, 0.1, 2.0, 0.0, 2.3, 1.9, -0.2, 1.7, 0.2];
};

/// Functions without real numbers: of text, of positions, or whose result is not scored; those that make shapes; and those of
/// frames, whose slopes the tests of drags check.
const WITHOUT: &[&str] = &[
    "is_none",
    "in",
    "band",
    "bor",
    "bxor",
    "invert",
    "shl",
    "shr",
    "index",
    "slice",
    "append",
    "gcd",
    "factorial",
    "comb",
    "argmin_by",
    "argmax_by",
    "sorted_by",
    "enumerate",
    "zip",
    "zip_strict",
    "range",
    "str",
    "repr",
    "format",
    "fstr",
    "method",
    "check_look",
    "options",
    "frame_in",
    "placed",
    "reflection",
    "worn",
];

fn recorded(x: &[f64], f: impl FnOnce(&[Var]) -> Var) -> Density {
    let (value, sheet) = with_sheet(|| f(&x.iter().map(|x| Var::input(*x)).collect::<Vec<_>>()));
    let mut graph = sheet.graph;
    let id = value.id(&mut graph);
    Density::new(graph, id, &sheet.guards)
}

#[test]
fn every_builtin_has_the_slope_of_central_differences_or_none_to_have() {
    for (name, plain, noted, x) in CASES {
        let density =
            recorded(x, |vars| call(name, &noted(vars)).unwrap_or_else(|fault| panic!("{name}: {fault}")));
        let mut g = vec![0.0; x.len()];
        let value = density.interpret(x, &mut g);
        let at = |x: &[f64]| call(name, &plain(x)).unwrap_or(f64::NAN);
        let expected = at(x);
        assert!(
            (value - expected).abs() <= 1e-13 * expected.abs().max(1.0),
            "{name}({x:?}): {value} {expected}"
        );
        for k in 0..x.len() {
            let line = |t: f64| {
                let mut point = x.to_vec();
                point[k] = t;
                at(&point)
            };
            let difference = slope(&line, x[k]);
            let close = (g[k] - difference).abs() <= 1e-6 * difference.abs().max(1e-3);
            assert!(close, "{name}({x:?}) by argument {k}: {} {difference}", g[k]);
        }
        every_evaluator(&density, x);
    }
    for builtin in builtins::<Var>() {
        let is_shape = niwaki_geom::solids::WORDS.iter().any(|word| word.name == builtin.name);
        let known =
            CASES.iter().any(|case| case.0 == builtin.name) || WITHOUT.contains(&builtin.name) || is_shape;
        assert!(known, "`{}` is neither checked nor known to have no slope", builtin.name);
    }
}

#[test]
fn a_recording_holds_wherever_its_guards_do() {
    // A function that decides by a number without a guard fails at points where it would decide differently.
    let (mut seed, mut inside) = (5, 0);
    for (name, plain, noted, x) in CASES {
        let density =
            recorded(x, |vars| call(name, &noted(vars)).unwrap_or_else(|fault| panic!("{name}: {fault}")));
        for _ in 0..300 {
            let wide = 10f64.powf(-2.0 + 2.5 * unit(&mut seed));
            let point: Vec<f64> =
                x.iter().map(|x| x + wide * x.abs().max(0.3) * (2.0 * unit(&mut seed) - 1.0)).collect();
            let Ok(expected) = call(name, &plain(&point)) else { continue };
            if density.broken(&point).is_some() {
                continue;
            }
            inside += 1;
            let value = density.interpret(&point, &mut vec![0.0; x.len()]);
            let close = (value - expected).abs() <= 1e-9 * expected.abs().max(1.0);
            assert!(close, "{name} recorded at {x:?}, at {point:?}: {value}, not {expected}");
        }
    }
    assert!(inside > 100 * CASES.len(), "{inside}");
}

fn pairs<S: Scalar>(x: &[S]) -> Value<S> {
    Value::list(x.chunks(2).map(|pair| Value::tuple(reals(pair))).collect())
}

fn points<S: Scalar>(x: &[S]) -> Value<S> {
    Value::list(x.chunks(3).map(Value::vector).collect())
}

fn prism<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    vec![pairs(&x[..10]), Value::Real(x[10]), Value::None, Value::Real(x[11])]
}

fn swept<S: Scalar>(x: &[S]) -> Vec<Value<S>> {
    vec![pairs(&x[..6]), points(&x[6..18]), Value::Real(x[18])]
}

/// Words for solids of lists of points, and numbers that make one.
type Solid = (&'static str, Build<f64>, Build<Var>, &'static [f64]);
const SOLIDS: &[Solid] = &[
    ("extrude", prism, prism, &[0.0, 0.0, 3.0, 0.1, 3.2, 3.0, 2.0, 1.0, 0.3, 2.0, 1.5, 20.0]),
    ("revolve", |x| vec![pairs(x)], |x| vec![pairs(x)], &[0.5, 0.0, 1.0, 0.5, 0.4, 1.0, 0.8, 2.0]),
    (
        "sweep",
        swept,
        swept,
        &[0.2, 0.0, 0.1, 0.3, -0.2, 0.1, 0.0, 0.0, 0.1, 1.0, 0.2, 0.0, 1.2, 0.9, 0.3, 1.0, 1.8, 0.9, 0.7],
    ),
    (
        "hull",
        |x| vec![points(x)],
        |x| vec![points(x)],
        &[0.0, 0.1, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.3, 0.3, 0.4],
    ),
];

#[test]
fn a_recording_of_a_solid_ends_before_its_points_make_none() {
    let mut seed = 7;
    for (name, plain, noted, x) in SOLIDS {
        let density =
            recorded(x, |vars| call(name, &noted(vars)).unwrap_or_else(|fault| panic!("{name}: {fault}")));
        assert!(density.broken(x).is_none(), "{name}");
        let mut none = 0;
        for _ in 0..400 {
            let wide = 10f64.powf(-2.0 + 2.5 * unit(&mut seed));
            let far: Vec<f64> =
                x.iter().map(|x| x + wide * x.abs().max(0.3) * (2.0 * unit(&mut seed) - 1.0)).collect();
            // Points on the way there, as a trajectory meets them: a hull has none only in a plane, which it crosses.
            let at =
                |share: f64| -> Vec<f64> { x.iter().zip(&far).map(|(a, b)| a + (b - a) * share).collect() };
            let end =
                (1..=20).map(|k| f64::from(k) / 20.0).find(|share| call(name, &plain(&at(*share))).is_err());
            if let Some(end) = end {
                none += 1;
                assert!(density.broken(&at(end)).is_some(), "{name} at {:?}", at(end));
            }
        }
        assert!(none > 40 || *name == "hull", "{name}: {none}");
    }
    // On its way to the other side of the other three a point of a hull passes their plane.
    let (_, _, noted, x) = SOLIDS[3];
    let density = recorded(x, |vars| call("hull", &noted(vars)).expect("a hull"));
    let mut across = x.to_vec();
    across[11] = -0.4;
    assert!(density.broken(&across).is_some());
}

#[test]
fn operations_without_derivative_fail_for_numbers_that_vary() {
    let (codes, _) = with_sheet(|| {
        let x = Var::input(0.5);
        let code = |name: &str, args: &[Value<Var>]| call(name, args).err().map(|fault| fault.code);
        (
            code("str", &[Value::Real(x)]),
            code("format", &[Value::Real(x)]),
            code("round", &[Value::Real(x), Value::Int(1)]),
            code("str", &[Value::real(0.5)]),
        )
    });
    assert_eq!(codes, (Some("no-derivative"), Some("no-derivative"), Some("no-derivative"), None));
}

/// Asserts that the tape, alone and in lanes, and the machine code agree with the interpreter.
fn every_evaluator(density: &Density, x: &[f64]) {
    let mut expected = vec![0.0; x.len()];
    let value = density.interpret(x, &mut expected);
    let size = expected.iter().chain([&value]).fold(1e-3, |m: f64, x| m.max(x.abs()));
    let check = |evaluator: &str, actual: f64, g: &[f64]| {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-11 * size || a.is_nan() && b.is_nan();
        assert!(near(actual, value), "{evaluator}: {actual} {value}");
        assert!(g.iter().zip(&expected).all(|(a, b)| near(*a, *b)), "{evaluator}: {g:?} {expected:?}");
    };
    let tape = Tape::new(density);
    let mut g = vec![0.0; x.len()];
    let actual = tape.lanes::<1>().at_point(&tape, x, &mut g);
    check("tape", actual, &g);
    let rows: Vec<[f64; 16]> = x.iter().map(|x| [*x; 16]).collect();
    let mut many = vec![[0.0; 16]; x.len()];
    let actual = tape.lanes::<16>().value_and_gradient(&tape, &rows, &mut many);
    let last: Vec<f64> = many.iter().map(|row| row[15]).collect();
    check("lanes", actual[15], &last);
    let bits =
        |value: f64, g: &[f64]| -> Vec<u64> { g.iter().chain([&value]).map(|x| x.to_bits()).collect() };
    let by_tape = bits(actual[15], &last);
    let mut native = Native::compile(density).expect("machine code for this processor");
    let actual = native.value_and_gradient(x, &mut g);
    check("machine code", actual, &g);
    let sound = |g: &[f64]| g.iter().chain([&actual]).all(|x| !x.is_nan());
    // To the bit, so that a chain does not depend on the evaluator.
    assert!(!sound(&g) || bits(actual, &g) == by_tape, "machine code and tape differ: {g:?} {last:?}");
    if native.gradient(x, &mut g) {
        check("machine code without the value", value, &g);
        assert!(!sound(&g) || bits(actual, &g) == by_tape, "without the value: {g:?} {last:?}");
    }
}

/// A random graph whose values stay near one, so that differences keep their digits.
fn random(seed: &mut u64) -> (Graph, Id, Vec<f64>) {
    let mut g = Graph::new();
    let dim = 2 + (unit(seed) * 4.0) as usize;
    let x: Vec<f64> = (0..dim).map(|_| 2.0 * unit(seed) - 1.0).collect();
    let mut ids: Vec<Id> = (0..dim).map(|_| g.input()).collect();
    for _ in 0..25 {
        let n = ids.len();
        let mut pick = || ids[(unit(seed) * n as f64) as usize];
        let (a, b, t) = (pick(), pick(), pick());
        // Squashed to (0.5, 1.5), where every function is smooth.
        let squash = |g: &mut Graph, id: Id| {
            let (flat, half, unity) = (g.unary(Op::Tanh, id), g.constant(0.5), g.constant(1.0));
            let scaled = g.mul(half, flat);
            g.add(unity, scaled)
        };
        let unary = [
            Op::Sqrt,
            Op::Exp,
            Op::Log,
            Op::Log1p,
            Op::Expm1,
            Op::Sin,
            Op::Cos,
            Op::Tan,
            Op::Atan,
            Op::Sinh,
            Op::Cosh,
            Op::Tanh,
            Op::LnGamma,
            Op::Erf,
            Op::Erfcx,
            Op::LnBesselI0e,
            Op::Neg,
            Op::Abs,
        ];
        let next = match (unit(seed) * 9.0) as usize {
            0 => g.add(a, b),
            1 => g.sub(a, b),
            2 => {
                let a = g.unary(Op::Tanh, a);
                g.mul(a, b)
            }
            3 => {
                let below = squash(&mut g, b);
                let above = g.unary(Op::Tanh, a);
                g.div(above, below)
            }
            4 => {
                let (base, power) = (squash(&mut g, a), squash(&mut g, b));
                g.pow(base, power)
            }
            5 => {
                let test = g.binary(Op::Less, a, b);
                let (yes, no) = (g.unary(Op::Sin, t), g.unary(Op::Cos, b));
                g.select(test, yes, no)
            }
            6 => {
                let op = [Op::Min, Op::Max, Op::Atan2][(unit(seed) * 3.0) as usize];
                let a = squash(&mut g, a);
                g.binary(op, a, b)
            }
            _ => {
                let op = unary[(unit(seed) * unary.len() as f64) as usize];
                let a = squash(&mut g, a);
                g.unary(op, a)
            }
        };
        ids.push(next);
    }
    let zero = g.constant(0.0);
    let value = ids.iter().rev().take(8).fold(zero, |sum, id| {
        let flat = g.unary(Op::Tanh, *id);
        g.add(sum, flat)
    });
    (g, value, x)
}

#[test]
fn a_thousand_random_graphs_have_the_slopes_of_central_differences() {
    let (mut seed, mut skipped) = (20_240_611, 0);
    for round in 0..1000 {
        let (graph, value, x) = random(&mut seed);
        let density = Density::new(graph, value, &[]);
        let mut g = vec![0.0; x.len()];
        density.interpret(&x, &mut g);
        let at = |x: &[f64]| density.interpret(x, &mut vec![0.0; x.len()]);
        let size = g.iter().fold(1e-2, |m: f64, g| m.max(g.abs()));
        for k in 0..x.len() {
            let line = |t: f64| {
                let mut point = x.clone();
                point[k] = t;
                at(&point)
            };
            let h = 1e-3;
            let (left, right) = ((line(x[k]) - line(x[k] - h)) / h, (line(x[k] + h) - line(x[k])) / h);
            // A select or a corner is within the step, so differences do not give the slope.
            if (left - right).abs() > 0.05 * size {
                skipped += 1;
                continue;
            }
            let difference = slope(&line, x[k]);
            let coarse = (right + left) / 2.0;
            if (coarse - difference).abs() > 1e-3 * size {
                skipped += 1;
                continue;
            }
            assert!((g[k] - difference).abs() < 1e-6 * size, "{round}, {k}: {} {difference}", g[k]);
        }
        if round % 10 == 0 {
            every_evaluator(&density, &x);
        }
    }
    assert!(skipped < 350, "{skipped} of about 3500 derivatives are at corners");
}

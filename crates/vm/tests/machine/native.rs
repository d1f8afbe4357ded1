//! The claim: machine code computes the same values to the last bit, raises the same faults at the same place,
//! and takes the same steps as the interpreter.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

#[path = "../support/halves.rs"]
mod halves;

use halves::Halves;
use niwaki_math::{Dist, LastLogs, StreamKey};
use niwaki_vm::code::Program;
use niwaki_vm::core::parse::parse;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::held::Held;
use niwaki_vm::machine::{Limits, Machine};
use niwaki_vm::passes::compile;
use niwaki_vm::value::{Range, Value, repr};
use std::sync::Arc;

/// Answers that draw every choice from its distribution, and note all that happens in its order.
#[derive(Default)]
struct Drawn {
    events: Vec<String>,
    /// How many choices machine code has asked for.
    by_code: usize,
    /// Whether the run pauses at each factor.
    pauses: bool,
}

impl Drawn {
    fn draw(&mut self, address: u128, dist: &Dist) -> Value {
        let (draw, log) = dist.sample_and_score(&mut StreamKey::new(7, 0, 0).at(address));
        self.events.push(format!("{address} {draw:?} {log:?}"));
        draw.into()
    }

    fn note(&mut self, log: f64) -> Answer<()> {
        self.events.push(format!("factor {log:?}"));
        if self.pauses { Answer::Pause } else { Answer::Go(()) }
    }
}

impl Answers<f64> for Drawn {
    const LOGS: bool = true;
    const DRAWS: bool = true;

    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        Ok(Answer::Go(self.draw(at.address(), dist)))
    }

    fn drawn(&mut self, address: u128, dist: &Dist, logs: &mut LastLogs<f64>) -> Option<Value> {
        self.by_code += 1;
        let known = dist.sample_and_score_with(&mut StreamKey::new(7, 0, 0).at(address), logs);
        assert_eq!(known, dist.sample_and_score(&mut StreamKey::new(7, 0, 0).at(address)));
        Some(self.draw(address, dist))
    }

    fn score(&mut self, _: &At<'_, f64>, _: Factor, log: f64) -> Result<Answer<()>, Fault> {
        Ok(self.note(log))
    }

    fn scored(&mut self, log: f64) -> Answer<()> {
        self.note(log)
    }

    fn host(&mut self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        Ok(args[0].clone())
    }
}

/// The result of a run, or the fault with its stack; the steps of the run, and the bytes that it is charged.
type Outcome = (String, u64, usize);

fn outcome(program: &Program, limits: Limits) -> Outcome {
    outcome_by(program, limits, None, &mut Drawn::default())
}

/// The outcome of a run by these answers, which continues where they pause it.
fn outcome_by(program: &Program, limits: Limits, held: Option<&Held>, answers: &mut Drawn) -> Outcome {
    let mut machine = Machine::new(program, limits).holding(held);
    let mut state = machine.start(&[], true).unwrap();
    match machine.finish(&mut state, answers) {
        Ok(()) => (repr(&state.result()).unwrap().to_string(), state.steps(), state.bytes()),
        Err(fault) => (format!("{fault:?}"), state.steps(), state.bytes()),
    }
}

/// Checks that runs with and without machine code agree, with all limits of steps up to a number. Returns the
/// result.
fn agree(text: &str, most: u64) -> String {
    let program = compile::<f64>(&parse(text).unwrap(), vec![]).unwrap();
    let (plain, quick) = (program.clone().with_machine_code_after(0), program.with_machine_code_after(1));
    for steps in (0..most).chain([20_000_000]) {
        let limits = Limits { steps, ..Limits::default() };
        assert_eq!(outcome(&plain, limits), outcome(&quick, limits), "{steps} steps of {text}");
    }
    outcome(&quick, Limits::default()).0
}

/// Runs continue while their code is written; the code changes nothing in them.
#[test]
fn a_run_does_not_wait_for_its_code() {
    if std::env::var_os("NIWAKI_JIT").is_some() {
        return;
    }
    let text = entry(
        "(set $l (list 1.5 2 (vec 1.0 2.0))) (set $s 0) (for $i (range 1000) (body (set $s (add $s (mul $i (index $l (mod $i 2))))))) (return $s)",
    );
    let program = compile::<f64>(&parse(&text).unwrap(), vec![]).unwrap();
    let expected = outcome(&program.clone().with_machine_code_after(0), Limits::default());
    let start = std::time::Instant::now();
    while program.machine_code() == 0 {
        assert!(start.elapsed().as_secs() < 120, "no code was written");
        assert_eq!(outcome(&program, Limits::default()), expected);
    }
    assert_eq!(outcome(&program, Limits::default()), expected);
}

fn entry(body: &str) -> String {
    format!("(module (fn \"m\" (params) {body}) (entry \"m\"))")
}

#[test]
fn loops_of_numbers_agree() {
    let sum = entry("(set $s 0) (for $i (range 1000) (body (set $s (add $s (mul $i 0.5))))) (return $s)");
    assert_eq!(agree(&sum, 40), "249750.0");
}

#[test]
fn a_variable_may_change_its_kind() {
    let text = entry("(set $x 0) (for $i (range 9) (body (set $x (add $x 0.25)))) (return $x)");
    assert_eq!(agree(&text, 20), "2.25");
    let text = entry(
        "(set $x none) (for $i (range 9) (body (if (is_none $x) (then (set $x $i)) (else (set $x (div $x 2)))))) (return $x)",
    );
    assert_eq!(agree(&text, 20), "0.0");
}

#[test]
fn a_whole_number_without_an_exact_real_is_compared_exactly() {
    let text = entry(
        "(set $n 9007199254740993) (set $x 9007199254740992.0) (set $k 0) (for $i (range 9) (body (if (gt $n $x) (then (set $k (add $k 1)))))) (return $k)",
    );
    assert_eq!(agree(&text, 20), "9");
}

#[test]
fn whole_numbers_are_divided_as_python_does() {
    let text = entry(
        "(set $all 0) (for $i (range -9 9) (body (set $all (add (mul 3 $all) (add (floordiv $i 4) (mul 2 (mod $i 5))))) (set $all (mod $all 1000003)))) (return $all)",
    );
    agree(&text, 40);
    let text =
        entry("(set $x 0.0) (for $i (range -9 9) (body (set $x (add (mul 0.5 $x) (div $i 7))))) (return $x)");
    agree(&text, 40);
}

#[test]
fn faults_agree_with_the_interpreter() {
    let cases = [
        (
            "(set $x 9) (while true (body (set $x (sub $x 1)) (set $y (div 1 $x)))) (return 0)",
            "division-by-zero",
        ),
        ("(set $x 1) (while true (body (set $x (mul $x 3)))) (return 0)", "integer-overflow"),
        ("(set $x 1) (while true (body (set $x (add $x $x)))) (return 0)", "integer-overflow"),
        ("(set $x -1) (while true (body (set $x (sub $x (mul -1 $x))))) (return 0)", "integer-overflow"),
        (
            "(set $x 1.0) (while true (body (set $x (sub $x 0.25)) (set $y (sqrt $x)))) (return 0)",
            "math-domain",
        ),
        (
            "(set $l (list 1 2 3)) (set $k 0) (while true (body (set $y (index $l $k)) (set $k (add $k 1)))) (return 0)",
            "list-index",
        ),
        ("(set $x 2.0) (while true (body (set $x (pow $x 2)))) (return 0)", "float-overflow"),
        ("(set $x 0) (while true (body (set $x (add $x 1)))) (return 0)", "step-budget"),
        (
            "(set $x 0) (for $i (range 9) (body (if (eq $i 6) (then (set $x \"a\"))) (set $x (add $x 1)))) (return 0)",
            "type-mismatch",
        ),
    ];
    for (body, code) in cases {
        let outcome = agree(&entry(body), 30);
        assert!(outcome.contains(code), "{outcome}");
    }
}

#[test]
fn a_call_in_progress_is_in_the_stack_of_a_fault() {
    let text = "(module (fn \"half\" (params $x) (return (div 1.0 $x)))
        (fn \"twice\" (params $x) (set $y (call \"half\" $x)) (return (mul 2 $y)))
        (fn \"m\" (params) (set $x 8) (while true (body (set $x (sub $x 1)) (set $z (call \"twice\" $x)))) (return 0))
        (entry \"m\"))";
    let outcome = agree(text, 60);
    assert!(["half", "twice", "division-by-zero"].iter().all(|word| outcome.contains(word)), "{outcome}");
}

#[test]
fn elements_of_shared_values_agree() {
    let text = entry(
        "(set $rows (list (tuple 1.5 2) (tuple 2.5 3) (tuple 3.5 4))) (set $s 0) (set $last none)
         (for $k (range 5) (body (for $row $rows (body (set $last $row) (set $s (add $s (mul (index $row 0) (index $row 1))))))))
         (return (tuple $s $last))",
    );
    assert_eq!(agree(&text, 40), "(122.5, (3.5, 4))");
    let text = entry(
        "(set $v (vec 1.0 2.0 3.0)) (set $s 0.0) (for $k (range 5) (body (for $x $v (body (set $s (add $s $x)))))) (return $s)",
    );
    assert_eq!(agree(&text, 40), "30.0");
}

#[test]
fn fields_of_records_and_fresh_values_agree() {
    let text = "(module (class 0 \"P\" (\"x\" \"y\") namedtuple) (fn \"m\" (params)
        (set $ps (list (record 0 1.5 2) (record 0 2.5 (list 7)))) (set $s 0) (set $v (vec 1.0 2.0)) (set $w $v) (set $kept none)
        (for $k (range 6) (body (set $p (index $ps (mod $k 2))) (set $s (add $s (field $p \"x\")))
            (set $v (mul $v 0.5)) (set $w $v) (set $kept (tuple $s $k))
            (set $y (field $p \"y\"))))
        (return (tuple $s $v $w $kept $y $p))) (entry \"m\"))";
    let outcome = agree(text, 30);
    assert!(
        outcome.starts_with("(12.0, vec(0.015625, 0.03125), vec(0.015625, 0.03125), (12.0, 5), [7]"),
        "{outcome}"
    );
}

/// Code for one kind is refused for every other kind, be it by the tag or by the length of a vector.
#[test]
fn code_runs_only_for_its_kinds() {
    let values = [
        "none",
        "true",
        "2",
        "0.5",
        "\"a\"",
        "(tuple 1 (list 2))",
        "(list 1 2)",
        "(record 0 1 2)",
        "(range 1 9 3)",
        "(vec 3.0 4.0)",
        "(vec 1.0 2.0 2.0)",
        "(vec 1.0 1.0 1.0 1.0)",
    ];
    for (a, b) in values.iter().flat_map(|a| values.iter().map(move |b| (a, b))) {
        let size = if [a, b].iter().all(|value| value.starts_with("(vec")) { "(norm $x)" } else { "0" };
        let text = format!(
            "(module (class 0 \"P\" (\"x\" \"y\") namedtuple)
             (fn \"f\" (params $x) (set $n 0) (set $y none) (while (lt $n 3) (body (set $n (add $n 1)) (set $z $y)
                (set $s {size}) (set $y $x))) (return (tuple $x $y $z $s)))
             (fn \"m\" (params) (set $a (call \"f\" {a})) (set $b (call \"f\" {b})) (set $c (call \"f\" {a}))
                (return (tuple $a $b $c))) (entry \"m\"))"
        );
        agree(&text, 12);
    }
}

/// Shared values change places in registers of the machine and of an activation, and numbers replace them; then
/// nobody holds them any more.
#[test]
fn overwritten_values_are_dropped() {
    for choice in ["", "(set $u (sample (dist uniform 0.0 1.0)))"] {
        let text = format!(
            "(module (fn \"m\" (params $r) {choice} (set $x $r) (set $y (list 1 $r)) (set $z (vec 1.0 2.0)) (set $k 0)
                (while (lt $k 9) (body (set $k (add $k 1)) (set $z $x) (set $x $y) (set $y $z) (set $w (tuple $k $k)) (set $v $w)
                    (if (eq $k 6) (then (set $z \"a\") (set $w $z))) (if (gt $k 6) (then (set $y 0.5)))))
                (return (tuple $x $y $z $w $v))) (entry \"m\"))"
        );
        let program = compile::<f64>(&parse(&text).unwrap(), vec![]).unwrap();
        let range = Arc::new(Range::new(0, 9, 2).unwrap());
        let [interpreted, compiled] = [0, 1].map(|visits| {
            let program = program.clone().with_machine_code_after(visits);
            let mut machine = Machine::new(&program, Limits::default());
            let mut state = machine.start(&[Value::Range(range.clone())], true).unwrap();
            machine.finish(&mut state, &mut Halves).unwrap();
            repr(&state.result()).unwrap().to_string()
        });
        assert_eq!(interpreted, compiled);
        assert_eq!(Arc::strong_count(&range), 1);
    }
}

/// A walk that branches: choices of families with and without code of their own, with parameters that are constants and
/// others, a factor after each step, and calls, of which the last passes shared data back.
const WALK: &str = r#"(module
    (const 0 (dist categorical (list 0.2 0.3 0.5)))
    (fn "walk" (params $x $sd $n)
        (set $y (sample (dist gaussian $x $sd))) (set $u (sample (dist uniform -1 $n)))
        (set $k (sample (data 0))) (set $g (sample (dist gamma 2.0 1.5)))
        (set $z (add (mul $u $k) (mul 0.125 $g)))
        (do (factor (sub 0.5 (mul $z 0.25))))
        (set $p (tuple $y (list $z)))
        (if (sample (dist bernoulli (div $n 20))) (then (set $z (add $z 1.0))))
        (if (gt $n 1) (then (set $r (call "walk" (add $y $z) (sub $sd 0.0625) (sub $n 1)))
            (set $z (add $z (index $r 0)))
            (return (call "walk" $z (sub $sd 0.0625) (sub $n 2)))))
        (return $p))
    (fn "m" (params) (return (call "walk" 0.0 SD N))) (entry "m"))"#;

fn walk(sd: &str, n: usize) -> [Program; 2] {
    let text = WALK.replace("SD", sd).replace('N', &n.to_string());
    let program = compile::<f64>(&parse(&text).unwrap(), vec![]).unwrap();
    [program.clone().with_machine_code_after(0), program.with_machine_code_after(1)]
}

/// Machine code makes the choices, and their order, values, densities and bytes are those of the interpreter; also
/// where the run pauses at factors, and where its steps or bytes end.
#[test]
fn choices_agree() {
    let [plain, quick] = walk("1.0", 8);
    let most = outcome(&plain, Limits::default());
    for pauses in [false, true] {
        for limits in (0..most.1 + 2)
            .map(|steps| Limits { steps, ..Limits::default() })
            .chain((most.2 / 2..most.2 + 8192).step_by(97).map(|bytes| Limits { bytes, ..Limits::default() }))
        {
            let [mut interpreted, mut compiled] = [(); 2].map(|()| Drawn { pauses, ..Drawn::default() });
            let expected = outcome_by(&plain, limits, None, &mut interpreted);
            assert_eq!(outcome_by(&quick, limits, None, &mut compiled), expected, "{limits:?}");
            assert_eq!(compiled.events, interpreted.events, "{limits:?}");
            assert!(interpreted.by_code == 0 && (compiled.by_code > 0 || limits != Limits::default()));
        }
    }
    let mut compiled = Drawn::default();
    outcome_by(&quick, Limits::default(), None, &mut compiled);
    assert!(compiled.by_code > 200, "{} choices by machine code", compiled.by_code);
}

/// Code leaves before a choice whose parameters have no distribution: the fault is at its place, with the calls
/// around it, after the same choices.
#[test]
fn a_fault_of_a_choice_agrees() {
    let [plain, quick] = walk("0.25", 6);
    let [mut interpreted, mut compiled] = [Drawn::default(), Drawn::default()];
    let expected = outcome_by(&plain, Limits::default(), None, &mut interpreted);
    assert!(expected.0.contains("bad-parameter") && expected.0.contains("`sd` of gaussian is 0.0"));
    for _ in 0..3 {
        compiled = Drawn::default();
        assert_eq!(outcome_by(&quick, Limits::default(), None, &mut compiled), expected);
        assert_eq!(compiled.events, interpreted.events);
    }
    assert!(interpreted.events.len() > 8 && compiled.by_code > 8);
}

/// Activations that ended with a call hold nothing, also where the call has returned shared data to them: with held
/// choices each of them returns by itself.
#[test]
fn callers_that_return_hold_nothing() {
    let text = "(module (fn \"f\" (params $r $n) (set $u (sample (dist uniform 0.0 1.0)))
            (if (gt $n 0) (then (return (call \"f\" $r (sub $n 1))))) (return $r))
        (fn \"m\" (params $r) (set $a (call \"f\" $r 4)) (do (factor (index $a 0))) (set $b (call \"f\" $r 4))
            (return (index $b 1))) (entry \"m\"))";
    let program = compile::<f64>(&parse(text).unwrap(), vec![]).unwrap();
    let held = Held::new(&program, vec![("f/u".into(), Value::real(0.25))]).unwrap();
    for (visits, held) in [(0, None), (1, None), (0, Some(&held)), (1, Some(&held))] {
        let program = program.clone().with_machine_code_after(visits);
        let range = Arc::new(Range::new(0, 9, 2).unwrap());
        let mut machine = Machine::new(&program, Limits::default()).holding(held);
        let mut state = machine.start(&[Value::Range(range.clone())], true).unwrap();
        machine.finish(&mut state, &mut Drawn::default()).unwrap();
        assert_eq!(repr(&state.result()).unwrap().to_string(), "2");
        // The arguments of the run are the other owner.
        assert_eq!(Arc::strong_count(&range), 2);
    }
}

/// A run with held choices asks the interpreter for all of them.
#[test]
fn a_held_choice_leaves_to_the_interpreter() {
    let [plain, quick] = walk("1.0", 4);
    let path = "walk/walk/y".to_string();
    let held = Held::new(&plain, vec![(path, Value::real(0.25))]).unwrap();
    let [mut interpreted, mut compiled] = [Drawn::default(), Drawn::default()];
    let expected = outcome_by(&plain, Limits::default(), Some(&held), &mut interpreted);
    for _ in 0..3 {
        outcome(&quick, Limits::default());
        compiled = Drawn::default();
        assert_eq!(outcome_by(&quick, Limits::default(), Some(&held), &mut compiled), expected);
        assert_eq!(compiled.events, interpreted.events);
    }
    let factors = interpreted.events.iter().filter(|event| event.starts_with("factor")).count();
    let choices = interpreted.events.len() - factors;
    // Five choices and a factor in each activation; the held choice is a factor.
    assert_eq!((factors, choices, compiled.by_code), (10, 44, 0));
}

/// Writes random programs: numbers, loops, branches, calls, elements; sometimes a fault.
struct Writer {
    dice: u64,
    text: String,
    depth: usize,
    loops: usize,
    /// Whether the function makes choices.
    chooses: bool,
}

impl Writer {
    fn roll(&mut self, n: u64) -> u64 {
        self.dice = self.dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.dice >> 33) % n
    }

    fn variable(&mut self) -> &'static str {
        ["$a", "$b", "$c", "$d"][self.roll(4) as usize]
    }

    fn expression(&mut self, depth: usize) -> String {
        let kind = self.roll(if depth == 0 { 4 } else { 21 });
        let (a, b) = if kind > 3 {
            (self.expression(depth - 1), self.expression(depth - 1))
        } else {
            (String::new(), String::new())
        };
        match kind {
            0 | 1 => self.variable().into(),
            2 => format!("{}", self.roll(7) as i64 - 2),
            3 => {
                ["0.5", "-1.25", "3.0", "true", "1e200", "4611686018427387904"][self.roll(6) as usize].into()
            }
            4..=8 => format!("({} {a} {b})", ["add", "sub", "mul", "add", "sub"][self.roll(5) as usize]),
            9 => format!("(div {a} {b})"),
            10 => format!("({} {a} {b})", ["mod", "floordiv", "pow"][self.roll(3) as usize]),
            11 => format!("({} {a} {b})", ["lt", "le", "eq", "ne", "gt", "ge"][self.roll(6) as usize]),
            12 => format!(
                "({} {a})",
                ["neg", "not", "abs", "float", "int", "floor", "round"][self.roll(7) as usize]
            ),
            13 => {
                format!("({} {a})", ["sin", "sqrt", "exp", "log", "is_none", "sign"][self.roll(6) as usize])
            }
            14 => format!("({} {a} {b})", ["min", "max", "atan2", "hypot"][self.roll(4) as usize]),
            15 => format!("(index $l (mod {a} 4))"),
            16 => format!("(dot {} {})", self.vector(), self.vector()),
            17 => format!("({} {})", ["norm", "len"][self.roll(2) as usize], self.vector()),
            18 => format!("(index {} {})", self.vector(), self.roll(3)),
            19 => format!("(field {} {})", self.vector(), ["x", "y", "z"][self.roll(3) as usize]),
            _ => format!("(call \"f{}\" {a} {b})", self.roll(2)),
        }
    }

    fn vector(&mut self) -> String {
        let (a, b) = (self.variable(), self.variable());
        match self.roll(14) {
            0..=2 => "$v".into(),
            3..=5 => "$w".into(),
            6 => format!("(vec {a} {b} 0.5)"),
            7 => format!("(vec {a} {b})"),
            8 => format!("({} $v $w)", ["add", "sub", "cross"][self.roll(3) as usize]),
            9 => format!("(mul $v {a})"),
            10 => format!("(mul {a} $w)"),
            11 => format!("(div $v {a})"),
            12 => format!("({} $w)", ["neg", "normalize"][self.roll(2) as usize]),
            _ => format!("({} $v $w {a})", ["lerp", "rotate"][self.roll(2) as usize]),
        }
    }

    fn statements(&mut self, depth: usize) {
        for _ in 0..1 + self.roll(3) {
            let kind = self.roll(if depth == 0 { 9 } else { 14 });
            if self.chooses && self.roll(7) == 0 {
                let a = self.variable();
                let statement = match self.roll(4) {
                    0 => format!("(set {a} (call \"g\" $b $v)) "),
                    1 => format!("(do (factor (sub {a} {a}))) "),
                    _ => format!("(set {a} (sample (dist uniform 0.0 1.0))) "),
                };
                self.text += &statement;
            }
            match kind {
                0..=5 => {
                    let (to, value) = (self.variable(), self.expression(2));
                    self.text += &format!("(set {to} {value}) ");
                }
                6 if self.depth > 0 => {
                    let test = self.expression(1);
                    let jump = ["break", "continue"][self.roll(2) as usize];
                    self.text += &format!("(if (lt {test} 0) (then ({jump}))) ");
                }
                6 => self.text += "(set $t (tuple $a $b)) (unpack ($b $a) $t) ",
                7 | 8 => {
                    let (to, value) = (["$v", "$w"][self.roll(2) as usize], self.vector());
                    self.text += &format!("(set {to} {value}) ");
                }
                9 | 10 => {
                    let test = self.expression(1);
                    self.text += &format!("(if (gt {test} 0.5) (then ");
                    self.statements(depth - 1);
                    self.text += ") (else ";
                    self.statements(depth - 1);
                    self.text += ")) ";
                }
                11 => {
                    self.loops += 1;
                    let k = format!("$k{}", self.loops);
                    let most = 3 + self.roll(9);
                    self.text += &format!("(set {k} 0) (while (lt {k} {most}) (body (set {k} (add {k} 1)) ");
                    self.inside(depth);
                }
                12 => {
                    self.loops += 1;
                    let k = format!("$k{}", self.loops);
                    let count = 2 + self.roll(12);
                    let range = match self.roll(4) {
                        0 => format!("(range $a {count})"),
                        1 => format!("(range {count} -3 -2)"),
                        _ => format!("(range {count})"),
                    };
                    self.text += &format!("(for {k} {range} (body (set $a {k}) ");
                    self.inside(depth);
                }
                _ => {
                    let over = ["$l", "$p", "(list 1 0.5 2)", "(vec 0.5 0.25)", "(tuple $a 2.0)"]
                        [self.roll(5) as usize];
                    self.text += &format!("(for $x {over} (body (set $b $x) ");
                    self.inside(depth);
                }
            }
        }
    }

    fn inside(&mut self, depth: usize) {
        self.depth += 1;
        self.statements(depth - 1);
        self.depth -= 1;
        self.text += ")) ";
    }

    fn program(seed: u64) -> String {
        let mut writer = Writer { dice: seed, text: String::new(), depth: 0, loops: 0, chooses: false };
        writer.text += "(module ";
        for k in 0..2 {
            // The second function may call the first; neither calls itself.
            writer.text += &format!(
                "(fn \"f{k}\" (params $a $b) (set $c 1.5) (set $d $b) (set $l (list $a $b 0.5 2)) (set $p (tuple 1.0 $a)) "
            );
            let start = writer.text.len();
            writer.statements(1);
            writer.text += "(return (add $a $c))) ";
            let body = writer.text.split_off(start);
            writer.text += &if k == 0 {
                body.replace("(call \"f0\"", "(add").replace("(call \"f1\"", "(sub")
            } else {
                body.replace("(call \"f1\"", "(call \"f0\"")
            };
        }
        writer.text += "(fn \"g\" (params $a $v) (set $b (sample (dist uniform 0.0 1.0))) (set $c 2) (set $d $a) (set $l (list 1 2 3 4.5)) (set $p (tuple $b 2)) (set $w $v) ";
        writer.statements(1);
        writer.text += "(do (factor 0.0)) (return (add $a $c))) ";
        writer.chooses = seed.is_multiple_of(2);
        writer.text += "(fn \"m\" (params) (set $a 1) (set $b 2.5) (set $c 0) (set $d -1.5) (set $l (list 0.5 1.5 2.5 3.5)) (set $p (tuple 1 2)) (set $v (vec 0.5 1.5 2.5)) (set $w (vec 1.0 0.0 $a)) ";
        let rounds = 2 + writer.roll(6);
        writer.text += &format!("(for $again (range {rounds}) (body ");
        writer.statements(3);
        writer.text += ")) (return (tuple $a $b $c $d $v $w))) (entry \"m\"))";
        writer.text
    }
}

#[test]
fn programs_at_random_agree() {
    let mut faults = 0;
    let seeds = std::env::var("SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(400);
    for seed in 0..seeds {
        let text = Writer::program(seed);
        let Ok(module) = parse(&text) else { panic!("{text}") };
        let program = compile::<f64>(&module, vec![]).unwrap_or_else(|error| panic!("{error}: {text}"));
        let (plain, quick) = (program.clone().with_machine_code_after(0), program.with_machine_code_after(1));
        for (steps, bytes) in
            [(60_000, 1 << 26), (7, 1 << 26), (300, 1 << 26), (60_000, 1 << 26), (60_000, 12_000)]
        {
            let limits = Limits { steps, bytes };
            let (interpreted, compiled) = (outcome(&plain, limits), outcome(&quick, limits));
            faults += u32::from(interpreted.0.contains("code:"));
            assert_eq!(interpreted, compiled, "seed {seed}, {steps} steps, {bytes} bytes: {text}");
        }
    }
    let all = 5 * seeds as u32;
    assert!((all / 20..all - all / 20).contains(&faults), "{faults} of {all} runs fault");
}

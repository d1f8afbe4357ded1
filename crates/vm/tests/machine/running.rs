//! The claim: a compiled program has the results of core form. It suspends where it may, never uses the host
//! stack, and stops at its budgets with the model's own call stack.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

use niwaki_math::{Dist, Draw};
use niwaki_vm::code::{Function, Program, SiteKind};
use niwaki_vm::core::parse::parse;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::machine::state::State;
use niwaki_vm::machine::{Limits, Machine, Stop};
use niwaki_vm::passes::{Scope, compile, compile_with_scope};
use niwaki_vm::value::{Value, repr};
use std::collections::BTreeSet;

/// Answers choices with 1, 2, 3, ... (or their values in turn), pauses at factors if `pause` is set, and logs
/// everything.
#[derive(Default)]
struct Script {
    count: i64,
    pause: bool,
    paths: Vec<String>,
    addresses: Vec<u128>,
    score: f64,
}

impl Answers<f64> for Script {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        self.count += 1;
        if self.paths.len() < 1000 {
            self.paths.push(at.path());
        }
        self.addresses.push(at.address());
        let draw = match dist.enumerate() {
            Some(values) => values[self.count as usize % values.len()].clone(),
            None => Draw::Real(self.count as f64),
        };
        Ok(Answer::Go(Value::from(draw)))
    }
    fn score(&mut self, _: &At<'_, f64>, _: Factor, log: f64) -> Result<Answer<()>, Fault> {
        self.score += log;
        Ok(if self.pause { Answer::Pause } else { Answer::Go(()) })
    }
    fn host(&mut self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        Ok(args[0].clone())
    }
}

fn program(text: &str) -> Program {
    compile(&parse(text).expect("core form"), vec![]).expect("a program")
}

fn run_with(text: &str, limits: Limits) -> Result<(String, Script), Box<RunFault>> {
    let program = program(text);
    let mut machine = Machine::new(&program, limits);
    let mut state = machine.start(&[], true).expect("a start");
    let mut script = Script::default();
    machine.finish(&mut state, &mut script)?;
    let result = state.result();
    Ok((repr(&result).expect("a short value"), script))
}

fn value(text: &str) -> String {
    match run_with(text, Limits::default()) {
        Ok((value, _)) => value,
        Err(fault) => panic!("{fault}"),
    }
}

fn fault(text: &str, limits: Limits) -> Box<RunFault> {
    match run_with(text, limits) {
        Ok((value, _)) => panic!("no fault, but {value}"),
        Err(fault) => fault,
    }
}

fn entry(body: &str) -> String {
    format!("(module (fn \"m\" (params) {body}) (entry \"m\"))")
}

/// A choice that nothing reads: it makes the function around it effectful.
const EFFECT: &str = "(do (sample (dist bernoulli 0.5)))";

#[test]
fn merges_loops_and_exits_do_not_depend_on_effects() {
    // Each body runs as it is (a plain loop) and with a choice in every iteration (a lifted loop).
    let bodies = [
        (
            "(set $s 0) (for $i (range 5) (body EFFECT (set $s (add $s $i)))) (return (tuple $s $i))",
            "(10, 4)",
        ),
        (
            "(set $s 0) (for $i (range 9) (body EFFECT (if (eq $i 3) (then (break))) (set $s $i))) (return $s)",
            "2",
        ),
        (
            "(set $s 0) (for $i (range 5) (body EFFECT (if (eq (mod $i 2) 0) (then (continue))) (set $s (add $s $i)))) (return $s)",
            "4",
        ),
        ("(for $i (range 5) (body EFFECT (if (eq $i 3) (then (return (mul $i 100)))))) (return -1)", "300"),
        (
            "(set $a 1) (set $b 2) (set $n 0) (while (lt $n 3) (body EFFECT (set $t $a) (set $a $b) (set $b $t) (set $n (add $n 1)))) (return (tuple $a $b))",
            "(2, 1)",
        ),
        (
            "(set $s 0) (for $i (range 3) (body EFFECT (for $j (range $i) (body EFFECT (if (eq $j 1) (then (break))) (set $s (add (mul 10 $s) $j)))))) (return $s)",
            "0",
        ),
        (
            "(set $a 0) (set $b 1) (for $i (range 10) (body EFFECT (unpack ($a $b) (tuple $b (add $a $b))))) (return (tuple $a $b))",
            "(55, 89)",
        ),
        ("(set $x 1) (for $i (list) (body EFFECT (set $x 2))) (return $x)", "1"),
        (
            "(for $i (range 4) (body EFFECT (for $j (range 4) (body EFFECT (if (eq (add $i $j) 5) (then (return (tuple $i $j)))))))) (return none)",
            "(2, 3)",
        ),
        (
            "(set $n 0) (while true (body EFFECT (set $n (add $n 1)) (if (gt $n 6) (then (break)) (else (continue))))) (return $n)",
            "7",
        ),
        // A variable that only the test reads is carried.
        (
            "(set $more true) (set $n 0) (while $more (body EFFECT (set $more (lt $n 3)) (set $n (add $n 1)))) (return $n)",
            "4",
        ),
        (
            "(set $xs (list)) (for $i (range 3) (body EFFECT (set $xs (append $xs (mul $i $i))))) (return $xs)",
            "[0, 1, 4]",
        ),
    ];
    for (body, expected) in bodies {
        assert_eq!(value(&entry(&body.replace("EFFECT", ""))), expected, "plain: {body}");
        assert_eq!(value(&entry(&body.replace("EFFECT", EFFECT))), expected, "lifted: {body}");
    }
}

#[test]
fn a_variable_read_before_it_is_assigned_is_a_fault() {
    for effect in ["", EFFECT] {
        let text = entry(&format!("(for $i (list) (body {effect} (set $x 2))) (return $x)"));
        assert_eq!(fault(&text, Limits::default()).fault.code, "unassigned-variable");
        let text = entry(&format!("{effect} (if (eq 1 2) (then (set $x 2))) (return $x)"));
        assert_eq!(fault(&text, Limits::default()).fault.code, "unassigned-variable");
    }
}

#[test]
fn closures_defaults_and_records_have_their_values() {
    let text = r#"(module (class 0 "P" ("x" "y")) (fn "add" (params $a $b) (defaults $k) (captures $k) (return (add (mul 100 $k) (add $a $b))))
        (fn "m" (params) (set $f (closure "add" 7)) (set $p (record 0 (apply $f 1) (apply $f 1 2)))
        (return (tuple (field $p "x") (field $p "y") (cond (and 1 0) 5 (or 0 6))))) (entry "m"))"#;
    assert_eq!(value(text), "(708, 703, 6)");
}

#[test]
fn addresses_are_paths_of_sites() {
    let text = r#"(module (fn "wing" (params $i) (set $z (sample (dist gaussian 0 1))) (return $z))
        (fn "m" (params) (for $i (range 2) (body (set $a (call "wing" $i)) (set $b (call "wing" $i)))) (set $z (sample (dist gaussian 0 1))))
        (entry "m"))"#;
    let (_, script) = run_with(text, Limits::default()).unwrap_or_else(|f| panic!("{f}"));
    assert_eq!(script.paths, ["i[0]/wing/z", "i[0]/wing#1/z", "i[1]/wing/z", "i[1]/wing#1/z", "z"]);
    let unique: std::collections::HashSet<u128> = script.addresses.iter().copied().collect();
    assert_eq!(unique.len(), 5);
}

#[test]
fn addresses_do_not_depend_on_the_numbers_of_variables() {
    let script_of = |x: &str, y: &str| {
        let text = format!(
            "(module (fn \"low\" (params) (set ${x} (sample (dist gaussian 0 1))) (return ${x}))
            (fn \"m\" (params) (for ${y} (range 2) (body (set ${x} (call \"low\")) (set $f (closure \"low\"))
                (set ${x} (apply $f)))) (return (sample (dist gaussian 0 1)))) (entry \"m\"))"
        );
        let (_, script) = run_with(&text, Limits::default()).unwrap_or_else(|f| panic!("{f}"));
        (script.paths, script.addresses)
    };
    assert_eq!(script_of("x", "i"), script_of("x%1", "i%2"));
}

#[test]
fn a_stack_of_200000_calls_runs_and_is_dropped() {
    for effect in ["", EFFECT] {
        let text = format!(
            r#"(module (fn "down" (params $n) {effect} (if (eq $n 0) (then (return (tuple 0 none))))
               (return (tuple $n (call "down" (sub $n 1))))) (fn "m" (params) (set $v (call "down" 200000))
               (return (index $v 0))) (entry "m"))"#
        );
        assert_eq!(value(&text), "200000");
    }
}

#[test]
fn budgets_stop_endless_runs_and_show_the_stack() {
    let steps = Limits { steps: 100_000, ..Limits::default() };
    let memory = Limits { bytes: 10 << 20, ..Limits::default() };
    let endless = entry("(set $n 0) (while true (body (set $n (add $n 1))))");
    assert_eq!(fault(&endless, steps).fault.code, "step-budget");
    let endless = entry(&format!("(set $n 0) (while true (body {EFFECT} (set $n (add $n 1))))"));
    assert_eq!(fault(&endless, steps).fault.code, "step-budget");
    for effect in ["", EFFECT] {
        let text = format!(
            r#"(module (fn "f" (params $n) {effect} (return (add 1 (call @7:3-7:9 "f" (add $n 1)))))
               (fn "m" (params) (return (call @9:1-9:5 "f" 0))) (entry "m"))"#
        );
        let report = fault(&text, memory);
        assert_eq!(report.fault.code, "memory-budget");
        assert!(report.omitted > 1000);
        assert_eq!((&*report.stack[0].function, report.stack[0].span.line), ("m", 9));
        assert_eq!((&*report.stack[1].function, report.stack[1].span.line), ("f", 7));
    }
}

#[test]
fn values_count_while_they_are_held_and_large_values_are_refused() {
    let bytes = |bytes| Limits { bytes, ..Limits::default() };
    let kept = |element: &str| {
        entry(&format!(
            "(set $xs (list)) (for $i (range 100000) (body (set $xs (add $xs (list {element}))))) (return (len $xs))"
        ))
    };
    let dropped = entry(
        "(set $n 0) (for $i (range 20000) (body (set $n (add $n (len (mul (list $i) 1000)))))) (return $n)",
    );
    for element in [
        "(mul (list $i) 100)",
        "(mul \"text \" (add 100 (mod $i 100)))",
        "(tuple $i $i $i $i $i)",
        "(vec $i 2.0 3.0)",
    ] {
        assert_eq!(fault(&kept(element), bytes(2 << 20)).fault.code, "memory-budget", "{element}");
    }
    // The loop makes 320 MB in all, but holds 16 kB at a time.
    assert_eq!(run_with(&dropped, bytes(1 << 20)).map(|(value, _)| value).ok().as_deref(), Some("20000000"));
    let report = fault(&entry("(return (len (mul (list 1) 60000000)))"), bytes(100 << 20));
    assert!(report.fault.message.contains("100 MB"), "{report}");
    let below = entry("(return (len (mul (list 1) 4000000)))");
    assert!(run_with(&below, bytes(100 << 20)).is_ok());
}

#[test]
fn a_run_has_nothing_of_the_run_before_it() {
    let text = "(module (fn \"m\" (params $x) (if (eq $x 1) (then (set $n (len (mul (list 1) 40000))))
        (else (set $n (len (mul (list 2) 30000))))) (return $n)) (entry \"m\"))";
    let program = program(text);
    // Either list fits, both do not.
    let mut machine = Machine::new(&program, Limits { bytes: 1 << 20, ..Limits::default() });
    for (x, length) in [(1, 40_000), (2, 30_000), (1, 40_000)] {
        let mut state = machine.start(&[Value::Int(x)], true).expect("a start");
        machine.finish(&mut state, &mut Script::default()).unwrap_or_else(|fault| panic!("{fault}"));
        assert_eq!(state.result(), Value::Int(length));
    }
}

#[test]
fn an_operation_takes_a_step_for_every_eight_elements() {
    let text = entry("(set $xs (mul (list 1) 80000)) (return (sum $xs))");
    assert!(run_with(&text, Limits { steps: 20_000, ..Limits::default() }).is_ok());
    let report = fault(&text, Limits { steps: 19_999, ..Limits::default() });
    assert_eq!(report.fault.code, "step-budget");
}

#[test]
fn a_paused_run_resumes_at_its_place_and_its_fork_is_separate() {
    let text = r#"(module (fn "m" (params) (set $xs (list)) (for $i (range 4) (body
        (set $x (sample (dist gaussian 0 1))) (do (factor $x)) (set $xs (append $xs $x)))) (return $xs)) (entry "m"))"#;
    let program = program(text);
    let mut machine = Machine::new(&program, Limits::default());
    let mut state = machine.start(&[], true).expect("a start");
    let mut script = Script { pause: true, ..Script::default() };
    let root = state.runnable().first().expect("the root");
    for _ in 0..2 {
        let stop = machine.resume(&mut state, root, &mut script).unwrap_or_else(|f| panic!("{f}"));
        assert_eq!(stop, Stop::Paused);
    }
    let finish = |mut state: State, count: i64| {
        let mut machine = Machine::new(&program, Limits::default());
        let mut script = Script { count, ..Script::default() };
        machine.finish(&mut state, &mut script).unwrap_or_else(|f| panic!("{f}"));
        repr(&state.result()).expect("short")
    };
    let fork = state.clone();
    assert_eq!(finish(state, 2), "[1.0, 2.0, 3.0, 4.0]");
    assert_eq!(finish(fork, 70), "[1.0, 2.0, 71.0, 72.0]");
}

#[test]
fn futures_wait_for_each_other_and_a_cycle_is_a_fault() {
    let text = r#"(module (fn "late" (params $k) (do (factor 0.0)) (return (mul $k 10)))
        (fn "m" (params) (set $a (future "late" 1)) (set $b (future "late" 2))
        (return (tuple (force $b) (force $a) $a))) (entry "m"))"#;
    let program = program(text);
    for depth_first in [true, false] {
        let mut machine = Machine::new(&program, Limits::default());
        let mut state = machine.start(&[], depth_first).expect("a start");
        machine.finish(&mut state, &mut Script::default()).unwrap_or_else(|f| panic!("{f}"));
        assert_eq!(repr(&state.result()).expect("short"), "(20, 10, 10)");
    }
    assert!(
        compile::<f64>(
            &parse("(module (fn \"m\" (params) (return (call \"n\"))) (entry \"m\"))").expect("core"),
            vec![]
        )
        .is_err()
    );
}

#[test]
fn a_force_that_waits_reads_its_future_again() {
    // The next future is the first runnable one, the last, or each in turn. Every future stops at a factor, so
    // that forces wait and other futures run in between.
    let helpers = r#"(fn "leaf" (params $k) (do (factor 0.0)) (return (mul $k 10)))
        (fn "pair" (params $k) (return (tuple (future "leaf" $k) (future "leaf" (add $k 1)))))
        (fn "late" (params $f) (do (factor 0.0)) (return (add 1 (force $f))))
        (fn "get" (params) (captures $fs) (return (force (index $fs 1))))
        (fn "nested" (params $k) (return (future "leaf" $k)))"#;
    let bodies = [
        // A future that a branch chooses.
        ("(set $f (cond (eq 1 1) (future \"leaf\" 7) none)) (return (force $f))", "70"),
        ("(set $f none) (if (eq 1 1) (then (set $f (future \"leaf\" 7)))) (return (force $f))", "70"),
        // Futures from an unpacked tuple, and two in one expression.
        ("(unpack ($a $b) (call \"pair\" 1)) (return (sub (force $a) (force $b)))", "-10"),
        ("(return (sub (force (future \"leaf\" 3)) (force (future \"leaf\" 1))))", "20"),
        // Futures in a list, a tuple and a dictionary.
        (
            "(set $fs (list (future \"leaf\" 1) (future \"leaf\" 2))) (set $s 0) (for $i (range 2) (body (set $s (add (mul 100 $s) (force (index $fs $i)))))) (return $s)",
            "1020",
        ),
        (
            "(set $fs (call \"pair\" 4)) (return (tuple (force (index $fs 1)) (force (index $fs 0)) (force (index $fs 1))))",
            "(50, 40, 50)",
        ),
        (
            "(set $d (dict (\"a\" \"b\") (future \"leaf\" 1) (future \"leaf\" 2))) (return (add (force (index $d \"b\")) (force (index $d \"a\"))))",
            "30",
        ),
        // Futures as arguments of a call and of a future, and in a capture.
        (
            "(set $f (future \"late\" (future \"leaf\" 5))) (return (add (force $f) (call \"late\" (future \"leaf\" 6))))",
            "112",
        ),
        ("(set $g (closure \"get\" (call \"pair\" 8))) (return (apply $g))", "90"),
        // A future that returns a future.
        ("(return (force (force (future \"nested\" 3))))", "30"),
    ];
    for (body, expected) in bodies {
        let program = program(&format!("(module {helpers} (fn \"m\" (params) {body}) (entry \"m\"))"));
        for order in 0..3 {
            let mut machine = Machine::new(&program, Limits::default());
            let mut state = machine.start(&[], false).expect("a start");
            let mut script = Script { pause: true, ..Script::default() };
            let mut turn = 0;
            while !state.has_ended() {
                let can: Vec<_> = state.runnable().iter().collect();
                turn += 1;
                let next = [0, can.len() - 1, turn % can.len()][order];
                machine.resume(&mut state, can[next], &mut script).unwrap_or_else(|f| panic!("{body}: {f}"));
            }
            assert_eq!(repr(&state.result()).expect("short"), expected, "order {order}: {body}");
        }
    }
}

/// The claim: every read of a future that is not forced is a fault with one code. The future may still run
/// (orders that are not depth first), have returned (depth first), or be kept (chains); its function may be
/// pure or not.
#[test]
fn a_read_of_a_future_that_is_not_forced_is_a_fault() {
    let helpers = r#"
        (fn "leaf" (params $k) (do (factor 0.1)) (return (mul 10 $k)))
        (fn "now" (params $k) (return (mul 10 $k)))"#;
    let looks = [
        "(if $f (then (return 1)))",
        "(while $f (body (return 1)))",
        "(do (not $f))",
        "(do (eq $f $f))",
        "(do (eq (list $f) (list 10)))",
        "(do (lt (tuple 1 $f) (tuple 2 1)))",
        "(do (add 1 $f))",
        "(do (sum (list 1 $f)))",
        "(do (min $f 2))",
        "(do (in 1 (list 1 $f)))",
        "(do (fstr $f))",
        "(do (str (list $f)))",
        "(do (len $f))",
        "(do (index (list 1 2) $f))",
        "(do (apply $f 1))",
        "(for $i $f (body (set $x $i)))",
        "(do (dist bernoulli $f))",
        "(do (sample (dist bernoulli $f)))",
        "(do (factor $f))",
        "(do (condition $f))",
        "(do (emit $f))",
        "(do (query $f 1))",
    ];
    for (look, leaf) in looks.iter().flat_map(|look| ["leaf", "now"].map(|leaf| (look, leaf))) {
        let body = format!("(set $f (future \"{leaf}\" 1)) {look} (return 0)");
        let program = program(&format!("(module {helpers} (fn \"m\" (params) {body}) (entry \"m\"))"));
        let mut machine = Machine::new(&program, Limits::default());
        let mut ran = |depth_first| {
            let mut state = machine.start(&[], depth_first).expect("a start");
            machine
                .finish(&mut state, &mut Script::default())
                .map(|()| "an answer")
                .map_err(|met| met.fault.code)
        };
        let (deep, wide) = (ran(true), ran(false));
        let kept =
            machine.begin(&[], &mut Script::default()).map(|_| "an answer").map_err(|met| met.fault.code);
        for outcome in [deep, wide, kept] {
            assert_eq!(outcome, Err("future-not-forced"), "{leaf}: {look}");
        }
    }
}

/// Records the visible variables at every choice, and the x of the place that the program looks from.
#[derive(Default)]
struct Scopes {
    count: i64,
    seen: Vec<(String, String, Option<f64>)>,
}

impl Answers<f64> for Scopes {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        let names: Vec<String> =
            at.visible().map(|(name, _, value)| format!("{name}={}", repr(value).unwrap())).collect();
        let look = at.look().map(|frame| match frame.field("center") {
            Some(Value::Real(x)) => *x,
            other => panic!("{other:?}"),
        });
        self.seen.push((at.site.label.to_string(), names.join(" "), look));
        self.count += 1;
        let values = dist.enumerate().expect("a finite choice");
        Ok(Answer::Go(Value::from(values[self.count as usize % values.len()].clone())))
    }
    fn host(&mut self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        Ok(args[0].clone())
    }
}

/// The records at all choices of a program.
fn scopes(text: &str) -> Vec<(String, String, Option<f64>)> {
    let program =
        compile_with_scope(&parse(text).expect("core form"), vec![], Scope::All).expect("a program");
    let (mut machine, mut scopes) = (Machine::new(&program, Limits::default()), Scopes::default());
    let mut state = machine.start(&[], true).expect("a start");
    machine.finish(&mut state, &mut scopes).expect("a run");
    scopes.seen
}

#[test]
fn choices_see_the_variables_that_every_path_has_assigned() {
    let seen = scopes(
        r#"(module
          (fn "part" (params $p $q) (captures $c)
            (set $p%3 7) (set $p (add $p $c))
            (set $u (sample (dist bernoulli 0.5)))
            (return $u))
          (fn "m" (params)
            (set $a 1) (set $b (add $a 1)) (set $a 3)
            (set $s (sample (dist bernoulli 0.5)))
            (if $s (then (set $b 5) (set $only 6)) (else (set $t 8)))
            (set $v (sample (dist bernoulli 0.5)))
            (set $gone 0) (set $b 9)
            (for $i (range 2) (body
              (set $w (sample (dist bernoulli 0.5)))
              (set $gone (add $i 10))
              (for $j (range 1) (body (set $x (sample (dist bernoulli 0.5)))))))
            (set $y (sample (dist bernoulli 0.5)))
            (do (call "part" 1 2 $a))
            (return none)) (entry "m"))"#,
    );
    let expected = [
        ("s", "b=2 a=3"),
        ("v", "a=3 s=True b=5"),
        ("w", "a=3 s=True v=False b=9 gone=0 i=0"),
        ("x", "a=3 s=True v=False b=9 i=0 w=True gone=10 j=0"),
        ("w", "a=3 s=True v=False b=9 gone=10 i=1"),
        ("x", "a=3 s=True v=False b=9 i=1 w=True gone=11 j=0"),
        ("y", "a=3 s=True v=False b=9 gone=11"),
        ("u", "c=3 q=2 p=4"),
    ];
    let visible: Vec<(&str, &str)> = seen.iter().map(|(label, names, _)| (&**label, &**names)).collect();
    assert_eq!(visible, expected);
}

/// The origin of the frame at every choice: frames compose on the way down, also through loops, values and futures, and not into
/// memoised calls.
#[test]
fn choices_see_the_frame_of_their_function() {
    #[derive(Default)]
    struct Frames(Vec<(String, Option<[f64; 3]>)>);
    impl Answers<f64> for Frames {
        fn choice(&mut self, at: &At<'_, f64>, _: &Dist) -> Result<Answer<Value>, Fault> {
            let origin = at.frame().map(|frame| frame.translation.to_array());
            self.0.push((at.site.label.to_string(), origin));
            Ok(Answer::Go(Value::Bool(true)))
        }
        fn host(&mut self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
            Ok(args[0].clone())
        }
    }
    let flip = |name: &str| format!("(set ${name} (sample (dist bernoulli 0.5)))");
    let text = format!(
        r#"(module
          (fn "leaf" (params) {} (return 1))
          (fn "part" (params $p) {} (for $i (range 1) (body {}
              (do (place (tuple $p 1.0 0.0) (call "leaf")))))
            (do (future "leaf")) (do (apply (closure "leaf"))) (return none))
          (fn "m" (params) {}
            (set $f (closure "part")) (set $r (mem (closure "leaf")))
            (do (place (tuple 5.0 0.0 0.0) (apply $f 2.0)))
            (do (place (tuple 5.0 0.0 0.0) (apply $r)))
            (do (call "part" 3.0))
            (return none)) (entry "m"))"#,
        flip("u"),
        flip("a"),
        flip("b"),
        flip("first")
    );
    let program =
        compile_with_scope(&parse(&text).expect("core form"), vec![], Scope::All).expect("a program");
    let (mut machine, mut frames) = (Machine::new(&program, Limits::default()), Frames::default());
    let mut state = machine.start(&[], true).expect("a start");
    machine.finish(&mut state, &mut frames).expect("a run");
    let placed = Some([5.0, 0.0, 0.0]);
    let expected = [
        ("first", None),
        ("a", placed),
        ("b", placed),
        ("u", Some([7.0, 1.0, 0.0])),
        ("u", placed),
        ("u", placed),
        ("u", None),
        ("a", None),
        ("b", None),
        ("u", Some([3.0, 1.0, 0.0])),
        ("u", None),
        ("u", None),
    ];
    let origins: Vec<(&str, Option<[f64; 3]>)> = frames.0.iter().map(|(label, at)| (&**label, *at)).collect();
    assert_eq!(origins, expected);
}

#[test]
fn the_program_looks_from_the_frame_that_was_assigned_last() {
    let seen = scopes(
        r#"(module (class 0 "Frame" ("center" "forward" "up" "radius")) (class 1 "Other" ("center"))
          (fn "m" (params)
            (set $a (sample (dist bernoulli 0.5)))
            (set $f (record 0 1.0 0.0 0.0 1.0)) (set $o (record 1 9.0))
            (set $b (sample (dist bernoulli 0.5)))
            (if $b (then (set $%look (record 0 2.0 0.0 0.0 1.0))))
            (set $c (sample (dist bernoulli 0.5)))
            (for $i (range 2) (body
              (set $d (sample (dist bernoulli 0.5)))
              (set $%look (record 0 (add $i 3.0) 0.0 0.0 1.0))))
            (set $e (sample (dist bernoulli 0.5)))
            (set $f (record 0 5.0 0.0 0.0 1.0))
            (set $g (sample (dist bernoulli 0.5)))
            (return none)) (entry "m"))"#,
    );
    let looks: Vec<(&str, Option<f64>)> = seen.iter().map(|(label, _, look)| (&**label, *look)).collect();
    let expected = [
        ("a", None),
        ("b", Some(1.0)),
        // The arm with `look` is not taken.
        ("c", Some(1.0)),
        ("d", Some(1.0)),
        ("d", Some(3.0)),
        ("e", Some(4.0)),
        ("g", Some(5.0)),
    ];
    assert_eq!(looks, expected);
    assert!(seen.iter().all(|(_, names, _)| !names.contains("look") && !names.contains(" =")));
}

/// For each function, the variables and choices that are angles, and those that are not.
fn angles(text: &str) -> Vec<(String, String, String)> {
    let program =
        compile_with_scope(&parse(text).expect("core form"), vec![], Scope::All).expect("a program");
    let sorted = |names: BTreeSet<String>| names.into_iter().collect::<Vec<_>>().join(" ");
    let of = |f: &Function| {
        let named = |is_angle: bool| {
            let seen = f.scope.iter().filter(|x| x.is_angle == is_angle).map(|x| x.name.to_string());
            let drawn = f.sites.iter().filter(|site| matches!(site.kind, SiteKind::Sample(_)));
            let drawn = drawn.filter(|site| site.is_angle == is_angle).map(|site| format!("~{}", site.label));
            sorted(seen.chain(drawn).collect())
        };
        (f.name.to_string(), named(true), named(false))
    };
    program.functions.iter().filter(|f| !f.sites.is_empty() && !f.scope.is_empty()).map(of).collect()
}

#[test]
fn angles_are_values_that_flow_into_or_come_from_angles() {
    // The model of vines.
    let vines = r#"(module
      (fn "vines" (params $x $y $ahead)
        (set $start_angle (sample #start_angle (dist gaussian (atan2 (index $ahead 1) (index $ahead 0)) 0.5)))
        (set $later (sample #later (dist bernoulli 0.5)))
        (do (call "branch" $x $y $start_angle 0.75))
        (return none))
      (fn "branch" (params $x $y $angle $width)
        (set $angle (add $angle (sample #turn (dist gaussian 0.0 0.4))))
        (set $width (mul 0.9 $width))
        (set $end_x (add $x (mul 2.0 (cos $angle)))) (set $end_y (add $y (mul 2.0 (sin $angle))))
        (do (emit (stroke (tuple $x $y 0.0) (tuple $end_x $end_y 0.0) $width)))
        (set $side (cond (sample #side (dist bernoulli 0.5)) 1.0 -1.0))
        (set $leaf_angle (add $angle (sample #leaf (dist gaussian (mul $side 0.8) 0.3))))
        (do (emit (ellipse (tuple $end_x $end_y 0.0) 2.0 1.0 $leaf_angle)))
        (if (sample #on (dist bernoulli 0.5)) (then (do (call "branch" $end_x $end_y $angle $width))))
        (return none))
      (entry "vines"))"#;
    let row = |name: &str, yes: &str, no: &str| (name.to_string(), yes.to_string(), no.to_string());
    assert_eq!(
        angles(vines),
        [
            row("vines", "start_angle ~start_angle", "ahead x y ~later"),
            row("branch", "angle leaf_angle ~leaf ~turn", "end_x end_y side width x y ~on ~side"),
        ]
    );
    // The values pass through a loop, a capture, a returned value and an argument of a pure function; some only
    // come from an angle.
    let ways = r#"(module
      (fn "turned" (params $t) (return (sub 3.0 $t)))
      (fn "drawn" (params $m) (set $d (sample #d (dist uniform $m 2.0))) (set $n (sample #n (dist bernoulli 0.5)))
        (return $d))
      (fn "inner" (params) (captures $c $l) (set $k (sample #k (dist bernoulli 0.5)))
        (return (mul $l (tan $c))))
      (fn "m" (params $a $b $e $h)
        (set $s $h) (set $o 0.0)
        (for $i (range 3) (body
          (set $s (add $s (sample #step (dist gaussian 0.0 1.0)))) (set $o (add $o $b))))
        (do (emit (ellipse (tuple $o 0.0 0.0) 1.0 1.0 (neg (call "turned" $s)))))
        (set $r (call "drawn" $a)) (set $x (sin $r))
        (set $g (atan2 $x $o)) (set $p (radians $b)) (set $q (add $p 1.0))
        (do (call "inner" $e $o))
        (set $z (sample #z (dist bernoulli 0.5)))
        (return (tuple $g $q))) (entry "m"))"#;
    assert_eq!(
        angles(ways),
        [
            row("drawn", "d m ~d", "~n"),
            row("inner", "c", "l ~k"),
            row("m", "a e g h p q r s", "b o x ~z"),
            row("m/i#0", "a e h s ~step", "b i o"),
        ]
    );
}

/// A memoised coin that two functions request, directly and by a future, and that a choice selects.
const MEMOISED: &str = r#"(module
  (fn "coin" (params $i) (set $x (sample (dist uniform 0.0 1.0))) (do (factor 1.0)) (return $x))
  (fn "one" (params $i) (return (apply (mem (closure "coin") "coin") $i)))
  (fn "two" (params $i) (do (factor 0.0)) (return (force (future_apply (mem (closure "coin") "coin") $i))))
  (fn "m" (params)
    (set $f (future "two" 1)) (set $g (future "one" 1)) (set $h (future "two" 2))
    (set $a (call "one" 1)) (set $b (call "one" 2)) (set $c (call "one" 1.0))
    (return (tuple (eq $a (force $f)) (eq $a (force $g)) (eq $b (force $h)) (eq $a $b) (eq $a $c))))
  (entry "m"))"#;

#[test]
fn a_memoised_call_is_one_activation_for_all_callers() {
    let program = program(MEMOISED);
    let mut addresses = BTreeSet::new();
    for depth_first in [true, false] {
        // Futures run one by one in many orders: always the first, always the last, and mixtures.
        for rule in 0..6_u64 {
            let mut machine = Machine::new(&program, Limits::default());
            let mut state = machine.start(&[], depth_first).unwrap();
            let mut script = Script { pause: true, ..Script::default() };
            let mut turn = rule;
            while !state.has_ended() {
                let runnable = state.runnable();
                turn = turn.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                let at = match rule {
                    0 => 0,
                    1 => runnable.len() - 1,
                    _ => (turn >> 33) as usize % runnable.len(),
                };
                let next = runnable.get(at).unwrap();
                let copy = state.clone();
                state = copy;
                machine.resume(&mut state, next, &mut script).unwrap();
            }
            assert_eq!(repr(&state.result()).unwrap(), "(True, True, True, False, False)", "rule {rule}");
            assert_eq!(script.score, 3.0, "a call is scored once");
            let run_addresses: BTreeSet<u128> = script.addresses.iter().copied().collect();
            assert_eq!(run_addresses.len(), 3);
            addresses.insert(run_addresses);
        }
    }
    assert_eq!(addresses.len(), 1, "addresses do not depend on the order");
}

#[test]
fn a_memoised_call_has_a_readable_address_of_its_own() {
    let text = r#"(module
      (fn "paint" (params $i $s) (captures $base) (set $hue (sample (dist uniform 0.0 1.0))) (return (add $hue $base)))
      (fn "m" (params)
        (for $k (range 2) (body
          (set $color (mem (closure "paint" $k)))
          (do (apply $color 1 "a/b")) (do (apply $color 1 "a/b")) (do (apply $color (list 2 0.5) none)))))
      (entry "m"))"#;
    let (_, script) = run_with(text, Limits::default()).unwrap();
    let expected = [
        "k[0]/color(1, 'a\\x2fb')/hue",
        "k[0]/color([2, 0.5], None)/hue",
        "k[1]/color(1, 'a\\x2fb')/hue",
        "k[1]/color([2, 0.5], None)/hue",
    ];
    assert_eq!(script.paths, expected);
    let program = program(text);
    for (path, address) in expected.iter().zip(&script.addresses) {
        let held =
            niwaki_vm::machine::held::Held::new(&program, vec![((*path).to_string(), Value::Real(0.5))]);
        assert!(held.unwrap().find(*address).is_some(), "{path}");
    }
}

#[test]
fn a_memoised_call_that_needs_itself_is_a_fault() {
    let round = r#"(module
      (fn "f" (params $n) (do (sample (dist bernoulli 0.5))) (return (apply (mem (closure "f") "f") (sub 1 $n))))
      (fn "m" (params) (return (apply (mem (closure "f") "f") 0))) (entry "m"))"#;
    assert_eq!(fault(round, Limits::default()).fault.code, "memo-cycle");
    let program = program(round);
    let mut machine = Machine::new(&program, Limits::default());
    let mut state = machine.start(&[], false).unwrap();
    assert_eq!(machine.finish(&mut state, &mut Script::default()).unwrap_err().fault.code, "memo-cycle");
    let argument = r#"(module
      (fn "f" (params $n) (return (sample (dist bernoulli 0.5))))
      (fn "m" (params) (return (apply (mem (closure "f") "f") (closure "f")))) (entry "m"))"#;
    assert_eq!(fault(argument, Limits::default()).fault.code, "memo-argument");
}

//! The claim: a text with random changes is refused, or runs to a value or a fault. Nothing panics.

#[path = "../kept/programs.rs"]
mod programs;

use niwaki_math::{Dist, Draw};
use niwaki_vm::core::parse::parse;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At};
use niwaki_vm::machine::{Limits, Machine};
use niwaki_vm::passes::compile;
use niwaki_vm::value::{Value, repr};
use programs::{PROGRAMS, compiled};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Parts of core form that are not in the other programs.
const MORE: &str = r#"(module (file 0 "m.py") (class 0 "P" ("x" "y") namedtuple) (const 0 (list (dist bernoulli 0.5) 1 "a"))
  (fn @1:1-1:2 "g" (file 0) (params $a $b) (defaults 2) (captures $c) (return (add $a (mul $b $c))))
  (fn "m" (file 0) (params)
    (set $d (dict ("a" 1) 2 (sample #d (dist gaussian 0.0 1.0))))
    (set $p (record 0 1.5 (index (data 0) 1)))
    (set $f (closure "g" (field $p "x")))
    (unpack ($x $y) $p) (unpack_star ($u) $v ($w) (list 1 2 3 4))
    (set $t (fstr "<" (format (apply $f 1) "05.1f" "") ">" (format $d "" "r")))
    (set $s (method (method $t "upper") "split" ","))
    (assert (and (is_none none) (not (in 7 $v)) (or $s false)) "no")
    (for $i (slice (list 1 2 3) 0 none 2) (body (if (gt $i 1) (then (break)) (else (continue)))))
    (while (lt $x 9) (body (set $x (add $x (cond (eq $x 3) 2 1)))))
    (set $q (future "g" 1 2 3)) (set $r (future_apply $f 1))
    (do (emit (box (vec 0 0 0) (vec 1 $x 1)) (cylinder (tuple 0 0 0) 1 2)))
    (do (query "k" (tuple (force $q) (force $r)))) (do (observe (index (data 0) 0) true))
    (do (host 0 1)) (do (condition (le (softeq 1 2 3) 0.0)))
    (return (list (sum (to_list (range 3))) (sorted $v true) (zip $v $v) (round 2.5) (sqrt 2) $t $d)))
  (entry "m"))"#;

/// A random number generator (splitmix64).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ z >> 31) as usize % n
    }
}

/// The words of a text, with parentheses as words.
fn words(text: &str) -> Vec<String> {
    let (mut words, mut word, mut quoted) = (vec![], String::new(), false);
    for c in text.chars() {
        let ends = !quoted && (c.is_whitespace() || "()".contains(c));
        if ends && !word.is_empty() {
            words.push(std::mem::take(&mut word));
        }
        quoted ^= c == '"';
        if !ends {
            word.push(c);
        } else if !c.is_whitespace() {
            words.push(c.to_string());
        }
    }
    words
}

/// The end of the list or the word at `at`.
fn end(words: &[String], at: usize) -> usize {
    let mut depth = 0_i32;
    for (i, word) in words.iter().enumerate().skip(at) {
        depth += i32::from(word == "(") - i32::from(word == ")");
        if depth <= 0 {
            return i + 1;
        }
    }
    words.len()
}

const STRANGE: &[&str] = &[
    "999",
    "-1",
    "0",
    "70000",
    "9223372036854775807",
    "-9223372036854775808",
    "1e308",
    "nan",
    "inf",
    "-inf",
    "none",
    "true",
    "\"\"",
    "\"a\"",
    "$x",
    "$%1",
    "$",
    "()",
    "(list)",
    "(tuple)",
    "(record 999)",
    "(data 7)",
    "(host 9 1)",
    "(dict (1 2) 3)",
    "(closure \"m\")",
    "(call \"m\")",
    "(dist gaussian)",
    "(dist dirichlet 1)",
    "(range 0 9 0)",
    "(range 100000000)",
    "(unpack () 1)",
    "(emit)",
    "(future \"m\")",
    "(force 1)",
    "#",
    "@1:1",
    "(fn \"h\")",
    "(class 9 \"Q\" ())",
    "(const 99999999 1)",
    "(entry \"h\")",
    "(break)",
    "(method 1 \"x\")",
];

fn mutated(text: &str, random: &mut Random) -> String {
    let mut words = words(text);
    for _ in 0..=random.below(3) {
        let at = random.below(words.len());
        let (to, other) = (end(&words, at), random.below(words.len()));
        let piece: Vec<String> = match random.below(6) {
            0 => vec![],
            1 => vec![STRANGE[random.below(STRANGE.len())].into()],
            2 => [&words[at..to], &words[at..to]].concat(),
            3 => words[other..end(&words, other)].to_vec(),
            4 => vec![words[other].clone()],
            _ => [&words[at..to], &[STRANGE[random.below(STRANGE.len())].into()]].concat(),
        };
        words.splice(at..to, piece);
        if words.is_empty() || words.len() > 5000 {
            break;
        }
    }
    words.join(" ")
}

/// Answers choices with their values in turn, and never pauses.
struct InTurn(u64);

impl Answers<f64> for InTurn {
    fn choice(&mut self, _: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        self.0 += 1;
        let draw = match dist.enumerate() {
            Some(values) if !values.is_empty() => values[self.0 as usize % values.len()].clone(),
            _ => Draw::Real(0.5),
        };
        Ok(Answer::Go(Value::from(draw)))
    }
    fn host(&mut self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        Ok(args.first().cloned().unwrap_or_default())
    }
}

/// The stage that a text reaches: 0 is not core form, 1 is not a program, 2 is a fault, 3 is a value.
fn stage(text: &str) -> usize {
    let Ok(module) = parse(text) else { return 0 };
    assert!(parse(&niwaki_vm::core::print::print(&module)).is_ok(), "the printed text can be read");
    let Ok(program) = compile::<f64>(&module, vec![]) else { return 1 };
    let limits = Limits { steps: 20_000, bytes: 1 << 24 };
    let mut stage = 3;
    for depth_first in [true, false] {
        let mut machine = Machine::new(&program, limits);
        let Ok(mut state) = machine.start(&[], depth_first) else { return 2 };
        match machine.finish(&mut state, &mut InTurn(0)) {
            Ok(()) => _ = repr(&state.result()),
            Err(_) => stage = 2,
        }
    }
    stage
}

/// The message of a panic, if the text causes one.
fn panics(text: &str) -> Option<String> {
    let outcome = catch_unwind(AssertUnwindSafe(|| stage(text)));
    outcome.err().map(|panic| {
        let message = panic.downcast_ref::<String>().cloned();
        message.or_else(|| panic.downcast_ref::<&str>().map(ToString::to_string)).unwrap_or_default()
    })
}

#[test]
fn a_mutated_text_does_not_panic() {
    let from = |name: &str, other| std::env::var(name).map_or(other, |text| text.parse().expect("a number"));
    let (seed, count) = (from("NIWAKI_SEED", 1), from("NIWAKI_MUTANTS", 4000));
    let mut random = Random(seed);
    let texts: Vec<&str> = PROGRAMS.iter().map(|(_, text)| *text).chain([MORE; 8]).collect();
    let mut reached = [0; 4];
    for _ in 0..count {
        let text = mutated(texts[random.below(texts.len())], &mut random);
        match catch_unwind(AssertUnwindSafe(|| stage(&text))) {
            Ok(stage) => reached[stage] += 1,
            Err(_) => panic!("{:?}: {text}", panics(&text)),
        }
    }
    println!("{reached:?}");
    assert!(reached.iter().all(|n| *n > count / 100), "{reached:?}");
}

#[test]
fn texts_that_once_panicked_are_refused() {
    assert_eq!(stage(MORE), 3);
    assert!(!compiled(MORE).functions.is_empty());
    for body in [
        "(return (record 999))",
        "(return (record 70000 1))",
        "(return (dict (1 2) 3))",
        "(return (host 65536 1))",
    ] {
        let text = format!("(module (fn \"m\" (params) {body}) (entry \"m\"))");
        assert!(stage(&text) < 2, "{text}");
    }
    let entry = "(module (fn \"m\" (params $a) (defaults $b) (captures $b) (return $a)) (entry \"m\"))";
    assert_eq!(stage(entry), 1);
    assert_eq!(stage("(module (const 9999999999999 1) (fn \"m\" (params) (return 1)) (entry \"m\"))"), 0);
    assert_eq!(stage("(module (class 7 \"P\" ()) (fn \"m\" (params) (return (record 0))) (entry \"m\"))"), 0);
}

#[test]
fn the_compiler_leaves_long_computations_to_the_run() {
    for body in ["(to_list (range 1000000000000))", "(method \"a\" \"ljust\" 100000000000)"] {
        assert_eq!(
            stage(&format!("(module (fn \"m\" (params) (return {body})) (entry \"m\"))")),
            2,
            "{body}"
        );
    }
    let loops = "(for $i (range 1) (body (set $x $i) ".repeat(40) + "(do (factor 0))" + &"))".repeat(40);
    assert_eq!(stage(&format!("(module (fn \"m\" (params) {loops}) (entry \"m\"))")), 3);
}

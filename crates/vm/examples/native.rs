//! The speed of machine code: loops and functions of numbers, interpreted and compiled, in nanoseconds per
//! round.
//!
//! `cargo run --release -p niwaki-vm --example native`

#[path = "../tests/support/halves.rs"]
mod halves;

use halves::Halves;
use niwaki_vm::code::Program;
use niwaki_vm::core::parse::parse;
use niwaki_vm::machine::{Limits, Machine};
use niwaki_vm::passes::compile;
use niwaki_vm::value::repr;
use std::time::Instant;

const ROUNDS: u32 = 1_000_000;

const PROGRAMS: [(&str, &str); 6] = [
    (
        "sum of halves",
        "(fn \"m\" (params) (set $s 0.0)
        (for $i (range 1000000) (body (set $s (add $s (mul $i 0.5))))) (return $s))",
    ),
    (
        "whole numbers",
        "(fn \"m\" (params) (set $n 27) (set $k 0)
        (while (lt $k 1000000) (body (if (eq (mod $n 2) 0) (then (set $n (floordiv $n 2)))
            (else (set $n (mod (add (mul 3 $n) 1) 1000003)))) (set $k (add $k 1)))) (return $n))",
    ),
    (
        "sine and root",
        "(fn \"m\" (params) (set $x 0.3)
        (for $i (range 1000000) (body (set $x (sqrt (add 1.0 (mul 0.5 (sin (mul 3.0 $x)))))))) (return $x))",
    ),
    (
        "elements of a list",
        "(fn \"m\" (params) (set $xs (list 0.5 1.5 2.5 3.5)) (set $s 0.0)
        (for $k (range 250000) (body (for $x $xs (body (set $s (add $s (mul $x $x))))))) (return $s))",
    ),
    (
        "a pure function",
        "(fn \"wave\" (params $x $t) (set $y (mul $x $t)) (if (gt $y 1.0) (then (return (sub $y 1.0))))
            (return (add $y 0.25)))
        (fn \"m\" (params) (set $x 0.3)
        (for $i (range 1000000) (body (set $x (call \"wave\" $x 1.7)))) (return $x))",
    ),
    (
        "escapes of a map",
        "(fn \"m\" (params) (set $all 0)
        (for $i (range 20000) (body (set $x 0.0) (set $y 0.0) (set $k 0)
            (set $a (sub (mul 0.0001 $i) 1.5))
            (while (lt $k 50) (body (set $t (add (sub (mul $x $x) (mul $y $y)) $a))
                (set $y (add (mul 2.0 (mul $x $y)) 0.1)) (set $x $t)
                (if (gt (add (mul $x $x) (mul $y $y)) 4.0) (then (break)))
                (set $k (add $k 1)) (set $all (add $all 1)))))) (return $all))",
    ),
];

fn run(program: &Program) -> (String, f64) {
    let mut best = f64::INFINITY;
    let mut answer = String::new();
    for _ in 0..5 {
        let mut machine = Machine::new(program, Limits { steps: u64::MAX, ..Limits::default() });
        let mut state = machine.start(&[], true).expect("no arguments");
        let start = Instant::now();
        machine.finish(&mut state, &mut Halves).expect("no fault");
        best = best.min(start.elapsed().as_secs_f64());
        answer = repr(&state.result()).expect("a number").to_string();
    }
    (answer, best)
}

fn main() {
    println!("{:20} {:>12} {:>12} {:>7}", "", "interpreted", "compiled", "times");
    for (name, text) in PROGRAMS {
        let module = parse(&format!("(module {text} (entry \"m\"))")).expect("core form");
        let program: Program = compile(&module, vec![]).expect("a program");
        let (plain, quick) = (program.clone().with_machine_code_after(0), program);
        let ((interpreted, slow), (compiled, fast)) = (run(&plain), run(&quick));
        assert_eq!(interpreted, compiled, "{name}");
        let each = |seconds: f64| seconds / f64::from(ROUNDS) * 1e9;
        println!("{name:20} {:9.2} ns {:9.2} ns {:7.1}", each(slow), each(fast), slow / fast);
    }
}

//! The claim: machine code gives the same values to the last bit, the same faults at the same place, and takes the same
//! steps as the interpreter.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

use niwaki_geom::Shape;
use niwaki_math::Dist;
use niwaki_vm::code::Program;
use niwaki_vm::core::parse::parse;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::{Limits, Machine};
use niwaki_vm::passes::compile;
use niwaki_vm::value::{Value, repr};

/// Every choice is a half.
struct Halves;

impl Answers<f64> for Halves {
    fn choice(&mut self, _: &At<'_, f64>, _: &Dist) -> Result<Answer<Value>, Fault> {
        Ok(Answer::Go(Value::real(0.5)))
    }
    fn score(&mut self, _: &At<'_, f64>, _: Factor, _: f64) -> Result<Answer<()>, Fault> {
        Ok(Answer::Go(()))
    }
    fn emit(&mut self, _: &At<'_, f64>, _: &[Shape]) -> Result<Answer<()>, Fault> {
        Ok(Answer::Go(()))
    }
    fn query(&mut self, _: &At<'_, f64>, _: &Value, _: &Value) -> Result<(), Fault> {
        Ok(())
    }
    fn host(&mut self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        Ok(args[0].clone())
    }
}

/// What a run gives, or the fault with its stack; and its steps.
fn outcome(program: &Program, limits: Limits) -> (String, u64) {
    let mut machine = Machine::new(program, limits);
    let mut state = machine.start(&[], true).unwrap();
    match machine.finish(&mut state, &mut Halves) {
        Ok(()) => (repr(&state.result()).unwrap().to_string(), state.steps()),
        Err(fault) => (format!("{fault:?}"), state.steps()),
    }
}

/// The same with machine code and without, with all limits of steps up to a number.
fn agree(text: &str, most: u64) -> String {
    let program = compile::<f64>(&parse(text).unwrap(), vec![]).unwrap();
    let (plain, quick) =
        (program.clone().with_machine_code_after(0), program.with_machine_code_after(1));
    for steps in (0..most).chain([20_000_000]) {
        let limits = Limits { steps, ..Limits::default() };
        assert_eq!(outcome(&plain, limits), outcome(&quick, limits), "{steps} steps of {text}");
    }
    outcome(&quick, Limits::default()).0
}

fn entry(body: &str) -> String {
    format!("(module (fn \"m\" (params) {body}) (entry \"m\"))")
}

#[test]
fn loops_of_numbers() {
    let sum = entry(
        "(set $s 0) (for $i (range 1000) (body (set $s (add $s (mul $i 0.5))))) (return $s)",
    );
    assert_eq!(agree(&sum, 40), "249750.0");
}

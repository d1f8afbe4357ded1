//! Answers for runs whose choices do not matter.

use niwaki_math::Dist;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At};
use niwaki_vm::value::Value;

/// Answers every choice with a half.
pub struct Halves;

impl Answers<f64> for Halves {
    fn choice(&mut self, _: &At<'_, f64>, _: &Dist) -> Result<Answer<Value>, Fault> {
        Ok(Answer::Go(Value::real(0.5)))
    }
    fn host(&mut self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        Ok(args[0].clone())
    }
}

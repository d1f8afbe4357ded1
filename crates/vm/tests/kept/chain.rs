//! A chain of single-site proposals from the prior, which is small enough to be its own specification.

use niwaki_geom::Shape;
use niwaki_math::{Dist, Stream};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::kept::inspect::Item;
use niwaki_vm::machine::kept::{Change, Changed, Propose, Proposed, Strategy, Totals, Trace};
use niwaki_vm::machine::{Limits, Machine};
use niwaki_vm::value::Value;
use std::collections::HashMap;

/// Draws new choices from their priors, or takes their values from a table.
struct Draws {
    seed: u64,
    visit: u64,
    known: HashMap<u128, Value>,
}

impl Answers<f64> for Draws {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        if let Some(value) = self.known.get(&at.address()) {
            return Ok(Answer::Go(value.clone()));
        }
        Ok(Answer::Go(Value::from(dist.sample(&mut Stream::new(self.seed, 0, at.address(), self.visit)))))
    }
    fn score(&mut self, _: &At<'_, f64>, _: Factor, _: f64) -> Result<Answer<()>, Fault> {
        unreachable!("a kept run keeps its own scores")
    }
    fn emit(&mut self, _: &At<'_, f64>, _: &[Shape]) -> Result<Answer<()>, Fault> {
        unreachable!("a kept run keeps its own scene")
    }
    fn query(&mut self, _: &At<'_, f64>, _: &Value, _: &Value) -> Result<(), Fault> {
        unreachable!("a kept run keeps its own table")
    }
    fn host(&mut self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        Ok(args[0].clone())
    }
}

impl Propose<f64> for Draws {
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        dist: &Dist,
        _: &Value,
        log_density: f64,
    ) -> Result<Proposed<f64>, Fault> {
        let draw = dist.sample(&mut Stream::new(self.seed, 1, at.address(), self.visit));
        let forward = niwaki_math::grid(dist.log_density(&draw));
        Ok(Proposed { value: Value::from(draw), forward, backward: log_density })
    }
}

pub struct Chain<'p> {
    program: &'p Program,
    machine: Machine<'p>,
    pub trace: Trace,
    strategy: Strategy,
    seed: u64,
    pub accepted: u64,
}

impl<'p> Chain<'p> {
    pub fn start(program: &'p Program, strategy: Strategy, seed: u64) -> Self {
        let mut machine = Machine::new(program, Limits::default());
        let mut visit = 0;
        loop {
            let mut draws = Draws { seed, visit, known: HashMap::new() };
            let (mut trace, change) = machine.begin(&[], &mut draws).expect("a run");
            if change == Change::Done {
                trace.commit(program);
                return Chain { program, machine, trace, strategy, seed, accepted: 0 };
            }
            visit += 1;
            assert!(visit < 1000, "no possible start");
        }
    }

    fn pick(&self, step: u64, salt: u128) -> f64 {
        Stream::new(self.seed, 2, salt, step).uniform()
    }

    fn decide(&mut self, step: u64, became: Change) -> String {
        let (change, before, choices) = (self.trace.change(), self.trace.len(), self.trace.len_after());
        let (fresh, stale) = self.trace.fresh_and_stale();
        let (forward, backward) = self.trace.forward_and_backward();
        let mut sum = change.log_prior.plus(&change.log_factors);
        sum.add_total(stale);
        sum.remove_total(fresh);
        let log_ratio = sum.value() + (backward - forward) + (before as f64 / choices as f64).ln();
        let mut after = self.trace.totals().clone();
        after.add(change);
        let accept = became == Change::Unchanged
            || (became == Change::Done && self.pick(step, 2).ln() < log_ratio && !after.is_impossible());
        if accept {
            self.trace.commit(self.program);
            self.accepted += 1;
        } else {
            self.trace.rollback(self.program);
        }
        match became {
            Change::Impossible => "impossible".into(),
            // The text has everything that decides, to the bit.
            Change::Unchanged => "same".into(),
            Change::Done => format!("{accept} {log_ratio:?} {after:?} {choices}"),
        }
    }

    pub fn step(&mut self, step: u64) -> String {
        let change = self.propose(step);
        self.decide(step, change)
    }

    fn propose(&mut self, step: u64) -> Change {
        let choice = (self.pick(step, 1) * self.trace.len() as f64) as usize;
        let mut proposer = Draws { seed: self.seed, visit: step + 10_000, known: HashMap::new() };
        let mut draws = Draws { seed: self.seed, visit: step + 10_000, known: HashMap::new() };
        self.machine
            .propose(&mut self.trace, choice, self.strategy, &mut proposer, &mut draws)
            .expect("a run")
    }

    pub fn propose_and_roll_back(&mut self, step: u64) {
        self.propose(step + 1_000_000);
        self.trace.rollback(self.program);
    }

    /// Moves several numbers at once, each to a nearby value.
    pub fn block(&mut self, step: u64) -> String {
        let mut changes = Vec::new();
        for choice in self.trace.numbers() {
            let (value, _) = self.trace.choice(self.program, choice);
            let u = self.pick(step, 100 + choice as u128);
            if u < 0.5 {
                let value = match value {
                    Value::Real(x) => Value::Real(x + u - 0.25),
                    Value::Bool(b) => Value::Bool(!b),
                    other => other.clone(),
                };
                changes.push(Changed { choice, proposed: Proposed { value, forward: 0.0, backward: 0.0 } });
            }
        }
        let mut draws = Draws { seed: self.seed, visit: step + 10_000, known: HashMap::new() };
        let change = self.machine.change(&mut self.trace, changes, self.strategy, &mut draws).expect("a run");
        self.decide(step, change)
    }

    /// The log densities of proposing these changes and their reverse after a run; the changes are undone.
    pub fn forward_and_backward(&mut self, changes: Vec<Changed<f64>>) -> (f64, f64) {
        let mut draws = Draws { seed: self.seed, visit: 1, known: HashMap::new() };
        self.machine.change(&mut self.trace, changes, self.strategy, &mut draws).expect("a run");
        let both = self.trace.forward_and_backward();
        self.trace.rollback(self.program);
        both
    }

    /// The contents of the trace, as text.
    pub fn dump(&self) -> String {
        let mut text = format!("{:?} {:?}\n", self.trace.result(), self.trace.totals());
        self.trace.visit(self.program, |place, item| {
            let text_of_item = match item {
                Item::Choice(value, log) => format!("{value:?} {log:?}"),
                Item::Held(value, log) => format!("held {value:?} {log:?}"),
                Item::Factor(log) => format!("{log:?}"),
                Item::Emit(primitive) => format!("{:?}", primitive.aabb()),
                Item::Query(key, value) => format!("{key:?} = {value:?}"),
            };
            text += &format!("{} {text_of_item}\n", place.path());
        });
        for choice in self.trace.numbers() {
            text += &format!("{:x} ", self.trace.address(self.program, choice));
        }
        text
    }
}

/// The sums of a new run with the chain's choices; its transaction is still open.
pub fn fresh_totals(program: &Program, chain: &Chain) -> Totals {
    let mut known = HashMap::new();
    chain.trace.visit(program, |place, item| {
        if let Item::Choice(value, _) = item {
            known.insert(place.address(), value.clone());
        }
    });
    let mut machine = Machine::new(program, Limits::default());
    let mut draws = Draws { seed: 0, visit: 0, known };
    let (trace, change) = machine.begin(&[], &mut draws).expect("a run");
    assert_eq!(change, Change::Done);
    trace.change().clone()
}

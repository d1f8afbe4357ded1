//! The claim: a choice knows the box of the part that was emitted last on its call path. The box is the same in
//! every order of running, and a run that does not record parts has none.

use niwaki_geom::{Aabb, Shape};
use niwaki_math::Dist;
use niwaki_vm::core::parse::parse;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At};
use niwaki_vm::machine::kept::part::{Part, Piece};
use niwaki_vm::machine::state::State;
use niwaki_vm::machine::{Limits, Machine, Stop};
use niwaki_vm::passes::compile;
use niwaki_vm::value::Value;
use std::collections::BTreeMap;

/// Parts along x at 1, 2, ...; each is 1 wide, 2 high and 4 deep.
const PROGRAM: &str = r#"(module
  (fn "part" (params $x) (return (box (tuple $x 0.0 0.0) (tuple 1.0 2.0 4.0))))
  (fn "leaf" (params $x)
    (set $before (sample (dist bernoulli 0.5)))
    (do (emit (call "part" $x)))
    (set $after (sample (dist bernoulli 0.5)))
    (return 0))
  (fn "m" (params)
    (set $a (sample (dist bernoulli 0.5)))
    (do (emit (call "part" 1.0) (call "part" 2.0)))
    (set $b (sample (dist bernoulli 0.5)))
    (set $f (future "leaf" 10.0))
    (do (call "leaf" 20.0))
    (do (emit))
    (set $c (sample (dist bernoulli 0.5)))
    (for $i (range 2) (body
      (set $d (sample (dist bernoulli 0.5)))
      (do (emit (call "part" (add 30.0 $i))))
      (set $g (future "leaf" (add 40.0 $i)))
      (for $j (range 2) (body
        (set $e (sample (dist bernoulli 0.5)))
        (do (emit (call "part" (add (add 50.0 (mul 10.0 $j)) $i))))))))
    (set $h (sample (dist bernoulli 0.5)))
    (do (force $f))
    (set $k (sample (dist bernoulli 0.5)))
    (return 0)) (entry "m"))"#;

/// Records the part at every choice, by the choice's address, and the labels in the order of running. Pauses at
/// each `emit`.
#[derive(Default)]
struct PartRecord {
    parts: BTreeMap<u128, (String, Option<Aabb>)>,
    order: Vec<(String, f64)>,
}

impl Answers<f64> for PartRecord {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        let (label, part) = (at.site.label.to_string(), at.part().copied());
        self.order.push((label.clone(), part.map_or(0.0, |part| part.center().x)));
        assert!(self.parts.insert(at.address(), (label, part)).is_none());
        Ok(Answer::Go(Value::from(dist.enumerate().expect("a finite choice")[0].clone())))
    }
    fn emit(&mut self, _: &At<'_, f64>, _: &[Shape]) -> Result<Answer<()>, Fault> {
        Ok(Answer::Pause)
    }
    fn host(&mut self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        Ok(args[0].clone())
    }
}

/// Runs the futures in the order that `pick` chooses, and continues with a copy of the state after every pause.
fn run(depth_first: bool, asks: bool, pick: impl Fn(usize) -> usize) -> PartRecord {
    let program = compile(&parse(PROGRAM).expect("core form"), vec![]).expect("a program");
    let (mut machine, mut record) = (Machine::new(&program, Limits::default()), PartRecord::default());
    let mut state = machine.start(&[], depth_first).expect("a start");
    if asks {
        state.note_parts();
    }
    while !state.has_ended() {
        let next = state.runnable().get(pick(state.runnable().len())).expect("a place");
        if machine.resume(&mut state, next, &mut record).expect("a run") == Stop::Paused {
            let mut copy = State::clone(&state);
            copy.clone_from(&state);
            state = copy;
        }
    }
    record
}

#[test]
fn a_choice_knows_the_last_part_on_its_call_path() {
    let record = run(true, true, |_| 0);
    let expected = [
        ("a", 0.0),
        ("b", 2.0),
        // A future and a call both see the part of their caller; the parts that they emit are their own.
        ("before", 2.0),
        ("after", 10.0),
        ("before", 2.0),
        ("after", 20.0),
        ("c", 2.0),
        // Iterations pass the part on, also the iterations of an inner loop.
        ("d", 2.0),
        ("before", 30.0),
        ("after", 40.0),
        ("e", 30.0),
        ("e", 50.0),
        ("d", 60.0),
        ("before", 31.0),
        ("after", 41.0),
        ("e", 31.0),
        ("e", 51.0),
        ("h", 61.0),
        ("k", 61.0),
    ];
    let parts_by_label: Vec<(&str, f64)> = record.order.iter().map(|(label, x)| (&**label, *x)).collect();
    assert_eq!(parts_by_label, expected);
    for part in record.parts.values().filter_map(|(_, part)| *part) {
        assert_eq!(part.extent().to_array(), [1.0, 2.0, 4.0]);
        assert_eq!(part.center().to_array()[1..], [0.0, 0.0]);
    }
}

#[test]
fn the_order_of_running_does_not_matter() {
    let parts = run(true, true, |_| 0).parts;
    for pick in [|_| 0, |n| n - 1, |n| n / 2] as [fn(usize) -> usize; 3] {
        assert_eq!(run(false, true, pick).parts, parts);
    }
}

#[test]
fn a_run_that_does_not_record_parts_has_none() {
    assert!(run(false, false, |_| 0).parts.values().all(|(_, part)| part.is_none()));
}

#[test]
fn a_kept_run_has_the_same_parts() {
    let program = compile(&parse(PROGRAM).expect("core form"), vec![]).expect("a program");
    let mut machine = Machine::new(&program, Limits::default());
    let (mut trace, _) = machine.begin(&[], &mut PartRecord::default()).expect("a run");
    trace.commit(&program);
    let parts = run(true, true, |_| 0).parts;
    assert_eq!(trace.len(), parts.len());
    for choice in 0..trace.len() {
        let (label, part) = &parts[&trace.address(&program, choice)];
        assert_eq!(trace.part(&program, choice), *part, "{label}");
    }
}

#[test]
fn a_part_that_runs_separately_has_the_same_parts() {
    let program = compile(&parse(PROGRAM).expect("core form"), vec![]).expect("a program");
    let mut machine = Machine::new(&program, Limits::default());
    let (mut trace, _) = machine.begin(&[], &mut PartRecord::default()).expect("a run");
    trace.commit(&program);
    let parts = run(true, true, |_| 0).parts;
    let mut parts_to_run = vec![Part::WHOLE];
    let mut seen = 0;
    while let Some(part) = parts_to_run.pop() {
        trace.pieces(&program, part, |piece| {
            if let Piece::Part(below) = piece {
                parts_to_run.push(below);
            }
        });
        let mut state = trace.start_part(&program, part, false);
        trace.note_parts(&program, part, &mut state);
        let mut record = PartRecord::default();
        while let Some(next) = state.runnable().first() {
            machine.resume(&mut state, next, &mut record).expect("a run");
        }
        for (address, part) in &record.parts {
            assert_eq!(parts[address], *part);
            seen += 1;
        }
    }
    assert!(seen > 2 * parts.len());
}

//! The claim: the trace is the same to the bit, whichever part of a run is repeated. The four strategies agree,
//! a rollback restores everything, and the sums equal those of a new run with the same choices.

mod chain;
mod programs;

use chain::{Chain, fresh_totals};
use niwaki_vm::code::Op;
use niwaki_vm::core::parse::parse;
use niwaki_vm::machine::kept::{Changed, Proposed, Strategy};
use niwaki_vm::passes::{Scope, compile_with_scope};
use niwaki_vm::value::Value;
use programs::{PROGRAMS, compiled};

const STRATEGIES: [Strategy; 4] = [Strategy::Rerun, Strategy::Resume, Strategy::Cache, Strategy::C3];

#[test]
fn four_strategies_make_the_same_chain() {
    for (name, text) in PROGRAMS {
        let program = compiled(text);
        for seed in 0..4 {
            let mut chains: Vec<Chain> =
                STRATEGIES.iter().map(|strategy| Chain::start(&program, *strategy, seed)).collect();
            for step in 0..400 {
                let outcomes: Vec<String> = chains.iter_mut().map(|chain| chain.step(step)).collect();
                for (strategy, outcome) in STRATEGIES.iter().zip(&outcomes) {
                    assert_eq!(outcome, &outcomes[0], "{name}, seed {seed}, step {step}, {strategy:?}");
                }
                if step % 20 == 0 {
                    let dumps: Vec<String> = chains.iter().map(Chain::dump).collect();
                    for (strategy, dump) in STRATEGIES.iter().zip(&dumps) {
                        assert_eq!(dump, &dumps[0], "{name}, seed {seed}, step {step}, {strategy:?}");
                    }
                    let fresh = fresh_totals(&program, &chains[0]);
                    assert_eq!(&fresh, chains[3].trace.totals(), "{name}, seed {seed}, step {step}: sums");
                }
            }
            assert!(chains[0].accepted > 0, "{name}: no proposal was accepted");
        }
    }
}

#[test]
fn readable_variables_do_not_change_a_chain() {
    let mut visible = 0;
    for (name, text) in PROGRAMS {
        let plain = compiled(text);
        let with_scope =
            compile_with_scope(&parse(text).expect("core form"), vec![], Scope::All).expect("a program");
        visible += with_scope.functions.iter().map(|f| f.scope.len()).sum::<usize>();
        for seed in 0..3 {
            let mut rerun = Chain::start(&plain, Strategy::Rerun, seed);
            let start = |strategy: &Strategy| Chain::start(&with_scope, *strategy, seed);
            let mut chains: Vec<Chain> = STRATEGIES.iter().map(start).collect();
            for step in 0..200 {
                let outcome = rerun.step(step);
                for (strategy, chain) in STRATEGIES.iter().zip(&mut chains) {
                    assert_eq!(chain.step(step), outcome, "{name}, seed {seed}, step {step}, {strategy:?}");
                }
                if step % 40 == 0 {
                    let dump = rerun.dump();
                    chains.iter().for_each(|chain| assert_eq!(chain.dump(), dump, "{name}, seed {seed}"));
                }
            }
        }
    }
    assert!(visible > 4 * PROGRAMS.len(), "{visible} variables");
}

#[test]
fn a_block_of_changes_agrees_with_a_rerun() {
    for (name, text) in PROGRAMS {
        let program = compiled(text);
        for seed in 0..4 {
            let mut a = Chain::start(&program, Strategy::Rerun, seed);
            let mut b = Chain::start(&program, Strategy::C3, seed);
            for step in 0..200 {
                assert_eq!(a.block(step), b.block(step), "{name}, seed {seed}, step {step}");
            }
            assert_eq!(a.dump(), b.dump(), "{name}, seed {seed}");
            assert_eq!(&fresh_totals(&program, &a), b.trace.totals(), "{name}, seed {seed}: sums");
        }
    }
}

/// The claim: a changed choice that the run no longer reaches does not count in the move's density; a choice
/// that it reaches does.
#[test]
fn choices_that_are_not_reached_do_not_count_in_the_proposal() {
    let program = compiled(
        r#"(module (fn "m" (params) (set $b (sample (dist bernoulli 0.5)))
            (if $b (then (set $x (sample (dist gaussian 0.0 1.0))) (do (factor $x)))) (return $b)) (entry "m"))"#,
    );
    for strategy in STRATEGIES {
        let with_x = |seed: &u64| Chain::start(&program, strategy, *seed).trace.len() == 2;
        let mut chain = Chain::start(&program, strategy, (0..).find(with_x).expect("a seed"));
        let (b, x) = match chain.trace.choice(&program, 0).0 {
            Value::Bool(_) => (0, 1),
            _ => (1, 0),
        };
        let change = |choice, value, forward, backward| Changed {
            choice,
            proposed: Proposed { value, forward, backward },
        };
        let moved = || change(x, Value::Real(0.25), -1.0, -2.0);
        assert_eq!(chain.forward_and_backward(vec![moved()]), (-1.0, -2.0));
        let unreached = vec![change(b, Value::Bool(false), -0.5, -0.25), moved()];
        assert_eq!(chain.forward_and_backward(unreached), (-0.5, -0.25));
    }
}

/// Each mutant is a slice of a choice, of a call's result, or of a single changed argument or capture. The
/// slice ends before one of its instructions.
#[test]
fn a_slice_without_one_instruction_is_detected() {
    let program = compiled(
        r#"(module
          (fn "line" (params $n $a0 $sy)
            (set $t (mul 0.25 $n))
            (set $a (sample (dist gaussian $a0 1.0)))
            (set $b (sample (dist gaussian $t 1.0)))
            (do (observe (dist gaussian (add $a $b) $sy) $t))
            (return (tuple $a $n)))
          (fn "m" (params)
            (set $a0 (sample (dist gaussian 0.0 2.0))) (set $sy (sample (dist uniform 0.5 2.0)))
            (for $i (range 3) (body
              (set $one (call "line" $i $a0 $sy))
              (do (factor (mul -0.1 (index $one 0))))))) (entry "m"))"#,
    );
    let mut mutants = 0;
    for (number, f) in program.functions.iter().enumerate() {
        let mut starts: Vec<u32> = f.sites.iter().map(|site| site.again).chain(f.outers.clone()).collect();
        if &*f.name == "line" {
            starts.extend(&f.inputs[1..]);
        }
        starts.retain(|start| *start >= f.body);
        starts.sort_unstable();
        starts.dedup();
        for start in starts {
            let ends = |op: &Op| matches!(op, Op::Done | Op::Return { .. } | Op::ReturnIteration { .. });
            let length = f.code[start as usize..].iter().position(ends).expect("an end");
            for at in start as usize..=start as usize + length {
                if f.code[at] == Op::Done {
                    continue;
                }
                let mut mutant = program.clone();
                mutant.functions[number].code[at] = Op::Done;
                let mut rerun = Chain::start(&program, Strategy::Rerun, 3);
                let mut mutated = Chain::start(&mutant, Strategy::C3, 3);
                let differs = (0..300).any(|step| rerun.step(step) != mutated.step(step));
                let sums = &fresh_totals(&program, &mutated) != mutated.trace.totals();
                assert!(differs || sums, "{} without {:?} at {at}", f.name, f.code[at]);
                mutants += 1;
            }
        }
    }
    assert!(mutants >= 10, "{mutants} mutants");
}

#[test]
fn a_rollback_restores_everything() {
    for (name, text) in PROGRAMS {
        let program = compiled(text);
        for strategy in STRATEGIES {
            let mut chain = Chain::start(&program, strategy, 7);
            for step in 0..150 {
                let before = chain.dump();
                chain.propose_and_roll_back(step);
                assert_eq!(before, chain.dump(), "{name}, {strategy:?}, step {step}");
                chain.step(step);
            }
        }
    }
}

#[test]
fn call_sites_without_benefit_are_switched_off_without_other_effects() {
    // The argument of the inner call changes with every proposal of the first choice.
    let program = compiled(
        r#"(module (fn "leaf" (params $x) (do (observe (dist gaussian $x 1.0) 0.5)) (return $x))
          (fn "m" (params) (set $x (sample (dist gaussian 0.0 1.0))) (set $y (call "leaf" $x)) (return $y)) (entry "m"))"#,
    );
    let mut on = Chain::start(&program, Strategy::C3, 5);
    on.trace.adapt(&program, None);
    let mut adapted = Chain::start(&program, Strategy::C3, 5);
    assert_eq!(adapted.trace.cached_calls(&program), (1, 1));
    for step in 0..300 {
        assert_eq!(on.step(step), adapted.step(step));
    }
    assert_eq!(on.trace.cached_calls(&program), (1, 1));
    assert_eq!(adapted.trace.cached_calls(&program), (1, 0));
    assert_eq!(on.dump(), adapted.dump());
}

#[test]
fn a_long_run_holds_no_more_memory_than_a_short_one() {
    // Programs that create and remove activations hold no more after a long run than after a short run, up to
    // their largest size.
    let program = compiled(programs::GEOMETRIC);
    let mut chain = Chain::start(&program, Strategy::C3, 3);
    let mut largest = [0; 2];
    for (half, largest) in largest.iter_mut().enumerate() {
        for step in 0..20_000 {
            chain.step(half as u64 * 20_000 + step);
            *largest = (*largest).max(chain.trace.bytes());
        }
    }
    assert!(largest[1] < 3 * largest[0], "{largest:?}");
}

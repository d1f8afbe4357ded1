//! The claim: a proposal that uses variables in scope gives the exact answer, and the same chain to the bit under all four
//! strategies: its variables are kept up to date even where nothing else in the model reads them. Keeping variables
//! changes nothing else: a chain that does not use them has the same states.
//!
//! The shares of values are judged as in `board`: z beyond 6 once in 8 million, about 60 of them.

use super::board::furthest;
use super::programs::{PROGRAMS as OF_THE_MACHINE, task};
use niwaki_agreement::compare;
use niwaki_chain::kernel::Kernel;
use niwaki_chain::leaf::Proposer;
use niwaki_chain::{Chain, Settings};
use niwaki_propose::user::User;
use niwaki_run::Task;
use niwaki_run::select::Selection;
use niwaki_vm::core::Name;
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::{Scope, compile_with_scope};
use std::sync::Arc;

/// The description, the program, a pattern and the proposal for the choices that match it.
const PROGRAMS: [(&str, &str, &str, &str); 6] = [
    (
        "a pure value that only the proposal reads, and one of two arms",
        r#"(module (fn "m" (params)
            (set $a (sample (dist discrete_uniform 0 2)))
            (set $w (mul 0.2 (add $a 1)))
            (if (gt $a 0) (then (set $v 0.3)) (else (set $v (sample (dist bernoulli 0.5)))))
            (set $b (sample (dist bernoulli 0.4)))
            (do (factor (cond $b (mul 0.5 $a) -0.2)))
            (return (tuple $a $b))) (entry "m"))"#,
        "b",
        "(params $w $old $v) (return (dist bernoulli (cond $old $w (cond (gt $v 0.5) 0.3 0.6))))",
    ),
    (
        "variables of the function around a loop, that the loop does not read",
        r#"(module (fn "m" (params)
            (set $a (sample (dist bernoulli 0.6)))
            (set $p (cond $a 0.8 0.3))
            (set $n 0)
            (for $i (range (cond $a 3 2)) (body (set $b (sample (dist bernoulli 0.4))) (set $n (add $n (cond $b 1 0)))))
            (do (factor (mul -0.7 $n)))
            (return (tuple $a $n))) (entry "m"))"#,
        "b",
        "(params $p $i $n $old) (return (dist bernoulli (cond $old (mul $p 0.7) (div (add $i 1.0) (add 5.0 $n)))))",
    ),
    (
        "a parameter of a recursion",
        r#"(module
          (fn "more" (params $k)
            (if (ge $k 4) (then (return $k)))
            (set $on (sample (dist bernoulli 0.6)))
            (if $on (then (return (call "more" (add $k 1)))))
            (return $k))
          (fn "m" (params) (set $k (call "more" 0)) (do (factor (mul 0.8 $k))) (return $k)) (entry "m"))"#,
        "on",
        "(params $k $old) (return (dist bernoulli (cond $old 0.5 (div 1.0 (add 1.2 $k)))))",
    ),
    (
        "a variable that a loop assigns, and that nothing but the proposal reads",
        r#"(module
          (fn "m" (params)
            (set $s 0) (set $n 0)
            (for $i (range 3) (body
              (set $x (sample (dist bernoulli 0.4)))
              (for $j (range 2) (body (set $s (cond $x 1 0))))
              (set $n (add $n (cond $x 1 0)))))
            (do (factor (mul 0.5 $n)))
            (return $n))
          (entry "m"))"#,
        "x",
        "(params $s $old) (return (dist bernoulli (cond (eq $s 1) 0.7 0.3)))",
    ),
    (
        "a value that a loop hands on",
        r#"(module (const 0 (list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4))
            (dist categorical (list 0.3 0.3 0.4))))
          (fn "m" (params) (set $s 0)
            (for $i (range 3) (body (set $s (sample (index (data 0) $s)))
              (do (factor (cond (eq $s $i) 0.5 -0.5)))))
            (return $s)) (entry "m"))"#,
        "s",
        "(params $s $i) (return (dist categorical (list (add 0.5 $s) 1.0 (add 0.2 $i))))",
    ),
    (
        "what a call returned, and an element of a list",
        r#"(module (fn "leaf" (params $q) (set $x (sample (dist discrete_uniform 0 2))) (do (factor (mul $q $x))) (return $x))
          (fn "m" (params) (set $y (call "leaf" 0.3)) (set $xs (list (add $y 0.5) 2.0)) (set $e (index $xs 0))
            (set $z (sample (dist discrete_uniform 0 2)))
            (do (factor (cond (eq $z $y) 0.6 -0.1)))
            (return (tuple $y $z))) (entry "m"))"#,
        "z",
        "(params $y $e $old) (return (dist categorical (list (add 0.2 $y) (add 0.5 $old) $e)))",
    ),
];

/// The program compiled to keep the proposal's variables, and a kernel of the prior and the proposal.
fn case(text: &str, pattern: &str, function: &str) -> (Task, Kernel) {
    let user = User::new(task(&format!(r#"(module (fn "q" {function}) (entry "q"))"#))).expect("a proposal");
    let names: Vec<Name> = user.variables().cloned().collect();
    let program = compile_with_scope(&parse(text).expect("core form"), vec![], Scope::Names(&names))
        .expect("a program");
    let on = Selection { sites: vec![vec![pattern.into()]], ..Selection::default() };
    let scoped = Kernel::On(on, Box::new(Kernel::Leaf(Proposer::Proposal(Arc::new(user)))));
    (Task::new(Arc::new(program)), Kernel::Cycle(vec![Kernel::PRIOR, scoped.clone(), scoped]))
}

fn settings(kernel: Kernel) -> Settings {
    Settings { seed: 11, kernel, thin: 0, ..Settings::default() }
}

fn z((_, text, pattern, function): (&str, &str, &str, &str)) -> f64 {
    let (kept, kernel) = case(text, pattern, function);
    furthest(&kept, &task(text), &settings(kernel))
}

#[test]
fn a_proposal_with_variables_in_scope_gives_the_exact_answer() {
    for program in PROGRAMS {
        let z = z(program);
        assert!(z < 6.0, "{}: {z}", program.0);
    }
}

#[test]
fn four_strategies_agree_with_proposals_in_scope() {
    for (name, text, pattern, function) in PROGRAMS {
        let (kept, kernel) = case(text, pattern, function);
        let (difference, compared) = compare(&kept, &settings(kernel), 2000, 30).expect("a chain");
        assert!(difference.is_none(), "{name}: {}", difference.unwrap_or_default());
        assert!(compared.accepted > 100, "{name}");
    }
}

#[test]
fn to_keep_variables_changes_no_chain() {
    let states = |task: &Task| {
        let mut chain: Chain = Chain::start(task, &settings(Kernel::PRIOR), 0, None).expect("a first state");
        let ended = chain.advance(task, 500, &mut |_, _| true).map_err(|failure| failure.to_string());
        let totals = chain.state.trace.totals();
        let score = chain.state.log_score();
        (ended, totals.log_prior.value().to_bits(), score.to_bits(), chain.state.trace.result())
    };
    for (name, text, pattern, function) in PROGRAMS {
        let (kept, _) = case(text, pattern, function);
        assert_eq!(states(&kept), states(&task(text)), "{name}");
    }
    for (name, text) in PROGRAMS.map(|program| (program.0, program.1)).iter().chain(OF_THE_MACHINE) {
        let all =
            compile_with_scope(&parse(text).expect("core form"), vec![], Scope::All).expect("a program");
        let all = Task::new(Arc::new(all));
        assert_eq!(states(&all), states(&task(text)), "{name}");
    }
}

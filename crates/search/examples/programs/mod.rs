//! The programs whose speed and instructions are measured, in core form.

#![allow(dead_code)] // Each example uses some of them.

use niwaki_chain::Chain;
use niwaki_chain::kernel::Kernel;
use niwaki_chain::leaf::Proposer;
use niwaki_particles::{Settings, smc};
use niwaki_run::Task;
use niwaki_run::order::Order;
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use std::sync::Arc;

/// The task of a program without arguments, in core form.
pub fn task(text: &str) -> Task {
    let program = compile(&parse(text).expect("core form"), vec![]).expect("a program");
    Task::new(Arc::new(program))
}

/// Runs particles depth first; returns how many steps they took.
pub fn particle_steps(task: &Task, particles: usize, seed: u64) -> usize {
    let settings = Settings { particles, order: Order::DepthFirst, seed, ..Settings::default() };
    let (mut steps, mut ended) = (0, 0);
    smc(task, &settings, &mut |progress| {
        steps += particles - ended;
        ended = progress.ended;
        true
    })
    .expect("a result");
    steps
}

/// A hidden Markov model of 100 steps with three states.
pub fn hmm() -> String {
    let states = "(list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4)) \
                  (dist categorical (list 0.3 0.3 0.4)))";
    format!(
        "(module (const 0 {states}) (const 1 {states}) (fn \"m\" (params) (set $s 0) \
         (for $i (range 100) (body (set $s (sample (index (data 0) $s))) \
         (do (observe (index (data 1) $s) (mod $i 3))))) (return $s)) (entry \"m\"))"
    )
}

/// A recursive walk that branches; its factors pull it outwards.
pub const BRANCHING: &str = r#"(module
      (fn "branch" (params $x $y $h $d)
        (set $angle (sample (dist gaussian $h 0.3)))
        (set $len (sample (dist uniform 0.5 1.5)))
        (set $nx (add $x (mul $len (cos $angle)))) (set $ny (add $y (mul $len (sin $angle))))
        (set $e (div (sub (sqrt (add (mul $nx $nx) (mul $ny $ny))) (add $d 1)) 1.5))
        (do (factor (sub 0.35 (mul (mul 0.5 $e) $e))))
        (if (lt $d 5) (then (if (sample (dist bernoulli 0.7))
          (then (do (call "branch" $nx $ny (add $angle 0.5) (add $d 1)))
                (do (call "branch" $nx $ny (sub $angle 0.5) (add $d 1))))
          (else (do (call "branch" $nx $ny $angle (add $d 1))))))))
      (fn "m" (params) (do (call "branch" 0.0 0.0 0.0 0))) (entry "m"))"#;

/// A hidden Markov model, a mixture, topics and a regression.
pub fn of_chains(n: usize) -> [(&'static str, String); 4] {
    let list_of_ones = |count: usize| format!("(list{})", " 1.0".repeat(count));
    let hmm = format!(
        r#"(module (const 0 (list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4))
             (dist categorical (list 0.3 0.3 0.4))))
           (fn "m" (params) (set $s 0) (for $i (range {n}) (body (set $s (sample (index (data 0) $s)))
             (do (observe (index (data 0) $s) (mod $i 3))))) (return $s)) (entry "m"))"#
    );
    let mixture = format!(
        r#"(module (fn "m" (params)
            (set $w (sample (dist dirichlet (list 1.0 1.0 1.0 1.0)))) (set $mus (list)) (set $sds (list))
            (for $k (range 4) (body (set $mu (sample (dist gaussian 0.0 10.0))) (set $mus (add $mus (list $mu)))))
            (for $k (range 4) (body (set $sd (sample (dist uniform 0.1 4.0))) (set $sds (add $sds (list $sd)))))
            (for $i (range {n}) (body (set $z (sample (dist categorical $w)))
              (do (observe (dist gaussian (index $mus $z) (index $sds $z)) (sub (mul 5.0 (mod $i 3)) 4.0))))))
           (entry "m"))"#
    );
    let topics = format!(
        r#"(module (fn "m" (params) (set $topics (list))
            (for $k (range 10) (body (set $topics (append $topics (sample (dist dirichlet {}))))))
            (for $d (range {}) (body (set $theta (sample (dist dirichlet {})))
              (for $i (range 20) (body (set $z (sample (dist categorical $theta)))
                (do (observe (dist categorical (index $topics $z)) (mod (add $i $d) 20))))))))
           (entry "m"))"#,
        list_of_ones(20),
        n / 20,
        list_of_ones(10)
    );
    let regression = format!(
        r#"(module (const 0 (list -2.0 -1.0 0.0 1.0 2.0))
           (fn "line" (params $ys $a0 $b0 $sa $sb $sy)
             (set $a (sample (dist gaussian $a0 $sa))) (set $b (sample (dist gaussian $b0 $sb)))
             (for $p (zip (data 0) $ys) (body (unpack ($x $y) $p)
               (do (observe (dist gaussian (add $a (mul $b $x)) $sy) $y))))
             (return (tuple $a $b)))
           (fn "m" (params)
             (set $a0 (sample (dist gaussian 0.0 10.0))) (set $b0 (sample (dist gaussian 0.0 10.0)))
             (set $sa (sample (dist uniform 0.05 3.0))) (set $sb (sample (dist uniform 0.05 3.0)))
             (set $sy (sample (dist uniform 0.05 3.0))) (set $lines (list))
             (for $i (range {}) (body (set $lines (append $lines
               (call "line" (list 0.1 0.2 0.3 (mul 0.1 (mod $i 7)) 0.5) $a0 $b0 $sa $sb $sy)))))
             (return (tuple $a0 $lines)))
           (entry "m"))"#,
        n / 5
    );
    [("hmm", hmm), ("mixture", mixture), ("topics", topics), ("regression", regression)]
}

/// A chain over one of these programs, by proposals of single choices.
pub fn chain(name: &str, task: &Task) -> Chain {
    let kernel = if name == "hmm" { Kernel::PRIOR } else { Kernel::Leaf(Proposer::ByFamily {}) };
    let settings = niwaki_chain::Settings { seed: 1, kernel, thin: 0, ..niwaki_chain::Settings::default() };
    Chain::start(task, &settings, 0, None).expect("a chain")
}

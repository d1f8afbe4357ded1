//! Programs that make, take away and re-enter activations in every way that the language has.

use niwaki_infer::Task;
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use std::sync::Arc;

pub fn task(text: &str) -> Task {
    Task::new(Arc::new(compile(&parse(text).expect("core form"), vec![]).expect("a program")))
}

/// A recursion of random depth.
pub const GEOMETRIC: &str = r#"(module
  (fn "more" (params $n)
    (if (sample (dist bernoulli 0.7)) (then (return (add 1 (call "more" (add $n 1)))))) (return 0))
  (fn "m" (params) (set $k (call "more" 0)) (do (factor (mul -0.1 $k))) (return $k)) (entry "m"))"#;

pub const PROGRAMS: &[(&str, &str)] = &[
    ("geometric", GEOMETRIC),
    (
        "hmm as a loop",
        r#"(module (const 0 (list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4))
            (dist categorical (list 0.3 0.3 0.4))))
          (fn "m" (params) (set $s 0)
            (for $i (range 12) (body (set $s (sample (index (data 0) $s)))
              (do (observe (index (data 0) $s) (mod $i 3))) (do (query $i $s)))) (return $s)) (entry "m"))"#,
    ),
    (
        "hmm by recursion",
        r#"(module (const 0 (list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4))
            (dist categorical (list 0.3 0.3 0.4))))
          (fn "step" (params $s) (return (sample (index (data 0) $s))))
          (fn "hmm" (params $n) (if (eq $n 0) (then (return (list 0))))
            (set $before (call "hmm" (sub $n 1)))
            (set $s (call "step" (index $before -1)))
            (do (observe (index (data 0) $s) (mod $n 3)))
            (return (add $before (list $s))))
          (fn "m" (params) (return (call "hmm" 8))) (entry "m"))"#,
    ),
    (
        "branches that change what there is",
        r#"(module (fn "arm" (params $x) (set $y (sample (dist gaussian $x 1.0))) (do (factor (neg (mul $y $y)))) (return $y))
          (fn "m" (params)
            (set $c (sample (dist bernoulli 0.5)))
            (if $c (then (set $a (call "arm" 1.0)) (set $b (sample (dist gaussian $a 2.0))))
              (else (set $a (sample (dist uniform 0.0 3.0))) (set $b 0.5)
                 (if (gt $a 1.5) (then (set $b (call "arm" $a))))))
            (set $d (sample (dist gaussian (add $a $b) 1.0)))
            (do (observe (dist gaussian $d 0.5) 1.0))
            (return (tuple $a $b $d))) (entry "m"))"#,
    ),
    (
        "loops with break, return and changing counts",
        r#"(module
          (fn "inner" (params $n)
            (set $t 0.0)
            (for $j (range $n) (body
              (set $u (sample (dist uniform 0.0 1.0)))
              (if (gt $u 0.9) (then (return (sub $t 10.0))))
              (if (gt $u 0.7) (then (break)))
              (if (lt $u 0.2) (then (continue)))
              (set $t (add $t (sample (dist gaussian $u 1.0))))))
            (return $t))
          (fn "m" (params)
            (set $k (sample (dist poisson 3.0)))
            (set $sum 0.0)
            (for $i (range $k) (body (set $sum (add $sum (call "inner" (add $i (mod $k 2)))))))
            (set $n 0)
            (while (sample (dist bernoulli 0.6)) (body (set $n (add $n 1)) (set $sum (add $sum (sample (dist gaussian $sum 1.0))))))
            (do (observe (dist gaussian $sum 2.0) 1.0))
            (return (tuple $k $n $sum))) (entry "m"))"#,
    ),
    (
        "nested loops that share captures",
        r#"(module (fn "m" (params)
            (set $mu (sample (dist gaussian 0.0 1.0))) (set $sd (sample (dist uniform 0.5 2.0)))
            (set $total 0.0)
            (for $i (range 4) (body
              (set $a (sample (dist gaussian $mu $sd)))
              (for $j (range 3) (body
                (set $b (sample (dist gaussian $a $sd)))
                (do (observe (dist gaussian $b 1.0) (mul 0.5 $j)))
                (set $total (add $total (mul $b 0.0)))))))
            (return $total)) (entry "m"))"#,
    ),
    (
        "closures that change",
        r#"(module
          (fn "up" (params $x) (captures $s) (return (add $x (sample (dist gaussian $s 1.0)))))
          (fn "down" (params $x) (captures $s) (set $y (sample (dist uniform 0.0 1.0))) (return (sub (sub $x $y) $s)))
          (fn "plain" (params $x) (return (mul $x 2.0)))
          (fn "m" (params)
            (set $w (sample (dist categorical (list 0.4 0.4 0.2))))
            (set $s (sample (dist gaussian 0.0 1.0)))
            (set $f (cond (eq $w 0) (closure "up" $s) (cond (eq $w 1) (closure "down" $s) (closure "plain"))))
            (set $x (apply $f 1.0)) (set $y (apply $f $x))
            (do (observe (dist gaussian $y 1.0) 0.3)) (return $y)) (entry "m"))"#,
    ),
    (
        "a choice whose family or dimension changes",
        r#"(module (fn "m" (params)
            (set $c (sample (dist categorical (list 0.3 0.3 0.4))))
            (set $d (cond (eq $c 0) (dist gaussian 0.0 1.0) (cond (eq $c 1) (dist uniform 0.0 2.0) (dist gamma 2.0 1.0))))
            (set $x (sample $d))
            (set $n (cond (eq $c 0) (list 1.0 2.0) (list 1.0 1.0 1.0)))
            (set $p (sample (dist dirichlet $n)))
            (do (observe (dist gaussian $x 1.0) (index $p 0))) (return $x)) (entry "m"))"#,
    ),
    (
        "supports that move",
        r#"(module (fn "m" (params)
            (set $w (sample (dist uniform 1.0 2.0))) (set $x (sample (dist uniform 0.0 $w)))
            (do (condition (lt $x 1.9))) (do (factor $x)) (return $x)) (entry "m"))"#,
    ),
    (
        "futures and shapes",
        r#"(module
          (fn "grow" (params $h $d)
            (set $w (sample (dist uniform 0.2 1.0)))
            (do (emit (box (tuple 0.0 $h 0.0) (tuple $w 0.2 $w))))
            (if (and (lt $d 4) (sample (dist bernoulli 0.6))) (then
              (set $a (future "grow" (add $h $w) (add $d 1)))
              (do (future "grow" (sub $h $w) (add $d 1)))
              (return (add $w (force $a)))))
            (return $w))
          (fn "m" (params) (set $t (call "grow" 0.0 0)) (do (factor (neg $t))) (return $t)) (entry "m"))"#,
    ),
    (
        "conditions with effects",
        r#"(module (fn "coin" (params $p) (return (sample (dist bernoulli $p))))
          (fn "m" (params)
            (set $a (and (call "coin" 0.6) (call "coin" 0.7) (sample (dist bernoulli 0.5))))
            (set $b (or (call "coin" 0.2) $a (call "coin" 0.3)))
            (set $x (cond $b (sample (dist gaussian 1.0 1.0)) (call "coin" 0.5)))
            (do (factor (cond $b $x 0.1))) (return (tuple $a $b $x))) (entry "m"))"#,
    ),
];

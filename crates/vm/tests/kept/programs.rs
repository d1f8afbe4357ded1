//! Programs that create, remove and re-enter activations by every construct of the language.

use niwaki_vm::code::Program;
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;

pub fn compiled(text: &str) -> Program {
    compile(&parse(text).expect("core form"), vec![]).expect("a program")
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
        "truth values of truth values, before a future",
        r#"(module
          (class 0 "Both" ("first" "second")) (const 0 (list 0.0 -0.7 0.6))
          (fn "m" (params)
            (unpack ($n $b) (tuple 0 (sample #bernoulli (dist bernoulli 0.6))))
            (set $f1 (cond $b (future #h0 "h0" $n true) $n))
            (if #bernoulli#1 (sample #bernoulli#1 (dist bernoulli 0.8))
              (then
                (set $c3 (mod (add (cond (gt $n 1) $n $n) (sub $n 2)) 3)))
              (else))
            (set $c4 (and (or (not (eq (mod $n 2) 0)) (eq (mod $n 2) 0)) (not (eq (mod 2 2) 0))))
            (set $r5 (record 0 (future #late "late" $f1 1) $f1))
            (return (tuple $n $b $c4 $f1)))
          (fn "h0" (params $n $b) (defaults true)
            (set $k (sample #k (dist categorical (list 1.0 2.0 1.0))))
            (return (mod $k 3)))
          (fn "late" (params $promise $n) (defaults 1)
            (do (factor #factor (index (data 0) (mod $n 3)))))
          (entry "m"))"#,
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
        "futures that are chosen, unpacked, listed and captured",
        r#"(module
          (fn "leaf" (params $x) (set $y (sample (dist gaussian $x 1.0))) (do (factor (mul -0.1 $y))) (return $y))
          (fn "pair" (params $x) (return (tuple (future "leaf" $x) (future "leaf" (mul $x 2.0)))))
          (fn "get" (params $k) (captures $fs) (return (force (index $fs $k))))
          (fn "m" (params)
            (set $c (sample (dist bernoulli 0.5)))
            (set $f (cond $c (future "leaf" 1.0) 0.5))
            (unpack ($a $b) (call "pair" (force $f)))
            (set $fs (list $a $b $f))
            (set $g (closure "get" $fs))
            (set $s 0.0)
            (for $i (range (add 1 (sample (dist discrete_uniform 0 2)))) (body
              (set $s (add $s (sub (force (index $fs $i)) (force $f))))
              (do (observe (dist gaussian (apply $g $i) 1.0) 0.5))))
            (set $h (future_apply $g 2))
            (return (tuple (force $h) $s (force $a) $b))) (entry "m"))"#,
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
    (
        "conditions over what is known, kept past a site",
        r#"(module (fn "m" (params)
            (set $a (sample (dist bernoulli 0.6)))
            (set $b (or (sample (dist bernoulli 0.3)) $a))
            (set $c (and $a (sample (dist bernoulli 0.5)) $b))
            (set $d (or $c (sample (dist bernoulli 0.2)) $a))
            (do (factor -0.1))
            (set $x (sample (dist gaussian (cond $b 1.0 0.0) 1.0)))
            (return (tuple $b $c $d $x))) (entry "m"))"#,
    ),
    (
        "a list of components, read by points",
        r#"(module (fn "m" (params)
            (set $k (add 2 (sample (dist categorical (list 0.5 0.5)))))
            (set $mus (list)) (for $i (range $k) (body (set $mus (append $mus (sample (dist gaussian 0.0 3.0))))))
            (set $sds (list)) (for $i (range 3) (body (set $sds (add $sds (list (sample (dist uniform 0.5 2.0)))))))
            (for $i (range 9) (body
              (set $z (sample (dist discrete_uniform 0 (sub $k 1))))
              (do (observe (dist gaussian (index $mus $z) (index $sds $z)) (sub (mod $i 3) 1.0)))
              (do (query $i (index $mus $z)))))
            (return $mus)) (entry "m"))"#,
    ),
    (
        "a list that grows while it is read",
        r#"(module (fn "m" (params)
            (set $xs (list 0.5))
            (for $i (range 10) (body
              (set $x (sample (dist gaussian (index $xs -1) 1.0)))
              (do (observe (dist gaussian $x 2.0) 1.0))
              (if (gt $x 0.0) (then (set $xs (append $xs $x))))
              (if (gt $x 3.0) (then (break)))))
            (do (factor (mul -0.1 (len $xs))))
            (return $xs)) (entry "m"))"#,
    ),
    (
        "sums along a list",
        r#"(module (fn "m" (params)
            (set $s (list 0.0))
            (for $i (range 8) (body (set $s (append $s (add (index $s -1) (sample (dist gaussian 0.0 1.0)))))))
            (do (observe (dist gaussian (index $s 8) 0.5) 2.0))
            (do (observe (dist gaussian (index $s 4) 0.5) -1.0))
            (return $s)) (entry "m"))"#,
    ),
    (
        "lists by recursion, by halves and passed down",
        r#"(module
          (fn "halves" (params $i $j $mus)
            (if (eq (sub $j $i) 1) (then
              (set $z (sample (dist categorical (list 0.5 0.3 0.2))))
              (do (observe (dist gaussian (index $mus $z) 1.0) (mul 0.3 $i)))
              (return (list (index $mus $z)))))
            (set $m (floordiv (add $i $j) 2))
            (return (add (call "halves" $i $m $mus) (call "halves" $m $j $mus))))
          (fn "down" (params $n $mus)
            (if (eq $n 0) (then (return $mus)))
            (return (call "down" (sub $n 1) (append $mus (sample (dist gaussian (index $mus 0) 1.0))))))
          (fn "m" (params)
            (set $mus (call "down" 3 (list (sample (dist gaussian 0.0 2.0)))))
            (set $all (call "halves" 0 7 $mus))
            (set $c (sample (dist bernoulli 0.5)))
            (do (factor (cond $c (index $all 2) (mul -1.0 (index $all 3)))))
            (return $all)) (entry "m"))"#,
    ),
    (
        "indices that switch, elements that steer",
        r#"(module
          (fn "use" (params $xs $i)
            (set $x (index $xs $i))
            (if (gt $x 0.0) (then (set $y (sample (dist gaussian $x 1.0))) (do (factor (neg (mul $y $y)))) (return $y)))
            (return $x))
          (fn "m" (params)
            (set $xs (list)) (for $i (range 4) (body (set $xs (append $xs (sample (dist gaussian 0.0 1.0))))))
            (set $which (sample (dist discrete_uniform 0 3)))
            (set $a (call "use" $xs $which))
            (set $b (call "use" $xs (sub 3 $which)))
            (set $ys (list $a $b))
            (set $d (sample (dist gaussian (index $ys (mod $which 2)) 1.0)))
            (do (observe (dist gaussian (add $d $a) 1.0) 0.5))
            (return $ys)) (entry "m"))"#,
    ),
    (
        "collections in tuples",
        r#"(module
          (fn "components" (params $k)
            (set $mus (list)) (set $sds (list))
            (for $i (range $k) (body (set $mus (append $mus (sample (dist gaussian 0.0 3.0))))
              (set $sds (append $sds (sample (dist uniform 0.5 2.0))))))
            (return (tuple $k (tuple $mus $sds))))
          (fn "point" (params $i $c $k)
            (set $z (sample (dist discrete_uniform 0 (sub $k 1))))
            (set $mus (index (index $c 1) 0)) (set $sds (index (index $c 1) 1))
            (do (observe (dist gaussian (index $mus $z) (index $sds $z)) (sub (mod $i 3) 1.0)))
            (if (gt $i 0) (then (return (call "point" (sub $i 1) $c $k))))
            (return (tuple $z $mus)))
          (fn "m" (params)
            (set $k (add 2 (sample (dist categorical (list 0.5 0.5)))))
            (set $c (call "components" $k))
            (unpack ($n $lists) $c)
            (unpack ($mus $sds) $lists)
            (set $all (list)) (for $i (range 3) (body (set $all (add $all (list (index $mus (mod $i $n)))))))
            (do (query "all" (tuple $all 1)))
            (unpack ($z $again) (call "point" 7 $c $k))
            (return (tuple $z $again $sds))) (entry "m"))"#,
    ),
    (
        "a pair that is carried, with a list that grows",
        r#"(module
          (fn "h" (params $n)
            (if (lt $n 0) (then (return (tuple 0 (list)))))
            (set $before (call "h" (sub $n 1)))
            (set $s (sample (dist categorical (list 0.2 0.3 0.5))))
            (do (factor (cond (eq $s (index $before 0)) 0.5 -0.5)))
            (return (tuple $s (append (index $before 1) $s))))
          (fn "m" (params) (return (call "h" 7))) (entry "m"))"#,
    ),
    (
        "much that does not depend on what changed",
        r#"(module
          (fn "half" (params $x) (return (mul $x 0.5)))
          (fn "line" (params $n $a0 $sa $sy $w)
            (set $t (mul 0.25 $n))
            (set $a (sample (dist gaussian $a0 $sa)))
            (set $u (add $t 1.0))
            (set $b (sample (dist gaussian 0.0 $u)))
            (if (gt $n 2) (then (set $t (add $t $b))) (else (do (factor (mul -0.1 $u)))))
            (set $v (add $u $t))
            (set $c (sample (dist gaussian (call "half" $v) 1.0)))
            (for $j (range 3) (body (set $v (add $v $j))))
            (for $p (zip (list 0.1 0.2 0.3) (list $v 1.0 $w)) (body (unpack ($x $y) $p)
              (do (observe (dist gaussian (add $a (mul $b $x)) $sy) $y))))
            (do (query $n (tuple $u $c)))
            (if (gt $c 2.0) (then (return (tuple $n $c))))
            (do (observe (dist gaussian $c $sy) (mul $w $u)))
            (return (tuple $a $n)))
          (fn "m" (params)
            (set $a0 (sample (dist gaussian 0.0 2.0)))
            (set $sa (sample (dist uniform 0.5 2.0)))
            (set $sy (sample (dist uniform 0.5 2.0)))
            (set $k (sample (dist categorical (list 0.5 0.5))))
            (set $lines (list)) (set $w 0.0)
            (for $i (range 5) (body
              (set $one (call "line" (add $i (mul 2 $k)) $a0 $sa $sy $w))
              (set $w (mul 0.1 (index $one 0)))
              (set $lines (append $lines $one))
              (do (call "line" $i 0.5 $sa $sy 0.0))))
            (return (tuple $lines $w))) (entry "m"))"#,
    ),
    (
        "a choice that is drawn anew in the middle of what is left out",
        r#"(module
          (fn "f" (params $c $x $n)
            (set $d (cond $c (dist delta $x) (dist gaussian $x 1.0)))
            (set $y (sample $d))
            (set $z (sample (dist gaussian 0.0 1.0)))
            (set $e (add $y $z))
            (do (observe (dist gaussian $e 1.0) $n))
            (set $q (sample (dist dirichlet (cond $c (list 1.0 1.0) (list 1.0 2.0 1.0)))))
            (return (add $e (index $q 1))))
          (fn "m" (params)
            (set $c (sample (dist bernoulli 0.5)))
            (set $x (sample (dist gaussian 0.0 1.0)))
            (set $s 0.0)
            (for $i (range 4) (body
              (set $r (call "f" $c $x $i))
              (do (observe (dist gaussian $r 2.0) 0.1))
              (set $s (add $s (sample (dist uniform 0.0 1.0))))))
            (set $n 0)
            (while (lt $n 3) (body (set $x (add $x (sample (dist gaussian $x 0.5)))) (set $n (add $n 1))
              (do (call "f" (gt $x 0.0) $s $n))))
            (return (tuple $s $x))) (entry "m"))"#,
    ),
    (
        "memoised coins that are asked for from several places, by choices",
        r#"(module
          (fn "coin" (params $i)
            (set $x (sample (dist bernoulli 0.4))) (do (factor (cond $x 0.3 -0.2))) (return $x))
          (fn "ask" (params $i) (return (apply (mem (closure "coin") "coin") $i)))
          (fn "m" (params) (set $n 0)
            (for $k (range 5) (body
              (set $i (sample (dist categorical (list 0.5 0.3 0.2))))
              (if (call "ask" $i) (then (set $n (add $n 1)))
                (else (do (observe (dist bernoulli 0.3) (call "ask" 0)))))))
            (return $n)) (entry "m"))"#,
    ),
    (
        "a memoised walk that calls itself",
        r#"(module
          (fn "walk" (params $n)
            (if (le $n 0) (then (return 0.0)))
            (set $before (apply (mem (closure "walk") "walk") (sub $n 1)))
            (return (sample (dist gaussian $before 1.0))))
          (fn "m" (params)
            (set $w (mem (closure "walk") "walk"))
            (set $k (sample (dist poisson 2.0)))
            (set $a (apply $w $k))
            (set $j (sample (dist discrete_uniform 0 3)))
            (do (observe (dist gaussian (apply $w $j) 1.0) 0.5))
            (do (query "a" $a))
            (if (gt $a 0.5) (then (return (apply $w (add $j 1)))))
            (return $a)) (entry "m"))"#,
    ),
    (
        "memoised closures of choices",
        r#"(module
          (fn "mean" (params $i) (captures $mu $sd)
            (set $x (sample (dist gaussian $mu $sd))) (return (add $x $i)))
          (fn "group" (params $f $i)
            (set $y (apply $f $i)) (do (observe (dist gaussian $y 1.0) (mul 0.5 $i))) (return $y))
          (fn "m" (params)
            (set $mu (sample (dist gaussian 0.0 2.0)))
            (set $f (mem (closure "mean" $mu 1.0)))
            (set $s 0.0)
            (for $i (range 4) (body
              (set $z (sample (dist categorical (list 1.0 1.0 2.0))))
              (set $s (add $s (call "group" $f $z)))))
            (set $c (sample (dist bernoulli 0.5)))
            (if $c (then (set $s (add $s (force (future_apply $f 1))))))
            (set $sd (sample (dist uniform 0.5 2.0)))
            (for $j (range 2) (body
              (set $g (mem (cond (sample (dist bernoulli 0.7)) (closure "deep" $f $sd) (closure "mean" $mu $sd))))
              (set $s (add $s (apply $g (cond $c 0 $j))))
              (set $s (mul $s (apply $g 0)))))
            (return $s))
          (fn "deep" (params $i) (captures $f $sd)
            (return (add (sample (dist gaussian 0.0 $sd)) (apply $f (mul 2 $i)))))
          (entry "m"))"#,
    ),
];

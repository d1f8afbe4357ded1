//! Programs whose answer is known, and the page that some of them draw on.

use niwaki_geom::{Drawing, Page, SketchSpec, match_drawing};
use niwaki_run::Task;
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::{Scope, compile_with_scope};
use std::sync::Arc;

/// Each with a name. Those that emit are scored by how well they draw [`page`].
pub const PROGRAMS: [(&str, &str); 6] = [
    (
        "strokes by recursion, and a disc that moves with what they return",
        r#"(module
          (fn "step" (params $x $y $d)
            (set $k (sample (dist categorical (list 0.4 0.3 0.3))))
            (set $to (add $x (sub $k 1)))
            (do (emit (stroke (tuple $x $y 0.0) (tuple $to (add $y 1.2) 0.0) 0.5)))
            (if (and (lt $d 1) (sample (dist bernoulli 0.6)))
              (then (return (add (mul 3 (call "step" $to (add $y 1.2) (add $d 1))) $k))))
            (return $k))
          (fn "m" (params)
            (set $v (call "step" 0.0 -2.0 0))
            (do (emit (disc (tuple (cond (gt $v 1) 1.6 -1.6) 1.0 0.0) 0.8)))
            (set $b (sample (dist bernoulli 0.4)))
            (do (emit (disc (tuple (cond $b 1.5 -1.5) -1.5 0.0) 0.7)))
            (return (tuple $v $b))) (entry "m"))"#,
    ),
    (
        "arms that grow as futures",
        r#"(module
          (fn "arm" (params $s)
            (set $a (sample (dist bernoulli 0.5)))
            (do (emit (stroke (tuple 0.0 -1.0 0.0) (tuple (mul $s (cond $a 2.0 1.0)) 1.5 0.0) 0.6)))
            (set $b (sample (dist bernoulli (cond $a 0.7 0.3))))
            (if $b (then (do (emit (disc (tuple (mul $s 1.8) 1.8 0.0) 0.6)))))
            (return (add (mul 2 (cond $a 1 0)) (cond $b 1 0))))
          (fn "m" (params)
            (set $l (future "arm" -1.0)) (set $r (future "arm" 1.0))
            (set $c (sample (dist bernoulli 0.5))) (do (factor (cond $c -0.4 0.0)))
            (return (tuple (force $l) (force $r) $c))) (entry "m"))"#,
    ),
    (
        "discs at continuous places, one of which may be absent",
        r#"(module (fn "m" (params)
            (set $x (sample (dist uniform -2.0 2.0)))
            (do (emit (disc (tuple $x -1.0 0.0) 0.8)))
            (set $more (sample (dist bernoulli 0.5)))
            (set $w 0.0)
            (if $more (then (set $w (sample (dist gaussian 0.5 1.0)))
              (do (emit (disc (tuple $w 1.2 0.0) 0.7)))))
            (return (tuple (lt $x 0.3) $more (lt $w 0.8)))) (entry "m"))"#,
    ),
    (
        "a share and a scale that are observed",
        r#"(module (fn "m" (params)
            (set $p (sample (dist beta 2.0 3.0))) (do (observe (dist gaussian $p 0.4) 0.7))
            (set $g (sample (dist gamma 2.0 0.5))) (do (observe (dist gaussian $g (add 0.4 $p)) 1.4))
            (return (tuple (lt $p 0.45) (lt $g 1.1)))) (entry "m"))"#,
    ),
    (
        "as many whole numbers as a count says, in a list",
        r#"(module (fn "m" (params)
            (set $n (min (sample (dist poisson 1.2)) 3)) (do (factor (mul -0.3 $n)))
            (set $xs (list)) (set $s 0)
            (for $i (range $n) (body
              (set $k (sample (dist discrete_uniform 0 2))) (set $xs (append $xs $k)) (set $s (add $s $k))
              (do (factor (cond (eq $k 1) 0.5 -0.4)))))
            (set $b (sample (dist bernoulli (cond (gt $s 2) 0.8 0.3)))) (do (factor (cond $b 0.0 -0.7)))
            (return (tuple $n $s $b))) (entry "m"))"#,
    ),
    (
        "calls that decide about the scene outside of them",
        r#"(module (fn "pick" (params) (return (sample (dist categorical (list 0.3 0.25 0.25 0.2)))))
          (fn "m" (params)
            (set $k (call "pick"))
            (do (emit (disc (tuple (sub (mul 1.2 $k) 1.8) 0.8 0.0) 1.1)))
            (set $j (call "pick"))
            (do (emit (disc (tuple (sub (mul 1.2 $j) 1.8) -1.0 0.0) 1.1)))
            (return (tuple $k $j))) (entry "m"))"#,
    ),
];

/// A page of 8 x 8 pixels that is half full.
pub fn page(sigma: f64) -> Arc<dyn SketchSpec> {
    let page = Page::new([-3.0, -3.0], [3.0, 3.0], [8, 8]).expect("a page");
    let filled = |pixel: usize| (pixel % 8 > 2 && pixel / 8 < 4) || (pixel % 8 < 3 && pixel / 8 > 4);
    let greys: Vec<u8> = (0..64).map(|pixel| if filled(pixel) { 0 } else { 255 }).collect();
    match_drawing(Arc::new(Drawing::new(page, &greys).expect("a drawing")), sigma).expect("a sketch")
}

/// The task of a program, compiled so that a guide can read all variables.
pub fn task(text: &str) -> Task {
    let program = compile_with_scope(&parse(text).expect("a module"), vec![], Scope::All).expect("a program");
    let sketches = if text.contains("emit") { vec![page(0.6)] } else { vec![] };
    Task { sketches, ..Task::new(Arc::new(program)) }
}

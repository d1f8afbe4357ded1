//! The price of a particle-step on the machine alone: the HMM and the branching program, on one thread.
//!
//! `cargo run --release -p niwaki-infer --example machine`

use niwaki_infer::Task;
use niwaki_infer::particles::{Order, Settings, smc};
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use std::sync::Arc;

/// Seconds that this thread has run, by the kernel's account; other programs on the machine do not count.
fn cpu_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|t| t.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1e-9
}

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("one pool");
    let states = "(list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4)) \
                  (dist categorical (list 0.3 0.3 0.4)))";
    let hmm = format!(
        "(module (const 0 {states}) (const 1 {states}) (fn \"m\" (params) (set $s 0) \
         (for $i (range 100) (body (set $s (sample (index (data 0) $s))) \
         (do (observe (index (data 1) $s) (mod $i 3))))) (return $s)) (entry \"m\"))"
    );
    let seconds = std::env::var("SECONDS").ok().and_then(|s| s.parse().ok()).unwrap_or(2.0);
    let branching = r#"(module
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
    for (name, text, particles) in [
        ("hmm", hmm.as_str(), 1000),
        ("hmm", hmm.as_str(), 100),
        ("branching", branching, 300),
        ("branching", branching, 30),
    ] {
        if std::env::var("ONLY").is_ok_and(|only| only != format!("{name}{particles}")) {
            continue;
        }
        let program = compile(&parse(text).expect("core form"), vec![]).expect("a program");
        if std::env::args().any(|a| a == "--code") {
            println!("{}", niwaki_vm::code::disassemble(&program));
        }
        let task = Task::new(Arc::new(program));
        let (mut steps, mut runs, start) = (0usize, 0u64, cpu_seconds());
        while runs == 0 || cpu_seconds() - start < seconds {
            let settings =
                Settings { particles, order: Order::DepthFirst, seed: runs, ..Settings::default() };
            let mut ended = 0;
            smc(&task, &settings, &mut |p| {
                steps += particles - ended;
                ended = p.ended;
                true
            })
            .expect("a result");
            runs += 1;
        }
        let rate = steps as f64 / (cpu_seconds() - start);
        println!("{name}: {:.2} M particle-steps/s, {} steps a run", rate / 1e6, steps as u64 / runs);
    }
}

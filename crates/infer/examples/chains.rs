//! The price of a proposal of a Markov chain: one chain, one thread, single choices.
//!
//! `cargo run --release -p niwaki-infer --example chains [NAME] [SIZE]`
//!
//! It also prints the bits of the last score, which depend on the seed and the number of proposals alone. With
//! `PROPOSALS=N` it makes N proposals instead of running for `SECONDS`, so that instructions and bits can be compared.

use niwaki_infer::Task;
use niwaki_infer::chain::kernel::Kernel;
use niwaki_infer::chain::leaf::Proposer;
use niwaki_infer::chain::{Chain, Settings};
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use std::sync::Arc;

/// Seconds that this thread has run, by the kernel's account; other programs on the machine do not count.
fn cpu_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|t| t.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1e-9
}

/// A hidden Markov model, a mixture, topics and a regression.
fn programs(n: usize) -> [(&'static str, String); 4] {
    let ones = |count: usize| format!("(list{})", " 1.0".repeat(count));
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
        ones(20),
        n / 20,
        ones(10)
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

fn main() {
    let wanted = std::env::args().nth(1).unwrap_or_default();
    let n = std::env::args().nth(2).and_then(|n| n.parse().ok()).unwrap_or(1000);
    let seconds = std::env::var("SECONDS").ok().and_then(|s| s.parse().ok()).unwrap_or(1.0);
    let count = std::env::var("PROPOSALS").ok().and_then(|n| n.parse::<u64>().ok());
    for (name, text) in programs(n) {
        if !name.starts_with(&wanted) {
            continue;
        }
        let program = compile(&parse(&text).expect("core form"), vec![]).expect("a program");
        let task = Task::new(Arc::new(program));
        let kernel = if name == "hmm" { Kernel::PRIOR } else { Kernel::Leaf(Proposer::ByFamily {}) };
        let settings = Settings { seed: 1, kernel, thin: 0, ..Settings::default() };
        let mut chain: Chain = Chain::start(&task, &settings, 0, None).expect("a chain");
        let start = cpu_seconds();
        let left = |made: u64| match count {
            Some(count) => made < count,
            None => cpu_seconds() - start < seconds,
        };
        while left(chain.visit()) {
            let steps = count.map_or(10_240, |count| count - chain.visit());
            chain.advance(&task, steps, &mut |_, _| true).expect("proposals");
        }
        let (made, all) = (chain.visit() as f64, chain.counts.all());
        println!(
            "{name:12} {n:6} {:6.3} M proposals/s, accepted {:.2}, score {:016x}",
            made / (cpu_seconds() - start) / 1e6,
            all.accepted as f64 / made,
            chain.state.log_score().to_bits()
        );
    }
}

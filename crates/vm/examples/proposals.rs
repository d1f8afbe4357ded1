//! The price of a proposal on the machine alone: one chain, one thread, single choices.
//!
//! `cargo run --release -p niwaki-vm --example proposals [NAME] [SIZE]`
//!
//! With `PROPOSALS=N` the example makes N proposals instead of running for `SECONDS`, so that instructions can
//! be counted.

use niwaki_math::{Dist, Stream, grid};
use niwaki_vm::core::parse::parse;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At};
use niwaki_vm::machine::kept::{Change, Propose, Proposed, Strategy};
use niwaki_vm::machine::{Limits, Machine};
use niwaki_vm::passes::compile;
use niwaki_vm::value::Value;

struct Draws(u64);

impl Answers<f64> for Draws {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        Ok(Answer::Go(Value::from(dist.sample(&mut Stream::new(1, 0, at.address(), self.0)))))
    }
    fn host(&mut self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        Ok(args[0].clone())
    }
}

/// Proposes small steps for numbers on the whole line, and draws from the prior for all other values.
struct Steps(u64);

impl Propose<f64> for Steps {
    #[inline]
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        dist: &Dist,
        old: &Value,
        log_density: f64,
    ) -> Result<Proposed<f64>, Fault> {
        let mut stream = Stream::new(1, 1, at.address(), self.0);
        if let (Dist::Gaussian { .. }, Value::Real(x)) = (dist, old) {
            let step = Dist::Gaussian { mean: *x, sd: 0.2 };
            return Ok(Proposed {
                value: Value::from(step.sample(&mut stream)),
                forward: 0.0,
                backward: 0.0,
            });
        }
        let (draw, log) = dist.sample_and_score(&mut stream);
        Ok(Proposed { value: Value::from(draw), forward: grid(log), backward: log_density })
    }
}

fn cpu_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|t| t.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1e-9
}

const STATES: &str = "(const 0 (list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4)) \
                      (dist categorical (list 0.3 0.3 0.4))))";

fn programs(n: usize) -> Vec<(&'static str, String)> {
    let hmm = |body: &str| format!("(module {STATES} {body} (entry \"m\"))");
    let gmm = |body: &str| {
        format!(
            r#"(module {body} (fn "m" (params)
            (set $w (sample (dist dirichlet (list 1.0 1.0 1.0 1.0))))
            (set $mus (list)) (for $k (range 4) (body (set $mu (sample (dist gaussian 0.0 10.0))) (set $mus (add $mus (list $mu)))))
            (set $sds (list)) (for $k (range 4) (body (set $sd (sample (dist uniform 0.1 4.0))) (set $sds (add $sds (list $sd)))))
            MAIN) (entry "m"))"#
        )
    };
    let observe = "(set $z (sample (dist categorical $w))) (do (observe (dist gaussian (index $mus $z) (index $sds $z)) (sub (mul 5.0 (mod $i 3)) 4.0)))";
    vec![
        ("hmm-loop", hmm(&format!(
            "(fn \"m\" (params) (set $s 0) (for $i (range {n}) (body (set $s (sample (index (data 0) $s))) \
             (do (observe (index (data 0) $s) (mod $i 3))))) (return $s))"))),
        ("hmm-query", hmm(&format!(
            "(fn \"m\" (params) (set $s 0) (for $i (range {n}) (body (set $s (sample (index (data 0) $s))) \
             (do (observe (index (data 0) $s) (mod $i 3))) (do (query $i $s)))) (return none))"))),
        ("hmm-rec", hmm(&format!(
            "(fn \"h\" (params $n) (set $s 0) (if (gt $n 0) (then (set $s (call \"h\" (sub $n 1))))) \
             (set $s (sample (index (data 0) $s))) (do (observe (index (data 0) $s) (mod $n 3))) (return $s)) \
             (fn \"m\" (params) (return (call \"h\" {})))", n - 1))),
        ("hmm-while", hmm(&format!(
            "(fn \"m\" (params) (set $s 0) (set $i 0) (while (lt $i {n}) (body (set $s (sample (index (data 0) $s))) \
             (do (observe (index (data 0) $s) (mod $i 3))) (set $i (add $i 1)))) (return $s))"))),
        ("hmm-list", hmm(&format!(
            "(fn \"m\" (params) (set $s 0) (set $l (list)) (for $i (range {n}) (body (set $s (sample (index (data 0) $s))) \
             (do (observe (index (data 0) $s) (mod $i 3))) (set $l (add $l (list $s))))) (return $l))"))),
        ("hmm-rec-list", hmm(&format!(
            "(fn \"h\" (params $n) (if (lt $n 0) (then (return (list 0)))) (set $l (call \"h\" (sub $n 1))) \
             (set $s (sample (index (data 0) (index $l -1)))) (do (observe (index (data 0) $s) (mod $n 3))) (return (add $l (list $s)))) \
             (fn \"m\" (params) (return (call \"h\" {})))", n - 1))),
        ("gmm-loop", gmm("").replace("MAIN", &format!("(for $i (range {n}) (body {observe}))"))),
        ("gmm-rec", gmm(&format!("(fn \"p\" (params $i $w $mus $sds) (if (lt $i {n}) (then {observe} (do (call \"p\" (add $i 1) $w $mus $sds)))))"))
            .replace("MAIN", "(do (call \"p\" 0 $w $mus $sds))")),
        ("lda", format!(
            r#"(module (fn "m" (params)
            (set $topics (list)) (for $k (range 10) (body (set $topics (append $topics (sample (dist dirichlet DENSE))))))
            (for $d (range {}) (body
              (set $theta (sample (dist dirichlet (list 1.0 1.0 1.0 1.0 1.0 1.0 1.0 1.0 1.0 1.0))))
              (for $i (range 20) (body (set $z (sample (dist categorical $theta)))
                (do (observe (dist categorical (index $topics $z)) (mod (add $i $d) 20))))))))
            (entry "m"))"#, n / 20).replace("DENSE", &format!("(list{})", " 1.0".repeat(20)))),
        ("hlr", format!(
            r#"(module (fn "m" (params)
            (set $a0 (sample (dist gaussian 0.0 10.0))) (set $b0 (sample (dist gaussian 0.0 10.0)))
            (set $sa (sample (dist uniform 0.05 3.0))) (set $sb (sample (dist uniform 0.05 3.0))) (set $sy (sample (dist uniform 0.05 3.0)))
            (for $i (range {}) (body
              (set $a (sample (dist gaussian $a0 $sa))) (set $b (sample (dist gaussian $b0 $sb)))
              (for $j (range 5) (body (do (observe (dist gaussian (add $a (mul $b (sub $j 2))) $sy) (mul 0.3 (mod (add $i $j) 7)))))))))
            (entry "m"))"#, n / 5)),
        ("hlr-lines", format!(
            r#"(module (const 0 (list -2.0 -1.0 0.0 1.0 2.0))
            (fn "line" (params $ys $a0 $b0 $sa $sb $sy)
            (set $a (sample (dist gaussian $a0 $sa))) (set $b (sample (dist gaussian $b0 $sb)))
              (for $p (zip (data 0) $ys) (body (unpack ($x $y) $p) (do (observe (dist gaussian (add $a (mul $b $x)) $sy) $y))))
              (return (tuple $a $b)))
            (fn "m" (params)
            (set $a0 (sample (dist gaussian 0.0 10.0))) (set $b0 (sample (dist gaussian 0.0 10.0)))
            (set $sa (sample (dist uniform 0.05 3.0))) (set $sb (sample (dist uniform 0.05 3.0))) (set $sy (sample (dist uniform 0.05 3.0)))
            (set $lines (list))
            (for $i (range {}) (body
              (set $lines (append $lines (call "line" (list 0.1 0.2 0.3 (mul 0.1 (mod $i 7)) 0.5) $a0 $b0 $sa $sb $sy)))))
            (return (tuple $a0 $lines)))
            (entry "m"))"#, n / 5)),
    ]
}

fn main() {
    let pattern = std::env::args().nth(1).unwrap_or_default();
    let n = std::env::args().nth(2).and_then(|n| n.parse().ok()).unwrap_or(1000);
    let seconds = std::env::var("SECONDS").ok().and_then(|s| s.parse().ok()).unwrap_or(1.0);
    let count = std::env::var("PROPOSALS").ok().and_then(|n| n.parse::<u64>().ok());
    let strategy = match std::env::var("STRATEGY").as_deref() {
        Ok("rerun") => Strategy::Rerun,
        Ok("resume") => Strategy::Resume,
        Ok("cache") => Strategy::Cache,
        _ => Strategy::C3,
    };
    for (name, text) in programs(n) {
        if !name.starts_with(&pattern) {
            continue;
        }
        let program = compile(&parse(&text).expect("core form"), vec![]).expect("a program");
        if std::env::args().any(|a| a == "--code") {
            println!("{}", niwaki_vm::code::disassemble(&program));
        }
        let mut machine = Machine::new(&program, Limits::default());
        let (mut trace, _) = machine.begin(&[], &mut Draws(0)).expect("a run");
        trace.commit(&program);
        let (mut steps, mut accepted, mut first, start) = (0u64, 0u64, 0.0, cpu_seconds());
        let counters = trace.counters();
        let is_due = |steps: u64| !steps.is_multiple_of(1024) || cpu_seconds() - start < seconds;
        while count.map_or_else(|| is_due(steps), |count| steps < count) {
            let mut pick = Stream::new(1, 2, 0, steps);
            let choice = (pick.uniform() * trace.len() as f64) as usize;
            let change = machine
                .propose(&mut trace, choice, strategy, &mut Steps(steps), &mut Draws(steps + 1))
                .expect("a run");
            let (fresh, stale) = trace.fresh_and_stale();
            let (forward, backward) = trace.forward_and_backward();
            let mut sum = trace.change().log_prior.plus(&trace.change().log_factors);
            sum.add_total(stale);
            sum.remove_total(fresh);
            let ratio = sum.value() + (backward - forward);
            if change == Change::Unchanged
                || (change == Change::Done && (ratio >= 0.0 || pick.uniform().ln() < ratio))
            {
                trace.commit(&program);
                accepted += 1;
            } else {
                trace.rollback(&program);
            }
            steps += 1;
            if steps == 1000 {
                first = 1000.0 / (cpu_seconds() - start);
            }
        }
        let c = trace.counters();
        let per = |x: u64| x as f64 / steps as f64;
        println!(
            "{name:12} {n:6} {:9.0} /s (first 1000: {first:9.0}), accepted {:.2}, a proposal: {:.2} entered, {:.2} skipped, {:.1} instructions; {} bytes",
            steps as f64 / (cpu_seconds() - start),
            per(accepted),
            per(c.entered - counters.entered),
            per(c.skipped - counters.skipped),
            per(c.instructions - counters.instructions),
            trace.bytes()
        );
    }
}

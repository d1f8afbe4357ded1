//! The cost of a particle-step on the machine alone: the HMM and the branching program, on one thread.
//!
//! `cargo run --release -p niwaki-search --example machine`

mod programs;

/// Seconds that this thread has run, by the kernel's account, without other programs on the machine.
fn cpu_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|t| t.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1e-9
}

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("one pool");
    let (hmm, branching) = (programs::hmm(), programs::BRANCHING);
    let seconds = std::env::var("SECONDS").ok().and_then(|s| s.parse().ok()).unwrap_or(2.0);
    for (name, text, particles) in [
        ("hmm", hmm.as_str(), 1000),
        ("hmm", hmm.as_str(), 100),
        ("branching", branching, 300),
        ("branching", branching, 30),
    ] {
        if std::env::var("ONLY").is_ok_and(|only| only != format!("{name}{particles}")) {
            continue;
        }
        let task = programs::task(text);
        if std::env::args().any(|a| a == "--code") {
            println!("{}", niwaki_vm::code::disassemble(&task.program));
        }
        let (mut steps, mut runs, start) = (0, 0, cpu_seconds());
        while runs == 0 || cpu_seconds() - start < seconds {
            steps += programs::particle_steps(&task, particles, runs);
            runs += 1;
        }
        let rate = steps as f64 / (cpu_seconds() - start);
        println!("{name}: {:.2} M particle-steps/s, {} steps a run", rate / 1e6, steps as u64 / runs);
    }
}

//! Particle filters and Markov chains written by hand: the rates that a general system is measured against.
//!
//! No traces, no addresses, no generality: each filter, each chain knows its model. The filters draw the same choices in
//! the same order as `../models/*.py` and `../webppl/*.wppl`, and resample at every factor, as those do; the chains make
//! the same proposals.
//!
//!     limit hmm DATA.json PARTICLES SECONDS SEED
//!     limit branching - PARTICLES SECONDS SEED
//!     limit rate|globals|check hmm|lda|gmm|hlr DATA.json SECONDS SEED
//!     limit hmc ring|coloring COLORING.txt POINT STEP LENGTH DRAWS SEED
//!     limit gradients ring|coloring COLORING.txt REFERENCE.txt
//!
//! Prints one JSON line. Filters: particle-steps, the CPU seconds they took, and the log evidence of every run. Chains:
//! proposals and CPU seconds, of any choice or of global ones; or the worst error of a local log ratio. Gradients: how
//! many, wall and CPU seconds; or the worst errors.
mod branching;
mod chains;
mod gradients;
mod hmm;
mod population;

use population::{Random, SeedableRng};

/// What one run of a filter did.
struct Run {
    /// Particle-steps: calls that drew choices and met a factor. Particles that ended take none.
    steps: u64,
    /// The estimate of the log evidence, in nats.
    log_evidence: f64,
}

/// CPU seconds of this process: other work on a shared machine does not count.
fn cpu_seconds() -> f64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}

/// Runs the filter for `seconds`, after one run that is thrown away, and prints the line.
fn measure(
    program: &str,
    particles: usize,
    seconds: f64,
    seed: u64,
    mut filter: impl FnMut(&mut Random) -> Run,
) {
    let mut random = Random::seed_from_u64(seed);
    filter(&mut random);
    let start = cpu_seconds();
    let (mut steps, mut evidence) = (0, Vec::new());
    while cpu_seconds() - start < seconds {
        let run = filter(&mut random);
        steps += run.steps;
        evidence.push(run.log_evidence);
    }
    let taken = cpu_seconds() - start;
    let line = serde_json::json!({
        "system": "limit", "program": program, "particles": particles, "seed": seed,
        "steps": steps, "cpu_seconds": taken, "log_evidence": evidence,
    });
    println!("{line}");
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let usage = "usage: limit hmm|branching DATA.json|- PARTICLES SECONDS SEED, or \
                 limit rate|globals|check hmm|lda|gmm|hlr DATA.json SECONDS SEED, or \
                 limit hmc ring|coloring COLORING.txt POINT STEP LENGTH DRAWS SEED, or \
                 limit gradients ring|coloring COLORING.txt REFERENCE.txt";
    if let Some(line) = gradients::run(&args.iter().map(String::as_str).collect::<Vec<_>>()) {
        println!("{line}");
        return;
    }
    if let [what @ ("rate" | "globals" | "check"), program, data, seconds, seed] =
        &args.iter().map(String::as_str).collect::<Vec<_>>()[..]
    {
        let (seconds, seed) = (seconds.parse().expect(usage), seed.parse().expect(usage));
        println!("{}", chains::run(what, program, data, seconds, seed));
        return;
    }
    let [program, data, particles, seconds, seed] = &args[..] else { panic!("{usage}") };
    let particles: usize = particles.parse().expect(usage);
    let seconds: f64 = seconds.parse().expect(usage);
    let seed: u64 = seed.parse().expect(usage);
    match program.as_str() {
        "hmm" => {
            let model = hmm::Hmm::read(data);
            measure(program, particles, seconds, seed, |random| model.filter(particles, random));
        }
        "branching" => {
            measure(program, particles, seconds, seed, |random| branching::filter(particles, random))
        }
        _ => panic!("{usage}"),
    }
}

//! The cost of a proposal of a Markov chain: one chain, one thread, single choices.
//!
//! `cargo run --release -p niwaki-search --example chains [NAME] [SIZE]`
//!
//! It also prints the bits of the last score, which depend on the seed and the number of proposals alone. With
//! `PROPOSALS=N` it makes N proposals instead of running for `SECONDS`, so that instructions and bits can be compared.

mod programs;

/// Seconds that this thread has run, by the kernel's account, without other programs on the machine.
fn cpu_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|t| t.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1e-9
}

fn main() {
    let prefix = std::env::args().nth(1).unwrap_or_default();
    let n = std::env::args().nth(2).and_then(|n| n.parse().ok()).unwrap_or(1000);
    let seconds = std::env::var("SECONDS").ok().and_then(|s| s.parse().ok()).unwrap_or(1.0);
    let count = std::env::var("PROPOSALS").ok().and_then(|n| n.parse::<u64>().ok());
    for (name, text) in programs::of_chains(n) {
        if !name.starts_with(&prefix) {
            continue;
        }
        let task = programs::task(&text);
        let mut chain = programs::chain(name, &task);
        let start = cpu_seconds();
        let left = |proposals: u64| match count {
            Some(count) => proposals < count,
            None => cpu_seconds() - start < seconds,
        };
        while left(chain.visit()) {
            let steps = count.map_or(10_240, |count| count - chain.visit());
            chain.advance(&task, steps, &mut |_, _| true).expect("proposals");
        }
        let (proposals, all) = (chain.visit() as f64, chain.counts.all());
        println!(
            "{name:12} {n:6} {:6.3} M proposals/s, accepted {:.2}, score {:016x}",
            proposals / (cpu_seconds() - start) / 1e6,
            all.accepted as f64 / proposals,
            chain.state.log_score().to_bits()
        );
    }
}

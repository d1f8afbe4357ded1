//! Gradients per second of one thread, and what compiling costs: `cargo run --release -p niwaki-grad --example rates`.
//!
//! Rates are by CPU time of this thread, so that other processes matter little; the best of several repeats is
//! printed.

#[path = "../tests/peers/mod.rs"]
mod peers;

use niwaki_grad::{Density, Native, Tape};
use std::hint::black_box;
use std::time::Instant;

/// Seconds of CPU time of this thread, from the kernel (in nanoseconds there).
fn cpu() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split_whitespace().next().and_then(|w| w.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1e-9
}

/// Calls per second: the best of five repeats of a tenth of a second or more.
fn rate(mut f: impl FnMut()) -> f64 {
    let mut n = 1_u64;
    let mut best = 0.0_f64;
    let mut repeats = 0;
    while repeats < 5 {
        let start = cpu();
        (0..n).for_each(|_| f());
        let seconds = cpu() - start;
        if seconds < 0.1 {
            n *= 2;
            continue;
        }
        best = best.max(n as f64 / seconds);
        repeats += 1;
    }
    best
}

/// The result of `f`, and its seconds.
fn timed<T>(f: impl Fn() -> T) -> (T, f64) {
    let mut tries = 0;
    // Too short for the kernel's CPU clock, which moves in ticks: wall time, the best of three.
    let mut best = f64::INFINITY;
    loop {
        let start = Instant::now();
        let result = f();
        best = best.min(start.elapsed().as_secs_f64());
        tries += 1;
        if tries == 3 {
            return (result, best);
        }
    }
}

fn shown(rate: f64) -> String {
    if rate > 1e6 { format!("{:.1} M", rate / 1e6) } else { format!("{:.0} k", rate / 1e3) }
}

fn lanes<const L: usize>(tape: &Tape, x: &[f64]) -> f64 {
    let mut memory = tape.lanes::<L>();
    let points: Vec<[f64; L]> = x.iter().map(|x| [*x; L]).collect();
    let mut g = vec![[0.0; L]; x.len()];
    rate(|| {
        black_box(memory.value_and_gradient(tape, black_box(&points), &mut g));
    }) * L as f64
}

fn measure(name: &str, x: &[f64], record: impl Fn() -> Density) {
    let (density, recording) = timed(&record);
    let (tape, taping) = timed(|| Tape::new(&density));
    let (native, compiling) = timed(|| Native::compile(&density));
    let (both, slope) = density.operations();
    println!(
        "{name}: {} coordinates, {both} operations with the value, {slope} without; tape of {} slots",
        density.dim(),
        tape.slots()
    );
    println!(
        "  record and differentiate {:.2} ms, tape {:.2} ms, machine code {:.2} ms",
        recording * 1e3,
        taping * 1e3,
        compiling * 1e3
    );
    let mut g = vec![0.0; x.len()];
    if let Ok(mut native) = native {
        let value = rate(|| {
            black_box(native.value_and_gradient(black_box(x), &mut g));
        });
        let slope = rate(|| {
            black_box(native.gradient(black_box(x), &mut g));
        });
        println!("  machine code: value and gradient {}/s, gradient {}/s", shown(value), shown(slope));
    }
    println!(
        "  tape: 1 chain {}/s, 16 chains {}/s, 64 chains {}/s",
        shown(lanes::<1>(&tape, x)),
        shown(lanes::<16>(&tape, x)),
        shown(lanes::<64>(&tape, x))
    );
}

fn main() {
    let start =
        |name: &str| peers::known().into_iter().find(|k| k.name == name).map(|k| k.x).unwrap_or_default();
    let (ring, coloring) = (start("ring"), start("coloring"));
    let drawing = peers::drawing();
    measure("ring", &ring, || peers::recorded(&ring, peers::ring));
    measure("coloring", &coloring, || {
        peers::recorded(&coloring, |x| peers::coloring(&drawing, x, niwaki_grad::Var::below_or))
    });
    for blocks in [6, 12, 28] {
        let x = peers::stack_start(blocks);
        measure(&format!("stack of {blocks}"), &x, || peers::recorded(&x, |x| peers::stack(blocks, x)));
    }
}

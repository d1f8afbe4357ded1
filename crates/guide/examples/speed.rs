//! The cost of a guide on one thread: `cargo run --release -p niwaki-guide --example speed`.
//!
//! A network of the usual size (62 numbers of a window, 13 features, 20 sites): nanoseconds for a window, for an
//! answer and for a draw, beside a draw of the prior; and microseconds for a training step of 256 choices.

use niwaki_guide::{Head, Net, NetForm, Rows, Scratch, Training, train};
use niwaki_math::{Dist, Stream};
use std::hint::black_box;
use std::time::Instant;

/// Nanoseconds of a call, over `n` calls.
fn each(n: u64, mut call: impl FnMut(u64)) -> f64 {
    let start = Instant::now();
    (0..n).for_each(&mut call);
    start.elapsed().as_secs_f64() * 1e9 / n as f64
}

fn main() {
    let dists = [
        Dist::Uniform { lo: -3.0, hi: 3.0 },
        Dist::Bernoulli { p: 0.3 },
        Dist::Gaussian { mean: 0.0, sd: 1.0 },
        Dist::Beta { a: 2.0, b: 3.0 },
        Dist::Poisson { rate: 4.0 },
    ];
    let heads: Vec<Head> = (0..20).filter_map(|k| Head::of(&dists[k % 5], 4)).collect();
    let form = NetForm::new(62, 13, heads);
    let net: Net = Net::start(form.clone(), 1);
    let mut stream = Stream::new(1, 0, 0, 0);
    let windows: Vec<Vec<f32>> =
        (0..1000).map(|_| (0..62).map(|_| stream.uniform() as f32).collect()).collect();
    let features: Vec<(u32, f32)> = (0..13).map(|k| (k, 0.3 * k as f32)).collect();
    let (mut sums, mut scratch) = (Vec::new(), Scratch::default());
    let see = each(1_000_000, |k| net.see(black_box(&windows[k as usize % 1000]), &mut sums));
    let answer = each(1_000_000, |k| {
        black_box(net.answer(black_box(&sums), &features, k as usize % 20, &mut scratch));
    });
    println!("{} weights: see {see:.0} ns, answer {answer:.0} ns", net.size());
    for (site, d) in dists.iter().enumerate() {
        let outputs = net.answer(&sums, &features, site, &mut scratch).to_vec();
        let head = form.heads[site];
        let draw = each(300_000, |k| {
            black_box(head.draw(&outputs, d, 0.02, &mut Stream::new(1, k, 2, 3)));
        });
        let prior = each(300_000, |k| {
            black_box(d.sample_and_score(&mut Stream::new(1, k, 2, 3)));
        });
        println!("{}: draw {draw:.0} ns, of the prior {prior:.0} ns", d.family());
    }
    let mut rows = Rows::new(&form);
    for k in 0..200_000 {
        let d = &dists[k % 5];
        let mut window = windows[k % 1000].clone();
        window[0] += k as f32 * 1e-6;
        let Some(lesson) = form.heads[k % 20].lesson(d, &d.sample(&mut stream)) else { continue };
        rows.push(k % 20, &window, &features, &lesson);
    }
    let with = Training { steps: 1000, every: 1000, ..Training::new(1, 0) };
    let start = Instant::now();
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(1).build() else { return };
    let trained = pool.install(|| train(net, &rows, &Rows::new(&form), &with, &mut |_| true));
    let step = start.elapsed().as_secs_f64() * 1e3;
    println!("training: {step:.0} us a step, {} bytes a row", rows.bytes() / rows.len());
    black_box(trained.is_ok());
}

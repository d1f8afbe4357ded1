//! Chains over three densities, for the bench beside other systems: see `benches/hmc`.
//!
//!     trajectories start MODEL                                   time until the first gradient, and until machine code
//!     trajectories check MODEL                                   largest errors against known values and gradients
//!     trajectories chain MODEL POINT STEP LENGTH DRAWS SEED OUT  one chain; draws go to the file OUT, f64 in native order
//!     trajectories lanes MODEL POINT STEP LENGTH DRAWS SEED -    64 chains in lanes
//!     trajectories nuts MODEL POINT WARMUP DRAWS SEED OUT        the no-U-turn sampler, with its own warm-up
//!     trajectories vi MODEL POINT FAMILY STEPS DRAWS SEED        a normal near the density, and its bound by DRAWS draws
//!
//! MODEL is ring, coloring, stack, or stackN of N blocks; POINT a file with a number for each coordinate. Prints one
//! JSON line.

#[path = "programs/densities.rs"]
mod densities;

use densities::{Target, density, first_point, peers};
use niwaki_continuous::hamiltonian::chains::{Length, run};
use niwaki_continuous::hamiltonian::lanes::run_in_lanes;
use niwaki_continuous::hamiltonian::{Chain, Draws, Settings, Shape};
use niwaki_continuous::variational;
use niwaki_continuous::variational::ascent::{ascend, counts};
use niwaki_continuous::variational::family::Family;
use niwaki_continuous::variational::pathfinder::pathfinder;
use niwaki_continuous::variational::{Batch, Purpose};
use niwaki_grad::{Compiled, Native, Tape, Wide};
use niwaki_math::Stream;
use std::sync::Arc;
use std::time::Instant;

fn milliseconds<T>(f: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = f();
    (result, start.elapsed().as_secs_f64() * 1e3)
}

/// Seconds of CPU time of this thread.
fn cpu() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split_whitespace().next().and_then(|w| w.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1e-9
}

fn startup(model: &str) -> String {
    let point = first_point(model);
    let mut g = vec![0.0; point.len()];
    let (density, recording) = milliseconds(|| Arc::new(density(model)));
    let (mut compiled, tape) = milliseconds(|| {
        let mut compiled = Compiled::new(density.clone());
        compiled.inside(&point, &mut g);
        compiled
    });
    let busy = cpu();
    let (_, code) = milliseconds(|| Native::compile(&density).is_ok());
    let code_cpu = (cpu() - busy) * 1e3;
    let (_, behind) = milliseconds(|| {
        // As in a chain: gradients by tape while the code is compiled, a value at the end of each trajectory.
        while !compiled.is_native() {
            (0..100).for_each(|_| {
                compiled.gradient(&point, &mut g);
            });
            compiled.inside(&point, &mut g);
        }
    });
    let (both, slope) = density.operations();
    format!(
        r#"{{"dim": {}, "operations": {both}, "operations_of_gradient": {slope}, "slots": {}, "record_ms": {recording},
            "first_gradient_ms": {tape}, "machine_code_ms": {code},
            "machine_code_cpu_ms": {code_cpu}, "chain_until_machine_code_ms": {behind}}}"#,
        density.dim(),
        Tape::new(&density).slots(),
    )
    .replace('\n', "")
}

fn check(model: &str) -> String {
    let density = density(model);
    let mut native = Native::compile(&density).expect("machine code for this processor");
    let (mut value_off, mut slope_off) = (0.0_f64, 0.0_f64);
    let mut points = 0;
    for known in peers::known().into_iter().filter(|k| k.name == model) {
        let mut g = vec![0.0; known.x.len()];
        let value = native.value_and_gradient(&known.x, &mut g);
        value_off = value_off.max((value / known.value - 1.0).abs());
        let size = known.gradient.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let worst = g.iter().zip(&known.gradient).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        slope_off = slope_off.max(worst / size);
        points += 1;
    }
    format!(r#"{{"points": {points}, "value": {value_off}, "gradient": {slope_off}}}"#)
}

fn write(path: &str, draws: &[Draws]) {
    if path != "-" {
        let bytes: Vec<u8> = draws.iter().flat_map(|d| &d.x).flat_map(|x| x.to_ne_bytes()).collect();
        std::fs::write(path, bytes).unwrap_or_else(|error| panic!("{path}: {error}"));
    }
}

fn report(draws: &[Draws], seconds: f64, cpu: f64) -> String {
    let gradients: u64 = draws.iter().map(|d| d.gradients + d.warmup_gradients).sum();
    let accept: f64 = draws.iter().map(|d| d.accept.iter().sum::<f64>() / d.len() as f64).sum();
    format!(
        r#"{{"gradients": {gradients}, "seconds": {seconds}, "cpu_seconds": {cpu}, "accept": {}, "divergences": {}, "draws": {}}}"#,
        accept / draws.len() as f64,
        draws.iter().map(|d| d.divergences.len()).sum::<usize>(),
        draws.iter().map(Draws::len).sum::<usize>(),
    )
}

fn sample(args: &[&str]) -> String {
    let [what, model, point, rest @ ..] = args else { panic!("{USAGE}") };
    let text = std::fs::read_to_string(point).unwrap_or_else(|error| panic!("{point}: {error}"));
    let start: Vec<f64> = text.split_whitespace().map(|word| word.parse().expect(USAGE)).collect();
    let number = |k: usize| rest.get(k).and_then(|word| word.parse::<u32>().ok()).expect(USAGE);
    let density = Arc::new(density(model));
    if *what == "nuts" {
        let settings = Settings { warmup: number(0), draws: number(1), ..Settings::nuts() };
        let (clock, busy) = (Instant::now(), cpu());
        let target = Target(Compiled::new(density));
        let chain = Chain::new(target, &start, &settings, u64::from(number(2)), 0).expect("a point of it");
        let draws = [run(chain, &settings, &|_| true)];
        let line = report(&draws, clock.elapsed().as_secs_f64(), cpu() - busy);
        write(rest[3], &draws);
        return line;
    }
    let settings = Settings {
        length: Length::Fixed { steps: number(1), jitter: 0.0 },
        warmup: 0,
        draws: number(2),
        shape: Shape::Unit,
        step_size: Some(rest[0].parse().expect(USAGE)),
        ..Settings::hmc()
    };
    let (seed, count) = (u64::from(number(3)), if *what == "lanes" { 64 } else { 1 });
    let chains: Vec<_> = (0..count)
        .map(|k| {
            let mut compiled = Compiled::new(density.clone());
            if *what == "chain" {
                compiled.finish();
            }
            Chain::new(Target(compiled), &start, &settings, seed, k).expect("a point of it")
        })
        .collect();
    let (clock, busy) = (Instant::now(), cpu());
    let draws: Vec<Draws> = if *what == "lanes" {
        let mut all = Vec::new();
        let mut chains = chains.into_iter().peekable();
        while chains.peek().is_some() {
            let group: Vec<_> = chains.by_ref().take(LANES).collect();
            let mut wide = Wide::<LANES>::new(&density);
            all.extend(run_in_lanes(group, &mut wide, &settings, &|_, _| true));
        }
        all
    } else {
        chains.into_iter().map(|chain| run(chain, &settings, &|_| true)).collect()
    };
    let line = report(&draws, clock.elapsed().as_secs_f64(), cpu() - busy);
    write(rest[4], &draws);
    line
}

/// A normal by a family's name (mean-field, full-rank, pathfinder): the seconds of its search without the recording, and its bound.
fn normal(args: &[&str]) -> String {
    let [_, model, point, family, rest @ ..] = args else { panic!("{USAGE}") };
    let text = std::fs::read_to_string(point).unwrap_or_else(|error| panic!("{point}: {error}"));
    let start: Vec<f64> = text.split_whitespace().map(|word| word.parse().expect(USAGE)).collect();
    let number = |k: usize| rest.get(k).and_then(|word| word.parse::<u32>().ok()).expect(USAGE);
    let (steps, draws, seed) = (number(0), number(1), u64::from(number(2)));
    let clock = Instant::now();
    let density = Arc::new(density(model));
    let recorded = clock.elapsed().as_secs_f64();
    let busy = cpu();
    let mut target = Target(Compiled::new(density.clone()));
    let mut wide = Wide::<{ variational::LANES }>::new(&density);
    let mut batch = Batch::new(&mut target, &mut wide);
    let path = pathfinder(&mut batch, &start, seed, 0, &|_| true).expect("one structure");
    let path_seconds = clock.elapsed().as_secs_f64() - recorded;
    let family = match *family {
        "mean-field" => Some(Family::MeanField),
        "full-rank" => Some(Family::FullRank),
        _ => None,
    };
    let (approximation, step_count, converged) = match family {
        None => (path.normal, path.bounds.len(), true),
        Some(family) => {
            let settings = variational::Settings { family, steps, samples: 16, tolerance: 0.02 };
            let fit = ascend(&mut batch, &path.normal, &settings, seed, 0, &|_| true).expect("one structure");
            (fit.normal, fit.bounds.len(), fit.converged)
        }
    };
    let (seconds, busy, gradients) =
        (clock.elapsed().as_secs_f64() - recorded, cpu() - busy, batch.gradients);
    let mut stream = Stream::new(seed, 1, Purpose::Draw as u128, 0);
    let mut rows = [(); 3].map(|()| vec![[0.0; variational::LANES]; start.len()]);
    let mut ratios = Vec::new();
    for count in counts(draws as usize) {
        let [z, x, g] = &mut rows;
        approximation.draw(&mut stream, z, x);
        let log_q = approximation.log_density(z);
        let log_p = batch.evaluate(x, g, count).expect("one structure");
        ratios.extend(log_p.iter().zip(log_q).take(count).map(|(p, q)| p - q));
    }
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    let variance = ratios.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / ratios.len() as f64;
    format!(
        r#"{{"record_seconds": {recorded}, "path_seconds": {path_seconds}, "seconds": {seconds}, "cpu_seconds": {busy}, "gradients": {gradients}, "steps": {step_count}, "converged": {converged}, "bound": {mean}, "bound_error": {}}}"#,
        (variance / ratios.len() as f64).sqrt(),
    )
}

/// As `gradient::explore` groups them on one thread.
const LANES: usize = 64;

const USAGE: &str = "usage: trajectories start|check MODEL, chain|lanes MODEL POINT STEP LENGTH DRAWS SEED OUT, \
                     nuts MODEL POINT WARMUP DRAWS SEED OUT, or vi MODEL POINT FAMILY STEPS DRAWS SEED";

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let line = match args[..] {
        ["start", model] => startup(model),
        ["check", model] => check(model),
        ["chain" | "lanes" | "nuts", ..] => sample(&args),
        ["vi", ..] => normal(&args),
        _ => panic!("{USAGE}"),
    };
    println!("{line}");
}

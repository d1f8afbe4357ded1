//! A chain in a lane is the chain alone, to the bit: with lengths that vary, warm-ups of its own, refusals, and points
//! that only its own target covers.

use niwaki_continuous::hamiltonian::chains::{Length, run};
use niwaki_continuous::hamiltonian::climb::{climb, climb_in_lanes};
use niwaki_continuous::hamiltonian::lanes::{Wide, run_in_lanes, suits};
use niwaki_continuous::hamiltonian::{Cause, Chain, Draws, Potential, Settings, Shape, Stop};

/// A banana behind a wall: refused beyond it, not a number in one corner.
#[derive(Clone)]
struct Banana {
    curve: f64,
}

impl Potential for Banana {
    fn dim(&self) -> usize {
        2
    }
    fn value_and_gradient(&mut self, x: &[f64], g: &mut [f64]) -> Result<f64, Stop> {
        if x[0] > 1.8 {
            return Err(Stop { cause: Cause::Guard, place: 3 });
        }
        let bend = x[1] - self.curve * x[0] * x[0];
        g[0] = -x[0] + 8.0 * self.curve * bend * x[0];
        g[1] = if x[1] < -2.5 { f64::NAN } else { -4.0 * bend };
        Ok(-0.5 * x[0] * x[0] - 2.0 * bend * bend)
    }
}

/// The banana over lanes. Points with `y` above `top` are not covered.
struct Bananas {
    single: Banana,
    top: f64,
    evaluated: u64,
}

impl<const L: usize> Wide<L> for Bananas {
    fn value_and_gradient(&mut self, x: &[[f64; L]], g: &mut [[f64; L]]) -> ([f64; L], [bool; L]) {
        let (mut values, mut covered) = ([f64::NAN; L], [false; L]);
        for l in 0..L {
            let mut slope = [f64::NAN; 2];
            if let Ok(value) = self.single.value_and_gradient(&[x[0][l], x[1][l]], &mut slope) {
                (values[l], covered[l]) = (value, x[1][l] <= self.top);
            }
            // Lanes that are not covered have no meaning.
            (0..2).for_each(|k| g[k][l] = if covered[l] { slope[k] } else { 1e300 });
        }
        self.evaluated += 1;
        (values, covered)
    }
    fn gradient(&mut self, x: &[[f64; L]], g: &mut [[f64; L]]) -> [bool; L] {
        self.value_and_gradient(x, g).1
    }
}

fn settings(jitter: f64, shape: Shape) -> Settings {
    let length = Length::Fixed { steps: 12, jitter };
    Settings { length, warmup: 120, draws: 60, thin: 2, shape, ..Settings::hmc() }
}

fn chains(settings: &Settings, curve: f64) -> Vec<Chain<Banana>> {
    let start = |k: u64| [0.2 * k as f64 - 0.5, 0.3];
    (0..5)
        .map(|k| Chain::new(Banana { curve }, &start(k), settings, 17, k).expect("a point of the target"))
        .collect()
}

fn bits(draws: &Draws) -> Vec<u64> {
    let numbers = [&draws.x, &draws.log_density, &draws.energy, &draws.accept];
    let all = numbers.into_iter().flatten().chain([&draws.step_size]);
    all.map(|x| x.to_bits()).chain(draws.steps.iter().map(|n| u64::from(*n))).collect()
}

#[test]
fn a_lane_gives_what_its_chain_gives_alone() {
    for (jitter, shape, top) in [
        (0.0, Shape::Unit, f64::INFINITY),
        (0.5, Shape::Diagonal, f64::INFINITY),
        (0.5, Shape::Diagonal, 1.5),
        // Covered nowhere: its chains run alone.
        (0.3, Shape::Diagonal, f64::NEG_INFINITY),
    ] {
        let settings = settings(jitter, shape);
        assert!(suits(&settings));
        let alone: Vec<Draws> =
            chains(&settings, 1.0).into_iter().map(|chain| run(chain, &settings, &|_| true)).collect();
        let mut wide = Bananas { single: Banana { curve: 1.0 }, top, evaluated: 0 };
        let together = run_in_lanes::<_, 8>(chains(&settings, 1.0), &mut wide, &settings, &|_, _| true);
        for (a, b) in alone.iter().zip(&together) {
            assert_eq!(bits(a), bits(b), "{jitter} {shape:?} {top}");
            assert_eq!(
                (a.metric.as_ref(), a.broken, a.gradients),
                (b.metric.as_ref(), b.broken, b.gradients)
            );
            assert_eq!(a.len(), 60);
        }
        assert!(
            alone.iter().map(|a| a.broken.refused[Cause::Guard as usize]).sum::<u64>() > 0,
            "the wall is met"
        );
        assert_eq!(wide.evaluated < 50, top == f64::NEG_INFINITY, "{}", wide.evaluated);
    }
}

#[test]
fn an_ascent_in_a_lane_is_the_ascent_alone() {
    for top in [f64::INFINITY, 0.5, f64::NEG_INFINITY] {
        // The last but one meets the corner without a gradient, the last the wall: their ascents end there.
        let starts = [[0.3, 1.5], [-1.0, -2.0], [1.5, 0.1], [0.2, -2.6], [1.9, 0.0]];
        let (mut target, mut wide) =
            (Banana { curve: 1.0 }, Bananas { single: Banana { curve: 1.0 }, top, evaluated: 0 });
        let mut alone: Vec<Vec<f64>> = starts.iter().map(|start| start.to_vec()).collect();
        let steps_alone: Vec<u32> = alone.iter_mut().map(|x| climb(&mut target, x, 50)).collect();
        let mut targets = vec![target; starts.len()];
        let mut tops: Vec<Vec<f64>> = starts.iter().map(|start| start.to_vec()).collect();
        let steps_in_lanes = climb_in_lanes::<8>(
            &mut targets.iter_mut().collect::<Vec<_>>(),
            &mut tops.iter_mut().collect::<Vec<_>>(),
            &mut wide,
            50,
        );
        assert_eq!((&alone, &steps_alone), (&tops, &steps_in_lanes), "{top}");
        assert!(steps_alone[..2].iter().all(|&steps| steps > 1), "{steps_alone:?}");
        assert_eq!((steps_alone[3..].to_vec(), &tops[4]), (vec![1, 1], &starts[4].to_vec()));
    }
}

#[test]
fn a_wide_density_that_is_another_one_is_found_out() {
    let settings = settings(0.5, Shape::Diagonal);
    let alone = chains(&settings, 1.0).into_iter().map(|chain| run(chain, &settings, &|_| true));
    let mut wide = Bananas { single: Banana { curve: 1.0 + 1e-12 }, top: f64::INFINITY, evaluated: 0 };
    let together = run_in_lanes::<_, 8>(chains(&settings, 1.0), &mut wide, &settings, &|_, _| true);
    assert!(alone.zip(&together).all(|(a, b)| bits(&a) != bits(b)));
}

#[test]
fn lanes_can_be_stopped_one_by_one() {
    let settings = settings(0.0, Shape::Unit);
    let mut wide = Bananas { single: Banana { curve: 1.0 }, top: f64::INFINITY, evaluated: 0 };
    let ended = run_in_lanes::<_, 8>(chains(&settings, 1.0), &mut wide, &settings, &|chain, done| {
        chain != 1 || done < 150
    });
    let ends: Vec<(bool, usize)> = ended.iter().map(|draws| (draws.interrupted, draws.len())).collect();
    assert_eq!(ends, [(false, 60), (true, 20), (false, 60), (false, 60), (false, 60)]);
}

#[test]
fn only_fixed_lengths_and_scales_suit_lanes() {
    assert!(!suits(&Settings::nuts()));
    assert!(!suits(&settings(0.0, Shape::Dense)) && !suits(&settings(0.0, Shape::LowRank)));
}

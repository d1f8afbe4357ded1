//! A path of targets from loose to tight: walked down once (annealing) or by all rungs at a time (parallel tempering).
//!
//! Soft constraints with a common factor on their widths make such a path: wide, and every design is nearly as good;
//! narrow, and only a thin sheet is left. Annealing only finds a start; it is no draw. Parallel tempering is a chain
//! on all rungs, whose tightest one draws from its target. Two neighbours exchange their points with probability
//!
//! ```text
//! min(1, exp(l_i(x_j) + l_j(x_i) - l_i(x_i) - l_j(x_j)))
//! ```
//!
//! even pairs and odd pairs in turn (Okabe et al. 2001; Syed et al. 2022, section 2.3, on why in turn and not at
//! random), where `l_i` is the log density of rung i.

use super::chains::{Chain, Draws, Purpose, Settings};
use super::potential::{Potential, Stop, evaluate};
use super::transition::acceptance;
use super::warmup::Adaptation;
use rayon::prelude::*;

/// A log density with one more parameter.
pub trait Family {
    /// How many coordinates.
    fn dim(&self) -> usize;

    /// The log density at `x` for this `width` (1: as the model states its constraints; above 1: looser), nats, and its
    /// gradient in `x`.
    ///
    /// # Errors
    /// A point that the target refuses.
    fn value_and_gradient(&mut self, x: &[f64], width: f64, gradient: &mut [f64]) -> Result<f64, Stop>;
}

/// One member of a family.
#[derive(Clone, Debug)]
pub struct At<F> {
    /// The family.
    pub family: F,
    /// The factor on the widths.
    pub width: f64,
}

impl<F: Family> Potential for At<F> {
    fn dim(&self) -> usize {
        self.family.dim()
    }
    fn value_and_gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<f64, Stop> {
        self.family.value_and_gradient(x, self.width, gradient)
    }
}

/// Widths from `loosest` down to 1, each the same ratio below the one before; `rungs` of them, at least two.
pub fn ladder(loosest: f64, rungs: usize) -> Vec<f64> {
    let last = rungs.max(2) - 1;
    (0..=last).map(|k| loosest.powf(1.0 - k as f64 / last as f64)).collect()
}

/// Walks a chain down a ladder of widths with `each` transitions on every rung, whose step size is adapted anew; gives
/// the point that it reaches, unconstrained.
///
/// # Errors
/// The refusal of the start, or of a point of one rung by the next.
pub fn anneal<F: Family>(
    family: F,
    start: &[f64],
    widths: &[f64],
    each: u32,
    settings: &Settings,
    seed: u64,
    number: u64,
) -> Result<Vec<f64>, Stop> {
    let width = widths.first().copied().unwrap_or(1.0);
    let mut chain = Chain::new(At { family, width }, start, settings, seed, number)?;
    // Every rung is a warm-up of its own, within which both step size and metric may settle.
    let rung_settings = Settings { warmup: each, ..settings.clone() };
    for (rung, width) in widths.iter().enumerate() {
        chain.rung = rung as u32;
        chain.target.width = *width;
        chain.phase.log_density = evaluate(&mut chain.target, &chain.phase.x, &mut chain.phase.gradient)?;
        let mut adaptation = Adaptation::new(&mut chain, &rung_settings);
        for _ in 0..each {
            let made = chain.advance();
            adaptation.learn(&mut chain, &made);
        }
    }
    Ok(chain.phase.x)
}

/// What a tempered chain gave.
#[derive(Clone, Debug, Default)]
pub struct Tempered {
    /// Draws of the last rung. Its gradients and divergences are its own; those of the others are not counted.
    pub draws: Draws,
    /// Share of exchanges accepted between each rung and the next, after warm-up, `(rungs - 1,)`.
    pub exchanges: Vec<f64>,
    /// Gradients on all rungs, exchanges and warm-up included.
    pub gradients: u64,
}

/// One tempered chain: every rung moves, in parallel, then neighbours may exchange. Each rung adapts its own step size
/// and metric in warm-up.
///
/// # Errors
/// The refusal of `start` by a rung.
pub fn parallel_tempering<F: Family + Send>(
    make: impl Fn(usize) -> F,
    start: &[f64],
    widths: &[f64],
    settings: &Settings,
    seed: u64,
    number: u64,
    watch: &dyn Fn(u32) -> bool,
) -> Result<Tempered, Stop> {
    let mut rungs = Vec::new();
    for (k, width) in widths.iter().enumerate() {
        let target = At { family: make(k), width: *width };
        let mut chain = Chain::new(target, start, settings, seed, number)?;
        chain.rung = k as u32;
        let adaptation = Adaptation::new(&mut chain, settings);
        rungs.push((chain, adaptation));
    }
    let Some(pairs) = rungs.len().checked_sub(1) else { return Ok(Tempered::default()) };
    let mut tempered = Tempered {
        draws: Draws { dim: start.len(), ..Draws::default() },
        exchanges: vec![0.0; pairs],
        gradients: 0,
    };
    let mut offered = vec![0u32; pairs];
    let mut spare = (vec![0.0; start.len()], vec![0.0; start.len()]);
    let thin = settings.thin.max(1);
    let total = settings.warmup + settings.draws * thin;
    for visit in 0..total {
        let warming = visit < settings.warmup;
        let made: Vec<_> = rungs
            .par_iter_mut()
            .map(|(chain, adaptation)| {
                let made = chain.advance();
                if warming {
                    adaptation.learn(chain, &made);
                }
                made
            })
            .collect();
        tempered.gradients += made.iter().map(|one| u64::from(one.steps)).sum::<u64>();

        for pair in ((visit as usize % 2)..pairs).step_by(2) {
            let (low, high) = rungs.split_at_mut(pair + 1);
            let accepted = exchange(&mut low[pair].0, &mut high[0].0, &mut spare);
            tempered.gradients += 2;
            if !warming {
                tempered.exchanges[pair] += f64::from(u8::from(accepted));
                offered[pair] += 1;
            }
        }

        let (last, last_made) = (&rungs[pairs].0, &made[pairs]);
        if warming {
            tempered.draws.count_warmup(last_made);
        } else {
            let diverging = tempered.draws.count(last_made);
            if (visit - settings.warmup) % thin == thin - 1 {
                tempered.draws.push(&last.phase, last_made, diverging);
            }
        }
        if !watch(visit + 1) {
            tempered.draws.interrupted = true;
            break;
        }
    }
    for (share, offers) in tempered.exchanges.iter_mut().zip(offered) {
        *share /= f64::from(offers.max(1));
    }
    if let Some((last, _)) = rungs.pop() {
        tempered.draws.step_size = last.step_size;
        tempered.draws.metric = Some(last.metric);
    }
    Ok(tempered)
}

/// Offers two rungs each other's points; a refusal by either is a rejection.
fn exchange<F: Family>(a: &mut Chain<At<F>>, b: &mut Chain<At<F>>, spare: &mut (Vec<f64>, Vec<f64>)) -> bool {
    let u = a.stream(Purpose::Exchange).uniform();
    let Ok(a_there) = evaluate(&mut a.target, &b.phase.x, &mut spare.0) else { return false };
    let Ok(b_there) = evaluate(&mut b.target, &a.phase.x, &mut spare.1) else { return false };
    let log_ratio = a_there + b_there - a.phase.log_density - b.phase.log_density;
    if u >= acceptance(log_ratio) {
        return false;
    }
    std::mem::swap(&mut a.phase.x, &mut b.phase.x);
    std::mem::swap(&mut a.phase.gradient, &mut spare.0);
    std::mem::swap(&mut b.phase.gradient, &mut spare.1);
    (a.phase.log_density, b.phase.log_density) = (a_there, b_there);
    true
}

#[cfg(test)]
mod tests {
    //! Tempering finds both of two modes in their proportion, where one chain stays in its own; annealing finds a sheet.
    use super::*;
    use crate::hamiltonian::chains;

    /// Two normals of deviation `width * 0.1` around -2 and 2, the right one three times as heavy.
    #[derive(Clone)]
    struct TwoModes;

    impl Family for TwoModes {
        fn dim(&self) -> usize {
            1
        }
        fn value_and_gradient(&mut self, x: &[f64], width: f64, g: &mut [f64]) -> Result<f64, Stop> {
            let s2 = (0.1 * width).powi(2);
            let (left, right) =
                (-0.5 * (x[0] + 2.0).powi(2) / s2, 3f64.ln() - 0.5 * (x[0] - 2.0).powi(2) / s2);
            let top = left.max(right);
            let total = top + ((left - top).exp() + (right - top).exp()).ln();
            g[0] = ((left - total).exp() * -(x[0] + 2.0) - (right - total).exp() * (x[0] - 2.0)) / s2;
            Ok(total)
        }
    }

    #[test]
    fn parallel_tempering_visits_both_modes_in_proportion() {
        let settings = Settings { warmup: 300, draws: 4000, ..Settings::nuts() };
        let widths = ladder(20.0, 8);
        let run = |start: f64| {
            parallel_tempering(|_| TwoModes, &[start], &widths, &settings, 3, 0, &|_| true).expect("a start")
        };
        for start in [-2.0, 2.0] {
            let tempered = run(start);
            assert!(tempered.exchanges.iter().all(|share| *share > 0.3), "{:?}", tempered.exchanges);
            // Batch means over 20 batches: the share lies within 6 standard errors (Student's t with 19 degrees of
            // freedom, false alarm 1e-5).
            let right: Vec<f64> = tempered.draws.x.iter().map(|x| f64::from(u8::from(*x > 0.0))).collect();
            let batches: Vec<f64> = right.chunks(200).map(|b| b.iter().sum::<f64>() / 200.0).collect();
            let mean = batches.iter().sum::<f64>() / 20.0;
            let var = batches.iter().map(|b| (b - mean).powi(2)).sum::<f64>() / 19.0 / 20.0;
            assert!(var > 0.0 && (mean - 0.75).abs() < 6.0 * var.sqrt(), "{mean} {}", var.sqrt());
            assert!(var.sqrt() < 0.05, "{}", var.sqrt());
        }
        // Without it the chain never leaves.
        let alone =
            chains::sample(|_| At { family: TwoModes, width: 1.0 }, &[vec![-2.0]], &settings, 3, &|_, _| {
                true
            });
        assert!(alone.expect("a start")[0].x.iter().all(|x| *x < 0.0));
    }

    /// The dissertation's point (eq. 4.1) with a wide normal to keep it in.
    #[derive(Clone)]
    struct Sheet;

    impl Family for Sheet {
        fn dim(&self) -> usize {
            2
        }
        fn value_and_gradient(&mut self, x: &[f64], width: f64, g: &mut [f64]) -> Result<f64, Stop> {
            let s = 1e-5 * width;
            let z = x[1].powi(4) - x[1].powi(2) + x[0].powi(2) - 0.25;
            let slope = -z / (s * s);
            g[0] = slope * 2.0 * x[0] - x[0];
            g[1] = slope * (4.0 * x[1].powi(3) - 2.0 * x[1]) - x[1];
            Ok(-0.5 * (z / s).powi(2) - 0.5 * (x[0] * x[0] + x[1] * x[1]))
        }
    }

    #[test]
    fn annealing_arrives_on_a_thin_sheet() {
        let settings = Settings::nuts();
        for seed in 0..5 {
            let start = [1.4, -1.3 + 0.5 * seed as f64];
            let x = anneal(Sheet, &start, &ladder(1e5, 11), 40, &settings, seed, 0).expect("a start");
            let z = x[1].powi(4) - x[1].powi(2) + x[0].powi(2) - 0.25;
            assert!(z.abs() < 6e-5, "{z}");
        }
    }

    #[test]
    fn ladders_are_geometric() {
        let made = ladder(8.0, 4);
        assert!(made.iter().zip([8.0, 4.0, 2.0, 1.0]).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}

//! The ascent of the evidence bound: automatic differentiation variational inference (Kucukelbir, Tran, Ranganath,
//! Gelman & Blei 2017) with Adam (Kingma & Ba 2015, algorithm 1).
//!
//! In rounds. In a round the steps have one length, until the bound of a block of steps is no longer above that of the
//! block before by more than its noise. The iterates then move around an optimum, and their mean over the block is
//! nearer to it than the last (Dhaka et al. 2020, section 3). Means of two rounds are compared by the same draws. The ascent
//! ends when a round is no worse than the best and gains less than the tolerance, its error counted. The next round takes
//! shorter steps where a round gained nothing that its error lets one see, and begins at the best where it was worse: its
//! steps were too long. The result is the best of the means and the start.
//!
//! Where half of a step's draws have no finite density, or a block falls far below the best, the ascent goes back to the
//! best and takes shorter steps; after some such returns it ends there.

use super::batch::{Batch, Elsewhere, Row};
use super::family::{Family, Member, Memory};
use super::normal::Normal;
use super::{LANES, Purpose};
use crate::hamiltonian::Potential;
use crate::hamiltonian::lanes::Wide;
use niwaki_math::Stream;
use serde::Deserialize;

/// Length of the steps of the first round, in deviations of the start and logs of its scales.
const FIRST: f64 = 0.1;
/// The share of it in the next round, and after a return.
const FINER: f64 = 0.4;
/// A round with steps this short is the last.
const LAST: f64 = 1e-4;
/// Steps of a block in the first round; each round adds as many, up to so many times.
const BLOCK: u32 = 40;
const LONGEST: u32 = 8;
/// Draws by which means of rounds are compared.
const CHECKS: usize = 256;
/// Returns to the best after which an ascent ends.
const RETURNS: u32 = 4;
/// A block this many nats below the best, and as many for each coordinate, has fallen.
const FALL: f64 = 100.0;
/// How much of the mean slope, and of the mean squared slope, is remembered from one step to the next.
const MEMORY: (f64, f64) = (0.9, 0.99);
/// Keeps a parameter without any slope where it is.
const TINY: f64 = 1e-8;

/// The settings of an ascent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The family of the normals.
    pub family: Family,
    /// Steps at most.
    pub steps: u32,
    /// Draws of each step.
    pub samples: usize,
    /// A round that gains less ends the ascent, nats.
    pub tolerance: f64,
}

/// Where a fit starts.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// At the normal of a path.
    Pathfinder,
    /// Around a run.
    Run,
}

/// Where an ascent broke off.
#[derive(Clone, Debug, PartialEq)]
pub struct Broke {
    /// The step.
    pub step: u32,
    /// The last draw without a finite density or gradient, where that was the reason.
    pub x: Option<Vec<f64>>,
}

/// The result of an ascent.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The normal.
    pub normal: Normal,
    /// The estimate of the bound at each step, over the draws with a finite density, nats.
    pub bounds: Vec<f64>,
    /// Whether a round gained less than the tolerance.
    pub converged: bool,
    /// Where it broke off.
    pub broke: Option<Broke>,
    /// Whether it was stopped before its end.
    pub interrupted: bool,
}

/// Ascends from a normal. `number` keys the random bits; `watch` is called with the steps so far, and ends the ascent with
/// the best so far when it returns false.
///
/// # Errors
/// A draw that makes other choices.
pub fn ascend<P: Potential, W: Wide<LANES>>(
    batch: &mut Batch<'_, P, W>,
    start: &Normal,
    settings: &Settings,
    seed: u64,
    number: u64,
    watch: &dyn Fn(u32) -> bool,
) -> Result<Fit, Elsewhere> {
    let member = Member::new(settings.family, start, &batch.angles);
    let mut ascent = Ascent {
        adam: Adam::new(member.parameters.len()),
        slope: vec![0.0; member.parameters.len()],
        rows: Rows::new(&member),
        settings,
        seed,
        number,
        member,
        bounds: vec![],
    };
    let mut best = (ascent.member.clone(), ascent.check(batch)?);
    let (mut rate, mut round, mut returns) = (FIRST, 1, 0);
    let fit = |ascent: &mut Ascent, best: &(Member, Check), converged, broke, interrupted| Fit {
        normal: best.0.normal(),
        bounds: std::mem::take(&mut ascent.bounds),
        converged,
        broke,
        interrupted,
    };
    let mut before: Option<Block> = None;
    loop {
        let block = ascent.block(batch, rate, BLOCK * round.min(LONGEST), watch)?;
        let fell = block.mean < best.1.mean - FALL * (1.0 + 0.1 * start.dim() as f64)
            && before.as_ref().is_some_and(|before| block.mean < before.mean);
        match block.end {
            End::Interrupted => return Ok(fit(&mut ascent, &best, false, None, true)),
            End::Whole if !fell => {}
            _ => {
                returns += 1;
                if returns == RETURNS {
                    let x = batch.refused.take().filter(|_| !fell);
                    let broke = Broke { step: ascent.bounds.len() as u32, x };
                    return Ok(fit(&mut ascent, &best, false, Some(broke), false));
                }
                ascent.member.parameters.clone_from(&best.0.parameters);
                ascent.adam.forget();
                (rate, before) = (rate * FINER, None);
                continue;
            }
        }
        let is_last = ascent.bounds.len() as u32 >= settings.steps;
        let settled =
            before.as_ref().is_some_and(|before| block.mean - before.mean <= before.noise.hypot(block.noise));
        if !settled && !is_last {
            before = Some(block);
            continue;
        }
        ascent.member.parameters = block.center;
        let check = ascent.check(batch)?;
        let (gain, error) = check.gain(&best.1);
        // A mean that is as good as can be seen is taken: it has less noise than the one before.
        let is_better = gain > -2.0 * error;
        if is_better {
            best = (ascent.member.clone(), check);
        }
        let has_ended = settled && is_better && gain + 2.0 * error < settings.tolerance;
        if has_ended && rate < FIRST || rate < LAST || is_last {
            return Ok(fit(&mut ascent, &best, has_ended, None, false));
        }
        if !is_better {
            ascent.member.parameters.clone_from(&best.0.parameters);
            ascent.adam.forget();
        }
        // Steps are not too long while a round gains by them.
        if gain < settings.tolerance.max(2.0 * error) {
            rate *= FINER;
        }
        (round, before) = (round + 1, None);
    }
}

/// How a block of steps ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    Whole,
    /// A step had too few draws with a finite density, or the bound left the range of numbers.
    Refused,
    Interrupted,
}

/// Some steps of one length.
struct Block {
    /// The mean of the iterates.
    center: Vec<f64>,
    /// The mean of the bounds, nats, and its standard error.
    mean: f64,
    noise: f64,
    end: End,
}

/// The draws by which means of rounds are compared: `log p(x) - log q(x)` of each, nats.
struct Check {
    ratios: Vec<f64>,
    mean: f64,
}

impl Check {
    fn new(ratios: Vec<f64>) -> Check {
        let sound = ratios.iter().filter(|ratio| ratio.is_finite());
        let (count, sum) = sound.fold((0_u32, 0.0), |(n, sum), ratio| (n + 1, sum + ratio));
        let mean =
            if 2 * (count as usize) < ratios.len() { f64::NEG_INFINITY } else { sum / f64::from(count) };
        Check { ratios, mean }
    }

    /// By how much this one is higher than another, over the draws that both have, and the standard error of that, nats.
    fn gain(&self, other: &Check) -> (f64, f64) {
        if !other.mean.is_finite() || !self.mean.is_finite() {
            return (if self.mean > other.mean { f64::INFINITY } else { f64::NEG_INFINITY }, 0.0);
        }
        let both = self.ratios.iter().zip(&other.ratios).map(|(a, b)| a - b);
        let both: Vec<f64> = both.filter(|d| d.is_finite()).collect();
        let count = both.len().max(1) as f64;
        let mean = both.iter().sum::<f64>() / count;
        let variance = both.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count;
        (mean, (variance / count).sqrt())
    }
}

/// The memory of one batch of draws.
struct Rows {
    z: Vec<Row>,
    x: Vec<Row>,
    g: Vec<Row>,
    memory: Memory,
}

impl Rows {
    fn new(member: &Member) -> Rows {
        let none = vec![[0.0; LANES]; member.dim()];
        Rows { z: none.clone(), x: none.clone(), g: none, memory: member.memory() }
    }
}

struct Ascent<'a> {
    member: Member,
    adam: Adam,
    slope: Vec<f64>,
    rows: Rows,
    settings: &'a Settings,
    seed: u64,
    number: u64,
    bounds: Vec<f64>,
}

impl Ascent<'_> {
    /// Steps of one length.
    fn block<P: Potential, W: Wide<LANES>>(
        &mut self,
        batch: &mut Batch<'_, P, W>,
        rate: f64,
        steps: u32,
        watch: &dyn Fn(u32) -> bool,
    ) -> Result<Block, Elsewhere> {
        let first = self.bounds.len();
        let mut center = vec![0.0; self.member.parameters.len()];
        let mut end = End::Whole;
        for _ in 0..steps {
            if !watch(self.bounds.len() as u32) {
                end = End::Interrupted;
                break;
            }
            if !self.step(batch, rate)? {
                end = End::Refused;
                break;
            }
            center.iter_mut().zip(&self.member.parameters).for_each(|(c, p)| *c += p);
        }
        let block_bounds = &self.bounds[first..];
        let count = block_bounds.len().max(1) as f64;
        center.iter_mut().for_each(|c| *c /= count);
        let mean = block_bounds.iter().sum::<f64>() / count;
        let variance = block_bounds.iter().map(|b| (b - mean).powi(2)).sum::<f64>() / count;
        // A bound that grows without end leaves the range of numbers.
        if end == End::Whole && !variance.is_finite() {
            end = End::Refused;
        }
        Ok(Block { center, mean, noise: (variance / count).sqrt(), end })
    }

    /// One step; false where too few draws have a finite density.
    fn step<P: Potential, W: Wide<LANES>>(
        &mut self,
        batch: &mut Batch<'_, P, W>,
        rate: f64,
    ) -> Result<bool, Elsewhere> {
        let visit = self.bounds.len() as u64;
        let mut stream = Stream::new(self.seed, self.number, Purpose::Step as u128, visit);
        let (mut sum, mut sound) = (0.0, 0);
        self.slope.fill(0.0);
        for count in counts(self.settings.samples) {
            let Rows { z, x, g, memory } = &mut self.rows;
            z.iter_mut().flatten().for_each(|z| *z = stream.normal());
            let log_q = self.member.place(z, x, memory);
            let log_p = batch.evaluate(x, g, count)?;
            let is_sound: [bool; LANES] = std::array::from_fn(|l| l < count && log_p[l].is_finite());
            for l in (0..LANES).filter(|l| is_sound[*l]) {
                (sum, sound) = (sum + log_p[l] - log_q[l], sound + 1);
            }
            // The gradients of other lanes have no meaning, and may be no numbers.
            if is_sound.contains(&false) {
                g.iter_mut().for_each(|g| {
                    g.iter_mut().zip(is_sound).for_each(|(g, s)| *g = if s { *g } else { 0.0 })
                });
            }
            self.member.add_gradient(z, g, &is_sound, &mut self.slope, memory);
        }
        if 2 * sound < self.settings.samples {
            return Ok(false);
        }
        let share = 1.0 / sound as f64;
        self.bounds.push(sum * share);
        self.adam.step(&mut self.member.parameters, &self.slope, share, rate);
        Ok(self.member.parameters.iter().all(|p| p.is_finite()))
    }

    /// The ratios of the member at draws that are the same for all.
    fn check<P: Potential, W: Wide<LANES>>(
        &mut self,
        batch: &mut Batch<'_, P, W>,
    ) -> Result<Check, Elsewhere> {
        let mut stream = Stream::new(self.seed, self.number, Purpose::Check as u128, 0);
        let mut ratios = Vec::with_capacity(CHECKS);
        let Rows { z, x, g, memory } = &mut self.rows;
        for count in counts(CHECKS) {
            z.iter_mut().flatten().for_each(|z| *z = stream.normal());
            let log_q = self.member.place(z, x, memory);
            let log_p = batch.evaluate(x, g, count)?;
            ratios.extend(log_p.iter().zip(log_q).take(count).map(|(p, q)| p - q));
        }
        Ok(Check::new(ratios))
    }
}

/// How many draws each batch has.
pub fn counts(draws: usize) -> impl Iterator<Item = usize> {
    (0..draws).step_by(LANES).map(move |first| LANES.min(draws - first))
}

/// Means of slopes and of their squares.
struct Adam {
    means: Vec<(f64, f64)>,
    /// The shares of the initial zeros in the means.
    shares: (f64, f64),
}

impl Adam {
    fn new(size: usize) -> Adam {
        Adam { means: vec![(0.0, 0.0); size], shares: (1.0, 1.0) }
    }

    fn forget(&mut self) {
        *self = Adam::new(self.means.len());
    }

    /// One step up a slope that is `share` of these sums.
    fn step(&mut self, parameters: &mut [f64], sums: &[f64], share: f64, rate: f64) {
        self.shares = (self.shares.0 * MEMORY.0, self.shares.1 * MEMORY.1);
        let (first, second) = (rate / (1.0 - self.shares.0), 1.0 / (1.0 - self.shares.1));
        for ((p, sum), (mean, square)) in parameters.iter_mut().zip(sums).zip(&mut self.means) {
            let slope = sum * share;
            *mean = MEMORY.0 * *mean + (1.0 - MEMORY.0) * slope;
            *square = MEMORY.1 * *square + (1.0 - MEMORY.1) * slope * slope;
            *p += first * *mean / ((second * *square).sqrt() + TINY);
        }
    }
}

#[cfg(test)]
mod tests {
    //! Normal targets are found: by the full rank to the bit of their evidence, by the mean field to the best diagonal. An
    //! ascent that cannot go on keeps the best.
    use super::*;
    use crate::hamiltonian::metric::cholesky;
    use crate::hamiltonian::potential::tests::By;
    use crate::hamiltonian::{Cause, Stop};
    use crate::variational::batch::tests::Uncovered;

    const PRECISION: [f64; 9] = [2.0, 0.9, 0.0, 0.9, 1.0, -0.2, 0.0, -0.2, 0.5];

    fn correlated() -> impl Potential {
        By(3, |x: &[f64], g: &mut [f64]| {
            let at: Vec<f64> = x.iter().zip([1.0, -2.0, 30.0]).map(|(x, m)| x - m).collect();
            for (g, row) in g.iter_mut().zip(PRECISION.chunks(3)) {
                *g = -row.iter().zip(&at).map(|(p, x)| p * x).sum::<f64>();
            }
            Ok(0.5 * at.iter().zip(&*g).map(|(x, g)| x * g).sum::<f64>())
        })
    }

    fn settings(family: Family) -> Settings {
        Settings { family, steps: 4000, samples: 16, tolerance: 0.01 }
    }

    /// `log Z`: half the log determinant of `2 pi` covariance.
    fn evidence() -> f64 {
        let l = cholesky(&PRECISION).expect("positive definite");
        1.5 * std::f64::consts::TAU.ln() - (0..3).map(|i| l[i * 4].ln()).sum::<f64>()
    }

    fn fitted(family: Family) -> Fit {
        let (mut target, mut wide) = (correlated(), Uncovered);
        let start = Normal::diagonal(vec![0.0, 0.0, 27.0], vec![1.0; 3]);
        ascend(&mut Batch::new(&mut target, &mut wide), &start, &settings(family), 3, 0, &|_| true)
            .expect("one structure")
    }

    #[test]
    fn the_full_rank_reaches_the_evidence_without_noise() {
        let fit = fitted(Family::FullRank);
        let last = &fit.bounds[fit.bounds.len() - 100..];
        let mean = last.iter().sum::<f64>() / 100.0;
        assert!(fit.converged && (mean - evidence()).abs() < 1e-3, "{mean} {}", evidence());
    }

    #[test]
    fn the_mean_field_reaches_the_best_diagonal() {
        // The best diagonal has the variances 1 / precision; its bound is below by half the log of the ratio of determinants.
        let fit = fitted(Family::MeanField);
        let variances = fit.normal.covariance();
        for (i, variance) in variances.iter().enumerate() {
            assert!((variance * PRECISION[i * 4] - 1.0).abs() < 0.05, "{variances:?}");
        }
        assert!(fit.converged && (fit.normal.mean[2] - 30.0).abs() < 0.1, "{:?}", fit.normal.mean);
    }

    /// An angle's density over the line repeats every turn, and would be the higher the wider the normal is. Around the
    /// circle the bound is below the evidence, which is `log 1`.
    #[test]
    fn the_bound_of_an_angle_is_below_its_evidence() {
        // von Mises of concentration 1: ln I_0(1) = 0.2359143585.
        let log_norm = std::f64::consts::TAU.ln() + 0.235_914_358_5;
        for family in [Family::MeanField, Family::FullRank] {
            let mut target = By(1, |x: &[f64], g: &mut [f64]| {
                g[0] = -x[0].sin();
                Ok(x[0].cos() - log_norm)
            });
            let (mut wide, start) = (Uncovered, Normal::diagonal(vec![0.5], vec![0.1]));
            let mut batch = Batch::new(&mut target, &mut wide).around(vec![0]);
            let fit = ascend(&mut batch, &start, &settings(family), 3, 0, &|_| true).expect("one structure");
            let last = &fit.bounds[fit.bounds.len() - 200..];
            let mean = last.iter().sum::<f64>() / 200.0;
            // The best normal is 0.01 nats below; 3200 draws of a ratio whose deviation is about 0.15.
            assert!(mean < 0.012 && mean > -0.1, "{family:?}: {mean}");
        }
    }

    #[test]
    fn a_target_that_stops_being_a_number_keeps_the_best_and_says_where() {
        // The bound grows with the normal's width, until most draws lie where there is no number.
        let mut target = By(1, |x: &[f64], g: &mut [f64]| {
            g[0] = 2.0 * x[0];
            if x[0].abs() > 5.0 { Ok(f64::NAN) } else { Ok(x[0] * x[0]) }
        });
        let (mut wide, start) = (Uncovered, Normal::diagonal(vec![0.0], vec![0.1]));
        let mut batch = Batch::new(&mut target, &mut wide);
        let longer = Settings { steps: 20_000, ..settings(Family::MeanField) };
        let fit = ascend(&mut batch, &start, &longer, 1, 0, &|_| true).expect("one structure");
        let broke = fit.broke.expect("the ascent leaves the numbers");
        assert!(broke.x.is_some_and(|x| x[0].abs() > 5.0) && broke.step > 0);
        assert!(fit.normal.mean[0].is_finite() && !fit.converged);
        // A bound that leaves the range of numbers.
        let mut target = By(1, |x: &[f64], g: &mut [f64]| {
            g[0] = 4.0 * x[0].powi(3);
            Ok(x[0].powi(4))
        });
        let mut batch = Batch::new(&mut target, &mut wide);
        let longer = Settings { steps: 200_000, ..settings(Family::MeanField) };
        let fit = ascend(&mut batch, &start, &longer, 1, 0, &|_| true).expect("one structure");
        assert!(fit.broke.is_some() && fit.normal.log_det.is_finite());
        let stop = Stop { cause: Cause::Guard, place: 0 };
        let mut elsewhere = By(1, |_: &[f64], _: &mut [f64]| Err(stop));
        let mut batch = Batch::new(&mut elsewhere, &mut wide);
        let outcome = ascend(&mut batch, &start, &settings(Family::MeanField), 1, 0, &|_| true);
        assert!(outcome.is_err());
    }
}

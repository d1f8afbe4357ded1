//! Parallel chains: warm-up, then draws from a frozen kernel.
//!
//! Random streams are keyed by (seed, chain, purpose, step), so a chain's draws do not depend on the number of
//! threads, nor on the other chains.

use super::climb::climb;
use super::hmc::Hmc;
use super::leapfrog::Phase;
use super::metric::{Metric, Shape};
use super::nuts::Nuts;
use super::potential::{Cause, Potential, Stop};
use super::step_size::first_guess;
use super::transition::{BrokenOff, Divergence, Kernel, Transition};
use super::warmup::Adaptation;
use niwaki_math::Stream;
use rayon::prelude::*;

/// The rule for the length of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Length {
    /// A fixed number of leapfrog steps, with jitter.
    Fixed {
        /// Leapfrog steps.
        steps: u32,
        /// The jitter, as a share of the steps, in `[0, 1]`.
        jitter: f64,
    },
    /// A length until the trajectory turns back.
    NoUTurn {
        /// Most doublings.
        max_depth: u32,
    },
}

impl Length {
    /// Create a kernel of this length.
    pub fn kernel(self, max_energy_error: f64) -> Kernel {
        match self {
            Length::Fixed { steps, jitter } => Kernel::Hmc(Hmc::new(steps, jitter, max_energy_error)),
            Length::NoUTurn { max_depth } => Kernel::Nuts(Nuts::new(max_depth, max_energy_error)),
        }
    }
}

/// An energy error above this many nats is a divergence, as in Stan.
pub const MAX_ENERGY_ERROR: f64 = 1000.0;

/// The settings of a chain.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The length of trajectories.
    pub length: Length,
    /// The number of ascent steps from the start, before the warm-up.
    pub climb: u32,
    /// The number of warm-up transitions, which adapt step size and metric; their draws are dropped.
    pub warmup: u32,
    /// The number of draws after the warm-up.
    pub draws: u32,
    /// The number of transitions for each draw, at least one.
    pub thin: u32,
    /// The target acceptance of the adaptation of the step size.
    pub target_accept: f64,
    /// The shape of the fitted metric.
    pub shape: Shape,
    /// The first metric; by default the identity.
    pub metric: Option<Metric>,
    /// A fixed step size; by default it is adapted.
    pub step_size: Option<f64>,
    /// An energy error above this many nats is a divergence.
    pub max_energy_error: f64,
}

impl Settings {
    /// NUTS as in Stan: at most ten doublings, acceptance 0.8, a diagonal metric, 1000 transitions to warm up.
    pub fn nuts() -> Settings {
        Settings {
            length: Length::NoUTurn { max_depth: 10 },
            climb: 0,
            warmup: 1000,
            draws: 1000,
            thin: 1,
            target_accept: 0.8,
            shape: Shape::Diagonal,
            metric: None,
            step_size: None,
            max_energy_error: MAX_ENERGY_ERROR,
        }
    }

    /// The dissertation's length (100 steps, not jittered) and acceptance (0.65; dissertation 4.4).
    pub fn hmc() -> Settings {
        Settings {
            length: Length::Fixed { steps: 100, jitter: 0.0 },
            target_accept: 0.65,
            ..Settings::nuts()
        }
    }

    /// The kernel that these settings describe.
    pub fn kernel(&self) -> Kernel {
        self.length.kernel(self.max_energy_error)
    }
}

/// The purpose of a stream of random bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Purpose {
    /// Momentum, directions, acceptance of one transition.
    Transition,
    /// The search for a first step size.
    Guess,
    /// The length of one transition.
    Length,
}

/// A chain: its point and its kernel.
pub struct Chain<P> {
    /// The target.
    pub target: P,
    /// The present point.
    pub phase: Phase,
    /// The metric in use.
    pub metric: Metric,
    /// The step size in use.
    pub step_size: f64,
    /// The kernel.
    pub kernel: Kernel,
    /// The seed of all chains.
    pub seed: u64,
    /// The number of the chain.
    pub number: u64,
    /// The number of transitions so far.
    pub visit: u64,
    /// The number of gradients of the ascent.
    pub climbed: u32,
}

impl<P: Potential> Chain<P> {
    /// A chain at `start`, or uphill from it, with the settings' metric.
    ///
    /// # Errors
    /// The target's refusal of `start`.
    pub fn new(
        mut target: P,
        start: &[f64],
        settings: &Settings,
        seed: u64,
        number: u64,
    ) -> Result<Self, Stop> {
        let mut start = start.to_vec();
        let climbed = climb(&mut target, &mut start, settings.climb);
        Chain::on_top(target, &start, climbed, settings, seed, number)
    }

    /// A chain at `start`, which was reached with `climbed` gradients uphill.
    ///
    /// # Errors
    /// The target's refusal of `start`.
    pub fn on_top(
        mut target: P,
        start: &[f64],
        climbed: u32,
        settings: &Settings,
        seed: u64,
        number: u64,
    ) -> Result<Self, Stop> {
        let phase = Phase::at(&mut target, start)?;
        let metric = settings.metric.clone().unwrap_or_else(|| Metric::unit(start.len()));
        let (kernel, step_size) = (settings.kernel(), settings.step_size.unwrap_or(1.0));
        Ok(Chain { target, phase, metric, step_size, kernel, seed, number, visit: 0, climbed })
    }

    /// The random bits of this visit, for one purpose.
    pub fn stream(&self, purpose: Purpose) -> Stream {
        Stream::new(self.seed, self.number, purpose as u128, self.visit)
    }

    /// Random numbers for the length of the next transition. All chains use those of the first chain, so that lanes have
    /// equal lengths.
    pub(super) fn lengths(&self) -> Stream {
        Stream::new(self.seed, 0, Purpose::Length as u128, self.visit)
    }

    /// Make a transition.
    pub fn advance(&mut self) -> Transition {
        let (mut stream, mut lengths) = (self.stream(Purpose::Transition), self.lengths());
        self.visit += 1;
        let Chain { target, metric, step_size, phase, .. } = self;
        match &mut self.kernel {
            Kernel::Hmc(hmc) => {
                phase.refresh(metric, &mut stream);
                let steps = hmc.length(&mut lengths);
                hmc.go(target, metric, *step_size, phase, steps, &mut stream)
            }
            Kernel::Nuts(nuts) => nuts.step(target, metric, *step_size, phase, &mut stream),
        }
    }

    /// Sets the step size to one that suits a single step; the search starts from a guess.
    pub fn guess_step(&mut self, from: f64) {
        let mut stream = self.stream(Purpose::Guess);
        self.step_size = first_guess(&mut self.target, &self.metric, &self.phase, from, &mut stream);
    }
}

/// The draws of a chain, with their statistics.
#[derive(Clone, Debug, Default)]
pub struct Draws {
    /// The number of coordinates.
    pub dim: usize,
    /// The draws by rows, unconstrained, `(n, dim)`.
    pub x: Vec<f64>,
    /// Log density of each draw, nats.
    pub log_density: Vec<f64>,
    /// The Hamiltonian at each draw, with the momentum that led there, nats.
    pub energy: Vec<f64>,
    /// Mean acceptance of each draw's trajectory.
    pub accept: Vec<f64>,
    /// Leapfrog steps for each draw.
    pub steps: Vec<u32>,
    /// Doublings for each draw.
    pub depth: Vec<u32>,
    /// Whether a trajectory between each draw and the one before broke off for another reason than structure.
    pub diverging: Vec<bool>,
    /// Whether a trajectory between each draw and the one before was refused for structure ([`Cause::Guard`]).
    pub off_structure: Vec<bool>,
    /// The trajectories that broke off after warm-up.
    pub divergences: Vec<Divergence>,
    /// Counts of trajectories that broke off, in warm-up and after it.
    pub broken: BrokenOff,
    /// Gradients taken after warm-up.
    pub gradients: u64,
    /// Gradients taken in warm-up and uphill, without those of first guesses.
    pub warmup_gradients: u64,
    /// The frozen step size.
    pub step_size: f64,
    /// The frozen metric.
    pub metric: Option<Metric>,
    /// Whether the chain was stopped before its end.
    pub interrupted: bool,
}

impl Draws {
    /// The number of draws.
    pub fn len(&self) -> usize {
        self.energy.len()
    }

    /// Whether there are no draws.
    pub fn is_empty(&self) -> bool {
        self.energy.is_empty()
    }

    /// The draws in order.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.x.chunks_exact(self.dim.max(1))
    }

    /// Count a transition of the warm-up.
    pub(super) fn count_warmup(&mut self, transition: &Transition) {
        self.warmup_gradients += u64::from(transition.steps);
        if let Some(divergence) = &transition.divergence {
            self.broken.count(divergence.stop, true);
        }
    }

    /// Count a transition after warm-up; return the kind of its break.
    pub(super) fn count(&mut self, transition: &Transition) -> Marks {
        self.gradients += u64::from(transition.steps);
        let Some(divergence) = &transition.divergence else { return Marks::default() };
        self.broken.count(divergence.stop, false);
        self.divergences.push(divergence.clone());
        let off_structure = divergence.stop.is_some_and(|stop| stop.cause == Cause::Guard);
        Marks { diverging: !off_structure, off_structure }
    }

    /// Add the present point as a draw.
    pub(super) fn push(&mut self, phase: &Phase, transition: &Transition, broke_off: Marks) {
        self.x.extend_from_slice(&phase.x);
        self.log_density.push(phase.log_density);
        self.energy.push(transition.energy);
        self.accept.push(transition.accept);
        self.steps.push(transition.steps);
        self.depth.push(transition.depth);
        self.diverging.push(broke_off.diverging);
        self.off_structure.push(broke_off.off_structure);
    }
}

/// How trajectories between two draws broke off, if they did.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Marks {
    diverging: bool,
    off_structure: bool,
}

/// The failure of a chain that could not start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BadStart {
    /// The number of the chain.
    pub chain: usize,
    /// The reason of the target for refusing the start.
    pub stop: Stop,
}

/// Called regularly with (chain, transitions so far). When it returns false, the chains end with the draws so far.
pub type Watch<'a> = &'a (dyn Fn(usize, u32) -> bool + Sync);

/// Transitions between two calls of `watch`.
pub const GLANCE: u64 = 32;

/// One chain for each start, in parallel; `make` gives each its own target.
///
/// # Errors
/// A start that its target refuses: the first such chain.
pub fn sample<P: Potential>(
    make: impl Fn(usize) -> P + Sync,
    starts: &[Vec<f64>],
    settings: &Settings,
    seed: u64,
    watch: Watch,
) -> Result<Vec<Draws>, BadStart> {
    let draws: Vec<Result<Draws, BadStart>> = starts
        .par_iter()
        .enumerate()
        .map(|(k, start)| {
            let chain = Chain::new(make(k), start, settings, seed, k as u64);
            let chain = chain.map_err(|stop| BadStart { chain: k, stop })?;
            Ok(run(chain, settings, &|done| watch(k, done)))
        })
        .collect();
    draws.into_iter().collect()
}

/// Run a chain: warm-up, then draws.
pub fn run<P: Potential>(chain: Chain<P>, settings: &Settings, watch: &dyn Fn(u32) -> bool) -> Draws {
    let mut ongoing = Ongoing::new(chain, settings);
    while !ongoing.is_over() {
        let transition = ongoing.chain.advance();
        ongoing.take(&transition);
        ongoing.check(watch);
    }
    ongoing.finish()
}

/// A chain in warm-up, or among its draws.
pub(super) struct Ongoing<'a, P> {
    pub(super) chain: Chain<P>,
    settings: &'a Settings,
    adaptation: Adaptation,
    draws: Draws,
    warmed: u32,
    /// Transitions left until the next draw.
    left: u32,
    /// The kinds of breaks since the last draw.
    broke_off: Marks,
}

impl<'a, P: Potential> Ongoing<'a, P> {
    pub(super) fn new(mut chain: Chain<P>, settings: &'a Settings) -> Self {
        let adaptation = Adaptation::new(&mut chain, settings);
        let dim = chain.phase.x.len();
        let draws = Draws { dim, warmup_gradients: u64::from(chain.climbed), ..Draws::default() };
        let left = settings.thin.max(1);
        Ongoing { chain, settings, adaptation, draws, warmed: 0, left, broke_off: Marks::default() }
    }

    pub(super) fn is_over(&self) -> bool {
        let drawn = self.draws.len() as u64 >= u64::from(self.settings.draws);
        self.draws.interrupted || self.warmed == self.settings.warmup && drawn
    }

    /// Adapt to a transition of the warm-up, or record a transition after it.
    pub(super) fn take(&mut self, transition: &Transition) {
        if self.warmed < self.settings.warmup {
            self.warmed += 1;
            self.draws.count_warmup(transition);
            self.adaptation.learn(&mut self.chain, transition);
            return;
        }
        let now = self.draws.count(transition);
        self.broke_off.diverging |= now.diverging;
        self.broke_off.off_structure |= now.off_structure;
        self.left -= 1;
        if self.left == 0 {
            self.draws.push(&self.chain.phase, transition, self.broke_off);
            (self.left, self.broke_off) = (self.settings.thin.max(1), Marks::default());
        }
    }

    /// Call `watch` regularly, and stop the chain when it returns false.
    pub(super) fn check(&mut self, watch: &dyn Fn(u32) -> bool) {
        let visit = self.chain.visit;
        self.draws.interrupted |= visit.is_multiple_of(GLANCE) && !watch(visit as u32);
    }

    pub(super) fn finish(mut self) -> Draws {
        self.draws.step_size = self.chain.step_size;
        self.draws.metric = Some(self.chain.metric);
        self.draws
    }
}

#[cfg(test)]
mod tests {
    //! Chains do not depend on threads or on one another; they can be stopped; a bad start is reported with its chain.
    use super::*;
    use crate::hamiltonian::potential::tests::{By, normals};

    fn chains(threads: usize, count: usize) -> Vec<Draws> {
        let settings = Settings { warmup: 150, draws: 50, ..Settings::nuts() };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let starts = vec![vec![0.3, -1.0, 2.0]; count];
        pool.install(|| sample(|_| normals(vec![0.1, 1.0, 10.0]), &starts, &settings, 7, &|_, _| true))
            .expect("the starts are points of the target")
    }

    #[test]
    fn draws_do_not_depend_on_threads_or_on_other_chains() {
        let (single, many) = (chains(1, 4), chains(3, 5));
        for (a, b) in single.iter().zip(&many) {
            assert_eq!((&a.x, &a.energy, a.step_size), (&b.x, &b.energy, b.step_size));
        }
        assert_ne!(single[0].x, single[1].x);
    }

    #[test]
    fn a_chain_can_be_stopped() {
        let settings = Settings { warmup: 100, draws: 1000, ..Settings::nuts() };
        let stopped = |at: u32| {
            let chains = sample(|_| normals(vec![1.0]), &[vec![0.0]], &settings, 1, &|_, done| done < at);
            let draws = chains.expect("a start").pop().expect("one chain");
            (draws.interrupted, draws.len())
        };
        assert_eq!(stopped(20), (true, 0));
        assert_eq!(stopped(164), (true, 92));
        assert_eq!(stopped(u32::MAX), (false, 1000));
    }

    #[test]
    fn a_start_that_is_refused_is_named() {
        let make = |_| {
            By(1, |x: &[f64], g: &mut [f64]| {
                g[0] = 0.0;
                Ok(x[0].ln())
            })
        };
        let bad = sample(make, &[vec![1.0], vec![-1.0]], &Settings::nuts(), 1, &|_, _| true);
        let stop = Stop { cause: Cause::NotFinite, place: 0 };
        assert_eq!(bad.err(), Some(BadStart { chain: 1, stop }));
    }
}

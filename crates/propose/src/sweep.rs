//! One sweep of sequential Monte Carlo: particles grow from barrier to barrier until all have ended.
//!
//! ```text
//! while particles run
//!     advance      each one runs to its next barrier; the held one follows its run
//!     weigh        the scores at this barrier count in the weights
//!     resample     where few particles have most of the weight; the held one survives
//!     rejuvenate   where the particles are moved
//! ```
//!
//! Nobody is held in a population of its own (SMC). In conditional SMC one particle holds the present run of a chain, so
//! that the sweep leaves the law of the runs as it is (Andrieu, Doucet & Holenstein 2010, section 4.3): particle Gibbs
//! sweeps over whole runs, regrowth over a part of one. What the particles are, and from which streams they draw, is theirs.

use niwaki_run::Failure;

/// Particles that a sweep grows.
pub trait Particles {
    /// What they show at a barrier.
    type Seen;

    /// How many run.
    fn running(&mut self) -> usize;

    /// Runs each of them to its next barrier, or to its end; the `held` one along the run that it holds.
    ///
    /// # Errors
    /// A fault of the program.
    fn advance(&mut self, held: Option<usize>) -> Result<(), Failure>;

    /// Counts the scores at this barrier in the weights.
    ///
    /// # Errors
    /// A sketch scores NaN, or all are impossible where that is an error.
    fn weigh(&mut self) -> Result<Self::Seen, Failure>;

    /// Whether to resample now.
    fn is_low(&self) -> bool;

    /// Resamples them; the `held` one survives, or another one takes its run over. Returns who holds it then.
    ///
    /// # Errors
    /// A fault of the program.
    fn resample(&mut self, held: Option<usize>) -> Result<Option<usize>, Failure>;

    /// Moves them, where that is due.
    ///
    /// # Errors
    /// A fault of the program.
    fn rejuvenate(&mut self, _resampled: bool) -> Result<(), Failure> {
        Ok(())
    }
}

/// Grows particles, of which one may be `held`, until all have ended. `watch` sees them at each barrier before they are
/// resampled; when it returns false, they are left as they are, and so is the return value.
///
/// # Errors
/// Those of the particles.
pub fn sweep<P: Particles>(
    particles: &mut P,
    mut held: Option<usize>,
    watch: &mut dyn FnMut(&mut P, P::Seen) -> bool,
) -> Result<bool, Failure> {
    while particles.running() > 0 {
        particles.advance(held)?;
        let seen = particles.weigh()?;
        if !watch(particles, seen) {
            return Ok(false);
        }
        let resampled = particles.is_low();
        if resampled {
            held = particles.resample(held)?;
        }
        particles.rejuvenate(resampled)?;
    }
    Ok(true)
}

//! A sweep of sequential Monte Carlo: particles run from barrier to barrier until all have ended.
//!
//! ```text
//! while particles run
//!     advance      each particle runs to its next barrier; the held particle follows its run
//!     weigh        the weights count the scores at this barrier
//!     resample     where few particles have most of the weight; the held particle survives
//!     rejuvenate   where particles are moved
//! ```
//!
//! Plain SMC holds no particle. In conditional SMC a particle holds the present run of a chain, so that the sweep preserves the
//! law of the runs (Andrieu, Doucet & Holenstein 2010, section 4.3): particle Gibbs sweeps over whole runs, regrowth over a part
//! of a run. The trait [`Particles`] leaves the form of particles and their random streams open.

use niwaki_run::Failure;

/// Particles that a sweep grows.
pub trait Particles {
    /// The summary of a barrier for `watch`.
    type Seen;

    /// The number of running particles.
    fn running(&mut self) -> usize;

    /// Run each particle to its next barrier or to its end. The `held` particle follows its run.
    ///
    /// # Errors
    /// A fault of the program.
    fn advance(&mut self, held: Option<usize>) -> Result<(), Failure>;

    /// Add the scores at this barrier to the weights.
    ///
    /// # Errors
    /// A sketch scores NaN; all particles are impossible, where that is an error.
    fn weigh(&mut self) -> Result<Self::Seen, Failure>;

    /// Whether to resample now.
    fn is_low(&self) -> bool;

    /// Resample the particles. The `held` particle survives, or another particle takes over its run. Returns the index of the
    /// particle that holds the run afterwards.
    ///
    /// # Errors
    /// A fault of the program.
    fn resample(&mut self, held: Option<usize>) -> Result<Option<usize>, Failure>;

    /// Move the particles, where a move is due.
    ///
    /// # Errors
    /// A fault of the program.
    fn rejuvenate(&mut self, _resampled: bool) -> Result<(), Failure> {
        Ok(())
    }
}

/// Run particles until all have ended. `held` is the index of a particle that holds a run. `watch` is called at each barrier
/// before resampling; when it returns false, the sweep stops and returns false.
///
/// # Errors
/// The errors of the methods of [`Particles`].
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

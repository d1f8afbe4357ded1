//! The memory of a population, held against its budget.
//!
//! What the particles' own activations take is known at any time. Copies of a particle share their values, so these are
//! estimated: all that was made counts, until a census over all particles finds what there is, each shared part once. Growth
//! adds up to the same on any number of threads, so the same populations are stopped.

use niwaki_propose::particle::Particle;
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::stack::{Call, RunFault};
use niwaki_vm::value::Census;

/// Values that a particle may drop between two barriers before it is counted again, bytes, and beside them this part of
/// those that it holds.
const DROPPED: usize = 1 << 16;
const DROPPED_PART: usize = 16;

/// A particle that had so many bytes of values before it ran is counted again where it has more than this.
pub(super) fn values_to_recount(before: usize) -> usize {
    before + DROPPED + before / DROPPED_PART
}

/// How much some particles have grown.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Growth {
    /// Bytes of activations: less, or more.
    activations: isize,
    /// Bytes of values made.
    values: usize,
    /// Bytes of all that grew.
    pub up: usize,
}

impl Growth {
    /// The growth of a number of equal particles: bytes of activations, and of new values.
    pub fn of(particles: usize, activations: isize, values: usize) -> Growth {
        let up = particles * (values + activations.max(0) as usize);
        Growth { activations: activations * particles as isize, values: values * particles, up }
    }

    /// Adds that of other particles.
    pub fn add(&mut self, other: Growth) {
        self.activations += other.activations;
        self.values += other.values;
        self.up += other.up;
    }
}

/// The memory that a population takes.
#[derive(Default)]
pub(super) struct Resident {
    activations: isize,
    values: usize,
    /// The part of `values` that is newer than the last census.
    fresh: usize,
}

impl Resident {
    /// By how much the particles may grow before the next barrier: an eighth of the budget is for what a census would
    /// find to be shared.
    pub fn room(&self, limit: usize) -> usize {
        (limit + limit / 8).saturating_sub(self.total())
    }

    /// With that growth.
    fn with(&self, growth: Growth) -> Resident {
        Resident {
            activations: self.activations + growth.activations,
            values: self.values.saturating_add(growth.values),
            fresh: self.fresh.saturating_add(growth.values),
        }
    }

    /// Whether a census may find that there is less, and it matters.
    fn is_close(&self, limit: usize) -> bool {
        self.total() > limit || self.total() > limit / 4 * 3 && self.fresh > limit / 8
    }

    /// Adds the growth of particles that cannot be counted one by one; false, and nothing is added, where they would have to be.
    pub fn grown_together(&mut self, growth: Growth, limit: usize) -> bool {
        let next = self.with(growth);
        let fits = growth.up <= self.room(limit) && !next.is_close(limit);
        if fits {
            *self = next;
        }
        fits
    }

    fn total(&self) -> usize {
        usize::try_from(self.activations).unwrap_or(0).saturating_add(self.values)
    }

    /// The particles have run to a barrier and grown. A census is made where it may matter.
    ///
    /// # Errors
    /// They take more than their budget.
    pub fn grown(&mut self, growth: Growth, task: &Task, particles: &[Particle]) -> Result<(), Failure> {
        let limit = task.limits.bytes;
        *self = self.with(growth);
        if self.is_close(limit) {
            let machine = task.machine();
            let mut census = Census::new();
            if let Some(first) = particles.first() {
                machine.leave_out_inputs(&first.state, &mut census);
            }
            particles.iter().for_each(|particle| particle.count(&mut census));
            (self.values, self.fresh) = (census.bytes(), 0);
        }
        if self.total() > limit { Err(too_large(task)) } else { Ok(()) }
    }
}

/// The failure of a particle; where it met its own share of the memory, with the budget of `all`, bytes.
fn of_share(failure: Failure, all: usize) -> Failure {
    match failure {
        Failure::Run(mut met) if met.fault.code == "memory-budget" => {
            let message =
                format!("one particle needs more than its share of the {} MB that all have", all >> 20);
            met.fault = Fault::new("memory-budget", message)
                .with_help("check that every recursion ends, use fewer particles, or raise `max_memory`");
            Failure::Run(met)
        }
        other => other,
    }
}

/// Runs `advance` on a particle, and adds by how much it has grown; also by becoming a copy of another one before.
#[inline]
pub(super) fn counted(
    particle: &mut Particle,
    machine: &mut Machine<'_>,
    all: usize,
    growth: &mut Growth,
    advance: impl FnOnce(&mut Particle, &mut Machine<'_>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let before = particle.state.value_bytes();
    advance(particle, machine).map_err(|failure| of_share(failure, all))?;
    if particle.state.value_bytes() > values_to_recount(before) {
        machine.recount(&mut particle.state);
    }
    let values = particle.state.value_bytes().saturating_sub(before);
    growth.values += values;
    growth.up += values;
    let activations = particle.state.own_bytes() as isize;
    if activations != particle.bytes {
        let grown = activations - std::mem::replace(&mut particle.bytes, activations);
        growth.activations += grown;
        growth.up += grown.max(0) as usize;
    }
    Ok(())
}

/// The fault of a population, at the function that the particles run: any of them may be the one that grows.
#[cold]
pub(super) fn too_large(task: &Task) -> Failure {
    let f = task.program.function(task.program.entry);
    let call = Call { function: f.name.clone(), file: f.file, span: f.span };
    let message = format!("the particles need more than {} MB together", task.limits.bytes >> 20);
    let fault = Fault::new("memory-budget", message)
        .with_help("use fewer particles, keep less in the model, or raise `max_memory`");
    Failure::Run(Box::new(RunFault { fault, stack: vec![call], omitted: 0, path: String::new() }))
}

//! Copies of a resampling. Each copy is made when the particles run again, by the thread that runs it.

use niwaki_propose::particle::Particle;
use niwaki_run::resampling::{further_copies, pair};
use std::collections::{HashSet, VecDeque};

/// The smallest number of copies of a parent that move to another thread in advance.
const FEW: usize = 4;

/// Pending copies.
#[derive(Default)]
pub(super) struct Copies {
    /// The number of survivors of each particle; empty without pending copies.
    counts: Vec<usize>,
    /// The parent and the index of each copy, by ascending parent.
    moves: Vec<(usize, usize)>,
    /// The thread of each copy.
    threads: Vec<usize>,
    /// The lineage of the first copy; further copies have the next lineages, in the order of `moves`.
    lineage: u64,
}

/// The ancestry of particles.
pub(super) struct Ancestry {
    /// The ancestor of each particle: its index at the first barrier.
    pub first: Vec<usize>,
    /// The number of lineages so far.
    pub lineages: u64,
}

impl Ancestry {
    /// Start the ancestry of `n` particles: each particle is its own ancestor.
    pub fn of(n: usize) -> Ancestry {
        Ancestry { first: (0..n).collect(), lineages: n as u64 }
    }

    /// The number of ancestors at the first barrier.
    pub fn ancestors(&self) -> usize {
        self.first.iter().collect::<HashSet<_>>().len()
    }
}

/// A particle and its index.
pub(super) struct Indexed<'a> {
    pub index: usize,
    pub particle: &'a mut Particle,
    /// For a particle that becomes a copy of the last particle before it that is no copy: its new lineage.
    lineage: Option<u64>,
}

impl Copies {
    /// Register a resampling in which particle `i` survives `counts[i]` times, and update the ancestry.
    pub fn plan(counts: Vec<usize>, ancestry: &mut Ancestry) -> Copies {
        let moves = further_copies(&counts);
        let lineage = ancestry.lineages;
        // Lineages are assigned in this order, whatever thread copies.
        ancestry.lineages += moves.len() as u64;
        for &(parent, to) in &moves {
            ancestry.first[to] = ancestry.first[parent];
        }
        let threads = Vec::new();
        if moves.is_empty() { Copies::default() } else { Copies { counts, moves, threads, lineage } }
    }

    /// Assign each copy to a thread: the thread of its parent, or another thread if a large family would overload it.
    pub fn share_out(&mut self, particles: &mut [Particle], threads: usize) {
        let home = |index: usize| particles[index].home % threads;
        let mut load = vec![0; threads];
        self.counts.iter().enumerate().for_each(|(index, count)| load[home(index)] += count);
        let fair = particles.len().div_ceil(threads);
        self.threads.clear();
        for family in self.moves.chunk_by(|a, b| a.0 == b.0) {
            let (home_thread, mut staying) = (home(family[0].0), family.len());
            let end = self.threads.len() + staying;
            self.threads.resize(end, home_thread);
            while let Some(idle) = (0..threads).min_by_key(|thread| load[*thread]) {
                let spare = fair.saturating_sub(load[idle]);
                let moving = load[home_thread].saturating_sub(fair).min(spare).min(staying);
                if moving < FEW {
                    break;
                }
                let last = end - (family.len() - staying);
                self.threads[last - moving..last].fill(idle);
                (load[home_thread], load[idle], staying) =
                    (load[home_thread] - moving, load[idle] + moving, staying - moving);
            }
        }
        self.give_near(particles);
    }

    /// Swaps the particles that copies will overwrite, so that each is overwritten by the thread that ran it: a thread
    /// then frees memory that it allocated itself. These particles are not used any more.
    fn give_near(&self, particles: &mut [Particle]) {
        // Indices whose particle another thread should overwrite, by the thread that ran the particle.
        let mut foreign: Vec<Vec<usize>> = Vec::new();
        for (at, (&(_, place), &wanted)) in self.moves.iter().zip(&self.threads).enumerate() {
            let home = particles[place].home;
            if wanted == home {
                continue;
            }
            if foreign.len() <= wanted.max(home) {
                foreign.resize(wanted.max(home) + 1, Vec::new());
            }
            match foreign[wanted].pop() {
                None => foreign[home].push(at),
                Some(other) => {
                    particles.swap(place, self.moves[other].1);
                    if self.threads[other] != home {
                        foreign[home].push(other);
                    }
                }
            }
        }
    }

    /// The number of survivors of a particle.
    pub fn count(&self, index: usize) -> usize {
        self.counts.get(index).copied().unwrap_or(1)
    }

    /// The parent, the index and the lineage of each copy.
    pub fn with_lineages(&self) -> impl Iterator<Item = (usize, usize, u64)> {
        self.moves.iter().zip(self.lineage..).map(|(&(parent, to), lineage)| (parent, to, lineage))
    }

    /// Make all pending copies.
    pub fn make(&mut self, particles: &mut [Particle], seed: u64) {
        for (parent, to, lineage) in self.with_lineages() {
            let [parent, child] = pair(particles, parent, to);
            child.copy_from(parent, lineage, seed);
        }
        self.clear();
    }

    /// The particles in batches of about `size`, for each of the `threads` those that it ran last and their copies, which
    /// are to be made.
    pub fn batches<'a>(
        &mut self,
        particles: &'a mut [Particle],
        seed: u64,
        size: usize,
        threads: usize,
    ) -> Vec<VecDeque<Vec<Indexed<'a>>>> {
        let mut lists: Vec<VecDeque<Vec<Indexed<'a>>>> = (0..threads).map(|_| VecDeque::new()).collect();
        let mut open: Vec<Vec<Indexed<'a>>> = (0..threads).map(|_| Vec::with_capacity(size)).collect();
        let mut all: Vec<Option<&mut Particle>> = particles.iter_mut().map(Some).collect();
        let mut moves = self.moves.iter().zip(&self.threads).zip(self.lineage..).peekable();
        let mut next_batch = |open: &mut Vec<Indexed<'a>>, thread: usize| {
            if open.len() >= size {
                lists[thread].push_back(std::mem::replace(open, Vec::with_capacity(size)));
            }
            open.len()
        };
        for index in 0..all.len() {
            if self.count(index) == 0 {
                continue;
            }
            let Some(particle) = all[index].take() else { continue };
            let mut thread = particle.home % threads;
            let mut parent = next_batch(&mut open[thread], thread);
            open[thread].push(Indexed { index, particle, lineage: None });
            while let Some(((&(_, to), &assigned), lineage)) =
                moves.next_if(|(((from, _), _), _)| *from == index)
            {
                let Some(particle) = all[to].take() else { continue };
                let mut waits = Some(lineage);
                if assigned != thread || open[thread].len() >= size {
                    // The rest of a large family is copied from its first copy.
                    particle.copy_from(open[thread][parent].particle, lineage, seed);
                    (thread, parent, waits) = (assigned, next_batch(&mut open[assigned], assigned), None);
                }
                open[thread].push(Indexed { index: to, particle, lineage: waits });
            }
        }
        for (list, batch) in lists.iter_mut().zip(open) {
            list.extend(Some(batch).filter(|batch| !batch.is_empty()));
        }
        lists
    }

    /// Clear the copies after they were made.
    pub fn clear(&mut self) {
        *self = Copies::default();
    }
}

/// Make the copies of a batch.
pub(super) fn copy(batch: &mut [Indexed<'_>], seed: u64) {
    let mut parent = 0;
    for at in 0..batch.len() {
        let (before, rest) = batch.split_at_mut(at);
        match rest[0].lineage.take() {
            None => parent = at,
            Some(lineage) => rest[0].particle.copy_from(before[parent].particle, lineage, seed),
        }
    }
}

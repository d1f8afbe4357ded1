//! Thinned samples of a chain, in bounded memory.

use crate::walk::state::State;
use niwaki_run::run::Run;
use niwaki_vm::code::Program;
use std::sync::Arc;

/// Samples, oldest first.
pub struct Samples {
    /// The samples, shared with their readers.
    pub all: Vec<Arc<Run>>,
    /// Proposals between two samples; doubled when they take too much memory. Zero: no samples.
    pub thin: u64,
    /// The most choices of all samples together.
    room: usize,
    held: usize,
}

impl Samples {
    /// Start without samples; a sample is due every `thin` proposals.
    pub fn new(thin: u64, room: usize) -> Samples {
        Samples { all: vec![], thin, room: room.max(1), held: 0 }
    }

    /// Restore the samples of a chain that resumes.
    pub(crate) fn restore(&mut self, all: Vec<Run>, thin: u64) {
        self.held = all.iter().map(|sample| sample.log.len() + 1).sum();
        (self.all, self.thin) = (all.into_iter().map(Arc::new).collect(), thin);
    }

    /// Add the present state. When the samples hold too many choices, every second sample is dropped: the remaining samples are
    /// those of twice the thinning. `warmup` is the proposal at which the first interval began.
    pub fn keep(&mut self, state: &State, program: &Program, visit: u64, warmup: u64) {
        self.held += state.trace.len() + 1;
        self.all.push(Arc::new(state.run(program, visit)));
        while self.held > self.room && self.all.len() > 1 {
            self.thin *= 2;
            let thin = self.thin;
            self.all.retain(|sample| (sample.visit - warmup).is_multiple_of(thin));
            self.held = self.all.iter().map(|sample| sample.log.len() + 1).sum();
        }
    }
}

//! Reachability: a check whether chains of regrowth by choice reach every run.
//!
//! Such a kernel changes one activation with choices of its own, and what is below it. The set of choices outside of it is fixed:
//! a run with a different set has weight zero. So the *outermost* activations with choices of their own are the same in every run that
//! a chain reaches. If two runs of the model differ in these activations, no chain leads between them:
//!
//! ```text
//! for i in range(3):                 an activation for each iteration, and the loop itself makes no choice:
//!     if flip(0.2): break            runs with one, two and three iterations are apart
//! ```

use niwaki_math::StreamKey;
use niwaki_run::Task;
use niwaki_run::fresh::Fresh;
use niwaki_vm::code::Program;
use niwaki_vm::machine::kept::part::{Part, Piece};
use niwaki_vm::machine::kept::{Change, Trace};
use std::collections::BTreeSet;

/// The number of runs from the prior.
const RUNS: u64 = 64;

/// The outermost activations of a run that make choices, by the hashes of their paths.
fn outermost(trace: &Trace, program: &Program) -> BTreeSet<u128> {
    let (mut activations, mut work) = (BTreeSet::new(), vec![Part::WHOLE]);
    while let Some(part) = work.pop() {
        let (mut below, mut chooses) = (vec![], false);
        trace.pieces(program, part, |piece| match piece {
            Piece::Choice(_) => chooses = true,
            Piece::Part(part) => below.push(part),
            Piece::Emit(_) | Piece::Held(_) => {}
        });
        if chooses {
            activations.insert(trace.part_path(part));
        } else {
            work.extend(below);
        }
    }
    activations
}

/// Check by a few runs from the prior whether regrowth by choice alone cannot reach all runs.
pub fn is_apart(task: &Task, seed: u64) -> bool {
    let (mut machine, mut first) = (task.machine(), None);
    for stream in 0..RUNS {
        let mut answers = Fresh::plain(StreamKey::new(seed, stream, 0), &*task.hosts);
        match task.begin(&mut machine, &mut answers) {
            // An impossible run has ended early.
            Ok((_, Change::Impossible)) => {}
            Ok((trace, _)) => {
                let activations = outermost(&trace, &task.program);
                if first.get_or_insert_with(|| activations.clone()) != &activations {
                    return true;
                }
            }
            Err(met) if met.is_invalid() => {}
            // The search tells it.
            Err(_) => return false,
        }
    }
    false
}

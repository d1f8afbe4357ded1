//! The claim: whatever the kernel, the four strategies make the same chain to the bit, a rollback leaves nothing, and
//! the sums are those of a run from the start; on programs that make, take away and re-enter calls in every way.

mod board;
mod calibration;
mod mixed;
mod programs;

use niwaki_infer::chain::Settings;
use niwaki_infer::chain::accept::Rules;
use niwaki_infer::chain::agreement::{Seen, compare, disagreement};
use niwaki_infer::chain::kernel::{Kernel, Selection};
use niwaki_vm::code::Program;
use niwaki_vm::machine::kept::Trace;
use programs::{PROGRAMS, task};

/// One of every kind, and all of them together.
pub fn kernels() -> Vec<(&'static str, Kernel)> {
    let drift = || Kernel::Drift { step: 0.7, target: 0.44 };
    let neighbour = || Kernel::Neighbour { reach: 2 };
    let block = || Kernel::Block { step: 0.3, share: 0.4, target: 0.23 };
    let regenerate = |levels| Kernel::Regenerate { levels };
    let deep = Selection { depth: vec![1.0, 3.0, 0.5], ..Selection::default() };
    let all = Kernel::Cycle(vec![
        Kernel::Prior,
        Kernel::Repeat(2, Box::new(drift())),
        Kernel::Mixture(vec![(1.0, neighbour()), (2.0, block())]),
        regenerate(0),
        Kernel::On(deep.clone(), Box::new(Kernel::Prior)),
    ]);
    vec![
        ("prior", Kernel::Prior),
        ("drift", drift()),
        ("neighbour", neighbour()),
        ("block", block()),
        ("regenerate 0", regenerate(0)),
        ("regenerate 2", regenerate(2)),
        ("odds by depth", Kernel::On(deep, Box::new(Kernel::Cycle(vec![Kernel::Prior, regenerate(1)])))),
        ("annealed", Kernel::Anneal { hot: 4.0, cold: 0.5, steps: 200, kernel: Box::new(all.clone()) }),
        ("all", all),
    ]
}

#[test]
fn four_strategies_make_the_same_chain() {
    for (name, text) in PROGRAMS {
        let task = task(text);
        for (kind, kernel) in kernels() {
            let settings = Settings { seed: 5, kernel, warmup: 150, thin: 0, ..Settings::default() };
            let (found, seen) = compare(&task, &settings, 300, 30).expect("a chain");
            assert!(found.is_none(), "{name}, {kind}: {}", found.unwrap_or_default());
            assert!(seen.accepted > 0, "{name}, {kind}: nothing was accepted");
        }
    }
}

/// A rollback that leaves one register.
struct LeavesOneRegister;

impl Rules for LeavesOneRegister {
    fn undo(trace: &mut Trace, program: &Program) {
        trace.rollback_but_one_register(program);
    }
}

#[test]
fn a_rollback_that_leaves_one_register_is_found_out() {
    let mut found_out = 0;
    for (_, text) in PROGRAMS {
        let settings = Settings { seed: 5, thin: 0, ..Settings::default() };
        let mut seen = Seen::default();
        let found = disagreement::<LeavesOneRegister>(&task(text), &settings, 300, 30, &mut seen);
        found_out += usize::from(!matches!(found, Ok(None)));
    }
    // Where hardly anything is rejected, or the register is written again before it is read, nothing is to be seen.
    assert!(2 * found_out > PROGRAMS.len(), "in {found_out} of {} programs", PROGRAMS.len());
}

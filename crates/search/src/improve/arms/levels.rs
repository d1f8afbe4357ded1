//! Levels: a loop has an iteration more or less, a recursion a level more or less, or a discrete choice is turned, and what stands is
//! held. The edited run is improved by moves before it is compared with the run that it comes from.

use super::{Arm, Form, Sizes, Step, moves};
use niwaki_chain::kernel::Kernel;
use niwaki_math::{Family, Space};
use niwaki_run::Task;
use niwaki_vm::code::{Function, Mode, Place, Site, SiteKind, Source};
use niwaki_vm::fault::Fault;
use niwaki_vm::value::Value;

pub(super) const LEVELS: Arm = Arm {
    step: Step("levels"),
    suits: |_, task| may_have_levels(task),
    most_reals: usize::MAX,
    form: Form::Edits(kernel),
};

/// Linkages for each other move; a linkage makes as many proposals as the run has choices, and more.
const LINKED: f64 = 0.01;

/// The moves that improve an edited run.
fn kernel(sizes: &Sizes) -> Result<Kernel, Fault> {
    Ok(Kernel::Mixture(vec![(1.0, moves::kernel(sizes)?), (LINKED, Kernel::LINKAGE)]))
}

/// Whether a program has loops with choices or calls, or may have a choice of a whole number or a truth value.
fn may_have_levels(task: &Task) -> bool {
    let mut functions = task.program.functions.iter();
    functions.any(|function| {
        let is_discrete =
            |site: &Site| family(function, site).is_none_or(|family| is_discrete(family.space()));
        let mut samples = function.sites.iter().filter(|site| matches!(site.kind, SiteKind::Sample(_)));
        function.mode == Mode::Iteration || samples.any(is_discrete)
    })
}

fn is_discrete(space: Space) -> bool {
    matches!(space, Space::Booleans | Space::Categories | Space::Integers)
}

/// The family of the distribution of a choice, where the program alone tells it.
fn family(function: &Function, site: &Site) -> Option<Family> {
    match &site.kind {
        SiteKind::Sample(Source::Family(family)) => Some(*family),
        SiteKind::Sample(Source::Value) => {
            let from = function.operands[site.args.range()].first()?;
            match &function.constants.get(from.index()) {
                Some(Value::Dist(dist)) if from.place() == Place::Constant => Some(dist.family()),
                _ => None,
            }
        }
        _ => None,
    }
}

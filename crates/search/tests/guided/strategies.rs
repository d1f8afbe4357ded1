//! The four strategies make the same chain to the bit, with a guide that looks at the scene and one that only reads, alone, in
//! mixtures, and in regrowth.

use super::guides::{WILD, random};
use super::populations::by;
use super::programs::{PROGRAMS, page, task};
use niwaki_agreement::compare;
use niwaki_chain::Settings;
use niwaki_chain::kernel::Kernel;
use niwaki_run::Task;
use niwaki_run::select::Selection;
use serde_json::json;

#[expect(dead_code, reason = "its programs alone are used")]
#[path = "../../../vm/tests/kept/programs.rs"]
mod of_the_machine;

fn agree(name: &str, task: &Task) {
    let guided = || Kernel::guided(random(task, 1, WILD));
    let regrow =
        Kernel::leaf("regrow", json!({"particles": 4, "turn": 0.3, "pick": "size"})).expect("a kernel");
    let deep = Selection { depth: vec![1.0, 3.0, 0.5], ..Selection::default() };
    for (kind, kernel) in [
        ("guided", guided()),
        ("on", Kernel::On(deep, Box::new(guided()))),
        ("a mixture", Kernel::Mixture(vec![(2.0, guided()), (1.0, Kernel::PRIOR)])),
        ("regrow", Kernel::Cycle(vec![guided(), regrow.drawn_by(by(task, 2, WILD))])),
    ] {
        for powers in [vec![1.0], vec![1.0, 0.3]] {
            let settings = Settings {
                seed: 5,
                thin: 0,
                kernel: kernel.clone(),
                powers,
                every: 4,
                ..Settings::default()
            };
            let (difference, compared) = compare(task, &settings, 150, 30).expect("a chain");
            assert!(difference.is_none(), "{name}, {kind}: {}", difference.unwrap_or_default());
            assert!(compared.accepted > 0, "{name}, {kind}: nothing was accepted");
        }
    }
}

#[test]
fn four_strategies_make_the_same_guided_chain() {
    PROGRAMS.iter().for_each(|(name, text)| agree(name, &task(text)));
}

/// Programs that create, remove and re-enter calls in every combination.
#[test]
fn four_strategies_agree_on_the_programs_of_the_machine() {
    for (name, text) in of_the_machine::PROGRAMS {
        let guided = task(text);
        agree(name, &Task { sketches: vec![], ..guided.clone() });
        if text.contains("emit") {
            agree(name, &Task { sketches: vec![page(0.6)], ..guided });
        }
    }
}

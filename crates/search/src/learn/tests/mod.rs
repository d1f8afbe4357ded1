//! The rows of `lessons` for a choice of a trace equal, to the bit, the inputs of a guide when it drew that choice:
//! for particles that share their past, that became copies of others, and whose futures ran in any order. In a chain a guide
//! reads the same variables, lists of cells included.

mod climbing;
#[allow(dead_code, reason = "some judges are for populations alone")]
#[path = "../../../../particles/src/tests/judges.rs"]
mod judges;
mod taught;

use super::lessons::{Example, Making, follow, survey, train};
use niwaki_chain::kernel::Kernel;
use niwaki_chain::walk::state::State;
use niwaki_chain::walk::streams::Streams;
use niwaki_geom::{Aabb, Drawing, Page, match_drawing};
use niwaki_guide::{Net, NetForm};
use niwaki_math::{Dist, StreamKey};
use niwaki_propose::guide::bound::{BoundGuide, Sight};
use niwaki_propose::guide::{Guide, Network};
use niwaki_propose::particle::Particle;
use niwaki_propose::proposal::{ByProposal, Proposal};
use niwaki_run::Task;
use niwaki_run::chooser::{Chooser, Chosen, Context, Prior};
use niwaki_run::forward::forward;
use niwaki_run::fresh::Fresh;
use niwaki_run::record::Record;
use niwaki_run::replay::by_address;
use niwaki_vm::core::parse::parse;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::{Change, Propose, Proposed, Strategy};
use niwaki_vm::passes::{Scope, compile_with_scope};
use niwaki_vm::value::{Value, repr};
use serde_json::json;
use std::collections::HashMap;
use std::sync::Arc;

/// Limbs that look ahead, in futures, with a list in scope.
const LIMBS: &str = r#"(module
  (fn "limb" (params $x $y $d)
    (set $xs (list $d))
    (set $turn (sample (dist gaussian 0.0 0.8)))
    (do (look (tuple $x $y) (tuple $turn 1.0)))
    (set $xs (append $xs $turn))
    (set $w (sample (dist uniform 0.1 0.6)))
    (do (emit (stroke (tuple $x $y 0.0) (tuple (add $x $turn) (add $y 1.0) 0.0) $w)))
    (set $k (sample (dist gamma 2.0 0.4)))
    (if (lt $d 2) (then (do (future "limb" (add $x $turn) (add $y 1.0) (add $d 1)))
      (if (gt $k 0.8) (then (do (future "limb" $x $y (add $d 1))))))))
  (fn "m" (params) (do (future "limb" 0.0 -2.0 0)) (return 0)) (entry "m"))"#;

pub(crate) fn limbs() -> Task {
    let program = compile_with_scope(&parse(LIMBS).unwrap(), vec![], Scope::All).unwrap();
    let page = Page::new([-3.0, -3.0], [3.0, 3.0], [12, 12]).unwrap();
    let greys: Vec<u8> = (0..144).map(|pixel| if pixel / 3 % 2 == 0 { 0 } else { 255 }).collect();
    let sketch = match_drawing(Arc::new(Drawing::new(page, &greys).unwrap()), 0.3).unwrap();
    Task { sketches: vec![sketch], ..Task::new(Arc::new(program)) }
}

/// Runs of the prior, as examples.
fn examples(task: &Task) -> Vec<Example> {
    let run = |stream| Some(forward(task, 3, stream, true).ok()?.log.entries());
    let example = |stream| Some(Example { task: task.clone(), entries: run(stream)?, held_out: false });
    (0..20).filter_map(example).collect()
}

fn making() -> Making {
    serde_json::from_value(json!({
        "model": "m", "hidden": [8, 8], "components": 2, "share": 0.02, "looks": true, "reads": true, "steps": 30,
        "passes": 1.0, "rate": 0.03, "batch": 16, "averaging": 0.5, "seed": 0,
    }))
    .unwrap()
}

/// A guide before training: for any input it draws like the prior.
pub(crate) fn blank(task: &Task) -> Arc<BoundGuide> {
    let form = survey(&examples(task), &making()).unwrap();
    let heads = form.sites.iter().map(|site| site.head).collect();
    let net = Net::start(NetForm::new(form.window_values(), form.features(), heads), 1);
    Arc::new(BoundGuide::new(Arc::new(Guide { form, net: Network::Shared(net) }), task).unwrap())
}

/// A guide whose draws depend on what it sees, after a few steps of training.
pub(crate) fn trained(task: &Task) -> Arc<BoundGuide> {
    let taught = train(&examples(task), &making(), None, &mut |_| true, None).unwrap();
    Arc::new(BoundGuide::new(Arc::new(taught.guide), task).unwrap())
}

/// Window and features, as bits.
type Inputs = (Vec<u32>, Vec<(u32, u32)>);

fn inputs(sight: &Sight) -> Inputs {
    let (window, features) = sight.inputs();
    (window.iter().map(|x| x.to_bits()).collect(), features.iter().map(|(n, x)| (*n, x.to_bits())).collect())
}

/// The inputs at each draw, by address and value: several particles can draw the same whole number.
type Drawn = HashMap<(u128, String), Vec<Inputs>>;

/// Draws by a guide, and stores its inputs.
struct Noting<'a> {
    proposal: &'a Proposal,
    particle: StreamKey,
    sight: &'a mut Sight,
    drawn: &'a mut Drawn,
}

impl Chooser for Noting<'_> {
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let (stream, otherwise) = (self.particle, Prior(self.particle));
        let chooser =
            ByProposal { proposal: self.proposal, stream, sight: &mut *self.sight, fallback: otherwise };
        let chosen = { chooser }.choose(at, dist, seen)?;
        if let Some(chosen) = &chosen {
            let drawn = self.drawn.entry((seen.address, repr(&chosen.value)?)).or_default();
            drawn.push(inputs(self.sight));
        }
        Ok(chosen)
    }
}

#[test]
fn rows_equal_the_inputs_of_the_guide() {
    let task = limbs();
    let guide = blank(&task);
    let proposal = Kernel::guided(guide.clone()).proposal().unwrap();
    let mut machine = task.machine();
    let mut start = task.start(&machine, false).unwrap();
    start.note_parts();
    let mut record = Record::start(&task.sketches);
    record.sketches.expect_windows();
    let mut all: Vec<Particle> =
        (0..12).map(|lineage| Particle::start(start.clone(), record.fork(), lineage, 7)).collect();
    // All particles share a sight, as on one thread.
    let (mut drawn, mut sight, mut lineage) = (Drawn::new(), Sight::default(), 12);
    while all.iter().any(Particle::is_running) {
        for particle_to_run in &mut all {
            sight.forget();
            let particle = particle_to_run.stream;
            let chooser = Noting { proposal: &proposal, particle, sight: &mut sight, drawn: &mut drawn };
            particle_to_run.advance(&mut machine, &task, 7, chooser).unwrap();
        }
        // The worst become copies of the best.
        all.sort_by(|a, b| b.record.log_score().total_cmp(&a.record.log_score()));
        let (best, worst) = all.split_at_mut(8);
        for (to, from) in worst.iter_mut().zip(best) {
            to.copy_from(from, lineage, 7);
            lineage += 1;
        }
    }
    let mut compared = 0;
    for particle in &all {
        let example = Example { task: task.clone(), entries: particle.record.log.entries(), held_out: false };
        let mut sight = Sight::default();
        follow(&example, &mut |at, dist, seen, value: &Value| {
            guide.look(at, dist, seen, &mut sight, 0).expect("a site that it draws");
            let before = &drawn[&(seen.address, repr(value)?)];
            let now = inputs(&sight);
            assert!(before.contains(&now), "{}: {now:?}", at.path());
            assert!(now.0.iter().any(|x| f32::from_bits(*x) != 0.0) && now.1.len() > 4);
            compared += 1;
            Ok(())
        })
        .unwrap();
    }
    assert!(compared > 100, "{compared} choices only");
}

/// Proposes the old value, and stores the inputs of a guide.
struct Reading<'a> {
    guide: &'a BoundGuide,
    /// The last part on the call path.
    part: Option<Aabb>,
    read: HashMap<u128, Vec<(u32, u32)>>,
}

impl Propose<f64> for Reading<'_> {
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        dist: &Dist,
        old: &Value,
        _: f64,
    ) -> Result<Proposed<f64>, Fault> {
        let mut sight = Sight::default();
        let seen = Context { part: self.part, ..Context::of(at) };
        self.guide.look(at, dist, seen, &mut sight, 0).expect("a site that it draws");
        self.read.insert(at.address(), inputs(&sight).1);
        Ok(Proposed { value: old.clone(), forward: 0.0, backward: 0.0 })
    }
}

#[test]
fn a_chain_reads_what_a_particle_reads() {
    let task = limbs();
    let guide = blank(&task);
    let mut machine = task.machine();
    for stream in 0..10 {
        let entries = forward(&task, 5, stream, true).unwrap().log.entries();
        let (mut state, _) = State::start(&task, Streams::new(0, 0), 1, Some(&by_address(&entries))).unwrap();
        let mut reading = Reading { guide: &guide, part: None, read: HashMap::new() };
        for choice in state.trace.numbers() {
            let mut answers = Fresh::plain(StreamKey::new(0, 0, 0), &*task.hosts);
            let trace = &mut state.trace;
            reading.part = trace.part(&task.program, choice);
            let change = machine.propose(trace, choice, Strategy::C3, &mut reading, &mut answers).unwrap();
            assert_eq!(change, Change::Unchanged);
            trace.rollback(&task.program);
        }
        let example = Example { task: task.clone(), entries, held_out: false };
        let mut sight = Sight::default();
        follow(&example, &mut |at, dist, seen, _| {
            guide.look(at, dist, seen, &mut sight, 0).expect("a site that it draws");
            assert_eq!(inputs(&sight).1, reading.read[&seen.address], "{}", at.path());
            Ok(())
        })
        .unwrap();
    }
}

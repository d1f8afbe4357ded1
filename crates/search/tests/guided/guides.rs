//! Guides without training. Traces determine their inputs; their weights are random and large, so that
//! they are far from the prior and depend on all inputs.

use niwaki_guide::{Net, NetForm, write};
use niwaki_math::Stream;
use niwaki_propose::guide::Guide;
use niwaki_propose::guide::bound::BoundGuide;
use niwaki_run::Task;
use niwaki_run::forward::forward;
use niwaki_search::learn::lessons::{Example, Making, survey};
use serde_json::{Value, json};
use std::sync::Arc;

/// The share of the prior: large, so that no weight is so rare and so great that averages are not normal.
const SHARE: f64 = 0.25;
/// Deviations of the changes of weights: for single particles, which must meet every value often enough to be
/// counted, and for chains.
pub const MILD: f64 = 0.5;
pub const WILD: f64 = 1.0;

fn making() -> Making {
    let settings = json!({
        "model": "m", "hidden": [8, 8], "components": 2, "share": SHARE, "looks": true, "reads": true, "steps": 1,
        "passes": 1.0, "rate": 1e-3, "batch": 16, "averaging": 0.9, "seed": 0,
    });
    serde_json::from_value(settings).expect("settings")
}

/// The bytes of a guide with random weights; its inputs are not standardised.
fn shaken(mut bytes: Vec<u8>, seed: u64, spread: f64) -> Vec<u8> {
    let length = u64::from_le_bytes(bytes[..8].try_into().expect("eight")) as usize;
    let (head, data) = bytes.split_at_mut(8 + length);
    let header: Value = serde_json::from_slice(&head[8..]).expect("a header");
    let place =
        |name: &str, index: usize| header[name]["data_offsets"][index].as_u64().expect("a place") as usize;
    let mut stream = Stream::new(seed, 0, 0, 0);
    for weight in data[place("weights", 0)..place("weights", 1)].chunks_exact_mut(4) {
        let old = f32::from_le_bytes(weight.try_into().expect("four"));
        weight.copy_from_slice(&(old + (spread * stream.normal()) as f32).to_le_bytes());
    }
    for feature in data[place("features", 0)..place("features", 1)].chunks_exact_mut(8) {
        feature[..4].copy_from_slice(&0.0_f32.to_le_bytes());
        feature[4..].copy_from_slice(&1.0_f32.to_le_bytes());
    }
    bytes
}

/// A guide for a task, by number.
pub fn random(task: &Task, number: u64, spread: f64) -> Arc<BoundGuide> {
    let traces = (0..60).map(|stream| forward(task, 900, stream, false).expect("a run"));
    let possible = traces.filter(|run| run.cause.is_none() && run.has_ended);
    let examples: Vec<Example> = possible
        .map(|run| Example { task: task.clone(), entries: run.log.entries(), held_out: false })
        .collect();
    let form = survey(&examples, &making()).expect("a form");
    let heads = form.sites.iter().map(|site| site.head).collect();
    let net = NetForm { hidden: [8, 8], ..NetForm::new(form.window_values(), form.features(), heads) };
    let net: Net = Net::start(net, number);
    let bytes = write(&net, &serde_json::to_string(&form).expect("a form"));
    let guide = Guide::of_bytes(&shaken(bytes, number, spread)).expect("a guide");
    Arc::new(BoundGuide::new(Arc::new(guide), task).expect("a guide of this task"))
}

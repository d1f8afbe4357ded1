//! Programs run: forwards, as chains by all four strategies, as particles; under small limits, with machine code and without.

use crate::core_text::on_stack_for;
use niwaki_agreement::compare;
use niwaki_chain::Settings;
use niwaki_chain::kernel::Kernel;
use niwaki_geom::{Aabb, Rule, no_overshoot, no_self_intersection, vec3};
use niwaki_particles::{Moment, Rejuvenation, smc};
use niwaki_run::Task;
use niwaki_run::forward::forward;
use niwaki_run::order::Order;
use niwaki_vm::core::parse::parse;
use niwaki_vm::machine::Limits;
use niwaki_vm::passes::compile;
use niwaki_vm::value::Value;
use serde_json::json;
use std::sync::Arc;

/// Bytes before the text: how it is run.
pub const HEAD: usize = 4;
/// Proposals of a chain.
const PROPOSALS: u64 = 12;
/// What a run may use.
const LIMITS: Limits = Limits { steps: 3000, bytes: 16 << 20 };

/// Runs a program whose text follows [`HEAD`] bytes of settings.
///
/// # Panics
/// When two strategies disagree, or a seed gives two results, be it by machine code.
pub fn check(bytes: &[u8]) {
    let Some((head, text)) = bytes.split_at_checked(HEAD) else { return };
    let Ok(text) = std::str::from_utf8(text) else { return };
    on_stack_for(text, || {
        if let Some([plain, compiled]) = tasks(text, head[0]) {
            run(&plain, &compiled, head);
        }
    });
}

/// The task of a text, where that is a program, without machine code and with it from the first visit; its parameters are whole
/// numbers.
fn tasks(text: &str, flags: u8) -> Option<[Task; 2]> {
    let module = parse(text).ok()?;
    let entry = module.functions.iter().find(|function| function.name == module.entry)?;
    let args: Vec<Value> = (0..entry.params.len()).map(|k| Value::Int(2 + k as i64)).collect();
    let program = compile::<f64>(&module, vec![]).ok()?;
    let mut sketches = vec![];
    if flags & 1 == 1 {
        let domain = Aabb { low: vec3(-1.0, -1.0, -1.0), high: vec3(1.0, 1.0, 1.0) };
        sketches.push(no_overshoot(domain, 2.0).expect("a sketch"));
    }
    if flags & 2 == 2 {
        sketches.push(no_self_intersection(Rule::Solid));
    }
    Some([0, 1].map(|visits| Task {
        args: args.clone(),
        sketches: sketches.clone(),
        limits: LIMITS,
        ..Task::new(Arc::new(program.clone().with_machine_code_after(visits)))
    }))
}

/// Runs a task without machine code and the same one with it, which says what a run finds twice.
///
/// # Panics
/// As [`check`].
pub fn run(plain: &Task, compiled: &Task, head: &[u8]) {
    let seed = u64::from(head[1]);
    let once = |task| {
        format!("{:?}", forward(task, seed, 0, head[0] & 4 == 4).map_err(|failure| failure.to_string()))
    };
    assert_eq!(once(plain), once(compiled), "a forward run");
    let kernel = kernel(head[2]);
    let settings = Settings {
        seed,
        kernel: kernel.clone(),
        warmup: 4,
        tries: 4,
        thin: 0,
        powers: if head[0] & 8 == 8 { vec![1.0, 0.3] } else { vec![1.0] },
        every: 4,
        ..Settings::default()
    };
    let either = if head[3] & 8 == 8 { plain } else { compiled };
    if let Ok((Some(difference), _)) = compare(either, &settings, PROPOSALS, 4) {
        panic!("{difference}");
    }
    let moves =
        || Rejuvenation { kernel: kernel.clone(), moves: 1, at: Moment::Resampled, final_chains: None };
    let order = if head[3] & 1 == 1 { Order::DepthFirst } else { Order::Stochastic };
    let settings = niwaki_particles::Settings {
        // As many as run in lanes, or fewer.
        particles: if head[3] & 4 == 4 { 20 } else { 4 },
        order,
        rejuvenate: (head[3] & 2 == 2).then(moves),
        seed,
        ..niwaki_particles::Settings::default()
    };
    let found = |task| match smc(task, &settings, &mut |_| true) {
        Err(failure) => failure.to_string(),
        Ok(found) => {
            let all = found
                .particles
                .iter()
                .map(|p| format!("{:?} {:?} {:?} {:?}", p.value, p.log_prior, p.log_score, p.log_weight));
            format!("{:?} {:?}", all.collect::<Vec<_>>(), found.log_normaliser)
        }
    };
    assert_eq!(found(plain), found(compiled), "particles");
}

/// One kernel of each kind, and all together.
fn kernel(number: u8) -> Kernel {
    let leaf = |name: &str, settings| Kernel::leaf(name, settings).expect("a kernel");
    let drift = || leaf("drift", json!({"step": 0.7, "target": 0.44}));
    let neighbour = || leaf("neighbour", json!({"reach": 2}));
    let block = || leaf("block", json!({"step": 0.3, "share": 0.4, "target": 0.23}));
    let regenerate = || leaf("regenerate", json!({"levels": number >> 3 & 1}));
    match number % 7 {
        0 => Kernel::PRIOR,
        1 => drift(),
        2 => neighbour(),
        3 => block(),
        4 => regenerate(),
        5 => leaf("regrow", json!({"particles": 3, "turn": 0.5, "pick": "size"})),
        _ => Kernel::Cycle(vec![Kernel::PRIOR, drift(), block(), neighbour(), regenerate()]),
    }
}

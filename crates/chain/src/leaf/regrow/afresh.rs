//! Fresh regrowth: a part of a run is grown again, and everything outside of the part is held.
//!
//! Particles grow the part from its inputs, in a scene that has everything else. Their weights are those of regrowth, but
//! no particle holds the present values. With their weights they follow the conditional law of the part.

use super::{Block, Contents, Regrow, Weighing, pick, refuse_memoised};
use crate::walk::Walk;
use crate::walk::state::State;
use crate::walk::streams::Streams;
use niwaki_math::RngCore;
use niwaki_run::run::Run;
use niwaki_run::select::Selection;
use niwaki_run::setting::COUNT;
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::refusal::Expected;
use niwaki_vm::value::Value;
use rayon::prelude::*;
use std::collections::HashMap;

/// The settings of a fresh regrowth.
#[derive(Clone, Copy, Debug)]
pub struct Afresh<'a> {
    /// A pattern that matches only the part.
    pub part: &'a str,
    /// The number of particles.
    pub particles: usize,
    /// The power of the score.
    pub power: f64,
    /// The seed of all random numbers.
    pub seed: u64,
}

/// Grow a part again. Returns a run for each possible particle, with its weight; outside of the part each run has these values.
///
/// # Errors
/// A pattern that matches no part or several, no particles, values of an impossible run, particles that are all impossible, a fault of the
/// program.
pub fn afresh(task: &Task, known: &HashMap<u128, Value>, with: &Afresh<'_>) -> Result<Vec<Run>, Failure> {
    if with.particles == 0 {
        return Err(Fault::refused("particles", "0".into(), Expected::Range(COUNT)).into());
    }
    let (program, streams) = (&*task.program, Streams::new(with.seed, 0));
    refuse_memoised(program)?;
    let (state, spreads) = State::start(task, streams, 1, Some(known))?;
    let outside = |part: &HashMap<u128, Value>| -> HashMap<u128, Value> {
        state.choices(program).filter(|(address, _)| !part.contains_key(address)).collect()
    };
    let picked = pick::only(with.part, &state.trace, program)?;
    let contents = Contents::of(&state, program, picked.part, &|_| true);
    let (Contents { held, rest, numbers }, sketches) = contents.ok_or_else(Failure::no_start)?;
    let (outside, start) = (outside(&held), state.trace.start_part(program, picked.part, false));
    let (selection, path) = (Selection::default(), state.trace.part_path(picked.part));
    let kernel = Regrow {
        particles: with.particles,
        turn: 0.0,
        pick: pick::Pick::default(),
        best: false,
        proposal: None,
        selection: Selection::default(),
    };
    let block = |particles| Block {
        task,
        start: start.clone(),
        path,
        sketches: sketches.fork(),
        held: &held,
        rest: &rest,
        selection: &selection,
        proposal: None,
        beta: with.power,
        particles,
    };
    let mut chain: Walk = Walk::start(program, streams, state, &spreads);
    let mut machine = task.machine();
    let moves = streams.moves(0);
    // The present part, which scores what the others are compared with.
    let present = block(1).conditional(&mut machine, None, moves.at(0).next_u64())?;
    let block = block(with.particles);
    let mut set = block.free(&mut machine, None, moves.at(1).next_u64())?;
    let weighing =
        Weighing { task, kernel: &kernel, picked: &picked, block: &block, numbers: &numbers, emits: None };
    let before = (&present.grown[0], present.grown[0].result());
    chain.weigh_last(&mut machine, &weighing, &mut set, Some(before))?;
    if set.log_mean == f64::NEG_INFINITY {
        let causes = set.grown.iter().map(|member| member.particle.record.cause.as_deref());
        let named = causes.map(|cause| (cause.unwrap_or("a change outside of the part"), 1));
        return Err(Failure::impossible(0, named));
    }
    let weighed = set.grown.iter().zip(&set.weights.relative).filter(|(_, weight)| **weight > 0.0);
    let parts: Vec<_> = weighed.map(|(member, weight)| (member.values(&block), weight.ln())).collect();
    let whole = |(part, log_weight): (HashMap<u128, Value>, f64)| {
        let known = outside.iter().map(|(address, value)| (*address, value.clone())).chain(part).collect();
        let (state, _) = State::start(task, streams, 1, Some(&known))?;
        Ok(Run { log_weight, ..state.run(program, 0) })
    };
    parts.into_par_iter().map(whole).collect()
}

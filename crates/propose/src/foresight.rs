//! Guides as forecasts of the further score of a paused run, from the next choices of the run ([`ahead`](crate::guide::ahead)).

use crate::guide::Network;
use crate::guide::ahead::{BESIDE, inputs, root};
use crate::guide::bound::{BoundGuide, Sight};
use crate::look_ahead::{Forecast, Paused};
use niwaki_geom::Shape;
use niwaki_guide::Net;
use niwaki_math::Dist;
use niwaki_run::chooser::Context;
use niwaki_run::task::Hosts;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::{Machine, Stop};
use niwaki_vm::value::Value;
use std::sync::Arc;

/// The most futures that are examined; further futures count as futures without a guided choice.
const MOST: usize = 16;
impl BoundGuide {
    /// Whether the guide has learned to look ahead.
    pub fn looks_ahead(&self) -> bool {
        self.guide().form.ahead.is_some()
    }

    /// The inputs of the forecast for a paused run, in `sight`. `owner` is the number of the guide among the drawers.
    pub fn prospect<'s>(
        &self,
        run: Paused<'_>,
        machine: &mut Machine<'_>,
        sight: &'s mut Sight,
        owner: usize,
    ) -> &'s [f64] {
        let Network::Shared(net) = &self.guide().net else { return &[] };
        let units = net.form().hidden[1];
        let mut state = match sight.copy.take() {
            Some(mut state) => {
                state.clone_from(run.state);
                state
            }
            None => run.state.clone(),
        };
        let mut sums = std::mem::take(&mut sight.prospect);
        sums.clear();
        sums.resize(inputs(units), 0.0);
        sight.forget();
        let (mut choices, mut unguided) = (0.0, 0.0);
        let mut usable = true;
        for (number, future) in run.state.runnable().iter().enumerate() {
            if number >= MOST || !usable {
                unguided += 1.0;
                continue;
            }
            let hidden = &mut sums[BESIDE..BESIDE + units];
            let mut look = Looking { guide: self, net, run, sight, owner, hidden, is_guided: false };
            match machine.resume(&mut state, future, &mut look) {
                Ok(Stop::Paused) if look.is_guided => choices += 1.0,
                // The future has no further choice, or its next choice waits for another future.
                Ok(Stop::Returned | Stop::Waiting) => {}
                Ok(_) => unguided += 1.0,
                // The run itself meets the fault, unless another choice avoids it.
                Err(_) => (unguided, usable) = (unguided + 1.0, false),
            }
        }
        let g = root(run.record.log_score());
        sums[..BESIDE].copy_from_slice(&[choices, unguided, g, g * g, g * choices, g * unguided]);
        let (before, after) = sums.split_at_mut(BESIDE + units);
        for (to, h) in after.iter_mut().zip(&before[BESIDE..]) {
            *to = g * h;
        }
        sight.copy = Some(state);
        sight.prospect = sums;
        &sight.prospect
    }
}

/// A guide that looks ahead, as a forecast.
#[derive(Clone, Debug)]
pub struct Foresight {
    /// The guide.
    pub guide: Arc<BoundGuide>,
    /// The number of the guide among the drawers of its proposal, which share a sight.
    pub owner: usize,
}

impl Forecast for Foresight {
    fn rise(&self, run: Paused<'_>, machine: &mut Machine<'_>, sight: &mut Sight) -> f64 {
        let log_score = run.record.log_score();
        match &self.guide.guide().form.ahead {
            Some(line) if line.looks() => {
                line.rise(self.guide.prospect(run, machine, sight, self.owner), log_score)
            }
            Some(line) => {
                let g = root(log_score);
                line.rise(&[0.0, 0.0, g, g * g], log_score)
            }
            None => 0.0,
        }
    }
}

/// Answers that run up to the next choice and let the guide look at it.
struct Looking<'a, 's> {
    guide: &'a BoundGuide,
    net: &'a Net,
    run: Paused<'a>,
    sight: &'s mut Sight,
    owner: usize,
    /// Sums of hidden layers.
    hidden: &'s mut [f64],
    /// Whether the run met a choice that the guide draws.
    is_guided: bool,
}

impl Answers<f64> for Looking<'_, '_> {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        let record = self.run.record;
        let sketches = Some(&record.sketches).filter(|sketches| !sketches.is_empty());
        let seen = Context { address: at.address(), sketches, primitives: record.primitives, part: None };
        if let Some(site) = self.guide.look(at, dist, seen, self.sight, self.owner) {
            self.sight.hidden(self.net, site, self.hidden);
            self.is_guided = true;
        }
        Ok(Answer::Pause)
    }

    fn score(&mut self, _: &At<'_, f64>, _: Factor, _: f64) -> Result<Answer<()>, Fault> {
        Ok(Answer::Pause)
    }

    fn emit(&mut self, _: &At<'_, f64>, _: &[Shape]) -> Result<Answer<()>, Fault> {
        Ok(Answer::Pause)
    }

    fn host(&mut self, constant: u16, args: &[Value], steps: &mut u64) -> Result<Value, Fault> {
        let hosts: &dyn Hosts = &*self.run.task.hosts;
        hosts.call(constant, args, steps)
    }
}

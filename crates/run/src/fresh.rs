//! New choices of a kept run: known values where they exist, else draws from the prior.

use crate::chooser::{Chooser, Known, Prior};
use crate::task::Hosts;
use niwaki_math::{Dist, Interval, Space, StreamKey, Support};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At};
use niwaki_vm::value::Value;
use std::collections::HashMap;

/// Answers for the new choices of a kept run: known values where they exist, else draws from the prior.
pub struct Fresh<'a> {
    /// The chooser of the new values.
    pub chooser: Known<'a, Prior>,
    /// Host functions.
    pub hosts: &'a dyn Hosts,
    /// The spread of each site's distribution by the key of the site; `None` where spreads are not recorded.
    pub spreads: Option<&'a mut HashMap<u128, f64>>,
}

impl<'a> Fresh<'a> {
    /// Draw all new choices from this stream.
    pub fn plain(key: StreamKey, hosts: &'a dyn Hosts) -> Fresh<'a> {
        Fresh::of(key, None, hosts)
    }

    /// Draw new choices from this stream, except those with known values.
    pub fn of(key: StreamKey, known: Option<&'a HashMap<u128, Value>>, hosts: &'a dyn Hosts) -> Fresh<'a> {
        Fresh { chooser: Known { values: known, fallback: Prior(key) }, hosts, spreads: None }
    }
}

// A kept run holds its own scores, scene and queries.
impl Answers<f64> for Fresh<'_> {
    #[inline]
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        if let Some(spreads) = &mut self.spreads {
            spreads.entry(at.site.key).or_insert_with(|| plain_spread(dist));
        }
        Ok(self.chooser.draw(at, dist)?.map_or(Answer::Pause, Answer::Go))
    }

    fn host(&mut self, constant: u16, args: &[Value], steps: &mut u64) -> Result<Value, Fault> {
        self.hosts.call(constant, args, steps)
    }
}

/// The approximate spread of a distribution, in the coordinate in which its values drift.
pub fn spread(dist: &Dist) -> f64 {
    let scale = if dist.family().space() == Space::Components { None } else { dist.scale() };
    scale.unwrap_or(1.0)
}

/// The spread in the coordinate of the value itself, for steps that may leave the support.
pub(crate) fn plain_spread(dist: &Dist) -> f64 {
    match (dist.family().space(), dist.support()) {
        (Space::Bounded, Support::Reals(Interval { lo: Some(lo), hi: Some(hi) })) => (hi - lo) * 0.3,
        _ => spread(dist),
    }
}

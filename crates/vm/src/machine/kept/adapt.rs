//! Call sites where reuse does not pay: when a call is reached often and never skipped, its arguments are no
//! longer compared.
//!
//! Source: dissertation 3.3.4. After some proposals, a site is switched off when it has been reached `reached`
//! times without one call being skipped on entry or unchanged on return. This changes time only. Here a
//! proposal counts once, however often it reaches the site.

use super::super::state::{NodeId, State};
use super::slot::Slot;
use super::trace::{Kept, Trace};
use crate::code::{FunctionId, Mode, Program, SiteKind};
use niwaki_math::Scalar;

/// The setting that decides when a call site is switched off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Adaptation {
    /// The number of proposals before any site is switched off.
    pub proposals: u32,
    /// The number of consecutive proposals that reach a site without a benefit.
    pub reached: u32,
}

impl Default for Adaptation {
    /// The dissertation's setting.
    fn default() -> Self {
        Adaptation { proposals: 10, reached: 50 }
    }
}

/// The benefits of each call site so far.
#[derive(Debug)]
pub(crate) struct Sites {
    /// The setting; `None` if all sites stay on.
    adaptation: Option<Adaptation>,
    /// The number of each function's first site.
    first: Vec<u32>,
    /// The number of consecutive proposals that reached a site without a benefit, and the last of them; `OFF`
    /// for a site that is switched off.
    reached: Vec<(u32, u32)>,
}

const OFF: u32 = u32::MAX;

impl Sites {
    pub fn new<S: Scalar>(program: &Program<S>, adaptation: Option<Adaptation>) -> Self {
        let mut count = 0;
        let first = program.functions.iter().map(|f| {
            count += f.sites.len() as u32;
            count - f.sites.len() as u32
        });
        let first = first.collect();
        Sites { adaptation, first, reached: vec![(0, 0); count as usize] }
    }

    #[inline]
    fn at(&self, function: FunctionId, site: u32) -> usize {
        self.first[function.0 as usize] as usize + site as usize
    }

    /// Whether the arguments of calls at a site are compared.
    #[inline]
    pub fn is_on(&self, function: FunctionId, site: u32) -> bool {
        self.reached[self.at(function, site)].0 != OFF
    }

    /// Records that a call at a site was skipped, or left nothing changed.
    #[inline]
    pub fn paid(&mut self, function: FunctionId, site: u32) {
        let at = self.at(function, site);
        if self.reached[at].0 != OFF {
            self.reached[at].0 = 0;
        }
    }

    /// Records that a call at a site had to be entered in a proposal.
    #[inline]
    pub fn missed(&mut self, function: FunctionId, site: u32, proposal: u32) {
        let Some(adaptation) = self.adaptation else { return };
        let at = self.at(function, site);
        let (reached, last) = &mut self.reached[at];
        // A proposal that changes an input of all calls reaches a site many times, and counts once.
        if *last == proposal {
            return;
        }
        *last = proposal;
        if *reached < adaptation.reached {
            *reached += 1;
        } else if proposal > adaptation.proposals {
            *reached = OFF;
        }
    }
}

impl<S: Scalar> Trace<S> {
    /// Switches off call sites where reuse does not pay, or (`None`) switches all sites on.
    pub fn adapt(&mut self, program: &Program<S>, adaptation: Option<Adaptation>) {
        self.kept.sites = Sites::new(program, adaptation);
    }

    /// The number of kept calls, and the number of those at sites whose arguments are compared.
    pub fn cached_calls(&self, program: &Program<S>) -> (usize, usize) {
        let (mut calls, mut cached) = (0, 0);
        let mut work = vec![NodeId(0)];
        while let Some(id) = work.pop() {
            let n = &self.state.nodes[id.0 as usize];
            let f = program.function(n.function);
            if f.mode == Mode::Loop {
                work.extend(&self.kept.loops[n.slots as usize]);
                continue;
            }
            for (i, site) in f.sites.iter().enumerate() {
                let held = self.kept.slots[n.slots as usize + i].held;
                if held == Slot::NOTHING {
                    continue;
                }
                if site.kind.makes_activation() {
                    if !matches!(site.kind, SiteKind::Loop(_)) {
                        calls += 1;
                        cached += usize::from(self.kept.sites.is_on(n.function, i as u32));
                    }
                    if self.kept.shared(&self.state, self.kept.slots[n.slots as usize + i]).is_none() {
                        work.push(NodeId(held));
                    }
                }
            }
        }
        (calls, cached)
    }
}

impl<S: Scalar> Kept<S> {
    /// The call site of an activation: the calling function, and the number of the site.
    #[inline]
    pub(super) fn caller(state: &State<S>, node: NodeId) -> (FunctionId, u32) {
        let n = &state.nodes[node.0 as usize];
        (state.nodes[n.parent.0 as usize].function, n.site)
    }
}

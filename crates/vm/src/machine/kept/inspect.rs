//! What a trace holds, in program order: choices, primitives, queries, with readable paths.

use super::super::address::join;
use super::super::state::NodeId;
use super::{Kept, Trace};
use crate::code::{Function, Mode, Program, Site, SiteKind};
use crate::value::Value;
use niwaki_geom::Primitive;
use niwaki_math::Scalar;

/// One thing that a trace holds.
pub enum Item<'a, S: Scalar> {
    /// A choice: its value and log density, nats.
    Choice(&'a Value<S>, f64),
    /// A factor or an observation, nats.
    Factor(f64),
    /// A primitive of the scene.
    Emit(&'a Primitive),
    /// What a query wrote: key and value.
    Query(&'a Value<S>, &'a Value<S>),
}

/// Where it stands.
pub struct Place<'a, S: Scalar> {
    /// The site.
    pub site: &'a Site,
    /// The function it stands in.
    pub function: &'a Function<S>,
    node: NodeId,
    trace: &'a Trace<S>,
    program: &'a Program<S>,
}

impl<S: Scalar> Place<'_, S> {
    /// The address: a hash of the path of sites.
    pub fn address(&self) -> u128 {
        join(self.trace.state.nodes[self.node.0 as usize].path, self.site.key)
    }

    /// The readable address.
    pub fn path(&self) -> String {
        let mut path = self.trace.state.path(self.program, self.node);
        if !path.is_empty() {
            path.push('/');
        }
        path + &self.site.label
    }
}

impl<S: Scalar> Trace<S> {
    /// Visits everything that the trace holds, in program order.
    pub fn visit(&self, program: &Program<S>, mut each: impl FnMut(Place<'_, S>, Item<'_, S>)) {
        // What is still to be visited, the next last: a node from one of its sites on, or a whole activation.
        let mut work = vec![(NodeId(0), 0usize)];
        while let Some((node, from)) = work.pop() {
            let n = &self.state.nodes[node.0 as usize];
            let f = program.function(n.function);
            if f.mode == Mode::Loop {
                let children = &self.kept.loops[n.slots as usize];
                work.extend(children.iter().rev().map(|child| (*child, 0)));
                continue;
            }
            for (i, site) in f.sites.iter().enumerate().skip(from) {
                let slot = self.kept.slots[n.slots as usize + i];
                if !slot.is_filled() {
                    continue;
                }
                let place = Place { site, function: f, node, trace: self, program };
                let own = n.registers as usize;
                let value = |o: crate::code::Operand| match o.place() {
                    crate::code::Place::Node => &self.state.registers[own + o.index()],
                    crate::code::Place::Outer => {
                        let outer = self.state.nodes[n.parent.0 as usize].registers as usize;
                        &self.state.registers[outer + o.index()]
                    }
                    _ => &f.constants[o.index()],
                };
                match &site.kind {
                    SiteKind::Call { .. }
                    | SiteKind::Apply
                    | SiteKind::Future { .. }
                    | SiteKind::FutureApply { .. }
                    | SiteKind::Loop(_) => {
                        work.push((node, i + 1));
                        work.push((NodeId(slot.held), 0));
                        break;
                    }
                    SiteKind::Sample { .. } | SiteKind::SampleDist | SiteKind::SampleIndexed => {
                        each(place, Item::Choice(value(site.to), slot.log));
                    }
                    SiteKind::Observe { .. }
                    | SiteKind::ObserveDist
                    | SiteKind::ObserveIndexed
                    | SiteKind::Factor
                    | SiteKind::Condition => each(place, Item::Factor(slot.log)),
                    SiteKind::Emit => {
                        if let Some(primitive) = &self.kept.emits[slot.held as usize] {
                            each(place, Item::Emit(primitive));
                        }
                    }
                    SiteKind::Query => {
                        let [key, written] = f.operands[site.args.range()] else { continue };
                        each(
                            place,
                            Item::Query(value(key), &self.kept.resolved(&self.state, value(written))),
                        );
                    }
                    SiteKind::Force | SiteKind::Cell { .. } | SiteKind::Read => {}
                }
            }
        }
    }

    /// The address of a choice.
    pub fn address(&self, program: &Program<S>, choice: usize) -> u128 {
        let at = self.kept.choices[choice];
        let n = &self.state.nodes[at.node.0 as usize];
        join(n.path, program.function(n.function).sites[at.site as usize].key)
    }

    /// The readable address of a choice.
    pub fn path(&self, program: &Program<S>, choice: usize) -> String {
        let at = self.kept.choices[choice];
        let function = program.function(self.state.nodes[at.node.0 as usize].function);
        let site = &function.sites[at.site as usize];
        Place { site, function, node: at.node, trace: self, program }.path()
    }

    /// The function and the site of a choice: what all choices made at one place of the text have in common.
    pub fn site_of(&self, choice: usize) -> (crate::code::FunctionId, u16) {
        let at = self.kept.choices[choice];
        (self.state.nodes[at.node.0 as usize].function, at.site)
    }

    /// The value of a choice and its log density, nats.
    pub fn choice(&self, program: &Program<S>, choice: usize) -> (&Value<S>, f64) {
        let at = self.kept.choices[choice];
        let n = &self.state.nodes[at.node.0 as usize];
        let site = &program.function(n.function).sites[at.site as usize];
        let slot = self.kept.slots[Kept::slot_at(&self.state, at.node, at.site as usize)];
        (&self.state.registers[n.registers as usize + site.to.index()], slot.log)
    }

    /// How many calls stand above a choice (iterations of loops are none).
    pub fn depth(&self, program: &Program<S>, choice: usize) -> usize {
        let mut at = self.kept.choices[choice].node;
        let mut depth = 0;
        while at != NodeId::NONE {
            let n = &self.state.nodes[at.0 as usize];
            depth += usize::from(program.function(n.function).mode == Mode::Node);
            at = n.parent;
        }
        depth - 1
    }

    /// The choices of the trace by number, in the order of the table; it changes when choices are born or die.
    pub fn numbers(&self) -> std::ops::Range<usize> {
        0..self.kept.choices.len()
    }
}

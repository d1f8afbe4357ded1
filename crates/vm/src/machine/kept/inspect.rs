//! The contents of a trace, in program order: choices, primitives and queries, with readable paths.

use super::super::address::join;
use super::super::state::NodeId;
use super::trace::{Kept, Trace};
use crate::code::{Function, Mode, Program, Site, SiteKind};
use crate::value::Value;
use niwaki_geom::{Aabb, Primitive};
use niwaki_math::Scalar;
use std::collections::HashSet;

/// An item of a trace.
pub enum Item<'a, S: Scalar> {
    /// A choice: its value and log density in nats.
    Choice(&'a Value<S>, f64),
    /// A held choice: its value and log density in nats.
    Held(&'a Value<S>, f64),
    /// A factor or an observation, in nats.
    Factor(f64),
    /// A primitive of the scene.
    Emit(&'a Primitive),
    /// The key and the value of a query.
    Query(&'a Value<S>, &'a Value<S>),
}

/// The place of an item in the program.
pub struct Place<'a, S: Scalar> {
    /// The site.
    pub site: &'a Site,
    /// The function that contains the site.
    pub function: &'a Function<S>,
    pub(super) node: NodeId,
    pub(super) trace: &'a Trace<S>,
    pub(super) program: &'a Program<S>,
}

impl<S: Scalar> Place<'_, S> {
    /// The number of calls above the item (iterations of loops do not count).
    pub fn depth(&self) -> usize {
        self.trace.depth_of(self.program, self.node)
    }

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

/// A named activation of a trace.
#[derive(Clone, Debug, PartialEq)]
pub struct Activation {
    /// The hash of its path, which is the same in every run.
    pub key: u128,
    /// The key of its caller; for an iteration of a loop, the activation with the loop.
    pub parent: u128,
    /// Its name: the component of an address, or the function's name for the root.
    pub label: String,
    /// The function.
    pub function: String,
    /// The number of calls and iterations above it.
    pub depth: usize,
}

impl<S: Scalar> Trace<S> {
    /// The activations in program order, callers first. A loop is not an activation, but its iterations are. A
    /// memoised call is listed at its first caller.
    pub fn outline(&self, program: &Program<S>) -> Vec<Activation> {
        let mut activations = Vec::new();
        let mut work = vec![(NodeId(0), 0, 0usize)];
        let mut seen = HashSet::new();
        while let Some((node, parent, depth)) = work.pop() {
            let n = &self.state.nodes[node.0 as usize];
            let f = program.function(n.function);
            if n.memo().is_some_and(|number| !seen.insert(number)) {
                continue;
            }
            if f.mode == Mode::Loop {
                let children = &self.kept.loops[n.slots as usize];
                work.extend(children.iter().rev().map(|child| (*child, parent, depth)));
                continue;
            }
            let path = self.state.path(program, node);
            let label =
                if depth == 0 { f.name.to_string() } else { path.rsplit('/').next().unwrap_or("").into() };
            activations.push(Activation { key: n.path, parent, label, function: f.name.to_string(), depth });
            for (i, site) in f.sites.iter().enumerate().rev() {
                let slot = self.kept.slots[n.slots as usize + i];
                if site.kind.makes_activation() && slot.is_filled() {
                    work.push((NodeId(slot.held), n.path, depth + 1));
                }
            }
        }
        activations
    }

    /// Whether an activation was called, directly or indirectly, from another.
    pub fn is_below(&self, node: NodeId, above: NodeId) -> bool {
        let mut at = node;
        while at != NodeId::NONE && at != above {
            at = self.state.above(at);
        }
        at == above && node != above
    }

    /// The hash of an activation's path; `None` for a loop's own node.
    pub fn key_of(&self, program: &Program<S>, node: NodeId) -> Option<u128> {
        let n = &self.state.nodes[node.0 as usize];
        (program.function(n.function).mode != Mode::Loop).then_some(n.path)
    }

    /// Visits all items of the trace, in program order; a memoised call at its first caller.
    pub fn visit(&self, program: &Program<S>, mut each: impl FnMut(Place<'_, S>, Item<'_, S>)) {
        // The rest of the visit, with the next entry last: a node from one of its sites on, or a whole
        // activation.
        let mut work = vec![(NodeId(0), 0usize)];
        let mut seen = HashSet::new();
        while let Some((node, from)) = work.pop() {
            let n = &self.state.nodes[node.0 as usize];
            let f = program.function(n.function);
            let memo = n.memo().filter(|_| from == 0);
            if memo.is_some_and(|number| !seen.insert(number)) {
                continue;
            }
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
                let base = n.registers as usize;
                let value = |o: crate::code::Operand| match o.place() {
                    crate::code::Place::Node => &self.state.registers[base + o.index()],
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
                    SiteKind::Sample(_) if slot.is_held() => {
                        each(place, Item::Held(value(site.to), slot.log));
                    }
                    SiteKind::Sample(_) => {
                        each(place, Item::Choice(value(site.to), slot.log));
                    }
                    SiteKind::Observe(_) | SiteKind::Factor | SiteKind::Condition => {
                        each(place, Item::Factor(slot.log))
                    }
                    SiteKind::Emit => {
                        if let Some(primitive) = &self.kept.emits[slot.held as usize] {
                            each(place, Item::Emit(primitive));
                        }
                    }
                    SiteKind::Query => {
                        let [key, value_operand] = f.operands[site.args.range()] else { continue };
                        each(
                            place,
                            Item::Query(value(key), &self.kept.resolved(&self.state, value(value_operand))),
                        );
                    }
                    SiteKind::Force | SiteKind::Memoise { .. } => {}
                    SiteKind::Cell { .. } | SiteKind::Append { .. } | SiteKind::Read => {}
                }
            }
        }
    }

    /// The box of the part that was emitted last on the call path of a choice, before it in program order. It
    /// is the result of [`At::part`](crate::machine::answers::At::part) in a run that begins.
    pub fn part(&self, program: &Program<S>, choice: usize) -> Option<Aabb> {
        let at = self.kept.choices[choice];
        self.part_before(program, at.node, at.site as usize)
    }

    /// The box of the part that was emitted last on the call path of a site.
    pub(super) fn part_before(
        &self,
        program: &Program<S>,
        mut node: NodeId,
        mut before: usize,
    ) -> Option<Aabb> {
        loop {
            if let Some(part) = self.last_part(program, node, before) {
                return Some(part);
            }
            let n = &self.state.nodes[node.0 as usize];
            if n.parent == NodeId::NONE || n.memo().is_some() {
                return None;
            }
            let parent = &self.state.nodes[n.parent.0 as usize];
            if program.function(parent.function).mode == Mode::Loop {
                // For an iteration: first the earlier iterations, then the sites before the loop.
                let children = &self.kept.loops[parent.slots as usize];
                let earlier =
                    children.iter().position(|child| *child == node).map_or(&[][..], |i| &children[..i]);
                let part = earlier.iter().rev().find_map(|child| self.last_part(program, *child, usize::MAX));
                if part.is_some() || parent.parent == NodeId::NONE {
                    return part;
                }
                (node, before) = (parent.parent, parent.site as usize);
            } else {
                (node, before) = (n.parent, n.site as usize);
            }
        }
    }

    /// The box of the part that an activation, with its loops, emitted last within its first `sites` sites.
    fn last_part(&self, program: &Program<S>, node: NodeId, sites: usize) -> Option<Aabb> {
        let n = &self.state.nodes[node.0 as usize];
        let all = program.function(n.function).sites.iter().enumerate().take(sites);
        all.rev().find_map(|(i, site)| {
            let slot = self.kept.slots[n.slots as usize + i];
            match &site.kind {
                SiteKind::Emit if slot.is_filled() => {
                    let primitive = self.kept.emits[slot.held as usize].as_ref()?;
                    primitive.shapes().last().map(|shape| *shape.aabb())
                }
                SiteKind::Loop(_) if slot.is_filled() => {
                    let header = &self.state.nodes[slot.held as usize];
                    let children = self.kept.loops[header.slots as usize].iter().rev();
                    children.into_iter().find_map(|child| self.last_part(program, *child, usize::MAX))
                }
                _ => None,
            }
        })
    }

    /// The address of a choice.
    pub fn address(&self, program: &Program<S>, choice: usize) -> u128 {
        let at = self.kept.choices[choice];
        let n = &self.state.nodes[at.node.0 as usize];
        join(n.path, program.function(n.function).sites[at.site as usize].key)
    }

    /// The readable address of a choice.
    pub fn path(&self, program: &Program<S>, choice: usize) -> String {
        self.place(program, choice).path()
    }

    /// The place of a choice.
    pub fn place<'a>(&'a self, program: &'a Program<S>, choice: usize) -> Place<'a, S> {
        let at = self.kept.choices[choice];
        self.place_at(program, at.node, at.site)
    }

    pub(super) fn place_at<'a>(&'a self, program: &'a Program<S>, node: NodeId, site: u16) -> Place<'a, S> {
        let function = program.function(self.state.nodes[node.0 as usize].function);
        Place { site: &function.sites[site as usize], function, node, trace: self, program }
    }

    /// The function and the site of a choice: the same for all choices from one place of the text.
    pub fn site_of(&self, choice: usize) -> (crate::code::FunctionId, u16) {
        let at = self.kept.choices[choice];
        (self.state.nodes[at.node.0 as usize].function, at.site)
    }

    /// The value of a choice, and its log density in nats.
    pub fn choice(&self, program: &Program<S>, choice: usize) -> (&Value<S>, f64) {
        let at = self.kept.choices[choice];
        let n = &self.state.nodes[at.node.0 as usize];
        let site = &program.function(n.function).sites[at.site as usize];
        let slot = self.kept.slots[Kept::slot_at(&self.state, at.node, at.site as usize)];
        (&self.state.registers[n.registers as usize + site.to.index()], slot.log)
    }

    /// The number of calls above a choice (iterations of loops do not count).
    pub fn depth(&self, program: &Program<S>, choice: usize) -> usize {
        self.depth_of(program, self.kept.choices[choice].node)
    }

    fn depth_of(&self, program: &Program<S>, node: NodeId) -> usize {
        let mut at = node;
        let mut depth = 0;
        while at != NodeId::NONE {
            let n = &self.state.nodes[at.0 as usize];
            depth += usize::from(program.function(n.function).mode == Mode::Node);
            at = self.state.above(at);
        }
        depth - 1
    }

    /// The numbers of the trace's choices. They change when choices are added or removed.
    pub fn numbers(&self) -> std::ops::Range<usize> {
        0..self.kept.choices.len()
    }
}

//! The levels of a run: the iterations of its loops, and the calls of a function from within a call of the same function. The choices
//! of a level have other addresses at the place of another level.

use super::super::address::{iteration_key, join};
use super::super::state::NodeId;
use super::part::{Part, Piece};
use super::trace::Trace;
use crate::code::{Mode, Program, SiteKind};
use niwaki_math::Scalar;
use std::collections::HashSet;

/// A loop of a trace.
pub struct Iterations {
    path: u128,
    /// Its iterations in order, each with what is below it.
    pub parts: Vec<Part>,
}

impl Iterations {
    /// The hash of the loop's path: the same in every run that reaches it.
    pub fn path(&self) -> u128 {
        self.path
    }

    /// The hash of the path of iteration `number`, whether or not it exists.
    pub fn path_of(&self, number: usize) -> u128 {
        join(self.path, iteration_key(number as u32))
    }
}

/// A call of a function, and the next call of the same function below it.
pub struct Recursion {
    /// The call.
    pub above: Part,
    /// The call below it.
    pub below: Part,
}

/// The contents of a part that count when it is moved.
pub enum Within {
    /// All of it.
    All,
    /// All without the part that is called below.
    Without(Part),
    /// The choices of the activations from the first one down to the part that is called below, without that.
    Between(Part),
}

/// A part at another place.
pub struct Moved {
    /// The numbers of its choices, and the addresses that they have at the other place.
    pub choices: Vec<(u128, usize)>,
    /// The path that the part that is called below has at the other place.
    pub below: Option<u128>,
}

impl<S: Scalar> Trace<S> {
    /// The loops whose iterations are activations, in no order that counts.
    pub fn loops(&self, program: &Program<S>) -> Vec<Iterations> {
        let mut loops = Vec::new();
        self.nodes_below(program, |node| {
            let n = &self.state.nodes[node.0 as usize];
            if program.function(n.function).mode == Mode::Loop {
                let children = &self.kept.loops[n.slots as usize];
                let parts = children.iter().map(|child| Part::of(*child)).collect();
                loops.push(Iterations { path: n.path, parts });
            }
        });
        loops
    }

    /// The pairs of calls of the same function of which one is below the other, and no third is between them.
    pub fn recursions(&self, program: &Program<S>) -> Vec<Recursion> {
        let mut pairs = Vec::new();
        self.nodes_below(program, |node| {
            let function = self.state.nodes[node.0 as usize].function;
            if program.function(function).mode != Mode::Node {
                return;
            }
            let mut at = self.state.above(node);
            while at != NodeId::NONE && self.state.nodes[at.0 as usize].function != function {
                at = self.state.above(at);
            }
            if at != NodeId::NONE {
                pairs.push(Recursion { above: Part::of(at), below: Part::of(node) });
            }
        });
        pairs
    }

    /// The choices of a part, with the addresses that they would have if its first activation had the path `to`. Memoised calls have the
    /// same address everywhere, and are left out.
    pub fn moved(&self, program: &Program<S>, part: Part, to: u128, within: &Within) -> Moved {
        let (end, between) = match within {
            Within::All => (None, None),
            Within::Without(below) => (Some(below.node), None),
            Within::Between(below) => (Some(below.node), Some(self.path_down(part.node, below.node))),
        };
        let mut moved = Moved { choices: Vec::new(), below: None };
        let mut work = vec![(part.node, to)];
        while let Some((node, path)) = work.pop() {
            if Some(node) == end {
                moved.below = Some(path);
                continue;
            }
            let n = &self.state.nodes[node.0 as usize];
            let f = program.function(n.function);
            let mut below = |child: NodeId, key: u128| {
                let is_there = self.state.nodes[child.0 as usize].path == join(n.path, key);
                if is_there && between.as_ref().is_none_or(|between| between.contains(&child)) {
                    work.push((child, join(path, key)));
                }
            };
            if f.mode == Mode::Loop {
                let children = &self.kept.loops[n.slots as usize];
                (0..).zip(children).for_each(|(i, child)| below(*child, iteration_key(i)));
                continue;
            }
            for (i, site) in f.sites.iter().enumerate() {
                let slot = self.kept.slots[n.slots as usize + i];
                match &site.kind {
                    _ if !slot.is_filled() => {}
                    SiteKind::Sample(_) if slot.is_held() => {}
                    SiteKind::Sample(_) => {
                        moved.choices.push((join(path, site.key), slot.held as usize));
                    }
                    kind if kind.makes_activation() => below(NodeId(slot.held), site.key),
                    _ => {}
                }
            }
        }
        moved
    }

    /// The outermost activations with choices at or below them, of which none is among `known`.
    pub fn parts_without(&self, program: &Program<S>, known: &dyn Fn(u128) -> bool) -> Vec<Part> {
        // Each part before those below it, with the place of the part above it.
        let mut parts = vec![(Part::WHOLE, 0, 0_usize, 0_usize)];
        let mut at = 0;
        while at < parts.len() {
            let (part, ..) = parts[at];
            let (mut below, mut new, mut old) = (Vec::new(), 0, 0);
            self.pieces(program, part, |piece| match piece {
                Piece::Choice(n) if known(self.address(program, n)) => old += 1,
                Piece::Choice(_) => new += 1,
                Piece::Part(part) => below.push((part, at, 0, 0)),
                Piece::Emit(_) | Piece::Held(_) => {}
            });
            (parts[at].2, parts[at].3) = (new, old);
            parts.extend(below);
            at += 1;
        }
        for at in (1..parts.len()).rev() {
            let (_, above, new, old) = parts[at];
            parts[above].2 += new;
            parts[above].3 += old;
        }
        let mut outermost = Vec::new();
        // Whether a part lies in one that is new; the iterations from one on are each a part of its own.
        let mut inside = vec![false; parts.len()];
        for at in 0..parts.len() {
            let (part, above, new, old) = parts[at];
            let is_new = new > 0 && old == 0 && !part.is_onward();
            let is_inside = at > 0 && inside[above];
            if is_new && !is_inside {
                outermost.push(part);
            }
            inside[at] = is_new || is_inside;
        }
        outermost
    }

    /// The nodes on the way from a node, which is left out, down to a node below it.
    fn path_down(&self, from: NodeId, to: NodeId) -> HashSet<NodeId> {
        let mut nodes = HashSet::new();
        let mut at = to;
        while at != from && at != NodeId::NONE {
            nodes.insert(at);
            // A loop's node has no place of its own in the order of calls, but a path.
            at = self.state.nodes[at.0 as usize].parent;
        }
        nodes
    }

    /// Visits all nodes, those of loops too; those of memoised calls once.
    fn nodes_below(&self, program: &Program<S>, mut each: impl FnMut(NodeId)) {
        let (mut work, mut memoised) = (vec![NodeId(0)], HashSet::new());
        while let Some(node) = work.pop() {
            let n = &self.state.nodes[node.0 as usize];
            if n.memo().is_some_and(|number| !memoised.insert(number)) {
                continue;
            }
            each(node);
            let f = program.function(n.function);
            if f.mode == Mode::Loop {
                work.extend(self.kept.loops[n.slots as usize].iter().rev());
                continue;
            }
            for (i, site) in f.sites.iter().enumerate().rev() {
                let slot = self.kept.slots[n.slots as usize + i];
                if site.kind.makes_activation() && slot.is_filled() {
                    work.push(NodeId(slot.held));
                }
            }
        }
    }
}

//! Parts of a trace, which can run once more without the rest.
//!
//! A part is an activation and all activations below it, or the iterations of a loop from a given one on. So a
//! loop is divided like the recursion that it could be: the iterations from `i` on consist of iteration `i` and
//! of the iterations from `i + 1` on.
//!
//! The inputs of a part are in its own registers, and the inputs of an iteration also in the loop's node. A run
//! of the part needs nothing else. Its result is the value of a call, or the kind of exit of the iterations and
//! the values that they carry.

use super::super::numbers::Numbers;
use super::super::state::{NodeId, State, Status};
use super::trace::Trace;
use crate::code::{Mode, Program, SiteKind};
use crate::value::Value;
use niwaki_geom::Primitive;
use niwaki_math::Scalar;
use std::collections::HashMap;
use std::sync::Arc;

/// A part of a trace. It is valid until the trace changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Part {
    pub(super) node: NodeId,
    /// Whether later iterations of the same loop belong to the part.
    onward: bool,
}

impl Part {
    /// The whole run.
    pub const WHOLE: Part = Part { node: NodeId(0), onward: false };

    /// An activation with all below it.
    pub(super) fn of(node: NodeId) -> Part {
        Part { node, onward: false }
    }

    /// Whether the part consists of the iterations of a loop from a given one on.
    pub fn is_onward(self) -> bool {
        self.onward
    }
}

/// A piece of a part.
pub enum Piece<'a> {
    /// A choice of the part's own activation, by number.
    Choice(usize),
    /// A held choice of the part's own activation, by its number among held choices.
    Held(u32),
    /// A primitive that the part's own activation emitted.
    Emit(&'a Primitive),
    /// A part below.
    Part(Part),
}

impl<S: Scalar> Trace<S> {
    /// Visits the pieces of a part, in program order. No transaction may be open.
    pub fn pieces<'a>(&'a self, program: &Program<S>, part: Part, mut each: impl FnMut(Piece<'a>)) {
        let n = &self.state.nodes[part.node.0 as usize];
        if part.onward {
            each(Piece::Part(Part { onward: false, ..part }));
            let header = &self.state.nodes[n.parent.0 as usize];
            if let Some(next) = self.kept.loops[header.slots as usize].get(n.iteration as usize + 1) {
                each(Piece::Part(Part { node: *next, onward: true }));
            }
            return;
        }
        for (i, site) in program.function(n.function).sites.iter().enumerate() {
            let slot = self.kept.slots[n.slots as usize + i];
            match &site.kind {
                _ if !slot.is_filled() => {}
                SiteKind::Sample(_) if slot.is_held() => each(Piece::Held(slot.held)),
                SiteKind::Sample(_) => each(Piece::Choice(slot.held as usize)),
                SiteKind::Emit => {
                    self.kept.emits[slot.held as usize].iter().for_each(|emit| each(Piece::Emit(emit)));
                }
                SiteKind::Loop(_) => {
                    let header = &self.state.nodes[slot.held as usize];
                    let first = self.kept.loops[header.slots as usize].first();
                    first.into_iter().for_each(|node| each(Piece::Part(Part { node: *node, onward: true })));
                }
                kind if kind.makes_activation() => {
                    each(Piece::Part(Part::of(NodeId(slot.held))));
                }
                _ => {}
            }
        }
    }

    /// Visits the choices (by number), the held choices and the primitives of a part and of all parts below it,
    /// in no order.
    pub fn all_pieces<'a>(&'a self, program: &Program<S>, part: Part, mut each: impl FnMut(Piece<'a>)) {
        let mut work = vec![part];
        while let Some(part) = work.pop() {
            self.pieces(program, part, |piece| match piece {
                Piece::Part(part) => work.push(part),
                other => each(other),
            });
        }
    }

    /// The activation of a choice, as a part.
    pub fn part_of(&self, choice: usize) -> Part {
        Part::of(self.activation(choice, 0))
    }

    /// The hash of the path of a part's first activation: the same in every run that reaches it with the same
    /// inputs.
    pub fn part_path(&self, part: Part) -> u128 {
        self.state.nodes[part.node.0 as usize].path
    }

    /// The readable path of a part's first activation; empty for the whole run.
    pub fn part_name(&self, program: &Program<S>, part: Part) -> String {
        self.state.path(program, part.node)
    }

    /// A run of a part that has not begun, with the part's inputs in this trace. Futures that it creates are
    /// deferred. With `origins`, addresses below it can be read from the root.
    pub fn start_part(&self, program: &Program<S>, part: Part, origins: bool) -> State<S> {
        let mut state = State::empty();
        let n = &self.state.nodes[part.node.0 as usize];
        let f = program.function(n.function);
        let copy = |state: &mut State<S>, from: NodeId, parent: NodeId, inputs: usize| {
            let n = &self.state.nodes[from.0 as usize];
            let to = state.new_node(program, n.function, parent, 0, n.path);
            state.nodes[to.0 as usize].iteration = n.iteration;
            let (at, base) = (state.nodes[to.0 as usize].registers as usize, n.registers as usize);
            for i in 0..inputs {
                state.registers[at + i] = self.kept.resolved(&self.state, &self.state.registers[base + i]);
            }
            to
        };
        let mut above = NodeId::NONE;
        if f.mode == Mode::Iteration {
            let header = &self.state.nodes[n.parent.0 as usize];
            let all = program.function(header.function).node_registers as usize;
            above = copy(&mut state, n.parent, NodeId::NONE, all);
            if !part.onward {
                // The loop has nothing more to run over.
                let over = state.nodes[above.0 as usize].registers as usize;
                state.registers[over] = Value::tuple(Vec::new());
            }
        }
        let first = copy(&mut state, part.node, above, f.params as usize + f.captures as usize);
        if origins {
            let (node, name) = match above {
                NodeId::NONE => (first, self.state.path(program, part.node)),
                header => (header, self.state.loop_path(program, n.parent)),
            };
            state.origins = Some(HashMap::from([(node, name)]));
        }
        let future = state.new_future(Status::Runnable(first), false);
        state.runnable.push(future);
        // The values at the beginning belong to this trace.
        let values = state.registers.iter().chain(self.state.inputs.iter().flat_map(|inputs| inputs.iter()));
        let inputs: Arc<[Value<S>]> = values.filter(|value| !value.is_plain()).cloned().collect();
        state.inputs = (!inputs.is_empty()).then_some(inputs);
        state.unmet = self.held_within(program, part);
        state
    }

    /// Lets a run of a part that has not begun record the parts that activations emit last, and begin with the
    /// last part before it in this trace.
    pub fn note_parts(&self, program: &Program<S>, part: Part, start: &mut State<S>) {
        start.note_parts();
        if let Some(before) = self.part_before(program, part.node, 0) {
            // The first node is the loop's node if the part is an iteration.
            start.put_part(NodeId(0), before);
        }
    }

    /// The held choices that only this part has: a run of the part must meet them.
    fn held_within(&self, program: &Program<S>, part: Part) -> Numbers {
        let mut within = vec![0; self.kept.met.len()];
        if !within.is_empty() {
            self.all_pieces(program, part, |piece| {
                if let Piece::Held(number) = piece {
                    within[number as usize] += 1;
                }
            });
        }
        let all = (0..).zip(within.iter().zip(&self.kept.met));
        all.filter(|(_, (inside, all))| **inside > 0 && inside == all).map(|(number, _)| number).collect()
    }
}

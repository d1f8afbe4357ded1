//! The order of a density's operations, and the places of their numbers in the scratch.
//!
//! The gradient comes first; the other operations of the value are a second program, which runs after it on the same
//! scratch. Constants are in the scratch too, the most used ones at its start. An instruction that reads a number near the
//! start of the scratch is shorter than one that reads from further on, and both are shorter than the constant's bits.

use crate::density::Density;
use crate::graph::{Id, small};
use crate::operation::Op;

/// Operations in one function of machine code.
pub(super) const FUNCTION: usize = 600;

/// Mark of nodes without a place in the scratch, and without a segment.
pub(super) const NOWHERE: u32 = u32::MAX;

/// Calls of an operation at a level: `n` numbers of each argument from place `from` on, one argument after the other;
/// results at `to`.
pub(super) struct Batch {
    pub level: u32,
    pub op: Op,
    pub ids: Vec<Id>,
    pub from: u32,
    pub to: u32,
}

/// Operations of a program, ordered by level: the number of calls that must run before.
#[derive(Default)]
pub(super) struct Program {
    /// Instructions, cut into functions, with the level of each function.
    pub segments: Vec<(u32, Vec<Id>)>,
    pub batches: Vec<Batch>,
    /// The numbers that calls take, and the places from which the calls read them.
    pub arguments: Vec<(Id, u32)>,
}

/// Two programs over one scratch.
pub(super) struct Layout {
    /// The gradient, with the guards.
    pub slope: Program,
    /// The other operations of the value.
    pub rest: Program,
    /// Places in the scratch of the numbers that are read from there.
    pub place: Vec<u32>,
    /// For each instruction, the function that computes it, counted over both programs.
    pub segment: Vec<u32>,
    /// Numbers in the scratch at the start.
    pub scratch: Vec<f64>,
    /// Place of the value.
    pub value: u32,
    /// Places that hold nonzero bits if the guards hold.
    pub flags: Vec<u32>,
}

/// The comparison `a < b` that a select evaluates itself, so that it is not computed as a number.
pub(super) fn test_of(density: &Density, select: Id) -> Option<Id> {
    let graph = density.graph();
    let node = graph.node(select);
    (node.op == Op::Select).then(|| node.arg(0)).filter(|test| graph.node(*test).op == Op::Less)
}

/// Arguments as the code reads them.
fn reads(density: &Density, id: Id) -> impl Iterator<Item = Id> {
    let graph = density.graph();
    let node = *graph.node(id);
    let test = test_of(density, id);
    let comparands = test.map(|test| [graph.node(test).arg(0), graph.node(test).arg(1)]);
    let direct = (usize::from(test.is_some())..node.op.arity()).map(move |k| node.arg(k));
    comparands.into_iter().flatten().chain(direct)
}

/// Marks the nodes that the code reads or writes for the roots.
fn needed(density: &Density, roots: impl Iterator<Item = Id>) -> Vec<bool> {
    let mut needed = vec![false; density.graph().len()];
    roots.for_each(|id| needed[id.index()] = true);
    for at in (0..needed.len()).rev() {
        if needed[at] {
            reads(density, Id(small(at))).for_each(|arg| needed[arg.index()] = true);
        }
    }
    needed
}

impl Program {
    /// The program of the nodes that `mine` accepts; all other nodes that they read are computed before.
    fn new(density: &Density, mine: impl Fn(Id) -> bool) -> Program {
        let graph = density.graph();
        let mut level = vec![0_u32; graph.len()];
        let (mut plain, mut calls): (Vec<Id>, Vec<Id>) = (vec![], vec![]);
        for (id, node) in graph.nodes().filter(|(id, node)| mine(*id) && node.op.arity() > 0) {
            let after = |arg: Id| level[arg.index()] + u32::from(mine(arg) && graph.node(arg).op.is_call());
            level[id.index()] = reads(density, id).map(after).max().unwrap_or(0);
            if node.op.is_call() { &mut calls } else { &mut plain }.push(id);
        }
        plain.sort_by_key(|id| (level[id.index()], *id));
        calls.sort_by_key(|id| (level[id.index()], graph.node(*id).op, *id));
        let mut program = Program::default();
        for id in calls {
            let (op, level) = (graph.node(id).op, level[id.index()]);
            match program.batches.last_mut() {
                Some(batch) if batch.op == op && batch.level == level => batch.ids.push(id),
                _ => program.batches.push(Batch { level, op, ids: vec![id], from: 0, to: 0 }),
            }
        }
        for id in plain {
            let at = level[id.index()];
            match program.segments.last_mut() {
                Some((l, ids)) if *l == at && ids.len() < FUNCTION => ids.push(id),
                _ => program.segments.push((at, vec![id])),
            }
        }
        program
    }

    /// Allocates places from `size` on for arguments and results of calls.
    fn place_calls(&mut self, density: &Density, place: &mut [u32], size: &mut u32) {
        for batch in &mut self.batches {
            let n = small(batch.ids.len());
            batch.from = *size;
            batch.to = *size + n * small(batch.op.arity());
            *size = batch.to + n;
            for (k, id) in batch.ids.iter().enumerate() {
                place[id.index()] = batch.to + small(k);
                for (j, arg) in density.graph().node(*id).args().enumerate() {
                    self.arguments.push((arg, batch.from + small(j) * n + small(k)));
                }
            }
        }
    }
}

impl Layout {
    pub(super) fn new(density: &Density) -> Layout {
        let graph = density.graph();
        let guards = || density.guards().iter().flat_map(|g| [g.a, g.b]);
        let for_slope = needed(density, density.gradient().iter().copied().chain(guards()));
        let for_value = needed(density, std::iter::once(density.value()));
        let slope = Program::new(density, |id| for_slope[id.index()]);
        let rest = Program::new(density, |id| for_value[id.index()] && !for_slope[id.index()]);
        let mut layout = Layout {
            slope,
            rest,
            place: vec![NOWHERE; graph.len()],
            segment: vec![NOWHERE; graph.len()],
            scratch: vec![],
            value: NOWHERE,
            flags: vec![],
        };
        let segments = || layout.slope.segments.iter().chain(&layout.rest.segments).map(|(_, ids)| ids);
        for (at, ids) in segments().enumerate() {
            ids.iter().for_each(|id| layout.segment[id.index()] = small(at));
        }
        // Constants that instructions read, or that are results.
        let mut uses = vec![0_u32; graph.len()];
        let results = density.gradient().iter().copied().chain(guards()).chain([density.value()]);
        let read = segments().flatten().flat_map(|id| reads(density, *id));
        for id in read.chain(results).filter(|id| graph.node(*id).op == Op::Constant) {
            uses[id.index()] += 1;
        }
        let mut constants: Vec<Id> =
            graph.nodes().map(|(id, _)| id).filter(|id| uses[id.index()] > 0).collect();
        constants.sort_by_key(|id| (std::cmp::Reverse(uses[id.index()]), *id));
        for (at, id) in constants.iter().enumerate() {
            layout.place[id.index()] = small(at);
        }
        let mut size = small(constants.len());
        layout.slope.place_calls(density, &mut layout.place, &mut size);
        layout.rest.place_calls(density, &mut layout.place, &mut size);
        layout.place_instructions(density, &mut size);
        for _ in density.guards().chunks(FUNCTION) {
            layout.flags.push(size);
            size += 1;
        }
        layout.value = layout.place[density.value().index()];
        layout.scratch = vec![0.0; size as usize];
        let arguments = layout.slope.arguments.iter().chain(&layout.rest.arguments);
        let read = constants.iter().map(|id| (*id, layout.place[id.index()]));
        for (id, place) in arguments.copied().chain(read) {
            if let Some(x) = graph.constant_of(id) {
                layout.scratch[place as usize] = x;
            }
        }
        layout
    }

    /// Whether an instruction computes the node: not a constant, an input or a result of a call.
    pub(super) fn is_instruction(&self, id: Id) -> bool {
        self.segment[id.index()] != NOWHERE
    }

    /// The place of the node in the scratch, if it has one.
    pub(super) fn place_of(&self, id: Id) -> Option<u32> {
        Some(self.place[id.index()]).filter(|place| *place != NOWHERE)
    }

    /// Places of instructions that another function reads, of guards, and of the value.
    fn place_instructions(&mut self, density: &Density, size: &mut u32) {
        let (place, segment) = (&mut self.place, &self.segment);
        // If only a call of a later program takes a number, it is written to the place where the call reads it.
        for (arg, to) in &self.rest.arguments {
            let at = segment[arg.index()];
            if (at as usize) < self.slope.segments.len() && place[arg.index()] == NOWHERE {
                place[arg.index()] = *to;
            }
        }
        let mut put = |id: Id| {
            if place[id.index()] == NOWHERE {
                place[id.index()] = *size;
                *size += 1;
            }
        };
        let segments = self.slope.segments.iter().chain(&self.rest.segments).map(|(_, ids)| ids);
        for (at, ids) in segments.enumerate() {
            for arg in ids.iter().flat_map(|id| reads(density, *id)) {
                let from = segment[arg.index()];
                if from != NOWHERE && from != small(at) {
                    put(arg);
                }
            }
        }
        let guards = density.guards().iter().flat_map(|g| [g.a, g.b]);
        guards.filter(|id| segment[id.index()] != NOWHERE).for_each(&mut put);
        put(density.value());
    }
}

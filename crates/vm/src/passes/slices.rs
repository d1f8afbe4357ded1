//! Slices: of what follows a site or stands in a function, the part that one changed register can reach.
//!
//! A kept activation that is entered again because one value has changed need not be run whole: an instruction that
//! reads nothing that has changed leaves what it left before. For each site, parameter and capture the instructions
//! that depend on it are copied to the end of the function's code, in their order, with those that make the scratch
//! values which they read. [`Op::Done`] ends a slice whose return does not depend on it.
//!
//! A slice is optimistic where its instructions tell at run time: a choice that keeps its value, a call or a loop that
//! leaves what it left changes nothing further. Where one of them does, the run goes on in the whole code after it,
//! which does all that the slice would do and more.
//!
//! Branches on what has not changed go the same way again; at a branch on what has, or at a loop that is no site, a
//! slice ends with a jump into the whole code.

use super::place::reads_and_writes;
use crate::code::{Function, Mode, Op, Operand, Place, SiteId, SiteKind};
use niwaki_math::Scalar;
use std::collections::HashSet;

/// All slices of a function together are at most this many times as long as its code.
const MOST: usize = 8;

/// Appends the slices of a function to its code.
pub(crate) fn slice<S: Scalar>(f: &mut Function<S>) {
    f.body = f.code.len() as u32;
    let whole: Vec<u32> = f.sites.iter().map(|site| site.next).collect();
    f.sites.iter_mut().zip(&whole).for_each(|(site, next)| site.again = *next);
    if f.mode == Mode::Pure {
        return;
    }
    let inputs = usize::from(f.params) + usize::from(f.captures);
    f.inputs = (0..inputs).map(|i| append(f, 0, &[Operand::new(Place::Node, i)])).collect();
    if f.mode == Mode::Iteration {
        let outer = |o: &Operand| (o.place() == Place::Outer).then(|| o.index() + 1);
        let all = f.code.iter().flat_map(|op| reads_and_writes(f, op).0);
        let count = all.filter_map(|o| outer(&o)).max().unwrap_or(0);
        f.outers = (0..count).map(|i| append(f, 0, &[Operand::new(Place::Outer, i)])).collect();
    }
    for (i, next) in whole.into_iter().enumerate() {
        let site = &f.sites[i];
        let mut results = vec![site.to];
        match &site.kind {
            SiteKind::Loop(l) => {
                results.extend(&f.operands[l.out.range()]);
                results.extend(l.exit.into_iter().flat_map(|(how, value)| [how, value]));
            }
            SiteKind::Sample { .. }
            | SiteKind::SampleDist
            | SiteKind::SampleIndexed
            | SiteKind::Call { .. }
            | SiteKind::Apply
            | SiteKind::Future { .. }
            | SiteKind::FutureApply { .. }
            | SiteKind::Read => {}
            // No run begins after one of the others.
            _ => continue,
        }
        f.sites[i].again = append(f, next, &results);
    }
}

/// Appends the slice from `start` on of what depends on those registers; where it begins. That is `start` itself when
/// the slice would be no shorter.
fn append<S: Scalar>(f: &mut Function<S>, start: u32, changed: &[Operand]) -> u32 {
    let Some(slice) = Slice::of(f, start as usize, changed) else { return start };
    if f.code.len() + slice.len() > f.body as usize * (1 + MOST) {
        return start;
    }
    let at = f.code.len() as u32;
    for (op, from) in slice {
        f.code.push(op);
        f.spans.push(f.spans[from]);
    }
    at
}

struct Slice {
    /// The instructions on the way to the end.
    path: Vec<usize>,
    /// Which of them are in the slice.
    taken: Vec<bool>,
    /// Places in `path` before which all scratch values of the whole code must be there.
    joins: Vec<usize>,
    /// Where the slice goes over into the whole code.
    rest: Option<usize>,
}

impl Slice {
    /// The slice's instructions, and where each comes from.
    fn of<S: Scalar>(f: &Function<S>, start: usize, changed: &[Operand]) -> Option<Vec<(Op, usize)>> {
        let mut slice = Slice { path: vec![], taken: vec![], joins: vec![], rest: None };
        let tainted = slice.forward(f, start, changed);
        slice.backward(f, &tainted);
        let last = *slice.path.last()?;
        let mut ops: Vec<(Op, usize)> = slice
            .path
            .iter()
            .zip(&slice.taken)
            .filter(|(_, taken)| **taken)
            .map(|(at, _)| (passed(f, &f.code[*at], &tainted).unwrap_or(f.code[*at]), *at))
            .collect();
        let whole = slice.path.len() + usize::from(slice.rest.is_some());
        match slice.rest {
            Some(rest) => ops.push((Op::Jump { target: rest as u32 }, rest)),
            None if !slice.taken.last().copied().unwrap_or(false) => ops.push((Op::Done, last)),
            None => {}
        }
        (ops.len() < whole).then_some(ops)
    }

    /// Walks to the end and takes what depends on the changed registers; all registers that may have changed.
    fn forward<S: Scalar>(&mut self, f: &Function<S>, start: usize, changed: &[Operand]) -> HashSet<Operand> {
        let mut tainted: HashSet<Operand> = changed.iter().copied().collect();
        let mut at = start;
        loop {
            let op = f.code[at];
            let (reads, writes) = reads_and_writes(f, &op);
            let hit = reads.iter().any(|o| tainted.contains(o));
            match op {
                Op::Jump { target } if target as usize > at => {
                    at = target as usize;
                    continue;
                }
                Op::Clear { .. } => {
                    at += 1;
                    continue;
                }
                Op::JumpIf { target, .. }
                | Op::JumpUnless { target, .. }
                | Op::JumpUnlessCompare { target, .. }
                    if !hit && target as usize > at =>
                {
                    self.joins.push(self.path.len());
                    self.path.push(at);
                    self.taken.push(true);
                }
                Op::Jump { .. }
                | Op::JumpIf { .. }
                | Op::JumpUnless { .. }
                | Op::JumpUnlessCompare { .. }
                | Op::Next { .. } => {
                    self.joins.push(self.path.len());
                    self.rest = Some(at);
                    return tainted;
                }
                Op::Return { .. } | Op::ReturnIteration { .. } => {
                    self.path.push(at);
                    self.taken.push(hit);
                    return tainted;
                }
                Op::Site { site } => {
                    let site = &f.sites[site.0 as usize];
                    self.path.push(at);
                    // What a query tells lies in registers.
                    self.taken.push(hit && !matches!(site.kind, SiteKind::Query));
                    let is_changed = match site.kind {
                        // Whether they leave something else is known when they have run.
                        SiteKind::Sample { .. }
                        | SiteKind::SampleDist
                        | SiteKind::SampleIndexed
                        | SiteKind::Call { .. }
                        | SiteKind::Loop(_)
                        | SiteKind::Query
                        | SiteKind::Cell { .. } => false,
                        SiteKind::Append { .. } => tainted.contains(&f.operands[site.args.start as usize]),
                        _ => hit,
                    };
                    if is_changed {
                        tainted.insert(site.to);
                    }
                }
                _ => {
                    self.path.push(at);
                    self.taken.push(hit);
                    if hit {
                        tainted.extend(writes);
                    }
                }
            }
            at += 1;
        }
    }

    /// Takes what makes the scratch values that are read. They live no longer than to the next site.
    fn backward<S: Scalar>(&mut self, f: &Function<S>, tainted: &HashSet<Operand>) {
        let mut needed: HashSet<Operand> = HashSet::new();
        let mut all = self.joins.last() == Some(&self.path.len());
        for i in (0..self.path.len()).rev() {
            let op = &f.code[self.path[i]];
            if let Op::Site { .. } = op {
                all = false;
            }
            let (mut reads, writes) = reads_and_writes(f, op);
            self.taken[i] |= all || writes.iter().any(|o| needed.contains(o));
            all |= self.joins.contains(&i);
            if self.taken[i] {
                if let Some(Op::Pass { site, arg }) = passed(f, op, tainted) {
                    let args = f.sites[site.0 as usize].args;
                    reads = vec![f.operands[args.start as usize + arg as usize]];
                }
                writes.iter().for_each(|o| {
                    needed.remove(o);
                });
                needed.extend(reads.into_iter().filter(|o| o.place() == Place::Scratch));
            }
        }
    }
}

/// A call of which one argument may have changed.
fn passed<S: Scalar>(f: &Function<S>, op: &Op, tainted: &HashSet<Operand>) -> Option<Op> {
    let Op::Site { site: SiteId(number) } = *op else { return None };
    let site = &f.sites[number as usize];
    if !matches!(site.kind, SiteKind::Call { .. }) {
        return None;
    }
    let mut changed = (0..).zip(&f.operands[site.args.range()]).filter(|(_, o)| tainted.contains(o));
    match (changed.next(), changed.next()) {
        (Some((arg, _)), None) => Some(Op::Pass { site: SiteId(number), arg }),
        _ => None,
    }
}

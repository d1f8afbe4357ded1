//! Slices: the instructions of a function, or after a site, that depend on one changed register.
//!
//! A kept activation that is entered again because one value has changed need not be run whole: an instruction that
//! reads nothing that has changed has the same result as before. For each site, parameter and capture the instructions
//! that depend on it are copied to the end of the function's code, in their order, with those that compute the scratch
//! values which they read. [`Op::Done`] ends a slice whose return does not depend on it.
//!
//! A slice is optimistic where a test at run time is possible: a choice that keeps its value, or a call or a loop with
//! the same result as before, changes nothing further. Otherwise the run continues in the whole code after it, which
//! includes all instructions of the slice.
//!
//! A branch on an unchanged value takes the same arm as before; at a branch on a changed one, or at a loop that is no
//! site, a slice ends with a jump into the whole code.

use crate::code::flow::reads_and_writes;
use crate::code::{Function, Mode, Op, Operand, Place, SiteId, SiteKind};
use niwaki_math::Scalar;
use std::collections::HashSet;

/// All slices of a function together are at most this many times as long as its code.
const MOST: usize = 8;

/// A slice has both arms of so many consecutive branches; after those the other arm is the whole code.
const DEEPEST: usize = 3;

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
        let read = f.code.iter().flat_map(|op| reads_and_writes(f, op).0);
        let all = read.chain(f.scope.iter().map(|x| x.at));
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
            SiteKind::Sample(_) | SiteKind::Read => {}
            kind if kind.makes_activation() => {}
            // No run begins after one of the others.
            _ => continue,
        }
        f.sites[i].again = append(f, next, &results);
    }
}

/// Appends the slice from `start` on of what depends on those registers, and gives where it begins. That is `start`
/// itself when the slice would leave nothing out, or would be too long.
fn append<S: Scalar>(f: &mut Function<S>, start: u32, changed: &[Operand]) -> u32 {
    let base = f.code.len();
    for deepest in [DEEPEST, 0] {
        let mut slice = Slice::forward(f, start as usize, changed.iter().copied().collect(), deepest);
        slice.backward(f);
        if !slice.leaves_out(f) {
            return start;
        }
        let mut ops = Vec::new();
        slice.write(f, base, &mut ops);
        if base + ops.len() <= f.body as usize * (1 + MOST) {
            for (op, from) in ops {
                f.code.push(op);
                f.spans.push(f.spans[from]);
            }
            return base as u32;
        }
    }
    start
}

/// A slice: one path to the end, and the paths that branch off.
struct Slice {
    /// Registers that may have changed.
    tainted: HashSet<Operand>,
    /// The instructions on the path.
    path: Vec<usize>,
    /// Which of them are in the slice.
    taken: Vec<bool>,
    /// At a branch in `path`: the slice of its other arm, or nothing where that is the whole code.
    others: Vec<(usize, Option<Slice>)>,
    /// Where the slice continues in the whole code.
    rest: Option<usize>,
}

impl Slice {
    /// Visits the path to the end and collects what depends on the changed registers; both arms at so many branches.
    fn forward<S: Scalar>(
        f: &Function<S>,
        mut at: usize,
        tainted: HashSet<Operand>,
        deepest: usize,
    ) -> Slice {
        let mut slice = Slice { tainted, path: vec![], taken: vec![], others: vec![], rest: None };
        let mut left = deepest;
        loop {
            let op = f.code[at];
            let (reads, writes) = reads_and_writes(f, &op);
            let hit = reads.iter().any(|o| slice.tainted.contains(o));
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
                    let other = (left > 0).then(|| {
                        left -= 1;
                        Slice::forward(f, target as usize, slice.tainted.clone(), left)
                    });
                    slice.others.push((slice.path.len(), other));
                    slice.take(at, true);
                }
                Op::Jump { .. }
                | Op::JumpIf { .. }
                | Op::JumpUnless { .. }
                | Op::JumpUnlessCompare { .. }
                | Op::Next { .. } => {
                    slice.rest = Some(at);
                    return slice;
                }
                Op::Return { .. } | Op::ReturnIteration { .. } => {
                    slice.take(at, hit);
                    return slice;
                }
                Op::Site { site } => {
                    let site = &f.sites[site.0 as usize];
                    // The values of a query are in registers.
                    slice.take(at, hit && !matches!(site.kind, SiteKind::Query));
                    let is_changed = match site.kind {
                        // Whether their results change is known when they have run.
                        SiteKind::Sample(_)
                        | SiteKind::Call { .. }
                        | SiteKind::Loop(_)
                        | SiteKind::Query
                        | SiteKind::Cell { .. } => false,
                        SiteKind::Append { .. } => {
                            slice.tainted.contains(&f.operands[site.args.start as usize])
                        }
                        _ => hit,
                    };
                    if is_changed {
                        slice.tainted.insert(site.to);
                    }
                }
                _ => {
                    // What was written anew before is written again here, whatever it now becomes.
                    let hit = hit || writes.iter().any(|o| slice.tainted.contains(o));
                    slice.take(at, hit);
                    if hit {
                        slice.tainted.extend(writes);
                    }
                }
            }
            at += 1;
        }
    }

    fn take(&mut self, at: usize, taken: bool) {
        self.path.push(at);
        self.taken.push(taken);
    }

    /// Adds what computes the scratch values that are read, which are valid up to the next site. The result: the
    /// scratch values that are needed where the slice begins, and whether all those of the whole code are needed.
    fn backward<S: Scalar>(&mut self, f: &Function<S>) -> (HashSet<Operand>, bool) {
        let mut needed: HashSet<Operand> = HashSet::new();
        let mut all = self.rest.is_some();
        for i in (0..self.path.len()).rev() {
            let op = &f.code[self.path[i]];
            if let Op::Site { .. } = op {
                all = false;
            }
            let (mut reads, writes) = reads_and_writes(f, op);
            // The whole code needs all scratch values, and no other: registers of the node are as they were. One that is
            // written in several places must not be set back to what the first of them gives.
            let is_needed = |o: &Operand| needed.contains(o) || all && o.place() == Place::Scratch;
            self.taken[i] |= writes.iter().any(is_needed);
            match self.others.iter_mut().find(|(place, _)| *place == i) {
                Some((_, Some(other))) => {
                    let theirs = other.backward(f);
                    needed.extend(theirs.0);
                    all |= theirs.1;
                }
                Some((_, None)) => all = true,
                None => {}
            }
            if self.taken[i] {
                if let Some(Op::Pass { site, arg }) = self.passed(f, op) {
                    let args = f.sites[site.0 as usize].args;
                    reads = vec![f.operands[args.start as usize + arg as usize]];
                }
                writes.iter().for_each(|o| {
                    needed.remove(o);
                });
                needed.extend(reads.into_iter().filter(|o| o.place() == Place::Scratch));
            }
        }
        (needed, all)
    }

    /// Whether it does less than the whole code.
    fn leaves_out<S: Scalar>(&self, f: &Function<S>) -> bool {
        let passes = |(at, taken): (&usize, &bool)| {
            *taken
                && matches!(self.passed(f, &f.code[*at]), Some(Op::Pass { site, .. })
                    if f.sites[site.0 as usize].args.len > 1)
        };
        self.taken.contains(&false)
            || self.path.iter().zip(&self.taken).any(passes)
            || self.others.iter().any(|(_, other)| other.as_ref().is_some_and(|other| other.leaves_out(f)))
    }

    /// Writes its instructions, each with its original, placed from `base` on.
    fn write<S: Scalar>(&self, f: &Function<S>, base: usize, ops: &mut Vec<(Op, usize)>) {
        let mut branches = Vec::new();
        for (i, at) in self.path.iter().enumerate().filter(|(i, _)| self.taken[*i]) {
            if let Some((_, Some(other))) = self.others.iter().find(|(place, _)| *place == i) {
                branches.push((ops.len(), other));
            }
            ops.push((self.passed(f, &f.code[*at]).unwrap_or(f.code[*at]), *at));
        }
        match (self.rest, self.path.last()) {
            (Some(rest), _) => ops.push((Op::Jump { target: rest as u32 }, rest)),
            (None, Some(last)) if !self.taken.last().copied().unwrap_or(false) => {
                ops.push((Op::Done, *last));
            }
            _ => {}
        }
        for (at, other) in branches {
            let here = (base + ops.len()) as u32;
            if let Op::JumpIf { target, .. }
            | Op::JumpUnless { target, .. }
            | Op::JumpUnlessCompare { target, .. } = &mut ops[at].0
            {
                *target = here;
            }
            other.write(f, base, ops);
        }
    }

    /// A call of which one argument may have changed.
    fn passed<S: Scalar>(&self, f: &Function<S>, op: &Op) -> Option<Op> {
        let Op::Site { site: SiteId(number) } = *op else { return None };
        let site = &f.sites[number as usize];
        if !matches!(site.kind, SiteKind::Call { .. }) {
            return None;
        }
        let operands = &f.operands[site.args.range()];
        let mut changed = (0..).zip(operands).filter(|(_, o)| self.tainted.contains(o));
        match (changed.next(), changed.next()) {
            (Some((arg, _)), None) => Some(Op::Pass { site: SiteId(number), arg }),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    //! Slices are those that a person would write by hand.
    use super::*;
    use crate::code::disassemble;
    use crate::core::parse::parse;
    use crate::passes::compile;

    /// The instructions from `start` on to the end of a slice.
    fn slice_from(f: &Function, listing: &[String], start: u32) -> Vec<String> {
        let mut ops = Vec::new();
        for (op, line) in f.code.iter().zip(listing).skip(start as usize) {
            ops.push(line.clone());
            if matches!(op, Op::Done | Op::Jump { .. } | Op::Return { .. } | Op::ReturnIteration { .. }) {
                break;
            }
        }
        ops
    }

    #[test]
    fn a_slice_holds_what_depends_and_no_more() {
        let text = r#"(module
          (fn "f" (params $n $m)
            (set $k (sample (dist poisson 2.0)))
            (do (query (str $n) $k))
            (set $x (sample (dist gaussian $m 1.0)))
            (set $t (mul $n 2.0))
            (do (observe (dist gaussian (add $x $k) 1.0) $t))
            (return $n))
          (fn "m" (params) (return (call "f" 1.0 2.0))) (entry "m"))"#;
        let program = compile::<f64>(&parse(text).unwrap(), vec![]).unwrap();
        let f = &program.functions[0];
        let text = disassemble(&program);
        let listing: Vec<String> = text
            .lines()
            .skip_while(|line| !line.starts_with("f0 "))
            .skip(1)
            .take_while(|line| !line.starts_with("f1 "))
            .filter(|line| !line.starts_with("     "))
            .map(|line| line.trim().split_once("  ").unwrap_or(("", line)).1.to_string())
            .collect();
        assert_eq!(listing.len(), f.code.len());
        let has = |start: u32| {
            let slice = slice_from(f, &listing, start);
            let part = |word: &str| slice.iter().any(|line| line.contains(word));
            (part("str"), part("Gaussian") && part("\"x\""), part("Mul"), part("Observe"), part("done"))
        };
        // The count: not the key's text and the other choice, but the observation with what it reads.
        assert_eq!(has(f.sites[0].again), (false, false, true, true, true));
        // The mean of the other choice: that choice, and nothing else unless it changes.
        assert_eq!(has(f.inputs[1]), (false, true, false, false, true));
    }
}

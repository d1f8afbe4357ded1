//! Slices: the instructions of a function, or of the part after a site, that depend on one changed register.
//!
//! A kept activation that is entered again because one value has changed need not run completely: an
//! instruction that reads no changed value has the same result as before. For each site, parameter and capture,
//! the pass copies the instructions that depend on it to the end of the function's code, in their order. The
//! copy includes the instructions that compute scratch values which the slice reads. [`Op::Done`] ends a slice
//! whose return does not depend on the changed value.
//!
//! A slice is optimistic where a test at run time is possible: a choice that keeps its value changes nothing
//! further, nor does a call or a loop with the same result as before. Otherwise the run continues in the whole
//! code after it, which includes all instructions of the slice.
//!
//! A branch on an unchanged value takes the same arm as before. At a branch on a changed value, or at a loop
//! that is not a site, a slice ends with a jump into the whole code.

use crate::code::flow::reads_and_writes;
use crate::code::{Function, Mode, Op, Operand, Place, SiteId, SiteKind};
use niwaki_math::Scalar;
use std::collections::HashSet;

/// The most length of all slices of a function together, as a multiple of the length of its code.
const MAX_GROWTH: usize = 8;

/// The most consecutive branches of which a slice has both arms; after these, the other arm is the whole code.
const MAX_BRANCHES: usize = 3;

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
            // No run begins after any other site.
            _ => continue,
        }
        f.sites[i].again = append(f, next, &results);
    }
}

/// Appends the slice from `start` on of the instructions that depend on the changed registers, and returns its
/// first instruction. Returns `start` itself if the slice would omit nothing, or would be too long.
fn append<S: Scalar>(f: &mut Function<S>, start: u32, changed: &[Operand]) -> u32 {
    let base = f.code.len();
    for deepest in [MAX_BRANCHES, 0] {
        let mut slice = Slice::forward(f, start as usize, changed.iter().copied().collect(), deepest);
        slice.backward(f);
        if !slice.omits_instructions(f) {
            return start;
        }
        let mut ops = Vec::new();
        slice.write(f, base, &mut ops);
        if base + ops.len() <= f.body as usize * (1 + MAX_GROWTH) {
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
    /// Whether each instruction on the path is in the slice.
    is_in_slice: Vec<bool>,
    /// The other arms of branches: the position of the branch in `path`, and the slice of the other arm. `None`
    /// stands for the whole code.
    other_arms: Vec<(usize, Option<Slice>)>,
    /// The instruction where the slice continues in the whole code.
    rest: Option<usize>,
}

impl Slice {
    /// Visits the path to the end and collects the instructions that depend on the changed registers. Up to
    /// `deepest` branches have both arms.
    fn forward<S: Scalar>(
        f: &Function<S>,
        mut at: usize,
        tainted: HashSet<Operand>,
        deepest: usize,
    ) -> Slice {
        let mut slice = Slice { tainted, path: vec![], is_in_slice: vec![], other_arms: vec![], rest: None };
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
                    slice.other_arms.push((slice.path.len(), other));
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
                        // The results of these sites are compared when they have run.
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
                    // A register that was written before with a changed value is written again here, even if
                    // this value is unchanged.
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

    fn take(&mut self, at: usize, is_in_slice: bool) {
        self.path.push(at);
        self.is_in_slice.push(is_in_slice);
    }

    /// Adds the instructions that compute the scratch values which the slice reads; these are valid up to the
    /// next site. Returns the scratch values that are needed where the slice begins, and whether all scratch
    /// values of the whole code are needed.
    fn backward<S: Scalar>(&mut self, f: &Function<S>) -> (HashSet<Operand>, bool) {
        let mut needed: HashSet<Operand> = HashSet::new();
        let mut all = self.rest.is_some();
        for i in (0..self.path.len()).rev() {
            let op = &f.code[self.path[i]];
            if let Op::Site { .. } = op {
                all = false;
            }
            let (mut reads, writes) = reads_and_writes(f, op);
            // The whole code needs all scratch values and nothing else: registers of the node are as they were.
            // A register that is written in several places must not be set back to the value of the first
            // place.
            let is_needed = |o: &Operand| needed.contains(o) || all && o.place() == Place::Scratch;
            self.is_in_slice[i] |= writes.iter().any(is_needed);
            match self.other_arms.iter_mut().find(|(place, _)| *place == i) {
                Some((_, Some(other))) => {
                    let theirs = other.backward(f);
                    needed.extend(theirs.0);
                    all |= theirs.1;
                }
                Some((_, None)) => all = true,
                None => {}
            }
            if self.is_in_slice[i] {
                if let Some(Op::Pass { site, arg }) = self.as_pass(f, op) {
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

    /// Whether the slice does less than the whole code.
    fn omits_instructions<S: Scalar>(&self, f: &Function<S>) -> bool {
        let passes = |(at, is_in_slice): (&usize, &bool)| {
            *is_in_slice
                && matches!(self.as_pass(f, &f.code[*at]), Some(Op::Pass { site, .. })
                    if f.sites[site.0 as usize].args.len > 1)
        };
        self.is_in_slice.contains(&false)
            || self.path.iter().zip(&self.is_in_slice).any(passes)
            || self
                .other_arms
                .iter()
                .any(|(_, other)| other.as_ref().is_some_and(|other| other.omits_instructions(f)))
    }

    /// Writes the slice's instructions, each with its original, from `base` on.
    fn write<S: Scalar>(&self, f: &Function<S>, base: usize, ops: &mut Vec<(Op, usize)>) {
        let mut branches = Vec::new();
        for (i, at) in self.path.iter().enumerate().filter(|(i, _)| self.is_in_slice[*i]) {
            if let Some((_, Some(other))) = self.other_arms.iter().find(|(place, _)| *place == i) {
                branches.push((ops.len(), other));
            }
            ops.push((self.as_pass(f, &f.code[*at]).unwrap_or(f.code[*at]), *at));
        }
        match (self.rest, self.path.last()) {
            (Some(rest), _) => ops.push((Op::Jump { target: rest as u32 }, rest)),
            (None, Some(last)) if !self.is_in_slice.last().copied().unwrap_or(false) => {
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

    /// The shorter form of a call if only one of its arguments may have changed.
    fn as_pass<S: Scalar>(&self, f: &Function<S>, op: &Op) -> Option<Op> {
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
    //! The claim: slices are as a person would write them by hand.
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
    fn a_slice_has_the_dependent_instructions_and_no_others() {
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
        // A change of the count runs neither the text of the key nor the other choice, but the observation and
        // the values that it reads.
        assert_eq!(has(f.sites[0].again), (false, false, true, true, true));
        // A change of the mean of the other choice runs that choice, and nothing else unless the choice
        // changes.
        assert_eq!(has(f.inputs[1]), (false, true, false, false, true));
    }
}

//! The flow of data and control: the registers that instructions read and write, their successors, and
//! liveness.

use super::function::Function;
use super::op::Op;
use super::operand::{Args, Operand, Place};
use super::site::SiteKind;
use niwaki_math::Scalar;

/// A set of registers of one class.
#[derive(Clone, PartialEq)]
pub(crate) struct Bits {
    of: Place,
    words: Vec<u64>,
}

impl Bits {
    pub(crate) fn empty(of: Place, n: usize) -> Self {
        Bits { of, words: vec![0; n.div_ceil(64)] }
    }
    pub(crate) fn set(&mut self, o: Operand) {
        if o.place() == self.of {
            self.words[o.index() / 64] |= 1 << (o.index() % 64);
        }
    }
    fn clear(&mut self, o: Operand) {
        if o.place() == self.of {
            self.words[o.index() / 64] &= !(1 << (o.index() % 64));
        }
    }
    pub(crate) fn has(&self, o: Operand) -> bool {
        o.place() == self.of && self.words[o.index() / 64] >> (o.index() % 64) & 1 == 1
    }
    pub(crate) fn join(&mut self, other: &Bits) {
        self.words.iter_mut().zip(&other.words).for_each(|(a, b)| *a |= b);
    }
    pub(crate) fn is_empty(&self) -> bool {
        self.words.iter().all(|word| *word == 0)
    }
}

/// The registers that an instruction reads, and the registers that it writes.
pub(crate) fn reads_and_writes<S: Scalar>(f: &Function<S>, op: &Op) -> (Vec<Operand>, Vec<Operand>) {
    let run = |a: Args| f.operands[a.range()].to_vec();
    match *op {
        Op::Move { to, from } => (vec![from], vec![to]),
        Op::Add { to, a, b }
        | Op::Sub { to, a, b }
        | Op::Mul { to, a, b }
        | Op::Div { to, a, b }
        | Op::Binary { to, a, b, .. } => (vec![a, b], vec![to]),
        Op::Neg { to, a } | Op::Not { to, a } | Op::Field { to, a, .. } | Op::Length { to, a } => {
            (vec![a], vec![to])
        }
        Op::Builtin { to, args, .. }
        | Op::List { to, args }
        | Op::Tuple { to, args }
        | Op::Dict { to, args }
        | Op::Record { to, args, .. }
        | Op::Closure { to, args, .. }
        | Op::Dist { to, args, .. }
        | Op::Host { to, args, .. }
        | Op::CallPure { to, args, .. } => (run(args), vec![to]),
        Op::Unpack { from, to } | Op::UnpackStar { from, to, .. } => (vec![from], run(to)),
        Op::Jump { .. } | Op::Clear { .. } | Op::Done => (vec![], vec![]),
        Op::Pass { site, arg } => {
            let args = f.sites[site.0 as usize].args;
            (vec![f.operands[args.start as usize + arg as usize]], vec![])
        }
        Op::JumpIf { a, .. } | Op::JumpUnless { a, .. } | Op::CheckSet { a, .. } | Op::Return { a } => {
            (vec![a], vec![])
        }
        Op::JumpUnlessCompare { a, b, .. } => (vec![a, b], vec![]),
        Op::Next { to, over, index, length, .. } => (vec![over, index, length], vec![to, index]),
        Op::Assert { a, message } => (vec![a, message], vec![]),
        Op::ReturnIteration { args, .. } => (run(args), vec![]),
        Op::Site { site } => {
            let s = &f.sites[site.0 as usize];
            let (mut reads, mut writes) = (run(s.args), vec![s.to]);
            if let SiteKind::Loop(l) = &s.kind {
                reads.extend(l.over.into_iter().chain(run(l.carried)).chain(run(l.captures)));
                writes.extend(run(l.out).into_iter().chain(l.exit.into_iter().flat_map(|(a, b)| [a, b])));
            }
            if let SiteKind::Cell { content } | SiteKind::Append { content } = s.kind {
                writes.push(content);
            }
            (reads, writes)
        }
    }
}

/// The instructions that may follow the instruction at `at`.
pub(crate) fn successors(op: &Op, at: usize) -> (Option<usize>, Option<usize>) {
    match *op {
        Op::Jump { target } => (Some(target as usize), None),
        Op::JumpIf { target, .. }
        | Op::JumpUnless { target, .. }
        | Op::JumpUnlessCompare { target, .. }
        | Op::Next { target, .. } => (Some(at + 1), Some(target as usize)),
        Op::Return { .. } | Op::ReturnIteration { .. } | Op::Done => (None, None),
        _ => (Some(at + 1), None),
    }
}

/// The registers of one class that are live before each instruction, and before the end. The class has
/// `registers` registers.
pub(crate) fn live_before<S: Scalar>(f: &Function<S>, of: Place, registers: usize) -> Vec<Bits> {
    let effects: Vec<_> = f
        .code
        .iter()
        .map(|op| {
            let (mut reads, writes) = reads_and_writes(f, op);
            if let Op::Site { site } = op {
                reads.extend(f.scope.iter().filter(|x| x.site == *site).map(|x| x.at));
            }
            (reads, writes)
        })
        .collect();
    let mut before = vec![Bits::empty(of, registers); f.code.len() + 1];
    loop {
        let mut changed = false;
        for at in (0..f.code.len()).rev() {
            let mut live = after(f, &before, at);
            effects[at].1.iter().for_each(|w| live.clear(*w));
            effects[at].0.iter().for_each(|r| live.set(*r));
            changed |= live != before[at];
            before[at] = live;
        }
        if !changed {
            return before;
        }
    }
}

/// The registers that are live after an instruction.
pub(crate) fn after<S: Scalar>(f: &Function<S>, before: &[Bits], at: usize) -> Bits {
    let mut live = Bits { of: before[at].of, words: vec![0; before[at].words.len()] };
    let (first, second) = successors(&f.code[at], at);
    first.into_iter().chain(second).for_each(|next| live.join(&before[next]));
    live
}

impl<S: Scalar> Function<S> {
    /// The registers and constants that an instruction reads.
    pub fn reads(&self, op: &Op) -> Vec<Operand> {
        reads_and_writes(self, op).0
    }
}

//! Where each register is stored, by liveness on bytecode.
//!
//! Only what is needed after a suspension site is in the node, with the results of sites and the arguments that
//! are read again ([`SiteKind::is_read_again`]). Everything else is scratch.
//! Instructions without effect are dropped, and futures whose handle is never read are marked.

use crate::builtins::builtin_id;
use crate::code::{Args, Function, Mode, Op, Operand, Place, SiteKind};
use niwaki_math::Scalar;

/// A set of registers of one class.
#[derive(Clone, PartialEq)]
pub(crate) struct Bits {
    of: Place,
    words: Vec<u64>,
}

impl Bits {
    fn empty(of: Place, n: usize) -> Self {
        Bits { of, words: vec![0; n.div_ceil(64)] }
    }
    fn set(&mut self, o: Operand) {
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
    fn join(&mut self, other: &Bits) {
        self.words.iter_mut().zip(&other.words).for_each(|(a, b)| *a |= b);
    }
    pub(crate) fn is_empty(&self) -> bool {
        self.words.iter().all(|word| *word == 0)
    }
}

/// The registers that an instruction reads, and those that it writes.
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

/// The instructions that may follow the one at `at`.
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

/// Which of the `registers` registers of one class are live before each instruction, and before the end.
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

/// What is live after an instruction.
fn after<S: Scalar>(f: &Function<S>, before: &[Bits], at: usize) -> Bits {
    let mut live = Bits { of: before[at].of, words: vec![0; before[at].words.len()] };
    let (one, two) = successors(&f.code[at], at);
    one.into_iter().chain(two).for_each(|next| live.join(&before[next]));
    live
}

/// What is live after each instruction, of virtual registers.
fn live_after<S: Scalar>(f: &Function<S>, registers: usize) -> Vec<Bits> {
    let before = live_before(f, Place::Node, registers);
    (0..f.code.len()).map(|at| after(f, &before, at)).collect()
}

/// Chooses places for the `registers` virtual registers of a function.
pub(crate) fn place<S: Scalar>(f: &mut Function<S>, registers: usize) {
    drop_dead(f, registers);
    let inputs = f.params as usize + f.captures as usize;
    let pure = f.mode == Mode::Pure;
    let mut node = Bits::empty(Place::Node, registers);
    if !pure {
        (0..inputs).for_each(|i| node.set(Operand::new(Place::Node, i)));
        f.scope.iter().for_each(|x| node.set(x.at));
        let after = live_after(f, registers);
        for (at, op) in f.code.iter().enumerate() {
            let Op::Site { site } = *op else { continue };
            node.join(&after[at]);
            let s = f.sites[site.0 as usize].clone();
            reads_and_writes(f, op).1.into_iter().for_each(|w| node.set(w));
            if s.kind.is_read_again() {
                f.operands[s.args.range()].iter().for_each(|o| node.set(*o));
            }
            // What a loop iterates over is kept: it need not be computed again to see that it is the same.
            if let SiteKind::Loop(l) = &s.kind {
                l.over.into_iter().for_each(|over| node.set(over));
            }
            let unread = !after[at].has(s.to);
            f.sites[site.0 as usize].is_read = !unread;
            match &mut f.sites[site.0 as usize].kind {
                SiteKind::Future { detached, .. } | SiteKind::FutureApply { detached } => *detached = unread,
                _ => {}
            }
        }
    }
    let (mut nodes, mut scratch) = (0, 0);
    let map: Vec<Operand> = (0..registers)
        .map(|i| {
            let (place, count) = if node.has(Operand::new(Place::Node, i)) {
                (Place::Node, &mut nodes)
            } else {
                (Place::Scratch, &mut scratch)
            };
            *count += 1;
            Operand::new(place, *count - 1)
        })
        .collect();
    f.node_registers = nodes as u16;
    f.scratch_registers = scratch as u16;
    for (at, op) in f.code.iter().enumerate() {
        if let Op::Site { site } = *op {
            let s = &mut f.sites[site.0 as usize];
            s.next = at as u32 + 1;
            s.is_tail = f.mode == Mode::Node && returns(&f.code, at + 1, s.to);
        }
    }
    rewrite(f, |o| if o.place() == Place::Node { map[o.index()] } else { o });
}

/// Whether an activation that continues at an instruction returns at once, with that register or with a constant.
fn returns(code: &[Op], mut at: usize, result: Operand) -> bool {
    // Jumps do not go round in circles without a loop's test between them, but that is not known here.
    for _ in 0..code.len() {
        match code.get(at) {
            Some(Op::Jump { target }) => at = *target as usize,
            Some(Op::Return { a }) => return *a == result || a.place() == Place::Constant,
            _ => return false,
        }
    }
    false
}

/// Removes moves into registers that are never read, and clearing of no sites; of a `look` that is never read its faults
/// remain. A jump to the next instruction costs a
/// step of the interpreter, so they are removed and the jumps adjusted.
fn drop_dead<S: Scalar>(f: &mut Function<S>, registers: usize) {
    let (look, check) = (builtin_id("look"), builtin_id("check_look"));
    loop {
        let after = live_after(f, registers);
        let dead = |at: usize, op: &Op| match op {
            Op::Move { to, .. } => !after[at].has(*to),
            Op::Clear { from, to } => from >= to,
            _ => false,
        };
        let keep: Vec<bool> = f.code.iter().enumerate().map(|(at, op)| !dead(at, op)).collect();
        for (op, after) in f.code.iter_mut().zip(&after) {
            if let Op::Builtin { to, id, .. } = op
                && Some(*id) == look
                && !after.has(*to)
            {
                *id = check.unwrap_or(*id);
            }
        }
        if keep.iter().all(|k| *k) {
            return;
        }
        let mut new_at: Vec<u32> = Vec::with_capacity(keep.len() + 1);
        let mut count = 0;
        for k in &keep {
            new_at.push(count);
            count += u32::from(*k);
        }
        new_at.push(count);
        let mut kept = keep.iter();
        f.code.retain(|_| *kept.next().unwrap_or(&true));
        let mut kept = keep.iter();
        f.spans.retain(|_| *kept.next().unwrap_or(&true));
        for op in &mut f.code {
            if let Op::Jump { target }
            | Op::JumpIf { target, .. }
            | Op::JumpUnless { target, .. }
            | Op::JumpUnlessCompare { target, .. }
            | Op::Next { target, .. } = op
            {
                *target = new_at[*target as usize];
            }
        }
    }
}

/// Moves every register to its place.
pub(crate) fn rewrite<S: Scalar>(f: &mut Function<S>, map: impl Fn(Operand) -> Operand) {
    f.operands.iter_mut().for_each(|o| *o = map(*o));
    for o in &mut f.defaults {
        // Defaults name captured inputs, whose numbers are the same in either place.
        *o = map(*o);
    }
    f.scope.iter_mut().for_each(|x| x.at = map(x.at));
    for s in &mut f.sites {
        s.to = map(s.to);
        if let SiteKind::Loop(l) = &mut s.kind {
            l.over = l.over.map(&map);
            l.exit = l.exit.map(|(a, b)| (map(a), map(b)));
        }
        if let SiteKind::Cell { content } | SiteKind::Append { content } = &mut s.kind {
            *content = map(*content);
        }
    }
    for op in &mut f.code {
        match op {
            Op::Move { to, from } => (*to, *from) = (map(*to), map(*from)),
            Op::Add { to, a, b }
            | Op::Sub { to, a, b }
            | Op::Mul { to, a, b }
            | Op::Div { to, a, b }
            | Op::Binary { to, a, b, .. } => (*to, *a, *b) = (map(*to), map(*a), map(*b)),
            Op::Neg { to, a } | Op::Not { to, a } | Op::Field { to, a, .. } | Op::Length { to, a } => {
                (*to, *a) = (map(*to), map(*a));
            }
            Op::Builtin { to, .. }
            | Op::List { to, .. }
            | Op::Tuple { to, .. }
            | Op::Dict { to, .. }
            | Op::Record { to, .. }
            | Op::Closure { to, .. }
            | Op::Dist { to, .. }
            | Op::Host { to, .. }
            | Op::CallPure { to, .. } => *to = map(*to),
            Op::Unpack { from, .. } | Op::UnpackStar { from, .. } => *from = map(*from),
            Op::JumpIf { a, .. } | Op::JumpUnless { a, .. } | Op::CheckSet { a, .. } | Op::Return { a } => {
                *a = map(*a)
            }
            Op::JumpUnlessCompare { a, b, .. } => (*a, *b) = (map(*a), map(*b)),
            Op::Next { to, over, index, length, .. } => {
                (*to, *over, *index, *length) = (map(*to), map(*over), map(*index), map(*length));
            }
            Op::Assert { a, message } => (*a, *message) = (map(*a), map(*message)),
            Op::Jump { .. }
            | Op::ReturnIteration { .. }
            | Op::Site { .. }
            | Op::Clear { .. }
            | Op::Pass { .. }
            | Op::Done => {}
        }
    }
}

//! The place of each register, chosen by liveness on bytecode.
//!
//! A node contains the values that are needed after a suspension site, the results of sites, and the arguments
//! that are read again ([`SiteKind::is_read_again`]). All other values are scratch. The pass also drops
//! instructions without effect, and marks futures whose handle is never read.

use crate::builtins::builtin_id;
use crate::code::flow::{Bits, after, live_before, reads_and_writes};
use crate::code::{Function, Mode, Op, Operand, Place, SiteKind};
use niwaki_math::Scalar;

/// The virtual registers that are live after each instruction.
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
            // The sequence of a loop is kept, so that its identity can be tested without computing it again.
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

/// Whether an activation that continues at an instruction returns at once, with the register `result` or with a
/// constant.
fn returns(code: &[Op], mut at: usize, result: Operand) -> bool {
    // Jumps do not form circles without a loop's test, but this function does not know that.
    for _ in 0..code.len() {
        match code.get(at) {
            Some(Op::Jump { target }) => at = *target as usize,
            Some(Op::Return { a }) => return *a == result || a.place() == Place::Constant,
            _ => return false,
        }
    }
    false
}

/// Removes moves into registers that are never read, and instructions that clear no sites. A `look` whose
/// result is never read keeps only its checks. A jump to the next instruction would cost a step of the
/// interpreter, so jumps are adjusted.
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
        // Defaults refer to captured inputs, which have the same numbers in both places.
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

//! The verifier: checks the properties that the machine relies on, once for each program.
//!
//! * Every operand lies within its function's registers, constants or captures, and every jump within the code.
//! * Instructions end in a return.
//! * Sites belong to functions that may suspend, and each site belongs to one instruction.
//! * A register that other activations may have overwritten is never read, and a register that was read is not
//!   overwritten.
//! * A slice that writes a register of the node also has the instructions of its path that write it later.

use super::flow::{live_before, reads_and_writes, successors};
use super::{Function, Mode, Op, Operand, Place, Program, SiteKind};
use niwaki_math::Scalar;
use std::collections::HashSet;

/// A program that the machine must not run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerifyError {
    /// The name of the function.
    pub function: String,
    /// The number of the instruction.
    pub at: usize,
    /// The description of the violation.
    pub message: String,
}

impl std::fmt::Display for VerifyError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} at {}: {}", self.function, self.at, self.message)
    }
}

/// Checks a whole program.
///
/// # Errors
/// The first violation.
pub fn verify<S: Scalar>(program: &Program<S>) -> Result<(), VerifyError> {
    for f in &program.functions {
        let outer = outer_registers(program, f);
        function(program, f, outer)?;
    }
    Ok(())
}

/// The number of registers of the loop node above an iteration.
fn outer_registers<S: Scalar>(program: &Program<S>, f: &Function<S>) -> usize {
    let loops = program.functions.iter().flat_map(|g| &g.sites).filter_map(|s| match &s.kind {
        SiteKind::Loop(l) => Some(l),
        _ => None,
    });
    for l in loops {
        if std::ptr::eq(program.function(l.body), f) {
            return program.function(l.header).node_registers as usize;
        }
    }
    0
}

fn function<S: Scalar>(program: &Program<S>, f: &Function<S>, outer: usize) -> Result<(), VerifyError> {
    let fail = |at: usize, message: &str| {
        Err(VerifyError { function: f.name.to_string(), at, message: message.to_string() })
    };
    if f.mode == Mode::Loop {
        return Ok(());
    }
    let fits = |o: Operand| {
        o.index()
            < match o.place() {
                Place::Node => f.node_registers as usize,
                Place::Scratch => f.scratch_registers as usize,
                Place::Constant => f.constants.len(),
                Place::Outer => outer,
            }
    };
    let mut seen = vec![false; f.sites.len()];
    for (at, op) in f.code.iter().enumerate() {
        if let (Op::Site { site }, true) = (*op, at < f.body as usize) {
            let Some(seen) = seen.get_mut(site.0 as usize) else { return fail(at, "no such site") };
            if std::mem::replace(seen, true) {
                return fail(at, "a site at two places");
            }
            if f.mode == Mode::Pure {
                return fail(at, "a site in a pure function");
            }
            if f.sites[site.0 as usize].next as usize != at + 1 {
                return fail(at, "a site that returns elsewhere");
            }
        }
        let (reads, writes) = reads_and_writes(f, op);
        if matches!(op, Op::Site { .. }) && !writes.iter().all(|o| o.place() == Place::Node) {
            return fail(at, "a site's results must be in the node");
        }
        if !reads.iter().chain(&writes).all(|o| fits(*o)) {
            return fail(at, "an operand out of range");
        }
        if !writes.iter().all(|o| o.is_register()) {
            return fail(at, "a write to something that is no register");
        }
        match *op {
            Op::Done | Op::Pass { .. } if at < f.body as usize => return fail(at, "a slice's end elsewhere"),
            Op::Pass { site, .. } | Op::Site { site } if site.0 as usize >= f.sites.len() => {
                return fail(at, "no such site");
            }
            Op::Jump { target }
            | Op::JumpIf { target, .. }
            | Op::JumpUnless { target, .. }
            | Op::JumpUnlessCompare { target, .. }
            | Op::Next { target, .. }
                if target as usize >= f.code.len() =>
            {
                return fail(at, "a jump out of the function");
            }
            Op::CallPure { function, args, .. } => {
                let Some(callee) = program.functions.get(function as usize) else {
                    return fail(at, "no such function");
                };
                if callee.mode != Mode::Pure || callee.params + callee.captures != args.len {
                    return fail(at, "a pure call that does not fit its function");
                }
            }
            Op::Clear { to, .. } if to as usize > f.sites.len() => return fail(at, "no such site"),
            Op::Return { .. } if f.mode == Mode::Iteration => {
                return fail(at, "a plain return in an iteration");
            }
            Op::ReturnIteration { .. } if f.mode != Mode::Iteration => {
                return fail(at, "an iteration's return elsewhere");
            }
            _ => {}
        }
    }
    if !f.scope.iter().all(|x| fits(x.at) && x.at.place() != Place::Scratch) {
        return fail(0, "a variable to keep that is not kept");
    }
    let starts = f.sites.iter().map(|site| site.again).chain(f.inputs.iter().chain(&f.outers).copied());
    if starts.into_iter().any(|start| start as usize >= f.code.len()) {
        return fail(f.code.len(), "no such slice");
    }
    if f.mode != Mode::Pure
        && let Some(at) = stale_scratch_read(f)
    {
        return fail(at, "scratch registers are not kept from one run of an activation to the next");
    }
    if f.mode != Mode::Pure
        && let Some(at) = read_before_overwrite(f)
    {
        return fail(at, "a register of the node is read and assigned again");
    }
    let inputs = f.inputs.iter().chain(&f.outers).map(|slice| (*slice, 0));
    let mut slices = inputs.chain(f.sites.iter().map(|site| (site.again, site.next)));
    let wrong =
        slices.find_map(|(slice, whole)| departure(f, slice as usize, whole as usize, HashSet::new()));
    if let Some(at) = wrong {
        return fail(at, "a slice departs from the code, or sets a register of the node back");
    }
    // Slices end like the code, or with `Done`.
    match (f.code.get((f.body as usize).wrapping_sub(1)), f.code.last()) {
        (
            Some(Op::Return { .. } | Op::ReturnIteration { .. } | Op::Jump { .. }),
            Some(Op::Return { .. } | Op::ReturnIteration { .. } | Op::Jump { .. } | Op::Done),
        ) => Ok(()),
        _ => fail(f.code.len(), "control can run off the end"),
    }
}

/// Finds an instruction at which an activation can be entered while a scratch register is live, or a site with
/// a scratch argument that is read when its activation does not run.
///
/// The machine enters an activation at its start, and after each site: when a call returns, when a pause ends,
/// and when the run of a changed choice begins. It also enters slices that replace these places, sites that are
/// repeated, and the instruction after a skipped call. Other activations have used the same scratch registers
/// before.
fn stale_scratch_read<S: Scalar>(f: &Function<S>) -> Option<usize> {
    let live = live_before(f, Place::Scratch, f.scratch_registers as usize);
    let entries = [0].into_iter().chain(f.sites.iter().flat_map(|site| [site.next, site.again]));
    let mut entries: Vec<usize> =
        entries.chain(f.inputs.iter().chain(&f.outers).copied()).map(|at| at as usize).collect();
    for (at, op) in f.code.iter().enumerate() {
        match *op {
            Op::Site { site } => {
                let site = &f.sites[site.0 as usize];
                let args = &f.operands[site.args.range()];
                if site.kind.is_read_again() && args.iter().any(|o| o.place() == Place::Scratch) {
                    return Some(at);
                }
                entries.extend([at + 1, site.resumes_at(at)]);
            }
            Op::Pass { .. } => entries.push(at + 1),
            _ => {}
        }
    }
    entries.into_iter().find(|at| !live[*at].is_empty())
}

/// Finds an instruction that reads a register of the node to which the instruction itself or a later one
/// writes.
///
/// The registers of an activation that is entered again hold the values that were written last. If a slice
/// omits the first of two assignments, an instruction between them would read the second.
fn read_before_overwrite<S: Scalar>(f: &Function<S>) -> Option<usize> {
    let body = f.body as usize;
    let mut written: Vec<HashSet<Operand>> = vec![HashSet::new(); body + 1];
    for at in (0..body).rev() {
        let (reads, writes) = reads_and_writes(f, &f.code[at]);
        let (first, second) = successors(&f.code[at], at);
        // Loops that are not sites have no registers in the node, so backward jumps do not matter.
        let mut later: HashSet<Operand> = writes.into_iter().filter(|o| o.is_node()).collect();
        for next in first.into_iter().chain(second).filter(|next| *next > at) {
            later.extend(&written[next]);
        }
        if reads.iter().any(|o| later.contains(o)) {
            return Some(at);
        }
        written[at] = later;
    }
    None
}

/// Finds where a slice departs from the path of the code from `whole` on. A slice departs with an instruction
/// that is not next on the path, or if it omits a branch. It also departs if it omits an instruction that
/// writes a register of the node which the slice has `written` before: the last writer of a register must be
/// the same as on the path.
fn departure<S: Scalar>(
    f: &Function<S>,
    mut slice: usize,
    mut whole: usize,
    mut written: HashSet<Operand>,
) -> Option<usize> {
    let body = f.body as usize;
    while slice >= body {
        let (Some(op), Some(original)) = (f.code.get(slice), f.code[..body].get(whole)) else {
            return Some(slice);
        };
        let (next, other) = successors(original, whole);
        let is_last = next.is_none();
        match *original {
            // From here on the slice uses the whole code.
            _ if matches!(*op, Op::Jump { target } if target as usize == whole) => return None,
            Op::Jump { target } if target as usize > whole => {
                whole = target as usize;
                continue;
            }
            _ => {}
        }
        let (_, writes) = reads_and_writes(f, original);
        if f.spans[slice] == f.spans[whole] && is_copy(f, op, original) {
            if let (Some(mine), Some(theirs)) = (successors(op, slice).1, other)
                && let Some(at) = departure(f, mine, theirs, written.clone())
            {
                return Some(at);
            }
            written.extend(writes.into_iter().filter(|o| o.is_node()));
            slice += 1;
        } else if other.is_some()
            || matches!(original, Op::Jump { .. })
            || is_last && *op != Op::Done
            || writes.iter().any(|o| written.contains(o))
        {
            return Some(slice);
        }
        if is_last {
            return None;
        }
        whole += 1;
    }
    (slice != whole).then_some(slice)
}

/// Whether an instruction of a slice is a copy of an instruction of the code. The targets of branches may
/// differ, and a call may become one with a single changed argument.
fn is_copy<S: Scalar>(f: &Function<S>, op: &Op, original: &Op) -> bool {
    match (*op, *original) {
        (Op::Pass { site: mine, .. }, Op::Site { site }) => mine == site,
        (Op::JumpIf { .. }, Op::JumpIf { .. })
        | (Op::JumpUnless { .. }, Op::JumpUnless { .. })
        | (Op::JumpUnlessCompare { .. }, Op::JumpUnlessCompare { .. }) => f.reads(op) == f.reads(original),
        _ => op == original,
    }
}

#[cfg(test)]
mod tests {
    //! The claim: the verifier refuses every read of a scratch value that may be overwritten, and every slice
    //! that leaves another value in a register of the node than the whole code would.
    use super::*;
    use crate::core::parse::parse;
    use crate::passes::{compile, place::rewrite};

    /// Every kind of site.
    const TEXT: &str = r#"(module (const 0 (list (dist bernoulli 0.4) (dist bernoulli 0.6)))
      (fn "leaf" (params $k) (do (factor (mul -0.1 $k))) (return $k))
      (fn "arm" (params $x) (captures $s) (return (add $x (sample (dist gaussian $s 1.0)))))
      (fn "m" (params $n)
        (set $a (sample (dist gaussian (mul $n 0.5) (add $n 1.0))))
        (set $d (cond (gt $a 0.0) (dist gaussian $a 1.0) (dist uniform 0.0 2.0)))
        (set $b (sample $d))
        (set $c (sample (index (data 0) (mod $n 2))))
        (do (observe (dist gaussian $b 1.0) (mul $a 0.1)))
        (do (observe $d (add $b 0.0)))
        (do (observe (index (data 0) (mod $n 2)) $c))
        (do (condition (gt (add $a 9.0) 0.0)))
        (do (query (add $n 1) (mul $b 2.0)))
        (do (emit (box (tuple 0.0 $a 0.0) (tuple 1.0 1.0 1.0))))
        (set $f (closure "arm" (mul $b 3.0)))
        (set $e (apply $f (add $b 1.0)))
        (set $g (cond $c (future "leaf" (add $n 2)) none))
        (set $h (future_apply $f (add $n 3)))
        (set $xs (list (mul $e 2.0) 0.5))
        (for $i (range (add $n 3)) (body
          (set $y (sample (dist gaussian (index $xs -1) 1.0)))
          (if (gt $y 9.0) (then (return none)))
          (set $e (add $e $y))
          (set $xs (append $xs (mul $y 0.5)))))
        (set $k (add (force $g) (force (index (tuple $h $e) 0))))
        (do (call "leaf" (mul $k 0.1)))
        (return (tuple $e $xs $k)))
      (entry "m"))"#;

    #[test]
    fn a_force_of_a_scratch_register_is_refused() {
        let mut program = compile::<f64>(&parse(TEXT).unwrap(), vec![]).unwrap();
        let f = &mut program.functions[2];
        let forces = f.sites.iter().filter(|site| site.kind == SiteKind::Force);
        let forced: Vec<Operand> = forces.map(|site| f.operands[site.args.range()][0]).collect();
        assert_eq!(forced.len(), 2);
        assert_eq!(verify(&program), Ok(()));
        for operand in forced {
            assert!(refused(&program, 2, operand));
        }
    }

    /// Whether the verifier refuses a program after a register of the node becomes a register of the machine.
    fn refused(program: &Program, number: usize, register: Operand) -> bool {
        let mut moved = program.clone();
        let f = &mut moved.functions[number];
        let to = Operand::new(Place::Scratch, f.scratch_registers as usize);
        f.scratch_registers += 1;
        rewrite(f, |o| if o == register { to } else { o });
        verify(&moved).is_err()
    }

    #[test]
    fn no_register_of_a_node_can_be_a_scratch_register() {
        let program = compile::<f64>(&parse(TEXT).unwrap(), vec![]).unwrap();
        let mut kinds = std::collections::HashSet::new();
        for (number, f) in program.functions.iter().enumerate() {
            if matches!(f.mode, Mode::Pure | Mode::Loop) {
                continue;
            }
            kinds.extend(f.sites.iter().map(|site| {
                let source = match &site.kind {
                    SiteKind::Sample(source) | SiteKind::Observe(source) => {
                        Some(std::mem::discriminant(source))
                    }
                    _ => None,
                };
                (std::mem::discriminant(&site.kind), source)
            }));
            // The sequence of a loop is in the node for speed.
            let over: Vec<Operand> = f
                .sites
                .iter()
                .filter_map(|site| match &site.kind {
                    SiteKind::Loop(l) => l.over,
                    _ => None,
                })
                .collect();
            for i in usize::from(f.params + f.captures)..usize::from(f.node_registers) {
                let register = Operand::new(Place::Node, i);
                assert!(
                    over.contains(&register) || refused(&program, number, register),
                    "{} {register:?}\n{}",
                    f.name,
                    crate::code::disassemble(&program)
                );
            }
        }
        assert_eq!(kinds.len(), 19, "every kind of site, and every source of a distribution");
    }

    #[test]
    fn a_slice_that_leaves_out_the_last_writer_is_refused() {
        let text = r#"(module (fn "m" (params $n)
            (set $a (sample (dist gaussian 0.0 1.0)))
            (set $p (mul $a 2.0))
            (set $q (sub $n 1.0))
            (do (sample (dist bernoulli 0.5)))
            (do (factor (mul $p $n)))
            (return $q)) (entry "m"))"#;
        let mut program = compile::<f64>(&parse(text).unwrap(), vec![]).unwrap();
        let f = &mut program.functions[0];
        let body = f.body as usize;
        let writer = |name| {
            let at = f.code[..body].iter().position(|op| format!("{op:?}").contains(name)).unwrap();
            reads_and_writes(f, &f.code[at]).1[0]
        };
        let (p, q) = (writer("Mul"), writer("Sub"));
        assert!(p.is_node() && q.is_node() && f.sites[0].again as usize >= body);
        assert_eq!(verify(&program), Ok(()));
        // The change is as if both were one variable: the slice after the choice has its first assignment, but
        // not the last.
        rewrite(&mut program.functions[0], |o| if o == q { p } else { o });
        assert!(
            verify(&program).is_err_and(|error| error.message.contains("sets a register of the node back"))
        );
    }

    #[test]
    fn a_test_of_an_overwritten_register_is_refused() {
        let text = r#"(module (fn "m" (params)
            (set $b (sample (dist bernoulli 0.6)))
            (set $c (or (sample (dist bernoulli 0.3)) $b))
            (do (factor -0.1)) (return $c)) (entry "m"))"#;
        let mut program = compile::<f64>(&parse(text).unwrap(), vec![]).unwrap();
        assert_eq!(verify(&program), Ok(()));
        let code = &mut program.functions[0].code;
        let at = code.iter().position(|op| matches!(op, Op::JumpIf { .. })).unwrap();
        let Op::Move { to, .. } = code[at - 1] else { panic!("the first operand is moved") };
        let Op::JumpIf { a, .. } = &mut code[at] else { unreachable!() };
        assert_ne!(*a, to);
        *a = to;
        assert!(verify(&program).is_err_and(|error| error.message.contains("assigned again")));
    }
}

//! The verifier: what the machine relies on, checked once for each program.
//!
//! Every operand lies within its function's registers, constants or captures; every jump within the code;
//! instructions end in a return; sites belong to functions that may suspend; each site stands at one place.

use super::{Function, Mode, Op, Operand, Place, Program, SiteKind};
use crate::passes::reads_and_writes;
use niwaki_math::Scalar;

/// A program that the machine must not run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerifyError {
    /// Function.
    pub function: String,
    /// Instruction.
    pub at: usize,
    /// What is wrong.
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

/// Registers of the loop node above an iteration.
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
            if f.sites[site.0 as usize].to.place() != Place::Node {
                return fail(at, "a site's result must live in the node");
            }
        }
        let (reads, writes) = reads_and_writes(f, op);
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
    let starts = f.sites.iter().map(|site| site.again).chain(f.inputs.iter().chain(&f.outers).copied());
    if starts.into_iter().any(|start| start as usize >= f.code.len()) {
        return fail(f.code.len(), "no such slice");
    }
    // Slices end as the code does, or by being done.
    match (f.code.get((f.body as usize).wrapping_sub(1)), f.code.last()) {
        (
            Some(Op::Return { .. } | Op::ReturnIteration { .. } | Op::Jump { .. }),
            Some(Op::Return { .. } | Op::ReturnIteration { .. } | Op::Jump { .. } | Op::Done),
        ) => Ok(()),
        _ => fail(f.code.len(), "control can run off the end"),
    }
}

//! What every run that has an `infer` inside keeps to, whichever method the `infer` has: limits, and faults.

use crate::Failure;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Limits;

/// How many `infer` may be inside one another. Each takes some of the host's stack.
const DEPTH: usize = 16;

/// Bytes that the runs of an `infer` have at least, so that many inside one another end by their depth.
const SMALLEST: usize = 1 << 20;

/// What an `infer` does, as far as a recorded run needs to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// It visits all runs, at most so many: its result has a derivative.
    Enumeration {
        /// Most runs.
        max_runs: usize,
    },
    /// It draws random numbers.
    Random,
}

/// The limits of the runs of an `infer` inside of a run with these limits, itself inside of so many.
///
/// # Errors
/// Too many are inside one another.
pub fn limits_inside(limits: Limits, depth: usize) -> Result<Limits, Fault> {
    if depth == DEPTH {
        return Err(Fault::new("infer-failed", format!("more than {DEPTH} `infer` are inside one another")));
    }
    let bytes = (limits.bytes / 4).clamp(SMALLEST.min(limits.bytes), limits.bytes);
    Ok(Limits { bytes, ..limits })
}

/// The fault of a run whose inferences took more steps than it may take, with those of the model `name` inside.
pub fn too_long(name: &str, steps: u64) -> Fault {
    let message = format!("with the runs of `infer` of `{name}` the model took more than {steps} steps");
    Fault::new("step-budget", message).with_help("search with fewer runs inside, or raise `max_steps`")
}

/// The failure of an inner search as a fault of the run around it.
pub fn fault_of(name: &str, failure: Failure) -> Fault {
    match failure {
        Failure::Run(inner) => {
            let line = inner.stack.last().map_or(0, |call| call.span.line);
            let message = format!("inside `infer` of `{name}`, at line {line}: {}", inner.fault.message);
            // What all of its runs meet, the run around it meets.
            let fault = Fault::new(inner.fault.code, message).caused_by(&inner.fault);
            match &inner.fault.help {
                Some(help) => fault.with_help(help.clone()),
                None => fault,
            }
        }
        Failure::Setting(fault) if fault.code == "wrong-arity" => fault,
        Failure::Setting(fault) => {
            Fault::new("infer-failed", format!("`infer` of `{name}`: {}", fault.message))
        }
        Failure::Impossible { causes, .. } | Failure::NoStart { causes, .. } => {
            let causes: Vec<String> = causes.iter().map(|(cause, n)| format!("{cause} ({n})")).collect();
            let causes = if causes.is_empty() { String::new() } else { format!(": {}", causes.join(", ")) };
            Fault::new("infer-failed", format!("every run of `{name}` is impossible{causes}"))
        }
    }
}

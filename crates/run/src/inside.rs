//! Limits and faults of nested inference, the same for every method of the inner `infer`.

use crate::Failure;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Limits;

/// The deepest nesting of `infer`. Each level uses the stack of the host.
const DEPTH: usize = 16;

/// The smallest memory budget of the runs of an `infer`, so that deep nesting ends at its depth limit.
const SMALLEST: usize = 1 << 20;

/// The kind of an `infer`, for recorded runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// The inference enumerates all runs, so its result has a derivative.
    Enumeration {
        /// The most runs.
        max_runs: usize,
    },
    /// The inference draws random numbers.
    Random,
}

/// The limits of the runs of an `infer` inside a run with these limits. `depth` is the nesting of the outer run.
///
/// # Errors
/// Too deep a nesting.
pub fn limits_inside(limits: Limits, depth: usize) -> Result<Limits, Fault> {
    if depth == DEPTH {
        return Err(Fault::new("infer-failed", format!("more than {DEPTH} `infer` are inside one another")));
    }
    let bytes = (limits.bytes / 4).clamp(SMALLEST.min(limits.bytes), limits.bytes);
    Ok(Limits { bytes, ..limits })
}

/// The fault of a run that exceeds its step budget together with the runs of the inner model `name`.
pub fn too_long(name: &str, steps: u64) -> Fault {
    let message = format!("with the runs of `infer` of `{name}` the model took more than {steps} steps");
    Fault::new("step-budget", message).with_help("search with fewer runs inside, or raise `max_steps`")
}

/// Convert the failure of an inner search to a fault of the outer run.
pub fn fault_of(name: &str, failure: Failure) -> Fault {
    match failure {
        Failure::Run(inner) => {
            let line = inner.stack.last().map_or(0, |call| call.span.line);
            let message = format!("inside `infer` of `{name}`, at line {line}: {}", inner.fault.message);
            // A fault of all inner runs is a fault of the outer run.
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

//! Core form to bytecode, in eight steps:
//!
//! 1. [`effects`]: the functions that can suspend (the others are pure);
//! 2. `frames`: the frames of placed calls, as captures;
//! 3. [`collections`]: the lists that hold references to their elements;
//! 4. [`liveness`]: the variables that a loop must pass from one iteration to the next;
//! 5. `emit`, `expressions`, `sites`, `statements`: one pass over each function. It uses static single
//!    assignment, with merges written by each arm; loops that can suspend are *lifted* into functions of their
//!    own;
//! 6. `place`: the registers that are in the node, and the scratch registers, by liveness on bytecode;
//! 7. `slices`: the instructions that one changed value can reach;
//! 8. `angles`: the values that are angles, for readers at choices.

mod angles;
pub mod collections;
pub mod effects;
mod emit;
mod expressions;
mod frames;
pub mod liveness;
pub(crate) mod place;
mod scope;
mod sites;
mod slices;
mod statements;

use crate::code::{Function, FunctionId, Mode, Program, verify};
use crate::core::deep::with_stack;
use crate::core::visit::each_stmt;
use crate::core::{Expr, ExprKind, Literal, Module, Name, PLACE};
use crate::fault::Fault;
use crate::native::entries_of;
use crate::value::Value;
use collections::Collections;
use effects::Effects;
use emit::Builder;
use niwaki_math::Scalar;
use std::any::TypeId;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

pub use scope::Scope;

/// A model that cannot be compiled: a defect of the text or a limit of the machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CompileError(pub String);

impl std::fmt::Display for CompileError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.0)
    }
}

impl std::error::Error for CompileError {}

impl From<Fault> for CompileError {
    fn from(fault: Fault) -> Self {
        CompileError(fault.message.clone())
    }
}

/// The data that all functions of a module share while they are lowered.
pub(crate) struct Unit<'m, S: Scalar> {
    pub module: &'m Module,
    pub effects: Effects,
    pub collections: Collections,
    pub ids: HashMap<Name, FunctionId>,
    pub data: Vec<Value<S>>,
    /// The variables that choices can read.
    pub scope: Scope<'m>,
    /// Captures that may have no value where the function is called or turned into a value: the function, and
    /// the number of the capture.
    pub unassigned: HashSet<(FunctionId, usize)>,
    /// The functions so far: first the functions of the module, then lifted loops.
    pub functions: Vec<Option<Function<S>>>,
}

/// Compiles a module. `data` are the constants that come beside the text.
///
/// # Errors
/// Names that are not defined, wrong numbers of arguments to known functions, or a function too large for the
/// machine (more than 16,384 registers).
pub fn compile<S: Scalar>(module: &Module, data: Vec<Value<S>>) -> Result<Program<S>, CompileError> {
    compile_with_scope(module, data, Scope::Names(&[]))
}

/// Compiles a module so that the variables in `scope` can be read at every choice if every path has assigned
/// them ([`At::visible`](crate::machine::answers::At::visible)). The behaviour of the program is the same:
/// addresses, and so random streams, do not depend on the scope.
///
/// # Errors
/// As for [`compile`].
pub fn compile_with_scope<S: Scalar>(
    module: &Module,
    data: Vec<Value<S>>,
    scope: Scope<'_>,
) -> Result<Program<S>, CompileError> {
    with_stack(|| compile_here(module, data, scope))
        .unwrap_or_else(|error| Err(CompileError(format!("no thread for the compiler: {error}"))))
}

fn compile_here<S: Scalar>(
    module: &Module,
    data: Vec<Value<S>>,
    scope: Scope<'_>,
) -> Result<Program<S>, CompileError> {
    check_records(module)?;
    let effects = Effects::of(module);
    let framed = frames::with_frames(module, &effects);
    let module = framed.as_ref().unwrap_or(module);
    let collections = Collections::of(module, &effects);
    let mut unit = Unit {
        module,
        effects,
        collections,
        ids: HashMap::new(),
        data,
        scope,
        unassigned: HashSet::new(),
        functions: vec![],
    };
    // The table of constants has no gaps.
    let most = unit.data.len() + module.constants.len();
    for (k, literal) in &module.constants {
        let value = constant(literal)?;
        if *k >= most {
            return Err(CompileError(format!("constant {k} of {most}: they are numbered from 0")));
        }
        if unit.data.len() <= *k {
            unit.data.resize(k + 1, Value::None);
        }
        unit.data[*k] = value;
    }
    for (i, f) in module.functions.iter().enumerate() {
        if unit.ids.insert(f.name.clone(), FunctionId(i as u32)).is_some() {
            return Err(CompileError(format!("the function `{}` is defined twice", f.name)));
        }
    }
    // Compilation is repeated while it finds calls that leave a capture unassigned: the called function must
    // check the capture.
    let mut known = None;
    while known != Some(unit.unassigned.len()) {
        known = Some(unit.unassigned.len());
        lower_all(&mut unit)?;
    }
    let entry = *unit
        .ids
        .get(&module.entry)
        .ok_or_else(|| CompileError(format!("the entry `{}` is not defined", module.entry)))?;
    let main = &module.functions[entry.0 as usize];
    if main.captures.iter().any(|x| **x != *PLACE) {
        return Err(CompileError(format!("the entry `{}` captures variables", main.name)));
    }
    let mut program = Program {
        files: module.files.clone(),
        classes: module.classes.iter().cloned().map(Arc::new).collect(),
        functions: unit.functions.into_iter().flatten().collect(),
        entry,
        frames: framed.is_some(),
        constants_of_copies: Vec::new(),
    };
    angles::mark(&mut program);
    verify(&program).map_err(|e| CompileError(e.to_string()))?;
    if TypeId::of::<S>() == TypeId::of::<f64>() {
        program.functions.iter_mut().for_each(|f| f.native = entries_of(f));
    }
    Ok(program)
}

/// Lowers all functions of the module.
fn lower_all<S: Scalar>(unit: &mut Unit<'_, S>) -> Result<(), CompileError> {
    let module = unit.module;
    unit.functions.clear();
    unit.functions.resize_with(module.functions.len(), || None);
    for (i, f) in module.functions.iter().enumerate() {
        let mode = if unit.effects.function(&f.name) { Mode::Node } else { Mode::Pure };
        let compiled = Builder::function(unit, f, mode)?;
        unit.functions[i] = Some(compiled);
    }
    Ok(())
}

/// Checks that every record has a known class and values for all fields.
fn check_records(module: &Module) -> Result<(), CompileError> {
    let mut wrong = None;
    let mut look = |e: &Expr| {
        e.each(&mut |e| {
            if let ExprKind::Record(class, fields) = &e.kind {
                let count = module.classes.get(*class).map(|known| known.fields.len());
                if count != Some(fields.len()) {
                    wrong = Some((*class, fields.len()));
                }
            }
        });
    };
    for f in &module.functions {
        f.defaults.iter().for_each(&mut look);
        each_stmt(&f.body, &mut |s| s.expressions().into_iter().for_each(&mut look));
    }
    wrong.map_or(Ok(()), |(class, fields)| {
        Err(CompileError(format!("there is no class {class} of {fields} fields")))
    })
}

/// The value of a literal.
pub(crate) fn literal<S: Scalar>(l: &Literal) -> Value<S> {
    match l {
        Literal::None => Value::None,
        Literal::Bool(b) => Value::Bool(*b),
        Literal::Int(i) => Value::Int(*i),
        Literal::Real(x) => Value::Real(S::from_f64(*x)),
        Literal::Str(s) => Value::str(s),
    }
}

/// The value of a constant in the text: a literal, or a list, tuple or distribution of literals.
fn constant<S: Scalar>(e: &Expr) -> Result<Value<S>, CompileError> {
    let all = |items: &[Expr]| items.iter().map(constant).collect::<Result<Vec<_>, _>>();
    Ok(match &e.kind {
        ExprKind::Literal(l) => literal(l),
        ExprKind::List(items) => Value::list(all(items)?),
        ExprKind::Tuple(items) => Value::tuple(all(items)?),
        ExprKind::Dist(name, args) => {
            Value::Dist(Arc::new(crate::builtins::make_dist(sites::family(name)?, &all(args)?)?))
        }
        _ => return Err(CompileError("a constant must consist of literals".into())),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::Operand;
    use crate::core::parse::parse;

    fn error(text: &str) -> String {
        match compile::<f64>(&parse(text).expect("core form"), vec![]) {
            Ok(_) => panic!("a program"),
            Err(error) => error.0,
        }
    }

    fn entry(body: &str) -> String {
        format!("(module (fn \"m\" (params $x) (return {body})) (entry \"m\"))")
    }

    #[test]
    fn a_large_constant_number_takes_no_memory() {
        let text = "(module (const 99999999999 0) (fn \"m\" (params) (return 1)) (entry \"m\"))";
        assert!(parse(text).unwrap_err().message.contains("there are at most 65536"));
        let text = "(module (const 9 0) (fn \"m\" (params) (return 1)) (entry \"m\"))";
        assert_eq!(error(text), "constant 9 of 1: they are numbered from 0");
        assert_eq!(error(&entry("(data 99999999999)")), "constant 99999999999 is missing");
        // The number 65537 has more than 16 bits; cut to 16 bits it would be 1.
        assert!(error(&entry("(host 65537 1)")).contains("is too large"));
    }

    #[test]
    fn functions_beyond_the_limits_of_instructions_are_too_large() {
        let numbers: Vec<String> = (0..=Operand::MAX_INDEX + 1).map(|i| format!("{i}.5")).collect();
        let fits = entry(&format!("(index (list {}) 0)", numbers[..4000].join(" ")));
        assert!(compile::<f64>(&parse(&fits).expect("core form"), vec![]).is_ok());
        let constants = entry(&format!("(index (list {}) 0)", numbers.join(" ")));
        let arguments = entry(&format!("(len (list $x {}))", "1 ".repeat(1 << 16)));
        assert_eq!(error(&constants), "`m` is too large: it has more than 16384 constants");
        assert_eq!(
            error(&arguments),
            "`m` is too large: it has more than 65535 arguments in one call or list"
        );
        let many: Vec<String> =
            (0..=Operand::MAX_INDEX).map(|i| format!("(set $x{i} (sample (dist bernoulli $p)))")).collect();
        let values = format!("(module (fn \"m\" (params $p) {} (return 1)) (entry \"m\"))", many.join(" "));
        assert!(
            error(&values).starts_with("`m` is too large: it has more than 16384 values"),
            "{}",
            error(&values)
        );
    }
}

//! Bytecode as text that a person can review.

use super::{Args, Function, Mode, Op, Program, SiteKind};
use niwaki_math::Scalar;
use std::fmt::Write;

/// The text of a whole program, function by function.
pub fn disassemble<S: Scalar>(program: &Program<S>) -> String {
    let mut out = String::new();
    for (i, f) in program.functions.iter().enumerate() {
        let mode = match f.mode {
            Mode::Pure => "pure",
            Mode::Node => "node",
            Mode::Loop => "loop",
            Mode::Iteration => "iteration",
        };
        let _ = writeln!(
            out,
            "f{i} {} ({mode}, {} parameters, {} captures, {} node registers, {} scratch)",
            f.name, f.params, f.captures, f.node_registers, f.scratch_registers
        );
        for (k, value) in f.constants.iter().enumerate() {
            let _ = writeln!(out, "     k{k} = {value:?}");
        }
        for (at, op) in f.code.iter().enumerate() {
            if at == f.body as usize {
                let _ = writeln!(out, "     slices");
            }
            let _ = writeln!(out, "  {at:3}  {}", instruction(f, op));
        }
    }
    out
}

fn run<S: Scalar>(f: &Function<S>, args: Args) -> String {
    let parts: Vec<String> = f.operands[args.range()].iter().map(|o| format!("{o:?}")).collect();
    format!("({})", parts.join(", "))
}

fn instruction<S: Scalar>(f: &Function<S>, op: &Op) -> String {
    match *op {
        Op::Move { to, from } => format!("{to:?} = {from:?}"),
        Op::Add { to, a, b } => format!("{to:?} = Add {a:?} {b:?}"),
        Op::Sub { to, a, b } => format!("{to:?} = Sub {a:?} {b:?}"),
        Op::Mul { to, a, b } => format!("{to:?} = Mul {a:?} {b:?}"),
        Op::Div { to, a, b } => format!("{to:?} = Div {a:?} {b:?}"),
        Op::Binary { op, to, a, b } => format!("{to:?} = {op:?} {a:?} {b:?}"),
        Op::Neg { to, a } => format!("{to:?} = Neg {a:?}"),
        Op::Not { to, a } => format!("{to:?} = Not {a:?}"),
        Op::Builtin { to, id, args } => {
            format!("{to:?} = {}{}", crate::builtins::builtin::<S>(id).name, run(f, args))
        }
        Op::List { to, args } => format!("{to:?} = List{}", run(f, args)),
        Op::Tuple { to, args } => format!("{to:?} = Tuple{}", run(f, args)),
        Op::Dict { to, args } => format!("{to:?} = Dict{}", run(f, args)),
        Op::Record { to, class, args } => format!("{to:?} = Record {class}{}", run(f, args)),
        Op::Field { to, a, name } => format!("{to:?} = {a:?}.{}", f.names[name as usize]),
        Op::Unpack { from, to } => format!("{} = Unpack {from:?}", run(f, to)),
        Op::UnpackStar { from, to, star } => {
            format!("{} = Unpack {from:?} with the rest at {star}", run(f, to))
        }
        Op::Closure { to, function, args } => format!("{to:?} = Closure f{function}{}", run(f, args)),
        Op::Dist { to, family, args } => format!("{to:?} = {family:?}{}", run(f, args)),
        Op::Host { to, constant, args } => format!("{to:?} = Host {constant}{}", run(f, args)),
        Op::CallPure { to, function, args } => format!("{to:?} = f{function}{}", run(f, args)),
        Op::Jump { target } => format!("jump {target}"),
        Op::JumpIf { a, target } => format!("if {a:?} jump {target}"),
        Op::JumpUnless { a, target } => format!("unless {a:?} jump {target}"),
        Op::JumpUnlessCompare { op, a, b, target } => format!("unless {op:?} {a:?} {b:?} jump {target}"),
        Op::Length { to, a } => format!("{to:?} = Length {a:?}"),
        Op::Next { to, over, index, length, target } => {
            format!("{to:?} = next of {over:?} at {index:?} of {length:?}, else jump {target}")
        }
        Op::CheckSet { a, name } => format!("check {a:?} is set ({})", f.names[name as usize]),
        Op::Assert { a, message } => format!("assert {a:?}, {message:?}"),
        Op::Pass { site, arg } => format!("argument {arg} of site {}", site.0),
        Op::Done => "done".into(),
        Op::Clear { from, to } => format!("clear sites {from}..{to}"),
        Op::Return { a } => format!("return {a:?}"),
        Op::ReturnIteration { exit, args } => format!("end iteration {exit} {}", run(f, args)),
        Op::Site { site } => {
            let s = &f.sites[site.0 as usize];
            let kind = match &s.kind {
                SiteKind::Call { function } | SiteKind::Future { function, detached: false } => {
                    format!(
                        "{} f{}",
                        if matches!(s.kind, SiteKind::Call { .. }) { "call" } else { "future" },
                        function.0
                    )
                }
                SiteKind::Future { function, .. } => format!("detached future f{}", function.0),
                SiteKind::Loop(l) => format!(
                    "loop f{} over {:?} carried {} captures {} out {}",
                    l.body.0,
                    l.over,
                    run(f, l.carried),
                    run(f, l.captures),
                    run(f, l.out)
                ),
                other => format!("{other:?}"),
            };
            format!("{:?} = site {} \"{}\" {kind} {}", s.to, site.0, s.label, run(f, s.args))
        }
    }
}

//! Core form that is nested deeply: the thread that visits it, and how it is dropped.
//!
//! The reader and all passes recurse once for each level of a text. [`read`](super::read) refuses more than
//! [`MAX_DEPTH`](super::read::MAX_DEPTH) levels, and every visit runs on a thread whose stack is large enough
//! for them, so the stack of the caller does not matter. A drop needs no stack: it moves the parts to a list.

use super::read::Sexp;
use super::{Expr, ExprKind, Module, Stmt, StmtKind};

/// Bytes of stack for the deepest text. Only the touched pages take memory: up to about 10 kB for each level.
const STACK: usize = 128 << 20;

/// Runs `work` on a thread with enough stack for the deepest text.
///
/// # Errors
/// The system starts no thread.
pub(crate) fn with_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, std::io::Error> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work)?;
        Ok(thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

impl Drop for Sexp<'_> {
    fn drop(&mut self) {
        let Sexp::List(items) = self else { return };
        let mut work = std::mem::take(items);
        while let Some(mut sexp) = work.pop() {
            if let Sexp::List(items) = &mut sexp {
                work.append(items);
            }
        }
    }
}

impl Drop for Module {
    fn drop(&mut self) {
        let mut exprs: Vec<Expr> = self.constants.drain(..).map(|(_, e)| e).collect();
        let mut stmts = Vec::new();
        for f in &mut self.functions {
            exprs.append(&mut f.defaults);
            stmts.append(&mut f.body);
        }
        while let Some(s) = stmts.pop() {
            take_statement(s, &mut stmts, &mut exprs);
        }
        while let Some(e) = exprs.pop() {
            take_expression(e, &mut exprs);
        }
    }
}

/// Moves the parts of a statement to the lists.
fn take_statement(s: Stmt, stmts: &mut Vec<Stmt>, exprs: &mut Vec<Expr>) {
    match s.kind {
        StmtKind::Set(_, e)
        | StmtKind::Unpack(_, e)
        | StmtKind::UnpackStar(_, _, _, e)
        | StmtKind::Return(e)
        | StmtKind::Do(e) => exprs.push(e),
        StmtKind::If(e, a, b) => {
            exprs.push(e);
            stmts.extend(a);
            stmts.extend(b);
        }
        StmtKind::For(_, e, body) | StmtKind::While(e, body) => {
            exprs.push(e);
            stmts.extend(body);
        }
        StmtKind::Assert(a, b) => exprs.extend([a, b]),
        StmtKind::Break | StmtKind::Continue => {}
    }
}

/// Moves the parts of an expression to the list.
fn take_expression(e: Expr, exprs: &mut Vec<Expr>) {
    use ExprKind::*;
    match e.kind {
        Literal(_) | Data(_) | Var(_) => {}
        And(xs) | Or(xs) | Emit(xs) | List(xs) | Tuple(xs) => exprs.extend(xs),
        Call(_, xs)
        | Closure(_, xs)
        | Future(_, xs)
        | Dist(_, xs)
        | Host(_, xs)
        | Record(_, xs)
        | Op(_, xs) => {
            exprs.extend(xs);
        }
        Cond(c, a, b) => exprs.extend([*c, *a, *b]),
        Sample(x, options) => {
            exprs.push(*x);
            exprs.extend(options.map(|options| *options));
        }
        Factor(x) | Condition(x) | Force(x) | Field(x, _) | Mem(x, _) => exprs.push(*x),
        Observe(a, b) | Query(a, b) | Place(a, b) => exprs.extend([*a, *b]),
        Apply(x, xs) | FutureApply(x, xs) | Method(x, _, xs) => {
            exprs.push(*x);
            exprs.extend(xs);
        }
        Dict(keys, xs) => {
            exprs.extend(keys);
            exprs.extend(xs);
        }
    }
}

impl Clone for Module {
    fn clone(&self) -> Self {
        let copy = || Module {
            files: self.files.clone(),
            classes: self.classes.clone(),
            constants: self.constants.clone(),
            functions: self.functions.clone(),
            entry: self.entry.clone(),
        };
        with_stack(copy).unwrap_or_else(|_| copy())
    }
}

impl std::fmt::Debug for Module {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&super::print::print(self))
    }
}

#[cfg(test)]
mod tests {
    //! The claim: a text of any depth is read, printed, compiled and dropped, or refused, on a thread with little stack.
    use crate::core::parse::parse;
    use crate::core::print::print;
    use crate::core::read::MAX_DEPTH;
    use crate::passes::compile;

    /// Every way to nest: the text before and after the inner part, and the innermost part.
    const NESTED: &[(&str, &str, &str)] = &[
        ("(return (add 1 ", "))", ""),
        ("(neg ", ")", "1"),
        ("(add ", " 1)", "1"),
        ("(and true ", ")", "1"),
        ("(or ", " 1)", "1"),
        ("(cond true ", " 2)", "1"),
        ("(cond ", " 1 2)", "1"),
        ("(list ", ")", "1"),
        ("(tuple 1 ", ")", "1"),
        ("(dict (1) ", ")", "1"),
        ("(method ", " \"upper\")", "\"a\""),
        ("(field ", " \"x\")", "$p"),
        ("(index ", " 0)", "$p"),
        ("(fstr (format ", " \"\" \"\"))", "$p"),
        ("(apply ", " 1)", "$p"),
        ("(call \"g\" ", ")", "$p"),
        ("(sample (dist delta ", "))", "$p"),
        ("(force ", ")", "$p"),
        ("(future \"g\" ", ")", "$p"),
        ("(closure \"k\" ", ")", "$p"),
        ("(emit ", ")", "$p"),
        ("(do ", ")", "$p"),
        ("(foo ", ")", "$p"),
    ];
    const BLOCKS: &[(&str, &str)] = &[
        ("(if $p (then ", "))"),
        ("(if $p (then (do (factor 0))) (else ", "))"),
        ("(if $p (then (set $a 1)) (else (set $b 2) ", "))"),
        ("(for $i (range 2) (body ", "))"),
        ("(for $i (range 2) (body (do (factor 0)) ", "))"),
        ("(while $p (body (set $p false) ", "))"),
    ];

    fn module(body: &str) -> String {
        format!(
            "(module (fn \"g\" (params $x) (do (factor 0)) (return $x)) (fn \"k\" (params) (captures $x) (return $x))
              (fn \"m\" (params $p) {body}) (entry \"m\"))"
        )
    }

    fn texts(depth: usize) -> Vec<String> {
        let expressions = NESTED.iter().map(|(open, close, inner)| {
            let (open, close) = (open.repeat(depth), close.repeat(depth));
            module(&format!("(return {open}{inner}{close})"))
        });
        let blocks = BLOCKS
            .iter()
            .map(|(open, close)| module(&format!("{}(return 1){}", open.repeat(depth), close.repeat(depth))));
        expressions.chain(blocks).collect()
    }

    fn on_little_stack(work: impl FnOnce() + Send + 'static) {
        std::thread::Builder::new().stack_size(256 << 10).spawn(work).unwrap().join().unwrap();
    }

    #[test]
    fn deep_texts_do_not_need_the_stack_of_the_caller() {
        on_little_stack(|| {
            let mut compiled = 0;
            for depth in [300, 900, MAX_DEPTH / 2 - 8, MAX_DEPTH - 8] {
                for text in texts(depth) {
                    let Ok(module) = parse(&text) else { continue };
                    assert!(print(&module).len() > depth && format!("{module:?}").len() > depth);
                    drop(module.clone());
                    compiled += usize::from(compile::<f64>(&module, vec![]).is_ok());
                }
            }
            assert!(compiled > 40, "{compiled}");
        });
    }

    #[test]
    fn a_text_nested_too_deeply_is_an_error() {
        on_little_stack(|| {
            for depth in [MAX_DEPTH + 1, 100_000] {
                for text in texts(depth) {
                    assert!(parse(&text).unwrap_err().message.contains("nested too deeply"));
                }
            }
        });
    }
}

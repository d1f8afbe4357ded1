//! `place`: the frame of a call goes to every call below it as a hidden capture.
//!
//! A program that places nothing stays as it is. In any other program each effectful function gets one capture more, the
//! frame in the world of what it emits, or `None`. Direct calls pass it on as they pass other captures. A function value
//! holds `None` there, and its callers replace that: the last argument of each `Apply` is the frame
//! ([`Program::frames`](crate::code::Program::frames)). So a frame is a value like any other: a changed frame runs the calls
//! again that depend on it, and is recorded with the run. A memoised call belongs to no caller, so its frame stays `None`.

use super::effects::Effects;
use crate::core::visit::each_stmt;
use crate::core::{Expr, ExprKind, Literal, Module, Name, PLACE, Span, Stmt, StmtKind};

/// The module with frames as captures; `None` if it places nothing.
pub fn with_frames(module: &Module, effects: &Effects) -> Option<Module> {
    let mut places = false;
    for f in &module.functions {
        each_stmt(&f.body, &mut |s| {
            s.expressions()
                .iter()
                .for_each(|e| e.each(&mut |e| places |= matches!(e.kind, ExprKind::Place(..))));
        });
    }
    if !places {
        return None;
    }
    let mut module = module.clone();
    for f in &mut module.functions {
        let is_placed = effects.function(&f.name);
        if is_placed {
            f.captures.push(Name::from(PLACE));
        }
        let rewriting = Rewriting { effects, is_placed };
        f.defaults.iter_mut().for_each(|e| rewriting.expression(e));
        rewriting.block(&mut f.body);
    }
    Some(module)
}

/// The rewriting of one function.
struct Rewriting<'a> {
    effects: &'a Effects,
    /// Whether the function has the frame as a capture.
    is_placed: bool,
}

fn expression(span: Span, kind: ExprKind) -> Expr {
    Expr { span, label: None, kind }
}

fn none(span: Span) -> Expr {
    expression(span, ExprKind::Literal(Literal::None))
}

/// Whether a capture of a function value stands for the frame of its caller.
pub fn is_no_frame(capture: &Expr) -> bool {
    matches!(capture.kind, ExprKind::Literal(Literal::None))
}

impl Rewriting<'_> {
    fn block(&self, block: &mut [Stmt]) {
        for s in block {
            match &mut s.kind {
                StmtKind::Set(_, e)
                | StmtKind::Unpack(_, e)
                | StmtKind::UnpackStar(_, _, _, e)
                | StmtKind::Return(e)
                | StmtKind::Do(e) => self.expression(e),
                StmtKind::If(e, a, b) => {
                    self.expression(e);
                    self.block(a);
                    self.block(b);
                }
                StmtKind::For(_, e, body) | StmtKind::While(e, body) => {
                    self.expression(e);
                    self.block(body);
                }
                StmtKind::Assert(a, b) => [a, b].into_iter().for_each(|e| self.expression(e)),
                StmtKind::Break | StmtKind::Continue => {}
            }
        }
    }

    /// The frame of the function.
    fn frame(&self, span: Span) -> Expr {
        match self.is_placed {
            true => expression(span, ExprKind::Var(Name::from(PLACE))),
            false => none(span),
        }
    }

    fn expression(&self, e: &mut Expr) {
        let span = e.span;
        if let ExprKind::Place(frame, call) = &mut e.kind {
            self.expression(frame);
            let frame = std::mem::replace(&mut **frame, none(span));
            let frame = expression(span, ExprKind::Op("frame_in".into(), vec![self.frame(span), frame]));
            *e = self.placed(std::mem::replace(&mut **call, none(span)), frame);
            return;
        }
        e.parts_mut().into_iter().for_each(|part| self.expression(part));
        match &mut e.kind {
            ExprKind::Call(f, args) | ExprKind::Future(f, args) if self.effects.function(f) => {
                args.push(self.frame(span));
            }
            ExprKind::Apply(_, args) | ExprKind::FutureApply(_, args) => args.push(self.frame(span)),
            ExprKind::Closure(f, captures) if self.effects.function(f) => captures.push(none(span)),
            ExprKind::Emit(shapes) => {
                let shapes = std::mem::take(shapes);
                let shapes = expression(span, ExprKind::Tuple(shapes));
                let placed = ExprKind::Op("placed".into(), vec![self.frame(span), shapes]);
                e.kind = ExprKind::Emit(vec![expression(span, placed)]);
            }
            _ => {}
        }
    }

    /// A call in a frame. A pure function emits nothing, but the frame is checked.
    fn placed(&self, mut call: Expr, frame: Expr) -> Expr {
        let span = call.span;
        match &mut call.kind {
            ExprKind::Call(f, args) if self.effects.function(f) => {
                args.iter_mut().for_each(|part| self.expression(part));
                args.push(frame);
            }
            ExprKind::Apply(f, args) => {
                std::iter::once(&mut **f).chain(&mut *args).for_each(|part| self.expression(part));
                args.push(frame);
            }
            _ => {
                self.expression(&mut call);
                let both = expression(span, ExprKind::Tuple(vec![call, frame]));
                let first = expression(span, ExprKind::Literal(Literal::Int(0)));
                return expression(span, ExprKind::Op("index".into(), vec![both, first]));
            }
        }
        call
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::parse::parse;
    use crate::core::print;

    fn rewritten(text: &str) -> String {
        let module = parse(text).expect("core form");
        let effects = Effects::of(&module);
        print::print(with_frames(&module, &effects).as_ref().unwrap_or(&module))
    }

    #[test]
    fn a_program_that_places_nothing_stays_as_it_is() {
        let text = "(module (fn \"m\" (params $x) (do (emit $x)) (return (apply $x 1))) (entry \"m\"))";
        assert!(!rewritten(text).contains(PLACE));
    }

    #[test]
    fn each_effectful_call_passes_its_frame_on() {
        let text = "(module (fn \"leg\" (params $x) (do (emit $x)))
          (fn \"twice\" (params $x) (return (mul 2 $x)))
          (fn \"m\" (params $f $x) (do (place $f (call \"leg\" $x))) (do (call \"leg\" (call \"twice\" $x)))
            (do (apply $f $x)) (return (closure \"leg\"))) (entry \"m\"))";
        let module = rewritten(text);
        for part in [
            "(emit (placed $%place (tuple $x)))",
            "(call \"leg\" $x (frame_in $%place $f))",
            "(call \"leg\" (call \"twice\" $x) $%place)",
            "(apply $f $x $%place)",
            "(closure \"leg\" none)",
        ] {
            assert!(module.contains(part), "{part}: {module}");
        }
    }
}

//! The variables that are needed at the head of each loop, on core form.
//!
//! A lifted loop passes only the variables to the next iteration that are assigned in its body *and* live at
//! its head. Everything else stays inside of an iteration. So an iteration's result changes only when something
//! that matters changes; re-running depends on that.

use crate::core::visit::Names;
use crate::core::{Stmt, StmtKind};
use std::collections::HashMap;

/// For each loop statement, the variables that are live at its head: before its test, or before it takes its
/// next element. Statements are identified by their addresses in memory, which are stable while the module is
/// borrowed.
#[derive(Default)]
pub struct LoopHeads(HashMap<*const Stmt, Names>);

impl LoopHeads {
    /// Analyses a function's body.
    pub fn of(body: &[Stmt]) -> Self {
        let mut heads = LoopHeads::default();
        heads.block(body, Names::new(), &Names::new(), &Names::new());
        heads
    }

    /// The variables that are live at the head of a loop.
    pub fn at(&self, stmt: &Stmt) -> &Names {
        &self.0[&std::ptr::from_ref(stmt)]
    }

    /// The variables that are live before the block, from those that are live after it, after a `break` and
    /// after a `continue`.
    fn block(&mut self, block: &[Stmt], after: Names, on_break: &Names, on_continue: &Names) -> Names {
        let mut live = after;
        for s in block.iter().rev() {
            match &s.kind {
                StmtKind::Return(_) => live = Names::new(),
                StmtKind::Break => live = on_break.clone(),
                StmtKind::Continue => live = on_continue.clone(),
                StmtKind::If(_, a, b) => {
                    let other = self.block(b, live.clone(), on_break, on_continue);
                    live = self.block(a, live, on_break, on_continue);
                    live.extend(other);
                }
                StmtKind::For(_, _, body) | StmtKind::While(_, body) => live = self.loop_head(s, body, live),
                _ => {
                    for x in s.targets() {
                        live.remove(x);
                    }
                }
            }
            for e in s.expressions() {
                e.reads(&mut live);
            }
        }
        live
    }

    fn loop_head(&mut self, s: &Stmt, body: &[Stmt], after: Names) -> Names {
        // The live variables only grow from one visit to the next. Without the result of the last visit, the
        // time for nested loops would double with each level.
        let mut head = after.clone();
        head.extend(self.0.get(&std::ptr::from_ref(s)).into_iter().flatten().cloned());
        if let StmtKind::While(test, _) = &s.kind {
            test.reads(&mut head);
        }
        loop {
            let mut round = self.block(body, head.clone(), &after, &head);
            if let StmtKind::For(x, _, _) = &s.kind {
                round.remove(x);
            }
            let before = head.len();
            head.extend(round);
            if head.len() == before {
                break;
            }
        }
        self.0.insert(std::ptr::from_ref(s), head.clone());
        head
    }
}

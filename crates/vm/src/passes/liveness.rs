//! Which variables are still needed at the head of each loop, on core form.
//!
//! A lifted loop passes from one iteration to the next just what is assigned in its body *and* live at its
//! head. Everything else stays inside an iteration, so that an iteration's result changes only when something
//! that matters changes (re-running depends on that).

use crate::core::visit::Names;
use crate::core::{Stmt, StmtKind};
use std::collections::HashMap;

/// For each loop statement (by its address in memory, stable while the module is borrowed): what is live at
/// its head, that is before its test or before its next element is taken.
#[derive(Default)]
pub struct LoopHeads(HashMap<*const Stmt, Names>);

impl LoopHeads {
    /// Analyses a function's body.
    pub fn of(body: &[Stmt]) -> Self {
        let mut heads = LoopHeads::default();
        heads.block(body, Names::new(), &Names::new(), &Names::new());
        heads
    }

    /// What is live at the head of that loop.
    pub fn at(&self, stmt: &Stmt) -> &Names {
        &self.0[&std::ptr::from_ref(stmt)]
    }

    /// What is live before the block, from what is live after it, after a break and after a continue.
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
        // What is live only grows from one visit to the next. Without what the last visit found, a loop in a loop in a
        // loop would take time by two to the power of their number.
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

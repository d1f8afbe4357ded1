//! The functions that can reach an effect: a fixed point over the call graph.
//!
//! Any other function is *pure*: it gets no node and no site. A call through a value of unknown origin counts
//! as effectful.

use crate::core::visit::each_stmt;
use crate::core::{Expr, ExprKind, Module, Name, Stmt};
use std::collections::HashSet;

/// The names of the effectful functions.
#[derive(Debug, Default)]
pub struct Effects(HashSet<Name>);

impl Effects {
    /// Analyses a module.
    pub fn of(module: &Module) -> Self {
        let mut effects = Effects::default();
        loop {
            let before = effects.0.len();
            for f in &module.functions {
                if effects.in_block(&f.body) {
                    effects.0.insert(f.name.clone());
                }
            }
            if effects.0.len() == before {
                return effects;
            }
        }
    }

    /// Whether the named function can reach an effect.
    pub fn function(&self, name: &Name) -> bool {
        self.0.contains(name)
    }

    /// Whether evaluating the expression can suspend.
    pub fn in_expr(&self, e: &Expr) -> bool {
        use ExprKind::*;
        let mut suspends = false;
        e.each(&mut |e| {
            suspends |= match &e.kind {
                Sample(..) | Observe(..) | Factor(_) | Condition(_) | Query(..) | Emit(_) | Force(_) => true,
                Future(..) | FutureApply(..) | Apply(..) | Mem(..) => true,
                Call(name, _) => self.function(name),
                _ => false,
            };
        });
        suspends
    }

    /// Whether running the block can suspend.
    pub fn in_block(&self, block: &[Stmt]) -> bool {
        let mut suspends = false;
        each_stmt(block, &mut |s| {
            suspends = suspends || s.expressions().into_iter().any(|e| self.in_expr(e))
        });
        suspends
    }
}

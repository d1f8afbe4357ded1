//! Lowering of expressions: each returns the operand that holds its value.

use super::CompileError;
use super::emit::{Builder, Result};
use crate::builtins::{builtin_id, make_dist};
use crate::code::{Binary, FunctionId, Op, Operand};
use crate::core::{Expr, ExprKind, Name};
use crate::value::Value;
use niwaki_math::Scalar;
use std::sync::Arc;

/// The operations that have an instruction of their own.
fn binary(name: &str) -> Option<Binary> {
    Some(match name {
        "add" => Binary::Add,
        "sub" => Binary::Sub,
        "mul" => Binary::Mul,
        "div" => Binary::Div,
        "floordiv" => Binary::FloorDiv,
        "mod" => Binary::Mod,
        "pow" => Binary::Pow,
        "eq" => Binary::Eq,
        "ne" => Binary::Ne,
        "lt" => Binary::Lt,
        "le" => Binary::Le,
        "gt" => Binary::Gt,
        "ge" => Binary::Ge,
        "index" => Binary::Index,
        "in" => Binary::In,
        _ => return None,
    })
}

impl<S: Scalar> Builder<'_, '_, S> {
    /// Lowers an expression.
    pub fn expr(&mut self, e: &Expr) -> Result<Operand> {
        let outside = self.span;
        if e.span.line > 0 {
            self.span = e.span;
        }
        let result = self.expr_here(e);
        self.span = outside;
        result
    }

    pub fn exprs(&mut self, items: &[Expr]) -> Result<Vec<Operand>> {
        items.iter().map(|e| self.expr(e)).collect()
    }

    fn expr_here(&mut self, e: &Expr) -> Result<Operand> {
        use ExprKind::*;
        if self.mode != crate::code::Mode::Pure
            && let Some(site) = self.site(e)?
        {
            return Ok(site);
        }
        if self.mode != crate::code::Mode::Pure
            && let Some(at) = self.collection(e)?
        {
            return Ok(at);
        }
        match &e.kind {
            Literal(l) => Ok(self.literal(l)),
            Data(k) => self.data(*k),
            Var(x) => self.variable(x),
            And(items) => self.shortcut(items, true),
            Or(items) => self.shortcut(items, false),
            Cond(c, a, b) => self.conditional(c, a, b),
            Op(name, args) => self.operation(name, args),
            Call(name, args) => self.pure_call(name, args),
            _ => self.construct(e),
        }
    }

    /// Lowers expressions that compute a value from their arguments, in order.
    fn construct(&mut self, e: &Expr) -> Result<Operand> {
        use ExprKind::*;
        let mut operands = match &e.kind {
            Closure(name, captures) => self.capture_operands(self.function_id(name)?, captures)?,
            _ => e.parts().into_iter().map(|p| self.expr(p)).collect::<Result<Vec<_>>>()?,
        };
        if let Method(_, name, _) = &e.kind {
            let name = self.literal(&crate::core::Literal::Str(name.to_string()));
            operands.insert(1, name);
        }
        if let Some(value) = self.folded(e, &operands) {
            return Ok(self.constant(value));
        }
        let args = self.args(&operands);
        let to = self.register()?;
        let op = match &e.kind {
            List(_) => crate::code::Op::List { to, args },
            Tuple(_) => crate::code::Op::Tuple { to, args },
            Dict(..) => crate::code::Op::Dict { to, args },
            Record(class, _) => {
                crate::code::Op::Record { to, class: self.sixteen(*class, "classes of records")?, args }
            }
            Field(_, name) => crate::code::Op::Field { to, a: operands[0], name: self.name(name) },
            Method(..) => {
                let id = builtin_id("method").ok_or_else(|| CompileError("methods are missing".into()))?;
                crate::code::Op::Builtin { to, id, args }
            }
            Host(k, _) => crate::code::Op::Host { to, constant: self.sixteen(*k, "constants")?, args },
            Closure(name, _) => {
                let id = self.function_id(name)?;
                crate::code::Op::Closure {
                    to,
                    function: self.sixteen(id.0 as usize, "functions of the model before it")?,
                    args,
                }
            }
            Dist(name, _) => crate::code::Op::Dist { to, family: super::sites::family(name)?, args },
            _ => return Err(CompileError(format!("an effect in the pure function `{}`", self.name))),
        };
        self.op(op);
        Ok(to)
    }

    /// The value of an aggregate or distribution of constants: values never change, so one value serves every
    /// use.
    pub fn folded(&self, e: &Expr, operands: &[Operand]) -> Option<Value<S>> {
        use ExprKind::*;
        if operands.iter().any(|o| o.place() != crate::code::Place::Constant) {
            return None;
        }
        let mut values: Vec<Value<S>> = operands.iter().map(|o| self.constants[o.index()].clone()).collect();
        Some(match &e.kind {
            List(_) => Value::list(values),
            Tuple(_) => Value::tuple(values),
            Dict(keys, _) => {
                let rest = values.split_off(keys.len());
                Value::Dict(Arc::new(crate::value::Dict::new(values.into_iter().zip(rest).collect())))
            }
            // Bad parameters are left to the run, which knows the call stack.
            Dist(name, _) => {
                Value::Dist(Arc::new(make_dist(super::sites::family(name).ok()?, &values).ok()?))
            }
            _ => return None,
        })
    }

    fn variable(&mut self, x: &Name) -> Result<Operand> {
        let Some(binding) = self.env.get(x).copied() else {
            // The variable is certainly unassigned: the check always fails, and its fault has the variable's
            // name.
            let unset = self.unset();
            let name = self.name(x);
            self.op(Op::CheckSet { a: unset, name });
            return Ok(unset);
        };
        if binding.maybe_unset {
            let name = self.name(x);
            self.op(Op::CheckSet { a: binding.at, name });
            self.env.insert(x.clone(), super::emit::Binding { maybe_unset: false, ..binding });
        }
        Ok(binding.at)
    }

    fn operation(&mut self, name: &Name, items: &[Expr]) -> Result<Operand> {
        let operands = self.exprs(items)?;
        if let Some(value) = self.constant_result(name, &operands) {
            return Ok(self.constant(value));
        }
        let to = self.register()?;
        let op = match (&**name, operands.as_slice()) {
            ("add", &[a, b]) => Op::Add { to, a, b },
            ("sub", &[a, b]) => Op::Sub { to, a, b },
            ("mul", &[a, b]) => Op::Mul { to, a, b },
            ("div", &[a, b]) => Op::Div { to, a, b },
            (n, [a, b]) if binary(n).is_some() => {
                let op = binary(n).unwrap_or(Binary::Add);
                Op::Binary { op, to, a: *a, b: *b }
            }
            ("neg", [a]) => Op::Neg { to, a: *a },
            ("not", [a]) => Op::Not { to, a: *a },
            _ => {
                let id =
                    builtin_id(name).ok_or_else(|| CompileError(format!("unknown operation `{name}`")))?;
                Op::Builtin { to, id, args: self.args(&operands) }
            }
        };
        self.op(op);
        Ok(to)
    }

    /// The value of a built-in function of constants, if it takes little time. A call that fails is left to the
    /// run, which knows the call stack.
    fn constant_result(&self, name: &str, operands: &[Operand]) -> Option<Value<S>> {
        if binary(name).is_some() || operands.iter().any(|o| o.place() != crate::code::Place::Constant) {
            return None;
        }
        let values: Vec<Value<S>> = operands.iter().map(|o| self.constants[o.index()].clone()).collect();
        // The run has bounds of time and memory, but the compiler has none.
        let is_long = |value: &Value<S>| matches!(value, Value::Range(range) if range.len > 1000);
        // Results that vary with a recording are computed by the run.
        if matches!(name, "method" | "format" | "fstr") || values.iter().any(|v| is_long(v) || v.varies()) {
            return None;
        }
        crate::builtins::builtin::<S>(builtin_id(name)?).call(&values).ok()
    }

    fn pure_call(&mut self, name: &Name, items: &[Expr]) -> Result<Operand> {
        let (id, operands) = self.direct_call(name, items)?;
        let args = self.args(&operands);
        let to = self.register()?;
        let function = self.sixteen(id.0 as usize, "functions of the model before it")?;
        self.op(Op::CallPure { to, function, args });
        Ok(to)
    }

    /// A direct call: the operands are the function's arguments and then its captures.
    pub fn direct_call(&mut self, name: &Name, items: &[Expr]) -> Result<(FunctionId, Vec<Operand>)> {
        let id = self.function_id(name)?;
        let f = self.definition(id);
        let (params, needed) = (f.params.len(), f.params.len() + f.captures.len());
        if needed != items.len() {
            return Err(CompileError(format!(
                "`{name}` takes {needed} arguments and captures, {} given",
                items.len()
            )));
        }
        let mut operands = self.exprs(&items[..params])?;
        operands.extend(self.capture_operands(id, &items[params..])?);
        Ok((id, operands))
    }

    /// The operands of a function's captures at this place. A variable without a value is passed on: the
    /// function may not read it. A capture that holds a default is checked here, because without a value the
    /// function's definition did not run.
    fn capture_operands(&mut self, id: FunctionId, items: &[Expr]) -> Result<Vec<Operand>> {
        let f = self.definition(id);
        if f.captures.len() != items.len() {
            return Err(CompileError(format!("a closure of `{}` with the wrong number of captures", f.name)));
        }
        let mut operands = Vec::with_capacity(items.len());
        for (i, (capture, item)) in f.captures.iter().zip(items).enumerate() {
            operands.push(match &item.kind {
                ExprKind::Var(x) if !f.is_default(capture) && !self.is_set(x) => {
                    self.unit.unassigned.insert((id, i));
                    self.current(x)
                }
                _ => self.expr(item)?,
            });
        }
        Ok(operands)
    }

    /// Lowers `and` and `or`: the value that decides, else the last.
    fn shortcut(&mut self, items: &[Expr], is_and: bool) -> Result<Operand> {
        let end = self.label();
        let to = self.register()?;
        let mut merges = Vec::new();
        // The jump of each operand that decides, and the number of sites before the jump.
        let mut deciding = Vec::new();
        for (i, item) in items.iter().enumerate() {
            let a = self.expr(item)?;
            self.op(Op::Move { to, from: a });
            if i == 0 {
                merges.push(self.env.clone());
            }
            if i + 1 < items.len() {
                let decided = self.label();
                deciding.push((decided, self.sites.len()));
                let target = Self::jump_target(decided);
                // The jump tests `a` and not `to`, which a later operand may overwrite.
                self.op(if is_and { Op::JumpUnless { a, target } } else { Op::JumpIf { a, target } });
            }
        }
        // Checks in a later operand do not hold if an earlier operand decided.
        if let Some(first) = merges.pop() {
            self.env = first;
        }
        let last = self.sites.len();
        if deciding.iter().any(|(_, sites)| *sites < last) {
            self.jump(end);
            for (decided, sites) in deciding {
                self.bind(decided);
                self.clear(sites, last);
                self.jump(end);
            }
        } else {
            deciding.into_iter().for_each(|(decided, _)| self.bind(decided));
        }
        self.bind(end);
        Ok(to)
    }

    fn conditional(&mut self, c: &Expr, a: &Expr, b: &Expr) -> Result<Operand> {
        let (other, end) = (self.label(), self.label());
        self.branch_unless(c, other)?;
        let to = self.register()?;
        let env = self.env.clone();
        let (head_of_a, first) = (self.code.len(), self.sites.len());
        let x = self.expr(a)?;
        self.op(Op::Move { to, from: x });
        self.jump(end);
        let between = self.sites.len();
        self.bind(other);
        self.clear(first, between);
        self.env = env.clone();
        let y = self.expr(b)?;
        self.op(Op::Move { to, from: y });
        self.bind(end);
        self.clear_at(head_of_a, between, self.sites.len());
        self.env = env;
        Ok(to)
    }

    /// Jumps to `other` unless the condition holds; a comparison and its jump become one instruction.
    pub fn branch_unless(&mut self, c: &Expr, other: super::emit::Label) -> Result<()> {
        let target = Self::jump_target(other);
        if let ExprKind::Op(name, args) = &c.kind
            && let (Some(op), [x, y]) = (binary(name), args.as_slice())
            && matches!(op, Binary::Eq | Binary::Ne | Binary::Lt | Binary::Le | Binary::Gt | Binary::Ge)
        {
            let (a, b) = (self.expr(x)?, self.expr(y)?);
            let outside = self.span;
            if c.span.line > 0 {
                self.span = c.span;
            }
            self.op(Op::JumpUnlessCompare { op, a, b, target });
            self.span = outside;
            return Ok(());
        }
        let a = self.expr(c)?;
        self.op(Op::JumpUnless { a, target });
        Ok(())
    }

    /// The constant that marks an unassigned variable.
    pub fn unset(&mut self) -> Operand {
        self.constant(crate::value::Value::Unset)
    }
}

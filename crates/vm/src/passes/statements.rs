//! Lowering of statements. Every method returns whether control can continue after the statement.
//!
//! An assignment gives a variable a new register; where two arms meet, each arm writes the register of the
//! merge. A loop that cannot suspend keeps its variables in registers that are written again in each round. A
//! loop that can suspend is lifted: its body becomes a function with one activation for each iteration.

use super::CompileError;
use super::emit::{Binding, Builder, Environment, LoopContext, Result, VALUES};
use crate::code::{Function, FunctionId, Loop, Mode, Op, Operand, Place, SiteKind, exit};
use crate::core::visit::{Names, assigned, in_order_of_assignment, returns};
use crate::core::{Expr, ExprKind, LOOK, Literal, Name, Stmt, StmtKind, readable};
use niwaki_math::Scalar;

impl<S: Scalar> Builder<'_, '_, S> {
    pub fn block(&mut self, block: &[Stmt]) -> Result<bool> {
        for s in block {
            if !self.stmt(s)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn stmt(&mut self, s: &Stmt) -> Result<bool> {
        let outside = self.span;
        if s.span.line > 0 {
            self.span = s.span;
        }
        self.target = s.targets().first().map(|x| (*x).clone());
        let continues = match &s.kind {
            // No choice reads the place here. The front end has put expressions that can fail into a statement
            // of their own.
            StmtKind::Set(x, e)
                if **x == *LOOK && !self.scope_of_choices.has(x) && !self.unit.effects.in_expr(e) =>
            {
                true
            }
            StmtKind::Set(x, e) => {
                let at = self.expr(e)?;
                self.assign(x, at);
                true
            }
            // Each name is bound to a part; no tuple is made.
            StmtKind::Unpack(xs, Expr { kind: ExprKind::Tuple(parts), .. }) if parts.len() == xs.len() => {
                let all = self.exprs(parts)?;
                xs.iter().zip(all).for_each(|(x, at)| self.assign(x, at));
                true
            }
            StmtKind::Unpack(xs, e) => {
                let from = self.expr(e)?;
                let registers = xs.iter().map(|_| self.register()).collect::<Result<Vec<_>>>()?;
                let to = self.args(&registers);
                self.op(Op::Unpack { from, to });
                xs.iter().zip(registers).for_each(|(x, at)| self.assign(x, at));
                true
            }
            StmtKind::UnpackStar(a, r, c, e) => {
                let from = self.expr(e)?;
                let names: Vec<&Name> = a.iter().chain(std::iter::once(r)).chain(c).collect();
                let registers = names.iter().map(|_| self.register()).collect::<Result<Vec<_>>>()?;
                let to = self.args(&registers);
                self.op(Op::UnpackStar { from, to, star: self.sixteen(a.len(), "names in one assignment")? });
                names.iter().zip(registers).for_each(|(x, at)| self.assign(x, at));
                true
            }
            StmtKind::If(c, a, b) => self.branch(c, a, b)?,
            StmtKind::For(x, over, body) => {
                let lifted = self.mode != Mode::Pure && self.unit.effects.in_block(body);
                if lifted {
                    self.lifted(s, Some((x, over)), None, body)?
                } else {
                    self.plain(s, Some((x, over)), None, body)?
                }
            }
            StmtKind::While(test, body) => {
                let suspends = self.unit.effects.in_block(body) || self.unit.effects.in_expr(test);
                if self.mode != Mode::Pure && suspends {
                    self.lifted(s, None, Some(test), body)?
                } else {
                    self.plain(s, None, Some(test), body)?
                }
            }
            StmtKind::Break => self.leave(true)?,
            StmtKind::Continue => self.leave(false)?,
            StmtKind::Return(e) => {
                let a = self.expr(e)?;
                self.return_value(a);
                false
            }
            StmtKind::Do(e) => {
                self.expr(e)?;
                true
            }
            StmtKind::Assert(c, m) => {
                let a = self.expr(c)?;
                let message = self.expr(m)?;
                self.op(Op::Assert { a, message });
                true
            }
        };
        self.span = outside;
        self.target = None;
        Ok(continues)
    }

    fn return_value(&mut self, a: Operand) {
        if self.mode == Mode::Iteration {
            self.return_iteration(exit::RETURN, Some(a));
        } else {
            self.clear_rest();
            self.op(Op::Return { a });
        }
    }

    /// Leaves an iteration with the current values of the carried variables.
    fn return_iteration(&mut self, kind: i64, value: Option<Operand>) {
        let carried = self.carried.clone();
        let mut operands: Vec<Operand> = carried.iter().map(|x| self.current(x)).collect();
        operands.extend(value);
        let args = self.args(&operands);
        self.clear_rest();
        self.op(Op::ReturnIteration { exit: kind as i8, args });
    }

    /// The operand of a variable, assigned or not.
    pub fn current(&mut self, x: &Name) -> Operand {
        match self.env.get(x) {
            Some(b) => b.at,
            None => self.unset(),
        }
    }

    fn branch(&mut self, c: &Expr, a: &[Stmt], b: &[Stmt]) -> Result<bool> {
        let (other, end) = (self.label(), self.label());
        self.branch_unless(c, other)?;
        let before = self.env.clone();
        let (head_of_a, first) = (self.code.len(), self.sites.len());
        let a_continues = self.block(a)?;
        let after_a = std::mem::replace(&mut self.env, before.clone());
        let end_of_a = self.code.len();
        if a_continues {
            self.jump(end);
        }
        let between = self.sites.len();
        self.bind(other);
        self.clear(first, between);
        let b_continues = self.block(b)?;
        match (a_continues, b_continues) {
            (true, true) => {
                let after_b = std::mem::take(&mut self.env);
                self.merge(&after_a, &after_b, end_of_a)?;
            }
            (true, false) => self.env = after_a,
            _ => {}
        }
        self.bind(end);
        self.clear_at(head_of_a, between, self.sites.len());
        Ok(a_continues || b_continues)
    }

    /// Merges two environments: where they differ, each arm writes the register of the merge. The first arm
    /// ends with the jump at `end_of_a`, the second arm ends here.
    fn merge(&mut self, a: &Environment, b: &Environment, end_of_a: usize) -> Result<()> {
        let names: Names = a.keys().chain(b.keys()).cloned().collect();
        let (mut moves_a, mut moves_b) = (Vec::new(), Vec::new());
        for x in names {
            let (p, q) = (a.get(&x).copied(), b.get(&x).copied());
            let maybe_unset = p.is_none_or(|p| p.maybe_unset) || q.is_none_or(|q| q.maybe_unset);
            let moment = p.into_iter().chain(q).map(|binding| binding.moment).max().unwrap_or(0);
            let at = match (p, q) {
                (Some(p), Some(q)) if p.at == q.at => p.at,
                _ => {
                    let to = self.register()?;
                    let unset = if p.is_none() || q.is_none() { Some(self.unset()) } else { None };
                    moves_a.extend(p.map(|p| p.at).or(unset).map(|from| Op::Move { to, from }));
                    moves_b.extend(q.map(|q| q.at).or(unset).map(|from| Op::Move { to, from }));
                    to
                }
            };
            self.env.insert(x, Binding { at, maybe_unset, moment });
        }
        for op in moves_b {
            self.op(op);
        }
        self.insert(end_of_a, moves_a);
        Ok(())
    }

    /// Lowers `break` (or `continue`).
    fn leave(&mut self, is_break: bool) -> Result<bool> {
        match self.loops.last() {
            None => return Err(CompileError("`break` or `continue` outside a loop".into())),
            Some(LoopContext::Lifted) => {
                self.return_iteration(if is_break { exit::BREAK } else { exit::NEXT }, None);
            }
            Some(LoopContext::Plain { variables, next, end }) => {
                let (variables, to) = (variables.clone(), if is_break { *end } else { *next });
                self.write_back(&variables)?;
                self.jump(to);
            }
        }
        Ok(false)
    }

    /// Writes the variables of a plain loop to their registers, all at once.
    fn write_back(&mut self, variables: &[(Name, Operand)]) -> Result<()> {
        let mut moves: Vec<(Operand, Operand)> = Vec::new();
        for (x, to) in variables {
            let from = self.current(x);
            if from != *to {
                moves.push((*to, from));
            }
        }
        // A source that another move overwrites first is saved.
        for i in 0..moves.len() {
            if moves[..i].iter().any(|m| m.0 == moves[i].1) {
                let saved = self.register()?;
                self.op(Op::Move { to: saved, from: moves[i].1 });
                moves[i].1 = saved;
            }
        }
        for (to, from) in moves {
            self.op(Op::Move { to, from });
        }
        Ok(())
    }

    /// Lowers a loop that cannot suspend: a plain jump.
    fn plain(
        &mut self,
        s: &Stmt,
        each: Option<(&Name, &Expr)>,
        test: Option<&Expr>,
        body: &[Stmt],
    ) -> Result<bool> {
        let mut variables_set = assigned(body);
        let mut iteration = None;
        if let Some((x, over)) = each {
            let over = self.expr(over)?;
            let (held, length, index) = (self.register()?, self.register()?, self.register()?);
            self.op(Op::Move { to: held, from: over });
            self.op(Op::Length { to: length, a: held });
            let zero = self.literal(&Literal::Int(0));
            self.op(Op::Move { to: index, from: zero });
            iteration = Some((x, held, index, length));
            variables_set.insert(x.clone());
        }
        // Each variable that a round can pass to the next round, or to the code after the loop, has a register
        // for the whole loop.
        let mut variables = Vec::new();
        let mut unset_before = Vec::new();
        for x in self.carried_variables(s, &variables_set) {
            let to = self.register()?;
            let from = self.current(&x);
            self.op(Op::Move { to, from });
            unset_before.push(self.env.get(&x).is_none_or(|b| b.maybe_unset));
            variables.push((x, to));
        }
        for ((x, at), maybe_unset) in variables.iter().zip(&unset_before) {
            self.assign_maybe(x, *at, *maybe_unset);
        }
        let (head, end) = (self.label(), self.label());
        self.bind(head);
        let before = self.env.clone();
        if let Some((x, over, index, length)) = iteration {
            let to = self.register()?;
            self.op(Op::Next { to, over, index, length, target: Self::jump_target(end) });
            self.assign(x, to);
        }
        if let Some(test) = test {
            let out = self.label();
            self.branch_unless(test, out)?;
            self.loop_body(body, &variables, head, end)?;
            self.bind(out);
        } else {
            self.loop_body(body, &variables, head, end)?;
        }
        self.bind(end);
        // After the loop its variables move to registers of their own, so that the registers of the loop are
        // scratch.
        self.env = before;
        let mut after = Vec::new();
        for ((x, from), maybe_unset) in variables.into_iter().zip(unset_before) {
            let at = self.register()?;
            self.op(Op::Move { to: at, from });
            after.push((x, at, maybe_unset));
        }
        self.assign_all(body, &after);
        Ok(true)
    }

    /// The assigned variables that one iteration passes to the next, or to the code after the loop.
    fn carried_variables(&self, s: &Stmt, assigned: &Names) -> Vec<Name> {
        let live = self.heads.at(s);
        // Choices cannot read variables that a path has left unassigned, except for the place to look from.
        let is_kept = |x: &Name| self.scope_of_choices.has(x) && (**x == *LOOK || self.is_set(x));
        assigned.iter().filter(|x| live.contains(*x) || is_kept(x)).cloned().collect()
    }

    /// Assigns variables after a loop, in the order in which its body assigns them.
    fn assign_all(&mut self, body: &[Stmt], values: &[(Name, Operand, bool)]) {
        let names: Vec<Name> = values.iter().map(|value| value.0.clone()).collect();
        for x in in_order_of_assignment(body, &names) {
            for (_, at, maybe_unset) in values.iter().filter(|value| value.0 == x) {
                self.assign_maybe(&x, *at, *maybe_unset);
            }
        }
    }

    fn loop_body(
        &mut self,
        body: &[Stmt],
        variables: &[(Name, Operand)],
        next: super::emit::Label,
        end: super::emit::Label,
    ) -> Result<()> {
        self.loops.push(LoopContext::Plain { variables: variables.to_vec(), next, end });
        let continues = self.block(body)?;
        self.loops.pop();
        if continues {
            self.write_back(variables)?;
            self.jump(next);
        }
        Ok(())
    }

    /// Lowers a loop that can suspend.
    fn lifted(
        &mut self,
        s: &Stmt,
        each: Option<(&Name, &Expr)>,
        test: Option<&Expr>,
        body: &[Stmt],
    ) -> Result<bool> {
        let over = match each {
            Some((_, over)) => Some(self.expr(over)?),
            None => None,
        };
        let mut set = assigned(body);
        set.extend(each.map(|(x, _)| x.clone()));
        let carried = self.carried_variables(s, &set);
        let mut reads = Names::new();
        test.into_iter().for_each(|t| t.reads(&mut reads));
        crate::core::visit::each_stmt(body, &mut |s| {
            s.expressions().into_iter().for_each(|e| e.reads(&mut reads))
        });
        // The variables that choices in the body can read; a variable that the body assigns belongs to the
        // iteration.
        let kept = self.env.keys().filter(|x| self.scope_of_choices.has(x) && !set.contains(*x));
        reads.extend(kept.cloned());
        let captured: Vec<Name> =
            reads.into_iter().filter(|x| !carried.contains(x) && self.env.contains_key(x)).collect();
        let capture_at: Vec<Operand> = captured.iter().map(|x| self.env[x].at).collect();
        let carried_at: Vec<Operand> = carried.iter().map(|x| self.current(x)).collect();
        let label = each.map_or(Name::from("while"), |(x, _)| Name::from(readable(x)));
        let key = Name::from(format!("loop {label}"));

        let (header, function) = self.iteration(s, &label, &carried, &captured)?;
        let out = carried.iter().map(|_| self.register()).collect::<Result<Vec<_>>>()?;
        let exit = if returns(body) { Some((self.register()?, self.register()?)) } else { None };
        let kind = SiteKind::Loop(Loop {
            header,
            body: function,
            over,
            carried: self.args(&carried_at),
            captures: self.args(&capture_at),
            out: self.args(&out),
            exit,
        });
        self.target = None;
        self.add_site(kind, &key, (&s.label, Name::from(format!("{label}[]"))), &[])?;
        // Only the run knows whether the loop assigned the variable.
        let unset = |x: &Name| self.env.get(x).is_none_or(|b| b.maybe_unset);
        let after: Vec<_> = carried.into_iter().zip(out).map(|(x, at)| (x.clone(), at, unset(&x))).collect();
        self.assign_all(body, &after);
        if let Some((how, value)) = exit {
            let on = self.label();
            let is_return = self.literal(&Literal::Int(exit::RETURN));
            self.op(Op::JumpUnlessCompare {
                op: crate::code::Binary::Eq,
                a: how,
                b: is_return,
                target: Self::jump_target(on),
            });
            self.return_value(value);
            self.bind(on);
        }
        Ok(true)
    }

    /// Compiles the body of a lifted loop as a function of the element and the carried values.
    fn iteration(
        &mut self,
        s: &Stmt,
        label: &Name,
        carried: &[Name],
        captured: &[Name],
    ) -> Result<(FunctionId, FunctionId)> {
        let (each, test, body) = match &s.kind {
            StmtKind::For(x, _, body) => (Some(x), None, body),
            StmtKind::While(test, body) => (None, Some(test), body),
            _ => return Err(CompileError("an iteration of a statement that is not a loop".into())),
        };
        let n = self.occurrences.entry(format!("iteration {label}")).or_insert(0);
        let name = Name::from(format!("{}/{label}#{n}", self.name));
        *n += 1;
        let analyses = (self.heads, self.scope_of_choices);
        let mut b = Builder::new(&mut *self.unit, analyses, name, self.file, Mode::Iteration);
        b.span = s.span;
        b.carried = carried.to_vec();
        b.loops.push(LoopContext::Lifted);
        let element = if each.is_some() { Some(b.register()?) } else { None };
        if captured.len() >= Operand::MAX_INDEX {
            return Err(b.is_too_large(VALUES));
        }
        for (i, x) in captured.iter().enumerate() {
            b.env.insert(x.clone(), Binding { at: Operand::new(Place::Outer, i + 1), ..self.env[x] });
        }
        b.moment = self.moment;
        let mut values = Vec::new();
        for x in carried {
            values.push((x.clone(), b.register()?, self.env.get(x).is_none_or(|b| b.maybe_unset)));
        }
        b.assign_all(body, &values);
        if let (Some(x), Some(at)) = (each, element) {
            b.assign(x, at);
        }
        let out = b.label();
        if let Some(test) = test {
            b.branch_unless(test, out)?;
        }
        let (at_test, tested) = (b.env.clone(), b.sites.len());
        if b.block(body)? {
            b.return_iteration(exit::NEXT, None);
        }
        b.bind(out);
        if test.is_some() {
            b.env = at_test;
            b.clear(tested, b.sites.len());
            b.return_iteration(exit::BREAK, None);
        }
        let params = b.carried.len() + usize::from(element.is_some());
        let function: Function<S> = b.finish(params, 0, vec![], s.span)?;
        let header = Function {
            name: function.name.clone(),
            mode: Mode::Loop,
            params: 0,
            node_registers: captured.len() as u16 + 1,
            scratch_registers: 0,
            code: vec![],
            body: 0,
            inputs: vec![],
            outers: vec![],
            spans: vec![],
            operands: vec![],
            constants: vec![],
            names: vec![],
            sites: vec![],
            scope: vec![],
            ..function.clone()
        };
        self.unit.functions.extend([Some(header), Some(function)]);
        let last = self.unit.functions.len() as u32 - 1;
        Ok((FunctionId(last - 1), FunctionId(last)))
    }
}

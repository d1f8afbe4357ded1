//! The builder of one function: registers, labels, constants and the environment from variables to operands.

use super::liveness::LoopHeads;
use super::scope::FunctionScope;
use super::{CompileError, Unit, literal, place};
use crate::builtins::make_dist;
use crate::code::entries::Entries;
use crate::code::{Args, Function, FunctionId, Mode, Op, Operand, Place, Site, Visible};
use crate::core::{self, ExprKind, Literal, Name, Span};
use crate::value::{self, Value};
use niwaki_math::Scalar;
use std::collections::HashMap;
use std::sync::Arc;

/// The most instructions or operands of a function: the passes take time that grows with the square of the
/// number.
const MOST_CODE: usize = 1 << 18;

/// The most items of a kind that a function may have, and the name of the kind.
pub(crate) type Limit = (usize, &'static str);

/// The limit on registers of a function.
pub(crate) const VALUES: Limit =
    (Operand::MAX_INDEX + 1, "values (its variables, and the results of its expressions)");

pub(crate) type Result<T> = std::result::Result<T, CompileError>;

/// The value of a variable at a point of the program.
#[derive(Clone, Copy)]
pub(crate) struct Binding {
    pub at: Operand,
    /// Whether some path leaves the variable unassigned.
    pub maybe_unset: bool,
    /// The number of its last assignment, in program order.
    pub moment: u32,
}

pub(crate) type Environment = HashMap<Name, Binding>;

/// A place in the code that becomes known later.
#[derive(Clone, Copy)]
pub(crate) struct Label(usize);

/// The meaning of `break` and `continue` at a place.
pub(crate) enum LoopContext {
    /// A plain loop: the registers of the loop's variables, and the jump targets.
    Plain { variables: Vec<(Name, Operand)>, next: Label, end: Label },
    /// The body of a lifted loop: the iteration returns.
    Lifted,
}

pub(crate) struct Builder<'u, 'm, S: Scalar> {
    pub unit: &'u mut Unit<'m, S>,
    pub heads: &'u LoopHeads,
    pub scope_of_choices: &'u FunctionScope,
    pub name: Name,
    pub file: u32,
    pub mode: Mode,
    pub code: Vec<Op>,
    pub spans: Vec<Span>,
    pub span: Span,
    pub operands: Vec<Operand>,
    pub constants: Vec<Value<S>>,
    pub literals: Vec<(Literal, Operand)>,
    pub data: HashMap<usize, Operand>,
    pub names: Vec<Name>,
    pub sites: Vec<Site>,
    pub scope: Vec<Visible>,
    pub occurrences: HashMap<String, u32>,
    pub labels: Vec<Option<usize>>,
    pub registers: usize,
    pub env: Environment,
    pub loops: Vec<LoopContext>,
    /// The carried variables of an iteration, in order.
    pub carried: Vec<Name>,
    /// The moment of the last assignment.
    pub moment: u32,
    /// The variable that the current statement assigns.
    pub target: Option<Name>,
    /// The first limit that the function exceeds.
    pub too_large: Option<Limit>,
}

impl<'u, 'm, S: Scalar> Builder<'u, 'm, S> {
    pub fn new(
        unit: &'u mut Unit<'m, S>,
        (heads, scope_of_choices): (&'u LoopHeads, &'u FunctionScope),
        name: Name,
        file: u32,
        mode: Mode,
    ) -> Self {
        Builder {
            unit,
            heads,
            scope_of_choices,
            name,
            file,
            mode,
            code: vec![],
            spans: vec![],
            span: Span::default(),
            operands: vec![],
            constants: vec![],
            literals: vec![],
            data: HashMap::new(),
            names: vec![],
            sites: vec![],
            scope: vec![],
            occurrences: HashMap::new(),
            labels: vec![],
            registers: 0,
            env: HashMap::new(),
            loops: vec![],
            carried: vec![],
            moment: 0,
            target: None,
            too_large: None,
        }
    }

    /// Lowers one function of the module.
    pub fn function(unit: &mut Unit<'m, S>, f: &'m core::Function, mode: Mode) -> Result<Function<S>> {
        let (heads, scope_of_choices) = (LoopHeads::of(&f.body), FunctionScope::of(f, unit.scope));
        let mut b = Builder::new(unit, (&heads, &scope_of_choices), f.name.clone(), f.file, mode);
        b.span = f.span;
        let inputs: Vec<(&Name, Operand)> =
            f.params.iter().chain(&f.captures).map(|x| Ok((x, b.register()?))).collect::<Result<_>>()?;
        // Captured variables were assigned before the call, or never.
        let (params, captures) = inputs.split_at(f.params.len());
        let id = b.function_id(&f.name)?;
        for (i, (x, at)) in captures.iter().enumerate() {
            let maybe_unset = b.unit.unassigned.contains(&(id, i));
            b.assign_maybe(x, *at, maybe_unset);
        }
        params.iter().for_each(|(x, at)| b.assign(x, *at));
        let defaults = f.defaults.iter().map(|e| b.default(f, e)).collect::<Result<Vec<_>>>()?;
        if b.block(&f.body)? {
            let none = b.literal(&Literal::None);
            b.op(Op::Return { a: none });
        }
        let mut function = b.finish(f.params.len(), f.captures.len(), defaults, f.span)?;
        function.parameters = f.params.iter().map(|x| Name::from(core::readable(x))).collect();
        Ok(function)
    }

    fn default(&mut self, f: &core::Function, e: &core::Expr) -> Result<Operand> {
        match &e.kind {
            ExprKind::Literal(l) => Ok(self.literal(l)),
            ExprKind::Data(k) => self.data(*k),
            ExprKind::Var(x) => match f.captures.iter().position(|c| c == x) {
                Some(i) => Ok(Operand::new(Place::Node, f.params.len() + i)),
                None => Err(CompileError(format!(
                    "a default of `{}` reads `{x}`, which it does not capture",
                    f.name
                ))),
            },
            _ => {
                let value = self.fixed(e)?;
                Ok(self.constant(value))
            }
        }
    }

    /// The value of an expression that consists of constants and of functions without captures.
    fn fixed(&self, e: &core::Expr) -> Result<Value<S>> {
        use ExprKind::*;
        let all = |items: &[core::Expr]| items.iter().map(|e| self.fixed(e)).collect::<Result<Vec<_>>>();
        Ok(match &e.kind {
            Literal(l) => literal(l),
            Data(k) => {
                let value = self.unit.data.get(*k).cloned();
                value.ok_or_else(|| CompileError(format!("constant {k} is missing")))?
            }
            // A frame is no capture of the function's own.
            Closure(name, captures) if captures.iter().all(super::frames::is_no_frame) => {
                let id = self.function_id(name)?;
                if self.definition(id).captures.len() != captures.len() {
                    return Err(CompileError(format!("a closure of `{name}` without its captures")));
                }
                let captures = all(captures)?;
                Value::Function(Arc::new(value::Closure { function: id.0, memo: None, captures }))
            }
            Dist(family, args) => {
                Value::Dist(Arc::new(make_dist(super::sites::family(family)?, &all(args)?)?))
            }
            Record(class, fields) => {
                let class = Arc::new(self.unit.module.classes[*class].clone());
                Value::Record(Arc::new(value::Record { class, fields: all(fields)? }))
            }
            List(items) => Value::list(all(items)?),
            Tuple(items) => Value::tuple(all(items)?),
            Dict(keys, values) => {
                let pairs = all(keys)?.into_iter().zip(all(values)?).collect();
                Value::Dict(Arc::new(value::Dict::new(pairs)))
            }
            _ => {
                return Err(CompileError(format!(
                    "a default of `{}` does not consist of constants",
                    self.name
                )));
            }
        })
    }

    /// Resolves labels, chooses places for the registers and returns the function.
    pub fn finish(
        mut self,
        params: usize,
        captures: usize,
        defaults: Vec<Operand>,
        span: Span,
    ) -> Result<Function<S>> {
        for op in &mut self.code {
            if let Op::Jump { target }
            | Op::JumpIf { target, .. }
            | Op::JumpUnless { target, .. }
            | Op::JumpUnlessCompare { target, .. }
            | Op::Next { target, .. } = op
            {
                let at = self.labels[*target as usize];
                *target = at.ok_or_else(|| CompileError("a jump without a target".into()))? as u32;
            }
        }
        self.limit(self.code.len() > MOST_CODE, (MOST_CODE, "instructions"));
        self.limit(self.operands.len() > MOST_CODE, (MOST_CODE, "arguments of instructions"));
        if let Some(limit) = self.too_large {
            return Err(self.is_too_large(limit));
        }
        let sites =
            self.sixteen(self.sites.len(), "choices, effects, loops and calls of functions with some")?;
        let (params, captures) =
            (self.sixteen(params, "parameters")?, self.sixteen(captures, "captured variables")?);
        for op in &mut self.code {
            if let Op::Clear { to, .. } = op {
                *to = sites.min(*to);
            }
        }
        let mut f = Function {
            name: self.name,
            file: self.file,
            span,
            mode: self.mode,
            params,
            defaults,
            captures,
            node_registers: 0,
            scratch_registers: 0,
            code: self.code,
            body: 0,
            inputs: vec![],
            outers: vec![],
            spans: self.spans,
            operands: self.operands,
            constants: self.constants,
            names: self.names,
            sites: self.sites,
            parameters: vec![],
            native: Entries::default(),
            scope: self.scope,
        };
        place::place(&mut f, self.registers);
        super::slices::slice(&mut f);
        Ok(f)
    }

    pub fn op(&mut self, op: Op) {
        self.code.push(op);
        self.spans.push(self.span);
    }

    /// Assigns a value to a variable.
    pub fn assign(&mut self, x: &Name, at: Operand) {
        self.assign_maybe(x, at, false);
    }

    /// Assigns a value to a variable that some paths may leave unassigned.
    pub fn assign_maybe(&mut self, x: &Name, at: Operand, maybe_unset: bool) {
        self.moment += 1;
        self.env.insert(x.clone(), Binding { at, maybe_unset, moment: self.moment });
    }

    /// Whether every path has assigned a value to a variable.
    pub fn is_set(&self, x: &Name) -> bool {
        self.env.get(x).is_some_and(|binding| !binding.maybe_unset)
    }

    /// A new register; it is virtual until [`place`] decides.
    pub fn register(&mut self) -> Result<Operand> {
        if self.registers > Operand::MAX_INDEX {
            return Err(self.is_too_large(VALUES));
        }
        self.registers += 1;
        Ok(Operand::new(Place::Node, self.registers - 1))
    }

    pub fn is_too_large(&self, (most, kind): Limit) -> CompileError {
        let name = self.name.split('/').next().unwrap_or_default();
        CompileError(format!("`{name}` is too large: it has more than {most} {kind}"))
    }

    /// Records a limit that the function exceeds; the first one is reported.
    fn limit(&mut self, is_above: bool, limit: Limit) {
        if is_above {
            self.too_large.get_or_insert(limit);
        }
    }

    /// A count of the function as a number of 16 bits, which fits into an instruction.
    pub fn sixteen(&self, number: usize, kind: &'static str) -> Result<u16> {
        u16::try_from(number).map_err(|_| self.is_too_large((usize::from(u16::MAX), kind)))
    }

    /// Marks that from here on the sites numbered `from..to` are not on the path.
    pub fn clear(&mut self, from: usize, to: usize) {
        if from < to {
            self.op(Op::Clear { from: from as u16, to: to as u16 });
        }
    }

    /// Inserts a [`clear`](Self::clear) before the instruction at `at`.
    pub fn clear_at(&mut self, at: usize, from: usize, to: usize) {
        if from < to {
            self.insert(at, vec![Op::Clear { from: from as u16, to: to as u16 }]);
        }
    }

    /// Marks that the run leaves the function here: no later site of the function is on the path. The number of
    /// sites is known at the end.
    pub fn clear_rest(&mut self) {
        self.clear(self.sites.len(), u16::MAX as usize);
    }

    pub fn args(&mut self, operands: &[Operand]) -> Args {
        let start = self.operands.len() as u32;
        self.operands.extend_from_slice(operands);
        self.limit(
            operands.len() > usize::from(u16::MAX),
            (usize::from(u16::MAX), "arguments in one call or list"),
        );
        Args { start, len: operands.len() as u16 }
    }

    pub fn label(&mut self) -> Label {
        self.labels.push(None);
        Label(self.labels.len() - 1)
    }

    pub fn bind(&mut self, label: Label) {
        self.labels[label.0] = Some(self.code.len());
    }

    pub fn jump(&mut self, to: Label) {
        self.op(Op::Jump { target: to.0 as u32 });
    }

    pub fn jump_target(to: Label) -> u32 {
        to.0 as u32
    }

    /// Inserts instructions before the instruction at `at`. Labels after it move along; a label on it stays.
    pub fn insert(&mut self, at: usize, ops: Vec<Op>) {
        let (n, span) = (ops.len(), self.span);
        self.code.splice(at..at, ops);
        self.spans.splice(at..at, std::iter::repeat_n(span, n));
        for l in self.labels.iter_mut().flatten() {
            if *l > at {
                *l += n;
            }
        }
    }

    pub fn name(&mut self, name: &Name) -> u16 {
        let at = self.names.iter().position(|n| n == name).unwrap_or_else(|| {
            self.names.push(name.clone());
            self.names.len() - 1
        });
        self.limit(at > usize::from(u16::MAX), (usize::from(u16::MAX), "names of fields"));
        at as u16
    }

    pub fn constant(&mut self, value: Value<S>) -> Operand {
        self.constants.push(value);
        self.limit(self.constants.len() > Operand::MAX_INDEX + 1, (Operand::MAX_INDEX + 1, "constants"));
        Operand::new(Place::Constant, (self.constants.len() - 1).min(Operand::MAX_INDEX))
    }

    pub fn literal(&mut self, l: &Literal) -> Operand {
        let identical = |a: &Literal, b: &Literal| match (a, b) {
            (Literal::Real(x), Literal::Real(y)) => x.to_bits() == y.to_bits(),
            _ => a == b,
        };
        if let Some((_, at)) = self.literals.iter().find(|(k, _)| identical(k, l)) {
            return *at;
        }
        let at = self.constant(literal(l));
        self.literals.push((l.clone(), at));
        at
    }

    pub fn data(&mut self, k: usize) -> Result<Operand> {
        if let Some(at) = self.data.get(&k) {
            return Ok(*at);
        }
        let value = self.unit.data.get(k).cloned();
        let value = value.ok_or_else(|| CompileError(format!("constant {k} is missing")))?;
        let at = self.constant(value);
        self.data.insert(k, at);
        Ok(at)
    }

    pub fn function_id(&self, name: &Name) -> Result<FunctionId> {
        let id = self.unit.ids.get(name).copied();
        id.ok_or_else(|| CompileError(format!("the function `{name}` is not defined")))
    }

    /// The definition of a function of the module.
    pub fn definition(&self, id: FunctionId) -> &'m core::Function {
        &self.unit.module.functions[id.0 as usize]
    }

    /// Whether a call of the function is a suspension site.
    pub fn is_effectful(&self, name: &Name) -> bool {
        self.unit.effects.function(name)
    }
}

//! The loop over instructions for lanes. It follows the loop of single runs (`machine::interpret`) instruction
//! by instruction, with the same steps and the same bytes.

use super::column::{Column, Side};
use super::questions::LaneAnswers;
use super::{Divergence, Lanes};
use crate::builtins;
use crate::code::{Args, Binary, Function, FunctionId, Mode, Op, Operand, exit};
use crate::machine::budget;
use crate::machine::keep::Dropped;
use crate::machine::operate;
use crate::machine::outcome::Continuation;
use crate::machine::outcome::Stop;
use crate::machine::registers::Registers;
use crate::machine::state::{FutureId, NodeId};
use crate::machine::workspace::{Machine, PureCall};
use crate::value::{Value, iter_get, iter_len, ops};

/// Running lanes: their place, with the registers of pure functions.
pub(super) struct Run<'r, 'p> {
    pub machine: &'r mut Machine<'p>,
    pub lanes: &'r mut Lanes,
    pub future: FutureId,
    pub node: NodeId,
    pub id: FunctionId,
    pub f: &'p Function,
    pub pc: usize,
    /// The first registers of the activation, of the loop node above it, and of a pure function.
    base: usize,
    outer: usize,
    pub scratch: usize,
    /// The columns of the machine's scratch registers, like `Lanes::columns`.
    scratch_columns: Vec<Option<Column>>,
}

impl<'r, 'p> Run<'r, 'p> {
    /// Begins at the instruction where the future is suspended.
    pub fn new(machine: &'r mut Machine<'p>, lanes: &'r mut Lanes, future: FutureId, node: NodeId) -> Self {
        let id = lanes.state.nodes[node.0 as usize].function;
        let (f, pc) = (machine.program.function(id), lanes.state.nodes[node.0 as usize].pc as usize);
        let scratch_columns = Vec::new();
        Run { machine, lanes, future, node, id, f, pc, base: 0, outer: 0, scratch: 0, scratch_columns }
    }

    pub fn registers(&self) -> Registers<'p, f64> {
        Registers { f: self.f, base: self.base, outer: self.outer, scratch: self.scratch }
    }

    /// The column of an operand whose values differ.
    #[inline]
    pub fn column(&self, o: Operand) -> Option<&Column> {
        if o.is_node() {
            self.lanes.columns[self.base + o.index()].as_ref()
        } else if o.is_outer() {
            self.lanes.columns[self.outer + o.index()].as_ref()
        } else if o.is_constant() {
            None
        } else {
            self.scratch_columns.get(self.scratch + o.index()).and_then(Option::as_ref)
        }
    }

    /// The value of an operand that all lanes share.
    #[inline]
    pub fn value(&self, o: Operand) -> &Value {
        self.registers().get(&self.lanes.state, &self.machine.scratch, o)
    }

    pub fn side(&self, o: Operand) -> Side {
        match self.column(o) {
            Some(column) => Side::Each(column.clone()),
            None => Side::All(self.value(o).clone()),
        }
    }

    pub fn sides(&self, args: Args) -> Vec<Side> {
        self.f.operands[args.range()].iter().map(|o| self.side(*o)).collect()
    }

    fn are_shared(&self, args: Args) -> bool {
        self.f.operands[args.range()].iter().all(|o| self.column(*o).is_none())
    }

    /// Writes a register of the current function.
    pub fn put(&mut self, to: Operand, side: Side) {
        if to.is_node() {
            return self.store(self.base + to.index(), side);
        }
        let at = self.scratch + to.index();
        if self.scratch_columns.len() <= at {
            self.scratch_columns.resize(at + 1, None);
        }
        let (value, column) = split(side);
        self.machine.holds_shared |= !value.is_plain();
        self.machine.scratch[at].store(value);
        self.scratch_columns[at] = column;
    }

    /// Writes a register of the state.
    pub fn store(&mut self, register: usize, side: Side) {
        let (value, column) = split(side);
        self.lanes.state.registers[register].store(value);
        self.lanes.columns[register] = column;
    }

    /// Continues in another activation.
    pub fn enter(&mut self, node: NodeId, pc: usize) {
        (self.node, self.pc) = (node, pc);
        self.id = self.lanes.state.nodes[node.0 as usize].function;
        self.f = self.machine.program.function(self.id);
        (self.base, self.outer) = self.machine.bases(&self.lanes.state, self.f, node);
        self.machine.reserve(self.scratch + self.f.scratch_registers as usize);
    }

    /// Counts a call, an iteration or a backward jump.
    #[inline]
    pub fn step(&mut self) -> Result<(), Divergence> {
        let state = &mut self.lanes.state;
        state.steps += 1;
        if state.steps > state.alarm { Ok(self.machine.check_limits(state, &Dropped)?) } else { Ok(()) }
    }

    fn goto(&mut self, target: u32) -> Result<(), Divergence> {
        if target as usize <= self.pc {
            self.step()?;
        }
        self.pc = target as usize;
        Ok(())
    }

    /// The truth of an operand, which all lanes must share.
    fn truth(&self, a: Operand) -> Result<bool, Divergence> {
        match self.column(a) {
            None => Ok(ops::truth(self.value(a))?),
            Some(column) => self.common_truth(column),
        }
    }

    /// Enters a pure function with these arguments and captures.
    pub fn enter_pure(
        &mut self,
        function: FunctionId,
        to: Operand,
        inputs: Vec<Side>,
    ) -> Result<(), Divergence> {
        self.step()?;
        let (caller, pc, scratch) = (self.id, self.pc + 1, self.scratch);
        let call = PureCall { caller, pc, scratch, to, as_future: false };
        self.machine.pure.push(call);
        self.scratch += self.f.scratch_registers as usize;
        self.id = function;
        self.f = self.machine.program.function(function);
        let end = self.scratch + self.f.scratch_registers as usize;
        let deeper = self.machine.reserve(end);
        // Columns that an earlier call left there have no meaning.
        let end = self.scratch_columns.len().min(end);
        self.scratch_columns.get_mut(self.scratch..end).unwrap_or_default().fill(None);
        for (i, side) in inputs.into_iter().enumerate() {
            self.put(Operand::new(crate::code::Place::Scratch, i), side);
        }
        if deeper {
            self.machine.afford(&mut self.lanes.state, &Dropped)?;
        }
        self.pc = 0;
        Ok(())
    }

    /// Runs up to the next question whose answer is to pause, or to the end.
    pub fn run<A: LaneAnswers>(mut self, answers: &mut A) -> Result<Stop, Divergence> {
        self.enter(self.node, self.pc);
        if self.f.mode == Mode::Pure {
            return Err(Divergence);
        }
        loop {
            match self.f.code[self.pc] {
                Op::Move { to, from } => {
                    let side = self.side(from);
                    self.put(to, side);
                }
                Op::Add { to, a, b } => self.binary(Binary::Add, to, a, b)?,
                Op::Sub { to, a, b } => self.binary(Binary::Sub, to, a, b)?,
                Op::Mul { to, a, b } => self.binary(Binary::Mul, to, a, b)?,
                Op::Div { to, a, b } => self.binary(Binary::Div, to, a, b)?,
                Op::Binary { op, to, a, b } => self.binary(op, to, a, b)?,
                Op::Neg { to, a } => self.negate(to, a)?,
                Op::Not { to, a } => match self.column(a).cloned() {
                    None => {
                        let value = Value::Bool(!ops::truth(self.value(a))?);
                        self.put(to, Side::All(value));
                    }
                    Some(column) => {
                        let value = |lane| Ok(Value::Bool(!ops::truth(&column.get(lane))?));
                        let column = Column::of(self.lanes.count, value)?;
                        self.put(to, Side::Each(column));
                    }
                },
                Op::Jump { target } => {
                    self.goto(target)?;
                    continue;
                }
                Op::JumpIf { a, target } => {
                    if self.truth(a)? {
                        self.goto(target)?;
                        continue;
                    }
                }
                Op::JumpUnless { a, target } => {
                    if !self.truth(a)? {
                        self.goto(target)?;
                        continue;
                    }
                }
                Op::JumpUnlessCompare { op, a, b, target } => {
                    if !self.compare(op, a, b)? {
                        self.goto(target)?;
                        continue;
                    }
                }
                Op::Builtin { to, id, args } => self.builtin(to, builtins::builtin(id), args)?,
                Op::CallPure { to, function, args } => {
                    let inputs = self.sides(args);
                    self.enter_pure(FunctionId(u32::from(function)), to, inputs)?;
                    continue;
                }
                Op::Length { to, a } => {
                    let length = match self.column(a) {
                        None => iter_len(self.value(a))?,
                        Some(column) => self.length(column)?,
                    };
                    self.put(to, Side::All(Value::Int(length as i64)));
                }
                Op::Next { to, over, index, length, target } => {
                    let (Value::Int(i), Value::Int(n)) = (self.value(index), self.value(length)) else {
                        return Err(Divergence);
                    };
                    let i = *i;
                    if i >= *n {
                        self.goto(target)?;
                        continue;
                    }
                    let item = self.element(over, i as usize)?;
                    self.put(to, item);
                    self.put(index, Side::All(Value::Int(i + 1)));
                }
                Op::CheckSet { a, .. } => {
                    if self.column(a).is_none() && matches!(self.value(a), Value::Unset) {
                        return Err(Divergence);
                    }
                }
                Op::Clear { .. } => {}
                Op::Assert { a, .. } => {
                    if !self.truth(a)? {
                        return Err(Divergence);
                    }
                }
                Op::Return { a } => {
                    let side = self.side(a);
                    match self.give_back(side) {
                        Some(()) => continue,
                        None => return Ok(Stop::Returned),
                    }
                }
                Op::ReturnIteration { exit: kind, args } => {
                    let kind = i64::from(kind);
                    if kind == exit::NEXT && self.next_iteration(args)? {
                        self.step()?;
                        self.pc = 0;
                        continue;
                    }
                    match self.end_loop(kind, args) {
                        Some(()) => continue,
                        None => return Ok(Stop::Returned),
                    }
                }
                Op::Site { site } => match self.site(site, answers)? {
                    Continuation::Next => {}
                    Continuation::Enter(inner, at) => {
                        self.step()?;
                        self.enter(inner, at as usize);
                        continue;
                    }
                    Continuation::Entered => continue,
                    Continuation::Stop(stop) => return Ok(stop),
                    Continuation::Goto(_) | Continuation::Pure { .. } => return Err(Divergence),
                },
                op @ (Op::List { args, .. }
                | Op::Tuple { args, .. }
                | Op::Dict { args, .. }
                | Op::Record { args, .. }
                | Op::Closure { args, .. }
                | Op::Dist { args, .. }) => {
                    if self.are_shared(args) {
                        self.construct(op)?;
                    } else {
                        self.build(op, args)?;
                    }
                }
                op @ Op::Field { to, a, name } => match self.column(a).cloned() {
                    None => self.construct(op)?,
                    Some(column) => self.field(to, &column, name)?,
                },
                op @ Op::Unpack { from, to } => match self.column(from).cloned() {
                    None => self.construct(op)?,
                    Some(column) => self.unpack(&column, to)?,
                },
                op @ Op::UnpackStar { from, .. } => {
                    if self.column(from).is_some() {
                        return Err(Divergence);
                    }
                    self.construct(op)?;
                }
                Op::Host { .. } | Op::Pass { .. } | Op::Done => return Err(Divergence),
            }
            self.pc += 1;
        }
    }

    /// Runs an instruction on values that all lanes share.
    fn construct(&mut self, op: Op) -> Result<(), Divergence> {
        let r = self.registers();
        self.machine.construct(&mut self.lanes.state, &mut Dropped, r, op)?;
        match op {
            Op::Unpack { to, .. } | Op::UnpackStar { to, .. } => {
                let f = self.f;
                f.operands[to.range()].iter().for_each(|o| self.forget(*o));
            }
            Op::List { to, .. }
            | Op::Tuple { to, .. }
            | Op::Dict { to, .. }
            | Op::Record { to, .. }
            | Op::Closure { to, .. }
            | Op::Dist { to, .. }
            | Op::Field { to, .. } => self.forget(to),
            _ => {}
        }
        Ok(())
    }

    /// Forgets the column of a register, which now has one value for all lanes.
    fn forget(&mut self, to: Operand) {
        if to.is_node() {
            self.lanes.columns[self.base + to.index()] = None;
        } else if let Some(column) = self.scratch_columns.get_mut(self.scratch + to.index()) {
            *column = None;
        }
    }

    /// An element of a loop's sequence, which has more than `i` elements.
    fn element(&self, over: Operand, i: usize) -> Result<Side, Divergence> {
        match self.column(over) {
            None => Ok(Side::All(iter_get(self.value(over), i))),
            Some(column) => self.elements(column, i).map(Side::Each),
        }
    }

    /// Runs an operation on two operands.
    fn binary(&mut self, op: Binary, to: Operand, a: Operand, b: Operand) -> Result<(), Divergence> {
        let side = match (self.column(a), self.column(b)) {
            (None, None) => {
                let (x, y) = (self.value(a), self.value(b));
                let quick = match (x, y) {
                    (Value::Int(x), Value::Int(y)) => operate::ints(op, *x, *y).map(Value::Int),
                    _ if op == Binary::Index => Some(operate::values(op, x, y)?),
                    _ => None,
                };
                Side::All(match quick {
                    Some(value) => value,
                    None => {
                        let r = self.registers();
                        self.machine.operate(&mut self.lanes.state, &Dropped, r, op, (a, b))?
                    }
                })
            }
            _ => {
                let (x, y) = (self.side(a), self.side(b));
                Side::Each(self.operate(op, &x, &y)?)
            }
        };
        self.put(to, side);
        Ok(())
    }

    fn negate(&mut self, to: Operand, a: Operand) -> Result<(), Divergence> {
        let side = match self.column(a).cloned() {
            None => {
                let value = ops::neg(self.value(a))?;
                self.charge_each(|_| budget::of_result(&value))?;
                Side::All(value)
            }
            Some(column) => {
                let result = Column::of(self.lanes.count, |lane| Ok(ops::neg(&column.get(lane))?))?;
                self.charge_results(&result)?;
                Side::Each(result)
            }
        };
        self.put(to, side);
        Ok(())
    }

    /// Whether a comparison holds, on which all lanes must agree.
    fn compare(&mut self, op: Binary, a: Operand, b: Operand) -> Result<bool, Divergence> {
        if self.column(a).is_none() && self.column(b).is_none() {
            let (x, y) = (self.value(a), self.value(b));
            if x.is_plain() || y.is_plain() {
                return Ok(operate::holds(op, x, y)?);
            }
            let r = self.registers();
            return Ok(self.machine.compare(&mut self.lanes.state, &Dropped, r, op, (a, b))?);
        }
        let (x, y) = (self.side(a), self.side(b));
        let column = self.operate(op, &x, &y)?;
        self.common_truth(&column)
    }
}

/// Splits an operand into the value of the register itself and its column.
fn split(side: Side) -> (Value, Option<Column>) {
    match side {
        Side::Each(column) => (Value::None, Some(column)),
        Side::All(value) => (value, None),
    }
}

//! Calls, loops and returns of lanes: as for a single run (`machine::suspend`, `machine::loops`), with columns
//! beside the registers.

use super::Divergence;
use super::column::{Column, Side};
use super::interpret::Run;
use crate::code::{Args, FunctionId, Loop, Mode, Site, SiteId, SiteKind, exit};
use crate::machine::address::{iteration_key, join};
use crate::machine::budget;
use crate::machine::keep::Dropped;
use crate::machine::outcome::Continuation;
use crate::machine::state::{FutureId, Node, NodeId};
use crate::machine::suspend::defaults;
use crate::value::{Value, index, iter_get, iter_len, ops};

impl Run<'_, '_> {
    /// Runs a site that is neither a choice nor a factor.
    pub fn other(&mut self, number: SiteId, site: &Site) -> Result<Continuation, Divergence> {
        match &site.kind {
            SiteKind::Call { function } => {
                let inputs = self.sides(site.args);
                Ok(Continuation::Enter(self.call(number, site, *function, inputs)?, 0))
            }
            SiteKind::Apply => self.apply(number, site),
            SiteKind::Loop(l) => self.begin_loop(number, site, l),
            SiteKind::Query => {
                let key = self.side(self.f.operands[site.args.start as usize]);
                let Side::All(key) = key else { return Err(Divergence) };
                key.refuse_futures("the key of a query")?;
                key.refuse_as_key()?;
                Ok(Continuation::Next)
            }
            SiteKind::Cell { .. } => {
                let side = self.side(self.f.operands[site.args.start as usize]);
                self.store(self.registers().base + site.to.index(), side);
                Ok(Continuation::Next)
            }
            SiteKind::Append { .. } => {
                let [list, element] =
                    [0, 1].map(|i| self.side(self.f.operands[site.args.start as usize + i]));
                let side = match (&list, &element) {
                    (Side::All(list), Side::All(element)) => {
                        let longer = ops::append(list.clone(), element.clone())?;
                        self.lanes.state.charged += budget::of_append(&longer);
                        Side::All(longer)
                    }
                    _ => {
                        let longer = |lane| Ok(ops::append(list.get(lane), element.get(lane))?);
                        let longer = Column::of(self.lanes.count, longer)?;
                        let bytes = budget::of_append(&longer.get(0));
                        // Lists of different lengths have different prices.
                        self.length(&longer)?;
                        self.lanes.state.charged += bytes;
                        Side::Each(longer)
                    }
                };
                self.machine.afford(&mut self.lanes.state, &Dropped)?;
                self.store(self.registers().base + site.to.index(), side);
                Ok(Continuation::Next)
            }
            SiteKind::Read => {
                let [list, at] = [0, 1].map(|i| self.side(self.f.operands[site.args.start as usize + i]));
                let side = match (&list, &at) {
                    (Side::All(list), Side::All(at)) => Side::All(index::index(list, at)?),
                    _ => Side::Each(self.operate(crate::code::Binary::Index, &list, &at)?),
                };
                self.store(self.registers().base + site.to.index(), side);
                Ok(Continuation::Next)
            }
            _ => Err(Divergence),
        }
    }

    /// Creates an activation with these arguments.
    fn call(
        &mut self,
        number: SiteId,
        site: &Site,
        function: FunctionId,
        inputs: Vec<Side>,
    ) -> Result<NodeId, Divergence> {
        let path = join(self.path(self.node), site.key);
        let (places, caller) = (self.lanes.state.places(), self.node);
        // For a known function that calls itself last, the registers are passed on.
        let is_known = matches!(site.kind, SiteKind::Call { .. });
        let created = if site.is_tail && is_known && self.lanes.state.is_deep() && self.id == function {
            self.forget_values(caller);
            let state = &mut self.lanes.state;
            state.new_node_in_place(self.machine.program, caller, u32::from(number.0), path)
        } else {
            self.new_node(function, caller, u32::from(number.0), path)
        };
        if self.lanes.state.places() > places {
            self.machine.afford(&mut self.lanes.state, &Dropped)?;
        }
        let at = self.first(created);
        for (i, side) in inputs.into_iter().enumerate() {
            self.store(at + i, side);
        }
        if site.is_tail && self.first(caller) != at {
            self.forget_values(caller);
            self.lanes.state.drop_values(self.machine.program, caller);
        }
        Ok(created)
    }

    /// Calls a function value, which all lanes must share.
    fn apply(&mut self, number: SiteId, site: &Site) -> Result<Continuation, Divergence> {
        let mut inputs = self.sides(site.args).into_iter();
        let Some(Side::All(Value::Function(closure))) = inputs.next() else { return Err(Divergence) };
        let function = FunctionId(closure.function);
        let f = self.machine.program.function(function);
        if closure.memo.is_some() {
            return Err(Divergence);
        }
        let frame = if self.machine.program.frames { inputs.next_back() } else { None };
        let left_out = defaults(f, &closure, inputs.len())?;
        let hidden = left_out.chain(&closure.captures).cloned().map(Side::All);
        let mut inputs: Vec<Side> = inputs.chain(hidden).collect();
        if let Some(frame) = frame.filter(|_| f.mode != Mode::Pure) {
            inputs.truncate(usize::from(f.params + f.captures) - 1);
            inputs.push(frame);
        }
        if f.mode == Mode::Pure {
            self.enter_pure(function, site.to, inputs)?;
            return Ok(Continuation::Entered);
        }
        Ok(Continuation::Enter(self.call(number, site, function, inputs)?, 0))
    }

    fn path(&self, node: NodeId) -> u128 {
        self.lanes.state.nodes[node.0 as usize].path
    }

    /// The first register of a node.
    fn first(&self, node: NodeId) -> usize {
        self.lanes.state.nodes[node.0 as usize].registers as usize
    }

    fn new_node(&mut self, function: FunctionId, parent: NodeId, site: u32, path: u128) -> NodeId {
        let state = &mut self.lanes.state;
        let created = state.new_node(self.machine.program, function, parent, site, path);
        self.lanes.columns.resize(state.registers.len(), None);
        created
    }

    /// Forgets the columns of a node's registers, which have no meaning any more.
    fn forget_values(&mut self, node: NodeId) {
        let n = self.lanes.state.nodes[node.0 as usize];
        let at = n.registers as usize;
        let count = self.machine.program.function(n.function).node_registers as usize;
        self.lanes.columns[at..at + count].fill(None);
    }

    fn release(&mut self, node: NodeId) {
        self.forget_values(node);
        self.lanes.state.fill(node);
        self.lanes.state.release(self.machine.program, node);
    }

    /// Enters a loop, or passes a loop without iterations.
    fn begin_loop(&mut self, number: SiteId, site: &Site, l: &Loop) -> Result<Continuation, Divergence> {
        let over = l.over.map(|o| self.side(o));
        let count = match &over {
            Some(Side::All(over)) => Some(iter_len(over)?),
            Some(Side::Each(column)) => Some(self.length(column)?),
            None => None,
        };
        let carried = self.sides(l.carried);
        if count == Some(0) {
            self.leave_loop(self.node, number, exit::NEXT, carried);
            return Ok(Continuation::Next);
        }
        let first = match &over {
            Some(Side::All(over)) => Some(Side::All(iter_get(over, 0))),
            Some(Side::Each(column)) => Some(Side::Each(self.elements(column, 0)?)),
            None => None,
        };
        let path = join(self.path(self.node), site.key);
        let places = self.lanes.state.places();
        let header = self.new_node(l.header, self.node, u32::from(number.0), path);
        let captures = self.sides(l.captures);
        let at = self.first(header);
        self.store(at, over.unwrap_or(Side::All(Value::None)));
        for (i, side) in captures.into_iter().enumerate() {
            self.store(at + 1 + i, side);
        }
        let inner = self.new_node(l.body, header, 0, join(path, iteration_key(0)));
        let at = self.first(inner);
        for (i, side) in first.into_iter().chain(carried).enumerate() {
            self.store(at + i, side);
        }
        if self.lanes.state.places() > places {
            self.machine.afford(&mut self.lanes.state, &Dropped)?;
        }
        Ok(Continuation::Enter(inner, 0))
    }

    /// Begins the next iteration in the node of the last one; returns `false` after the last iteration.
    pub fn next_iteration(&mut self, carried: Args) -> Result<bool, Divergence> {
        let Node { parent: header, iteration, .. } = self.lanes.state.nodes[self.node.0 as usize];
        let i = iteration + 1;
        let over = self.first(header);
        let element = match (&self.lanes.columns[over], &self.lanes.state.registers[over]) {
            (Some(column), _) if (i as usize) < self.length(column)? => {
                Some(Side::Each(self.elements(column, i as usize)?))
            }
            (Some(_), _) => return Ok(false),
            (None, Value::None) => None,
            (None, over) if (i as usize) < iter_len(over)? => Some(Side::All(iter_get(over, i as usize))),
            _ => return Ok(false),
        };
        let path = join(self.path(header), iteration_key(i));
        let carried = self.sides(carried);
        let n = &mut self.lanes.state.nodes[self.node.0 as usize];
        (n.iteration, n.path) = (i, path);
        let base = n.registers as usize;
        for (at, side) in element.into_iter().chain(carried).enumerate() {
            self.store(base + at, side);
        }
        Ok(true)
    }

    /// Ends the loop after an iteration that carries these values (and a returned value) out; `None` for a loop
    /// that runs apart.
    pub fn end_loop(&mut self, kind: i64, carried: Args) -> Option<()> {
        let carried = self.sides(carried);
        let header = self.lanes.state.nodes[self.node.0 as usize].parent;
        let above = self.lanes.state.nodes[header.0 as usize];
        self.release(self.node);
        self.release(header);
        let next = self.leave_loop(above.parent, SiteId(above.site as u16), kind, carried);
        self.enter(above.parent, next as usize);
        Some(())
    }

    /// Writes the results of a loop to the registers of its owner.
    fn leave_loop(&mut self, owner: NodeId, number: SiteId, kind: i64, mut carried: Vec<Side>) -> u32 {
        let n = self.lanes.state.nodes[owner.0 as usize];
        let (f, base) = (self.machine.program.function(n.function), n.registers as usize);
        let site = &f.sites[number.0 as usize];
        if let SiteKind::Loop(l) = &site.kind {
            if let Some((how, value)) = l.exit {
                if kind == exit::RETURN {
                    let returned = carried.pop().unwrap_or(Side::All(Value::None));
                    self.store(base + value.index(), returned);
                }
                self.store(base + how.index(), Side::All(Value::Int(kind)));
            }
            for (o, side) in f.operands[l.out.range()].iter().zip(carried) {
                self.store(base + o.index(), side);
            }
        }
        site.next
    }

    /// Returns from an activation or a pure function; `None` at the end of the run.
    pub fn give_back(&mut self, side: Side) -> Option<()> {
        if let Some(call) = self.machine.pure.pop() {
            self.id = call.caller;
            self.f = self.machine.program.function(self.id);
            (self.scratch, self.pc) = (call.scratch, call.pc);
            self.put(call.to, side);
            return Some(());
        }
        let n = self.lanes.state.nodes[self.node.0 as usize];
        self.release(self.node);
        if n.parent == NodeId::NONE {
            let value = match side {
                Side::All(value) => value,
                Side::Each(column) => {
                    self.lanes.result = Some(column);
                    Value::None
                }
            };
            self.lanes.state.returned(FutureId(0), value);
            return None;
        }
        let above = self.lanes.state.nodes[n.parent.0 as usize];
        let site = &self.machine.program.function(above.function).sites[n.site as usize];
        self.store(above.registers as usize + site.to.index(), side);
        self.enter(n.parent, site.next as usize);
        Some(())
    }
}

//! Lifted loops: a loop node that holds the sequence to run over, and one node for the current iteration.

use super::Machine;
use super::address::{iteration_key, join};
use super::keep::Dropped;
use super::outcome::Continuation;
use super::registers::Registers;
use super::state::{FutureId, Node, NodeId, State};
use crate::code::{Args, Loop, Site, SiteId, SiteKind, exit};
use crate::fault::Fault;
use crate::value::{Value, iter_get, iter_len};
use niwaki_math::Scalar;

impl<S: Scalar> Machine<'_, S> {
    /// Enters a loop, or passes a loop without iterations.
    pub(super) fn begin_loop(
        &mut self,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        site_id: SiteId,
        site: &Site,
        l: &Loop,
    ) -> Result<Continuation, Fault> {
        let over = l.over.map(|o| r.get(state, &self.scratch, o).clone());
        let first = match &over {
            Some(over) if iter_len(over)? == 0 => {
                r.gather(state, &self.scratch, l.carried, &mut self.buffer);
                self.leave_loop(state, node, site_id, exit::NEXT);
                return Ok(Continuation::Next);
            }
            Some(over) => Some(iter_get(over, 0)),
            None => None,
        };
        let path = join(state.nodes[node.0 as usize].path, site.key);
        let places = state.places();
        let header = state.new_node(self.program, l.header, node, u32::from(site_id.0), path);
        let at = state.nodes[header.0 as usize].registers as usize;
        r.gather(state, &self.scratch, l.captures, &mut self.buffer);
        state.registers[at].store(over.unwrap_or_default());
        for (i, value) in self.buffer.drain(..).enumerate() {
            state.registers[at + 1 + i].store(value);
        }
        let inner = state.new_node(self.program, l.body, header, 0, join(path, iteration_key(0)));
        let at = state.nodes[inner.0 as usize].registers as usize;
        r.gather(state, &self.scratch, l.carried, &mut self.buffer);
        for (i, value) in first.into_iter().chain(self.buffer.drain(..)).enumerate() {
            state.registers[at + i].store(value);
        }
        if state.places() > places {
            self.afford(state, &Dropped)?;
        }
        Ok(Continuation::Enter(inner, 0))
    }

    /// Begins the next iteration in the node of the last one; returns `false` after the last iteration.
    #[inline(always)]
    pub(super) fn next_iteration(
        &mut self,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        carried: Args,
    ) -> Result<bool, Fault> {
        let Node { parent: header, iteration, .. } = state.nodes[node.0 as usize];
        let i = iteration + 1;
        // The loop node's first register has the sequence of the loop.
        let element = match &state.registers[r.outer] {
            Value::Range(range) if (i as usize) < range.len => Some(Value::Int(range.at(i as usize))),
            Value::Range(_) => return Ok(false),
            Value::None => None,
            over if (i as usize) < iter_len(over)? => Some(iter_get(over, i as usize)),
            _ => return Ok(false),
        };
        let path = join(state.nodes[header.0 as usize].path, iteration_key(i));
        let n = &mut state.nodes[node.0 as usize];
        (n.iteration, n.path) = (i, path);
        // All carried values are read before any is written: they may be exchanged.
        let at = r.base + usize::from(element.is_some());
        match r.f.operands[carried.range()] {
            [] => {}
            [operand] => {
                let value = r.get(state, &self.scratch, operand).clone();
                state.registers[at].store(value);
            }
            _ => {
                r.gather(state, &self.scratch, carried, &mut self.buffer);
                for (register, value) in state.registers[at..].iter_mut().zip(self.buffer.drain(..)) {
                    register.store(value);
                }
            }
        }
        if let Some(element) = element {
            state.registers[r.base].store(element);
        }
        Ok(true)
    }

    /// Ends the loop after an iteration whose carried values (and returned value) are in the buffer. Returns
    /// where to continue; `None` for a loop that runs apart: then the future returns the values.
    pub(super) fn end_loop(
        &mut self,
        state: &mut State<S>,
        future: FutureId,
        node: NodeId,
        kind: i64,
    ) -> Option<(NodeId, u32)> {
        let header = state.nodes[node.0 as usize].parent;
        let above = state.nodes[header.0 as usize];
        state.release(self.program, node);
        state.release(self.program, header);
        if above.parent == NodeId::NONE {
            self.buffer.push(Value::Int(kind));
            state.returned(future, Value::tuple(self.buffer.drain(..).collect()));
            return None;
        }
        let next = self.leave_loop(state, above.parent, SiteId(above.site as u16), kind);
        Some((above.parent, next))
    }

    /// Writes the results of a loop, which are in the buffer, to the registers of its owner.
    fn leave_loop(&mut self, state: &mut State<S>, owner: NodeId, site: SiteId, kind: i64) -> u32 {
        let n = &state.nodes[owner.0 as usize];
        let (f, base) = (self.program.function(n.function), n.registers as usize);
        let site = &f.sites[site.0 as usize];
        if let SiteKind::Loop(l) = &site.kind {
            if let Some((how, value)) = l.exit {
                if kind == exit::RETURN {
                    state.registers[base + value.index()].store(self.buffer.pop().unwrap_or_default());
                }
                state.registers[base + how.index()].store(Value::Int(kind));
            }
            for (o, value) in f.operands[l.out.range()].iter().zip(self.buffer.drain(..)) {
                state.registers[base + o.index()].store(value);
            }
        }
        site.next
    }
}

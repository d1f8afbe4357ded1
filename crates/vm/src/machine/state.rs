//! The state of a run: nodes, registers and futures. A fork is `clone` (or `clone_from`, into the buffers of a
//! state that is no longer needed).
//!
//! | node | |
//! | --- | --- |
//! | function, parent, site | whose activation this is, who called it and where |
//! | registers | first of its registers in the state's register file |
//! | iteration | of an iteration: which one; of a memoised call: its number, with a mark (`Node::memo`) |
//! | pc | where a suspended activation continues |
//! | slots | first of its slots, where activations are kept (`kept`) |
//! | path | hash of the path of sites from the root |
//!
//! A released node keeps its block of registers and waits in its function's free list, so that after the first
//! iterations nothing is allocated.

use super::address;
use super::boxes::Parts;
use super::buffers::{copy, make_room};
use super::memos::Memos;
use super::numbers::Numbers;
use super::runnable::Runnable;
use crate::code::{FunctionId, Mode, Program};
use crate::value::{Census, Value};
use niwaki_math::Scalar;
use std::collections::HashMap;
use std::sync::Arc;

pub use super::ids::{FutureId, NodeId};

/// The number of activations that each have registers of their own, see [`State::is_deep`].
const SHALLOW: usize = 7;

/// An activation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub path: u128,
    pub function: FunctionId,
    pub parent: NodeId,
    /// The site in the parent's function; for the first node of a future, the future's number.
    pub site: u32,
    pub registers: u32,
    /// The number of an iteration; for the activation of a memoised call, see [`Node::memo`].
    pub iteration: u32,
    /// The place where a suspended activation continues; for a kept iteration, the kind of its exit.
    pub pc: u32,
    /// The first slot of a kept activation, or the number of a kept loop node among the loops. Otherwise see
    /// [`Node::LENT`].
    pub slots: u32,
    /// The transaction that created a kept activation.
    pub created: u32,
}

impl Node {
    /// The mark in [`Node::slots`] of a dropped activation whose registers now belong to the activation that it
    /// called last.
    const LENT: u32 = u32::MAX - 1;

    /// The mark in [`Node::slots`] of an activation that has dropped its contents at a call that comes last.
    const EMPTY: u32 = u32::MAX - 2;

    /// The mark of a memoised call in [`Node::iteration`].
    const MEMO: u32 = 1 << 31;

    /// An activation at its start, without registers.
    #[inline(always)]
    fn fresh(function: FunctionId, parent: NodeId, site: u32, path: u128) -> Node {
        Node { path, function, parent, site, registers: 0, iteration: 0, pc: 0, slots: u32::MAX, created: 0 }
    }

    /// The number of a memoised call: the number of its future, or of its entry in a trace. The first caller is
    /// not a part of its address.
    #[inline(always)]
    pub fn memo(&self) -> Option<u32> {
        (self.iteration & Node::MEMO != 0).then_some(self.iteration & !Node::MEMO)
    }

    /// Marks the node as the activation of a memoised call.
    pub fn set_memo(&mut self, number: u32) {
        self.iteration = Node::MEMO | number;
    }
}

/// The state of a future.
#[derive(Clone, Debug)]
pub(crate) enum Status<S: Scalar> {
    /// The future can run, from this node on.
    Runnable(NodeId),
    /// The future waits at this node for another future.
    Waiting(NodeId, FutureId),
    /// The memoised call runs from this node on, as a part of the future that requested it first.
    Inside(NodeId),
    /// The future has returned this value.
    Returned(Value<S>),
    /// The number can be used again.
    Free,
}

/// A future of the program.
#[derive(Clone, Debug)]
pub(crate) struct Future<S: Scalar> {
    pub status: Status<S>,
    /// The future that waits for this one, and the next future that waits for the same: a list that ends with
    /// `NONE`.
    pub waiter: FutureId,
    pub next_waiter: FutureId,
    /// Whether no value holds its handle: its number is free once it has returned.
    pub detached: bool,
    /// The register of the result, if the future waits for a memoised call; otherwise `u32::MAX`.
    pub receives: u32,
}

impl<S: Scalar> Future<S> {
    fn new(status: Status<S>, detached: bool) -> Self {
        Future { status, waiter: FutureId::NONE, next_waiter: FutureId::NONE, detached, receives: u32::MAX }
    }
}

/// The state of one run of a program.
#[derive(Debug)]
pub struct State<S: Scalar = f64> {
    pub(crate) nodes: Vec<Node>,
    pub(crate) registers: Vec<Value<S>>,
    /// The first free node of each function; free nodes are linked by `parent`.
    pub(crate) free: Vec<NodeId>,
    /// The first free node without registers, linked likewise: its registers went to the activation that it
    /// called last.
    pub(crate) bare: NodeId,
    pub(crate) futures: Vec<Future<S>>,
    pub(crate) free_futures: Vec<u32>,
    pub(crate) runnable: Runnable,
    pub(crate) unreturned: u32,
    /// Whether futures run where they are created.
    pub(crate) depth_first: bool,
    pub(crate) steps: u64,
    /// Bytes of values: those that the last audit found, and all that were made since.
    pub(crate) charged: usize,
    /// Bytes of the choices in the log.
    pub(crate) logged: usize,
    /// The next audit is due when [`State::bytes`] is above this.
    pub(crate) ceiling: usize,
    /// The limits are checked when the steps exceed this number.
    pub(crate) alarm: u64,
    /// The arguments and captures of the run: they belong to the caller, and are not counted.
    pub(crate) inputs: Option<Arc<[Value<S>]>>,
    /// Held choices that the run has not met.
    pub(crate) unmet: Numbers,
    /// Readable paths of the first activations of futures, if they are recorded.
    pub(crate) origins: Option<HashMap<NodeId, String>>,
    /// The parts that activations emitted last, if they are recorded.
    pub(crate) parts: Parts,
    /// The memoised calls.
    pub(crate) memos: Memos,
}

impl<S: Scalar> Clone for State<S> {
    fn clone(&self) -> Self {
        let mut copy = State::empty();
        copy.clone_from(self);
        copy
    }

    fn clone_from(&mut self, source: &Self) {
        copy(&mut self.nodes, &source.nodes);
        copy(&mut self.registers, &source.registers);
        copy(&mut self.free, &source.free);
        self.bare = source.bare;
        copy(&mut self.futures, &source.futures);
        copy(&mut self.free_futures, &source.free_futures);
        self.runnable.clone_from(&source.runnable);
        self.unreturned = source.unreturned;
        self.depth_first = source.depth_first;
        self.steps = source.steps;
        self.charged = source.charged;
        self.logged = source.logged;
        self.ceiling = source.ceiling;
        self.alarm = source.alarm;
        let address = |values: &Option<Arc<[Value<S>]>>| values.as_ref().map(Arc::as_ptr);
        if address(&self.inputs) != address(&source.inputs) {
            self.inputs.clone_from(&source.inputs);
        }
        self.unmet.clone_from(&source.unmet);
        self.origins.clone_from(&source.origins);
        self.parts.clone_from(&source.parts);
        self.memos.clone_from(&source.memos);
    }
}

impl<S: Scalar> State<S> {
    /// An empty state.
    pub(crate) fn empty() -> Self {
        State {
            nodes: Vec::new(),
            registers: Vec::new(),
            free: Vec::new(),
            bare: NodeId::NONE,
            futures: Vec::new(),
            free_futures: Vec::new(),
            runnable: Runnable::default(),
            unreturned: 0,
            depth_first: false,
            steps: 0,
            charged: 0,
            logged: 0,
            ceiling: 0,
            alarm: 0,
            inputs: None,
            unmet: Numbers::default(),
            origins: None,
            parts: Parts::default(),
            memos: Memos::default(),
        }
    }

    /// Lets futures record where they were created, so that addresses below them are read from the root.
    pub fn remember_origins(&mut self) {
        self.origins = Some(HashMap::new());
    }

    /// The futures that can run, in an order that is the same in every run.
    pub fn runnable(&self) -> &Runnable {
        &self.runnable
    }

    /// Whether every future, the root included, has returned.
    pub fn has_ended(&self) -> bool {
        self.unreturned == 0
    }

    /// The path of the activation in which a runnable future is suspended: an address for the choice to run it.
    pub fn path_of(&self, future: FutureId) -> u128 {
        match self.futures[future.0 as usize].status {
            Status::Runnable(node) | Status::Waiting(node, _) => self.nodes[node.0 as usize].path,
            _ => address::ROOT,
        }
    }

    /// The function of the activation in which a runnable future is suspended; for a future that has not begun,
    /// the function that it calls.
    pub fn function_of(&self, future: FutureId) -> Option<FunctionId> {
        match self.futures.get(future.0 as usize)?.status {
            Status::Runnable(node) => Some(self.nodes[node.0 as usize].function),
            _ => None,
        }
    }

    /// Whether a future has returned; a new future may then have its number.
    pub fn has_returned(&self, future: FutureId) -> bool {
        matches!(
            self.futures.get(future.0 as usize).map(|future| &future.status),
            Some(Status::Returned(_) | Status::Free)
        )
    }

    /// The value that the program returned, once it has ended, with futures replaced by their values.
    pub fn result(&self) -> Value<S> {
        match self.futures.first().map(|f| &f.status) {
            Some(Status::Returned(value)) => self.resolve(value),
            _ => Value::None,
        }
    }

    /// Replaces every handle of a returned future in a value by that future's value.
    pub fn resolve(&self, value: &Value<S>) -> Value<S> {
        let returned = |id: u32| match self.futures.get(id as usize).map(|f| &f.status) {
            Some(Status::Returned(v)) => Some(v.clone()),
            _ => None,
        };
        value.replace_futures(&returned)
    }

    /// The state of a run that has ended with this value.
    pub fn of_result(value: Value<S>) -> Self {
        let root = Future::new(Status::Returned(value), false);
        State { futures: vec![root], ..State::empty() }
    }

    /// A hash of the places of all futures: the activation in which each is suspended, and the future that it
    /// waits for. Two runs of one program with equal hashes differ only in the values that their activations
    /// hold.
    pub fn suspension_hash(&self) -> u128 {
        let word = |a: u32, b: u32| u128::from(a) << 32 | u128::from(b);
        self.futures.iter().fold(self.memos.hash(self.futures.len() as u128), |hash, future| {
            let (kind, node, on) = match future.status {
                Status::Runnable(node) => (1, Some(node), 0),
                Status::Waiting(node, on) => (2, Some(node), on.0),
                Status::Returned(_) => (3, None, 0),
                Status::Free => (4, None, 0),
                Status::Inside(node) => (5, Some(node), 0),
            };
            let at = node.map(|node| &self.nodes[node.0 as usize]);
            let hash = address::join(hash, at.map_or(0, |at| at.path));
            address::join(hash, word(kind, at.map_or(0, |at| at.pc)) << 64 | u128::from(on))
        })
    }

    /// Steps taken so far: calls, iterations and backward jumps, and the steps of operations on many elements.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Bytes of nodes, registers and values, or more: values that were dropped since the last audit count as
    /// well.
    #[inline]
    pub fn bytes(&self) -> usize {
        self.own_bytes().saturating_add(self.charged).saturating_add(self.logged)
    }

    /// The part of [`State::bytes`] that values and logged choices take.
    #[inline]
    pub fn value_bytes(&self) -> usize {
        self.charged + self.logged
    }

    /// The number of nodes and registers, free ones included: when it has grown, the run must afford more.
    #[inline]
    pub(crate) fn places(&self) -> usize {
        self.nodes.len() + self.registers.len()
    }

    /// Bytes of nodes, registers and futures.
    #[inline]
    pub fn own_bytes(&self) -> usize {
        self.nodes.len() * size_of::<Node>()
            + self.registers.len() * size_of::<Value<S>>()
            + self.futures.len() * (size_of::<Future<S>>() + size_of::<FutureId>())
            + self.memos.bytes()
    }

    /// Counts the values that the run holds.
    pub fn count<'v>(&'v self, census: &mut Census<'v, S>) {
        self.registers.iter().for_each(|value| census.add(value));
        for future in &self.futures {
            if let Status::Returned(value) = &future.status {
                census.add(value);
            }
        }
    }

    /// Excludes the arguments and captures of the run from a census.
    pub fn leave_out_inputs(&self, census: &mut Census<'_, S>) {
        self.inputs.iter().flat_map(|inputs| inputs.iter()).for_each(|value| census.leave_out(value));
    }

    /// A node for an activation of `function`; the contents of its registers have no meaning.
    #[inline]
    pub(crate) fn new_node(
        &mut self,
        program: &Program<S>,
        function: FunctionId,
        parent: NodeId,
        site: u32,
        path: u128,
    ) -> NodeId {
        if self.free.is_empty() {
            self.free.resize(program.functions.len(), NodeId::NONE);
        }
        if let Some(node) = self.reuse_node(function, parent, site, path) {
            return node;
        }
        let at = self.registers.len();
        let count = program.function(function).node_registers as usize;
        let (used, ceiling) = (self.bytes(), self.ceiling);
        make_room(&mut self.registers, count, || ceiling.saturating_sub(used));
        self.registers.resize(at + count, Value::None);
        self.add_node(Node { registers: at as u32, ..Node::fresh(function, parent, site, path) })
    }

    /// A released node of `function`, as a new one; `None` if there is none.
    #[inline(always)]
    pub(super) fn reuse_node(
        &mut self,
        function: FunctionId,
        parent: NodeId,
        site: u32,
        path: u128,
    ) -> Option<NodeId> {
        let free = self.free.get_mut(function.0 as usize).filter(|free| **free != NodeId::NONE)?;
        let id = *free;
        let node = &mut self.nodes[id.0 as usize];
        *free = node.parent;
        let (registers, slots) = (node.registers, node.slots);
        *node = Node { registers, slots, ..Node::fresh(function, parent, site, path) };
        Some(id)
    }

    /// Whether the run has so many activations that a function that calls itself last hands its registers over. A call with
    /// registers of its own takes fewer instructions, but a copy of the run copies all registers.
    #[inline(always)]
    pub(crate) fn is_deep(&self) -> bool {
        self.nodes.len() > SHALLOW
    }

    /// A node for an activation of the same function that `caller` calls last. It takes over the registers of
    /// the caller, which drop their contents.
    pub(crate) fn new_node_in_place(
        &mut self,
        program: &Program<S>,
        caller: NodeId,
        site: u32,
        path: u128,
    ) -> NodeId {
        self.drop_values(program, caller);
        let above = &mut self.nodes[caller.0 as usize];
        let fresh = Node { path, parent: caller, site, iteration: 0, pc: 0, slots: u32::MAX, ..*above };
        above.slots = Node::LENT;
        self.add_node(fresh)
    }

    /// Adds a node, in place of a free node without registers if there is one.
    fn add_node(&mut self, fresh: Node) -> NodeId {
        let id = self.bare;
        if id != NodeId::NONE {
            self.bare = std::mem::replace(&mut self.nodes[id.0 as usize], fresh).parent;
            return id;
        }
        let (used, ceiling) = (self.bytes(), self.ceiling);
        make_room(&mut self.nodes, 1, || ceiling.saturating_sub(used));
        self.nodes.push(fresh);
        NodeId((self.nodes.len() - 1) as u32)
    }

    /// Releases a node. Its registers drop shared data; numbers may stay until they are overwritten.
    #[inline]
    pub(crate) fn release(&mut self, program: &Program<S>, id: NodeId) {
        let node = &mut self.nodes[id.0 as usize];
        // The borrower of lent registers was released just before, so they are free.
        let free = match node.slots {
            Node::LENT => &mut self.bare,
            _ => &mut self.free[node.function.0 as usize],
        };
        node.parent = std::mem::replace(free, id);
        if node.slots == Node::EMPTY {
            node.slots = u32::MAX;
        } else {
            self.drop_values(program, id);
        }
    }

    /// Drops the contents of an activation with so many registers, which returns after the call that it makes.
    #[inline]
    pub(super) fn drop_before_return(&mut self, id: NodeId, count: usize) {
        self.drop_registers(id, count);
        self.nodes[id.0 as usize].slots = Node::EMPTY;
    }

    /// Notes that a register of an activation may have got shared data.
    #[inline]
    pub(super) fn fill(&mut self, id: NodeId) {
        let node = &mut self.nodes[id.0 as usize];
        if node.slots == Node::EMPTY {
            node.slots = u32::MAX;
        }
    }

    /// Drops the shared data in the registers of a node, which nobody reads any more.
    #[inline]
    pub(crate) fn drop_values(&mut self, program: &Program<S>, id: NodeId) {
        let function = self.nodes[id.0 as usize].function;
        self.drop_registers(id, program.function(function).node_registers as usize);
    }

    #[inline]
    fn drop_registers(&mut self, id: NodeId, count: usize) {
        let at = self.nodes[id.0 as usize].registers as usize;
        let registers = &mut self.registers[at..at + count];
        registers.iter_mut().filter(|value| !value.is_plain()).for_each(|value| *value = Value::None);
    }

    /// Stops a future at an instruction of a node, to continue there later.
    #[inline(always)]
    pub(crate) fn pause(&mut self, future: FutureId, node: NodeId, pc: usize) {
        self.nodes[node.0 as usize].pc = pc as u32;
        // A running future is marked as runnable.
        if let Status::Runnable(at) = &mut self.futures[future.0 as usize].status {
            *at = node;
        }
    }

    /// Adds a future.
    pub(crate) fn new_future(&mut self, status: Status<S>, detached: bool) -> FutureId {
        if !matches!(status, Status::Returned(_) | Status::Inside(_)) {
            self.unreturned += 1;
        }
        let future = Future::new(status, detached);
        let id = match self.free_futures.pop() {
            Some(id) => {
                self.futures[id as usize] = future;
                id
            }
            None => {
                self.futures.push(future);
                (self.futures.len() - 1) as u32
            }
        };
        FutureId(id)
    }

    /// Records that a future has returned: futures that waited for it can run.
    pub(crate) fn returned(&mut self, id: FutureId, value: Value<S>) {
        self.unreturned -= 1;
        self.runnable.remove(id);
        self.settle(id, value);
    }

    /// Records the value of a future or a memoised call.
    pub(super) fn settle(&mut self, id: FutureId, value: Value<S>) {
        let future = &mut self.futures[id.0 as usize];
        let (waiter, detached) = (std::mem::replace(&mut future.waiter, FutureId::NONE), future.detached);
        if waiter != FutureId::NONE {
            self.wake(waiter, &value);
        }
        let future = &mut self.futures[id.0 as usize];
        future.status = if detached { Status::Free } else { Status::Returned(value) };
        if detached {
            self.free_futures.push(id.0);
        }
    }

    /// Wakes the futures that waited for a value: a list of futures, from the one that waited last.
    fn wake(&mut self, mut waiter: FutureId, value: &Value<S>) {
        // They are woken in the order of their numbers, not in the order in which they began to wait.
        let mut waiting = Vec::new();
        while waiter != FutureId::NONE {
            waiting.push(waiter);
            waiter = self.futures[waiter.0 as usize].next_waiter;
        }
        waiting.sort_unstable_by_key(|waiter| waiter.0);
        for waiter in waiting {
            let future = &mut self.futures[waiter.0 as usize];
            if let Status::Waiting(node, _) = future.status {
                future.status = Status::Runnable(node);
                let receives = std::mem::replace(&mut future.receives, u32::MAX);
                if receives != u32::MAX {
                    // The future waits at a call, which has its result now.
                    self.registers[receives as usize].store(value.clone());
                    self.nodes[node.0 as usize].pc += 1;
                }
                self.runnable.push(waiter);
            }
        }
    }

    /// Stops a future at a node, to continue when another future has returned.
    pub(super) fn wait(&mut self, future: FutureId, node: NodeId, awaited: FutureId) {
        let first = std::mem::replace(&mut self.futures[awaited.0 as usize].waiter, future);
        let waiting = &mut self.futures[future.0 as usize];
        waiting.next_waiter = first;
        waiting.status = Status::Waiting(node, awaited);
        self.runnable.remove(future);
    }

    /// The component of a loop's node in addresses, with the iteration left open. It is the component of the
    /// loop's site; for a loop that runs apart, its whole path.
    fn loop_label(&self, program: &Program<S>, header: NodeId) -> String {
        let n = &self.nodes[header.0 as usize];
        if n.parent == NodeId::NONE {
            let origin = self.origins.as_ref().and_then(|origins| origins.get(&header));
            return origin.cloned().unwrap_or_default();
        }
        let above = &self.nodes[n.parent.0 as usize];
        program.function(above.function).sites[n.site as usize].label.to_string()
    }

    /// The readable path of a loop's node, with the iteration left open.
    pub(crate) fn loop_path(&self, program: &Program<S>, header: NodeId) -> String {
        let above = self.path(program, self.nodes[header.0 as usize].parent);
        let label = self.loop_label(program, header);
        if above.is_empty() { label } else { format!("{above}/{label}") }
    }

    /// The readable path of an activation, from the root or from the future that it belongs to.
    pub(crate) fn path(&self, program: &Program<S>, node: NodeId) -> String {
        let mut parts: Vec<String> = Vec::new();
        let mut at = node;
        while at != NodeId::NONE {
            let n = &self.nodes[at.0 as usize];
            if n.memo().is_some() {
                parts.extend(self.memos.name(n.path).map(str::to_string));
                break;
            }
            if n.parent == NodeId::NONE {
                let origin = self.origins.as_ref().and_then(|origins| origins.get(&at));
                parts.extend(origin.cloned());
                break;
            }
            let parent = &self.nodes[n.parent.0 as usize];
            if program.function(parent.function).mode == Mode::Loop {
                // The component of a loop consists of the loop node's site and the iteration.
                let component = self.loop_label(program, n.parent);
                parts.push(component.replacen("[]", &format!("[{}]", n.iteration), 1));
                at = parent.parent;
            } else {
                parts.push(program.function(parent.function).sites[n.site as usize].label.to_string());
                at = n.parent;
            }
        }
        parts.reverse();
        parts.join("/")
    }
}

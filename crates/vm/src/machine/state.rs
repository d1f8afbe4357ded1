//! The state of a run: nodes, registers and futures. Forking it is `clone` (or `clone_from`, into the buffers
//! of a state that is no longer needed).
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

/// An activation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub path: u128,
    pub function: FunctionId,
    pub parent: NodeId,
    /// Site in the parent's function; of the first node of a future: the future's number.
    pub site: u32,
    pub registers: u32,
    /// Of an iteration: which one. Of the activation of a memoised call: [`Node::memo`].
    pub iteration: u32,
    /// Of a suspended activation: where it continues. Of a kept iteration: how it ended.
    pub pc: u32,
    /// Of a kept activation: its first slot; of a kept loop node: its number among the loops. Else see [`Node::LENT`].
    pub slots: u32,
    /// Of a kept activation: the transaction that created it.
    pub created: u32,
}

impl Node {
    /// In [`Node::slots`], where activations are dropped: the registers are those of the activation that it called last.
    const LENT: u32 = u32::MAX - 1;

    /// The mark of a memoised call in [`Node::iteration`].
    const MEMO: u32 = 1 << 31;

    /// Of the activation of a memoised call: its number, of its future or of its entry in a trace. Who called it first is
    /// no part of its address.
    #[inline(always)]
    pub fn memo(&self) -> Option<u32> {
        (self.iteration & Node::MEMO != 0).then_some(self.iteration & !Node::MEMO)
    }

    /// Marks it as the activation of a memoised call.
    pub fn set_memo(&mut self, number: u32) {
        self.iteration = Node::MEMO | number;
    }
}

/// The state of a future.
#[derive(Clone, Debug)]
pub(crate) enum Status<S: Scalar> {
    /// It can run, from this node.
    Runnable(NodeId),
    /// It waits at this node for another future.
    Waiting(NodeId, FutureId),
    /// Of a memoised call: it runs from this node as a part of the future that asked first.
    Inside(NodeId),
    /// It has returned.
    Returned(Value<S>),
    /// Its number is free to be used again.
    Free,
}

/// A future of the program.
#[derive(Clone, Debug)]
pub(crate) struct Future<S: Scalar> {
    pub status: Status<S>,
    /// The future that waits for it, and the next one that waits for the same: a list, `NONE` at its end.
    pub waiter: FutureId,
    pub next_waiter: FutureId,
    /// No value holds its handle: its number is free once it has returned.
    pub detached: bool,
    /// Where it waits for a memoised call: the register of the result. Elsewhere `u32::MAX`.
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
    /// First free node of each function; free nodes are linked by `parent`.
    pub(crate) free: Vec<NodeId>,
    /// First free node without registers, linked likewise: its registers went to the activation that it called last.
    pub(crate) bare: NodeId,
    pub(crate) futures: Vec<Future<S>>,
    pub(crate) free_futures: Vec<u32>,
    pub(crate) runnable: Runnable,
    pub(crate) unreturned: u32,
    /// Futures run where they are created.
    pub(crate) depth_first: bool,
    pub(crate) steps: u64,
    /// Bytes of values: those that the last audit found, and all that was made since.
    pub(crate) charged: usize,
    /// Bytes of the choices that were logged.
    pub(crate) logged: usize,
    /// The next audit is due when [`State::bytes`] is above this.
    pub(crate) ceiling: usize,
    /// The limits are looked at when more steps than these are taken.
    pub(crate) alarm: u64,
    /// What the run was given: it belongs to the caller, and is not counted.
    pub(crate) given: Option<Arc<[Value<S>]>>,
    /// Held choices that the run has not met.
    pub(crate) unmet: Numbers,
    /// Readable paths of the activations that futures began with, where they are kept.
    pub(crate) origins: Option<HashMap<NodeId, String>>,
    /// What activations emitted last, where it is noted.
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
        let address = |given: &Option<Arc<[Value<S>]>>| given.as_ref().map(Arc::as_ptr);
        if address(&self.given) != address(&source.given) {
            self.given.clone_from(&source.given);
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
            given: None,
            unmet: Numbers::default(),
            origins: None,
            parts: Parts::default(),
            memos: Memos::default(),
        }
    }

    /// From now on futures remember where they were created, so that addresses below them are read from the root.
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

    /// The path of the activation in which a runnable future is suspended: an address for the choice of running it.
    pub fn path_of(&self, future: FutureId) -> u128 {
        match self.futures[future.0 as usize].status {
            Status::Runnable(node) | Status::Waiting(node, _) => self.nodes[node.0 as usize].path,
            _ => address::ROOT,
        }
    }

    /// The function of the activation in which a runnable future is suspended; of one that has not begun, the function that
    /// it calls.
    pub fn function_of(&self, future: FutureId) -> Option<FunctionId> {
        match self.futures.get(future.0 as usize)?.status {
            Status::Runnable(node) => Some(self.nodes[node.0 as usize].function),
            _ => None,
        }
    }

    /// Whether a future has returned; another one may get its number.
    pub fn has_returned(&self, future: FutureId) -> bool {
        matches!(
            self.futures.get(future.0 as usize).map(|own| &own.status),
            Some(Status::Returned(_) | Status::Free)
        )
    }

    /// What the program returned, once it has ended, with futures replaced by their values.
    pub fn result(&self) -> Value<S> {
        match self.futures.first().map(|f| &f.status) {
            Some(Status::Returned(value)) => self.resolve(value),
            _ => Value::None,
        }
    }

    /// The value with every handle of a returned future replaced by that future's value.
    pub fn resolve(&self, value: &Value<S>) -> Value<S> {
        let known = |id: u32| match self.futures.get(id as usize).map(|f| &f.status) {
            Some(Status::Returned(v)) => Some(v.clone()),
            _ => None,
        };
        value.replace_futures(&known)
    }

    /// The state of a run that has ended with this value.
    pub fn of_result(value: Value<S>) -> Self {
        let root = Future::new(Status::Returned(value), false);
        State { futures: vec![root], ..State::empty() }
    }

    /// A hash of where every future is: which activation is suspended where, and which waits for which. Two runs of
    /// one program with equal hashes differ only in the values that their activations hold.
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

    /// Steps taken so far: calls, iterations and backward jumps, and those of operations on many elements.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Bytes that nodes, registers and values take, or more: values that were dropped since the last audit count, too.
    #[inline]
    pub fn bytes(&self) -> usize {
        self.own_bytes().saturating_add(self.charged).saturating_add(self.logged)
    }

    /// Of [`State::bytes`], those of values and of logged choices.
    #[inline]
    pub fn value_bytes(&self) -> usize {
        self.charged + self.logged
    }

    /// How many nodes and registers there are, free ones included: what may have to be afforded has grown where this has.
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

    /// What the run was given, which is not counted as what it holds.
    pub fn leave_out_given(&self, census: &mut Census<'_, S>) {
        self.given.iter().flat_map(|given| given.iter()).for_each(|value| census.leave_out(value));
    }

    /// A node for an activation of `function`; what its registers hold means nothing.
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
        let fresh = Node {
            path,
            function,
            parent,
            site,
            registers: 0,
            iteration: 0,
            pc: 0,
            slots: u32::MAX,
            created: 0,
        };
        let free = self.free[function.0 as usize];
        if free != NodeId::NONE {
            let node = &mut self.nodes[free.0 as usize];
            self.free[function.0 as usize] = node.parent;
            *node = Node { registers: node.registers, slots: node.slots, ..fresh };
            return free;
        }
        let at = self.registers.len();
        let count = program.function(function).node_registers as usize;
        let (taken, ceiling) = (self.bytes(), self.ceiling);
        make_room(&mut self.registers, count, || ceiling.saturating_sub(taken));
        self.registers.resize(at + count, Value::None);
        self.add_node(Node { registers: at as u32, ..fresh })
    }

    /// A node for an activation that `caller` calls last, of the same function. It takes over the registers of the caller, which
    /// drop what they hold.
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

    /// Adds a node, in the place of a free one without registers if there is one.
    fn add_node(&mut self, fresh: Node) -> NodeId {
        let id = self.bare;
        if id != NodeId::NONE {
            self.bare = std::mem::replace(&mut self.nodes[id.0 as usize], fresh).parent;
            return id;
        }
        let (taken, ceiling) = (self.bytes(), self.ceiling);
        make_room(&mut self.nodes, 1, || ceiling.saturating_sub(taken));
        self.nodes.push(fresh);
        NodeId((self.nodes.len() - 1) as u32)
    }

    /// Releases a node. Its registers drop what is shared; numbers may stay until they are overwritten.
    #[inline]
    pub(crate) fn release(&mut self, program: &Program<S>, id: NodeId) {
        let node = &mut self.nodes[id.0 as usize];
        // Of registers that are lent the borrower was released just before: they are free.
        let free = match node.slots {
            Node::LENT => &mut self.bare,
            _ => &mut self.free[node.function.0 as usize],
        };
        node.parent = std::mem::replace(free, id);
        self.drop_values(program, id);
    }

    /// The registers of a node drop what is shared: nothing reads them any more.
    #[inline]
    pub(crate) fn drop_values(&mut self, program: &Program<S>, id: NodeId) {
        let node = &self.nodes[id.0 as usize];
        let (function, at) = (node.function, node.registers as usize);
        let count = program.function(function).node_registers as usize;
        let registers = &mut self.registers[at..at + count];
        // Most activations hold numbers only: a first pass detects that without writing.
        if registers.iter().fold(false, |shared, value| shared | !value.is_plain()) {
            registers.iter_mut().filter(|value| !value.is_plain()).for_each(|value| *value = Value::None);
        }
    }

    /// A future stops at this instruction of this node, to continue there later.
    #[inline(always)]
    pub(crate) fn pause(&mut self, future: FutureId, node: NodeId, pc: usize) {
        self.nodes[node.0 as usize].pc = pc as u32;
        // A future that runs is marked as one that can run.
        if let Status::Runnable(at) = &mut self.futures[future.0 as usize].status {
            *at = node;
        }
    }

    /// A new future.
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

    /// A future has returned: those that waited for it can run.
    pub(crate) fn returned(&mut self, id: FutureId, value: Value<S>) {
        self.unreturned -= 1;
        self.runnable.remove(id);
        self.settle(id, value);
    }

    /// A future or a memoised call has its value.
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

    /// Those that waited for this value can run: a list of futures, from the one that waited last.
    fn wake(&mut self, mut waiter: FutureId, value: &Value<S>) {
        // In the order of their numbers, whichever waited first.
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
                    // It waits at a call, which has its result now.
                    self.registers[receives as usize].store(value.clone());
                    self.nodes[node.0 as usize].pc += 1;
                }
                self.runnable.push(waiter);
            }
        }
    }

    /// A future stops at this node, to continue when another has returned.
    pub(super) fn wait(&mut self, future: FutureId, node: NodeId, wanted: FutureId) {
        let first = std::mem::replace(&mut self.futures[wanted.0 as usize].waiter, future);
        let own = &mut self.futures[future.0 as usize];
        own.next_waiter = first;
        own.status = Status::Waiting(node, wanted);
        self.runnable.remove(future);
    }

    /// The component of a loop's node in addresses, its iteration left open: that of its site, or, of a loop that is run
    /// apart, its whole path.
    fn loop_label(&self, program: &Program<S>, header: NodeId) -> String {
        let n = &self.nodes[header.0 as usize];
        if n.parent == NodeId::NONE {
            let origin = self.origins.as_ref().and_then(|origins| origins.get(&header));
            return origin.cloned().unwrap_or_default();
        }
        let above = &self.nodes[n.parent.0 as usize];
        program.function(above.function).sites[n.site as usize].label.to_string()
    }

    /// The readable path of a loop's node, its iteration left open.
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
                // The component of a loop is made from the loop node's site and the iteration.
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

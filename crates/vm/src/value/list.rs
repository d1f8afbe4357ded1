//! Lists: persistent vectors, each a trie with 32 children per node and a tail.
//!
//! ```text
//!   body: len 70, tail [64..70)        Elements are added to the tail; a full tail becomes a leaf. A list of up
//!     root --+-- leaf [ 0..32)         to 32 elements is a tail alone, flat. Reading and replacing one
//!            +-- leaf [32..64)         element touch one node on each level, copied only where shared.
//! ```
//!
//! Appending costs O(1) on average and writes in place when the list is not shared. [`List::diff`] finds the
//! differences of two versions and skips the nodes that they share. So a changed element of a long list wakes
//! only the readers of that element (no persistent vector in the package index can do this).
//!
//! Source: Bagwell's array mapped tries as in Clojure's vectors; the node width is measured, not derived.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::blocks::{block, shared};
use super::census::Census;
use super::{Scalar, Value, release};

const BITS: u32 = 5;
const WIDTH: usize = 1 << BITS;
const MASK: usize = WIDTH - 1;

/// A persistent list.
#[derive(Clone)]
pub struct List<S: Scalar = f64>(Arc<Body<S>>);

#[derive(Clone)]
struct Body<S: Scalar> {
    len: usize,
    /// The bits of a position that the levels below the root use: 0 when the root is a leaf.
    shift: u32,
    root: Option<Arc<Node<S>>>,
    /// The last 0 to 32 elements (at least one element in a list that is not empty).
    tail: Vec<Value<S>>,
}

#[derive(Clone)]
enum Node<S: Scalar> {
    Branch(Vec<Arc<Node<S>>>),
    /// Exactly 32 elements.
    Leaf(Vec<Value<S>>),
}

impl<S: Scalar> Drop for Body<S> {
    fn drop(&mut self) {
        release::release(&mut self.tail);
    }
}

impl<S: Scalar> Drop for Node<S> {
    fn drop(&mut self) {
        if let Node::Leaf(items) = self {
            release::release(items);
        }
    }
}

impl<S: Scalar> Body<S> {
    /// Position of the tail's first element: how many elements the trie holds.
    #[inline]
    fn tail_start(&self) -> usize {
        self.len - self.tail.len()
    }

    /// Adds a full leaf below the root. `start` is the number of elements that the trie held before.
    fn push_leaf(&mut self, start: usize, leaf: Arc<Node<S>>) {
        let Some(root) = &mut self.root else {
            self.root = Some(leaf);
            return;
        };
        if start == WIDTH << self.shift {
            let beside = path(self.shift, leaf);
            self.root = Some(Arc::new(Node::Branch(vec![Arc::clone(root), beside])));
            self.shift += BITS;
            return;
        }
        let (mut node, mut shift) = (root, self.shift);
        while let Node::Branch(children) = Arc::make_mut(node) {
            let at = (start >> shift) & MASK;
            shift -= BITS;
            if at == children.len() {
                children.push(path(shift, leaf));
                return;
            }
            node = &mut children[at];
        }
        unreachable!("a leaf is full: nothing hangs below it");
    }
}

/// A leaf under as many single-child branches as `shift` requires.
fn path<S: Scalar>(shift: u32, leaf: Arc<Node<S>>) -> Arc<Node<S>> {
    (0..shift / BITS).fold(leaf, |below, _| Arc::new(Node::Branch(vec![below])))
}

impl<S: Scalar> Default for List<S> {
    fn default() -> List<S> {
        List::from_vec(Vec::new())
    }
}

impl<S: Scalar> List<S> {
    /// A list of the given elements; O(n).
    pub fn from_vec(items: Vec<Value<S>>) -> List<S> {
        let mut body = Body { len: 0, shift: 0, root: None, tail: Vec::new() };
        if items.len() <= WIDTH {
            body.len = items.len();
            body.tail = items;
            return List(Arc::new(body));
        }
        let mut items = items.into_iter();
        while items.len() > WIDTH {
            let leaf = Arc::new(Node::Leaf(items.by_ref().take(WIDTH).collect()));
            body.push_leaf(body.len, leaf);
            body.len += WIDTH;
        }
        body.tail = items.collect();
        body.len += body.tail.len();
        List(Arc::new(body))
    }

    /// Repeats the list `times` times, without a second copy of the elements meanwhile.
    pub fn repeated(&self, times: usize) -> List<S> {
        let mut body = Body { len: 0, shift: 0, root: None, tail: Vec::new() };
        let total = self.len() * times;
        let mut items = (0..times).flat_map(|_| self.iter());
        while body.len < total {
            let count = WIDTH.min(total - body.len);
            let mut leaf = Vec::with_capacity(count);
            leaf.extend(items.by_ref().take(count).cloned());
            if body.len + count == total {
                body.tail = leaf;
            } else {
                body.push_leaf(body.len, Arc::new(Node::Leaf(leaf)));
            }
            body.len += count;
        }
        List(Arc::new(body))
    }

    /// Number of elements.
    #[inline]
    pub fn len(&self) -> usize {
        self.0.len
    }

    /// True for a list without elements.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.0.len == 0
    }

    /// Its address in memory: no other list has it while this one exists.
    #[inline]
    pub fn address(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }

    /// True when both are the same list in memory.
    #[inline]
    pub fn ptr_eq(&self, other: &List<S>) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// The element at a position.
    #[inline]
    pub fn get(&self, at: usize) -> Option<&Value<S>> {
        let start = self.0.tail_start();
        // Most lists are so short that they have only a tail.
        if at >= start { self.0.tail.get(at - start) } else { self.chunk(at).first() }
    }

    /// The elements from a position to the end of the leaf that holds it; empty beyond the end.
    #[inline]
    pub fn chunk(&self, at: usize) -> &[Value<S>] {
        let start = self.0.tail_start();
        if at >= start {
            return self.0.tail.get(at - start..).unwrap_or(&[]);
        }
        let (mut node, mut shift) = (self.0.root.as_ref(), self.0.shift);
        while let Some(inner) = node {
            match &**inner {
                Node::Leaf(items) => return &items[at & MASK..],
                Node::Branch(children) => node = children.get((at >> shift) & MASK),
            }
            shift -= BITS;
        }
        &[]
    }

    /// The elements in order.
    pub fn iter(&self) -> Iter<'_, S> {
        Iter { list: self, chunk: self.chunk(0).iter(), next: self.chunk(0).len() }
    }

    /// Adds an element at the end: in place when the list has one owner, else on a copy of the tail.
    pub fn append(&mut self, item: Value<S>) {
        if Arc::get_mut(&mut self.0).is_none() {
            // A copy with room for the element, so that the tail is allocated once.
            let Body { len, shift, root, tail } = &*self.0;
            let mut longer = Vec::with_capacity((tail.len() + 1).min(WIDTH));
            longer.extend_from_slice(tail);
            self.0 = Arc::new(Body { len: *len, shift: *shift, root: root.clone(), tail: longer });
        }
        let body = Arc::make_mut(&mut self.0);
        if body.tail.len() == WIDTH {
            let start = body.tail_start();
            let leaf = Arc::new(Node::Leaf(std::mem::replace(&mut body.tail, Vec::with_capacity(4))));
            body.push_leaf(start, leaf);
        }
        body.tail.push(item);
        body.len += 1;
    }

    /// Replaces the element at a position; `false` when there is no such position.
    pub fn set(&mut self, at: usize, item: Value<S>) -> bool {
        if at >= self.0.len {
            return false;
        }
        let body = Arc::make_mut(&mut self.0);
        let start = body.tail_start();
        if at >= start {
            body.tail[at - start] = item;
            return true;
        }
        let mut shift = body.shift;
        let Some(mut node) = body.root.as_mut() else { return false };
        loop {
            match Arc::make_mut(node) {
                Node::Leaf(items) => {
                    items[at & MASK] = item;
                    return true;
                }
                Node::Branch(children) => {
                    node = &mut children[(at >> shift) & MASK];
                    shift -= BITS;
                }
            }
        }
    }

    /// Adds all elements of another list at the end; O(length of the other).
    pub fn extend(&mut self, other: &List<S>) {
        if self.is_empty() {
            *self = other.clone();
            return;
        }
        for item in other.iter() {
            self.append(item.clone());
        }
    }

    /// Calls `visit` with the position and both elements wherever two versions may differ: within the common
    /// length, skipping the nodes that they share in memory. Stops when `visit` breaks.
    pub fn visit_unshared<'a, B>(
        old: &'a List<S>,
        new: &'a List<S>,
        visit: &mut impl FnMut(usize, &'a Value<S>, &'a Value<S>) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        if old.ptr_eq(new) {
            return ControlFlow::Continue(());
        }
        let in_both = old.0.tail_start().min(new.0.tail_start());
        if let (true, Some(a), Some(b)) = (in_both > 0, &old.0.root, &new.0.root) {
            let (mut a, mut b) = (a, b);
            // The first child of the higher trie covers all elements that the lower trie can hold.
            for _ in (old.0.shift.min(new.0.shift)..old.0.shift).step_by(BITS as usize) {
                a = first_child(a);
            }
            for _ in (old.0.shift.min(new.0.shift)..new.0.shift).step_by(BITS as usize) {
                b = first_child(b);
            }
            visit_nodes(a, b, old.0.shift.min(new.0.shift), 0, visit)?;
        }
        // The rest is the tail of one list, 32 elements at most, against the tail or a leaf of the other.
        for at in in_both..old.len().min(new.len()) {
            if let (Some(a), Some(b)) = (old.get(at), new.get(at)) {
                visit(at, a, b)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Counts the memory that the list takes; versions of a list share nodes.
    pub(super) fn count<'v>(&'v self, census: &mut Census<'v, S>) {
        if census.add_shared(&self.0) {
            let tail = &self.0.tail;
            // A tail that grew in place has room for more, but a copy of it has not: both count alike.
            let room = if tail.is_empty() { 0 } else { tail.len().next_power_of_two().max(4) };
            census.add_items(tail, room);
            if let Some(root) = &self.0.root {
                count_node(root, census);
            }
        }
    }

    /// Excludes the list, and the nodes that a version of it shares, from the count: the upper levels suffice
    /// for that.
    pub(super) fn leave_out(&self, census: &mut Census<'_, S>) {
        census.note(self.address());
        let Some(root) = &self.0.root else { return };
        census.note(Arc::as_ptr(root) as usize);
        if let Node::Branch(children) = &**root {
            children.iter().for_each(|child| census.note(Arc::as_ptr(child) as usize));
        }
    }

    /// True when this list is not shared.
    #[inline]
    pub(super) fn has_one_owner(&self) -> bool {
        Arc::strong_count(&self.0) == 1
    }

    /// Moves the elements that would be dropped with this list to the work list.
    pub(super) fn gather(self, work: &mut Vec<Value<S>>) {
        if let Some(mut body) = Arc::into_inner(self.0) {
            release::gather(&mut body.tail, work);
            if let Some(root) = body.root.take() {
                gather_node(root, work);
            }
        }
    }
}

/// Bytes of a list of `len` elements, or a little more, without the data behind the elements.
pub(super) fn bytes_of<S: Scalar>(len: usize) -> usize {
    let leaf = shared::<Node<S>>() + WIDTH * size_of::<Value<S>>();
    // A leaf takes a place in a branch, and a branch takes one thirty-second of a place in a higher branch.
    let leaves = len / WIDTH * (leaf + 2 * size_of::<usize>());
    shared::<Body<S>>() + leaves + (len % WIDTH).next_power_of_two() * size_of::<Value<S>>()
}

/// Counts a subtree; the recursion is as deep as the trie, six levels at most.
fn count_node<'v, S: Scalar>(node: &'v Arc<Node<S>>, census: &mut Census<'v, S>) {
    if census.add_shared(node) {
        match &**node {
            Node::Leaf(items) => census.add_items(items, WIDTH),
            Node::Branch(children) => {
                census.add_bytes(block(children.len().next_power_of_two().max(4) * size_of::<usize>()));
                children.iter().for_each(|child| count_node(child, census));
            }
        }
    }
}

/// Frees a subtree with one owner; the recursion is as deep as the trie, six levels at most.
fn gather_node<S: Scalar>(node: Arc<Node<S>>, work: &mut Vec<Value<S>>) {
    if let Some(mut node) = Arc::into_inner(node) {
        match &mut node {
            Node::Leaf(items) => release::gather(items, work),
            Node::Branch(children) => {
                for child in std::mem::take(children) {
                    gather_node(child, work);
                }
            }
        }
    }
}

fn first_child<S: Scalar>(node: &Arc<Node<S>>) -> &Arc<Node<S>> {
    match &**node {
        Node::Branch(children) => children.first().unwrap_or(node),
        Node::Leaf(_) => node,
    }
}

fn visit_nodes<'a, S: Scalar, B>(
    old: &'a Arc<Node<S>>,
    new: &'a Arc<Node<S>>,
    shift: u32,
    start: usize,
    visit: &mut impl FnMut(usize, &'a Value<S>, &'a Value<S>) -> ControlFlow<B>,
) -> ControlFlow<B> {
    if Arc::ptr_eq(old, new) {
        return ControlFlow::Continue(());
    }
    match (&**old, &**new) {
        (Node::Leaf(old), Node::Leaf(new)) => {
            for (at, (a, b)) in old.iter().zip(new).enumerate() {
                visit(start + at, a, b)?;
            }
        }
        (Node::Branch(old), Node::Branch(new)) => {
            for (at, (a, b)) in old.iter().zip(new).enumerate() {
                visit_nodes(a, b, shift - BITS, start + (at << shift), visit)?;
            }
        }
        _ => unreachable!("both nodes are on the level that `shift` names"),
    }
    ControlFlow::Continue(())
}

/// Iterator over the elements of a list, leaf by leaf.
pub struct Iter<'a, S: Scalar> {
    list: &'a List<S>,
    chunk: std::slice::Iter<'a, Value<S>>,
    /// Position of the first element after the chunk.
    next: usize,
}

impl<'a, S: Scalar> Iterator for Iter<'a, S> {
    type Item = &'a Value<S>;

    #[inline]
    fn next(&mut self) -> Option<&'a Value<S>> {
        if let Some(item) = self.chunk.next() {
            return Some(item);
        }
        let chunk = self.list.chunk(self.next);
        self.next += chunk.len();
        self.chunk = chunk.iter();
        self.chunk.next()
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.list.len() - self.next + self.chunk.len();
        (left, Some(left))
    }
}

impl<S: Scalar> ExactSizeIterator for Iter<'_, S> {}

#[cfg(test)]
mod tests {
    use super::*;

    /// A small linear congruential generator: the tests need variety, not randomness.
    struct Dice(u64);
    impl Dice {
        fn roll(&mut self, sides: usize) -> usize {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((self.0 >> 33) as usize) % sides
        }
    }

    fn ints(list: &List) -> Vec<i64> {
        list.iter().map(|v| if let Value::Int(n) = v { *n } else { panic!("not an int") }).collect()
    }

    #[test]
    fn random_operations_agree_with_a_vec_and_old_versions_never_change() {
        let mut dice = Dice(7);
        let (mut list, mut plain) = (List::<f64>::default(), Vec::new());
        let mut kept: Vec<(List, Vec<i64>)> = Vec::new();
        for step in 0..6000 {
            let n = step as i64;
            match dice.roll(10) {
                0..6 => {
                    list.append(Value::Int(n));
                    plain.push(n);
                }
                6..8 if !plain.is_empty() => {
                    let at = dice.roll(plain.len());
                    assert!(list.set(at, Value::Int(n)));
                    plain[at] = n;
                }
                8 if plain.len() < 2000 => {
                    let other: Vec<i64> = (0..dice.roll(70) as i64).collect();
                    list.extend(&List::from_vec(other.iter().copied().map(Value::Int).collect()));
                    plain.extend(other);
                }
                _ if dice.roll(20) == 0 => kept.push((list.clone(), plain.clone())),
                _ => {}
            }
            assert_eq!(list.len(), plain.len());
            let at = dice.roll(plain.len() + 2);
            assert_eq!(list.get(at).map(|v| v == &Value::Int(plain[at])), plain.get(at).map(|_| true));
        }
        assert_eq!(ints(&list), plain);
        assert!(kept.len() > 10);
        for (list, plain) in &kept {
            assert_eq!(&ints(list), plain);
        }
    }

    #[test]
    fn from_vec_agrees_with_appending_at_every_boundary() {
        for n in [0, 1, 31, 32, 33, 63, 64, 65, 1023, 1024, 1025, 1056, 1057, 32_768, 32_800, 32_801, 40_000]
        {
            let plain: Vec<i64> = (0..n).collect();
            let built = List::<f64>::from_vec(plain.iter().copied().map(Value::Int).collect());
            let mut grown = List::<f64>::default();
            plain.iter().for_each(|&x| grown.append(Value::Int(x)));
            assert_eq!(ints(&built), plain);
            assert_eq!(ints(&grown), plain);
            assert_eq!(built.iter().len(), plain.len());
            assert!(List::diff(&built, &grown).is_empty());
            assert_eq!(built.get(plain.len()).map(|_| ()), None);
        }
    }

    #[test]
    fn diff_finds_all_changes_for_any_two_lengths() {
        let mut dice = Dice(3);
        for _ in 0..300 {
            let n = 1 + dice.roll(2500);
            let old = List::<f64>::from_vec((0..n).map(|x| Value::Int(x as i64)).collect());
            let mut new = old.clone();
            let mut expected = std::collections::BTreeSet::new();
            for _ in 0..dice.roll(4) {
                let at = dice.roll(n);
                new.set(at, Value::Int(-1));
                expected.insert(at);
            }
            for _ in 0..dice.roll(1200) {
                expected.insert(new.len());
                new.append(Value::None);
            }
            let expected: Vec<usize> = expected.into_iter().collect();
            assert_eq!(List::diff(&old, &new), expected);
            assert_eq!(List::diff(&new, &old), expected);
        }
    }

    #[test]
    fn diff_looks_only_at_leaves_that_are_not_shared() {
        let old = List::<f64>::from_vec((0..100_000).map(Value::Int).collect());
        let mut new = old.clone();
        new.set(54_321, Value::Int(0));
        let mut seen = 0;
        let _ = List::visit_unshared(&old, &new, &mut |_, _, _| {
            seen += 1;
            ControlFlow::<()>::Continue(())
        });
        assert!(seen <= 64, "one leaf and one tail, not {seen} elements");
    }

    #[test]
    fn appending_to_the_only_owner_copies_nothing() {
        let mut list = List::<f64>::default();
        list.append(Value::Int(0));
        let body = Arc::as_ptr(&list.0);
        (1..10_000).for_each(|n| list.append(Value::Int(n)));
        assert_eq!(body, Arc::as_ptr(&list.0));
    }
}

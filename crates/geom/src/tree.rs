//! A bag of boxed items as a persistent, balanced tree of boxes. It finds near items, and the extent of all.
//!
//! Leaves are short lists of items, from the newest to the oldest, whose tails copies share. Cloning is one reference count.
//! A change copies only the path from the root (and not even the path if it is not shared), so particles share common parts.
//! The box of all is the extent of the whole bag: an order statistic that removal keeps. A new item goes where boxes
//! grow least; a full list is cut in two. Heights of siblings differ by at most one, so that a long chain of shapes costs no
//! more than a compact scene.

use crate::bounds::Aabb;
use std::sync::Arc;

/// The most items in a leaf. A longer list makes a lower tree: less is copied, but more items are visited.
const MOST: usize = 12;

/// An item with a box around it.
pub trait Boxed {
    /// The box.
    fn aabb(&self) -> &Aabb;
}

/// A bag of items, each with a box.
#[derive(Clone, Debug)]
pub struct BoxTree<T> {
    all: Part<T>,
    len: usize,
}

/// Items, and the smallest box around them.
#[derive(Debug)]
struct Part<T> {
    aabb: Aabb,
    node: Node<T>,
}

/// A node goes through registers: functions that change a tree take and return it by value.
#[derive(Debug)]
enum Node<T> {
    Leaf(List<T>),
    Branch(Arc<Branch<T>>),
}

type List<T> = Option<Arc<Entry<T>>>;

#[derive(Debug)]
struct Entry<T> {
    item: T,
    /// The number of items from here to the oldest.
    count: usize,
    older: List<T>,
}

#[derive(Debug)]
struct Branch<T> {
    height: u32,
    parts: [Part<T>; 2],
}

impl<T> Clone for Node<T> {
    #[inline]
    fn clone(&self) -> Node<T> {
        match self {
            Node::Leaf(list) => Node::Leaf(list.clone()),
            Node::Branch(branch) => Node::Branch(branch.clone()),
        }
    }
}

impl<T> Clone for Part<T> {
    #[inline]
    fn clone(&self) -> Part<T> {
        Part { aabb: self.aabb, node: self.node.clone() }
    }
}

impl<T> Node<T> {
    #[inline]
    fn height(&self) -> u32 {
        match self {
            Node::Leaf(_) => 0,
            Node::Branch(branch) => branch.height,
        }
    }
}

impl<T> Default for BoxTree<T> {
    fn default() -> BoxTree<T> {
        BoxTree { all: Part { aabb: Aabb::EMPTY, node: Node::Leaf(None) }, len: 0 }
    }
}

impl<T: Clone + Boxed> BoxTree<T> {
    /// Number of items.
    pub fn len(&self) -> usize {
        self.len
    }

    /// True when there are no items.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The smallest box around all items.
    pub fn bounds(&self) -> Aabb {
        self.all.aabb
    }

    /// Adds an item to the bag.
    pub fn insert(&mut self, item: T) {
        self.len += 1;
        self.all.insert(item);
    }

    /// Removes an item for which `is` holds and whose box is `aabb`; `None` without such an item.
    pub fn remove(&mut self, aabb: &Aabb, is: impl Fn(&T) -> bool) -> Option<T> {
        let (rest, item) = without(&self.all.node, aabb, &is)?;
        self.all = rest;
        self.len -= 1;
        Some(item)
    }

    /// Calls `f` with every item whose box meets `aabb`, borders included.
    pub fn visit(&self, aabb: &Aabb, mut f: impl FnMut(&T)) {
        visit(&self.all.node, aabb, &mut f);
    }

    /// Calls `f` with every item.
    pub fn each(&self, mut f: impl FnMut(&T)) {
        let space = Aabb { low: Aabb::EMPTY.high, high: Aabb::EMPTY.low };
        self.visit(&space, &mut f);
    }
}

// The tree's height is logarithmic and lists are short, so these recursions are shallow.

fn visit<T: Boxed>(node: &Node<T>, near: &Aabb, f: &mut impl FnMut(&T)) {
    match node {
        Node::Leaf(list) => each(list).filter(|item| item.aabb().meets(near)).for_each(f),
        Node::Branch(branch) => {
            for part in branch.parts.iter().filter(|part| part.aabb.meets(near)) {
                visit(&part.node, near, f);
            }
        }
    }
}

/// The items of a list, from the newest.
fn each<T>(list: &List<T>) -> impl Iterator<Item = &T> {
    std::iter::successors(list.as_deref(), |entry| entry.older.as_deref()).map(|entry| &entry.item)
}

impl<T: Clone + Boxed> Part<T> {
    /// The part of a list.
    fn of(list: List<T>) -> Part<T> {
        let aabb = each(&list).fold(Aabb::EMPTY, |all, item| all.union(item.aabb()));
        Part { aabb, node: Node::Leaf(list) }
    }

    /// Adds an item. Unshared nodes change in place.
    fn insert(&mut self, item: T) {
        self.aabb = self.aabb.union(item.aabb());
        match &mut self.node {
            Node::Leaf(list) => self.node = longer(list.take(), item),
            Node::Branch(branch) => match unshared(branch) {
                None => self.node = with(&self.node, item),
                Some(branch) => {
                    let near = branch.nearer(item.aabb());
                    branch.parts[near].insert(item);
                    let [a, b] = branch.parts.each_ref().map(|part| part.node.height());
                    if a.abs_diff(b) > 1 {
                        let [a, b] = branch.parts.clone();
                        self.node = joined(a, b);
                    } else {
                        branch.height = 1 + a.max(b);
                    }
                }
            },
        }
    }
}

impl<T: Boxed> Branch<T> {
    /// The part that grows least with a box.
    #[inline]
    fn nearer(&self, aabb: &Aabb) -> usize {
        let [a, b] = &self.parts;
        let growth = |part: &Part<T>| part.aabb.union(aabb).half_area() - part.aabb.half_area();
        usize::from(growth(a) > growth(b))
    }
}

/// The branch for changes in place; `None` if it is shared.
#[inline]
fn unshared<T>(branch: &mut Arc<Branch<T>>) -> Option<&mut Branch<T>> {
    // The count is cheaper than `get_mut`: most branches are shared.
    if Arc::strong_count(branch) == 1 { Arc::get_mut(branch) } else { None }
}

/// A node with another item; all but the path to the item is shared.
fn with<T: Clone + Boxed>(node: &Node<T>, item: T) -> Node<T> {
    match node {
        Node::Leaf(list) => longer(list.clone(), item),
        Node::Branch(branch) => {
            let near = branch.nearer(item.aabb());
            let (far, near) = (&branch.parts[1 - near], &branch.parts[near]);
            let aabb = near.aabb.union(item.aabb());
            joined(Part { aabb, node: with(&near.node, item) }, far.clone())
        }
    }
}

/// A list with another item, or two lists if it would be too long.
fn longer<T: Clone + Boxed>(list: List<T>, item: T) -> Node<T> {
    let count = list.as_ref().map_or(0, |entry| entry.count);
    if count == MOST {
        return cut(&list, &item);
    }
    Node::Leaf(Some(Arc::new(Entry { item, count: count + 1, older: list })))
}

/// The items of a list and another item as two lists: halves along the axis on which their middles are farthest apart.
fn cut<T: Clone + Boxed>(list: &List<T>, item: &T) -> Node<T> {
    let mut items: Vec<&T> = each(list).chain([item]).collect();
    // Twice the middle.
    let middle = |item: &T| item.aabb().low + item.aabb().high;
    let reach = Aabb::around(items.iter().map(|item| middle(item))).extent().to_array();
    let axis = (0..3).fold(0, |most, axis| if reach[axis] > reach[most] { axis } else { most });
    let half = items.len() / 2;
    items.select_nth_unstable_by(half, |a, b| middle(a)[axis].total_cmp(&middle(b)[axis]));
    let list_of = |items: &[&T]| {
        items.iter().enumerate().fold(None, |older, (count, item)| {
            Some(Arc::new(Entry { item: (*item).clone(), count: count + 1, older }))
        })
    };
    let (low, high) = items.split_at(half);
    branch(Part::of(list_of(low)), Part::of(list_of(high)))
}

/// A branch over two parts whose heights may differ by two.
#[inline(always)]
fn joined<T: Clone + Boxed>(a: Part<T>, b: Part<T>) -> Node<T> {
    match a.node.height().abs_diff(b.node.height()) {
        0 | 1 => branch(a, b),
        _ => level(a, b),
    }
}

/// A branch over two parts whose heights differ by two: the taller part of the taller part moves up.
#[cold]
#[inline(never)]
fn level<T: Clone + Boxed>(a: Part<T>, b: Part<T>) -> Node<T> {
    let (tall, low) = if a.node.height() > b.node.height() { (a, b) } else { (b, a) };
    let Node::Branch(branches) = &tall.node else { return branch(tall, low) };
    let [p, q] = &branches.parts;
    let (up, down) = if p.node.height() >= q.node.height() { (p, q) } else { (q, p) };
    let aabb = down.aabb.union(&low.aabb);
    branch(up.clone(), Part { aabb, node: joined(down.clone(), low) })
}

#[inline(always)]
fn branch<T>(a: Part<T>, b: Part<T>) -> Node<T> {
    let height = 1 + a.node.height().max(b.node.height());
    Node::Branch(Arc::new(Branch { height, parts: [a, b] }))
}

/// A node without an item, and the item; `None` if the node does not have it.
fn without<T: Clone + Boxed>(node: &Node<T>, aabb: &Aabb, is: &impl Fn(&T) -> bool) -> Option<(Part<T>, T)> {
    match node {
        Node::Leaf(list) => shorter(list, aabb, is).map(|(rest, item)| (Part::of(rest), item)),
        Node::Branch(branch) => {
            let [a, b] = &branch.parts;
            for (in_here, other) in [(a, b), (b, a)] {
                if !in_here.aabb.contains(aabb) {
                    continue;
                }
                if let Some((rest, item)) = without(&in_here.node, aabb, is) {
                    let rest = match rest.node {
                        Node::Leaf(None) => other.clone(),
                        _ => Part { aabb: rest.aabb.union(&other.aabb), node: joined(rest, other.clone()) },
                    };
                    return Some((rest, item));
                }
            }
            None
        }
    }
}

/// A list without an item, and the item; `None` if the list does not have it.
fn shorter<T: Clone + Boxed>(list: &List<T>, aabb: &Aabb, is: &impl Fn(&T) -> bool) -> Option<(List<T>, T)> {
    let Entry { item, count, older } = &**list.as_ref()?;
    if item.aabb() == aabb && is(item) {
        return Some((older.clone(), item.clone()));
    }
    let (older, removed) = shorter(older, aabb, is)?;
    Some((Some(Arc::new(Entry { item: item.clone(), count: count - 1, older })), removed))
}

#[cfg(test)]
mod tests {
    //! The tree gives the same results as a list, stays balanced, and copies are independent.
    use super::*;
    use crate::vector::vec3;

    #[derive(Clone)]
    struct Item(Aabb, u64);

    impl Boxed for Item {
        fn aabb(&self) -> &Aabb {
            &self.0
        }
    }

    fn cube(k: u64) -> Aabb {
        let x = |s: u64| (k.wrapping_mul(s) % 97) as f64;
        let low = vec3(x(31), x(57), x(83));
        Aabb { low, high: low + vec3(5.0, 4.0, 3.0) }
    }

    fn near_items(tree: &BoxTree<Item>, near: &Aabb) -> Vec<u64> {
        let mut items = Vec::new();
        tree.visit(near, |item| items.push(item.1));
        items.sort_unstable();
        items
    }

    #[test]
    fn a_tree_agrees_with_a_list() {
        let mut tree = BoxTree::default();
        let mut list: Vec<u64> = Vec::new();
        for k in 0..300 {
            tree.insert(Item(cube(k), k));
            list.push(k);
            if k % 3 == 2 {
                let removed = list.remove((k as usize * 7) % list.len());
                let before = tree.clone();
                assert_eq!(
                    tree.remove(&cube(removed), |item| item.1 == removed).map(|item| item.1),
                    Some(removed)
                );
                assert!(tree.remove(&cube(removed), |item| item.1 == removed).is_none());
                assert!(near_items(&before, &cube(removed)).contains(&removed));
            }
            let near = cube(k * 13 + 5);
            let expected: Vec<u64> = list.iter().copied().filter(|i| cube(*i).meets(&near)).collect();
            assert_eq!(near_items(&tree, &near), expected);
            let bounds = list.iter().fold(Aabb::EMPTY, |b, i| b.union(&cube(*i)));
            assert_eq!(tree.bounds(), bounds);
            assert_eq!(tree.len(), list.len());
        }
        for k in list {
            tree.remove(&cube(k), |item| item.1 == k).unwrap();
        }
        assert!(tree.is_empty() && tree.bounds().is_empty());
    }

    #[test]
    fn many_items_may_have_one_box() {
        let mut tree = BoxTree::default();
        (0..100).for_each(|k| tree.insert(Item(cube(1), k)));
        let whole = tree.clone();
        assert_eq!(tree.remove(&cube(1), |item| item.1 == 99).map(|item| item.1), Some(99));
        assert_eq!((near_items(&tree, &cube(1)).len(), near_items(&whole, &cube(1)).len()), (99, 100));
        assert!(tree.all.node.height() <= 6);
    }

    #[test]
    fn a_row_of_items_stays_balanced() {
        let mut tree = BoxTree::default();
        for k in 0..1024 {
            let low = vec3(k as f64, 0.0, 0.0);
            tree.insert(Item(Aabb { low, high: low + vec3(1.0, 1.0, 1.0) }, k));
        }
        // An AVL tree of n leaves is at most 1.44 log2(n) high.
        assert!(tree.all.node.height() <= 15);
    }
}

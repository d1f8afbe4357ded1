//! A bag of boxed items as a persistent, balanced tree of boxes: finds near items, and the extent of all.
//!
//! Cloning is one reference count. Changing copies only the path from the root (and not even that when it is not
//! shared), so particles share what they have in common. The root's box is the extent of the whole bag: an order
//! statistic that removal keeps. A new item goes where boxes grow least; heights of siblings are kept within one of
//! each other, so that a long chain of shapes costs no more than a compact scene.

use crate::bounds::Aabb;
use std::sync::Arc;

/// Something with a box around it.
pub trait Boxed {
    /// The box.
    fn aabb(&self) -> &Aabb;
}

/// A bag of items, each with a box.
#[derive(Clone, Debug)]
pub struct BoxTree<T> {
    root: Node<T>,
    len: usize,
}

#[derive(Clone, Debug, Default)]
enum Node<T> {
    #[default]
    Nothing,
    Leaf(T),
    Branch(Arc<Branch<T>>),
}

#[derive(Debug)]
struct Branch<T> {
    aabb: Aabb,
    height: u32,
    children: [Node<T>; 2],
}

impl<T: Boxed> Node<T> {
    #[inline]
    fn aabb(&self) -> &Aabb {
        match self {
            Node::Nothing => &Aabb::EMPTY,
            Node::Leaf(item) => item.aabb(),
            Node::Branch(branch) => &branch.aabb,
        }
    }

    #[inline]
    fn height(&self) -> u32 {
        match self {
            Node::Nothing | Node::Leaf(_) => 0,
            Node::Branch(branch) => branch.height,
        }
    }
}

impl<T> Default for BoxTree<T> {
    fn default() -> BoxTree<T> {
        BoxTree { root: Node::Nothing, len: 0 }
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
        *self.root.aabb()
    }

    /// Adds an item to the bag.
    pub fn insert(&mut self, item: T) {
        self.len += 1;
        self.root = inserted(std::mem::take(&mut self.root), Node::Leaf(item));
    }

    /// Removes one item for which `is` holds and whose box is `aabb`; `None` when there is no such item.
    pub fn remove(&mut self, aabb: &Aabb, is: impl Fn(&T) -> bool) -> Option<T> {
        let (rest, item) = removed(&self.root, aabb, &is)?;
        self.root = rest;
        self.len -= 1;
        Some(item)
    }

    /// Calls `f` with every item whose box meets `aabb`, borders included.
    pub fn visit(&self, aabb: &Aabb, mut f: impl FnMut(&T)) {
        visit(&self.root, aabb, &mut f);
    }

    /// Calls `f` with every item.
    pub fn each(&self, mut f: impl FnMut(&T)) {
        let everything = Aabb { low: Aabb::EMPTY.high, high: Aabb::EMPTY.low };
        self.visit(&everything, &mut f);
    }
}

// The tree's height is logarithmic, so these recursions are shallow.

fn visit<T: Boxed>(node: &Node<T>, near: &Aabb, f: &mut impl FnMut(&T)) {
    if !node.aabb().meets(near) {
        return;
    }
    match node {
        Node::Nothing => {}
        Node::Leaf(item) => f(item),
        Node::Branch(branch) => branch.children.iter().for_each(|c| visit(c, near, f)),
    }
}

/// A branch over two trees whose heights may differ by two: the taller one's taller child moves up. `old` is a branch
/// that is needed no more.
fn joined<T: Clone + Boxed>(a: Node<T>, b: Node<T>, old: Option<Arc<Branch<T>>>) -> Node<T> {
    let (tall, low) = if a.height() >= b.height() { (a, b) } else { (b, a) };
    match tall {
        Node::Branch(tall) if tall.height > low.height() + 1 => {
            let [p, q] = &tall.children;
            let (up, down) = if p.height() >= q.height() { (p, q) } else { (q, p) };
            branch(up.clone(), joined(down.clone(), low, None), old)
        }
        tall => branch(tall, low, old),
    }
}

fn branch<T: Boxed>(a: Node<T>, b: Node<T>, old: Option<Arc<Branch<T>>>) -> Node<T> {
    let aabb = a.aabb().union(b.aabb());
    let branch = Branch { aabb, height: 1 + a.height().max(b.height()), children: [a, b] };
    if let Some(mut old) = old
        && let Some(place) = Arc::get_mut(&mut old)
    {
        *place = branch;
        return Node::Branch(old);
    }
    Node::Branch(Arc::new(branch))
}

fn inserted<T: Clone + Boxed>(node: Node<T>, leaf: Node<T>) -> Node<T> {
    match node {
        Node::Nothing => leaf,
        Node::Leaf(_) => branch(node, leaf, None),
        Node::Branch(mut at) => {
            let growth = |c: &Node<T>| c.aabb().union(leaf.aabb()).half_area() - c.aabb().half_area();
            let near = usize::from(growth(&at.children[0]) > growth(&at.children[1]));
            // Unshared nodes are changed in place.
            let (near, far) = match Arc::get_mut(&mut at) {
                Some(own) => {
                    (std::mem::take(&mut own.children[near]), std::mem::take(&mut own.children[1 - near]))
                }
                None => (at.children[near].clone(), at.children[1 - near].clone()),
            };
            joined(inserted(near, leaf), far, Some(at))
        }
    }
}

fn removed<T: Clone + Boxed>(node: &Node<T>, aabb: &Aabb, is: &impl Fn(&T) -> bool) -> Option<(Node<T>, T)> {
    match node {
        Node::Nothing => None,
        Node::Leaf(item) => (item.aabb() == aabb && is(item)).then(|| (Node::Nothing, item.clone())),
        Node::Branch(branch) => {
            if !branch.aabb.contains(aabb) {
                return None;
            }
            let [a, b] = &branch.children;
            for (in_here, other) in [(a, b), (b, a)] {
                if let Some((rest, item)) = removed(in_here, aabb, is) {
                    let rest = match rest {
                        Node::Nothing => other.clone(),
                        rest => joined(rest, other.clone(), None),
                    };
                    return Some((rest, item));
                }
            }
            None
        }
    }
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
    fn it_answers_as_a_list_would() {
        let mut tree = BoxTree::default();
        let mut list: Vec<u64> = Vec::new();
        for k in 0..300 {
            tree.insert(Item(cube(k), k));
            list.push(k);
            if k % 3 == 2 {
                let gone = list.remove((k as usize * 7) % list.len());
                let before = tree.clone();
                assert_eq!(tree.remove(&cube(gone), |item| item.1 == gone).map(|item| item.1), Some(gone));
                assert!(tree.remove(&cube(gone), |item| item.1 == gone).is_none());
                assert!(near_items(&before, &cube(gone)).contains(&gone));
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
    fn a_row_of_items_stays_balanced() {
        let mut tree = BoxTree::default();
        for k in 0..1024 {
            let low = vec3(k as f64, 0.0, 0.0);
            tree.insert(Item(Aabb { low, high: low + vec3(1.0, 1.0, 1.0) }, k));
        }
        // An AVL tree of n leaves is at most 1.44 log2(n) high.
        assert!(tree.root.height() <= 15);
    }
}

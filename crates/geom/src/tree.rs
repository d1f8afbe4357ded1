//! A bag of boxed items as a persistent, balanced tree of boxes: who is near, and how far does everything reach.
//!
//! Cloning is one reference count. Changing copies only the path from the root (and not even that when nobody else
//! holds it), so particles share what they have in common. The root's box is the extent of the whole bag: an order
//! statistic that removal keeps. A new item goes where boxes grow least; heights of siblings are kept within one of
//! each other, so that a chain of shapes grown in one direction stays as cheap as a bush.

use crate::bounds::Aabb;
use std::sync::Arc;

/// A bag of items, each with a box.
#[derive(Clone, Debug)]
pub struct BoxTree<T> {
    root: Option<Arc<Node<T>>>,
    len: usize,
}

#[derive(Clone, Debug)]
enum Node<T> {
    Leaf { aabb: Aabb, item: T },
    Branch { aabb: Aabb, height: u32, children: [Arc<Node<T>>; 2] },
}

impl<T> Node<T> {
    #[inline]
    fn aabb(&self) -> &Aabb {
        match self {
            Node::Leaf { aabb, .. } | Node::Branch { aabb, .. } => aabb,
        }
    }

    #[inline]
    fn height(&self) -> u32 {
        match self {
            Node::Leaf { .. } => 0,
            Node::Branch { height, .. } => *height,
        }
    }
}

impl<T> Default for BoxTree<T> {
    fn default() -> BoxTree<T> {
        BoxTree { root: None, len: 0 }
    }
}

impl<T: Clone> BoxTree<T> {
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
        self.root.as_ref().map_or(Aabb::EMPTY, |root| *root.aabb())
    }

    /// Puts an item into the bag.
    pub fn insert(&mut self, aabb: Aabb, item: T) {
        let leaf = Arc::new(Node::Leaf { aabb, item });
        self.len += 1;
        self.root = Some(match self.root.take() {
            None => leaf,
            Some(root) => inserted(root, leaf),
        });
    }

    /// Takes one item out for which `is` holds and whose box is `aabb`; `None` when there is no such item.
    pub fn remove(&mut self, aabb: &Aabb, is: impl Fn(&T) -> bool) -> Option<T> {
        let root = self.root.clone()?;
        let (rest, item) = removed(&root, aabb, &is)?;
        self.root = rest;
        self.len -= 1;
        Some(item)
    }

    /// Calls `f` with every item whose box meets `aabb`, borders included.
    pub fn visit(&self, aabb: &Aabb, mut f: impl FnMut(&Aabb, &T)) {
        if let Some(root) = &self.root {
            visit(root, aabb, &mut f);
        }
    }

    /// Calls `f` with every item.
    pub fn each(&self, mut f: impl FnMut(&Aabb, &T)) {
        let everything = Aabb { low: Aabb::EMPTY.high, high: Aabb::EMPTY.low };
        self.visit(&everything, &mut f);
    }
}

// The tree's height is logarithmic, so these recursions are shallow.

fn visit<T>(node: &Node<T>, near: &Aabb, f: &mut impl FnMut(&Aabb, &T)) {
    if !node.aabb().meets(near) {
        return;
    }
    match node {
        Node::Leaf { aabb, item } => f(aabb, item),
        Node::Branch { children, .. } => children.iter().for_each(|c| visit(c, near, f)),
    }
}

/// A branch over two trees whose heights may differ by two: the taller one's taller child moves up.
fn joined<T: Clone>(a: Arc<Node<T>>, b: Arc<Node<T>>) -> Arc<Node<T>> {
    let (tall, low) = if a.height() >= b.height() { (a, b) } else { (b, a) };
    if tall.height() > low.height() + 1
        && let Node::Branch { children: [p, q], .. } = &*tall
    {
        let (up, down) = if p.height() >= q.height() { (p, q) } else { (q, p) };
        return branch(up.clone(), joined(down.clone(), low));
    }
    branch(tall, low)
}

fn branch<T>(a: Arc<Node<T>>, b: Arc<Node<T>>) -> Arc<Node<T>> {
    let aabb = a.aabb().union(b.aabb());
    let height = 1 + a.height().max(b.height());
    Arc::new(Node::Branch { aabb, height, children: [a, b] })
}

fn inserted<T: Clone>(node: Arc<Node<T>>, leaf: Arc<Node<T>>) -> Arc<Node<T>> {
    let Node::Branch { children: [a, b], .. } = &*node else {
        return branch(node, leaf);
    };
    let growth = |c: &Node<T>| c.aabb().union(leaf.aabb()).half_area() - c.aabb().half_area();
    let (near, far) = if growth(a) <= growth(b) { (a, b) } else { (b, a) };
    let (near, far) = (near.clone(), far.clone());
    drop(node);
    joined(inserted(near, leaf), far)
}

type Rest<T> = Option<Arc<Node<T>>>;

fn removed<T: Clone>(node: &Arc<Node<T>>, aabb: &Aabb, is: &impl Fn(&T) -> bool) -> Option<(Rest<T>, T)> {
    match &**node {
        Node::Leaf { aabb: there, item } => (there == aabb && is(item)).then(|| (None, item.clone())),
        Node::Branch { aabb: around, children: [a, b], .. } => {
            if !around.contains(aabb) {
                return None;
            }
            for (in_here, other) in [(a, b), (b, a)] {
                if let Some((rest, item)) = removed(in_here, aabb, is) {
                    let rest = rest.map_or_else(|| other.clone(), |rest| joined(rest, other.clone()));
                    return Some((Some(rest), item));
                }
            }
            None
        }
    }
}

#[cfg(test)]
mod tests {
    //! The tree answers as a list would, stays balanced, and copies do not see each other's changes.
    use super::*;
    use crate::vector::vec3;

    fn cube(k: u64) -> Aabb {
        let x = |s: u64| (k.wrapping_mul(s) % 97) as f64;
        let low = vec3(x(31), x(57), x(83));
        Aabb { low, high: low + vec3(5.0, 4.0, 3.0) }
    }

    fn found(tree: &BoxTree<u64>, near: &Aabb) -> Vec<u64> {
        let mut items = Vec::new();
        tree.visit(near, |_, item| items.push(*item));
        items.sort_unstable();
        items
    }

    #[test]
    fn it_answers_as_a_list_would() {
        let mut tree = BoxTree::default();
        let mut list: Vec<u64> = Vec::new();
        for k in 0..300 {
            tree.insert(cube(k), k);
            list.push(k);
            if k % 3 == 2 {
                let gone = list.remove((k as usize * 7) % list.len());
                let before = tree.clone();
                assert_eq!(tree.remove(&cube(gone), |item| *item == gone), Some(gone));
                assert!(tree.remove(&cube(gone), |item| *item == gone).is_none());
                assert!(found(&before, &cube(gone)).contains(&gone));
            }
            let near = cube(k * 13 + 5);
            let expected: Vec<u64> = list.iter().copied().filter(|i| cube(*i).meets(&near)).collect();
            assert_eq!(found(&tree, &near), expected);
            let bounds = list.iter().fold(Aabb::EMPTY, |b, i| b.union(&cube(*i)));
            assert_eq!(tree.bounds(), bounds);
            assert_eq!(tree.len(), list.len());
        }
        for k in list {
            tree.remove(&cube(k), |item| *item == k).unwrap();
        }
        assert!(tree.is_empty() && tree.bounds().is_empty());
    }

    #[test]
    fn a_row_of_items_stays_balanced() {
        let mut tree = BoxTree::default();
        for k in 0..1024 {
            let low = vec3(k as f64, 0.0, 0.0);
            tree.insert(Aabb { low, high: low + vec3(1.0, 1.0, 1.0) }, k);
        }
        // An AVL tree of n leaves is at most 1.44 log2(n) high.
        assert!(tree.root.unwrap().height() <= 15);
    }
}

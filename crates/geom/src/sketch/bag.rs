//! Bags: the primitives of a sketch, for their removal.
//!
//! Particles only add primitives. For them a bag is a list from the newest to the oldest whose tail copies share: one entry
//! for each primitive, for any number of copies. Metropolis-Hastings also removes primitives. The first removal turns the
//! bag into a tree of boxes for good. From then on it also keeps the *mark* of each primitive: data of this primitive that
//! its removal needs, for example the cells that it fills. Copies share marks, also marks that are computed after the copy.

use crate::bounds::Aabb;
use crate::once::Once;
use crate::solids::primitive::Primitive;
use crate::tree::{BoxTree, Boxed};
use std::sync::{Arc, OnceLock};

/// A bag of primitives with marks, and the box around all of them.
#[derive(Clone, Debug)]
pub struct Bag<M = ()> {
    bounds: Aabb,
    held: Held<M>,
}

#[derive(Clone, Debug)]
enum Held<M> {
    List(Option<Arc<Entry>>),
    Tree(BoxTree<Marked<M>>),
}

/// A primitive, and its mark once it is computed.
#[derive(Clone, Debug)]
struct Marked<M> {
    primitive: Primitive,
    mark: Arc<OnceLock<M>>,
}

impl<M> Boxed for Marked<M> {
    #[inline]
    fn aabb(&self) -> &Aabb {
        self.primitive.aabb()
    }
}

#[derive(Debug)]
struct Entry {
    primitive: Primitive,
    older: Option<Arc<Entry>>,
}

impl Drop for Entry {
    /// Drops entries in a loop: a list of a million would overflow the stack if each dropped the next.
    fn drop(&mut self) {
        let mut next = self.older.take();
        while let Some(mut entry) = next.and_then(Arc::into_inner) {
            next = entry.older.take();
        }
    }
}

impl<M> Default for Bag<M> {
    fn default() -> Bag<M> {
        Bag { bounds: Aabb::EMPTY, held: Held::List(None) }
    }
}

impl<M: Clone> Bag<M> {
    /// The smallest box around all primitives: an order statistic, which removal gives back.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// True when marks of new primitives are kept.
    pub fn keeps_marks(&self) -> bool {
        matches!(self.held, Held::Tree(_))
    }

    /// Adds a primitive; `mark` computes its mark, if the bag keeps marks.
    pub fn add(&mut self, primitive: &Primitive, mark: impl FnOnce() -> M) {
        self.bounds = self.bounds.union(primitive.aabb());
        match &mut self.held {
            Held::List(newest) => {
                let older = newest.take();
                *newest = Some(Arc::new(Entry { primitive: primitive.clone(), older }));
            }
            Held::Tree(tree) => {
                let mark = Arc::new(OnceLock::from(mark()));
                tree.insert(Marked { primitive: primitive.clone(), mark });
            }
        }
    }

    /// Removes one primitive equal to this, and returns its mark, which `mark` computes if it is missing; `None` without such a
    /// primitive.
    pub fn remove(&mut self, primitive: &Primitive, mark: impl FnOnce() -> M) -> Option<M> {
        let mut tree = self.tree();
        let removed = tree.remove(primitive.aabb(), |p| p.primitive == *primitive);
        self.bounds = tree.bounds();
        self.held = Held::Tree(tree);
        removed.map(|item| item.mark.once(mark).clone())
    }

    /// Calls `f` with every primitive.
    pub fn each(&self, mut f: impl FnMut(&Primitive)) {
        match &self.held {
            Held::Tree(tree) => tree.each(|item| f(&item.primitive)),
            Held::List(newest) => {
                let mut next = newest.as_ref();
                while let Some(entry) = next {
                    f(&entry.primitive);
                    next = entry.older.as_ref();
                }
            }
        }
    }

    /// Becomes a tree, as at the first removal: copies then share it.
    pub fn expect_removals(&mut self) {
        self.held = Held::Tree(self.tree());
    }

    fn tree(&self) -> BoxTree<Marked<M>> {
        match &self.held {
            Held::Tree(tree) => tree.clone(),
            Held::List(_) => {
                let mut tree = BoxTree::default();
                self.each(|primitive| {
                    tree.insert(Marked { primitive: primitive.clone(), mark: Arc::default() });
                });
                tree
            }
        }
    }
}

impl<M: Clone> PartialEq for Bag<M> {
    fn eq(&self, other: &Bag<M>) -> bool {
        same_bag(&self.tree(), &other.tree(), |item| &item.primitive)
    }
}

/// Equality of bags: both have each primitive equally often.
pub(crate) fn same_bag<T: Clone + Boxed>(
    a: &BoxTree<T>,
    b: &BoxTree<T>,
    of: impl Fn(&T) -> &Primitive,
) -> bool {
    let mut rest = a.clone();
    let mut is_equal = a.len() == b.len();
    b.each(|item| is_equal = is_equal && rest.remove(item.aabb(), |p| of(p) == of(item)).is_some());
    is_equal
}

#[cfg(test)]
mod tests {
    //! A bag does not depend on its history, copies are independent, and long lists are dropped in a loop.
    use super::Bag;
    use crate::{Look, Primitive, Shape, vec3};

    fn cube(x: f64) -> Primitive {
        Primitive::new([Shape::cuboid(vec3(x, 0.0, 0.0), vec3(1.0, 1.0, 1.0), &Look::default()).unwrap()])
    }

    #[test]
    fn lists_and_trees_are_the_same_bag() {
        let (mut list, mut tree) = (Bag::default(), Bag::default());
        tree.add(&cube(9.0), || 'a');
        assert_eq!((tree.remove(&cube(9.0), || 'b'), tree.remove(&cube(9.0), || 'c')), (Some('b'), None));
        assert!(tree == list && tree.bounds().is_empty());
        for x in [0.0, 3.0, 3.0, -2.0] {
            list.add(&cube(x), || 'l');
        }
        for x in [-2.0, 3.0, 0.0, 3.0] {
            tree.add(&cube(x), || 't');
        }
        assert!(list == tree && list.bounds() == tree.bounds());
        let whole = list.clone();
        // The list kept no marks, the tree does; a mark that one copy computes is known to the others.
        assert_eq!(tree.clone().remove(&cube(0.0), || 'n'), Some('t'));
        list.expect_removals();
        assert_eq!(list.clone().remove(&cube(0.0), || 'n'), Some('n'));
        assert_eq!(list.clone().remove(&cube(0.0), || 'm'), Some('n'));
        assert_eq!(list.remove(&cube(3.0), || 'n'), Some('n'));
        assert!(list != whole && list.remove(&cube(3.0), || 'n').is_some());
        assert_eq!(list.remove(&cube(3.0), || 'n'), None);
        assert_eq!((list.bounds().low.x, list.bounds().high.x), (-2.5, 0.5));
        assert!(whole == tree);
    }

    #[test]
    fn the_drop_of_a_long_list_does_not_overflow_the_stack() {
        let primitive = cube(0.0);
        let mut bag = Bag::default();
        (0..300_000).for_each(|_| bag.add(&primitive, || ()));
        let copy = bag.clone();
        drop(bag);
        assert_eq!(copy.bounds(), *primitive.aabb());
    }
}

//! The primitives that a sketch holds, so that it can tell what it can give back.
//!
//! As long as primitives only come, which is all that particles do, the bag is a list from the newest to the oldest
//! whose tail copies share: one entry for each primitive, whatever the number of copies. The first removal makes a
//! tree of boxes of it, and it stays one: under Metropolis-Hastings primitives come and go.

use super::same_bag;
use crate::bounds::Aabb;
use crate::primitive::Primitive;
use crate::tree::BoxTree;
use std::sync::Arc;

/// A bag of primitives and the box around all of them.
#[derive(Clone, Debug)]
pub struct Bag {
    bounds: Aabb,
    held: Held,
}

#[derive(Clone, Debug)]
enum Held {
    List(Option<Arc<Entry>>),
    Tree(BoxTree<Primitive>),
}

#[derive(Debug)]
struct Entry {
    primitive: Primitive,
    older: Option<Arc<Entry>>,
}

impl Drop for Entry {
    /// One entry after the other: a list of a million would overflow the stack if each dropped the next.
    fn drop(&mut self) {
        let mut next = self.older.take();
        while let Some(mut entry) = next.and_then(Arc::into_inner) {
            next = entry.older.take();
        }
    }
}

impl Default for Bag {
    fn default() -> Bag {
        Bag { bounds: Aabb::EMPTY, held: Held::List(None) }
    }
}

impl Bag {
    /// The smallest box around all primitives: an order statistic, which removal gives back.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Puts a primitive in.
    pub fn add(&mut self, primitive: &Primitive) {
        self.bounds = self.bounds.union(primitive.aabb());
        match &mut self.held {
            Held::List(newest) => {
                let older = newest.take();
                *newest = Some(Arc::new(Entry { primitive: primitive.clone(), older }));
            }
            Held::Tree(tree) => tree.insert(primitive.clone()),
        }
    }

    /// Takes one primitive equal to this out; false when there is none.
    pub fn remove(&mut self, primitive: &Primitive) -> bool {
        let mut tree = self.tree();
        let found = tree.remove(primitive.aabb(), |p| p == primitive).is_some();
        self.bounds = tree.bounds();
        self.held = Held::Tree(tree);
        found
    }

    fn tree(&self) -> BoxTree<Primitive> {
        match &self.held {
            Held::Tree(tree) => tree.clone(),
            Held::List(newest) => {
                let mut tree = BoxTree::default();
                let mut next = newest.as_ref();
                while let Some(entry) = next {
                    tree.insert(entry.primitive.clone());
                    next = entry.older.as_ref();
                }
                tree
            }
        }
    }
}

impl PartialEq for Bag {
    fn eq(&self, other: &Bag) -> bool {
        same_bag(&self.tree(), &other.tree())
    }
}

#[cfg(test)]
mod tests {
    //! A bag is the same however it came about, copies do not see each other, and long lists are dropped in a loop.
    use super::Bag;
    use crate::{Look, Primitive, Shape, vec3};

    fn cube(x: f64) -> Primitive {
        Primitive::new([Shape::cuboid(vec3(x, 0.0, 0.0), vec3(1.0, 1.0, 1.0), &Look::default()).unwrap()])
    }

    #[test]
    fn lists_and_trees_are_the_same_bag() {
        let (mut list, mut tree) = (Bag::default(), Bag::default());
        tree.add(&cube(9.0));
        assert!(tree.remove(&cube(9.0)) && !tree.remove(&cube(9.0)));
        assert!(tree == list && tree.bounds().is_empty());
        for x in [0.0, 3.0, 3.0, -2.0] {
            list.add(&cube(x));
        }
        for x in [-2.0, 3.0, 0.0, 3.0] {
            tree.add(&cube(x));
        }
        assert!(list == tree && list.bounds() == tree.bounds());
        let whole = list.clone();
        assert!(list.remove(&cube(3.0)) && list != whole && list.remove(&cube(3.0)));
        assert!(!list.remove(&cube(3.0)));
        assert_eq!((list.bounds().low.x, list.bounds().high.x), (-2.5, 0.5));
        assert!(whole == tree);
    }

    #[test]
    fn a_long_list_goes_without_overflowing_the_stack() {
        let one = cube(0.0);
        let mut bag = Bag::default();
        (0..300_000).for_each(|_| bag.add(&one));
        let copy = bag.clone();
        drop(bag);
        assert_eq!(copy.bounds(), *one.aabb());
    }
}

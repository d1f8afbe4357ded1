//! A long row of bricks that copies share.
//!
//! Bricks stand in pages, so that copying a row and changing a few bricks of the copy cost a few pages and those bricks,
//! however long the row is: a chain copies its sketches before each proposal, and goes back to the copy when the
//! proposal is rejected. A brick without counts is not stored, so that equal counts are equal data.

use super::brick::Brick;
use std::sync::Arc;

/// Bricks of one page.
const PAGE: usize = 64;
type Page = [Option<Arc<Brick>>; PAGE];

/// Bricks by number. Cloning shares all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Pages(Arc<Vec<Arc<Page>>>);

impl Pages {
    /// Room for as many bricks, none stored.
    pub fn new(bricks: usize) -> Pages {
        let empty: Arc<Page> = Arc::new([const { None }; PAGE]);
        Pages(Arc::new(vec![empty; bricks.div_ceil(PAGE)]))
    }

    /// A brick that is stored.
    #[inline]
    pub fn get(&self, number: usize) -> Option<&Brick> {
        self.0[number / PAGE][number % PAGE].as_deref()
    }

    /// Changes a brick, empty if none is stored, and lets go of it when no count is left.
    #[inline]
    pub fn change(&mut self, number: usize, change: impl FnOnce(&mut Brick)) {
        let place = &mut Arc::make_mut(&mut Arc::make_mut(&mut self.0)[number / PAGE])[number % PAGE];
        let brick = Arc::make_mut(place.get_or_insert_default());
        change(brick);
        if brick.trim() {
            *place = None;
        }
    }

    /// Bricks that this and `other` share in memory.
    pub fn shared_with(&self, other: &Pages) -> usize {
        let bricks = |pages: &Pages| pages.0.iter().flat_map(|page| page.iter().cloned()).collect::<Vec<_>>();
        let (ours, theirs) = (bricks(self), bricks(other));
        let pairs = ours.iter().zip(&theirs);
        pairs.filter(|(a, b)| matches!((a, b), (Some(a), Some(b)) if Arc::ptr_eq(a, b))).count()
    }
}

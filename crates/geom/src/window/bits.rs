//! Bits of a page, one for each cell, in tiles that copies share.

use crate::bricks::brick::Plane;
use std::sync::Arc;

/// Words of bits. Cloning shares all tiles; a change copies a tile only if it is shared.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Bits(Arc<Vec<Arc<Plane>>>);

impl Bits {
    /// Zeros for a number of words.
    pub fn new(words: usize) -> Bits {
        let empty = Arc::new([0; 64]);
        Bits(Arc::new((0..words.div_ceil(64)).map(|_| empty.clone()).collect()))
    }

    /// A word.
    #[inline]
    pub fn word(&self, word: usize) -> u64 {
        self.0[word / 64][word % 64]
    }

    /// Changes the bits of a word that are set in `bits`.
    #[inline]
    pub fn flip(&mut self, word: usize, bits: u64) {
        let tile = &mut Arc::make_mut(&mut self.0)[word / 64];
        Arc::make_mut(tile)[word % 64] ^= bits;
    }
}

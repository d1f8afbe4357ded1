//! Counts of the shapes that each ray of a picture meets, in tiles that copies share.
//!
//! A tile is 64 bundles of 64 rays that are near each other. A change copies a tile only if it is shared. A tile without
//! counts is not stored.

use crate::bricks::brick::Brick;
use crate::view::Cover;
use std::sync::Arc;

/// The number of words of a tile.
const TILE: usize = 64;

/// A count for every ray. Cloning shares all tiles.
#[derive(Clone, Debug, PartialEq)]
pub struct Tiles(Arc<Vec<Option<Arc<Brick>>>>);

impl Tiles {
    /// Zeros for a number of words of rays.
    pub fn new(words: usize) -> Tiles {
        Tiles(Arc::new(vec![None; words.div_ceil(TILE)]))
    }

    /// Adds one to the count of every ray of `cover`; `each` gets the rays of each word that met nothing before.
    pub fn add(&mut self, cover: &Cover, mut each: impl FnMut(usize, u64)) {
        self.visit(cover, |brick, word, rays| each(word, brick.raise(word % TILE, &[rays])[0]));
    }

    /// Subtracts one from the count of every ray of `cover`, which must be above 0; `each` gets the rays of each word that meet
    /// nothing now.
    pub fn remove(&mut self, cover: &Cover, mut each: impl FnMut(usize, u64)) {
        self.visit(cover, |brick, word, rays| each(word, brick.lower(word % TILE, &[rays])[0]));
        let tiles = Arc::make_mut(&mut self.0);
        for words in cover.words().chunk_by(|a, b| a.0 as usize / TILE == b.0 as usize / TILE) {
            let tile = &mut tiles[words[0].0 as usize / TILE];
            if tile.as_mut().is_some_and(|brick| Arc::make_mut(brick).trim()) {
                *tile = None;
            }
        }
    }

    fn visit(&mut self, cover: &Cover, mut each: impl FnMut(&mut Brick, usize, u64)) {
        if cover.words().is_empty() {
            return;
        }
        let tiles = Arc::make_mut(&mut self.0);
        for words in cover.words().chunk_by(|a, b| a.0 as usize / TILE == b.0 as usize / TILE) {
            let tile = tiles[words[0].0 as usize / TILE].get_or_insert_with(Arc::default);
            let brick = Arc::make_mut(tile);
            words.iter().for_each(|(word, rays)| each(brick, *word as usize, *rays));
        }
    }

    /// Rays of a word that meet a shape.
    #[inline]
    pub fn any(&self, word: usize) -> u64 {
        self.0[word / TILE].as_ref().map_or(0, |brick| brick.any(word % TILE))
    }

    /// The count of shapes that a ray meets.
    pub fn get(&self, ray: usize) -> u32 {
        self.0[ray / 64 / TILE].as_ref().map_or(0, |brick| brick.get(ray / 64 % TILE, ray % 64))
    }

    /// Tiles that this and `other` share in memory.
    pub fn shared_with(&self, other: &Tiles) -> usize {
        let pairs = self.0.iter().zip(other.0.iter());
        pairs.filter(|(a, b)| matches!((a, b), (Some(a), Some(b)) if Arc::ptr_eq(a, b))).count()
    }
}

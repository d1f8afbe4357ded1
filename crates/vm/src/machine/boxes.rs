//! A box for each activation: what it emitted last.

use super::buffers::copy;
use niwaki_geom::Aabb;

/// What activations emitted last.
#[derive(Debug, Default)]
pub(crate) struct Parts {
    pub(super) noted: bool,
    /// By node: the path of the activation that emitted it, and its box.
    pub(super) boxes: Vec<(u128, Aabb)>,
}

impl Parts {
    /// Whether the run notes them.
    pub fn are_noted(&self) -> bool {
        self.noted
    }

    /// Becomes a copy, in place.
    #[inline]
    pub fn clone_from(&mut self, source: &Parts) {
        self.noted = source.noted;
        if self.noted {
            copy(&mut self.boxes, &source.boxes);
        }
    }
}

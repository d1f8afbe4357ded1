//! The boxes of the parts that activations emitted last.

use super::buffers::copy;
use niwaki_geom::Aabb;

/// The part that each activation emitted last.
#[derive(Debug, Default)]
pub(crate) struct Parts {
    pub(super) are_recorded: bool,
    /// For each node, the path of the activation that emitted the part, and its box.
    pub(super) boxes: Vec<(u128, Aabb)>,
}

impl Parts {
    /// Whether the run records parts.
    pub fn is_recording(&self) -> bool {
        self.are_recorded
    }

    /// Becomes a copy of another table, in place.
    #[inline]
    pub fn clone_from(&mut self, source: &Parts) {
        self.are_recorded = source.are_recorded;
        if self.are_recorded {
            copy(&mut self.boxes, &source.boxes);
        }
    }
}

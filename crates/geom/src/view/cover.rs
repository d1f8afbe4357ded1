//! The rays that meet a shape: one bit for each ray, word by word, without empty words.
//!
//! The tree of rays is visited once for each convex piece: a solid, or a triangle of a mesh. Boxes of rays outside of
//! the outline are skipped, and boxes inside are taken whole. Only bundles on its border are tested ray by ray. So the cost
//! grows with the pixels of the shape.

use super::outline::{Checks, Outline, Outliner};
use super::rays::{Node, Rays};
use crate::mesh::TriMesh;
use crate::solids::shape::Shape;

/// A set of rays: words with their numbers, ascending, none zero.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cover(Vec<(u32, u64)>);

impl Cover {
    /// Numbers and words, ascending.
    pub fn words(&self) -> &[(u32, u64)] {
        &self.0
    }

    /// Number of rays.
    pub fn count(&self) -> usize {
        self.0.iter().map(|(_, bits)| bits.count_ones() as usize).sum()
    }

    /// The numbers of the rays, ascending.
    pub fn rays(&self) -> impl Iterator<Item = usize> + '_ {
        self.0.iter().flat_map(|(word, bits)| {
            (0..64).filter(move |k| bits >> k & 1 == 1).map(move |k| *word as usize * 64 + k)
        })
    }

    /// A cover of ascending, distinct words.
    pub(crate) fn in_order(words: Vec<(u32, u64)>) -> Cover {
        Cover(words)
    }

    /// A cover of words in any order, which may be several for a number.
    pub(crate) fn settled(mut words: Vec<(u32, u64)>) -> Cover {
        words.sort_unstable_by_key(|(word, _)| *word);
        words.dedup_by(|next, last| {
            let is_equal = next.0 == last.0;
            if is_equal {
                last.1 |= next.1;
            }
            is_equal
        });
        Cover(words)
    }
}

impl Rays {
    /// The rays that meet `shape`.
    pub fn meeting(&self, shape: &Shape) -> Cover {
        let Some(convex) = shape.convex() else { return self.meeting_mesh(&shape.world_mesh()) };
        let mut words = Vec::new();
        let mut pieces = 0;
        self.outliner().of_convex(&convex, |outline| {
            self.take(outline, &mut words);
            pieces += 1;
        });
        // The words of a single piece are in order.
        if pieces == 1 { Cover(words) } else { Cover::settled(words) }
    }

    /// The rays that meet a triangle of `mesh`.
    pub fn meeting_mesh(&self, mesh: &TriMesh) -> Cover {
        let mut words = Vec::new();
        let mut outliner = self.outliner();
        for corners in mesh.corners() {
            outliner.of_triangle(&corners, |outline| self.take(outline, &mut words));
            // At any time there are at most a few words for each bundle, for any number of triangles.
            if words.len() > 8 * self.words() + 1024 {
                words = Cover::settled(std::mem::take(&mut words)).0;
            }
        }
        Cover::settled(words)
    }

    /// The rays that meet a triangle.
    pub(super) fn meeting_triangle(&self, corners: &[crate::vector::Vec3; 3]) -> Cover {
        let mut words = Vec::new();
        self.outliner().of_triangle(corners, |outline| self.take(outline, &mut words));
        Cover(words)
    }

    fn outliner(&self) -> Outliner<'_> {
        Outliner::new(self.projection(), self.near)
    }

    fn take(&self, outline: &Outline<'_>, words: &mut Vec<(u32, u64)>) {
        if let Some(root) = self.nodes.first() {
            self.visit(root, 0, outline, outline.all_checks(), words);
        }
    }

    /// The tree halves its rays, so this is shallow.
    fn visit(
        &self,
        node: &Node,
        index: usize,
        outline: &Outline<'_>,
        checks: Checks,
        words: &mut Vec<(u32, u64)>,
    ) {
        let Some(checks) = outline.remaining(node, checks) else { return };
        if checks.is_empty() {
            let range = node.first..node.first + node.count;
            words.extend(range.map(|word| (word, self.bundles[word as usize].live)));
        } else if node.second == 0 {
            let bits = outline.meets(&self.bundles[node.first as usize], checks);
            if bits != 0 {
                words.push((node.first, bits));
            }
        } else {
            for child in [index + 1, node.second as usize] {
                self.visit(&self.nodes[child], child, outline, checks, words);
            }
        }
    }
}

//! The readers of elements of collections.

use super::super::ids::NodeId;

/// A site that reads an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reader {
    pub node: NodeId,
    pub site: u16,
    /// The slot of the site: `held` is the list of readers that contains it, `mark` its place there.
    pub slot: u32,
}

/// The readers of an element.
#[derive(Debug, Default)]
pub(crate) struct Readers {
    /// The register that holds the element.
    pub register: u32,
    pub all: Vec<Reader>,
}

impl Readers {
    /// The bytes of the list.
    pub fn bytes(&self) -> usize {
        size_of::<Readers>() + self.all.capacity() * size_of::<Reader>()
    }
}

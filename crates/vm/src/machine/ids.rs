//! Numbers of nodes and futures.

/// Number of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NodeId(pub u32);

impl NodeId {
    /// No node.
    pub const NONE: NodeId = NodeId(u32::MAX);
}

/// Number of a future; the root call is future 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FutureId(pub u32);

impl FutureId {
    /// No future.
    pub const NONE: FutureId = FutureId(u32::MAX);
}

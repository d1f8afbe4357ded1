//! The vertices of faces, edges and triangles: shared by all boxes, and by all prisms with as many sides.
//!
//! A prism has a bottom ring `0..n`, a top ring `n..2n` and the two cap centres `2n` and `2n + 1`, which are
//! corners of triangles but not of the hull (facts of the original: caps are fans about their centre, `4 n`
//! triangles in all). A box is eight corners, bit 0, 1 and 2 of the index choosing the high x, y and z.

use crate::once::Once;
use std::sync::{Arc, OnceLock};

/// Faces, edges and triangles of a convex solid, as vertex indices.
#[derive(Debug, PartialEq)]
pub struct Topology {
    /// Number of corners of the hull; further vertices belong to triangles only.
    pub corners: usize,
    /// Corners of each face, counter-clockwise seen from outside.
    pub faces: Vec<Vec<u32>>,
    /// Every edge once.
    pub edges: Vec<[u32; 2]>,
    /// The surface as triangles.
    pub triangles: Vec<[u32; 3]>,
}

impl Topology {
    /// A topology of faces. Edges follow from them, and fans from the first corner of each face are the triangles.
    pub fn from_faces(corners: usize, faces: Vec<Vec<u32>>) -> Topology {
        let mut edges = Vec::new();
        let mut triangles = Vec::new();
        for face in &faces {
            for i in 0..face.len() {
                let (a, b) = (face[i], face[(i + 1) % face.len()]);
                // Each edge occurs once in each direction.
                if a < b {
                    edges.push([a, b]);
                }
            }
            triangles.extend((1..face.len() - 1).map(|i| [face[0], face[i], face[i + 1]]));
        }
        Topology { corners, faces, edges, triangles }
    }

    /// Bytes that it takes.
    pub(crate) fn bytes(&self) -> usize {
        let faces = self.faces.iter().map(|face| size_of::<Vec<u32>>() + size_of_val(&face[..]));
        faces.sum::<usize>() + size_of_val(&self.edges[..]) + size_of_val(&self.triangles[..])
    }

    /// The topology of a box with eight corners.
    pub fn cuboid() -> &'static Topology {
        Topology::the_cuboid()
    }

    /// The topology of a box, shared.
    pub fn shared_cuboid() -> Arc<Topology> {
        Topology::the_cuboid().clone()
    }

    fn the_cuboid() -> &'static Arc<Topology> {
        static CUBOID: OnceLock<Arc<Topology>> = OnceLock::new();
        let build = || {
            let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
            Arc::new(Topology::from_faces(8, faces.iter().map(|f| f.to_vec()).collect()))
        };
        CUBOID.once(build)
    }

    /// The topology of a prism or frustum over an `n`-gon whose caps have no middle.
    pub fn frustum(n: usize) -> Arc<Topology> {
        static FRUSTA: [OnceLock<Arc<Topology>>; 17] = [const { OnceLock::new() }; 17];
        let build = || {
            let (n, next) = (n as u32, |k: u32| (k + 1) % n as u32);
            let sides = (0..n).map(|k| vec![k, next(k), n + next(k), n + k]);
            let caps = [(0..n).rev().collect(), (n..2 * n).collect()];
            Arc::new(Topology::from_faces(2 * n as usize, sides.chain(caps).collect()))
        };
        FRUSTA.get(n).map_or_else(build, |cell| cell.once(build).clone())
    }

    /// The topology of a prism or frustum over an `n`-gon.
    pub fn prism(n: usize) -> Arc<Topology> {
        static PRISMS: [OnceLock<Arc<Topology>>; 65] = [const { OnceLock::new() }; 65];
        match PRISMS.get(n) {
            Some(cell) => cell.once(|| Arc::new(Topology::new_prism(n))).clone(),
            None => Arc::new(Topology::new_prism(n)),
        }
    }

    fn new_prism(n: usize) -> Topology {
        let n = n as u32;
        let next = |k: u32| (k + 1) % n;
        let sides = (0..n).map(|k| vec![k, next(k), n + next(k), n + k]);
        let caps = [(0..n).rev().collect(), (n..2 * n).collect()];
        let mut prism = Topology::from_faces(2 * n as usize, sides.chain(caps).collect());
        prism.triangles.truncate(2 * n as usize);
        for k in 0..n {
            prism.triangles.push([2 * n, next(k), k]);
            prism.triangles.push([2 * n + 1, n + k, n + next(k)]);
        }
        prism
    }
}

#[cfg(test)]
mod tests {
    //! Euler's formula holds and every edge has two triangles.
    use super::*;

    #[test]
    fn solids_are_closed() {
        let prisms = [Topology::prism(8), Topology::prism(3), Topology::prism(70)];
        for t in
            [Topology::shared_cuboid(), Topology::frustum(4), Topology::frustum(20)].into_iter().chain(prisms)
        {
            assert_eq!(t.corners + t.faces.len(), t.edges.len() + 2);
            let mut sides: Vec<(u32, u32)> =
                t.triangles.iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]).collect();
            let mut back: Vec<(u32, u32)> = sides.iter().map(|(a, b)| (*b, *a)).collect();
            sides.sort_unstable();
            back.sort_unstable();
            assert_eq!(sides, back);
        }
        assert_eq!(Topology::prism(8).triangles.len(), 32);
        assert_eq!(Topology::cuboid().triangles.len(), 12);
    }
}

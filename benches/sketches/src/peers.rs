//! The intersection tests of parry3d (double precision).

use niwaki_geom::{Primitive, TriMesh, Vec3};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::intersection_test;
use parry3d_f64::shape::{ConvexPolyhedron, SharedShape, TriMesh as PeerMesh};

/// A shape where it stands.
pub struct Peer(SharedShape);

fn point(p: &Vec3) -> Vector {
    Vector::new(p.x, p.y, p.z)
}

impl Peer {
    /// A convex polyhedron of the corners, or a mesh.
    pub fn of(primitive: &Primitive) -> Peer {
        let shape = &primitive.shapes()[0];
        let hull = shape.convex().and_then(|solid| {
            ConvexPolyhedron::from_convex_hull(&solid.corners().iter().map(point).collect::<Vec<_>>())
        });
        hull.map_or_else(|| Peer::mesh(&shape.world_mesh()), |hull| Peer(SharedShape::new(hull)))
    }

    /// A surface of triangles with a tree of boxes.
    pub fn mesh(mesh: &TriMesh) -> Peer {
        let corners = mesh.vertices().iter().map(point).collect();
        Peer(SharedShape::new(
            PeerMesh::new(corners, mesh.triangles().to_vec()).expect("a mesh with triangles"),
        ))
    }

    /// Whether they meet.
    pub fn meets(&self, other: &Peer) -> bool {
        intersection_test(&Pose::IDENTITY, &*self.0, &Pose::IDENTITY, &*other.0).unwrap_or(false)
    }
}

//! Triangles with normals, built piece by piece.

use crate::mesh::TriMesh;
use crate::vector::Vec3;

/// Sides of round solids.
pub const ROUND: usize = 48;
/// Segments of a rounded edge for each quarter turn.
pub const ARC: usize = 6;
/// Triangles with a unit normal at every vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FineMesh {
    /// Positions, scene units.
    pub vertices: Vec<Vec3>,
    /// Unit normals, one for each vertex, or none.
    pub normals: Vec<Vec3>,
    /// Triangles, counter-clockwise seen from outside.
    pub faces: Vec<[u32; 3]>,
}

impl FineMesh {
    /// Adds a vertex and returns its number.
    pub(crate) fn point(&mut self, position: Vec3, normal: Vec3) -> u32 {
        self.vertices.push(position);
        self.normals.push(normal);
        (self.vertices.len() - 1) as u32
    }

    /// Adds a triangle unless two of its corners coincide.
    pub(crate) fn face(&mut self, [a, b, c]: [u32; 3]) {
        let [p, q, r] = [a, b, c].map(|i| self.vertices[i as usize]);
        if p != q && q != r && r != p {
            self.faces.push([a, b, c]);
        }
    }

    /// Adds the quadrilateral `a b c d`, counter-clockwise.
    pub(crate) fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.face([a, b, c]);
        self.face([a, c, d]);
    }

    /// Removes vertices without a triangle, as a row that has shrunk to a point leaves them.
    pub(crate) fn without_unused(self) -> FineMesh {
        let mut used = vec![false; self.vertices.len()];
        for &corner in self.faces.iter().flatten() {
            used[corner as usize] = true;
        }
        if used.iter().all(|&is_used| is_used) {
            return self;
        }
        let mut mesh = FineMesh::default();
        let mut numbers = Vec::with_capacity(used.len());
        for ((&place, &normal), &is_used) in self.vertices.iter().zip(&self.normals).zip(&used) {
            numbers.push(if is_used { mesh.point(place, normal) } else { 0 });
        }
        mesh.faces = self.faces.iter().map(|face| face.map(|corner| numbers[corner as usize])).collect();
        mesh
    }
}

/// Several meshes as one, without joining them.
impl FromIterator<FineMesh> for FineMesh {
    fn from_iter<I: IntoIterator<Item = FineMesh>>(meshes: I) -> FineMesh {
        let mut meshes = meshes.into_iter();
        let mut all = meshes.next().unwrap_or_default();
        for mesh in meshes {
            let start = all.vertices.len() as u32;
            all.vertices.extend(mesh.vertices);
            all.normals.extend(mesh.normals);
            all.faces.extend(mesh.faces.iter().map(|face| face.map(|corner| corner + start)));
        }
        all
    }
}

impl From<&TriMesh> for FineMesh {
    /// A mesh without normals.
    fn from(mesh: &TriMesh) -> FineMesh {
        FineMesh { vertices: mesh.vertices().to_vec(), normals: Vec::new(), faces: mesh.triangles().to_vec() }
    }
}

/// `v` as a unit vector, or `or` without a direction.
pub(crate) fn unit_or(v: Vec3, or: Vec3) -> Vec3 {
    v.unit().unwrap_or(or)
}

//! Triangle meshes: checked once, then shared.

use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::folds::{Fold, folds};
use crate::once::Once;
use crate::vector::Vec3;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// Triangles over shared vertices. Every index is in range and every coordinate finite.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(try_from = "Arrays")]
pub struct TriMesh {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    /// Flat parts that lie over themselves, computed at the first fill.
    #[serde(skip)]
    folds: OnceLock<Arc<[Fold]>>,
    /// Its reflection, computed when it is first used.
    #[serde(skip)]
    mirrored: OnceLock<Arc<TriMesh>>,
}

impl PartialEq for TriMesh {
    fn eq(&self, other: &TriMesh) -> bool {
        self.vertices == other.vertices && self.triangles == other.triangles
    }
}

/// A mesh before it is checked.
#[derive(Deserialize)]
struct Arrays {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl TryFrom<Arrays> for TriMesh {
    type Error = GeomError;

    fn try_from(arrays: Arrays) -> Result<TriMesh, GeomError> {
        TriMesh::new(arrays.vertices, arrays.triangles)
    }
}

impl TriMesh {
    /// A mesh of `vertices` (scene units) and `triangles` (three indices each).
    ///
    /// # Errors
    /// `bad-shape` without a triangle, and for the first bad entry.
    pub fn new(vertices: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Result<TriMesh, GeomError> {
        if vertices.is_empty() || triangles.is_empty() {
            let (v, t) = (vertices.len(), triangles.len());
            return Err(GeomError::new(
                "bad-shape",
                format!("a mesh needs a triangle, found {v} vertices and {t} faces"),
            ));
        }
        if let Some(i) = vertices.iter().position(|v| !v.is_finite()) {
            let message = format!("vertex {i} is {:?}, expected finite coordinates", vertices[i].to_array());
            return Err(GeomError::new("bad-shape", message));
        }
        let count = vertices.len();
        if let Some(i) = triangles.iter().position(|t| t.iter().any(|v| *v as usize >= count)) {
            let message = format!("face {i} is {:?}, but there are only {count} vertices", triangles[i]);
            return Err(GeomError::new("bad-shape", message));
        }
        Ok(TriMesh { vertices, triangles, folds: OnceLock::new(), mirrored: OnceLock::new() })
    }

    /// The vertices.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Three vertex indices for each triangle, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Bytes of its vertices and triangles.
    pub fn bytes(&self) -> usize {
        size_of_val(self.vertices()) + size_of_val(self.triangles())
    }

    /// Corners of each triangle.
    pub fn corners(&self) -> impl Iterator<Item = [Vec3; 3]> + '_ {
        self.triangles.iter().map(|t| t.map(|v| self.vertices[v as usize]))
    }

    /// The smallest box around all vertices that a triangle uses.
    pub fn aabb(&self) -> Aabb {
        Aabb::around(self.corners().flatten())
    }

    /// The mesh with every vertex moved by `f`.
    pub fn map(&self, f: impl Fn(Vec3) -> Vec3) -> TriMesh {
        let vertices = self.vertices.iter().map(|v| f(*v)).collect();
        TriMesh {
            vertices,
            triangles: self.triangles.clone(),
            folds: OnceLock::new(),
            mirrored: OnceLock::new(),
        }
    }

    /// The mesh scaled, turned and moved by `f`. Its flat parts stay flat, and are not computed again.
    pub fn placed(&self, f: impl Fn(Vec3) -> Vec3) -> TriMesh {
        self.folds();
        TriMesh { folds: self.folds.clone(), ..self.map(f) }
    }

    /// The mesh reflected at the plane x = 0: the same one at each call.
    pub(crate) fn mirrored(&self) -> Arc<TriMesh> {
        let reflect = || {
            let triangles = self.triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
            Arc::new(TriMesh { triangles, ..self.map(Vec3::mirrored) })
        };
        self.mirrored.once(reflect).clone()
    }

    /// The flat parts that lie over themselves.
    pub(crate) fn folds(&self) -> &[Fold] {
        self.folds.once(|| folds(self).into())
    }

    /// For each vertex the number of the first one at its place.
    pub(crate) fn merged(&self) -> Vec<u32> {
        let mut first: HashMap<[u64; 3], u32> = HashMap::new();
        // Adding zero turns -0.0 into 0.0, so that both are the same vertex.
        let key = |v: &Vec3| v.to_array().map(|c| (c + 0.0).to_bits());
        (0..).zip(&self.vertices).map(|(i, v)| *first.entry(key(v)).or_insert(i)).collect()
    }

    /// Number of edges not shared by exactly two triangles, after merging equal vertices: zero for a closed mesh.
    pub fn open_edges(&self) -> usize {
        let merged = self.merged();
        let mut uses: HashMap<(u32, u32), usize> = HashMap::new();
        for t in &self.triangles {
            let t = t.map(|v| merged[v as usize]);
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                if a != b {
                    *uses.entry((a.min(b), a.max(b))).or_insert(0) += 1;
                }
            }
        }
        uses.values().filter(|n| **n != 2).count()
    }
}

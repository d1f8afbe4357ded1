//! Triangles: a mesh of any of them is voxelised, drawn and intersected, or refused.

use crate::numbers::{below, near, point, real, size};
use crate::solids::{mesh, shape};
use arbitrary::Unstructured;
use niwaki_geom::hull::hull;
use niwaki_geom::voxel::surface::touches;
use niwaki_geom::{Grid, Look, Rule, Shape, Target, TriMesh, Vec3, Voxels, intersects};
use niwaki_render::{Camera, Shot, Surface, render};
use std::sync::Arc;

/// Grids of more cells than this are not filled, so that an input takes some milliseconds at most.
const MOST_CELLS: usize = 1 << 18;
/// Grids of more cells than this are not compared cell by cell.
const MOST_COMPARED: usize = 2000;

/// Does with a mesh all that the engine can.
///
/// # Panics
/// When a touched cell is not filled, or the order of two shapes decides whether they intersect.
pub fn check(bytes: &[u8]) {
    let u = &mut Unstructured::new(bytes);
    let strange = below(u, 3) == 0;
    let Ok(mesh) = mesh(u, strange) else { return };
    let voxel = if strange { real(u) } else { size(u).max(0.02) };
    if let Ok(grid) = Grid::around(&mesh.aabb(), voxel)
        && grid.len() <= MOST_CELLS
    {
        voxels(&mesh, &grid);
        if let Ok(target) = Target::new(mesh.clone(), voxel) {
            assert!(target.filled() <= grid.len());
        }
    }
    picture(u, &mesh);
    let _ = (hull(mesh.vertices()), mesh.open_edges());
    let Ok(solid) = Shape::mesh(&Arc::new(mesh), near(u), size(u), &Look::default()) else { return };
    let _ = solid.fine_mesh();
    let Some(other) = shape(u) else { return };
    for rule in [Rule::Solid, Rule::Surface] {
        assert_eq!(intersects(&solid, &other, rule), intersects(&other, &solid, rule), "{rule:?}");
    }
}

/// Every cell that a triangle touches is filled.
fn voxels(mesh: &TriMesh, grid: &Grid) {
    let Some(voxels) = Voxels::of_mesh(mesh, grid) else { return };
    let [nx, ny, nz] = grid.dims();
    assert!(voxels.count() <= grid.len());
    if grid.len() > MOST_COMPARED {
        return;
    }
    let corners: Vec<[Vec3; 3]> = mesh.corners().map(|t| t.map(|p| grid.to_grid(p))).collect();
    for cell in (0..nx * ny * nz).map(|i| [i % nx, i / nx % ny, i / nx / ny]) {
        let touched = corners.iter().any(|t| touches(t, cell.map(|k| k as i64)));
        assert!(!touched || voxels.contains(cell), "{cell:?} is touched and not filled");
    }
}

/// A picture has all its pixels, whatever is in it.
fn picture(u: &mut Unstructured<'_>, mesh: &TriMesh) {
    let narrow = |p: Vec3| p.to_array().map(|x| x as f32);
    let surface = Surface {
        vertices: mesh.vertices().iter().map(|p| narrow(*p)).collect(),
        faces: mesh.triangles().to_vec(),
        ..Surface::default()
    };
    let camera =
        Camera { eye: narrow(point(u)), target: narrow(near(u)), up: narrow(near(u)), fov_y: real(u) as f32 };
    let camera = (below(u, 2) == 0).then_some(camera);
    let shot = Shot { width: 3, height: 2, samples: 1, camera, ..Shot::default() };
    if let Ok(pixels) = render(&[surface], None, &shot) {
        assert_eq!(pixels.len(), 24);
    }
}

//! Properties of every solid.

use super::shape::Shape;
use crate::bounds::Aabb;
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::vector::{Mat3, Vec3, vec3};

fn volume(mesh: &TriMesh) -> f64 {
    mesh.corners().map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

/// Both meshes are closed. The fine one has nearly this volume (a share of which is the tolerance), unit normals that agree
/// with its faces, and no vertex without a face. The coarse one lies in the shape's box, and has an inside. Its own frame is
/// at it.
pub(crate) fn sound(shape: &Shape, expected: f64, tolerance: f64) {
    let coarse = shape.world_mesh();
    assert_eq!(coarse.open_edges(), 0, "{}", shape.kind());
    assert!(volume(&coarse) > 0.0 && shape.aabb().grown(1e-9).contains(&coarse.aabb()), "{}", shape.kind());

    let frame = shape.frame();
    assert!(
        frame.rotation.defect() < 1e-9
            && shape.aabb().grown(1e-9).contains(&Aabb::around([frame.translation])),
        "{}",
        shape.kind()
    );

    // A reflected shape is the reflection of the shape, and of its fine mesh; twice reflected it is the shape.
    let mirror = Placement {
        rotation: Mat3 { columns: [vec3(-1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)] },
        translation: vec3(2.0, 0.0, 0.0),
    };
    let mirrored = shape.in_frame(&mirror).expect("a reflection");
    let pairs = [
        (shape.world_mesh().vertices().to_vec(), mirrored.world_mesh().vertices().to_vec()),
        (shape.fine_mesh().vertices, mirrored.fine_mesh().vertices),
    ];
    let near = |p: Vec3, points: &[Vec3]| points.iter().any(|q| (*q - p).norm() < 1e-9);
    for (points, reflected) in pairs {
        assert!(
            points.iter().step_by(1 + points.len() / 100).all(|p| near(mirror.apply(*p), &reflected)),
            "{} mirrored",
            shape.kind()
        );
    }
    assert!(volume(&mirrored.world_mesh()) > 0.0, "{} mirrored", shape.kind());

    let fine = shape.fine_mesh();
    let mesh = TriMesh::new(fine.vertices.clone(), fine.faces.clone()).unwrap();
    assert_eq!(mesh.open_edges(), 0, "{}", shape.kind());
    let measured = volume(&mesh);
    assert!((measured / expected - 1.0).abs() < tolerance, "{}: {measured} for {expected}", shape.kind());
    let used: std::collections::HashSet<u32> = fine.faces.iter().flatten().copied().collect();
    assert_eq!(used.len(), fine.vertices.len(), "{}", shape.kind());
    for face in &fine.faces {
        let [a, b, c] = face.map(|i| fine.vertices[i as usize]);
        let across = (b - a).cross(c - a);
        for &i in face {
            assert!((fine.normals[i as usize].norm() - 1.0).abs() < 1e-9);
            assert!(fine.normals[i as usize].dot(across) > -1e-9, "{}", shape.kind());
        }
    }
}

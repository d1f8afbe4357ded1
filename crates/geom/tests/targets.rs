//! Voxels of three published targets have the published counts, and an empty scene the published score.
//!
//! The meshes are not part of the project: the test reads them from the folder in `NIWAKI_REFERENCE_TARGETS` and
//! prints a note when it is not set.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

use niwaki_geom::{Sketch, Target, TriMesh, VolumeMatch, vec3};
use std::path::Path;
use std::sync::Arc;

/// Vertices and triangles of a Wavefront file; everything else is skipped.
fn read(path: &Path) -> TriMesh {
    let text = std::fs::read_to_string(path).expect("a readable mesh");
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let p: Vec<f64> = words.map(|w| w.parse().expect("a coordinate")).collect();
                vertices.push(vec3(p[0], p[1], p[2]));
            }
            Some("f") => {
                let face: Vec<u32> = words
                    .map(|w| w.split('/').next().unwrap().parse::<u32>().expect("an index") - 1)
                    .collect();
                triangles.extend((1..face.len() - 1).map(|i| [face[0], face[i], face[i + 1]]));
            }
            _ => (),
        }
    }
    TriMesh::new(vertices, triangles).expect("a mesh")
}

#[test]
fn published_counts_and_scores_come_out() {
    let Ok(folder) = std::env::var("NIWAKI_REFERENCE_TARGETS") else {
        println!("skipped: NIWAKI_REFERENCE_TARGETS is not set");
        return;
    };
    for (name, voxel, dims, filled, score) in [
        ("shipProxy2", 0.25, [75, 14, 62], 17662, -86.02),
        ("buildingProxy1_thicker", 0.25, [108, 51, 71], 75359, -40.43),
        ("treeProxy_long_2", 0.4, [17, 66, 35], 5890, -22.13),
    ] {
        let mesh = read(&Path::new(&folder).join(format!("{name}.obj")));
        let target = Arc::new(Target::new(mesh, voxel).unwrap());
        assert_eq!(target.grid().dims(), dims, "{name}");
        assert_eq!(target.filled(), filled, "{name}");
        let empty = VolumeMatch::new(target.clone(), 0.02);
        assert!((empty.log_score() - score).abs() < 0.005, "{name}: {}", empty.log_score());
        println!("{name}: {dims:?} cells, {filled} filled, empty scene {:.2}", empty.log_score());
    }
}

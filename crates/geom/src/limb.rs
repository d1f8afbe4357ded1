//! Convex hull of two rings that lie in front of each other: both rings, and a band of triangles between them.
//!
//! ```text
//!     b[j] ---- b[j+1]       the edge a[i] b[j] is on the hull; the next face of the band ends at a[i+1] or at b[j+1]:
//!      |  \    /             at a[i+1] when b[j+1] is below the plane of a[i], a[i+1], b[j]; at both, as a
//!     a[i] ---- a[i+1]       quadrangle, when it is on it; otherwise at b[j+1]
//! ```
//!
//! This is the merge step of the divide-and-conquer hull (Preparata & Hong 1977) for polygons: linear in the number
//! of sides. If a ring cuts the plane of the other, the general hull replaces it.

use crate::topology::Topology;
use crate::vector::Vec3;

/// Faces of the hull of the rings `points[..sides]` and `points[sides..]`, both counter-clockwise seen against the
/// direction from the first to the second; `None` when one does not lie in front of the other.
pub fn band(points: &[Vec3], sides: usize) -> Option<Topology> {
    let (a, b) = points.split_at(sides);
    let close = 1e-10 * (a[0] - a[1]).norm().max((b[0] - b[1]).norm());
    // Normals from corners far apart: a third of the ring between them.
    let plane = |ring: &[Vec3]| {
        let [p, q, r] = [0, sides / 3, 2 * sides / 3].map(|k| ring[k]);
        (q - p).cross(r - p).unit().map(|normal| (normal, normal.dot(p)))
    };
    let (low, high) = (plane(a)?, plane(b)?);
    let ahead = b.iter().all(|p| low.0.dot(*p) - low.1 > close);
    let behind = a.iter().all(|p| high.0.dot(*p) - high.1 < -close);
    if !(ahead && behind) {
        return None;
    }

    let above = |p: Vec3, [q, r, s]: [Vec3; 3]| Some((r - q).cross(s - q).unit()?.dot(p - q));
    let mut first = 0;
    for k in 1..sides {
        if above(b[k], [a[0], a[1], b[first]])? > close {
            first = k;
        }
    }
    let index = |ring: usize, k: usize| (ring * sides + k % sides) as u32;
    let mut faces = Vec::with_capacity(2 * sides + 2);
    faces.push((0..sides).rev().map(|k| index(0, k)).collect::<Vec<u32>>());
    faces.push((0..sides).map(|k| index(1, k)).collect());
    let (mut i, mut j) = (0, first);
    while i < sides || j < first + sides {
        let height = above(b[(j + 1) % sides], [a[i % sides], a[(i + 1) % sides], b[j % sides]])?;
        let (more_a, more_b) = (i < sides, j < first + sides);
        // The first face is known to end at a[1].
        let to_a = more_a && (i == 0 || !more_b || height <= close);
        let to_b = more_b && (!to_a || height.abs() <= close);
        faces.push(match (to_a, to_b) {
            (true, true) => vec![index(0, i), index(0, i + 1), index(1, j + 1), index(1, j)],
            (true, false) => vec![index(0, i), index(0, i + 1), index(1, j)],
            _ => vec![index(0, i), index(1, j + 1), index(1, j)],
        });
        i += usize::from(to_a);
        j += usize::from(to_b);
    }
    Some(Topology::from_faces(points.len(), faces))
}

#[cfg(test)]
mod tests {
    //! The band is the general hull: the same volume, and every vertex below every face.
    use super::band;
    use crate::hull::hull;
    use crate::ring::Ring;
    use crate::topology::Topology;
    use crate::vector::{Vec3, vec3};

    fn volume(points: &[Vec3], topology: &Topology) -> f64 {
        let corner = |t: &[u32; 3]| t.map(|v| points[v as usize]);
        topology.triangles.iter().map(corner).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    #[test]
    fn bent_straight_and_twisted_limbs_have_their_hull() {
        let (mut bands, mut quads) = (0, 0);
        for k in 0..2000u64 {
            let u = |s: u64| (k.wrapping_mul(s).wrapping_add(s) % 1009) as f64 / 1009.0 - 0.5;
            let straight = if k % 4 == 0 { 0.0 } else { 1.0 };
            let normal = vec3(u(31), u(77) + 0.6, u(57)).unit().unwrap();
            let end = vec3(u(211), 1.5 + u(307), u(401));
            let end = if straight == 0.0 { normal * 2.0 } else { end };
            let turned = (normal + vec3(u(83), u(109), u(139)) * straight).unit().unwrap();
            let start = Ring { center: Vec3::ZERO, normal, radius: 0.6 + u(13) };
            let end = Ring { center: end, normal: turned, radius: 0.6 + u(17) };
            let sides = 3 + k as usize % 9;
            let points: Vec<Vec3> = start.vertices(sides).chain(end.vertices(sides)).collect();
            let Some(band) = band(&points, sides) else { continue };
            bands += 1;
            quads += band.faces.iter().filter(|f| f.len() == 4).count();
            assert_eq!(band.corners + band.faces.len(), band.edges.len() + 2, "{k}");
            let expected = volume(&points, &hull(&points).unwrap());
            assert!((volume(&points, &band) - expected).abs() < 1e-9 * expected.max(1e-3), "{k} {sides}");
            for face in &band.faces {
                let [a, b, c] = [face[0], face[1], face[2]].map(|v| points[v as usize]);
                let normal = (b - a).cross(c - a).unit().unwrap();
                assert!(points.iter().all(|p| normal.dot(*p - a) < 1e-8), "{k}");
            }
        }
        assert!(bands > 1000 && quads > 1000, "{bands} {quads}");
    }
}

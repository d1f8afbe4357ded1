//! Convex hull of a few dozen points, for limbs and cones, by adding one point at a time.
//!
//! Each new point sees some faces. A fan from the point to the rim of these faces replaces them. Triangles in one plane are
//! merged at the end, so that a ring becomes one face again. Points within `1e-10` of the size from the
//! hull so far are taken to lie on it: limbs have rounding errors of `1e-16`, and no model has details of `1e-10`.

use crate::bounds::Aabb;
use crate::topology::Topology;
use crate::vector::Vec3;

struct Triangle {
    corners: [u32; 3],
    normal: Vec3,
    offset: f64,
}

/// Faces and edges of the hull of `points`, or `None` when they lie in a plane.
pub fn hull(points: &[Vec3]) -> Option<Topology> {
    let close = closeness(points);
    let make = |corners: [u32; 3]| {
        let [a, b, c] = corners.map(|i| points[i as usize]);
        let normal = (b - a).cross(c - a).unit()?;
        Some(Triangle { corners, normal, offset: normal.dot(a) })
    };
    let mut faces = first_tetrahedron(points)?.into_iter().map(make).collect::<Option<Vec<_>>>()?;
    let mut rim: Vec<(u32, u32)> = Vec::new();
    for (i, p) in points.iter().enumerate() {
        rim.clear();
        faces.retain(|f| {
            let hidden = f.normal.dot(*p) - f.offset <= close;
            if !hidden {
                let [a, b, c] = f.corners;
                rim.extend([(a, b), (b, c), (c, a)]);
            }
            hidden
        });
        for k in 0..rim.len() {
            let (a, b) = rim[k];
            if !rim.contains(&(b, a)) {
                faces.push(make([a, b, i as u32])?);
            }
        }
    }
    Some(Topology::from_faces(points.len(), merged(&faces, points, close)?))
}

/// The distance below which a point lies on a plane.
fn closeness(points: &[Vec3]) -> f64 {
    let size = Aabb::around(points.iter().copied()).extent();
    1e-10 * size.x.max(size.y).max(size.z)
}

/// Numbers of four points far from each other, not all in a plane; `None` for points in a plane, which have no hull.
pub fn far_apart(points: &[Vec3]) -> Option<[usize; 4]> {
    let close = closeness(points);
    let farthest = |measure: &dyn Fn(Vec3) -> f64| {
        let best = (0..points.len()).max_by(|i, j| measure(points[*i]).total_cmp(&measure(points[*j])))?;
        (measure(points[best]) > close).then_some(best)
    };
    let a = 0;
    let b = farthest(&|p| (p - points[a]).norm())?;
    let along = (points[b] - points[a]).unit()?;
    let c = farthest(&|p| (p - points[a]).cross(along).norm())?;
    let normal = (points[b] - points[a]).cross(points[c] - points[a]).unit()?;
    let d = farthest(&|p| (p - points[a]).dot(normal).abs())?;
    Some([a, b, c, d])
}

/// Four points far from each other, as outward triangles.
fn first_tetrahedron(points: &[Vec3]) -> Option<[[u32; 3]; 4]> {
    let [a, b, c, d] = far_apart(points)?;
    let normal = (points[b] - points[a]).cross(points[c] - points[a]);
    let (b, c) = if (points[d] - points[a]).dot(normal) > 0.0 { (c, b) } else { (b, c) };
    let [a, b, c, d] = [a, b, c, d].map(|i| i as u32);
    Some([[a, b, c], [a, d, b], [b, d, c], [c, d, a]])
}

/// Joins triangles of one plane into one face: its sides are those that no opposite side cancels. `None` if too few remain,
/// because points lie as close as rounding.
fn merged(triangles: &[Triangle], points: &[Vec3], close: f64) -> Option<Vec<Vec<u32>>> {
    let mut faces = Vec::new();
    let mut done = vec![false; triangles.len()];
    for first in 0..triangles.len() {
        if done[first] {
            continue;
        }
        let plane = &triangles[first];
        let mut sides: Vec<(u32, u32)> = Vec::new();
        for (i, t) in triangles.iter().enumerate().skip(first) {
            let inside = t
                .corners
                .iter()
                .all(|c| (plane.normal.dot(points[*c as usize]) - plane.offset).abs() <= close);
            if !done[i] && inside && t.normal.dot(plane.normal) > 0.999 {
                done[i] = true;
                let [a, b, c] = t.corners;
                sides.extend([(a, b), (b, c), (c, a)]);
            }
        }
        let rim: Vec<(u32, u32)> =
            sides.iter().copied().filter(|(a, b)| !sides.contains(&(*b, *a))).collect();
        if rim.len() < 3 {
            return None;
        }
        let mut face = vec![rim[0].0];
        let mut at = rim[0].1;
        while at != face[0] && face.len() < rim.len() {
            face.push(at);
            match rim.iter().find(|(a, _)| *a == at) {
                Some((_, b)) => at = *b,
                None => break,
            }
        }
        faces.push(face);
    }
    Some(faces)
}

#[cfg(test)]
mod tests {
    //! A box with points inside and on its faces comes back as six faces.
    use super::*;
    use crate::vector::vec3;

    #[test]
    fn the_hull_of_a_lattice_is_its_box() {
        let mut points = Vec::new();
        for i in 0..27 {
            points.push(vec3((i % 3) as f64, (i / 3 % 3) as f64, (i / 9) as f64));
        }
        let hull = hull(&points).unwrap();
        assert_eq!(hull.faces.len(), 6);
        for face in &hull.faces {
            let [a, b, c] = [face[0], face[1], face[2]].map(|i| points[i as usize]);
            let normal = (b - a).cross(c - a);
            assert!(points.iter().all(|p| (*p - a).dot(normal) <= 1e-12));
        }
    }

    #[test]
    fn points_of_a_plane_have_no_hull() {
        let points: Vec<Vec3> = (0..9).map(|i| vec3((i % 3) as f64, 1.0, (i / 3) as f64)).collect();
        assert!(hull(&points).is_none());
    }

    #[test]
    fn points_that_are_too_far_for_their_size_have_a_whole_hull_or_none() {
        for k in 0..40 {
            let far = vec3(0.3, 0.7, 0.5) * 2.0_f64.powi(k);
            let ring = (0..7).map(|i| f64::from(i) * 0.9).map(|x| vec3(x.sin(), 0.0, x.cos()));
            let points: Vec<Vec3> = ring.chain([vec3(0.0, 1.0, 0.0)]).map(|p| p + far).collect();
            let outcome = hull(&points);
            assert!(outcome.as_ref().is_none_or(|hull| hull.faces.iter().all(|face| face.len() > 2)), "{k}");
            assert!(outcome.is_some() || k > 15, "{k}");
        }
    }
}

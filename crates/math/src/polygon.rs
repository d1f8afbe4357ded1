//! Simple polygons of the plane: containment, distance from the boundary, area, and the area shared with a disc.
//!
//! A polygon is the list of its corners in order, in either direction; the first corner is not repeated. The edge from the last
//! corner to the first closes the boundary. For a polygon that crosses itself the results have no meaning.

use crate::Scalar;

/// A point of the plane.
pub type Point<S> = [S; 2];

fn edges<S: Scalar>(corners: &[Point<S>]) -> impl Iterator<Item = (Point<S>, Point<S>)> {
    (0..corners.len()).map(|at| (corners[at], corners[(at + 1) % corners.len()]))
}

fn minus<S: Scalar>(a: Point<S>, b: Point<S>) -> Point<S> {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot<S: Scalar>(a: Point<S>, b: Point<S>) -> S {
    a[0] * b[0] + a[1] * b[1]
}

fn cross<S: Scalar>(a: Point<S>, b: Point<S>) -> S {
    a[0] * b[1] - a[1] * b[0]
}

/// Twice the signed area, positive for counter-clockwise corners: the shoelace formula.
pub fn twice_signed<S: Scalar>(corners: &[Point<S>]) -> S {
    let Some(first) = corners.first() else { return S::from_f64(0.0) };
    edges(corners).fold(S::from_f64(0.0), |sum, (a, b)| sum + cross(minus(a, *first), minus(b, *first)))
}

/// The area, for either direction of the corners.
pub fn area<S: Scalar>(corners: &[Point<S>]) -> S {
    (twice_signed(corners) * S::from_f64(0.5)).abs()
}

/// Whether a point is inside: a ray from it towards +x then crosses the boundary an odd number of times. A point of
/// the boundary is inside on left and lower edges and outside on the others.
pub fn contains<S: Scalar>(corners: &[Point<S>], point: Point<S>) -> bool {
    let [x, y] = point;
    edges(corners).fold(false, |inside, ([ax, ay], [bx, by])| {
        if (ay > y) == (by > y) {
            return inside;
        }
        inside != (x < ax + (y - ay) / (by - ay) * (bx - ax))
    })
}

/// The distance from a point to the nearest point of the boundary, from inside or outside.
pub fn boundary_distance<S: Scalar>(corners: &[Point<S>], point: Point<S>) -> S {
    let mut least: Option<S> = None;
    for (a, b) in edges(corners) {
        let (edge, from) = (minus(b, a), minus(point, a));
        let length = dot(edge, edge);
        let t = if length.value() == 0.0 { S::from_f64(0.0) } else { dot(from, edge) / length };
        let t = t.max(S::from_f64(0.0)).min(S::from_f64(1.0));
        let away = minus(from, [edge[0] * t, edge[1] * t]);
        let square = dot(away, away);
        least = Some(least.map_or(square, |least| least.min(square)));
    }
    least.map_or(S::from_f64(f64::INFINITY), |square| {
        if square.value() == 0.0 { S::from_f64(0.0) } else { square.sqrt() }
    })
}

/// The area that a polygon and a disc have in common.
///
/// With the centre at the origin, the sum over edges of the signed area between the edge and the centre, as far as it
/// lies in the disc: a triangle for the part of the edge inside of the circle, a sector for each part outside of it.
pub fn disc_area<S: Scalar>(corners: &[Point<S>], center: Point<S>, radius: S) -> S {
    if radius <= S::from_f64(0.0) {
        return S::from_f64(0.0);
    }
    let half = S::from_f64(0.5);
    let sector = |a: Point<S>, b: Point<S>| radius * radius * half * cross(a, b).atan2(dot(a, b));
    let total = edges(corners).fold(S::from_f64(0.0), |sum, (a, b)| {
        let (a, b) = (minus(a, center), minus(b, center));
        let edge = minus(b, a);
        let square = dot(edge, edge);
        if square.value() == 0.0 {
            return sum;
        }
        // Parameters of the points where the line meets the circle, in lengths of the edge.
        let middle = -(dot(a, edge) / square);
        let discriminant = middle * middle - (dot(a, a) - radius * radius) / square;
        if discriminant <= S::from_f64(0.0) {
            return sum + sector(a, b);
        }
        let reach = discriminant.sqrt();
        let clamped = |t: S| t.max(S::from_f64(0.0)).min(S::from_f64(1.0));
        let (enter, leave) = (clamped(middle - reach), clamped(middle + reach));
        if enter >= leave {
            return sum + sector(a, b);
        }
        let at = |t: S| [a[0] + edge[0] * t, a[1] + edge[1] * t];
        let (p, q) = (at(enter), at(leave));
        let before = if enter > S::from_f64(0.0) { sector(a, p) } else { S::from_f64(0.0) };
        let after = if leave < S::from_f64(1.0) { sector(q, b) } else { S::from_f64(0.0) };
        sum + before + cross(p, q) * half + after
    });
    total.abs()
}

/// The polygon with every edge moved inwards by `by` (outwards when negative), corners mitred.
///
/// `None` if the result is not a polygon with the same corners: an edge would turn round, or two neighbouring edges are
/// parallel and face each other.
pub fn inset<S: Scalar>(corners: &[Point<S>], by: S) -> Option<Vec<Point<S>>> {
    let n = corners.len();
    let (turn, zero) = (twice_signed(corners), S::from_f64(0.0));
    if n < 3 || turn == zero {
        return None;
    }
    let by = if turn > zero { by } else { -by };
    // The inward normal of each edge, and the distance of the moved edge from the origin along this normal.
    let mut lines = Vec::with_capacity(n);
    for (a, b) in edges(corners) {
        let edge = minus(b, a);
        let length = dot(edge, edge);
        if length.value() == 0.0 {
            return None;
        }
        let length = length.sqrt();
        let normal = [-(edge[1] / length), edge[0] / length];
        lines.push((normal, dot(normal, a) + by));
    }
    let mut moved = Vec::with_capacity(n);
    for at in 0..n {
        let ((m, p), (k, q)) = (lines[(at + n - 1) % n], lines[at]);
        let sine = cross(m, k);
        if sine.abs() < S::from_f64(1e-12) {
            if dot(m, k) < zero {
                return None;
            }
            // A corner in the middle of a straight edge.
            let corner = corners[at];
            moved.push([corner[0] + k[0] * by, corner[1] + k[1] * by]);
            continue;
        }
        moved.push([(p * k[1] - q * m[1]) / sine, (q * m[0] - p * k[0]) / sine]);
    }
    let keeps_directions =
        edges(corners).zip(edges(&moved)).all(|((a, b), (c, d))| dot(minus(b, a), minus(d, c)) > zero);
    keeps_directions.then_some(moved)
}

#[cfg(test)]
mod tests {
    //! The areas of a square and an L are computed by hand; areas with discs are compared with counts of sample points.

    use super::*;
    use std::f64::consts::PI;

    const SQUARE: [Point<f64>; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    const ELL: [Point<f64>; 6] = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.0], [2.0, 4.0], [0.0, 4.0]];

    fn reversed(corners: &[Point<f64>]) -> Vec<Point<f64>> {
        corners.iter().rev().copied().collect()
    }

    #[test]
    fn areas_containment_and_distances_of_an_ell() {
        assert_eq!(area(&ELL), 12.0);
        assert_eq!(area(&reversed(&ELL)), 12.0);
        assert!(contains(&ELL, [1.0, 3.0]) && contains(&ELL, [3.0, 1.0]));
        assert!(!contains(&ELL, [3.0, 3.0]) && !contains(&ELL, [-1.0, 1.0]) && !contains(&ELL, [5.0, 1.0]));
        assert_eq!(boundary_distance(&ELL, [1.0, 1.5]), 1.0);
        assert_eq!(boundary_distance(&ELL, [3.0, 3.0]), 1.0);
        assert_eq!(boundary_distance(&ELL, [-3.0, -4.0]), 5.0);
        assert_eq!(boundary_distance(&ELL, [2.0, 2.0]), 0.0);
        assert_eq!(boundary_distance::<f64>(&[], [0.0, 0.0]), f64::INFINITY);
    }

    #[test]
    fn areas_shared_with_discs_match_counts() {
        assert!((disc_area(&SQUARE, [1.0, 1.0], 0.5) - PI / 4.0).abs() < 1e-12);
        assert!((disc_area(&SQUARE, [1.0, 1.0], 5.0) - 4.0).abs() < 1e-12);
        assert!((disc_area(&SQUARE, [0.0, 0.0], 1.0) - PI / 4.0).abs() < 1e-12);
        assert!((disc_area(&SQUARE, [0.0, 1.0], 0.5) - PI / 8.0).abs() < 1e-12);
        assert!(disc_area(&SQUARE, [9.0, 9.0], 1.0).abs() < 1e-12);
        assert_eq!(disc_area(&SQUARE, [1.0, 1.0], 0.0), 0.0);
        // Count of midpoints of a grid of 400 x 400 over the disc's box. Its error is below the length of the boundary of
        // the shared area (less than 14) times the grid's step.
        for (center, radius) in [([1.7, 2.1], 1.3), ([3.9, 0.3], 1.0), ([2.2, 2.4], 0.9)] {
            let step = 2.0 * radius / 400.0;
            let inside = (0..160_000).filter(|k| {
                let (dx, dy) = (
                    -radius + (f64::from(k % 400) + 0.5) * step,
                    -radius + (f64::from(k / 400) + 0.5) * step,
                );
                dx * dx + dy * dy < radius * radius && contains(&ELL, [center[0] + dx, center[1] + dy])
            });
            let counted = inside.count() as f64 * step * step;
            let shared = disc_area(&ELL, center, radius);
            assert!((shared - counted).abs() < 14.0 * step, "{shared} {counted}");
            assert!((shared - disc_area(&reversed(&ELL), center, radius)).abs() < 1e-12);
        }
    }

    #[test]
    fn insets_move_edges_or_fail() {
        let inner = inset(&ELL, 0.5).unwrap();
        assert_eq!(inner, vec![[0.5, 0.5], [3.5, 0.5], [3.5, 1.5], [1.5, 1.5], [1.5, 3.5], [0.5, 3.5]]);
        assert_eq!(area(&inset(&reversed(&SQUARE), -1.0).unwrap()), 16.0);
        assert_eq!(inset(&SQUARE, 1.0), None);
        assert_eq!(inset(&SQUARE, 3.0), None);
        assert_eq!(inset(&SQUARE[..2], 0.1), None);
    }
}

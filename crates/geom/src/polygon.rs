//! Simple polygons of a plane, as the sections of solids: their checks, their direction and triangles.

use crate::error::{GeomError, bad_shape as bad};
use niwaki_math::Scalar;
use niwaki_math::polygon::twice_signed;

/// A point of the plane.
pub type Pair = [f64; 2];

/// The most points of a list.
pub const MOST: usize = 1024;

pub(crate) fn minus<S: Scalar>(a: [S; 2], b: [S; 2]) -> [S; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn dot<S: Scalar>(a: [S; 2], b: [S; 2]) -> S {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn cross<S: Scalar>(a: [S; 2], b: [S; 2]) -> S {
    a[0] * b[1] - a[1] * b[0]
}

/// Twice the area of a triangle, positive for counter-clockwise corners.
fn turn<S: Scalar>(a: [S; 2], b: [S; 2], c: [S; 2]) -> S {
    cross(minus(b, a), minus(c, b))
}

/// The corners counter-clockwise, for either direction of the list.
pub fn counter_clockwise(mut corners: Vec<Pair>) -> Vec<Pair> {
    if twice_signed(&corners) < 0.0 {
        corners.reverse();
    }
    corners
}

/// Refuses a list with fewer points than `least` or more than `most`, with a number that is not finite, and with a point twice in
/// a row. `what` begins the sentence: `polygon of an extrusion`.
///
/// # Errors
/// `bad-shape`.
pub fn check_points<const N: usize>(
    what: &str,
    points: &[[f64; N]],
    (least, most): (usize, usize),
) -> Result<(), GeomError> {
    let count = points.len();
    if !(least..=most).contains(&count) {
        return bad(format!("the {what} has {count} points, expected {least} to {most}"));
    }
    if let Some(k) = points.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        return bad(format!("point {k} of the {what} is {:?}, expected finite numbers", points[k]));
    }
    match points.windows(2).position(|pair| pair[0] == pair[1]) {
        Some(k) => bad(format!("points {k} and {} of the {what} are the same", k + 1)),
        None => Ok(()),
    }
}

/// Refuses a polygon whose boundary meets itself. Its points passed [`check_points`]; `side` names a side by the number of its first point.
///
/// # Errors
/// `bad-shape`.
pub fn check_simple<S: Scalar>(
    what: &str,
    corners: &[[S; 2]],
    side: &dyn Fn(usize) -> String,
) -> Result<(), GeomError> {
    let (n, zero) = (corners.len(), S::from_f64(0.0));
    let at = |k: usize| corners[k % n];
    for k in 0..n {
        let (a, b, c) = (at(k), at(k + 1), at(k + 2));
        if turn(a, b, c) == zero && dot(minus(b, a), minus(c, b)) < zero {
            return bad(format!("the {what} turns back on itself where {} ends", side(k)));
        }
    }
    for i in 0..n {
        // The first and the last side are neighbours.
        for j in i + 2..n - usize::from(i == 0) {
            if meet([at(i), at(i + 1)], [at(j), at(j + 1)]) {
                return bad(format!("the {what} crosses itself: {} meets {}", side(i), side(j)));
            }
        }
    }
    Ok(())
}

/// Refuses the section of a solid unless it is a simple polygon.
///
/// # Errors
/// `bad-shape`.
pub fn check_section(what: &str, corners: &[Pair], most: usize) -> Result<(), GeomError> {
    check_points(what, corners, (3, most))?;
    let last = corners.len() - 1;
    if corners[0] == corners[last] {
        return bad(format!(
            "the first and the last point of the {what} are the same; it closes without the last"
        ));
    }
    check_simple(what, corners, &|k| {
        format!("the side from point {} to point {}", k % (last + 1), (k + 1) % (last + 1))
    })
}

/// Notes in a recording what decides whether a polygon is simple, if its numbers vary.
pub fn note_simple<S: Scalar>(corners: &[[S; 2]]) {
    if corners.iter().flatten().any(|x| x.varies()) {
        let _ = check_simple("polygon", corners, &|_| String::new());
    }
}

/// True when two sides share a point.
fn meet<S: Scalar>([a, b]: [[S; 2]; 2], [c, d]: [[S; 2]; 2]) -> bool {
    let apart = |k: usize| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]);
    if apart(0) || apart(1) {
        return false;
    }
    let zero = S::from_f64(0.0);
    let one_side = |x: S, y: S| x > zero && y > zero || x < zero && y < zero;
    !one_side(turn(a, b, c), turn(a, b, d)) && !one_side(turn(c, d, a), turn(c, d, b))
}

/// True for a simple polygon without a corner that points inwards, in either direction.
pub fn is_convex(corners: &[Pair]) -> bool {
    let n = corners.len();
    let turns = (0..n).map(|k| turn(corners[k], corners[(k + 1) % n], corners[(k + 2) % n]));
    let (low, high) = turns.fold((0.0_f64, 0.0_f64), |(low, high), turn| (low.min(turn), high.max(turn)));
    low == 0.0 || high == 0.0
}

/// Triangles that fill a counter-clockwise polygon: ears are cut off, one after the other (Meisters 1975). Each side is one of exactly
/// one triangle, also for a polygon on the verge of crossing itself.
pub fn triangles(corners: &[Pair]) -> Vec<[u32; 3]> {
    let mut rest: Vec<usize> = (0..corners.len()).collect();
    let mut faces = Vec::with_capacity(corners.len().saturating_sub(2));
    let mut k = 0;
    while rest.len() > 3 {
        let n = rest.len();
        let ear = |k: usize| {
            let [a, b, c] = [rest[(k + n - 1) % n], rest[k % n], rest[(k + 1) % n]].map(|i| corners[i]);
            let holds = |p: Pair| {
                p != a
                    && p != b
                    && p != c
                    && turn(a, b, p) >= 0.0
                    && turn(b, c, p) >= 0.0
                    && turn(c, a, p) >= 0.0
            };
            turn(a, b, c) > 0.0 && !rest.iter().any(|i| holds(corners[*i]))
        };
        // Rounding may hide every ear: then the sharpest corner goes.
        let at = (k..k + n).find(|k| ear(*k)).unwrap_or(k) % n;
        faces.push([rest[(at + n - 1) % n], rest[at], rest[(at + 1) % n]].map(|i| i as u32));
        rest.remove(at);
        // The next ear is looked for beyond the neighbour, so that triangles do not all share a corner.
        k = at + 1;
    }
    faces.extend(<[usize; 3]>::try_from(rest).ok().map(|last| last.map(|i| i as u32)));
    faces
}

#[cfg(test)]
mod tests {
    //! Ears fill concave polygons, in either direction and with points within sides; what meets itself is refused.
    use super::*;
    use niwaki_math::polygon::area;

    /// A star, a comb, a spiral, a square with points within its sides, and a polygon with a needle.
    fn polygons() -> Vec<Vec<Pair>> {
        let star = (0..10).map(|k| {
            let (sin, cos) = (0.3 + 0.2 * std::f64::consts::PI * f64::from(k)).sin_cos();
            let radius = if k % 2 == 0 { 2.0 } else { 0.5 };
            [radius * cos, radius * sin]
        });
        let comb = (0..8).flat_map(|k| [[f64::from(k), 3.0], [f64::from(k) + 0.5, 0.1]]);
        let spiral = vec![
            [0.0, 0.0],
            [5.0, 0.0],
            [5.0, 5.0],
            [1.0, 5.0],
            [1.0, 2.0],
            [3.0, 2.0],
            [3.0, 3.0],
            [2.0, 3.0],
        ];
        let spiral = [&spiral[..], &[[2.0, 4.0], [4.0, 4.0], [4.0, 1.0], [0.0, 1.0]]].concat();
        let square: Vec<Pair> = (0..8)
            .map(|k| {
                [
                    [0.0, 0.0],
                    [1.0, 0.0],
                    [2.0, 0.0],
                    [2.0, 1.0],
                    [2.0, 2.0],
                    [1.0, 2.0],
                    [0.0, 2.0],
                    [0.0, 1.0],
                ][k]
            })
            .collect();
        let needle =
            vec![[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.0], [2.0, 1e-9], [1.9, 2.0], [0.0, 2.0]];
        vec![star.collect(), comb.chain([[8.0, 4.0], [-1.0, 4.0]]).collect(), spiral, square, needle]
    }

    #[test]
    fn ears_fill_a_polygon_of_either_direction() {
        for corners in polygons() {
            check_simple("polygon", &corners, &|k| format!("side {k}")).unwrap();
            let forth = counter_clockwise(corners.clone());
            let back = counter_clockwise(corners.into_iter().rev().collect());
            assert_eq!(forth, back);
            assert_eq!(is_convex(&forth), forth.len() == 8, "only the square is");
            let faces = triangles(&forth);
            assert_eq!(faces.len(), forth.len() - 2);
            let areas: Vec<f64> = faces
                .iter()
                .map(|f| f.map(|i| forth[i as usize]))
                .map(|[a, b, c]| 0.5 * turn(a, b, c))
                .collect();
            assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
            assert!((areas.iter().sum::<f64>() / area(&forth) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_polygon_that_meets_itself_is_refused() {
        let error = |corners: &[Pair]| {
            check_points("polygon", corners, (3, MOST))
                .and_then(|()| check_simple("polygon", corners, &|k| format!("side {k}")))
                .map_or_else(|error| error.message, |()| String::new())
        };
        for (corners, expected) in [
            (&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]][..], "crosses itself: side 0 meets side 2"),
            (
                &[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]],
                "crosses itself: side 0 meets side 2",
            ),
            (&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], "turns back on itself where side 1 ends"),
            (&[[0.0, 0.0], [1.0, 0.0]], "has 2 points, expected 3 to 1024"),
            (&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]], "points 1 and 2 of the polygon are the same"),
            (&[[0.0, 0.0], [1.0, f64::NAN], [0.0, 1.0]], "point 1 of the polygon is [1.0, NaN]"),
        ] {
            assert!(error(corners).contains(expected), "{}", error(corners));
        }
    }
}

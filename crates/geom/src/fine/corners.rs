//! Polygons with rounded corners: the outlines of prisms and of solids of revolution.

use super::crease::SHARP;
use crate::polygon::{Pair, cross, dot, minus};
use niwaki_math::polygon::inset;
use std::f64::consts::FRAC_PI_2;

fn unit(a: Pair) -> Pair {
    let length = a[0].hypot(a[1]);
    a.map(|x| x / length)
}

/// A vertex of a rounded polygon: it lies at `core + out * reach`, where the reach is the width of the rounding on the boundary, and
/// zero on the polygon that is moved inwards by this width.
#[derive(Clone, Copy, Debug)]
pub struct Rounded {
    /// The corner that it belongs to.
    pub corner: usize,
    /// Its place on the inner polygon.
    pub core: Pair,
    /// Its way out, for a reach of 1.
    pub out: Pair,
    /// The outward normal.
    pub normal: Pair,
}

/// The largest width by which the sides of a counter-clockwise polygon can move inwards and stay apart, about.
pub fn room(corners: &[Pair]) -> f64 {
    let n = corners.len();
    let at = |k: usize| corners[k % n];
    let along: Vec<Pair> = (0..n).map(|k| unit(minus(at(k + 1), at(k)))).collect();
    // Tangent of half the turn at the start of each side.
    let half: Vec<f64> = (0..n)
        .map(|k| {
            let (a, b) = (along[(k + n - 1) % n], along[k]);
            (0.5 * cross(a, b).atan2(dot(a, b))).tan()
        })
        .collect();
    let mut room = f64::INFINITY;
    for i in 0..n {
        let side = minus(at(i + 1), at(i));
        let lost = half[i] + half[(i + 1) % n];
        if lost > 0.0 {
            room = room.min(side[0].hypot(side[1]) / lost);
        }
        for j in i + 2..n - usize::from(i == 0) {
            // Sides that face each other, by more than 60 degrees.
            if dot(along[i], along[j]) < 0.5 {
                room = room.min(0.5 * distance([at(i), at(i + 1)], [at(j), at(j + 1)]));
            }
        }
    }
    room
}

/// Distance of two segments that do not cross.
fn distance(s: [Pair; 2], t: [Pair; 2]) -> f64 {
    let to = |p: Pair, [a, b]: [Pair; 2]| {
        let (side, from) = (minus(b, a), minus(p, a));
        let share = (dot(from, side) / dot(side, side)).clamp(0.0, 1.0);
        (from[0] - side[0] * share).hypot(from[1] - side[1] * share)
    };
    to(s[0], t).min(to(s[1], t)).min(to(t[0], s)).min(to(t[1], s))
}

/// The vertices of a counter-clockwise polygon, in order: sharp corners that stick out become arcs of `width`, of `arc` steps for a
/// quarter turn; gentle corners are one vertex with a normal between those of the sides, other corners two. Corners that are not `round`
/// keep their place and the normals of their sides.
pub fn rounded(corners: &[Pair], width: f64, arc: usize, round: &dyn Fn(usize) -> bool) -> Vec<Rounded> {
    let n = corners.len();
    let along = |k: usize| unit(minus(corners[(k + 1) % n], corners[k % n]));
    let inner = (width > 0.0).then(|| inset(corners, width)).flatten();
    let width = if inner.is_some() { width } else { 0.0 };
    let inner = inner.unwrap_or_else(|| corners.to_vec());
    let mut vertices = Vec::new();
    for corner in 0..n {
        let (before, after) = (along(corner + n - 1), along(corner));
        let (sin, cos) = (cross(before, after), dot(before, after));
        let outward = |along: Pair| [along[1], -along[0]];
        let is_round = round(corner);
        let core = if is_round { inner[corner] } else { corners[corner] };
        // Where the corner itself is, seen from the inner polygon.
        let out =
            if is_round && width > 0.0 { minus(corners[corner], core).map(|x| x / width) } else { [0.0; 2] };
        let mut push = |out: Pair, normal: Pair| vertices.push(Rounded { corner, core, out, normal });
        if cos >= SHARP {
            push(out, unit([before[1] + after[1], -before[0] - after[0]]));
        } else if sin <= 0.0 || width == 0.0 || !is_round {
            push(out, outward(before));
            push(out, outward(after));
        } else {
            let turn = sin.atan2(cos);
            let steps = ((turn / FRAC_PI_2 * arc as f64).ceil() as usize).max(1);
            for k in 0..=steps {
                let (sin, cos) = (turn * k as f64 / steps as f64).sin_cos();
                let [x, y] = outward(before);
                let normal = if k == steps { outward(after) } else { [x * cos - y * sin, x * sin + y * cos] };
                push(normal, normal);
            }
        }
    }
    vertices
}

#[cfg(test)]
mod tests {
    //! Rounded corners are arcs about the inner polygon.
    use super::*;

    #[test]
    fn rounded_corners_lie_on_their_arcs() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        assert!((room(&square) - 1.0).abs() < 1e-12);
        let vertices = rounded(&square, 0.5, 4, &|_| true);
        assert_eq!(vertices.len(), 20);
        for v in &vertices {
            assert!((v.out[0].hypot(v.out[1]) - 1.0).abs() < 1e-12 && v.out == v.normal);
            assert!(v.core.iter().all(|x| (x - 1.0).abs() == 0.5));
        }
        // A corner that points inwards stays sharp.
        let hook = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [2.0, 3.0], [2.0, 1.0], [0.0, 1.0]];
        let inner = rounded(&hook, 0.1, 4, &|_| true).into_iter().filter(|v| v.corner == 4);
        assert!(
            inner
                .map(|v| [v.core[0] + 0.1 * v.out[0], v.core[1] + 0.1 * v.out[1]])
                .all(|p| { (p[0] - 2.0).abs() < 1e-12 && (p[1] - 1.0).abs() < 1e-12 })
        );
        assert!((room(&hook) - 0.5).abs() < 1e-12);
    }
}

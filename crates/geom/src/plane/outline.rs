//! The interval of a shape between two heights of the plane. Drawings need nothing else of a shape.
//!
//! An outline is one convex piece of a shape seen along z: the hull of two circles, an ellipse, or a polygon. Between
//! two heights each has one interval of x, in closed form, with square roots and no angles: the same bits everywhere.

use crate::solids::shape::Shape;
use crate::solids::{Ellipse, Solid, Stroke};

/// A point of the plane, scene units.
type Point = [f64; 2];

/// A convex piece of the plane.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// The convex hull of two circles: their middles and radii, and the corners of the straight part, if any.
    Stroke([(Point, f64); 2], Option<[Point; 4]>),
    /// The points `p` around the middle with `a x^2 + 2 b x y + c y^2 <= 1`.
    Ellipse(Point, [f64; 3]),
    /// A triangle of a solid's mesh.
    Triangle([Point; 3]),
}

impl Outline {
    /// Calls `each` with the pieces of `shape`.
    pub fn of(shape: &Shape, mut each: impl FnMut(Outline)) {
        let placement = shape.placement();
        match shape.solid() {
            Solid::Stroke(Stroke { ends }) => {
                let ends = [&ends[0], &ends[1]].map(|end| {
                    let center = placement.apply(end.center);
                    ([center.x, center.y], end.radius)
                });
                each(Outline::Stroke(ends, straight(ends)));
            }
            Solid::Ellipse(Ellipse { size: [long, wide] }) => {
                let axis = placement.rotation.columns[0];
                let (p, q) = (4.0 / (long * long), 4.0 / (wide * wide));
                let (cos, sin) = (axis.x, axis.y);
                let form =
                    [p * cos * cos + q * sin * sin, (p - q) * cos * sin, p * sin * sin + q * cos * cos];
                let center = placement.translation;
                each(Outline::Ellipse([center.x, center.y], form));
            }
            _ => {
                for triangle in shape.world_mesh().corners() {
                    each(Outline::Triangle(triangle.map(|p| [p.x, p.y])));
                }
            }
        }
    }

    /// The interval of x in which the piece has points with a y from `low` to `high`; `None` when there are none.
    #[inline]
    pub fn across(&self, low: f64, high: f64) -> Option<Interval> {
        match self {
            Outline::Stroke([a, b], straight) => {
                let ends = join(disc(a, low, high), disc(b, low, high));
                straight.as_ref().map_or(ends, |four| join(ends, polygon(four, low, high)))
            }
            Outline::Ellipse(center, form) => ellipse(*center, *form, low, high),
            Outline::Triangle(three) => polygon(three, low, high),
        }
    }

    /// Smallest and largest y.
    #[inline]
    pub fn heights(&self) -> Interval {
        match self {
            Outline::Stroke([(a, r), (b, s)], _) => ((a[1] - r).min(b[1] - s), (a[1] + r).max(b[1] + s)),
            Outline::Ellipse(center, [a, b, c]) => {
                let half = (a / (a * c - b * b)).sqrt();
                (center[1] - half, center[1] + half)
            }
            Outline::Triangle([a, b, c]) => (a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1])),
        }
    }
}

/// The interval from the smallest to the largest number.
type Interval = (f64, f64);

/// The smallest interval around two intervals.
#[inline]
fn join(a: Option<Interval>, b: Option<Interval>) -> Option<Interval> {
    match (a, b) {
        (Some(a), Some(b)) => Some((a.0.min(b.0), a.1.max(b.1))),
        (a, b) => a.or(b),
    }
}

/// Corners of the straight part of a stroke; `None` where one circle holds the other.
fn straight([(a, r), (b, s)]: [(Point, f64); 2]) -> Option<[Point; 4]> {
    let along = [b[0] - a[0], b[1] - a[1]];
    let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
    if length <= (r - s).abs() {
        return None;
    }
    // The sides touch the circles where their unit normals have `lean` along the stroke and `rest` across it.
    let lean = (r - s) / length;
    let rest = (1.0 - lean * lean).sqrt();
    let u = [along[0] / length, along[1] / length];
    let left = [lean * u[0] - rest * u[1], lean * u[1] + rest * u[0]];
    let right = [lean * u[0] + rest * u[1], lean * u[1] - rest * u[0]];
    let at = |p: Point, by: f64, n: Point| [p[0] + by * n[0], p[1] + by * n[1]];
    Some([at(a, r, right), at(b, s, right), at(b, s, left), at(a, r, left)])
}

#[inline]
fn disc((center, radius): &(Point, f64), low: f64, high: f64) -> Option<Interval> {
    let away = center[1].clamp(low, high) - center[1];
    let square = radius * radius - away * away;
    (square > 0.0).then(|| {
        let half = square.sqrt();
        (center[0] - half, center[0] + half)
    })
}

/// With `x = (-b y +- sqrt(a - (a c - b^2) y^2)) / a`: the right border is largest at one height, the left at its
/// opposite, and each falls off on both sides of it.
#[inline]
fn ellipse(center: Point, [a, b, c]: [f64; 3], low: f64, high: f64) -> Option<Interval> {
    let det = a * c - b * b;
    let top = (a / det).sqrt();
    let (low, high) = ((low - center[1]).max(-top), (high - center[1]).min(top));
    if low > high {
        return None;
    }
    let widest = -b / (c * det).sqrt();
    let border = |y: f64| (a - det * y * y).max(0.0).sqrt();
    let (right, left) = (widest.clamp(low, high), (-widest).clamp(low, high));
    Some((center[0] + (-b * left - border(left)) / a, center[0] + (-b * right + border(right)) / a))
}

#[inline]
fn polygon(corners: &[Point], low: f64, high: f64) -> Option<Interval> {
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut p = corners[corners.len() - 1];
    for &q in corners {
        let (under, over) = if p[1] <= q[1] { (p, q) } else { (q, p) };
        if over[1] >= low && under[1] <= high {
            let slope = (over[0] - under[0]) / (over[1] - under[1]);
            // A point inside of the strip counts itself: a level side has no slope.
            let first = if under[1] >= low { under[0] } else { under[0] + (low - under[1]) * slope };
            let last = if over[1] <= high { over[0] } else { under[0] + (high - under[1]) * slope };
            least = least.min(first).min(last);
            most = most.max(first).max(last);
        }
        p = q;
    }
    (least <= most).then_some((least, most))
}

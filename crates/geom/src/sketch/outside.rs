//! The reach of a drawing out of its window.
//!
//! ```text
//! log score = -(ex^2 + ey^2) / 0.001^2
//! ex, ey    = lengths outside of the window on both sides / its extent, along x and y
//! ```
//!
//! Dissertation 6.5.3: it keeps a circuit inside of its die; the original's code has it in the shape program too. A stroke
//! counts by its axis without its width, any other shape by its box. differs: the box of an ellipse is exact (the original
//! turns one of its corners twice).
//!
//! Nearly all shapes are inside. So only the shapes outside are kept, sorted: equal drawings are equal data.

use crate::bounds::Aabb;
use crate::plane::Page;
use crate::solids::shape::Shape;
use crate::solids::{Solid, Stroke};

/// The share of the window that lowers the log score by 1.
const SCALE: f64 = 0.001;

/// Lengths outside on the left, the right, below and above, of the shapes that are outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outside(Vec<[f64; 4]>);

/// Lengths outside of a page; `None` for a shape inside.
fn lengths(shape: &Shape, page: &Page) -> Option<[f64; 4]> {
    let reach = match shape.solid() {
        Solid::Stroke(Stroke { ends }) => {
            Aabb::around(ends.iter().map(|end| shape.placement().apply(end.center)))
        }
        _ => *shape.aabb(),
    };
    let (low, high) = (page.low(), page.high());
    let out = [low[0] - reach.low.x, reach.high.x - high[0], low[1] - reach.low.y, reach.high.y - high[1]];
    let out = out.map(|length| length.max(0.0));
    (out != [0.0; 4]).then_some(out)
}

fn order(a: &[f64; 4], b: &[f64; 4]) -> std::cmp::Ordering {
    a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal)
}

impl Outside {
    /// Adds a shape.
    pub fn add(&mut self, shape: &Shape, page: &Page) {
        if let Some(out) = lengths(shape, page) {
            let at = self.0.partition_point(|other| order(other, &out).is_lt());
            self.0.insert(at, out);
        }
    }

    /// Removes a shape that was added.
    pub fn remove(&mut self, shape: &Shape, page: &Page) {
        if let Some(out) = lengths(shape, page)
            && let Some(at) = self.0.iter().position(|other| *other == out)
        {
            self.0.remove(at);
        }
    }

    /// `ex` and `ey`.
    pub fn shares(&self, page: &Page) -> [f64; 2] {
        let most = |side: usize| self.0.iter().map(|out| out[side]).fold(0.0, f64::max);
        let (low, high) = (page.low(), page.high());
        [(most(0) + most(1)) / (high[0] - low[0]), (most(2) + most(3)) / (high[1] - low[1])]
    }

    /// Nats, zero or less.
    pub fn log_score(&self, page: &Page) -> f64 {
        if self.0.is_empty() {
            return 0.0;
        }
        let [x, y] = self.shares(page).map(|share| share / SCALE);
        -(x * x + y * y)
    }
}

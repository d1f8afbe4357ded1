//! Frames in which calls are placed, and shapes in them: what the word `place` becomes.
//!
//! A frame is a point and a matrix, `p -> m p + t`. The matrix is a rotation, or a rotation after a reflection. Frames and
//! shapes are computed by [`Scalar`], so a recording has the places of shapes in frames that vary.

use super::answer::{Answer, unfit};
use super::shapes::each_shape;
use super::vectors::{length, parts, three};
use crate::fault::Fault;
use crate::value::{Scalar, Value};
use niwaki_geom::{Mat3, Placement, Shape, Vec3};

/// The kinds of frames that `place` takes.
const EXPECTED: &str = "a point, a rotation, a pair of both, or a `Frame`";

/// The largest deviation of a frame's directions from length 1 and right angles.
const SKEW: f64 = 1e-6;

/// A frame: its origin, and its matrix row by row.
struct Placing<S> {
    origin: [S; 3],
    rows: [[S; 3]; 3],
}

fn number<S: Scalar>(x: f64) -> S {
    S::from_f64(x)
}

fn product<S: Scalar>(v: [S; 3], w: [S; 3]) -> S {
    v[0] * w[0] + v[1] * w[1] + v[2] * w[2]
}

impl<S: Scalar> Placing<S> {
    fn unit() -> [[S; 3]; 3] {
        Vec3::AXES.map(|axis| axis.to_array().map(number))
    }

    fn turn(&self, v: [S; 3]) -> [S; 3] {
        self.rows.map(|row| product(row, v))
    }

    fn apply(&self, p: [S; 3]) -> [S; 3] {
        let turned = self.turn(p);
        [0, 1, 2].map(|k| turned[k] + self.origin[k])
    }

    /// The frame `inner` in this frame.
    fn after(&self, inner: &Placing<S>) -> Placing<S> {
        let column = |j: usize| inner.rows.map(|row| row[j]);
        let rows = self.rows.map(|row| [0, 1, 2].map(|j| product(row, column(j))));
        Placing { origin: self.apply(inner.origin), rows }
    }

    fn value(&self) -> Value<S> {
        let rows = self.rows.concat().try_into().expect("three rows of three");
        Value::tuple(vec![Value::vector(&self.origin), Value::Rotation(std::sync::Arc::new(rows))])
    }

    /// The frame of a value that [`Placing::value`] made.
    fn of(value: &Value<S>) -> Result<Placing<S>, Fault> {
        match value {
            Value::Tuple(pair) => match pair.items() {
                [origin, Value::Rotation(r)] => Ok(Placing { origin: point(origin)?, rows: rows(r) }),
                _ => Err(unfit("place", EXPECTED, value)),
            },
            _ => Err(unfit("place", EXPECTED, value)),
        }
    }

    /// The frame that a model gives.
    fn given(value: &Value<S>) -> Result<Placing<S>, Fault> {
        let no_move = [number(0.0); 3];
        match value {
            Value::Rotation(r) => Ok(Placing { origin: no_move, rows: rows(r) }),
            Value::Tuple(pair) if matches!(pair.items(), [_, Value::Rotation(_)]) => Placing::of(value),
            Value::Record(record) if record.class.is_frame() => Placing::looking(&record.fields),
            Value::Tuple(fields) if fields.items().len() == 4 => Placing::looking(fields.items()),
            Value::Vector(_) | Value::Tuple(_) | Value::List(_) => {
                Ok(Placing { origin: point(value)?, rows: Placing::unit() })
            }
            _ => Err(unfit("place", EXPECTED, value)),
        }
    }

    /// The frame of a place to look from, by its fields: center, forward, up, radius.
    fn looking(fields: &[Value<S>]) -> Result<Placing<S>, Fault> {
        let [forward, up] = [three("place", &fields[1])?, three("place", &fields[2])?];
        // The axes of the frame are its columns: x to the left, y up, z forward.
        let across = [0, 1, 2].map(|k: usize| {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            up[a] * forward[b] - up[b] * forward[a]
        });
        let skew = [length(&forward), length(&up), length(&across)].map(|l| (l.value() - 1.0).abs());
        if !skew.iter().all(|skew| *skew <= SKEW) {
            let message = "`place`: `forward` and `up` of a frame have the length 1 and are at right angles, as those of `look`";
            return Err(Fault::bad_argument(message));
        }
        let rows = [0, 1, 2].map(|k| [across[k], up[k], forward[k]]);
        Ok(Placing { origin: point(&fields[0])?, rows })
    }

    fn plain(&self) -> Placement {
        let rotation = Mat3::from_rows(self.rows.map(|row| row.map(Scalar::value)));
        Placement { rotation, translation: Vec3::from(self.origin.map(Scalar::value)) }
    }

    /// Places one shape; the solids of a cut have positions of their own.
    fn shape(&self, shape: &Shape) -> Result<Shape, Fault> {
        let placed = shape.in_frame(&self.plain()).map_err(|error| Fault::bad_shape(error.message))?;
        for (before, after) in shape.leaves().iter().zip(placed.leaves()) {
            S::note(after.address(), || self.position(before));
        }
        Ok(placed)
    }

    /// The numbers of a shape's position after the frame: a point and directions.
    fn position(&self, shape: &Shape) -> Vec<S> {
        let mut noted = S::noted(shape.address());
        if noted.is_empty() {
            // A shape that does not vary, in a frame that may.
            let Placement { rotation, translation } = shape.placement();
            let points = std::iter::once(translation).chain(rotation.columns);
            noted = points.flat_map(|p| p.to_array().map(number)).collect();
        }
        let mut vectors = noted.chunks_exact(3).map(|v| [v[0], v[1], v[2]]);
        let middle = vectors.next().map(|middle| self.apply(middle));
        middle.into_iter().chain(vectors.map(|v| self.turn(v))).flatten().collect()
    }
}

/// The frame of a value of [`frame_in`], in plain numbers; `None` for any other value.
pub fn placement<S: Scalar>(value: &Value<S>) -> Option<Placement> {
    if !matches!(value, Value::Tuple(_)) {
        return None;
    }
    Placing::of(value).ok().map(|frame| frame.plain())
}

fn rows<S: Scalar>(r: &[S; 9]) -> [[S; 3]; 3] {
    [[r[0], r[1], r[2]], [r[3], r[4], r[5]], [r[6], r[7], r[8]]]
}

/// A point; in the plane its z is 0.
fn point<S: Scalar>(value: &Value<S>) -> Result<[S; 3], Fault> {
    let read = parts("place", value).map_err(|_| unfit("place", EXPECTED, value))?;
    match *read.components() {
        [x, y] => Ok([x, y, number(0.0)]),
        [x, y, z] => Ok([x, y, z]),
        _ => Err(unfit("place", EXPECTED, value)),
    }
}

/// `frame_in(outer, frame)`: the frame that a model gives, inside of the frame of the caller, which may be `None`.
pub fn frame_in<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    if matches!(args[1], Value::None) {
        return Ok(args[0].clone());
    }
    let inner = Placing::given(&args[1])?;
    Ok(match &args[0] {
        Value::None => inner.value(),
        outer => Placing::of(outer)?.after(&inner).value(),
    })
}

/// `placed(frame, shapes)`: shapes, also in lists and tuples, in a frame or in `None`.
pub fn placed<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    match &args[0] {
        Value::None => Ok(args[1].clone()),
        frame => {
            let frame = Placing::of(frame)?;
            each_shape(&args[1], |shape| {
                frame.shape(shape).map_err(|fault| fault.of_call("place", &args[..1]))
            })
        }
    }
}

/// `reflection(axis)`: the frame that reflects at the plane through the origin across `axis`, "x", "y", "z" or a direction.
pub fn reflection<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let axis: [S; 3] = match &args[0] {
        Value::Str(text) => match ["x", "y", "z"].iter().position(|letter| *letter == &**text) {
            Some(at) => Vec3::AXES[at].to_array().map(number),
            None => return Err(unfit_axis(&args[0])),
        },
        direction => three("mirrored", direction).map_err(|_| unfit_axis(&args[0]))?,
    };
    let square = product(axis, axis);
    if square.value() == 0.0 {
        return Err(Fault::bad_argument("`mirrored`: the axis has the length 0"));
    }
    let unit = Placing::<S>::unit();
    let entry = |i: usize, j: usize| unit[i][j] - number::<S>(2.0) * axis[i] * axis[j] / square;
    let matrix = [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)));
    Ok(Placing { origin: [number(0.0); 3], rows: matrix }.value())
}

fn unfit_axis<S: Scalar>(value: &Value<S>) -> Fault {
    unfit("mirrored", "\"x\", \"y\", \"z\" or a direction as its axis", value)
}

#[cfg(test)]
mod tests {
    use crate::builtins::tests::{V, call, code, reals};
    use niwaki_geom::{Shape, vec3};

    fn shape_of(value: &V) -> Shape {
        match value {
            V::Shape(shape) => shape.clone(),
            V::Tuple(items) => shape_of(&items.items()[0]),
            other => panic!("{other:?}"),
        }
    }

    fn quarter() -> V {
        call("rotation", &[reals([0.0, 1.0, 0.0]), V::real(std::f64::consts::FRAC_PI_2)]).expect("a rotation")
    }

    fn placed(frame: &V, shape: &V) -> Shape {
        let frame = call("frame_in", &[V::None, frame.clone()]).expect("a frame");
        shape_of(&call("placed", &[frame, V::tuple(vec![shape.clone()])]).expect("a shape"))
    }

    fn plank() -> V {
        call("box", &[reals([2.0, 0.0, 0.0]), reals([4.0, 1.0, 2.0])]).expect("a box")
    }

    #[test]
    fn shapes_go_into_frames() {
        assert_eq!(placed(&reals([0.0, 5.0, 1.0]), &plank()).aabb().low, vec3(0.0, 4.5, 0.0));
        let turned = placed(&V::tuple(vec![reals([0.0, 5.0, 1.0]), quarter()]), &plank());
        // A quarter turn about y takes x to -z.
        assert!((turned.aabb().low - vec3(-1.0, 4.5, -3.0)).norm() < 1e-12, "{:?}", turned.aabb());
        let look =
            V::tuple(vec![reals([1.0, 0.0, 0.0]), reals([1.0, 0.0, 0.0]), reals([0.0, 1.0, 0.0]), V::Int(1)]);
        // z is forward, so x points to -z.
        assert!((placed(&look, &plank()).aabb().low - vec3(0.0, -0.5, -4.0)).norm() < 1e-12);
    }

    #[test]
    fn frames_compose_from_the_inside() {
        let outer = call("frame_in", &[V::None, quarter()]).expect("a frame");
        let inner = call("frame_in", &[outer, reals([1.0, 0.0, 0.0])]).expect("a frame");
        let moved = shape_of(&call("placed", &[inner, plank()]).expect("a shape"));
        assert!((moved.aabb().low - vec3(-1.0, -0.5, -5.0)).norm() < 1e-12, "{:?}", moved.aabb());
    }

    #[test]
    fn a_reflection_is_exact_and_its_own_inverse() {
        let mirror = call("reflection", &[V::str("x")]).expect("a frame");
        let once = placed(&mirror, &plank());
        assert_eq!((once.aabb().low, once.is_aligned_box()), (vec3(-4.0, -0.5, -1.0), true));
        assert_eq!(placed(&mirror, &V::Shape(once)), shape_of(&plank()));
    }

    #[test]
    fn other_values_are_no_frames() {
        for wrong in [V::Int(1), V::str("x"), reals([1.0]), V::tuple(vec![V::Int(1), quarter()])] {
            assert_eq!(code("frame_in", &[V::None, wrong]), "type-mismatch");
        }
        let skew = V::tuple(vec![reals([0.0; 3]), reals([1.0, 0.0, 0.0]), reals([0.6, 0.8, 0.0]), V::Int(1)]);
        assert_eq!(code("frame_in", &[V::None, skew]), "bad-argument");
        assert_eq!(code("reflection", &[V::str("w")]), "type-mismatch");
        assert_eq!(code("reflection", &[reals([0.0; 3])]), "bad-argument");
    }
}

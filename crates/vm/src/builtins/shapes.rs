//! Shapes from values: the words of [`WORDS`]. Models and plain Python runs both use this file.
//!
//! A scene is made of plain numbers: a recording scalar gives only its value here. Where the shape is it may note
//! ([`Scalar::note`]): its middle, and three directions, of which some may be zero. A point that is fixed to the shape
//! is the middle and a sum of these.

use std::any::Any;
use std::cell::RefCell;
use std::sync::Arc;

use niwaki_geom::{Bark, Frame, GeomError, Look, Mat3, Shape, TriMesh, Vec3, vec3};

use super::answer::{Answer, unfit};
use super::arithmetic::{real, whole};
use super::vectors::three;
use crate::fault::Fault;
use crate::value::index::{iter_all, iter_get, iter_len};
use crate::value::{Scalar, Value, same};

/// The words that make shapes, and their parameters in order; those of `niwaki.words` are the same.
pub const WORDS: &[(&str, &[&str])] = &[
    (
        "box",
        &["center", "size", "rotation", "taper", "taper_axis", "bevel", "color", "metalness", "roughness"],
    ),
    (
        "cylinder",
        &[
            "center",
            "radius",
            "length",
            "axis",
            "top_radius",
            "rotation",
            "bevel",
            "color",
            "metalness",
            "roughness",
        ],
    ),
    (
        "limb",
        &[
            "start",
            "end",
            "start_radius",
            "end_radius",
            "start_normal",
            "end_normal",
            "color",
            "metalness",
            "roughness",
        ],
    ),
    ("segment", &["start", "split", "end", "onto", "color", "metalness", "roughness"]),
    ("mesh", &["vertices", "faces", "center", "rotation", "scale", "color", "metalness", "roughness"]),
    ("stroke", &["start", "end", "width", "end_width", "color"]),
    ("ellipse", &["center", "length", "width", "angle", "color"]),
    ("disc", &["center", "radius", "color"]),
];

/// One word's arguments; those left out are `None`.
struct Arguments<'a, S: Scalar> {
    word: &'static str,
    args: &'a [Value<S>],
}

impl<S: Scalar> Arguments<'_, S> {
    fn given(&self, at: usize) -> Option<&Value<S>> {
        self.args.get(at).filter(|arg| !matches!(arg, Value::None))
    }

    fn needed(&self, at: usize) -> Result<&Value<S>, Fault> {
        self.given(at).ok_or_else(|| {
            Fault::bad_argument(format!("argument {} of `{}` cannot be None", at + 1, self.word))
        })
    }

    /// Reads an argument, or a part of one; what is wrong with it names the parameter.
    fn read<T>(
        &self,
        at: usize,
        value: &Value<S>,
        read: impl FnOnce(&str, &Value<S>) -> Result<T, Fault>,
    ) -> Result<T, Fault> {
        read(self.word, value).map_err(|fault| self.named(at, &fault))
    }

    #[cold]
    fn named(&self, at: usize, fault: &Fault) -> Fault {
        let parameters = WORDS.iter().find(|(word, _)| *word == self.word).map(|(_, parameters)| *parameters);
        let name = parameters.and_then(|names| names.get(at)).copied().unwrap_or("an argument");
        let (word, named) = (format!("`{}`", self.word), format!("`{name}` of `{}`", self.word));
        Fault::new(fault.code, fault.message.replacen(&word, &named, 1))
    }

    fn number_or(&self, at: usize, default: f64) -> Result<f64, Fault> {
        self.given(at).map_or(Ok(default), |arg| self.read(at, arg, real).map(Scalar::value))
    }

    /// A length, a width or a factor of them.
    fn measure(&self, at: usize) -> Result<f64, Fault> {
        self.read(at, self.needed(at)?, measured)
    }

    fn measure_or(&self, at: usize, default: f64) -> Result<f64, Fault> {
        self.given(at).map_or(Ok(default), |arg| self.read(at, arg, measured))
    }

    /// Three lengths.
    fn measures(&self, at: usize) -> Result<Vec3, Fault> {
        self.triple(at).map(|[x, y, z]| vec3(signed(x), signed(y), signed(z)))
    }

    fn point(&self, at: usize) -> Result<Vec3, Fault> {
        self.read(at, self.needed(at)?, point)
    }

    fn direction(&self, at: usize) -> Result<Option<Vec3>, Fault> {
        self.given(at).map(|arg| self.read(at, arg, point)).transpose()
    }

    /// The parts of a tuple, list or record of `count`.
    fn several(&self, at: usize, count: usize, expected: &str) -> Result<Vec<Value<S>>, Fault> {
        let arg = self.needed(at)?;
        let several = matches!(arg, Value::Tuple(_) | Value::List(_) | Value::Record(_));
        if !several || iter_len(arg)? != count {
            return Err(self.named(at, &unfit(self.word, expected, arg)));
        }
        iter_all(arg)
    }

    fn frame(&self, at: usize) -> Result<Frame, Fault> {
        let parts = self.several(at, 4, "a frame (center, forward, up, radius)")?;
        let [center, forward, up, radius] = &parts[..] else { unreachable!("counted above") };
        let place = |value| self.read(at, value, point);
        let radius = self.read(at, radius, measured)?;
        Ok(Frame { center: place(center)?, forward: place(forward)?, up: place(up)?, radius })
    }

    fn rotation(&self, at: usize) -> Result<Option<Mat3>, Fault> {
        let rows = self.rows(at)?;
        Ok(rows.map(|rows| Mat3::from_rows(rows.map(|row| row.map(Scalar::value)))))
    }

    /// The rows of a rotation.
    fn rows(&self, at: usize) -> Result<Option<[[S; 3]; 3]>, Fault> {
        let Some(arg) = self.given(at) else { return Ok(None) };
        if let Value::Rotation(r) = arg {
            return Ok(Some([[r[0], r[1], r[2]], [r[3], r[4], r[5]], [r[6], r[7], r[8]]]));
        }
        let rows = matches!(arg, Value::Tuple(_) | Value::List(_)) && iter_len(arg)? == 3;
        if !rows {
            return Err(self.named(at, &unfit(self.word, "a rotation such as `rotation(axis, angle)`", arg)));
        }
        let row = |row: usize| self.read(at, &iter_get(arg, row), three);
        Ok(Some([row(0)?, row(1)?, row(2)?]))
    }

    /// The same, with the rows of no turn where it is left out.
    fn turn(&self, at: usize) -> Result<[[S; 3]; 3], Fault> {
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Ok(self.rows(at)?.unwrap_or_else(|| unit.map(|row| row.map(S::from_f64))))
    }

    fn triple(&self, at: usize) -> Result<[S; 3], Fault> {
        self.read(at, self.needed(at)?, three)
    }

    fn scalar(&self, at: usize) -> Result<S, Fault> {
        self.read(at, self.needed(at)?, real)
    }

    /// The look; of solids, metalness and roughness come after the colour.
    fn look(&self, rotation: Option<usize>, bevel: Option<usize>, first: usize) -> Result<Look, Fault> {
        let rotation = rotation.map_or(Ok(None), |at| self.rotation(at))?;
        let bevel = match bevel {
            Some(at) => self.given(at).map(|arg| self.read(at, arg, measured)).transpose()?,
            None => None,
        };
        let color = self.given(first).map(|arg| self.read(first, arg, three)).transpose()?;
        let color = color.map(|color| color.map(|part| part.value() as f32));
        let share = |at: usize| {
            let read = |arg| {
                let share = self.read(at, arg, real)?;
                let _ = share > S::from_f64(1.0);
                Ok(signed(share) as f32)
            };
            self.given(at).map(read).transpose()
        };
        let (metalness, roughness) = (share(first + 1)?, share(first + 2)?);
        Ok(Look { rotation, bevel, color, metalness, roughness })
    }
}

fn point<S: Scalar>(word: &str, value: &Value<S>) -> Result<Vec3, Fault> {
    three(word, value).map(|[x, y, z]| vec3(x.value(), y.value(), z.value()))
}

/// A measure as a plain number. Whether there is such a shape depends on its sign, so a recording holds only where the sign
/// stays: the comparison notes that.
fn signed<S: Scalar>(measure: S) -> f64 {
    let _ = measure > S::from_f64(0.0);
    measure.value()
}

fn measured<S: Scalar>(word: &str, value: &Value<S>) -> Result<f64, Fault> {
    real(word, value).map(signed)
}

/// The middle of a shape, and three directions.
type At<S> = [[S; 3]; 4];

/// A shape, and where it is.
fn shape<S: Scalar>(
    given: &Arguments<'_, S>,
    result: Result<Shape, GeomError>,
    at: impl FnOnce() -> Result<At<S>, Fault>,
) -> Answer<S> {
    let shape = result.map_err(|error| refused(error).of_call(given.word, given.args))?;
    // The same arguments have given a shape.
    S::note(shape.address(), || at().map_or_else(|_| Vec::new(), |at| at.concat()));
    Ok(Value::Shape(shape))
}

/// Between two points, and from the one to the other.
fn between<S: Scalar>(start: [S; 3], end: [S; 3]) -> At<S> {
    let (half, zero) = (S::from_f64(0.5), [S::from_f64(0.0); 3]);
    let along = [0, 1, 2].map(|k| end[k] - start[k]);
    [[0, 1, 2].map(|k| start[k] + half * along[k]), zero, along, zero]
}

/// Turned, the directions of the coordinates times `size`.
fn turned<S: Scalar>(center: [S; 3], rotation: [[S; 3]; 3], size: [S; 3]) -> At<S> {
    let along = |j: usize| [0, 1, 2].map(|i| rotation[i][j] * size[j]);
    [center, along(0), along(1), along(2)]
}

/// The faults of the geometry crate keep their messages. They are about measures and places: the kinds of arguments were
/// checked before.
fn refused(error: GeomError) -> Fault {
    Fault::bad_shape(error.message)
}

/// 0, 1 or 2 for `"x"`, `"y"`, `"z"`.
fn letter<S: Scalar>(word: &str, value: &Value<S>) -> Result<usize, Fault> {
    let at = match value {
        Value::Str(text) => ["x", "y", "z"].iter().position(|letter| *letter == &**text),
        _ => None,
    };
    at.ok_or_else(|| {
        let shown = crate::value::repr(value).unwrap_or_default();
        Fault::bad_shape(format!("an axis of `{word}` is {shown}, expected \"x\", \"y\" or \"z\""))
    })
}

/// The word `box`.
pub fn cuboid<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let given = Arguments { word: "box", args };
    let (center, size) = (given.point(0)?, given.measures(1)?);
    let taper = given.measure_or(3, 1.0)?;
    let axis = given.given(4).map_or(Ok(2), |arg| letter("box", arg))?;
    let look = given.look(Some(2), Some(5), 6)?;
    shape(&given, Shape::tapered_box(center, size, taper, axis, &look), || {
        Ok(turned(given.triple(0)?, given.turn(2)?, given.triple(1)?))
    })
}

/// The word `cylinder`.
pub fn cylinder<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let given = Arguments { word: "cylinder", args };
    let axis = match given.given(3) {
        None => Vec3::AXES[1],
        Some(name @ Value::Str(_)) => Vec3::AXES[letter("cylinder", name)?],
        Some(direction) => given.read(3, direction, point)?,
    };
    let top = given.given(4).map(|arg| given.read(4, arg, measured)).transpose()?;
    let (radius, length) = (given.measure(1)?, given.measure(2)?);
    let look = given.look(Some(5), Some(6), 7)?;
    shape(&given, Shape::cylinder(given.point(0)?, radius, length, axis, top, &look), || {
        let axis = match given.given(3) {
            Some(direction) if !matches!(direction, Value::Str(_)) => three("cylinder", direction)?,
            _ => axis.to_array().map(S::from_f64),
        };
        let norm = axis.iter().fold(S::from_f64(0.0), |sum, x| sum + *x * *x).sqrt();
        let (turn, length) = (given.turn(5)?, given.scalar(2)? / norm);
        let along = turn.map(|row| (row[0] * axis[0] + row[1] * axis[1] + row[2] * axis[2]) * length);
        let zero = [S::from_f64(0.0); 3];
        Ok([given.triple(0)?, zero, along, zero])
    })
}

/// The word `limb`.
pub fn limb<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let given = Arguments { word: "limb", args };
    let radii = (given.measure(2)?, given.measure(3)?);
    let normals = (given.direction(4)?, given.direction(5)?);
    let look = given.look(None, None, 6)?;
    shape(&given, Shape::limb(given.point(0)?, given.point(1)?, radii, normals, &look), || {
        Ok(between(given.triple(0)?, given.triple(1)?))
    })
}

/// The word `segment`.
pub fn segment<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let given = Arguments { word: "segment", args };
    let onto = given.given(3).map(|_| {
        let parts = given.several(3, 4, "a piece of bark (low, low_radius, high, high_radius)")?;
        let place = |at: usize| given.read(3, &parts[at], point);
        let radius = |at: usize| given.read(3, &parts[at], measured);
        Ok(Bark { low: place(0)?, low_radius: radius(1)?, high: place(2)?, high_radius: radius(3)? })
    });
    let frames = [given.frame(0)?, given.frame(1)?, given.frame(2)?];
    shape(&given, Shape::segment(frames, onto.transpose()?, &given.look(None, None, 4)?), || {
        let center = |at: usize| three("segment", &given.several(at, 4, "a frame")?[0]);
        Ok(between(center(0)?, center(2)?))
    })
}

/// The word `stroke`.
pub fn stroke<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let given = Arguments { word: "stroke", args };
    let width = given.measure(2)?;
    let widths = (width, given.measure_or(3, width)?);
    shape(
        &given,
        Shape::stroke(given.point(0)?, given.point(1)?, widths, &given.look(None, None, 4)?),
        || Ok(between(given.triple(0)?, given.triple(1)?)),
    )
}

/// The word `ellipse`.
pub fn ellipse<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let given = Arguments { word: "ellipse", args };
    let (size, angle) = ((given.measure(1)?, given.measure(2)?), given.number_or(3, 0.0)?);
    shape(&given, Shape::ellipse(given.point(0)?, size, angle, &given.look(None, None, 4)?), || {
        let angle = given.given(3).map_or(Ok(S::from_f64(0.0)), |arg| real("ellipse", arg))?;
        let (c, s, zero) = (angle.cos(), angle.sin(), S::from_f64(0.0));
        let rows = [[c, -s, zero], [s, c, zero], [zero; 3]];
        Ok(turned(given.triple(0)?, rows, [given.scalar(1)?, given.scalar(2)?, zero]))
    })
}

/// The word `disc`.
pub fn disc<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let given = Arguments { word: "disc", args };
    let width = 2.0 * given.measure(1)?;
    shape(&given, Shape::ellipse(given.point(0)?, (width, width), 0.0, &given.look(None, None, 2)?), || {
        let (radius, zero) = (given.scalar(1)?, S::from_f64(0.0));
        let rows = [[radius, zero, zero], [zero, radius, zero], [zero; 3]];
        Ok(turned(given.triple(0)?, rows, [S::from_f64(1.0); 3]))
    })
}

/// The word `mesh`.
pub fn mesh<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let given = Arguments { word: "mesh", args };
    placed(&kept_mesh(&given, given.needed(0)?, given.needed(1)?)?, args)
}

/// The word `mesh`, of a mesh that was read before: the first two arguments are not read.
pub fn placed<S: Scalar>(mesh: &Arc<TriMesh>, args: &[Value<S>]) -> Answer<S> {
    let given = Arguments { word: "mesh", args };
    let center = given.given(2).map_or(Ok(vec3(0.0, 0.0, 0.0)), |arg| given.read(2, arg, point))?;
    shape(
        &given,
        Shape::mesh(mesh, center, given.measure_or(4, 1.0)?, &given.look(Some(3), None, 5)?),
        || {
            let zero = [S::from_f64(0.0); 3];
            let center = given.given(2).map_or(Ok(zero), |arg| three("mesh", arg))?;
            let scale = given.given(4).map_or(Ok(S::from_f64(1.0)), |arg| real("mesh", arg))?;
            Ok(turned(center, given.turn(3)?, [scale; 3]))
        },
    )
}

/// Meshes that a thread keeps, newest last.
const KEPT: usize = 16;

/// The data that a mesh was made of, and the mesh.
type Kept = (Box<dyn Any>, Arc<TriMesh>);

thread_local! {
    /// A model places the same mesh again and again; its vertices are constants. They are compared by identity, so a
    /// hit costs nothing, and the mesh is shared by all shapes that place it.
    static MESHES: RefCell<Vec<Kept>> = const { RefCell::new(Vec::new()) };
}

fn kept_mesh<S: Scalar>(
    given: &Arguments<'_, S>,
    vertices: &Value<S>,
    faces: &Value<S>,
) -> Result<Arc<TriMesh>, Fault> {
    MESHES.with_borrow_mut(|meshes| {
        let is_it = |kept: &Kept| {
            kept.0
                .downcast_ref()
                .is_some_and(|(v, f): &(Value<S>, Value<S>)| same(v, vertices) && same(f, faces))
        };
        if let Some((_, mesh)) = meshes.iter().find(|kept| is_it(kept)) {
            return Ok(Arc::clone(mesh));
        }
        let mesh = Arc::new(read_mesh(given, vertices, faces)?);
        if meshes.len() == KEPT {
            meshes.remove(0);
        }
        meshes.push((Box::new((vertices.clone(), faces.clone())), Arc::clone(&mesh)));
        Ok(mesh)
    })
}

fn read_mesh<S: Scalar>(
    given: &Arguments<'_, S>,
    vertices: &Value<S>,
    faces: &Value<S>,
) -> Result<TriMesh, Fault> {
    let invalid = |fault: Fault| fault.of_call(given.word, given.args);
    let points = iter_all(vertices)?.iter().map(|v| given.read(0, v, point)).collect::<Result<_, _>>()?;
    let corner = |value: &Value<S>| {
        let n = given.read(1, value, whole)?;
        let missing = |_| invalid(Fault::bad_shape(format!("a face of `mesh` names vertex {n}")));
        u32::try_from(n).map_err(missing)
    };
    let face = |value: &Value<S>| {
        let corners: Vec<u32> = iter_all(value)?.iter().map(corner).collect::<Result<_, _>>()?;
        <[u32; 3]>::try_from(corners).map_err(|other| {
            Fault::bad_shape(format!("a face of `mesh` has {} vertices, expected 3", other.len()))
        })
    };
    let triangles = iter_all(faces)?.iter().map(face).collect::<Result<_, _>>()?;
    TriMesh::new(points, triangles).map_err(|error| invalid(refused(error)))
}

#[cfg(test)]
mod tests {
    use super::WORDS;
    use crate::builtins::tests::{V, call, code, reals};
    use crate::builtins::{builtin, builtin_id};
    use crate::value::Value;
    use niwaki_geom::{Shape, Solid, vec3};
    use std::sync::Arc;

    #[test]
    fn each_word_is_a_builtin_that_takes_its_parameters() {
        for (name, parameters) in WORDS {
            let id =
                builtin_id(name).unwrap_or_else(|| panic!("`{name}` is missing in the table of builtins"));
            assert_eq!(builtin::<f64>(id).max_args, parameters.len(), "parameters of `{name}`");
        }
    }

    fn shape_of(name: &str, args: &[V]) -> Shape {
        match call(name, args) {
            Ok(Value::Shape(shape)) => shape,
            other => panic!("{other:?}"),
        }
    }

    fn at(x: f64, y: f64, z: f64) -> V {
        V::tuple(vec![V::real(x), V::real(y), V::real(z)])
    }

    #[test]
    fn words_place_their_solids() {
        let cube = shape_of("box", &[at(0.0, 1.0, 0.0), reals([2.0, 2.0, 4.0])]);
        assert_eq!(cube.aabb().low, vec3(-1.0, 0.0, -2.0));
        let tapered = [at(0.0, 0.0, 0.0), at(1.0, 1.0, 1.0), V::None, V::real(0.5), V::str("y")];
        assert_eq!(shape_of("box", &tapered).kind(), "tapered-box");
        let log = shape_of("cylinder", &[at(0.0, 0.0, 0.0), V::real(0.5), V::Int(4), V::str("z")]);
        assert_eq!(log.aabb().extent().z, 4.0);
        let color = [
            at(0.0, 0.0, 0.0),
            at(0.0, 1.0, 0.0),
            V::real(0.2),
            V::real(0.1),
            V::None,
            V::None,
            at(1.0, 0.5, 0.0),
        ];
        assert_eq!(shape_of("limb", &color).color(), Some([1.0, 0.5, 0.0]));
    }

    #[test]
    fn a_segment_takes_frames_and_bark() {
        let frame = |y: f64, r: f64| {
            V::tuple(vec![at(0.0, y, 0.0), at(0.0, 1.0, 0.0), at(0.0, 0.0, 1.0), V::real(r)])
        };
        let [start, split, end] = [frame(0.0, 1.0), frame(0.3, 0.9), frame(4.0, 0.7)];
        let trunk = shape_of("segment", &[start.clone(), split.clone(), end.clone()]);
        assert_eq!((trunk.kind(), trunk.aabb().extent().y), ("segment", 4.0));
        let short = V::tuple(vec![at(0.0, 1.0, 0.0), V::real(0.2)]);
        assert_eq!(code("segment", &[start.clone(), split.clone(), short.clone()]), "type-mismatch");
        assert_eq!(code("segment", &[start.clone(), split, end, short]), "type-mismatch");
        let skew = V::tuple(vec![at(0.0, 1.0, 0.0), at(0.0, 1.0, 0.0), at(0.0, 1.0, 0.0), V::real(0.5)]);
        assert_eq!(code("segment", &[start.clone(), start, skew]), "bad-shape");
    }

    #[test]
    fn flat_shapes_have_their_sizes() {
        let line = shape_of("stroke", &[at(0.0, 0.0, 1.0), at(3.0, 0.0, 1.0), V::real(2.0), V::real(1.0)]);
        assert_eq!((line.kind(), line.aabb().low.x, line.aabb().high.x), ("stroke", -1.0, 3.5));
        let leaf = shape_of("ellipse", &[at(0.0, 0.0, 0.0), V::Int(4), V::Int(2)]);
        assert_eq!((leaf.aabb().extent().x, leaf.aabb().extent().y), (4.0, 2.0));
        let round = shape_of("disc", &[at(0.0, 0.0, 0.0), V::Int(2), at(1.0, 0.0, 0.0)]);
        assert_eq!((round.aabb().extent().y, round.color()), (4.0, Some([1.0, 0.0, 0.0])));
        assert_eq!(code("stroke", &[at(0.0, 0.0, 1.0), at(3.0, 0.0, 0.0), V::real(2.0)]), "bad-shape");
        assert_eq!(code("disc", &[at(0.0, 0.0, 1.0), V::Int(0)]), "bad-shape");
    }

    #[test]
    fn a_mesh_is_read_once() {
        let vertices =
            V::list(vec![at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(0.0, 0.0, 1.0)]);
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let faces = V::list(faces.map(|f| V::tuple(f.map(V::Int).to_vec())).to_vec());
        let (a, b) = (
            shape_of("mesh", &[vertices.clone(), faces.clone()]),
            shape_of("mesh", &[vertices.clone(), faces]),
        );
        let (Solid::Mesh(a), Solid::Mesh(b)) = (a.solid(), b.solid()) else { panic!("not meshes") };
        assert!(Arc::ptr_eq(a, b));
        let far = V::list(vec![V::tuple(vec![V::Int(0), V::Int(1), V::Int(9)])]);
        assert_eq!(code("mesh", &[vertices, far]), "bad-shape");
    }

    #[test]
    fn impossible_shapes_are_faults() {
        assert_eq!(code("box", &[at(0.0, 0.0, 0.0), at(1.0, -1.0, 1.0)]), "bad-shape");
        assert_eq!(code("cylinder", &[at(0.0, 0.0, 0.0), V::None, V::Int(1)]), "bad-argument");
        assert_eq!(code("cylinder", &[at(0.0, 0.0, 0.0), V::Int(1), V::Int(1), V::str("q")]), "bad-shape");
        assert_eq!(code("box", &[V::Int(1), at(1.0, 1.0, 1.0)]), "type-mismatch");
    }
}

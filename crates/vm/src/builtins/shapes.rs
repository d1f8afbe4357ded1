//! Shapes from values: the words that the solids of `niwaki_geom` describe. Models and plain Python runs both
//! use this file.
//!
//! A scene consists of plain numbers: a recording scalar contributes only its value. It may note the places of
//! shapes ([`Scalar::note`]).

use std::any::Any;
use std::cell::RefCell;
use std::sync::Arc;

use niwaki_geom::solids::word::looks::{self, PAINTED};
use niwaki_geom::solids::word::{Arguments, Description, Word};
use niwaki_geom::{Bark, Frame, GeomError, Shape, Solid, TriMesh, Vec3};

use super::Builtin;
use super::answer::{Answer, unfit};
use super::arithmetic::{real, whole};
use super::colors::rgb;
use super::vectors::{three, two};
use crate::fault::Fault;
use crate::value::index::{iter_all, iter_get, iter_len};
use crate::value::{Scalar, Value, identical};

/// The arguments of a call of a word; omitted arguments are `None`.
struct WordCall<'a, S: Scalar> {
    word: &'static Description,
    args: &'a [Value<S>],
    /// A mesh that was read before; then the first two arguments are ignored.
    mesh: Option<&'a Arc<TriMesh>>,
}

impl<S: Scalar> WordCall<'_, S> {
    fn argument(&self, at: usize) -> Option<&Value<S>> {
        self.args.get(at).filter(|arg| !matches!(arg, Value::None))
    }

    #[inline]
    fn required(&self, at: usize) -> Result<&Value<S>, Fault> {
        self.argument(at).ok_or_else(|| {
            Fault::bad_argument(format!("argument {} of `{}` cannot be None", at + 1, self.word.name))
        })
    }

    /// Reads an argument or a part of an argument; a fault names the parameter.
    #[inline]
    fn read<T>(
        &self,
        at: usize,
        value: &Value<S>,
        read: impl FnOnce(&str, &Value<S>) -> Result<T, Fault>,
    ) -> Result<T, Fault> {
        read(self.word.name, value).map_err(|fault| self.named(at, &fault))
    }

    #[cold]
    fn named(&self, at: usize, fault: &Fault) -> Fault {
        let name = self.word.parameters().nth(at).map_or("an argument", |parameter| parameter.name);
        let word = self.word.name;
        let (word, named) = (format!("`{word}`"), format!("`{name}` of `{word}`"));
        Fault::new(fault.code, fault.message.replacen(&word, &named, 1))
    }

    /// The parts of a tuple, list or record that must have `count` parts.
    fn parts_of(&self, at: usize, count: usize, expected: &str) -> Result<Vec<Value<S>>, Fault> {
        let arg = self.required(at)?;
        let has_parts = matches!(arg, Value::Tuple(_) | Value::List(_) | Value::Record(_));
        if !has_parts || iter_len(arg)? != count {
            return Err(self.named(at, &unfit(self.word.name, expected, arg)));
        }
        iter_all(arg)
    }

    /// The points of a list or a tuple.
    fn list_of<const N: usize>(
        &self,
        at: usize,
        expected: &str,
        read: impl Fn(&str, &Value<S>) -> Result<[S; N], Fault>,
    ) -> Result<Vec<[S; N]>, Fault> {
        let arg = self.required(at)?;
        if !matches!(arg, Value::Tuple(_) | Value::List(_)) {
            return Err(self.named(at, &unfit(self.word.name, expected, arg)));
        }
        (0..iter_len(arg)?).map(|k| self.read(at, &iter_get(arg, k), &read)).collect()
    }
}

impl<S: Scalar> Arguments<S> for WordCall<'_, S> {
    type Fault = Fault;

    #[inline]
    fn is_given(&self, at: usize) -> bool {
        self.argument(at).is_some()
    }

    #[inline]
    fn real(&self, at: usize) -> Result<S, Fault> {
        self.read(at, self.required(at)?, real)
    }

    #[inline]
    fn three(&self, at: usize) -> Result<[S; 3], Fault> {
        self.read(at, self.required(at)?, three)
    }

    fn rows(&self, at: usize) -> Result<[[S; 3]; 3], Fault> {
        let arg = self.required(at)?;
        if let Value::Rotation(r) = arg {
            return Ok([[r[0], r[1], r[2]], [r[3], r[4], r[5]], [r[6], r[7], r[8]]]);
        }
        let rows = matches!(arg, Value::Tuple(_) | Value::List(_)) && iter_len(arg)? == 3;
        if !rows {
            return Err(
                self.named(at, &unfit(self.word.name, "a rotation such as `rotation(axis, angle)`", arg))
            );
        }
        let row = |row: usize| self.read(at, &iter_get(arg, row), three);
        Ok([row(0)?, row(1)?, row(2)?])
    }

    fn letter(&self, at: usize) -> Result<usize, Fault> {
        let arg = self.required(at)?;
        let position = match arg {
            Value::Str(text) => ["x", "y", "z"].iter().position(|letter| *letter == &**text),
            _ => None,
        };
        position.ok_or_else(|| {
            let shown = crate::value::repr(arg).unwrap_or_default();
            let word = self.word.name;
            Fault::bad_shape(format!("an axis of `{word}` is {shown}, expected \"x\", \"y\" or \"z\""))
        })
    }

    fn one_of(&self, at: usize, words: &[&str]) -> Result<usize, Fault> {
        let arg = self.required(at)?;
        let found = match arg {
            Value::Str(text) => words.iter().position(|word| *word == &**text),
            _ => None,
        };
        found.ok_or_else(|| {
            let expected: Vec<String> = words.iter().map(|word| format!("{word:?}")).collect();
            self.named(at, &unfit(self.word.name, &expected.join(" or "), arg))
        })
    }

    fn text(&self, at: usize) -> Result<Arc<str>, Fault> {
        match self.required(at)? {
            Value::Str(text) => Ok(Arc::from(&**text)),
            other => Err(self.named(at, &unfit(self.word.name, "a name in quotes", other))),
        }
    }

    fn color(&self, at: usize) -> Result<[f32; 3], Fault> {
        let color: [S; 3] = self.read(at, self.required(at)?, rgb)?;
        Ok(color.map(|part| part.value() as f32))
    }

    fn axis(&self, at: usize) -> Result<[S; 3], Fault> {
        match self.required(at)? {
            Value::Str(_) => Ok(Vec3::AXES[self.letter(at)?].to_array().map(S::from_f64)),
            direction => self.read(at, direction, three),
        }
    }

    fn frame(&self, at: usize) -> Result<([S; 3], Frame), Fault> {
        let parts = self.parts_of(at, 4, "a frame (center, forward, up, radius)")?;
        let middle = self.read(at, &parts[0], three)?;
        let [forward, up] = [self.read(at, &parts[1], point)?, self.read(at, &parts[2], point)?];
        let radius = self.read(at, &parts[3], length)?;
        Ok((middle, Frame { center: Vec3::from(middle.map(Scalar::value)), forward, up, radius }))
    }

    fn bark(&self, at: usize) -> Result<Bark, Fault> {
        let parts = self.parts_of(at, 4, "a piece of bark (low, low_radius, high, high_radius)")?;
        let place = |part: usize| self.read(at, &parts[part], point);
        let radius = |part: usize| self.read(at, &parts[part], length);
        Ok(Bark { low: place(0)?, low_radius: radius(1)?, high: place(2)?, high_radius: radius(3)? })
    }

    fn points(&self, at: usize) -> Result<Vec<[S; 3]>, Fault> {
        self.list_of(at, "a list of points such as `[(0, 0, 0), (1, 0, 0)]`", three)
    }

    fn pairs(&self, at: usize) -> Result<Vec<[S; 2]>, Fault> {
        self.list_of(at, "a list of points such as `[(0, 0), (1, 0)]`", two)
    }

    fn mesh(&self, at: usize) -> Result<Arc<TriMesh>, Fault> {
        match self.mesh {
            Some(mesh) => Ok(Arc::clone(mesh)),
            None => cached_mesh(self, self.required(at)?, self.required(at + 1)?),
        }
    }
}

fn point<S: Scalar>(word: &str, value: &Value<S>) -> Result<Vec3, Fault> {
    three(word, value).map(|parts| Vec3::from(parts.map(Scalar::value)))
}

/// Reads a length within an argument. The sign decides whether there is such a shape, so a recording is valid
/// only while the sign stays: the comparison records that.
fn length<S: Scalar>(word: &str, value: &Value<S>) -> Result<f64, Fault> {
    let measure = real(word, value)?;
    let _ = measure > S::from_f64(0.0);
    Ok(measure.value())
}

/// The built-in function of a word.
pub(super) const fn builtin<S: Scalar, W: Word<S>>() -> Builtin<S>
where
    Solid: From<W::Solid>,
{
    let (min_args, max_args) = W::DESCRIPTION.counts();
    Builtin { name: W::DESCRIPTION.name, min_args, max_args, run: |args| build::<S, W>(args, None) }
}

/// Builds the shape of a call. `mesh` is the mesh of a word whose first two arguments were read before.
pub(super) fn build<S: Scalar, W: Word<S>>(args: &[Value<S>], mesh: Option<&Arc<TriMesh>>) -> Answer<S>
where
    Solid: From<W::Solid>,
{
    let (word, parsed) = (W::DESCRIPTION.name, W::read(&WordCall { word: &W::DESCRIPTION, args, mesh })?);
    let shape =
        parsed.solid().and_then(|(solid, placement)| Shape::new(solid.into(), placement, parsed.look()));
    let shape = shape.map_err(|error| bad_shape(error).of_call(word, args))?;
    S::note(shape.address(), || parsed.at().concat());
    Ok(Value::Shape(shape))
}

/// The look of an `emit` as data.
const EMIT: Description = Description { name: "emit", doc: "", measures: &[], look: PAINTED };

/// `worn(color, metalness, roughness, material, shapes)`: shapes, also in lists and tuples, in one tuple; those without a part of
/// this look have it now. Other values stay as they are.
pub(super) fn worn<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (given, shapes) = args.split_at(PAINTED.len());
    let look = looks::read(&WordCall { word: &EMIT, args: given, mesh: None }, PAINTED, 0)?;
    each_shape(&shapes[0], |shape| {
        let worn = shape.worn(&look).map_err(|error| bad_shape(error).of_call("emit", given))?;
        S::note(worn.address(), || S::noted(shape.address()));
        Ok(worn)
    })
}

/// The shapes of a value, changed, in one tuple; lists and tuples are opened, and other values stay as they are.
pub(super) fn each_shape<S: Scalar>(
    value: &Value<S>,
    change: impl Fn(&Shape) -> Result<Shape, Fault>,
) -> Answer<S> {
    let (mut waiting, mut all) = (vec![value.clone()], Vec::new());
    while let Some(value) = waiting.pop() {
        match &value {
            Value::Shape(shape) => all.push(Value::Shape(change(shape)?)),
            Value::Tuple(_) | Value::List(_) => waiting.extend(iter_all(&value)?.into_iter().rev()),
            _ => all.push(value),
        }
    }
    Ok(Value::tuple(all))
}

/// Converts a fault of the geometry crate, and keeps its message. Such faults concern measures and places: the
/// kinds of arguments were checked before.
fn bad_shape(error: GeomError) -> Fault {
    Fault::bad_shape(error.message)
}

/// The most meshes that a thread caches, newest last.
const CACHED_MESHES: usize = 16;

/// The data of a mesh, and the mesh.
type CachedMesh = (Box<dyn Any>, Arc<TriMesh>);

thread_local! {
    /// Meshes that models of this thread placed before. A model places the same mesh again and again, and its
    /// vertices are constants. They are compared by identity, so a hit costs nothing, and all shapes that place
    /// a mesh share it.
    static MESHES: RefCell<Vec<CachedMesh>> = const { RefCell::new(Vec::new()) };
}

fn cached_mesh<S: Scalar>(
    call: &WordCall<'_, S>,
    vertices: &Value<S>,
    faces: &Value<S>,
) -> Result<Arc<TriMesh>, Fault> {
    MESHES.with_borrow_mut(|meshes| {
        let is_match = |cached: &CachedMesh| {
            cached
                .0
                .downcast_ref()
                .is_some_and(|(v, f): &(Value<S>, Value<S>)| identical(v, vertices) && identical(f, faces))
        };
        if let Some((_, mesh)) = meshes.iter().find(|cached| is_match(cached)) {
            return Ok(Arc::clone(mesh));
        }
        let mesh = Arc::new(read_mesh(call, vertices, faces)?);
        if meshes.len() == CACHED_MESHES {
            meshes.remove(0);
        }
        meshes.push((Box::new((vertices.clone(), faces.clone())), Arc::clone(&mesh)));
        Ok(mesh)
    })
}

fn read_mesh<S: Scalar>(
    call: &WordCall<'_, S>,
    vertices: &Value<S>,
    faces: &Value<S>,
) -> Result<TriMesh, Fault> {
    let invalid = |fault: Fault| fault.of_call(call.word.name, call.args);
    let points = iter_all(vertices)?.iter().map(|v| call.read(0, v, point)).collect::<Result<_, _>>()?;
    let corner = |value: &Value<S>| {
        let n = call.read(1, value, whole)?;
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
    TriMesh::new(points, triangles).map_err(|error| invalid(bad_shape(error)))
}

#[cfg(test)]
mod tests {
    use crate::builtins::tests::{V, call, code, reals};
    use crate::value::Value;
    use niwaki_geom::{Shape, Solid, vec3};
    use std::sync::Arc;

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
            V::str("round"),
            at(1.0, 0.5, 0.0),
        ];
        assert_eq!(shape_of("limb", &color).color(), Some([1.0, 0.5, 0.0]));
        let [.., joint, _] = &color;
        assert_eq!(
            code("limb", &color.clone().map(|arg| if arg == *joint { V::str("bent") } else { arg })),
            "type-mismatch"
        );
        let worn = |look: [V; 4]| {
            let [a, b, c, d] = look;
            call(
                "worn",
                &[a, b, c, d, V::tuple(vec![V::Shape(cube.clone()), V::Shape(shape_of("limb", &color))])],
            )
        };
        let painted = worn([V::str("#fff"), V::None, V::real(0.25), V::str("oak")]).unwrap();
        let V::Tuple(painted) = painted else { panic!("{painted:?}") };
        let [V::Shape(cube), V::Shape(limb)] = painted.items() else { panic!("{painted:?}") };
        assert_eq!(
            (cube.color(), cube.roughness(), cube.material()),
            (Some([1.0; 3]), Some(0.25), Some("oak"))
        );
        assert_eq!((limb.color(), limb.material()), (Some([1.0, 0.5, 0.0]), Some("oak")));
        assert_eq!(limb.world_mesh().vertices(), shape_of("limb", &color).world_mesh().vertices());
        for wrong in [V::str("oak"), V::real(1.0)] {
            let fault = worn([wrong, V::None, V::None, V::None]).unwrap_err();
            assert!(
                fault.code == "type-mismatch" && fault.message.starts_with("`color` of `emit`"),
                "{fault}"
            );
        }
        assert_eq!(worn([V::None, V::Int(2), V::None, V::None]).unwrap_err().code, "bad-shape");
        assert_eq!(worn([V::None, V::None, V::None, V::str("")]).unwrap_err().code, "bad-shape");
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

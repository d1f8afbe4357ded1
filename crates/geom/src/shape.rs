//! A shape: a solid, its place and its look. It never changes and is shared by counting references.
//!
//! Solids are centred at the origin and *placed*: first turned, then moved. Scores use a coarse mesh: inscribed polygons with
//! few sides, sharp edges. Its hull is computed with the shape, but not held by it ([`crate::store`]). Pictures make a finer mesh
//! from the same solid.

use crate::bounds::Aabb;
use crate::coarse::{convex, ring};
use crate::convex::{Convex, is_aligned};
use crate::error::GeomError;
use crate::mesh::TriMesh;
use crate::plane::flat::{self, Round};
use crate::segment::Tube;
use crate::store::{self, Number, WorldMesh};
use crate::vector::{Mat3, Vec3, vec3};
use crate::words::Look;
use serde::{Deserialize, Serialize};
use std::rc::Rc;
use std::sync::Arc;

/// Default number of sides of a cylinder (dissertation chapter 5's coarse mesh).
pub const CYLINDER_SIDES: usize = 8;
/// Default number of sides of a limb.
pub const LIMB_SIDES: usize = 10;

/// A round end of a limb: a regular polygon in the plane through `center` with unit `normal`.
///
/// The first vertex lies where the smallest turn from +y to the normal takes +z, so that a ring is a function of its
/// centre, normal and radius, and two limbs that name the same ring share its vertices to the bit.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Ring {
    /// Middle, scene units.
    pub center: Vec3,
    /// Unit direction across the ring, from the start of the limb to its end.
    pub normal: Vec3,
    /// Distance of the vertices from the middle.
    pub radius: f64,
}

impl Ring {
    /// The `sides` vertices, counter-clockwise seen against the normal.
    pub fn vertices(&self, sides: usize) -> impl Iterator<Item = Vec3> + '_ {
        let turn = Mat3::between(Vec3::AXES[1], self.normal);
        ring(sides).map(move |(sin, cos)| self.center + turn.apply(vec3(sin, 0.0, cos) * self.radius))
    }
}

/// The solid of a shape, centred at the origin (a limb and a mesh: at their coordinates).
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Solid {
    /// Full side lengths.
    Box {
        /// Along x, y and z.
        size: Vec3,
    },
    /// A box whose +z face is scaled about its middle.
    TaperedBox {
        /// Along x, y and z.
        size: Vec3,
        /// Scale of the +z face in x and y.
        taper: f64,
    },
    /// A prism along +y over an inscribed polygon whose first vertex points to +z.
    Cylinder {
        /// Distance of the vertices from the axis.
        radius: f64,
        /// Along y.
        length: f64,
        /// Of the polygon.
        sides: usize,
    },
    /// A cylinder with two radii.
    TaperedCylinder {
        /// At the -y end.
        radius: f64,
        /// At the +y end.
        top_radius: f64,
        /// Along y.
        length: f64,
        /// Of the polygon.
        sides: usize,
    },
    /// Convex hull of two rings: a bent, tapered segment. Limbs that share a ring only touch, as long as each lies
    /// on its own side of the ring's plane.
    Limb {
        /// Start and end.
        rings: Box<[Ring; 2]>,
        /// Of both rings.
        sides: usize,
    },
    /// A bent, tapered tube over three rings whose base may lie on a parent's bark: see [`crate::segment`].
    Segment(Tube),
    /// Any closed mesh.
    Mesh(Arc<TriMesh>),
    /// Flat: the convex hull of two circles on one plane parallel to z = 0, a straight stroke with round ends.
    Stroke {
        /// Start and end.
        ends: Box<[Round; 2]>,
    },
    /// Flat: an ellipse on a plane parallel to z = 0.
    Ellipse {
        /// Full lengths along its own x and y.
        size: [f64; 2],
    },
}

impl Solid {
    /// True for what lies on a plane parallel to z = 0; in space it is a thin plate.
    pub fn is_flat(&self) -> bool {
        matches!(self, Solid::Stroke { .. } | Solid::Ellipse { .. })
    }
}

/// First turn, then move.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Placement {
    /// A rotation.
    pub rotation: Mat3,
    /// Scene units.
    pub translation: Vec3,
}

impl Placement {
    /// No movement.
    pub const IDENTITY: Placement = Placement { rotation: Mat3::IDENTITY, translation: Vec3::ZERO };

    /// From the solid's own coordinates to the world's.
    #[inline]
    pub fn apply(&self, p: Vec3) -> Vec3 {
        self.rotation.apply(p) + self.translation
    }
}

/// The data of a shape. It must be small: a population of particles holds millions of them.
#[derive(Debug)]
struct Inner {
    solid: Solid,
    translation: Vec3,
    /// None where it is not turned, to the bit.
    rotation: Option<Box<Mat3>>,
    /// None where nothing of it is given.
    paint: Option<Box<Paint>>,
    aabb: Aabb,
    /// Of the hull of a solid that is neither a box nor a mesh; infinite for these.
    width: f64,
    /// Of its geometry in a store; none for a box.
    number: Number,
}

// With the counters in front of it, 160 bytes: a size that allocators have.
const _: () = assert!(std::mem::size_of::<Inner>() <= 144);

/// What pictures show beside the form.
#[derive(Clone, Copy, Debug)]
struct Paint {
    bevel: Option<f64>,
    /// NaN for none.
    color: [f32; 3],
    /// Metalness and roughness; NaN for none.
    finish: [f32; 2],
}

impl Paint {
    const NONE: Paint = Paint { bevel: None, color: [f32::NAN; 3], finish: [f32::NAN; 2] };
}

impl PartialEq for Paint {
    fn eq(&self, other: &Paint) -> bool {
        let same_color = self.color == other.color || (self.color[0].is_nan() && other.color[0].is_nan());
        let bits = |p: &Paint| (p.bevel.map(f64::to_bits), p.finish.map(f32::to_bits));
        same_color && bits(self) == bits(other)
    }
}

/// A placed solid with its look. Cloning shares it.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(try_from = "Plain", into = "Plain")]
pub struct Shape(Arc<Inner>);

/// The serialised form of a shape.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Plain {
    solid: Solid,
    placement: Placement,
    bevel: Option<f64>,
    color: Option<[f32; 3]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    metalness: Option<f32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    roughness: Option<f32>,
}

impl TryFrom<Plain> for Shape {
    type Error = GeomError;

    fn try_from(plain: Plain) -> Result<Shape, GeomError> {
        let Plain { solid, placement, bevel, color, metalness, roughness } = plain;
        Shape::new(solid, placement, &Look { rotation: None, bevel, color, metalness, roughness })
    }
}

impl From<Shape> for Plain {
    fn from(shape: Shape) -> Plain {
        Plain {
            solid: shape.solid().clone(),
            placement: shape.placement(),
            bevel: shape.bevel(),
            color: shape.color(),
            metalness: shape.metalness(),
            roughness: shape.roughness(),
        }
    }
}

impl PartialEq for Shape {
    fn eq(&self, other: &Shape) -> bool {
        let (a, b) = (&*self.0, &*other.0);
        Arc::ptr_eq(&self.0, &other.0)
            || (a.aabb == b.aabb
                && (a.translation, a.rotation()) == (b.translation, b.rotation())
                && a.paint() == b.paint()
                && a.solid == b.solid)
    }
}

impl Inner {
    #[inline]
    fn rotation(&self) -> &Mat3 {
        self.rotation.as_deref().unwrap_or(&Mat3::IDENTITY)
    }

    #[inline]
    fn placement(&self) -> Placement {
        Placement { rotation: *self.rotation(), translation: self.translation }
    }

    fn paint(&self) -> &Paint {
        self.paint.as_deref().unwrap_or(&Paint::NONE)
    }
}

impl Shape {
    /// Places `solid` in the world and computes the data for scores. The rotation of its look is not read.
    ///
    /// # Errors
    /// `bad-shape` for sizes that are not positive and finite, a placement that is not a rotation, a flat limb, or a look
    /// that is out of range.
    pub fn new(solid: Solid, placement: Placement, look: &Look) -> Result<Shape, GeomError> {
        let Look { bevel, color, metalness, roughness, .. } = *look;
        check_solid(&solid)?;
        if !placement.translation.is_finite() {
            return bad(format!(
                "the centre is {:?}, expected finite numbers",
                placement.translation.to_array()
            ));
        }
        let defect = placement.rotation.defect();
        if defect.is_nan() || defect > 1e-6 {
            return bad(format!("the rotation is not a rotation: it is off by {defect}"));
        }
        if let Some(b) = bevel.filter(|b| !(*b >= 0.0 && b.is_finite())) {
            return bad(format!("the bevel is {b}, expected zero or more"));
        }
        if let Some(c) = color.filter(|c| !c.iter().all(|c| c.is_finite())) {
            return bad(format!("the color is {c:?}, expected three finite numbers"));
        }
        for (name, given) in [("metalness", metalness), ("roughness", roughness)] {
            if let Some(share) = given.filter(|share| !(0.0..=1.0).contains(share)) {
                return bad(format!("the {name} is {share}, expected a number from 0 to 1"));
            }
        }
        let flat = || bad(format!("{} has no inside", kind(&solid)));
        let (mut width, mut number) = (f64::INFINITY, Number::NONE);
        let aabb = match &solid {
            Solid::Mesh(mesh) => {
                number = Number::new();
                Aabb::around(mesh.corners().flatten().map(|p| placement.apply(p)))
            }
            Solid::Box { size } => {
                let convex = Convex::cuboid(*size, &placement);
                // A size that is lost in rounding beside the placement leaves the corners equal.
                if convex.width() <= 0.0 {
                    return flat();
                }
                Aabb::around(convex.corners().iter().copied())
            }
            solid if solid.is_flat() => {
                flat::check(solid, &placement)?;
                flat::aabb(solid, &placement).unwrap_or(Aabb::EMPTY)
            }
            solid => {
                let Some(coarse) = convex(solid, &placement) else { return flat() };
                (width, number) = (coarse.width(), Number::new());
                let aabb = Aabb::around(coarse.corners().iter().copied());
                store::keep_hull(&number, Rc::new(coarse));
                aabb
            }
        };
        // Beyond this, squares and products of lengths lose all meaning.
        let reach = aabb.union(&Aabb { low: Vec3::ZERO, high: Vec3::ZERO }).extent().norm();
        if reach.is_nan() || reach > 1e12 {
            return bad("the shape is farther than 1e12 from the origin".to_string());
        }
        let is_painted = bevel.is_some() || color.is_some() || metalness.is_some() || roughness.is_some();
        let paint = is_painted.then(|| {
            let finish = [metalness, roughness].map(|share| share.unwrap_or(f32::NAN));
            Box::new(Paint { bevel, color: color.unwrap_or([f32::NAN; 3]), finish })
        });
        let Placement { rotation, translation } = placement;
        let bits = |turn: &Mat3| turn.columns.map(|column| column.to_array().map(f64::to_bits));
        let rotation = (bits(&rotation) != bits(&Mat3::IDENTITY)).then(|| Box::new(rotation));
        Ok(Shape(Arc::new(Inner { solid, translation, rotation, paint, aabb, width, number })))
    }

    /// The solid, in its own coordinates.
    pub fn solid(&self) -> &Solid {
        &self.0.solid
    }

    /// Where it is.
    #[inline]
    pub fn placement(&self) -> Placement {
        self.0.placement()
    }

    /// How it is turned, before it is moved.
    #[inline]
    pub fn rotation(&self) -> &Mat3 {
        self.0.rotation()
    }

    /// How far it is moved, scene units.
    #[inline]
    pub fn translation(&self) -> Vec3 {
        self.0.translation
    }

    /// Rounding of edges in pictures and exports, as a share of the half lengths.
    pub fn bevel(&self) -> Option<f64> {
        self.0.paint().bevel
    }

    /// Linear colour in `[0, 1]`.
    pub fn color(&self) -> Option<[f32; 3]> {
        Some(self.0.paint().color).filter(|color| !color[0].is_nan())
    }

    /// From 0 (paint, wood, stone) to 1 (metal).
    pub fn metalness(&self) -> Option<f32> {
        Some(self.0.paint().finish[0]).filter(|share| !share.is_nan())
    }

    /// From 0 (a mirror) to 1 (chalk).
    pub fn roughness(&self) -> Option<f32> {
        Some(self.0.paint().finish[1]).filter(|share| !share.is_nan())
    }

    /// `box`, `tapered-box`, `cylinder`, `tapered-cylinder`, `limb`, `segment`, `mesh`, `stroke` or `ellipse`.
    pub fn kind(&self) -> &'static str {
        kind(&self.0.solid)
    }

    /// Its address in memory: no other shape has it while this one exists.
    #[inline]
    pub fn address(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }

    /// Whether something else holds it, too.
    #[inline]
    pub fn is_shared(&self) -> bool {
        Arc::strong_count(&self.0) > 1
    }

    /// Bytes that it takes, and of a mesh those of its triangles. Its geometry is in stores of limited size, and does not count.
    pub fn bytes(&self) -> usize {
        let beside = match &self.0.solid {
            Solid::Limb { .. } => size_of::<[Ring; 2]>(),
            Solid::Segment(tube) => tube.bytes(),
            Solid::Mesh(mesh) => mesh.bytes(),
            Solid::Stroke { .. } => size_of::<[Round; 2]>(),
            _ => 0,
        };
        let turned = self.0.rotation.as_ref().map_or(0, |_| size_of::<Mat3>());
        let painted = self.0.paint.as_ref().map_or(0, |_| size_of::<Paint>());
        16 + size_of::<Inner>() + turned + painted + beside
    }

    /// The smallest box around the coarse mesh, world space; of a flat shape, around the outline.
    #[inline]
    pub fn aabb(&self) -> &Aabb {
        &self.0.aabb
    }

    /// True for a box whose sides are exactly the coordinate directions: it is its [`Shape::aabb`].
    #[inline]
    pub fn is_aligned_box(&self) -> bool {
        let turned = || self.0.rotation.as_deref().is_some_and(|rotation| !is_aligned(rotation));
        matches!(self.0.solid, Solid::Box { .. }) && !turned()
    }

    /// True for all but a mesh and flat shapes, which are treated as the meshes of their plates.
    #[inline]
    pub fn is_convex(&self) -> bool {
        !matches!(self.0.solid, Solid::Mesh(_)) && !self.0.solid.is_flat()
    }

    /// The convex solid; `None` for a mesh and for a flat shape. A segment's is a little larger than it: see [`Convex::pieces`].
    #[inline]
    pub fn convex(&self) -> Option<Convex<'static>> {
        let Inner { solid, number, .. } = &*self.0;
        match solid {
            Solid::Box { size } => Some(Convex::cuboid(*size, &self.placement())),
            _ if !self.is_convex() => None,
            _ => store::hull(number, || convex(solid, &self.placement())).map(Convex::Coarse),
        }
    }

    /// The coarse mesh as triangles in the world.
    pub fn world_mesh(&self) -> WorldMesh {
        let (Inner { solid, number, .. }, placement) = (&*self.0, self.placement());
        let compute = || match (solid, self.convex()) {
            (Solid::Mesh(mesh), _) => Ok(mesh.placed(|p| placement.apply(p))),
            (solid, _) if solid.is_flat() => {
                flat::plate(solid, flat::COARSE).map(|mesh| mesh.map(|p| placement.apply(p)))
            }
            (_, Some(convex)) => {
                TriMesh::new(convex.vertices().to_vec(), convex.topology().triangles.clone())
            }
            (_, None) => Err(GeomError::new("bad-shape", "a solid without geometry")),
        };
        store::mesh(number, || compute().expect("the same numbers gave a mesh when the shape was made"))
    }

    /// Smallest length of the solid: the scale of the tolerance between touching and overlapping.
    pub fn thickness(&self) -> f64 {
        let e = self.0.aabb.extent();
        let boxed = e.x.min(e.y).min(e.z);
        match &self.0.solid {
            Solid::Box { size } => boxed.min(size.x.min(size.y).min(size.z)),
            _ => boxed.min(self.0.width),
        }
    }
}

fn kind(solid: &Solid) -> &'static str {
    match solid {
        Solid::Box { .. } => "box",
        Solid::TaperedBox { .. } => "tapered-box",
        Solid::Cylinder { .. } => "cylinder",
        Solid::TaperedCylinder { .. } => "tapered-cylinder",
        Solid::Limb { .. } => "limb",
        Solid::Segment(_) => "segment",
        Solid::Mesh(_) => "mesh",
        Solid::Stroke { .. } => "stroke",
        Solid::Ellipse { .. } => "ellipse",
    }
}

fn bad<T>(message: String) -> Result<T, GeomError> {
    Err(GeomError::new("bad-shape", message))
}

fn check_solid(solid: &Solid) -> Result<(), GeomError> {
    let positive = |what: &str, x: f64| match x > 0.0 && x.is_finite() {
        true => Ok(()),
        false => bad(format!("the {what} of a {} is {x}, expected a positive number", kind(solid))),
    };
    let not_negative = |what: &str, x: f64| if x == 0.0 { Ok(()) } else { positive(what, x) };
    let polygon = |sides: usize| match (3..=1024).contains(&sides) {
        true => Ok(()),
        false => bad(format!("a {} has {sides} sides, expected 3 to 1024", kind(solid))),
    };
    let sized = |size: Vec3| size.to_array().into_iter().try_for_each(|s| positive("size", s));
    let finite = |what: &str, p: Vec3| match p.is_finite() {
        true => Ok(()),
        false => bad(format!("the {what} is {:?}, expected finite numbers", p.to_array())),
    };
    let unit = |what: &str, v: Vec3| match (v.norm() - 1.0).abs() < 1e-6 {
        true => Ok(()),
        false => bad(format!("the {what} is {:?}, expected a direction of length 1", v.to_array())),
    };
    match solid {
        Solid::Box { size } => sized(*size),
        Solid::TaperedBox { size, taper } => sized(*size).and_then(|()| not_negative("taper", *taper)),
        Solid::Cylinder { radius, length, sides } => {
            positive("radius", *radius)?;
            positive("length", *length)?;
            polygon(*sides)
        }
        Solid::TaperedCylinder { radius, top_radius, length, sides } => {
            positive("radius", *radius)?;
            not_negative("top radius", *top_radius)?;
            positive("length", *length)?;
            polygon(*sides)
        }
        Solid::Limb { rings, sides } => {
            for ring in rings.iter() {
                positive("radius", ring.radius)?;
                finite("centre of an end of a limb", ring.center)?;
                unit("normal of an end of a limb", ring.normal)?;
            }
            polygon(*sides)
        }
        Solid::Segment(tube) => {
            for frame in &tube.frames() {
                positive("radius", frame.radius)?;
                finite("centre of a segment's frame", frame.center)?;
                unit("forward direction of a segment's frame", frame.forward)?;
                unit("up direction of a segment's frame", frame.up)?;
                let slant = frame.forward.dot(frame.up).abs();
                if slant.is_nan() || slant > 1e-6 {
                    let [forward, up] = [frame.forward, frame.up].map(Vec3::to_array);
                    return bad(format!(
                        "the directions of a segment's frame are {forward:?} and {up:?}, expected a right angle between them"
                    ));
                }
            }
            tube.onto().map_or(Ok(()), |bark| {
                positive("parent's radius", bark.low_radius)?;
                positive("parent's radius", bark.high_radius)
            })
        }
        Solid::Mesh(_) => Ok(()),
        Solid::Stroke { ends } => ends.iter().try_for_each(|end| {
            positive("radius", end.radius)?;
            finite("end of a stroke", end.center)
        }),
        Solid::Ellipse { size } => size.iter().try_for_each(|s| positive("size", *s)),
    }
}

//! Shapes: a solid, its place and its look. A shape never changes, and reference counts share it.
//!
//! Scores use the coarse mesh of its solid. Its hull is computed with the shape, but a store keeps it
//! ([`crate::store`]). Pictures and files show the fine mesh of the same solid.

use super::cut::{Cut, Operation};
use super::measured::{Form, Tone, no_inside};
use super::{Cuboid, Solid, surface};
use crate::bounds::Aabb;
use crate::convex::{Convex, is_aligned};
use crate::error::{GeomError, bad_shape};
use crate::fine::FineMesh;
use crate::look::{Look, Paint};
use crate::mesh::TriMesh;
use crate::once::Once;
use crate::placement::Placement;
use crate::store::{self, Number, WorldMesh};
use crate::vector::{Mat3, Vec3};
use serde::{Deserialize, Serialize};
use std::rc::Rc;
use std::sync::Arc;

/// The data of a shape. They must be small: a population of particles has millions of shapes.
#[derive(Debug)]
struct Inner {
    solid: Solid,
    translation: Vec3,
    /// The rotation; `None` for the identity, to the bit.
    rotation: Option<Box<Mat3>>,
    /// The paint; `None` for an empty look.
    paint: Option<Box<Paint>>,
    /// The smallest box around the coarse mesh; of a cut, around its solids.
    aabb: Aabb,
    /// The thickness of the hull; infinite for a box and a mesh.
    width: f64,
    /// The number of its geometry in a store; no number for a box.
    number: Number,
}

// With the counters in front of it, the size is 160 bytes, which is a size class of allocators.
const _: () = assert!(std::mem::size_of::<Inner>() <= 144);

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
    #[serde(default, skip_serializing_if = "Option::is_none")]
    material: Option<Arc<str>>,
}

impl TryFrom<Plain> for Shape {
    type Error = GeomError;

    fn try_from(plain: Plain) -> Result<Shape, GeomError> {
        let Plain { solid, placement, bevel, color, metalness, roughness, material } = plain;
        Shape::new(solid, placement, &Look { rotation: None, bevel, color, metalness, roughness, material })
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
            material: shape.0.paint().material.clone(),
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

/// True unless the rotation is the identity, to the bit.
#[inline]
fn is_turned(rotation: &Mat3) -> bool {
    // Without jumps: the numbers were just computed, and a comparison of memory would wait until they are there.
    let differing = |a: Vec3, b: Vec3| {
        let bits = |x: f64, y: f64| x.to_bits() ^ y.to_bits();
        bits(a.x, b.x) | bits(a.y, b.y) | bits(a.z, b.z)
    };
    let [a, b, c] = rotation.columns;
    let [x, y, z] = Mat3::IDENTITY.columns;
    differing(a, x) | differing(b, y) | differing(c, z) != 0
}

impl Shape {
    /// Places `solid` in the world and computes the data for scores. It ignores the rotation of the look.
    ///
    /// # Errors
    /// `bad-shape` for sizes that are not positive and finite, a placement that is not a rotation, a flat limb, or a look
    /// that is out of range.
    pub fn new(solid: Solid, placement: Placement, look: &Look) -> Result<Shape, GeomError> {
        Shape::painted(solid, placement, Paint::of(look)?)
    }

    fn painted(solid: Solid, placement: Placement, paint: Option<Box<Paint>>) -> Result<Shape, GeomError> {
        solid.check()?;
        placement.check()?;
        // The solids of a cut are in the world, so that they keep their numbers and their places for gradients.
        let (solid, placement) = match solid {
            Solid::Cut(cut) if placement != Placement::IDENTITY => {
                (Solid::Cut(Arc::new(cut.placed(&placement)?)), Placement::IDENTITY)
            }
            solid => (solid, placement),
        };
        let (mut width, mut number) = (f64::INFINITY, Number::NONE);
        let aabb = match solid.form() {
            Form::Box | Form::Flat => solid.aabb(&placement)?,
            Form::Mesh => {
                number = Number::new();
                match &solid {
                    // Many cuts are only parts of other cuts: nobody asks for their surfaces.
                    Solid::Cut(cut) => {
                        surface::check(cut)?;
                        cut.around_solids()
                    }
                    solid => solid.aabb(&placement)?,
                }
            }
            Form::Convex => {
                let Some(hull) = solid.hull(&placement) else { return no_inside(solid.kind()) };
                (width, number) = (hull.width(), Number::new());
                let aabb = Aabb::around(hull.corners().iter().copied());
                store::keep_hull(&number, Rc::new(hull));
                aabb
            }
        };
        // Beyond this length, squares and products of lengths lose too many digits.
        let reach = aabb.union(&Aabb { low: Vec3::ZERO, high: Vec3::ZERO }).extent().norm();
        if reach.is_nan() || reach > 1e12 {
            return bad_shape("the shape is farther than 1e12 from the origin".to_string());
        }
        let Placement { rotation, translation } = placement;
        let rotation = is_turned(&rotation).then(|| Box::new(rotation));
        Ok(Shape(Arc::new(Inner { solid, translation, rotation, paint, aabb, width, number })))
    }

    /// Applies an operation to two solids. The look is that of the first, without its bevel.
    ///
    /// # Errors
    /// `bad-shape` for a flat shape, too many solids, and if nothing is left.
    pub fn combined(operation: Operation, a: &Shape, b: &Shape) -> Result<Shape, GeomError> {
        let cut = Cut::new(operation, a, b)?;
        Shape::new(Solid::Cut(Arc::new(cut)), Placement::IDENTITY, &Look { bevel: None, ..a.look() })
    }

    /// The tree of a cut; `None` for any other shape.
    pub fn cut(&self) -> Option<&Cut> {
        match &self.0.solid {
            Solid::Cut(cut) => Some(cut),
            _ => None,
        }
    }

    /// The solids of a cut, in the world; of any other shape, itself.
    pub fn leaves(&self) -> &[Shape] {
        self.cut().map_or(std::slice::from_ref(self), Cut::solids)
    }

    /// The coats of paint: shapes of one look each, which together look like this one. A face of a cut has the look of its
    /// solid if that has a colour, and that of the cut if not.
    pub fn coats(&self) -> Vec<Shape> {
        let Some(cut) = self.cut() else { return vec![self.clone()] };
        let mut coats: Vec<(Look, Vec<usize>)> = Vec::new();
        for (leaf, solid) in cut.solids().iter().enumerate() {
            let look = if solid.color().is_some() { solid.look() } else { self.look() };
            let look = Look { bevel: None, ..look };
            match coats.iter_mut().find(|(known, _)| *known == look) {
                Some((_, leaves)) => leaves.push(leaf),
                None => coats.push((look, vec![leaf])),
            }
        }
        let coat = |(look, leaves): &(Look, Vec<usize>)| {
            let shown = Solid::Cut(Arc::new(cut.showing(leaves.clone())));
            Shape::new(shown, Placement::IDENTITY, look).expect("the cut with another look")
        };
        match &coats[..] {
            [(look, _)] if *look == self.look() => vec![self.clone()],
            coats => coats.iter().map(coat).collect(),
        }
    }

    /// The places among its [`Shape::leaves`] of the solids whose faces pictures show.
    pub fn shown(&self) -> Vec<usize> {
        (0..self.leaves().len()).filter(|leaf| self.cut().is_none_or(|cut| cut.shows(*leaf))).collect()
    }

    /// The look, without the rotation, which is in the placement.
    fn look(&self) -> Look {
        Look {
            rotation: None,
            bevel: self.bevel(),
            color: self.color(),
            metalness: self.metalness(),
            roughness: self.roughness(),
            material: self.0.paint().material.clone(),
        }
    }

    /// The shape in a frame, whose matrix is a rotation, or a rotation after a reflection. The frame moves the shape; it does not
    /// change its measures.
    ///
    /// # Errors
    /// `bad-shape` for a frame that is neither, or that moves the shape too far away.
    pub fn in_frame(&self, frame: &Placement) -> Result<Shape, GeomError> {
        if let Some(cut) = self.cut() {
            let solid = Solid::Cut(Arc::new(cut.placed(frame)?));
            return Shape::painted(solid, Placement::IDENTITY, self.0.paint.clone());
        }
        let [a, b, c] = frame.rotation.columns;
        let mut inner = self.placement();
        let mut solid = self.solid().clone();
        if a.cross(b).dot(c) < 0.0 {
            // The reflection goes into the solid, so that a rotation remains.
            solid = solid.mirrored();
            inner.rotation.columns[0] = -inner.rotation.columns[0];
        }
        let mut placement = frame.after(&inner);
        // Adding zero turns -0.0 into 0.0, so that a shape that is not turned is found to be so.
        placement.rotation.columns = placement.rotation.columns.map(|column| column + Vec3::ZERO);
        Shape::painted(solid, placement, self.0.paint.clone())
    }

    /// The solid, in its own coordinates.
    pub fn solid(&self) -> &Solid {
        &self.0.solid
    }

    /// The placement.
    #[inline]
    pub fn placement(&self) -> Placement {
        self.0.placement()
    }

    /// The rotation, which precedes the move.
    #[inline]
    pub fn rotation(&self) -> &Mat3 {
        self.0.rotation()
    }

    /// The move, scene units.
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

    /// Metalness, from 0 (paint, wood, stone) to 1 (metal).
    pub fn metalness(&self) -> Option<f32> {
        Some(self.0.paint().finish[0]).filter(|share| !share.is_nan())
    }

    /// Roughness, from 0 (a mirror) to 1 (chalk).
    pub fn roughness(&self) -> Option<f32> {
        Some(self.0.paint().finish[1]).filter(|share| !share.is_nan())
    }

    /// The name of the material.
    pub fn material(&self) -> Option<&str> {
        self.0.paint().material.as_deref()
    }

    /// The shape with the colour and the surface of `look` where it has none of its own.
    ///
    /// # Errors
    /// `bad-shape` for a look that is out of range.
    pub fn worn(&self, look: &Look) -> Result<Shape, GeomError> {
        let Some(coat) = Paint::of(look)? else { return Ok(self.clone()) };
        let paint = self.0.paint().over(&coat, self.0.solid.is_flat());
        if paint == *self.0.paint() {
            return Ok(self.clone());
        }
        let Inner { solid, translation, rotation, aabb, width, number, .. } = &*self.0;
        let copy = match solid.form() {
            Form::Box | Form::Flat => Number::NONE,
            Form::Mesh | Form::Convex => Number::new(),
        };
        if solid.form() == Form::Convex
            && let Some(hull) = store::hull(number, || solid.hull(&self.placement()))
        {
            store::keep_hull(&copy, hull);
        }
        Ok(Shape(Arc::new(Inner {
            solid: solid.clone(),
            translation: *translation,
            rotation: rotation.clone(),
            paint: Some(Box::new(paint)),
            aabb: *aabb,
            width: *width,
            number: copy,
        })))
    }

    /// The kind of the solid: one of [`super::KINDS`].
    pub fn kind(&self) -> &'static str {
        self.0.solid.kind()
    }

    /// The tone without a colour; of a cut, that of its first solid.
    pub fn tone(&self) -> Tone {
        self.cut().map_or(self, Cut::base).0.solid.tone()
    }

    /// The address in memory, which is unique while the shape exists.
    #[inline]
    pub fn address(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }

    /// True if there is another reference to it.
    #[inline]
    pub fn is_shared(&self) -> bool {
        Arc::strong_count(&self.0) > 1
    }

    /// Its bytes, with the triangles of a mesh. Its geometry is in stores of limited size, and does not count.
    pub fn bytes(&self) -> usize {
        let turned = self.0.rotation.as_ref().map_or(0, |_| size_of::<Mat3>());
        let painted = self.0.paint.as_ref().map_or(0, |_| size_of::<Paint>());
        16 + size_of::<Inner>() + turned + painted + self.0.solid.bytes()
    }

    /// The smallest box around the coarse mesh, world space; for a flat shape, around the outline.
    #[inline]
    pub fn aabb(&self) -> &Aabb {
        match &self.0.solid {
            Solid::Cut(cut) => self.around_surface(cut),
            _ => &self.0.aabb,
        }
    }

    /// The box of a cut.
    #[inline(never)]
    fn around_surface<'a>(&self, cut: &'a Cut) -> &'a Aabb {
        cut.aabb.once(|| self.world_mesh().aabb())
    }

    /// True for a box whose sides are exactly the coordinate directions: it is its [`Shape::aabb`].
    #[inline]
    pub fn is_aligned_box(&self) -> bool {
        let turned = || self.0.rotation.as_deref().is_some_and(|rotation| !is_aligned(rotation));
        matches!(self.0.solid, Solid::Box(_)) && !turned()
    }

    /// True for a box and a convex solid; flat shapes are treated as the meshes of their plates.
    #[inline]
    pub fn is_convex(&self) -> bool {
        matches!(self.0.solid.form(), Form::Box | Form::Convex)
    }

    /// The convex solid; `None` for a solid with a mesh. For a segment it is a little larger: see [`Convex::pieces`].
    #[inline]
    pub fn convex(&self) -> Option<Convex<'static>> {
        let Inner { solid, number, .. } = &*self.0;
        match (solid, solid.form()) {
            (Solid::Box(Cuboid { size }), _) => Some(Convex::cuboid(*size, &self.placement())),
            (_, Form::Convex) => store::hull(number, || solid.hull(&self.placement())).map(Convex::Coarse),
            _ => None,
        }
    }

    /// The coarse mesh as triangles in the world.
    pub fn world_mesh(&self) -> WorldMesh {
        let (Inner { solid, number, .. }, placement) = (&*self.0, self.placement());
        let compute = || match self.convex() {
            Some(convex) => TriMesh::new(convex.vertices().to_vec(), convex.topology().triangles.clone()),
            None => solid.mesh(&placement),
        };
        store::mesh(number, || {
            compute().expect("a solid that was checked when the shape was made has a mesh")
        })
    }

    /// The mesh with many sides in the world, for pictures and files: rounded edges, round cylinders, smooth normals (the high
    /// resolution of chapter 5's figures). A flat face and a round rim share vertices where they meet, because their normals
    /// agree there.
    pub fn fine_mesh(&self) -> FineMesh {
        self.bevelled(self.bevel())
    }

    /// [`Shape::fine_mesh`], with sharp edges unless the shape has a bevel of its own.
    pub fn sharp_mesh(&self) -> FineMesh {
        self.bevelled(Some(self.bevel().unwrap_or(0.0)))
    }

    fn bevelled(&self, bevel: Option<f64>) -> FineMesh {
        let bevel = bevel.map(|bevel| bevel.clamp(0.0, 1.0));
        let (mut mesh, placement) = (self.0.solid.fine(bevel).without_unused(), self.placement());
        for p in &mut mesh.vertices {
            *p = placement.apply(*p);
        }
        for n in &mut mesh.normals {
            *n = placement.rotation.apply(*n);
        }
        mesh
    }

    /// The frame about which a person turns the shape: one of its points, and its axes.
    pub fn frame(&self) -> Placement {
        self.0.solid.frame(&self.placement())
    }

    /// Smallest length of the solid: the scale of the tolerance between touching and overlapping.
    pub fn thickness(&self) -> f64 {
        let e = self.aabb().extent();
        let boxed = e.x.min(e.y).min(e.z);
        match &self.0.solid {
            Solid::Box(Cuboid { size }) => boxed.min(size.x.min(size.y).min(size.z)),
            _ => boxed.min(self.0.width),
        }
    }
}

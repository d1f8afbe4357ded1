//! The solids, one file for each: its measures, its meshes and its word. [`Solid`] is the table of them.
//!
//! To add a solid, write a file like `cylinder.rs` (a type that is [`Measured`], and a [`word::Word`]) and a row below.
//!
//! - [`measured`]: the trait of each kind of solid
//! - [`word`]: the words of the language that make solids, as data
//! - [`shape`], [`words`], [`primitive`]: the placed solids that a model emits
//! - `plate`: flat shapes as solids
//! - [`cut`], `surface`, `leaf`, `sides`: solids cut from others

#[macro_use]
pub mod word;

pub mod arch;
pub mod cuboid;
pub mod cut;
pub mod cylinder;
pub mod ellipse;
pub mod ellipsoid;
pub mod extrusion;
pub mod hull;
mod leaf;
pub mod limb;
pub mod measured;
pub mod mesh;
mod plate;
pub mod primitive;
pub mod revolution;
pub mod segment;
pub mod shape;
mod sides;
pub mod stroke;
mod surface;
pub mod sweep;
#[cfg(test)]
pub(crate) mod testing;
pub mod torus;
pub mod wedge;
pub mod words;

use crate::bounds::Aabb;
use crate::convex::Coarse;
use crate::error::GeomError;
use crate::fine::FineMesh;
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::tube::Tube;
pub use arch::Arch;
pub use cuboid::{Cuboid, TaperedCuboid};
pub use cut::Cut;
pub use cylinder::{Cylinder, TaperedCylinder};
pub use ellipse::Ellipse;
pub use ellipsoid::Ellipsoid;
pub use extrusion::Extrusion;
pub use hull::Hull as PointHull;
pub use limb::Limb;
pub use measured::{Checks, Form, Measured, Tone};
pub use revolution::Revolution;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
pub use stroke::Stroke;
pub use sweep::Sweep;
pub use torus::Torus;
pub use wedge::Wedge;
use word::{Called, Description, Either};

/// Declares [`Solid`] and the list of words. A row is the name of the kind in stored scenes (in snake case), the type of its
/// measures, and the words that make it, each by its file. Rows are never moved: stored scenes may name a kind by its place.
macro_rules! solids {
    ($d:tt $($(#[$doc:meta])* $variant:ident($measures:ty) $([$($file:ident::$word:ident),*])?;)*) => {
        /// The solid of a shape, centred at the origin (a limb, a segment and a mesh: at their coordinates).
        #[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
        #[serde(rename_all = "snake_case")]
        pub enum Solid { $($(#[$doc])* $variant($measures),)* }

        $(impl From<$measures> for Solid {
            #[inline]
            fn from(measures: $measures) -> Solid {
                Solid::$variant(measures)
            }
        })*

        /// Every word that makes a solid, in the order of the table.
        pub const WORDS: &[Description] = &[$($($(<$file::$word<f64> as Called<f64>>::DESCRIPTION),*,)?)*];

        /// Every kind of solid, in the order of the table.
        pub const KINDS: &[&str] = &[$(<$measures as Measured>::KIND),*];

        impl Solid {
            /// Its name in messages: one of [`KINDS`].
            pub fn kind(&self) -> &'static str {
                match self { $(Solid::$variant(_) => <$measures as Measured>::KIND,)* }
            }

            /// The form of the surface.
            #[inline]
            pub fn form(&self) -> Form {
                match self { $(Solid::$variant(solid) => Measured::form(solid),)* }
            }

            /// The tone without a colour.
            pub fn tone(&self) -> Tone {
                match self { $(Solid::$variant(_) => <$measures as Measured>::TONE,)* }
            }

            /// Its bytes on the heap, with the triangles of a mesh.
            pub(crate) fn bytes(&self) -> usize {
                match self { $(Solid::$variant(solid) => Measured::bytes(solid),)* }
            }

            /// Refuses measures that no solid has.
            ///
            /// # Errors
            /// `bad-shape` for sizes that are not positive and finite, and for vectors that are no directions.
            #[inline]
            pub(crate) fn check(&self) -> Result<(), GeomError> {
                match self { $(Solid::$variant(solid) => solid.check(Checks::of::<$measures>()),)* }
            }

            /// [`Measured::hull`].
            pub(crate) fn hull(&self, placement: &Placement) -> Option<Coarse> {
                match self { $(Solid::$variant(solid) => solid.hull(placement),)* }
            }

            /// [`Measured::mesh`].
            pub(crate) fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
                match self { $(Solid::$variant(solid) => Measured::mesh(solid, placement),)* }
            }

            /// [`Measured::aabb`].
            #[inline]
            pub(crate) fn aabb(&self, placement: &Placement) -> Result<Aabb, GeomError> {
                match self { $(Solid::$variant(solid) => Measured::aabb(solid, placement),)* }
            }

            /// [`Measured::frame`].
            pub(crate) fn frame(&self, placement: &Placement) -> Placement {
                match self { $(Solid::$variant(solid) => Measured::frame(solid, placement),)* }
            }

            /// [`Measured::mirrored`].
            pub(crate) fn mirrored(&self) -> Solid {
                match self { $(Solid::$variant(solid) => Solid::$variant(Measured::mirrored(solid)),)* }
            }

            /// [`Measured::fine`].
            pub(crate) fn fine(&self, bevel: Option<f64>) -> FineMesh {
                match self { $(Solid::$variant(solid) => solid.fine(bevel),)* }
            }
        }

        /// Calls a macro with the words, each as its file and its type, before what else is given.
        #[macro_export]
        macro_rules! words_of_solids {
            ($d then:ident $d($d rest:tt)*) => { $d then! { [$($($($file $word)*)?)*] $d($d rest)* } };
        }
    };
}

solids! {
    $
    /// A box.
    Box(Cuboid) [cuboid::BoxWord];
    /// A box whose +z face is scaled about its middle.
    TaperedBox(TaperedCuboid);
    /// A prism along +y over a regular polygon.
    Cylinder(Cylinder) [cylinder::CylinderWord, cylinder::ConeWord];
    /// A cylinder with two radii.
    TaperedCylinder(TaperedCylinder);
    /// Convex hull of two rings: a bent, tapered segment.
    Limb(Limb) [limb::LimbWord];
    /// A bent, tapered tube over three rings whose base may lie on a parent's bark: see [`crate::segment`].
    Segment(Tube) [segment::SegmentWord];
    /// Any closed mesh.
    Mesh(Arc<TriMesh>) [mesh::MeshWord];
    /// Flat: a straight stroke with round ends.
    Stroke(Stroke) [stroke::StrokeWord];
    /// Flat: an ellipse on a plane parallel to z = 0.
    Ellipse(Ellipse) [ellipse::EllipseWord, ellipse::DiscWord];
    /// An ellipsoid, such as a sphere.
    Ellipsoid(Ellipsoid) [ellipsoid::SphereWord, ellipsoid::EllipsoidWord];
    /// A gable roof.
    Wedge(Wedge) [wedge::WedgeWord];
    /// A ring.
    Torus(Torus) [torus::TorusWord];
    /// A half ring on two legs.
    Arch(Arch) [arch::ArchWord];
    /// A prism over any polygon.
    Extrusion(Arc<Extrusion>) [extrusion::ExtrudeWord];
    /// What a line encloses with an axis about which it is turned.
    Revolution(Arc<Revolution>) [revolution::RevolveWord];
    /// A polygon drawn along a path.
    Sweep(Arc<Sweep>) [sweep::SweepWord];
    /// The convex hull of points.
    Hull(Arc<PointHull>) [hull::HullWord];
    /// A solid cut from others, by operators.
    Cut(Arc<Cut>);
}

impl Solid {
    /// True for a shape on a plane parallel to z = 0; in space it is a thin plate.
    pub fn is_flat(&self) -> bool {
        self.form() == Form::Flat
    }
}

impl<A: Into<Solid>, B: Into<Solid>> From<Either<A, B>> for Solid {
    #[inline]
    fn from(solid: Either<A, B>) -> Solid {
        match solid {
            Either::Plain(solid) => solid.into(),
            Either::Other(solid) => solid.into(),
        }
    }
}

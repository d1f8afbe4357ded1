//! The words of the language that make solids: their parameters as data, and the reading of their calls.
//!
//! `word!` declares a word: its parameters with their kinds ([`kinds`]), defaults and texts of the manual. `make words` writes
//! Python's functions, stubs and pages from these descriptions; the machine reads calls by them.

use crate::error::GeomError;
use crate::look::Look;
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::tube::{Bark, Frame};
use crate::vector::{Mat3, Vec3};
use niwaki_math::Parameter;
use niwaki_math::Scalar;
use std::sync::Arc;

/// A word as data.
#[derive(Clone, Copy, Debug)]
pub struct Description {
    /// The name in the language.
    pub name: &'static str,
    /// The description for the manual.
    pub doc: &'static str,
    /// The parameters without those of the look.
    pub measures: &'static [Parameter],
    /// The parameters of the look, which come last.
    pub look: &'static [Parameter],
}

impl Description {
    /// All parameters, in order.
    pub fn parameters(&self) -> impl Iterator<Item = &'static Parameter> + use<> {
        self.measures.iter().chain(self.look)
    }

    /// The number of required parameters, and the number of all.
    pub const fn counts(&self) -> (usize, usize) {
        let mut needed = 0;
        while needed < self.measures.len() && self.measures[needed].default.is_none() {
            needed += 1;
        }
        (needed, self.measures.len() + self.look.len())
    }
}

/// The arguments of a call, by place. Implementations make the faults of wrong arguments.
pub trait Arguments<S: Scalar> {
    /// The fault of an argument that cannot be read.
    type Fault;
    /// False for an argument that is absent or None.
    fn is_given(&self, at: usize) -> bool;
    /// A number.
    fn real(&self, at: usize) -> Result<S, Self::Fault>;
    /// A point or a direction, of three numbers.
    fn three(&self, at: usize) -> Result<[S; 3], Self::Fault>;
    /// The rows of a rotation.
    fn rows(&self, at: usize) -> Result<[[S; 3]; 3], Self::Fault>;
    /// The coordinate that a letter names: 0, 1 or 2.
    fn letter(&self, at: usize) -> Result<usize, Self::Fault>;
    /// A text: which of `words` it is.
    fn one_of(&self, at: usize, words: &[&str]) -> Result<usize, Self::Fault>;
    /// A text.
    fn text(&self, at: usize) -> Result<Arc<str>, Self::Fault>;
    /// A colour: three numbers, or a name.
    fn color(&self, at: usize) -> Result<[f32; 3], Self::Fault>;
    /// A letter, or a direction of any length.
    fn axis(&self, at: usize) -> Result<[S; 3], Self::Fault>;
    /// A frame of a segment, and its middle.
    fn frame(&self, at: usize) -> Result<([S; 3], Frame), Self::Fault>;
    /// The bark below a segment.
    fn bark(&self, at: usize) -> Result<Bark, Self::Fault>;
    /// Points of space, of three numbers each.
    fn points(&self, at: usize) -> Result<Vec<[S; 3]>, Self::Fault>;
    /// Points of a plane, of two numbers each.
    fn pairs(&self, at: usize) -> Result<Vec<[S; 2]>, Self::Fault>;
    /// A mesh: its vertices are at this place, its faces at the next.
    fn mesh(&self, at: usize) -> Result<Arc<TriMesh>, Self::Fault>;
}

/// A call of a word: `word!` implements it from the declaration.
pub trait Called<S: Scalar>: Sized {
    /// The word as data.
    const DESCRIPTION: Description;

    /// The arguments of a call, in order.
    ///
    /// # Errors
    /// The fault of the first argument that is missing or of another kind.
    fn read<A: Arguments<S>>(arguments: &A) -> Result<Self, A::Fault>;

    /// Colour and surface, without a rotation, which is a parameter of its own.
    fn look(&self) -> &Look;
}

/// The solid of a word.
pub trait Word<S: Scalar>: Called<S> {
    /// The kind of solid, or [`Either`] of two.
    type Solid;

    /// The solid and its placement; [`plain`] gives the numbers of arguments. [`super::Measured::check`] checks measures later:
    /// this function only checks values that the solid would lose.
    ///
    /// # Errors
    /// `bad-shape`.
    fn solid(&self) -> Result<(Self::Solid, Placement), GeomError>;

    /// The position for gradients: the middle and three directions, some of which may be zero, as functions of the arguments. A
    /// point that is fixed to the shape is the middle plus a sum of these. [`turned`] and [`between`] suit most words.
    fn at(&self) -> [[S; 3]; 4];
}

/// A solid of one of two kinds.
#[derive(Clone, Debug)]
pub enum Either<A, B> {
    /// The plain kind.
    Plain(A),
    /// The other kind.
    Other(B),
}

/// A point or sizes as plain numbers.
pub fn plain<S: Scalar>(three: [S; 3]) -> Vec3 {
    Vec3::from(three.map(Scalar::value))
}

/// A direction of length 1; `name` names it in a message.
///
/// # Errors
/// `bad-shape` for a vector without direction.
pub fn direction(v: Vec3, name: &str) -> Result<Vec3, GeomError> {
    let message = || format!("the {name} is {:?}, expected a direction", v.to_array());
    v.unit().ok_or_else(|| GeomError::new("bad-shape", message()))
}

/// The placement around `center`: laid along the axis, then turned by `rotation`.
pub fn placed<S: Scalar>(center: [S; 3], laid: Mat3, rotation: Option<[[S; 3]; 3]>) -> Placement {
    let turn = rotation.map(|rows| Mat3::from_rows(rows.map(|row| row.map(Scalar::value))));
    Placement { rotation: turn.map_or(laid, |turn| turn.after(&laid)), translation: plain(center) }
}

/// The rows of a rotation, or of none.
fn rows<S: Scalar>(rotation: Option<[[S; 3]; 3]>) -> [[S; 3]; 3] {
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    rotation.unwrap_or_else(|| unit.map(|row| row.map(S::from_f64)))
}

/// The position of a turned solid: the directions of the coordinates times `size`.
pub fn turned<S: Scalar>(center: [S; 3], rotation: Option<[[S; 3]; 3]>, size: [S; 3]) -> [[S; 3]; 4] {
    let rotation = rows(rotation);
    let along = |j: usize| [0, 1, 2].map(|i| rotation[i][j] * size[j]);
    [center, along(0), along(1), along(2)]
}

/// The images of the coordinate directions, which `laid` and then `rotation` turn.
pub fn images<S: Scalar>(laid: Mat3, rotation: Option<[[S; 3]; 3]>) -> [[S; 3]; 3] {
    let rotation = rows(rotation);
    laid.columns.map(|column| {
        let [x, y, z] = column.to_array().map(S::from_f64);
        rotation.map(|row| row[0] * x + row[1] * y + row[2] * z)
    })
}

/// Around `center` along `axis` (any length), then turned: the only direction is the axis, `length` long.
pub fn laid_along<S: Scalar>(
    center: [S; 3],
    axis: [S; 3],
    rotation: Option<[[S; 3]; 3]>,
    length: S,
) -> [[S; 3]; 4] {
    let norm = axis.iter().fold(S::from_f64(0.0), |sum, x| sum + *x * *x).sqrt();
    let (zero, scale) = ([S::from_f64(0.0); 3], length / norm);
    [
        center,
        zero,
        rows(rotation).map(|row| (row[0] * axis[0] + row[1] * axis[1] + row[2] * axis[2]) * scale),
        zero,
    ]
}

/// The position between two points: the middle, and the direction from `start` to `end`.
pub fn between<S: Scalar>(start: [S; 3], end: [S; 3]) -> [[S; 3]; 4] {
    let (half, zero) = (S::from_f64(0.5), [S::from_f64(0.0); 3]);
    let along = [0, 1, 2].map(|k| end[k] - start[k]);
    [[0, 1, 2].map(|k| start[k] + half * along[k]), zero, along, zero]
}

/// The position of points of a plane at a height of their own, in the box around them: the middle of the box, and its sides. They
/// are placed as `lie` says: the images of their two coordinates and of the height.
pub fn boxed<S: Scalar>(pairs: &[[S; 2]], height: [S; 2], center: [S; 3], lie: [[S; 3]; 3]) -> [[S; 3]; 4] {
    let ends = |k: usize| {
        let mut numbers = pairs.iter().map(|pair| pair[k]);
        let first = numbers.next().unwrap_or(S::from_f64(0.0));
        numbers.fold([first, first], |[low, high], x| [low.min(x), high.max(x)])
    };
    let sides = [ends(0), ends(1), height];
    let half = S::from_f64(0.5);
    let middle = [0, 1, 2]
        .map(|i| (0..3).fold(center[i], |sum, k| sum + lie[k][i] * (half * (sides[k][0] + sides[k][1]))));
    let along = |k: usize| lie[k].map(|x| x * (sides[k][1] - sides[k][0]));
    [middle, along(0), along(1), along(2)]
}

/// The position of given points: their mean, and three sums of their distances from it. The weights of the sums depend on nothing but
/// the numbers of the points, and have no pattern. So whatever moves, turns or stretches all points does the same with the position.
pub fn spread<S: Scalar>(points: &[[S; 3]]) -> [[S; 3]; 4] {
    // The plastic number of three dimensions: multiples of its powers fill a cube evenly (Roberts 2018).
    const ROOTS: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3];
    let share = S::from_f64(1.0 / points.len().max(1) as f64);
    let sum = |weight: &dyn Fn(usize) -> S, of: &dyn Fn([S; 3]) -> [S; 3]| {
        points.iter().enumerate().fold([S::from_f64(0.0); 3], |sum, (k, p)| {
            let (weight, p) = (weight(k), of(*p));
            [0, 1, 2].map(|i| sum[i] + weight * p[i])
        })
    };
    let mean = sum(&|_| share, &|p| p);
    let away = |p: [S; 3]| [0, 1, 2].map(|i| p[i] - mean[i]);
    let along = |root: f64| sum(&|k| S::from_f64((k as f64 * root).fract() - 0.5), &away);
    [mean, along(ROOTS[0]), along(ROOTS[1]), along(ROOTS[2])]
}

/// Kinds of parameters: the type of an argument in a call, and its reading. An `Option` of a kind may be absent.
pub mod kinds {
    use super::{Arc, Arguments, Bark, Frame, Scalar, TriMesh};

    /// A kind of parameter.
    pub trait Kind {
        /// An argument of this kind.
        type Of<S: Scalar>;
        /// The default in a declaration.
        type Default;
        /// The type in Python, without ` | None`.
        const PYTHON: &'static str;
        /// True if it may always be absent.
        const OPTIONAL: bool = false;

        /// The argument at a place.
        ///
        /// # Errors
        /// The fault of an argument that is missing or of another kind.
        fn read<S: Scalar, A: Arguments<S>>(arguments: &A, at: usize) -> Result<Self::Of<S>, A::Fault>;

        /// The argument of a default.
        fn default<S: Scalar>(default: Self::Default) -> Self::Of<S>;
    }

    /// The argument at a place, or its default.
    #[inline]
    pub fn read_or<K: Kind, S: Scalar, A: Arguments<S>>(
        arguments: &A,
        at: usize,
        default: Option<K::Default>,
    ) -> Result<K::Of<S>, A::Fault> {
        match default {
            Some(default) if !arguments.is_given(at) => Ok(K::default(default)),
            _ => K::read(arguments, at),
        }
    }

    /// A measure whose sign decides about the solid. A recording holds only while the sign stays, and the comparison records
    /// this.
    #[inline]
    fn signed<S: Scalar>(measure: S) -> S {
        let _ = measure > S::from_f64(0.0);
        measure
    }

    /// Declares a kind.
    macro_rules! kind {
        ($(#[$doc:meta])* $kind:ident $python:literal [$($of:tt)*] $default:ty, |$d:pat_param| $made:expr, |$arguments:ident, $at:ident| $read:expr) => {
            $(#[$doc])*
            #[derive(Clone, Copy, Debug)]
            pub enum $kind {}

            impl Kind for $kind {
                type Of<S: Scalar> = $($of)*;
                type Default = $default;
                const PYTHON: &'static str = $python;

                #[inline]
                fn read<S: Scalar, A: Arguments<S>>($arguments: &A, $at: usize) -> Result<Self::Of<S>, A::Fault> {
                    $read
                }

                fn default<S: Scalar>($d: $default) -> Self::Of<S> {
                    $made
                }
            }
        };
    }

    /// No value: the default of a parameter that can never be absent.
    #[derive(Clone, Copy, Debug)]
    pub enum Never {}

    kind! {
        /// A point or a direction.
        Point "VecLike" [[S; 3]] (f64, f64, f64), |(x, y, z)| [x, y, z].map(S::from_f64), |arguments, at| arguments.three(at)
    }
    kind! {
        /// Three lengths.
        Lengths "VecLike" [[S; 3]] Never, |never| match never {}, |arguments, at| Ok(arguments.three(at)?.map(signed))
    }
    kind! {
        /// A length, a width or a factor of them.
        Length "float" [S] f64, |length| S::from_f64(length), |arguments, at| arguments.real(at).map(signed)
    }
    kind! {
        /// Any number, such as an angle.
        Number "float" [S] f64, |number| S::from_f64(number), |arguments, at| arguments.real(at)
    }
    kind! {
        /// The rows of a rotation.
        Turn "Rotation" [[[S; 3]; 3]] Never, |never| match never {}, |arguments, at| arguments.rows(at)
    }
    kind! {
        /// The letter of a coordinate, as its number.
        Letter "str" [usize] &'static str, |letter| coordinate(letter), |arguments, at| arguments.letter(at)
    }
    kind! {
        /// A direction of any length, or a letter.
        Axis "Axis" [[S; 3]] &'static str,
        |letter| std::array::from_fn(|k| S::from_f64(f64::from(k == coordinate(letter)))),
        |arguments, at| arguments.axis(at)
    }
    kind! {
        /// A frame of a segment, and its middle.
        Framed "Frame" [([S; 3], Frame)] Never, |never| match never {}, |arguments, at| arguments.frame(at)
    }
    kind! {
        /// The bark below a segment.
        Barked "Bark" [Bark] Never, |never| match never {}, |arguments, at| arguments.bark(at)
    }
    kind! {
        /// Points of space.
        Points "Points" [Vec<[S; 3]>] Never, |never| match never {}, |arguments, at| arguments.points(at)
    }
    kind! {
        /// Points of a plane.
        Pairs "Pairs" [Vec<[S; 2]>] Never, |never| match never {}, |arguments, at| arguments.pairs(at)
    }
    kind! {
        /// The vertices of a mesh, and its faces, which are the next parameter.
        Vertices "Any" [Arc<TriMesh>] Never, |never| match never {}, |arguments, at| arguments.mesh(at)
    }
    kind! {
        /// The faces of a mesh, which were read with its vertices.
        Faces "Any" [()] Never, |never| match never {}, |_arguments, _at| Ok(())
    }
    kind! {
        /// A colour.
        Color "Color" [[f32; 3]] Never, |never| match never {},
        |arguments, at| arguments.color(at)
    }
    kind! {
        /// The name of a material.
        Material "str" [Arc<str>] Never, |never| match never {}, |arguments, at| arguments.text(at)
    }
    kind! {
        /// The word "round": a joint at which limbs may bend.
        Joint "str" [()] Never, |never| match never {},
        |arguments, at| arguments.one_of(at, &["round"]).map(|_| ())
    }
    kind! {
        /// A number from 0 to 1.
        Share "float" [f32] Never, |never| match never {}, |arguments, at| {
            let share = arguments.real(at)?;
            let _ = share > S::from_f64(1.0);
            Ok(signed(share).value() as f32)
        }
    }

    /// 0, 1 or 2 for x, y or z; 3 for any other letter.
    fn coordinate(letter: &str) -> usize {
        ["x", "y", "z"].iter().position(|other| *other == letter).unwrap_or(3)
    }

    impl<K: Kind> Kind for Option<K> {
        type Of<S: Scalar> = Option<K::Of<S>>;
        type Default = Never;
        const PYTHON: &'static str = K::PYTHON;
        const OPTIONAL: bool = true;

        #[inline]
        fn read<S: Scalar, A: Arguments<S>>(arguments: &A, at: usize) -> Result<Self::Of<S>, A::Fault> {
            if arguments.is_given(at) { K::read(arguments, at).map(Some) } else { Ok(None) }
        }

        fn default<S: Scalar>(never: Never) -> Self::Of<S> {
            match never {}
        }
    }
}

/// The looks at the end of a declaration.
pub mod looks {
    use super::kinds::{Color, Kind, Length, Material, Share};
    use super::{Arguments, Look, Parameter, Scalar};

    const COLOR: Parameter =
        optional::<Color>("color", "`(r, g, b)` in [0, 1], or a name such as \"tomato\" or \"#c83c1e\".");
    const METALNESS: Parameter =
        optional::<Share>("metalness", "From 0 (paint, wood, stone) to 1 (metal); 0 when left out.");
    const ROUGHNESS: Parameter =
        optional::<Share>("roughness", "From 0 (a mirror) to 1 (chalk); that of the palette when left out.");
    const MATERIAL: Parameter = optional::<Material>(
        "material",
        "The name of a material, which files keep; pictures do not show it.",
    );
    const BEVEL: Parameter = optional::<Length>(
        "bevel",
        "Rounding of the edges, drawn only: a share of half the smallest side, 0 for sharp edges.",
    );

    /// The look of a flat shape.
    pub const COLORED: &[Parameter] = &[COLOR];
    /// The look of a solid without edges to round.
    pub const PAINTED: &[Parameter] = &[COLOR, METALNESS, ROUGHNESS, MATERIAL];
    /// The look of a solid with edges.
    pub const BEVELLED: &[Parameter] = &[BEVEL, COLOR, METALNESS, ROUGHNESS, MATERIAL];

    const fn optional<K: Kind>(name: &'static str, doc: &'static str) -> Parameter {
        Parameter { name, python: K::PYTHON, default: Some("None"), doc }
    }

    /// The look in a call, from the place of its first parameter on.
    ///
    /// # Errors
    /// The fault of an argument of another kind.
    #[inline]
    pub fn read<S: Scalar, A: Arguments<S>>(
        arguments: &A,
        looks: &'static [Parameter],
        mut at: usize,
    ) -> Result<Look, A::Fault> {
        let mut look = Look::default();
        if looks.len() == BEVELLED.len() {
            look.bevel = <Option<Length>>::read(arguments, at)?.map(Scalar::value);
            at += 1;
        }
        look.color = <Option<Color>>::read(arguments, at)?;
        if looks.len() > 1 {
            look.metalness = <Option<Share>>::read(arguments, at + 1)?;
            look.roughness = <Option<Share>>::read(arguments, at + 2)?;
            look.material = <Option<Material>>::read(arguments, at + 3)?;
        }
        Ok(look)
    }
}

/// Declares a word: its name in the language, the type of its calls, its parameters, and its look.
///
/// ```text
/// word! {
///     /// The first sentences of the manual.
///     "ball" Ball {
///         /// Its middle.
///         center: Point,
///         /// Greater than 0.
///         radius: Length = 1.0,
///         /// Turns it about its middle.
///         rotation: Option<Turn>,
///         ..PAINTED
///     }
/// }
/// ```
macro_rules! word {
    ($(#[doc = $doc:literal])* $name:literal $word:ident {
        $($(#[doc = $about:literal])* $field:ident: $kind:ty $(= $default:expr)?,)*
        ..$look:ident
    }) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug)]
        pub struct $word<S: niwaki_math::Scalar> {
            $($(#[doc = $about])* pub $field: <$kind as $crate::solids::word::kinds::Kind>::Of<S>,)*
            /// Colour and surface.
            pub look: $crate::look::Look,
        }

        impl<S: niwaki_math::Scalar> $crate::solids::word::Called<S> for $word<S> {
            const DESCRIPTION: $crate::solids::word::Description = $crate::solids::word::Description {
                name: $name,
                doc: concat!($($doc, "\n"),*),
                measures: &[$(niwaki_math::Parameter {
                    name: stringify!($field),
                    python: <$kind as $crate::solids::word::kinds::Kind>::PYTHON,
                    default: if <$kind as $crate::solids::word::kinds::Kind>::OPTIONAL {
                        Some("None")
                    } else {
                        default!($(stringify!($default))?)
                    },
                    doc: concat!($($about, "\n"),*),
                }),*],
                look: $crate::solids::word::looks::$look,
            };

            #[inline]
            fn read<A: $crate::solids::word::Arguments<S>>(arguments: &A) -> Result<Self, A::Fault> {
                let mut at = 0;
                $(
                    let default = default!($($default)?);
                    let $field = $crate::solids::word::kinds::read_or::<$kind, S, A>(arguments, at, default)?;
                    at += 1;
                )*
                let look = $crate::solids::word::looks::read(arguments, $crate::solids::word::looks::$look, at)?;
                Ok($word { $($field,)* look })
            }

            fn look(&self) -> &$crate::look::Look {
                &self.look
            }
        }
    };
}

/// `Some` of a token, or `None` without one.
macro_rules! default {
    () => {
        None
    };
    ($some:expr) => {
        Some($some)
    };
}

//! The words of the language that make solids: their parameters as data, and how a call of them is read.
//!
//! `word!` declares a word: its parameters with their kinds ([`kinds`]), what is taken where one is left out, and what
//! the manual says. Python's functions, stubs and pages are written from these descriptions; the machine reads calls by them.

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
    /// Its name in the language.
    pub name: &'static str,
    /// What it makes.
    pub doc: &'static str,
    /// Its parameters without those of its look.
    pub measures: &'static [Parameter],
    /// The parameters of its look, which come last.
    pub look: &'static [Parameter],
}

impl Description {
    /// All parameters, in order.
    pub fn parameters(&self) -> impl Iterator<Item = &'static Parameter> + use<> {
        self.measures.iter().chain(self.look)
    }

    /// How many parameters must be given, and how many there are.
    pub const fn counts(&self) -> (usize, usize) {
        let mut needed = 0;
        while needed < self.measures.len() && self.measures[needed].default.is_none() {
            needed += 1;
        }
        (needed, self.measures.len() + self.look.len())
    }
}

/// The arguments of a call, by place. What is wrong with one is said by whoever holds them.
pub trait Arguments<S: Scalar> {
    /// Why an argument cannot be read.
    type Fault;
    /// False for what is left out, or None.
    fn is_given(&self, at: usize) -> bool;
    /// A number.
    fn real(&self, at: usize) -> Result<S, Self::Fault>;
    /// A point or a direction, of three numbers.
    fn three(&self, at: usize) -> Result<[S; 3], Self::Fault>;
    /// The rows of a rotation.
    fn rows(&self, at: usize) -> Result<[[S; 3]; 3], Self::Fault>;
    /// The coordinate that a letter names: 0, 1 or 2.
    fn letter(&self, at: usize) -> Result<usize, Self::Fault>;
    /// A letter, or a direction of any length.
    fn axis(&self, at: usize) -> Result<[S; 3], Self::Fault>;
    /// A frame of a segment, and its middle.
    fn frame(&self, at: usize) -> Result<([S; 3], Frame), Self::Fault>;
    /// The bark below a segment.
    fn bark(&self, at: usize) -> Result<Bark, Self::Fault>;
    /// A mesh: its vertices are at this place, its faces at the next.
    fn mesh(&self, at: usize) -> Result<Arc<TriMesh>, Self::Fault>;
}

/// A word, as it was called: what `word!` makes of its declaration.
pub trait Called<S: Scalar>: Sized {
    /// The word as data.
    const DESCRIPTION: Description;

    /// The arguments of a call, in order.
    ///
    /// # Errors
    /// That of the first argument that is missing or of another kind.
    fn read<A: Arguments<S>>(given: &A) -> Result<Self, A::Fault>;

    /// Colour and surface; its rotation is none, for that is a parameter by itself.
    fn look(&self) -> &Look;
}

/// What a word makes.
pub trait Word<S: Scalar>: Called<S> {
    /// The kind of solid, or [`Either`] of two.
    type Solid;

    /// The solid and where it is; [`plain`] gives the numbers of arguments. Measures are checked later
    /// ([`super::Measured::check`]): here only what would be lost on the way.
    ///
    /// # Errors
    /// `bad-shape`.
    fn solid(&self) -> Result<(Self::Solid, Placement), GeomError>;

    /// Where it is, for gradients: its middle and three directions, of which some may be zero, by the arguments as they
    /// came. A point that is fixed to the shape is the middle and a sum of these. [`turned`] and [`between`] suit most.
    fn at(&self) -> [[S; 3]; 4];
}

/// A solid of one of two kinds.
#[derive(Clone, Debug)]
pub enum Either<A, B> {
    /// The plain kind.
    Plain(A),
    /// The other.
    Other(B),
}

/// A point or sizes as plain numbers.
pub fn plain<S: Scalar>(three: [S; 3]) -> Vec3 {
    Vec3::from(three.map(Scalar::value))
}

/// A direction of length 1; `what` names it in a message.
///
/// # Errors
/// `bad-shape` for none.
pub fn direction(v: Vec3, what: &str) -> Result<Vec3, GeomError> {
    let message = || format!("the {what} is {:?}, expected a direction", v.to_array());
    v.unit().ok_or_else(|| GeomError::new("bad-shape", message()))
}

/// Around `center`; laid along its axis, then turned as it was given.
pub fn placed<S: Scalar>(center: [S; 3], laid: Mat3, rotation: Option<[[S; 3]; 3]>) -> Placement {
    let given = rotation.map(|rows| Mat3::from_rows(rows.map(|row| row.map(Scalar::value))));
    Placement { rotation: given.map_or(laid, |given| given.after(&laid)), translation: plain(center) }
}

/// Turned, the directions of the coordinates times `size`.
pub fn turned<S: Scalar>(center: [S; 3], rotation: Option<[[S; 3]; 3]>, size: [S; 3]) -> [[S; 3]; 4] {
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let rotation = rotation.unwrap_or_else(|| unit.map(|row| row.map(S::from_f64)));
    let along = |j: usize| [0, 1, 2].map(|i| rotation[i][j] * size[j]);
    [center, along(0), along(1), along(2)]
}

/// Around `center` along `axis` (any length), then turned: the only direction is the axis, `length` long.
pub fn laid_along<S: Scalar>(
    center: [S; 3],
    axis: [S; 3],
    rotation: Option<[[S; 3]; 3]>,
    length: S,
) -> [[S; 3]; 4] {
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let norm = axis.iter().fold(S::from_f64(0.0), |sum, x| sum + *x * *x).sqrt();
    let turn = rotation.unwrap_or_else(|| unit.map(|row| row.map(S::from_f64)));
    let (zero, scale) = ([S::from_f64(0.0); 3], length / norm);
    [center, zero, turn.map(|row| (row[0] * axis[0] + row[1] * axis[1] + row[2] * axis[2]) * scale), zero]
}

/// Between two points, and from the one to the other.
pub fn between<S: Scalar>(start: [S; 3], end: [S; 3]) -> [[S; 3]; 4] {
    let (half, zero) = (S::from_f64(0.5), [S::from_f64(0.0); 3]);
    let along = [0, 1, 2].map(|k| end[k] - start[k]);
    [[0, 1, 2].map(|k| start[k] + half * along[k]), zero, along, zero]
}

/// Kinds of parameters: the type that an argument has in a call, and how it is read. `Option` of a kind may be left out.
pub mod kinds {
    use super::{Arc, Arguments, Bark, Frame, Scalar, TriMesh};

    /// A kind of parameter.
    pub trait Kind {
        /// An argument of this kind.
        type Of<S: Scalar>;
        /// What a declaration gives for one that is left out.
        type Default;
        /// Its type in Python, without ` | None`.
        const PYTHON: &'static str;
        /// True where it may always be left out.
        const OPTIONAL: bool = false;

        /// The argument at a place.
        ///
        /// # Errors
        /// Where it is missing, or of another kind.
        fn read<S: Scalar, A: Arguments<S>>(given: &A, at: usize) -> Result<Self::Of<S>, A::Fault>;

        /// The argument that stands for one that is left out.
        fn default<S: Scalar>(default: Self::Default) -> Self::Of<S>;
    }

    /// The argument at a place, or what stands for it.
    #[inline]
    pub fn read_or<K: Kind, S: Scalar, A: Arguments<S>>(
        given: &A,
        at: usize,
        default: Option<K::Default>,
    ) -> Result<K::Of<S>, A::Fault> {
        match default {
            Some(default) if !given.is_given(at) => Ok(K::default(default)),
            _ => K::read(given, at),
        }
    }

    /// Whether there is a solid depends on the signs of its measures, so a recording holds only where the sign stays: the
    /// comparison notes that.
    #[inline]
    fn signed<S: Scalar>(measure: S) -> S {
        let _ = measure > S::from_f64(0.0);
        measure
    }

    /// Declares a kind.
    macro_rules! kind {
        ($(#[$doc:meta])* $kind:ident $python:literal [$($of:tt)*] $default:ty, |$d:pat_param| $made:expr, |$given:ident, $at:ident| $read:expr) => {
            $(#[$doc])*
            #[derive(Clone, Copy, Debug)]
            pub enum $kind {}

            impl Kind for $kind {
                type Of<S: Scalar> = $($of)*;
                type Default = $default;
                const PYTHON: &'static str = $python;

                #[inline]
                fn read<S: Scalar, A: Arguments<S>>($given: &A, $at: usize) -> Result<Self::Of<S>, A::Fault> {
                    $read
                }

                fn default<S: Scalar>($d: $default) -> Self::Of<S> {
                    $made
                }
            }
        };
    }

    /// No value: what can never be left out has no default.
    #[derive(Clone, Copy, Debug)]
    pub enum Never {}

    kind! {
        /// A point or a direction.
        Point "VecLike" [[S; 3]] (f64, f64, f64), |(x, y, z)| [x, y, z].map(S::from_f64), |given, at| given.three(at)
    }
    kind! {
        /// Three lengths.
        Lengths "VecLike" [[S; 3]] Never, |never| match never {}, |given, at| Ok(given.three(at)?.map(signed))
    }
    kind! {
        /// A length, a width or a factor of them.
        Length "float" [S] f64, |length| S::from_f64(length), |given, at| given.real(at).map(signed)
    }
    kind! {
        /// Any number, such as an angle.
        Number "float" [S] f64, |number| S::from_f64(number), |given, at| given.real(at)
    }
    kind! {
        /// The rows of a rotation.
        Turn "Rotation" [[[S; 3]; 3]] Never, |never| match never {}, |given, at| given.rows(at)
    }
    kind! {
        /// The letter of a coordinate, as its number.
        Letter "str" [usize] &'static str, |letter| coordinate(letter), |given, at| given.letter(at)
    }
    kind! {
        /// A direction of any length, or a letter.
        Axis "Axis" [[S; 3]] &'static str,
        |letter| std::array::from_fn(|k| S::from_f64(f64::from(k == coordinate(letter)))),
        |given, at| given.axis(at)
    }
    kind! {
        /// A frame of a segment, and its middle.
        Framed "Frame" [([S; 3], Frame)] Never, |never| match never {}, |given, at| given.frame(at)
    }
    kind! {
        /// The bark below a segment.
        Barked "Bark" [Bark] Never, |never| match never {}, |given, at| given.bark(at)
    }
    kind! {
        /// The vertices of a mesh, and its faces, which are the next parameter.
        Vertices "Any" [Arc<TriMesh>] Never, |never| match never {}, |given, at| given.mesh(at)
    }
    kind! {
        /// The faces of a mesh, which were read with its vertices.
        Faces "Any" [()] Never, |never| match never {}, |_given, _at| Ok(())
    }
    kind! {
        /// A colour.
        Color "Color" [[f32; 3]] Never, |never| match never {},
        |given, at| Ok(given.three(at)?.map(|part| part.value() as f32))
    }
    kind! {
        /// A number from 0 to 1.
        Share "float" [f32] Never, |never| match never {}, |given, at| {
            let share = given.real(at)?;
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
        fn read<S: Scalar, A: Arguments<S>>(given: &A, at: usize) -> Result<Self::Of<S>, A::Fault> {
            if given.is_given(at) { K::read(given, at).map(Some) } else { Ok(None) }
        }

        fn default<S: Scalar>(never: Never) -> Self::Of<S> {
            match never {}
        }
    }
}

/// The looks that a declaration of a word can end in.
pub mod looks {
    use super::kinds::{Color, Kind, Length, Share};
    use super::{Arguments, Look, Parameter, Scalar};

    const COLOR: Parameter = optional::<Color>("color", "`(r, g, b)` in [0, 1].");
    const METALNESS: Parameter =
        optional::<Share>("metalness", "From 0 (paint, wood, stone) to 1 (metal); 0 when left out.");
    const ROUGHNESS: Parameter =
        optional::<Share>("roughness", "From 0 (a mirror) to 1 (chalk); that of the palette when left out.");
    const BEVEL: Parameter = optional::<Length>("bevel", "Width of the bevelled edges, drawn only.");

    /// Of a flat shape.
    pub const COLORED: &[Parameter] = &[COLOR];
    /// Of a solid without edges to round.
    pub const PAINTED: &[Parameter] = &[COLOR, METALNESS, ROUGHNESS];
    /// Of a solid with edges.
    pub const BEVELLED: &[Parameter] = &[BEVEL, COLOR, METALNESS, ROUGHNESS];

    const fn optional<K: Kind>(name: &'static str, doc: &'static str) -> Parameter {
        Parameter { name, python: K::PYTHON, default: Some("None"), doc }
    }

    /// The look in a call, from the place of its first parameter on.
    ///
    /// # Errors
    /// That of an argument of another kind.
    #[inline]
    pub fn read<S: Scalar, A: Arguments<S>>(
        given: &A,
        looks: &'static [Parameter],
        mut at: usize,
    ) -> Result<Look, A::Fault> {
        let mut look = Look::default();
        if looks.len() == BEVELLED.len() {
            look.bevel = <Option<Length>>::read(given, at)?.map(Scalar::value);
            at += 1;
        }
        look.color = <Option<Color>>::read(given, at)?;
        if looks.len() > 1 {
            look.metalness = <Option<Share>>::read(given, at + 1)?;
            look.roughness = <Option<Share>>::read(given, at + 2)?;
        }
        Ok(look)
    }
}

/// Declares a word: its name in the language, the type of its calls, its parameters, and the look that it ends in.
///
/// ```text
/// word! {
///     /// What it makes: the first sentences of the manual.
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
                        given!($(stringify!($default))?)
                    },
                    doc: concat!($($about, "\n"),*),
                }),*],
                look: $crate::solids::word::looks::$look,
            };

            #[inline]
            fn read<A: $crate::solids::word::Arguments<S>>(given: &A) -> Result<Self, A::Fault> {
                let mut at = 0;
                $(
                    let default = given!($($default)?);
                    let $field = $crate::solids::word::kinds::read_or::<$kind, S, A>(given, at, default)?;
                    at += 1;
                )*
                let look = $crate::solids::word::looks::read(given, $crate::solids::word::looks::$look, at)?;
                Ok($word { $($field,)* look })
            }

            fn look(&self) -> &$crate::look::Look {
                &self.look
            }
        }
    };
}

/// `Some` of what is there.
macro_rules! given {
    () => {
        None
    };
    ($some:expr) => {
        Some($some)
    };
}

//! The table of the families: the name, parameters and space of values of each.
//!
//! A row holds the family's variants of [`Family`] and [`Dist`], its parameters with their texts for the manual, and its name in
//! a model. It also holds its [`Space`], a description of its draws, and the limits of its parameters. All other properties follow
//! from these by an exhaustive `match`, below the table and wherever a [`Space`] or a [`Support`] is used: so no family is left out.

use super::coordinates::Interval;
use super::draw::Draw;
use super::fields::Field;
use super::lists::{DiagonalGaussian, Multinomial};
use super::mixture::Mixture;
use super::param::Param;
use super::space::Space;
use super::support::Support;
use super::vectors::MultivariateGaussian;
use super::weights::Weights;
use crate::scalar::Scalar;
use std::fmt;
use std::sync::Arc;

/// The support of a row.
macro_rules! support {
    (Booleans) => {
        Support::Booleans
    };
    (Categories $n:expr) => {
        Support::Categories($n)
    };
    (Integers $lo:expr, $hi:expr) => {
        Support::Integers { lo: $lo, hi: $hi }
    };
    (Line $center:expr, $scale:expr) => {
        Support::Reals(Interval::LINE)
    };
    (Positive) => {
        Support::Reals(Interval { lo: Some(S::from_f64(0.0)), hi: None })
    };
    (Unit) => {
        Support::Reals(Interval { lo: Some(S::from_f64(0.0)), hi: Some(S::from_f64(1.0)) })
    };
    (Bounded $lo:expr, $hi:expr) => {
        Support::Reals(Interval { lo: $lo, hi: $hi })
    };
    (Circle) => {
        Support::Circle
    };
    (Simplex $n:expr) => {
        Support::Simplex($n)
    };
    (Vectors $n:expr, $scale:expr) => {
        Support::Vectors($n)
    };
    (Counts $n:expr) => {
        Support::Counts($n)
    };
    (Truths $n:expr) => {
        Support::Truths($n)
    };
    (Components $mixture:expr) => {
        $mixture.support()
    };
    (Fixed $value:expr) => {
        Support::of_value($value)
    };
}

/// The scale of a row.
macro_rules! scale {
    (Line $center:expr, $scale:expr) => {
        Some($scale)
    };
    (Vectors $n:expr, $scale:expr) => {
        Some($scale)
    };
    (Components $mixture:expr) => {
        $mixture.components.first()?.scale()
    };
    ($space:ident $($other:tt)*) => {
        None
    };
}

/// The center of a row.
macro_rules! center {
    (Line $center:expr, $scale:expr) => {
        Some($center)
    };
    ($space:ident $($other:tt)*) => {
        None
    };
}

/// The type of a field in Python.
macro_rules! python {
    (S) => {
        "float"
    };
    (i64) => {
        "int"
    };
}

/// The default of a field in Python.
macro_rules! default {
    () => {
        None
    };
    ($default:literal) => {
        Some(stringify!($default))
    };
}

/// The largest number of parameters of a family whose parameters are numbers.
pub const MOST_NUMBERS: usize = 4;

/// A field that is a number.
trait Number<S> {
    fn number(&self) -> f64;
}

impl<S: Scalar> Number<S> for S {
    fn number(&self) -> f64 {
        self.value()
    }
}

impl<S: Scalar> Number<S> for i64 {
    fn number(&self) -> f64 {
        *self as f64
    }
}

/// Texts of a family; the manual and Python's classes are written from them.
#[derive(Clone, Copy, Debug)]
pub struct Manual {
    /// The name of the class in Python.
    pub class: &'static str,
    /// The description of the family.
    pub doc: &'static str,
    /// The parameters, in order.
    pub parameters: &'static [Parameter],
    /// The description of a draw.
    pub gives: &'static str,
    /// The limits of the parameters; every number is finite.
    pub limits: &'static str,
}

/// A parameter of a family, or of a word of the language that makes a solid.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// The name in a call.
    pub name: &'static str,
    /// The type in Python.
    pub python: &'static str,
    /// The default value as Python writes it; none for a required parameter.
    pub default: Option<&'static str>,
    /// The text for the manual.
    pub doc: &'static str,
}

impl Parameter {
    /// The fields, in order.
    pub fn row(&self) -> (&'static str, &'static str, Option<&'static str>, &'static str) {
        (self.name, self.python, self.default, self.doc)
    }
}

/// Declares the enums of the table and their methods.
macro_rules! families {
    ($( $(#[doc = $doc:literal])* $variant:ident
        $({ $($(#[doc = $about:literal])* $field:ident: $type:ident $(= $default:literal)?,)* })?
        $(($whole:ident: $held:ty; $($(#[doc = $of:literal])* $parameter:literal: $python:literal,)*))?
        $name:literal $space:ident $(($($place:tt)*))?, $gives:literal, $limits:literal; )*) => {
        /// A family of distributions.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Family { $( $(#[doc = $doc])* $variant, )* }

        impl Family {
            /// Every family, in the order of the table.
            pub const ALL: &'static [Family] = &[$(Family::$variant),*];

            /// The name in a model.
            pub const fn name(self) -> &'static str {
                match self { $(Family::$variant => $name,)* }
            }

            /// The parameters' names, in their order.
            pub const fn parameters(self) -> &'static [&'static str] {
                match self { $(Family::$variant => &[$($(stringify!($field)),*)? $($($parameter),*)?],)* }
            }

            /// The texts for the manual and for Python.
            pub const fn manual(self) -> Manual {
                match self {
                    $(Family::$variant => Manual {
                        class: stringify!($variant),
                        doc: concat!($($doc, "\n"),*),
                        parameters: &[
                            $($(Parameter {
                                name: stringify!($field),
                                python: python!($type),
                                default: default!($($default)?),
                                doc: concat!($($about, "\n"),*),
                            }),*)?
                            $($(Parameter {
                                name: $parameter,
                                python: $python,
                                default: None,
                                doc: concat!($($of, "\n"),*),
                            }),*)?
                        ],
                        gives: $gives,
                        limits: $limits,
                    },)*
                }
            }

            /// The space of the values.
            pub const fn space(self) -> Space {
                match self { $(Family::$variant => Space::$space,)* }
            }

            /// The family of this name.
            pub fn from_name(name: &str) -> Option<Family> {
                match name { $($name => Some(Family::$variant),)* _ => None }
            }
        }

        /// A distribution with checked parameters.
        ///
        /// ```
        /// use niwaki_math::{Dist, Draw, Family, Param, Stream};
        /// let d: Dist = Dist::new(Family::Gaussian, &[Param::Int(0), Param::Real(2.0)]).unwrap();
        /// let x = d.sample(&mut Stream::new(1, 0, 0, 0));
        /// assert!(d.log_density(&x) <= d.log_density(&Draw::Real(0.0)));
        /// ```
        #[derive(Clone, Debug, PartialEq)]
        #[allow(missing_docs)] // The fields are the parameters.
        pub enum Dist<S: Scalar = f64> { $( $(#[doc = $doc])* $variant $({ $($field: $type),* })? $(($held))?, )* }

        #[allow(unused_variables)] // A space rarely needs all fields of its row.
        impl<S: Scalar> Dist<S> {
            /// The family.
            pub fn family(&self) -> Family {
                match self { $(Dist::$variant { .. } => Family::$variant,)* }
            }

            /// The parameters, in the order in which [`Dist::new`] takes them.
            pub fn params(&self) -> Vec<Param<S>> {
                match self {
                    $(Dist::$variant $({ $($field),* })? $(($whole))? => {
                        [$($($field.params()),*)? $($whole.params())?].concat()
                    })*
                }
            }

            /// Writes the parameters of a family whose parameters are numbers, and returns their number; zero for other families.
            pub fn numbers(&self, to: &mut [f64; MOST_NUMBERS]) -> usize {
                match self {
                    $(Dist::$variant $({ $($field),* })? $(($whole))? => {
                        let numbers: &[f64] = &[$($(Number::<S>::number($field)),*)?];
                        $(let _ = $whole;)?
                        to[..numbers.len()].copy_from_slice(numbers);
                        numbers.len()
                    })*
                }
            }

            /// Converts the distribution to another kind of number.
            pub fn convert<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Dist<T> {
                match self {
                    $(Dist::$variant $({ $($field),* })? $(($whole))? => {
                        Dist::$variant $({ $($field: $field.over(number)),* })? $(($whole.over(number)))?
                    })*
                }
            }

            /// The set of the values.
            pub fn support(&self) -> Support<S> {
                match self {
                    $(Dist::$variant $({ $($field),* })? $(($whole))? => support!($space $($($place)*)?),)*
                }
            }

            /// The middle of a family on the whole line.
            pub fn center(&self) -> Option<S> {
                match self {
                    $(Dist::$variant $({ $($field),* })? $(($whole))? => center!($space $($($place)*)?),)*
                }
            }

            /// The scale of a family on the whole line or of vectors; for a mixture, that of its first component.
            pub fn scale(&self) -> Option<S> {
                match self {
                    $(Dist::$variant $({ $($field),* })? $(($whole))? => scale!($space $($($place)*)?),)*
                }
            }
        }
    };
}

families! {
    /// True with probability `p`, else False.
    Bernoulli {
        /// Probability of True, in [0, 1].
        p: S = 0.5,
    } "bernoulli" Booleans,
        "`True` with probability p", "p from 0 to 1";
    /// An index from 0, drawn with probability proportional to its weight.
    Categorical(w: Arc<Weights<S>>;
        /// Weight of each index, not negative, not all zero; they need not sum to one.
        "weights": "Sequence[float]",
    ) "categorical" Categories(w.len()),
        "an index from 0", "weights 0 or more, at least one above 0";
    /// An integer from `lo` to `hi`, both included, all equally likely.
    DiscreteUniform {
        /// Least value.
        lo: i64,
        /// Greatest value, included.
        hi: i64,
    } "discrete_uniform" Integers(*lo, Some(*hi)),
        "an integer, both ends included", "integers, lo not above hi";
    /// A count of rare events with the given mean.
    Poisson {
        /// Mean, greater than 0.
        rate: S = 1.0,
    } "poisson" Integers(0, None),
        "an integer from 0", "rate from 0 to 1e15";
    /// The number of successes in `n` trials.
    Binomial {
        /// Number of trials, at least 0.
        n: i64,
        /// Probability of success of one trial, in [0, 1].
        p: S = 0.5,
    } "binomial" Integers(0, Some(*n)),
        "successes among n", "n an integer, 0 or more; p from 0 to 1";
    /// The number of failures before the first success, from 0.
    Geometric {
        /// Probability of success of one trial, in (0, 1].
        p: S = 0.5,
    } "geometric" Integers(0, None),
        "failures before the first success, from 0", "p above 0, not above 1";
    /// A real number between `lo` and `hi`, all equally likely.
    Uniform {
        /// Lower end.
        lo: S = 0.0,
        /// Upper end, greater than `lo`.
        hi: S = 1.0,
    } "uniform" Bounded(Some(*lo), Some(*hi)),
        "a number", "lo below hi";
    /// A real number from the bell curve.
    Gaussian {
        /// Centre.
        mean: S = 0.0,
        /// Standard deviation, greater than 0.
        sd: S = 1.0,
    } "gaussian" Line(*mean, *sd),
        "a number", "sd above 0";
    /// A positive number whose logarithm is Gaussian.
    LogNormal {
        /// Mean of the logarithm.
        mean: S = 0.0,
        /// Standard deviation of the logarithm, greater than 0.
        sd: S = 1.0,
    } "log_normal" Positive,
        "a number above 0; mean and sd are of its logarithm", "sd above 1e-147, mean at most 1e150 times sd away from 0";
    /// A positive number with mean `shape * scale`.
    Gamma {
        /// Shape, greater than 0.
        shape: S,
        /// Scale, greater than 0.
        scale: S = 1.0,
    } "gamma" Positive,
        "a number above 0", "shape and scale above 0";
    /// A positive number whose reciprocal is gamma distributed.
    InverseGamma {
        /// Shape, greater than 0.
        shape: S,
        /// Scale, greater than 0.
        scale: S = 1.0,
    } "inverse_gamma" Positive,
        "a number above 0", "shape and scale above 0";
    /// A real number in (0, 1) with mean `a / (a + b)`.
    Beta {
        /// Weight towards 1, greater than 0.
        a: S,
        /// Weight towards 0, greater than 0.
        b: S,
    } "beta" Unit,
        "a number in (0, 1)", "a and b above 0";
    /// A waiting time with mean `1 / rate`.
    Exponential {
        /// Events per unit, greater than 0.
        rate: S = 1.0,
    } "exponential" Positive,
        "a number above 0", "rate above 0";
    /// A real number that falls off exponentially on both sides.
    Laplace {
        /// Centre.
        loc: S = 0.0,
        /// Mean distance from the centre, greater than 0.
        scale: S = 1.0,
    } "laplace" Line(*loc, *scale),
        "a number", "scale above 0";
    /// A real number with very heavy tails.
    Cauchy {
        /// Centre.
        loc: S = 0.0,
        /// Half width at half height, greater than 0.
        scale: S = 1.0,
    } "cauchy" Line(*loc, *scale),
        "a number", "scale above 0";
    /// A real number from a bell with heavy tails.
    StudentT {
        /// Degrees of freedom, greater than 0.
        df: S,
        /// Centre.
        loc: S = 0.0,
        /// Width, greater than 0.
        scale: S = 1.0,
    } "student_t" Line(*loc, *scale),
        "a number", "df and scale above 0";
    /// An angle in radians, around `mean`.
    VonMises {
        /// Central angle, radians.
        mean: S = 0.0,
        /// How tight, at least 0.
        concentration: S = 1.0,
    } "von_mises" Circle,
        "an angle in radians", "concentration 0 or more";
    /// A Gaussian kept between `lo` and `hi`.
    TruncatedGaussian {
        /// Centre of the whole bell.
        mean: S,
        /// Standard deviation of the whole bell, greater than 0.
        sd: S,
        /// Lower end.
        lo: S,
        /// Upper end, greater than `lo`.
        hi: S,
    } "truncated_gaussian" Bounded(Some(*lo), Some(*hi)),
        "a number from lo to hi", "sd above 0, lo below hi";
    /// A list of shares that sum to one.
    Dirichlet(a: Arc<[S]>;
        /// One for each share, greater than 0.
        "concentrations": "Sequence[float]",
    ) "dirichlet" Simplex(a.len()),
        "a tuple of numbers that sum to 1", "all concentrations above 0, at most 1e300 together";
    /// A list of numbers that vary together.
    MultivariateGaussian(g: Arc<MultivariateGaussian<S>>;
        /// Centre, (n,).
        "mean": "Sequence[float]",
        /// Symmetric and positive definite, (n, n).
        "covariance": "Sequence[Sequence[float]]",
    ) "multivariate_gaussian" Vectors(g.mean.len(), g.scale()),
        "a tuple of numbers", "covariance symmetric and positive definite, of the size of the mean";
    /// A list of numbers that vary by themselves, each with its own centre and spread.
    DiagonalGaussian(g: Arc<DiagonalGaussian<S>>;
        /// Centres, (n,).
        "mean": "Sequence[float]",
        /// Standard deviations, (n,), greater than 0.
        "sd": "Sequence[float]",
    ) "diagonal_gaussian" Vectors(g.mean.len(), g.scale()),
        "a tuple of numbers that are independent, each with its mean and sd", "every sd above 0, as many as means";
    /// How often each category came in `n` trials.
    Multinomial(m: Arc<Multinomial<S>>;
        /// Trials, at least 0.
        "n": "int",
        /// Weight of each category in a trial, not negative; at least one greater than 0.
        "weights": "Sequence[float]",
    ) "multinomial" Counts(m.len()),
        "a tuple of counts: how often each category came in n trials", "n an integer, 0 or more; weights as of `categorical`";
    /// A list of truth values that are drawn by themselves.
    MultivariateBernoulli(ps: Arc<[S]>;
        /// Of each its probability of being true, in [0, 1].
        "ps": "Sequence[float]",
    ) "multivariate_bernoulli" Truths(ps.len()),
        "a tuple of truth values that are independent", "every p from 0 to 1";
    /// A draw from one of several distributions, picked with probability proportional to its weight.
    Mixture(m: Arc<Mixture<S>>;
        /// Weight of each component.
        "weights": "Sequence[float]",
        /// Distribution values, as many as weights.
        "components": "Sequence[Distribution]",
    ) "mixture" Components(m),
        "a draw of one component", "weights as of `categorical`, one for each component";
    /// Always the same value.
    Delta(value: Draw<S>;
        /// What every draw gives.
        "value": "Any",
    ) "delta" Fixed(value),
        "the value", "any";
}

// Distributions are stored in registers and nodes: their size must not grow unnoticed.
const _: () = assert!(size_of::<Dist<f64>>() <= 40);

impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    //! Every name belongs to one family.
    use super::*;

    #[test]
    fn names_are_distinct_and_give_their_family() {
        assert_eq!(Family::ALL.len(), 25);
        for &family in Family::ALL {
            assert_eq!(Family::from_name(family.name()), Some(family));
            assert!(!family.parameters().is_empty());
        }
        assert_eq!(Family::from_name("normal"), None);
    }
}

//! The table of the families: the name, parameters and space of values of each.
//!
//! A row holds the family's variants of [`Family`] and [`Dist`], its name in a model and its [`Space`]. All other
//! properties of a family follow from these by an exhaustive `match`, below the table and wherever a [`Space`] or a
//! [`Support`] is used: a family cannot be left out.

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
    (Line $scale:expr) => {
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
    (Line $scale:expr) => {
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

/// Declares the enums from the table, and what follows from it.
macro_rules! families {
    ($( $(#[$doc:meta])* $variant:ident
        $({ $($field:ident: $type:ty),* })? $(($whole:ident: $held:ty; $($parameter:literal),*))?
        $name:literal $space:ident $(($($place:tt)*))?; )*) => {
        /// A family of distributions.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Family { $( $(#[$doc])* $variant, )* }

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

            /// Where its values lie.
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
        pub enum Dist<S: Scalar = f64> { $( $(#[$doc])* $variant $({ $($field: $type),* })? $(($held))?, )* }

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

            /// The same distribution over another kind of number.
            pub fn convert<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Dist<T> {
                match self {
                    $(Dist::$variant $({ $($field),* })? $(($whole))? => {
                        Dist::$variant $({ $($field: $field.over(number)),* })? $(($whole.over(number)))?
                    })*
                }
            }

            /// Where the values lie.
            pub fn support(&self) -> Support<S> {
                match self {
                    $(Dist::$variant $({ $($field),* })? $(($whole))? => support!($space $($($place)*)?),)*
                }
            }

            /// The scale of a family on the whole line or of vectors; the first of a mixture of such.
            pub fn scale(&self) -> Option<S> {
                match self {
                    $(Dist::$variant $({ $($field),* })? $(($whole))? => scale!($space $($($place)*)?),)*
                }
            }
        }
    };
}

families! {
    /// True with probability `p`.
    Bernoulli { p: S } "bernoulli" Booleans;
    /// Index 0, 1, ... with probability proportional to its weight.
    Categorical(w: Arc<Weights<S>>; "weights") "categorical" Categories(w.len());
    /// Whole numbers from `lo` to `hi`, both included, equally likely.
    DiscreteUniform { lo: i64, hi: i64 } "discrete_uniform" Integers(*lo, Some(*hi));
    /// Number of events when `rate` are expected.
    Poisson { rate: S } "poisson" Integers(0, None);
    /// Successes in `n` trials of probability `p`.
    Binomial { n: i64, p: S } "binomial" Integers(0, Some(*n));
    /// Failures before the first success of probability `p`: 0, 1, ...
    Geometric { p: S } "geometric" Integers(0, None);
    /// Real numbers between `lo` and `hi`, equally likely.
    Uniform { lo: S, hi: S } "uniform" Bounded(Some(*lo), Some(*hi));
    /// The normal distribution.
    Gaussian { mean: S, sd: S } "gaussian" Line(*sd);
    /// Its logarithm is Gaussian with this mean and standard deviation.
    LogNormal { mean: S, sd: S } "log_normal" Positive;
    /// Gamma; its mean is `shape * scale`.
    Gamma { shape: S, scale: S } "gamma" Positive;
    /// One over a gamma with the same shape and scale `1 / scale`.
    InverseGamma { shape: S, scale: S } "inverse_gamma" Positive;
    /// Between 0 and 1; its mean is `a / (a + b)`.
    Beta { a: S, b: S } "beta" Unit;
    /// Time to the first event; its mean is `1 / rate`.
    Exponential { rate: S } "exponential" Positive;
    /// Two exponentials back to back.
    Laplace { loc: S, scale: S } "laplace" Line(*scale);
    /// Student's t with one degree of freedom.
    Cauchy { loc: S, scale: S } "cauchy" Line(*scale);
    /// Student's t, moved and scaled.
    StudentT { df: S, loc: S, scale: S } "student_t" Line(*scale);
    /// An angle in radians, within half a turn of zero.
    VonMises { mean: S, concentration: S } "von_mises" Circle;
    /// A Gaussian given that it falls between `lo` and `hi`.
    TruncatedGaussian { mean: S, sd: S, lo: S, hi: S } "truncated_gaussian" Bounded(Some(*lo), Some(*hi));
    /// Positive numbers that sum to one.
    Dirichlet(a: Arc<[S]>; "concentrations") "dirichlet" Simplex(a.len());
    /// Gaussian vectors.
    MultivariateGaussian(g: Arc<MultivariateGaussian<S>>; "mean", "covariance")
        "multivariate_gaussian" Vectors(g.mean.len(), g.scale());
    /// Gaussians that are independent, as a vector.
    DiagonalGaussian(g: Arc<DiagonalGaussian<S>>; "mean", "sd")
        "diagonal_gaussian" Vectors(g.mean.len(), g.scale());
    /// How often each category came in `n` trials, in which it has a probability proportional to its weight.
    Multinomial(m: Arc<Multinomial<S>>; "n", "weights") "multinomial" Counts(m.len());
    /// Truth values that are independent, each true with its own probability.
    MultivariateBernoulli(ps: Arc<[S]>; "ps") "multivariate_bernoulli" Truths(ps.len());
    /// One of `components`, chosen by `weights`.
    Mixture(m: Arc<Mixture<S>>; "weights", "components") "mixture" Components(m);
    /// Always the same value.
    Delta(value: Draw<S>; "value") "delta" Fixed(value);
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
    //! Every name gives its family back.
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

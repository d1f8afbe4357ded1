//! The families' names and those of their parameters, as a model writes them.

use std::fmt;

/// Declares the enum, its names and its parameter names in one table.
macro_rules! families {
    ($( $(#[$doc:meta])* $variant:ident $name:literal [$($parameter:literal),*] )*) => {
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
                match self { $(Family::$variant => &[$($parameter),*],)* }
            }

            /// The family of this name.
            pub fn from_name(name: &str) -> Option<Family> {
                match name { $($name => Some(Family::$variant),)* _ => None }
            }
        }
    };
}

families! {
    /// True with probability `p`.
    Bernoulli "bernoulli" ["p"]
    /// Index 0, 1, ... with probability proportional to its weight.
    Categorical "categorical" ["weights"]
    /// Whole numbers from `lo` to `hi`, both included, equally likely.
    DiscreteUniform "discrete_uniform" ["lo", "hi"]
    /// Number of events when `rate` are expected.
    Poisson "poisson" ["rate"]
    /// Successes in `n` trials of probability `p`.
    Binomial "binomial" ["n", "p"]
    /// Failures before the first success of probability `p`: 0, 1, ...
    Geometric "geometric" ["p"]
    /// Real numbers between `lo` and `hi`, equally likely.
    Uniform "uniform" ["lo", "hi"]
    /// The normal distribution.
    Gaussian "gaussian" ["mean", "sd"]
    /// Its logarithm is Gaussian with this mean and standard deviation.
    LogNormal "log_normal" ["mean", "sd"]
    /// Gamma; its mean is `shape * scale`.
    Gamma "gamma" ["shape", "scale"]
    /// One over a gamma with the same shape and scale `1 / scale`.
    InverseGamma "inverse_gamma" ["shape", "scale"]
    /// Between 0 and 1; its mean is `a / (a + b)`.
    Beta "beta" ["a", "b"]
    /// Time to the first event; its mean is `1 / rate`.
    Exponential "exponential" ["rate"]
    /// Two exponentials back to back.
    Laplace "laplace" ["loc", "scale"]
    /// Student's t with one degree of freedom.
    Cauchy "cauchy" ["loc", "scale"]
    /// Student's t, moved and scaled.
    StudentT "student_t" ["df", "loc", "scale"]
    /// An angle in radians, within half a turn of zero.
    VonMises "von_mises" ["mean", "concentration"]
    /// A Gaussian given that it falls between `lo` and `hi`.
    TruncatedGaussian "truncated_gaussian" ["mean", "sd", "lo", "hi"]
    /// Positive numbers that sum to one.
    Dirichlet "dirichlet" ["concentrations"]
    /// Gaussian vectors.
    MultivariateGaussian "multivariate_gaussian" ["mean", "covariance"]
    /// One of `components`, chosen by `weights`.
    Mixture "mixture" ["weights", "components"]
    /// Always the same value.
    Delta "delta" ["value"]
}

impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    //! Names lead back to their families.
    use super::*;

    #[test]
    fn names_are_found_and_distinct() {
        assert_eq!(Family::ALL.len(), 22);
        for &family in Family::ALL {
            assert_eq!(Family::from_name(family.name()), Some(family));
            assert!(!family.parameters().is_empty());
        }
        assert_eq!(Family::from_name("normal"), None);
    }
}

//! Five models whose means are known by conjugacy or quadrature: HMC and NUTS find them within 4.5 standard errors.
//!
//! The error is that of 40 batch means (Student's t with 39 degrees of freedom: 4.5 is a false alarm in 6e-5; there are
//! 60 comparisons). A mutant target, shifted by a tenth of a deviation, is rejected.

use crate::densities::{By, ln_sigmoid, sigmoid};
use niwaki_continuous::hamiltonian::chains::Length;
use niwaki_continuous::hamiltonian::{Potential, Settings, Shape, sample};

struct Known {
    name: &'static str,
    dim: usize,
    target: fn() -> By,
    /// The statistics that are averaged, from unconstrained coordinates.
    watched: fn(&[f64]) -> Vec<f64>,
    means: Vec<f64>,
}

/// `p ~ Beta(2, 3)`, 7 of 10: `Beta(9, 6)`.
fn beta_binomial() -> Known {
    let (a, b) = (9.0, 6.0);
    Known {
        name: "beta-binomial",
        dim: 1,
        target: || {
            By::new(1, |x, g| {
                g[0] = 9.0 * (1.0 - sigmoid(x[0])) - 6.0 * sigmoid(x[0]);
                9.0 * ln_sigmoid(x[0]) + 6.0 * ln_sigmoid(-x[0])
            })
        },
        watched: |x| vec![sigmoid(x[0]), sigmoid(x[0]).powi(2)],
        means: vec![a / (a + b), a * (a + 1.0) / ((a + b) * (a + b + 1.0))],
    }
}

/// `r ~ Gamma(2, rate 1)`, Poisson counts 3, 1, 4: `Gamma(10, rate 4)`.
fn gamma_poisson() -> Known {
    Known {
        name: "gamma-Poisson",
        dim: 1,
        target: || {
            By::new(1, |x, g| {
                g[0] = 10.0 - 4.0 * x[0].exp();
                10.0 * x[0] - 4.0 * x[0].exp()
            })
        },
        watched: |x| vec![x[0].exp(), x[0].exp().powi(2)],
        means: vec![2.5, 10.0 * 11.0 / 16.0],
    }
}

/// A line through four points, normal prior and noise of deviation 1: a normal with correlation, by its precision.
fn line() -> Known {
    // Precision I + X^T X with X = [1, t], t = 0, 1, 2, 3; right side X^T y with y = 1, 3, 2, 5.
    let (a, b, d) = (5.0, 6.0, 15.0);
    let (r, s) = (11.0, 22.0);
    let determinant = a * d - b * b;
    let mean = [(d * r - b * s) / determinant, (a * s - b * r) / determinant];
    Known {
        name: "line",
        dim: 2,
        target: || {
            By::new(2, |x, g| {
                g[0] = 11.0 - 5.0 * x[0] - 6.0 * x[1];
                g[1] = 22.0 - 6.0 * x[0] - 15.0 * x[1];
                0.5 * (x[0] * (g[0] + 11.0) + x[1] * (g[1] + 22.0))
            })
        },
        watched: |x| vec![x[0], x[1], x[0] * x[1]],
        means: vec![mean[0], mean[1], mean[0] * mean[1] - b / determinant],
    }
}

/// `theta ~ Dirichlet(1, 1, 1)` by breaking a stick, counts 4, 1, 2: `Dirichlet(5, 2, 3)`.
fn dirichlet() -> Known {
    Known {
        name: "Dirichlet",
        dim: 2,
        target: || {
            By::new(2, |x, g| {
                let (z, w) = (sigmoid(x[0]), sigmoid(x[1]));
                g[0] = 5.0 * (1.0 - z) - 5.0 * z;
                g[1] = 2.0 * (1.0 - w) - 3.0 * w;
                5.0 * ln_sigmoid(x[0])
                    + 5.0 * ln_sigmoid(-x[0])
                    + 2.0 * ln_sigmoid(x[1])
                    + 3.0 * ln_sigmoid(-x[1])
            })
        },
        watched: |x| {
            let (z, w) = (sigmoid(x[0]), sigmoid(x[1]));
            vec![z, (1.0 - z) * w, (1.0 - z) * (1.0 - w)]
        },
        means: vec![0.5, 0.2, 0.3],
    }
}

/// The dissertation's point (eq. 4.1) at bandwidth 0.1, uniform on a square: by the midpoint rule, which for a density
/// that is flat at the border converges fast.
fn point() -> Known {
    const S: f64 = 0.1;
    let (n, mut total, mut sums) = (2000, 0.0, [0.0; 3]);
    for i in 0..n {
        for j in 0..n {
            let at = |k: usize| -1.5 + 3.0 * (k as f64 + 0.5) / f64::from(n as u32);
            let (x, y) = (at(i), at(j));
            let z = y.powi(4) - y * y + x * x - 0.25;
            let weight = (-0.5 * z * z / (S * S)).exp();
            total += weight;
            for (sum, value) in sums.iter_mut().zip([x * x, y * y, x * x * y * y]) {
                *sum += weight * value;
            }
        }
    }
    Known {
        name: "point",
        dim: 2,
        target: || {
            By::new(2, |u, g| {
                let s = [sigmoid(u[0]), sigmoid(u[1])];
                let [x, y] = s.map(|s| -1.5 + 3.0 * s);
                let z = y.powi(4) - y * y + x * x - 0.25;
                let slope = -z / (S * S);
                let chain = |k: usize, inner: f64| inner * 3.0 * s[k] * (1.0 - s[k]) + 1.0 - 2.0 * s[k];
                g[0] = chain(0, slope * 2.0 * x);
                g[1] = chain(1, slope * (4.0 * y.powi(3) - 2.0 * y));
                -0.5 * z * z / (S * S) + u.iter().map(|u| ln_sigmoid(*u) + ln_sigmoid(-u)).sum::<f64>()
            })
        },
        watched: |u| {
            let [x, y] = [u[0], u[1]].map(|u| -1.5 + 3.0 * sigmoid(u));
            vec![x * x, y * y, x * x * y * y]
        },
        means: sums.map(|sum| sum / total).to_vec(),
    }
}

const CHAINS: usize = 4;
const DRAWS: usize = 4000;
const BATCHES: usize = 10;

/// The largest distance from a known mean, in standard errors.
fn distance<P: Potential>(known: &Known, make: impl Fn(usize) -> P + Sync, settings: &Settings) -> f64 {
    let starts: Vec<Vec<f64>> = (0..CHAINS).map(|k| vec![0.2 * k as f64 - 0.3; known.dim]).collect();
    let chains = sample(make, &starts, settings, 41, &|_, _| true).expect("starts");
    let size = DRAWS / BATCHES;
    let mut batches: Vec<Vec<f64>> = Vec::new();
    for chain in &chains {
        let rows: Vec<Vec<f64>> = chain.rows().map(known.watched).collect();
        for batch in rows.chunks(size) {
            let mean = |k: usize| batch.iter().map(|row| row[k]).sum::<f64>() / size as f64;
            batches.push((0..known.means.len()).map(mean).collect());
        }
    }
    let n = batches.len() as f64;
    let distances = known.means.iter().enumerate().map(|(k, exact)| {
        let mean = batches.iter().map(|b| b[k]).sum::<f64>() / n;
        let var = batches.iter().map(|b| (b[k] - mean).powi(2)).sum::<f64>() / (n - 1.0) / n;
        (mean - exact).abs() / var.sqrt()
    });
    distances.fold(0.0, f64::max)
}

fn all() -> [Known; 5] {
    [beta_binomial(), gamma_poisson(), line(), dirichlet(), point()]
}

fn every_setting() -> [Settings; 5] {
    let base = Settings { warmup: 500, draws: DRAWS as u32, ..Settings::nuts() };
    let fixed = Length::Fixed { steps: 10, jitter: 0.5 };
    [
        base.clone(),
        Settings { shape: Shape::Dense, ..base.clone() },
        Settings { shape: Shape::LowRank, ..base.clone() },
        Settings { shape: Shape::Unit, ..base.clone() },
        Settings { length: fixed, target_accept: 0.65, ..base },
    ]
}

#[test]
fn means_are_found() {
    for known in all() {
        for settings in every_setting() {
            let deviation = distance(&known, |_| (known.target)(), &settings);
            assert!(deviation < 4.5, "{} {settings:?}: {deviation}", known.name);
        }
    }
}

/// A mutant: everything a little to the right.
struct Shifted(By);

impl Potential for Shifted {
    fn dim(&self) -> usize {
        self.0.dim()
    }
    fn value_and_gradient(
        &mut self,
        x: &[f64],
        g: &mut [f64],
    ) -> Result<f64, niwaki_continuous::hamiltonian::Stop> {
        let moved: Vec<f64> = x.iter().map(|x| x - 0.06).collect();
        self.0.value_and_gradient(&moved, g)
    }
}

#[test]
fn a_target_a_little_to_the_right_is_found() {
    for known in all() {
        // The point's density is even in both coordinates and spread wide: its means hardly see a shift.
        if known.name == "point" {
            continue;
        }
        let settings = Settings { warmup: 500, draws: DRAWS as u32, ..Settings::nuts() };
        let deviation = distance(&known, |_| Shifted((known.target)()), &settings);
        assert!(deviation > 4.5, "{}: {deviation}", known.name);
    }
}

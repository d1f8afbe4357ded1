//! Several normals as one proposal: equal shares of each.
//!
//! Draws of all of them have one target, so each draw is weighed by the density of all together (Veach & Guibas 1995,
//! "balance heuristic"; Zhang et al. 2022, algorithm 2):
//!
//! ```text
//! log w(x) = log p(x) - log (1/n) sum_j q_j(x)
//! ```
//!
//! Weighed by its own normal alone, each normal's draws would estimate the whole evidence, and a mode that two normals found
//! would count twice.
//!
//! Where coordinates are angles this is a product of conditional densities, as for one normal ([`super::turns`]): that of
//! the coordinates that are none, then that of each angle given those before it, summed over turns.

use super::batch::Row;
use super::normal::Normal;
use super::turns::wound;
use niwaki_math::log_sums::log_sum_exp;

/// `log(2 pi) / 2`.
const HALF_LOG_TWO_PI: f64 = 0.918_938_533_204_672_7;

/// The log density of draws under equal shares of normals, nats, on the circles of the angles. The normals are those of
/// [`Normal::in_order`].
pub fn log_density(normals: &[&Normal], angles: &[usize], x: &[Row]) -> Row {
    let first = x.len() - angles.len();
    let mut z: Vec<Row> = x.to_vec();
    // Of each normal: the draws' `z` of the angles, and the log density of what comes before these.
    let mut parts: Vec<(Vec<Row>, Row)> = Vec::with_capacity(normals.len());
    let turns: Vec<_> = normals.iter().map(|normal| normal.turns(angles).0).collect();
    for (normal, turns) in normals.iter().zip(&turns) {
        normal.whiten(x, angles, &mut z);
        let log_det = normal.log_det - turns.iter().map(|(_, deviation)| deviation.ln()).sum::<f64>();
        let is_angle = |k: &usize| turns.iter().any(|(at, _)| at == k);
        let mut log = [-log_det - first as f64 * HALF_LOG_TWO_PI; super::LANES];
        for (k, row) in z.iter().enumerate() {
            if !is_angle(&k) {
                log.iter_mut().zip(row).for_each(|(log, z)| *log -= 0.5 * z * z);
            }
        }
        parts.push((turns.iter().map(|(at, _)| z[*at]).collect(), log));
    }
    let constant = |deviation: f64| deviation.ln() + HALF_LOG_TWO_PI;
    std::array::from_fn(|l| {
        let of = |j: usize, k: usize| (parts[j].0[k][l], turns[j][k].1);
        let mut logs: Vec<f64> = parts.iter().map(|(_, log)| log[l]).collect();
        let mut before = log_sum_exp(logs.iter().copied());
        let mut total = before - (normals.len() as f64).ln();
        for k in 0..angles.len() {
            let around: Vec<f64> = logs
                .iter()
                .enumerate()
                .map(|(j, log)| {
                    let (z, deviation) = of(j, k);
                    log + wound(z, deviation).0 - constant(deviation)
                })
                .collect();
            total += log_sum_exp(around.iter().copied()) - before;
            for (j, log) in logs.iter_mut().enumerate() {
                let (z, deviation) = of(j, k);
                *log -= 0.5 * z * z + constant(deviation);
            }
            before = log_sum_exp(logs.iter().copied());
        }
        total
    })
}

#[cfg(test)]
mod tests {
    //! Shares of normals are their mean, and one normal is itself; around circles the density integrates to one.
    use super::*;
    use crate::variational::LANES;
    use niwaki_math::Stream;
    use std::f64::consts::{PI, TAU};

    fn normals() -> [Normal; 2] {
        let columns = [vec![1.0, 0.5, -0.3]];
        let of = |mean: Vec<f64>, deviation: Vec<f64>, m: f64| {
            Normal::low_rank(mean, deviation, &columns, &[m]).expect("positive definite")
        };
        [
            of(vec![0.3, -1.0, 2.0], vec![0.5, 1.0, 2.0], 0.8),
            of(vec![1.0, 5.0, 2.5], vec![1.5, 2.0, 0.7], -0.3),
        ]
    }

    #[test]
    fn the_density_is_the_mean_of_the_parts() {
        let [a, b] = normals();
        let (mut z, mut stream) = (vec![[0.0; LANES]; 3], Stream::new(5, 0, 0, 0));
        let (mut x, mut back) = (z.clone(), z.clone());
        a.draw(&mut stream, &mut z, &mut x);
        let first = a.log_density(&z);
        b.whiten(&x, &[], &mut back);
        let other = b.log_density(&back);
        let (alone, both) = (log_density(&[&a], &[], &x), log_density(&[&a, &b], &[], &x));
        for l in 0..LANES {
            assert!((alone[l] - first[l]).abs() < 1e-10);
            let mean = (0.5 * (first[l].exp() + other[l].exp())).ln();
            assert!((both[l] - mean).abs() < 1e-10);
        }
    }

    #[test]
    fn around_circles_the_density_integrates_to_one() {
        // Of one angle it is a function of the angle, so the integral over one turn, and over the line of the others, is one.
        let angles = [1];
        let parts = normals().map(|normal| normal.in_order(&angles).expect("positive definite"));
        let (cells, turns) = (64_usize, 40_usize);
        let (width, step) = (0.5, TAU / turns as f64);
        let mut points = vec![];
        for i in 0..cells {
            for j in 0..cells {
                points.extend(
                    (0..turns)
                        .map(|k| [-15.0 + width * i as f64, PI + step * k as f64, -14.0 + width * j as f64]),
                );
            }
        }
        let mut mass = 0.0;
        for some in points.chunks(LANES) {
            let x: Vec<Row> =
                (0..3).map(|k| std::array::from_fn(|l| some.get(l).map_or(0.0, |p| p[k]))).collect();
            let log = log_density(&[&parts[0], &parts[1]], &angles, &x);
            mass += log[..some.len()].iter().map(|log| log.exp()).sum::<f64>() * width * width * step;
        }
        assert!((mass - 1.0).abs() < 1e-3, "{mass}");
    }
}

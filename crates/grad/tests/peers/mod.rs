//! The three densities that gradient engines are compared on: a ring of 2 variables (dissertation 4.2), a colouring of
//! 60 (20 regions; factors of appendix B.1), a stack of 118 or more (blocks, contacts, latent forces; factors of
//! appendix B.2). Constants of the normal densities are dropped.
//!
//! Written over any scalar: as `f64` they are the hand-written densities, as [`Var`] they record themselves.

#![allow(dead_code)] // Used by the tests and by an example, each in part.

use niwaki_grad::scalar::with_sheet;
use niwaki_grad::{Density, Var};
use niwaki_math::Scalar;

fn sigmoid<S: Scalar>(v: S) -> S {
    S::from_f64(1.0) / (S::from_f64(1.0) + (-v).exp())
}

/// `ln s(v) + ln s(-v)`.
fn log_jacobian<S: Scalar>(v: S) -> S {
    S::from_f64(2.0) * sigmoid(v).ln() - v
}

pub fn ring<S: Scalar>(x: &[S]) -> S {
    let c = S::from_f64;
    let y2 = x[1] * x[1];
    let z = (y2 * y2 - y2 + x[0] * x[0] - c(0.25)) / c(0.005);
    c(-0.5) * z * z
}

/// Areas, edges, pairs of one chroma, pairs of two lightnesses.
pub struct Drawing {
    area: Vec<f64>,
    edges: Vec<(usize, usize)>,
    chroma: Vec<(usize, usize)>,
    light: Vec<(usize, usize)>,
}

pub fn drawing() -> Drawing {
    let text = include_str!("../../../../benches/hmc/coloring.txt");
    let mut words = text.split_whitespace();
    let mut next = || words.next().expect("as many words as the first line says");
    let mut count = || next().parse::<usize>().expect("a whole number");
    let [n, e, c, l] = [count(), count(), count(), count()];
    let area = (0..n).map(|_| next().parse().expect("a number")).collect();
    let mut pairs = |n: usize| {
        let mut number = || next().parse().expect("a whole number");
        (0..n).map(|_| (number(), number())).collect::<Vec<_>>()
    };
    Drawing { area, edges: pairs(e), chroma: pairs(c), light: pairs(l) }
}

/// `a < b ? x : y`, as a single operation for a scalar that records; all three numbers are arguments.
pub type Choose<S> = fn(S, f64, S, S) -> S;

pub fn coloring<S: Scalar>(d: &Drawing, x: &[S], select: Choose<S>) -> S {
    let c = S::from_f64;
    const M: [[f64; 3]; 3] = [
        [0.4124564, 0.3575761, 0.1804375],
        [0.2126729, 0.7151522, 0.0721750],
        [0.0193339, 0.1191920, 0.9503041],
    ];
    const WHITE: [f64; 3] = [0.95047, 1.0, 1.08883];
    let cut = (6.0_f64 / 29.0).powi(3);
    let mut lab: Vec<[S; 3]> = Vec::new();
    let mut total = c(0.0);
    for region in x.chunks(3) {
        let linear: Vec<S> = region
            .iter()
            .map(|v| {
                total = total + log_jacobian(*v);
                let s = sigmoid(*v);
                select(s, 0.04045, s / c(12.92), ((s + c(0.055)) / c(1.055)).powf(c(2.4)))
            })
            .collect();
        let f: Vec<S> = (0..3)
            .map(|i| {
                let t = (0..3).fold(c(0.0), |sum, j| sum + linear[j] * c(M[i][j] / WHITE[i]));
                select(t, cut, t * c(841.0 / 108.0) + c(4.0 / 29.0), t.powf(c(1.0 / 3.0)))
            })
            .collect();
        lab.push([c(116.0) * f[1] - c(16.0), c(500.0) * (f[0] - f[1]), c(200.0) * (f[1] - f[2])]);
    }
    let normal = |z: S| c(-0.5) * z * z;
    for (k, [l, a, b]) in lab.iter().enumerate() {
        let c2 = *a * *a + *b * *b;
        let saturation = (c2 / (c2 + *l * *l)).sqrt();
        let off = saturation - c(if k == 0 { 0.3 } else { 0.7 });
        total = total + c(-0.5 * d.area[k]) * off * off;
    }
    let difference = |(i, j): (usize, usize)| -> [S; 3] { std::array::from_fn(|k| lab[i][k] - lab[j][k]) };
    for &edge in &d.edges {
        let [l, a, b] = difference(edge);
        let mean = if edge.0 == 0 || edge.1 == 0 { 0.3 } else { 0.2 };
        total = total + normal((l.abs() / c(100.0) - c(mean)) / c(0.4));
        total = total + normal(((l * l + a * a + b * b).sqrt() / c(300.0) - c(0.3)) / c(0.2));
    }
    for &pair in &d.chroma {
        let [_, a, b] = difference(pair);
        total = total + c(-0.5 / 25.0) * (a * a + b * b);
    }
    for &pair in &d.light {
        total = total + normal((difference(pair)[0] - c(15.0)) / c(5.0));
    }
    total
}

/// Coordinates of a stack of that many blocks.
pub fn stack_dim(blocks: usize) -> usize {
    6 * blocks + 2 * (blocks - 1) + 12 * blocks
}

pub fn stack<S: Scalar>(blocks: usize, x: &[S]) -> S {
    let c = S::from_f64;
    const FRICTION: f64 = 0.5;
    const TOLERANCE: f64 = 0.01;
    const BOUNDS: [(f64, f64); 8] =
        [(0.3, 1.0), (0.3, 1.0), (0.3, 1.0), (0.5, 1.2), (0.5, 1.2), (-0.3, 0.3), (-0.6, 0.6), (-0.6, 0.6)];
    const TETS: [[usize; 4]; 6] =
        [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]];
    let zero = c(0.0);
    let n = blocks;
    let mut total = zero;
    let mut at = 0;
    let mut part: Vec<Vec<S>> = Vec::new();
    for (k, (lo, hi)) in BOUNDS.iter().enumerate() {
        let count = if k < 6 { n } else { n - 1 };
        let values = x[at..at + count].iter().map(|v| {
            total = total + log_jacobian(*v);
            c(*lo) + c(hi - lo) * sigmoid(*v)
        });
        part.push(values.collect());
        at += count;
    }
    let (vn, rest) = x[at..].split_at(4 * n);
    let (v1, v2) = rest.split_at(4 * n);
    let (mut normal, mut first, mut second) = (vec![], vec![], vec![]);
    for k in 0..4 * n {
        let force = vn[k].exp();
        let share = |v: S| c(FRICTION) * force * (c(2.0) * sigmoid(v) - c(1.0));
        first.push(share(v1[k]));
        second.push(share(v2[k]));
        normal.push(force);
        total = total + c(3.0) * vn[k] + log_jacobian(v1[k]) + log_jacobian(v2[k]);
    }
    let [hx, hy, h, tx, ty, ux, ox, oy] = &part[..] else { unreachable!("eight bounds") };
    let mut block = Vec::new();
    let (mut cx, mut cy, mut z0) = (zero, zero, zero);
    for i in 0..n {
        let (tx, ty) = (hx[i] * tx[i], hy[i] * ty[i]);
        let (ccx, z1) = (cx + ux[i], z0 + h[i]);
        let (sx, bx) = ([-hx[i], hx[i], hx[i], -hx[i]], [-tx, tx, tx, -tx]);
        let (sy, by) = ([-hy[i], -hy[i], hy[i], hy[i]], [-ty, -ty, ty, ty]);
        let corner = |k: usize| -> [S; 3] {
            if k < 4 { [cx + sx[k], cy + sy[k], z0] } else { [ccx + bx[k - 4], cy + by[k - 4], z1] }
        };
        let corners: Vec<[S; 3]> = (0..8).map(corner).collect();
        let (mut volume, mut moment) = (zero, [zero; 3]);
        for tet in TETS {
            let [p, q, r, s] = tet.map(|k| corners[k]);
            let [a, b, d] = [q, r, s].map(|v| -> [S; 3] { std::array::from_fn(|k| v[k] - p[k]) });
            let det = a[0] * (b[1] * d[2] - b[2] * d[1])
                + a[1] * (b[2] * d[0] - b[0] * d[2])
                + a[2] * (b[0] * d[1] - b[1] * d[0]);
            volume = volume + det;
            for k in 0..3 {
                moment[k] = moment[k] + det * (p[k] + q[k] + r[k] + s[k]);
            }
        }
        let centre = moment.map(|m| c(0.25) * m / volume);
        block.push((volume / c(6.0), centre, (cx, cy, ccx, tx, ty, z0)));
        if i + 1 < n {
            cx = cx + (ux[i] + ox[i] * tx);
            cy = cy + oy[i] * ty;
        }
        z0 = z1;
    }
    let mut wrench = vec![[zero; 6]; n];
    for i in 0..n {
        let (_, _, (cx, cy, _, _, _, z0)) = block[i];
        let (mut xl, mut xr, mut yl, mut yr) = (cx - hx[i], cx + hx[i], cy - hy[i], cy + hy[i]);
        if i > 0 {
            let (_, _, (_, below_y, ccx, tx, ty, _)) = block[i - 1];
            (xl, xr) = (xl.max(ccx - tx), xr.min(ccx + tx));
            (yl, yr) = (yl.max(below_y - ty), yr.min(below_y + ty));
        }
        for (k, (px, py)) in [(xl, yl), (xr, yl), (xr, yr), (xl, yr)].into_iter().enumerate() {
            let (a, b, f) = (first[4 * i + k], second[4 * i + k], normal[4 * i + k]);
            let mut push = |on: usize, sign: f64| {
                let g = block[on].1;
                let (rx, ry, rz) = (px - g[0], py - g[1], z0 - g[2]);
                let all = [a, b, f, ry * f - rz * b, rz * a - rx * f, rx * b - ry * a];
                for (sum, term) in wrench[on].iter_mut().zip(all) {
                    *sum = if sign > 0.0 { *sum + term } else { *sum - term };
                }
            };
            push(i, 1.0);
            if i > 0 {
                push(i - 1, -1.0);
            }
        }
    }
    let share = c(1.0 / n as f64);
    let weight = block.iter().fold(zero, |sum, b| sum + b.0) * share;
    let lever = hx.iter().chain(hy).fold(zero, |sum, h| sum + *h) * c(0.5) * share;
    let (mut force, mut torque) = (zero, zero);
    for (w, b) in wrench.iter().zip(&block) {
        let fz = w[2] - b.0;
        force = force + w[0] * w[0] + w[1] * w[1] + fz * fz;
        torque = torque + w[3] * w[3] + w[4] * w[4] + w[5] * w[5];
    }
    let sf = c(TOLERANCE) * weight;
    let st = sf * lever;
    total - c(0.5) * force / (sf * sf) - c(0.5) * torque / (st * st)
}

/// The recorded density of a function.
pub fn recorded(at: &[f64], f: impl FnOnce(&[Var]) -> Var) -> Density {
    let (value, sheet) = with_sheet(|| {
        let x: Vec<Var> = at.iter().map(|x| Var::input(*x)).collect();
        f(&x)
    });
    let mut graph = sheet.graph;
    let value = value.id(&mut graph);
    Density::new(graph, value, &sheet.guards)
}

/// The three densities with their names, as graphs, recorded at known points.
pub fn peers() -> Vec<(&'static str, Density)> {
    let start = |name| known().into_iter().find(|k| k.name == name).expect("a known point").x;
    let d = drawing();
    vec![
        ("ring", recorded(&start("ring"), ring)),
        ("coloring", recorded(&start("coloring"), |x| coloring(&d, x, Var::below_or))),
        ("stack", recorded(&start("stack"), |x| stack(6, x))),
    ]
}

/// A point at which a density and its gradient are known.
pub struct Known {
    pub name: String,
    pub value: f64,
    pub x: Vec<f64>,
    pub gradient: Vec<f64>,
}

pub fn known() -> Vec<Known> {
    let line = |line: &str| {
        let mut words = line.split_whitespace();
        let name = words.next().expect("a name").to_string();
        let numbers: Vec<f64> = words.map(|w| w.parse().expect("a number")).collect();
        let n = numbers[0] as usize;
        Known { name, value: numbers[1], x: numbers[2..2 + n].to_vec(), gradient: numbers[2 + n..].to_vec() }
    };
    include_str!("../../../../benches/hmc/reference.txt").lines().map(line).collect()
}

/// Start of a stack of any size: nominal blocks, their weight spread over the vertices below.
pub fn stack_start(blocks: usize) -> Vec<f64> {
    let mut x = vec![0.0; stack_dim(blocks)];
    let geometry = 6 * blocks + 2 * (blocks - 1);
    for i in 0..blocks {
        for k in 0..4 {
            x[geometry + 4 * i + k] = (1.9 * (blocks - i) as f64 / 4.0).ln();
        }
    }
    x
}

/// `x <= bound ? yes : no` of plain numbers.
pub fn plain_choose(x: f64, bound: f64, yes: f64, no: f64) -> f64 {
    if x <= bound { yes } else { no }
}

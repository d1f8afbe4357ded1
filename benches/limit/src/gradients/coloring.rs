//! Colours of 20 regions (the factors of the dissertation's appendix B.1) with their gradient, differentiated by hand.
//!
//! One exponential and one power for each channel, one cube root for each of its tristimulus values; logarithms only
//! where the value is asked for. Scalar code with the system's libm.

use super::Density;

const REGIONS: usize = 20;
pub const DIM: usize = 3 * REGIONS;

const M: [[f64; 3]; 3] = [
    [0.4124564 / 0.95047, 0.3575761 / 0.95047, 0.1804375 / 0.95047],
    [0.2126729, 0.7151522, 0.0721750],
    [0.0193339 / 1.08883, 0.1191920 / 1.08883, 0.9503041 / 1.08883],
];
/// Below it the cube root of CIELAB is its tangent.
const FOOT: f64 = (6.0 / 29.0) * (6.0 / 29.0) * (6.0 / 29.0);

type Pair = (usize, usize);

pub struct Coloring {
    area: [f64; REGIONS],
    edges: Vec<(Pair, f64)>,
    chroma: Vec<Pair>,
    light: Vec<Pair>,
    /// Slopes of each channel's linear light, and of each tristimulus value's root.
    slopes: [[f64; 6]; REGIONS],
    share: [f64; DIM],
    lab: [[f64; 3]; REGIONS],
    back: [[f64; 3]; REGIONS],
}

impl Coloring {
    /// From the text of `benches/hmc/coloring.txt`.
    pub fn read(text: &str) -> Self {
        let mut words = text.split_whitespace();
        let mut next = || words.next().expect("as many words as the first line says");
        let [n, e, c, l] = [(); 4].map(|()| next().parse::<usize>().expect("a whole number"));
        assert_eq!(n, REGIONS, "a drawing of {REGIONS} regions");
        let area = [(); REGIONS].map(|()| next().parse().expect("a number"));
        let mut pairs = |count: usize| -> Vec<Pair> {
            let mut one = || next().parse().expect("a whole number");
            (0..count).map(|_| (one(), one())).collect()
        };
        let edges =
            pairs(e).into_iter().map(|(i, j)| ((i, j), if i == 0 || j == 0 { 0.3 } else { 0.2 })).collect();
        let (chroma, light) = (pairs(c), pairs(l));
        let rows = [[0.0; 3]; REGIONS];
        Coloring {
            area,
            edges,
            chroma,
            light,
            slopes: [[0.0; 6]; REGIONS],
            share: [0.0; DIM],
            lab: rows,
            back: rows,
        }
    }
}

impl Density<DIM> for Coloring {
    fn gradient<const VALUE: bool>(&mut self, x: &[f64; DIM], g: &mut [f64; DIM]) -> f64 {
        let mut value = 0.0;
        for region in 0..REGIONS {
            let mut linear = [0.0; 3];
            for k in 0..3 {
                let v = x[3 * region + k];
                let s = 1.0 / (1.0 + (-v).exp());
                self.share[3 * region + k] = s;
                if VALUE {
                    value += 2.0 * s.ln() - v;
                }
                (linear[k], self.slopes[region][k]) = if s <= 0.04045 {
                    (s * (1.0 / 12.92), 1.0 / 12.92)
                } else {
                    let u = (s + 0.055) * (1.0 / 1.055);
                    let power = u.powf(2.4);
                    (power, 2.4 / 1.055 * power / u)
                };
            }
            let mut f = [0.0; 3];
            for i in 0..3 {
                let t = M[i][0] * linear[0] + M[i][1] * linear[1] + M[i][2] * linear[2];
                (f[i], self.slopes[region][3 + i]) = if t > FOOT {
                    let root = t.cbrt();
                    (root, root / (3.0 * t))
                } else {
                    (t * (841.0 / 108.0) + 4.0 / 29.0, 841.0 / 108.0)
                };
            }
            let lab = [116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])];
            self.lab[region] = lab;
            let [l, a, b] = lab;
            let chroma = a * a + b * b;
            let whole = chroma + l * l;
            let saturation = (chroma / whole).sqrt();
            let off = saturation - if region == 0 { 0.3 } else { 0.7 };
            let slope = -self.area[region] * off / (saturation * whole * whole);
            self.back[region] = [slope * -chroma * l, slope * l * l * a, slope * l * l * b];
            if VALUE {
                value -= 0.5 * self.area[region] * off * off;
            }
        }
        let (lab, back) = (&self.lab, &mut self.back);
        let mut push = |(i, j): Pair, d: [f64; 3]| {
            for k in 0..3 {
                back[i][k] += d[k];
                back[j][k] -= d[k];
            }
        };
        for &((i, j), mean) in &self.edges {
            let [l, a, b]: [f64; 3] = std::array::from_fn(|k| lab[i][k] - lab[j][k]);
            let light = (l.abs() * 0.01 - mean) * 2.5;
            let distance = (l * l + a * a + b * b).sqrt();
            let apart = (distance * (1.0 / 300.0) - 0.3) * 5.0;
            let along = -apart * (5.0 / 300.0) / distance;
            push((i, j), [along * l - light * 0.025 * l.signum(), along * a, along * b]);
            if VALUE {
                value -= 0.5 * (light * light + apart * apart);
            }
        }
        for &(i, j) in &self.chroma {
            let (a, b) = (lab[i][1] - lab[j][1], lab[i][2] - lab[j][2]);
            push((i, j), [0.0, a * (-1.0 / 25.0), b * (-1.0 / 25.0)]);
            if VALUE {
                value -= 0.5 / 25.0 * (a * a + b * b);
            }
        }
        for &(i, j) in &self.light {
            let z = (lab[i][0] - lab[j][0] - 15.0) * 0.2;
            push((i, j), [z * -0.2, 0.0, 0.0]);
            if VALUE {
                value -= 0.5 * z * z;
            }
        }
        for region in 0..REGIONS {
            let ([l, a, b], slopes) = (self.back[region], &self.slopes[region]);
            let root = [
                500.0 * a * slopes[3],
                (116.0 * l - 500.0 * a + 200.0 * b) * slopes[4],
                -200.0 * b * slopes[5],
            ];
            for k in 0..3 {
                let s = self.share[3 * region + k];
                let light = root[0] * M[0][k] + root[1] * M[1][k] + root[2] * M[2][k];
                g[3 * region + k] = light * slopes[k] * s * (1.0 - s) + 1.0 - 2.0 * s;
            }
        }
        value
    }
}

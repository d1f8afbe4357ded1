//! A point near a curve (dissertation 4.2): `-z^2 / 2` with `z = (y^4 - y^2 + x^2 - 1/4) / sigma`.

use super::Density;

const SIGMA: f64 = 0.005;

pub struct Ring;

impl Density<2> for Ring {
    #[inline(always)]
    fn gradient<const VALUE: bool>(&mut self, q: &[f64; 2], g: &mut [f64; 2]) -> f64 {
        let [x, y] = *q;
        let y2 = y * y;
        let z = (y2 * y2 - y2 + x * x - 0.25) * (1.0 / SIGMA);
        let slope = z * (-1.0 / SIGMA);
        *g = [slope * (x + x), slope * (y * (4.0 * y2 - 2.0))];
        -0.5 * z * z
    }
}

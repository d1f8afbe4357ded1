//! The sums of a pixel over its samples, and after the last sample the means.

use super::v3::V3;

/// The surface of one pixel and its sampled light.
#[derive(Clone, Copy, Debug, Default)]
pub struct Grain {
    /// Mean normal (unit), or zero where there is no surface.
    pub normal: V3,
    /// Mean position.
    pub point: V3,
    /// Width of the pixel on the surface, scene units.
    pub footprint: f32,
    /// Samples that met the surface.
    pub count: f32,
    /// Mean sky light that is blocked.
    pub blocked: V3,
    /// Samples behind `blocked`.
    pub sky_weight: f32,
    /// Share of the sun that is visible.
    pub sun: f32,
    /// Samples behind `sun`.
    pub sun_weight: f32,
}

/// Sums over the samples of a pixel that met parts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Body {
    /// Samples.
    pub count: f32,
    /// Paint, linear.
    pub paint: V3,
    /// Light of the unblocked sun off paint and lacquer.
    pub sunlit: V3,
    /// Light of the unblocked sky off paint.
    pub open: V3,
    /// Light of the sky off lacquer.
    pub shine: V3,
    /// Brightness of the darkest sample in unblocked light.
    pub darkest: f32,
    /// Brightness of the brightest sample in unblocked light.
    pub brightest: f32,
}

/// Sums over the samples that met the ghost, also behind parts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shell {
    /// Samples.
    pub count: f32,
    /// Samples with nothing in front.
    pub visible: f32,
    /// Opacity of the glass where it is visible.
    pub opacity: f32,
    /// Normals.
    pub normal: V3,
    /// Distances from the eye over the scene's radius.
    pub depth: f32,
}

/// The sums of a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pixel {
    /// Samples cast.
    pub samples: f32,
    /// Parts.
    pub body: Body,
    /// Light on parts.
    pub body_grain: Grain,
    /// Samples that met the floor.
    pub floor: f32,
    /// Light on the floor.
    pub floor_grain: Grain,
    /// Weight of the floor's shadow: 1 below the scene, 0 far away.
    pub fade: f32,
    /// The ghost.
    pub shell: Shell,
}

impl Pixel {
    /// True if any sample met a part, the shadow's floor or the ghost.
    pub fn is_hit(&self) -> bool {
        self.body.count > 0.0 || self.floor_grain.count > 0.0 || self.shell.count > 0.0
    }

    /// Turns the sums about light into means, after the last sample.
    pub fn finish(&mut self) {
        finish(&mut self.body_grain, self.samples);
        finish(&mut self.floor_grain, self.samples);
        self.fade /= self.floor.max(1.0);
    }
}

/// Turns sums into means. Weights are shares of the pixel, so that a pixel with more samples counts no more than its
/// neighbour. Otherwise the darker side of a shadow's edge, where samples disagree, would count more.
fn finish(grain: &mut Grain, samples: f32) {
    if grain.count > 0.0 {
        let count = grain.count;
        grain.normal = grain.normal.unit();
        grain.point = grain.point / count;
        grain.footprint /= count;
        grain.blocked = grain.blocked / grain.sky_weight.max(1.0);
    }
    grain.sun = if grain.sun_weight > 0.0 { grain.sun / grain.sun_weight } else { 1.0 };
    grain.sky_weight /= samples.max(1.0);
    grain.sun_weight /= samples.max(1.0);
}

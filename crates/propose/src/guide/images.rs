//! Guides of the dissertation's architecture: what they see of a page.
//!
//! Two things differ from the dissertation's program. The scene is seen as it is at the choice; there it is as it was
//! after the branch before, for the choices of a branch's own leaf and flower. And the numbers in scope that are inputs
//! have their range in the traces as -1 to 1, where the dissertation has bounds that were written down.

use super::bound::Sight;
use super::form::ImageForm;
use niwaki_geom::sketch::product::Sketches;
use niwaki_geom::{Page, Place};
use niwaki_guide::Filtered;
use niwaki_guide::filtered::Levels;
use niwaki_run::Task;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Inputs of the place: x and y on the page, and the direction.
pub const OF_PLACE: u32 = 3;

/// The page of a guide for one program.
#[derive(Debug)]
pub struct Images {
    /// The member of the score that shows the page.
    member: usize,
    /// Where the page is in the scene.
    pub page: Page,
    /// The pixels of its target, a bit each.
    pub bits: Arc<[u64]>,
    target: Levels,
}

impl Images {
    /// The page of the first sketch of this name that has one.
    pub(super) fn new(form: &ImageForm, net: &Filtered, task: &Task) -> Option<Images> {
        let mut members = task.sketches.iter().enumerate().filter(|(_, sketch)| sketch.name() == form.sketch);
        let (member, (page, bits)) = members.find_map(|(member, sketch)| Some((member, sketch.image()?)))?;
        let mut target = Levels::default();
        net.see_target(page.size(), &bits, &mut target);
        Some(Images { member, page, bits: bits.into(), target })
    }

    /// The target as the network sees it.
    pub(super) fn target(&self) -> &Levels {
        &self.target
    }

    /// A place, in shares of the page from its upper left corner.
    pub(super) fn at(&self, place: &Place) -> [f64; 2] {
        let ([left, low], [right, high]) = (self.page.low(), self.page.high());
        [(place.position.x - left) / (right - left), (high - place.position.y) / (high - low)]
    }

    /// Fills `sight` with the image of a scene; with an empty one where there are no sketches.
    pub(super) fn see(&self, net: &Filtered, sketches: Option<&Sketches>, sight: &mut Sight) {
        sight.bits.clear();
        if let Some(sketches) = sketches {
            sketches.image(self.member, &mut sight.bits);
        }
        sight.bits.resize(self.bits.len(), 0);
        net.see_scene(self.page.size(), &sight.bits, &mut sight.view.scene);
    }
}

/// The inputs of a place: x and y on the page, and the direction as an angle from 0 to a full turn.
pub(super) fn of_place(net: &Filtered, at: [f64; 2], place: &Place) -> impl Iterator<Item = (u32, f32)> {
    let count = net.form().features as u32;
    let heading = place.forward.y.atan2(place.forward.x).rem_euclid(TAU);
    (count.saturating_sub(OF_PLACE)..count).zip([at[0], at[1], heading].map(|x| x as f32))
}

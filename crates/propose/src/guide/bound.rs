//! A guide for one program: what each of its sites sees, and how it draws.

use super::form::GuideForm;
use super::images::{Images, of_place};
use super::inputs::place;
use super::{Guide, Network};
use niwaki_geom::sketch::product::Sketches;
use niwaki_geom::{Aabb, Place, Placement, Vec3, WindowForm, vec3};
use niwaki_guide::filtered::View;
use niwaki_guide::{Lesson, Net, Scratch};
use niwaki_math::{Dist, Draw, MOST_NUMBERS, Stream};
use niwaki_run::Task;
use niwaki_run::chooser::{Chosen, Context};
use niwaki_vm::code::SiteKind;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::state::State;
use niwaki_vm::value::Value;
use std::collections::HashMap;
use std::sync::Arc;

/// A guide for one program.
#[derive(Debug)]
pub struct BoundGuide {
    guide: Arc<Guide>,
    sites: HashMap<u128, Site>,
    windows: Vec<(usize, WindowForm)>,
    /// The page of a guide of the dissertation's architecture.
    images: Option<Images>,
    /// Where it looks from as long as nothing says where: the middle of what it looks at.
    middle: Place,
    /// Parts of the guide that the program or its score does not have, for people.
    pub lost: Vec<String>,
}

/// A site of the program that the guide draws.
#[derive(Debug)]
struct Site {
    /// Its number in the guide.
    number: usize,
    /// For each variable that can be read at the site, in their order, its number in the guide.
    variables: Vec<Option<u32>>,
}

/// The view of a guide, kept while place and scene stay the same, and the memory of its computations.
#[derive(Debug, Default)]
pub struct Sight {
    /// Place and number of primitives of the sums, and the drawer that they are of.
    seen: Option<(usize, Place, usize)>,
    window: Vec<f32>,
    sums: Vec<f32>,
    /// The inputs that are not zero, by number.
    pub features: Vec<(u32, f32)>,
    scratch: Scratch,
    /// The image of the scene, and what the filters make of it.
    pub bits: Vec<u64>,
    pub(super) view: View,
    /// The place, in shares of the page from its upper left corner.
    pub at: [f64; 2],
    /// A copy of a run whose next choices are looked at, and what was seen there.
    pub(crate) copy: Option<State>,
    pub(crate) prospect: Vec<f64>,
}

/// The last view of a paused run, for when the run resumes: its next choice is often at the same place.
#[derive(Clone, Debug, Default)]
pub struct Glance {
    seen: Option<(usize, Place, usize)>,
    sums: Vec<f32>,
}

impl Glance {
    /// Becomes a copy of another one.
    #[inline]
    pub fn become_copy(&mut self, other: &Glance) {
        self.seen = other.seen;
        if other.seen.is_some() {
            self.sums.clone_from(&other.sums);
        }
    }
}

impl Sight {
    /// Forgets what was seen: another run follows.
    pub fn forget(&mut self) {
        self.seen = None;
    }

    /// Leaves what was seen to the run that pauses.
    pub fn leave(&mut self, to: &mut Glance) {
        to.seen = self.seen.take();
        if to.seen.is_some() {
            to.sums.clone_from(&self.sums);
        }
    }

    /// Goes on with what a run was left, or forgets what was seen.
    pub fn recall(&mut self, from: &Glance) {
        self.seen = from.seen;
        if from.seen.is_some() {
            self.sums.clone_from(&from.sums);
        }
    }

    /// The window that was seen last, and the inputs beside it.
    pub fn inputs(&self) -> (&[f32], &[(u32, f32)]) {
        (&self.window, &self.features)
    }

    /// Adds the second hidden layer of a network at its `site`-th choice, which was looked at.
    pub fn hidden(&mut self, net: &Net, site: usize, to: &mut [f64]) {
        let hidden = net.hidden(&self.sums, &self.features, site, &mut self.scratch);
        to.iter_mut().zip(hidden).for_each(|(to, h)| *to += f64::from(*h));
    }
}

/// The member of a task's score that shows each window: the next member of the window's name.
pub(crate) fn members(
    task: &Task,
    windows: &[(String, WindowForm)],
) -> Result<Vec<(usize, WindowForm)>, String> {
    let mut from = 0;
    let mut matches = Vec::new();
    for (name, form) in windows {
        let shows = |at: &usize| {
            let sketch = &task.sketches[*at];
            sketch.name() == name && sketch.window().is_some_and(|window| window.values() == form.values())
        };
        let Some(at) = (from..task.sketches.len()).find(shows) else { return Err(name.clone()) };
        matches.push((at, form.clone()));
        from = at + 1;
    }
    Ok(matches)
}

impl BoundGuide {
    /// Binds a guide to the program and the score of a task.
    ///
    /// # Errors
    /// A guide of which nothing matches, or which looks at sketches that the score does not have.
    pub fn new(guide: Arc<Guide>, task: &Task) -> Result<BoundGuide, Fault> {
        let form = &guide.form;
        let windows = members(task, &form.windows).map_err(|name| lacking(form, &name))?;
        let images = match (&guide.net, &form.image) {
            (Network::Filtered(net), Some(image)) => {
                Some(Images::new(image, net, task).ok_or_else(|| lacking(form, &image.sketch))?)
            }
            _ => None,
        };
        let mut sites = HashMap::new();
        let mut lost = Vec::new();
        for function in &task.program.functions {
            for site in &function.sites {
                if !matches!(site.kind, SiteKind::Sample(_)) {
                    continue;
                }
                let key = format!("{:032x}", site.key);
                let Some(number) = form.sites.iter().position(|known_site| known_site.key == key) else {
                    let name = format!("{}/{}", function.name, site.label);
                    if form.left.iter().all(|(left, _)| *left != name) {
                        lost.push(format!("it does not know `{}` of `{}`", site.label, function.name));
                    }
                    continue;
                };
                let known_site = &form.sites[number];
                let variable = |name: &str| {
                    let mut all = known_site.variables.iter().copied();
                    all.find(|v| form.variables[*v as usize].name == name)
                };
                let scope = function.visible(site);
                let variables: Vec<Option<u32>> = scope.map(|seen| variable(&seen.name)).collect();
                for v in &known_site.variables {
                    if !variables.contains(&Some(*v)) {
                        let name = &form.variables[*v as usize].name;
                        lost.push(format!("`{}` of `{}` does not see `{name}`", site.label, function.name));
                    }
                }
                sites.insert(site.key, Site { number, variables });
            }
        }
        if sites.is_empty() && !form.sites.is_empty() {
            let message =
                format!("it was trained for `{}`, and none of its choices is in this model", form.model);
            return Err(Fault::new("guide-model", message)
                .with_help("train a guide for this model: `niwaki.train_guide`"));
        }
        let absent =
            (0..form.sites.len()).filter(|number| sites.values().all(|site: &Site| site.number != *number));
        lost.extend(absent.map(|number| {
            let missing_site = &form.sites[number];
            format!("the model has no `{}` of `{}`", missing_site.label, missing_site.function)
        }));
        let domain = windows.first().and_then(|(member, _)| task.sketches[*member].domain());
        let middle = along_axes(domain.map_or(vec3(0.0, 0.0, 0.0), |domain| domain.center()));
        Ok(BoundGuide { guide, sites, windows, images, middle, lost })
    }

    /// The page of a guide of the dissertation's architecture.
    pub fn images(&self) -> Option<&Images> {
        self.images.as_ref()
    }

    /// The guide.
    pub fn guide(&self) -> &Arc<Guide> {
        &self.guide
    }

    /// Whether it looks at the scene.
    pub fn looks(&self) -> bool {
        !self.windows.is_empty() || self.images.is_some()
    }

    /// Whether it draws the choices of a site, by key.
    pub fn knows(&self, site: u128) -> bool {
        self.sites.contains_key(&site)
    }

    /// Fills `sight` with what the guide sees at a choice; the number of the site in the guide, or `None` where it draws
    /// nothing.
    pub fn look(
        &self,
        at: &At<'_, f64>,
        dist: &Dist,
        seen: Context<'_>,
        sight: &mut Sight,
        owner: usize,
    ) -> Option<usize> {
        let site = self.sites.get(&at.site.key)?;
        let form = &self.guide.form;
        let choice = &form.sites[site.number];
        if !choice.head.fits(dist) {
            return None;
        }
        let part = at.part().or(seen.part.as_ref());
        let here = place_of(at, part).unwrap_or(self.middle);
        let now = (owner, here, seen.primitives);
        if sight.seen != Some(now) {
            let is_unchanged =
                sight.seen.is_some_and(|(viewer, _, count)| (viewer, count) == (owner, seen.primitives));
            self.see(seen.sketches, &here, is_unchanged, sight);
            sight.seen = Some(now);
        }
        sight.features.clear();
        if let (Network::Filtered(net), Some(_)) = (&self.guide.net, &self.images) {
            sight.features.extend(of_place(net, sight.at, &here));
        }
        for (variable, (_, _, value)) in site.variables.iter().zip(at.visible()) {
            if let Some(v) = variable {
                let input = &form.variables[*v as usize];
                input.kind.write(value, &here, input.first, &|cell| at.element(cell), &mut sight.features);
            }
        }
        if let (Some(first), Some(part)) = (form.part, part) {
            let numbers = of_part(part).into_iter().zip(first..);
            sight.features.extend(numbers.map(|(x, number)| (number, x as f32)));
        }
        parameters(dist, choice.parameters, &mut sight.features);
        Some(site.number)
    }

    /// Fills `sight` with what the sketches show around a place; with zeros where there are none. An image is looked at
    /// again unless it is the same.
    fn see(&self, sketches: Option<&Sketches>, here: &Place, is_unchanged: bool, sight: &mut Sight) {
        match (&self.guide.net, &self.images) {
            (Network::Shared(net), _) => {
                sight.window.clear();
                if let Some(sketches) = sketches {
                    let windows = self.windows.iter().map(|(member, window)| (*member, window));
                    sketches.look(windows, here, &mut sight.window);
                }
                sight.window.resize(self.guide.form.window_values(), 0.0);
                net.see(&sight.window, &mut sight.sums);
            }
            (Network::Filtered(net), Some(images)) => {
                sight.at = images.at(here);
                if !is_unchanged {
                    images.see(net, sketches, sight);
                }
            }
            (Network::Filtered(_), None) => {}
        }
    }

    /// Looks once more from the place of the last choice, at another scene; all other inputs stay as they are.
    pub fn look_again(&self, sketches: Option<&Sketches>, sight: &mut Sight) {
        if let Some((_, here, _)) = sight.seen.take() {
            self.see(sketches, &here, false, sight);
        }
    }

    /// Outputs for the head of the guide's `site`-th choice, which was looked at.
    fn outputs<'s>(&self, site: usize, dist: &Dist, sight: &'s mut Sight) -> &'s [f32] {
        match (&self.guide.net, &self.images) {
            (Network::Shared(net), _) => net.answer(&sight.sums, &sight.features, site, &mut sight.scratch),
            (Network::Filtered(net), Some(images)) => {
                net.answer(images.target(), sight.at, &sight.features, site, dist, &mut sight.view)
            }
            (Network::Filtered(_), None) => &[],
        }
    }

    /// A value for the choice that was looked at, which is the guide's `site`-th.
    pub fn answer(&self, site: usize, dist: &Dist, sight: &mut Sight, rng: &mut Stream) -> Chosen {
        let form = &self.guide.form;
        let drawn = form.sites[site].head.draw(self.outputs(site, dist, sight), dist, form.share, rng);
        Chosen { value: drawn.value.into(), log_prior: drawn.log_prior, log_drawn: drawn.log_drawn }
    }

    /// The log density with which it draws a value there, nats.
    pub fn log_of(&self, site: usize, dist: &Dist, value: &Draw, sight: &mut Sight) -> f64 {
        let form = &self.guide.form;
        form.sites[site].head.log_drawn(self.outputs(site, dist, sight), dist, form.share, value)
    }

    /// A value of the guide's `site`-th choice as something to learn; `None` where the head cannot draw it.
    pub fn lesson(&self, site: usize, dist: &Dist, value: &Value) -> Option<Lesson> {
        self.guide.form.sites[site].head.lesson(dist, &value.draw()?)
    }

    /// A value for a choice with its densities; `None` where the guide draws nothing.
    pub fn draw(
        &self,
        at: &At<'_, f64>,
        dist: &Dist,
        seen: Context<'_>,
        sight: &mut Sight,
        owner: usize,
        rng: &mut Stream,
    ) -> Option<Chosen> {
        let site = self.look(at, dist, seen, sight, owner)?;
        Some(self.answer(site, dist, sight, rng))
    }

    /// The log density with which it draws a value, nats; `None` where it draws nothing.
    pub fn log_drawn(
        &self,
        at: &At<'_, f64>,
        dist: &Dist,
        value: &Value,
        seen: Context<'_>,
        sight: &mut Sight,
        owner: usize,
    ) -> Option<f64> {
        let draw = value.draw()?;
        let site = self.look(at, dist, seen, sight, owner)?;
        Some(self.log_of(site, dist, &draw, sight))
    }
}

/// A guide that looks at what the score does not have.
fn lacking(form: &GuideForm, name: &str) -> Fault {
    let message = format!("the guide of `{}` looks at `{name}`, which the score does not have", form.model);
    Fault::new("guide-score", message).with_help("search by the score that the guide was trained for")
}

/// Where a choice is: the frame that was assigned last in its scope, or else the middle of the last part on its call path.
/// A frame is in that of its function, if the function is placed; without another place, that is the place.
fn place_of(at: &At<'_, f64>, part: Option<&Aabb>) -> Option<Place> {
    let (outer, look) = (at.frame(), at.look().and_then(place));
    let placed = |inner: Place| outer.map_or(inner, |outer| outer_place(outer, inner));
    look.map(placed)
        .or_else(|| part.map(|part| along_axes(part.center())))
        .or_else(|| outer.map(|outer| outer_place(outer, along_axes(Vec3::ZERO))))
}

/// A place in a frame, as a place in the world.
fn outer_place(outer: Placement, inner: Place) -> Place {
    Place {
        position: outer.apply(inner.position),
        forward: outer.rotation.apply(inner.forward),
        up: outer.rotation.apply(inner.up),
        ..inner
    }
}

/// A place that looks along +y, with +z up.
fn along_axes(position: Vec3) -> Place {
    Place { position, forward: vec3(0.0, 1.0, 0.0), up: vec3(0.0, 0.0, 1.0), scale: 1.0 }
}

/// The middle and the half sizes of a part.
pub const OF_PART: [&str; 6] =
    ["middle.x", "middle.y", "middle.z", "half size x", "half size y", "half size z"];

/// The numbers of a part, as [`OF_PART`] names them.
fn of_part(part: &Aabb) -> [f64; 6] {
    let (middle, half) = (part.center(), part.extent() * 0.5);
    [middle.x, middle.y, middle.z, half.x, half.y, half.z]
}

/// Adds the prior's parameters, from input `first` on.
fn parameters(dist: &Dist, (first, count): (u32, u32), to: &mut Vec<(u32, f32)>) {
    let mut all = [0.0; MOST_NUMBERS];
    let n = dist.numbers(&mut all).min(count as usize);
    to.extend(all[..n].iter().enumerate().map(|(i, x)| (first + i as u32, *x as f32)));
}

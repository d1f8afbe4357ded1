//! Products of sketches of one scene: scores multiply, so their logs add.
//!
//! Sketches are updated in order. When a sketch forbids the scene, the sketches after it keep a list of waiting primitives.
//! They catch up as soon as the sketches before allow the scene again. So the state depends on the scene only, not on its
//! history.

use super::score::{Sketch, SketchSpec};
use crate::solids::primitive::Primitive;
use crate::window::{Place, WindowForm};
use niwaki_math::{Total, grid};
use std::sync::Arc;

/// An ordered list of sketches, scored together.
#[derive(Default)]
pub struct Sketches {
    members: Vec<Member>,
}

struct Member {
    name: &'static str,
    sketch: Box<dyn Sketch>,
    /// The score of the primitives that the sketch has seen.
    log_score: f64,
    /// Primitives of the scene that the sketch has not seen yet.
    waiting: Vec<Primitive>,
}

impl Member {
    fn fork(&self) -> Member {
        Member {
            name: self.name,
            sketch: self.sketch.fork(),
            log_score: self.log_score,
            waiting: self.waiting.clone(),
        }
    }

    fn become_copy(&mut self, other: &Member) -> bool {
        self.name = other.name;
        self.log_score = other.log_score;
        self.waiting.clone_from(&other.waiting);
        self.sketch.become_copy(&*other.sketch)
    }

    fn is_forbidden(&self) -> bool {
        self.log_score == f64::NEG_INFINITY
    }

    /// Adds the waiting primitives to the sketch, and another.
    fn see(&mut self, last: Option<&Primitive>) {
        for primitive in self.waiting.drain(..) {
            self.sketch.add(&primitive);
        }
        if let Some(primitive) = last {
            self.sketch.add(primitive);
        }
        self.log_score = self.sketch.log_score();
    }
}

impl Clone for Sketches {
    fn clone(&self) -> Sketches {
        self.fork()
    }
}

impl Sketches {
    /// The empty scene as `specs` see it, in order.
    pub fn start(specs: &[Arc<dyn SketchSpec>]) -> Sketches {
        let member = |spec: &Arc<dyn SketchSpec>| {
            let sketch = spec.start();
            Member { name: spec.name(), log_score: sketch.log_score(), sketch, waiting: Vec::new() }
        };
        Sketches { members: specs.iter().map(member).collect() }
    }

    /// Number of sketches.
    pub fn len(&self) -> usize {
        self.members.len()
    }

    /// True when nothing is scored.
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// The sketches with their names, in order. A sketch after the first that forbids the scene may not have seen all of it.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &dyn Sketch)> {
        self.members.iter().map(|m| (m.name, &*m.sketch))
    }

    /// Adds a primitive to the scene; returns the name of the first sketch that now forbids it.
    pub fn add(&mut self, primitive: &Primitive) -> Option<&'static str> {
        let mut forbidden = None;
        for member in &mut self.members {
            if forbidden.is_some() {
                member.waiting.push(primitive.clone());
                continue;
            }
            member.see(Some(primitive));
            forbidden = member.is_forbidden().then_some(member.name);
        }
        forbidden
    }

    /// Removes a primitive from the scene. Returns false without a change if the scene has no equal primitive.
    pub fn remove(&mut self, primitive: &Primitive) -> bool {
        for (i, member) in self.members.iter_mut().enumerate() {
            if let Some(at) = member.waiting.iter().position(|p| p == primitive) {
                member.waiting.remove(at);
            } else if !member.sketch.remove(primitive) {
                // All members hold the same scene, so the first one decides.
                debug_assert_eq!(i, 0, "sketches of one scene disagree about it");
                return false;
            }
        }
        self.catch_up();
        true
    }

    /// Removes primitives from the scene, adds others, and then scores it once. Returns false if the scene lacked one of
    /// `removed`: the sketches are not usable afterwards.
    pub fn exchange<'a>(
        &mut self,
        removed: impl Iterator<Item = &'a Primitive> + Clone,
        added: impl Iterator<Item = &'a Primitive> + Clone,
    ) -> bool {
        for member in &mut self.members {
            for primitive in removed.clone() {
                if let Some(at) = member.waiting.iter().position(|p| p == primitive) {
                    member.waiting.swap_remove(at);
                } else if !member.sketch.remove(primitive) {
                    return false;
                }
            }
            member.waiting.extend(added.clone().cloned());
        }
        self.catch_up();
        true
    }

    /// Prepares for removals: the data that they need is kept from now on, so that copies share it.
    pub fn expect_removals(&mut self) {
        self.members.iter_mut().for_each(|member| member.sketch.expect_removals());
    }

    /// Prepares for windows: the data that they need is kept from now on, so that copies share it.
    pub fn expect_windows(&mut self) {
        self.members.iter_mut().for_each(|member| member.sketch.expect_windows());
    }

    /// Appends the view of each form from its sketch, by number. A sketch after the first that forbids the scene lacks waiting
    /// primitives: look at allowed scenes only.
    pub fn look<'a>(
        &self,
        forms: impl IntoIterator<Item = (usize, &'a WindowForm)>,
        place: &Place,
        out: &mut Vec<f32>,
    ) {
        for (number, form) in forms {
            self.members[number].sketch.look(form, place, out);
        }
    }

    /// Appends the image of the sketch of that number, as [`Sketch::image`] does.
    pub fn image(&self, number: usize, out: &mut Vec<u64>) {
        self.members[number].sketch.image(out);
    }

    /// Name of the first sketch that forbids the scene.
    pub fn forbidden_by(&self) -> Option<&'static str> {
        self.members.iter().find(|m| m.is_forbidden()).map(|m| m.name)
    }

    /// Sum of the log scores up to the first sketch that forbids the scene, nats.
    pub fn total(&self) -> Total {
        let mut sum = Total::default();
        for member in &self.members {
            sum.add(grid(member.log_score));
            if member.is_forbidden() {
                break;
            }
        }
        sum
    }

    /// [`Sketches::total`] as a number.
    pub fn log_score(&self) -> f64 {
        self.total().value()
    }

    /// A copy that shares unchanged data.
    pub fn fork(&self) -> Sketches {
        Sketches { members: self.members.iter().map(Member::fork).collect() }
    }

    /// Becomes a copy of `other`, in place if both have sketches of the same kinds.
    pub fn become_copy(&mut self, other: &Sketches) {
        let has_equal_count = self.members.len() == other.members.len();
        if !has_equal_count
            || !self.members.iter_mut().zip(&other.members).all(|(to, from)| to.become_copy(from))
        {
            *self = other.fork();
        }
    }

    /// Named numbers of all sketches, in order.
    pub fn measures(&self) -> Vec<(&'static str, f64)> {
        self.iter().flat_map(|(_, sketch)| sketch.measures()).collect()
    }

    /// Share of cells that are equal in the scene and its target, if a sketch has a target.
    pub fn similarity(&self) -> Option<f64> {
        self.measures().into_iter().find(|(name, _)| *name == "similarity").map(|(_, share)| share)
    }

    /// Adds to each sketch its waiting primitives, up to the first that forbids the scene.
    fn catch_up(&mut self) {
        for member in &mut self.members {
            member.see(None);
            if member.is_forbidden() {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    //! Forbidden scenes stop the later sketches, which catch up when the scene is allowed again.
    use super::*;
    use crate::{Look, Rule, Shape, Target, match_volume, no_self_intersection, vec3};

    fn cube(x: f64) -> Primitive {
        let shape = Shape::cuboid(vec3(x, 0.0, 0.0), vec3(1.0, 1.0, 1.0), &Look::default()).unwrap();
        Primitive::new([shape])
    }

    #[test]
    fn later_sketches_wait_and_catch_up() {
        let mesh = cube(0.0).shapes()[0].world_mesh().clone();
        let target = Arc::new(Target::new(mesh, 0.1).unwrap());
        let specs = [no_self_intersection(Rule::Solid), match_volume(target, 0.02).unwrap()];
        let mut scene = Sketches::start(&specs);
        let empty = scene.log_score();
        assert_eq!(scene.add(&cube(0.0)), None);
        let single = scene.log_score();
        assert!(single > empty);
        assert_eq!(scene.add(&cube(0.5)), Some("no_self_intersection"));
        assert_eq!(scene.log_score(), f64::NEG_INFINITY);
        assert_eq!(scene.add(&cube(1.5)), Some("no_self_intersection"));
        assert!(!scene.remove(&cube(7.0)));
        assert!(scene.remove(&cube(0.5)));
        let mut plain = Sketches::start(&specs);
        plain.add(&cube(1.5));
        plain.add(&cube(0.0));
        assert_eq!(scene.log_score(), plain.log_score());
        assert!(scene.remove(&cube(1.5)));
        assert_eq!(scene.log_score(), single);
        // The same by exchanges: one that is forbidden, and back.
        let (old, new) = ([cube(0.0)], [cube(1.5), cube(1.7)]);
        assert!(scene.exchange(old.iter(), new.iter()));
        assert_eq!(scene.forbidden_by(), Some("no_self_intersection"));
        assert!(scene.exchange(new.iter(), old.iter()));
        assert_eq!((scene.log_score(), scene.forbidden_by()), (single, None));
        assert!(scene.remove(&cube(0.0)));
        assert_eq!(scene.log_score(), empty);
    }

    /// A copy in place is a copy, also of a scene that is forbidden, and the two are independent.
    #[test]
    fn a_copy_in_place_is_a_copy() {
        let target = Arc::new(Target::new(cube(0.0).shapes()[0].world_mesh().clone(), 0.1).unwrap());
        let specs = [no_self_intersection(Rule::Solid), match_volume(target, 0.02).unwrap()];
        for places in [vec![0.0], vec![0.0, 0.5], vec![0.0, 0.5, 1.5]] {
            let (mut from, mut to, mut other) =
                (Sketches::start(&specs), Sketches::start(&specs), Sketches::default());
            to.add(&cube(0.3));
            for x in places {
                from.add(&cube(x));
            }
            let score = from.log_score();
            to.become_copy(&from);
            other.become_copy(&from);
            assert_eq!((to.log_score(), other.log_score()), (score, score));
            assert_eq!((to.measures(), other.measures()), (from.measures(), from.measures()));
            // Waiting primitives were copied too: once the scene is allowed again, both are equal.
            to.add(&cube(3.0));
            assert_eq!(from.log_score(), score);
            from.add(&cube(3.0));
            for scene in [&mut from, &mut to] {
                scene.remove(&cube(0.5));
            }
            assert_eq!((to.log_score(), to.measures()), (from.log_score(), from.measures()));
        }
    }
}

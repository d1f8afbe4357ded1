//! Sketches: after any additions, removals and copies a sketch is that of the shapes that stand, to the bit.

use crate::numbers::{below, near};
use crate::solids::primitive;
use arbitrary::Unstructured;
use niwaki_geom::view::{Camera, Lens};
use niwaki_geom::{
    Aabb, CellWeight, Drawing, Look, Page, Picture, Place, Primitive, Rule, Shape, Sketch, SketchSpec,
    Sketches, Target, TargetPicture, Texture, Vec3, avoid, fill_drawing, floor, limits, match_drawing,
    match_image, match_shadow, match_volume, match_volume_by, no_overshoot, no_self_intersection, vec3,
};
use std::sync::{Arc, OnceLock};

/// Steps of a history.
const STEPS: usize = 24;
/// Copies that are kept.
const COPIES: usize = 4;

/// Follows one sketch, or three as one, through a history.
///
/// # Panics
/// When it differs from a sketch of the shapes that stand, or a copy changed.
pub fn check(bytes: &[u8]) {
    let u = &mut Unstructured::new(bytes);
    let specs = specs();
    if below(u, 4) == 0 {
        let three: Vec<_> = (0..3).map(|_| specs[below(u, specs.len())].clone()).collect();
        together(u, &three);
    } else {
        let number = below(u, specs.len());
        alone(u, &*specs[number]);
    }
}

/// Every kind of sketch, over targets that are made once.
fn specs() -> &'static [Arc<dyn SketchSpec>] {
    static SPECS: OnceLock<Vec<Arc<dyn SketchSpec>>> = OnceLock::new();
    SPECS.get_or_init(|| {
        let cube = Shape::cuboid(Vec3::ZERO, vec3(2.0, 3.0, 1.5), &Look::default()).expect("a box");
        let target = Arc::new(Target::new(cube.world_mesh().clone(), 0.25).expect("a target"));
        let page = Page::new([-2.0, -1.5], [2.0, 1.5], [40, 30]).expect("a page");
        let on = |k: usize| (k % 40).abs_diff(20) + (k / 40).abs_diff(15) < 12;
        let greys: Vec<u8> = (0..1200).map(|k| if on(k) { (k % 250) as u8 } else { 255 }).collect();
        let drawing = Arc::new(Drawing::new(page.clone(), &greys).expect("a drawing"));
        let picture = |lens: Lens| {
            let up = vec3(0.0, 1.0, 0.0);
            let camera = Camera::new(vec3(0.5, 1.0, 6.0), Vec3::ZERO, up, lens).expect("a camera");
            let wanted = TargetPicture {
                size: [40, 30],
                on: (0..1200).map(on).collect(),
                greys: Some(greys.clone()),
                multiplier: 1.5,
            };
            Arc::new(Picture::new(&wanted, camera.rays([40, 30])).expect("a picture"))
        };
        let parallel = picture(Lens::Orthographic { height: 4.0 });
        let domain = Aabb { low: vec3(-1.0, -1.5, -1.0), high: vec3(1.0, 1.5, 1.0) };
        vec![
            no_self_intersection(Rule::Solid),
            no_self_intersection(Rule::Surface),
            match_volume(target.clone(), 0.02).expect("a sketch"),
            match_image(picture(Lens::Perspective { fov: 0.9, near: 0.1 }), 0.02).expect("a sketch"),
            match_image(parallel.clone(), 0.02).expect("a sketch"),
            match_shadow(parallel, 0.02).expect("a sketch"),
            match_drawing(drawing, 0.02).expect("a sketch"),
            fill_drawing(Texture { page, share: 0.5, sigma: 0.01 }).expect("a sketch"),
            avoid(target.clone()),
            floor(-1.0).expect("a sketch"),
            no_overshoot(domain, 0.3).expect("a sketch"),
            limits(Some([1.0, 2.0]), Some(domain), 0.3).expect("a sketch"),
            match_volume_by(target, 0.02, CellWeight::Balanced).expect("a sketch"),
        ]
    })
}

/// All that a sketch says, as bits.
fn said(spec: &dyn SketchSpec, sketch: &dyn Sketch, place: &Place) -> String {
    let measures: Vec<_> = sketch.measures().iter().map(|(name, x)| (*name, x.to_bits())).collect();
    let (mut window, mut image) = (vec![], vec![]);
    if let Some(form) = spec.window() {
        sketch.look(&form, place, &mut window);
        assert_eq!(window.len(), form.values());
    }
    sketch.image(&mut image);
    let window: Vec<u32> = window.iter().map(|x| x.to_bits()).collect();
    assert!(!sketch.log_score().is_nan(), "{}: {measures:?}", spec.name());
    format!("{:?} {measures:?} {window:?} {image:?}", sketch.log_score().to_bits())
}

fn alone(u: &mut Unstructured<'_>, spec: &dyn SketchSpec) {
    let place = Place::new(near(u), near(u), Some(near(u)));
    let place = place.or_else(|| Place::new(Vec3::ZERO, Vec3::AXES[0], None)).expect("a place");
    let (mut sketch, mut stand) = (spec.start(), Vec::<Primitive>::new());
    let mut copies: Vec<(Box<dyn Sketch>, Vec<Primitive>)> = vec![];
    for _ in 0..STEPS {
        if u.is_empty() {
            break;
        }
        match below(u, 10) {
            0..4 => {
                let Some(primitive) = primitive(u) else { continue };
                sketch.add(&primitive);
                stand.push(primitive);
            }
            4 if !stand.is_empty() => {
                // Once more the same.
                let primitive = stand[below(u, stand.len())].clone();
                sketch.add(&primitive);
                stand.push(primitive);
            }
            5 | 6 if !stand.is_empty() => {
                let gone = stand.swap_remove(below(u, stand.len()));
                assert!(sketch.remove(&gone), "{}: it was there", spec.name());
            }
            7 => {
                let Some(primitive) = primitive(u) else { continue };
                let there = stand.iter().position(|other| *other == primitive);
                let removed = sketch.remove(&primitive);
                assert_eq!(removed, there.is_some(), "{}: {primitive:?}", spec.name());
                there.map(|at| stand.swap_remove(at));
            }
            8 if copies.len() < COPIES => copies.push((sketch.fork(), stand.clone())),
            8 => {
                let (copy, then) = &copies[below(u, copies.len())];
                assert!(sketch.become_copy(&**copy));
                stand.clone_from(then);
            }
            _ if below(u, 2) == 0 => sketch.expect_removals(),
            _ => sketch.expect_windows(),
        }
        compare(spec, &*sketch, &stand, &place);
    }
    for (copy, then) in &copies {
        compare(spec, &**copy, then, &place);
    }
}

/// The sketch says what one of these shapes says, added in the other order.
fn compare(spec: &dyn SketchSpec, sketch: &dyn Sketch, stand: &[Primitive], place: &Place) {
    let mut fresh = spec.start();
    stand.iter().rev().for_each(|primitive| fresh.add(primitive));
    assert_eq!(said(spec, sketch, place), said(spec, &*fresh, place), "{} of {stand:?}", spec.name());
}

/// Several sketches of one scene, of which the first that forbids it keeps the others waiting.
fn together(u: &mut Unstructured<'_>, specs: &[Arc<dyn SketchSpec>]) {
    let (mut sketches, mut stand) = (Sketches::start(specs), Vec::<Primitive>::new());
    let mut copy = (sketches.fork(), vec![]);
    for _ in 0..STEPS {
        if u.is_empty() {
            break;
        }
        match below(u, 8) {
            0..3 => {
                let Some(primitive) = primitive(u) else { continue };
                sketches.add(&primitive);
                stand.push(primitive);
            }
            3 if !stand.is_empty() => {
                let gone = stand.swap_remove(below(u, stand.len()));
                assert!(sketches.remove(&gone), "it was there");
            }
            4 if !stand.is_empty() => {
                let gone = stand.swap_remove(below(u, stand.len()));
                let come = primitive(u);
                assert!(sketches.exchange(std::iter::once(&gone), come.iter()), "it was there");
                stand.extend(come);
            }
            5 => copy = (sketches.fork(), stand.clone()),
            6 => {
                sketches.become_copy(&copy.0);
                stand.clone_from(&copy.1);
            }
            _ if below(u, 2) == 0 => sketches.expect_removals(),
            _ => sketches.expect_windows(),
        }
        let mut fresh = Sketches::start(specs);
        stand.iter().rev().for_each(|primitive| _ = fresh.add(primitive));
        let of = |sketches: &Sketches| (sketches.log_score().to_bits(), sketches.forbidden_by());
        assert_eq!(of(&sketches), of(&fresh), "{stand:?}");
    }
}

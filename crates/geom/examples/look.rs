//! The cost of a window: a view from a place, and the update of its data while shapes are added.
//!
//! `cargo run --release -p niwaki-geom --example look`
//!
//! Input: walks of 40 strokes in a window of 24 by 24 for drawings, 200 forward ships for a block and for a picture. Prints microseconds for each look and for each stroke
//! added to a copy. The windows are checked against those of sketches that do not expect windows.

#[path = "../tests/scenes/mod.rs"]
mod scenes;

use niwaki_geom::view::{Camera, Lens};
use niwaki_geom::{
    Drawing, Look, Page, Picture, Place, Primitive, Shape, SketchSpec, Sketches, Target, TargetPicture,
    Texture, Vec3, WindowForm, fill_drawing, match_drawing, match_image, match_volume, vec3,
};
use scenes::{Dice, ship::ship};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

/// Looks from the same place in a row.
const REPEAT: u32 = 4;

fn main() {
    for side in [50, 100, 200] {
        let page = Page::new([-12.0, -2.0], [12.0, 22.0], [side, side]).expect("a page");
        let greys: Vec<u8> = (0..side * side).map(|p| if p / side % 3 == 0 { 0 } else { 255 }).collect();
        let drawing = Drawing::new(page.clone(), &greys).expect("a drawing");
        let spec = match_drawing(Arc::new(drawing), 0.014).expect("a sketch");
        measure(&format!("match_drawing {side}"), &spec, &walks());
        let texture = Texture { page, share: 0.5, sigma: 0.007 };
        measure(&format!("fill_drawing {side}"), &fill_drawing(texture).expect("a sketch"), &walks());
    }
    let block = Shape::cuboid(vec3(0.03, 0.36, -2.29), vec3(18.44, 3.24, 15.22), &Look::default());
    let block = block.expect("a block");
    for voxel in [0.25, 0.125, 0.0625] {
        let target = Target::new(block.world_mesh().clone(), voxel).expect("a target");
        let name = format!("match_volume {:?}", target.grid().dims());
        measure(&name, &match_volume(Arc::new(target), 0.02).expect("a sketch"), &ships());
    }
    for side in [50, 200] {
        let lens = Lens::Perspective { fov: 0.8, near: 0.1 };
        let camera = Camera::new(vec3(5.0, 20.0, -30.0), Vec3::ZERO, vec3(0.0, 1.0, 0.0), lens);
        let rays = camera.expect("a camera").rays([side; 2]);
        let on = (0..side * side).map(|p| p / side % 3 == 0).collect();
        let target = TargetPicture { size: [side; 2], on, greys: None, multiplier: 0.0 };
        let picture = Picture::new(&target, rays).expect("a picture");
        let spec = match_image(Arc::new(picture), 0.02).expect("a sketch");
        measure(&format!("match_image {side}"), &spec, &ships());
    }
}

/// Primitives, and a place at each.
type Walk = Vec<(Primitive, Place)>;

fn walks() -> Vec<Walk> {
    let walk = |walk: u32| {
        let (mut at, mut turn) = (vec3(0.0, 10.0, 0.0), f64::from(walk));
        let step = |step: u32| {
            turn += f64::from((walk * 31 + step * 17) % 13) / 6.0 - 1.0;
            let (start, ahead) = (at, vec3(turn.cos(), turn.sin(), 0.0));
            at = if (start + ahead * 2.0).norm() > 14.0 { vec3(0.0, 10.0, 0.0) } else { start + ahead * 2.0 };
            let stroke = Shape::stroke(start, start + ahead * 2.0, (0.75, 0.75), &Look::default());
            (Primitive::new([stroke.expect("a stroke")]), Place::new(at, ahead, None).expect("a place"))
        };
        (0..40).map(step).collect()
    };
    (0..200).map(walk).collect()
}

/// Forward ships of about 16 parts.
fn ships() -> Vec<Walk> {
    let mut dice = Dice::new(4);
    let place = |part: &Primitive, dice: &mut Dice| {
        Place::new(part.aabb().center(), dice.point(1.0), Some(dice.point(1.0))).expect("a place")
    };
    let with_places =
        |_: usize| ship(&mut dice).into_iter().map(|part| (part.clone(), place(&part, &mut dice))).collect();
    (0..200).map(with_places).collect()
}

fn measure(name: &str, spec: &Arc<dyn SketchSpec>, walks: &[Walk]) {
    let form = spec.window().expect("a window");
    let steps: usize = walks.iter().map(Vec::len).sum();
    // The least of some rounds: other programs run too.
    let mut least = [f64::INFINITY; 3];
    for _ in 0..5 {
        let mut spent = [0.0; 3];
        for expects in [0, 1] {
            walks.iter().for_each(|walk| round(walk, spec, &form, expects, &mut spent));
        }
        least = std::array::from_fn(|k| least[k].min(spent[k] / steps as f64));
    }
    let [plain, with, look] = least;
    println!(
        "{name}: look {look:.2} us ({} numbers); add {plain:.2} us, with windows {with:.2} us",
        form.values()
    );
}

/// Adds to `spent` microseconds of adding without windows, with them, and of looking.
fn round(walk: &Walk, spec: &Arc<dyn SketchSpec>, form: &WindowForm, expects: usize, spent: &mut [f64; 3]) {
    let mut particle = Sketches::start(std::slice::from_ref(spec));
    if expects == 1 {
        particle.expect_windows();
    }
    let (mut seen, mut plain) = (Vec::new(), Vec::new());
    for (primitive, place) in walk {
        let started = Instant::now();
        let mut next = particle.fork();
        next.add(primitive);
        spent[expects] += started.elapsed().as_secs_f64() * 1e6;
        particle = next;
        if expects == 1 {
            let started = Instant::now();
            for _ in 0..REPEAT {
                seen.clear();
                particle.look([(0, black_box(form))], black_box(place), &mut seen);
            }
            spent[2] += started.elapsed().as_secs_f64() * 1e6 / f64::from(REPEAT);
            black_box(&seen);
        }
    }
    if expects == 1 {
        let mut unprepared = Sketches::start(std::slice::from_ref(spec));
        for (primitive, _) in walk {
            unprepared.add(primitive);
        }
        unprepared.look([(0, form)], &walk.last().expect("a step").1, &mut plain);
        assert!(plain == seen, "a look without preparation shows something else");
    }
}

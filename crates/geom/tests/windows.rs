//! Windows show what plain loops over pixels and cells count, turn with the scene, and depend on the scene alone, not on
//! how it came about.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

mod scenes;

use niwaki_geom::view::{Camera, Lens, Light, Rays, shadow_rays};
use niwaki_geom::{
    Drawing, Look, Page, Picture, Place, Primitive, Shape, Sketch, SketchSpec, Sketches, Target,
    TargetPicture, Texture, TriMesh, Vec3, VolumeMatch, WindowForm, WindowKind, fill_drawing, match_drawing,
    match_image, match_shadow, match_volume, vec3,
};
use scenes::{Dice, any_shape, torus};
use std::sync::Arc;

fn look(sketch: &dyn Sketch, form: &WindowForm, place: &Place) -> Vec<f32> {
    let mut out = vec![7.0];
    sketch.look(form, place, &mut out);
    assert_eq!((out.len(), out[0]), (form.values() + 1, 7.0));
    out.split_off(1)
}

fn close(a: &[f32], b: &[f32], most: f32) {
    assert_eq!(a.len(), b.len());
    let worst = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(worst <= most, "{worst}: {a:?} {b:?}");
}

fn any_place(dice: &mut Dice, reach: f64) -> Place {
    let mut place = Place::new(dice.point(reach), dice.point(1.0), Some(dice.point(1.0))).unwrap();
    place.scale = [1.0, 1.0, 0.3, 2.5][dice.below(4)];
    place
}

fn any_primitive(dice: &mut Dice) -> Primitive {
    let stroke = |dice: &mut Dice| {
        let (a, b) = (dice.point(2.0), dice.point(2.0));
        Shape::stroke(a, vec3(b.x, b.y, a.z), (0.3, 0.5), &Look::default()).unwrap()
    };
    let shape = |dice: &mut Dice| if dice.below(2) == 0 { stroke(dice) } else { any_shape(dice, 1.5) };
    Primitive::new((0..1 + dice.below(2)).map(|_| shape(dice)).collect::<Vec<Shape>>())
}

/// Shares of each cell by `of(column, row)`, pixel by pixel; `outside` is what a pixel that is not on the page shows.
fn by_pixels(
    form: &WindowForm,
    (at, ahead): ([f64; 2], [f64; 2]),
    (size, pixel, scale): ([usize; 2], [f64; 2], f64),
    outside: [f64; 2],
    of: impl Fn(usize, usize) -> [f64; 2],
) -> Vec<f32> {
    let mut all = Vec::new();
    for point in &form.points {
        let [a, b, _] = point.at.map(|length| length * scale);
        // World units, y upwards, from the page's upper left corner.
        let middle = [at[0] + a * ahead[0] - b * ahead[1], at[1] + a * ahead[1] + b * ahead[0]];
        let half = 0.5 * point.cell * scale;
        let overlap = |low: f64, high: f64, middle: f64| {
            (high.min(middle + half) - low.max(middle - half)).max(0.0) / (2.0 * half)
        };
        let (mut sums, mut inside) = ([0.0; 2], 0.0);
        for row in 0..size[1] {
            for column in 0..size[0] {
                let (x, y) = (column as f64 * pixel[0], -(row as f64 + 1.0) * pixel[1]);
                let part = overlap(x, x + pixel[0], middle[0]) * overlap(y, y + pixel[1], middle[1]);
                let shown = of(column, row);
                inside += part;
                sums = [sums[0] + part * shown[0], sums[1] + part * shown[1]];
            }
        }
        let beyond = 1.0 - inside;
        all.extend([0, 1].map(|k| (sums[k] + beyond * outside[k]) as f32));
    }
    all
}

fn uncovered(is_drawn: bool, covered: bool) -> [f64; 2] {
    [f64::from(is_drawn && !covered), f64::from(!is_drawn && !covered)]
}

fn any_page(dice: &mut Dice) -> Page {
    let low = [dice.uniform(-2.5, -1.5), dice.uniform(-2.5, -1.5)];
    let high = [dice.uniform(1.0, 2.5), dice.uniform(1.0, 2.5)];
    Page::new(low, high, [10 + dice.below(180), 10 + dice.below(90)]).unwrap()
}

/// Some shapes of a target, row by row.
fn blots(dice: &mut Dice, [columns, rows]: [usize; 2]) -> Vec<bool> {
    let mut on = vec![false; columns * rows];
    for _ in 0..5 {
        let (x, y, r) = (dice.below(columns) as f64, dice.below(rows) as f64, dice.uniform(2.0, 15.0));
        for (pixel, on) in on.iter_mut().enumerate() {
            *on |= (pixel as f64 % columns as f64 - x).hypot((pixel / columns) as f64 - y) < r;
        }
    }
    on[0] = true;
    on[1] = false;
    on
}

fn greys(on: &[bool]) -> Vec<u8> {
    on.iter().map(|on| if *on { 0 } else { 255 }).collect()
}

fn on_page(page: &Page, place: &Place) -> ([f64; 2], [f64; 2]) {
    let flat = |v: Vec3| [v.x / v.x.hypot(v.y), v.y / v.x.hypot(v.y)];
    ([place.position.x - page.low()[0], place.position.y - page.high()[1]], flat(place.forward))
}

#[test]
fn windows_of_drawings_agree_with_loops_over_pixels() {
    let mut dice = Dice::new(1);
    for _ in 0..6 {
        let page = any_page(&mut dice);
        let (size, on) = (page.size(), blots(&mut dice, page.size()));
        let drawing = Arc::new(Drawing::new(page.clone(), &greys(&on)).unwrap());
        let drawn = match_drawing(drawing.clone(), 0.02).unwrap();
        let texture = fill_drawing(Texture { page: page.clone(), share: 0.5, sigma: 0.1 }).unwrap();
        let form = drawn.window().unwrap();
        assert_eq!((form.values(), Some(form.clone())), (62, texture.window()));
        let (mut scene, mut drawn, mut texture) = (Vec::new(), drawn.start(), texture.start());
        for _ in 0..8 {
            let primitive = any_primitive(&mut dice);
            drawn.add(&primitive);
            texture.add(&primitive);
            scene.push(primitive);
            let mask = drawing.mask(&scene);
            let place = any_place(&mut dice, 3.0);
            let measures = (size, page.pixel(), place.scale);
            let plain = by_pixels(&form, on_page(&page, &place), measures, [0.0, 2.0], |column, row| {
                uncovered(on[row * size[0] + column], mask[row * size[0] + column])
            });
            close(&look(&*drawn, &form, &place), &plain, 2e-5);
            let held: Vec<u64> = {
                let mut words = vec![0; page.sampled_words()];
                for shape in scene.iter().flat_map(Primitive::shapes) {
                    page.sampled(shape).words().iter().for_each(|(word, bits)| words[*word as usize] |= bits);
                }
                words
            };
            let plain = by_pixels(&form, on_page(&page, &place), measures, [0.0, 1.0], |column, row| {
                [f64::from(held[page.sampled_word(column, row)] != 0), 0.0]
            });
            close(&look(&*texture, &form, &place), &plain, 2e-5);
        }
    }
}

fn camera(lens: Lens, from: Vec3) -> Camera {
    Camera::new(from, Vec3::ZERO, vec3(0.0, 1.0, 0.0), lens).unwrap()
}

fn picture(on: Vec<bool>, size: [usize; 2], rays: Rays) -> Arc<Picture> {
    Arc::new(Picture::new(&TargetPicture { size, on, greys: None, multiplier: 0.0 }, rays).unwrap())
}

/// Parallel along z, a picture is a page; in perspective the window lies where the place is seen.
#[test]
fn windows_of_pictures_agree_with_loops_over_pixels() {
    let mut dice = Dice::new(2);
    for round in 0..6 {
        let size = [20 + dice.below(80), 20 + dice.below(80)];
        let aspect = size[0] as f64 / size[1] as f64;
        let on = blots(&mut dice, size);
        let parallel = round % 2 == 0;
        let (lens, half) = match parallel {
            true => (Lens::Orthographic { height: 4.0 }, 2.0),
            false => (Lens::Perspective { fov: 0.9, near: 0.1 }, 0.45_f64.tan()),
        };
        let camera = camera(lens, vec3(0.0, 0.0, 6.0));
        let picture = picture(on.clone(), size, camera.rays(size));
        let spec = match_image(picture.clone(), 0.02).unwrap();
        let form = spec.window().unwrap();
        let (mut sketch, mut scene) = (spec.start(), Vec::new());
        for _ in 0..6 {
            let primitive = any_primitive(&mut dice);
            sketch.add(&primitive);
            scene.push(primitive);
            let mask = picture.mask(&scene);
            let place = any_place(&mut dice, 2.0);
            let fall = |p: Vec3| if parallel { [p.x, p.y] } else { [p.x / (6.0 - p.z), p.y / (6.0 - p.z)] };
            let (at, next) = (fall(place.position), fall(place.position + place.forward * 1e-6));
            let ahead = [next[0] - at[0], next[1] - at[1]];
            let length = ahead[0].hypot(ahead[1]);
            let seen = ([at[0] + half * aspect, at[1] - half], ahead.map(|x| x / length));
            let pixel = [2.0 * half * aspect / size[0] as f64, 2.0 * half / size[1] as f64];
            let plain = by_pixels(&form, seen, (size, pixel, place.scale), [0.0, 2.0], |column, row| {
                uncovered(on[row * size[0] + column], mask[row * size[0] + column])
            });
            close(&look(&*sketch, &form, &place), &plain, 2e-4);
        }
        let behind = Place::new(vec3(0.0, 0.0, 9.0), vec3(1.0, 0.0, 0.0), None).unwrap();
        let all = look(&*sketch, &form, &behind);
        assert!(parallel || all.chunks(2).all(|pair| pair == [0.0, 2.0]));
    }
}

/// The shadow of a place falls along the light: there the window shows what should be dark.
#[test]
fn windows_of_shadows_look_along_the_light() {
    let corner = |x: f64, z: f64| vec3(4.0 * x, -1.0, 4.0 * z);
    let floor = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let floor = TriMesh::new(floor, vec![[0, 2, 1], [0, 3, 2]]).unwrap();
    let (size, light) = ([90, 70], Light::new(vec3(1.0, -1.0, 0.0)).unwrap());
    let camera = camera(Lens::Perspective { fov: 0.9, near: 0.1 }, vec3(0.0, 7.0, 8.0));
    let rays = shadow_rays(&floor, &camera, &light, size).unwrap();
    // Dark where the floor has x > 0.
    let mut on = vec![false; size[0] * size[1]];
    for ray in 0..rays.len() {
        on[rays.ray(ray).pixel as usize] = rays.ray(ray).start.x > 0.0;
    }
    let picture = picture(on, size, rays);
    let spec = match_shadow(picture, 0.02).unwrap();
    let form = spec.window().unwrap();
    let mut sketch = spec.start();
    sketch.expect_windows();
    // Two units above the floor, its shadow falls two units farther along x.
    let shown = |sketch: &dyn Sketch, x: f64| {
        let place = Place::new(vec3(x, 1.0, 0.3), vec3(0.0, 0.0, 1.0), None).unwrap();
        look(sketch, &form, &place)[..2].to_vec()
    };
    close(&shown(&*sketch, -1.2), &[1.0, 0.0], 1e-6);
    close(&shown(&*sketch, -2.8), &[0.0, 1.0], 1e-6);
    close(&shown(&*sketch, 9.0), &[0.0, 2.0], 1e-6);
    let cube = Shape::cuboid(vec3(-1.2, 1.0, 0.3), vec3(1.0, 1.0, 1.0), &Look::default()).unwrap();
    sketch.add(&Primitive::new([cube]));
    close(&shown(&*sketch, -1.2), &[0.0, 0.0], 1e-6);
    close(&shown(&*sketch, 0.6), &[1.0, 0.0], 1e-6);
}

/// Both channels of the box with this number of boxes of `side` cells.
fn by_cells(sketch: &VolumeMatch, target: &Target, side: i64, first: [i64; 3]) -> [f64; 2] {
    let (dims, mut sums) = (target.grid().dims(), [0.0; 2]);
    for cell in 0..side.pow(3) {
        let at = [cell % side, cell / side % side, cell / side / side];
        let at: [i64; 3] = std::array::from_fn(|a| first[a] * side + at[a]);
        let inside = (0..3).all(|a| at[a] >= 0 && at[a] < dims[a] as i64);
        let shown = if inside {
            let cell = at.map(|x| x as usize);
            uncovered(target.contains(cell), sketch.counters().get(cell) > 0)
        } else {
            [0.0, 2.0]
        };
        sums = [sums[0] + shown[0], sums[1] + shown[1]];
    }
    sums.map(|sum| sum / side.pow(3) as f64)
}

#[test]
fn windows_of_volumes_agree_with_loops_over_cells() {
    let mut dice = Dice::new(3);
    for voxel in [0.13, 0.05, 0.03] {
        let target = Arc::new(Target::new(torus(1.4, 0.5, 12, 8), voxel).unwrap());
        let (grid, form) = (target.grid(), match_volume(target.clone(), 0.02).unwrap().window().unwrap());
        assert_eq!((form.values(), form.kind), (114, WindowKind::Solid));
        let cell = (grid.cell().x + grid.cell().y + grid.cell().z) / 3.0;
        let mut sketch = VolumeMatch::new(target.clone(), 0.02);
        sketch.expect_windows();
        for _ in 0..3 {
            sketch.add(&any_primitive(&mut dice));
            let place = any_place(&mut dice, 2.0);
            let mut plain = Vec::new();
            for point in &form.points {
                let [x, y, z] = point.at.map(|length| length * place.scale);
                let side = 1 << (point.cell * place.scale / cell).log2().round().clamp(0.0, 4.0) as i64;
                let at = place.position + place.forward * x + place.left() * y + place.up * z;
                let at = grid.to_grid(at) / side as f64 - vec3(0.5, 0.5, 0.5);
                let at = at.to_array();
                let mut sums = [0.0; 2];
                for corner in 0..8 {
                    let up = [corner & 1, corner >> 1 & 1, corner >> 2];
                    let first = std::array::from_fn(|a| at[a].floor() as i64 + up[a]);
                    let weight: f64 = (0..3)
                        .map(|a| {
                            let rest = at[a] - at[a].floor();
                            if up[a] == 1 { rest } else { 1.0 - rest }
                        })
                        .product();
                    let shown = by_cells(&sketch, &target, side, first);
                    sums = [sums[0] + weight * shown[0], sums[1] + weight * shown[1]];
                }
                plain.extend(sums.map(|sum| sum as f32));
            }
            close(&look(&sketch, &form, &place), &plain, 1e-6);
        }
    }
}

/// A page, its drawing, its scene and the place turned by 90 degrees show the same, whatever the number of pixels.
#[test]
fn a_turn_of_scene_and_place_changes_no_window() {
    let mut dice = Dice::new(4);
    let quarter = |p: Vec3| vec3(-p.y, p.x, p.z);
    let size = 37;
    let on = blots(&mut dice, [size; 2]);
    // Column x and row y go to column y and row size - 1 - x.
    let turned: Vec<bool> = (0..size * size).map(|p| on[(p % size) * size + size - 1 - p / size]).collect();
    let page = || Page::new([-2.0; 2], [2.0; 2], [size; 2]).unwrap();
    let sketch = |on: &[bool]| {
        let drawing = Drawing::new(page(), &greys(on)).unwrap();
        match_drawing(Arc::new(drawing), 0.02).unwrap()
    };
    let form = sketch(&on).window().unwrap();
    let (mut a, mut b) = (sketch(&on).start(), sketch(&turned).start());
    for _ in 0..10 {
        let ends = [dice.point(2.0), dice.point(2.0)].map(|p| vec3(p.x, p.y, 0.0));
        let stroke = |[start, end]: [Vec3; 2]| {
            Primitive::new([Shape::stroke(start, end, (0.3, 0.2), &Look::default()).unwrap()])
        };
        a.add(&stroke(ends));
        b.add(&stroke(ends.map(quarter)));
        let place = any_place(&mut dice, 2.5);
        let (position, forward) = (quarter(place.position), quarter(place.forward));
        let other = Place { position, forward, up: quarter(place.up), scale: place.scale };
        close(&look(&*a, &form, &place), &look(&*b, &form, &other), 1e-6);
    }
    // A cube of 48 cells, with boxes turned about y.
    let quarter = |p: Vec3| vec3(p.z, p.y, -p.x);
    let cuboid = |center: Vec3, size: Vec3| Shape::cuboid(center, size, &Look::default()).unwrap();
    let sketch = |arm: Shape| {
        let block = cuboid(Vec3::ZERO, vec3(2.83, 3.0, 2.83));
        let plate = cuboid(Vec3::ZERO, vec3(3.0, 0.02, 3.0));
        let parts = [&block, &arm, &plate];
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
        for mesh in parts.map(|part| part.world_mesh().clone()) {
            let first = vertices.len() as u32;
            vertices.extend_from_slice(mesh.vertices());
            triangles.extend(mesh.triangles().iter().map(|t| t.map(|v| v + first)));
        }
        let target = Target::new(TriMesh::new(vertices, triangles).unwrap(), 3.2 / 47.9).unwrap();
        assert_eq!(target.grid().dims(), [48; 3]);
        match_volume(Arc::new(target), 0.02).unwrap()
    };
    let arm = (vec3(1.0, 0.2, -0.4), vec3(0.91, 0.31, 0.53));
    let swap = |v: Vec3| vec3(v.z, v.y, v.x);
    let (a, b) = (sketch(cuboid(arm.0, arm.1)), sketch(cuboid(quarter(arm.0), swap(arm.1))));
    let form = a.window().unwrap();
    let (mut a, mut b) = (a.start(), b.start());
    for _ in 0..6 {
        let (center, size) = (dice.point(1.4), dice.point(1.0));
        let size = vec3(0.1 + size.x.abs(), 0.1 + size.y.abs(), 0.1 + size.z.abs());
        a.add(&Primitive::new([cuboid(center, size)]));
        b.add(&Primitive::new([cuboid(quarter(center), swap(size))]));
        let place = any_place(&mut dice, 2.0);
        let (position, forward) = (quarter(place.position), quarter(place.forward));
        let other = Place { position, forward, up: quarter(place.up), scale: place.scale };
        close(&look(&*a, &form, &place), &look(&*b, &form, &other), 1e-6);
    }
}

/// Random additions, removals and copies, with windows expected from the start, from later on and never.
#[test]
fn windows_depend_on_the_scene_alone() {
    let mut dice = Dice::new(5);
    let page = any_page(&mut dice);
    let on = blots(&mut dice, page.size());
    let drawing = Arc::new(Drawing::new(page.clone(), &greys(&on)).unwrap());
    let lens = Lens::Perspective { fov: 0.9, near: 0.1 };
    let rays = camera(lens, vec3(0.0, 1.0, 6.0)).rays([70, 50]);
    let specs: [Arc<dyn SketchSpec>; 4] = [
        match_drawing(drawing, 0.02).unwrap(),
        fill_drawing(Texture { page, share: 0.5, sigma: 0.1 }).unwrap(),
        match_image(picture(blots(&mut dice, [70, 50]), [70, 50], rays), 0.02).unwrap(),
        match_volume(Arc::new(Target::new(torus(1.4, 0.5, 12, 8), 0.06).unwrap()), 0.02).unwrap(),
    ];
    let forms: Vec<WindowForm> = specs.iter().map(|spec| spec.window().unwrap()).collect();
    let seen = |sketches: &Sketches, place: &Place| {
        let mut out = Vec::new();
        sketches.look(forms.iter().enumerate(), place, &mut out);
        assert_eq!(out.len(), 3 * 62 + 114);
        out
    };
    let (mut first, mut later) = (Sketches::start(&specs), Sketches::start(&specs));
    first.expect_windows();
    let (mut held, mut copies) = (Vec::new(), Vec::new());
    for step in 0..60 {
        if step == 20 {
            later.expect_windows();
        }
        if held.is_empty() || dice.below(5) < 3 {
            let primitive = any_primitive(&mut dice);
            first.add(&primitive);
            later.add(&primitive);
            held.push(primitive);
        } else {
            let removed = held.swap_remove(dice.below(held.len()));
            assert!(first.remove(&removed) && later.remove(&removed));
        }
        let place = any_place(&mut dice, 2.0);
        let mut fresh = Sketches::start(&specs);
        held.iter().rev().for_each(|primitive| assert_eq!(fresh.add(primitive), None));
        let shown = seen(&fresh, &place);
        assert!(seen(&first, &place) == shown && seen(&later, &place) == shown, "step {step}");
        match dice.below(6) {
            0 => copies.push((first.fork(), place, shown)),
            1 => {
                let mut copy = later.fork();
                copy.add(&any_primitive(&mut dice));
                copy.become_copy(&first);
                copies.push((copy, place, shown));
            }
            _ => (),
        }
    }
    for primitive in held {
        assert!(first.remove(&primitive));
    }
    let place = any_place(&mut dice, 1.0);
    assert_eq!(seen(&first, &place), seen(&Sketches::start(&specs), &place));
    assert!(copies.len() > 5 && copies.iter().all(|(copy, place, shown)| seen(copy, place) == *shown));
}

/// Two resolutions of the same target, seen with the same lengths, show nearly the same.
#[test]
fn another_resolution_shows_nearly_the_same() {
    let disc = |side: usize| {
        let on = |p: usize| {
            let (x, y) = ((p % side) as f64 + 0.5, (p / side) as f64 + 0.5);
            (x / side as f64 - 0.4).hypot(y / side as f64 - 0.5) < 0.3
        };
        let on: Vec<bool> = (0..side * side).map(on).collect();
        let page = Page::new([-2.0; 2], [2.0; 2], [side; 2]).unwrap();
        match_drawing(Arc::new(Drawing::new(page, &greys(&on)).unwrap()), 0.02).unwrap()
    };
    let form = disc(50).window().unwrap();
    assert_eq!(form, disc(200).window().unwrap());
    let (mut coarse, mut fine) = (disc(50).start(), disc(200).start());
    let mut dice = Dice::new(6);
    let (mut sum, mut count) = (0.0, 0);
    for _ in 0..10 {
        let stroke =
            Shape::stroke(vec3(-1.0, dice.uniform(-1.5, 1.5), 0.0), Vec3::ZERO, (0.3, 0.3), &Look::default());
        let stroke = Primitive::new([stroke.unwrap()]);
        coarse.add(&stroke);
        fine.add(&stroke);
        let place = any_place(&mut dice, 1.5);
        let both = [look(&*coarse, &form, &place), look(&*fine, &form, &place)];
        sum += both[0].iter().zip(&both[1]).map(|(a, b)| (a - b).abs()).sum::<f32>();
        count += form.values();
    }
    assert!(sum / (count as f32) < 0.03, "{}", sum / count as f32);
}

#[test]
fn places_and_forms_are_as_documented() {
    let place = Place::new(Vec3::ZERO, vec3(0.0, 3.0, 0.0), Some(vec3(1.0, 5.0, 0.0))).unwrap();
    assert_eq!((place.forward, place.up, place.scale), (vec3(0.0, 1.0, 0.0), vec3(1.0, 0.0, 0.0), 1.0));
    assert_eq!(place.left(), place.up.cross(place.forward));
    let place = Place::new(Vec3::ZERO, vec3(2.0, 0.0, 0.0), None).unwrap();
    assert_eq!((place.up, place.left()), (vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, -1.0)));
    assert!(
        Place::new(Vec3::ZERO, vec3(0.0, 1.0, 0.0), None).unwrap().up.dot(vec3(0.0, 1.0, 0.0)).abs() < 1e-9
    );
    assert_eq!(Place::new(Vec3::ZERO, Vec3::ZERO, None), None);
    assert_eq!(Place::new(vec3(f64::NAN, 0.0, 0.0), vec3(1.0, 0.0, 0.0), None), None);
    let form = WindowForm::flat(50.0);
    let lengths = |first: usize| {
        let [x, y, _] = form.points[first].at;
        (x.hypot(y), form.points[first].cell)
    };
    assert_eq!([1, 7, 15, 23].map(|k| lengths(k).0.round()), [2.0, 4.0, 8.0, 15.0]);
    assert!(
        WindowForm::solid(1.0).points[15..29].iter().all(|p| (Vec3::from(p.at).norm() - 0.08).abs() < 1e-12)
    );
}

//! Silhouettes and shadows agree to the pixel with a renderer that tests every ray against every triangle, and scores
//! with the published formula, in any order of adding and removing.
//!
//! The renderer shares no code with the engine's: its own camera, its own triangle test (Moeller & Trumbore 1997).
#![allow(clippy::unwrap_used)] // A test fails where it panics.

mod scenes;

use niwaki_geom::view::camera::Camera;
use niwaki_geom::view::{Lens, Light, shadow_rays};
use niwaki_geom::{
    Cylinder, Look, Picture, PictureMatch, Primitive, Shape, Sketch, Solid, TargetPicture, TriMesh, Vec3,
    match_image, vec3,
};
use scenes::{Dice, any_shape};
use std::sync::Arc;

/// A camera as a test writes it.
#[derive(Clone, Copy)]
struct Eye {
    position: Vec3,
    look_at: Vec3,
    up: Vec3,
    lens: Lens,
}

impl Eye {
    fn camera(&self) -> Camera {
        Camera::new(self.position, self.look_at, self.up, self.lens).unwrap()
    }

    /// The origin and direction of a pixel's ray, by the textbook.
    fn ray(&self, size: [usize; 2], pixel: usize) -> (Vec3, Vec3) {
        let z = (self.position - self.look_at).unit().unwrap();
        let x = self.up.cross(z).unit().unwrap();
        let y = z.cross(x);
        let (column, row) = (pixel % size[0], pixel / size[0]);
        let across = 2.0 * (column as f64 + 0.5) / size[0] as f64 - 1.0;
        let high = 1.0 - 2.0 * (row as f64 + 0.5) / size[1] as f64;
        let aspect = size[0] as f64 / size[1] as f64;
        match self.lens {
            Lens::Perspective { fov, near } => {
                let half = (fov / 2.0).tan();
                let along = x * (across * half * aspect) + y * (high * half) - z;
                (self.position + along * near, along)
            }
            Lens::Orthographic { height } => {
                let half = height / 2.0;
                (self.position + x * (across * half * aspect) + y * (high * half), -z)
            }
        }
    }
}

/// The distance of a triangle along a ray that meets it.
fn hit([a, b, c]: [Vec3; 3], start: Vec3, along: Vec3) -> Option<f64> {
    let (e, f) = (b - a, c - a);
    let p = along.cross(f);
    let scale = e.dot(p);
    let s = (start - a).dot(p) / scale;
    let q = (start - a).cross(e);
    let t = along.dot(q) / scale;
    let far = f.dot(q) / scale;
    (scale != 0.0 && s >= 0.0 && t >= 0.0 && s + t <= 1.0 && far > 0.0).then_some(far)
}

fn nearest(mesh: &TriMesh, start: Vec3, along: Vec3) -> Option<f64> {
    mesh.corners().filter_map(|t| hit(t, start, along)).min_by(f64::total_cmp)
}

/// Counts of the shapes that the ray of each pixel meets.
fn silhouettes(eye: &Eye, size: [usize; 2], shapes: &[Shape]) -> Vec<u32> {
    let met = |pixel| {
        let (start, along) = eye.ray(size, pixel);
        shapes.iter().filter(|s| nearest(&s.world_mesh(), start, along).is_some()).count() as u32
    };
    (0..size[0] * size[1]).map(met).collect()
}

/// Counts of the shapes between the light and the point that each pixel sees of the receiver; `None` without a point.
fn shadows(eye: &Eye, size: [usize; 2], floor: &TriMesh, light: Vec3, shapes: &[Shape]) -> Vec<Option<u32>> {
    let met = |pixel| {
        let (start, along) = eye.ray(size, pixel);
        let point = start + along * nearest(floor, start, along)?;
        Some(shapes.iter().filter(|s| nearest(&s.world_mesh(), point, -light).is_some()).count() as u32)
    };
    (0..size[0] * size[1]).map(met).collect()
}

fn perspective(dice: &mut Dice, distance: f64) -> Eye {
    let position = dice.point(1.0).unit().unwrap() * distance;
    let lens = Lens::Perspective { fov: dice.uniform(0.4, 1.4), near: 0.1 };
    Eye { position, look_at: dice.point(1.0), up: vec3(0.1, 1.0, 0.2), lens }
}

fn orthographic(dice: &mut Dice, distance: f64) -> Eye {
    Eye { lens: Lens::Orthographic { height: dice.uniform(4.0, 9.0) }, ..perspective(dice, distance) }
}

/// A target picture with a disc that is on and random greys.
fn target(dice: &mut Dice, size: [usize; 2]) -> TargetPicture {
    let middle = [size[0] as f64 * 0.5, size[1] as f64 * 0.4];
    let inside = |p: usize| {
        let (x, y) = ((p % size[0]) as f64 - middle[0], (p / size[0]) as f64 - middle[1]);
        x * x + y * y < middle[1] * middle[1]
    };
    let count = size[0] * size[1];
    let greys = (0..count).map(|p| if p % 3 == 0 { dice.below(256) as u8 } else { 0 }).collect();
    TargetPicture { size, on: (0..count).map(inside).collect(), greys: Some(greys), multiplier: 10.0 }
}

fn similarity_by_hand(target: &TargetPicture, on: &[bool]) -> f64 {
    let weight = |p: usize| 255 + 10 * u64::from(target.greys.as_ref().unwrap()[p]);
    let all: u64 = (0..on.len()).map(weight).sum();
    let equal: u64 = (0..on.len()).filter(|p| on[*p] == target.on[*p]).map(weight).sum();
    equal as f64 / all as f64
}

/// Adds the shapes and compares counts, mask and score with the renderer's results.
fn compare(
    picture: &Arc<Picture>,
    target: &TargetPicture,
    shapes: &[Shape],
    rendered: &[u32],
    scene: &str,
) -> PictureMatch {
    let mut sketch = PictureMatch::new("match", picture.clone(), 0.02);
    let primitives: Vec<Primitive> = shapes.chunks(2).map(Primitive::new).collect();
    primitives.iter().for_each(|p| sketch.add(p));
    for (ray, pixel) in picture.rays().pixels().iter().enumerate() {
        let expected = rendered[*pixel as usize];
        assert_eq!(sketch.tiles().get(ray), expected, "{scene}, pixel {pixel}");
    }
    let on: Vec<bool> = rendered.iter().map(|n| *n > 0).collect();
    assert!(sketch.mask() == on && picture.mask(&primitives) == on, "{scene}");
    assert_eq!(sketch.on().pixels, on.iter().filter(|on| **on).count() as i64);
    assert!((sketch.similarity() - similarity_by_hand(target, &on)).abs() < 1e-12, "{scene}");
    sketch
}

#[test]
fn silhouettes_are_those_of_every_ray_against_every_triangle() {
    let mut dice = Dice::new(5);
    let (mut lit, mut crossing) = (0, 0);
    for scene in 0..60 {
        let size = [40 + dice.below(60), 30 + dice.below(60)];
        // Near enough that some shapes are around or behind the camera.
        let distance = dice.uniform(1.0, 10.0);
        let eye =
            if scene % 3 == 0 { orthographic(&mut dice, distance) } else { perspective(&mut dice, distance) };
        let shapes: Vec<Shape> = (0..1 + dice.below(7)).map(|_| any_shape(&mut dice, 2.5)).collect();
        let target = target(&mut dice, size);
        let camera = eye.camera();
        let picture = Arc::new(Picture::new(&target, camera.rays(size)).unwrap());
        let rendered = silhouettes(&eye, size, &shapes);
        compare(&picture, &target, &shapes, &rendered, &format!("scene {scene}"));
        lit += rendered.iter().filter(|n| **n > 0).count();
        crossing += usize::from(shapes.iter().any(|s| {
            let mesh = s.world_mesh();
            let depths = mesh.vertices().iter().map(|p| camera.projection().depth(*p));
            let (low, high) =
                depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), d| (a.min(d), b.max(d)));
            low < camera.near() && high > camera.near()
        }));
    }
    assert!(
        lit > 20_000 && crossing > 5,
        "{lit} pixels on, {crossing} scenes with a shape beside the camera"
    );
}

/// A floor, or a bumpy sheet.
fn receiver(dice: &mut Dice, bumpy: bool) -> TriMesh {
    let n = if bumpy { 7 } else { 1 };
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            let at = |k: usize| k as f64 / n as f64 * 14.0 - 7.0;
            let y = if bumpy { dice.uniform(-1.5, 1.0) } else { 0.0 };
            vertices.push(vec3(at(i), y, at(j)));
            if i < n && j < n {
                let id = |i: usize, j: usize| (i * (n + 1) + j) as u32;
                triangles.push([id(i, j), id(i, j + 1), id(i + 1, j)]);
                triangles.push([id(i + 1, j), id(i, j + 1), id(i + 1, j + 1)]);
            }
        }
    }
    TriMesh::new(vertices, triangles).unwrap()
}

#[test]
fn shadows_are_those_of_every_point_against_every_triangle() {
    let mut dice = Dice::new(6);
    let (mut lit, mut under) = (0, 0);
    for scene in 0..60 {
        let size = [40 + dice.below(50), 30 + dice.below(50)];
        let mut eye =
            if scene % 4 == 0 { orthographic(&mut dice, 14.0) } else { perspective(&mut dice, 14.0) };
        eye.position.y = eye.position.y.abs() + 3.0;
        let floor = receiver(&mut dice, scene % 2 == 0);
        let light =
            vec3(dice.uniform(-1.0, 1.0), -dice.uniform(0.2, 1.0), dice.uniform(-1.0, 1.0)).unit().unwrap();
        // Around the receiver: above it, through it and below it, where they cast no shadow on it.
        let shapes: Vec<Shape> = (0..1 + dice.below(7)).map(|_| any_shape(&mut dice, 3.0)).collect();
        let rays = shadow_rays(&floor, &eye.camera(), &Light::new(light * 3.0).unwrap(), size).unwrap();
        let target = target(&mut dice, size);
        let rendered = shadows(&eye, size, &floor, light, &shapes);
        let mut seen: Vec<usize> = rays.pixels().iter().map(|p| *p as usize).collect();
        seen.sort_unstable();
        let expected: Vec<usize> = (0..rendered.len()).filter(|p| rendered[*p].is_some()).collect();
        assert_eq!(seen, expected, "scene {scene}: which pixels see the receiver");
        let counts: Vec<u32> = rendered.iter().map(|n| n.unwrap_or(0)).collect();
        let picture = Arc::new(Picture::new(&target, rays).unwrap());
        compare(&picture, &target, &shapes, &counts, &format!("scene {scene}"));
        lit += counts.iter().filter(|n| **n > 0).count();
        // The extra counts of a test without starts, which takes whole lines for rays.
        let back = shadows(&eye, size, &floor, -light, &shapes);
        under += (0..counts.len()).filter(|p| counts[*p] == 0 && back[*p].is_some_and(|n| n > 0)).count();
    }
    assert!(
        lit > 10_000 && under > 2_000,
        "{lit} pixels in shadow, {under} with a shape on the wrong side only"
    );
}

#[test]
fn shapes_on_the_floor_cast_shadows_and_shapes_below_it_do_not() {
    let floor = receiver(&mut Dice::new(0), false);
    let eye = Eye {
        position: vec3(0.0, 20.0, 0.0),
        look_at: Vec3::ZERO,
        up: vec3(0.0, 0.0, -1.0),
        lens: Lens::Orthographic { height: 14.0 },
    };
    let size = [140, 140];
    let rays = shadow_rays(&floor, &eye.camera(), &Light::new(vec3(0.0, -1.0, 0.0)).unwrap(), size).unwrap();
    assert_eq!(rays.len(), 140 * 140);
    let cube = |y: f64| Shape::cuboid(vec3(0.013, y, 0.017), vec3(2.0, 1.0, 3.0), &Look::default()).unwrap();
    assert_eq!(rays.meeting(&cube(0.5)).count(), 20 * 30);
    assert_eq!(rays.meeting(&cube(5.0)).count(), 20 * 30);
    assert_eq!(rays.meeting(&cube(0.2)).count(), 20 * 30);
    assert_eq!(rays.meeting(&cube(-0.5)).count(), 0);
}

#[test]
fn meshes_have_no_gaps_between_their_triangles() {
    // Pixel rays through the very edges and corners of a mesh's triangles: a square of unit squares, each cut in two.
    let n = 16;
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            vertices.push(vec3(f64::from(i), f64::from(j), 0.0));
            if i < n && j < n {
                let id = |i: i32, j: i32| (i * (n + 1) + j) as u32;
                triangles.push([id(i, j), id(i + 1, j), id(i + 1, j + 1)]);
                triangles.push([id(i, j), id(i + 1, j + 1), id(i, j + 1)]);
            }
        }
    }
    let sheet = Arc::new(TriMesh::new(vertices, triangles).unwrap());
    for turn in [0.0, 0.3, 1.1, 2.0] {
        let rotation = Some(niwaki_geom::Mat3::rotation(vec3(0.3, 1.0, 0.2).unit().unwrap(), 0.4 * turn));
        let shape =
            Shape::mesh(&sheet, vec3(-8.0, -8.0, 0.0), 1.0, &Look { rotation, ..Look::default() }).unwrap();
        let border: Vec<Vec3> = [0, n, n * (n + 1), n * (n + 2)]
            .iter()
            .map(|i| shape.placement().apply(sheet.vertices()[*i as usize]))
            .collect();
        let middle = (border[0] + border[3]) * 0.5;
        for perspective in [false, true] {
            let position = middle + vec3(0.0, 0.0, 30.0);
            let lens = match perspective {
                true => Lens::Perspective { fov: 0.2, near: 0.1 },
                false => Lens::Orthographic { height: 8.0 },
            };
            let eye = Eye { position, look_at: middle, up: vec3(0.0, 1.0, 0.0), lens };
            let rays = eye.camera().rays([128, 128]);
            assert_eq!(rays.meeting(&shape).count(), 128 * 128, "turn {turn}");
        }
    }
}

fn disc_picture(dice: &mut Dice) -> Arc<Picture> {
    let size = [150, 120];
    let eye = perspective(dice, 9.0);
    Arc::new(Picture::new(&target(dice, size), eye.camera().rays(size)).unwrap())
}

#[test]
fn scores_do_not_depend_on_the_order_and_removing_undoes_adding() {
    let mut dice = Dice::new(8);
    let picture = disc_picture(&mut dice);
    let primitives: Vec<Primitive> =
        (0..40).map(|_| Primitive::new([any_shape(&mut dice, 2.0), any_shape(&mut dice, 2.0)])).collect();
    let empty = PictureMatch::new("match", picture.clone(), 0.02);
    let (mut forward, mut backward) = (empty.clone(), empty.clone());
    primitives.iter().for_each(|p| forward.add(p));
    primitives.iter().rev().for_each(|p| backward.add(p));
    assert!(forward == backward && forward.log_score().to_bits() == backward.log_score().to_bits());
    let mut rest = empty.clone();
    for (i, p) in primitives.iter().enumerate() {
        if i % 2 == 0 {
            assert!(forward.remove(p));
            assert!(!forward.remove(p));
        } else {
            rest.add(p);
        }
    }
    assert!(forward == rest && forward.log_score().to_bits() == rest.log_score().to_bits());
    primitives.iter().skip(1).step_by(2).for_each(|p| assert!(forward.remove(p)));
    assert!(forward == empty && forward.log_score().to_bits() == empty.log_score().to_bits());
}

#[test]
fn copies_share_unchanged_tiles() {
    let mut dice = Dice::new(9);
    let picture = disc_picture(&mut dice);
    let mut trunk = PictureMatch::new("match", picture.clone(), 0.02);
    (0..30).for_each(|_| trunk.add(&Primitive::new([any_shape(&mut dice, 2.5)])));
    let before = trunk.clone();
    let mut copy = trunk.clone();
    let all = trunk.tiles().shared_with(copy.tiles());
    let small =
        Primitive::new([Shape::cuboid(Vec3::ZERO, vec3(0.05, 0.05, 0.05), &Look::default()).unwrap()]);
    copy.add(&small);
    let kept = trunk.tiles().shared_with(copy.tiles());
    assert!(all >= 4 && kept + 2 >= all && kept < all, "{kept} of {all} tiles are shared");
    assert!(trunk == before && copy != trunk);
    assert!(copy.remove(&small) && copy == trunk);
}

/// A picture of 100 x 100 with the first `on` pixels on.
fn first_on(on: usize, greys: Option<Vec<u8>>, multiplier: f64) -> Result<Picture, niwaki_geom::GeomError> {
    let size = [100, 100];
    let lens = Lens::Orthographic { height: 10.0 };
    let camera = Camera::new(vec3(0.0, 0.0, 10.0), Vec3::ZERO, vec3(0.0, 1.0, 0.0), lens).unwrap();
    let target = TargetPicture { size, on: (0..10_000).map(|p| p < on).collect(), greys, multiplier };
    Picture::new(&target, camera.rays(size))
}

#[test]
fn the_empty_scene_is_a_picture_with_all_pixels_off() {
    // The published images: a skyline with 0.2978 of its pixels on, a ship's front with 0.0885.
    for (on, expected) in [(2978, -107.9), (885, -6.8)] {
        let spec = match_image(Arc::new(first_on(on, None, 10.0).unwrap()), 0.02).unwrap();
        let empty = spec.start();
        assert!((empty.log_score() - expected).abs() < 0.05, "{on}: {}", empty.log_score());
        assert_eq!(empty.measures()[0], ("similarity", (10_000 - on) as f64 / 10_000.0));
    }
    // With weights it is one less the weighted share: of 100 pixels on, all weigh 1 + 10, of 9900 off, all 1.
    let greys = (0..10_000).map(|p| if p < 100 { 255 } else { 0 }).collect();
    let picture = Arc::new(first_on(100, Some(greys), 10.0).unwrap());
    let empty = PictureMatch::new("match", picture.clone(), 0.02);
    assert_eq!(empty.similarity(), 9900.0 / 11_000.0);
    assert!((picture.on_fraction() - 1100.0 / 11_000.0).abs() < 1e-15);
    // The mutant that leaves the weights out gives another score.
    assert!(
        PictureMatch::new("match", Arc::new(first_on(100, None, 10.0).unwrap()), 0.02).similarity() == 0.99
    );
}

#[test]
fn a_perfect_match_has_similarity_one() {
    // Rows 0..50 of an orthographic picture 10 high: everything above y = 0.
    let picture = Arc::new(first_on(5000, None, 10.0).unwrap());
    let mut sketch = PictureMatch::new("match", picture, 0.02);
    let half = Shape::cuboid(vec3(0.0, 3.0, 0.0), vec3(20.0, 6.0, 1.0), &Look::default()).unwrap();
    sketch.add(&Primitive::new([half]));
    assert_eq!(sketch.similarity(), 1.0);
    assert!((sketch.log_score() - 2.9931).abs() < 1e-4);
}

#[test]
fn impossible_pictures_cameras_and_lights_are_refused() {
    let code = |picture: Result<Picture, niwaki_geom::GeomError>| picture.unwrap_err().code;
    assert_eq!(code(first_on(0, None, 10.0)), "image-one-color");
    assert_eq!(code(first_on(10_000, None, 10.0)), "image-one-color");
    assert_eq!(code(first_on(10, Some(vec![0; 3]), 10.0)), "bad-image");
    assert_eq!(code(first_on(10, None, -1.0)), "bad-setting");
    let lens = Lens::Perspective { fov: 0.8, near: 0.1 };
    let up = vec3(0.0, 1.0, 0.0);
    assert!(Camera::new(Vec3::ZERO, Vec3::ZERO, up, lens).is_err());
    assert!(Camera::new(up * 5.0, Vec3::ZERO, up, lens).is_err());
    assert!(Camera::new(up, vec3(f64::NAN, 0.0, 0.0), up, lens).is_err());
    assert!(Camera::new(Vec3::ZERO, up, Vec3::AXES[0], Lens::Perspective { fov: 4.0, near: 0.1 }).is_err());
    assert!(Light::new(Vec3::ZERO).is_err());
    let floor = receiver(&mut Dice::new(0), false);
    let above = Camera::new(up * 20.0, Vec3::ZERO, Vec3::AXES[2], lens).unwrap();
    let away = Camera::new(up * 20.0, up * 40.0, Vec3::AXES[2], lens).unwrap();
    let aside = Camera::new(vec3(90.0, 20.0, 0.0), vec3(90.0, 0.0, 0.0), Vec3::AXES[2], lens).unwrap();
    let light = |v: Vec3| Light::new(v).unwrap();
    let shadow = |camera: &Camera, v: Vec3| shadow_rays(&floor, camera, &light(v), [50, 40]);
    assert!(shadow(&above, -up).is_ok());
    assert_eq!(shadow(&above, Vec3::AXES[0]).unwrap_err().code, "light-grazes");
    let behind = shadow(&away, -up).unwrap_err();
    assert_eq!((behind.code, &*behind.message), ("receiver-unseen", "it is behind the camera"));
    assert_eq!(shadow(&aside, -up).unwrap_err().code, "receiver-unseen");
}

#[test]
fn a_cylinder_with_very_many_sides_is_covered_whole() {
    let picture = first_on(5, None, 1.0).unwrap();
    let solid = Solid::Cylinder(Cylinder { radius: 3.0, length: 2.0, sides: 1000 });
    let turned = niwaki_geom::Placement {
        rotation: niwaki_geom::Mat3::between(Vec3::AXES[1], Vec3::AXES[2]),
        translation: vec3(0.01, 0.02, 0.0),
    };
    let shape = Shape::new(solid, turned, &Look::default()).unwrap();
    let mesh = picture.rays().meeting_mesh(&shape.world_mesh());
    let whole = picture.rays().meeting(&shape);
    assert_eq!(whole, mesh);
    let area = std::f64::consts::PI * 9.0 * 100.0;
    assert!((whole.count() as f64 - area).abs() < 30.0, "{} pixels", whole.count());
}

#[test]
fn the_published_camera_of_the_skyline_has_the_origin_where_it_was_measured() {
    // Column 113.4 and row 126.8 of 200 x 200, and about 5.3 pixels for each unit there.
    let eye = Eye {
        position: vec3(31.0552, 1.83332, 33.0193),
        look_at: vec3(-3.07631, 5.13738, 0.527147),
        up: vec3(0.0506582, 0.997551, 0.0482248),
        lens: Lens::Perspective { fov: 45f64.to_radians(), near: 0.1 },
    };
    let size = [2000, 2000];
    let rays = eye.camera().rays(size);
    let middle = |at: Vec3| {
        let dot = Shape::cuboid(at, vec3(0.06, 0.06, 0.06), &Look::default()).unwrap();
        let pixels: Vec<u32> = rays.meeting(&dot).rays().map(|ray| rays.pixels()[ray]).collect();
        assert!(pixels.len() > 4);
        let mean = |part: &dyn Fn(u32) -> u32| {
            pixels.iter().map(|p| f64::from(part(*p)) + 0.5).sum::<f64>() / pixels.len() as f64 / 10.0
        };
        [mean(&|p| p % 2000), mean(&|p| p / 2000)]
    };
    let origin = middle(Vec3::ZERO);
    assert!((origin[0] - 113.4).abs() < 0.1 && (origin[1] - 126.8).abs() < 0.1, "{origin:?}");
    let above = middle(vec3(0.0, 1.0, 0.0));
    assert!((origin[1] - above[1] - 5.3).abs() < 0.1, "{above:?}");
}

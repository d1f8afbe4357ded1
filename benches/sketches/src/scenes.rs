//! What is measured: kinds of primitives, and sketches with a target.

use niwaki_geom::solids::{Extrusion, PointHull, Revolution, Sweep};
use niwaki_geom::view::camera::Camera;
use niwaki_geom::view::{Lens, Light, shadow_rays};
use niwaki_geom::{
    GeomError, Look, Mat3, Operation, Picture, Primitive, Rule, Shape, SketchSpec, Target, TargetPicture,
    TriMesh, Vec3, avoid, floor, match_image, match_shadow, match_volume, no_self_intersection, vec3,
};
use std::f64::consts::TAU;
use std::sync::Arc;

/// SplitMix64.
pub struct Dice(pub u64);

impl Dice {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn point(&mut self) -> Vec3 {
        vec3(self.within(-4.0, 4.0), self.within(-4.0, 4.0), self.within(-4.0, 4.0))
    }

    fn direction(&mut self) -> Vec3 {
        loop {
            let found = vec3(self.within(-1.0, 1.0), self.within(-1.0, 1.0), self.within(-1.0, 1.0));
            if let Some(unit) = found.unit().filter(|_| found.norm() < 1.0) {
                return unit;
            }
        }
    }
}

/// The kinds of primitives, in the order of the table.
pub const KINDS: [&str; 12] = [
    "aligned box",
    "box",
    "cylinder",
    "limb",
    "hull",
    "extrusion",
    "revolution",
    "sweep",
    "box with a hole",
    "turned box with a hole",
    "mesh 100",
    "mesh 10000",
];

/// The sketches, in the order of the table.
pub const SKETCHES: [&str; 6] = ["volume", "avoid", "self-intersection", "silhouette", "shadow", "floor"];

/// A ball of about as many triangles.
pub fn ball(triangles: usize, radius: f64) -> Result<TriMesh, GeomError> {
    let around = ((triangles as f64).sqrt().round() as usize).max(4);
    let rings = triangles / (2 * around);
    let mut vertices = vec![vec3(0.0, -radius, 0.0), vec3(0.0, radius, 0.0)];
    for ring in 1..=rings {
        let (sin, cos) = (TAU * 0.5 * ring as f64 / (rings + 1) as f64).sin_cos();
        for k in 0..around {
            let (s, c) = (TAU * k as f64 / around as f64).sin_cos();
            vertices.push(vec3(radius * sin * s, -radius * cos, radius * sin * c));
        }
    }
    let at = |ring: usize, k: usize| (2 + ring * around + k % around) as u32;
    let mut faces = Vec::new();
    for k in 0..around {
        faces.push([0, at(0, k + 1), at(0, k)]);
        faces.push([1, at(rings - 1, k), at(rings - 1, k + 1)]);
        for ring in 1..rings {
            faces.push([at(ring - 1, k), at(ring - 1, k + 1), at(ring, k + 1)]);
            faces.push([at(ring - 1, k), at(ring, k + 1), at(ring, k)]);
        }
    }
    TriMesh::new(vertices, faces)
}

/// What makes shapes of a kind.
pub struct Maker {
    meshes: [Arc<TriMesh>; 2],
}

impl Maker {
    /// With its meshes.
    pub fn new() -> Result<Maker, GeomError> {
        Ok(Maker { meshes: [Arc::new(ball(100, 0.5)?), Arc::new(ball(10_000, 0.5)?)] })
    }

    /// A shape about one unit large, somewhere in a cube of eight.
    pub fn shape(&self, kind: &str, dice: &mut Dice) -> Result<Shape, GeomError> {
        let plain = Look::default();
        let turned =
            Look { rotation: Some(Mat3::rotation(dice.direction(), dice.within(0.0, TAU))), ..plain };
        let (at, along) = (dice.point(), dice.direction());
        let size = vec3(dice.within(0.5, 1.5), dice.within(0.5, 1.5), dice.within(0.5, 1.5));
        match kind {
            "aligned box" => Shape::cuboid(at, size, &plain),
            "box" => Shape::cuboid(at, size, &turned),
            "cylinder" => Shape::cylinder(at, 0.5 * size.x, size.y, along, None, &plain),
            "limb" => {
                let normals = (Some(along), (along + dice.direction() * 0.3).unit());
                Shape::limb(at, at + along * size.y, (0.3 * size.x, 0.25 * size.x), normals, &plain)
            }
            "box with a hole" | "turned box with a hole" => {
                let look = if kind == "box with a hole" { plain } else { turned };
                let hole = Shape::cuboid(at, vec3(0.5 * size.x, 0.5 * size.y, 2.0 * size.z), &look)?;
                Shape::combined(Operation::Difference, &Shape::cuboid(at, size, &look)?, &hole)
            }
            "hull" => {
                let points = (0..10).map(|_| dice.direction() * 0.5).collect();
                Shape::placed(Arc::new(PointHull { points }).into(), at, Mat3::IDENTITY, &turned)
            }
            "extrusion" => {
                let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [0.2, 0.5], [0.2, 0.0], [-0.5, 0.0]];
                let polygon = corners.map(|corner| corner.map(|x| x * size.x)).into();
                let solid = Extrusion { polygon, height: size.y, twist: 0.0, taper: 1.0 };
                Shape::placed(Arc::new(solid).into(), at, Mat3::IDENTITY, &turned)
            }
            "revolution" => {
                let profile = [[0.0, 0.0], [0.4, 0.0], [0.5, 1.0], [0.4, 1.0], [0.3, 0.2], [0.0, 0.2]];
                let profile = profile.map(|point| point.map(|x| x * size.x)).into();
                Shape::placed(Arc::new(Revolution { profile }).into(), at, Mat3::IDENTITY, &turned)
            }
            "sweep" => {
                let corners = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]];
                let path = (0..6).map(|k| f64::from(k) * 0.4);
                let path = path.map(|t| vec3(t.cos(), 0.3 * t, t.sin()) * (0.7 * size.x)).collect();
                let solid = Sweep { profile: corners.into(), path, scale: 0.5 };
                Shape::placed(Arc::new(solid).into(), at, Mat3::IDENTITY, &turned)
            }
            _ => Shape::mesh(&self.meshes[usize::from(kind != "mesh 100")], at, size.x, &turned),
        }
    }
}

/// Side of the pictures, pixels.
pub const SIDE: usize = 256;
/// Height of the view, scene units.
pub const VIEW: f64 = 10.0;
/// Where the shadow's light goes.
pub const LIGHT: [f64; 3] = [0.3, -1.0, 0.2];
/// Height of the plane that catches the shadow.
pub const GROUND: f64 = -5.0;

/// The targets of all sketches: a ball in a grid, and a disc in a picture.
pub struct Goals {
    /// For volumes, and to keep away from.
    pub target: Arc<Target>,
    /// Pixels that should be on.
    pub on: Vec<bool>,
    silhouette: Arc<Picture>,
    shadow: Arc<Picture>,
}

impl Goals {
    /// With a grid of 80 cells along each side.
    pub fn new() -> Result<Goals, GeomError> {
        let half = 0.5 * SIDE as f64;
        let inside =
            |p: usize| ((p % SIDE) as f64 - half).hypot((p / SIDE) as f64 - half) < 0.3 * SIDE as f64;
        let on: Vec<bool> = (0..SIDE * SIDE).map(inside).collect();
        let picture = TargetPicture { size: [SIDE, SIDE], on: on.clone(), greys: None, multiplier: 0.0 };
        let lens = Lens::Orthographic { height: VIEW };
        let front = Camera::new(vec3(0.0, 0.0, 20.0), Vec3::ZERO, Vec3::AXES[1], lens)?;
        let above = Camera::new(vec3(0.0, 20.0, 0.0), vec3(0.0, GROUND, 0.0), vec3(0.0, 0.0, -1.0), lens)?;
        let corners = [[-40.0, -40.0], [-40.0, 40.0], [40.0, 40.0], [40.0, -40.0]];
        let ground =
            TriMesh::new(corners.map(|[x, z]| vec3(x, GROUND, z)).to_vec(), vec![[0, 1, 2], [0, 2, 3]])?;
        let cast = shadow_rays(&ground, &above, &Light::new(Vec3::from(LIGHT))?, [SIDE, SIDE])?;
        Ok(Goals {
            target: Arc::new(Target::new(ball(2_000, 4.0)?, 0.1)?),
            on,
            silhouette: Arc::new(Picture::new(&picture, front.rays([SIDE, SIDE]))?),
            shadow: Arc::new(Picture::new(&picture, cast)?),
        })
    }

    /// What a sketch is made by.
    pub fn sketch(&self, name: &str) -> Result<Arc<dyn SketchSpec>, GeomError> {
        match name {
            "volume" => match_volume(self.target.clone(), 0.1),
            "avoid" => Ok(avoid(self.target.clone())),
            "self-intersection" => Ok(no_self_intersection(Rule::Solid)),
            "silhouette" => match_image(self.silhouette.clone(), 0.1),
            "shadow" => match_shadow(self.shadow.clone(), 0.1),
            _ => floor(-2.0),
        }
    }
}

/// Where points are seen in the picture of a sketch: columns and rows.
pub fn seen(sketch: &str, points: &[Vec3], into: &mut Vec<[f64; 2]>) {
    let scale = SIDE as f64 / VIEW;
    let half = 0.5 * SIDE as f64;
    into.clear();
    into.extend(points.iter().map(|p| {
        if sketch == "silhouette" {
            return [half + scale * p.x, half - scale * p.y];
        }
        let fall = (GROUND - p.y) / LIGHT[1];
        [half + scale * (p.x + fall * LIGHT[0]), half + scale * (p.z + fall * LIGHT[2])]
    }));
}

/// A scene of shapes far enough from each other that most new ones meet few of them.
pub fn scene(maker: &Maker, kind: &str, count: usize, dice: &mut Dice) -> Result<Vec<Primitive>, GeomError> {
    (0..count).map(|_| maker.shape(kind, dice).map(|shape| Primitive::new([shape]))).collect()
}

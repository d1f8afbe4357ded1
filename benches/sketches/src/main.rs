//! What a primitive costs in each sketch: nanoseconds, beside loops by hand and parry3d.
//!
//!     sketches SEED COUNT
//!
//! Prints a JSON line for each kind of primitive and each sketch. `make`: the shape itself. `add`: to a scene of 50, whose
//! data nobody shares; `copy`: a copy of the scene, with the primitive added and scored, as a particle does it;
//! `remove`: from the scene, as a chain does it; `score`: the log score. `hand`: the loop for this one case; `parry`: the
//! tests of parry3d. `differ`: answers of the loop by hand that are not the engine's, of `of`.
mod by_hand;
mod peers;
mod scenes;

use by_hand::{Bits, Boxes, Oriented, aligned_box, closed, convex, outline};
use niwaki_geom::{Aabb, GeomError, Primitive, Sketch};
use peers::Peer;
use scenes::{Dice, Goals, KINDS, Maker, SIDE, SKETCHES, scene, seen};
use std::hint::black_box;
use std::time::Instant;

/// Primitives that stand in the scene already.
const STANDING: usize = 50;

/// Median of the nanoseconds that `f` takes for each item.
fn median<T>(items: &[T], mut f: impl FnMut(&T) -> Option<u64>) -> f64 {
    let mut all: Vec<u64> = items.iter().filter_map(&mut f).collect();
    all.sort_unstable();
    all.get(all.len() / 2).map_or(f64::NAN, |one| *one as f64)
}

/// Nanoseconds of one call, the least of seven.
fn least(mut prepare: impl FnMut(), mut f: impl FnMut()) -> u64 {
    let times = (0..7).map(|_| {
        prepare();
        let begun = Instant::now();
        f();
        begun.elapsed().as_nanos() as u64
    });
    times.min().unwrap_or(0)
}

fn main() -> Result<(), GeomError> {
    let mut arguments = std::env::args().skip(1).map(|one| one.parse::<u64>().unwrap_or(1));
    let (seed, count) = (arguments.next().unwrap_or(1), arguments.next().unwrap_or(200) as usize);
    let (maker, goals) = (Maker::new()?, Goals::new()?);
    for kind in KINDS {
        // A large mesh takes milliseconds.
        let count = if kind == "mesh 10000" { count.div_ceil(20) } else { count };
        let mut dice = Dice(seed);
        let standing = scene(&maker, kind, STANDING, &mut dice)?;
        let mut made = Vec::with_capacity(count);
        let mut making = Vec::with_capacity(count);
        for _ in 0..count {
            let begun = Instant::now();
            let shape = maker.shape(kind, &mut dice)?;
            making.push(begun.elapsed().as_nanos() as u64);
            shape.world_mesh();
            made.push(Primitive::new([shape]));
        }
        let make = median(&making, |one| Some(*one));
        for name in SKETCHES {
            let line = measure(&goals, name, kind, &standing, &made)?;
            println!("{}", line.with("make", make));
        }
    }
    Ok(())
}

/// One row of the table.
struct Line(serde_json::Map<String, serde_json::Value>);

impl Line {
    fn with(mut self, name: &str, value: f64) -> Line {
        let rounded = (10.0 * value).round() / 10.0;
        self.0
            .insert(name.into(), if rounded.is_finite() { rounded.into() } else { serde_json::Value::Null });
        self
    }
}

impl std::fmt::Display for Line {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", serde_json::Value::Object(self.0.clone()))
    }
}

fn measure(
    goals: &Goals,
    name: &str,
    kind: &str,
    standing: &[Primitive],
    made: &[Primitive],
) -> Result<Line, GeomError> {
    let spec = goals.sketch(name)?;
    let fresh = || {
        let mut sketch = spec.start();
        standing.iter().for_each(|one| sketch.add(one));
        sketch
    };
    let shared = fresh();
    let copy = median(made, |one| {
        let mut begun = Instant::now();
        let mut best = u64::MAX;
        for _ in 0..7 {
            let mut sketch = shared.fork();
            sketch.add(one);
            black_box(sketch.log_score());
            best = best.min(begun.elapsed().as_nanos() as u64);
            drop(sketch);
            begun = Instant::now();
        }
        Some(best)
    });
    let mut own = fresh();
    own.expect_removals();
    let mut times = Vec::with_capacity(made.len());
    for one in made {
        let mut best = [u64::MAX; 3];
        for _ in 0..7 {
            let begun = Instant::now();
            own.add(one);
            let added = begun.elapsed().as_nanos() as u64;
            let begun = Instant::now();
            black_box(own.log_score());
            let scored = begun.elapsed().as_nanos() as u64;
            let begun = Instant::now();
            own.remove(one);
            let removed = begun.elapsed().as_nanos() as u64;
            best = [best[0].min(added), best[1].min(scored), best[2].min(removed)];
        }
        times.push(best);
    }
    let [add, score, remove] = [0, 1, 2].map(|k| median(&times, |one| Some(one[k])));
    let line = serde_json::json!({"kind": kind, "sketch": name, "count": made.len()});
    let serde_json::Value::Object(line) = line else { return Ok(Line(serde_json::Map::new())) };
    let limits = limits(goals, name, kind, standing, made, &*shared);
    Ok(limits.into_iter().fold(
        Line(line).with("add", add).with("copy", copy).with("remove", remove).with("score", score),
        |line, (name, value)| line.with(name, value),
    ))
}

/// True if a loop by hand knows the cells and the outline of this kind.
fn has_a_loop(kind: &str) -> bool {
    !kind.starts_with("mesh") && !kind.ends_with("hole")
}

/// The loops by hand and the peers, with how many of their answers differ from the engine's.
fn limits(
    goals: &Goals,
    name: &str,
    kind: &str,
    standing: &[Primitive],
    made: &[Primitive],
    shared: &dyn Sketch,
) -> Vec<(&'static str, f64)> {
    let measure = |sketch: &dyn Sketch, what: &str| {
        sketch.measures().iter().find(|(one, _)| *one == what).map_or(f64::NAN, |(_, value)| *value)
    };
    // What the engine's sketch says of one primitive more.
    let after = |one: &Primitive| {
        let mut sketch = shared.fork();
        sketch.add(one);
        sketch
    };
    match name {
        "volume" => {
            let grid = goals.target.grid();
            let target = Bits::of(grid.dims(), |cell| goals.target.contains(cell));
            let mut rows = Bits::new(grid.dims());
            let mut add = |bits: &mut Bits, one: &Primitive| {
                let shape = &one.shapes()[0];
                match shape.convex() {
                    _ if shape.is_aligned_box() => aligned_box(bits, &target, grid, shape.aabb()),
                    Some(solid) => convex(bits, &target, grid, &solid),
                    None => closed(bits, &target, grid, &shape.world_mesh(), &mut rows),
                }
            };
            let mut full = Bits::new(grid.dims());
            for one in standing {
                add(&mut full, one);
            }
            let mut bits = Bits::new(grid.dims());
            let mut fewer = 0.0;
            let mut cells = 0.0;
            let hand = median(made, |one| {
                let mut new = [0; 2];
                let bits = std::cell::RefCell::new((&mut bits, &mut new, &mut add));
                let took = least(
                    || bits.borrow_mut().0.copy(&full),
                    || {
                        let (bits, new, add) = &mut *bits.borrow_mut();
                        **new = add(bits, one);
                    },
                );
                let filled = measure(&*after(one), "filled") - measure(shared, "filled");
                // The engine counts the cells that a shape touches, the loop those whose middle it has.
                fewer += filled - f64::from(new[0]);
                cells += filled;
                Some(took)
            });
            vec![("hand", hand), ("differ", fewer), ("of", cells)]
        }
        "silhouette" | "shadow" if made[0].shapes()[0].is_convex() => {
            let dims = [SIDE, SIDE, 1];
            let target = Bits::of(dims, |[x, y, _]| goals.on[y * SIDE + x]);
            let mut points = Vec::new();
            let mut add = |bits: &mut Bits, one: &Primitive| {
                let Some(solid) = one.shapes()[0].convex() else { return [0; 2] };
                seen(name, solid.corners(), &mut points);
                outline(bits, &target, &points, &solid.topology().edges)
            };
            let mut full = Bits::new(dims);
            for one in standing {
                add(&mut full, one);
            }
            let mut bits = Bits::new(dims);
            let (mut differ, mut all) = (0.0, 0.0);
            let on = |sketch: &dyn Sketch| measure(sketch, "pixels_on");
            let hand = median(made, |one| {
                let mut new = [0; 2];
                let bits = std::cell::RefCell::new((&mut bits, &mut new, &mut add));
                let took = least(
                    || bits.borrow_mut().0.copy(&full),
                    || {
                        let (bits, new, add) = &mut *bits.borrow_mut();
                        **new = add(bits, one);
                    },
                );
                let filled = on(&*after(one)) - on(shared);
                differ += (filled - f64::from(new[0])).abs();
                all += filled;
                Some(took)
            });
            vec![("hand", hand), ("differ", differ), ("of", all)]
        }
        "self-intersection" => {
            let boxes = Boxes::of(&standing.iter().map(|one| *one.aabb()).collect::<Vec<Aabb>>());
            let peers: Vec<Peer> = standing.iter().map(Peer::of).collect();
            let is_box = kind.ends_with("box");
            let corners =
                |one: &Primitive| one.shapes()[0].convex().map(|solid| Oriented::of(solid.corners()));
            let solids: Vec<Option<Oriented>> =
                standing.iter().map(|one| corners(one).filter(|_| is_box)).collect();
            let mut differ = 0.0;
            let expected = |one: &Primitive| {
                // Those that stand may meet each other: only what the new one adds counts.
                standing.iter().any(|other| {
                    niwaki_geom::intersect::primitives_intersect(one, other, niwaki_geom::Rule::Solid)
                })
            };
            let hand = match is_box {
                false => f64::NAN,
                true => median(made, |one| {
                    let mut found = false;
                    let took = least(
                        || (),
                        || {
                            let own = corners(one);
                            found = boxes.any(one.aabb(), |k| match (&own, &solids[k]) {
                                (Some(own), Some(other)) => own.meets(other),
                                _ => false,
                            });
                            black_box(found);
                        },
                    );
                    differ += f64::from(u8::from(found != expected(one)));
                    Some(took)
                }),
            };
            let mut peers_differ = 0.0;
            let parry = median(made, |one| {
                let own = Peer::of(one);
                let mut found = false;
                let took = least(
                    || (),
                    || {
                        found = boxes.any(one.aabb(), |k| own.meets(&peers[k]));
                        black_box(found);
                    },
                );
                peers_differ += f64::from(u8::from(found != expected(one)));
                Some(took)
            });
            let count = made.len() as f64;
            vec![
                ("hand", hand),
                ("parry", parry),
                ("differ", differ),
                ("of", count),
                ("parry differ", peers_differ),
            ]
        }
        "avoid" => {
            let obstacle = Peer::mesh(goals.target.mesh());
            let parry = median(made, |one| {
                let own = Peer::of(one);
                Some(least(
                    || (),
                    || {
                        black_box(own.meets(&obstacle));
                    },
                ))
            });
            vec![("parry", parry)]
        }
        "floor" => {
            let hand = median(made, |one| {
                let Some(solid) = one.shapes()[0].convex() else { return None };
                Some(least(
                    || (),
                    || {
                        let lowest = solid.corners().iter().fold(f64::INFINITY, |low, p| low.min(p.y));
                        black_box(lowest >= -2.0);
                    },
                ))
            });
            vec![("hand", hand)]
        }
        _ => Vec::new(),
    }
}

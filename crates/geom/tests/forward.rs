//! The intersection rule rejects as many ships and buildings as the published programs do.
//!
//! A forward sampler draws whole scenes and tests whether any two parts intersect. By the surface rule 0.32 of the
//! ships do, and 0.74 of the buildings.

mod scenes;

use niwaki_geom::{NoSelfIntersection, Primitive, Rule, Sketch};
use scenes::{Dice, building::building, ship::ship};

/// Share of scenes with an intersection by the surface and by the solid rule, and the mean number of parts.
fn shares(count: usize, mut scene: impl FnMut() -> Vec<Primitive>) -> (f64, f64, f64) {
    let (mut surface_hits, mut solid_hits, mut parts) = (0, 0, 0);
    for _ in 0..count {
        let scene = scene();
        parts += scene.len();
        let rejects = |rule: Rule| {
            let mut sketch = NoSelfIntersection::new(rule);
            scene.iter().for_each(|p| sketch.add(p));
            sketch.pairs() > 0
        };
        let (surface, solid) = (rejects(Rule::Surface), rejects(Rule::Solid));
        // Where surfaces cross, insides overlap.
        assert!(solid || !surface);
        surface_hits += usize::from(surface);
        solid_hits += usize::from(solid);
    }
    let share = |n: usize| n as f64 / count as f64;
    (share(surface_hits), share(solid_hits), share(parts))
}

/// 600 of the published ships gave 0.32: with 2400 of ours the difference has a standard deviation of 0.021, so 0.06
/// is 2.8 of them, a false alarm of 0.005 for a re-seeded run; the seed is fixed.
#[test]
fn a_third_of_forward_ships_run_into_themselves() {
    let mut dice = Dice::new(1);
    let (surface, solid, parts) = shares(2400, || ship(&mut dice));
    println!("ships: {surface:.3} by surface, {solid:.3} by solid, {parts:.2} parts");
    assert!((surface - 0.32).abs() < 0.06, "{surface}");
    // The published mean is 16.35 with standard deviation 6.4.
    assert!((parts - 16.35).abs() < 0.8, "{parts}");
}

/// 400 of the published buildings gave 0.74: with 1200 of ours the difference has a standard deviation of 0.025, so
/// 0.07 is 2.8 of them.
#[test]
fn three_quarters_of_forward_buildings_run_into_themselves() {
    let mut dice = Dice::new(2);
    let (surface, solid, parts) = shares(1200, || building(&mut dice));
    println!("buildings: {surface:.3} by surface, {solid:.3} by solid, {parts:.2} parts");
    assert!((surface - 0.74).abs() < 0.07, "{surface}");
    // The published mean is 72.6 with standard deviation 55.
    assert!((parts - 72.6).abs() < 8.0, "{parts}");
}

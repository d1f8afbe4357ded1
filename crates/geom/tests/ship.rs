//! The intersection rule rejects as many ships as the published programs do.
//!
//! A forward sampler draws whole ships and asks whether any two parts intersect. By the surface rule 0.32 of them do.

mod scenes;

use niwaki_geom::{NoSelfIntersection, Rule, Sketch};
use scenes::Dice;
use scenes::ship::ship;

/// 600 of the published ships gave 0.32: with 2400 of ours the difference has a standard deviation of 0.021, so 0.06
/// is 2.8 of them, a false alarm of 0.005 for a re-seeded run; the seed is fixed.
#[test]
fn a_third_of_forward_ships_run_into_themselves() {
    let mut dice = Dice::new(1);
    let (mut hits, mut solid_hits, mut parts, ships) = (0, 0, 0, 2400);
    for _ in 0..ships {
        let ship = ship(&mut dice);
        parts += ship.len();
        let rejects = |rule: Rule| {
            let mut sketch = NoSelfIntersection::new(rule);
            ship.iter().for_each(|p| sketch.add(p));
            sketch.pairs() > 0
        };
        let (surface, solid) = (rejects(Rule::Surface), rejects(Rule::Solid));
        // What crosses with its surface overlaps with its inside.
        assert!(solid || !surface);
        hits += usize::from(surface);
        solid_hits += usize::from(solid);
    }
    let share = hits as f64 / ships as f64;
    let mean = parts as f64 / ships as f64;
    println!("{share:.3} by surface, {:.3} by solid, {mean:.2} parts", solid_hits as f64 / ships as f64);
    assert!((share - 0.32).abs() < 0.06, "{share}");
    // The published mean is 16.35 with standard deviation 6.4.
    assert!((mean - 16.35).abs() < 0.8, "{mean}");
}

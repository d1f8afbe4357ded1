//! Bytes that a population holds for each primitive, by an allocator that counts bytes: for boxes less than the 700 that a thousand
//! particles of a thousand primitives may take on average for 0.7 GB, for welded segments less than the 1000 for 1 GB.

#![allow(unsafe_code)] // An allocator that counts bytes.

use niwaki_geom::{Rule, Shape, Target, Vec3, match_volume, no_self_intersection, store, vec3};
use niwaki_particles::{Progress, Settings, When, smc};
use niwaki_run::Task;
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The system's allocator, which counts bytes that are held now.
struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call is passed on unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        HELD.fetch_add(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller's layout, which is valid for any allocator.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: the place came from `alloc` above, and so from the system's allocator.
        unsafe { System.dealloc(place, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Piles up 300 turned boxes, three choices each.
const TOWER: &str = r#"(module (fn "m" (params)
    (for $k (range 300) (body
        (set $turn (sample (dist uniform 0.0 1.5)))
        (set $w (sample (dist uniform 0.5 2.0)))
        (set $d (sample (dist uniform 0.5 2.0)))
        (do (emit (box (tuple 0.0 (add 0.05 (mul 0.1 $k)) 0.0) (tuple $w 0.1 $d)
                       (rotation (tuple 0.0 1.0 0.0) $turn))))))
    (return 0)) (entry "m"))"#;

/// Puts up a stem of 150 segments by a recursion, on each of which a twig is welded: four choices for two segments.
const POLE: &str = r#"(module
    (class 0 "Frame" ("center" "forward" "up" "radius") namedtuple)
    (class 1 "Bark" ("low" "low_radius" "high" "high_radius") namedtuple)
    (fn "m" (params) (do (call "climb" 0 0.0)))
    (fn "climb" (params $k $y) (if (lt $k 150) (then
        (set $end (add $y (sample (dist uniform 3.0 5.0))))
        (set $up (vec 0.0 1.0 0.0)) (set $out (vec 1.0 0.0 0.0))
        (do (emit (segment (record 0 (vec 0.0 $y 0.0) $up $out 0.9) (record 0 (vec 0.0 (add $y 0.2) 0.0) $up $out 0.9)
                           (record 0 (vec 0.0 $end 0.0) $up $out 0.9) none none)))
        (set $at (add $y (sample (dist uniform 1.0 2.0))))
        (set $wide (sample (dist uniform 0.2 0.3)))
        (set $far (sample (dist uniform 2.0 3.0)))
        (set $bark (record 1 (vec 0.0 (sub $at $wide) 0.0) 0.9 (vec 0.0 (add $at $wide) 0.0) 0.9))
        (do (emit (segment (record 0 (vec 0.9463 $at 0.0) $out $up $wide)
                           (record 0 (vec 1.2463 $at 0.0) $out $up (mul 0.95 $wide))
                           (record 0 (vec $far $at 0.0) $out $up (mul 0.8 $wide)) $bark none)))
        (do (call "climb" (add $k 1) $end))) (else)))
    (entry "m"))"#;

/// Bytes that unrelated particles hold for each of the last 200 of 300 primitives.
fn bytes_for_each(model: &str) -> usize {
    let program = compile(&parse(model).expect("core form"), vec![]).expect("a program");
    let block = Shape::cuboid(Vec3::ZERO, vec3(2.0, 2.0, 2.0), &Default::default()).expect("a block");
    let target = Arc::new(Target::new(block.world_mesh().clone(), 0.4).expect("a target"));
    let sketches = vec![no_self_intersection(Rule::Solid), match_volume(target, 1e3).expect("a score")];
    let task = Task { sketches, ..Task::new(Arc::new(program)) };
    // Particles that are not resampled share nothing.
    let settings = Settings { particles: 20, when: When::EffectiveBelow(0.0), ..Settings::default() };
    let mut held = Vec::new();
    let mut watch = |_: Progress| {
        // What it holds has a limit of its own.
        store::empty();
        held.push(HELD.load(Ordering::Relaxed));
        true
    };
    // On one thread, so that there is one store.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    let result = pool.install(|| smc(&task, &settings, &mut |progress| watch(progress))).expect("a result");
    assert!(result.particles.iter().all(|particle| particle.primitives == 300));
    assert_eq!(held.len(), 301);
    (held[299] - held[99]) / (200 * settings.particles)
}

#[test]
fn a_primitive_and_its_choices_take_little_memory() {
    let each = bytes_for_each(TOWER);
    assert!(each < 600, "{each} bytes for each box");
    let each = bytes_for_each(POLE);
    assert!(each < 800, "{each} bytes for each segment");
}

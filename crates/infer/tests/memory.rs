//! What a population holds for each primitive, by an allocator that counts bytes: less than the 700 that a thousand
//! particles of a thousand primitives may take on average for 0.7 GB.

#![allow(unsafe_code)] // An allocator that counts bytes.

use niwaki_geom::{Rule, Shape, Target, Vec3, match_volume, no_self_intersection, vec3};
use niwaki_infer::Task;
use niwaki_infer::particles::{Settings, When, smc};
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

#[test]
fn a_box_and_its_choices_take_little_memory() {
    let program = compile(&parse(TOWER).expect("core form"), vec![]).expect("a program");
    let block = Shape::cuboid(Vec3::ZERO, vec3(2.0, 2.0, 2.0), &Default::default()).expect("a block");
    let target = Arc::new(Target::new(block.world_mesh().clone(), 0.4).expect("a target"));
    let sketches = vec![no_self_intersection(Rule::Solid), match_volume(target, 1e3).expect("a score")];
    let task = Task { sketches, ..Task::new(Arc::new(program)) };
    // Particles that are not resampled share nothing.
    let settings = Settings { particles: 20, when: When::EffectiveBelow(0.0), ..Settings::default() };
    let mut held = Vec::new();
    smc(&task, &settings, &mut |_| {
        held.push(HELD.load(Ordering::Relaxed));
        true
    })
    .expect("a result");
    assert_eq!(held.len(), 301);
    let each = (held[299] - held[99]) / (200 * settings.particles);
    assert!(each < 600, "{each} bytes for each box");
}

//! Recently used geometry of shapes: hulls, their pieces, and meshes. A shape keeps only its measures.
//!
//! A population of a thousand particles has a million shapes, and the hull of a segment with its pieces takes ten times as
//! much memory as the segment. Few hulls are in use at a time: those of a new shape and of shapes near it. So each thread has a
//! *store* of limited size, and missing geometry is computed again, with the same bits. No result depends on the content of a
//! store.
//!
//! A shape has a *number*, which no other shape of the process has or had. Its last digits are its place in every store. Numbers
//! ascend, so a new shape takes the place of an old one. A shape that is dropped leaves the store of its thread.

use crate::convex::Coarse;
use crate::mesh::TriMesh;
use crate::once::Once;
use std::cell::{Cell, RefCell};
use std::fmt;
use std::ops::Deref;
use std::rc::Rc;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// Places of a store, a power of two.
const PLACES: usize = 1 << 13;
/// Bytes of the stores of all threads together, if there are not too many threads.
const ALL: usize = 128 << 20;
/// Bytes that the store of any thread may have.
const LEAST: usize = 4 << 20;
/// The most bytes of the store of a thread. The pieces and edges of a hull count, computed or not.
pub const MOST: usize = 32 << 20;
/// The count of numbers that a thread reserves at once.
const BLOCK: u64 = 1 << 10;

/// The number of a shape, or no number. It is not shown: equal shapes have equal texts.
pub(crate) struct Number(u64);

impl fmt::Debug for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Number")
    }
}

impl Number {
    /// The number of a shape that needs no store.
    pub const NONE: Number = Number(0);

    /// A number that no other shape has or had.
    pub fn new() -> Number {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        thread_local! {
            static RESERVED: Cell<[u64; 2]> = const { Cell::new([0; 2]) };
        }
        let reserved = RESERVED.get();
        let [next, end] = match reserved {
            [next, end] if next < end => reserved,
            _ => {
                let next = NEXT.fetch_add(BLOCK, Ordering::Relaxed);
                [next, next + BLOCK]
            }
        };
        RESERVED.set([next + 1, end]);
        Number(next)
    }

    fn place(&self) -> usize {
        self.0 as usize % PLACES
    }
}

impl Drop for Number {
    fn drop(&mut self) {
        if self.0 != 0 {
            // At the end of a thread its store may have gone before its shapes.
            let _ = STORE.try_with(|store| store.borrow_mut().forget(self));
        }
    }
}

/// Geometry of the coarse mesh of a shape. A user holds a reference.
#[derive(Clone, Debug, Default)]
struct Entry {
    /// The number of the shape; zero for none.
    number: u64,
    hull: Option<Rc<Coarse>>,
    mesh: Option<Rc<TriMesh>>,
    /// Bytes of hull and mesh.
    bytes: usize,
}

struct Store {
    entries: Vec<Entry>,
    bytes: usize,
    most: usize,
    /// The place from which entries are dropped next.
    oldest: usize,
}

thread_local! {
    static STORE: RefCell<Store> =
        const { RefCell::new(Store { entries: Vec::new(), bytes: 0, most: 0, oldest: 0 }) };
}

impl Store {
    fn get(&self, number: &Number) -> Option<&Entry> {
        self.entries.get(number.place()).filter(|entry| entry.number == number.0)
    }

    /// Adds to the entry of a shape. An older shape at its place goes.
    fn put(&mut self, number: &Number, bytes: usize, add: impl FnOnce(&mut Entry)) {
        if self.entries.is_empty() {
            self.entries = vec![Entry::default(); PLACES];
            self.most = bytes_of_one();
        }
        let place = number.place();
        let entry = &mut self.entries[place];
        if entry.number != number.0 {
            self.bytes -= entry.bytes;
            *entry = Entry { number: number.0, ..Entry::default() };
        }
        add(entry);
        entry.bytes += bytes;
        self.bytes += bytes;
        for _ in 0..PLACES {
            if self.bytes <= self.most {
                break;
            }
            if self.oldest != place {
                self.bytes -= std::mem::take(&mut self.entries[self.oldest]).bytes;
            }
            self.oldest = (self.oldest + 1) % PLACES;
        }
    }

    fn forget(&mut self, number: &Number) {
        if self.get(number).is_some() {
            self.bytes -= std::mem::take(&mut self.entries[number.place()]).bytes;
        }
    }
}

/// Bytes that the store of a thread may have.
fn bytes_of_one() -> usize {
    static THREADS: OnceLock<usize> = OnceLock::new();
    let threads = THREADS.once(|| std::thread::available_parallelism().map_or(1, usize::from));
    (ALL / threads).clamp(LEAST, MOST)
}

/// The hull of a shape: from the store, or computed and stored.
#[inline]
pub(crate) fn hull(number: &Number, compute: impl FnOnce() -> Option<Coarse>) -> Option<Rc<Coarse>> {
    let stored = STORE.with_borrow(|store| store.get(number).and_then(|entry| entry.hull.clone()));
    stored.or_else(|| {
        let hull = Rc::new(compute()?);
        keep_hull(number, hull.clone());
        Some(hull)
    })
}

/// Stores the hull of a shape.
pub(crate) fn keep_hull(number: &Number, hull: Rc<Coarse>) {
    let bytes = hull.bytes();
    STORE.with_borrow_mut(|store| store.put(number, bytes, |entry| entry.hull = Some(hull)));
}

/// The coarse mesh of a shape: from the store, or computed and stored.
pub(crate) fn mesh(number: &Number, compute: impl FnOnce() -> TriMesh) -> WorldMesh {
    let stored = STORE.with_borrow(|store| store.get(number).and_then(|entry| entry.mesh.clone()));
    WorldMesh(stored.unwrap_or_else(|| {
        let mesh = Rc::new(compute());
        if number.0 != 0 {
            let (copy, bytes) = (mesh.clone(), mesh.bytes());
            STORE.with_borrow_mut(|store| store.put(number, bytes, |entry| entry.mesh = Some(copy)));
        }
        mesh
    }))
}

/// The coarse mesh of a shape in the world, held while it is used.
#[derive(Debug)]
pub struct WorldMesh(Rc<TriMesh>);

impl Deref for WorldMesh {
    type Target = TriMesh;

    fn deref(&self) -> &TriMesh {
        &self.0
    }
}

/// Bytes of the store of this thread.
pub fn held() -> usize {
    STORE.with_borrow(|store| store.bytes)
}

/// Empties the store of this thread.
pub fn empty() {
    STORE.with_borrow_mut(|store| {
        store.entries.clear();
        store.bytes = 0;
    });
}

//! The price of work, in instructions of a processor: a count, so that it is the same on every machine.
//!
//! A unit of work is a particle step, a proposal or a moved shape. Its price depends on the model, so it is estimated from one run.
//! The price has the model's instructions, the choices that a proposal draws, the calls of functions of the host, and what decides how
//! long sketches look at a shape: its corners, and the cells of a shape that is not convex. All are divided by the number of barriers of
//! the run. The factors are rounded from counts of callgrind (`benches/counts.json`) and from the processor seconds of the
//! problems of `benches/board.py`.

use niwaki_chain::walk::state::State;
use niwaki_chain::walk::streams::Streams;
use niwaki_geom::solids::shape::Shape;
use niwaki_geom::voxel::Grid;
use niwaki_geom::{Solid, Vec3};
use niwaki_run::inside::Inside;
use niwaki_run::replay::by_address;
use niwaki_run::run::Run;
use niwaki_run::task::Hosts;
use niwaki_run::{Failure, Task};
use niwaki_vm::code::SiteKind;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::kept::inspect::Item;
use niwaki_vm::value::Value;
use std::any::Any;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The least work of a search with an effort of 1: about a second of a processor.
pub(super) const FLOOR: u64 = 3_000_000_000;
/// A step of a particle, without the model's instructions and shapes.
const STEP: u64 = 9_000;
/// An instruction of the model.
const INSTRUCTION: u64 = 5;
/// A corner of a box that stands along the axes.
const ALIGNED_CORNER: u64 = 500;
/// A corner of any other shape whose faces are known from its kind.
const PRISM_CORNER: u64 = 1_000;
/// A corner of any other shape.
const CORNER: u64 = 3_000;
/// A cell of the box of a shape that is not convex, which a fill looks at, and a cell of the box of one of its triangles, which is
/// compared with the triangle.
const CELL: u64 = 5;
const TRIANGLE_CELL: u64 = 30;
/// A choice of a search with a proposal, which draws the choices of more than half of the work: a guide looks at the target, and its network
/// is computed.
const PROPOSED: u64 = 12_000;
/// A call of a function of the host. Its work is unknown, so a thousand calls are as dear as the floor: a search whose host takes
/// a third of a second ends after minutes.
const HOST: u64 = FLOOR / 1_000;

/// The price of a unit of work, in instructions; `by_proposal` is whether the search has a proposal.
///
/// # Errors
/// A fault of the program.
pub(super) fn of(task: &Task, run: &Run, by_proposal: bool) -> Result<u64, Failure> {
    let calls = Arc::new(Calls { hosts: task.hosts.clone(), number: AtomicU64::new(0) });
    let task = Task { hosts: calls.clone(), ..task.uncounted() };
    let known = by_address(&run.log.entries());
    let (state, _) = State::start(&task, Streams::new(0, 0), 1, Some(&known))?;
    let mut shapes = 0;
    state.trace.visit(&task.program, |_, item| {
        if let Item::Emit(primitive) = item {
            shapes += primitive.shapes().iter().map(|shape| of_shape(shape, &task)).sum::<u64>();
        }
    });
    let barriers = state.primitives as u64 + state.trace.totals().factors.unsigned_abs();
    let instructions = INSTRUCTION * state.trace.counters().instructions;
    let proposed = if by_proposal { PROPOSED * known.len() as u64 } else { 0 };
    let hosts = HOST.saturating_mul(calls.number.load(Ordering::Relaxed));
    let all = [instructions, shapes, proposed, hosts].into_iter().fold(0, u64::saturating_add);
    Ok(STEP + all / barriers.max(1))
}

/// The price of a shape in all sketches together.
fn of_shape(shape: &Shape, task: &Task) -> u64 {
    let mesh = shape.world_mesh();
    let corners = mesh.vertices().len() as u64;
    if shape.is_aligned_box() {
        return ALIGNED_CORNER * corners;
    }
    use Solid::{Box, Cylinder, TaperedBox, TaperedCylinder, Wedge};
    if let Box(_) | TaperedBox(_) | Cylinder(_) | TaperedCylinder(_) | Wedge(_) = shape.solid() {
        return PRISM_CORNER * corners;
    }
    // The cells of a cut are found by those of its solids, of which most are convex.
    if shape.convex().is_some() || shape.cut().is_some() {
        return CORNER * corners;
    }
    let grids = task.sketches.iter().filter_map(|sketch| sketch.grid());
    let filled = grids.map(|grid| {
        let of_triangle = |[a, b, c]: [Vec3; 3]| cells_of(a.max(b).max(c) - a.min(b).min(c), grid);
        let of_triangles: u64 = mesh.corners().map(of_triangle).sum();
        (CELL * cells_of(shape.aabb().extent(), grid)).saturating_add(TRIANGLE_CELL * of_triangles)
    });
    filled.fold(CORNER * corners, u64::saturating_add)
}

/// The number of cells of a box that begins within a cell; not more than a fill looks at.
fn cells_of(extent: Vec3, grid: &Grid) -> u64 {
    let cells: f64 = (0..3).map(|axis| extent[axis] / grid.cell()[axis] + 1.0).product();
    cells.min(grid.len() as f64) as u64
}

/// The highest log score that a run can have, nats; infinite where it is not known.
pub(super) fn most(task: &Task) -> f64 {
    let mut sites = task.program.functions.iter().flat_map(|function| &function.sites);
    if task.held.is_some() || sites.any(|site| matches!(site.kind, SiteKind::Factor | SiteKind::Observe(_))) {
        return f64::INFINITY;
    }
    task.sketches.iter().map(|sketch| sketch.most()).sum()
}

/// The functions of the host, with a count of their calls. An inference inside a model is none: its work is counted in steps.
struct Calls {
    hosts: Arc<dyn Hosts>,
    number: AtomicU64,
}

impl Hosts for Calls {
    fn call(&self, constant: u16, args: &[Value], steps: &mut u64) -> Result<Value, Fault> {
        let calls = u64::from(self.hosts.inference(constant).is_none());
        self.number.fetch_add(calls, Ordering::Relaxed);
        self.hosts.call(constant, args, steps)
    }

    fn raised(&self) -> Option<Box<dyn Any + Send>> {
        self.hosts.raised()
    }

    fn inference(&self, constant: u16) -> Option<Inside> {
        self.hosts.inference(constant)
    }
}

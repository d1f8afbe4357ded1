//! Machine code of a density, by Cranelift.
//!
//! Straight-line code in functions of a few hundred operations: for a single block, the time to allocate registers would grow
//! with the square of its length. Calls of `exp`, `log`, `pow` and the like are gathered level by level: first the operations
//! that need no call, then every call whose arguments are ready, as a loop over many numbers, then the operations
//! that waited for them. A separate call for each number would spill all registers each time.
//!
//! Numbers that cross from one function to another go through a scratch array. There are two programs over one
//! scratch: the gradient, which is sufficient inside a trajectory, and after it the other operations of the
//! value. A gradient of few coordinates without calls is also compiled as a loop of leapfrog steps.
//!
//! * `layout`: the order of operations, and the scratch; `code`: instructions of a function; `write`: functions of a
//!   program; `roll`: the loop of steps.
//!
//! Each operation is an operation of the tape, none fused and none re-ordered, so the numbers equal the tape's to the bit.

#![allow(unsafe_code)] // Calls of the functions that were compiled here.

mod code;
mod layout;
mod roll;
mod write;

use crate::density::Density;
use crate::kernels;
use crate::operation::Op;
use layout::Layout;
use niwaki_native::{CompileResult, Memory};
use std::sync::Arc;
use write::Writer;

/// Most numbers in the scratch: an instruction reaches numbers within 2 GiB.
const LARGEST: usize = 1 << 28;

/// `(x, g, scratch)`.
type Entry = unsafe extern "C" fn(*const f64, *mut f64, *mut f64);

#[derive(Clone, Copy)]
enum Step {
    Code(Entry),
    /// A loop over `n` numbers of each argument from place `from` on, one argument after the other; results at `to`.
    Calls {
        op: Op,
        from: u32,
        to: u32,
        n: u32,
    },
}

impl Step {
    /// A step that runs a function compiled as [`Entry`].
    fn code(address: *const u8) -> Step {
        // SAFETY: `Writer::plan_code`, which writes these functions, gives all of them that signature.
        Step::Code(unsafe { std::mem::transmute::<*const u8, Entry>(address) })
    }
}

/// One program: steps over an array of scratch.
struct Routine {
    steps: Vec<Step>,
    /// The loop of leapfrog steps, if the gradient is small enough.
    roll: Option<roll::Entry>,
    _code: Memory,
}

impl Routine {
    fn slope(density: &Density, layout: &Layout) -> CompileResult<Routine> {
        let mut writer = Writer::new(density, layout)?;
        writer.write_slope()?;
        let roll = writer.write_roll()?;
        let (steps, code, roll) = writer.finish(roll)?;
        // SAFETY: `Writer::write_roll` gives the function that signature.
        let roll = roll.map(|address| unsafe { std::mem::transmute::<*const u8, roll::Entry>(address) });
        Ok(Routine { steps, roll, _code: code })
    }

    fn rest(density: &Density, layout: &Layout) -> CompileResult<Routine> {
        let mut writer = Writer::new(density, layout)?;
        writer.write_rest()?;
        let (steps, code, _) = writer.finish(None)?;
        Ok(Routine { steps, roll: None, _code: code })
    }

    /// # Safety
    /// `x` and `g` hold a number for each coordinate, and `scratch` belongs to the layout.
    #[inline]
    unsafe fn run(&self, x: &[f64], g: &mut [f64], scratch: &mut [f64]) {
        for step in &self.steps {
            match *step {
                // SAFETY: the code reads numbers of `x` and writes numbers of `g`, one for each coordinate, and stays
                // within the scratch that was laid out with it.
                Step::Code(entry) => unsafe { entry(x.as_ptr(), g.as_mut_ptr(), scratch.as_mut_ptr()) },
                Step::Calls { op, from, to, n } => {
                    let (before, to) = scratch.split_at_mut(to as usize);
                    let n = n as usize;
                    let arguments = &before[from as usize..];
                    let (a, b) = arguments.split_at(n);
                    kernels::apply_all(op, a, b, &[], &mut to[..n]);
                }
            }
        }
    }
}

/// The shared part of all copies of a density's machine code.
struct Shared {
    slope: Routine,
    dim: usize,
    /// Place of the value.
    value: usize,
    /// Places that hold nonzero bits if the guards hold.
    flags: Vec<u32>,
}

/// A density as machine code, with its scratch memory. The gradient is compiled first, then the value.
#[derive(Clone)]
pub struct Native {
    shared: Arc<Shared>,
    rest: Option<Rest>,
    scratch: Vec<f64>,
}

/// Machine code of the operations that the value needs besides the gradient.
#[derive(Clone)]
pub(crate) struct Rest(Arc<Routine>);

/// The layout of a [`Rest`] before it is compiled.
pub(crate) struct Draft(Layout);

impl Draft {
    /// Compiles the rest; `density` must be the density of the draft.
    ///
    /// # Errors
    /// See [`Native::compile`].
    pub(crate) fn compile(&self, density: &Density) -> Result<Rest, String> {
        let routine = Routine::rest(density, &self.0).map_err(|error| error.to_string())?;
        Ok(Rest(Arc::new(routine)))
    }
}

impl Native {
    /// Compiles a density.
    ///
    /// # Errors
    /// A density of more than 2^28 numbers, a processor that Cranelift does not know, or memory that may not be executed. Use the
    /// tape then.
    pub fn compile(density: &Density) -> Result<Native, String> {
        let (mut native, draft) = Native::of_gradient(density)?;
        native.complete(draft.compile(density)?);
        Ok(native)
    }

    /// Compiles the gradient, and drafts the rest.
    ///
    /// # Errors
    /// See [`Native::compile`].
    pub(crate) fn of_gradient(density: &Density) -> Result<(Native, Draft), String> {
        let mut layout = Layout::new(density);
        if layout.scratch.len().max(density.dim()) > LARGEST {
            return Err("more numbers than an instruction can reach".into());
        }
        let slope = Routine::slope(density, &layout).map_err(|error| error.to_string())?;
        let scratch = std::mem::take(&mut layout.scratch);
        let flags = std::mem::take(&mut layout.flags);
        let shared = Shared { slope, dim: density.dim(), value: layout.value as usize, flags };
        Ok((Native { shared: Arc::new(shared), rest: None, scratch }, Draft(layout)))
    }

    /// Adds the rest, which must come from this code's draft.
    pub(crate) fn complete(&mut self, rest: Rest) {
        self.rest = Some(rest);
    }

    /// Whether the code computes values too.
    pub(crate) fn is_complete(&self) -> bool {
        self.rest.is_some()
    }

    /// The number of coordinates.
    pub fn dim(&self) -> usize {
        self.shared.dim
    }

    /// The log density at `x`, with its gradient in `g`; NaN outside the guards.
    ///
    /// # Panics
    /// See [`Native::inside`].
    #[inline]
    pub fn value_and_gradient(&mut self, x: &[f64], g: &mut [f64]) -> f64 {
        self.inside(x, g).unwrap_or(f64::NAN)
    }

    /// The log density at `x`, with its gradient in `g`; `None` outside the guards.
    ///
    /// # Panics
    /// If `x` or `g` does not have one number for each coordinate, or the code is not complete.
    #[inline]
    pub fn inside(&mut self, x: &[f64], g: &mut [f64]) -> Option<f64> {
        if !self.gradient(x, g) {
            return None;
        }
        let Rest(rest) = self.rest.as_ref().expect("`Compiled` calls this only where the code `is_complete`");
        // SAFETY: `gradient` checked the lengths.
        unsafe { rest.run(x, g, &mut self.scratch) };
        Some(self.scratch[self.shared.value])
    }

    /// The gradient at `x`; false, and NaN, outside the guards.
    ///
    /// # Panics
    /// If `x` or `g` does not have one number for each coordinate.
    #[inline]
    pub fn gradient(&mut self, x: &[f64], g: &mut [f64]) -> bool {
        let Shared { slope, dim, flags, .. } = &*self.shared;
        assert!(x.len() == *dim && g.len() == *dim);
        // SAFETY: the lengths are right, and the scratch is this layout's.
        unsafe { slope.run(x, g, &mut self.scratch) };
        let holds = flags.iter().all(|&flag| self.scratch[flag as usize].to_bits() != 0);
        if !holds {
            g.fill(f64::NAN);
        }
        holds
    }

    /// Makes up to `steps` leapfrog steps: `p += kick g`, `x += (step variance) p`, `g` becomes the gradient at `x`;
    /// the kick of all steps but the first is `step`. Stops before a step that leads outside the guards or to a slope
    /// that is not finite, and returns the number of steps made: zero if the density has no such loop.
    ///
    /// # Panics
    /// If a slice does not have one number for each coordinate.
    #[inline]
    pub fn roll(&mut self, at: Rolling<'_>, kick: f64, step: f64, steps: u32) -> u32 {
        let Some(entry) = self.shared.slope.roll.filter(|_| steps > 0) else { return 0 };
        let Rolling { x, p, g, variance } = at;
        assert!([x.len(), p.len(), g.len(), variance.len()] == [self.shared.dim; 4]);
        let (x, p, g, scratch) = (x.as_mut_ptr(), p.as_mut_ptr(), g.as_mut_ptr(), self.scratch.as_mut_ptr());
        // SAFETY: the code reads and writes one number of each for each coordinate, and stays within the scratch that
        // was laid out with it.
        let count = unsafe { entry(x, g, scratch, p, variance.as_ptr(), &[kick, step], u64::from(steps)) };
        u32::try_from(count).expect("at most `steps`")
    }
}

/// The state of a trajectory, one number for each coordinate.
pub struct Rolling<'a> {
    /// Position.
    pub x: &'a mut [f64],
    /// Momentum.
    pub p: &'a mut [f64],
    /// The gradient at `x`.
    pub g: &'a mut [f64],
    /// The diagonal of the inverse mass matrix.
    pub variance: &'a [f64],
}

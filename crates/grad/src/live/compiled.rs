//! A density that its tape evaluates while machine code is compiled in the background.
//!
//! Tape and machine code give equal numbers to the bit, so machine code replaces the tape as soon as it is ready: first the
//! gradient alone, which a trajectory needs most, then the value with its gradient.

use crate::density::Density;
use crate::native::{Native, Rest, Rolling};
use crate::tape::{Lanes, Tape};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};

/// Gradients by tape before machine code is compiled: with fewer, its compilation would not pay.
pub(crate) const WARM: u32 = 200;

enum Progress {
    /// Before the start: the number of gradients so far.
    Tape(u32),
    /// During compilation: first of the gradient, then of the rest. The lock never blocks; it lets threads share this state.
    Waiting(Mutex<Receiver<Stage>>),
    /// After compilation; also on a processor without machine code.
    Done,
}

/// A result of the background compilation.
enum Stage {
    Gradient(Native),
    Rest(Rest),
}

/// Compiles a density, and passes each stage to `give` as soon as it is ready; stops when `give` returns false.
fn compile(density: &Density, mut give: impl FnMut(Stage) -> bool) {
    let Ok((native, draft)) = Native::of_gradient(density) else { return };
    if give(Stage::Gradient(native))
        && let Ok(rest) = draft.compile(density)
    {
        give(Stage::Rest(rest));
    }
}

/// Evaluates a density at one point after another.
pub struct Compiled {
    density: Arc<Density>,
    tape: Arc<Tape>,
    lanes: Lanes<1>,
    native: Option<Native>,
    progress: Progress,
    /// Gradients by tape before machine code is compiled.
    warm: u32,
}

impl Compiled {
    /// Evaluates by tape first; machine code follows after some use.
    pub fn new(density: Arc<Density>) -> Compiled {
        Compiled::after(density, WARM)
    }

    /// As [`Compiled::new`], with machine code after `warm` gradients by tape.
    pub fn after(density: Arc<Density>, warm: u32) -> Compiled {
        let tape = Arc::new(Tape::new(&density));
        let lanes = tape.lanes();
        Compiled { density, tape, lanes, native: None, progress: Progress::Tape(0), warm }
    }

    /// Another evaluator of this density, with its own memory.
    pub fn beside(&self) -> Compiled {
        let (density, tape, progress) = (self.density.clone(), self.tape.clone(), Progress::Tape(0));
        Compiled { density, lanes: tape.lanes(), tape, native: None, progress, warm: self.warm }
    }

    /// Compiles now, and waits for the result.
    pub fn finish(&mut self) {
        match std::mem::replace(&mut self.progress, Progress::Done) {
            Progress::Tape(_) => {
                let density = self.density.clone();
                compile(&density, |stage| {
                    self.take(stage);
                    true
                });
            }
            Progress::Waiting(stages) => {
                let stages = stages.into_inner().unwrap_or_else(PoisonError::into_inner);
                stages.iter().for_each(|stage| self.take(stage));
            }
            Progress::Done => {}
        }
    }

    fn take(&mut self, stage: Stage) {
        match (stage, &mut self.native) {
            (Stage::Gradient(native), place) => *place = Some(native),
            (Stage::Rest(rest), Some(native)) => native.complete(rest),
            (Stage::Rest(_), None) => {}
        }
    }

    /// Whether machine code evaluates everything.
    pub fn is_native(&self) -> bool {
        self.native.as_ref().is_some_and(Native::is_complete)
    }

    /// The density.
    pub fn density(&self) -> &Arc<Density> {
        &self.density
    }

    /// The density's tape, for many chains at once.
    pub fn tape(&self) -> &Arc<Tape> {
        &self.tape
    }

    /// Starts the compilation when it is due, and takes the stages that are ready.
    fn advance(&mut self) {
        match &mut self.progress {
            Progress::Tape(n) if *n < self.warm => *n += 1,
            Progress::Tape(_) => {
                let (give, take) = channel();
                let density = self.density.clone();
                let thread = std::thread::Builder::new()
                    .name("machine code".into())
                    .spawn(move || compile(&density, |stage| give.send(stage).is_ok()));
                self.progress =
                    if thread.is_ok() { Progress::Waiting(Mutex::new(take)) } else { Progress::Done };
            }
            Progress::Waiting(stages) => {
                match stages.get_mut().unwrap_or_else(PoisonError::into_inner).try_recv() {
                    Ok(stage) => self.take(stage),
                    Err(TryRecvError::Empty) => {}
                    Err(TryRecvError::Disconnected) => self.progress = Progress::Done,
                }
            }
            Progress::Done => {}
        }
    }

    /// The log density at `x`, with its gradient in `g`; NaN outside the guards.
    ///
    /// # Panics
    /// If `x` or `g` does not have one number for each coordinate.
    #[inline]
    pub fn value_and_gradient(&mut self, x: &[f64], g: &mut [f64]) -> f64 {
        self.inside(x, g).unwrap_or(f64::NAN)
    }

    /// The log density at `x`, with its gradient in `g`; `None` outside the guards.
    ///
    /// # Panics
    /// See [`Compiled::value_and_gradient`].
    #[inline]
    pub fn inside(&mut self, x: &[f64], g: &mut [f64]) -> Option<f64> {
        if let Some(native) = self.native.as_mut().filter(|native| native.is_complete()) {
            return native.inside(x, g);
        }
        self.advance();
        self.lanes.inside(&self.tape, x, g)
    }

    /// The gradient at `x`; false outside the guards.
    ///
    /// # Panics
    /// See [`Compiled::value_and_gradient`].
    #[inline]
    pub fn gradient(&mut self, x: &[f64], g: &mut [f64]) -> bool {
        if let Some(native) = &mut self.native {
            return native.gradient(x, g);
        }
        self.advance();
        self.lanes.inside(&self.tape, x, g).is_some()
    }

    /// Leapfrog steps in machine code, as [`Native::roll`]; none while there is no machine code.
    ///
    /// # Panics
    /// See [`Native::roll`].
    #[inline]
    pub fn roll(&mut self, at: Rolling<'_>, kick: f64, step: f64, steps: u32) -> u32 {
        self.native.as_mut().map_or(0, |native| native.roll(at, kick, step, steps))
    }
}

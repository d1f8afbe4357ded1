//! A density, ready at once and fast soon: its tape runs while machine code is made in the background.
//!
//! The two give the same numbers to the bit, so the one takes over from the other whenever it is there: first the
//! gradient alone, which is most of what a trajectory asks for, then the value with its gradient.

use crate::density::Density;
use crate::native::Part;
use crate::tape::{Lanes, Tape};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};

/// Gradients by tape before machine code is asked for: it must be worth its compilation.
pub(crate) const WARM: u32 = 200;

enum Progress {
    /// Not asked for yet: gradients so far.
    Tape(u32),
    /// Being made: first the gradient alone, then both. The lock is never waited for; with it threads may share this.
    Waiting(Mutex<Receiver<Part>>),
    /// There is no more to come. A processor without machine code ends here with none.
    Done,
}

/// What evaluates a density at one point after another.
pub struct Compiled {
    density: Arc<Density>,
    tape: Arc<Tape>,
    lanes: Lanes<1>,
    slope: Option<Part>,
    both: Option<Part>,
    progress: Progress,
    /// Gradients by tape before machine code is asked for.
    warm: u32,
}

impl Compiled {
    /// Ready to evaluate by tape; machine code follows when it has been used for a while.
    pub fn new(density: Arc<Density>) -> Compiled {
        Compiled::after(density, WARM)
    }

    /// The same, asking for machine code after so many gradients by tape.
    pub fn after(density: Arc<Density>, warm: u32) -> Compiled {
        let tape = Arc::new(Tape::new(&density));
        let lanes = tape.lanes();
        Compiled { density, tape, lanes, slope: None, both: None, progress: Progress::Tape(0), warm }
    }

    /// Another that evaluates the same density, with memory of its own.
    pub fn beside(&self) -> Compiled {
        let (density, tape, progress) = (self.density.clone(), self.tape.clone(), Progress::Tape(0));
        Compiled { density, lanes: tape.lanes(), tape, slope: None, both: None, progress, warm: self.warm }
    }

    /// Compiles now, and waits for it.
    pub fn finish(&mut self) {
        match std::mem::replace(&mut self.progress, Progress::Done) {
            Progress::Tape(_) => {
                self.slope = Part::compile(&self.density, false).ok();
                self.both = self.slope.is_some().then(|| Part::compile(&self.density, true).ok()).flatten();
            }
            Progress::Waiting(parts) => {
                let parts = parts.into_inner().unwrap_or_else(PoisonError::into_inner);
                parts.iter().for_each(|part| self.take(part));
            }
            Progress::Done => {}
        }
    }

    fn take(&mut self, part: Part) {
        let place = if self.slope.is_none() { &mut self.slope } else { &mut self.both };
        *place = Some(part);
    }

    /// Whether all is machine code.
    pub fn is_native(&self) -> bool {
        self.both.is_some()
    }

    /// The density.
    pub fn density(&self) -> &Arc<Density> {
        &self.density
    }

    /// Its tape, for many chains at once.
    pub fn tape(&self) -> &Arc<Tape> {
        &self.tape
    }

    /// Asks for machine code after a while, and takes what there is of it.
    fn advance(&mut self) {
        match &mut self.progress {
            Progress::Tape(n) if *n < self.warm => *n += 1,
            Progress::Tape(_) => {
                let (give, take) = channel();
                let density = self.density.clone();
                let made = std::thread::Builder::new().name("machine code".into()).spawn(move || {
                    for with_value in [false, true] {
                        let Ok(part) = Part::compile(&density, with_value) else { return };
                        if give.send(part).is_err() {
                            return; // No one waits any more.
                        }
                    }
                });
                self.progress =
                    if made.is_ok() { Progress::Waiting(Mutex::new(take)) } else { Progress::Done };
            }
            Progress::Waiting(parts) => {
                match parts.get_mut().unwrap_or_else(PoisonError::into_inner).try_recv() {
                    Ok(part) => self.take(part),
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
    /// When `x` or `g` has not one number for each coordinate.
    #[inline]
    pub fn value_and_gradient(&mut self, x: &[f64], g: &mut [f64]) -> f64 {
        self.inside(x, g).unwrap_or(f64::NAN)
    }

    /// The same; `None` outside the guards.
    ///
    /// # Panics
    /// As for [`Compiled::value_and_gradient`].
    #[inline]
    pub fn inside(&mut self, x: &[f64], g: &mut [f64]) -> Option<f64> {
        if let Some(both) = &mut self.both {
            return both.inside(x, g);
        }
        self.advance();
        self.lanes.inside(&self.tape, x, g)
    }

    /// The gradient at `x`; false outside the guards.
    ///
    /// # Panics
    /// As for [`Compiled::value_and_gradient`].
    #[inline]
    pub fn gradient(&mut self, x: &[f64], g: &mut [f64]) -> bool {
        if let Some(slope) = &mut self.slope {
            return slope.inside(x, g).is_some();
        }
        self.advance();
        self.lanes.inside(&self.tape, x, g).is_some()
    }
}

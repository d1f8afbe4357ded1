//! A density, ready at once and fast soon: its tape runs while machine code is made in the background.
//!
//! The two agree to rounding, not to the bit, so the change from one to the other comes after a fixed number of
//! gradients, never when a clock or another thread says so: the same points give the same bits.

use crate::density::Density;
use crate::native::Native;
use crate::tape::{Lanes, Tape};
use std::sync::Arc;
use std::thread::JoinHandle;

/// Gradients by tape before machine code is asked for: it must be worth its compilation.
const WARM: u32 = 200;

/// Gradients by tape while the machine code is made: about what it costs. Then it is waited for.
const MEANWHILE: u32 = 2000;

enum Code {
    /// Not asked for yet: gradients so far.
    Tape(u32),
    /// Being made; gradients so far.
    Waiting(JoinHandle<Result<Native, String>>, u32),
    Ready(Box<Native>),
    /// This machine has none.
    Refused,
}

/// What evaluates a density at one point after another.
pub struct Compiled {
    density: Arc<Density>,
    tape: Arc<Tape>,
    lanes: Lanes<1>,
    code: Code,
}

impl Compiled {
    /// Ready to evaluate by tape; machine code follows when it has been used for a while.
    pub fn new(density: Arc<Density>) -> Compiled {
        let tape = Arc::new(Tape::new(&density));
        let lanes = tape.lanes();
        Compiled { density, tape, lanes, code: Code::Tape(0) }
    }

    /// Compiles now, and waits for it.
    pub fn finish(&mut self) {
        self.code = match std::mem::replace(&mut self.code, Code::Refused) {
            Code::Ready(native) => Code::Ready(native),
            Code::Waiting(made, _) => waited(made),
            Code::Tape(_) => ready(Native::compile(&self.density)),
            Code::Refused => Code::Refused,
        };
    }

    /// Whether machine code runs.
    pub fn is_native(&self) -> bool {
        matches!(self.code, Code::Ready(_))
    }

    /// The density.
    pub fn density(&self) -> &Arc<Density> {
        &self.density
    }

    /// Its tape, for many chains at once.
    pub fn tape(&self) -> &Arc<Tape> {
        &self.tape
    }

    /// The machine code, where there is some by now. Asks for it after a while.
    #[inline]
    fn native(&mut self) -> Option<&mut Native> {
        if !matches!(self.code, Code::Ready(_)) {
            self.advance();
        }
        match &mut self.code {
            Code::Ready(native) => Some(native),
            _ => None,
        }
    }

    fn advance(&mut self) {
        match &mut self.code {
            Code::Tape(n) if *n < WARM => *n += 1,
            Code::Tape(_) => {
                let density = self.density.clone();
                // Where nobody waits any more, what it makes is dropped with its handle.
                let made = std::thread::Builder::new()
                    .name("machine code".into())
                    .spawn(move || Native::compile(&density));
                self.code = made.map_or(Code::Refused, |made| Code::Waiting(made, 0));
            }
            Code::Waiting(_, n) if *n < MEANWHILE => *n += 1,
            Code::Waiting(..) => self.finish(),
            Code::Ready(_) | Code::Refused => {}
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
        match self.native() {
            Some(native) => native.inside(x, g),
            None => self.lanes.inside(&self.tape, x, g),
        }
    }

    /// The gradient at `x`; false outside the guards.
    ///
    /// # Panics
    /// As for [`Compiled::value_and_gradient`].
    #[inline]
    pub fn gradient(&mut self, x: &[f64], g: &mut [f64]) -> bool {
        match self.native() {
            Some(native) => native.gradient(x, g),
            None => self.lanes.inside(&self.tape, x, g).is_some(),
        }
    }
}

fn waited(made: JoinHandle<Result<Native, String>>) -> Code {
    ready(made.join().unwrap_or_else(|_| Err("the compilation came to no end".into())))
}

fn ready(made: Result<Native, String>) -> Code {
    made.map_or(Code::Refused, |native| Code::Ready(Box::new(native)))
}

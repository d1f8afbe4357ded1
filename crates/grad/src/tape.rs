//! The tape: a density as a list of instructions over lanes, one lane for each chain.
//!
//! Each instruction is a loop over the lanes, which the compiler turns into vector code, so 16 or 64 chains share the time to
//! decode an instruction. A tape needs no compilation. Slots are reused after the last reader of their value has run,
//! which keeps the lanes of a large graph in the cache.

#![allow(unsafe_code)] // Slices of one memory, disjoint by construction; calls of code for AVX2 and AVX-512.

use crate::density::{Comparison, Density, Guard};
use crate::graph::{Graph, Id, small};
use crate::kernels::{self, Vectors};
use crate::operation::Op;

#[derive(Clone, Copy, Debug)]
enum Step {
    Compute { op: Op, to: u32, a: u32, b: u32, c: u32 },
    Guard { comparison: Comparison, a: u32, b: u32 },
}

/// Instructions for some nodes of a graph; for a density, its value with its gradient.
#[derive(Clone, Debug)]
pub struct Tape {
    steps: Vec<Step>,
    /// Slots that hold a constant from the start.
    constants: Vec<(u32, f64)>,
    slots: usize,
    inputs: usize,
    /// The slots of the outputs; for a density, of its derivatives and then of its value.
    outputs: Vec<u32>,
}

impl Tape {
    /// The tape of a density.
    pub fn new(density: &Density) -> Tape {
        let outputs: Vec<Id> = density.gradient().iter().chain([&density.value()]).copied().collect();
        Tape::of(density.graph(), &outputs, density.guards())
    }

    /// The tape of a density's gradient alone.
    pub fn of_gradient(density: &Density) -> Tape {
        Tape::of(density.graph(), density.gradient(), density.guards())
    }

    /// The tape of some nodes, within guards.
    pub fn of(graph: &Graph, outputs: &[Id], guards: &[Guard]) -> Tape {
        const NONE: u32 = u32::MAX;
        let roots = guards.iter().flat_map(|g| [g.a, g.b]).chain(outputs.iter().copied());
        let needed = graph.needed(roots);
        let mut last = vec![0_u32; graph.len()];
        for &id in &needed {
            for arg in graph.node(id).args() {
                last[arg.index()] = id.0;
            }
        }
        // A guard runs right after the later of its two numbers.
        let mut guards: Vec<_> = guards.iter().map(|g| (g.a.max(g.b), *g)).collect();
        guards.sort_by_key(|(at, _)| *at);
        for (at, guard) in &guards {
            for id in [guard.a, guard.b] {
                last[id.index()] = last[id.index()].max(at.0);
            }
        }
        for id in outputs {
            last[id.index()] = NONE;
        }
        let inputs = graph.inputs();
        let mut tape = Tape { steps: vec![], constants: vec![], slots: inputs, inputs, outputs: vec![] };
        let mut slot = vec![NONE; graph.len()];
        let mut free: Vec<u32> = Vec::new();
        let mut guards = guards.into_iter().peekable();
        for &id in &needed {
            let node = graph.node(id);
            let permanent = node.op.arity() == 0;
            let reused = if permanent { node.input().map(small) } else { free.pop() };
            slot[id.index()] = reused.unwrap_or_else(|| {
                tape.slots += 1;
                small(tape.slots) - 1
            });
            let to = slot[id.index()];
            if let Some(x) = node.constant() {
                tape.constants.push((to, x));
            } else if !permanent {
                // An argument beyond the arity repeats the first: it is never the slot of the result.
                let at = |k: usize| slot[node.arg(if k < node.op.arity() { k } else { 0 }).index()];
                tape.steps.push(Step::Compute { op: node.op, to, a: at(0), b: at(1), c: at(2) });
            }
            let mut done: Vec<Id> = node.args().collect();
            while let Some((_, guard)) = guards.next_if(|(at, _)| *at == id) {
                let (a, b) = (slot[guard.a.index()], slot[guard.b.index()]);
                tape.steps.push(Step::Guard { comparison: guard.comparison, a, b });
                done.extend([guard.a, guard.b]);
            }
            done.sort_unstable();
            done.dedup();
            // Slots are freed only here, so that a result never overwrites its arguments.
            free.extend(
                done.iter()
                    .filter(|arg| last[arg.index()] == id.0 && graph.node(**arg).op.arity() > 0)
                    .map(|arg| slot[arg.index()]),
            );
        }
        tape.outputs = outputs.iter().map(|id| slot[id.index()]).collect();
        tape
    }

    /// The number of coordinates.
    pub fn dim(&self) -> usize {
        self.inputs
    }

    /// The number of slots in a lane.
    pub fn slots(&self) -> usize {
        self.slots
    }

    /// Memory for `L` lanes.
    pub fn lanes<const L: usize>(&self) -> Lanes<L> {
        let mut memory = vec![[0.0; L]; self.slots];
        for &(slot, x) in &self.constants {
            memory[slot as usize] = [x; L];
        }
        Lanes { memory }
    }

    /// Computes all nodes at `x`, and writes the first outputs to `g`; returns which lanes are inside the guards.
    #[inline(always)]
    fn run<const L: usize>(
        &self,
        memory: &mut [[f64; L]],
        x: &[[f64; L]],
        g: &mut [[f64; L]],
        inside: &mut [bool; L],
    ) {
        memory.iter_mut().zip(x).for_each(|(to, x)| copy(x, to));
        self.compute(memory, inside);
        for (g, slot) in g.iter_mut().zip(&self.outputs) {
            copy(&memory[*slot as usize], g);
        }
    }

    #[inline(always)]
    fn compute<const L: usize>(&self, memory: &mut [[f64; L]], inside: &mut [bool; L]) {
        let base = memory.as_mut_ptr();
        let slots = memory.len();
        for step in &self.steps {
            match *step {
                Step::Compute { op, to, a, b, c } => {
                    debug_assert!([to, a, b, c].iter().all(|&slot| (slot as usize) < slots));
                    // SAFETY: `Tape::of` hands out slots below `slots`, and gives a result a slot that none of its
                    // arguments has.
                    let (a, b, c, to) = unsafe {
                        (
                            &*base.add(a as usize),
                            &*base.add(b as usize),
                            &*base.add(c as usize),
                            &mut *base.add(to as usize),
                        )
                    };
                    kernels::any(op, a, b, c, to);
                }
                Step::Guard { comparison, a, b } => {
                    let (a, b) = (&memory[a as usize], &memory[b as usize]);
                    for (inside, (a, b)) in inside.iter_mut().zip(a.iter().zip(b)) {
                        *inside &= comparison.holds(*a, *b);
                    }
                }
            }
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn run_avx2<const L: usize>(
        &self,
        memory: &mut [[f64; L]],
        x: &[[f64; L]],
        g: &mut [[f64; L]],
        inside: &mut [bool; L],
    ) {
        self.run(memory, x, g, inside);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
    fn run_avx512<const L: usize>(
        &self,
        memory: &mut [[f64; L]],
        x: &[[f64; L]],
        g: &mut [[f64; L]],
        inside: &mut [bool; L],
    ) {
        self.run(memory, x, g, inside);
    }
}

/// Copies lanes number by number: the caller gets vector moves, while a call of `memcpy` would take as long as an
/// instruction.
#[inline(always)]
fn copy<const L: usize>(from: &[f64; L], to: &mut [f64; L]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

/// The memory of the lanes of a [`Tape`].
#[derive(Clone, Debug)]
pub struct Lanes<const L: usize> {
    memory: Vec<[f64; L]>,
}

impl<const L: usize> Lanes<L> {
    /// The log densities of `L` points, with their gradients in `g`.
    ///
    /// Coordinate `k` of chain `l` is `x[k][l]`: shape (dim, L), as for `g`. A chain outside the guards gets NaN.
    ///
    /// # Panics
    /// If `x` or `g` does not have one entry for each coordinate, or the memory belongs to another tape.
    pub fn value_and_gradient(&mut self, tape: &Tape, x: &[[f64; L]], g: &mut [[f64; L]]) -> [f64; L] {
        assert!(tape.outputs.len() == x.len() + 1);
        let inside = self.covered(tape, x, g);
        let mut value = self.value(tape);
        for (lane, inside) in inside.iter().enumerate() {
            if !inside {
                value[lane] = f64::NAN;
                g.iter_mut().for_each(|g| g[lane] = f64::NAN);
            }
        }
        value
    }

    /// Writes the first outputs of a tape, one for each coordinate, to `g`, and returns which lanes are inside the
    /// guards; the numbers of lanes outside have no meaning.
    ///
    /// # Panics
    /// See [`Lanes::value_and_gradient`]; also if the tape has fewer outputs.
    pub fn covered(&mut self, tape: &Tape, x: &[[f64; L]], g: &mut [[f64; L]]) -> [bool; L] {
        assert!(g.len() == x.len() && tape.outputs.len() >= x.len());
        self.run(tape, x, g)
    }

    /// The last output of the last evaluation: for a density's tape, its values.
    pub fn value(&self, tape: &Tape) -> [f64; L] {
        tape.outputs.last().map_or([f64::NAN; L], |slot| self.memory[*slot as usize])
    }

    /// Computes all nodes, with the first outputs in `g`, and returns which lanes are inside the guards.
    fn run(&mut self, tape: &Tape, x: &[[f64; L]], g: &mut [[f64; L]]) -> [bool; L] {
        assert!(x.len() == tape.dim() && self.memory.len() == tape.slots);
        let mut inside = [true; L];
        match Vectors::here() {
            // SAFETY: the processor has AVX-512.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx512 => unsafe { tape.run_avx512(&mut self.memory, x, g, &mut inside) },
            // SAFETY: the processor has AVX2.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx2 => unsafe { tape.run_avx2(&mut self.memory, x, g, &mut inside) },
            _ => tape.run(&mut self.memory, x, g, &mut inside),
        }
        inside
    }
}

impl Lanes<1> {
    /// The log density of one point, with its gradient in `g`; `None` outside the guards.
    ///
    /// # Panics
    /// See [`Lanes::value_and_gradient`].
    pub fn inside(&mut self, tape: &Tape, x: &[f64], g: &mut [f64]) -> Option<f64> {
        assert!(g.len() == x.len() && tape.outputs.len() == x.len() + 1);
        let [inside] = self.run(tape, x.as_chunks().0, g.as_chunks_mut().0);
        if !inside {
            g.fill(f64::NAN);
            return None;
        }
        Some(self.memory[tape.outputs[x.len()] as usize][0])
    }

    /// The outputs at a point.
    pub(crate) fn outputs(&mut self, tape: &Tape, x: &[f64]) -> Vec<f64> {
        self.run(tape, x.as_chunks().0, &mut []);
        tape.outputs.iter().map(|slot| self.memory[*slot as usize][0]).collect()
    }

    /// The log density of one point, with its gradient in `g`; NaN outside the guards.
    ///
    /// # Panics
    /// See [`Lanes::value_and_gradient`].
    pub fn at_point(&mut self, tape: &Tape, x: &[f64], g: &mut [f64]) -> f64 {
        self.inside(tape, x, g).unwrap_or(f64::NAN)
    }
}

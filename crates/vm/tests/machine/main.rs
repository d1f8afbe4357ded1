//! Tests of the machine, for programs as users write them and for broken texts.
//!
//! * `running`: results, suspension, budgets and call stacks;
//! * `native`: machine code agrees with the interpreter;
//! * `parts`: the part that was emitted last on the call path of a choice;
//! * `mutated`: a text with random changes is refused, or runs.
//!
//! The tests are one program, because each program would compile the machine again.

mod mutated;
mod native;
mod parts;
mod running;

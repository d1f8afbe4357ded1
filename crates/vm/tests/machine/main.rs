//! The machine keeps what it claims, for programs as users write them and for texts that nobody should.
//!
//! * `running`: results, suspension, budgets and stacks of calls;
//! * `native`: machine code does what the interpreter does;
//! * `parts`: the part that was emitted last on the call path of a choice;
//! * `mutated`: a text that was changed at random is refused, or runs.
//!
//! One program, because each would compile the machine again.

mod mutated;
mod native;
mod parts;
mod running;

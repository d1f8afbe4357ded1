//! Values: the contents of registers.
//!
//! A value has 16 bytes: a tag, and either the number itself or one thin pointer to shared data that never
//! changes. The kinds are in `variants`. [`List`] is a persistent trie of our own ([`list`]); tuples, records,
//! dictionaries and closures are flat.
//!
//! Nothing in this module recurses on the host stack. Dropping (`release`), identity of bits ([`identity`]),
//! Python's `==` and `<` ([`compare`]), hashing and printing (`print`) all keep a stack of their own. So a
//! chain of a million nested tuples is an ordinary value (a plain drop of such a chain overflows the stack).
//!
//! The scalar type is a parameter: `f64` when a model runs, a recording scalar when its gradient is needed.

pub mod aggregate;
mod blocks;
pub mod census;
pub mod compare;
pub mod draw;
pub mod format;
mod futures;
pub mod identity;
pub mod index;
pub mod list;
pub mod numbers;
pub mod ops;
pub mod print;
mod release;
pub mod text;
mod variants;

pub use aggregate::{Class, ClassKind, Closure, Dict, Memo, Range, Record, Tuple, Vector};
pub use census::Census;
pub use compare::{equal, hash, order};
pub use draw::log_density;
pub use identity::identical;
pub use index::{iter_get, iter_len};
pub use list::List;
pub use niwaki_geom::Shape;
pub use niwaki_math::{Dist, Draw, Family, Param, Scalar};
pub use print::{repr, str_of};
pub use text::Text;
pub use variants::{Cell, MAX_ELEMENTS, Value};

// The machine copies values between registers all the time; a third word would cost every copy.
const _: () = assert!(std::mem::size_of::<Value<f64>>() == 16);
const _: () = assert!(std::mem::size_of::<Result<Value<f64>, crate::fault::Fault>>() == 16);
const _: () = {
    const fn shared_between_threads<T: Send + Sync>() {}
    shared_between_threads::<Value<f64>>()
};

//! Reals as the integers of their bits, for data in JSON, which has no infinity.
//!
//! `#[serde(with = "niwaki_math::bits")]`

use serde::{Deserialize, Deserializer, Serializer};

/// Writes the bits of a number.
///
/// # Errors
/// An error of the writer.
pub fn serialize<S: Serializer>(x: &f64, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_u64(x.to_bits())
}

/// Reads a number from its bits.
///
/// # Errors
/// The input is not a whole number of 64 bits.
pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    u64::deserialize(from).map(f64::from_bits)
}

//! The search: enumeration, importance sampling, particles.

//! Numbers in, numbers out: scalars, small vectors, random streams, distributions.

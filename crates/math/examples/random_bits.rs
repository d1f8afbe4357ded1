//! Writes random bits of many streams to the standard output, for a battery of tests:
//! `cargo run --release -p niwaki-math --example random_bits -- ORDER [low|high] | RNG_test stdin64 -tlmax 64GB`.
//!
//! Orders: `along` a single stream; the first words at consecutive `addresses`, their `upper-addresses`, `seeds`, `streams` and `visits`;
//! words of `seed-bits`, `address-bits` and `visit-bits`, where each number is followed by those that differ from it in a single bit; and
//! `interleaved`, the words of 257 streams that differ from a stream in a single bit of seed, address or visit, by turns.

use niwaki_math::{RngCore, Stream};
use std::io::{BufWriter, Write};

/// The word of a stream that differs from a stream of the project by three numbers.
fn word(seed: u64, address: u128, visit: u64) -> u64 {
    Stream::new(seed, 0, address, visit).next_u64()
}

/// The words of an order: `n` is the number of the word.
fn order(name: &str) -> Option<Box<dyn FnMut(u64) -> u64>> {
    // A number, then the numbers that differ from it in a bit. The factor keeps the neighbours of two numbers apart.
    let near = |n: u64, bits: u64| {
        let base = u128::from(n / (bits + 1)).wrapping_mul(0x9E37_79B9_7F4A_7C15_F39C_C060_5CED_C835);
        base ^ if n.is_multiple_of(bits + 1) { 0 } else { 1 << (n % (bits + 1) - 1) }
    };
    let mut stream = Stream::new(1, 0, 77, 0);
    let mut streams: Vec<Stream> = std::iter::once(Stream::new(1, 0, 77, 0))
        .chain((0..64).map(|bit| Stream::new(1 ^ 1 << bit, 0, 77, 0)))
        .chain((0..128).map(|bit| Stream::new(1, 0, 77 ^ 1 << bit, 0)))
        .chain((0..64).map(|bit| Stream::new(1, 0, 77, 1 << bit)))
        .collect();
    Some(match name {
        "along" => Box::new(move |_| stream.next_u64()),
        "addresses" => Box::new(|n| word(1, u128::from(n), 0)),
        "upper-addresses" => Box::new(|n| word(1, u128::from(n) << 64, 0)),
        "seeds" => Box::new(|n| word(n, 77, 0)),
        "streams" => Box::new(|n| Stream::new(1, n, 77, 0).next_u64()),
        "visits" => Box::new(|n| word(1, 77, n)),
        "seed-bits" => Box::new(move |n| word(near(n, 64) as u64, 77, 0)),
        "address-bits" => Box::new(move |n| word(1, near(n, 128), 0)),
        "visit-bits" => Box::new(move |n| word(1, 77, near(n, 64) as u64)),
        "interleaved" => Box::new(move |n| {
            let at = n as usize % streams.len();
            streams[at].next_u64()
        }),
        _ => return None,
    })
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_default();
    let Some(mut words) = order(&name) else { panic!("no order of that name: {name}") };
    let half = arguments.next();
    let mut out = BufWriter::with_capacity(1 << 20, std::io::stdout().lock());
    for n in 0.. {
        let bits = words(n);
        // A battery that has seen enough closes the pipe.
        let written = match half.as_deref() {
            Some("low") => out.write_all(&(bits as u32).to_le_bytes()),
            Some("high") => out.write_all(&((bits >> 32) as u32).to_le_bytes()),
            _ => out.write_all(&bits.to_le_bytes()),
        };
        if written.is_err() {
            return;
        }
    }
}

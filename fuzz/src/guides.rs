//! Files of guides: any bytes are a network or an error, and a network that was read is written to the same bytes.

use crate::numbers::{below, byte};
use arbitrary::Unstructured;
use niwaki_guide::{Filtered, FilteredForm, Head, Net, NetForm, read, read_filtered, write, write_filtered};

/// Bytes before the description of a file: its length.
const LENGTH: usize = 8;

/// Reads a file of any bytes, or a whole one that is damaged.
///
/// # Panics
/// When a network that was read does not come back from what is written of it.
pub fn check(bytes: &[u8]) {
    match bytes.split_first() {
        Some((kind, rest)) if kind & 1 == 1 => reads(&damaged(&mut Unstructured::new(rest))),
        Some((_, rest)) => reads(rest),
        None => {}
    }
}

fn reads(bytes: &[u8]) {
    if let Ok((net, text)) = read(bytes) {
        let written = write(&net, &text);
        let (again, same) = read(&written).unwrap_or_else(|error| panic!("not read again: {error}"));
        assert_eq!((written, &text), (write(&again, &same), &same));
    }
    if let Ok(Some((net, text))) = read_filtered(bytes) {
        let written = write_filtered(&net, &text);
        let again = read_filtered(&written).unwrap_or_else(|error| panic!("not read again: {error}"));
        let (again, same) = again.expect("the same kind of network");
        assert_eq!((written, &text), (write_filtered(&again, &same), &same));
    }
}

/// The bytes of a small network, with some of them changed, left out or doubled; the length follows, or does not.
fn damaged(u: &mut Unstructured<'_>) -> Vec<u8> {
    let head = |u: &mut Unstructured<'_>| match below(u, 3) {
        0 => Head::Normal { components: 1 + below(u, 2) },
        1 => Head::Finite { values: 1 + below(u, 3) },
        _ => Head::Count { components: 1 },
    };
    let heads: Vec<Head> = (0..below(u, 3)).map(|_| head(u)).collect();
    let features = below(u, 3);
    let mut bytes = if below(u, 2) == 0 {
        let hidden = [1 + below(u, 4), 1 + below(u, 4)];
        write(&Net::start(NetForm { windows: below(u, 4), features, hidden, heads }, 1), "a text")
    } else {
        let sees = heads.iter().map(|_| (0..features as u32).collect()).collect();
        let form = FilteredForm { target: false, scene: below(u, 8) == 0, features, sees, heads };
        write_filtered(&Filtered::start(form, 1), "a text")
    };
    for _ in 0..below(u, 6) {
        let about = usize::from(bytes[0]) + (usize::from(bytes[1]) << 8);
        let end = if below(u, 8) == 0 { bytes.len() } else { (LENGTH + about).min(bytes.len()) };
        let at = usize::from(u.arbitrary::<u16>().unwrap_or(0)) % end;
        match below(u, 4) {
            0 => bytes[at] = byte(u),
            1 => bytes[at] = b"0123456789-.e\"[]{},:ntf"[below(u, 23)],
            2 if at >= LENGTH && about > 0 => {
                bytes.remove(at);
                bytes[..2].copy_from_slice(&((about - 1) as u16).to_le_bytes());
            }
            _ if at >= LENGTH && about < 60_000 => {
                bytes.insert(at, b"0123456789-e"[below(u, 12)]);
                bytes[..2].copy_from_slice(&((about + 1) as u16).to_le_bytes());
            }
            _ => {}
        }
    }
    bytes
}

//! Changes of core text that keep most of it well formed: words and parenthesised parts are replaced, moved, doubled, and
//! taken from other programs.

use niwaki_vm::builtins::builtins;
use niwaki_vm::value::Family;
use std::ops::Range;
use std::sync::OnceLock;

#[path = "../../crates/vm/tests/kept/programs.rs"]
#[allow(dead_code, missing_docs, unreachable_pub)]
mod of_the_machine;

/// Words of statements, expressions and items.
const HEADS: [&str; 42] = [
    "module",
    "file",
    "class",
    "const",
    "fn",
    "entry",
    "params",
    "captures",
    "defaults",
    "set",
    "unpack",
    "unpack_star",
    "if",
    "then",
    "else",
    "for",
    "body",
    "while",
    "break",
    "continue",
    "return",
    "do",
    "assert",
    "lit",
    "var",
    "data",
    "and",
    "or",
    "cond",
    "call",
    "closure",
    "apply",
    "sample",
    "observe",
    "factor",
    "condition",
    "query",
    "emit",
    "force",
    "future",
    "future_apply",
    "dist",
];
/// Further words: heads of rare parts, names of methods, atoms.
const ATOMS: [&str; 40] = [
    "record",
    "field",
    "list",
    "tuple",
    "dict",
    "method",
    "host",
    "0",
    "1",
    "2",
    "3",
    "-1",
    "0.5",
    "1.0",
    "-0.0",
    "1e300",
    "5e-324",
    "inf",
    "-inf",
    "nan",
    "true",
    "false",
    "none",
    "9223372036854775807",
    "-9223372036854775808",
    "4294967296",
    "99999999999999999999",
    "\"\"",
    "\"x\"",
    "\"m\"",
    "$x",
    "$n",
    "$%look",
    "#a",
    "#a[]",
    "@1:1-1:9",
    "()",
    "(list)",
    "(tuple 1 2)",
    "(range 3)",
];

/// Whole programs to take parts from.
pub fn programs() -> &'static [&'static str] {
    static ALL: OnceLock<Vec<&'static str>> = OnceLock::new();
    ALL.get_or_init(|| {
        let golden =
            [include_str!("../../tests/golden/closures.core"), include_str!("../../tests/golden/ship.core")];
        golden.into_iter().chain(of_the_machine::PROGRAMS.iter().map(|(_, text)| *text)).collect()
    })
}

/// Random numbers from the seed that the driver gives (SplitMix64).
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % n.max(1) as u64) as usize
    }
}

/// Changes the text after the first `head` bytes in one to four places; its size afterwards, at most `most`.
pub fn change(data: &mut [u8], size: usize, most: usize, seed: u32, head: usize) -> usize {
    let mut dice = Dice(u64::from(seed));
    let head = head.min(size);
    if head > 0 && dice.below(4) == 0 {
        data[dice.below(head)] = dice.below(256) as u8;
    }
    let mut text = String::from_utf8_lossy(&data[head..size]).into_owned();
    if text.len() < 12 {
        let all = programs();
        text = all[dice.below(all.len())].to_owned();
    }
    for _ in 0..=dice.below(4) {
        let Some(changed) = once(&text, &mut dice) else { continue };
        if head + changed.len() <= most {
            text = changed;
        }
    }
    if head + text.len() > most {
        return size;
    }
    data[head..head + text.len()].copy_from_slice(text.as_bytes());
    head + text.len()
}

fn once(text: &str, dice: &mut Dice) -> Option<String> {
    let parts = parts(text);
    if parts.is_empty() {
        return None;
    }
    let at = pick(&parts, dice);
    let here = &text[at.clone()];
    let instead = match dice.below(12) {
        0 => String::new(),
        1 => format!("{here} {here}"),
        2 | 3 => text[pick(&parts, dice)].to_owned(),
        4 => {
            let all = programs();
            let other = all[dice.below(all.len())];
            other[pick(&self::parts(other), dice)].to_owned()
        }
        5 => format!("({} {here})", word(dice)),
        6 => format!("({} {here} {})", word(dice), &text[pick(&parts, dice)]),
        7 => here.strip_prefix('(').and_then(|inside| inside.strip_suffix(')')).unwrap_or("0").to_owned(),
        8 => return Some(swapped(text, at, pick(&parts, dice))),
        9 => return Some(swapped(text, at.clone(), alike(text, &parts, here, dice).unwrap_or(at))),
        _ => word(dice).to_owned(),
    };
    Some([&text[..at.start], &instead, &text[at.end..]].concat())
}

/// Another part that starts with the same character.
fn alike(text: &str, parts: &[Range<usize>], here: &str, dice: &mut Dice) -> Option<Range<usize>> {
    let first = here.chars().next()?;
    let all: Vec<_> = parts.iter().filter(|part| text[(*part).clone()].starts_with(first)).collect();
    Some(all[dice.below(all.len())].clone())
}

/// The text with two parts exchanged; unchanged where one is in the other.
fn swapped(text: &str, a: Range<usize>, b: Range<usize>) -> String {
    let (a, b) = if a.start <= b.start { (a, b) } else { (b, a) };
    if a.end > b.start {
        return text.to_owned();
    }
    let of = |range: Range<usize>| &text[range];
    [of(0..a.start), of(b.clone()), of(a.end..b.start), of(a), &text[b.end..]].concat()
}

fn word(dice: &mut Dice) -> &'static str {
    let table = builtins::<f64>();
    match dice.below(8) {
        0..3 => HEADS[dice.below(HEADS.len())],
        3 | 4 => ATOMS[dice.below(ATOMS.len())],
        5 => Family::ALL[dice.below(Family::ALL.len())].name(),
        _ => table[dice.below(table.len())].name,
    }
}

/// Small parts as often as large ones: half of the time one of the atoms.
fn pick(parts: &[Range<usize>], dice: &mut Dice) -> Range<usize> {
    let first = parts[dice.below(parts.len())].clone();
    let second = parts[dice.below(parts.len())].clone();
    if dice.below(2) == 0 && second.len() < first.len() { second } else { first }
}

/// Every atom, string and closed list of a text.
fn parts(text: &str) -> Vec<Range<usize>> {
    let (bytes, mut open, mut found, mut at) = (text.as_bytes(), vec![], vec![], 0);
    while at < bytes.len() {
        let start = at;
        at += 1;
        match bytes[start] {
            b' ' | b'\n' | b'\t' | b'\r' => {}
            b'(' => open.push(start),
            b')' => found.extend(open.pop().map(|from| from..at)),
            b'"' => {
                while at < bytes.len() && bytes[at] != b'"' {
                    at += if bytes[at] == b'\\' { 2 } else { 1 };
                }
                at = (at + 1).min(bytes.len());
                while !text.is_char_boundary(at) {
                    at += 1;
                }
                found.push(start..at);
            }
            _ => {
                while at < bytes.len() && !b" \n\t\r()\"".contains(&bytes[at]) {
                    at += 1;
                }
                found.push(start..at);
            }
        }
    }
    found
}

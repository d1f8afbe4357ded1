//! Patterns over readable addresses: `*` and `?` match text within one component, `**` matches any text.
//!
//! A pattern without `/` is compared with the last component, any other with the whole address. Brackets are plain
//! text: the number of an iteration.

use niwaki_vm::value::text::edits;

/// Whether a pattern matches an address.
pub fn matches(pattern: &str, address: &str) -> bool {
    let text = if pattern.contains('/') || pattern.contains("**") { address } else { last(address) };
    let (pattern, text): (Vec<char>, Vec<char>) = (pattern.chars().collect(), text.chars().collect());
    // Where to backtrack to: a star of the pattern, and one more character of the text.
    let (mut p, mut t) = (0, 0);
    let mut returns: Vec<(usize, usize)> = Vec::new();
    loop {
        let star = pattern.get(p) == Some(&'*');
        let deep = star && pattern.get(p + 1) == Some(&'*');
        if star {
            let behind = p + if deep { 2 } else { 1 };
            if t < text.len() && (deep || text[t] != '/') {
                returns.push((p, t + 1));
            }
            p = behind;
            continue;
        }
        match (pattern.get(p), text.get(t)) {
            (None, None) => return true,
            (Some('?'), Some(c)) if *c != '/' => (p, t) = (p + 1, t + 1),
            (Some(a), Some(b)) if a == b => (p, t) = (p + 1, t + 1),
            _ => match returns.pop() {
                Some(place) => (p, t) = place,
                None => return false,
            },
        }
    }
}

/// The last component of an address.
pub fn last(address: &str) -> &str {
    address.rsplit('/').next().unwrap_or(address)
}

/// The three addresses of `known` with the smallest edit distance to `pattern`.
pub fn nearest(pattern: &str, known: &[String]) -> Vec<String> {
    let by_name = !pattern.contains('/');
    let mut ranked: Vec<(usize, &String)> = known
        .iter()
        .map(|address| (edits(pattern, if by_name { last(address) } else { address }), address))
        .collect();
    ranked.sort();
    ranked.dedup_by(|a, b| a.1 == b.1);
    ranked.into_iter().take(3).map(|(_, address)| address.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_match_within_a_component_and_double_stars_across() {
        for (pattern, address, expected) in [
            ("x", "x", true),
            ("x", "a/b/x", true),
            ("x", "a/b/xy", false),
            ("x*", "a/b/xy", true),
            ("a/*/x", "a/b/x", true),
            ("a/*/x", "a/b/c/x", false),
            ("a/**/x", "a/b/c/x", true),
            ("**", "a/b/c/x", true),
            ("**x", "a/b/c/x", true),
            ("row[*]/x", "row[12]/x", true),
            ("row[?]/x", "row[12]/x", false),
            ("row[1]/x", "row[1]/x", true),
            ("*a*b*", "xxaxxbxx", true),
            ("*a*b*", "xxbxxaxx", false),
            ("", "", true),
            ("*", "", true),
            ("a", "", false),
        ] {
            assert_eq!(matches(pattern, address), expected, "{pattern} {address}");
        }
    }

    #[test]
    fn nearest_addresses_come_first() {
        let known: Vec<String> =
            ["tree/width", "tree/height", "tree/depth", "colour"].map(String::from).into();
        assert_eq!(nearest("heigt", &known), ["tree/height", "tree/depth", "tree/width"]);
    }
}

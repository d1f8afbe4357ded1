//! Strings: shared, one pointer wide, counted in code points as Python counts them.

use super::blocks::{block, shared};
use std::ops::Deref;
use std::sync::Arc;

/// An immutable string.
#[derive(Clone, Debug)]
pub struct Text(Arc<Body>);

#[derive(Debug)]
struct Body {
    text: Box<str>,
    /// Number of code points. It equals the number of bytes exactly when the text is ASCII; then indexing is
    /// O(1).
    chars: usize,
}

impl Text {
    /// Length in code points.
    pub fn chars_len(&self) -> usize {
        self.0.chars
    }

    /// The code point at a position inside of the text, as a string.
    pub fn char_at(&self, at: usize) -> &str {
        self.span(at, at + 1)
    }

    /// Code points `from..to` (both at most the length).
    pub fn span(&self, from: usize, to: usize) -> &str {
        if from >= to {
            return "";
        }
        if self.0.chars == self.0.text.len() {
            return &self.0.text[from..to];
        }
        let byte = |at: usize| self.0.text.char_indices().nth(at).map_or(self.0.text.len(), |(byte, _)| byte);
        &self.0.text[byte(from)..byte(to)]
    }

    /// Its address in memory: no other text has it while this one exists.
    pub(super) fn address(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }

    /// Whether another value holds the string, too.
    pub(super) fn is_shared(&self) -> bool {
        Arc::strong_count(&self.0) > 1
    }

    pub(super) fn own_bytes(&self) -> usize {
        shared::<Body>() + block(self.0.text.len())
    }

    /// True when both are the same string in memory.
    pub fn ptr_eq(&self, other: &Text) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Deref for Text {
    type Target = str;
    fn deref(&self) -> &str {
        &self.0.text
    }
}

impl From<String> for Text {
    fn from(text: String) -> Text {
        let chars = text.chars().count();
        Text(Arc::new(Body { text: text.into_boxed_str(), chars }))
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Text {
        Text::from(text.to_string())
    }
}

impl PartialEq for Text {
    fn eq(&self, other: &Text) -> bool {
        self.ptr_eq(other) || **self == **other
    }
}

impl Eq for Text {}

/// The Levenshtein distance of two strings, for suggestions in messages.
pub fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.iter().enumerate() {
            let above = row[j + 1];
            row[j + 1] = (diagonal + usize::from(x != *y)).min(above + 1).min(row[j] + 1);
            diagonal = above;
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_code_points() {
        let plain = Text::from("abc");
        assert_eq!((plain.chars_len(), plain.char_at(1), plain.span(1, 3)), (3, "b", "bc"));
        let wide = Text::from("a\u{e9}\u{1f333}z");
        assert_eq!(
            (wide.chars_len(), wide.char_at(2), wide.span(1, 4)),
            (4, "\u{1f333}", "\u{e9}\u{1f333}z")
        );
        assert_eq!(wide.span(3, 1), "");
    }
}

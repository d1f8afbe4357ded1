//! Characters to nested lists: the S-expressions that core form is written in.

/// An S-expression, its atoms borrowed from the text.
#[derive(Clone, Debug, PartialEq)]
pub enum Sexp<'a> {
    /// A bare word or number.
    Atom(&'a str),
    /// A quoted string, its escapes (those of JSON) resolved.
    Text(String),
    /// A parenthesised list.
    List(Vec<Sexp<'a>>),
}

/// Text that is not core form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CoreError {
    /// The description of the error.
    pub message: String,
    /// Byte offset into the text, where known.
    pub offset: Option<usize>,
}

impl CoreError {
    /// An error without a place.
    pub fn new(message: impl Into<String>) -> Self {
        CoreError { message: message.into(), offset: None }
    }
}

impl std::fmt::Display for CoreError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.offset {
            Some(at) => write!(f, "core form, byte {at}: {}", self.message),
            None => write!(f, "core form: {}", self.message),
        }
    }
}

impl std::error::Error for CoreError {}

/// Lists nested deeper than this are refused: later passes recurse once for each level.
pub const MAX_DEPTH: usize = 2000;

/// Reads one S-expression and nothing after it.
pub fn read(text: &str) -> Result<Sexp<'_>, CoreError> {
    let fail = |message: &str, at: usize| CoreError { message: message.to_string(), offset: Some(at) };
    let bytes = text.as_bytes();
    let mut open: Vec<Vec<Sexp<'_>>> = Vec::new();
    let mut whole: Option<Sexp<'_>> = None;
    let mut at = 0;
    while at < bytes.len() {
        let item = match bytes[at] {
            b' ' | b'\n' | b'\t' | b'\r' => {
                at += 1;
                continue;
            }
            b';' => {
                while at < bytes.len() && bytes[at] != b'\n' {
                    at += 1;
                }
                continue;
            }
            b'(' => {
                if open.len() >= MAX_DEPTH {
                    return Err(fail("nested too deeply", at));
                }
                open.push(Vec::new());
                at += 1;
                continue;
            }
            b')' => {
                at += 1;
                Sexp::List(
                    open.pop()
                        .ok_or_else(|| fail("a closing parenthesis without its opening one", at - 1))?,
                )
            }
            b'"' => {
                let (value, end) = quoted(text, at).map_err(|m| fail(m, at))?;
                at = end;
                Sexp::Text(value)
            }
            _ => {
                let start = at;
                while at < bytes.len() && !b" \n\t\r()\";".contains(&bytes[at]) {
                    at += 1;
                }
                Sexp::Atom(&text[start..at])
            }
        };
        match open.last_mut() {
            Some(list) => list.push(item),
            None if whole.is_none() => whole = Some(item),
            None => return Err(fail("something after the end", at)),
        }
    }
    if !open.is_empty() {
        return Err(fail("an opening parenthesis without its closing one", bytes.len()));
    }
    whole.ok_or_else(|| fail("nothing to read", 0))
}

/// Reads the quoted string that starts at `start`: its value and the offset after the closing quote.
fn quoted(text: &str, start: usize) -> Result<(String, usize), &'static str> {
    let mut value = String::new();
    let mut chars = text[start + 1..].char_indices();
    let hex = |chars: &mut std::str::CharIndices<'_>| -> Result<u32, &'static str> {
        let mut code = 0;
        for _ in 0..4 {
            let digit = chars.next().and_then(|(_, c)| c.to_digit(16)).ok_or("a broken \\u escape")?;
            code = code * 16 + digit;
        }
        Ok(code)
    };
    while let Some((i, c)) = chars.next() {
        match c {
            '"' => return Ok((value, start + 1 + i + 1)),
            '\\' => match chars.next().ok_or("a string without its end")?.1 {
                'n' => value.push('\n'),
                't' => value.push('\t'),
                'r' => value.push('\r'),
                'b' => value.push('\u{8}'),
                'f' => value.push('\u{c}'),
                'u' => {
                    let mut code = hex(&mut chars)?;
                    if (0xD800..0xDC00).contains(&code) {
                        if chars.next().map(|p| p.1) != Some('\\') || chars.next().map(|p| p.1) != Some('u') {
                            return Err("half of a surrogate pair");
                        }
                        let low = hex(&mut chars)?;
                        if !(0xDC00..0xE000).contains(&low) {
                            return Err("half of a surrogate pair");
                        }
                        code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
                    }
                    value.push(char::from_u32(code).ok_or("a broken \\u escape")?);
                }
                other => value.push(other),
            },
            other => value.push(other),
        }
    }
    Err("a string without its end")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nests_strings_and_comments() {
        let s = read("(a \"x\\n\\u00e9\\ud83d\\ude00\" ; note\n (b 1.5))").unwrap();
        let Sexp::List(items) = &s else { panic!("a list") };
        assert_eq!(items[1], Sexp::Text("x\n\u{e9}\u{1F600}".into()));
        assert_eq!(items[2], Sexp::List(vec![Sexp::Atom("b"), Sexp::Atom("1.5")]));
    }

    #[test]
    fn refuses_broken_text() {
        for text in ["", "(a", ")", "(a) b", "\"x", "\"\\u12\"", "\"\\ud800x\""] {
            assert!(read(text).is_err(), "{text}");
        }
    }

    #[test]
    fn deep_nesting_is_an_error_not_a_crash() {
        assert!(read(&"(".repeat(1_000_000)).is_err());
    }
}

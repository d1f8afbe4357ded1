//! Words of choices: names of the numbers that a choice draws.
//!
//! `choose(["gable", "hip"])` draws 0 or 1. Its site has the list of options as its last argument. If the options are
//! distinct strings, they are the *words* of the choice. The run itself holds the number, so words change neither draws
//! nor densities; records name the number by its word, and values from outside may be words.

use super::answers::At;
use crate::fault::Fault;
use crate::value::draw::elements;
use crate::value::text::{Text, edits};
use crate::value::{Value, repr};
use niwaki_math::Scalar;
use std::borrow::Cow;
use std::collections::HashSet;

/// The value of a choice for a person: the word of a number that has one.
pub fn named<S: Scalar>(value: &Value<S>, words: Option<&[Text]>) -> Value<S> {
    match (value, words) {
        (Value::Int(number), Some(words)) => usize::try_from(*number).ok().and_then(|at| words.get(at)),
        _ => None,
    }
    .map_or_else(|| value.clone(), |word| Value::Str(word.clone()))
}

/// The most options that a message lists.
const LISTED: usize = 12;

impl<S: Scalar> At<'_, S> {
    /// The words of a choice, in the order of its numbers: its options, where these are distinct strings.
    pub fn words(&self) -> Option<Vec<Text>> {
        if !self.site.has_options {
            return None;
        }
        let options = *self.function.operands[self.site.args.range()].last()?;
        // Arguments of a choice are never in scratch.
        let options = match self.registers().get(self.state, &[], options) {
            sequence @ (Value::List(_) | Value::Tuple(_)) => elements(sequence)?,
            _ => return None,
        };
        let word = |option| if let Value::Str(word) = option { Some(word) } else { None };
        let words: Vec<Text> = options.map(word).collect::<Option<_>>()?;
        let distinct: HashSet<&str> = words.iter().map(|word| &**word).collect();
        (distinct.len() == words.len() && !words.is_empty()).then_some(words)
    }

    /// A value from outside of the run as the choice draws it: a word becomes its number, and any other value stays.
    ///
    /// # Errors
    /// A string for a choice without words; a string that is none of its words, which makes the run invalid, as another run may
    /// have other options.
    pub fn own_value<'v>(&self, value: &'v Value<S>) -> Result<Cow<'v, Value<S>>, Fault> {
        let Value::Str(name) = value else { return Ok(Cow::Borrowed(value)) };
        let words = self.words().ok_or_else(|| self.no_words(value))?;
        match words.iter().position(|word| word == name) {
            Some(number) => Ok(Cow::Owned(Value::Int(number as i64))),
            None => Err(self.no_option(name, &words)),
        }
    }

    #[cold]
    fn no_words(&self, value: &Value<S>) -> Fault {
        let path = self.path();
        Fault::type_mismatch(format!("the choice `{path}` does not draw words, found {}", value.described()))
            .with_help("give it a value of the kind that it draws; an option that is no word is given by its place, from 0")
    }

    #[cold]
    fn no_option(&self, name: &Text, words: &[Text]) -> Fault {
        let quoted = |word: &Text| repr(&Value::<f64>::Str(word.clone())).unwrap_or_default();
        let mut listed: Vec<String> = words.iter().take(LISTED).map(quoted).collect();
        if words.len() > LISTED {
            listed.push(format!("and {} more", words.len() - LISTED));
        }
        let mut help = format!("its options are {}", listed.join(", "));
        let nearest = words.iter().map(|word| (edits(name, word), word)).min_by_key(|(far, _)| *far);
        if let Some((far, word)) = nearest
            && 2 * far <= name.chars_len().max(2)
        {
            help = format!("did you mean {}? {help}", quoted(word));
        }
        let options = Value::list(words.iter().map(|word| Value::<S>::Str(word.clone())).collect());
        let path = self.path();
        let message = format!("{} is not an option of the choice `{path}`", quoted(name));
        Fault::new("unknown-option", message).about(path).with_help(help).of_call("choose", &[options])
    }
}

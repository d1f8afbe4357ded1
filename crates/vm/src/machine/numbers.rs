//! Numbers of held choices.

/// A set of numbers of held choices, as bits.
#[derive(Debug, Default)]
pub(crate) struct Numbers(Vec<u64>);

impl Clone for Numbers {
    fn clone(&self) -> Self {
        Numbers(self.0.clone())
    }

    fn clone_from(&mut self, source: &Self) {
        self.0.clone_from(&source.0);
    }
}

impl Numbers {
    /// All numbers below `count`.
    pub fn below(count: usize) -> Numbers {
        (0..count as u32).collect()
    }

    /// Whether a number is in the set.
    pub fn contains(&self, number: u32) -> bool {
        self.0.get(number as usize / 64).is_some_and(|word| word >> (number % 64) & 1 != 0)
    }

    /// Removes a number.
    pub fn remove(&mut self, number: u32) {
        if let Some(word) = self.0.get_mut(number as usize / 64) {
            *word &= !(1 << (number % 64));
        }
    }

    /// The least number in the set.
    pub fn first(&self) -> Option<u32> {
        let (at, word) = self.0.iter().enumerate().find(|(_, word)| **word != 0)?;
        Some(at as u32 * 64 + word.trailing_zeros())
    }
}

impl FromIterator<u32> for Numbers {
    fn from_iter<I: IntoIterator<Item = u32>>(numbers: I) -> Numbers {
        let mut set = Numbers::default();
        for number in numbers {
            let at = number as usize / 64;
            if at >= set.0.len() {
                set.0.resize(at + 1, 0);
            }
            set.0[at] |= 1 << (number % 64);
        }
        set
    }
}

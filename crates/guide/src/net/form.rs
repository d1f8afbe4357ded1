//! Inputs, sizes and heads of a network, and where each of its weights stands.

use crate::heads::Head;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Rows of weights are padded with zeros to a multiple of this, so that the compiler vectorises sums over them.
pub(crate) const LANES: usize = 8;

/// What a network reads and answers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NetForm {
    /// How many numbers windows have.
    pub windows: usize,
    /// How many features there are, over all sites.
    pub features: usize,
    /// Sizes of the two hidden layers.
    pub hidden: [usize; 2],
    /// The head of each site; a site is its place here.
    pub heads: Vec<Head>,
}

impl NetForm {
    /// The form with hidden layers of the usual sizes, 38 and 32.
    pub fn new(windows: usize, features: usize, heads: Vec<Head>) -> NetForm {
        NetForm { windows, features, hidden: [38, 32], heads }
    }
}

/// Where the weights stand in one list. A row holds the weights that leave one input, padded to [`LANES`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Layout {
    /// Padded sizes of the hidden layers.
    pub(crate) width: [usize; 2],
    /// Rows of the windows, features and sites, then the constants of the first layer.
    pub(crate) windows: usize,
    pub(crate) features: usize,
    pub(crate) sites: usize,
    pub(crate) first: usize,
    /// Rows of the second layer, then its constants.
    pub(crate) second: usize,
    pub(crate) second_constants: usize,
    /// Of each site: where its rows begin, where its constants do, and the padded number of outputs.
    pub(crate) heads: Vec<(usize, usize, usize)>,
    /// How many there are.
    pub(crate) len: usize,
}

/// The next multiple of [`LANES`].
fn padded(n: usize) -> usize {
    n.next_multiple_of(LANES)
}

impl Layout {
    pub(crate) fn new(form: &NetForm) -> Layout {
        let width = form.hidden.map(padded);
        let mut len = 0;
        let mut take = |n: usize| {
            len += n;
            len - n
        };
        let windows = take(form.windows * width[0]);
        let features = take(form.features * width[0]);
        let sites = take(form.heads.len() * width[0]);
        let first = take(width[0]);
        let second = take(form.hidden[0] * width[1]);
        let second_constants = take(width[1]);
        let heads = form
            .heads
            .iter()
            .map(|head| {
                let outputs = padded(head.outputs());
                (take(form.hidden[1] * outputs), take(outputs), outputs)
            })
            .collect();
        Layout { width, windows, features, sites, first, second, second_constants, heads, len }
    }

    /// The row of an input, in a block of rows of this width.
    pub(crate) fn row(block: usize, k: usize, width: usize) -> Range<usize> {
        block + k * width..block + (k + 1) * width
    }
}

//! Inputs, sizes and heads of a network, and the places of its weights.

use crate::heads::Head;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Rows of weights are padded with zeros to a multiple of this, so that the compiler vectorises sums over them.
pub(crate) const LANES: usize = 8;

/// The inputs and outputs of a network.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NetForm {
    /// The length of windows.
    pub windows: usize,
    /// The number of features, over all sites.
    pub features: usize,
    /// Sizes of the two hidden layers.
    pub hidden: [usize; 2],
    /// The head of each site; a site's number is its index here.
    pub heads: Vec<Head>,
}

impl NetForm {
    /// The form with hidden layers of the usual sizes, 38 and 32.
    pub fn new(windows: usize, features: usize, heads: Vec<Head>) -> NetForm {
        NetForm { windows, features, hidden: [38, 32], heads }
    }
}

/// The places of weights in one list. A row holds the weights that leave one input, padded to [`LANES`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Layout {
    /// Padded sizes of the hidden layers.
    pub(crate) width: [usize; 2],
    /// Start of the rows of windows, features and sites, then of the first layer's constants.
    pub(crate) windows: usize,
    pub(crate) features: usize,
    pub(crate) sites: usize,
    pub(crate) first: usize,
    /// Start of the second layer's rows, then of its constants.
    pub(crate) second: usize,
    pub(crate) second_constants: usize,
    /// For each site, the start of its rows, the start of its constants, and the padded number of outputs.
    pub(crate) heads: Vec<(usize, usize, usize)>,
    /// The number of weights.
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

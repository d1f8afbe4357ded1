//! Inputs and outputs of a network, and the places of its weights.

use super::levels::{CELLS, FILTERS, LEVELS};
use crate::heads::{Head, natural};
use crate::net::LANES;
use serde::{Deserialize, Serialize};

/// Fewest hidden units.
const LEAST: usize = 10;

/// The inputs and outputs of a network.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FilteredForm {
    /// Whether the network sees the target.
    pub target: bool,
    /// Whether the network sees the scene.
    pub scene: bool,
    /// The number of features, over all sites.
    pub features: usize,
    /// The features that each site sees, by number.
    pub sees: Vec<Vec<u32>>,
    /// The head of each site.
    pub heads: Vec<Head>,
}

/// The starts of a site's weights. A row holds the weights that leave one input, padded to [`LANES`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Site {
    pub(super) inputs: usize,
    pub(super) hidden: usize,
    pub(super) outputs: usize,
    /// Padded numbers of hidden units and outputs.
    pub(super) width: [usize; 2],
    pub(super) first: usize,
    pub(super) first_constants: usize,
    pub(super) second: usize,
    pub(super) constants: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layout {
    pub(super) sites: Vec<Site>,
    pub(super) len: usize,
}

impl FilteredForm {
    /// The number of images that the network sees.
    pub(super) fn images(&self) -> usize {
        usize::from(self.target) + usize::from(self.scene)
    }

    /// The length of the windows.
    pub(super) fn window(&self) -> usize {
        self.images() * LEVELS * CELLS
    }

    /// The places of the weights: first the filters of each image.
    pub(super) fn layout(&self) -> Layout {
        let mut len = self.images() * FILTERS;
        let mut take = |n: usize| {
            len += n;
            len - n
        };
        let site = |(sees, head): (&Vec<u32>, &Head)| {
            let inputs = self.window() + sees.len();
            let hidden = if inputs == 0 { 0 } else { LEAST.max(inputs / 2) };
            let outputs = natural::outputs(head);
            let width = [hidden, outputs].map(|n| n.next_multiple_of(LANES));
            Site {
                inputs,
                hidden,
                outputs,
                width,
                first: take(inputs * width[0]),
                first_constants: take(width[0]),
                second: take(hidden * width[1]),
                constants: take(width[1]),
            }
        };
        let sites = self.sees.iter().zip(&self.heads).map(site).collect();
        Layout { sites, len }
    }
}

impl Site {
    /// The number of weights, without padding.
    pub(super) fn size(&self) -> usize {
        (self.inputs + 1) * self.hidden + (self.hidden + 1) * self.outputs
    }
}

//! The network of the dissertation (6.4.1): filtered images around the place, and a small net for each choice.
//!
//! ```text
//! target --filters--> 4 levels --3x3 window at the place--+
//! scene  --filters--> 4 levels --3x3 window at the place--+--> tanh, half as many --> outputs of the choice
//! features, in their range ------------------------------+
//! ```
//!
//! Filters are 3 by 3 and linear, with a constant; all choices share them. The first level is the filtered image itself;
//! each further level filters the one before at half its size. The value of cells outside a level is learnt as well.
//! White is +1, touched pixels are -1. Windows stand along the axes of the page. Sizes equal those of the dissertation's code:
//! 76 inputs and 38 hidden units with both images and four features, 40 and 20 with one image, 4 and 10 without images.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `levels` | an image after its filters, windows on it, and derivatives |
//! | `form` | inputs of a network, and the places of its weights |
//! | `pass` | a network's way from inputs to outputs |
//! | `slope` | the loss of a trace, and its derivatives by all weights |
//! | `train` | Adam on whole traces |
//! | `file` | its bytes |

mod file;
mod form;
mod levels;
mod pass;
mod slope;
mod train;

pub use file::{read_filtered, write_filtered};
pub use form::FilteredForm;
pub use levels::Levels;
pub use pass::{Filtered, View};
pub use slope::{Choice, Trace, trace_loss, trace_loss_and_slope};
pub use train::{FilteredTraining, TrainedFiltered, train_filtered, train_filtered_along};

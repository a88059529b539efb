//! Figures of merit: pure functions from visibilities, masks and samples to numbers. Sums run in `f64` and in the order
//! of the pixels, so two runs agree to the last digit.

mod error;
mod motion;
mod spread;
mod umbra;

pub use error::ErrorFigures;
pub use motion::MotionExcess;
pub use spread::{Ratio, Timing};
pub use umbra::UmbraArea;

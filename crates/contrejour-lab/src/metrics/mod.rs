//! Figures of merit: pure functions from visibilities, masks and samples to numbers. Sums run in `f64` and in the order
//! of the pixels, so two runs agree to the last digit.
//!
//! A visibility is 0 where a receiver sees nothing of the light and 1 where it sees all of it. A mask says which pixels
//! count; the values of the others are not looked at.

mod error;
mod fit;
mod flip;
mod front;
mod input;
mod motion;
mod penumbra;
mod quantile;
mod spread;
mod umbra;

pub use error::{ErrorFigures, error_figures};
pub use fit::{PowerLaw, power_law};
pub use flip::{FLIP_PIXELS_PER_DEGREE, mean_flip};
pub use front::pareto_front;
pub use input::MetricError;
pub use motion::{MotionExcess, motion_excess};
pub use penumbra::penumbra_mask;
pub use spread::{Ratio, Timing};
pub use umbra::{NOT_UMBRA_FROM, UMBRA_UP_TO, UmbraArea, umbra_area};

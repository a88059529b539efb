//! Light views: the cameras that a light looks through.

mod cascade_slices;
mod cascades;
mod caster_light;
mod caster_place;
mod cube_face;
mod cube_views;
mod eye;
mod frame_views;
mod frustum;
mod guard;
mod light_outline;
mod object_light;
mod power_of_two;
mod records;
mod snapped_view;
mod view;

pub use cascade_slices::split_depths;
pub use cascades::{Cascade, CascadeError, CascadeShare, Cascades, cascade_views};
pub use caster_light::{NearOne, caster_light};
pub use caster_place::caster_place;
pub use cube_face::CubeFace;
pub use eye::{Eye, EyeError};
pub use frame_views::{FrameViews, frame_views};
pub use frustum::ObjectBox;
pub use guard::{MAX_GUARD_NDC, guard_ndc};
pub use light_outline::LightOutline;
pub use object_light::{ObjectLight, object_light};
pub use records::ViewCounts;
pub use view::{CastersInFront, Projection, View, views, views_with_guard};

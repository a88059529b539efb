//! The views of a cascaded light.

use contrejour_layout::ReceiverView;
use glam::DVec4;

use super::cascade_slices::{Sphere, split_depths};
use super::eye::EyeError;
use super::guard::guard_of_size;
use super::snapped_view::SnappedMap;
use super::view::View;
use super::{Eye, LightOutline};
use crate::light::not_negative;
use crate::{Light, LightError, LightKind, SettingsError, ShadowSettings};

/// Maps with fewer texels have none left to move by.
const MIN_MAP_SIZE: u32 = 4;

/// The maps of a cascaded light, from the eye outwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Cascades {
    /// One for each slice of the eye's view, the nearest first.
    pub cascades: Vec<Cascade>,
    /// A point's depth in the eye's view is the dot product with the point and 1. World units.
    pub eye_depth_from_world: DVec4,
}

/// A map and the slice of the eye's view that is looked up in it.
///
/// A receiver belongs to the first cascade whose `end_depth` is not less than the receiver's depth in the eye's view;
/// see [`Cascades::at`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cascade {
    /// What the light sees of the slice and of its border with the slice before.
    pub view: View,
    /// Where the slice begins: depth in the eye's view, world units.
    pub begin_depth: f64,
    /// Where the cascade begins to fade into the next one, or the last one into light: depth in the eye's view.
    pub blend_depth: f64,
    /// Where the slice ends: depth in the eye's view.
    pub end_depth: f64,
}

/// Which cascades a receiver is looked up in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CascadeShare {
    /// Index of its cascade.
    pub cascade: usize,
    /// Share of the next cascade in its visibility, or of full light where there is no next one. Range: 0 to 1; 0 means
    /// that one look-up is enough.
    pub next_share: f64,
}

/// Why a light has no cascades.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CascadeError {
    /// A field of the light is out of its range.
    #[error(transparent)]
    Light(#[from] LightError),
    /// A shadow setting is out of its range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A field of the eye is out of its range.
    #[error(transparent)]
    Eye(#[from] EyeError),
    /// The light is of another kind.
    #[error("the light is not cascaded: give a light of the kind Cascaded, or ask views for its views")]
    NotCascaded,
    /// The maps are too small to be moved by whole texels.
    #[error("the map size is {map_size}: give cascades at least 4 texels, 1024 is common")]
    MapSize {
        /// Texels along a side.
        map_size: u32,
    },
}

/// The views of a cascaded light on what an eye sees, from the eye outwards.
///
/// Each view is a square around the smallest sphere that holds a slice, so it has the same size wherever the eye looks;
/// and it moves by whole texels, so shadows of what stands still do not flicker when the eye moves or turns. Around the
/// sphere is a guard band as wide as soft edges and filters need, half of the map's half side at most.
///
/// The view's depth is 0 where the square's cube begins. Casters nearer to the light have negative depth; see
/// [`CastersInFront::Pancaked`](crate::CastersInFront::Pancaked). Matrices hold 32 bits in the end: far from the
/// origin, bring the world near the eye first.
///
/// ```
/// use contrejour_plan::{CascadeSettings, Eye, Light, LightKind, ShadowSettings, cascade_views};
/// use glam::DVec3;
///
/// let kind = LightKind::Cascaded {
///     towards_light: DVec3::new(1.0, 2.0, 0.5),
///     angular_radius: 0.00465,
///     cascades: CascadeSettings { count: 4, ..Default::default() },
/// };
/// let sun = Light { kind, color: [1.0; 3] };
/// let eye = Eye { position: DVec3::Y, forward: DVec3::NEG_Z, fov_y: 0.8, aspect: 1.6, near: 0.1, far: 80.0 };
/// let cascades = cascade_views(&sun, &eye, &ShadowSettings::default())?;
/// assert_eq!(cascades.cascades.len(), 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// The light is not cascaded, a field of the light, the eye or the settings is out of its range, or the map has fewer
/// than 4 texels along a side.
pub fn cascade_views(light: &Light, eye: &Eye, settings: &ShadowSettings) -> Result<Cascades, CascadeError> {
    light.validate()?;
    eye.validate()?;
    settings.validate()?;
    let LightKind::Cascaded { towards_light, angular_radius, cascades } = light.kind else {
        return Err(CascadeError::NotCascaded);
    };
    let map_size = settings.map_size;
    if map_size < MIN_MAP_SIZE {
        return Err(CascadeError::MapSize { map_size });
    }
    let caster_margin = cascades.caster_margin * eye.far;
    let depths = split_depths(eye.near, eye.far, cascades.count, cascades.logarithmic_share);
    // What is looked up here too, from the slice before.
    let mut seen_from = eye.near;
    let cascades = depths.windows(2).map(|pair| {
        let (begin_depth, end_depth) = (pair[0], pair[1]);
        let blend_depth = end_depth - cascades.border_share * (end_depth - begin_depth);
        let sphere = Sphere::around_slice(eye, [seen_from, end_depth]);
        // A penumbra from the front of the margin to the end of the cube, whose half side is the sphere's radius or
        // more.
        let penumbra_ndc = angular_radius.tan() * (2.0 + caster_margin / sphere.radius);
        let guard_ndc = guard_of_size(penumbra_ndc, LightOutline::Disk, settings);
        let map = SnappedMap { towards_light, angular_radius, map_size, guard_ndc, caster_margin };
        seen_from = blend_depth;
        let view = map.view(&sphere);
        not_negative("angular radius' tangent over half a cascade's side", view.light_size)?;
        Ok(Cascade { view, begin_depth, blend_depth, end_depth })
    });
    let cascades = cascades.collect::<Result<_, LightError>>()?;
    let axis = eye.axis_world();
    Ok(Cascades { cascades, eye_depth_from_world: axis.extend(-axis.dot(eye.position)) })
}

impl Cascades {
    /// Where a receiver is looked up, by its depth in the eye's view. None beyond the last cascade: there all is lit.
    pub fn at(&self, eye_depth: f64) -> Option<CascadeShare> {
        let cascade = self.cascades.iter().position(|cascade| eye_depth <= cascade.end_depth)?;
        let Cascade { blend_depth, end_depth, .. } = self.cascades[cascade];
        let next_share =
            if eye_depth > blend_depth { (eye_depth - blend_depth) / (end_depth - blend_depth) } else { 0.0 };
        Some(CascadeShare { cascade, next_share })
    }

    /// The views, from the eye outwards.
    pub fn views(&self) -> Vec<View> {
        self.cascades.iter().map(|cascade| cascade.view).collect()
    }

    /// What the visibility function needs of each.
    pub fn receiver_views(&self, settings: &ShadowSettings) -> Vec<ReceiverView> {
        let record = |cascade: &Cascade| ReceiverView {
            eye_depth_from_world: self.eye_depth_from_world.as_vec4().to_array(),
            blend_depth: cascade.blend_depth as f32,
            end_depth: cascade.end_depth as f32,
            ..cascade.view.receiver_view(settings)
        };
        self.cascades.iter().map(record).collect()
    }
}

#[cfg(test)]
mod tests;

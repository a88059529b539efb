//! The views of any light in a frame.

use contrejour_layout::ReceiverView;

use super::{CascadeError, Cascades, Eye, View, cascade_views, guard_ndc, views_with_guard};
use crate::{Light, LightError, LightKind, ShadowSettings};

/// What a light looks through in a frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameViews {
    /// Its views, in the order of its maps' layers.
    pub views: Vec<View>,
    /// How they are told apart where they are cascades.
    pub cascades: Option<Cascades>,
}

/// What a light looks through in a frame: [`views_with_guard`] with the guard that the settings ask for, or for a cascaded
/// light the [`cascade_views`] for the eye. Other lights need no eye.
///
/// # Errors
///
/// The light, or what a cascaded one needs of settings and eye, is out of its range; or a cascaded light has no eye.
pub fn frame_views(light: &Light, eye: Option<&Eye>, settings: &ShadowSettings) -> Result<FrameViews, CascadeError> {
    let LightKind::Cascaded { .. } = light.kind else {
        return Ok(FrameViews { views: views_with_guard(light, guard_ndc(light, settings))?, cascades: None });
    };
    let cascades = cascade_views(light, eye.ok_or(LightError::NeedsEye)?, settings)?;
    Ok(FrameViews { views: cascades.views(), cascades: Some(cascades) })
}

impl FrameViews {
    /// What the visibility function needs of each.
    pub fn receiver_views(&self, settings: &ShadowSettings) -> Vec<ReceiverView> {
        match &self.cascades {
            Some(cascades) => cascades.receiver_views(settings),
            None => self.views.iter().map(|view| view.receiver_view(settings)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CascadeSettings;
    use glam::DVec3;

    #[test]
    fn cascades_need_an_eye_and_others_do_not() {
        let settings = ShadowSettings::default();
        let eye = Eye { position: DVec3::Y, forward: DVec3::X, fov_y: 1.0, aspect: 1.5, near: 0.1, far: 30.0 };
        let cascades = CascadeSettings { count: 3, ..CascadeSettings::DEFAULT };
        let kind = LightKind::Cascaded { towards_light: DVec3::ONE, angular_radius: 0.01, cascades };
        let sun = Light { kind, color: [1.0; 3] };
        assert_eq!(frame_views(&sun, None, &settings), Err(CascadeError::Light(LightError::NeedsEye)));
        let seen = frame_views(&sun, Some(&eye), &settings).expect("a good sun and eye");
        assert_eq!((seen.views.len(), seen.receiver_views(&settings).len()), (3, 3));
        assert!(seen.receiver_views(&settings)[2].end_depth == 30.0);

        let kind = LightKind::Point { position: DVec3::ZERO, radius: 0.1, near: 0.1, far: 9.0 };
        let seen = frame_views(&Light { kind, color: [1.0; 3] }, None, &settings).expect("a good lamp");
        assert_eq!((seen.views.len(), seen.cascades), (6, None));
    }
}

//! What receivers ask of the shadows: a function, a texture of visibility, or the maps themselves.

use contrejour_layout::EyeView;
use contrejour_plan::{TextureKind, ViewChoice, VisibilityKind};

use crate::device_watch::OpenScopes;
use crate::error::DeviceError;
use crate::inputs::Maps;
use crate::lights::LightHandle;
use crate::shadows::Shadows;
use crate::timer::PassTimer;
use crate::visibility::{EyeInput, Visibility};
use crate::visibility_wgsl::visibility_wgsl;

impl Shadows {
    /// Records the full-screen visibility of a deferred renderer's pixels into `eye.target`, as one light is seen from
    /// them.
    ///
    /// # Errors
    ///
    /// The device fails, or does not draw into the options' `visibility_format`; then nothing was recorded.
    ///
    /// # Panics
    ///
    /// As [`visibility_kind`](Self::visibility_kind).
    pub fn encode_visibility<T: PassTimer>(
        &mut self,
        (device, queue): (&wgpu::Device, &wgpu::Queue),
        encoder: &mut wgpu::CommandEncoder,
        light: LightHandle,
        eye: &EyeInput<'_>,
        timer: &mut T,
    ) -> Result<(), DeviceError> {
        let state = self.lights.get_mut(light.0);
        let format = state.as_ref().map(|state| state.options.visibility_format);
        let visibility = state.and_then(|state| state.visibility.as_mut());
        let Some((visibility, format)) = visibility.zip(format) else { panic!("{NOT_PREPARED}") };
        let scopes = OpenScopes::push(device);
        let (pass, shadow) = visibility.pass(device, format);
        let eye_group = pass.bind_eye(device, queue, eye);
        if let Err(error) = self.watch.close(device, scopes, EYE_BYTES) {
            visibility.drop_pass();
            return Err(error);
        }
        pass.encode(encoder, eye, [&eye_group, shadow], timer);
        Ok(())
    }

    /// Which maps the visibility function of a light reads. A later [`prepare`](Self::prepare) changes it only where
    /// smoothies come or go: the light gains or loses its size, the first caster comes or the last one goes.
    ///
    /// # Panics
    ///
    /// Before the first [`prepare`](Self::prepare) with the light, where its options want no maps, and without such a
    /// light.
    pub fn visibility_kind(&self, light: LightHandle) -> VisibilityKind {
        self.visibility(light).kind
    }

    /// How the visibility function finds the view that shows a receiver. It shapes the function's text too.
    ///
    /// # Panics
    ///
    /// As [`visibility_kind`](Self::visibility_kind).
    pub fn view_choice(&self, light: LightHandle) -> ViewChoice {
        self.visibility(light).choice
    }

    /// WGSL text with the function `contrejour_visibility(position_world: vec3f, normal_world: vec3f) -> f32` and its
    /// bindings in the given bind group; append it to a shader. All its names start with `contrejour`, but for the
    /// struct `ReceiverView`. Normals have unit length and
    /// are those of the side that is seen: a side averted from the light is dark. 0 is dark, 1 is lit; points outside the
    /// light's maps are lit.
    ///
    /// # Panics
    ///
    /// As [`visibility_kind`](Self::visibility_kind).
    pub fn visibility_wgsl(&self, light: LightHandle, group: u32) -> String {
        visibility_wgsl(self.visibility_kind(light), self.view_choice(light), group)
    }

    /// Layout of [`visibility_bind_group`](Self::visibility_bind_group).
    ///
    /// # Panics
    ///
    /// As [`visibility_kind`](Self::visibility_kind).
    pub fn visibility_layout(&self, light: LightHandle) -> &wgpu::BindGroupLayout {
        &self.visibility(light).layout
    }

    /// The bind group of a light's visibility function. A later [`prepare`](Self::prepare) may replace it.
    ///
    /// # Panics
    ///
    /// As [`visibility_kind`](Self::visibility_kind).
    pub fn visibility_bind_group(&self, light: LightHandle) -> &wgpu::BindGroup {
        &self.visibility(light).bind_group
    }

    fn visibility(&self, light: LightHandle) -> &Visibility {
        match self.lights.get(light.0).and_then(|state| state.visibility.as_ref()) {
            Some(visibility) => visibility,
            None => panic!("{NOT_PREPARED}"),
        }
    }

    /// The maps of a light, after the first [`prepare`](Self::prepare) with it.
    pub fn maps(&self, light: LightHandle) -> Maps<'_> {
        let find = |kind| self.lights.get(light.0)?.frame.textures.find(kind);
        Maps {
            shadow_depth: find(TextureKind::ShadowDepth),
            shadow_hardware_depth: find(TextureKind::ShadowHardwareDepth),
            moments: find(TextureKind::Moments),
            smoothie_depth: find(TextureKind::SmoothieDepth),
            smoothie_alpha: find(TextureKind::SmoothieAlpha),
            smoothie_buffer: find(TextureKind::SmoothieBuffer),
            silhouette_map: find(TextureKind::SilhouetteMap),
        }
    }
}

/// Bytes that the full-screen pass needs: the record of the eye.
const EYE_BYTES: u64 = size_of::<EyeView>() as u64;

const NOT_PREPARED: &str = "no maps yet: call `prepare` first, with a light that is there and whose options want maps";

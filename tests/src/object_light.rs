//! Lights that have given bits in the object space of their casters: what the exact facing test is asked about.

use contrejour_plan::{Light, LightKind, NearOne, caster_light, views};
use glam::{DMat4, DVec3, DVec4};

/// A homogeneous light in the object space of casters that may be mirrored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectLight {
    /// x, y, z and w; w is 1 for a point and 0 for a direction.
    pub light_object: [f32; 4],
    /// Whether the casters stand mirrored in the world.
    pub mirrored: bool,
}

impl ObjectLight {
    /// World space from the casters' object space: mirroring loses no bits.
    pub fn world_from_object(&self) -> DMat4 {
        DMat4::from_scale(DVec3::new(if self.mirrored { -1.0 } else { 1.0 }, 1.0, 1.0))
    }

    /// The light in the world.
    pub fn light(&self) -> Light {
        let light_world = self.world_from_object() * DVec4::from_array(self.light_object.map(f64::from));
        let position = light_world.truncate();
        let kind = if light_world.w == 1.0 {
            // Along x, so that there is a view even from the farthest point.
            let target = DVec3 { x: if position.x == 0.0 { 1.0 } else { 0.0 }, ..position };
            LightKind::Spot { position, target, cone_angle: 2.5, radius: 0.0, near: 1.0, far: 1e30 }
        } else {
            LightKind::Directional {
                towards_light: position,
                center: DVec3::ZERO,
                half_extent: 1.0,
                half_depth: 1.0,
                angular_radius: 0.0,
            }
        };
        Light { kind, color: [1.0; 3] }
    }

    /// Whether the library brings the light back to object space bit by bit; -0 counts as 0.
    ///
    /// # Errors
    ///
    /// What it makes of the light instead.
    pub fn check_bits(&self) -> Result<(), String> {
        let view = views(&self.light()).map_err(|error| error.to_string())?[0];
        let found = caster_light(&view, &self.world_from_object(), &NearOne::IDENTITY);
        let light_object = found.light_object.map(f32::from_bits);
        if light_object == self.light_object && (found.casts, found.mirrored) == (1, self.mirrored.into()) {
            return Ok(());
        }
        Err(format!("{self:?} becomes {light_object:?}, casts {}, mirrored {}", found.casts, found.mirrored))
    }
}

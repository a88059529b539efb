//! Cameras and lights as a file brings them.

use glam::{DMat4, DVec3};

/// Coordinates beyond this leave no digits for what is seen.
const FARTHEST: f64 = 1e15;

/// A camera in perspective that stands in a file's world.
#[derive(Clone, Debug, PartialEq)]
pub struct FileCamera {
    /// Name in the file, of its node before its own; may be empty.
    pub name: String,
    /// Its node, by the index in the file.
    pub node: usize,
    /// Where it is, world space.
    pub eye: DVec3,
    /// Where it looks; unit length.
    pub forward: DVec3,
    /// Which way is up; unit length, and not along `forward`.
    pub up: DVec3,
    /// Full vertical opening angle. Unit: radians. Range: more than 0 and less than pi.
    pub fov_y: f64,
    /// Nearest depth that it sees, world units. Range: more than 0.
    pub near: f64,
    /// Farthest depth that it sees, world units; `None` where it sees any. Range: more than `near`.
    pub far: Option<f64>,
}

/// A light that stands in a file's world.
#[derive(Clone, Debug, PartialEq)]
pub struct FileLight {
    /// Name in the file, of its node before its own; may be empty.
    pub name: String,
    /// Its node, by the index in the file.
    pub node: usize,
    /// Where it is and where it shines.
    pub kind: FileLightKind,
    /// Linear colour, by which the intensity is multiplied. Range: 0 and up.
    pub color: [f32; 3],
    /// Unit: candela; lux of a directional light. World units are metres. Range: 0 and up.
    pub intensity: f64,
    /// Distance at which its light ends, world units; `None` where it never does. Range: more than 0.
    pub range: Option<f64>,
}

/// Where a light of a file is and where it shines, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FileLightKind {
    /// From very far away.
    Directional {
        /// Where it shines; unit length.
        direction: DVec3,
    },
    /// In all directions.
    Point {
        /// Where it is.
        position: DVec3,
    },
    /// In a cone.
    Spot {
        /// Where it is.
        position: DVec3,
        /// The cone's axis, away from the light; unit length.
        direction: DVec3,
        /// Angle from the axis up to which it is equally bright. Unit: radians. Range: 0 to less than the outer one.
        inner_half_angle: f64,
        /// Angle from the axis at which its light ends. Unit: radians. Range: more than 0, up to pi / 2.
        outer_half_angle: f64,
    },
}

/// Why nothing can look or shine from a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OutlookError {
    /// An axis has no length, or two of them are one.
    #[error("no direction is left by the matrix of its node: give a scale that is not 0")]
    NoDirection,
    /// It is where coordinates have no digits left.
    #[error("it is farther out than 1e15: move it nearer")]
    TooFar,
}

/// What is seen from a node, which looks along its -z axis (glTF 2.0, 3.10).
#[derive(Clone, Copy, Debug)]
struct Outlook<'a> {
    world_from_node: &'a DMat4,
}

impl Outlook<'_> {
    fn position(self) -> Result<DVec3, OutlookError> {
        let position = self.world_from_node.w_axis.truncate();
        if position.abs().max_element() > FARTHEST { Err(OutlookError::TooFar) } else { Ok(position) }
    }

    fn forward(self) -> Result<DVec3, OutlookError> {
        unit(-self.world_from_node.z_axis.truncate())
    }

    fn up(self) -> Result<DVec3, OutlookError> {
        unit(self.world_from_node.y_axis.truncate())
    }
}

fn unit(axis: DVec3) -> Result<DVec3, OutlookError> {
    // Scaled first, since squares of extreme axes leave the range.
    (axis / axis.abs().max_element()).try_normalize().ok_or(OutlookError::NoDirection)
}

impl FileCamera {
    /// The camera where its node is in a pose.
    ///
    /// # Errors
    ///
    /// The node leaves it no direction, or is too far out.
    pub fn seen_from(&self, world_from_node: &DMat4) -> Result<Self, OutlookError> {
        let outlook = Outlook { world_from_node };
        let (eye, forward, up) = (outlook.position()?, outlook.forward()?, outlook.up()?);
        if up.cross(forward).length() < 1e-6 {
            return Err(OutlookError::NoDirection);
        }
        Ok(Self { eye, forward, up, ..self.clone() })
    }
}

impl FileLight {
    /// The light where its node is in a pose.
    ///
    /// # Errors
    ///
    /// The node leaves it no direction where it needs one, or is too far out.
    pub fn shining_from(&self, world_from_node: &DMat4) -> Result<Self, OutlookError> {
        let outlook = Outlook { world_from_node };
        let mut kind = self.kind;
        match &mut kind {
            FileLightKind::Directional { direction } => *direction = outlook.forward()?,
            FileLightKind::Point { position } => *position = outlook.position()?,
            FileLightKind::Spot { position, direction, .. } => {
                (*position, *direction) = (outlook.position()?, outlook.forward()?);
            }
        }
        Ok(Self { kind, ..self.clone() })
    }
}

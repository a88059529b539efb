//! Generated meshes: smooth ones with smooth normals, edged ones with flat normals.
//!
//! All but the plane are closed, and wound counter-clockwise as seen from outside.

mod ball;
mod cuboid;
mod cylinder;
mod elephant;
mod fence;
mod implicit;
mod plane;
mod polygonise;
mod surface;
mod tube;

use contrejour_mesh::TriangleMesh;

/// A mesh that contrejour generates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A square grid in the xz plane around the origin, facing up: `2 segments^2` triangles. Open.
    Plane {
        /// Side lengths along x and z. Default: 10 each.
        size: [f64; 2],
        /// Squares along each side. Range: 1 to 1448. Default: 1.
        segments: u32,
    },
    /// A box around the origin: 12 triangles.
    Box {
        /// Side lengths. Default: 1 each.
        size: [f64; 3],
    },
    /// A cylinder around the y axis, the origin in its middle: `4 segments` triangles.
    Cylinder {
        /// Radius. Default: 0.5.
        radius: f64,
        /// Height. Default: 1.
        height: f64,
        /// Sides. Range: 3 to 1 048 576. Default: 96.
        segments: u32,
    },
    /// A ball around the origin: `2 segments (rings - 1)` triangles with `rings = segments / 2` from pole to pole.
    Sphere {
        /// Radius. Default: 0.5.
        radius: f64,
        /// Sides around the y axis. Range: 4 to 2048. Default: 64.
        segments: u32,
    },
    /// A torus around the y axis: `2 segments sides` triangles.
    Torus {
        /// From the y axis to the middle of the tube. Default: 1.
        radius: f64,
        /// Radius of the tube. Default: 0.35.
        tube_radius: f64,
        /// Steps along the tube. Range: 3 to 65 536. Default: 128.
        segments: u32,
        /// Steps around the tube. Range: 3 to 65 536. Default: 48.
        sides: u32,
    },
    /// The trefoil: a tube that goes twice around the y axis and three times through it; `2 segments sides`
    /// triangles.
    Knot {
        /// From the y axis to the middle of the torus that the tube winds on. Default: 1.
        radius: f64,
        /// Radius of the tube. Default: 0.22.
        tube_radius: f64,
        /// Steps along the tube. Range: 3 to 65 536. Default: 320.
        segments: u32,
        /// Steps around the tube. Range: 3 to 65 536. Default: 40.
        sides: u32,
    },
    /// An upright slab in the xy plane around the origin, with `columns rows` square holes.
    Fence {
        /// Width, height and thickness. Default: 4, 2, 0.04.
        size: [f64; 3],
        /// Holes along x. Range: 1 to 512. Default: 32.
        columns: u32,
        /// Holes along y. Range: 1 to 512. Default: 16.
        rows: u32,
        /// Width of the bars between and around the holes. Default: 0.04.
        bar: f64,
    },
    /// An elephant that walks along x, its feet at y = 0: a smooth body that shadows itself.
    Elephant {
        /// Height at its back. Default: 2.
        height: f64,
        /// Grid cells along its length; triangles grow with its square. Range: 24 to 256. Default: 48.
        segments: u32,
    },
}

/// Why a shape cannot be generated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// A length that is no sensible number.
    #[error("`{name}` is {value}: give a number from {least:e} to {most:e}", least = Shape::LENGTHS[0], most = Shape::LENGTHS[1])]
    Length {
        /// Name of the parameter.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// A count out of its range.
    #[error("`{name}` is {value}: give a whole number from {least} to {most}")]
    Count {
        /// Name of the parameter.
        name: &'static str,
        /// What was given.
        value: u32,
        /// The lowest that is allowed.
        least: u32,
        /// The highest that is allowed.
        most: u32,
    },
    /// More triangles than one shape may have.
    #[error("`{name}` makes {triangles} triangles: give less, {most} is the most for one shape", most = Shape::MAX_TRIANGLES)]
    Triangles {
        /// Name of the parameter to lower.
        name: &'static str,
        /// How many there would be.
        triangles: u64,
    },
    /// A fence whose bars leave no room for holes.
    #[error("`bar` is {bar}, which leaves no holes: give less than {most}")]
    FenceWithoutHoles {
        /// What was given.
        bar: f64,
        /// From where on there are no holes.
        most: f64,
    },
}

impl ShapeError {
    /// Name of the parameter that is to be changed.
    pub fn parameter(&self) -> &'static str {
        match self {
            Self::Length { name, .. } | Self::Count { name, .. } | Self::Triangles { name, .. } => name,
            Self::FenceWithoutHoles { .. } => "bar",
        }
    }
}

impl Shape {
    /// The shortest and the longest length that a shape may have, world units.
    pub const LENGTHS: [f64; 2] = [1e-9, 1e9];

    /// The most triangles that one shape may have.
    pub const MAX_TRIANGLES: u64 = 1 << 22;

    /// Its kind, as scene files name it.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Plane { .. } => "plane",
            Self::Box { .. } => "box",
            Self::Cylinder { .. } => "cylinder",
            Self::Sphere { .. } => "sphere",
            Self::Torus { .. } => "torus",
            Self::Knot { .. } => "knot",
            Self::Fence { .. } => "fence",
            Self::Elephant { .. } => "elephant",
        }
    }

    /// The triangles of the shape.
    ///
    /// # Errors
    /// A parameter that is out of its range.
    pub fn generate(&self) -> Result<TriangleMesh, ShapeError> {
        self.check()?;
        let surface = match *self {
            Self::Plane { size, segments } => plane::plane(size, segments),
            Self::Box { size } => cuboid::cuboid(size),
            Self::Cylinder { radius, height, segments } => cylinder::cylinder(radius, height, segments),
            Self::Sphere { radius, segments } => ball::ball(radius, segments),
            Self::Torus { radius, tube_radius, segments, sides } => tube::torus(radius, tube_radius, segments, sides),
            Self::Knot { radius, tube_radius, segments, sides } => tube::knot(radius, tube_radius, segments, sides),
            Self::Fence { size, columns, rows, bar } => fence::fence(size, columns, rows, bar),
            Self::Elephant { height, segments } => elephant::elephant(height, segments),
        };
        Ok(surface.into_mesh(self.kind()))
    }

    fn check(&self) -> Result<(), ShapeError> {
        match *self {
            Self::Plane { size: [x, z], segments } => {
                lengths([("size", x), ("size", z)])?;
                count("segments", segments, 1, 1448)
            }
            Self::Box { size: [x, y, z] } => lengths([("size", x), ("size", y), ("size", z)]),
            Self::Cylinder { radius, height, segments } => {
                lengths([("radius", radius), ("height", height)])?;
                count("segments", segments, 3, 1 << 20)
            }
            Self::Sphere { radius, segments } => {
                lengths([("radius", radius)])?;
                count("segments", segments, 4, 2048)
            }
            Self::Torus { radius, tube_radius, segments, sides }
            | Self::Knot { radius, tube_radius, segments, sides } => {
                lengths([("radius", radius), ("tube_radius", tube_radius)])?;
                count("segments", segments, 3, 1 << 16)?;
                count("sides", sides, 3, 1 << 16)?;
                let triangles = 2 * u64::from(segments) * u64::from(sides);
                if triangles > Self::MAX_TRIANGLES {
                    return Err(ShapeError::Triangles { name: "segments", triangles });
                }
                Ok(())
            }
            Self::Fence { size: [x, y, z], columns, rows, bar } => {
                lengths([("size", x), ("size", y), ("size", z), ("bar", bar)])?;
                count("columns", columns, 1, 512)?;
                count("rows", rows, 1, 512)?;
                let most = (x / f64::from(columns + 1)).min(y / f64::from(rows + 1));
                if bar >= most {
                    return Err(ShapeError::FenceWithoutHoles { bar, most });
                }
                Ok(())
            }
            Self::Elephant { height, segments } => {
                lengths([("height", height)])?;
                count("segments", segments, 24, 256)
            }
        }
    }
}

fn lengths<const N: usize>(named: [(&'static str, f64); N]) -> Result<(), ShapeError> {
    for (name, value) in named {
        if !(Shape::LENGTHS[0]..=Shape::LENGTHS[1]).contains(&value) {
            return Err(ShapeError::Length { name, value });
        }
    }
    Ok(())
}

fn count(name: &'static str, value: u32, least: u32, most: u32) -> Result<(), ShapeError> {
    if (least..=most).contains(&value) { Ok(()) } else { Err(ShapeError::Count { name, value, least, most }) }
}

#[cfg(test)]
mod tests;

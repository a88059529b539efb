//! A made-up mesh under a made-up light.

use arbitrary::{Arbitrary, Result, Unstructured};
use contrejour_mesh::Motion;
use glam::DVec3;

use crate::hostile::{Point, number, point};

/// Any triangles before any light: shared, doubled and collinear vertices, faces that repeat, turn or share edges by
/// the dozen, and lights in the planes of faces.
#[derive(Clone, Debug)]
pub struct Caster {
    /// Source vertices.
    pub positions: Vec<[f32; 3]>,
    /// Faces by source vertex.
    pub triangles: Vec<[u32; 3]>,
    /// The homogeneous light in the mesh's space.
    pub light: [f32; 4],
    /// Whether the mesh stands mirrored in the world.
    pub mirrored: bool,
    /// Whether its vertices move.
    pub motion: Motion,
    /// How far apart welded vertices may be.
    pub weld_distance: Option<f32>,
    /// How the light looks at the mesh.
    pub lens: Lens,
}

/// Where a light looks, and what it sees.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// A point that it looks at, or around which it shines.
    pub target: DVec3,
    /// Full opening angle of a spot, radians.
    pub cone_angle: f64,
    /// Nearest depth of a spot.
    pub near: f64,
    /// Farthest depth of a spot, half the extents of a sun.
    pub far: f64,
    /// Radius of a spot, angular radius of a sun.
    pub radius: f64,
}

impl<'a> Arbitrary<'a> for Caster {
    fn arbitrary(bytes: &mut Unstructured<'a>) -> Result<Self> {
        let (mut positions, mut triangles) = match bytes.int_in_range(0..=3)? {
            0 => fan(bytes)?,
            1 => grid(bytes)?,
            _ => (Vec::new(), Vec::new()),
        };
        for _ in 0..bytes.int_in_range(0..=12)? {
            let next = point(bytes, &positions)?;
            positions.push(next);
        }
        if !positions.is_empty() {
            for _ in 0..bytes.int_in_range(0..=24)? {
                triangles.push(triangle(bytes, positions.len(), &triangles)?);
            }
        }
        let light = light(bytes, &positions, &triangles)?;
        Ok(Self {
            light,
            mirrored: bytes.arbitrary()?,
            motion: *bytes.choose(&[Motion::Rigid, Motion::Deforming])?,
            weld_distance: if bytes.ratio(1, 8)? { Some(number(bytes)?.abs()) } else { None },
            lens: lens(bytes, &positions)?,
            positions,
            triangles,
        })
    }
}

/// Faces around one vertex, at times more than corners are searched for.
fn fan(bytes: &mut Unstructured) -> Result<(Vec<Point>, Vec<[u32; 3]>)> {
    let count = bytes.int_in_range(1..=300_u32)?;
    let height = number(bytes)?;
    let rim = |nth: u32| {
        let (sin, cos) = (f64::from(nth) * std::f64::consts::TAU / f64::from(count)).sin_cos();
        [cos as f32, sin as f32, height]
    };
    let positions = std::iter::once([0.0; 3]).chain((0..count).map(rim)).collect();
    let faces = (0..count).map(|nth| [0, 1 + nth, 1 + (nth + 1) % count]).collect();
    Ok((positions, faces))
}

/// A square grid in a plane, with single points moved out of it.
fn grid(bytes: &mut Unstructured) -> Result<(Vec<Point>, Vec<[u32; 3]>)> {
    let side = bytes.int_in_range(1..=6_u32)?;
    let axis = bytes.choose_index(3)?;
    let mut positions: Vec<Point> = Vec::new();
    for nth in 0..(side + 1) * (side + 1) {
        let mut place = [0.0; 3];
        place[(axis + 1) % 3] = (nth % (side + 1)) as f32;
        place[(axis + 2) % 3] = (nth / (side + 1)) as f32;
        if bytes.ratio(1, 8)? {
            place[axis] = number(bytes)?;
        }
        positions.push(place);
    }
    let faces = (0..side * side).flat_map(|nth| {
        let corner = nth / side * (side + 1) + nth % side;
        let [a, b, c, d] = [corner, corner + 1, corner + side + 2, corner + side + 1];
        [[a, b, c], [a, c, d]]
    });
    Ok((positions, faces.collect()))
}

fn triangle(bytes: &mut Unstructured, vertices: usize, before: &[[u32; 3]]) -> Result<[u32; 3]> {
    let vertex = |bytes: &mut Unstructured| Ok(bytes.choose_index(vertices)? as u32);
    Ok(match (bytes.int_in_range(0..=3)?, before) {
        (0, [.., _]) => {
            // Again, turned over, or with one corner elsewhere: edges of many faces.
            let [a, b, c] = *bytes.choose(before)?;
            let d = vertex(bytes)?;
            *bytes.choose(&[[a, b, c], [b, a, c], [c, b, d], [a, b, d]])?
        }
        _ => [vertex(bytes)?, vertex(bytes)?, vertex(bytes)?],
    })
}

/// A point or a direction; often one in the plane of a face, or along an edge.
fn light(bytes: &mut Unstructured, positions: &[Point], triangles: &[[u32; 3]]) -> Result<[f32; 4]> {
    let is_point = bytes.arbitrary()?;
    let of_face = match triangles {
        [] => Vec::new(),
        _ => bytes.choose(triangles)?.map(|vertex| positions[vertex as usize]).to_vec(),
    };
    let nearby = if bytes.arbitrary()? { &of_face } else { positions };
    let [x, y, z] = point(bytes, nearby)?;
    let w = if is_point { 1.0 } else { 0.0 };
    if is_point || of_face.is_empty() || bytes.arbitrary()? {
        return Ok([x, y, z, w]);
    }
    // From a corner to a point in the face's plane: a direction in it, as far as rounding lets it.
    let along: [f32; 3] = std::array::from_fn(|axis| [x, y, z][axis] - of_face[0][axis]);
    let along = if along.iter().all(|number| number.is_finite()) { along } else { [x, y, z] };
    Ok([along[0], along[1], along[2], w])
}

fn lens(bytes: &mut Unstructured, positions: &[Point]) -> Result<Lens> {
    let near = 10.0_f64.powi(bytes.int_in_range(-6..=3)?);
    Ok(Lens {
        target: DVec3::from(point(bytes, positions)?.map(f64::from)),
        cone_angle: *bytes.choose(&[0.017, 0.5, 1.0, 2.0, 3.124])?,
        near,
        far: near * 10.0_f64.powi(bytes.int_in_range(1..=9)?),
        radius: *bytes.choose(&[0.0, 0.01, 1.0])?,
    })
}

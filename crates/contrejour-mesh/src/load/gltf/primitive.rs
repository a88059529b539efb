//! One primitive: its vertices at rest, and its triangles.

use gltf::mesh::Mode;
use gltf::{Primitive, Semantic};

use super::accessor::{Data, Integers};
use crate::LoadError;

/// Vertices of a primitive before they are rounded to 32 bits.
pub(super) struct Vertices {
    pub(super) positions: Vec<[f64; 3]>,
    /// As many as positions, or none.
    pub(super) normals: Vec<[f64; 3]>,
    /// Linear; as many as positions.
    pub(super) colors: Vec<[f32; 3]>,
    /// As many as positions.
    pub(super) alphas: Vec<f32>,
}

/// What a triangle primitive holds that is left out.
#[derive(Default)]
pub(super) struct LeftOut {
    /// Indices after the last whole triangle.
    pub(super) indices: usize,
}

/// Reads positions, normals, colours and alpha with morph targets at their default weights.
pub(super) fn read_vertices(
    primitive: &Primitive,
    weights: &[f32],
    data: &Data,
) -> Result<Option<Vertices>, LoadError> {
    let Some(accessor) = primitive.get(&Semantic::Positions) else {
        return Ok(None);
    };
    let mut positions = data.read::<3>(&accessor, Integers::AsDeclared)?;
    let count = positions.len();
    let mut normals = match primitive.get(&Semantic::Normals) {
        Some(accessor) => data.read_attribute::<3>(&accessor, Integers::AsDeclared, count)?,
        None => Vec::new(),
    };
    for (target, &weight) in primitive.morph_targets().zip(weights) {
        if weight == 0.0 {
            continue;
        }
        let weight = f64::from(weight);
        if let Some(accessor) = target.positions() {
            add_scaled(&mut positions, &data.read_attribute(&accessor, Integers::AsDeclared, count)?, weight);
        }
        if let Some(accessor) = target.normals() {
            add_scaled(&mut normals, &data.read_attribute(&accessor, Integers::AsDeclared, count)?, weight);
        }
    }
    let colors = read_colors(primitive, count, data)?;
    let alphas = colors.iter().map(|[_, _, _, alpha]| *alpha).collect();
    let colors = colors.into_iter().map(|[red, green, blue, _]| [red, green, blue]).collect();
    Ok(Some(Vertices { positions, normals, colors, alphas }))
}

fn add_scaled(base: &mut [[f64; 3]], differences: &[[f64; 3]], weight: f64) {
    for (base, difference) in base.iter_mut().zip(differences) {
        for axis in 0..3 {
            base[axis] += weight * difference[axis];
        }
    }
}

fn read_colors(primitive: &Primitive, count: usize, data: &Data) -> Result<Vec<[f32; 4]>, LoadError> {
    let factor =
        primitive.material().pbr_metallic_roughness().base_color_factor().map(|channel| channel.clamp(0.0, 1.0));
    let times_factor =
        |color: [f64; 4]| [0, 1, 2, 3].map(|channel| (factor[channel] * color[channel] as f32).clamp(0.0, 1.0));
    let Some(accessor) = primitive.get(&Semantic::Colors(0)) else {
        return Ok(vec![factor; count]);
    };
    let colors: Vec<[f32; 4]> = if accessor.dimensions().multiplicity() == 4 {
        let colors = data.read_attribute::<4>(&accessor, Integers::Normalized, count)?;
        colors.into_iter().map(times_factor).collect()
    } else {
        let colors = data.read_attribute::<3>(&accessor, Integers::Normalized, count)?;
        colors.iter().map(|&[red, green, blue]| times_factor([red, green, blue, 1.0])).collect()
    };
    // What is not a number stays so when it is clamped.
    if colors.as_flattened().iter().all(|channel| channel.is_finite()) {
        return Ok(colors);
    }
    let place = format!("accessor {}", accessor.index());
    Err(data.malformed(place, "has a colour that is no number; correct it"))
}

/// Whether a primitive is made of triangles.
pub(super) fn has_triangles(primitive: &Primitive) -> bool {
    matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)
}

/// Triangles by vertex of the primitive, which has `vertex_count`.
pub(super) fn read_triangles(
    primitive: &Primitive,
    vertex_count: usize,
    data: &Data,
    place: &str,
    left_out: &mut LeftOut,
) -> Result<Vec<[u32; 3]>, LoadError> {
    let indices: Vec<u32> = match primitive.indices() {
        Some(accessor) => {
            data.read::<1>(&accessor, Integers::AsDeclared)?.iter().map(|&[index]| index as u32).collect()
        }
        None => (0..vertex_count as u32).collect(),
    };
    if let Some(&index) = indices.iter().find(|&&index| index as usize >= vertex_count) {
        return Err(LoadError::IndexOutOfRange {
            path: data.path.into(),
            place: place.into(),
            what: "vertex",
            index: i64::from(index),
            count: vertex_count,
        });
    }
    Ok(match primitive.mode() {
        Mode::TriangleStrip => indices
            .windows(3)
            .enumerate()
            .map(|(nth, window)| match nth % 2 {
                0 => [window[0], window[1], window[2]],
                _ => [window[0], window[2], window[1]],
            })
            .collect(),
        Mode::TriangleFan => {
            indices.get(1..).unwrap_or_default().windows(2).map(|pair| [indices[0], pair[0], pair[1]]).collect()
        }
        _ => {
            let (triangles, rest) = indices.as_chunks::<3>();
            left_out.indices += rest.len();
            triangles.to_vec()
        }
    })
}

//! Skins at rest: where joints put the vertices before any animation.

use glam::{DMat3, DMat4, DVec3};
use gltf::{Primitive, Semantic};

use super::accessor::{Data, Integers};
use super::primitive::Vertices;
use crate::{LoadError, Skin};

/// For each joint of a skin: world space from the space in which the mesh was bound.
pub(super) fn joint_matrices(
    skin: &gltf::Skin,
    world_from_nodes: &[DMat4],
    data: &Data,
) -> Result<Vec<DMat4>, LoadError> {
    let Skin { joints, inverse_binds } = read_skin(skin, data)?;
    let pairs = joints.iter().zip(&inverse_binds);
    Ok(pairs.map(|(&joint, inverse_bind)| world_from_nodes[joint] * inverse_bind).collect())
}

/// The joints of a skin.
pub(super) fn read_skin(skin: &gltf::Skin, data: &Data) -> Result<Skin, LoadError> {
    let number_count = 16 * skin.joints().len() as u64;
    data.count_numbers(number_count, || format!("skin {}", skin.index()))?;
    let joints: Vec<usize> = skin.joints().map(|joint| joint.index()).collect();
    let Some(accessor) = skin.inverse_bind_matrices() else {
        let inverse_binds = vec![DMat4::IDENTITY; joints.len()];
        return Ok(Skin { joints, inverse_binds });
    };
    let inverse_binds = data.read::<16>(&accessor, Integers::AsDeclared)?;
    if inverse_binds.len() < joints.len() {
        let place = format!("skin {}", skin.index());
        return Err(data.malformed(place, "has fewer inverse bind matrices than joints; export the file again"));
    }
    let inverse_binds = inverse_binds[..joints.len()].iter().map(DMat4::from_cols_array).collect();
    Ok(Skin { joints, inverse_binds })
}

/// Four joints and weights for each vertex of a primitive.
pub(super) struct InfluenceSet {
    pub(super) joints: Vec<[f64; 4]>,
    pub(super) weights: Vec<[f64; 4]>,
}

/// The sets of influences of a primitive with so many vertices, read one after the other.
pub(super) fn influence_sets(
    primitive: &Primitive,
    count: usize,
    data: &Data,
) -> impl Iterator<Item = Result<InfluenceSet, LoadError>> {
    let accessors = |set| Some((primitive.get(&Semantic::Joints(set))?, primitive.get(&Semantic::Weights(set))?));
    (0..).map_while(accessors).map(move |(joints, weights)| {
        Ok(InfluenceSet {
            joints: data.read_attribute::<4>(&joints, Integers::AsDeclared, count)?,
            weights: data.read_attribute::<4>(&weights, Integers::Normalized, count)?,
        })
    })
}

/// Moves vertices by the weighted sum of their joints' matrices; one without any weight stays where it is.
///
/// The sum is divided by the sum of the weights, which quantisation leaves near 1.
pub(super) fn apply(
    vertices: &mut Vertices,
    primitive: &Primitive,
    joint_matrices: &[DMat4],
    data: &Data,
    place: &str,
) -> Result<(), LoadError> {
    let count = vertices.positions.len();
    let mut matrices = vec![DMat4::ZERO; count];
    let mut weight_sums = vec![0.0; count];
    for set in influence_sets(primitive, count, data) {
        let InfluenceSet { joints, weights } = set?;
        for vertex in 0..count {
            for (&joint, &weight) in joints[vertex].iter().zip(&weights[vertex]) {
                if weight == 0.0 {
                    continue;
                }
                let matrix = joint_matrices.get(joint as usize).ok_or_else(|| LoadError::IndexOutOfRange {
                    path: data.path.into(),
                    place: format!("{place}, vertex {vertex}"),
                    what: "joint",
                    index: joint as i64,
                    count: joint_matrices.len(),
                })?;
                matrices[vertex] += *matrix * weight;
                weight_sums[vertex] += weight;
            }
        }
    }
    for vertex in 0..count {
        if weight_sums[vertex] == 0.0 {
            continue;
        }
        let matrix = matrices[vertex] * (1.0 / weight_sums[vertex]);
        let position = DVec3::from(vertices.positions[vertex]);
        vertices.positions[vertex] = matrix.transform_point3(position).to_array();
        if let Some(normal) = vertices.normals.get_mut(vertex) {
            let linear = DMat3::from_mat4(matrix);
            // The transposed inverse up to a positive factor, which exists for flat matrices too.
            let of_normals = DMat3::from_cols(
                linear.y_axis.cross(linear.z_axis),
                linear.z_axis.cross(linear.x_axis),
                linear.x_axis.cross(linear.y_axis),
            );
            let turned = of_normals * DVec3::from(*normal) * linear.determinant().signum();
            *normal = turned.to_array();
        }
    }
    Ok(())
}

//! Deforming meshes: the project's own and those of files, and where a pose puts their vertices, within what floats lose.

use std::f64::consts::TAU;
use std::path::Path;
use std::sync::Arc;

use contrejour_mesh::{DeformingMesh, PartPose, TriangleMesh, load_animated};
use glam::{DMat4, DVec3};

/// A mesh and some of its poses.
#[derive(Clone, Debug)]
pub struct PosedMesh {
    /// File and mesh, for messages.
    pub name: String,
    /// Its triangles at rest.
    pub mesh: TriangleMesh,
    /// What moves its vertices.
    pub deforming: Arc<DeformingMesh>,
    /// Poses at several times.
    pub poses: Vec<PartPose>,
}

const SIDES: u32 = 12;
const RINGS: u32 = 9;

/// A tube with a seam along it, on three joints one above the other, which two morph targets widen and tilt. Its last ring
/// has no joint.
///
/// # Panics
///
/// When a vertex is refused.
pub fn tube() -> PosedMesh {
    let mut deforming = DeformingMesh::new(3, 2);
    let mut mesh = TriangleMesh { name: "tube".into(), ..TriangleMesh::default() };
    for ring in 0..RINGS {
        let height = f64::from(ring) / f64::from(RINGS - 1);
        for side in 0..=SIDES {
            // The last column repeats the first, as where textures begin and end.
            let angle = f64::from(side % SIDES) * TAU / f64::from(SIDES);
            let out = DVec3::new(angle.cos(), 0.0, angle.sin());
            let position = (0.25 * out + height * DVec3::Y).as_vec3().to_array();
            let (low, high) = (1.0 - height, height * height);
            let mut influences = vec![(0, low), (1, 2.0 * low * height), (2, high)];
            if side == SIDES {
                influences.reverse();
            }
            if ring + 1 == RINGS {
                influences.clear();
            }
            let widen = (0.2 * (1.0 - height) * out).as_vec3().to_array();
            let tilt = if ring % 3 == 0 { [0.0, 0.3 * widen[0], 0.0] } else { [0.0; 3] };
            deforming.push_vertex(position, &influences, &[(0, widen), (1, tilt)]).expect("its numbers are small");
            mesh.positions.push(position);
        }
    }
    let column_count = SIDES + 1;
    for corner in (0..RINGS - 1).flat_map(|ring| (0..SIDES).map(move |side| ring * column_count + side)) {
        let [a, b, c, d] = [corner, corner + 1, corner + column_count + 1, corner + column_count];
        mesh.triangles.extend([[a, c, b], [a, d, c]]);
    }
    let poses = [0.0, 0.4, 1.1, 2.5].map(tube_pose);
    PosedMesh { name: "tube".into(), mesh, deforming: Arc::new(deforming), poses: poses.into() }
}

fn tube_pose(time: f64) -> PartPose {
    let joint = |index: f64| {
        let hinge = DMat4::from_translation(DVec3::new(0.0, 0.5 * index, 0.0));
        let turn = DMat4::from_axis_angle(DVec3::new(1.0, 0.4, 0.2 * index).normalize(), 0.7 * time * (index + 1.0));
        let scale = DMat4::from_scale(DVec3::new(1.0, 1.0 + 0.1 * time, 1.0));
        hinge * turn * scale * hinge.inverse()
    };
    PartPose {
        world_from_object: DMat4::IDENTITY,
        joint_matrices: vec![joint(0.0), joint(1.0), joint(2.0)],
        morph_weights: vec![time.sin(), 0.5 - time],
    }
}

/// The deforming meshes of a file, with poses of its first animation at even times, the last beyond its end.
///
/// # Errors
///
/// Why the file does not load or has no pose.
pub fn of_file(path: &Path, pose_count: u32) -> Result<Vec<PosedMesh>, String> {
    let model = load_animated(path).map_err(|error| error.to_string())?;
    let rig = &model.rig;
    let animation = rig.animations.first().ok_or("the file has no animation")?;
    let mut posed: Vec<PosedMesh> = (rig.parts.iter().zip(&model.file.nodes))
        .filter_map(|(part, node)| {
            let mesh = model.file.meshes[node.mesh].clone();
            let name = format!("{}, {}", path.display(), mesh.name);
            Some(PosedMesh { name, mesh, deforming: Arc::clone(part.deforming.as_ref()?), poses: Vec::new() })
        })
        .collect();
    for step in 0..pose_count {
        let time = 1.1 * animation.duration * f64::from(step) / f64::from(pose_count - 1);
        let pose = rig.pose(Some(animation), time).map_err(|error| error.to_string())?;
        let deforming_parts = rig.parts.iter().filter(|part| part.deforming.is_some());
        for (posed, part) in posed.iter_mut().zip(deforming_parts) {
            posed.poses.push(rig.part_pose(part, &pose));
        }
    }
    Ok(posed)
}

/// How far apart two ways to work out a vertex by 32-bit floats may be: each operation loses a last bit at most, 2^-23 of its
/// result in either direction of rounding, whether it is fused with the next or not, and no result is larger than the sum
/// of all terms' magnitudes.
///
/// A term of a morph target goes through its weight's rounding, a product and a sum for each target; what a joint adds
/// goes through its matrix's rounding, a product, three sums, its weight's product and a sum for each joint. Sums of
/// numbers below the smallest normal one may be flushed to zero.
pub fn most_difference(mesh: &DeformingMesh, vertex: usize, pose: &PartPose) -> f64 {
    let vertex = &mesh.vertices()[vertex];
    let morphs = &mesh.morph_deltas()[vertex.first_morph_delta as usize..][..vertex.morph_delta_count as usize];
    let influences = &mesh.influences()[vertex.first_influence as usize..][..vertex.influence_count as usize];
    let mut size = DVec3::from(vertex.position.map(f64::from)).abs();
    for morph in morphs {
        size += (pose.morph_weights[morph.morph_id as usize] * DVec3::from(morph.delta.map(f64::from))).abs();
    }
    let mut largest = size.max_element();
    let mut operations = 2 * morphs.len();
    if !influences.is_empty() {
        operations += 6 + influences.len();
        largest = 0.0;
        for influence in influences {
            let matrix = &pose.joint_matrices[influence.joint as usize];
            let row_size = |row: usize| matrix.row(row).abs().dot(size.extend(1.0));
            let of_joint = row_size(0).max(row_size(1)).max(row_size(2));
            largest += f64::from(influence.weight.abs()) * of_joint;
        }
    }
    let last_bit = f64::from(f32::EPSILON);
    // On both ways.
    2.0 * operations as f64 * (last_bit * largest + f64::from(f32::MIN_POSITIVE))
}

/// Compares the positions of a caster with where they should be.
///
/// # Errors
///
/// The first vertex that is farther off than [`most_difference`] allows.
pub fn compare_positions(
    mesh: &DeformingMesh,
    pose: &PartPose,
    expected: &[DVec3],
    found: &[[f32; 3]],
) -> Result<(), String> {
    if expected.len() != found.len() {
        return Err(format!("{} positions expected, {} found", expected.len(), found.len()));
    }
    for (vertex, (expected, found)) in expected.iter().zip(found).enumerate() {
        let difference = (*expected - DVec3::from(found.map(f64::from))).abs();
        let most = most_difference(mesh, vertex, pose);
        // NaN is not within.
        if !(difference.x <= most && difference.y <= most && difference.z <= most) {
            return Err(format!("vertex {vertex}: expected {expected} within {most:e}, found {found:?}"));
        }
    }
    Ok(())
}

/// Vertices that move alike have equal bits.
///
/// # Errors
///
/// The first two that have not.
pub fn check_alike(mesh: &DeformingMesh, positions: &[[f32; 3]]) -> Result<(), String> {
    for (vertex, class) in bytemuck::pod_collect_to_vec::<u8, u32>(&mesh.weld_data()).into_iter().enumerate() {
        let [own, first] = [vertex, class as usize].map(|vertex| positions[vertex].map(f32::to_bits));
        if own != first {
            return Err(format!("vertices {class} and {vertex} move alike and are at {first:x?} and {own:x?}"));
        }
    }
    Ok(())
}

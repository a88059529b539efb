//! Bytes as a glTF file in motion: refused in one line, or a rig that poses its meshes or says why not.

use std::path::Path;

use contrejour_layout::RestVertex;
use contrejour_mesh::{AnimatedModel, PartPose, Rig, RigPart, TriangleMesh, load_animated_bytes};

use crate::mesh_file::assert_one_line;

/// Animations and parts of a file that are looked at, so that a file of many takes no longer than its loading.
const MOST: usize = 4;

/// Loads bytes as a glTF file with its rig and poses it at some times; returns the number of parts that deform, `None`
/// where the file is refused. No file is opened: each one beside it is this one again.
///
/// # Panics
///
/// When a refusal has more or less than one line, a pose is not finite, or a mesh that deforms does not fit its own lists.
pub fn check_rig(bytes: &[u8]) -> Option<usize> {
    match load_animated_bytes(bytes, Path::new("any.gltf"), &|_| Ok(bytes.to_vec())) {
        Ok(model) => Some(check_model(&model)),
        Err(error) => {
            assert_one_line(&error.to_string());
            None
        }
    }
}

fn check_model(AnimatedModel { file, rig }: &AnimatedModel) -> usize {
    assert_eq!(rig.parts.len(), file.nodes.len(), "each mesh that stands somewhere is a part");
    let meshes = file.nodes.iter().map(|node| &file.meshes[node.mesh]);
    let deforming: Vec<_> = rig.parts.iter().zip(meshes).filter(|(part, _)| part.deforming.is_some()).collect();
    for (part, mesh) in deforming.iter().take(MOST) {
        check_topology(part, mesh);
    }
    let animations = rig.animations.iter().take(MOST).map(Some).chain([None]);
    for animation in animations {
        let duration = animation.map_or(0.0, |animation| animation.duration);
        assert!(duration.is_finite() && duration >= 0.0, "an animation takes {duration} s");
        for time in [-1.0, 0.4 * duration, f64::MAX] {
            match rig.pose(animation, time) {
                Err(error) => assert_one_line(&error.to_string()),
                Ok(pose) => {
                    assert!(pose.world_from_nodes.iter().all(|matrix| matrix.is_finite()), "a node is nowhere");
                    deforming
                        .iter()
                        .take(MOST)
                        .for_each(|(part, _)| check_pose(part, &rig.part_pose(part, &pose), rig));
                }
            }
        }
    }
    deforming.len()
}

fn check_topology(part: &RigPart, mesh: &TriangleMesh) {
    let Some(deforming) = &part.deforming else { return };
    let is_finite = |vertex: &RestVertex| vertex.position.iter().all(|coordinate| coordinate.is_finite());
    assert!(deforming.vertices().iter().all(is_finite), "a rest position is not finite");
    assert!(mesh.positions.as_flattened().iter().all(|coordinate| coordinate.is_finite()), "a position is not finite");
    let topology = deforming
        .topology(&mesh.positions, &mesh.triangles)
        .unwrap_or_else(|error| panic!("a mesh that deforms: {error}"));
    assert_eq!(topology.faces.len(), mesh.triangles.len());
}

fn check_pose(part: &RigPart, pose: &PartPose, rig: &Rig) {
    let Some(deforming) = &part.deforming else { return };
    let joint_count = part.skin.map_or(0, |skin| rig.skins[skin].joints.len());
    let counts = [pose.joint_matrices.len(), pose.morph_weights.len()];
    assert_eq!(counts, [deforming.joint_count() as usize, deforming.morph_count() as usize]);
    assert_eq!(counts[0], joint_count);
    assert_eq!(deforming.posed(pose).len(), deforming.vertices().len());
}

//! Vertices before anything moves them, and the joints and morph targets that do.

use std::sync::Arc;

use gltf::{Node, Primitive};

use super::super::accessor::{Data, Integers};
use super::super::{nodes, primitive, skin};
use super::morph_count;
use crate::load::is_finite;
use crate::rig::{DeformingMesh, DeformingMeshError, Rig};
use crate::{LoadError, MeshFile, TriangleMesh};

/// Gives the parts of a rig that deform what they deform by, and puts their meshes where it puts them at rest.
pub(super) fn read_deforming(
    rig: &mut Rig,
    scene_nodes: &[Node],
    data: &Data,
    file: &mut MeshFile,
) -> Result<(), LoadError> {
    let no_numbers = |node: &Node| LoadError::NotFinite { path: data.path.into(), place: nodes::node_place(node) };
    let mesh_nodes = scene_nodes.iter().filter(|node| node.mesh().is_some());
    // A node outside of the scene may have a matrix beyond all numbers; then no mesh that follows it has a place either.
    let rest = rig.pose(None, 0.0);
    for (index, node) in mesh_nodes.enumerate() {
        let mesh = &mut file.meshes[file.nodes[index].mesh];
        let joint_count = rig.parts[index].skin.map_or(0, |skin| rig.skins[skin].joints.len());
        let deforming = read_mesh(node, joint_count, data, mesh)?;
        if rig.parts[index].skin.is_none() && deforming.morph_deltas().is_empty() {
            continue;
        }
        let rest = rest.as_ref().map_err(|_| no_numbers(node))?;
        let part_pose = rig.part_pose(&rig.parts[index], rest);
        mesh.positions = deforming.posed(&part_pose).iter().map(|position| position.as_vec3().to_array()).collect();
        if !mesh.positions.iter().copied().all(is_finite) {
            return Err(no_numbers(node));
        }
        rig.parts[index].deforming = Some(Arc::new(deforming));
    }
    Ok(())
}

fn read_mesh(node: &Node, joint_count: usize, data: &Data, loaded: &TriangleMesh) -> Result<DeformingMesh, LoadError> {
    let Some(mesh) = node.mesh() else { return Ok(DeformingMesh::default()) };
    let mut deforming = DeformingMesh::new(joint_count as u32, morph_count(&mesh) as u32);
    for primitive in mesh.primitives().filter(primitive::has_triangles) {
        let place = format!("{}, mesh {}, primitive {}", nodes::node_place(node), mesh.index(), primitive.index());
        read_primitive(&primitive, node.skin().is_some(), data, &place, &mut deforming)?;
    }
    // Where no normal came with a vertex, it may have been repeated.
    let own_numbers = &loaded.vertex_numbers[..deforming.vertices().len()];
    for number in &loaded.vertex_numbers[own_numbers.len()..] {
        let vertex = own_numbers.partition_point(|own| own < number);
        deforming.repeat_vertex(vertex as u32);
    }
    Ok(deforming)
}

fn read_primitive(
    primitive: &Primitive,
    is_skinned: bool,
    data: &Data,
    place: &str,
    deforming: &mut DeformingMesh,
) -> Result<(), LoadError> {
    let Some(vertices) = primitive::read_vertices(primitive, &[], data)? else { return Ok(()) };
    let count = vertices.positions.len();
    let sets = skin::influence_sets(primitive, count, data).take_while(|_| is_skinned);
    let sets = sets.collect::<Result<Vec<_>, _>>()?;
    let mut targets = Vec::new();
    for (target, morph_id) in primitive.morph_targets().zip(0..) {
        if let Some(accessor) = target.positions() {
            targets.push((morph_id, data.read_attribute::<3>(&accessor, Integers::AsDeclared, count)?));
        }
    }
    let to_f32 = |position: [f64; 3]| position.map(|coordinate| coordinate as f32);
    let (mut influences, mut morph_deltas) = (Vec::new(), Vec::new());
    for (vertex, &position) in vertices.positions.iter().enumerate() {
        influences.clear();
        for set in &sets {
            let pairs = set.joints[vertex].iter().zip(set.weights[vertex]);
            influences.extend(pairs.map(|(&joint, weight)| (joint as u32, weight)));
        }
        morph_deltas.clear();
        morph_deltas.extend(targets.iter().map(|(morph_id, deltas)| (*morph_id, to_f32(deltas[vertex]))));
        deforming.push_vertex(to_f32(position), &influences, &morph_deltas).map_err(|error| {
            let (path, place) = (data.path.into(), format!("{place}, vertex {vertex}"));
            match error {
                DeformingMeshError::NotFinite => LoadError::NotFinite { path, place },
                problem => LoadError::Malformed { path, place, problem: problem.to_string() },
            }
        })?;
    }
    Ok(())
}

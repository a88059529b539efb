//! What moves the meshes of a file: nodes, skins, morph targets, animations.

mod animations;
mod deforming;

use gltf::{Document, Node};

use super::accessor::Data;
use super::{nodes, skin};
use crate::rig::{Rig, RigNode, RigPart, Skin};
use crate::{LoadError, MeshFile};

/// The rig of a document whose meshes are in `file`. Meshes that deform then stand where the rig's own numbers put them at
/// rest, which may differ from before in the last bit.
///
/// What it reads counts like what the meshes brought.
pub(super) fn read_rig(document: &Document, data: &Data, file: &mut MeshFile) -> Result<Rig, LoadError> {
    let mut rig = Rig {
        nodes: document.nodes().map(|node| rig_node(&node)).collect(),
        skins: vec![Skin::default(); document.skins().len()],
        ..Rig::default()
    };
    for node in document.nodes() {
        node.children().for_each(|child| rig.nodes[child.index()].parent = Some(node.index()));
    }
    rig.parents_first = parents_first(document, &rig.nodes);

    let scene_nodes = nodes::scene_nodes(document, data.path)?;
    for node in scene_nodes.iter().filter(|node| node.mesh().is_some()) {
        let skin = node.skin();
        if let Some(skin) = skin.as_ref().filter(|skin| rig.skins[skin.index()].joints.is_empty()) {
            rig.skins[skin.index()] = skin::read_skin(skin, data)?;
        }
        rig.parts.push(RigPart { node: node.index(), skin: skin.map(|skin| skin.index()), deforming: None });
    }
    deforming::read_deforming(&mut rig, &scene_nodes, data, file)?;
    rig.animations = animations::read_animations(document, &rig.nodes, data)?;
    Ok(rig)
}

fn rig_node(node: &Node) -> RigNode {
    let mesh = node.mesh();
    let weights = node.weights().or(mesh.as_ref().and_then(gltf::Mesh::weights)).unwrap_or_default();
    let mut morph_weights: Vec<f64> = weights.iter().copied().map(f64::from).collect();
    morph_weights.resize(mesh.map_or(0, |mesh| morph_count(&mesh)), 0.0);
    RigNode { parent: None, transform: nodes::node_transform(node), morph_weights }
}

/// Morph targets of a mesh: as many as the primitive with most of them has.
fn morph_count(mesh: &gltf::Mesh) -> usize {
    mesh.primitives().map(|primitive| primitive.morph_targets().len()).max().unwrap_or(0)
}

/// That there is no ring of nodes has been checked.
fn parents_first(document: &Document, nodes: &[RigNode]) -> Vec<usize> {
    let mut stack: Vec<Node> = document.nodes().filter(|node| nodes[node.index()].parent.is_none()).collect();
    let mut order = Vec::with_capacity(nodes.len());
    while let Some(node) = stack.pop() {
        order.push(node.index());
        stack.extend(node.children());
    }
    order
}

//! The tree of nodes, walked without recursion.

use std::path::Path;

use glam::{DMat4, DVec3, Mat4};
use gltf::scene::Transform;
use gltf::{Document, Node};

use crate::rig::rotation as rotation_of;
use crate::{LoadError, NodeTransform};

/// World space from each node's space, at rest, by node index.
pub(super) fn world_from_nodes(document: &Document, path: &Path) -> Result<Vec<DMat4>, LoadError> {
    let reached_twice = |node: usize| LoadError::NodeReachedTwice { path: path.into(), node };
    let mut has_parent = vec![false; document.nodes().len()];
    for child in document.nodes().flat_map(|node| node.children()) {
        if std::mem::replace(&mut has_parent[child.index()], true) {
            return Err(reached_twice(child.index()));
        }
    }
    let mut world_from_node: Vec<Option<DMat4>> = vec![None; has_parent.len()];
    let roots = document.nodes().filter(|node| !has_parent[node.index()]);
    let mut stack: Vec<(Node, DMat4)> = roots.map(|root| (root, DMat4::IDENTITY)).collect();
    while let Some((node, world_from_parent)) = stack.pop() {
        let world = world_from_parent * node_transform(&node).matrix();
        if !world.is_finite() {
            return Err(LoadError::Malformed {
                path: path.into(),
                place: node_place(&node),
                problem: "its transform is not finite; correct its matrix or scale".into(),
            });
        }
        world_from_node[node.index()] = Some(world);
        stack.extend(node.children().map(|child| (child, world)));
    }
    // Each node has one parent at most, so what no root leads to is a ring.
    let all = world_from_node.iter().enumerate();
    all.map(|(node, world)| world.ok_or_else(|| reached_twice(node))).collect()
}

/// Nodes of the default scene in depth-first order; of all root nodes when the file has no scene.
pub(super) fn scene_nodes<'a>(document: &'a Document, path: &Path) -> Result<Vec<Node<'a>>, LoadError> {
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let mut stack: Vec<Node> = match scene {
        Some(scene) => scene.nodes().collect(),
        None => root_nodes(document),
    };
    stack.reverse();
    let mut is_reached = vec![false; document.nodes().len()];
    let mut in_order = Vec::new();
    while let Some(node) = stack.pop() {
        if std::mem::replace(&mut is_reached[node.index()], true) {
            return Err(LoadError::NodeReachedTwice { path: path.into(), node: node.index() });
        }
        let first_child = stack.len();
        stack.extend(node.children());
        stack[first_child..].reverse();
        in_order.push(node);
    }
    Ok(in_order)
}

fn root_nodes(document: &Document) -> Vec<Node<'_>> {
    let mut has_parent = vec![false; document.nodes().len()];
    for child in document.nodes().flat_map(|node| node.children()) {
        has_parent[child.index()] = true;
    }
    document.nodes().filter(|node| !has_parent[node.index()]).collect()
}

/// How a node stands in its parent, at rest.
pub(super) fn node_transform(node: &Node) -> NodeTransform {
    match node.transform() {
        Transform::Matrix { matrix } => NodeTransform::Matrix(Mat4::from_cols_array_2d(&matrix).as_dmat4()),
        Transform::Decomposed { translation, rotation, scale } => NodeTransform::Parts {
            translation: DVec3::from(translation.map(f64::from)),
            rotation: rotation_of(&rotation.map(f64::from)),
            scale: DVec3::from(scale.map(f64::from)),
        },
    }
}

/// A node for messages, with the start of its name.
pub(super) fn node_place(node: &Node) -> String {
    match node.name() {
        Some(name) => {
            let start: String = name.chars().take(60).collect();
            format!("node {} {start:?}", node.index())
        }
        None => format!("node {}", node.index()),
    }
}

//! Outline edges without a quad.

use std::collections::BTreeSet;

use contrejour_layout::{Quad, SilhouetteEdge};
use contrejour_plan::View;
use glam::{DVec3, DVec4, Vec3Swizzles, Vec4Swizzles};

use super::super::device::DeviceMesh;

/// Edges whose image is shorter than this share of what it could be may be taken for points.
const POINT_SHARE: f64 = 1e-5;

/// Ends that are nearer than this to a plane of the frustum, as a share of their distance from the light, may be cut off.
const MARGIN: f64 = 1e-3;

/// Outline edges that lie in view, are clearly no points of the image and yet have no quad: what looks for gaps around
/// quads can't see those.
pub(in super::super) fn missing_quads(
    view: &View,
    meshes: &[DeviceMesh],
    silhouettes: &[SilhouetteEdge],
    quads: &[Quad],
) -> u64 {
    let with_quad: BTreeSet<_> = quads.iter().map(|quad| (quad.caster, quad.edge_id)).collect();
    let is_missing = |edge: &&SilhouetteEdge| {
        (edge.left == 0 || edge.right == 0)
            && !with_quad.contains(&(edge.caster, edge.edge_id))
            && must_have_quad(view, &meshes[edge.caster as usize], edge.edge_id)
    };
    silhouettes.iter().filter(is_missing).count() as u64
}

fn must_have_quad(view: &View, mesh: &DeviceMesh, edge_id: u32) -> bool {
    let matrix = view.light_clip_from_world * mesh.world_from_object;
    let edge = &mesh.topology.edges[edge_id as usize];
    let [low, high] = [edge.low_vertex, edge.high_vertex]
        .map(|vertex| DVec3::from(mesh.topology.positions[vertex as usize].map(f64::from)));
    let clip = matrix * low.extend(1.0);
    let delta = matrix * (high - low).extend(0.0);
    if !(is_in_view(clip) && is_in_view(clip + delta)) {
        return false;
    }
    let direction = delta.xy() * clip.w - clip.xy() * delta.w;
    let reach = matrix.x_axis.abs() + matrix.y_axis.abs() + matrix.z_axis.abs();
    let longest =
        (high - low).abs().max_element() * (reach.x.max(reach.y) * clip.w + clip.xy().abs().max_element() * reach.w);
    direction.abs().max_element() > POINT_SHARE * longest
}

fn is_in_view(clip: DVec4) -> bool {
    let share = clip.xyz() / clip.w;
    clip.w > 0.0 && share.xy().abs().max_element() < 1.0 - MARGIN && (MARGIN..1.0 - MARGIN).contains(&share.z)
}

#[cfg(test)]
mod tests {
    use contrejour_plan::ShadowSettings;
    use glam::DMat4;

    use super::*;
    use crate::mirror_frame::MirrorFrame;
    use crate::stability::lights;
    use crate::stability::meshes::{RING_RADIUS, ring};

    #[test]
    fn a_lost_quad_is_found() {
        let mesh = DeviceMesh::new(&ring(1.0, DVec3::ZERO)).expect("a good mesh");
        for (name, view) in lights::views_of_all_kinds(DVec3::ZERO, RING_RADIUS) {
            let settings = ShadowSettings::default();
            let mut made = MirrorFrame::of_view(&[(&*mesh.topology, DMat4::IDENTITY)], &view, &settings).run();
            let meshes = std::slice::from_ref(&mesh);
            assert_eq!(missing_quads(&view, meshes, &made.silhouettes, &made.quads), 0, "{name}");
            let must = |edge: &SilhouetteEdge| must_have_quad(&view, &meshes[0], edge.edge_id);
            let in_view = made.silhouettes.iter().filter(|edge| must(edge)).count() as u64;
            assert!(in_view > 5, "{name}: {in_view}");
            assert_eq!(missing_quads(&view, meshes, &made.silhouettes, &[]), in_view, "{name}");
            let lost = made.silhouettes.iter().find(|edge| must(edge)).expect("there is one").edge_id;
            made.quads.retain(|quad| quad.edge_id != lost);
            assert_eq!(missing_quads(&view, meshes, &made.silhouettes, &made.quads), 1, "{name}");
        }
    }
}

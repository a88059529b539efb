//! Silhouettes by an ordered map from edges to what their faces add up to, anew in every frame: no topology is kept, as
//! in programs that extrude silhouettes on the CPU.

use std::collections::BTreeMap;

use contrejour_layout::Face;
use glam::{DVec3, DVec4};

/// The silhouette edges from their lower to their higher vertex, with faces on the left less faces on the right.
pub(super) fn ordered_map_silhouette(
    positions: &[[f32; 3]],
    faces: &[Face],
    light_object: DVec4,
) -> BTreeMap<[u32; 2], i32> {
    let mut left_less_right = BTreeMap::new();
    for &Face { a, b, c } in faces {
        let sign = if is_lit([a, b, c].map(|vertex| positions[vertex as usize]), light_object) { 1 } else { -1 };
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let along = if from < to { sign } else { -sign };
            *left_less_right.entry([from.min(to), from.max(to)]).or_insert(0) += along;
        }
    }
    left_less_right.retain(|_, multiplicity| *multiplicity != 0);
    left_less_right
}

/// Whether the light sees the triangle counter-clockwise.
fn is_lit(corners: [[f32; 3]; 3], light: DVec4) -> bool {
    let [a, b, c] = corners.map(|corner| DVec3::from(corner.map(f64::from)));
    (b - a).cross(c - a).dot(light.truncate() - light.w * a) > 0.0
}

#[cfg(test)]
mod tests {
    use contrejour_plan::views;

    use super::super::lone_mesh::LoneMesh;
    use super::*;

    /// Silhouettes of a torus by the map and by the stages' twins; the map sees the given faces.
    fn both_ways(faces: impl FnOnce(&[Face]) -> Vec<Face>) -> [BTreeMap<[u32; 2], i32>; 2] {
        let torus = LoneMesh::torus(2000).expect("a torus");
        let light = torus.light;
        let view = views(&light).expect("a good light")[0];
        let map = ordered_map_silhouette(&torus.topology.positions, &faces(&torus.topology.faces), view.light_world);
        let twins = torus.mirror_frame(&light).expect("a frame").run().silhouettes;
        let twins = twins.iter().map(|silhouette| {
            let edge = torus.topology.edges[silhouette.edge_id as usize];
            ([edge.low_vertex, edge.high_vertex], silhouette.left as i32 - silhouette.right as i32)
        });
        [map, twins.collect()]
    }

    #[test]
    fn the_map_finds_what_the_twins_of_the_stages_find() {
        let [map, twins] = both_ways(<[Face]>::to_vec);
        assert!(map.len() > 50);
        assert_eq!(map, twins);
    }

    #[test]
    fn one_wrong_corner_is_told() {
        let [map, twins] = both_ways(|faces| {
            let mut faces = faces.to_vec();
            faces[7].c = faces[900].a;
            faces
        });
        assert_ne!(map, twins);
    }
}

//! The CPU twins of all compute stages on a made-up caster.

use contrejour_layout::{
    BLOCK_BY_PLANES, BLOCK_BY_POSITIONS, BLOCK_SIZE, Caster as CasterRecord, CasterLight, WorkItem,
};
use contrejour_mesh::TopologyAwareMesh;
use contrejour_mirror::{FrameInputs, FrameOutputs, run_frame};
use contrejour_plan::{Light, LightKind, NearOne, ShadowSettings, View, ViewCounts, caster_light, views};
use glam::{DMat4, DVec3};

use crate::Caster;

impl Caster {
    /// All stages, with room for all that the mesh can need.
    pub(crate) fn frame(&self, topology: &TopologyAwareMesh) -> FrameOutputs {
        let view = self.view();
        let near_one = NearOne::of_box(topology.bounds_min, topology.bounds_max);
        // The view's own light can be another one, where no view looks from this one.
        let light = CasterLight {
            light_object: self.light.map(f32::to_bits),
            mirrored: self.mirrored.into(),
            casts: 1,
            ..caster_light(&view, &self.world_from_object(), &near_one)
        };
        let record = CasterRecord {
            position_stride_words: 3,
            face_count: topology.faces.len() as u32,
            edge_count: topology.candidate_edge_count,
            first_vertex_edge_word: topology.vertex_edge_offsets.len() as u32,
            position_scale: near_one.scale,
            position_origin: near_one.origin,
            ..CasterRecord::default()
        };
        let blocks = |count: u32| 0..count.div_ceil(BLOCK_SIZE);
        let planes = topology.face_planes();
        let kind = |block| if planes.block_fits(block) { BLOCK_BY_PLANES } else { BLOCK_BY_POSITIONS };
        let face_item = |block| WorkItem { caster: 0, block, kind: kind(block) };
        let face_items: Vec<_> = blocks(record.face_count).map(face_item).collect();
        let edge_item = |block| WorkItem { caster: 0, block, kind: 0 };
        let edge_items: Vec<_> = blocks(record.edge_count).map(edge_item).collect();
        let counts = ViewCounts {
            casters: 1,
            face_blocks: face_items.len() as u32,
            edge_blocks: edge_items.len() as u32,
            undecided: record.face_count,
            silhouettes: record.edge_count,
            quads: record.edge_count,
            corners: 2 * record.edge_count,
        };
        let mut vertex_edges = topology.vertex_edge_offsets.clone();
        vertex_edges.extend(bytemuck::cast_slice::<_, u32>(&topology.vertex_edges));
        run_frame(&FrameInputs {
            view: &view.light_view(&ShadowSettings::default(), &counts),
            face_items: &face_items,
            edge_items: &edge_items,
            casters: &[record],
            caster_lights: &[light],
            positions: bytemuck::cast_slice(&topology.positions),
            faces: &topology.faces,
            planes: &planes.planes,
            edges: &topology.edges,
            incidences: &topology.incidences,
            vertex_edges: &vertex_edges,
        })
    }

    fn world_from_object(&self) -> DMat4 {
        DMat4::from_scale(DVec3::new(if self.mirrored { -1.0 } else { 1.0 }, 1.0, 1.0))
    }

    /// The light's view, or one from beside the mesh where the light has none.
    fn view(&self) -> View {
        let [x, y, z, w] = self.light;
        let light_world = self.world_from_object().transform_vector3(DVec3::new(x.into(), y.into(), z.into()));
        let target = self.world_from_object().transform_vector3(self.lens.target);
        let kind = if w == 1.0 {
            LightKind::Spot {
                position: light_world,
                target,
                cone_angle: self.lens.cone_angle,
                radius: self.lens.radius,
                near: self.lens.near,
                far: self.lens.far,
            }
        } else {
            LightKind::Directional {
                towards_light: light_world,
                center: target,
                half_extent: self.lens.far,
                half_depth: self.lens.far,
                angular_radius: self.lens.radius,
            }
        };
        let fallback = LightKind::Directional {
            towards_light: DVec3::Z,
            center: DVec3::ZERO,
            half_extent: 10.0,
            half_depth: 10.0,
            angular_radius: 0.0,
        };
        let view_of = |kind: LightKind| views(&Light { kind, color: [1.0; 3] });
        let views = view_of(kind).or_else(|_| view_of(fallback));
        views.unwrap_or_else(|error| panic!("{error}"))[0]
    }
}

//! A frame of one mesh for the CPU twins of the compute stages.

use contrejour_layout::{BLOCK_SIZE, Caster, CasterLight, LightView, WorkItem};
use contrejour_mesh::TopologyAwareMesh;
use contrejour_mirror::{FrameInputs, FrameOutputs, run_frame};
use contrejour_plan::{Light, ViewCounts, caster_light, position_scale, views};
use glam::DMat4;

use super::super::super::error::RunError;
use super::super::methods::THIN;
use super::LoneMesh;

/// Texels of the map that the geometry is made for: the width of smoothies has a floor in texels.
pub(super) const MAP_SIZE: u32 = 1024;

/// Records and lists of a frame that is run again and again.
pub(super) struct MirrorFrame<'a> {
    topology: &'a TopologyAwareMesh,
    view: LightView,
    caster: Caster,
    caster_light: CasterLight,
    face_items: Vec<WorkItem>,
    edge_items: Vec<WorkItem>,
    vertex_edges: Vec<u32>,
}

impl<'a> MirrorFrame<'a> {
    /// A frame with room for all that the mesh needs under this light, and no more.
    pub fn new(mesh: &'a LoneMesh, light: &Light) -> Result<Self, RunError> {
        let topology = &*mesh.topology;
        let view = views(light)?[0];
        let scale = position_scale(topology.bounds_min, topology.bounds_max);
        let caster = Caster {
            position_stride_words: 3,
            face_count: topology.faces.len() as u32,
            edge_count: topology.candidate_edge_count,
            first_vertex_edge_word: topology.vertex_edge_offsets.len() as u32,
            position_scale: scale,
            ..Caster::default()
        };
        let blocks = |count: u32| (0..count.div_ceil(BLOCK_SIZE)).map(|block| WorkItem { caster: 0, block }).collect();
        let [face_items, edge_items]: [Vec<WorkItem>; 2] = [caster.face_count, caster.edge_count].map(blocks);
        let counts = ViewCounts {
            face_items: face_items.len() as u32,
            edge_items: edge_items.len() as u32,
            undecided: caster.face_count,
            silhouettes: caster.edge_count,
            quads: caster.edge_count,
            corners: 2 * caster.edge_count,
        };
        let mut vertex_edges = topology.vertex_edge_offsets.clone();
        vertex_edges.extend(bytemuck::cast_slice::<_, u32>(&topology.vertex_edges));
        let mut frame = Self {
            topology,
            view: view.light_view(&THIN.settings(&mesh.scene.shadow, MAP_SIZE), &counts),
            caster,
            caster_light: caster_light(&view, &DMat4::IDENTITY, scale),
            face_items,
            edge_items,
            vertex_edges,
        };
        let counted = frame.run().counters;
        frame.view.quad_capacity = counted.quads;
        frame.view.corner_capacity = counted.corners;
        Ok(frame)
    }

    /// All stages, one after the other.
    pub fn run(&self) -> FrameOutputs {
        run_frame(&FrameInputs {
            view: &self.view,
            face_items: &self.face_items,
            edge_items: &self.edge_items,
            casters: &[self.caster],
            caster_lights: &[self.caster_light],
            positions: bytemuck::cast_slice(&self.topology.positions),
            faces: &self.topology.faces,
            edges: &self.topology.edges,
            incidences: &self.topology.incidences,
            vertex_edges: &self.vertex_edges,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_has_room_for_all_it_makes() {
        let torus = LoneMesh::torus(1000).expect("a torus");
        let frame = MirrorFrame::new(&torus, &torus.scene.light).expect("a frame");
        let made = frame.run();
        assert!(made.counters.quads > 30);
        assert_eq!(
            [made.quads.len(), made.corners.len()],
            [made.counters.quads, made.counters.corners].map(|n| n as usize)
        );
        // With less room, records would be missing.
        let mut narrow = frame;
        narrow.view.quad_capacity -= 1;
        assert_ne!(narrow.run().quads.len(), made.quads.len());
    }
}

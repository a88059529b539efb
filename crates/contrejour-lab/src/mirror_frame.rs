//! A frame for the CPU twins of the compute stages.

use std::borrow::Cow;

use bytemuck::cast_slice;
use contrejour_layout::{
    BLOCK_BY_PLANES, BLOCK_BY_POSITIONS, BLOCK_SIZE, Caster, CasterLight, Edge, Face, LIT_WORDS_PER_BLOCK, LightView,
    OUTLINE_WORDS_PER_BLOCK, WorkItem,
};
use contrejour_mesh::TopologyAwareMesh;
use contrejour_mirror::{FrameInputs, FrameOutputs, run_facing, run_frame};
use contrejour_plan::{Light, LightError, NearOne, ShadowSettings, View, ViewCounts, caster_light, views};
use glam::DMat4;

/// Quads and corners that a first run has room for: few meshes need more, and room for every edge of a large one would
/// be gigabytes.
const FIRST_ROOM: u32 = 1 << 16;

/// Records and lists of a frame that is run again and again.
pub(crate) struct MirrorFrame<'a> {
    /// Where the parts of each caster lie.
    pub casters: Vec<Caster>,
    /// The light as each caster sees it.
    pub caster_lights: Vec<CasterLight>,
    view: LightView,
    face_items: Vec<WorkItem>,
    edge_items: Vec<WorkItem>,
    positions: Cow<'a, [u32]>,
    faces: Cow<'a, [Face]>,
    planes: Vec<[f32; 4]>,
    edges: Cow<'a, [Edge]>,
    incidences: Cow<'a, [u32]>,
    vertex_edges: Vec<u32>,
}

impl<'a> MirrorFrame<'a> {
    /// A frame of meshes with their matrices, with room for all that they need under this light of one view, and no more.
    pub fn new(
        meshes: &[(&'a TopologyAwareMesh, DMat4)],
        light: &Light,
        settings: &ShadowSettings,
    ) -> Result<Self, LightError> {
        Ok(Self::of_view(meshes, &views(light)?[0], settings))
    }

    /// The same for one view of a light.
    pub fn of_view(meshes: &[(&'a TopologyAwareMesh, DMat4)], view: &View, settings: &ShadowSettings) -> Self {
        let mut frame = Self {
            casters: Vec::new(),
            caster_lights: Vec::new(),
            view: LightView::default(),
            face_items: Vec::new(),
            edge_items: Vec::new(),
            positions: Cow::default(),
            faces: Cow::default(),
            planes: Vec::new(),
            edges: Cow::default(),
            incidences: Cow::default(),
            vertex_edges: Vec::new(),
        };
        for ((mesh, world_from_object), index) in meshes.iter().zip(0..) {
            let planes = mesh.face_planes();
            frame.planes.extend(&planes.planes);
            let caster = frame.add(mesh);
            let light = caster_light(view, world_from_object, &near_one(mesh));
            if light.casts == 1 {
                frame.face_items.extend(items(index, caster.face_count).map(|item| {
                    let by_positions = !planes.block_fits(item.block);
                    WorkItem { kind: if by_positions { BLOCK_BY_POSITIONS } else { BLOCK_BY_PLANES }, ..item }
                }));
                frame.edge_items.extend(items(index, caster.edge_count));
            }
            frame.caster_lights.push(light);
            frame.casters.push(caster);
        }
        let [faces, edges] = [frame.faces.len(), frame.edges.len()].map(|count| count as u32);
        let counts = ViewCounts {
            casters: frame.casters.len() as u32,
            face_blocks: frame.face_items.len() as u32,
            edge_blocks: frame.edge_items.len() as u32,
            undecided: faces,
            silhouettes: edges,
            quads: edges.min(FIRST_ROOM),
            corners: edges.min(FIRST_ROOM),
        };
        frame.view = view.light_view(settings, &counts);
        // Only quads that fit count their corners.
        for _ in 0..2 {
            let counted = frame.run().counters;
            let had_room = counted.quads <= frame.view.quad_capacity;
            frame.view.quad_capacity = counted.quads;
            frame.view.corner_capacity = counted.corners;
            if had_room {
                break;
            }
        }
        frame
    }

    /// Puts a mesh behind the others.
    fn add(&mut self, mesh: &'a TopologyAwareMesh) -> Caster {
        let first_vertex_offset_word = self.vertex_edges.len() as u32;
        let last = self.casters.last();
        let caster = Caster {
            first_position_word: self.positions.len() as u32,
            position_stride_words: 3,
            first_face: self.faces.len() as u32,
            face_count: mesh.faces.len() as u32,
            first_edge: self.edges.len() as u32,
            edge_count: mesh.candidate_edge_count,
            first_incidence: self.incidences.len() as u32,
            first_vertex_offset_word,
            first_vertex_edge_word: first_vertex_offset_word + mesh.vertex_edge_offsets.len() as u32,
            first_lit_word: last.map_or(0, |last| last.first_lit_word + words(last.face_count, LIT_WORDS_PER_BLOCK)),
            first_outline_word: last
                .map_or(0, |last| last.first_outline_word + words(last.edge_count, OUTLINE_WORDS_PER_BLOCK)),
            position_scale: near_one(mesh).scale,
            position_origin: near_one(mesh).origin,
            mask: 0,
        };
        append(&mut self.positions, cast_slice(&mesh.positions));
        append(&mut self.faces, &mesh.faces);
        append(&mut self.edges, &mesh.edges);
        append(&mut self.incidences, &mesh.incidences);
        self.vertex_edges.extend(&mesh.vertex_edge_offsets);
        self.vertex_edges.extend(cast_slice::<_, u32>(&mesh.vertex_edges));
        caster
    }

    /// All stages, one after the other.
    pub fn run(&self) -> FrameOutputs {
        run_frame(&self.inputs())
    }

    /// The stages that find lit faces, alone: one bit a face.
    pub fn lit(&self) -> Vec<u32> {
        run_facing(&self.inputs())
    }

    fn inputs(&self) -> FrameInputs<'_> {
        FrameInputs {
            view: &self.view,
            face_items: &self.face_items,
            edge_items: &self.edge_items,
            casters: &self.casters,
            caster_lights: &self.caster_lights,
            positions: &self.positions,
            faces: &self.faces,
            planes: &self.planes,
            edges: &self.edges,
            incidences: &self.incidences,
            vertex_edges: &self.vertex_edges,
        }
    }
}

fn words(count: u32, words_per_block: u32) -> u32 {
    count.div_ceil(BLOCK_SIZE) * words_per_block
}

fn near_one(mesh: &TopologyAwareMesh) -> NearOne {
    NearOne::of_box(mesh.bounds_min, mesh.bounds_max)
}

fn items(caster: u32, count: u32) -> impl Iterator<Item = WorkItem> {
    (0..count.div_ceil(BLOCK_SIZE)).map(move |block| WorkItem { caster, block, kind: 0 })
}

/// Borrows what comes first, since most frames have one mesh.
fn append<'a, T: Clone>(pool: &mut Cow<'a, [T]>, part: &'a [T]) {
    if pool.is_empty() {
        *pool = Cow::Borrowed(part);
    } else {
        pool.to_mut().extend_from_slice(part);
    }
}

#[cfg(test)]
mod tests {
    use contrejour_mesh::BuildOptions;
    use contrejour_plan::LightKind;
    use glam::DVec3;

    use super::*;
    use crate::torus;

    fn ring() -> TopologyAwareMesh {
        let torus = torus(40, 12);
        TopologyAwareMesh::build(&torus.positions, &torus.triangles, &BuildOptions::default()).expect("a torus")
    }

    fn spot() -> Light {
        let position = DVec3::new(1.0, 4.0, 2.0);
        let kind = LightKind::Spot { position, target: DVec3::ZERO, cone_angle: 1.0, radius: 0.1, near: 1.0, far: 9.0 };
        Light { kind, color: [1.0; 3] }
    }

    #[test]
    fn a_frame_has_room_for_all_it_makes() {
        let ring = ring();
        let frame = MirrorFrame::new(&[(&ring, DMat4::IDENTITY)], &spot(), &ShadowSettings::default());
        let frame = frame.expect("a good light");
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

    #[test]
    fn each_of_several_meshes_is_found_as_alone() {
        let ring = ring();
        let places = [DMat4::IDENTITY, DMat4::from_translation(DVec3::new(0.5, 0.25, 0.0))];
        let frame_of = |places: &[DMat4]| {
            let meshes: Vec<_> = places.iter().map(|&place| (&ring, place)).collect();
            MirrorFrame::new(&meshes, &spot(), &ShadowSettings::default()).expect("a good light").run()
        };
        let [one, other] = places.map(|place| frame_of(&[place]));
        let both = frame_of(&places);
        assert_eq!(both.lit, [one.lit, other.lit].concat());
        assert_eq!(both.counters.quads, one.counters.quads + other.counters.quads);
        assert_eq!(both.counters.corners, one.counters.corners + other.counters.corners);
    }

    #[test]
    fn facing_alone_is_that_of_the_frame() {
        let ring = ring();
        let frame = MirrorFrame::new(&[(&ring, DMat4::IDENTITY)], &spot(), &ShadowSettings::default());
        let frame = frame.expect("a good light");
        assert_eq!(frame.lit(), frame.run().lit);
    }
}

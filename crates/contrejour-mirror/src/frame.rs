//! The stages of one light view on given work items, one after the other.

use contrejour_layout::{
    BLOCK_SIZE, Caster, CasterLight, Corner, Counters, DispatchArgs, DrawArgs, Edge, Face, FaceTest,
    LIT_WORDS_PER_BLOCK, LightView, OUTLINE_WORDS_PER_BLOCK, Quad, RecheckWord, SeatCounters, SilhouetteEdge, TestItem,
    ViewBundle, WorkItem,
};

use crate::{
    BuildCorners, ClassifyFaces, DetectSilhouette, ExtrudeEdges, RecheckFaces, RefineFaces, ResolveFaces,
    WriteDrawArgs, WriteExtrudeArgs, WriteRecheckArgs, WriteRefineArgs,
};

/// What the stages of one light view read: the pooled buffers of all casters.
#[derive(Clone, Copy, Debug)]
pub struct FrameInputs<'a> {
    /// The light view, with the room in all lists.
    pub view: &'a LightView,
    /// Blocks of faces.
    pub face_items: &'a [WorkItem],
    /// Blocks of edges.
    pub edge_items: &'a [WorkItem],
    /// Where the parts of each caster lie.
    pub casters: &'a [Caster],
    /// The light as each caster sees it.
    pub caster_lights: &'a [CasterLight],
    /// Pool of positions, as bits.
    pub positions: &'a [u32],
    /// Pool of faces.
    pub faces: &'a [Face],
    /// Pool of planes, by face; not read where work items ask for positions.
    pub planes: &'a [[f32; 4]],
    /// Pool of edges.
    pub edges: &'a [Edge],
    /// Pool of incidence words.
    pub incidences: &'a [u32],
    /// Pool of vertex offsets and vertex edges.
    pub vertex_edges: &'a [u32],
}

/// What the stages of one light view write. Lists end after their last record.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameOutputs {
    /// One bit a face.
    pub lit: Vec<u32>,
    /// Two bits an edge.
    pub outline_sides: Vec<u32>,
    /// The silhouette, block by block.
    pub silhouettes: Vec<SilhouetteEdge>,
    /// The quads.
    pub quads: Vec<Quad>,
    /// The corners.
    pub corners: Vec<Corner>,
    /// What was needed, also where a list had no room for it.
    pub counters: Counters,
    /// The dispatch of `recheck_faces`.
    pub recheck_args: [DispatchArgs; 1],
    /// The dispatches of `refine_faces` and `resolve_faces`.
    pub refine_args: [DispatchArgs; 2],
    /// The dispatches of `extrude_edges` and `build_corners`.
    pub extrude_args: [DispatchArgs; 2],
    /// The draws of quads and corners, behind that of the faces, which is left as it is.
    pub draw_args: [DrawArgs; 4],
}

/// Runs the stages of one light view in order, from `classify_faces` on: work items and the light as each caster sees it
/// are given.
///
/// # Panics
///
/// When a record names a part of a buffer that does not exist.
pub fn run_frame(inputs: &FrameInputs) -> FrameOutputs {
    let mut outputs = FrameOutputs::with_room(inputs);
    outputs.find_lit_faces(inputs);
    outputs.find_outline(inputs);
    outputs.build_smoothies(inputs);
    outputs
}

/// Runs the stages that find lit faces, alone: one bit a face.
///
/// # Panics
///
/// As [`run_frame`].
pub fn run_facing(inputs: &FrameInputs) -> Vec<u32> {
    let (lit, counters) = (lit_words(inputs), listed(inputs));
    let mut outputs = FrameOutputs { lit, counters, ..FrameOutputs::default() };
    outputs.find_lit_faces(inputs);
    outputs.lit
}

/// What `list_blocks` counts.
fn listed(inputs: &FrameInputs) -> Counters {
    let (face_items, edge_items) = (inputs.face_items.len() as u32, inputs.edge_items.len() as u32);
    Counters { face_items, edge_items, ..Counters::default() }
}

/// What it lists to be tested for the view, which has the only seat.
fn tests(items: &[WorkItem]) -> Vec<TestItem> {
    items.iter().map(|&WorkItem { caster, block, kind }| TestItem { caster, block, kind, seats: 1 }).collect()
}

fn lit_words(inputs: &FrameInputs) -> Vec<u32> {
    let end = |caster: &Caster| caster.first_lit_word + caster.face_count.div_ceil(BLOCK_SIZE) * LIT_WORDS_PER_BLOCK;
    vec![0; inputs.casters.iter().map(end).max().unwrap_or(0) as usize]
}

fn outline_words(inputs: &FrameInputs) -> Vec<u32> {
    let end =
        |caster: &Caster| caster.first_outline_word + caster.edge_count.div_ceil(BLOCK_SIZE) * OUTLINE_WORDS_PER_BLOCK;
    vec![0; inputs.casters.iter().map(end).max().unwrap_or(0) as usize]
}

impl FrameOutputs {
    fn with_room(inputs: &FrameInputs) -> Self {
        Self {
            lit: lit_words(inputs),
            outline_sides: outline_words(inputs),
            silhouettes: vec![SilhouetteEdge::default(); inputs.view.silhouette_capacity as usize],
            quads: vec![Quad::default(); inputs.view.quad_capacity as usize],
            corners: vec![Corner::default(); inputs.view.corner_capacity as usize],
            counters: listed(inputs),
            ..Self::default()
        }
    }

    fn find_lit_faces(&mut self, inputs: &FrameInputs) {
        let &FrameInputs { view, casters, caster_lights, faces, positions, .. } = inputs;
        let bundle = &ViewBundle::of_one(view);
        let face_tests = &tests(inputs.face_items);
        let mut counters =
            [SeatCounters { counts: self.counters, face_tests: face_tests.len() as u32, ..SeatCounters::default() }];
        let words = inputs.face_items.len() * LIT_WORDS_PER_BLOCK as usize;
        let mut recheck_words = vec![RecheckWord::default(); words];
        let mut undecided = vec![FaceTest::default(); view.undecided_capacity as usize];
        ClassifyFaces {
            bundle,
            face_tests,
            casters,
            caster_lights,
            planes: inputs.planes,
            lit: &mut self.lit,
            recheck_words: &mut recheck_words,
            counters: &mut counters,
        }
        .run();
        WriteRecheckArgs { bundle, counters: &counters, recheck_args: &mut self.recheck_args }.run();
        RecheckFaces {
            bundle,
            recheck_words: &recheck_words,
            casters,
            caster_lights,
            faces,
            positions,
            lit: &mut self.lit,
            undecided: &mut undecided,
            counters: &mut counters,
        }
        .run();
        self.counters = counters[0].counts;
        let (undecided, counters, lit) = (&undecided, &counters, &mut self.lit);
        WriteRefineArgs { bundle, counters, refine_args: &mut self.refine_args }.run();
        RefineFaces { bundle, undecided, counters, casters, caster_lights, faces, positions, lit }.run();
        let lit = &mut self.lit;
        ResolveFaces { bundle, undecided, counters, casters, caster_lights, faces, positions, lit }.run();
    }

    fn find_outline(&mut self, inputs: &FrameInputs) {
        let edge_tests = &tests(inputs.edge_items);
        let mut counters =
            [SeatCounters { counts: self.counters, edge_tests: edge_tests.len() as u32, ..SeatCounters::default() }];
        DetectSilhouette {
            bundle: &ViewBundle::of_one(inputs.view),
            edge_tests,
            casters: inputs.casters,
            edges: inputs.edges,
            incidences: inputs.incidences,
            lit: &self.lit,
            silhouettes: &mut self.silhouettes,
            outline_sides: &mut self.outline_sides,
            counters: &mut counters,
        }
        .run();
        self.counters = counters[0].counts;
        self.silhouettes.truncate(self.counters.silhouette_edges as usize);
        WriteExtrudeArgs { view: inputs.view, counters: &self.counters, extrude_args: &mut self.extrude_args }.run();
    }

    fn build_smoothies(&mut self, inputs: &FrameInputs) {
        let &FrameInputs { view, casters, caster_lights, positions, .. } = inputs;
        ExtrudeEdges {
            view,
            silhouettes: &self.silhouettes,
            casters,
            caster_lights,
            edges: inputs.edges,
            positions,
            quads: &mut self.quads,
            counters: &mut self.counters,
        }
        .run();
        self.quads.truncate(self.counters.quads as usize);
        BuildCorners {
            view,
            quads: &self.quads,
            casters,
            caster_lights,
            positions,
            outline_sides: &self.outline_sides,
            vertex_edges: inputs.vertex_edges,
            corners: &mut self.corners,
            counters: &mut self.counters,
        }
        .run();
        self.corners.truncate(self.counters.corners as usize);
        WriteDrawArgs { view, counters: &self.counters, draw_args: &mut self.draw_args }.run();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_scene::{TestLight, TestScene};

    #[test]
    fn tetrahedron_goes_all_the_way() {
        let positions = [[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]];
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        let frame = TestScene::new(&positions, &faces, TestLight::Directional).frame();
        assert_eq!(frame.lit, [0b1110, 0]);
        assert_eq!((frame.silhouettes.len(), frame.quads.len(), frame.corners.len()), (3, 3, 3));
        assert_eq!(frame.extrude_args, [DispatchArgs { x: 1, y: 1, z: 1 }; 2]);
        assert_eq!(frame.draw_args.map(|draw| draw.vertex_count), [0, 18, 36, 0]);
    }

    #[test]
    fn nothing_at_all_is_no_work() {
        let inputs = FrameInputs {
            view: &LightView::default(),
            face_items: &[],
            edge_items: &[],
            casters: &[],
            caster_lights: &[],
            positions: &[],
            faces: &[],
            planes: &[],
            edges: &[],
            incidences: &[],
            vertex_edges: &[],
        };
        let frame = run_frame(&inputs);
        assert_eq!(frame.counters, Counters::default());
        assert_eq!(frame.recheck_args, [DispatchArgs { x: 0, y: 0, z: 1 }]);
        assert_eq!(frame.refine_args, [DispatchArgs { x: 0, y: 0, z: 1 }; 2]);
        assert_eq!(frame.draw_args.map(|draw| draw.vertex_count), [0; 4]);
    }
}

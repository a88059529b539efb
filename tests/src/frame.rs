//! All buffers of one frame on the CPU, pooled without the library's own pooling, and stages that run on them.

use bytemuck::{bytes_of, cast_slice, cast_slice_mut};
use contrejour_layout::{
    BLOCK_BY_PLANES, BLOCK_BY_POSITIONS, BLOCK_SIZE, BundleShape, Caster, CasterLight, CasterPlace, Corner, Counters,
    DispatchArgs, DrawArgs, Edge, Face, FaceTest, LIT_WORDS_PER_BLOCK, LightView, NO_CASTER, OUTLINE_WORDS_PER_BLOCK,
    Quad, RecheckWord, SeatCounters, SilhouetteEdge, TestItem, VIEW_CULLS, ViewBundle, WorkItem,
};
use contrejour_mesh::{FacePlanes, TopologyAwareMesh};
use contrejour_plan::{Light, NearOne, ShadowSettings, View, ViewCounts, caster_place, views};

use crate::meshes::TestPart;
use crate::random::Random;

/// Words that lie between the parts of a pool and mean nothing: a stage that reads them goes wrong.
pub const GAP: [u32; 7] = [0xdead_beef; 7];

/// From one seat's draws to the next one's.
pub const DRAW_STRIDE: usize = 256 / size_of::<DrawArgs>();

/// Every buffer that the stages bind, named as the stages name them.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "the fields are the bindings, and the stages' files say what they hold")]
pub struct Frame {
    pub bundle: ViewBundle,
    /// The seat that the stages of one view work on.
    pub seat: usize,
    pub caster_places: Vec<CasterPlace>,
    pub face_blocks: Vec<WorkItem>,
    pub edge_blocks: Vec<WorkItem>,
    pub face_items: Vec<WorkItem>,
    pub face_tests: Vec<TestItem>,
    pub edge_tests: Vec<TestItem>,
    pub item_args: Vec<DispatchArgs>,
    pub casters: Vec<Caster>,
    pub caster_lights: Vec<CasterLight>,
    pub faces: Vec<Face>,
    pub planes: Vec<[f32; 4]>,
    pub positions: Vec<u32>,
    pub edges: Vec<Edge>,
    pub incidences: Vec<u32>,
    pub vertex_edges: Vec<u32>,
    pub lit: Vec<u32>,
    pub recheck_words: Vec<RecheckWord>,
    pub recheck_args: Vec<DispatchArgs>,
    pub undecided: Vec<FaceTest>,
    pub counters: Vec<SeatCounters>,
    pub refine_args: Vec<DispatchArgs>,
    pub silhouettes: Vec<SilhouetteEdge>,
    pub outline_sides: Vec<u32>,
    pub extrude_args: Vec<DispatchArgs>,
    pub quads: Vec<Quad>,
    pub corners: Vec<Corner>,
    pub draw_args: Vec<DrawArgs>,
}

impl Frame {
    /// The parts as casters of the light's first view, with room for all that they can need, before the first stage.
    ///
    /// # Panics
    ///
    /// When the light is refused.
    pub fn new(parts: &[TestPart], light: &Light, settings: &ShadowSettings) -> Self {
        Self::of_view(parts, &views(light).expect("the lights of the tests are good")[0], settings)
    }

    /// The same of any view of a light.
    pub fn of_view(parts: &[TestPart], view: &View, settings: &ShadowSettings) -> Self {
        Self::of_bundle(parts, &[*view], settings)
    }

    /// The same of views that are tested together, with gaps between what seats have where there are several.
    pub fn of_bundle(parts: &[TestPart], views: &[View], settings: &ShadowSettings) -> Self {
        let mut frame = Self::empty();
        let seats = views.len().next_power_of_two();
        let gap = if seats > 1 { GAP.len() } else { 0 };
        let (mut lit_words, mut outline_words) = (0, 0);
        for (part, index) in parts.iter().zip(0..) {
            let planes = part.topology.face_planes();
            let caster = frame.add_part(part, &planes, index, lit_words, outline_words);
            lit_words += caster.face_count.div_ceil(BLOCK_SIZE) * LIT_WORDS_PER_BLOCK;
            outline_words += caster.edge_count.div_ceil(BLOCK_SIZE) * OUTLINE_WORDS_PER_BLOCK;
            let TopologyAwareMesh { bounds_min, bounds_max, .. } = *part.topology;
            let bounds = (!is_by_positions(index)).then_some([bounds_min, bounds_max]);
            frame.caster_places.push(caster_place(&part.world_from_object, &near_one(&part.topology), bounds));
            frame.face_blocks.extend(blocks(index, caster.face_count).map(|item| {
                let by_positions = is_by_positions(index) || !planes.block_fits(item.block);
                WorkItem { kind: if by_positions { BLOCK_BY_POSITIONS } else { BLOCK_BY_PLANES }, ..item }
            }));
            frame.edge_blocks.extend(blocks(index, caster.edge_count));
            frame.casters.push(caster);
        }
        for blocks in [&mut frame.face_blocks, &mut frame.edge_blocks] {
            blocks.extend((0..blocks.len() as u32 / 4).map(|block| WorkItem {
                caster: NO_CASTER,
                block,
                kind: BLOCK_BY_PLANES,
            }));
            shuffle(blocks);
        }
        let caster_stride = frame.casters.len() + gap;
        let item_stride = frame.face_blocks.len() + gap;
        frame.caster_lights = vec![CasterLight::default(); seats * caster_stride];
        frame.face_items = vec![WorkItem::default(); seats * item_stride];
        frame.face_tests = vec![TestItem::default(); frame.face_blocks.len()];
        frame.edge_tests = vec![TestItem::default(); frame.edge_blocks.len()];

        let face_count: u32 = frame.casters.iter().map(|caster| caster.face_count).sum();
        let edge_count: u32 = frame.casters.iter().map(|caster| caster.edge_count).sum();
        let counts = ViewCounts {
            casters: frame.casters.len() as u32,
            face_blocks: frame.face_blocks.len() as u32,
            edge_blocks: frame.edge_blocks.len() as u32,
            undecided: face_count,
            silhouettes: edge_count,
            quads: edge_count,
            corners: 2 * edge_count,
        };
        // Casters out of view have silhouettes too.
        for (record, view) in frame.bundle.views.iter_mut().zip(views) {
            *record = view.light_view(settings, &counts);
            record.flags &= !VIEW_CULLS;
        }
        let outline_stride = outline_words as usize + gap;
        frame.bundle.shape = BundleShape {
            seat_count: seats as u32,
            seat_shift: seats.trailing_zeros(),
            caster_stride: caster_stride as u32,
            item_stride: item_stride as u32,
            outline_stride: outline_stride as u32,
            ..BundleShape::default()
        };
        frame.lit = vec![0; seats * lit_words as usize];
        frame.recheck_words = vec![RecheckWord::default(); seats * lit_words as usize];
        frame.outline_sides = vec![0; seats * outline_stride];
        frame.counters = vec![SeatCounters::default(); seats];
        frame.draw_args = vec![DrawArgs::default(); seats * DRAW_STRIDE];
        frame.set_room(counts);
        frame
    }

    /// No casters and no room.
    pub fn empty() -> Self {
        Self {
            bundle: ViewBundle::of_one(&LightView::default()),
            seat: 0,
            caster_places: Vec::new(),
            face_blocks: Vec::new(),
            edge_blocks: Vec::new(),
            face_items: Vec::new(),
            face_tests: Vec::new(),
            edge_tests: Vec::new(),
            item_args: vec![DispatchArgs::default(); 2],
            casters: Vec::new(),
            caster_lights: Vec::new(),
            faces: Vec::new(),
            planes: Vec::new(),
            positions: Vec::new(),
            edges: Vec::new(),
            incidences: Vec::new(),
            vertex_edges: Vec::new(),
            lit: Vec::new(),
            recheck_words: Vec::new(),
            recheck_args: vec![DispatchArgs::default()],
            undecided: Vec::new(),
            counters: vec![SeatCounters::default()],
            refine_args: vec![DispatchArgs::default(); 2],
            silhouettes: Vec::new(),
            outline_sides: Vec::new(),
            extrude_args: vec![DispatchArgs::default(); 2],
            quads: Vec::new(),
            corners: Vec::new(),
            draw_args: vec![DrawArgs::default(); 4],
        }
    }

    /// No casters, and a view alone of which something was counted.
    pub fn of_counts(view: LightView, counters: SeatCounters) -> Self {
        Self { bundle: ViewBundle::of_one(&view), counters: vec![counters], ..Self::empty() }
    }

    /// The view of the seat that stages of one view work on.
    pub fn view(&self) -> &LightView {
        &self.bundle.views[self.seat]
    }

    /// What was counted for that seat.
    pub fn counts(&self) -> &Counters {
        &self.counters[self.seat].counts
    }

    /// The quads that were made for that seat.
    pub fn made_quads(&self) -> &[Quad] {
        &self.quads[..self.counts().quads as usize]
    }

    /// The corners that were made for that seat.
    pub fn made_corners(&self) -> &[Corner] {
        &self.corners[..self.counts().corners as usize]
    }

    /// Where what that seat has begins in what seats have apart, by the stride.
    pub fn begin(&self, stride: u32) -> usize {
        self.seat * stride as usize
    }

    /// Gives the lists other sizes, in the records and in the views.
    pub fn set_room(&mut self, counts: ViewCounts) {
        for view in &mut self.bundle.views {
            view.undecided_capacity = counts.undecided;
            view.silhouette_capacity = counts.silhouettes;
            view.quad_capacity = counts.quads;
            view.corner_capacity = counts.corners;
        }
        let seats = self.bundle.shape.seat_count;
        let silhouette_stride = counts.silhouettes + if seats > 1 { GAP.len() as u32 } else { 0 };
        self.bundle.shape.silhouette_stride = silhouette_stride;
        self.undecided = vec![FaceTest::default(); (seats * counts.undecided) as usize];
        self.silhouettes = vec![SilhouetteEdge::default(); (seats * silhouette_stride) as usize];
        self.quads = vec![Quad::default(); counts.quads as usize];
        self.corners = vec![Corner::default(); counts.corners as usize];
    }

    /// Puts a part into the pools, behind a gap, every second one with a wider stride between its positions.
    fn add_part(
        &mut self,
        part: &TestPart,
        planes: &FacePlanes,
        index: u32,
        lit_words: u32,
        outline_words: u32,
    ) -> Caster {
        let mesh = &part.topology;
        let stride = 3 + index % 2;
        self.positions.extend(GAP);
        self.incidences.extend(GAP);
        self.vertex_edges.extend(GAP);
        self.faces.push(Face { a: GAP[0], b: GAP[1], c: GAP[2] });
        self.planes.push([-1.0; 4]);
        self.edges.push(Edge { low_vertex: GAP[0], high_vertex: GAP[1], first: GAP[2], second: GAP[3] });

        let candidates = &mesh.edges[..mesh.candidate_edge_count as usize];
        let first_vertex_offset_word = self.vertex_edges.len() as u32;
        let caster = Caster {
            first_position_word: self.positions.len() as u32,
            position_stride_words: stride,
            first_face: self.faces.len() as u32,
            face_count: mesh.faces.len() as u32,
            first_edge: self.edges.len() as u32,
            edge_count: mesh.candidate_edge_count,
            first_incidence: self.incidences.len() as u32,
            first_vertex_offset_word,
            first_vertex_edge_word: first_vertex_offset_word + mesh.vertex_edge_offsets.len() as u32,
            first_lit_word: lit_words,
            first_outline_word: outline_words,
            position_scale: near_one(mesh).scale,
            position_origin: near_one(mesh).origin,
            mask: 0,
        };
        for position in &mesh.positions {
            self.positions.extend(position.map(f32::to_bits));
            self.positions.extend(&GAP[3..stride as usize]);
        }
        self.faces.extend(&mesh.faces);
        // As for positions of the caller's, there are none.
        let wrong_planes = vec![[-1.0; 4]; mesh.faces.len()];
        self.planes.extend(if is_by_positions(index) { &wrong_planes } else { &planes.planes });
        self.edges.extend(candidates);
        self.incidences.extend(&mesh.incidences);
        self.vertex_edges.extend(&mesh.vertex_edge_offsets);
        self.vertex_edges.extend(mesh.vertex_edges.iter().flat_map(|edge| [edge.edge_id, edge.other_vertex]));
        caster
    }

    /// The listed blocks of faces.
    pub fn listed_faces(&self) -> &[TestItem] {
        &self.face_tests[..self.counters[0].face_tests as usize]
    }

    /// The bytes of a binding, from where the seat has its part of it: the stages of a bundle need the first one.
    ///
    /// # Panics
    ///
    /// When no buffer has the name.
    pub fn bytes(&self, binding: &str) -> &[u8] {
        let shape = &self.bundle.shape;
        match binding {
            "view" => bytes_of(self.view()),
            "bundle" => bytes_of(&self.bundle),
            "caster_places" => cast_slice(&self.caster_places),
            "face_blocks" => cast_slice(&self.face_blocks),
            "edge_blocks" => cast_slice(&self.edge_blocks),
            "face_items" => cast_slice(&self.face_items[self.begin(shape.item_stride)..]),
            "face_tests" => cast_slice(&self.face_tests),
            "edge_tests" => cast_slice(&self.edge_tests),
            "item_args" => cast_slice(&self.item_args),
            "casters" => cast_slice(&self.casters),
            "caster_lights" => cast_slice(&self.caster_lights[self.begin(shape.caster_stride)..]),
            "faces" => cast_slice(&self.faces),
            "planes" => cast_slice(&self.planes),
            "positions" => cast_slice(&self.positions),
            "edges" => cast_slice(&self.edges),
            "incidences" => cast_slice(&self.incidences),
            "vertex_edges" => cast_slice(&self.vertex_edges),
            "lit" => cast_slice(&self.lit),
            "recheck_words" => cast_slice(&self.recheck_words),
            "recheck_args" => cast_slice(&self.recheck_args),
            "undecided" => cast_slice(&self.undecided),
            "counters" => cast_slice(&self.counters[self.seat..]),
            "refine_args" => cast_slice(&self.refine_args),
            "silhouettes" => cast_slice(&self.silhouettes[self.begin(shape.silhouette_stride)..]),
            "outline_sides" => cast_slice(&self.outline_sides[self.begin(shape.outline_stride)..]),
            "extrude_args" => cast_slice(&self.extrude_args),
            "quads" => cast_slice(&self.quads),
            "corners" => cast_slice(&self.corners),
            "draw_args" => cast_slice(&self.draw_args[self.seat * DRAW_STRIDE..]),
            _ => panic!("no buffer is named {binding}"),
        }
    }

    /// Puts what a stage wrote in place of a binding's bytes.
    ///
    /// # Panics
    ///
    /// When stages write no buffer of the name, or one of another size.
    pub fn set_bytes(&mut self, binding: &str, bytes: &[u8]) {
        let shape = self.bundle.shape;
        let [items, casters, silhouettes, outlines] =
            [shape.item_stride, shape.caster_stride, shape.silhouette_stride, shape.outline_stride]
                .map(|stride| self.begin(stride));
        let place = match binding {
            "caster_lights" => cast_slice_mut(&mut self.caster_lights[casters..]),
            "face_items" => cast_slice_mut(&mut self.face_items[items..]),
            "face_tests" => cast_slice_mut(&mut self.face_tests),
            "edge_tests" => cast_slice_mut(&mut self.edge_tests),
            "item_args" => cast_slice_mut(&mut self.item_args),
            "lit" => cast_slice_mut(&mut self.lit),
            "recheck_words" => cast_slice_mut(&mut self.recheck_words),
            "recheck_args" => cast_slice_mut(&mut self.recheck_args),
            "undecided" => cast_slice_mut(&mut self.undecided),
            "counters" => cast_slice_mut(&mut self.counters[self.seat..]),
            "refine_args" => cast_slice_mut(&mut self.refine_args),
            "silhouettes" => cast_slice_mut(&mut self.silhouettes[silhouettes..]),
            "outline_sides" => cast_slice_mut(&mut self.outline_sides[outlines..]),
            "extrude_args" => cast_slice_mut(&mut self.extrude_args),
            "quads" => cast_slice_mut(&mut self.quads),
            "corners" => cast_slice_mut(&mut self.corners),
            "draw_args" => cast_slice_mut(&mut self.draw_args[self.seat * DRAW_STRIDE..]),
            _ => panic!("no stage writes {binding}"),
        };
        place.copy_from_slice(bytes);
    }
}

fn near_one(mesh: &TopologyAwareMesh) -> NearOne {
    NearOne::of_box(mesh.bounds_min, mesh.bounds_max)
}

fn blocks(caster: u32, count: u32) -> impl Iterator<Item = WorkItem> {
    (0..count.div_ceil(BLOCK_SIZE)).map(move |block| WorkItem { caster, block, kind: 0 })
}

/// Whether the faces of a part are tested by positions alone: every third one's, but not those of a part alone.
fn is_by_positions(index: u32) -> bool {
    index % 3 == 2
}

/// Blocks may come in any order.
fn shuffle(items: &mut [WorkItem]) {
    let mut random = Random::new(items.len() as u64);
    for end in (1..items.len()).rev() {
        items.swap(end, random.below(end + 1));
    }
}

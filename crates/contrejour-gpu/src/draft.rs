//! What a frame will do and upload, worked out before anything is touched.

use contrejour_layout::{CASTER_NEVER, CasterPlace, LightView, ReceiverView};
use contrejour_plan::{
    Capacity, CasterFacts, DeviceFacts, FramePlan, Outputs, PlanInput, SceneFacts, View, ViewCounts, caster_place,
    views,
};

use crate::casters::{CasterInput, CasterKey, CasterSet, LivePositions, Positions};
use crate::error::PrepareError;
use crate::inputs::{FrameInput, ShadowOptions};
use crate::pool::{MeshPool, PooledMesh};

/// A prepared frame that has not touched the device yet.
#[derive(Debug)]
pub(crate) struct FrameDraft {
    pub plan: FramePlan,
    pub casters: CasterSet,
    pub records: Records,
    pub singular_casters: u32,
    pub copies: Vec<LiveCopy>,
}

/// What a frame uploads.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Records {
    pub caster_places: Vec<CasterPlace>,
    /// One for each page, which differ in their counts.
    pub light_views: Vec<LightView>,
    pub receiver_view: ReceiverView,
}

/// A copy of a caller's positions into the pool.
#[derive(Clone, Debug)]
pub(crate) struct LiveCopy {
    pub source: wgpu::Buffer,
    pub source_offset: u64,
    pub target_offset: u64,
    pub size: u64,
}

impl FrameDraft {
    pub fn new(
        input: &FrameInput<'_>,
        pool: &MeshPool,
        options: &ShadowOptions,
        device: &DeviceFacts,
        capacity: Capacity,
    ) -> Result<Self, PrepareError> {
        // A spot and a directional light have one view each.
        let view = views(input.light)?.remove(0);

        // Look at each caster.
        let mut scene =
            SceneFacts { meshes: pool.facts().to_vec(), pieces: pool.pieces().to_vec(), ..SceneFacts::default() };
        let mut singular_casters = 0;
        let mut caster_places = Vec::with_capacity(input.casters.len());
        let mut live = Vec::with_capacity(input.casters.len());
        for (caster, index) in input.casters.iter().zip(0..) {
            let Some(mesh) = pool.get(caster.mesh) else {
                return Err(PrepareError::UnknownMesh { caster: index, mesh: caster.mesh });
            };
            let positions = live_positions(caster, index, pool.facts()[caster.mesh.0].vertices)?;
            let place = place(caster, mesh, positions);
            singular_casters += u32::from(place.casts == CASTER_NEVER && !mesh.topology.faces.is_empty());
            caster_places.push(place);
            scene.casters.push(facts(caster, index, positions));
            live.push(positions);
        }

        // Plan, and see where everybody's records lie.
        let plan = FramePlan::new(&PlanInput {
            scene: &scene,
            view: &view,
            settings: &options.settings,
            device,
            outputs: options.outputs,
            capacity,
        })?;
        let keys = input.casters.iter().zip(&live).map(|(caster, live)| CasterKey { mesh: caster.mesh, live: *live });
        let casters = CasterSet::new(keys.collect(), pool.position_words());
        let records = Records {
            caster_places,
            light_views: plan.pages.iter().map(|page| light_view(&view, &plan, &page.counts)).collect(),
            receiver_view: view.receiver_view(&plan.settings),
        };
        let copies = live_copies(input.casters, &live, pool.position_words());
        Ok(Self { plan, casters, records, singular_casters, copies })
    }
}

fn light_view(view: &View, plan: &FramePlan, counts: &ViewCounts) -> LightView {
    // The list of silhouette edges does not end where the maps do.
    let culls_casters = (plan.outputs != Outputs::Silhouettes).into();
    LightView { culls_casters, ..view.light_view(&plan.settings, counts) }
}

/// Who casts for a view is decided on the device, so the plan need not know where casters stand.
fn facts(caster: &CasterInput<'_>, index: usize, live: Option<LivePositions>) -> CasterFacts {
    CasterFacts {
        name: format!("caster {index}"),
        mesh: caster.mesh.0,
        bounds: None,
        own_position_words: live.map_or(0, LivePositions::words),
    }
}

fn place(caster: &CasterInput<'_>, mesh: &PooledMesh, live: Option<LivePositions>) -> CasterPlace {
    let topology = &mesh.topology;
    if topology.faces.is_empty() {
        return CasterPlace { casts: CASTER_NEVER, ..CasterPlace::default() };
    }
    // Where positions are the caller's, the CPU does not know where they are.
    let bounds = live.is_none().then_some([topology.bounds_min, topology.bounds_max]);
    caster_place(&caster.world_from_object, &mesh.near_one, bounds)
}

/// Where a caster brings its own positions: checks the buffer and says how they lie.
fn live_positions(
    caster: &CasterInput<'_>,
    index: usize,
    vertex_count: u32,
) -> Result<Option<LivePositions>, PrepareError> {
    let Positions::InBuffer { buffer, offset, stride } = caster.positions else { return Ok(None) };
    let is_aligned = offset % 4 == 0 && stride % 4 == 0 && stride >= 12 && stride <= u64::from(u32::MAX);
    let live = LivePositions { vertex_count, stride_words: (stride / 4) as u32 };
    let needed = offset + 4 * live.words();
    let available = buffer.size();
    let can_copy = buffer.usage().contains(wgpu::BufferUsages::COPY_SRC);
    if is_aligned && can_copy && needed <= available {
        return Ok(Some(live));
    }
    Err(PrepareError::Positions { caster: index, needed, available, offset, stride })
}

/// Live positions follow the meshes' own in the pool, in the order of the casters.
fn live_copies(casters: &[CasterInput<'_>], live: &[Option<LivePositions>], first_word: u64) -> Vec<LiveCopy> {
    let mut next_word = first_word;
    let mut copies = Vec::new();
    for (caster, live) in casters.iter().zip(live) {
        if let (Positions::InBuffer { buffer, offset, .. }, Some(live)) = (caster.positions, live) {
            if live.vertex_count > 0 {
                copies.push(LiveCopy {
                    source: buffer.clone(),
                    source_offset: offset,
                    target_offset: 4 * next_word,
                    size: 4 * live.words(),
                });
            }
            next_word += live.words();
        }
    }
    copies
}

//! The frame plan and how it is made.

use super::decide::{LeftOutList, casting, lacks_planes, note_without_silhouette, outlines_wanted, passes, stages};
use super::page::{Page, pages};
use super::room::{kept, with_room};
use super::seats::{most_items_with, seats, wanted_seats};
use super::size_buffers::{PageSizes, SceneSizes};
use super::{
    BufferKind, BufferPlan, Capacity, DeviceFacts, LeftOut, Omitted, Outputs, PagePlan, Pass, PipelinePlan, PlanError,
    Reason, SceneFacts, Stage, TextureKind, TexturePlan, VisibilityKind,
};
use crate::{CastersInFront, ShadowSettings, View, ViewCounts};

/// What a plan is made from.
#[derive(Clone, Copy, Debug)]
pub struct PlanInput<'a> {
    /// What there is to shadow.
    pub scene: &'a SceneFacts,
    /// The light's views, at least one. How many they are and whether the light has a size decides what is made; where they
    /// look decides who casts.
    pub views: &'a [View],
    /// Views of all lights of the scene together, this one's among them: those that may be tested together.
    pub all_views: usize,
    /// How its shadow is made.
    pub settings: &'a ShadowSettings,
    /// What the device can do.
    pub device: &'a DeviceFacts,
    /// What the caller wants.
    pub outputs: Outputs,
    /// Room that earlier frames are known to need on a page; zeros for a first frame.
    pub capacity: Capacity,
    /// Buffers that lights beside this one need. All lights share pages and lists, so what one needs shapes them for all.
    pub shared: &'a [BufferKind],
    /// Buffers that lights share, as an earlier frame's plan lists them; none for a first frame. Where both frames have
    /// one page, those with room are kept as they are and those without grow to half more than is needed.
    pub made: &'a [BufferPlan],
}

/// Everything that a frame of one light does and holds. Nothing else is created.
///
/// Buffers have room for all casters of the scene, so that a light that moves creates nothing. Which of them cast for a
/// view is decided on the device; `casting` says what comes out where the CPU knows where they stand.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FramePlan {
    /// What the caller wants.
    pub outputs: Outputs,
    /// How the shadow is made, as far as the device can do it.
    pub settings: ShadowSettings,
    /// The visibility function; `None` without maps.
    pub visibility: Option<VisibilityKind>,
    /// Compute stages in their order.
    pub stages: Vec<Stage>,
    /// Raster passes in their order.
    pub passes: Vec<Pass>,
    /// Pipelines in the order of what runs them.
    pub pipelines: Vec<PipelinePlan>,
    /// Pages, at least one; more where the device's buffers are too small for all meshes together.
    pub pages: Vec<PagePlan>,
    /// Views that are tested together, at most: 1, 2, 4 or 8. As many as the scene has, as far as their lists have room.
    pub seats: u32,
    /// Buffers by kind, then by page. All lights share them, but for those [of the light](BufferKind::is_of_light).
    pub buffers: Vec<BufferPlan>,
    /// Textures.
    pub textures: Vec<TexturePlan>,
    /// Indices of the casters that have work items in this frame, ascending, but for those near the frustum's edge.
    pub casting: Vec<usize>,
    /// Casters without a place for the light: their matrix is singular.
    pub singular_casters: u32,
    /// What was left out, and why.
    pub left_out: Vec<LeftOut>,
}

impl FramePlan {
    /// Decides what a frame does.
    ///
    /// # Errors
    ///
    /// The settings are out of range, a caster names no mesh, or the device can't hold what the frame needs.
    pub fn new(input: &PlanInput<'_>) -> Result<Self, PlanError> {
        let PlanInput { scene, settings, device, outputs, .. } = *input;
        settings.validate()?;
        for (caster, facts) in scene.casters.iter().enumerate() {
            if facts.mesh >= scene.meshes.len() {
                return Err(PlanError::UnknownMesh { caster, mesh: facts.mesh, meshes: scene.meshes.len() });
            }
        }
        let mut left_out = LeftOutList::default();

        // Decide what runs.
        let outlines = outlines_wanted(input, &mut left_out);
        let stages = stages(input, outlines.as_ref(), &mut left_out);
        let passes = passes(input, outlines.as_ref(), &mut left_out);
        let visibility = VisibilityKind::of(&settings.technique, &passes, has_size(input));
        let limit = device.max_texture_dimension_2d;
        if !passes.is_empty() && settings.map_size > limit {
            return Err(PlanError::MapTooLarge { map_size: settings.map_size, limit });
        }

        let lacks_planes = lacks_planes(input, &stages, &mut left_out);
        note_without_silhouette(scene, &stages, &passes, &mut left_out);

        // Decide who casts in this frame.
        let casting = casting(input, &mut left_out);
        left_out.all(scene.receivers.iter().map(|name| Omitted::Topology(name.clone())), Reason::ReceivesOnly);
        left_out.add(Omitted::InstanceTransforms, Reason::NothingIsInstanced);
        left_out.add(Omitted::Deformation, Reason::NothingIsSkinned);

        // List what that needs.
        // Where others have seats, a view that does nothing has one too.
        let is_shared = |kind: &BufferKind| match kind {
            BufferKind::LightView => input.shared.contains(&BufferKind::ViewBundle),
            kind => input.shared.contains(kind),
        };
        let is_needed = |kind: &BufferKind| is_bound(*kind, &stages, &passes) || is_shared(kind);
        let kinds: Vec<_> = BufferKind::ALL.into_iter().filter(is_needed).collect();
        let pages = pages(scene, &kinds, device, PageSizes::new(scene, &kinds, input.capacity, lacks_planes));
        let mut buffers = buffers(&kinds, &SceneSizes::new(scene, input.views.len()), &pages, device)?;
        let stays = |buffer: &BufferPlan| !buffer.kind.is_of_light();
        let have_one_page = pages.len() == 1 && input.made.iter().all(|made| made.page == 0);
        let made = if have_one_page { input.made } else { &[] };
        let kept_buffers: Vec<_> =
            buffers.iter().filter(|buffer| stays(buffer)).map(|buffer| kept(*buffer, made)).collect();
        let seats = seats(input, &kept_buffers);
        for buffer in buffers.iter_mut().filter(|buffer| stays(buffer)) {
            let is_paged = buffer.kind.is_paged();
            let expected = if is_paged { pages[buffer.page].sizes.expected_items(buffer.kind) } else { buffer.items };
            let most = most_items_with(seats, &kept_buffers, buffer, device);
            *buffer = with_room(*buffer, expected, made, most);
        }
        if stages.contains(&Stage::ClassifyFaces) && seats < wanted_seats(input) {
            left_out.add(Omitted::TestsTogether, Reason::ListsAreTooLarge);
        }
        for buffer in &mut buffers {
            *buffer = buffer.with_seats(seats);
        }
        let kept = |kind: &TextureKind| visibility.is_some_and(|visibility| visibility.textures().contains(kind));
        let layers = |kind: &TextureKind| if kept(kind) { input.views.len() as u32 } else { 1 };
        let textures = passes.iter().flat_map(|pass| pass.fills());
        let textures = textures.map(|kind| TexturePlan::new(*kind, settings, device, layers(kind))).collect();
        let of_stages = stages.iter().flat_map(|stage| PipelinePlan::of_stage(*stage, seats));
        let in_front = casters_in_front(input.views);
        let of_passes = passes.iter().flat_map(|pass| PipelinePlan::of_pass(*pass, &settings.technique, in_front));
        let pipelines = of_stages.chain(of_passes).collect();

        let pages = (pages.into_iter().enumerate())
            .map(|(index, page)| PagePlan {
                counts: counts(&page, scene.caster_slots(), &buffers, index),
                pieces: page.pieces,
                casters: page.casters,
            })
            .collect();
        let singular_casters = left_out.count(Reason::SingularMatrix);
        let left_out = left_out.0;
        Ok(Self {
            outputs,
            settings: settings.on_device(device),
            visibility,
            stages,
            passes,
            pipelines,
            pages,
            seats,
            buffers,
            textures,
            casting,
            singular_casters,
            left_out,
        })
    }

    /// Whether the frame runs anything: not where its maps stand as they are.
    pub fn is_drawn(&self) -> bool {
        self.reason(&Omitted::Redrawing).is_none()
    }

    /// Whether the frame runs a stage, where it is [drawn](Self::is_drawn).
    pub fn has_stage(&self, stage: Stage) -> bool {
        self.stages.contains(&stage)
    }

    /// The pass that fills the silhouette map, where the light has one.
    pub fn silhouette_map_pass(&self) -> Option<Pass> {
        self.passes.iter().copied().find(|pass| pass.fills_silhouette_map())
    }

    /// Whether the frame runs a pass, where it is [drawn](Self::is_drawn).
    pub fn has_pass(&self, pass: Pass) -> bool {
        self.passes.contains(&pass)
    }

    /// A buffer, where the frame needs it; the first page's.
    pub fn buffer(&self, kind: BufferKind) -> Option<&BufferPlan> {
        self.buffers.iter().find(|buffer| buffer.kind == kind)
    }

    /// A texture, where the frame needs it.
    pub fn texture(&self, kind: TextureKind) -> Option<&TexturePlan> {
        self.textures.iter().find(|texture| texture.kind == kind)
    }

    /// Whether a caster has work items in this frame.
    pub fn casts(&self, caster: usize) -> bool {
        self.casting.binary_search(&caster).is_ok()
    }

    /// Why something was left out; `None` where it was not.
    pub fn reason(&self, what: &Omitted) -> Option<Reason> {
        self.left_out.iter().find(|left_out| left_out.what == *what).map(|left_out| left_out.reason)
    }
}

/// Whether the light has a size: all its views show the same one.
pub(super) fn has_size(input: &PlanInput<'_>) -> bool {
    input.views.iter().any(|view| view.light_size > 0.0)
}

/// What becomes of casters in front of the views, which are alike in this.
fn casters_in_front(views: &[View]) -> CastersInFront {
    views.first().map_or(CastersInFront::Clipped, |view| view.casters_in_front)
}

/// Whether a stage or a pass needs a buffer. Receivers look the maps up through the receiver view.
fn is_bound(kind: BufferKind, stages: &[Stage], passes: &[Pass]) -> bool {
    let binds = |kind| {
        stages.iter().any(|stage| stage.buffers().contains(&kind))
            || passes.iter().any(|pass| pass.buffers().contains(&kind))
    };
    match kind {
        BufferKind::ReceiverView => !passes.is_empty(),
        // What a seat holds is copied from the light that has it.
        BufferKind::LightView | BufferKind::BundleShapes | BufferKind::ViewBundle => {
            binds(BufferKind::LightView) || binds(BufferKind::ViewBundle)
        }
        kind => binds(kind),
    }
}

fn buffers(
    kinds: &[BufferKind],
    scene: &SceneSizes,
    pages: &[Page],
    device: &DeviceFacts,
) -> Result<Vec<BufferPlan>, PlanError> {
    let mut buffers = Vec::new();
    for &kind in kinds {
        if kind.is_paged() {
            for (page, index) in pages.iter().zip(0..) {
                buffers.push(match kind {
                    BufferKind::LightView => scene.light_views(index),
                    _ => page.sizes.buffer(kind, index, device)?,
                });
            }
        } else {
            buffers.push(scene.buffer(kind, device)?);
        }
    }
    Ok(buffers)
}

/// Blocks on a page, and the room in its lists.
fn counts(page: &Page, casters: usize, buffers: &[BufferPlan], index: usize) -> ViewCounts {
    let room = |kind| {
        let listed = buffers.iter().find(|buffer| buffer.kind == kind && buffer.page == index);
        listed.map_or(0, |buffer| buffer.items as u32)
    };
    let [face_blocks, edge_blocks] = page.sizes.blocks();
    ViewCounts {
        casters: casters as u32,
        face_blocks,
        edge_blocks,
        undecided: room(BufferKind::Undecided),
        silhouettes: room(BufferKind::Silhouettes),
        quads: room(BufferKind::Quads),
        corners: room(BufferKind::Corners),
    }
}

#[cfg(test)]
mod tests;

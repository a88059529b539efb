//! The buffers and pipelines that all lights share.

use contrejour_layout::CasterPlace;
use contrejour_plan::{BufferKind, FramePlan, Omitted, PagePlan};

use crate::casters::{Casters, LiveCopy};
use crate::pipelines::Pipelines;
use crate::pool::MeshPool;
use crate::resources::Buffers;

/// Pools of meshes, records of casters, and the lists that are filled for one view after the other.
#[derive(Debug, Default)]
pub(crate) struct SceneBuffers {
    shared: Buffers,
    pipelines: Pipelines,
    /// What lies in the pools, page by page.
    pages: Vec<PagePlan>,
    has_planes: bool,
    has_tables: bool,
}

/// The pools that meshes fill page by page.
const MESH_POOLS: [BufferKind; 4] =
    [BufferKind::Faces, BufferKind::Edges, BufferKind::Incidences, BufferKind::VertexEdges];

impl SceneBuffers {
    pub fn shared(&self) -> &Buffers {
        &self.shared
    }

    pub fn shared_and_pipelines(&mut self) -> (&Buffers, &mut Pipelines) {
        (&self.shared, &mut self.pipelines)
    }

    /// Lets the tables of casters be written again.
    pub fn forget_tables(&mut self) {
        self.has_tables = false;
    }

    pub fn drop_unused(&mut self) {
        self.pipelines.drop_unused();
    }

    /// Makes and fills what a plan lists, as all do that share it; returns the bytes that it uploaded.
    pub fn follow(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        plan: Option<&FramePlan>,
        (meshes, casters): (&mut MeshPool, &mut Casters),
    ) -> u64 {
        let Some(plan) = plan else {
            *self = Self::default();
            return 0;
        };
        let made = self.shared.follow(device, plan.buffers.iter().filter(|buffer| !buffer.kind.is_of_light()));
        let mut bytes = 0;
        let mut write = |(kind, page): (BufferKind, usize), offset: u64, data: &[u8]| {
            if let Some(buffer) = self.shared.find(kind, page).filter(|_| !data.is_empty()) {
                queue.write_buffer(buffer, offset, data);
                bytes += data.len() as u64;
            }
        };

        // Meshes.
        if made.contains(&(BufferKind::Positions, 0)) {
            meshes.fill_positions(|offset, data| write((BufferKind::Positions, 0), offset, data));
        }
        if made.contains(&(BufferKind::Masks, 0)) || made.contains(&(BufferKind::MaskWords, 0)) {
            write((BufferKind::Masks, 0), 0, bytemuck::cast_slice(&meshes.masks().records()));
            meshes.masks().fill_words(|offset, data| write((BufferKind::MaskWords, 0), offset, data));
        }
        // Where nobody reads planes, their buffer has no room for them.
        let has_planes = plan.reason(&Omitted::FacePlanes).is_none() && plan.buffer(BufferKind::Planes).is_some();
        for (page, index) in plan.pages.iter().zip(0..) {
            let holds_others = self.pages.get(index).is_none_or(|old| old.pieces != page.pieces);
            // The buffer of one face is as large as one without planes.
            let has_new_planes = !self.has_planes || holds_others || made.contains(&(BufferKind::Planes, index));
            if has_new_planes && has_planes {
                meshes.fill_planes(page, |offset, data| write((BufferKind::Planes, index), offset, data));
            }
            for kind in MESH_POOLS {
                if holds_others || made.contains(&(kind, index)) {
                    meshes.fill(kind, page, |offset, data| write((kind, index), offset, data));
                }
            }
        }

        // Casters.
        let of_tables = [BufferKind::Casters, BufferKind::FaceBlocks, BufferKind::EdgeBlocks];
        let has_new_tables = made.iter().any(|(kind, _)| of_tables.contains(kind));
        // Blocks say whether their faces have planes.
        if !self.has_tables
            || has_new_tables
            || self.has_planes != has_planes
            || !holds_the_same(&self.pages, &plan.pages)
        {
            for (table, page) in casters.tables(meshes, &plan.pages).iter().zip(0..) {
                write((BufferKind::Casters, page), 0, bytemuck::cast_slice(&table.casters));
                write((BufferKind::FaceBlocks, page), 0, bytemuck::cast_slice(&table.face_blocks));
                write((BufferKind::EdgeBlocks, page), 0, bytemuck::cast_slice(&table.edge_blocks));
            }
        }
        if made.contains(&(BufferKind::CasterPlaces, 0)) {
            casters.move_all();
        }
        self.has_tables = true;
        self.has_planes = has_planes;
        self.pages.clone_from(&plan.pages);
        bytes
    }

    /// Uploads the places of casters that moved; returns the bytes.
    pub fn upload_places(&self, queue: &wgpu::Queue, casters: &mut Casters) -> u64 {
        let mut bytes = 0;
        let buffer = self.shared.find(BufferKind::CasterPlaces, 0);
        casters.take_moved(|slot, places| {
            let offset = (slot * size_of::<CasterPlace>()) as u64;
            let data = bytemuck::cast_slice(places);
            // A caster that was the last one has left no room behind.
            if let Some(buffer) = buffer.filter(|buffer| offset + data.len() as u64 <= buffer.size()) {
                queue.write_buffer(buffer, offset, data);
                bytes += data.len() as u64;
            }
        });
        bytes
    }

    /// Records the copies of positions that are the caller's.
    pub fn encode_copies(&self, encoder: &mut wgpu::CommandEncoder, copies: &[LiveCopy]) {
        let Some(target) = self.shared.find(BufferKind::Positions, 0) else { return };
        for copy in copies {
            encoder.copy_buffer_to_buffer(&copy.source, copy.source_offset, target, copy.target_offset, copy.size);
        }
    }
}

fn holds_the_same(old: &[PagePlan], new: &[PagePlan]) -> bool {
    let content = |pages: &[PagePlan]| -> Vec<_> {
        pages.iter().map(|page| (page.pieces.clone(), page.casters.clone(), page.counts.edge_blocks)).collect()
    };
    content(old) == content(new)
}

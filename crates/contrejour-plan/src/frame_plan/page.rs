//! Pages: a scene that is too large for one set of buffers is spread over several.

use super::size_buffers::PageSizes;
use super::{BufferKind, Capacity, DeviceFacts, MeshFacts, MeshPiece, SceneFacts};
use crate::ViewCounts;

/// What of a scene lies in one set of buffers, and the work there. Each stage runs over all pages before the next one
/// does. Positions, lit bits and outline sides serve all pages, so that a page needs nothing of what lies in others.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PagePlan {
    /// What lies in its pools, in their order; of each mesh at most one piece.
    pub pieces: Vec<MeshPiece>,
    /// The casters that have work here.
    pub casters: Vec<PagedCaster>,
    /// How much there is to work on, and the room in each list.
    pub counts: ViewCounts,
}

/// A caster whose piece lies in a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PagedCaster {
    /// Index of the caster.
    pub caster: usize,
    /// Index of the piece among those of the page.
    pub piece: usize,
}

impl PagePlan {
    /// Room for silhouette edges, quads and corners.
    pub fn capacity(&self) -> Capacity {
        let ViewCounts { silhouettes, quads, corners, .. } = self.counts;
        Capacity { silhouettes, quads, corners }
    }
}

impl MeshPiece {
    /// Whether every buffer of a page has room for this piece and one caster of it.
    pub fn fits(&self, mesh: &MeshFacts, device: &DeviceFacts) -> bool {
        let mut sizes = PageSizes::default();
        sizes.add_piece(self, mesh);
        sizes.add_casters(self, mesh, 1);
        sizes.fit(&BufferKind::ALL, device)
    }
}

/// A page without its buffers.
#[derive(Clone, Debug)]
pub(super) struct Page {
    pub pieces: Vec<MeshPiece>,
    pub casters: Vec<PagedCaster>,
    pub sizes: PageSizes,
}

impl Page {
    /// A page without pieces.
    fn new(empty: PageSizes) -> Self {
        Self { pieces: Vec::new(), casters: Vec::new(), sizes: empty }
    }

    /// All meshes, also those that nothing casts yet.
    fn whole(scene: &SceneFacts, empty: PageSizes) -> Self {
        let mut page = Self::new(empty);
        page.sizes.add_holes(&scene.holes);
        let mut caster_counts = vec![0; scene.meshes.len()];
        for (caster, facts) in scene.casters.iter().enumerate() {
            caster_counts[facts.mesh] += 1;
            page.casters.push(PagedCaster { caster, piece: facts.mesh });
        }
        for ((mesh, facts), caster_count) in scene.meshes.iter().enumerate().zip(caster_counts) {
            let piece = MeshPiece::whole(mesh, facts);
            page.sizes.add_piece(&piece, facts);
            page.sizes.add_casters(&piece, facts, caster_count);
            page.pieces.push(piece);
        }
        page
    }

    /// Adds a caster's piece where there is room for it: a page has room for anything alone.
    fn add(&mut self, piece: &MeshPiece, caster: usize, mesh: &MeshFacts, room: impl Fn(&PageSizes) -> bool) -> bool {
        let mut sizes = self.sizes;
        let last = self.pieces.last();
        let is_there = last == Some(piece);
        if !is_there {
            sizes.add_piece(piece, mesh);
        }
        sizes.add_casters(piece, mesh, 1);
        // Caster records have one base for each mesh.
        let is_cut_here = !is_there && last.is_some_and(|last| last.mesh == piece.mesh);
        if !self.casters.is_empty() && (is_cut_here || !room(&sizes)) {
            return false;
        }
        if !is_there {
            self.pieces.push(*piece);
        }
        self.casters.push(PagedCaster { caster, piece: self.pieces.len() - 1 });
        self.sizes = sizes;
        true
    }
}

/// Spreads a scene over one page, where all meshes fit it, or over several, each with what casts there, whose buffers of the
/// given kinds the device allows, as far as it can be cut. `empty` are the sizes of a page without pieces.
pub(super) fn pages(scene: &SceneFacts, kinds: &[BufferKind], device: &DeviceFacts, empty: PageSizes) -> Vec<Page> {
    let whole = Page::whole(scene, empty);
    if whole.sizes.fit(kinds, device) {
        return vec![whole];
    }
    let mut casters_of = vec![Vec::new(); scene.meshes.len()];
    for (caster, facts) in scene.casters.iter().enumerate() {
        casters_of[facts.mesh].push(caster);
    }
    let mut full = Vec::new();
    let mut page = Page::new(empty);
    for (mesh, facts) in scene.meshes.iter().enumerate() {
        let mut pieces: Vec<_> = scene.pieces.iter().filter(|piece| piece.mesh == mesh).copied().collect();
        if pieces.is_empty() {
            pieces.push(MeshPiece::whole(mesh, facts));
        }
        for piece in &pieces {
            for &caster in &casters_of[mesh] {
                if !page.add(piece, caster, facts, |sizes| sizes.fit(kinds, device)) {
                    full.push(std::mem::replace(&mut page, Page::new(empty)));
                    page.add(piece, caster, facts, |_| true);
                }
            }
        }
    }
    full.push(page);
    if full.len() == 1 {
        // On an only page every mesh would have its own place.
        full.push(Page::new(empty));
    }
    full
}

//! Counters and indirect arguments.

use crate::shared_struct::shared_struct;

shared_struct! {
    /// What the stages counted. Counters count past capacity, so that what a frame needed is always known.
    Counters {
        /// Undecided faces that short integers can decide; they fill the list from its front.
        undecided_near: u32,
        /// Undecided faces that need full integers; they fill the list from its back.
        undecided_far: u32,
        /// Silhouette edges.
        silhouette_edges: u32,
        /// Quads that were needed.
        quads: u32,
        /// Corners that were needed.
        corners: u32,
        /// Outline edges that project to a point and have no quad.
        point_edges: u32,
        /// Words of lit bits with faces that their planes leave undecided.
        recheck_words: u32,
        /// Blocks of faces without a mask of the casters that cast for the view; they fill the list from its front.
        face_items: u32,
        /// Blocks of edges of the casters that cast for the view.
        edge_items: u32,
        /// Casters that cast for the view.
        casters: u32,
        /// Casters that cast for the view and have no image in it: 32-bit floats can't hold their clip space.
        imageless_casters: u32,
        /// Blocks of masked faces of the casters that cast for the view; they fill the list from its back.
        masked_items: u32,
    }
}

/// A frame counts page by page. The sum saturates.
impl core::iter::Sum for Counters {
    fn sum<I: Iterator<Item = Self>>(pages: I) -> Self {
        pages.fold(Self::default(), |sum, page| Self {
            undecided_near: sum.undecided_near.saturating_add(page.undecided_near),
            undecided_far: sum.undecided_far.saturating_add(page.undecided_far),
            silhouette_edges: sum.silhouette_edges.saturating_add(page.silhouette_edges),
            quads: sum.quads.saturating_add(page.quads),
            corners: sum.corners.saturating_add(page.corners),
            point_edges: sum.point_edges.saturating_add(page.point_edges),
            recheck_words: sum.recheck_words.saturating_add(page.recheck_words),
            face_items: sum.face_items.saturating_add(page.face_items),
            edge_items: sum.edge_items.saturating_add(page.edge_items),
            casters: sum.casters.saturating_add(page.casters),
            imageless_casters: sum.imageless_casters.saturating_add(page.imageless_casters),
            masked_items: sum.masked_items.saturating_add(page.masked_items),
        })
    }
}

shared_struct! {
    /// Arguments of an indirect dispatch, in workgroups.
    DispatchArgs {
        /// Along x.
        x: u32,
        /// Along y.
        y: u32,
        /// Along z.
        z: u32,
    }
}

shared_struct! {
    /// Arguments of an indirect draw.
    DrawArgs {
        /// Vertices of each instance.
        vertex_count: u32,
        /// Instances.
        instance_count: u32,
        /// First vertex.
        first_vertex: u32,
        /// First instance; zero, as WebGPU's defaults ask.
        first_instance: u32,
    }
}

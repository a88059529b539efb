//! The compute stages.

use super::BufferKind::{self, *};

/// A compute stage. Its [name](Self::name) is its shader file, its entry point, its CPU twin and its test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Stage {
    /// From where casters stand to the lights as each sees them; leaves out those that a view can't see.
    PlaceCasters,
    /// From the blocks of all casters to those of the ones that cast: to draw for each view, to test for all together.
    ListBlocks,
    /// From listed blocks to the dispatches and the draws that work on them.
    WriteItemArgs,
    /// One lit bit for each face and view, by its stored plane where the bound allows; the others are listed by words.
    ClassifyFaces,
    /// From words with faces to recheck to the dispatch over those faces.
    WriteRecheckArgs,
    /// Faces that planes leave undecided, by positions where the bound allows; the others are listed.
    RecheckFaces,
    /// From undecided faces to the dispatches of the two exact tiers.
    WriteRefineArgs,
    /// Undecided faces by short integers.
    RefineFaces,
    /// Undecided faces by full integers.
    ResolveFaces,
    /// From lit bits to the lists of silhouette edges.
    DetectSilhouette,
    /// From silhouette edges to the dispatches that extrude them.
    WriteExtrudeArgs,
    /// From outline edges to quads on the image plane.
    ExtrudeEdges,
    /// From ends of outline edges to the wedges between quads.
    BuildCorners,
    /// From quads and corners to indirect draws.
    WriteDrawArgs,
}

impl Stage {
    /// All stages in the order in which a frame runs them.
    pub const ALL: [Self; 14] = [
        Self::PlaceCasters,
        Self::ListBlocks,
        Self::WriteItemArgs,
        Self::ClassifyFaces,
        Self::WriteRecheckArgs,
        Self::RecheckFaces,
        Self::WriteRefineArgs,
        Self::RefineFaces,
        Self::ResolveFaces,
        Self::DetectSilhouette,
        Self::WriteExtrudeArgs,
        Self::ExtrudeEdges,
        Self::BuildCorners,
        Self::WriteDrawArgs,
    ];

    /// The stages that decide what a view works on; every technique needs them.
    pub const PLACEMENT: &[Self] = Self::UP_TO_SILHOUETTES.split_at(3).0;

    /// The stages that find the silhouette.
    pub const DETECTION: &[Self] = Self::UP_TO_SILHOUETTES.split_at(3).1;

    /// The stages that end with the lists of silhouette edges: they run once for a bundle of views. The others extrude what
    /// is in them, for one view after the other.
    pub const UP_TO_SILHOUETTES: &[Self] = Self::ALL.split_at(10).0;

    /// Its name: shader file, entry point, CPU twin and test.
    pub const fn name(self) -> &'static str {
        match self {
            Self::PlaceCasters => "place_casters",
            Self::ListBlocks => "list_blocks",
            Self::WriteItemArgs => "write_item_args",
            Self::ClassifyFaces => "classify_faces",
            Self::WriteRecheckArgs => "write_recheck_args",
            Self::RecheckFaces => "recheck_faces",
            Self::WriteRefineArgs => "write_refine_args",
            Self::RefineFaces => "refine_faces",
            Self::ResolveFaces => "resolve_faces",
            Self::DetectSilhouette => "detect_silhouette",
            Self::WriteExtrudeArgs => "write_extrude_args",
            Self::ExtrudeEdges => "extrude_edges",
            Self::BuildCorners => "build_corners",
            Self::WriteDrawArgs => "write_draw_args",
        }
    }

    /// The buffers that its shader binds, in the order of their bindings; the first is a uniform.
    pub const fn buffers(self) -> &'static [BufferKind] {
        match self {
            Self::PlaceCasters => &[ViewBundle, CasterPlaces, CasterLights, Counters],
            Self::ListBlocks => {
                &[ViewBundle, CasterLights, FaceBlocks, EdgeBlocks, FaceItems, FaceTests, EdgeTests, Counters]
            }
            Self::WriteItemArgs => &[ViewBundle, Counters, ItemArgs, DrawArgs],
            Self::ClassifyFaces => &[ViewBundle, FaceTests, Casters, CasterLights, Planes, Lit, RecheckWords, Counters],
            Self::WriteRecheckArgs => &[ViewBundle, Counters, RecheckArgs],
            Self::RecheckFaces => {
                &[ViewBundle, RecheckWords, Casters, CasterLights, Faces, Positions, Lit, Undecided, Counters]
            }
            Self::WriteRefineArgs => &[ViewBundle, Counters, RefineArgs],
            Self::RefineFaces | Self::ResolveFaces => {
                &[ViewBundle, Undecided, Counters, Casters, CasterLights, Faces, Positions, Lit]
            }
            Self::DetectSilhouette => {
                &[ViewBundle, EdgeTests, Casters, Edges, Incidences, Lit, Silhouettes, OutlineSides, Counters]
            }
            Self::WriteExtrudeArgs => &[LightView, Counters, ExtrudeArgs],
            Self::ExtrudeEdges => &[LightView, Silhouettes, Casters, CasterLights, Edges, Positions, Quads, Counters],
            Self::BuildCorners => {
                &[LightView, Quads, Casters, CasterLights, Positions, OutlineSides, VertexEdges, Corners, Counters]
            }
            Self::WriteDrawArgs => &[LightView, Counters, DrawArgs],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// WebGPU's default limit of storage buffers in a shader stage.
    const MAX_STORAGE_BUFFERS: usize = 8;

    #[test]
    fn bindings_fit_the_default_limits() {
        for stage in Stage::ALL {
            let (uniform, storage) = stage.buffers().split_first().expect("never empty");
            let is_of_bundle = Stage::UP_TO_SILHOUETTES.contains(&stage);
            assert_eq!(*uniform, if is_of_bundle { ViewBundle } else { LightView });
            assert!(storage.len() <= MAX_STORAGE_BUFFERS, "{}", stage.name());
            let mut distinct = storage.to_vec();
            distinct.sort();
            distinct.dedup();
            assert_eq!(distinct.len(), storage.len(), "{}", stage.name());
        }
    }

    #[test]
    fn detection_ends_with_the_list() {
        assert_eq!(Stage::DETECTION.last(), Some(&Stage::DetectSilhouette));
    }

    #[test]
    fn stages_are_in_order() {
        assert!(Stage::ALL.is_sorted());
    }
}

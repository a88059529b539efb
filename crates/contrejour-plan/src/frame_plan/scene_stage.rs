//! The compute stages that prepare a scene for all its lights.

/// A compute stage that runs once a frame, before those of each light. As a [`Stage`](super::Stage) it has one
/// [name](Self::name): shader file, entry point, CPU twin and test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SceneStage {
    /// Rest vertices, joints and weights to positions.
    DeformPositions,
}

impl SceneStage {
    /// All of them in the order in which a frame runs them.
    pub const ALL: [Self; 1] = [Self::DeformPositions];

    /// Its name: shader file, entry point, CPU twin and test.
    pub const fn name(self) -> &'static str {
        match self {
            Self::DeformPositions => "deform_positions",
        }
    }
}

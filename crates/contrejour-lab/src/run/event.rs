//! What a run tells while it works.

use std::time::Duration;

use super::shard::Shard;

/// Something that happened. Whoever runs decides how it is shown.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// Before a full run: how long its groups will take, from a small part of the work, and what comes after them.
    Estimated {
        /// The time of the groups.
        duration: Duration,
        /// How many groups are measured.
        groups: usize,
        /// How many figures of the papers are made then. Their time is not in `duration`: they have scenes of their own,
        /// which no small part of the groups tells about.
        figures: usize,
    },
    /// There are more shards than groups, and this one has none.
    NothingToDo {
        /// The shard.
        shard: Shard,
        /// How many groups all shards have together.
        groups: usize,
    },
    /// Some points that a picture shows lie on faces without area, which the tracer can't tell sides of: they are not
    /// compared.
    WithoutArea {
        /// The scene.
        scene: &'a str,
        /// How many points.
        receivers: usize,
    },
    /// A group is not measured, because an earlier run with the same arguments did.
    Resumed {
        /// The scene.
        scene: &'a str,
        /// Texels along the shadow map's side.
        map_size: u32,
    },
    /// A group is not measured, because a quick report's time is over. The same command again measures it.
    OutOfTime {
        /// The scene.
        scene: &'a str,
        /// Texels along the shadow map's side.
        map_size: u32,
    },
    /// A contestant is left out, because the device can't do it as it is called.
    NotOnDevice {
        /// Its label.
        label: &'a str,
    },
    /// A truth is traced.
    TruthBegins {
        /// The scene.
        scene: &'a str,
        /// How many receivers are traced, over all positions of the light.
        receivers: u64,
    },
    /// More receivers are traced. Comes from any thread.
    TruthGrows {
        /// How many more.
        receivers: u64,
    },
    /// A truth is done.
    TruthDone,
    /// A group is measured.
    GroupBegins {
        /// The scene.
        scene: &'a str,
        /// Texels along the shadow map's side.
        map_size: u32,
        /// Frames that all its contestants draw together.
        frames: u64,
    },
    /// A frame of a contestant is drawn.
    FrameDone,
    /// A group is measured and kept.
    GroupDone {
        /// The scene.
        scene: &'a str,
        /// Texels along the shadow map's side.
        map_size: u32,
        /// Its number among those of this run, from 1.
        number: usize,
        /// How many groups this run measures.
        of: usize,
        /// How long it took.
        duration: Duration,
    },
    /// A table or figure of the papers is made.
    FigureBegins {
        /// Its name.
        name: &'a str,
    },
}

/// Who is told.
pub(crate) type Tell<'a> = &'a (dyn Fn(&Event<'_>) + Sync);

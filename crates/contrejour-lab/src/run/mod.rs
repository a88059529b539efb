//! Makes a report: measures every technique on every scene at every map size, and keeps each result at once.
//!
//! A **group** is a scene at a map size. Its contestants are on the device together and draw taking turns, frame by
//! frame, so that what disturbs the machine hits all alike. Then each draws a steady frame, which is compared with the
//! truth, and frames under a slowly moving light. The truth of a scene is traced once, from the points that its picture
//! shows.
//!
//! Compared are the receivers that lie in the light's maps and have the whole light above their plane. Elsewhere truth
//! and techniques mean different things: what is outside of the maps is lit by definition, and a surface whose plane
//! cuts the light is partly its own shadow, of which a technique that sees one point of the light knows nothing.
//!
//! Everything that is an error figure is the same to the last digit when it is measured again on the same machine.
//!
//! # The folder
//!
//! | In the folder | What it is |
//! | --- | --- |
//! | `index.html`, `report.json`, `report.csv`, `plots/` | the report, written at the end |
//! | `run.json` | what the run is to measure |
//! | `groups/<scene>-<size>.json` | a finished group |
//! | `truth/<scene>.bin` | a traced truth |
//! | `figures/<name>.json` | a table or figure of the papers |
//! | `pictures/` | pictures that the page shows |
//!
//! Files are written beside their place and then put there. A run that was interrupted loses the group under way and
//! nothing else: the same command goes on after what is there.
//!
//! # On many machines
//!
//! `--shard 2/8` measures every eighth group, from the second on, and needs nothing from the other shards. Groups are
//! counted a map size after the other, so that each shard has small maps and large ones. Shards with the same arguments
//! are put together by `contrejour report --merge DIR.. -o DIR`. Times are those of the machine that
//! measured the group, so a comparison within a group is always one of the same machine.
//!
//! As an array job of Slurm:
//!
//! ```sh
//! #!/bin/sh
//! #SBATCH --array=1-8
//! #SBATCH --gpus-per-task=1
//! #SBATCH --time=04:00:00
//! contrejour report --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" -o "shards/$SLURM_ARRAY_TASK_ID"
//! ```
//!
//! then `contrejour report --merge shards/* -o report`. A task that was stopped is submitted again and goes on.
//!
//! As an indexed job of Kubernetes, with a volume that all pods see; its indices count from 0:
//!
//! ```yaml
//! apiVersion: batch/v1
//! kind: Job
//! metadata:
//!   name: contrejour-report
//! spec:
//!   completionMode: Indexed
//!   completions: 8
//!   parallelism: 8
//!   template:
//!     spec:
//!       restartPolicy: OnFailure
//!       containers:
//!         - name: report
//!           image: contrejour
//!           command: ["sh", "-c"]
//!           args:
//!             - N=$((JOB_COMPLETION_INDEX + 1));
//!               exec contrejour report --shard "$N/8" -o "/shards/$N"
//!           resources:
//!             limits:
//!               nvidia.com/gpu: 1
//!           volumeMounts:
//!             - name: shards
//!               mountPath: /shards
//!       volumes:
//!         - name: shards
//!           persistentVolumeClaim:
//!             claimName: contrejour-shards
//! ```

mod arena;
mod check;
mod contestants;
mod effort;
mod error;
mod event;
mod figures;
mod folder;
mod group;
mod lab;
mod manifest;
mod measure;
mod merge;
mod options;
mod pilot;
mod shard;
mod subject;
mod timing;
mod truth;
mod truth_file;

pub use contestants::{Entrant, EntrantsError, entrants};
pub use effort::Effort;
pub use error::RunError;
pub use event::Event;
pub use measure::run;
pub use merge::{MergeError, merge};
pub use options::{FULL_SIZES, QUICK_SCENES, QUICK_SIZES, RunOptions, default_sizes};
pub use shard::{NoShard, Shard};
pub use subject::NamedScene;
pub(crate) use subject::Subject;
pub(crate) use truth::is_fair;

//! What a run is to measure: written first, so that a later run and a merge know what belongs together.

use std::collections::HashSet;

use serde::{Deserialize, Serialize};

use super::arena::has_flip;
use super::effort::Effort;
use super::error::RunError;
use super::folder::plain;
use super::options::RunOptions;
use super::shard::Shard;
use crate::report::Header;

/// What a run is to measure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Manifest {
    pub header: Header,
    pub effort: Effort,
    pub scenes: Vec<ManifestScene>,
    pub sizes: Vec<u32>,
    pub techniques: Vec<String>,
    /// Number of the shard, and how many there are.
    pub shard: [usize; 2],
    /// Whether the build compares pictures by FLIP.
    pub has_flip: bool,
}

/// A scene, and a number that changes with it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct ManifestScene {
    pub name: String,
    pub fingerprint: u64,
}

/// One scene at one map size, to be measured.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Work {
    /// Index of the scene.
    pub scene: usize,
    /// Its name.
    pub name: String,
    pub map_size: u32,
}

impl Manifest {
    pub fn new(options: &RunOptions) -> Result<Self, RunError> {
        if options.scenes.is_empty() {
            return Err(RunError::Nothing { what: "scene" });
        }
        if options.sizes.is_empty() {
            return Err(RunError::Nothing { what: "map size" });
        }
        let mut known = HashSet::new();
        let names = options.scenes.iter().map(|scene| plain(&scene.name));
        for what in names.chain(options.sizes.iter().map(|size| format!("size {size}"))) {
            if !known.insert(what.clone()) {
                return Err(RunError::Twice { what });
            }
        }
        let scene =
            |named: &super::NamedScene| ManifestScene { name: named.name.clone(), fingerprint: named.fingerprint() };
        Ok(Self {
            header: options.header(),
            effort: options.effort,
            scenes: options.scenes.iter().map(scene).collect(),
            sizes: options.sizes.clone(),
            techniques: options.techniques.clone(),
            shard: [options.shard.number(), options.shard.of()],
            has_flip: has_flip(),
        })
    }

    /// All groups of all shards, a scene after the other.
    pub fn all_work(&self) -> Vec<Work> {
        let of_scene = |(scene, ManifestScene { name, .. }): (usize, &ManifestScene)| {
            let name = name.clone();
            self.sizes.iter().map(move |&map_size| Work { scene, name: name.clone(), map_size })
        };
        self.scenes.iter().enumerate().flat_map(of_scene).collect()
    }

    /// The groups of its shard.
    pub fn work(&self) -> Vec<Work> {
        let numbered = self.all_work().into_iter().enumerate();
        numbered.filter(|(place, _)| self.does(*place)).map(|(_, work)| work).collect()
    }

    /// Whether a group is its shard's, by the group's place in all work. A map size is dealt after the other, so that
    /// each shard with several groups has several sizes: the largest maps take the longest.
    pub fn does(&self, place: usize) -> bool {
        let (scene, size) = (place / self.sizes.len(), place % self.sizes.len());
        self.shard().does(size * self.scenes.len() + scene)
    }

    /// Its shard. Papers' figures are made by the first one.
    pub fn shard(&self) -> Shard {
        let [number, of] = self.shard;
        Shard::new(number, of).unwrap_or(Shard::WHOLE)
    }

    /// What differs from another run of the same command; none where both fit together but for their shards.
    pub fn difference(&self, other: &Self) -> Option<&'static str> {
        let Header { version, seed, .. } = &self.header;
        [
            (*version != other.header.version, "version of contrejour"),
            (self.has_flip != other.has_flip, "build of contrejour (with or without FLIP)"),
            (*seed != other.header.seed, "seed"),
            (self.effort != other.effort, "extent (--quick or not) or picture size"),
            (self.scenes != other.scenes, "scene"),
            (self.sizes != other.sizes, "list of map sizes"),
            (self.techniques != other.techniques, "list of techniques"),
        ]
        .into_iter()
        .find_map(|(differs, what)| differs.then_some(what))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A manifest of two scenes at three sizes.
    pub fn sample(number: usize, of: usize) -> Manifest {
        let effort = Effort::QUICK;
        let header = Header {
            command: "contrejour report".into(),
            version: "0.1.0".into(),
            extent: effort.extent,
            seed: 7,
            picture_size: effort.picture_size,
            truth_samples_max: 1024,
            truth_target_error: 0.004,
            groups_asked: 6,
            shard: None,
        };
        let scenes = ["square", "boxes"].map(|name| ManifestScene { name: name.into(), fingerprint: 5 }).to_vec();
        let sizes = vec![256, 512, 1024];
        Manifest { header, effort, scenes, sizes, techniques: vec![], shard: [number, of], has_flip: has_flip() }
    }

    #[test]
    fn shards_deal_all_groups_once() {
        let whole = sample(1, 1).work();
        assert_eq!(whole, sample(2, 5).all_work());
        for of in 1..=7 {
            let dealt: Vec<Work> = (1..=of).flat_map(|number| sample(number, of).work()).collect();
            let unique: HashSet<_> = dealt.iter().cloned().collect();
            assert_eq!((dealt.len(), unique), (6, whole.iter().cloned().collect()), "{of} shards");
        }
    }

    #[test]
    fn no_shard_has_one_size_only() {
        for (scenes, sizes) in [(1, 4), (2, 3), (2, 4), (5, 4), (6, 2)] {
            let mut run = sample(1, 1);
            run.scenes = (0..scenes).map(|scene| ManifestScene { name: format!("{scene}"), fingerprint: 5 }).collect();
            run.sizes = (0..sizes).map(|size| 256 << size).collect();
            for of in 1..=scenes * sizes {
                for number in 1..=of {
                    run.shard = [number, of];
                    let work = run.work();
                    let unlike: HashSet<u32> = work.iter().map(|work| work.map_size).collect();
                    let expected = work.len().min(2);
                    assert!(unlike.len() >= expected, "{scenes} scenes, {sizes} sizes, {number}/{of}: {work:?}");
                }
            }
        }
    }

    #[test]
    fn what_differs_is_named_and_command_and_shard_may() {
        let one = sample(1, 2);
        let mut other = sample(2, 2);
        other.header.command = "contrejour report --seed 7".into();
        assert_eq!(one.difference(&other), None);
        other.header.seed = 8;
        assert_eq!(one.difference(&other), Some("seed"));
        let mut edited = sample(1, 2);
        edited.scenes[1].fingerprint += 1;
        assert_eq!(one.difference(&edited), Some("scene"));
        let mut rebuilt = sample(1, 2);
        rebuilt.has_flip = !rebuilt.has_flip;
        assert_eq!(one.difference(&rebuilt), Some("build of contrejour (with or without FLIP)"));
    }
}

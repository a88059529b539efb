//! The truth on disk, so that a run that goes on, other sizes and other techniques need not trace it again.

use std::path::Path;

use contrejour_mesh::read_file;
use contrejour_render::save_file;
use serde::{Deserialize, Serialize};

use super::effort::Effort;
use super::error::RunError;
use super::truth::SceneTruth;

/// What a truth depends on. A file with another key is traced again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct TruthKey {
    pub scene_fingerprint: u64,
    pub receivers_fingerprint: u64,
    pub seed: u64,
    pub picture_size: [u32; 2],
    pub truth_samples: u32,
    pub truth_target_error: f64,
    pub motion_steps: u32,
    pub motion_samples: u32,
}

impl TruthKey {
    pub fn new(scene_fingerprint: u64, receivers_fingerprint: u64, seed: u64, effort: &Effort) -> Self {
        let &Effort { picture_size, truth_samples, truth_target_error, motion_steps, motion_samples, .. } = effort;
        Self {
            scene_fingerprint,
            receivers_fingerprint,
            seed,
            picture_size,
            truth_samples,
            truth_target_error,
            motion_steps,
            motion_samples,
        }
    }
}

/// Room for the line with the key, which has some 300 bytes.
const MAX_KEY_BYTES: u64 = 4096;

impl SceneTruth {
    /// Writes it: a line of JSON with the key, then a plane of little-endian 32-bit floats for each of its parts.
    pub fn save(&self, key: &TruthKey, path: &Path) -> Result<(), RunError> {
        let mut bytes = serde_json::to_vec(key)?;
        bytes.push(b'\n');
        let masks = [&self.compared, &self.motion_compared]
            .map(|mask| mask.iter().map(|&holds| f32::from(u8::from(holds))).collect::<Vec<_>>());
        let planes = [&self.visibility, &self.standard_error, &self.samples, &masks[0], &masks[1]];
        for value in planes.into_iter().chain(&self.motion).flatten() {
            bytes.extend(value.to_le_bytes());
        }
        Ok(save_file(&bytes, path)?)
    }

    /// Reads it; none where there is no such file or its key is another.
    pub fn load(key: &TruthKey, path: &Path) -> Option<Self> {
        let pixels = key.picture_size.map(|side| side as usize).iter().product::<usize>();
        let planes = 6 + key.motion_steps as usize;
        let most = MAX_KEY_BYTES + (size_of::<f32>() * pixels * planes) as u64;
        let bytes = read_file(path, most).ok()?;
        let end = bytes.iter().position(|&byte| byte == b'\n')?;
        let kept: TruthKey = serde_json::from_slice(&bytes[..end]).ok()?;
        let values = &bytes[end + 1..];
        if kept != *key || values.len() != size_of::<f32>() * pixels * planes {
            return None;
        }
        let values: Vec<f32> = values.as_chunks().0.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect();
        let mut planes = values.chunks_exact(pixels).map(<[f32]>::to_vec);
        let [visibility, standard_error, samples] = [planes.next()?, planes.next()?, planes.next()?];
        let [compared, motion_compared] =
            [planes.next()?, planes.next()?].map(|mask| mask.into_iter().map(|value| value != 0.0).collect());
        Some(Self { visibility, standard_error, samples, compared, motion: planes.collect(), motion_compared })
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_truth_reads_back_under_its_own_key_only() {
        let effort = Effort { picture_size: [2, 1], motion_steps: 1, ..Effort::QUICK };
        let key = TruthKey::new(1, u64::MAX, 3, &effort);
        let truth = SceneTruth {
            visibility: vec![0.1, 1.0 / 3.0],
            standard_error: vec![0.0, 1e-7],
            samples: vec![128.0, 1024.0],
            compared: vec![true, false],
            motion: vec![vec![0.5, 0.25], vec![0.75, 0.125]],
            motion_compared: vec![false, true],
        };
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let path = folder.path().join("truth/square.bin");
        assert_eq!(SceneTruth::load(&key, &path), None);
        truth.save(&key, &path).expect("it can be written");
        assert_eq!(SceneTruth::load(&key, &path), Some(truth));
        let others = [TruthKey { seed: 4, ..key.clone() }, TruthKey { truth_target_error: 0.1, ..key.clone() }];
        assert!(others.iter().all(|other| SceneTruth::load(other, &path).is_none()));
        let bytes = fs::read(&path).expect("it is there");
        fs::write(&path, &bytes[..bytes.len() - 1]).expect("it can be written");
        assert_eq!(SceneTruth::load(&key, &path), None, "what was cut off is traced again");
    }
}

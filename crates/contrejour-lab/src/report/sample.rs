//! Made-up reports for tests.

use super::{Contestant, Cost, Errors, Extent, Group, Header, Machine, Parameter, Report, StageCost, Truth};
use crate::metrics::{ErrorFigures, MotionExcess, Timing, UmbraArea};

/// A report of the given groups, settled.
pub fn report(groups: Vec<Group>) -> Report {
    let header = Header {
        command: "contrejour report --quick -o report".into(),
        version: "0.1.0".into(),
        extent: Extent::Quick,
        seed: 7,
        picture_size: [320, 240],
        truth_samples_max: 1024,
        truth_target_error: 0.004,
        groups_asked: groups.len(),
        shard: None,
    };
    let mut report = Report { header, groups, figures: Vec::new() };
    report.settle();
    report
}

/// A group whose truth is exact to 0.001, not settled.
pub fn group(scene: &str, map_size: u32, contestants: Vec<Contestant>) -> Group {
    Group {
        scene: scene.into(),
        map_size,
        faces: 130_000,
        edges: 195_000,
        light_size: 0.25,
        machine: Machine { device: "Sample device (Vulkan)".into(), is_software: false, cores: 8 },
        truth: Truth { samples_mean: 512.0, standard_error_rms: 0.001, standard_error_max: 0.004 },
        truth_picture: None,
        contestants,
    }
}

/// A contestant with an RMSE and a time, spread by 10 % each way; everything else follows from them.
pub fn contestant(label: &str, family: &str, technique: &str, rmse: f64, time_ms: f64) -> Contestant {
    let figures = |pixels, rmse| ErrorFigures { pixels, rmse, mean_absolute: rmse * 0.3, percentile_99: rmse * 4.0 };
    let timing = |share: f64| Timing {
        median_ms: time_ms * share,
        low_ms: time_ms * share * 0.9,
        high_ms: time_ms * share * 1.1,
        frames: 60,
    };
    Contestant {
        label: label.into(),
        family: family.into(),
        technique: technique.into(),
        parameters: vec![Parameter { name: "strength".into(), value: "1".into() }],
        errors: Errors {
            receivers: figures(60_000, rmse),
            penumbra: Some(figures(9000, rmse * 2.0)),
            umbra: UmbraArea { pixels: 60_000, too_large_pixels: 0, too_small_pixels: 0 },
            flip: Some(rmse * 0.8),
            motion: Some(MotionExcess { steps: 15, mean: rmse * 0.01, percentile_99: rmse * 0.1, largest: rmse }),
        },
        cost: Cost {
            stages: vec![
                StageCost { name: "shadow_map".into(), timing: timing(0.7) },
                StageCost { name: "visibility".into(), timing: timing(0.3) },
            ],
            device: Some(timing(1.0)),
            wall: timing(1.5),
            record: timing(0.1),
            map_bytes: 4 << 20,
            buffer_bytes: 1 << 20,
        },
        picture: None,
        difference: None,
        stands: false,
        on_front: false,
        ratio: None,
    }
}

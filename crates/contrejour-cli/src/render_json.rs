//! What `contrejour render` tells about its frames.

use contrejour_render::Measurements;
use serde::Serialize;

use crate::render::Written;

#[derive(Serialize)]
struct Report<'a> {
    device: &'a str,
    frames: usize,
    frames_in_flight: usize,
    edges: u64,
    silhouette_edges: SilhouetteEdges,
    stages: Vec<Stage<'a>>,
    upload_bytes_per_frame: u64,
    readback_waits: u64,
    cpu_ms_per_frame: f64,
    overflow_frames: u64,
    pictures: Vec<String>,
    views: Vec<View<'a>>,
}

#[derive(Serialize)]
struct SilhouetteEdges {
    min: u32,
    median: u32,
    max: u32,
}

#[derive(Serialize)]
struct Stage<'a> {
    name: &'a str,
    gpu_ms: f64,
}

#[derive(Serialize)]
struct View<'a> {
    path: String,
    legend: &'a str,
}

/// One object, for scripts.
pub fn json(measured: &Measurements, written: &Written) -> Result<String, serde_json::Error> {
    let edges = measured.silhouette_edges;
    serde_json::to_string_pretty(&Report {
        device: &measured.device,
        frames: measured.frames,
        frames_in_flight: measured.frames_in_flight,
        edges: measured.edges,
        silhouette_edges: SilhouetteEdges { min: edges.min, median: edges.median, max: edges.max },
        stages: measured.stages.iter().map(|stage| Stage { name: &stage.name, gpu_ms: stage.gpu_ms }).collect(),
        upload_bytes_per_frame: measured.upload_bytes_per_frame,
        readback_waits: measured.readback_waits,
        cpu_ms_per_frame: measured.cpu_ms_per_frame,
        overflow_frames: measured.overflow_frames,
        pictures: written.pictures.iter().map(|path| path.display().to_string()).collect(),
        views: written.views.iter().map(|(path, legend)| View { path: path.display().to_string(), legend }).collect(),
    })
}

/// A few lines for people; the last is the picture's path, where there is one.
pub fn summary(measured: &Measurements, written: &Written) -> String {
    let edges = measured.silhouette_edges;
    let mut lines = vec![
        format!("device: {}", measured.device),
        // Techniques without smoothies look for no silhouette.
        match edges.max {
            0 => format!("edges: {}", measured.edges),
            _ => format!("edges: {}, in the silhouette: {} to {}", measured.edges, edges.min, edges.max),
        },
    ];
    if written.pictures.is_empty() {
        lines.push(format!("frames: {}, none read back", measured.frames));
        lines.push(format!(
            "CPU: {:.3} ms and {} bytes uploaded a frame",
            measured.cpu_ms_per_frame, measured.upload_bytes_per_frame
        ));
        lines.extend(measured.stages.iter().map(|stage| format!("  {:<20} {:>9.3} ms", stage.name, stage.gpu_ms)));
    }
    if measured.overflow_frames > 0 && written.pictures.is_empty() {
        lines.push(format!("note: {} frames had more quads or corners than room for them", measured.overflow_frames));
    }
    lines.extend(written.views.iter().map(|(path, legend)| format!("{}: {legend}", path.display())));
    lines.extend(written.pictures.last().map(|path| path.display().to_string()));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use contrejour_render::{Spread, StageCost};
    use serde_json::Value;

    fn measured() -> Measurements {
        Measurements {
            device: "a device".into(),
            frames: 120,
            frames_in_flight: 2,
            edges: 18,
            silhouette_edges: Spread { min: 6, median: 7, max: 8 },
            stages: vec![StageCost { name: "classify_faces".into(), gpu_ms: 0.25 }],
            upload_bytes_per_frame: 640,
            readback_waits: 0,
            cpu_ms_per_frame: 0.5,
            cpu_upload_ms: 0.1,
            cpu_record_ms: 0.3,
            cpu_submit_ms: 0.1,
            overflow_frames: 1,
        }
    }

    #[test]
    fn the_object_has_the_keys_that_scripts_rely_on() {
        let text = json(&measured(), &Written::default()).expect("numbers can be written");
        let value: Value = serde_json::from_str(&text).expect("it is JSON");
        assert_eq!(value["device"], "a device");
        assert_eq!(value["frames"], 120);
        assert_eq!(value["edges"], 18);
        assert_eq!(value["silhouette_edges"], serde_json::json!({ "min": 6, "median": 7, "max": 8 }));
        assert_eq!(value["stages"], serde_json::json!([{ "name": "classify_faces", "gpu_ms": 0.25 }]));
        assert_eq!(value["upload_bytes_per_frame"], 640);
        assert_eq!(value["readback_waits"], 0);
        assert_eq!(value["cpu_ms_per_frame"], 0.5);
        assert_eq!(value["overflow_frames"], 1);
    }

    #[test]
    fn the_last_line_is_the_picture() {
        let written = Written { pictures: vec!["a.png".into(), "b.png".into()], views: vec![] };
        assert_eq!(summary(&measured(), &written).lines().last(), Some("b.png"));
    }
}

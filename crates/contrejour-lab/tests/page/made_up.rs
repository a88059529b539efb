//! Made-up visibilities: a round shadow, its penumbra and what techniques would do to it, measured by the real metrics.

use std::path::Path;

use contrejour_lab::metrics::{Timing, error_figures, motion_excess, penumbra_mask, power_law, umbra_area};
use contrejour_lab::report::{
    Axis, Body, Contestant, Cost, Errors, Extent, Figure, GridRow, Group, Header, Machine, Parameter, Picture,
    PictureGrid, Plot, Report, Scale, Series, StageCost, Stroke, Table, Truth, difference_picture, visibility_picture,
};

const SIZE: [u32; 2] = [200, 150];

/// Scene, radius of its shadow and of its penumbra.
const SCENES: [(&str, f32, f32); 4] =
    [("square", 0.6, 0.5), ("cylinder", 0.5, 0.15), ("fence", 0.3, 0.06), ("elephant", 0.7, 0.25)];

/// How a made-up technique draws the edge of a shadow of radius 1 and penumbra 1.
struct MadeUp {
    label: &'static str,
    family: &'static str,
    technique: &'static str,
    /// How far the middle of its penumbra lies outside the true one, in penumbra radii.
    offset: f32,
    /// Width of its penumbra over the true one.
    width: f32,
    /// Time at 1024 texels in milliseconds.
    time_ms: f64,
    stages: &'static [&'static str],
}

const MAP: &[&str] = &["shadow_map", "visibility"];
const MIPS: &[&str] = &["shadow_map", "blur_map", "visibility"];
const SMOOTHIES: &[&str] = &[
    "classify_faces",
    "detect_silhouette",
    "extrude_edges",
    "build_corners",
    "shadow_map",
    "smoothie_buffer",
    "visibility",
];

const TECHNIQUES: [MadeUp; 11] = [
    made_up("shadow map", "shadow map", "shadow-map", 0.0, 0.01, 0.41, MAP),
    made_up("PCF 2x2", "PCF 2x2", "pcf", 0.0, 0.05, 0.44, MAP),
    made_up("bicubic PCF", "bicubic PCF", "pcf-bicubic", 0.0, 0.2, 0.62, MAP),
    made_up("PCSS 8+8, light 0.5", "PCSS 8+8", "pcss", 0.05, 0.5, 0.93, MAP),
    made_up("PCSS 8+8, light 1", "PCSS 8+8", "pcss", 0.05, 0.9, 0.98, MAP),
    made_up("PCSS 16+32, light 1", "PCSS 16+32", "pcss", 0.02, 0.95, 1.71, MAP),
    made_up("EVSM, blur 4", "EVSM", "evsm", -0.1, 0.4, 0.79, MIPS),
    made_up("EVSM, blur 8", "EVSM", "evsm", -0.2, 0.7, 0.88, MIPS),
    made_up("smoothies t = 0.02", "smoothies t = 0.02", "smoothies", 0.15, 0.15, 0.58, SMOOTHIES),
    made_up("smoothies t = 0.08", "smoothies t = 0.08", "smoothies", 0.6, 0.6, 0.66, SMOOTHIES),
    made_up("smoothies, light's size", "smoothies from the light's size", "smoothies", 0.5, 0.5, 0.63, SMOOTHIES),
];

const fn made_up(
    label: &'static str,
    family: &'static str,
    technique: &'static str,
    offset: f32,
    width: f32,
    time_ms: f64,
    stages: &'static [&'static str],
) -> MadeUp {
    MadeUp { label, family, technique, offset, width, time_ms, stages }
}

/// A report with every part of the page; its pictures are written below the folder.
pub fn report(folder: &Path) -> Report {
    std::fs::create_dir_all(folder.join("pictures")).expect("the folder can be made");
    let groups = SCENES.iter().flat_map(|&scene| [512, 1024, 2048].map(|map_size| group(scene, map_size, folder)));
    let mut report = Report {
        header: Header {
            command: "contrejour report --quick --sizes 512,1024,2048 -o sample-report".into(),
            version: "0.1.0".into(),
            extent: Extent::Quick,
            seed: 1,
            picture_size: SIZE,
            truth_samples_max: 4096,
            truth_target_error: 0.002,
            groups_asked: 3 * SCENES.len(),
            shard: None,
        },
        groups: groups.collect(),
        figures: figures(),
    };
    report.settle();
    report
}

fn group((scene, radius, penumbra): (&str, f32, f32), map_size: u32, folder: &Path) -> Group {
    let receivers = receivers();
    let truth = shadow(0.0, radius, penumbra);
    let truth_picture = format!("pictures/{scene}-truth.png");
    visibility_picture(SIZE, &truth, &receivers)
        .expect("the sizes agree")
        .save(folder.join(&truth_picture))
        .expect("saved");
    let contestants = TECHNIQUES
        .iter()
        .map(|made_up| contestant(made_up, (scene, radius, penumbra), map_size, &truth, &receivers, folder));
    Group {
        scene: scene.into(),
        map_size,
        faces: 4 * 32_768,
        edges: 6 * 32_768,
        light_size: 0.25,
        machine: Machine { device: "A made-up device (no driver)".into(), is_software: true, cores: 2 },
        truth: Truth { samples_mean: 812.0, standard_error_rms: 0.0012, standard_error_max: 0.002 },
        truth_picture: Some(truth_picture),
        contestants: contestants.collect(),
    }
}

fn contestant(
    made_up: &MadeUp,
    (scene, radius, penumbra): (&str, f32, f32),
    map_size: u32,
    truth: &[f32],
    receivers: &[bool],
    folder: &Path,
) -> Contestant {
    // Coarse maps shift edges a little.
    let texel = 2.0 / map_size as f32;
    let drawn = |shift: f32| shadow(shift, radius + made_up.offset * penumbra + 4.0 * texel, penumbra * made_up.width);
    let visibility = drawn(0.0);
    // The page shows the pictures of one size.
    let [picture, difference] = ["", "-difference"].map(|what| {
        let name = made_up.label.replace([' ', '\''], "-");
        (map_size == 1024).then(|| format!("pictures/{scene}-{map_size}-{name}{what}.png"))
    });
    if let [Some(picture), Some(difference)] = [&picture, &difference] {
        let drawn = visibility_picture(SIZE, &visibility, receivers).expect("the sizes agree");
        drawn.save(folder.join(picture)).expect("saved");
        let drawn = difference_picture(SIZE, truth, &visibility, receivers).expect("the sizes agree");
        drawn.save(folder.join(difference)).expect("saved");
    }

    let steps = [0.0, 0.01, 0.02];
    let true_frames = steps.map(|shift| shadow(shift, radius, penumbra));
    // Moving in steps of two makes every other one too large.
    let frames = [0.0, 0.0, 0.02].map(drawn);
    let mask = penumbra_mask(truth, &vec![0.001; truth.len()], receivers).expect("the sizes agree");
    let sound = "the input is sound";
    Contestant {
        label: made_up.label.into(),
        family: made_up.family.into(),
        technique: made_up.technique.into(),
        parameters: vec![Parameter { name: "width".into(), value: made_up.width.to_string() }],
        errors: Errors {
            receivers: error_figures(truth, &visibility, receivers).expect(sound).expect("there are receivers"),
            penumbra: error_figures(truth, &visibility, &mask).expect(sound),
            umbra: umbra_area(truth, &visibility, receivers).expect(sound).expect("there are receivers"),
            flip: Some(0.03),
            motion: motion_excess(&true_frames, &frames, receivers).expect(sound),
        },
        cost: cost(made_up, map_size),
        picture,
        difference,
        stands: false,
        on_front: false,
        ratio: None,
    }
}

fn cost(made_up: &MadeUp, map_size: u32) -> Cost {
    let time_ms = made_up.time_ms * (0.6 + 0.4 * f64::from(map_size) / 1024.0);
    let timing = |share: f64| {
        let samples: Vec<f64> = (0..60).map(|frame| share * time_ms * (1.0 + 0.001 * f64::from(frame % 13))).collect();
        Timing::from_samples(&samples).expect("these are times")
    };
    let share = 1.0 / made_up.stages.len() as f64;
    Cost {
        stages: made_up.stages.iter().map(|&name| StageCost { name: name.into(), timing: timing(share) }).collect(),
        device: Some(timing(1.0)),
        wall: timing(1.3),
        record: timing(0.1),
        map_bytes: u64::from(map_size) * u64::from(map_size) * if made_up.stages.len() > 2 { 12 } else { 4 },
        buffer_bytes: made_up.stages.len() as u64 * 300_000,
    }
}

/// Everything but the upper corners receives.
fn receivers() -> Vec<bool> {
    places().map(|[x, y]| y > -0.9 + 0.3 * x.abs()).collect()
}

/// Visibility around a round blocker that has moved to the right.
fn shadow(shift: f32, radius: f32, penumbra: f32) -> Vec<f32> {
    let edge = |distance: f32| ((distance - radius) / penumbra.max(1e-3) * 0.5 + 0.5).clamp(0.0, 1.0);
    places().map(|[x, y]| edge((x - shift).hypot(y))).map(|t| t * t * (3.0 - 2.0 * t)).collect()
}

/// Middles of the pixels, the height being 2.
fn places() -> impl Iterator<Item = [f32; 2]> {
    let [width, height] = SIZE;
    let unit = 2.0 / height as f32;
    let place = move |i: u32, count: u32| (i as f32 + 0.5 - count as f32 / 2.0) * unit;
    (0..height).flat_map(move |y| (0..width).map(move |x| [place(x, width), place(y, height)]))
}

/// One figure of each kind.
fn figures() -> Vec<Figure> {
    let texts = |cells: &[&str]| cells.iter().map(|&cell| cell.to_owned()).collect::<Vec<_>>();
    let table = Table {
        columns: texts(&["Technique", "256, theirs", "256, here", "1024, theirs", "1024, here"]),
        rows: vec![
            texts(&["shadow map", "1.00×", "1.00×", "1.00×", "1.00×"]),
            texts(&["bicubic PCF", "8.06×", "1.51×", "8.35×", "1.55×"]),
            texts(&["smoothies t = 0.02", "1.19×", "1.41×", "1.29×", "1.46×"]),
        ],
    };
    let measured: Vec<[f64; 2]> = [1e3, 1e4, 1e5, 1e6].map(|edges: f64| [edges, 2e-3 * edges.powf(0.62)]).to_vec();
    let law = power_law(&measured).expect("there is a law");
    let plot = Plot {
        x: Axis { label: "edges".into(), scale: Scale::Log },
        y: Axis { label: "time in ms".into(), scale: Scale::Log },
        series: vec![
            Series { label: "GPU".into(), points: measured, stroke: Stroke::Marks },
            Series {
                label: format!("fit: edges^{:.2}", law.exponent),
                points: [1e3, 1e6].map(|edges| [edges, law.at(edges)]).to_vec(),
                stroke: Stroke::Dashed,
            },
            Series {
                label: "ordered map".into(),
                points: [1e3, 1e4, 1e5, 1e6].map(|edges| [edges, 3e-4 * edges]).to_vec(),
                stroke: Stroke::Line,
            },
        ],
    };
    let picture = |scene: &str, label: &str| {
        let path = format!("pictures/{scene}-1024-{label}.png");
        Some(Picture { path, alt: format!("{scene}, {label}") })
    };
    let grid = PictureGrid {
        columns: texts(&["shadow map", "bicubic PCF", "smoothies t = 0.08"]),
        rows: ["cylinder", "fence"]
            .map(|scene| GridRow {
                label: scene.into(),
                cells: vec![
                    picture(scene, "shadow-map"),
                    picture(scene, "bicubic-PCF"),
                    picture(scene, "smoothies-t-=-0.08"),
                ],
            })
            .to_vec(),
    };
    let figure = |title: &str, caption: &str, body| Figure { title: title.into(), caption: caption.into(), body };
    vec![
        figure(
            "(a) Times of the cylinder scene",
            "Redoes a table of Chan and Durand (2003), as ratios.",
            Body::Table(table),
        ),
        figure("(b) Time to find silhouettes", "Medians of 60 frames.", Body::Plot(plot)),
        figure("(d) Cylinder and fence", "Resolutions across methods.", Body::Pictures(grid)),
    ]
}

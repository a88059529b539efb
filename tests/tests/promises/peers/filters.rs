//! Percentage-closer filters, texel for texel: each against the sum that its literature writes, over the map it looked into.

use contrejour_plan::{ShadowSettings, views};
use contrejour_render::read_texture;
use contrejour_tests::harness::Outcome;
use glam::DVec2;

use super::judged_scene::{JudgedScene, plates, rmse, settings, text_of};

/// Texels so large that most receivers near a shadow's edge lie between blocking and free ones.
const MAP_SIZE: u32 = 64;

/// Samplers place a look-up to a 256th of a texel along each axis, and each axis alone can turn dark to lit.
const MOST_BY_SAMPLERS: f64 = 2.0 / 256.0;

/// Gathered comparisons are weighed by the shader itself, in 32 bits.
const MOST_BY_SHADERS: f64 = 1e-4;

/// How a filter weighs the texels around a receiver, along one axis.
#[derive(Clone, Copy)]
enum Weights {
    /// A kernel of texels, moved by the share of a texel.
    Kernel(&'static [f64]),
    /// The uniform cubic B-spline.
    CubicSpline,
}

/// What a reference may be held to have wrong.
#[derive(Clone, Copy, PartialEq)]
enum Fault {
    None,
    MirroredColumns,
    MirroredRows,
    SwappedRows,
    HalfTexelAside,
    HalfTexelDown,
}

const FAULTS: [Fault; 5] =
    [Fault::MirroredColumns, Fault::MirroredRows, Fault::SwappedRows, Fault::HalfTexelAside, Fault::HalfTexelDown];

pub fn filters_are_their_sums() -> Outcome {
    let mut scene = plates(&[("[1.4, 1.2]", "[0.1, 1.6, 0]")])?;
    scene.keep_floor();
    let kernel = |texels: f64| settings("gaussian-pcf", &[("kernel", texels)], MAP_SIZE);
    let filters = [
        ("pcf", settings("pcf", &[], MAP_SIZE), Weights::Kernel(&[1.0]), MOST_BY_SAMPLERS),
        ("gaussian-pcf 3", kernel(3.0), Weights::Kernel(&[1.0, 2.0, 1.0]), MOST_BY_SAMPLERS),
        ("gaussian-pcf 5", kernel(5.0), Weights::Kernel(&[1.0, 3.0, 4.0, 3.0, 1.0]), MOST_BY_SAMPLERS),
        ("gaussian-pcf 7", kernel(7.0), Weights::Kernel(&[1.0, 5.0, 12.0, 16.0, 12.0, 5.0, 1.0]), MOST_BY_SAMPLERS),
        ("bicubic-pcf", settings("bicubic-pcf", &[], MAP_SIZE), Weights::CubicSpline, MOST_BY_SHADERS),
    ];
    for (name, filter, weights, most) in filters {
        let drawn = Drawn::new(&scene, filter)?;
        near(most, &drawn, weights, Fault::None).map_err(|error| format!("{name}: {error}"))?;
        for fault in FAULTS {
            if near(most, &drawn, weights, fault).is_ok() {
                return Err(format!("{name}: fault {} of the sum passes", fault as u32));
            }
        }
    }
    Ok(())
}

/// The same everywhere, and far nearer in the mean.
fn near(most: f64, drawn: &Drawn, weights: Weights, fault: Fault) -> Outcome {
    let wanted = drawn.wanted(weights, fault);
    let furthest = drawn.found.iter().zip(&wanted).map(|(found, wanted)| (found - wanted).abs()).fold(0.0, f64::max);
    let error = rmse(&drawn.found, &wanted);
    println!("most {furthest:.6}, RMSE {error:.6}, fault {}", fault as u32);
    // Positive, so that NaN is no success.
    if furthest <= most && error <= most / 4.0 {
        return Ok(());
    }
    Err(format!("{furthest:.5} off at most, {error:.5} in the mean"))
}

/// What a filter made of the floor, and the texels that it compared.
struct Drawn {
    found: Vec<f64>,
    /// Where the receivers fall on the map, in texels from the middle of the first.
    places: Vec<DVec2>,
    /// Whether the floor sees the light past a texel: 1 or 0.
    seen: Vec<f64>,
}

impl Drawn {
    fn new(scene: &JudgedScene, mut filter: ShadowSettings) -> Result<Self, String> {
        // Receivers that are moved look elsewhere.
        filter.bias.normal_texels = 0.0;
        let (found, contestant) = scene.drawn(&filter)?;
        let map = contestant.maps().shadow_hardware_depth.ok_or("filters compare with hardware depth")?;
        let depths: Vec<f32> = bytemuck::pod_collect_to_vec(&read_texture(scene.gpu(), map, 4).map_err(text_of)?);

        let view = views(scene.light()).map_err(text_of)?[0];
        let clip: Vec<_> =
            scene.receivers().map(|receiver| view.light_clip_from_world.project_point3(receiver.position)).collect();
        // The floor has one depth and the plate another: whatever is nearer than their middle blocks.
        let floor = clip.first().ok_or("the camera sees no floor")?.z;
        let plate = f64::from(depths.iter().copied().fold(1.0, f32::min));
        let seen =
            depths.iter().map(|depth| if f64::from(*depth) < 0.5 * (plate + floor) { 0.0 } else { 1.0 }).collect();
        let size = f64::from(MAP_SIZE);
        let places = clip.iter().map(|clip| (0.5 + 0.5 * DVec2::new(clip.x, -clip.y)) * size - 0.5).collect();
        Ok(Self { found, places, seen })
    }

    fn wanted(&self, weights: Weights, fault: Fault) -> Vec<f64> {
        self.places.iter().map(|place| self.sum(*place, weights, fault)).collect()
    }

    /// The share of the texels around a place that the light is seen past, weighed.
    fn sum(&self, place: DVec2, weights: Weights, fault: Fault) -> f64 {
        let place = match fault {
            Fault::HalfTexelAside => place + DVec2::new(0.5, 0.0),
            Fault::HalfTexelDown => place + DVec2::new(0.0, 0.5),
            _ => place,
        };
        let share = place - place.floor();
        let columns = weights.at(if fault == Fault::MirroredColumns { 1.0 - share.x } else { share.x });
        let mut rows = weights.at(if fault == Fault::MirroredRows { 1.0 - share.y } else { share.y });
        if fault == Fault::SwappedRows {
            rows.chunks_exact_mut(2).for_each(|pair| pair.swap(0, 1));
        }
        let first = place.floor() + 1.0 - 0.5 * columns.len() as f64;
        let mut sum = 0.0;
        for (y, row) in (first.y as i64..).zip(&rows) {
            for (x, column) in (first.x as i64..).zip(&columns) {
                let inside = |place: i64| place.clamp(0, i64::from(MAP_SIZE) - 1) as usize;
                sum += row * column * self.seen[inside(y) * MAP_SIZE as usize + inside(x)];
            }
        }
        sum
    }
}

impl Weights {
    /// Weights that add up to 1, of as many texels on either side of a place that lies a share of a texel beyond the
    /// middle of the last one before it.
    fn at(self, share: f64) -> Vec<f64> {
        match self {
            Self::Kernel(kernel) => {
                let sum: f64 = kernel.iter().sum();
                let texel = |index: usize| kernel.get(index).copied().unwrap_or(0.0);
                let moved = |index: usize| if index == 0 { 0.0 } else { texel(index - 1) };
                (0..=kernel.len()).map(|index| ((1.0 - share) * texel(index) + share * moved(index)) / sum).collect()
            }
            Self::CubicSpline => [-1.0, 0.0, 1.0, 2.0].map(|texel| cubic_spline(texel - share)).into(),
        }
    }
}

/// The uniform cubic B-spline about 0.
fn cubic_spline(place: f64) -> f64 {
    let distance = place.abs();
    match () {
        () if distance < 1.0 => 2.0 / 3.0 - distance.powi(2) + 0.5 * distance.powi(3),
        () if distance < 2.0 => (2.0 - distance).powi(3) / 6.0,
        () => 0.0,
    }
}

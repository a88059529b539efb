//! Smoothies of point lights have no seam where two faces of the cube meet.
//!
//! A guard band along each face shows what its neighbour shows, so both can be asked about the same directions. Each face
//! makes smoothies on an image plane of its own; they agree since all show the same sphere, to first order in its radius
//! over the blocker's depth. What is asked is alpha beside triangles that hang across all edges and corners of the cube:
//! by definition from the twins' quads and corners, and on the device. Spots that look through the same faces make
//! smoothies of disks, and there the same checks find the seam.

use contrejour_gpu::ShadowOptions;
use contrejour_plan::{
    AlphaRemap, CubeFace, Light, LightKind, LightOutline, ShadowSettings, SmoothieBlend, SmoothieSettings, Technique,
    View, frame_views, views,
};
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, cpu_trial, gpu_trial};
use contrejour_tests::lights::through;
use contrejour_tests::meshes::TestMesh;
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::random::Random;
use contrejour_tests::soft_edges::alpha;
use contrejour_tests::texture::read_half_floats;
use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};
use libtest_mimic::Trial;

const MAP_SIZE: u32 = 512;

/// Mean difference of alpha between two faces: a third of the light's radius over the blocker's depth, which is a
/// twentieth where that is least. Disks differ by 0.09.
const FACES_MEAN: f64 = 0.018;

/// Mean difference of alpha from what is defined: the triangles of a quad meet at a crease where its ends have different
/// widths, halves are rounded, and so are the corners of triangles: SwiftShader's to 1/16 texel, which makes it 0.0011.
const RASTER_MEAN: f64 = 0.002;

/// A fault makes so many times as much of a difference.
const FAULT: f64 = 4.0;

/// Alpha of neighbouring texels differs by less, but at the outline of a blocker.
const SMOOTH: f64 = 0.3;

pub fn trials() -> Vec<Trial> {
    vec![
        cpu_trial("lamp_borders::faces_agree_by_definition", faces_agree_by_definition),
        gpu_trial("lamp_borders::maps_of_faces_agree", maps_of_faces_agree),
        gpu_trial("lamp_borders::maps_are_as_defined", maps_are_as_defined),
    ]
}

const RADIUS: f64 = 0.06;
const NEAR: f64 = 0.6;
const FAR: f64 = 20.0;

fn settings(remap: AlphaRemap) -> ShadowSettings {
    let smoothies = SmoothieSettings { remap, blend: SmoothieBlend::TwoPasses, ..Default::default() };
    ShadowSettings { technique: Technique::Smoothies(smoothies), map_size: MAP_SIZE, ..Default::default() }
}

fn lamp() -> (Light, Vec<View>) {
    let kind = LightKind::Point { position: DVec3::ZERO, radius: RADIUS, near: NEAR, far: FAR };
    let light = Light { kind, color: [1.0; 3] };
    let views = frame_views(&light, None, &settings(AlphaRemap::Contact)).expect("a good lamp").views;
    (light, views)
}

/// A spot that looks through a view of the lamp.
fn spot(view: &View) -> (Light, View) {
    let light = through(view, RADIUS);
    (light, views(&light).expect("a good spot")[0])
}

/// Triangles at the distance 2 across the middles of the cube's edges and its corners, none before another one.
fn triangles() -> TestMesh {
    let mut random = Random::new(3);
    let mut positions = Vec::new();
    for index in 0..27 {
        let direction = DVec3::new(f64::from(index % 3), f64::from(index / 3 % 3), f64::from(index / 9)) - 1.0;
        if direction.length_squared() > 1.5 {
            let mut corner = || 0.45 * DVec3::new(random.signed(), random.signed(), random.signed());
            let middle = 2.0 * direction.normalize();
            positions.extend([middle + corner(), middle + corner(), middle + corner()].map(|corner| corner.as_vec3()));
        }
    }
    let faces: Vec<_> =
        (0..positions.len() as u32 / 3).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]).collect();
    let positions: Vec<_> = positions.into_iter().map(|position| position.to_array()).collect();
    TestMesh::generated("triangles", &positions, &faces)
}

/// The place of a world direction on a view's image plane, where that shows it some texels from its sides.
fn place_ndc(view: &View, direction: DVec3) -> Option<DVec2> {
    let clip = view.light_clip_from_world * direction.extend(1.0);
    let place = clip.xy() / clip.w;
    (clip.w > 0.0 && place.abs().max_element() < 1.0 - 8.0 / f64::from(MAP_SIZE)).then_some(place)
}

/// Directions to the texels of a view.
fn directions(view: &View) -> impl Iterator<Item = DVec3> {
    let world_from_clip = view.light_clip_from_world.inverse();
    (0..MAP_SIZE * MAP_SIZE).map(move |index| {
        let texel = [index % MAP_SIZE, index / MAP_SIZE];
        let [x, y] = texel.map(|texel| (f64::from(texel) + 0.5) / f64::from(MAP_SIZE) * 2.0 - 1.0);
        let world = world_from_clip * DVec4::new(x, -y, 0.5, 1.0);
        (world.xyz() / world.w).normalize()
    })
}

/// Mean over what two views show of the same directions, and of how many.
#[derive(Clone, Copy, Debug, Default)]
struct Difference {
    sum: f64,
    largest: f64,
    count: u32,
}

impl Difference {
    fn add(&mut self, difference: f64) {
        self.sum += difference;
        self.largest = self.largest.max(difference);
        self.count += 1;
    }

    fn mean(&self) -> f64 {
        self.sum / f64::from(self.count)
    }

    /// Enough to tell, and at most so much.
    fn check(&self, most: f64) -> Outcome {
        eprintln!("mean {}, largest {}, of {}", self.mean(), self.largest, self.count);
        if self.count > 2000 && self.mean() <= most {
            return Ok(());
        }
        Err(format!("a mean of {} of {} differences, {most} is allowed", self.mean(), self.count))
    }
}

/// Passes where the lamp does and spots in its place fail by far.
fn check_both(of_views: impl Fn(&[View]) -> Result<Difference, String>, most: f64) -> Outcome {
    let (_, lamp) = lamp();
    let spots: Vec<_> = lamp.iter().map(|view| spot(view).1).collect();
    of_views(&lamp)?.check(most)?;
    let seam = of_views(&spots)?;
    match seam.check(FAULT * most) {
        Err(_) => Ok(()),
        Ok(()) => Err(format!("the seam between disks is not found: {seam:?}")),
    }
}

/// What the twins make of the triangles for a view.
fn frame(view: &View) -> Frame {
    let mut frame = Frame::of_view(&triangles().parts, view, &settings(AlphaRemap::Contact));
    frame.run_mirrors("place_casters", "write_draw_args");
    frame
}

fn faces_agree_by_definition() -> Outcome {
    check_both(
        |views| {
            let frames: Vec<_> = views.iter().map(frame).collect();
            Ok(difference_of_neighbours(views, 7, |face, place| {
                Some(alpha(&views[face], frames[face].made_quads(), frames[face].made_corners(), place))
            }))
        },
        FACES_MEAN,
    )
}

/// Of every so many directions to texels that two faces show, and beside whose blockers one of them is not lit.
fn difference_of_neighbours(views: &[View], step: usize, alpha_at: impl Fn(usize, DVec2) -> Option<f64>) -> Difference {
    let mut difference = Difference::default();
    for (face, view) in views.iter().enumerate() {
        for direction in directions(view).step_by(step) {
            let other = CubeFace::of(direction).index();
            let Some((here, there)) = place_ndc(view, direction).zip(place_ndc(&views[other], direction)) else {
                continue;
            };
            if let Some((here, there)) = alpha_at(face, here).zip(alpha_at(other, there))
                && other != face
                && here.min(there) < 1.0
            {
                difference.add((here - there).abs());
            }
        }
    }
    difference
}

/// Smoothie alpha on a map.
struct AlphaMap(Vec<f32>);

impl AlphaMap {
    /// The maps of a light's views.
    fn of(gpu: &Gpu, light: &Light, remap: AlphaRemap) -> Result<Vec<Self>, String> {
        let options = ShadowOptions { settings: settings(remap), ..Default::default() };
        let mut pipeline = Pipeline::new(gpu, &triangles(), &options)?;
        pipeline.complete_frame(light)?;
        let texels = read_half_floats(gpu, pipeline.maps().smoothie_alpha.ok_or("there is no map of alpha")?);
        Ok(texels.chunks((MAP_SIZE * MAP_SIZE) as usize).map(|texels| Self(texels.to_vec())).collect())
    }

    fn texel(&self, [x, y]: [u32; 2]) -> f64 {
        self.0[(y * MAP_SIZE + x) as usize].into()
    }

    /// Between the four nearest texels; none where one of them may be a blocker's.
    fn at(&self, place_ndc: DVec2) -> Option<f64> {
        let place = (0.5 + 0.5 * place_ndc * DVec2::new(1.0, -1.0)) * f64::from(MAP_SIZE) - 0.5;
        let (first, share) = (place.floor(), place.fract());
        let [[x, y], sides] = [[first.x as u32, first.y as u32], [0, 1]];
        let rows = sides.map(|down| sides.map(|right| self.texel([x + right, y + down])));
        let (least, most) = rows
            .as_flattened()
            .iter()
            .fold((1.0_f64, 0.0_f64), |(least, most), &texel| (least.min(texel), most.max(texel)));
        let [above, below] = rows.map(|[left, right]| left + share.x * (right - left));
        (most - least < SMOOTH).then_some(above + share.y * (below - above))
    }
}

fn maps_of_faces_agree(gpu: &Gpu) -> Outcome {
    let (lamp, lamp_views) = lamp();
    check_both(
        |views| {
            let maps = if views == lamp_views {
                AlphaMap::of(gpu, &lamp, AlphaRemap::Contact)?
            } else {
                let of_spot = |view| Ok(AlphaMap::of(gpu, &spot(view).0, AlphaRemap::Contact)?.remove(0));
                views.iter().map(of_spot).collect::<Result<_, String>>()?
            };
            Ok(difference_of_neighbours(views, 1, |face, place| maps[face].at(place)))
        },
        FACES_MEAN,
    )
}

/// Quads and corners are drawn by vertex stages of their own, so each has a fault of its own.
fn maps_are_as_defined(gpu: &Gpu) -> Outcome {
    use LightOutline::{Disk, Sphere};

    let (lamp, views) = lamp();
    let maps = AlphaMap::of(gpu, &lamp, AlphaRemap::Off)?;
    let frames: Vec<_> = views.iter().map(frame).collect();
    let difference = |of_quads: LightOutline, of_corners: LightOutline| {
        let mut difference = Difference::default();
        for ((view, frame), map) in views.iter().zip(&frames).zip(&maps) {
            let [of_quads, of_corners] = [of_quads, of_corners].map(|light_outline| View { light_outline, ..*view });
            for place in directions(view).step_by(7).filter_map(|direction| place_ndc(view, direction)) {
                if let Some(drawn) = map.at(place).filter(|&drawn| drawn < 1.0) {
                    let defined = alpha(&of_quads, frame.made_quads(), &[], place).min(alpha(
                        &of_corners,
                        &[],
                        frame.made_corners(),
                        place,
                    ));
                    difference.add((drawn - defined).abs());
                }
            }
        }
        difference
    };
    difference(Sphere, Sphere).check(RASTER_MEAN)?;
    for faulty in [difference(Disk, Sphere), difference(Sphere, Disk)] {
        if faulty.check(FAULT * RASTER_MEAN).is_ok() {
            return Err(format!("a disk in the sphere's place is not found: {faulty:?}"));
        }
    }
    Ok(())
}

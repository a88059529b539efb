//! What alpha cuts casts where its picture leaves it, texel by texel, and nothing more: it has no silhouette and no smoothie,
//! and of what no alpha cuts nothing changes.
//!
//! Each texel of a map is held against a ray in 64-bit floats and [`MaskedMesh::keeps`], but where the picture's edge is
//! nearer than rounding goes.

use std::sync::Arc;

use contrejour_gpu::{CasterInput, LightHandle, MeshHandle, Positions, ShadowOptions, Shadows, Untimed};
use contrejour_mesh::{AlphaMask, MaskImage, MaskLevel, MaskedMesh, TextureFilter, TextureWrap, TopologyAwareMesh};
use contrejour_plan::{
    BufferKind, CascadeSettings, CastersInFront, Eye, Light, LightKind, Omitted, Projection, Reason, ShadowSettings,
    View, frame_views,
};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::{direction, point};
use contrejour_tests::meshes::shapes;
use contrejour_tests::random::Random;
use contrejour_tests::texture::{read_depth, read_floats, read_layers};
use glam::{DMat4, DQuat, DVec3, DVec4};
use libtest_mimic::Trial;
use wgpu::BufferUsages;

const MAP_SIZE: u32 = 192;

/// Largest difference of depths: of clip z, and of linear depth as a share of it.
const TOLERANCE: f64 = 1e-5;

/// How far from a picture's edge rounding may go: weights of a face's corners.
const BAND: f64 = 2e-3;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("masked::maps_are_what_rays_find", maps_are_what_rays_find),
        gpu_trial("masked::a_fault_in_a_mask_is_found", a_fault_in_a_mask_is_found),
        gpu_trial("masked::positions_of_the_callers_are_cut_too", positions_of_the_callers_are_cut_too),
        gpu_trial("masked::nothing_else_changes", nothing_else_changes),
        gpu_trial("masked::far_leaves_stay", far_leaves_stay),
    ]
}

/// A mesh with a mask where it stands.
#[derive(Clone)]
struct Leaf {
    mesh: Arc<MaskedMesh>,
    world_from_object: DMat4,
    /// Where other positions than those of the mesh count.
    positions: Option<Vec<[f32; 3]>>,
}

impl Leaf {
    fn new(mesh: &Arc<MaskedMesh>, world_from_object: DMat4) -> Self {
        Self { mesh: Arc::clone(mesh), world_from_object, positions: None }
    }

    fn corners_world(&self, face: u32) -> [DVec3; 3] {
        let face = self.mesh.mesh().faces[face as usize];
        let positions = self.positions.as_ref().unwrap_or(&self.mesh.mesh().positions);
        [face.a, face.b, face.c].map(|vertex| {
            self.world_from_object.transform_point3(DVec3::from(positions[vertex as usize].map(f64::from)))
        })
    }
}

/// A square from -1 to 1 in x and z whose picture is `span` times as large, from a coordinate below 0 on.
fn card(image: &Arc<MaskImage>, span: f32, cutoff: f32) -> Arc<MaskedMesh> {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mask = AlphaMask {
        coordinates: corners.map(|[x, z]: [f32; 2]| [span * x + 0.3, 0.7 * span * z + 0.1]).to_vec(),
        alphas: vec![1.0, 1.0, 0.7, 0.9],
        image: Arc::clone(image),
        cutoff,
    };
    let positions = corners.map(|[x, z]| [x, 0.0, z]);
    Arc::new(MaskedMesh::new(&positions, &[[0, 1, 2], [0, 2, 3]], mask).expect("it is good"))
}

fn image(size: [u32; 2], wrap: [TextureWrap; 2], filter: TextureFilter) -> Arc<MaskImage> {
    let mut random = Random::new(u64::from(size[0]));
    let alphas = (0..size[0] * size[1]).map(|_| random.below(256) as u8).collect();
    Arc::new(MaskImage::new(size, alphas, wrap, filter).expect("it is good"))
}

/// Cards of all kinds, each above the other, turned, stretched and mirrored.
fn leaves() -> Vec<Leaf> {
    use TextureFilter::{Linear, Nearest};
    use TextureWrap::{Clamp, Mirror, Repeat};
    let first = card(&image([7, 4], [Repeat, Mirror], Linear), 0.9, 0.5);
    let second = card(&image([8, 8], [Clamp, Repeat], Nearest), 0.7, 0.35);
    let third = card(&image([5, 9], [Mirror, Clamp], Linear), 1.1, 0.4);
    let turned = |angle: f64, height: f64| {
        DMat4::from_translation(height * DVec3::Y) * DMat4::from_quat(DQuat::from_rotation_z(angle))
    };
    vec![
        Leaf::new(&first, turned(0.3, 0.6)),
        Leaf::new(&second, turned(-0.2, 0.2) * DMat4::from_scale(DVec3::new(-0.8, 1.0, 0.7))),
        Leaf::new(&third, turned(0.1, -0.3) * DMat4::from_scale(DVec3::new(1.2, 0.5, 0.9))),
        // The same mesh again.
        Leaf::new(&first, turned(2.8, -0.6)),
    ]
}

/// A light with the eye that it needs, if any.
struct Lit {
    name: &'static str,
    light: Light,
    eye: Option<Eye>,
}

/// One light of each kind; in the cascades most leaves are in front of the nearest depth.
fn lights() -> Vec<Lit> {
    let above = DVec3::new(0.3, 2.5, 0.4);
    let cascades = CascadeSettings { count: 2, caster_margin: 0.0, ..CascadeSettings::DEFAULT };
    let towards_light = DVec3::new(0.2, 1.0, 0.3);
    let eye =
        Eye { position: DVec3::new(0.0, -0.9, 1.5), forward: -DVec3::Z, fov_y: 0.9, aspect: 1.3, near: 0.2, far: 3.0 };
    let lamp = LightKind::Point { position: DVec3::new(0.1, 0.05, 0.1), radius: 0.02, near: 0.02, far: 5.0 };
    let lit = |name, kind, eye| Lit { name, light: Light { kind, color: [1.0; 3] }, eye };
    vec![
        lit("spot", point(above, DVec3::ZERO, 1.3).kind, None),
        lit("sun", direction(towards_light, DVec3::ZERO, 1.3).kind, None),
        lit("lamp", lamp, None),
        lit("cascades", LightKind::Cascaded { towards_light, angular_radius: 0.01, cascades }, Some(eye)),
    ]
}

fn settings(technique: &str) -> ShadowSettings {
    ShadowSettings { technique: technique.parse().expect("it is listed"), map_size: MAP_SIZE, ..Default::default() }
}

/// What was drawn of some leaves in a light.
struct Drawn {
    shadows: Shadows,
    light: LightHandle,
}

fn draw(
    gpu: &Gpu,
    (leaves, uncut): (&[Leaf], &[Arc<TopologyAwareMesh>]),
    lit: &Lit,
    settings: &ShadowSettings,
) -> Result<Drawn, String> {
    let text = |error: &dyn std::error::Error| error.to_string();
    let mut shadows = Shadows::new(&gpu.device).map_err(|error| text(&error))?;
    let mut known: Vec<(*const MaskedMesh, MeshHandle)> = Vec::new();
    for mesh in uncut {
        let mesh = shadows.add_mesh(Arc::clone(mesh)).map_err(|error| text(&error))?;
        let input = CasterInput { mesh, world_from_object: DMat4::IDENTITY, positions: Positions::OfMesh };
        shadows.add_caster(&input).map_err(|error| text(&error))?;
    }
    for leaf in leaves {
        let address = Arc::as_ptr(&leaf.mesh);
        let mesh = match known.iter().find(|(known, _)| *known == address) {
            Some((_, mesh)) => *mesh,
            None => {
                let mesh = shadows.add_masked_mesh(&leaf.mesh).map_err(|error| text(&error))?;
                known.push((address, mesh));
                mesh
            }
        };
        let positions = leaf.positions.as_ref().map_or(Positions::OfMesh, |positions| Positions::InBuffer {
            buffer: gpu.upload(
                "positions of the caller's",
                bytemuck::cast_slice(positions),
                BufferUsages::STORAGE | BufferUsages::COPY_SRC,
            ),
            offset: 0,
            stride: 12,
            known: None,
        });
        let input = CasterInput { mesh, world_from_object: leaf.world_from_object, positions };
        shadows.add_caster(&input).map_err(|error| text(&error))?;
    }
    let options = ShadowOptions { settings: *settings, ..Default::default() };
    let light = shadows.add_light(&lit.light, &options).map_err(|error| text(&error))?;
    if let Some(eye) = &lit.eye {
        shadows.set_eye(light, eye).map_err(|error| text(&error))?;
    }
    for _ in 0..4 {
        shadows.prepare(&gpu.device, &gpu.queue).map_err(|error| text(&error))?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        shadows.encode(&mut encoder, &mut Untimed);
        gpu.queue.submit([encoder.finish()]);
        shadows.wait_for_counters(&gpu.device).map_err(|error| text(&error))?;
        if shadows.is_complete() {
            break;
        }
    }
    Ok(Drawn { shadows, light })
}

/// What a ray through the middle of a texel finds of the leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Seen {
    Nothing,
    /// Depth of the nearest point that is there: clip z, and linear.
    Leaf([f64; 2]),
    /// Rounding decides.
    Either,
}

fn seen(leaves: &[Leaf], view: &View, texel: [u32; 2]) -> Seen {
    let ndc = texel.map(|place| 2.0 * (f64::from(place) + 0.5) / f64::from(MAP_SIZE) - 1.0);
    let world_from_clip = view.light_clip_from_world.inverse();
    let at = |z: f64| {
        let point = world_from_clip * DVec4::new(ndc[0], -ndc[1], z, 1.0);
        point.truncate() / point.w
    };
    let (origin, end) = (at(0.0), at(1.0));
    let mut nearest = Seen::Nothing;
    let mut nearest_share = f64::INFINITY;
    for leaf in leaves {
        for face in 0..leaf.mesh.mesh().faces.len() as u32 {
            let [a, b, c] = leaf.corners_world(face);
            // Weights of b and c, and how far along the ray.
            let matrix = glam::DMat3::from_cols(b - a, c - a, origin - end);
            let [u, v, share] = (matrix.inverse() * (origin - a)).to_array();
            let is_in_front = share < 0.0 && view.casters_in_front == CastersInFront::Clipped;
            let weights = |du: f64, dv: f64| [1.0 - u - v - du - dv, u + du, v + dv];
            let is_there = |weights: [f64; 3]| {
                let inside = weights.iter().all(|weight| *weight >= 0.0);
                inside && leaf.mesh.keeps(face, weights)
            };
            let near = [[BAND, 0.0], [-BAND, 0.0], [0.0, BAND], [0.0, -BAND], [BAND, -BAND], [-BAND, BAND]];
            let there = is_there(weights(0.0, 0.0));
            let is_sure = near.iter().all(|&[du, dv]| is_there(weights(du, dv)) == there);
            if is_in_front || share > 1.0 || (!there && is_sure) || share >= nearest_share {
                continue;
            }
            nearest_share = share;
            if !is_sure {
                nearest = Seen::Either;
                continue;
            }
            let clip = view.light_clip_from_world * (origin + share * (end - origin)).extend(1.0);
            let z = clip.z / clip.w;
            let linear = match view.projection {
                Projection::Perspective => clip.w,
                Projection::Orthographic => view.near_depth + z * (view.far_depth - view.near_depth),
            };
            nearest = Seen::Leaf([z, linear]);
        }
    }
    nearest
}

/// Holds all texels of a map against rays; returns how many of them have a leaf, have none, and are left to rounding.
fn check(gpu: &Gpu, drawn: &Drawn, leaves: &[Leaf], lit: &Lit) -> Result<[usize; 3], String> {
    let maps = drawn.shadows.maps(drawn.light);
    let plan = drawn.shadows.plan(drawn.light).ok_or("there is a plan")?;
    let (texels, is_linear) = match (maps.shadow_depth, maps.shadow_hardware_depth) {
        (Some(map), _) => (read_floats(gpu, map), true),
        (None, Some(map)) => (read_depth(gpu, map), false),
        (None, None) => return Err("there is no map".into()),
    };
    let views = frame_views(&lit.light, lit.eye.as_ref(), &plan.settings).map_err(|error| error.to_string())?.views;
    let layers: Vec<_> = texels.chunks((MAP_SIZE * MAP_SIZE) as usize).collect();
    // Where nobody keeps a layer for each view, there is that of the last one.
    let views = &views[views.len() - layers.len()..];
    let mut counts = [0; 3];
    for (view, layer) in views.iter().zip(layers) {
        for (found, index) in layer.iter().zip(0..) {
            let texel = [index % MAP_SIZE, index / MAP_SIZE];
            let found = f64::from(*found);
            let is_empty = if is_linear { found >= view.far_depth * (1.0 - 1e-6) } else { found == 1.0 };
            let is_right = match seen(leaves, view, texel) {
                Seen::Either => {
                    counts[2] += 1;
                    true
                }
                Seen::Nothing => {
                    counts[1] += 1;
                    is_empty
                }
                Seen::Leaf([z, linear]) => {
                    counts[0] += 1;
                    let is_near = if is_linear {
                        (found - linear).abs() <= TOLERANCE * linear.abs().max(1.0)
                    } else {
                        // What is in front of a cascade is as near as can be.
                        (found - z.max(0.0)).abs() <= TOLERANCE
                    };
                    !is_empty && is_near
                }
            };
            if !is_right {
                return Err(format!("{}, texel {texel:?}: {found}, and {:?}", lit.name, seen(leaves, view, texel)));
            }
        }
    }
    Ok(counts)
}

fn maps_are_what_rays_find(gpu: &Gpu) -> Outcome {
    let leaves = leaves();
    for lit in &lights() {
        for technique in ["shadow-map", "vsm"] {
            let drawn = draw(gpu, (&leaves, &[]), lit, &settings(technique))?;
            let [there, none, either] = check(gpu, &drawn, &leaves, lit)?;
            let all = there + none + either;
            if there < all / 50 || none < all / 50 || either > all / 8 {
                return Err(format!("{}: {there} texels with leaves, {none} without, {either} left out", lit.name));
            }
        }
    }
    Ok(())
}

fn a_fault_in_a_mask_is_found(gpu: &Gpu) -> Outcome {
    use TextureWrap::{Clamp, Mirror, Repeat};
    let good = leaves();
    let lit = &lights()[0];
    let drawn = draw(gpu, (&good, &[]), lit, &settings("shadow-map"))?;
    check(gpu, &drawn, &good, lit)?;
    let with_mask = |change: &dyn Fn(&mut AlphaMask)| {
        let mut leaves = good.clone();
        let old = Arc::clone(&leaves[0].mesh);
        let mut mask = old.mask().clone();
        change(&mut mask);
        let triangles: Vec<[u32; 3]> = old.mesh().faces.iter().map(|face| [face.a, face.b, face.c]).collect();
        leaves[0].mesh = Arc::new(MaskedMesh::new(&old.mesh().positions, &triangles, mask).expect("it is good"));
        leaves
    };
    let placed = |mesh: usize| {
        let mut leaves = good.clone();
        leaves[0].mesh = Arc::clone(&leaves[mesh].mesh);
        leaves
    };
    let faults = [
        ("cutoff", with_mask(&|mask| mask.cutoff += 0.1)),
        ("coordinates", with_mask(&|mask| mask.coordinates.iter_mut().for_each(|[u, _]| *u += 0.1))),
        ("rows upside down", with_mask(&|mask| mask.coordinates.iter_mut().for_each(|[_, v]| *v = 1.0 - *v))),
        ("alphas", with_mask(&|mask| mask.alphas.reverse())),
        ("edges", with_mask(&|mask| mask.image = image([7, 4], [Mirror, Repeat], TextureFilter::Linear))),
        ("edges that end", with_mask(&|mask| mask.image = image([7, 4], [Clamp, Clamp], TextureFilter::Linear))),
        ("filter", with_mask(&|mask| mask.image = image([7, 4], [Repeat, Mirror], TextureFilter::Nearest))),
        ("another mask", placed(1)),
    ];
    for (name, faulty) in faults {
        if check(gpu, &drawn, &faulty, lit).is_ok() {
            return Err(format!("a fault in the {name} passes"));
        }
    }
    Ok(())
}

fn positions_of_the_callers_are_cut_too(gpu: &Gpu) -> Outcome {
    let mut leaves = leaves();
    leaves[0].positions = Some(vec![[-0.9, 0.3, -1.0], [1.0, 0.0, -0.8], [0.7, -0.2, 1.1], [-1.2, 0.1, 0.9]]);
    let lit = &lights()[0];
    let drawn = draw(gpu, (&leaves, &[]), lit, &settings("shadow-map"))?;
    check(gpu, &drawn, &leaves, lit)?;
    leaves[0].positions = None;
    if check(gpu, &drawn, &leaves, lit).is_ok() { Err("positions of the mesh pass".into()) } else { Ok(()) }
}

fn nothing_else_changes(gpu: &Gpu) -> Outcome {
    let torus = shapes().into_iter().find(|mesh| mesh.name == "torus").ok_or("there is a torus")?;
    let uncut = [Arc::clone(&torus.parts[0].topology)];
    for lit in &lights()[..3] {
        let settings = settings("smoothies");
        let alone = draw(gpu, (&[], &uncut), lit, &settings)?;
        let both = draw(gpu, (&leaves(), &uncut), lit, &settings)?;
        let plans = [&alone, &both].map(|drawn| drawn.shadows.plan(drawn.light).cloned());
        let [Some(plan_alone), Some(plan_of_both)] = plans else { return Err("there are plans".into()) };

        // The plan says so.
        let is_told = |caster: usize| {
            let what = Omitted::Silhouette(format!("caster {caster}"));
            plan_of_both.reason(&what) == Some(Reason::MaskCutsIt)
        };
        if (0..5).map(is_told).collect::<Vec<_>>() != [false, true, true, true, true] {
            return Err(format!("the plan leaves out {:?}", plan_of_both.left_out));
        }
        let has_masks = [&plan_alone, &plan_of_both].map(|plan| plan.buffer(BufferKind::MaskWords).is_some());
        if has_masks != [false, true] || plan_alone.reason(&Omitted::MaskedPasses) != Some(Reason::NothingIsMasked) {
            return Err(format!("buffers for masks: {has_masks:?}"));
        }

        // Silhouettes and smoothies are those of the torus.
        let counters = [&alone, &both].map(|drawn| drawn.shadows.stats().counters.unwrap_or_default());
        let counted = counters.map(|counters| [counters.silhouette_edges, counters.quads, counters.corners]);
        if counted[0] != counted[1] || counters[1].masked_items < 4 {
            return Err(format!("{}: {counters:?}", lit.name));
        }
        let depth = |drawn: &Drawn| {
            drawn.shadows.maps(drawn.light).shadow_depth.map(|map| read_floats(gpu, map)).ok_or("there is a map")
        };
        let [torus_depth, both_depth] = [depth(&alone)?, depth(&both)?];
        // A smoothie that lies behind what is nearest there is on nothing: those behind leaves are gone.
        let open: Vec<bool> = torus_depth.iter().zip(&both_depth).map(|(one, other)| one == other).collect();
        let maps = [&alone, &both].map(|drawn| drawn.shadows.maps(drawn.light));
        for (name, [one, other]) in [
            ("smoothie depth", maps.each_ref().map(|maps| maps.smoothie_depth)),
            ("smoothie alpha", maps.each_ref().map(|maps| maps.smoothie_alpha)),
        ] {
            let texels = |map: Option<&wgpu::Texture>| -> Result<Vec<Vec<u8>>, String> {
                let bytes = read_layers(gpu, map.ok_or("there is a map")?);
                let texels = bytes.chunks(bytes.len() / open.len()).zip(&open);
                Ok(texels.filter(|(_, is_open)| **is_open).map(|(texel, _)| texel.to_vec()).collect())
            };
            compare_exact(&format!("{}, {name}", lit.name), &texels(one)?, &texels(other)?)?;
        }

        // The shadow map has the nearer of both. Where there are no silhouettes, this technique keeps linear depth, of one view.
        let linear = ShadowSettings { technique: "vsm".parse().expect("it is listed"), ..settings };
        let leaves_alone = draw(gpu, (&leaves(), &[]), lit, &linear)?;
        let leaves_depth = depth(&leaves_alone)?;
        if leaves_depth.len() == both_depth.len() {
            let nearest: Vec<f32> = torus_depth.iter().zip(&leaves_depth).map(|(one, other)| one.min(*other)).collect();
            compare_exact(&format!("{}, shadow map", lit.name), &nearest, &both_depth)?;
        }
    }
    Ok(())
}

/// Where a texel of the map covers many of the picture, as much of it is covered as the picture leaves; without smaller
/// levels of the same coverage it would be all or nothing.
fn far_leaves_stay(gpu: &Gpu) -> Outcome {
    // A fifth of the texels, scattered.
    let side = 256_u32;
    let mut random = Random::new(5);
    let alphas: Vec<u8> = (0..side * side).map(|_| if random.below(5) == 0 { 255 } else { 0 }).collect();
    let share = MaskLevel { size: [side; 2], alphas: alphas.clone() }.share_kept(0.5);
    let image = MaskImage::new([side; 2], alphas, [TextureWrap::Repeat; 2], TextureFilter::Linear);
    let image = Arc::new(image.map_err(|error| error.to_string())?);
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let covered = |repeats: f32| -> Result<f64, String> {
        let mask = AlphaMask {
            coordinates: corners.map(|[x, z]: [f32; 2]| [repeats * x, repeats * z]).to_vec(),
            alphas: vec![1.0; 4],
            image: Arc::clone(&image),
            cutoff: 0.5,
        };
        let mesh = MaskedMesh::new(&corners.map(|[x, z]| [x, 0.0, z]), &[[0, 1, 2], [0, 2, 3]], mask);
        let leaf = Leaf::new(&Arc::new(mesh.map_err(|error| error.to_string())?), DMat4::IDENTITY);
        let lit = Lit { name: "sun", light: direction(DVec3::Y, DVec3::ZERO, 1.0 / 1.1), eye: None };
        let drawn = draw(gpu, (&[leaf], &[]), &lit, &settings("shadow-map"))?;
        let map = drawn.shadows.maps(drawn.light).shadow_hardware_depth.ok_or("there is a map")?;
        let depth = read_depth(gpu, map);
        Ok(depth.iter().filter(|depth| **depth < 1.0).count() as f64 / depth.len() as f64)
    };
    // From 2.7 texels of the picture in one of the map to 21 of them.
    for repeats in [1.0, 2.0, 4.0, 8.0] {
        let found = covered(repeats)?;
        if (found - share).abs() > 0.08 {
            return Err(format!(
                "{repeats} times the picture cover {found:.3} of the map, and {share:.3} of a picture"
            ));
        }
    }
    Ok(())
}

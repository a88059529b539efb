//! Frames against exact arithmetic, and against frames drawn from scratch.

mod maps;
mod pictures;
#[cfg(test)]
mod tests;

use contrejour_gpu::{LightHandle, Positions, ShadowLightError, Untimed};
use contrejour_layout::{CasterLight, Counters, SilhouetteEdge};
use contrejour_oracle::{ManyLights, OracleEdge, OracleTopology};
use contrejour_plan::{BufferKind, NearOne, ObjectBox, Stage, View, caster_light, frame_views};
use contrejour_render::{Gpu, copied_buffer, had_room, read_buffer};
use glam::{DMat4, DVec3};

use super::error::StressError;
use super::pictures::Pictures;
use super::run::REPEATS_MAX;
use super::world::{Placed, World};

/// Differences so far.
pub(super) struct Verifier<'a> {
    world: &'a World,
    rigid: ManyLights,
    flexible: OracleTopology,
    /// The pictures of the run, from the first verified frame on.
    walked: Option<Pictures>,
    pub light_frames: u64,
    pub texels: u64,
    pub differences: u64,
    pub first_difference: Option<String>,
}

/// Copies of what the stages of a view left.
struct Left {
    light: LightHandle,
    view: usize,
    /// Of each page: counters, silhouettes.
    pages: Vec<[wgpu::Buffer; 2]>,
    caster_lights: wgpu::Buffer,
}

/// What the device made of a mesh that deforms.
struct Deformed {
    oracle: ManyLights,
    /// Around its positions.
    bounds: [[f32; 3]; 2],
}

/// What 32-bit floats may do to a position of a torus of radius 1 on its way through a morph target and two joints: some 20
/// roundings of 2^-24 of numbers up to 4.
const POSE_TOLERANCE: f64 = 5e-6;

/// Boxes so much smaller must be out of view, for what the device's 32-bit test may not see.
const CERTAINLY: f64 = 0.98;

impl<'a> Verifier<'a> {
    pub fn new(world: &'a World) -> Self {
        let topology = OracleTopology::new(&world.mesh.positions, &world.triangles.triangles);
        let rigid = ManyLights::new(&topology);
        Self {
            world,
            rigid,
            flexible: topology,
            walked: None,
            light_frames: 0,
            texels: 0,
            differences: 0,
            first_difference: None,
        }
    }

    /// Compares what a frame left, and its picture, with the same frame drawn from scratch, then draws all lights once more
    /// and holds the lists of each view against exact arithmetic.
    pub fn check(&mut self, gpu: &Gpu, placed: &mut Placed, frame: u64) -> Result<(), StressError> {
        // First what the frame left: some of it may have been kept from frames before.
        self.check_maps(gpu, placed, frame)?;
        self.check_picture(gpu, frame)?;
        self.check_lists(gpu, placed, frame)
    }

    fn check_lists(&mut self, gpu: &Gpu, placed: &mut Placed, frame: u64) -> Result<(), StressError> {
        let deformed = self.deformed(gpu, placed, frame)?;
        let left = draw_again(gpu, placed)?;
        let places: Vec<_> = self.world.casters(frame).collect();
        let lights: Vec<_> = self.world.lights(frame).collect();
        let eye = self.world.eye(frame);
        for (index, (handle, light)) in placed.lights.iter().zip(&lights).enumerate() {
            let settings = self.world.settings(index);
            let views = frame_views(light, Some(&eye), settings).map_err(ShadowLightError::from)?.views;
            let of_light: Vec<_> = left.iter().filter(|left| left.light == *handle).collect();
            let are_drawn = of_light.iter().map(|left| left.view).eq(0..views.len());
            if !are_drawn && !places.is_empty() {
                self.differ(&format!("frame {frame}, light {index}: of its {} views others are drawn", views.len()));
                continue;
            }
            for (left, view) in of_light.iter().zip(&views) {
                let what = format!("frame {frame}, light {index}, view {}", left.view);
                self.check_view(gpu, left, (view, view.reach_ndc(settings)), &places, &deformed, &what)?;
            }
            self.light_frames += u64::from(are_drawn);
        }
        Ok(())
    }

    fn check_view(
        &mut self,
        gpu: &Gpu,
        left: &Left,
        (view, reach_ndc): (&View, f64),
        places: &[DMat4],
        deformed: &[Deformed],
        what: &str,
    ) -> Result<(), StressError> {
        let caster_lights: Vec<CasterLight> = read(gpu, &left.caster_lights, left.caster_lights.size())?;
        let mut silhouettes: Vec<SilhouetteEdge> = Vec::new();
        for [counters, list] in &left.pages {
            let counters: Vec<Counters> = read(gpu, counters, size_of::<Counters>() as u64)?;
            let count = u64::from(counters[0].silhouette_edges);
            silhouettes.extend(read::<SilhouetteEdge>(gpu, list, count * size_of::<SilhouetteEdge>() as u64)?);
        }
        let mesh = &*self.world.mesh;
        let near_one = NearOne::of_box(mesh.bounds_min, mesh.bounds_max);
        let mut casting = 0;
        for (index, place) in places.iter().enumerate() {
            let expected = caster_light(view, place, &near_one);
            let found = &caster_lights[index];
            let deformed = self.world.flexible_index(index).map(|index| &deformed[index]);
            if found.casts != 0 && expected.casts == 0 {
                self.differ(&format!("{what}: caster {index} casts, and can't"));
            }
            if found.casts == 0 {
                let [min, max] =
                    shrunk(deformed.map_or([mesh.bounds_min, mesh.bounds_max], |deformed| deformed.bounds));
                let bounds = ObjectBox { min, max, world_from_object: *place };
                if expected.casts != 0 && view.can_see(&bounds, CERTAINLY * reach_ndc) {
                    self.differ(&format!("{what}: caster {index} is left out"));
                }
                continue;
            }
            if found.light_object != expected.light_object || found.mirrored != expected.mirrored {
                self.differ(&format!("{what}: caster {index} sees another light"));
            }
            if !left.pages.is_empty() {
                let oracle = deformed.map_or(&self.rigid, |deformed| &deformed.oracle);
                casting += silhouettes.iter().filter(|edge| edge.caster as usize == index).count();
                let is_same = self.has_silhouette(oracle, &expected, index, &silhouettes);
                if !is_same {
                    self.differ(&format!("{what}: caster {index} has another silhouette"));
                }
            }
        }
        if casting != silhouettes.len() {
            self.differ(&format!("{what}: {} edges are of casters that don't cast", silhouettes.len() - casting));
        }
        Ok(())
    }

    /// Whether the edges of a caster are those that exact arithmetic finds from the CPU's own light.
    fn has_silhouette(
        &self,
        oracle: &ManyLights,
        light: &CasterLight,
        caster: usize,
        silhouettes: &[SilhouetteEdge],
    ) -> bool {
        let is_rigid = self.world.flexible_index(caster).is_none();
        let mesh = if is_rigid { &self.world.mesh } else { &self.world.flexible.topology };
        let lit = oracle.lit_faces(light.light_object.map(f32::from_bits), light.mirrored == 1);
        let of_caster = silhouettes.iter().filter(|edge| edge.caster as usize == caster);
        let mut found: Vec<_> = of_caster
            .map(|silhouette| {
                let edge = &mesh.edges[silhouette.edge_id as usize];
                let [left, right] = [silhouette.left, silhouette.right].map(u32::cast_signed);
                OracleEdge { low: edge.low_vertex, high: edge.high_vertex, left, right }
            })
            .collect();
        found.sort_unstable();
        found == oracle.silhouette(&lit)
    }

    /// What the device moved, as exact arithmetic sees it; each position is held against the CPU's own pose first, or a
    /// wrong pose would verify itself.
    fn deformed(&mut self, gpu: &Gpu, placed: &Placed, frame: u64) -> Result<Vec<Deformed>, StressError> {
        let mut deformed = Vec::new();
        for (positions, pose) in placed.flexible_positions().zip(self.world.flexible_poses(frame)) {
            let Positions::InBuffer { buffer, offset, .. } = positions else { continue };
            let expected = self.world.flexible.deforming.posed(&pose);
            let size = size_of::<[f32; 3]>() as u64 * expected.len() as u64;
            let bytes = read_buffer(gpu, buffer.slice(..), offset + size)?;
            let found: Vec<[f32; 3]> = bytemuck::pod_collect_to_vec(&bytes[offset as usize..]);
            let error = found
                .iter()
                .zip(&expected)
                .map(|(found, expected)| (DVec3::from(found.map(f64::from)) - *expected).abs().max_element());
            let largest = error.fold(0.0, f64::max);
            // NaN is not within.
            let is_posed = largest <= POSE_TOLERANCE;
            if !is_posed {
                self.differ(&format!("frame {frame}: a deformed position is {largest} off the CPU's"));
            }
            let corner = |pick: fn(f32, f32) -> f32| {
                found.iter().copied().reduce(|one, other| [0, 1, 2].map(|axis| pick(one[axis], other[axis])))
            };
            let bounds = [corner(f32::min), corner(f32::max)].map(Option::unwrap_or_default);
            deformed.push(Deformed { oracle: ManyLights::new(&self.flexible.clone().moved(&found)), bounds });
        }
        Ok(deformed)
    }

    fn differ(&mut self, difference: &str) {
        self.differences += 1;
        self.first_difference.get_or_insert_with(|| difference.to_owned());
    }
}

/// A box that is certainly seen where this one is.
fn shrunk([min, max]: [[f32; 3]; 2]) -> [[f32; 3]; 2] {
    let shrunk = |from: [f32; 3], to: [f32; 3]| {
        [0, 1, 2].map(|axis| {
            let [from, to] = [from[axis], to[axis]].map(f64::from);
            (0.5 * (from + to) + 0.5 * CERTAINLY * (from - to)) as f32
        })
    };
    [shrunk(min, max), shrunk(max, min)]
}

/// Draws the frame of a scene again, until all lists have room, and keeps what each view leaves.
fn draw_again(gpu: &Gpu, placed: &mut Placed) -> Result<Vec<Left>, StressError> {
    for _ in 0..REPEATS_MAX {
        let left = draw_once_more(gpu, placed)?;
        if had_room(gpu, &mut placed.shadows)? {
            return Ok(left);
        }
    }
    Err(StressError::Incomplete(REPEATS_MAX))
}

fn draw_once_more(gpu: &Gpu, placed: &mut Placed) -> Result<Vec<Left>, StressError> {
    let Placed { shadows, deformer, .. } = placed;
    shadows.redraw();
    shadows.prepare(&gpu.device, &gpu.queue)?;
    let mut left = Vec::new();
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("verified") });
    deformer.encode(&mut encoder, &mut Untimed);
    shadows.encode_each(&mut encoder, &mut Untimed, |encoder, view| {
        let mut copy = |buffer| copied_buffer(gpu, encoder, buffer);
        let Some(caster_lights) = view.buffers(BufferKind::CasterLights).next() else { return };
        let pages = view.buffers(BufferKind::Counters).zip(view.buffers(BufferKind::Silhouettes));
        left.push(Left {
            light: view.light,
            view: view.view,
            pages: pages.map(|(counters, list)| [copy(counters), copy(list)]).collect(),
            caster_lights: copy(caster_lights),
        });
    });
    gpu.queue.submit([encoder.finish()]);
    gpu.wait(None)?;
    // Silhouettes are those of the lights whose technique has any.
    for left in &mut left {
        if shadows.plan(left.light).is_none_or(|plan| !plan.has_stage(Stage::DetectSilhouette)) {
            left.pages.clear();
        }
    }
    Ok(left)
}

fn read<T: bytemuck::AnyBitPattern + bytemuck::NoUninit>(
    gpu: &Gpu,
    buffer: &wgpu::Buffer,
    size: u64,
) -> Result<Vec<T>, StressError> {
    Ok(bytemuck::pod_collect_to_vec(&read_buffer(gpu, buffer.slice(..), size)?))
}

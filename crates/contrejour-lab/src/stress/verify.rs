//! Frames against exact arithmetic, and against frames drawn from scratch.

use contrejour_gpu::{LightHandle, Positions, ShadowLightError, Shadows, Untimed};
use contrejour_layout::{CasterLight, Counters, SilhouetteEdge};
use contrejour_oracle::{ManyLights, OracleEdge, OracleTopology};
use contrejour_plan::{BufferKind, NearOne, ObjectBox, Stage, View, caster_light, frame_views};
use contrejour_render::{Gpu, copied_buffer, read_buffer, read_rows};
use glam::{DMat4, DVec3};

use super::error::StressError;
use super::run::settle;
use super::world::{Placed, World};

/// Differences so far.
pub(super) struct Verifier<'a> {
    world: &'a World,
    rigid: ManyLights,
    flexible: OracleTopology,
    pub light_frames: u64,
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

/// What 32-bit floats may do to a position of a torus of radius 1 on its way through a morph target and two joints: some 20
/// roundings of 2^-24 of numbers up to 4.
const POSE_TOLERANCE: f64 = 5e-6;

/// Boxes so much smaller must be out of view, for what the device's 32-bit test may not see.
const CERTAINLY: f64 = 0.98;

impl<'a> Verifier<'a> {
    pub fn new(world: &'a World) -> Self {
        let topology = OracleTopology::new(&world.mesh.positions, &world.triangles.triangles);
        let rigid = ManyLights::new(&topology);
        Self { world, rigid, flexible: topology, light_frames: 0, differences: 0, first_difference: None }
    }

    /// Compares what a frame left with the same frame drawn from scratch, then draws all lights once more and holds the
    /// lists of each view against exact arithmetic.
    pub fn check(&mut self, gpu: &Gpu, placed: &mut Placed, frame: u64) -> Result<(), StressError> {
        // First what the frame left: some of it may have been kept from frames before.
        self.check_maps(gpu, placed, frame)?;
        let deformed = self.deformed(gpu, placed, frame)?;
        let left = draw_again(gpu, placed)?;
        let places: Vec<_> = self.world.casters(frame).collect();
        let lights: Vec<_> = self.world.lights(frame).collect();
        for (index, (handle, light)) in placed.lights.iter().zip(&lights).enumerate() {
            let views = frame_views(light, None, self.world.settings()).map_err(ShadowLightError::from)?.views;
            let of_light: Vec<_> = left.iter().filter(|left| left.light == *handle).collect();
            let are_drawn = of_light.iter().map(|left| left.view).eq(0..views.len());
            if !are_drawn && !places.is_empty() {
                self.differ(&format!("frame {frame}, light {index}: of its {} views others are drawn", views.len()));
                continue;
            }
            for (left, view) in of_light.iter().zip(&views) {
                let what = format!("frame {frame}, light {index}, view {}", left.view);
                self.check_view(gpu, left, view, &places, &deformed, &what)?;
            }
            self.light_frames += u64::from(are_drawn);
        }
        Ok(())
    }

    fn check_view(
        &mut self,
        gpu: &Gpu,
        left: &Left,
        view: &View,
        places: &[DMat4],
        deformed: &[ManyLights],
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
        let reach_ndc = view.reach_ndc(self.world.settings());
        let mut casting = 0;
        for (index, place) in places.iter().enumerate() {
            let expected = caster_light(view, place, &near_one);
            let found = &caster_lights[index];
            if found.casts != 0 && expected.casts == 0 {
                self.differ(&format!("{what}: caster {index} casts, and can't"));
            }
            if found.casts == 0 {
                let shrunk = [mesh.bounds_min, mesh.bounds_max].map(|corner| corner.map(|x| x * CERTAINLY as f32));
                let bounds = ObjectBox { min: shrunk[0], max: shrunk[1], world_from_object: *place };
                // Nobody knows where the positions of the others are.
                let is_anywhere = self.world.flexible_index(index).is_some();
                if is_anywhere || expected.casts != 0 && view.can_see(&bounds, CERTAINLY * reach_ndc) {
                    self.differ(&format!("{what}: caster {index} is left out"));
                }
                continue;
            }
            if found.light_object != expected.light_object || found.mirrored != expected.mirrored {
                self.differ(&format!("{what}: caster {index} sees another light"));
            }
            if !left.pages.is_empty() {
                let oracle = self.world.flexible_index(index).map_or(&self.rigid, |index| &deformed[index]);
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
    fn deformed(&mut self, gpu: &Gpu, placed: &Placed, frame: u64) -> Result<Vec<ManyLights>, StressError> {
        let mut deformed = Vec::new();
        for (positions, pose) in placed.flexible_positions().zip(self.world.flexible_poses(frame)) {
            let Positions::InBuffer { buffer, offset, .. } = positions else { continue };
            let expected = self.world.flexible.deforming.posed(&pose);
            let size = size_of::<[f32; 3]>() as u64 * expected.len() as u64;
            let bytes = read_buffer(gpu, &buffer, offset + size)?;
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
            deformed.push(ManyLights::new(&self.flexible.clone().moved(&found)));
        }
        Ok(deformed)
    }

    /// Holds the maps against those of a scene that knows nothing of the frames before.
    fn check_maps(&mut self, gpu: &Gpu, placed: &Placed, frame: u64) -> Result<(), StressError> {
        let mut scratch = self.world.place(gpu, frame)?;
        settle(gpu, &mut scratch)?;
        for (index, (light, anew)) in placed.lights.iter().zip(&scratch.lights).enumerate() {
            if maps(gpu, &placed.shadows, *light)? != maps(gpu, &scratch.shadows, *anew)? {
                self.differ(&format!("frame {frame}, light {index}: its maps are not those drawn from scratch"));
            }
        }
        Ok(())
    }

    fn differ(&mut self, difference: &str) {
        self.differences += 1;
        self.first_difference.get_or_insert_with(|| difference.to_owned());
    }
}

/// Draws the frame of a scene again, and keeps what each view leaves.
fn draw_again(gpu: &Gpu, placed: &mut Placed) -> Result<Vec<Left>, StressError> {
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
    Ok(bytemuck::pod_collect_to_vec(&read_buffer(gpu, buffer, size)?))
}

/// All texels that receivers look up.
fn maps(gpu: &Gpu, shadows: &Shadows, light: LightHandle) -> Result<Vec<u8>, StressError> {
    let maps = shadows.maps(light);
    let kinds = shadows.plan(light).and_then(|plan| plan.visibility).map_or(&[][..], |kind| kind.textures());
    let mut bytes = Vec::new();
    for kind in kinds {
        let map = maps.of(*kind).ok_or(StressError::NoMap { map: kind.name() })?;
        let aspect = map.format().has_depth_aspect().then_some(wgpu::TextureAspect::DepthOnly);
        let texel = map.format().block_copy_size(aspect).unwrap_or(4);
        for layer in 0..map.depth_or_array_layers() {
            read_rows(gpu, map, [layer, 0], texel, |row| bytes.extend_from_slice(row))?;
        }
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stress::StressOptions;

    #[test]
    fn a_wrong_edge_a_missing_one_and_a_wrong_side_are_found() {
        let options = StressOptions { casters: 4, triangles_per_caster: 200, ..StressOptions::default() };
        let world = World::new(&options).expect("the options are good");
        let verifier = Verifier::new(&world);
        let light = CasterLight { light_object: [2.0_f32, 3.0, 0.5, 1.0].map(f32::to_bits), ..CasterLight::default() };
        let lit = verifier.rigid.lit_faces(light.light_object.map(f32::from_bits), false);
        let edge_id = |edge: &OracleEdge| {
            let is_it =
                |known: &contrejour_layout::Edge| [known.low_vertex, known.high_vertex] == [edge.low, edge.high];
            world.mesh.edges.iter().position(is_it).expect("the oracle knows the mesh's edges") as u32
        };
        let sound: Vec<_> = (verifier.rigid.silhouette(&lit).iter())
            .map(|edge| SilhouetteEdge {
                caster: 0,
                edge_id: edge_id(edge),
                left: edge.left.cast_unsigned(),
                right: edge.right.cast_unsigned(),
            })
            .collect();
        let passes = |edges: &[SilhouetteEdge]| verifier.has_silhouette(&verifier.rigid, &light, 0, edges);
        assert!(sound.len() > 10 && passes(&sound));

        let with = |fault: fn(&mut Vec<SilhouetteEdge>)| {
            let mut faulty = sound.clone();
            fault(&mut faulty);
            faulty
        };
        assert!(!passes(&with(|edges| edges.truncate(edges.len() - 1))));
        assert!(!passes(&with(|edges| edges.push(edges[0]))));
        assert!(!passes(&with(|edges| (edges[3].left, edges[3].right) = (edges[3].right, edges[3].left))));
        assert!(!passes(&with(|edges| edges[5].edge_id ^= 1)));
    }
}

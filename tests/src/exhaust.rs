//! Thousands of lights on one mesh: what the device finds against exact arithmetic, counted face by face and edge by
//! edge, beside what a bare float test would get wrong.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;

use contrejour_gpu::{CasterHandle, CasterInput, LightHandle, Positions, ShadowOptions, Shadows, Untimed};
use contrejour_layout::{BLOCK_SIZE, Counters, LIT_WORDS_PER_BLOCK, SilhouetteEdge};
use contrejour_mesh::TopologyAwareMesh;
use contrejour_oracle::{ManyLights, OracleTopology};
use contrejour_plan::{BufferKind, Outputs};
use glam::DMat4;

use crate::compare::{edge_differences, edges_of};
use crate::gpu::Gpu;
use crate::many_lights::Corners;
use crate::meshes::{TestMesh, TestPart};
use crate::object_light::ObjectLight;

/// Frames after which one must have had room, more than are in flight: those were recorded before its lists grew.
const MAX_TRIES: u32 = 2 * IN_FLIGHT as u32;

/// Frames that the device works on while the CPU checks others.
const IN_FLIGHT: usize = 4;

/// What was counted over some lights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Lights.
    pub lights: u64,
    /// Faces times lights.
    pub face_tests: u64,
    /// Faces that came to the exact tiers.
    pub undecided: u64,
    /// Edges of the exact silhouettes.
    pub silhouette_edges: u64,
    /// Signs that a float determinant without a bound gets wrong.
    pub wrong_by_floats: u64,
    /// Lit bits of the device that differ from exact arithmetic.
    pub wrong_bits: u64,
    /// Edges, with their left and right faces, that only the device or only exact arithmetic has.
    pub wrong_edges: u64,
    /// Where the first difference is.
    pub first_difference: Option<String>,
}

impl Tally {
    /// Differences of any kind.
    pub fn differences(&self) -> u64 {
        self.wrong_bits + self.wrong_edges
    }

    /// Adds another one's counts.
    pub fn add(&mut self, other: Self) {
        self.lights += other.lights;
        self.face_tests += other.face_tests;
        self.undecided += other.undecided;
        self.silhouette_edges += other.silhouette_edges;
        self.wrong_by_floats += other.wrong_by_floats;
        self.wrong_bits += other.wrong_bits;
        self.wrong_edges += other.wrong_edges;
        self.first_difference = self.first_difference.take().or(other.first_difference);
    }
}

/// The meshes of a file, each once and in its own object space, as casters of one `Shadows` object.
pub struct Exhaust<'a> {
    gpu: &'a Gpu,
    shadows: Shadows,
    light: Option<LightHandle>,
    casters: Vec<ExactCaster>,
    free: Vec<wgpu::Buffer>,
}

struct ExactCaster {
    handle: CasterHandle,
    mesh: Arc<TopologyAwareMesh>,
    oracle: ManyLights,
    lit_words: Range<usize>,
}

/// Positions that a buffer of the caller's holds.
#[derive(Clone, Debug)]
pub struct OwnPositions {
    /// The buffer.
    pub buffer: wgpu::Buffer,
    /// Where the first position starts, in bytes.
    pub offset: u64,
    /// From one position to the next, in bytes.
    pub stride: u64,
    /// What it holds.
    pub positions: Vec<[f32; 3]>,
}

/// A submitted frame on its way back.
struct Waiting {
    light: ObjectLight,
    tries: u32,
    buffer: wgpu::Buffer,
    layout: Layout,
    submission: wgpu::SubmissionIndex,
}

/// Sizes of what comes back of a frame, page after page of each of [`FOUND`]. Unit: bytes.
type Layout = [Vec<u64>; 3];

/// What a frame left on the device.
pub struct Found {
    /// Its counters.
    pub counters: Counters,
    /// Its lit bits.
    pub lit: Vec<u32>,
    /// Its silhouettes.
    pub silhouettes: Vec<SilhouetteEdge>,
}

/// Whether the textbook form, in plain 32-bit floats and without a bound, calls a face lit.
pub fn is_lit_by_floats(&[a, b, c]: &Corners, light: &ObjectLight) -> bool {
    let [x, y, z, w] = light.light_object;
    let minus = |p: [f32; 3], q: [f32; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let (p, q, r) = (minus(b, a), minus(c, a), minus([x, y, z], a.map(|coordinate| w * coordinate)));
    let normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let determinant = normal[0] * r[0] + normal[1] * r[1] + normal[2] * r[2];
    if light.mirrored { determinant < 0.0 } else { determinant > 0.0 }
}

impl<'a> Exhaust<'a> {
    /// Makes the object and adds the meshes.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn new(gpu: &'a Gpu, file: &TestMesh) -> Result<Self, String> {
        let mut exhaust = Self::empty(gpu)?;
        for part in &file.parts {
            if !exhaust.casters.iter().any(|caster| Arc::ptr_eq(&caster.mesh, &part.topology)) {
                let oracle = OracleTopology::new(&part.topology.positions, &part.triangles);
                exhaust.add(&part.topology, &oracle, None)?;
            }
        }
        Ok(exhaust)
    }

    /// Makes the object and adds a deforming mesh where a buffer has its vertices.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn of_moved(gpu: &'a Gpu, part: &TestPart, moved: OwnPositions) -> Result<Self, String> {
        let oracle = OracleTopology::new(&part.topology.positions, &part.triangles).moved(&moved.positions);
        Self::of_deforming(gpu, &part.topology, &oracle, moved)
    }

    /// The same for an oracle that knows already where the vertices are.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn of_deforming(
        gpu: &'a Gpu,
        topology: &Arc<TopologyAwareMesh>,
        oracle: &OracleTopology,
        moved: OwnPositions,
    ) -> Result<Self, String> {
        let mut exhaust = Self::empty(gpu)?;
        exhaust.add(topology, oracle, Some(moved))?;
        Ok(exhaust)
    }

    fn empty(gpu: &'a Gpu) -> Result<Self, String> {
        let shadows = Shadows::new(&gpu.device).map_err(|error| error.to_string())?;
        Ok(Self { gpu, shadows, light: None, casters: Vec::new(), free: Vec::new() })
    }

    fn add(
        &mut self,
        mesh: &Arc<TopologyAwareMesh>,
        oracle: &OracleTopology,
        own_positions: Option<OwnPositions>,
    ) -> Result<(), String> {
        let first_word = self.casters.last().map_or(0, |caster| caster.lit_words.end);
        let words = mesh.faces.len().div_ceil(BLOCK_SIZE as usize) * LIT_WORDS_PER_BLOCK as usize;
        let handle = self.shadows.add_mesh(Arc::clone(mesh)).map_err(|error| error.to_string())?;
        let positions = own_positions.map_or(Positions::OfMesh, |OwnPositions { buffer, offset, stride, .. }| {
            Positions::InBuffer { buffer, offset, stride, known: None }
        });
        let caster = CasterInput { mesh: handle, world_from_object: DMat4::IDENTITY, positions };
        self.casters.push(ExactCaster {
            handle: self.shadows.add_caster(&caster).map_err(|error| error.to_string())?,
            mesh: Arc::clone(mesh),
            oracle: ManyLights::new(oracle),
            lit_words: first_word..first_word + words,
        });
        Ok(())
    }

    /// The faces of all meshes.
    pub fn faces(&self) -> Vec<Corners> {
        self.casters.iter().flat_map(|caster| caster.oracle.corners()).copied().collect()
    }

    /// Runs a frame for each light and counts.
    ///
    /// # Errors
    ///
    /// What the library refuses, or that it makes another light of one.
    pub fn run(&mut self, lights: &[ObjectLight]) -> Result<Tally, String> {
        let mut tally = Tally::default();
        let mut waiting = VecDeque::new();
        for light in lights {
            waiting.push_back(self.submit(*light, 1)?);
            if waiting.len() > IN_FLIGHT {
                self.check_next(&mut waiting, &mut tally)?;
            }
        }
        while !waiting.is_empty() {
            self.check_next(&mut waiting, &mut tally)?;
        }
        Ok(tally)
    }

    fn submit(&mut self, light: ObjectLight, tries: u32) -> Result<Waiting, String> {
        light.check_bits()?;
        for caster in &self.casters {
            let moved = self.shadows.place_caster(caster.handle, &light.world_from_object());
            moved.map_err(|error| error.to_string())?;
        }
        let Gpu { device, queue, .. } = self.gpu;
        match self.light {
            Some(handle) => self.shadows.set_light(handle, &light.light()).map_err(|error| error.to_string())?,
            None => {
                let options = ShadowOptions { outputs: Outputs::Silhouettes, ..Default::default() };
                let added = self.shadows.add_light(&light.light(), &options);
                self.light = Some(added.map_err(|error| error.to_string())?);
            }
        }
        self.shadows.prepare(device, queue).map_err(|error| error.to_string())?;

        let layout = FOUND.map(|kind| self.shadows.buffers(kind).map(|part| part.size()).collect::<Vec<_>>());
        let size = layout.iter().flatten().sum::<u64>().max(4);
        let buffer = self.free.pop().filter(|free| free.size() >= size).unwrap_or_else(|| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("found"),
                size,
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            })
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        self.shadows.encode(&mut encoder, &mut Untimed);
        let mut begin = 0;
        for source in FOUND.into_iter().flat_map(|kind| self.shadows.buffers(kind)) {
            encoder.copy_buffer_to_buffer(source.buffer(), source.offset(), &buffer, begin, source.size());
            begin += source.size();
        }
        Ok(Waiting { light, tries, buffer, layout, submission: queue.submit([encoder.finish()]) })
    }

    /// Compares what the next frame found; one whose lists were too short runs again behind the others.
    fn check_next(&mut self, waiting: &mut VecDeque<Waiting>, tally: &mut Tally) -> Result<(), String> {
        let Some(Waiting { light, tries, buffer, layout, submission }) = waiting.pop_front() else { return Ok(()) };
        let found = self.gpu.map_after(&buffer, submission, |bytes| Found::read(bytes, &layout));
        self.free.push(buffer);
        match found {
            Some(found) => tally.add(self.compare(&light, &found)),
            None if tries < MAX_TRIES => waiting.push_back(self.submit(light, tries + 1)?),
            None => return Err(format!("lists were too short {tries} times: they do not grow")),
        }
        Ok(())
    }

    /// Counts where a frame's findings differ from exact arithmetic.
    pub fn compare(&self, light: &ObjectLight, found: &Found) -> Tally {
        let undecided = found.counters.undecided_near + found.counters.undecided_far;
        let mut tally = Tally { lights: 1, undecided: undecided.into(), ..Tally::default() };
        for (caster, index) in self.casters.iter().zip(0..) {
            let lit_faces = caster.oracle.lit_faces(light.light_object, light.mirrored);
            tally.face_tests += lit_faces.len() as u64;
            let faces = caster.oracle.corners().iter().zip(&lit_faces);
            tally.wrong_by_floats += faces.filter(|(face, lit)| is_lit_by_floats(face, light) != **lit).count() as u64;

            let words = &found.lit[caster.lit_words.clone()];
            let bit = |face: usize| words[face / 32] >> (face % 32) & 1 == 1;
            let mut wrong = (0..lit_faces.len()).filter(|&face| bit(face) != lit_faces[face]);
            if let Some(face) = wrong.next() {
                tally.wrong_bits += 1 + wrong.count() as u64;
                tally.first_difference.get_or_insert_with(|| format!("face {face} of mesh {index} under {light:?}"));
            }

            let expected = caster.oracle.silhouette(&lit_faces);
            tally.silhouette_edges += expected.len() as u64;
            let of_caster = found.silhouettes.iter().filter(|silhouette| silhouette.caster == index);
            let only_one_has = edge_differences(&expected, &edges_of(&caster.mesh, of_caster));
            if let Some(edge) = only_one_has.first() {
                tally.wrong_edges += only_one_has.len() as u64;
                tally.first_difference.get_or_insert_with(|| format!("{edge:?} of mesh {index} under {light:?}"));
            }
        }
        tally
    }
}

impl Found {
    /// What a frame left; `None` where its lists were too short.
    fn read(bytes: &[u8], layout: &Layout) -> Option<Self> {
        let [counters, lit, _] = layout.each_ref().map(|pages| pages.iter().sum::<u64>() as usize);
        let (counters, bytes) = bytes.split_at(counters);
        let (lit, mut lists) = bytes.split_at(lit);
        let pages: Vec<Counters> = bytemuck::pod_collect_to_vec(counters);
        let mut silhouettes = Vec::new();
        for (counters, size) in pages.iter().zip(&layout[2]) {
            let (list, others) = lists.split_at(*size as usize);
            let list: Vec<SilhouetteEdge> = bytemuck::pod_collect_to_vec(list);
            silhouettes.extend(list.get(..counters.silhouette_edges as usize)?);
            lists = others;
        }
        Some(Self { counters: pages.into_iter().sum(), lit: bytemuck::pod_collect_to_vec(lit), silhouettes })
    }
}

/// What comes back of a frame.
const FOUND: [BufferKind; 3] = [BufferKind::Counters, BufferKind::Lit, BufferKind::Silhouettes];

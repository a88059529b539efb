//! A scene whose meshes, casters and lights come and go in one object, and the same content in a fresh one.

use std::collections::BTreeMap;
use std::sync::Arc;

use contrejour_gpu::{CasterHandle, CasterInput, LightHandle, MeshHandle, Positions, ShadowOptions, Shadows, Untimed};
use contrejour_layout::{BLOCK_SIZE, Caster, Counters, Mask, SilhouetteEdge, WorkItem};
use contrejour_mesh::{MaskedMesh, TopologyAwareMesh};
use contrejour_plan::{BufferKind, Light, ShadowSettings};
use glam::DMat4;

use crate::compare::{compare_exact, compare_records};
use crate::gpu::Gpu;
use crate::texture::read_maps;

/// One object, and what is in it in the order in which it came.
#[derive(Debug)]
pub struct ChangingScene<'a> {
    /// The library's object.
    pub shadows: Shadows,
    /// The meshes.
    pub meshes: Vec<(MeshHandle, Arc<TopologyAwareMesh>)>,
    /// The casters.
    pub casters: Vec<PlacedCaster>,
    /// The lights, each with its technique.
    pub lights: Vec<(LightHandle, Light, &'static str)>,
    /// What cuts some of the meshes.
    masks: BTreeMap<MeshHandle, Arc<MaskedMesh>>,
    gpu: &'a Gpu,
}

/// A caster and where it stands.
#[derive(Clone, Debug)]
pub struct PlacedCaster {
    /// Its handle.
    pub handle: CasterHandle,
    /// Its mesh, place and positions.
    pub input: CasterInput,
}

/// What a frame leaves: the silhouettes of each view, and all texels of each light's maps.
#[derive(Clone, Debug, Default)]
pub struct Left {
    silhouettes: Vec<Vec<SilhouetteEdge>>,
    maps: Vec<Vec<u8>>,
}

/// Frames until all lists must have had room: those of a scene that changed are short of quads now and then.
const MAX_FRAMES: usize = 6;

fn text(error: impl ToString) -> String {
    error.to_string()
}

impl<'a> ChangingScene<'a> {
    /// Nothing yet.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn new(gpu: &'a Gpu) -> Result<Self, String> {
        let shadows = Shadows::new(&gpu.device).map_err(text)?;
        Ok(Self { shadows, meshes: Vec::new(), casters: Vec::new(), lights: Vec::new(), masks: BTreeMap::new(), gpu })
    }

    /// The same content in a fresh object, in the order of the lists.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn anew(&self) -> Result<Self, String> {
        let mut anew = Self::new(self.gpu)?;
        let mut meshes = BTreeMap::new();
        for (handle, mesh) in &self.meshes {
            let added = match self.masks.get(handle) {
                Some(masked) => anew.add_masked_mesh(masked)?,
                None => anew.add_mesh(mesh)?,
            };
            meshes.insert(*handle, added);
        }
        for PlacedCaster { input, .. } in &self.casters {
            let mesh = *meshes.get(&input.mesh).ok_or("the caster's mesh is there")?;
            anew.add_caster(CasterInput { mesh, ..input.clone() })?;
        }
        for &(_, light, technique) in &self.lights {
            anew.add_light(&light, technique)?;
        }
        Ok(anew)
    }

    /// Adds a mesh.
    ///
    /// # Errors
    ///
    /// What the library refuses, here and below.
    pub fn add_mesh(&mut self, mesh: &Arc<TopologyAwareMesh>) -> Result<MeshHandle, String> {
        let handle = self.shadows.add_mesh(Arc::clone(mesh)).map_err(text)?;
        self.meshes.push((handle, Arc::clone(mesh)));
        Ok(handle)
    }

    /// Adds a mesh that a mask cuts.
    ///
    /// # Errors
    ///
    /// As [`add_mesh`](Self::add_mesh).
    pub fn add_masked_mesh(&mut self, mesh: &Arc<MaskedMesh>) -> Result<MeshHandle, String> {
        let handle = self.shadows.add_masked_mesh(mesh).map_err(text)?;
        self.meshes.push((handle, Arc::clone(mesh.mesh())));
        self.masks.insert(handle, Arc::clone(mesh));
        Ok(handle)
    }

    /// Adds a caster.
    ///
    /// # Errors
    ///
    /// As [`add_mesh`](Self::add_mesh).
    pub fn add_caster(&mut self, input: CasterInput) -> Result<CasterHandle, String> {
        let handle = self.shadows.add_caster(&input).map_err(text)?;
        self.casters.push(PlacedCaster { handle, input });
        Ok(handle)
    }

    /// Adds a caster with the positions of its mesh.
    ///
    /// # Errors
    ///
    /// As [`add_mesh`](Self::add_mesh).
    pub fn place(&mut self, mesh: MeshHandle, world_from_object: DMat4) -> Result<CasterHandle, String> {
        self.add_caster(CasterInput { mesh, world_from_object, positions: Positions::OfMesh })
    }

    /// Adds a light with small maps.
    ///
    /// # Errors
    ///
    /// As [`add_mesh`](Self::add_mesh).
    pub fn add_light(&mut self, light: &Light, technique: &'static str) -> Result<LightHandle, String> {
        let mut settings = ShadowSettings { map_size: 64, ..Default::default() };
        // The smoothies of the preset are narrow: wide ones reach all around a lamp.
        if technique != settings.technique.to_string() {
            settings.technique = technique.parse().map_err(text)?;
        }
        let handle = self.shadows.add_light(light, &ShadowOptions { settings, ..Default::default() }).map_err(text)?;
        self.lights.push((handle, *light, technique));
        Ok(handle)
    }

    /// Moves the caster of this index.
    ///
    /// # Errors
    ///
    /// As [`add_mesh`](Self::add_mesh).
    pub fn move_caster(&mut self, index: usize, world_from_object: DMat4) -> Result<(), String> {
        let PlacedCaster { handle, input } = &mut self.casters[index];
        input.world_from_object = world_from_object;
        self.shadows.place_caster(*handle, &world_from_object).map_err(text)
    }

    /// Removes the caster of this index.
    ///
    /// # Errors
    ///
    /// As [`add_mesh`](Self::add_mesh).
    pub fn remove_caster(&mut self, index: usize) -> Result<PlacedCaster, String> {
        let caster = self.casters.remove(index);
        self.shadows.remove_caster(caster.handle).map_err(text)?;
        Ok(caster)
    }

    /// Removes the mesh of this index.
    ///
    /// # Errors
    ///
    /// As [`add_mesh`](Self::add_mesh).
    pub fn remove_mesh(&mut self, index: usize) -> Result<(), String> {
        let (handle, _) = self.meshes.remove(index);
        self.masks.remove(&handle);
        self.shadows.remove_mesh(handle).map_err(text)
    }

    /// Removes the light of this index.
    ///
    /// # Errors
    ///
    /// As [`add_mesh`](Self::add_mesh).
    pub fn remove_light(&mut self, index: usize) -> Result<(), String> {
        let (handle, ..) = self.lights.remove(index);
        self.shadows.remove_light(handle).map_err(text)
    }

    /// The mesh of a caster.
    ///
    /// # Panics
    ///
    /// When its mesh was removed before it.
    pub fn mesh_of(&self, caster: &PlacedCaster) -> &TopologyAwareMesh {
        let found = self.meshes.iter().find(|(handle, _)| *handle == caster.input.mesh);
        &found.expect("the caster's mesh is there").1
    }

    /// Prepares, records and submits one frame, and waits for nothing.
    ///
    /// # Errors
    ///
    /// As [`add_mesh`](Self::add_mesh).
    pub fn frame(&mut self) -> Result<(), String> {
        self.shadows.prepare(&self.gpu.device, &self.gpu.queue).map_err(text)?;
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        self.shadows.encode(&mut encoder, &mut Untimed);
        self.gpu.queue.submit([encoder.finish()]);
        Ok(())
    }

    /// Draws all lights until all lists had room, and reads what that left. Casters are named by their place in the list.
    ///
    /// # Errors
    ///
    /// As [`add_mesh`](Self::add_mesh).
    pub fn left(&mut self) -> Result<Left, String> {
        self.shadows.redraw();
        let silhouettes = self.draw()?;
        let by_slot: BTreeMap<_, _> =
            self.casters.iter().zip(0..).map(|(caster, at)| (caster.handle.index(), at)).collect();
        let mut left = Left::default();
        for (handle, ..) in &self.lights {
            left.maps.push(read_maps(self.gpu, &self.shadows, *handle)?);
            for (_, edges) in silhouettes.iter().filter(|(light, _)| light == handle) {
                let named = |edge: &SilhouetteEdge| {
                    let caster = *by_slot.get(&(edge.caster as usize)).ok_or("a silhouette is nobody's")?;
                    Ok(SilhouetteEdge { caster, ..*edge })
                };
                left.silhouettes.push(edges.iter().map(named).collect::<Result<_, String>>()?);
            }
        }
        Ok(left)
    }

    /// Draws until all lists had room. Returns the silhouettes of each view of the lights that have some.
    fn draw(&mut self) -> Result<Vec<(LightHandle, Vec<SilhouetteEdge>)>, String> {
        let Gpu { device, queue, .. } = self.gpu;
        for _ in 0..MAX_FRAMES {
            let mut lists = Vec::new();
            self.shadows.prepare(device, queue).map_err(text)?;
            let mut encoder = device.create_command_encoder(&Default::default());
            self.shadows.encode_each(&mut encoder, &mut Untimed, |encoder, view| {
                let pages = view.buffers(BufferKind::Counters).zip(view.buffers(BufferKind::Silhouettes));
                for (counters, silhouettes) in pages {
                    let copies = [counters, silhouettes].map(|buffer| copy(device, encoder, buffer));
                    lists.push(((view.light, view.view), copies));
                }
            });
            queue.submit([encoder.finish()]);
            self.shadows.wait_for_counters(device).map_err(text)?;
            if self.shadows.is_complete() {
                // Pages one after the other.
                let read = |page: &(_, [wgpu::Buffer; 2])| {
                    let [counters, edges] = &page.1;
                    let counted: Counters = self.gpu.read_back(counters, 1)[0];
                    self.gpu.read_back::<SilhouetteEdge>(edges, counted.silhouette_edges as usize)
                };
                let views = lists.chunk_by(|page, next| page.0 == next.0);
                return Ok(views.map(|pages| (pages[0].0.0, pages.iter().flat_map(read).collect())).collect());
            }
            self.shadows.redraw();
        }
        Err("lists never had room".into())
    }

    /// The caster's record on the device, as the first page has it.
    ///
    /// # Panics
    ///
    /// When no frame was prepared.
    pub fn record(&self, caster: CasterHandle) -> Caster {
        let buffer = self.buffer(BufferKind::Casters);
        self.gpu.read_back::<Caster>(buffer, caster.index() + 1)[caster.index()]
    }

    /// A list of blocks on the device, as the first page has it.
    ///
    /// # Panics
    ///
    /// When no frame was prepared.
    pub fn blocks(&self, kind: BufferKind) -> Vec<WorkItem> {
        let counts = self.shadows.plan(self.lights[0].0).expect("a frame was prepared").pages[0].counts;
        let count = if kind == BufferKind::FaceBlocks { counts.face_blocks } else { counts.edge_blocks };
        self.gpu.read_back(self.buffer(kind), count as usize)
    }

    /// A buffer that all lights share; the first page's.
    ///
    /// # Panics
    ///
    /// When no plan lists it.
    pub fn buffer(&self, kind: BufferKind) -> &wgpu::Buffer {
        self.shadows.buffer(kind).unwrap_or_else(|| panic!("no plan lists {}", kind.name())).buffer()
    }
}

/// What a frame leaves in both: the silhouettes in any order, and all texels.
///
/// # Errors
///
/// The first difference.
pub fn compare_left(expected: &Left, found: &Left) -> Result<(), String> {
    if expected.silhouettes.len() != found.silhouettes.len() || expected.maps.len() != found.maps.len() {
        return Err("there are not as many views".into());
    }
    for (index, (expected, found)) in expected.silhouettes.iter().zip(&found.silhouettes).enumerate() {
        compare_records("silhouette edge", expected, found, 0.0).map_err(|error| format!("list {index}: {error}"))?;
    }
    for (index, (expected, found)) in expected.maps.iter().zip(&found.maps).enumerate() {
        compare_exact(&format!("maps of light {index}"), expected, found)?;
    }
    Ok(())
}

impl Left {
    /// Silhouette edges of all views together.
    pub fn edge_count(&self) -> usize {
        self.silhouettes.iter().map(Vec::len).sum()
    }

    /// Whether the maps of the light of this index are the same in both.
    pub fn has_the_same_maps(&self, other: &Self, light: usize) -> bool {
        self.maps[light] == other.maps[light]
    }
}

/// Bytes of a mesh in all pools.
pub fn mesh_bytes(mesh: &TopologyAwareMesh) -> u64 {
    let positions = size_of_val(&mesh.positions[..]);
    let faces = size_of_val(&mesh.faces[..]) + size_of::<[f32; 4]>() * mesh.faces.len();
    let edges = size_of_val(&mesh.edges[..mesh.candidate_edge_count as usize]) + size_of_val(&mesh.incidences[..]);
    let vertex_edges = size_of_val(&mesh.vertex_edge_offsets[..]) + size_of_val(&mesh.vertex_edges[..]);
    (positions + faces + edges + vertex_edges) as u64
}

/// Bytes of a mask, its mesh apart.
pub fn mask_bytes(mesh: &MaskedMesh) -> u64 {
    let mask = mesh.mask();
    (size_of::<Mask>() + 12 * mask.coordinates.len()) as u64 + mask.image.level_bytes()
}

/// Bytes of the blocks of a caster of a mesh.
pub fn block_bytes(mesh: &TopologyAwareMesh) -> u64 {
    let blocks = (mesh.faces.len() as u32).div_ceil(BLOCK_SIZE) + mesh.candidate_edge_count.div_ceil(BLOCK_SIZE);
    u64::from(blocks) * size_of::<WorkItem>() as u64
}

fn copy(device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, part: wgpu::BufferSlice<'_>) -> wgpu::Buffer {
    let copy = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("copy"),
        size: part.size(),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    encoder.copy_buffer_to_buffer(part.buffer(), part.offset(), &copy, 0, part.size());
    copy
}

//! A stage over a scene's lights, in one way or the other.

use std::time::Duration;

use bytemuck::{bytes_of, pod_collect_to_vec};
use contrejour_gpu::stages::ComputeStage;
use contrejour_layout::{Counters, RecheckWord, SilhouetteEdge};
use contrejour_plan::{BufferKind, Stage};
use contrejour_render::{Gpu, read_buffer};

use crate::kernel::{Kernel, time};
use crate::scene::{Scene, buffer};

/// How lights read faces and edges.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Reads {
    /// A dispatch for each light.
    Apart,
    /// One for all.
    Shared,
}

/// What is found for a light.
#[derive(PartialEq, Eq)]
pub struct Found {
    /// Lit bits, or sides of outlines.
    pub words: Vec<u32>,
    /// Words with undecided faces, or edges of the silhouette; sorted.
    pub listed: Vec<[u32; 4]>,
}

pub struct Run<'a> {
    scene: &'a Scene,
    stage: Stage,
    kernel: &'a Kernel,
    lights: usize,
    reads: Reads,
    /// One for each dispatch.
    bind_groups: Vec<wgpu::BindGroup>,
    /// One for each dispatch.
    counters: Vec<wgpu::Buffer>,
    /// Lit bits or outline sides; lights that read apart share them, as they do in a frame.
    words: wgpu::Buffer,
    list: wgpu::Buffer,
}

impl<'a> Run<'a> {
    pub fn new(
        gpu: &Gpu,
        scene: &'a Scene,
        stage: &ComputeStage,
        kernel: &'a Kernel,
        (lights, reads): (usize, Reads),
    ) -> Self {
        let shares = if reads == Reads::Shared { lights } else { 1 };
        let dispatches = lights / shares;
        let empty = |size: u64| buffer(gpu, &vec![0; size as usize], wgpu::BufferUsages::STORAGE);
        let (words, list) = match stage.stage {
            // A byte a face is eight times a bit a face, however many lights share it.
            Stage::ClassifyFaces => {
                let words = scene.buffer(BufferKind::Lit).size() * if reads == Reads::Shared { 8 } else { 1 };
                (empty(words), empty(shares as u64 * scene.buffer(BufferKind::RecheckWords).size()))
            }
            _ => {
                let edges = u64::from(scene.view.silhouette_capacity) * shares as u64;
                let words = shares as u64 * scene.buffer(BufferKind::OutlineSides).size();
                (empty(words), empty(edges * size_of::<SilhouetteEdge>() as u64))
            }
        };
        let counters: Vec<_> = (0..dispatches).map(|_| empty((shares * size_of::<Counters>()) as u64)).collect();
        let bind = |(dispatch, counters): (usize, &wgpu::Buffer)| {
            let caster_lights = scene.caster_lights(gpu, dispatch * shares..(dispatch + 1) * shares);
            let lit = if reads == Reads::Shared { scene.lit_bytes(gpu) } else { scene.lit(gpu, dispatch) };
            let of_kind = |kind: &BufferKind| match kind {
                BufferKind::Counters => counters,
                BufferKind::CasterLights => &caster_lights,
                BufferKind::RecheckWords | BufferKind::Silhouettes => &list,
                BufferKind::OutlineSides => &words,
                BufferKind::Lit if stage.stage == Stage::ClassifyFaces => &words,
                BufferKind::Lit => &lit,
                kind => scene.buffer(*kind),
            };
            kernel.bind(gpu, &stage.stage.buffers().iter().map(of_kind).collect::<Vec<_>>())
        };
        let bind_groups = counters.iter().enumerate().map(bind).collect();
        Self { scene, stage: stage.stage, kernel, lights, reads, bind_groups, counters, words, list }
    }

    pub fn time(&self, gpu: &Gpu) -> Duration {
        self.reset(gpu);
        time(gpu, |encoder| {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            self.bind_groups.iter().for_each(|bind_group| self.kernel.dispatch(&mut pass, bind_group, self.groups()));
        })
    }

    /// What is found for each light.
    pub fn found(&self, gpu: &Gpu) -> Vec<Found> {
        self.reset(gpu);
        let shares = self.lights / self.bind_groups.len();
        let mut found = Vec::new();
        for (bind_group, counters) in self.bind_groups.iter().zip(&self.counters) {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            encoder.clear_buffer(&self.words, 0, None);
            self.kernel.dispatch(&mut encoder.begin_compute_pass(&Default::default()), bind_group, self.groups());
            gpu.queue.submit([encoder.finish()]);
            let read = |buffer| read_buffer(gpu, buffer, buffer.size()).expect("it can be read");
            let counters: Vec<Counters> = pod_collect_to_vec(&read(counters));
            let [words, list] = [&self.words, &self.list].map(read);
            let lists = list.chunks_exact(list.len() / shares);
            let of_light = |(light, (counters, list)): (usize, (&Counters, &[u8]))| Found {
                words: self.words_of(&words, light, shares),
                listed: self.listed(list, counters),
            };
            found.extend(counters.iter().zip(lists).enumerate().map(of_light));
        }
        found
    }

    fn words_of(&self, words: &[u8], light: usize, shares: usize) -> Vec<u32> {
        if self.stage == Stage::ClassifyFaces && self.reads == Reads::Shared {
            let word =
                |faces: &[u8]| (0..).zip(faces).fold(0, |word, (i, face)| word | u32::from(face >> light & 1) << i);
            return words.chunks_exact(32).map(word).collect();
        }
        let size = words.len() / shares;
        pod_collect_to_vec(&words[light * size..][..size])
    }

    fn listed(&self, list: &[u8], counters: &Counters) -> Vec<[u32; 4]> {
        let mut listed: Vec<_> = if self.stage == Stage::ClassifyFaces {
            let words: Vec<RecheckWord> = pod_collect_to_vec(list);
            words[..counters.recheck_words as usize]
                .iter()
                .map(|word| [word.caster, word.word, word.faces, 0])
                .collect()
        } else {
            let edges: Vec<SilhouetteEdge> = pod_collect_to_vec(list);
            let edges = &edges[..counters.silhouette_edges as usize];
            edges.iter().map(|edge| [edge.caster, edge.edge_id, edge.left, edge.right]).collect()
        };
        listed.sort_unstable();
        listed
    }

    fn groups(&self) -> u32 {
        match self.stage {
            Stage::ClassifyFaces => self.scene.counters.face_items.div_ceil(32),
            _ => self.scene.counters.edge_items,
        }
    }

    fn reset(&self, gpu: &Gpu) {
        for counters in &self.counters {
            let each = bytes_of(&self.scene.counters).repeat(counters.size() as usize / size_of::<Counters>());
            gpu.queue.write_buffer(counters, 0, &each);
        }
    }
}

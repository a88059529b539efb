//! How fast edges and their faces are found, against two other ways.
//!
//! `cargo bench -p contrejour-lab --features meshopt --bench edges [-- ROUNDS]`
//!
//! All start from the positions and vertex indices of a torus of a million triangles in shuffled order. They take
//! turns in one process, so that whatever else the machine does meets all of them alike; the medians are compared.

// The counting allocator below is the one thing that needs it.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::collections::BTreeMap;
use std::hint::black_box;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

use contrejour_lab::{Triangles, torus};
use contrejour_mesh::{BuildOptions, EdgeTable, TopologyAwareMesh};
use meshopt::VertexDataAdapter;

#[global_allocator]
static MEMORY: CountingAllocator = CountingAllocator { in_use: AtomicUsize::new(0), most: AtomicUsize::new(0) };

fn main() {
    // cargo passes `--bench` as well.
    let rounds = std::env::args().skip(1).find_map(|argument| argument.parse().ok()).unwrap_or(9);
    let mut mesh = torus(1000, 500);
    mesh.shuffle();
    println!(
        "{} triangles, {} vertices, {} threads, {rounds} rounds",
        mesh.triangles.len(),
        mesh.positions.len(),
        std::thread::available_parallelism().map_or(1, usize::from),
    );

    let contestants: [Contestant; 4] = [
        ("ordered map from edge to triangles", |mesh| time(|| ordered_map(mesh))),
        ("meshopt's adjacency generator", |mesh| time(|| meshopt_adjacency(mesh))),
        ("edges with their faces", |mesh| time(|| edge_table(mesh))),
        ("whole TopologyAwareMesh with report", |mesh| time(|| topology_aware_mesh(mesh))),
    ];
    let mut times = contestants.map(|_| Vec::new());
    for _ in 0..rounds {
        for ((_, run), times) in contestants.iter().zip(&mut times) {
            times.push(run(&mesh));
        }
    }
    let medians = times.map(median);
    let [map, meshopt, ..] = medians;
    for ((name, _), time) in contestants.iter().zip(medians) {
        println!(
            "{name:<36} {:8.1} ms   map / this {:5.2}   meshopt / this {:5.2}",
            time.as_secs_f64() * 1e3,
            map.as_secs_f64() / time.as_secs_f64(),
            meshopt.as_secs_f64() / time.as_secs_f64(),
        );
    }

    println!("Most memory beyond input and result:");
    for (name, bytes) in [
        ("edges with their faces", bytes_beyond_result(|| edge_table(&mesh))),
        ("whole TopologyAwareMesh with report", bytes_beyond_result(|| topology_aware_mesh(&mesh))),
    ] {
        println!("{name:<36} {:8.1} bytes a triangle", bytes as f64 / mesh.triangles.len() as f64);
    }
}

/// A name, and what runs once on the mesh and gives the time without freeing the result.
type Contestant = (&'static str, fn(&Triangles) -> Duration);

fn ordered_map(mesh: &Triangles) -> BTreeMap<(u32, u32), Vec<u32>> {
    let mut faces_of_edge = BTreeMap::<_, Vec<u32>>::new();
    for (&[a, b, c], face) in mesh.triangles.iter().zip(0..) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            faces_of_edge.entry((from.min(to), from.max(to))).or_default().push(face);
        }
    }
    faces_of_edge
}

fn meshopt_adjacency(mesh: &Triangles) -> Vec<u32> {
    let bytes = meshopt::typed_to_bytes(&mesh.positions);
    let vertices = VertexDataAdapter::new(bytes, size_of::<[f32; 3]>(), 0).expect("positions are whole");
    meshopt::generate_adjacency_indices(mesh.triangles.as_flattened(), &vertices)
}

fn edge_table(mesh: &Triangles) -> EdgeTable {
    EdgeTable::build(&mesh.positions, &mesh.triangles).expect("the torus has edges")
}

fn topology_aware_mesh(mesh: &Triangles) -> TopologyAwareMesh {
    TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default())
        .expect("the torus has a topology")
}

/// Time of one run. The result is dropped after the clock has stopped.
fn time<Result>(run: impl FnOnce() -> Result) -> Duration {
    let start = Instant::now();
    let result = black_box(run());
    let time = start.elapsed();
    drop(result);
    time
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times[times.len() / 2]
}

/// Most bytes in use at one time, less those before and those that the result keeps.
fn bytes_beyond_result<Result>(run: impl FnOnce() -> Result) -> usize {
    let before = MEMORY.in_use.load(Relaxed);
    MEMORY.most.store(before, Relaxed);
    let result = black_box(run());
    let (after, most) = (MEMORY.in_use.load(Relaxed), MEMORY.most.load(Relaxed));
    drop(result);
    most - before.max(after)
}

/// The system's allocator, and how much it has given away.
struct CountingAllocator {
    in_use: AtomicUsize,
    most: AtomicUsize,
}

impl CountingAllocator {
    fn count(&self, more: usize, less: usize) {
        let before = self.in_use.fetch_add(more, Relaxed);
        self.most.fetch_max(before + more, Relaxed);
        self.in_use.fetch_sub(less, Relaxed);
    }
}

// SAFETY: every call is passed on unchanged to the system's allocator; counting touches no memory that it manages.
unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        self.count(layout.size(), 0);
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        self.count(layout.size(), 0);
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        self.count(0, layout.size());
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, new_size: usize) -> *mut u8 {
        self.count(new_size, layout.size());
        unsafe { System.realloc(memory, layout, new_size) }
    }
}

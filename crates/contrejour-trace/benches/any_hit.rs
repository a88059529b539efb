//! Any-hit rays through obvhs' binary tree and through its compressed 8-wide tree (Ylitie, Karras & Laine 2017), and
//! the whole tracer on the same scenes.
//!
//! `cargo bench -p contrejour-trace`
//!
//! A shape stands on a floor; rays go from points of the floor to points of a small disk light, as the tracer's do.
//! Both trees get the same builder's settings and the triangle test that comes with obvhs, so that they alone differ.

use core::time::Duration;
use std::f64::consts::TAU;
use std::fmt;

use contrejour_trace::{LightShape, OccluderMesh, Occluders, Receiver, TraceOptions, trace};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use glam::{DMat4, DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::Ray;
use obvhs::triangle::Triangle;

const LIGHT: DVec3 = DVec3::new(2.0, 6.0, 1.0);
const RADIUS: f64 = 0.3;
/// Receivers along a side of the square that is looked at.
const SIDE: u32 = 100;
const RAYS_EACH: u32 = 16;

fn main() {
    divan::main();
}

/// What stands on the floor.
#[derive(Clone, Copy)]
enum Shape {
    /// A smooth body of 200 000 faces.
    Torus,
    /// 1500 upright slats, each of two long thin faces.
    Slats,
}

impl fmt::Display for Shape {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Torus => "torus",
            Self::Slats => "slats",
        })
    }
}

const SHAPES: [Shape; 2] = [Shape::Torus, Shape::Slats];

#[divan::bench(args = SHAPES)]
fn binary_tree(bencher: Bencher, shape: Shape) {
    let faces = faces(shape);
    let tree = build_bvh2_from_tris(&faces, BvhBuildParams::medium_build(), &mut Duration::default());
    let faces: Vec<Triangle> = tree.primitive_indices.iter().map(|&index| faces[index as usize]).collect();
    cast(bencher, |ray| tree.ray_traverse_miss(ray, |ray, slot| faces[slot].intersect(ray)));
}

#[divan::bench(args = SHAPES)]
fn eight_wide_tree(bencher: Bencher, shape: Shape) {
    let faces = faces(shape);
    let tree = build_cwbvh_from_tris(&faces, BvhBuildParams::medium_build(), &mut Duration::default());
    let faces: Vec<Triangle> = tree.primitive_indices.iter().map(|&index| faces[index as usize]).collect();
    cast(bencher, |ray| tree.ray_traverse_miss(ray, |ray, slot| faces[slot].intersect(ray)));
}

/// The whole tracer with its default options, on all threads; an item is a receiver.
#[divan::bench(args = SHAPES)]
fn tracer(bencher: Bencher, shape: Shape) {
    let (positions, triangles) = mesh(shape);
    let occluders = Occluders::new(&[OccluderMesh::new(&positions, &triangles, DMat4::IDENTITY)])
        .expect("the shapes are finite and smaller than 2^32 faces");
    let light = LightShape::Disk { center: LIGHT, normal: LIGHT, radius: RADIUS };
    let receivers: Vec<Receiver> =
        floor_points().map(|position| Receiver { position, face: 0, seen_from: LIGHT }).collect();
    let ask = || {
        trace(&occluders, &light, &receivers, &TraceOptions::default(), &|_| ()).expect("light and receivers are good")
    };
    let answers = ask();
    let rays: u64 = answers.iter().map(|answer| u64::from(answer.samples)).sum();
    let without_rays = answers.iter().filter(|answer| answer.samples == 0).count();
    println!("{shape}: {rays} rays, {without_rays} of {} receivers without any", receivers.len());
    bencher.counter(ItemsCount::new(receivers.len())).bench(ask);
}

/// Times the rays of all receivers on one thread.
fn cast(bencher: Bencher, misses: impl Fn(Ray) -> bool + Sync) {
    let rays: Vec<Ray> = floor_points()
        .flat_map(|point| {
            (0..RAYS_EACH).map(move |i| {
                let angle = TAU * f64::from(i) / f64::from(RAYS_EACH);
                let target = LIGHT + RADIUS * DVec3::new(angle.cos(), 0.0, angle.sin());
                let towards = (target - point).as_vec3a();
                let start = (point + 1e-4 * DVec3::Y).as_vec3a();
                Ray::new(start, towards.normalize(), 0.0, towards.length())
            })
        })
        .collect();
    bencher.counter(ItemsCount::new(rays.len())).bench(|| black_box(&rays).iter().filter(|&&ray| misses(ray)).count());
}

/// Evenly spread over the floor around the shape.
fn floor_points() -> impl Iterator<Item = DVec3> {
    let place = |i: u32| 6.0 * ((f64::from(i) + 0.5) / f64::from(SIDE) - 0.5);
    (0..SIDE * SIDE).map(move |i| DVec3::new(place(i % SIDE), 0.0, place(i / SIDE)))
}

fn faces(shape: Shape) -> Vec<Triangle> {
    let (positions, triangles) = mesh(shape);
    let corner = |vertex: u32| Vec3A::from(positions[vertex as usize]);
    triangles.iter().map(|&[a, b, c]| Triangle { v0: corner(a), v1: corner(b), v2: corner(c) }).collect()
}

/// The floor, whose first face holds all receivers, and the shape.
fn mesh(shape: Shape) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let mut positions = vec![[-20.0, 0.0, -20.0], [0.0, 0.0, 40.0], [20.0, 0.0, -20.0_f32]];
    let mut triangles = vec![[0, 1, 2]];
    match shape {
        Shape::Torus => {
            let (around, across) = (500, 200);
            let first = positions.len() as u32;
            for (i, j) in (0..around).flat_map(|i| (0..across).map(move |j| (i, j))) {
                let [ring, tube] = [(i, around), (j, across)].map(|(step, of)| TAU * f64::from(step) / f64::from(of));
                let reach = 1.2 + 0.4 * tube.cos();
                let point = [reach * ring.cos(), 0.41 + 0.4 * tube.sin(), reach * ring.sin()];
                positions.push(point.map(|x| x as f32));
                let vertex = |i: u32, j: u32| first + (i % around) * across + j % across;
                let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        Shape::Slats => {
            for i in 0..1500_u32 {
                let first = positions.len() as u32;
                let (x, z) = ((i % 50) as f32 * 0.08 - 2.0, (i / 50) as f32 * 0.13 - 2.0);
                let (dx, dz) = (0.02 * (i as f32).cos(), 0.02 * (i as f32).sin());
                for (x, z) in [(x - dx, z - dz), (x + dx, z + dz)] {
                    positions.extend([[x, 0.01, z], [x, 1.0, z]]);
                }
                triangles.extend([[first, first + 1, first + 2], [first + 1, first + 3, first + 2]]);
            }
        }
    }
    (positions, triangles)
}

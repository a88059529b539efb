//! A mesh that is too large for the device's buffers is spread over pages, and nothing else is different.

use std::sync::Arc;

use contrejour_gpu::{CasterInput, Positions, ShadowOptions, Shadows};
use contrejour_layout::{Corner, Quad, SilhouetteEdge, VertexEdge};
use contrejour_oracle::{ManyLights, OracleTopology};
use contrejour_plan::{BufferKind, Light, MeshPiece, NearOne, ShadowSettings, caster_light, views};
use contrejour_tests::compare::{compare_exact, compare_records};
use contrejour_tests::gpu::{Gpu, draw_whole, gpu_with_small_buffers};
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::{lights, point};
use contrejour_tests::meshes::{TestMesh, shapes, shared_named, tiny};
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::texture::{read_depth, read_floats, read_half_floats, read_maps};
use glam::{DMat4, DVec3};
use libtest_mimic::Trial;

use crate::many_lights::text;
use crate::{closed, exact};

/// Bytes that a shader may see of a buffer.
const LIMITS: [u64; 3] = [5 << 10, 20 << 10, 80 << 10];

/// A mesh takes part where it fills so many pages.
const PAGES: std::ops::RangeInclusive<usize> = 2..=40;

/// With faces without area, edges of many faces, borders, and several casters of one mesh.
const FILES: [&str; 4] =
    ["nasty/deg_faces.obj", "nasty/hollowcube.obj", "closed/bunny-index.obj", "animated/RiggedFigure.glb"];

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("pages::leave_what_one_page_leaves", leave_what_one_page_leaves),
        gpu_trial("pages::what_casts_fits_one_page_and_the_rest_does_not", what_casts_fits_one_page),
        gpu_trial("pages::a_vertex_without_the_edges_of_other_pages_is_found", missing_neighbours_are_found),
    ]
}

/// Meshes without casters are on no page, where there is no room for all of them.
fn what_casts_fits_one_page(gpu: &Gpu) -> Outcome {
    let small = gpu_with_small_buffers(180 << 10)?;
    let maps = |gpu: &Gpu| -> Result<_, String> {
        let mut shadows = Shadows::new(&gpu.device).map_err(text)?;
        let mut smallest = None;
        for shape in shapes() {
            let topology = &shape.parts[0].topology;
            let mesh = shadows.add_mesh(Arc::clone(topology)).map_err(text)?;
            smallest = smallest.into_iter().chain([(topology.faces.len(), mesh)]).min();
        }
        let (_, mesh) = smallest.ok_or("there are shapes")?;
        let caster = CasterInput { mesh, world_from_object: DMat4::IDENTITY, positions: Positions::OfMesh };
        shadows.add_caster(&caster).map_err(text)?;
        let light = shadows.add_light(&point(DVec3::new(2.0, 3.0, 1.0), DVec3::ZERO, 2.0), &options()).map_err(text)?;
        draw_whole(gpu, &mut shadows, |_| ())?;
        let plan = shadows.plan(light).ok_or("a frame was prepared")?;
        let pages = plan.pages.iter().filter(|page| !page.casters.is_empty()).count();
        Ok((read_maps(gpu, &shadows, light)?, plan.pages.len(), pages))
    };
    let (expected, whole, _) = maps(gpu)?;
    let (found, all, used) = maps(&small)?;
    compare_exact("maps", &expected, &found)?;
    // Else something else is tried.
    if whole == 1 && all > 1 && used == 1 {
        Ok(())
    } else {
        Err(format!("{whole} pages, {all} of which {used} are used"))
    }
}

fn options() -> ShadowOptions {
    ShadowOptions { settings: ShadowSettings { map_size: 256, ..Default::default() }, ..Default::default() }
}

/// The lists and the maps of a frame.
struct Left {
    silhouettes: Vec<SilhouetteEdge>,
    quads: Vec<Quad>,
    corners: Vec<Corner>,
    maps: [Vec<f32>; 3],
}

fn left_by(gpu: &Gpu, pipeline: &mut Pipeline<'_>, light: &Light) -> Result<Left, String> {
    pipeline.complete_frame(light)?;
    let (silhouettes, quads, corners) = (pipeline.silhouettes(), pipeline.quads(), pipeline.corners());
    let maps = pipeline.maps();
    let (Some(depth), Some(smoothie_depth), Some(alpha)) =
        (maps.shadow_depth, maps.smoothie_depth, maps.smoothie_alpha)
    else {
        return Err("the plan lists no smoothies".into());
    };
    let maps = [read_floats(gpu, depth), read_depth(gpu, smoothie_depth), read_half_floats(gpu, alpha)];
    Ok(Left { silhouettes, quads, corners, maps })
}

fn compare(whole: &Left, paged: &Left) -> Outcome {
    compare_records("silhouette edge", &whole.silhouettes, &paged.silhouettes, 0.0)?;
    compare_records("quad", &whole.quads, &paged.quads, 0.0)?;
    compare_records("corner", &whole.corners, &paged.corners, 0.0)?;
    for (name, (whole, paged)) in
        ["shadow depth", "smoothie depth", "alpha"].iter().zip(whole.maps.iter().zip(&paged.maps))
    {
        compare_exact(name, whole, paged)?;
    }
    Ok(())
}

fn page_count(pipeline: &Pipeline<'_>) -> usize {
    pipeline.plan().map_or(0, |plan| plan.pages.len())
}

/// A mesh as a device cuts it; none where one page is enough, or where not even its positions fit.
fn paged<'a>(gpu: &'a Gpu, mesh: &TestMesh) -> Result<Option<Pipeline<'a>>, String> {
    let mut pipeline = Pipeline::new(gpu, mesh, &options())?;
    match pipeline.frame(&lights(mesh)[0]) {
        Ok(_) => Ok(PAGES.contains(&page_count(&pipeline)).then_some(pipeline)),
        Err(error) if error.contains("max_storage_buffer_binding_size") => Ok(None),
        Err(error) => Err(error),
    }
}

fn leave_what_one_page_leaves(gpu: &Gpu) -> Outcome {
    let mut meshes = tiny();
    meshes.extend(shapes());
    meshes.extend(shared_named(&FILES));
    let mut page_counts = Vec::new();
    for limit in LIMITS {
        let small = gpu_with_small_buffers(limit)?;
        for mesh in &meshes {
            let at = |difference: String| format!("{} in buffers of {limit} bytes: {difference}", mesh.name);
            if let Some(mut pipeline) = paged(&small, mesh).map_err(at)? {
                page_counts.push(page_count(&pipeline));
                check(gpu, &small, mesh, &mut pipeline).map_err(at)?;
            }
        }
    }
    let most = page_counts.iter().max().copied().unwrap_or(0);
    eprintln!("pages of the meshes: {page_counts:?}");
    if page_counts.len() >= 12 && most >= 12 {
        return Ok(());
    }
    Err(format!("only {} meshes were cut, into at most {most} pages", page_counts.len()))
}

fn check(gpu: &Gpu, small: &Gpu, mesh: &TestMesh, pipeline: &mut Pipeline<'_>) -> Outcome {
    let mut whole = Pipeline::new(gpu, mesh, &options())?;
    let oracles: Vec<_> = mesh
        .parts
        .iter()
        .map(|part| ManyLights::new(&OracleTopology::new(&part.topology.positions, &part.triangles)))
        .collect();
    for (index, light) in lights(mesh).iter().enumerate().step_by(8) {
        let at = |difference: String| format!("light {index}: {difference}");
        let expected = left_by(gpu, &mut whole, light).map_err(at)?;
        let found = left_by(small, pipeline, light).map_err(at)?;
        compare(&expected, &found).map_err(at)?;
        check_silhouettes(mesh, &oracles, light, &found.silhouettes).map_err(at)?;
    }
    if page_count(&whole) == 1 { Ok(()) } else { Err("a page is not enough without a small limit".into()) }
}

/// Exact for each caster that is in view, and closed for all.
fn check_silhouettes(mesh: &TestMesh, oracles: &[ManyLights], light: &Light, found: &[SilhouetteEdge]) -> Outcome {
    let view = views(light).map_err(|error| error.to_string())?[0];
    for ((part, oracle), caster) in mesh.parts.iter().zip(oracles).zip(0..) {
        let of_caster: Vec<_> = found.iter().filter(|edge| edge.caster == caster).copied().collect();
        closed::check(&part.topology, &of_caster)?;
        let near_one = NearOne::of_box(part.topology.bounds_min, part.topology.bounds_max);
        if !of_caster.is_empty() {
            let light = caster_light(&view, &part.world_from_object, &near_one);
            exact::check(&part.topology, oracle, &light, &of_caster)?;
        }
    }
    Ok(())
}

/// Vertices at the borders of pages need the edges that lie in other pages: without them corners are wrong, and the
/// comparison says so.
fn missing_neighbours_are_found(gpu: &Gpu) -> Outcome {
    let mesh = shapes().swap_remove(4);
    let lights = lights(&mesh);
    let small = gpu_with_small_buffers(LIMITS[1])?;
    let mut pipeline = Pipeline::new(&small, &mesh, &options())?;
    let mut whole = Pipeline::new(gpu, &mesh, &options())?;
    compare(&left_by(gpu, &mut whole, &lights[0])?, &left_by(&small, &mut pipeline, &lights[0])?)?;

    let pages = pipeline.plan().map_or(&[][..], |plan| &plan.pages);
    for (page, part) in pages.iter().zip(pipeline.shadows.buffers(BufferKind::VertexEdges)) {
        let buffer = part.buffer();
        let [piece] = page.pieces.as_slice() else { return Err("one mesh has one piece on each page".into()) };
        small.queue.write_buffer(buffer, 0, bytemuck::cast_slice(&lists_of_own_edges(&small, &mesh, piece, buffer)));
    }
    let expected = left_by(gpu, &mut whole, &lights[1])?;
    let found = left_by(&small, &mut pipeline, &lights[1])?;
    match compare(&expected, &found) {
        Err(difference) if difference.contains("corner") => Ok(()),
        other => Err(format!("the missing edges were not found in corners: {other:?}")),
    }
}

/// The vertex lists of a page with the edges of the page alone.
fn lists_of_own_edges(gpu: &Gpu, mesh: &TestMesh, piece: &MeshPiece, buffer: &wgpu::Buffer) -> Vec<u32> {
    let words: Vec<u32> = gpu.read_back(buffer, (buffer.size() / 4) as usize);
    let (offsets, lists) = words.split_at(mesh.parts[0].topology.vertex_edge_offsets.len());
    let own = piece.first_edge..piece.first_edge + piece.edges();
    let (mut own_offsets, mut own_lists) = (vec![0], Vec::new());
    for range in offsets.windows(2) {
        let edges: &[VertexEdge] = bytemuck::cast_slice(&lists[2 * range[0] as usize..2 * range[1] as usize]);
        let own_edges = edges.iter().filter(|edge| own.contains(&edge.edge_id));
        own_lists.extend(own_edges.flat_map(|edge| [edge.edge_id, edge.other_vertex]));
        own_offsets.push(own_lists.len() as u32 / 2);
    }
    own_offsets.extend(own_lists);
    own_offsets
}

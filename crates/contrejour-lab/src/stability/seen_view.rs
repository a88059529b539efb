//! What a case came to in one view, against exact arithmetic and the definitions.

use contrejour_layout::{CasterLight, Corner, Quad, SilhouetteEdge};
use contrejour_mirror::FrameOutputs;
use contrejour_oracle::{GapSearch, OracleTopology, blocker_image, open_vertices, outline_gaps};
use contrejour_plan::{NearOne, View};
use glam::{DVec2, Mat4, Vec3};

use super::case::Case;
use super::checks::{FaceSigns, WidthDefinition, bare_lit, missing_quads, non_finite, wrong_edges, wrong_signs};
use super::device::{DeviceMesh, DeviceOutputs};
use super::row::Row;
use crate::mirror_frame::MirrorFrame;

/// Faces up to which the silhouette itself is compared, and not only its faces and that it is closed: the oracle keeps
/// a tree of all edges.
const ORACLE_FACES_MAX: usize = 50_000;

/// What the device and the twins made of a case for one view.
pub(super) struct SeenView<'a> {
    pub case: &'a Case,
    pub meshes: &'a [DeviceMesh],
    pub view: &'a View,
    pub frame: &'a MirrorFrame<'a>,
    pub twin: &'a FrameOutputs,
    pub found: &'a DeviceOutputs,
}

impl SeenView<'_> {
    /// Faces and silhouettes, caster by caster; nothing where the technique runs no stages that find them.
    pub fn compare_silhouettes(&self, row: &mut Row) {
        let Self { case, frame, twin, found, .. } = self;
        let Some(found_lit) = &found.lit else { return };
        let (mut faces, mut wrong_f32, mut wrong, mut open) = (0, 0, 0, 0);
        for &index in &found.casting {
            let (mesh, light) = (&*self.meshes[index].topology, &frame.caster_lights[index]);
            let exact = FaceSigns::exact(mesh, light);
            // All casters have room for their bits, on the device too.
            let first_lit_word = frame.casters[index].first_lit_word as usize;
            let lit = [&twin.lit, found_lit].map(|lit| &lit[first_lit_word..]);
            faces += mesh.faces.len() as u64;
            wrong_f32 += wrong_signs(&exact, &[&bare_lit(mesh, light)]);
            wrong += wrong_signs(&exact, &lit);

            let of_caster = |edges: &[SilhouetteEdge]| -> Vec<SilhouetteEdge> {
                edges.iter().filter(|edge| edge.caster as usize == index).copied().collect()
            };
            let lists = [&twin.silhouettes, &found.silhouettes].map(|list| of_caster(list));
            let source = &case.meshes[index];
            let expected = (mesh.faces.len() <= ORACLE_FACES_MAX).then(|| {
                OracleTopology::new(&source.positions, &source.triangles)
                    .silhouette(light.light_object.map(f32::from_bits), light.mirrored == 1)
            });
            for list in &lists {
                open += open_vertices(&mesh.edges, list).len() as u64;
                wrong += expected.as_ref().map_or(0, |expected| wrong_edges(&mesh.edges, expected, list));
            }
        }
        add(&mut row.faces_tested, faces);
        add(&mut row.sign_errors_f32, wrong_f32);
        add(&mut row.sign_errors, wrong);
        add(&mut row.open_cycles, open);
    }

    /// What is drawn.
    pub fn compare_smoothies(&self, row: &mut Row) {
        let Self { case, meshes, view, frame, twin, found } = self;
        add(&mut row.non_finite, found.non_finite + non_finite(&twin.quads) + non_finite(&twin.corners));
        let has_image = |edge: &&SilhouetteEdge| frame.caster_lights[edge.caster as usize].has_image();
        let missing = [(&found.silhouettes, &found.quads), (&twin.silhouettes, &twin.quads)].map(|(edges, quads)| {
            let edges: Vec<_> = edges.iter().filter(has_image).copied().collect();
            missing_quads(view, meshes, &edges, quads)
        });
        if found.lit.is_some() {
            add(&mut row.gaps, missing[0].max(missing[1]));
        }
        let Some(definition) = WidthDefinition::new(view, &case.settings) else { return };
        let drawn = [(&found.quads, &found.corners), (&twin.quads, &twin.corners)];
        let errors = drawn.iter().filter_map(|(quads, corners)| definition.error(meshes, quads, corners));
        row.width_error = row.width_error.into_iter().chain(errors).reduce(f64::max);

        let points = case.gap_search.as_ref().and_then(|search| {
            let blockers = blockers(meshes, frame);
            drawn.iter().map(|(quads, corners)| gap_points(quads, corners, &blockers, search)).max()
        });
        add(&mut row.gaps, points.unwrap_or(0));
    }
}

/// Adds to a cell what one more view counted.
fn add(cell: &mut Option<u64>, count: u64) {
    *cell = Some(cell.unwrap_or(0) + count);
}

fn gap_points(quads: &[Quad], corners: &[Corner], blockers: &[[DVec2; 3]], search: &GapSearch) -> u64 {
    outline_gaps(quads, corners, blockers, search).len() as u64
}

/// Images of all faces, by the very matrices that the stages get.
fn blockers(meshes: &[DeviceMesh], frame: &MirrorFrame) -> Vec<[DVec2; 3]> {
    let of_mesh = |(mesh, light): (&DeviceMesh, &CasterLight)| {
        let topology = &mesh.topology;
        let NearOne { origin, scale } = NearOne::of_box(topology.bounds_min, topology.bounds_max);
        let near_one = |&position: &[f32; 3]| scale * (Vec3::from(position) - Vec3::from(origin));
        let positions: Vec<_> = topology.positions.iter().map(near_one).collect();
        let faces: Vec<_> = topology.faces.iter().map(|face| [face.a, face.b, face.c]).collect();
        blocker_image(&positions, &faces, &Mat4::from_cols_array(&light.light_clip_from_object))
    };
    meshes.iter().zip(&frame.caster_lights).flat_map(of_mesh).collect()
}

#[cfg(test)]
mod tests {
    use contrejour_plan::{CubeFace, frame_views};
    use glam::DMat4;

    use super::*;
    use crate::stability::families::a_lamp_amid_a_ring;

    /// What the device would leave where it did as the twins.
    fn as_twins(made: &FrameOutputs) -> DeviceOutputs {
        DeviceOutputs {
            casting: vec![0],
            lit: Some(made.lit.clone()),
            silhouettes: made.silhouettes.clone(),
            quads: made.quads.clone(),
            corners: made.corners.clone(),
            non_finite: 0,
        }
    }

    #[test]
    fn the_outputs_of_another_view_and_a_lost_edge_are_found() {
        let case = a_lamp_amid_a_ring();
        let meshes = [DeviceMesh::new(&case.meshes[0]).expect("a good mesh")];
        let views = frame_views(&case.light, None, &case.settings).expect("a good lamp").views;
        let frames: Vec<_> = (views.iter())
            .map(|view| MirrorFrame::of_view(&[(&*meshes[0].topology, DMat4::IDENTITY)], view, &case.settings))
            .collect();
        let made: Vec<_> = frames.iter().map(MirrorFrame::run).collect();
        let row = |view: usize, found: &DeviceOutputs| {
            let mut row = Row { visibility_error_max: 1.0, ..Row::default() };
            let seen = SeenView {
                case: &case,
                meshes: &meshes,
                view: &views[view],
                frame: &frames[view],
                twin: &made[view],
                found,
            };
            seen.compare_silhouettes(&mut row);
            seen.compare_smoothies(&mut row);
            row
        };
        for (view, made) in made.iter().enumerate() {
            let sound = row(view, &as_twins(made));
            assert_eq!((sound.faults(), sound.faces_tested), (0, Some(768)), "view {view}: {sound:?}");
        }

        let view = CubeFace::PositiveX.index();
        let other = row(view, &as_twins(&made[CubeFace::NegativeX.index()]));
        assert!(other.gaps > Some(0) && other.faults() > 0, "{other:?}");
        let none = row(view, &DeviceOutputs { lit: None, ..as_twins(&made[view]) });
        assert_eq!((none.faces_tested, none.sign_errors, none.open_cycles), (None, None, None), "nothing was tested");
        let mut lost = as_twins(&made[view]);
        lost.silhouettes.pop();
        let lost = row(view, &lost);
        assert!(lost.sign_errors > Some(0) && lost.open_cycles > Some(0), "{lost:?}");
    }
}

//! The properties on what proptest makes up: the same that the fuzz targets check.

mod found;
mod mutations;
mod seeds;

use arbitrary::{Arbitrary, Unstructured};
use contrejour_properties::{
    Caster, Format, check_mesh_file, check_picture, check_rig, check_scene_text, check_silhouette,
};
use proptest::prelude::*;

use mutations::{Mutation, mutate, mutations};
use seeds::{picture_seeds, scene_seeds, seeds};

/// One of the seeds with some mutations.
fn mutated(format: Format) -> impl Strategy<Value = Vec<u8>> {
    let seeds = seeds(format);
    (0..seeds.len(), mutations()).prop_map(move |(seed, mutations)| mutate(&seeds[seed], &mutations))
}

fn mutated_picture() -> impl Strategy<Value = Vec<u8>> {
    let seeds = picture_seeds();
    (0..seeds.len(), mutations()).prop_map(move |(seed, mutations)| mutate(&seeds[seed], &mutations))
}

fn mutated_scene() -> impl Strategy<Value = String> {
    let seeds = scene_seeds();
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    (0..seeds.len(), mutations())
        .prop_map(move |(seed, mutations): (usize, Vec<Mutation>)| text(mutate(seeds[seed].as_bytes(), &mutations)))
}

/// Bytes that are often too few, as fuzzers' are, so that the end of a made-up caster is plain.
fn caster() -> impl Strategy<Value = Caster> {
    let bytes = prop::collection::vec(any::<u8>(), 0..600);
    bytes.prop_filter_map("enough bytes", |bytes| Caster::arbitrary_take_rest(Unstructured::new(&bytes)).ok())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(512) })]

    #[test]
    fn any_bytes_are_refused_or_load(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        for format in Format::ALL {
            check_mesh_file(format, &bytes);
        }
    }

    #[test]
    fn mutated_obj_files_are_refused_or_load(bytes in mutated(Format::Obj)) {
        check_mesh_file(Format::Obj, &bytes);
    }

    #[test]
    fn mutated_gltf_files_are_refused_or_load(bytes in mutated(Format::Gltf)) {
        check_mesh_file(Format::Gltf, &bytes);
    }

    #[test]
    fn mutated_rigs_are_refused_or_move(bytes in mutated(Format::Gltf)) {
        check_rig(&bytes);
    }

    #[test]
    fn mutated_ply_files_are_refused_or_load(bytes in mutated(Format::Ply)) {
        check_mesh_file(Format::Ply, &bytes);
    }

    #[test]
    fn mutated_stl_files_are_refused_or_load(bytes in mutated(Format::Stl)) {
        check_mesh_file(Format::Stl, &bytes);
    }

    #[test]
    fn mutated_pictures_are_refused_or_decoded(bytes in mutated_picture()) {
        check_picture(&bytes);
    }

    #[test]
    fn any_text_is_refused_or_is_a_scene(text in any::<String>()) {
        check_scene_text(&text);
    }

    #[test]
    fn mutated_scenes_are_refused_or_are_scenes(text in mutated_scene()) {
        check_scene_text(&text);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2048) })]

    #[test]
    fn any_triangles_have_the_exact_closed_silhouette(caster in caster()) {
        check_silhouette(&caster);
    }
}

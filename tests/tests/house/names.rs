//! A stage has one name, and that name is a file on every side.

use contrejour_plan::{SceneStage, Stage};

use crate::modules::{parse, stems};

/// Compares a side's files with the stages; the side may have other files too where `others` says so.
fn compare(side: &str, stages: &[String], files: &[String], others: bool) -> Result<(), String> {
    if let Some(missing) = stages.iter().find(|stage| !files.contains(stage)) {
        return Err(format!("{side} has no file {missing}"));
    }
    match files.iter().find(|file| !others && !stages.contains(file)) {
        Some(file) => Err(format!("{side} has a file {file}, which is no stage")),
        None => Ok(()),
    }
}

fn stages() -> Vec<String> {
    let names = SceneStage::ALL.map(SceneStage::name).into_iter().chain(Stage::ALL.map(Stage::name));
    names.map(str::to_owned).collect()
}

#[test]
fn stages_have_the_same_names_on_all_sides() {
    let gpu: Vec<_> =
        stems("crates/contrejour-gpu/src/stages", ".rs").into_iter().filter(|stem| stem != "mod").collect();
    let sides = [
        ("shaders/compute", stems("shaders/compute", ".wgsl"), false),
        ("the library", gpu, false),
        ("the mirror", stems("crates/contrejour-mirror/src", ".rs"), true),
        ("the tests", stems("tests/tests/stages", ".rs"), true),
    ];
    for (side, files, others) in sides {
        assert_eq!(compare(side, &stages(), &files, others), Ok(()));
    }
}

#[test]
fn the_library_runs_them_in_the_order_of_the_plan() {
    let library: Vec<_> = contrejour_gpu::stages::ALL.iter().map(|stage| stage.stage.name()).collect();
    assert_eq!(library, Stage::ALL.map(Stage::name));
    let once_a_frame: Vec<_> = contrejour_gpu::stages::SCENE.iter().map(|stage| stage.stage.name()).collect();
    assert_eq!(once_a_frame, SceneStage::ALL.map(SceneStage::name));
}

#[test]
fn every_stage_has_one_entry_point_of_its_name() {
    let of_lights = contrejour_gpu::stages::ALL.iter().map(|stage| (stage.stage.name(), stage.wgsl));
    let of_scenes = contrejour_gpu::stages::SCENE.iter().map(|stage| (stage.stage.name(), stage.wgsl));
    for (name, wgsl) in of_scenes.chain(of_lights) {
        let module = parse(&crate::modules::Module { name: name.into(), wgsl: wgsl.into() });
        let entry_points: Vec<_> = module.entry_points.iter().map(|entry_point| entry_point.name.as_str()).collect();
        assert_eq!(entry_points, [name]);
    }
}

#[test]
fn the_comparer_finds_a_missing_file_and_one_too_many() {
    let stages = stages();
    let without_last = &stages[..stages.len() - 1];
    assert!(compare("side", &stages, without_last, true).is_err_and(|text| text.contains("write_draw_args")));
    assert!(compare("side", without_last, &stages, false).is_err_and(|text| text.contains("no stage")));
    assert_eq!(compare("side", without_last, &stages, true), Ok(()));
}

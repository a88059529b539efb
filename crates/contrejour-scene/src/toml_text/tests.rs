use std::path::Path;

use contrejour_plan::{
    AlphaRemap, CascadeSettings, DepthPrecision, EdgeProfile, LightKind, ShadowSettings, SilhouetteMapSettings,
    SilhouetteSource, SilhouetteWinner, SmoothieWidth, StreamPrecision, Technique,
};
use glam::DVec3;

use crate::{BUILT_IN_SCENES, MeshSource, Place, Problem, Scene, SceneError};

const GOOD: &str = r#"size = [640, 480]

[camera]
eye = [0, 2, 5]
target = [0, 0, 0]

[light]
kind = "spot"
position = [-3, 5, 2]
target = [0, 0, 0]

[[mesh]]
shape = { kind = "torus", radius = 0.8, segments = 16, sides = 8 }
"#;

fn read(text: &str) -> Result<Scene, SceneError> {
    Scene::from_toml(text, Path::new("scenes"), "test.toml")
}

/// Where `GOOD` with `from` replaced by `to` is refused, and with which words.
fn refused(from: &str, to: &str) -> (Place, Problem) {
    assert!(GOOD.contains(from), "{from} is not in the text");
    match read(&GOOD.replacen(from, to, 1)).expect_err("must be refused") {
        SceneError::InFile { place, problem } => (place, *problem),
        other => panic!("{other}"),
    }
}

fn assert_refused(from: &str, to: &str, line: usize, column: usize, words: &str) {
    let (place, problem) = refused(from, to);
    let message = format!("{place}: {problem}");
    assert_eq!((place.line, place.column), (line, column), "{message}");
    assert!(message.starts_with("test.toml:") && message.contains(words), "{message}");
}

#[test]
fn a_good_scene_is_read() {
    let scene = read(GOOD).expect("good");
    assert_eq!(scene.size, [640, 480]);
    assert_eq!(scene.meshes.len(), 1);
    assert_eq!(scene.meshes[0].mesh.triangles.len(), 256);
    assert!(scene.meshes[0].casts && scene.meshes[0].receives);
    assert!((scene.camera.fov_y - 40_f64.to_radians()).abs() < 1e-15);
    assert_eq!(scene.lights.len(), 1);
    assert_eq!(scene.lights[0].shadow, ShadowSettings::default());
}

#[test]
fn a_sun_with_cascades_is_read() {
    let spot = "kind = \"spot\"\nposition = [-3, 5, 2]\ntarget = [0, 0, 0]\n";
    let sun = |keys: &str| format!("kind = \"directional\"\ntowards_light = [1, 2, 3]\n{keys}\n");
    let read_sun = |keys: &str| read(&GOOD.replace(spot, &sun(keys))).map(|scene| scene.lights[0].light.kind);
    let cascades_of = |keys: &str| match read_sun(keys).expect("good") {
        LightKind::Cascaded { cascades, .. } => cascades,
        other => panic!("{other:?}"),
    };
    assert_eq!(cascades_of("cascades = 3"), CascadeSettings { count: 3, ..CascadeSettings::DEFAULT });
    let all = "cascades = 8\nlogarithmic_share = 0.5\nborder_share = 0\ncaster_margin = 2";
    let expected = CascadeSettings { count: 8, logarithmic_share: 0.5, border_share: 0.0, caster_margin: 2.0 };
    assert_eq!(cascades_of(all), expected);
    for (keys, line, words) in [
        ("cascades = 0", 10, "a whole number from 1 to 8"),
        ("cascades = 9", 10, "a whole number from 1 to 8"),
        ("cascades = 2.5", 10, "a whole number from 1 to 8"),
        ("cascades = \"many\"", 10, "a whole number from 1 to 8"),
        ("border_share = 0.2", 10, "has no key `border_share`"),
        ("cascades = 2\nborder_share = 0.6", 11, "a number from 0 to 0.5"),
        ("cascades = 2\nlogarithmic_share = 1.5", 11, "a number from 0 to 1"),
        ("cascades = 2\ncaster_margin = -1", 11, "a number from 0 to 1000"),
        ("cascades = 2\nhalf_extent = 4", 11, "has no key `half_extent`"),
    ] {
        // At the key where that is refused, else at its value.
        let last = keys.lines().last().unwrap_or_default();
        let column = if words.starts_with("has") { 1 } else { last.find('=').map_or(0, |at| at + 3) };
        assert_refused(spot, &sun(keys), line, column, words);
    }
    let towards = "kind = \"directional\"\ntowards_light = [0, 0, 0]\ncascades = 2\n";
    assert_refused(spot, towards, 9, 17, "leaves no direction");
}

#[test]
fn the_avenue_is_read() {
    let scene = read(include_str!("../../assets/scenes/avenue.toml")).expect("good");
    assert!(matches!(scene.lights[0].light.kind, LightKind::Cascaded { .. }));
}

#[test]
fn every_built_in_scene_is_read() {
    for built_in in BUILT_IN_SCENES {
        let scene = built_in.load().unwrap_or_else(|error| panic!("{error}"));
        assert!(scene.meshes.iter().any(|mesh| mesh.casts), "{}", built_in.name);
        assert!(scene.meshes.iter().any(|mesh| mesh.receives), "{}", built_in.name);
    }
    assert!(Scene::built_in(Some("nothing")).is_none());
    assert!(Scene::built_in(None).is_some());
}

#[test]
fn the_documented_example_is_a_scene() {
    let page = include_str!("../scene_format.rs");
    let example = page.split("```").nth(1).expect("the page has an example");
    let text = example.trim_start_matches("toml").replace("//! ", "").replace("//!", "");
    assert_eq!(read(&text).expect("the example is good").meshes.len(), 2);
}

#[test]
fn a_mistake_in_the_syntax_has_its_line() {
    assert_refused("eye = [0, 2, 5]", "eye = [0, 2, 5", 5, 1, "not valid TOML");
    assert_refused("kind = \"spot\"\n", "kind = \"spot\"\nkind = \"spot\"\n", 9, 1, "duplicate key");
    let hint = "each begins with `[[light]]`";
    for (other, is_told) in [("[[light]]", true), ("[light]", true), ("[camera]", false)] {
        let text = format!("[light]\nkind = \"spot\"\n[camera]\n{other}\n");
        let error = read(&text).expect_err("a key is there twice").to_string();
        assert!(error.contains("duplicate key") && error.contains(hint) == is_told, "{error}");
    }
    let error = read("[[light]]\n[light]\n").expect_err("a key is there twice").to_string();
    assert!(error.contains(hint), "{error}");
}

#[test]
fn an_unknown_key_is_refused_with_the_known_ones() {
    assert_refused(
        "target = [0, 0, 0]",
        "aim = [0, 0, 0]",
        5,
        1,
        "the camera has no key `aim`; it has `eye`, `target`",
    );
    assert_refused("size", "sise", 1, 1, "the scene has no key `sise`");
    assert_refused("sides = 8", "corners = 8", 13, 56, "the shape has no key `corners`");
    assert_refused("sides = 8", "height = 8", 13, 56, "the shape \"torus\" has no key `height`");
    assert_refused("position", "center = [0, 0, 0]\nposition", 9, 1, "a spot light has no key `center`");
}

#[test]
fn a_missing_key_names_its_section() {
    assert_refused("eye = [0, 2, 5]", "", 3, 1, "the camera needs the key `eye`");
    assert_refused("kind = \"spot\"", "", 7, 1, "the light needs the key `kind`");
    assert!(read("").expect_err("nothing there").to_string().contains("test.toml:1:1: the scene needs the key `mesh`"));
}

#[test]
fn a_wrong_type_says_what_is_needed() {
    assert_refused("eye = [0, 2, 5]", "eye = \"far\"", 4, 7, "`eye` is a string; give an array of 3 numbers");
    assert_refused("eye = [0, 2, 5]", "eye = [0, true, 5]", 4, 11, "`eye` is true or false; give a number");
    assert_refused("segments = 16", "segments = 16.5", 13, 52, "give a whole number");
    assert_refused("[[mesh]]", "[mesh]", 12, 1, "`mesh` is a table; give an array of tables");
    assert_refused("[[mesh]]", "[[mesh]]\ncasts = 1", 13, 9, "`casts` is a whole number; give true or false");
}

#[test]
fn numbers_that_make_no_sense_are_refused() {
    assert_refused("eye = [0, 2, 5]", "eye = [0, nan, 5]", 4, 11, "`eye` is nan");
    assert_refused("eye = [0, 2, 5]", "eye = [0, 2, -inf]", 4, 14, "`eye` is -inf");
    assert_refused("eye = [0, 2, 5]", "eye = [0, 2, 1e300]", 4, 14, "`eye` is 1e300");
    assert_refused("eye = [0, 2, 5]", "eye = [0, 2]", 4, 7, "`eye` is an array of 2; give an array of 3 numbers");
    assert_refused("eye = [0, 2, 5]", "eye = [0, 2, 5]\nfov_y_degrees = 180", 5, 17, "degrees from 0.01 to 179");
    assert_refused("radius = 0.8", "radius = -1", 13, 36, "`radius` is -1");
    assert_refused("segments = 16", "segments = 65_537", 13, 52, "`segments` is 65537: give a whole number from 3");
    assert_refused("segments = 16", "segments = -3", 13, 52, "`segments` is -3");
    assert_refused(
        "[[mesh]]",
        "[[mesh]]\nscale = 0",
        13,
        9,
        "`scale` is 0; give a number between -1e15 and 1e15 and not within 1e-15 of 0",
    );
    assert_refused("[[mesh]]", "[[mesh]]\nscale = [1, 0, 1]", 13, 13, "`scale` is 0");
    assert_refused("[[mesh]]", "[[mesh]]\nbase_color = [1, 2, 1]", 13, 18, "a number from 0 to 1");
}

#[test]
fn a_picture_has_a_sensible_size() {
    for size in ["[0, 480]", "[640, 16385]", "[4000000000, 4000000000]"] {
        let (place, problem) = refused("[640, 480]", size);
        assert!(matches!(problem, Problem::PictureSize { .. }), "{problem}");
        assert_eq!((place.line, place.column), (1, 8));
    }
    assert_refused("[640, 480]", "[-1, 480]", 1, 9, "`size` is -1");
    assert_eq!(read(&GOOD.replace("[640, 480]", "[1, 16384]")).expect("at the limits").size, [1, 16_384]);
}

#[test]
fn views_need_a_direction_and_depths_in_order() {
    assert_refused("eye = [0, 2, 5]", "eye = [0, 0, 0]", 5, 10, "`target` leaves no direction");
    assert_refused("eye = [0, 2, 5]", "eye = [0, 2, 5]\nup = [0, 4, 10]", 5, 6, "`up` leaves no direction");
    assert_refused("position = [-3, 5, 2]", "position = [0, 0, 0]", 10, 10, "`target` leaves no direction");
    assert_refused("eye = [0, 2, 5]", "eye = [0, 2, 5]\nnear = 5\nfar = 5", 6, 7, "not beyond `near`");
}

#[test]
fn a_mesh_has_one_origin_and_its_file_is_told() {
    assert_refused("shape = {", "name = \"it\" #", 12, 1, "either `shape` or `file`");
    assert_refused("[[mesh]]", "[[mesh]]\nfile = \"a.obj\"", 13, 8, "not both");
    let (place, problem) = refused("shape = {", "file = \"no-such.obj\" #");
    assert_eq!(place.line, 13);
    let message = problem.to_string();
    assert!(matches!(problem, Problem::Mesh(_)) && message.contains("no-such.obj"), "{message}");
}

#[test]
fn mesh_files_are_found_beside_the_scene() {
    let text = GOOD.replace("shape = {", "file = \"meshes/knot.obj\" #");
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let scene = Scene::from_toml(&text, &assets, "test.toml").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.meshes[0].source, MeshSource::File(assets.join("meshes/knot.obj")));
    assert!(!scene.meshes[0].mesh.triangles.is_empty());
}

#[test]
fn lights_of_all_kinds_are_read() {
    let sun = GOOD
        .replace("\"spot\"", "\"directional\"\nangular_radius_degrees = 90e-1")
        .replace("position = [-3, 5, 2]\ntarget = [0, 0, 0]", "towards_light = [0, 3, 0]");
    let LightKind::Directional { center, half_extent, half_depth, angular_radius, .. } =
        read(&sun).expect("good").lights[0].light.kind
    else {
        panic!("a sun was asked for")
    };
    assert!(center.length() < 1e-6 && half_extent > 1.15 && half_depth > 0.35, "{half_extent} {half_depth}");
    assert!((angular_radius - 9_f64.to_radians()).abs() < 1e-15);

    let lamp = GOOD
        .replace("\"spot\"", "\"point\"\nradius = 0.3")
        .replace("position = [-3, 5, 2]\ntarget = [0, 0, 0]", "position = [0, 1, 0]");
    let LightKind::Point { position, radius, near, far } = read(&lamp).expect("good").lights[0].light.kind else {
        panic!("a lamp was asked for")
    };
    assert_eq!((position, radius), (DVec3::Y, 0.3));
    assert!(near > 0.1 && near < 1.0 && far > 1.0 && far < 5.0, "{near} {far}");
    assert_refused("\"spot\"", "\"point\"", 10, 1, "target");
    assert_refused("\"spot\"", "\"lamp\"", 8, 8, "`kind` is \"lamp\"; give one of `spot`, `point`, `directional`");
}

#[test]
fn shadow_settings_are_read_and_checked() {
    let with = |shadow: &str| GOOD.replacen("[light]", &format!("[shadow]\n{shadow}\n\n[light]"), 1);
    let scene =
        read(&with("preset = \"high\"\nwidth_ndc = 0.08\nremap = \"off\"\nbias_slope_texels = 3")).expect("good");
    let Technique::Smoothies(smoothies) = scene.lights[0].shadow.technique else { panic!("the default are smoothies") };
    assert_eq!((smoothies.width, smoothies.remap), (SmoothieWidth::Ndc(0.08), AlphaRemap::Off));
    assert_eq!((scene.lights[0].shadow.map_size, scene.lights[0].shadow.bias.slope_texels), (2048, 3.0));
    assert_eq!(
        read(&with("technique = \"shadow-map\"")).expect("good").lights[0].shadow.technique,
        Technique::ShadowMap
    );

    let message = |shadow: &str| read(&with(shadow)).expect_err("must be refused").to_string();
    assert!(message("preset = \"best\"").starts_with("test.toml:8:10: `preset` is \"best\"; give one of `low`"));
    assert!(message("map_size = 0").starts_with("test.toml:8:12: a shadow map of 0 texels"));
    assert!(message("width_ndc = 3").contains("width_ndc is 3: give more than 0, up to 2"));
    let foreign = message("technique = \"shadow-map\"\nremap = \"off\"");
    assert!(foreign.starts_with("test.toml:9:9: the technique shadow-map has no parameter \"remap\""), "{foreign}");
    let foreign = message("technique = \"pcss\"\nkernel = 5");
    assert!(foreign.contains("give one of blocker_samples, filter_samples"), "{foreign}");
    assert!(message("technique = \"pcss\"\nfilter_samples = 0").contains("a whole number from 1 to 1024"));
    let linear = with(
        "technique = \"silhouette-map-tam\"\nprofile = \"linear\"\nsamples = 4\nblending = 1\nbias_smoothie_texels = 2",
    );
    let Technique::SilhouetteMap(silhouettes) = read(&linear).expect("good").lights[0].shadow.technique else {
        panic!("it is named")
    };
    assert_eq!((silhouettes.profile, silhouettes.samples), (EdgeProfile::Linear, 4));
    assert_eq!(silhouettes.winner, SilhouetteWinner::ByBlending);
    let of_halves = read(&with("technique = \"silhouette-map-stream\"\nstream_bits = 16")).expect("good");
    let halves = SilhouetteSource::Stream(StreamPrecision::Bits16);
    assert!(matches!(
        of_halves.lights[0].shadow.technique,
        Technique::SilhouetteMap(SilhouetteMapSettings { source, .. }) if source == halves
    ));
    assert!(message("technique = \"silhouette-map-stream\"\nstream_bits = 24").contains("give 16 or 32"));
    assert!(message("technique = \"silhouette-map-tam\"\nstream_bits = 16").contains("no parameter \"stream_bits\""));
    assert!(message("technique = \"silhouette-map\"\nblending = 2").contains("a whole number from 0 to 1"));
    assert!(message("profile = \"disk\"").contains("the technique smoothies has no parameter \"profile\""));
    assert!(message("technique = \"silhouette-map\"\nremap = \"off\"").contains("no parameter \"remap\""));
    assert!(message("depth_bits = 24").contains("give 16 or 32"));
    let pcss =
        read(&with("technique = \"pcss\"\nfilter_samples = 64\ndepth_bits = 16")).expect("good").lights[0].shadow;
    assert_eq!(pcss.depth_precision, DepthPrecision::Bits16);
    assert!(matches!(pcss.technique, Technique::Pcss(pcss) if pcss.filter_samples == 64));
}

#[test]
fn a_scene_file_that_is_not_there_is_an_error() {
    let error = Scene::open(Path::new("no-such-scene.toml")).expect_err("there is none");
    assert!(error.to_string().starts_with("no-such-scene.toml: cannot be read"), "{error}");
}

/// `GOOD` with other lights.
fn with_lights(lights: &str) -> String {
    let (before, rest) = GOOD.split_once("[light]").expect("it has one");
    let (_, meshes) = rest.split_once("[[mesh]]").expect("it has one");
    format!("{before}{lights}\n[[mesh]]{meshes}")
}

const SPOT: &str = "[[light]]\nkind = \"spot\"\nposition = [-3, 5, 2]\ntarget = [0, 0, 0]\n";
const LAMP: &str = "[[light]]\nkind = \"point\"\nposition = [0, 2, 0]\n";
const SUN: &str = "[[light]]\nkind = \"directional\"\ntowards_light = [0, 1, 0]\n";

#[test]
fn many_lights_are_read_each_with_its_own() {
    let text = with_lights(&format!(
        "[shadow]\nmap_size = 256\nbias_slope_texels = 3\n
        {SPOT}cone_angle_degrees = 60\ninner_cone_angle_degrees = 45\nname = \"key\"
        [light.shadow]\nmap_size = 2048
        {LAMP}color = [1, 0.5, 0]\nintensity = 120\nrange = 6\nshadow = {{ technique = \"pcss\", preset = \"high\" }}
        {SUN}casts = false"
    ));
    let scene = read(&format!("exposure_ev100 = 3\n{text}")).unwrap_or_else(|error| panic!("{error}"));
    let [spot, lamp, sun] = &scene.lights[..] else { panic!("there are three") };
    assert_eq!((spot.name.as_str(), lamp.name.as_str(), sun.name.as_str()), ("key", "point", "directional"));
    assert!((spot.inner_cone_angle.expect("it was given") - 45_f64.to_radians()).abs() < 1e-15);
    assert_eq!((spot.intensity, spot.range, lamp.intensity, lamp.range), (None, None, Some(120.0), Some(6.0)));
    assert_eq!((lamp.light.color, sun.light.color), ([1.0, 0.5, 0.0], [1.0; 3]));
    assert_eq!((spot.casts, lamp.casts, sun.casts), (true, true, false));
    assert_eq!((spot.shadow.map_size, spot.shadow.bias.slope_texels), (2048, 3.0), "the other keys are the scene's");
    assert!(matches!(lamp.shadow.technique, Technique::Pcss(_)), "{:?}", lamp.shadow);
    assert_eq!((lamp.shadow.map_size, sun.shadow.map_size), (2048, 256), "a preset comes before the scene's keys");
    assert!((scene.exposure() - 1.0 / 9.6).abs() < 1e-12, "{}", scene.exposure());
}

#[test]
fn mistakes_in_one_of_many_lights_have_their_line() {
    let refused = |lights: &str, line: usize, words: &str| {
        let SceneError::InFile { place, problem } = read(&with_lights(lights)).expect_err("must be refused") else {
            panic!("{lights} is refused where it stands")
        };
        let message = format!("{place}: {problem}");
        assert!(place.line == line && message.contains(words), "{message}");
    };
    refused(&format!("{SPOT}{LAMP}target = [0, 0, 0]"), 14, "a point light has no key `target`");
    refused(&format!("{SPOT}{SUN}range = 3"), 14, "a directional light has no key `range`");
    refused(&format!("{SPOT}{LAMP}inner_cone_angle_degrees = 3"), 14, "has no key `inner_cone_angle_degrees`");
    refused(&format!("{SPOT}{LAMP}intensity = -1"), 14, "`intensity` is -1; give a number from 0");
    refused(&format!("{SPOT}{LAMP}range = 0"), 14, "`range` is 0");
    refused(&format!("{SPOT}{LAMP}[light.shadow]\nmap_size = 0"), 15, "a shadow map of 0 texels");
    refused(&format!("{SPOT}{LAMP}casts = 0"), 14, "give true or false");
    let inner = "cone_angle_degrees = 60\ninner_cone_angle_degrees = 70";
    refused(&format!("{SPOT}{inner}"), 12, "`inner_cone_angle_degrees` is 70, and the cone's angle is 60;");
    let inner = "cone_angle_degrees = 40\ninner_cone_angle_degrees = 50";
    refused(&format!("{SPOT}{inner}"), 12, "`inner_cone_angle_degrees` is 50, and the cone's angle is 40");
    assert_refused("size", "exposure_ev100 = 65\nsize", 1, 18, "an exposure value from -64 to 64");
    let many = SUN.repeat(Scene::MAX_LIGHTS + 1);
    assert!(read(&with_lights(&many)).expect_err("too many").to_string().contains("257 lights; give 1 to 256"));
    let given = |lights: &str| {
        let error =
            read(&with_lights("").replacen("size", &format!("{lights}\nsize"), 1)).expect_err("must be refused");
        error.to_string()
    };
    assert!(
        given("light = []").starts_with("test.toml:1:9: there are 0 lights; give 1 to 256"),
        "{}",
        given("light = []")
    );
    assert!(given("light = 3").contains("`light` is a whole number; give a table"), "{}", given("light = 3"));
    assert!(given("light = [3]").contains("`light` is a whole number; give a table"), "{}", given("light = [3]"));
}

#[test]
fn the_documented_lights_are_lights() {
    let page = include_str!("../scene_format.rs");
    let example = page.split("```").nth(3).expect("the page has a second example");
    let text = example.trim_start_matches("toml").replace("//! ", "").replace("//!", "");
    let (exposure, lights) = text.trim().split_once('\n').expect("it has lines");
    let scene = read(&format!("{exposure}\n{}", with_lights(lights))).expect("the example is good");
    assert_eq!((scene.lights.len(), scene.lights[1].shadow.map_size), (2, 2048));
}

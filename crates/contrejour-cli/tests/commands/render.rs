//! `contrejour render`.

use std::collections::BTreeSet;

use contrejour_plan::Technique;
use libtest_mimic::Trial;
use serde_json::Value;

use crate::program::Folder;
use crate::{Outcome, gpu_trial};

const SMALL: &str = "render boxes --size 64x40 --map-size 128";

/// What scripts may rely on.
const KEYS: [&str; 12] = [
    "device",
    "frames",
    "frames_in_flight",
    "edges",
    "silhouette_edges",
    "stages",
    "upload_bytes_per_frame",
    "readback_waits",
    "cpu_ms_per_frame",
    "overflow_frames",
    "pictures",
    "views",
];

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("render::a_picture_has_the_size_asked_for", a_picture_has_the_size_asked_for),
        gpu_trial("render::an_orbit_is_a_picture_a_frame", an_orbit_is_a_picture_a_frame),
        gpu_trial("render::an_animation_is_a_picture_a_frame", an_animation_is_a_picture_a_frame),
        gpu_trial("render::a_stream_tells_what_it_leaves_out", a_stream_tells_what_it_leaves_out),
        gpu_trial("render::what_a_mask_cuts_is_not_there", what_a_mask_cuts_is_not_there),
        gpu_trial("render::a_camera_of_the_file_sees_it", a_camera_of_the_file_sees_it),
        gpu_trial("render::cameras_and_lights_go_with_their_nodes", cameras_and_lights_go_with_their_nodes),
        gpu_trial("render::the_object_has_its_keys", the_object_has_its_keys),
        gpu_trial("render::views_are_pictures", views_are_pictures),
        gpu_trial("render::all_views_of_a_light_are_written", all_views_are_written),
        gpu_trial("render::every_technique_shows_its_maps", every_technique_shows_its_maps),
        gpu_trial("render::a_scene_file_is_drawn", a_scene_file_is_drawn),
    ]
}

fn expect_size(folder: &Folder, name: &str, expected: [u32; 2]) -> Outcome {
    let size = folder.png_size(name)?;
    if size == expected { Ok(()) } else { Err(format!("{name} is {size:?}, not {expected:?}")) }
}

fn expect_names(folder: &Folder, expected: &[&str]) -> Outcome {
    let names = folder.names();
    if names == expected { Ok(()) } else { Err(format!("the folder holds {names:?}, not {expected:?}")) }
}

fn a_picture_has_the_size_asked_for() -> Outcome {
    let folder = Folder::new();
    let printed = folder.run(&format!("{SMALL} -o picture.png")).stdout()?;
    if printed.lines().last() != Some("picture.png") {
        return Err(format!("the last line is not the picture: {printed}"));
    }
    expect_size(&folder, "picture.png", [64, 40])?;
    expect_names(&folder, &["picture.png"])
}

fn an_orbit_is_a_picture_a_frame() -> Outcome {
    let folder = Folder::new();
    folder.run(&format!("{SMALL} --orbit 3 -o frame-%03d.png")).stdout()?;
    let names = ["frame-000.png", "frame-001.png", "frame-002.png"];
    expect_names(&folder, &names)?;
    for name in names {
        expect_size(&folder, name, [64, 40])?;
    }
    let bytes: BTreeSet<_> = names.iter().map(|name| std::fs::read(folder.path(name)).unwrap_or_default()).collect();
    if bytes.len() == names.len() { Ok(()) } else { Err("the light does not move".into()) }
}

/// A face that a morph target of weight 0 to 1 widens within two seconds.
fn widening_face() -> String {
    let numbers: [f32; 22] = [
        0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, // positions
        0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, // how far they move
        0.0, 2.0, // seconds
        0.0, 1.0, // weights
    ];
    let bytes: String =
        numbers.iter().flat_map(|number| number.to_le_bytes()).map(|byte| format!("%{byte:02X}")).collect();
    serde_json::json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "targets": [{ "POSITION": 1 }] }] }],
        "animations": [{
            "name": "widen",
            "samplers": [{ "input": 2, "output": 3 }],
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "weights" } }],
        }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3 },
            { "bufferView": 0, "byteOffset": 36, "componentType": 5126, "type": "VEC3", "count": 3 },
            { "bufferView": 0, "byteOffset": 72, "componentType": 5126, "type": "SCALAR", "count": 2 },
            { "bufferView": 0, "byteOffset": 80, "componentType": 5126, "type": "SCALAR", "count": 2 },
        ],
        "bufferViews": [{ "buffer": 0, "byteLength": 88 }],
        "buffers": [{ "byteLength": 88, "uri": format!("data:application/octet-stream,{bytes}") }],
    })
    .to_string()
}

fn an_animation_is_a_picture_a_frame() -> Outcome {
    let folder = Folder::with(&[("face.gltf", &widening_face())]);
    let render = "render face.gltf --animation widen --size 64x40 --map-size 128";
    folder.run(&format!("{render} --animate 3 -o frame-%d.png")).stdout()?;
    folder.run(&format!("{render} --time 1 -o still.png --views maps")).stdout()?;
    folder.run(&format!("{render} --time 99 --orbit 2 -o orbit-%d.png")).stdout()?;
    let names = ["frame-0.png", "frame-1.png", "frame-2.png", "still.png", "orbit-0.png", "orbit-1.png"];
    let mut pictures = BTreeSet::new();
    for name in names {
        expect_size(&folder, name, [64, 40])?;
        pictures.insert(std::fs::read(folder.path(name)).unwrap_or_default());
    }
    let report = folder.run(&format!("{render} --animate 3 --json")).json()?;
    let is_timed = |stage: &Value| stage["name"] == "deform_positions";
    if !report["stages"].as_array().is_some_and(|stages| stages.is_empty() || stages.iter().any(is_timed)) {
        return Err(format!("the stage that deforms is not timed: {report}"));
    }
    if pictures.len() == names.len() { Ok(()) } else { Err("the model does not move".into()) }
}

fn a_stream_tells_what_it_leaves_out() -> Outcome {
    let folder = Folder::with(&[("face.gltf", &widening_face())]);
    let render = "render face.gltf --size 64x40 --map-size 128 -o face.png --technique silhouette-map";
    for (rest, is_told) in
        [("-stream --animation widen --time 1", true), ("-stream", false), (" --animation widen", false)]
    {
        let run = folder.run(&format!("{render}{rest}"));
        run.ends_with(0)?;
        if run.told().contains("silhouette-map-stream holds meshes at rest") != is_told {
            return Err(format!("{rest}: {}", run.told()));
        }
    }
    Ok(())
}

/// A face whose alpha is above the cutoff is as one without a mask, in motion too, but for its silhouette; below the cutoff
/// there is none.
fn what_a_mask_cuts_is_not_there() -> Outcome {
    let face = |alpha_mode: &str, alpha: f64| -> Result<String, String> {
        let mut file: Value = serde_json::from_str(&widening_face()).map_err(|error| error.to_string())?;
        let color = serde_json::json!({ "baseColorFactor": [1, 1, 1, alpha] });
        file["materials"] = serde_json::json!([{ "alphaMode": alpha_mode, "pbrMetallicRoughness": color }]);
        file["meshes"][0]["primitives"][0]["material"] = 0.into();
        Ok(file.to_string())
    };
    let [whole, kept] = [face("OPAQUE", 0.6)?, face("MASK", 0.6)?];
    let [cut, gone] = [face("MASK", 0.4)?, face("MASK", 0.0)?];
    let files = [("whole.gltf", &whole), ("kept.gltf", &kept), ("cut.gltf", &cut), ("gone.gltf", &gone)];
    let folder = Folder::with(&files.map(|(name, text)| (name, text.as_str())));
    let picture = |name: &str, time: u32| -> Result<Vec<u8>, String> {
        let still = "--size 64x40 --map-size 128 --technique pcf -o picture.png --animation widen --time";
        folder.run(&format!("render {name}.gltf {still} {time}")).stdout()?;
        std::fs::read(folder.path("picture.png")).map_err(|error| error.to_string())
    };
    if picture("kept", 1)? != picture("whole", 1)? || picture("kept", 0)? == picture("kept", 1)? {
        return Err("a face that the mask keeps is not as one without a mask".into());
    }
    if picture("cut", 1)? == picture("whole", 1)? || picture("cut", 1)? != picture("gone", 1)? {
        return Err("a face that the mask cuts is there".into());
    }
    let inspected = folder.run("inspect kept.gltf --json").json()?;
    if inspected["meshes"][0]["masked_triangles"] != 1 {
        return Err(format!("its masked triangles are not told: {inspected}"));
    }
    let plan = folder.run("plan kept.gltf").stdout()?;
    if !plan.contains("masked_shadow_map") || !plan.contains("a mask cuts its faces") {
        return Err(format!("the plan says nothing of the mask: {plan}"));
    }
    let silhouette = folder.run("silhouette kept.gltf --point 1,2,3 --on cpu");
    if !silhouette.told().contains("1 triangles are cut by alpha masks") {
        return Err(format!("that it has no silhouette is not told: {}", silhouette.told()));
    }
    Ok(())
}

fn a_camera_of_the_file_sees_it() -> Outcome {
    let mut file: Value = serde_json::from_str(&widening_face()).map_err(|error| error.to_string())?;
    file["cameras"] = serde_json::json!([{ "type": "perspective", "perspective": { "yfov": 0.7, "znear": 0.1 } }]);
    let at = [0.3, 0.3, 3.0];
    file["nodes"] = serde_json::json!([
        { "mesh": 0 },
        { "camera": 0, "translation": at, "name": "front" },
        { "camera": 0, "translation": at, "rotation": [0, 1, 0, 0], "name": "away" },
        { "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [1, 2, 3] },
    ]);
    file["extensionsUsed"] = serde_json::json!(["KHR_lights_punctual"]);
    file["extensions"] =
        serde_json::json!({ "KHR_lights_punctual": { "lights": [{ "type": "point", "intensity": 50 }] } });
    let folder = Folder::with(&[("face.gltf", &file.to_string()), ("empty.toml", "")]);

    let small = "--size 64x40 --map-size 128";
    for (name, arguments) in [("first", ""), ("front", "--camera front"), ("away", "--camera away")] {
        folder.run(&format!("render face.gltf {small} {arguments} -o {name}.png")).stdout()?;
    }
    folder.run(&format!("render face.gltf {small} --camera front --animation widen --time 1 -o wide.png")).stdout()?;
    let [first, front, away, wide] =
        ["first", "front", "away", "wide"].map(|name| std::fs::read(folder.path(&format!("{name}.png"))).ok());
    if first != front || front == away || wide == front || wide == away {
        return Err("the cameras do not see what stands before them".into());
    }
    let report = folder.run("inspect face.gltf --json").json()?;
    if report["cameras"][1]["name"] != "away" || report["lights"][0]["intensity"] != 50.0 {
        return Err(format!("cameras and lights are not listed: {report}"));
    }
    let folder = Folder::with(&[("face.gltf", &file.to_string()), ("empty.toml", "")]);
    folder.refuses("render face.gltf --camera roof", &["face.gltf", "roof", "\"front\", \"away\""])?;
    folder.refuses("render empty.toml --camera roof", &["empty.toml", "one camera"])?;
    folder.refuses("render boxes --camera roof", &["boxes", "one camera"])
}

/// A face, a camera and a light, of which some stand at a node that moves by 2 within two seconds.
fn carried(children: &[usize]) -> Result<String, String> {
    let mut file: Value = serde_json::from_str(&widening_face()).map_err(|error| error.to_string())?;
    file["cameras"] = serde_json::json!([{ "type": "perspective", "perspective": { "yfov": 0.7, "znear": 0.1 } }]);
    file["nodes"] = serde_json::json!([
        { "children": children },
        { "mesh": 0 },
        { "camera": 0, "translation": [0.25, 0.25, 3] },
        { "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [1, 1, 1], "rotation": [-0.38, 0.33, 0, 0.86] },
    ]);
    file["extensionsUsed"] = serde_json::json!(["KHR_lights_punctual"]);
    let light = serde_json::json!({ "type": "spot", "intensity": 50, "spot": {} });
    file["extensions"] = serde_json::json!({ "KHR_lights_punctual": { "lights": [light] } });
    // The second vertex is moved as far as the node is at the end.
    let keys =
        serde_json::json!({ "bufferView": 0, "byteOffset": 36, "componentType": 5126, "type": "VEC3", "count": 2 });
    file["accessors"].as_array_mut().ok_or("it has accessors")?.push(keys);
    file["animations"] = serde_json::json!([{
        "name": "carry",
        "samplers": [{ "input": 2, "output": 4 }],
        "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }],
    }]);
    Ok(file.to_string())
}

/// Where all go together nothing changes; else something does, in a picture alone and in one of a sequence.
fn cameras_and_lights_go_with_their_nodes() -> Outcome {
    for (children, is_alike) in [(&[1, 2, 3][..], true), (&[1, 3], false), (&[1, 2], false), (&[2, 3], false)] {
        let folder = Folder::with(&[("face.gltf", &carried(children)?)]);
        let render = "render face.gltf --animation carry --size 64x40 --map-size 128";
        folder.run(&format!("{render} --time 0 -o first.png")).stdout()?;
        folder.run(&format!("{render} --time 2 -o last.png")).stdout()?;
        // At 0 and 1 s.
        folder.run(&format!("{render} --animate 2 -o frame-%d.png")).stdout()?;
        let picture = |name: &str| std::fs::read(folder.path(name)).map_err(|error| error.to_string());
        let alike = [picture("first.png")? == picture("last.png")?, picture("frame-0.png")? == picture("frame-1.png")?];
        if alike != [is_alike; 2] {
            return Err(format!("with nodes {children:?} pictures are alike: {alike:?}"));
        }
    }
    let flat = carried(&[1, 2, 3])?.replace("\"path\":\"translation\"", "\"path\":\"scale\"");
    let folder = Folder::with(&[("flat.gltf", &flat)]);
    folder.refuses("render flat.gltf --animation carry --time 0 -o flat.png", &["flat.gltf", "node 2", "scale"])
}

fn the_object_has_its_keys() -> Outcome {
    let folder = Folder::new();
    let report = folder.run(&format!("{SMALL} --orbit 4 --json")).json()?;
    let keys: BTreeSet<_> = report.as_object().ok_or("it is an object")?.keys().map(String::as_str).collect();
    if keys != BTreeSet::from(KEYS) {
        return Err(format!("the keys are {keys:?}"));
    }
    let stages = report["stages"].as_array().ok_or("`stages` is a list")?;
    let is_stage =
        |stage: &Value| stage["name"].is_string() && stage["gpu_ms"].as_f64().is_some_and(|time| time >= 0.0);
    let spread = ["min", "median", "max"].map(|key| report["silhouette_edges"][key].as_u64());
    let is_good = report["device"].is_string()
        && report["frames"] == 4
        && report["edges"].as_u64().is_some_and(|edges| edges > 0)
        && spread.iter().all(|edges| edges.is_some_and(|edges| edges > 0))
        && spread.is_sorted()
        && stages.iter().all(is_stage)
        && report["readback_waits"] == 0
        && report["upload_bytes_per_frame"].as_u64().is_some_and(|bytes| bytes > 0)
        && report["cpu_ms_per_frame"].as_f64().is_some_and(|time| time > 0.0)
        && report["overflow_frames"].is_u64();
    if !is_good {
        return Err(format!("not what is documented: {report}"));
    }
    // Nothing was named, so nothing is written.
    expect_names(&folder, &[])
}

fn views_are_pictures() -> Outcome {
    let folder = Folder::new();
    let report = folder.run(&format!("{SMALL} -o picture.png --views maps --json")).json()?;
    for (name, size) in [
        ("shadow_map", [128, 128]),
        ("smoothie_depth", [128, 128]),
        ("smoothie_alpha", [128, 128]),
        ("visibility", [64, 40]),
        ("silhouette", [64, 40]),
    ] {
        expect_size(&folder, &format!("maps/{name}.png"), size)?;
    }
    if report["views"].as_array().is_some_and(|views| views.len() == 5) { Ok(()) } else { Err(report.to_string()) }
}

/// A file for each side of the cube around a point light, and for each cascade; each is told, and shows something else.
fn all_views_are_written() -> Outcome {
    let scene = |light: &str| {
        format!(
            "size = [48, 32]\n[camera]\neye = [3, 2, 5]\ntarget = [0, 0, 0]\n[shadow]\nmap_size = 32\n\
             [light]\n{light}\n[[mesh]]\nshape = {{ kind = \"box\" }}\n\
             [[mesh]]\nshape = {{ kind = \"box\", size = [7, 5, 6] }}\ntranslate = [1, 0.5, 0.7]\n"
        )
    };
    let lamp = scene("kind = \"point\"\nposition = [1, 2, 1.5]\nradius = 0.1");
    let sun = scene("kind = \"directional\"\ntowards_light = [1, 2, 1]\ncascades = 3");
    let faces = ["positive-x", "negative-x", "positive-y", "negative-y", "positive-z", "negative-z"];
    let cascades = ["cascade-1", "cascade-2", "cascade-3"];
    // Where nobody keeps a shadow map for each view, there is that of the last one.
    let folder = Folder::with(&[("scene.toml", &lamp)]);
    folder.run("render scene.toml --technique vsm --views maps -o picture.png").stdout()?;
    let written: Vec<bool> =
        faces.iter().map(|face| folder.path(&format!("maps/shadow_map-{face}.png")).exists()).collect();
    if written != [false, false, false, false, false, true] {
        return Err(format!("vsm: maps of {written:?}"));
    }
    for (name, text, suffixes) in [("lamp", lamp, &faces[..]), ("sun", sun, &cascades[..])] {
        let folder = Folder::with(&[("scene.toml", &text)]);
        let told = folder.run("render scene.toml --views maps -o picture.png").stdout()?;
        for map in ["shadow_map", "smoothie_depth", "smoothie_alpha"] {
            let mut different = BTreeSet::new();
            for suffix in suffixes {
                let file = format!("maps/{map}-{suffix}.png");
                expect_size(&folder, &file, [32, 32])?;
                if !told.contains(&file) {
                    return Err(format!("{name}: {file} is not told: {told}"));
                }
                different.insert(std::fs::read(folder.path(&file)).unwrap_or_default());
            }
            if map == "shadow_map" && different.len() != suffixes.len() {
                return Err(format!("{name}: of {} maps only {} differ", suffixes.len(), different.len()));
            }
        }
    }
    Ok(())
}

fn a_scene_file_is_drawn() -> Outcome {
    let scene = "size = [48, 32]\n[camera]\neye = [3, 2, 5]\ntarget = [0, 0, 0]\n\
                 [light]\nkind = \"directional\"\ntowards_light = [1, 2, 1]\n\
                 [[mesh]]\nshape = { kind = \"box\" }\n[[mesh]]\nfile = \"face.obj\"\n";
    let face = "v -2 -1 -2\nv -2 -1 2\nv 2 -1 2\nf 1 2 3\n";
    let folder = Folder::with(&[("scene.toml", scene), ("face.obj", face)]);
    folder.run("render scene.toml -o picture.png").stdout()?;
    expect_size(&folder, "picture.png", [48, 32])?;
    folder.run("render face.obj --size 32x32 -o face.png").stdout()?;
    expect_size(&folder, "face.png", [32, 32])
}

/// Also with 16-bit maps: each has a shadow map with something in it.
fn every_technique_shows_its_maps() -> Outcome {
    let folder = Folder::new();
    let techniques = Technique::NAMES.map(|name| format!("--technique {name}"));
    let with_halves =
        ["smoothies", "smoothies --two-passes", "evsm"].map(|name| format!("--technique {name} --depth-bits 16"));
    for arguments in techniques.iter().chain(&with_halves) {
        let printed = folder.run(&format!("{SMALL} {arguments} --views views -o picture.png")).stdout()?;
        let legend = printed.lines().find(|line| line.contains("shadow_map.png")).ok_or("there is no shadow map")?;
        if !legend.contains("white: depth 6.") || !legend.contains("dark grey: depth 10.9") {
            return Err(format!("{arguments}: not the depths of the scene: {legend}"));
        }
    }
    Ok(())
}

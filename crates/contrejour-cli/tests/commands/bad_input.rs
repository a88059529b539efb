//! What cannot be done: status 2, one line that says where and what, and no file.

use std::fs;

use libtest_mimic::Trial;

use crate::program::Folder;
use crate::{Outcome, cpu_trial};

/// A scene that starts with some keys of its own.
macro_rules! scene {
    ($keys:literal) => {
        concat!(
            $keys,
            "\n[camera]\neye = [3, 2, 5]\ntarget = [0, 0, 0]\n\
             [light]\nkind = \"spot\"\nposition = [0, 4, 0]\ntarget = [0, 0, 0]\n\
             [[mesh]]\nshape = { kind = \"box\" }\n"
        )
    };
}

const NO_KEY: &str = "size = [48, 32]\n[camera]\neye = [3, 2, 5]\ntarget = [0, 0, 0]\n\
                      [light]\nkind = \"spot\"\nposition = [0, 4, 0]\ntarget = [0, 0, 0]\nglow = 3\n\
                      [[mesh]]\nshape = { kind = \"box\" }\n";

const FILES: [(&str, &str); 13] = [
    ("face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    ("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
    ("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"),
    ("empty.obj", ""),
    ("mesh.xyz", "0 0 0\n"),
    ("key.toml", NO_KEY),
    ("text.toml", "size = [48, 32\n"),
    ("picture.toml", scene!("size = [1000000000, 1000000000]")),
    ("negative.toml", scene!("size = [-1, 32]")),
    ("map.toml", scene!("shadow = { map_size = 4294967295 }")),
    ("nan.toml", scene!("ambient = [0, nan, 0]")),
    ("large.toml", scene!("background = [0, 1e300, 0]")),
    ("zero.toml", "mesh = [{ file = \"a\\u0000b.obj\" }]\n"),
];

/// Arguments, and what the line must tell.
const CASES: [(&str, &[&str]); 39] = [
    ("render face.obj --animation Walk -o out.png", &["face.obj", "Walk", "has none"]),
    ("render boxes --animation Walk -o out.png", &["boxes", ".gltf"]),
    ("render face.obj --animation Walk --time -1 -o out.png", &["--time", "-1"]),
    ("render face.obj --animation Walk --animate 3 -o out.png", &["out.png", "%03d"]),
    ("render face.obj --animate 3 -o out-%d.png", &["--animation"]),
    ("silhouette missing.obj --point 1,2,3 -o out.json", &["missing.obj"]),
    ("silhouette folder.obj --point 1,2,3 -o out.json", &["folder.obj", "directory"]),
    ("silhouette range.obj --point 1,2,3 -o out.json", &["range.obj", "line 4", "9"]),
    ("silhouette nan.obj --point 1,2,3 -o out.json", &["nan.obj", "line 2"]),
    ("silhouette empty.obj --point 1,2,3 -o out.json", &["empty.obj"]),
    ("silhouette mesh.xyz --point 1,2,3 -o out.json", &["mesh.xyz", ".obj"]),
    ("silhouette face.obj --point nan,0,0 -o out.json", &["--point", "nan"]),
    ("silhouette face.obj --point 1,2 -o out.json", &["--point", "three"]),
    ("silhouette face.obj --point 1e39,0,0 -o out.json", &["--point", "1e39"]),
    ("silhouette face.obj --direction 0,0,0 -o out.json", &["direction", "zero"]),
    ("silhouette face.obj --direction=-0,0,0 -o out.json", &["direction", "zero"]),
    ("silhouette face.obj -o out.json", &["--point", "--direction"]),
    ("silhouette face.obj --point 1,2,3 --direction 1,2,3 -o out.json", &["--direction"]),
    ("silhouette face.obj --point 1,2,3 --format png -o out.json", &["--format", "svg"]),
    ("render --technique magic -o out.png", &["magic", "smoothies", "shadow-map"]),
    ("render nothing -o out.png", &["nothing", "boxes"]),
    ("render missing.toml -o out.png", &["missing.toml"]),
    ("render key.toml -o out.png", &["key.toml:9", "glow"]),
    ("render text.toml -o out.png", &["text.toml:1"]),
    ("render boxes --orbit 3 -o out.png", &["out.png", "%03d"]),
    ("render boxes -o out.jpg", &["out.jpg", ".png"]),
    ("render boxes --technique shadow-map --width 0.1 -o out.png", &["--width"]),
    ("render picture.toml -o out.png", &["picture.toml:1", "1000000000", "16384"]),
    ("render negative.toml -o out.png", &["negative.toml:1", "-1"]),
    ("render map.toml -o out.png", &["map.toml:1", "4294967295"]),
    ("render nan.toml -o out.png", &["nan.toml:1", "ambient"]),
    ("render large.toml -o out.png", &["large.toml:1", "1e300"]),
    ("render zero.toml -o out.png", &["zero.toml:1"]),
    ("render boxes --size 1000000000x1000000000 -o out.png", &["--size", "16384"]),
    ("render boxes --map-size 4294967295 -o out.png", &["4294967295"]),
    ("render boxes --orbit 4294967295", &["--orbit", "100000"]),
    ("report --scenes square --picture-size 1000000000x1 -o out", &["--picture-size", "16384"]),
    ("inspect missing.obj", &["missing.obj"]),
    ("plan missing.toml", &["missing.toml"]),
];

pub fn trials() -> Vec<Trial> {
    let trial = |(arguments, told): (&'static str, &'static [&'static str])| {
        cpu_trial(format!("bad_input::{arguments}"), move || is_refused(arguments, told))
    };
    CASES.into_iter().map(trial).collect()
}

fn is_refused(arguments: &str, told: &[&str]) -> Outcome {
    let folder = Folder::with(&FILES);
    fs::create_dir(folder.path("folder.obj")).map_err(|error| error.to_string())?;
    folder.refuses(arguments, told)
}

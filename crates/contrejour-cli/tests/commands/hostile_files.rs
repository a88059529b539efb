//! Paths that name no file, files that are too large or may not be read, and outputs without room: status 2, one line,
//! no file that is not whole. Unix alone, which has such files.

use std::fs::{self, File};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::process::Command;

use contrejour_render::Gpu;
use libtest_mimic::Trial;

use crate::program::{Folder, asset};
use crate::{Outcome, cpu_trial, gpu_trial};

const FACE: (&str, &str) = ("face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");

const PIPE_GLTF: &str = r#"{ "asset": { "version": "2.0" }, "buffers": [{ "uri": "pipe.bin", "byteLength": 36 }] }"#;

/// A mesh that is short of nothing but its material library.
const PIPE_MTL: &str = "mtllib pipe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n";

/// Arguments, and what the line must tell.
const INPUTS: [(&str, &[&str]); 15] = [
    ("inspect folder.ply", &["folder.ply", "directory"]),
    ("render folder.toml -o out.png", &["folder.toml", "directory"]),
    ("inspect pipe.obj", &["pipe.obj", "regular file"]),
    ("silhouette pipe.obj --point 1,2,3 -o out.json", &["pipe.obj", "regular file"]),
    ("render pipe.toml -o out.png", &["pipe.toml", "regular file"]),
    ("render pipe.gltf -o out.png", &["pipe.bin", "regular file"]),
    ("report --scenes pipe.toml -o out", &["pipe.toml", "regular file"]),
    ("report --merge shard -o out", &["run.json", "regular file"]),
    ("report --merge face.obj -o out", &["face.obj"]),
    ("inspect zero.stl", &["zero.stl", "regular file"]),
    ("render random.toml -o out.png", &["random.toml", "regular file"]),
    ("inspect loop.obj", &["loop.obj", "symbolic links"]),
    ("inspect huge.stl", &["huge.stl", "1099511627776", "2147483648"]),
    ("render huge.toml -o out.png", &["huge.toml", "1099511627776", "16777216"]),
    ("inspect kernel.obj", &["kernel.obj", "empty"]),
];

const OUTPUTS: [(&str, &[&str]); 5] = [
    ("silhouette face.obj --point 1,2,3 --on cpu -o folder.ply", &["folder.ply"]),
    ("silhouette face.obj --point 1,2,3 --on cpu -o face.obj/out.json", &["face.obj", "folder"]),
    ("silhouette face.obj --point 1,2,3 --on cpu -o /dev/full", &["/dev/full", "room"]),
    ("silhouette face.obj --point 1,2,3 --on cpu -o ..", &["names no file"]),
    ("inspect loop.obj/face.obj", &["loop.obj", "symbolic links"]),
];

pub fn trials() -> Vec<Trial> {
    let refused = |(arguments, told): (&'static str, &'static [&'static str])| {
        cpu_trial(format!("hostile_files::{arguments}"), move || is_refused(arguments, told))
    };
    let mut trials: Vec<_> = INPUTS.into_iter().chain(OUTPUTS).map(refused).collect();
    trials.push(cpu_trial("hostile_files::a_name_that_is_too_long", a_long_name_is_refused));
    trials.push(cpu_trial("hostile_files::a_library_that_is_a_pipe_is_left_out", a_library_that_is_a_pipe_is_left_out));
    trials.push(cpu_trial("hostile_files::nothing_can_be_printed", nothing_can_be_printed));
    trials.push(cpu_trial("hostile_files::nothing_can_be_told", nothing_can_be_told));
    trials.push(cpu_trial("hostile_files::a_full_disk_leaves_the_older_file", a_full_disk_leaves_the_older_file));
    trials.push(cpu_trial("hostile_files::no_permission", no_permission));
    trials.push(cpu_trial("hostile_files::no_device", no_device));
    trials.push(gpu_trial("hostile_files::no_memory_on_the_device", no_memory_on_the_device));
    trials
}

fn hostile_folder() -> Result<Folder, String> {
    let folder = Folder::with(&[FACE, ("pipe.gltf", PIPE_GLTF), ("pipe.mtl.obj", PIPE_MTL)]);
    let text = |error: std::io::Error| error.to_string();
    for name in ["folder.ply", "folder.toml", "shard"] {
        fs::create_dir(folder.path(name)).map_err(text)?;
    }
    let pipes = ["pipe.obj", "pipe.toml", "pipe.bin", "pipe.mtl", "shard/run.json"].map(|name| folder.path(name));
    if !Command::new("mkfifo").args(pipes).status().map_err(text)?.success() {
        return Err("pipes cannot be made".into());
    }
    for (target, link) in [
        ("/dev/zero", "zero.stl"),
        ("/dev/urandom", "random.toml"),
        ("loop.obj", "loop.obj"),
        ("/proc/self/mem", "kernel.obj"),
    ] {
        symlink(target, folder.path(link)).map_err(text)?;
    }
    for name in ["huge.stl", "huge.toml"] {
        // All holes, which take no room.
        File::create(folder.path(name)).and_then(|file| file.set_len(1 << 40)).map_err(text)?;
    }
    Ok(folder)
}

fn is_refused(arguments: &str, told: &[&str]) -> Outcome {
    if arguments.contains("kernel.obj") && !cfg!(target_os = "linux") {
        return Ok(());
    }
    hostile_folder()?.refuses(arguments, told)
}

fn a_long_name_is_refused() -> Outcome {
    let folder = Folder::with(&[FACE]);
    let long = "n".repeat(300);
    for arguments in
        [format!("inspect {long}.obj"), format!("silhouette face.obj --point 1,2,3 --on cpu -o {long}.json")]
    {
        let line = folder.run(&arguments).refusal()?;
        if !line.contains("too long") {
            return Err(format!("that the name is too long is not told: {line}"));
        }
    }
    Ok(())
}

fn a_library_that_is_a_pipe_is_left_out() -> Outcome {
    let printed = hostile_folder()?.run("inspect pipe.mtl.obj").stdout()?;
    if printed.contains("pipe.mtl") && printed.contains("regular file") {
        return Ok(());
    }
    Err(format!("it is not told that the library was left out: {printed}"))
}

fn nothing_can_be_printed() -> Outcome {
    if !cfg!(target_os = "linux") {
        return Ok(());
    }
    let line = Folder::with(&[FACE]).run_in_shell("exec \"$@\" >/dev/full", "inspect face.obj").refusal()?;
    if line.contains("cannot print") { Ok(()) } else { Err(line) }
}

/// A warning or a refusal that reaches nobody changes nothing else.
fn nothing_can_be_told() -> Outcome {
    if !cfg!(target_os = "linux") {
        return Ok(());
    }
    let open = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nmtllib missing.mtl\n";
    let folder = Folder::with(&[("open.obj", open)]);
    for (arguments, status) in
        [("inspect open.obj", 0), ("inspect missing.obj", 2), ("bogus", 2), ("render --size 0x0", 2)]
    {
        folder.run_in_shell("exec \"$@\" 2>/dev/full", arguments).ends_with(status)?;
    }
    Ok(())
}

/// A limit on the size of files stands for a disk without room: 512 or 1024 bytes, as the shell counts.
fn a_full_disk_leaves_the_older_file() -> Outcome {
    let folder = Folder::with(&[("out.obj", "an older file")]);
    fs::copy(asset("meshes/elephant.obj"), folder.path("elephant.obj")).map_err(|error| error.to_string())?;
    let before = folder.names();
    let arguments = "silhouette elephant.obj --point 1,2,3 --on cpu --format obj -o out.obj";
    let line = folder.run_in_shell("ulimit -f 1 && exec \"$@\"", arguments).refusal()?;
    if !line.contains("out.obj") || !line.contains("room") {
        return Err(format!("what has no room is not told: {line}"));
    }
    if folder.read("out.obj")? != "an older file" || folder.names() != before {
        return Err(format!("the older file is gone, or there are others: {:?}", folder.names()));
    }
    folder.run(arguments).stdout()?;
    let written = folder.read("out.obj")?.len();
    if written > 1024 { Ok(()) } else { Err(format!("{written} bytes would have had room")) }
}

/// The superuser may read everything, so the command is run as nobody then.
fn no_permission() -> Outcome {
    let folder = Folder::with(&[FACE, ("locked.obj", FACE.1)]);
    let text = |error: std::io::Error| error.to_string();
    fs::create_dir(folder.path("locked")).map_err(text)?;
    for name in ["locked.obj", "locked"] {
        fs::set_permissions(folder.path(name), PermissionsExt::from_mode(0o0)).map_err(text)?;
    }
    let is_superuser = File::open(folder.path("locked.obj")).is_ok();
    for (arguments, told) in [
        ("inspect locked.obj", "locked.obj"),
        ("inspect locked/face.obj", "locked/face.obj"),
        ("silhouette face.obj --point 1,2,3 --on cpu -o locked/out.json", "locked/out.json"),
    ] {
        let run = if is_superuser { folder.run_as_nobody(arguments)? } else { folder.run(arguments) };
        let line = run.refusal()?;
        if !line.contains(told) || !line.contains("denied") {
            return Err(format!("that {told} may not be used is not told: {line}"));
        }
    }
    Ok(())
}

fn no_device() -> Outcome {
    if !cfg!(target_os = "linux") {
        return Ok(());
    }
    let folder = Folder::with(&[FACE]);
    for (name, value) in [("VK_DRIVER_FILES", "/nonexistent.json"), ("WGPU_BACKEND", "dx12")] {
        for arguments in ["render boxes -o out.png", "silhouette face.obj --point 1,2,3", "report --quick -o out"] {
            let line = folder.run_in_shell(&format!("{name}={value} exec \"$@\""), arguments).refusal()?;
            if !line.contains("no graphics device") || !line.contains("driver") {
                return Err(format!("{name}={value}: {line}"));
            }
        }
    }
    let names = folder.names();
    if names == ["face.obj"] { Ok(()) } else { Err(format!("files were left: {names:?}")) }
}

/// Software devices give out 2 GiB at once; moments in this size need more.
fn no_memory_on_the_device() -> Outcome {
    if !Gpu::open().is_ok_and(|gpu| gpu.is_software() && gpu.facts().max_texture_dimension_2d >= 16_384) {
        eprintln!("not tested: this device may have memory for everything");
        return Ok(());
    }
    let folder = Folder::new();
    let line = folder.run("render boxes --technique vsm --map-size 16384 --size 64x40 -o out.png").refusal()?;
    if !line.contains("no memory") || !line.contains("smaller map") || !folder.names().is_empty() {
        return Err(format!("what needs memory is not told, or files were left: {line}"));
    }
    Ok(())
}

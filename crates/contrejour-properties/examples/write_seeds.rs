//! Writes the seeds of the fuzz targets that no text editor can write, into the folder that is given.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let folder =
        env::args_os().nth(1).map(PathBuf::from).ok_or_else(|| io::Error::other("name the folder of seeds"))?;
    let gltf = triangle_gltf();
    write(&folder, "gltf/triangle.gltf", gltf.replace("BUFFER", &data_uri(&triangle_buffer())).as_bytes())?;
    write(&folder, "gltf/triangle.glb", &glb(&gltf.replace(r#","uri":"BUFFER""#, ""), &triangle_buffer()))?;
    write(&folder, "gltf/beside.gltf", gltf.replace("BUFFER", "beside.bin").as_bytes())?;
    write(&folder, "gltf/textured.gltf", textured_gltf().replace("BUFFER", &data_uri(&textured_buffer())).as_bytes())?;
    let seen = seen_gltf().replace("BUFFER", &data_uri(&triangle_buffer()));
    write(&folder, "gltf/seen.gltf", seen.as_bytes())?;
    let skinned = skinned_gltf();
    write(&folder, "gltf/skinned.glb", &glb(&skinned, &skinned_buffer()))?;
    write(&folder, "gltf/animated.glb", &glb(&animated_gltf(), &animated_buffer()))?;
    for (name, encoding) in [("little", "binary_little_endian"), ("big", "binary_big_endian")] {
        write(&folder, &format!("ply/{name}.ply"), &binary_ply(encoding))?;
    }
    write(&folder, "stl/binary.stl", &binary_stl())?;
    // What arbitrary makes of bytes is no format; runs of them are a start.
    for (name, step) in [("up", 1_u8), ("leaps", 37), ("down", 251)] {
        let bytes: Vec<u8> = (0..600_u32).map(|nth| (nth as u8).wrapping_mul(step)).collect();
        write(&folder, &format!("topology/{name}"), &bytes)?;
    }
    Ok(())
}

fn write(folder: &Path, name: &str, bytes: &[u8]) -> io::Result<()> {
    fs::write(folder.join(name), bytes)
}

fn f32_bytes(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// Three positions, three indices of 16 bits, two bytes to fill up.
fn triangle_buffer() -> Vec<u8> {
    let mut buffer = f32_bytes(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    buffer.extend([0, 0, 1, 0, 2, 0, 0, 0]);
    buffer
}

fn triangle_gltf() -> String {
    [
        r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"#,
        r#""nodes":[{"mesh":0,"name":"a","translation":[1,2,3]},{"mesh":0,"scale":[-1,1,1],"children":[2]},"#,
        r#"{"mesh":1,"rotation":[0,0,0,1]}],"#,
        r#""materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,1]}}],"#,
        r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},"#,
        r#"{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0},"mode":5},{"attributes":{"POSITION":0},"mode":1}]}],"#,
        r#""accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},"#,
        r#"{"bufferView":1,"componentType":5123,"type":"SCALAR","count":3}],"#,
        r#""bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],"#,
        r#""buffers":[{"byteLength":44,"uri":"BUFFER"}]}"#,
    ]
    .concat()
}

/// With cameras and lights of all kinds.
fn seen_gltf() -> String {
    [
        r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0},{"camera":0,"translation":[1,2,9],"name":"a"},"#,
        r#"{"camera":1,"rotation":[0,1,0,0]},{"extensions":{"KHR_lights_punctual":{"light":0}},"translation":[0,4,0]},"#,
        r#"{"extensions":{"KHR_lights_punctual":{"light":1}},"rotation":[0.6,0,0,0.8]},"#,
        r#"{"extensions":{"KHR_lights_punctual":{"light":2}},"scale":[2,2,2],"translation":[3,4,5]}],"#,
        r#""cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.1,"zfar":99,"aspectRatio":1.5}},"#,
        r#"{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":0.1,"zfar":9}}],"#,
        r#""extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":["#,
        r#"{"type":"point","intensity":20,"range":7},{"type":"directional","color":[1,0.5,0.2],"intensity":1000},"#,
        r#"{"type":"spot","spot":{"innerConeAngle":0.2,"outerConeAngle":0.7}}]}},"#,
        r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"#,
        r#""accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},"#,
        r#"{"bufferView":1,"componentType":5123,"type":"SCALAR","count":3}],"#,
        r#""bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],"#,
        r#""buffers":[{"byteLength":44,"uri":"BUFFER"}]}"#,
    ]
    .concat()
}

/// Positions, three pairs of coordinates, and the start of a PNG: loaders decode no picture.
fn textured_buffer() -> Vec<u8> {
    let mut buffer = f32_bytes(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    buffer.extend(f32_bytes(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]));
    buffer.extend(b"\x89PNG\r\n\x1a\n");
    buffer
}

fn textured_gltf() -> String {
    [
        r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0},{"mesh":0}],"#,
        r#""meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_1":1},"material":0},"#,
        r#"{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":1},{"attributes":{"POSITION":0}}]}],"#,
        r#""materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}},"#,
        r#"{"pbrMetallicRoughness":{"baseColorTexture":{"index":1,"extensions":{"KHR_texture_transform":"#,
        r#"{"offset":[0.5,1],"rotation":1,"scale":[2,-2]}}}}}],"#,
        r#""extensionsUsed":["KHR_texture_transform"],"samplers":[{"magFilter":9728,"wrapS":33648,"wrapT":33071}],"#,
        r#""textures":[{"source":0},{"source":1,"sampler":0}],"#,
        r#""images":[{"bufferView":2,"mimeType":"image/png"},{"uri":"beside.png"}],"#,
        r#""accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},"#,
        r#"{"bufferView":1,"componentType":5126,"type":"VEC2","count":3}],"#,
        r#""bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},"#,
        r#"{"buffer":0,"byteOffset":60,"byteLength":8}],"#,
        r#""buffers":[{"byteLength":68,"uri":"BUFFER"}]}"#,
    ]
    .concat()
}

/// Positions, four joints and four weights a vertex, one matrix, differences of a morph target.
fn skinned_buffer() -> Vec<u8> {
    let mut buffer = f32_bytes(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    buffer.extend([0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    buffer.extend([255, 0, 0, 0, 127, 128, 0, 0, 0, 0, 0, 0]);
    let mut matrix = [0.0; 16];
    for place in [0, 5, 10, 15] {
        matrix[place] = 1.0;
    }
    buffer.extend(f32_bytes(&matrix));
    buffer
}

fn skinned_gltf() -> String {
    [
        r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0,"skin":0},{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1]}],"#,
        r#""skins":[{"joints":[1],"inverseBindMatrices":3}],"#,
        r#""meshes":[{"weights":[0.5],"primitives":[{"attributes":"#,
        r#"{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2,"COLOR_0":2},"mode":6,"targets":[{"POSITION":4}]}]}],"#,
        r#""accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},"#,
        r#"{"bufferView":1,"componentType":5121,"type":"VEC4","count":3},"#,
        r#"{"bufferView":2,"componentType":5121,"type":"VEC4","count":3,"normalized":true},"#,
        r#"{"bufferView":3,"componentType":5126,"type":"MAT4","count":1},"#,
        r#"{"componentType":5126,"type":"VEC3","count":3,"sparse":{"count":1,"#,
        r#""indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}}],"#,
        r#""bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},"#,
        r#"{"buffer":0,"byteOffset":48,"byteLength":12},{"buffer":0,"byteOffset":60,"byteLength":64}],"#,
        r#""buffers":[{"byteLength":124}]}"#,
    ]
    .concat()
}

/// That of the skinned file, then two times, two weights and two translations.
fn animated_buffer() -> Vec<u8> {
    let mut buffer = skinned_buffer();
    buffer.extend(f32_bytes(&[0.5, 2.0, 0.0, 1.0, 5.0, 0.0, 0.0, 5.0, 1.0, 0.0]));
    buffer
}

/// The skinned file with an animation of its weights and of its joint.
fn animated_gltf() -> String {
    let skinned = skinned_gltf();
    let skinned = skinned.replace(r#""matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1]"#, r#""translation":[5,0,0]"#);
    let skinned =
        skinned.replace(r#""byteLength":64}]"#, r#""byteLength":64},{"buffer":0,"byteOffset":124,"byteLength":40}]"#);
    let skinned = skinned.replace(r#""values":{"bufferView":0}}}]"#, r#""values":{"bufferView":0}}},ACCESSORS]"#);
    let accessors = [
        r#"{"bufferView":4,"componentType":5126,"type":"SCALAR","count":2},"#,
        r#"{"bufferView":4,"byteOffset":8,"componentType":5126,"type":"SCALAR","count":2},"#,
        r#"{"bufferView":4,"byteOffset":16,"componentType":5126,"type":"VEC3","count":2}"#,
    ];
    let animations = [
        r#""animations":[{"name":"a","samplers":[{"input":5,"output":6},{"input":5,"output":7,"interpolation":"STEP"}],"#,
        r#""channels":[{"sampler":0,"target":{"node":0,"path":"weights"}},"#,
        r#"{"sampler":1,"target":{"node":1,"path":"translation"}}]}],"buffers":[{"byteLength":164}]"#,
    ];
    let skinned = skinned.replace("ACCESSORS", &accessors.concat());
    skinned.replace(r#""buffers":[{"byteLength":124}]"#, &animations.concat())
}

fn data_uri(bytes: &[u8]) -> String {
    let hex: String = bytes.iter().map(|byte| format!("%{byte:02X}")).collect();
    format!("data:application/octet-stream,{hex}")
}

fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut glb = b"glTF".to_vec();
    for word in [2, 28 + json.len() as u32 + binary.len() as u32, json.len() as u32] {
        glb.extend(word.to_le_bytes());
    }
    glb.extend(b"JSON");
    glb.extend(json);
    glb.extend((binary.len() as u32).to_le_bytes());
    glb.extend(b"BIN\0");
    glb.extend(binary);
    glb
}

fn binary_ply(encoding: &str) -> Vec<u8> {
    let mut ply = format!(
        "ply\nformat {encoding} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
         element face 1\nproperty list uchar ushort vertex_indices\nend_header\n"
    )
    .into_bytes();
    let is_little = encoding == "binary_little_endian";
    for number in [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.5] {
        ply.extend(if is_little { number.to_le_bytes() } else { number.to_be_bytes() });
    }
    ply.push(4);
    for index in 0..4_u16 {
        ply.extend(if is_little { index.to_le_bytes() } else { index.to_be_bytes() });
    }
    ply
}

fn binary_stl() -> Vec<u8> {
    let mut stl = vec![b' '; 80];
    stl.extend(2_u32.to_le_bytes());
    for corners in [[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0]] {
        stl.extend(f32_bytes(&[0.0, 0.0, 1.0]));
        stl.extend(f32_bytes(&corners));
        stl.extend([0, 0]);
    }
    stl
}

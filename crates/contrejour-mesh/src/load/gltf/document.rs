//! The JSON part of a glTF file, and what a loader can rely on before it follows any index.

use std::path::Path;

use gltf::json::Root;
use gltf::json::validation::{Checked, Error as Invalid, Validate};
use gltf::{Document, Glb, Semantic};

use crate::LoadError;

/// Required extensions that change nothing about triangles, or are read here (`KHR_mesh_quantization`).
const KNOWN_EXTENSIONS: &[&str] = &[
    "KHR_animation_pointer",
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "EXT_texture_avif",
    "EXT_texture_webp",
    "MSFT_texture_dds",
];

/// A checked document and the binary chunk of a `.glb`.
pub(super) struct Parsed<'a> {
    pub(super) document: Document,
    pub(super) binary_chunk: Option<std::borrow::Cow<'a, [u8]>>,
}

pub(super) fn parse<'a>(bytes: &'a [u8], path: &Path) -> Result<Parsed<'a>, LoadError> {
    let malformed = |place: &str, problem: String| LoadError::Malformed {
        path: path.into(),
        place: one_line(place),
        problem: one_line(&problem),
    };
    let (json, binary_chunk) = if bytes.starts_with(b"glTF") {
        check_glb_length(bytes, path)?;
        let glb = Glb::from_slice(bytes)
            .map_err(|error| malformed("GLB container", format!("{error}; export the file again")))?;
        (glb.json, glb.bin)
    } else {
        (bytes.into(), None)
    };
    let mut root: Root = gltf::json::deserialize::from_slice(&json)
        .map_err(|error| malformed("JSON", format!("{error}; correct it or export the file again")))?;

    let is_known = |name: &String| KNOWN_EXTENSIONS.contains(&name.as_str()) || name.starts_with("KHR_materials_");
    if let Some(extension) = root.extensions_required.iter().find(|name| !is_known(name)) {
        return Err(LoadError::UnsupportedExtension { path: path.into(), extension: extension.clone() });
    }
    // The validation below knows fewer extensions.
    root.extensions_required.clear();

    check_position_accessors(&root, path)?;
    complete_images(&mut root, path)?;
    let mut first_invalid = None;
    root.validate(&root, gltf::json::Path::new, &mut |place, invalid| {
        let place = place().to_string();
        // Bounds are required and often left out; they are not needed here.
        let is_bounds = place.ends_with(".min") || place.ends_with(".max");
        if first_invalid.is_none() && !(is_bounds && matches!(invalid, Invalid::Missing)) {
            first_invalid = Some((place, invalid));
        }
    });
    match first_invalid {
        Some((place, invalid)) => {
            let problem = format!("{invalid}; correct it or export the file again");
            Err(malformed(&place, problem))
        }
        None => Ok(Parsed { document: Document::from_json_without_validation(root), binary_chunk }),
    }
}

/// The validation of a primitive follows the index of its positions without a look.
fn check_position_accessors(root: &Root, path: &Path) -> Result<(), LoadError> {
    let count = root.accessors.len();
    for (mesh, of_mesh) in root.meshes.iter().enumerate() {
        for (primitive, of_primitive) in of_mesh.primitives.iter().enumerate() {
            let positions = of_primitive.attributes.get(&Checked::Valid(Semantic::Positions));
            if let Some(accessor) = positions.filter(|accessor| accessor.value() >= count) {
                return Err(LoadError::IndexOutOfRange {
                    path: path.into(),
                    place: format!("mesh {mesh}, primitive {primitive}, POSITION"),
                    what: "accessor",
                    index: accessor.value() as i64,
                    count,
                });
            }
        }
    }
    Ok(())
}

/// The reader expects of an image in a buffer that it says what it is, and of any other that it has a URI.
fn complete_images(root: &mut Root, path: &Path) -> Result<(), LoadError> {
    for (index, image) in root.images.iter_mut().enumerate() {
        match (&image.buffer_view, &image.uri) {
            (Some(_), _) if image.mime_type.is_none() => {
                // Nobody asks: its first bytes tell.
                image.mime_type = Some(gltf::json::image::MimeType(String::new()));
            }
            (None, None) => {
                let problem = "has neither a bufferView nor a uri; give it one";
                let place = format!("image {index}");
                return Err(LoadError::Malformed { path: path.into(), place, problem: problem.into() });
            }
            _ => {}
        }
    }
    Ok(())
}

/// Names in the file can hold line breaks.
fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

/// The length in the header, which the reader of the container trusts to be at least its own size.
fn check_glb_length(bytes: &[u8], path: &Path) -> Result<(), LoadError> {
    const HEADER_BYTES: u64 = 12;
    let length = bytes.get(8..).and_then(|rest| rest.first_chunk());
    let length = length.map_or(0, |length| u64::from(u32::from_le_bytes(*length)));
    let available = bytes.len() as u64;
    if (HEADER_BYTES..=available).contains(&length) {
        return Ok(());
    }
    let (path, place) = (path.into(), "GLB container".into());
    if length < HEADER_BYTES && available >= HEADER_BYTES {
        let problem = format!("its length is given as {length} bytes, less than its header has; export it again");
        return Err(LoadError::Malformed { path, place, problem });
    }
    Err(LoadError::BeyondData { path, place, needed: length.max(HEADER_BYTES), available })
}

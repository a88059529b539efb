//! Base colour textures: their pictures as they are in the file, and texture coordinates.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{Affine2, Vec2};
use gltf::image::Source;
use gltf::texture::{Info, MagFilter, WrappingMode};
use gltf::{Primitive, Semantic};

use super::accessor::{Data, Integers};
use super::buffers::{beside, data_uri_bytes};
use crate::load::ReadFile;
use crate::{EncodedImage, LoadError, Texture, TextureFilter, TextureWrap};

/// The textures that were asked for so far; each picture is read once.
pub(super) struct Textures<'a> {
    path: &'a Path,
    read_beside: &'a ReadFile<'a>,
    /// By texture index; none where the picture is not read.
    textures: HashMap<usize, Option<Arc<Texture>>>,
    /// By image index.
    images: HashMap<usize, Option<Arc<EncodedImage>>>,
    images_of_files: HashMap<PathBuf, Option<Arc<EncodedImage>>>,
    without_coordinates: usize,
    warnings: Vec<String>,
}

/// The texture of a primitive.
pub(super) struct TexturedVertices {
    pub(super) texture: Arc<Texture>,
    /// One pair for each vertex.
    pub(super) coordinates: Vec<[f32; 2]>,
}

impl<'a> Textures<'a> {
    pub(super) fn new(path: &'a Path, read_beside: &'a ReadFile<'a>) -> Self {
        Self {
            path,
            read_beside,
            textures: HashMap::new(),
            images: HashMap::new(),
            images_of_files: HashMap::new(),
            without_coordinates: 0,
            warnings: Vec::new(),
        }
    }

    /// The base colour texture of a primitive and the coordinates of its vertices, of which there are so many; `None`
    /// where it has none, or none that can be read.
    pub(super) fn of_primitive(
        &mut self,
        primitive: &Primitive,
        vertex_count: usize,
        data: &Data,
    ) -> Result<Option<TexturedVertices>, LoadError> {
        let material = primitive.material();
        let Some(info) = material.pbr_metallic_roughness().base_color_texture() else {
            return Ok(None);
        };
        let Some(texture) = self.texture(&info.texture(), data)? else {
            return Ok(None);
        };
        let coordinates = read_coordinates(primitive, &info, vertex_count, data)?;
        self.without_coordinates += usize::from(coordinates.is_none());
        Ok(coordinates.map(|coordinates| TexturedVertices { texture, coordinates }))
    }

    fn texture(&mut self, texture: &gltf::Texture, data: &Data) -> Result<Option<Arc<Texture>>, LoadError> {
        if let Some(known) = self.textures.get(&texture.index()) {
            return Ok(known.clone());
        }
        let sampler = texture.sampler();
        let filter = match sampler.mag_filter() {
            Some(MagFilter::Nearest) => TextureFilter::Nearest,
            Some(MagFilter::Linear) | None => TextureFilter::Linear,
        };
        let wrap = [sampler.wrap_s(), sampler.wrap_t()].map(|mode| match mode {
            WrappingMode::Repeat => TextureWrap::Repeat,
            WrappingMode::MirroredRepeat => TextureWrap::Mirror,
            WrappingMode::ClampToEdge => TextureWrap::Clamp,
        });
        let image = self.image(&texture.source(), data)?;
        let read = image.map(|image| Arc::new(Texture { image, wrap, filter }));
        self.textures.insert(texture.index(), read.clone());
        Ok(read)
    }

    fn image(&mut self, image: &gltf::Image, data: &Data) -> Result<Option<Arc<EncodedImage>>, LoadError> {
        if let Some(known) = self.images.get(&image.index()) {
            return Ok(known.clone());
        }
        let in_file = format!("image {}", image.index());
        let place = format!("{}: {in_file}", self.path.display());
        let read = match image.source() {
            Source::View { view, .. } => {
                let bytes = data.view_bytes(&view, || in_file.clone())?.to_vec();
                Some(Arc::new(EncodedImage { place, bytes }))
            }
            Source::Uri { uri, .. } => match uri.strip_prefix("data:") {
                Some(text) => {
                    let problem = "its data URI cannot be decoded; export the file again";
                    let bytes = data_uri_bytes(text).ok_or_else(|| data.malformed(in_file, problem))?;
                    Some(Arc::new(EncodedImage { place, bytes }))
                }
                None => self.image_beside(uri, &in_file),
            },
        };
        self.images.insert(image.index(), read.clone());
        Ok(read)
    }

    /// The picture in a file. One that is not there is a warning: the triangles are good without it.
    fn image_beside(&mut self, uri: &str, in_file: &str) -> Option<Arc<EncodedImage>> {
        let file = beside(self.path, uri);
        if let Some(known) = self.images_of_files.get(&file) {
            return known.clone();
        }
        let unread = "texture not read, base colour factors used";
        let read = if uri.contains("://") {
            self.warnings.push(format!("{in_file}: {unread}: it is on the network; download it and name the file"));
            None
        } else if file.to_string_lossy().contains(char::is_control) {
            self.warnings.push(format!("{in_file}: {unread}: its uri has a control character; rename the file"));
            None
        } else {
            match (self.read_beside)(&file) {
                Ok(bytes) => Some(Arc::new(EncodedImage { place: file.display().to_string(), bytes })),
                Err(error) => {
                    self.warnings.push(format!("{in_file}: {unread}: {error}"));
                    None
                }
            }
        };
        self.images_of_files.insert(file, read.clone());
        read
    }

    /// What is not read, a line each.
    pub(super) fn into_warnings(mut self) -> Vec<String> {
        if self.without_coordinates > 0 {
            self.warnings.push(format!(
                "{} primitives have a base colour texture and lack its texture coordinates; base colour factors are used",
                self.without_coordinates
            ));
        }
        self.warnings
    }
}

/// Coordinates in the picture, after the transform of `KHR_texture_transform`; `None` where the primitive has not the set
/// that the texture asks for.
fn read_coordinates(
    primitive: &Primitive,
    info: &Info,
    vertex_count: usize,
    data: &Data,
) -> Result<Option<Vec<[f32; 2]>>, LoadError> {
    let transform = info.texture_transform();
    let set = transform.as_ref().and_then(|transform| transform.tex_coord()).unwrap_or(info.tex_coord());
    let Some(accessor) = primitive.get(&Semantic::TexCoords(set)) else {
        return Ok(None);
    };
    let read = data.read_attribute::<2>(&accessor, Integers::Normalized, vertex_count)?;
    // The extension turns clockwise in a picture whose y points down.
    let picture_from_set = transform.map_or(Affine2::IDENTITY, |transform| {
        Affine2::from_scale_angle_translation(
            transform.scale().into(),
            -transform.rotation(),
            transform.offset().into(),
        )
    });
    let place = |&[u, v]: &[f64; 2]| picture_from_set.transform_point2(Vec2::new(u as f32, v as f32)).to_array();
    let coordinates: Vec<[f32; 2]> = read.iter().map(place).collect();
    if coordinates.as_flattened().iter().all(|coordinate| coordinate.is_finite()) {
        return Ok(Some(coordinates));
    }
    let place = format!("accessor {}", accessor.index());
    Err(data.malformed(place, "has a texture coordinate that is no finite number; correct it"))
}

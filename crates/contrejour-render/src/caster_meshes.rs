//! What a mesh of the scene casts with: the topology of what no mask cuts, and each part that one does.

use std::collections::HashMap;
use std::sync::Arc;

use contrejour_gpu::{AddMeshError, MeshHandle, Shadows, mask_facts, masked_mesh_facts, mesh_facts};
use contrejour_mesh::{
    AlphaMask, BuildOptions, DeformingMesh, EncodedImage, MaskImage, MaskImageError, MaskedMesh, MaskedMeshError,
    MaterialPart, Texture, TextureFilter, TextureWrap, TopologyAwareMesh, TopologyError, TriangleMesh,
};
use contrejour_plan::{MaskFacts, MeshFacts};
use contrejour_scene::{TextureError, TextureReader};

/// Triangles that cast in one way.
#[derive(Clone, Debug)]
pub(crate) enum CasterMesh {
    /// With silhouettes.
    Uncut(Arc<TopologyAwareMesh>),
    /// With holes, from a vertex of the scene's mesh on.
    Masked { mesh: Arc<MaskedMesh>, first_vertex: u32 },
}

/// A mesh that casts is none that can.
#[derive(Debug, thiserror::Error)]
pub enum CasterMeshError {
    /// It has no topology.
    #[error("mesh {mesh:?} cannot cast a shadow")]
    Topology {
        /// Name of the mesh in the scene.
        mesh: String,
        /// What is wrong with it.
        source: TopologyError,
    },
    /// A mask does not fit it.
    #[error("mesh {mesh:?} cannot cast a shadow through its mask")]
    Mask {
        /// Name of the mesh in the scene.
        mesh: String,
        /// What is wrong with it.
        source: MaskedMeshError,
    },
    /// The picture of a mask is not decoded.
    #[error(transparent)]
    Texture(#[from] TextureError),
}

/// A picture, and how it is looked up.
type ImageKey = (*const EncodedImage, [TextureWrap; 2], TextureFilter);

/// Makes the casting meshes of a scene, and decodes each mask once.
#[derive(Debug, Default)]
pub(crate) struct CasterMeshes {
    reader: TextureReader,
    images: HashMap<ImageKey, Arc<MaskImage>>,
}

impl CasterMesh {
    /// Its triangles.
    pub fn topology(&self) -> &TopologyAwareMesh {
        match self {
            Self::Uncut(topology) => topology,
            Self::Masked { mesh, .. } => mesh.mesh(),
        }
    }

    /// What a frame plan needs to know of it.
    pub fn facts(&self) -> MeshFacts {
        match self {
            Self::Uncut(topology) => mesh_facts(topology),
            Self::Masked { mesh, .. } => masked_mesh_facts(mesh),
        }
    }

    pub fn add_to(&self, shadows: &mut Shadows) -> Result<MeshHandle, AddMeshError> {
        match self {
            Self::Uncut(topology) => shadows.add_mesh(Arc::clone(topology)),
            Self::Masked { mesh, .. } => shadows.add_masked_mesh(mesh),
        }
    }
}

/// What a frame plan needs to know of all masks.
pub(crate) fn mask_facts_of(meshes: &[CasterMesh]) -> MaskFacts {
    mask_facts(meshes.iter().filter_map(|mesh| match mesh {
        CasterMesh::Masked { mesh, .. } => Some(mesh),
        CasterMesh::Uncut(_) => None,
    }))
}

impl CasterMeshes {
    /// What a mesh casts with; `deforming` is what moves its vertices against each other, and `mesh` is then at rest.
    pub fn make(
        &mut self,
        name: &str,
        mesh: &TriangleMesh,
        deforming: Option<&DeformingMesh>,
    ) -> Result<Vec<CasterMesh>, CasterMeshError> {
        let topology_error = |source| CasterMeshError::Topology { mesh: name.to_owned(), source };
        let mut made = Vec::new();
        let triangles = mesh.uncut_triangles();
        if !triangles.is_empty() {
            let topology = match deforming {
                Some(deforming) => deforming.topology(&mesh.positions, &triangles),
                None => TopologyAwareMesh::build(&mesh.positions, &triangles, &BuildOptions::default()),
            };
            made.push(CasterMesh::Uncut(Arc::new(topology.map_err(topology_error)?)));
        }
        let mask_error = |source| CasterMeshError::Mask { mesh: name.to_owned(), source };
        for (part, cutoff) in mesh.cut_parts() {
            let image = match &part.texture {
                Some(texture) => self.image(texture)?.map_err(|source| mask_error(source.into()))?,
                None => Arc::new(MaskImage::opaque()),
            };
            let (masked, first_vertex) = masked_part(mesh, part, (image, cutoff)).map_err(mask_error)?;
            made.push(CasterMesh::Masked { mesh: Arc::new(masked), first_vertex });
        }
        Ok(made)
    }

    /// The alpha of a picture.
    fn image(&mut self, texture: &Arc<Texture>) -> Result<Result<Arc<MaskImage>, MaskImageError>, TextureError> {
        let key = (Arc::as_ptr(&texture.image), texture.wrap, texture.filter);
        if let Some(known) = self.images.get(&key) {
            return Ok(Ok(Arc::clone(known)));
        }
        let picture = self.reader.read(&texture.image)?;
        let (width, height) = picture.dimensions();
        let alphas = picture.pixels().map(|pixel| pixel.0[3]).collect();
        let image = MaskImage::new([width, height], alphas, texture.wrap, texture.filter).map(Arc::new);
        if let Ok(image) = &image {
            self.images.insert(key, Arc::clone(image));
        }
        Ok(image)
    }
}

/// A part of a mesh with its mask, and the first of its vertices: all from that one to its last come along.
fn masked_part(
    mesh: &TriangleMesh,
    part: &MaterialPart,
    (image, cutoff): (Arc<MaskImage>, f32),
) -> Result<(MaskedMesh, u32), MaskedMeshError> {
    let triangles = mesh.triangles_of(part);
    let corners = || triangles.as_flattened().iter().copied();
    let first = corners().min().unwrap_or_default();
    let vertices = first as usize..corners().max().map_or(0, |last| last as usize + 1);
    let triangles: Vec<[u32; 3]> = triangles.iter().map(|corners| corners.map(|vertex| vertex - first)).collect();
    let coordinates = |vertex: usize| mesh.texture_coordinates.get(vertex).copied().unwrap_or_default();
    let mask = AlphaMask {
        coordinates: vertices.clone().map(coordinates).collect(),
        alphas: vertices.clone().map(|vertex| mesh.alpha(vertex as u32)).collect(),
        image,
        cutoff,
    };
    Ok((MaskedMesh::new(&mesh.positions[vertices], &triangles, mask)?, first))
}

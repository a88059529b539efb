//! What a mesh of the scene casts with: the topology of what no mask cuts, and each part that one does.

use std::collections::HashMap;
use std::sync::Arc;

use contrejour_gpu::{AddMeshError, MeshHandle, Shadows, mask_facts, masked_mesh_facts, mesh_facts};
use contrejour_mesh::{
    AlphaMask, BuildOptions, DeformingMesh, MaskImage, MaskImageError, MaskedMesh, MaskedMeshError, MaterialPart,
    Texture, TopologyAwareMesh, TopologyError, TriangleMesh,
};
use contrejour_plan::{MaskFacts, MeshFacts};
use contrejour_scene::{TextureError, TextureReader};

/// Triangles that cast in one way.
#[derive(Clone, Debug)]
pub(crate) enum CasterMesh {
    /// With silhouettes.
    Uncut(Arc<TopologyAwareMesh>),
    /// With holes.
    Masked(Arc<MaskedMesh>),
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

/// Makes the casting meshes of a scene, and decodes each mask once.
#[derive(Debug, Default)]
pub(crate) struct CasterMeshes {
    reader: TextureReader,
    images: HashMap<*const Texture, Arc<MaskImage>>,
}

impl CasterMesh {
    /// Its triangles.
    pub fn topology(&self) -> &TopologyAwareMesh {
        match self {
            Self::Uncut(topology) => topology,
            Self::Masked(masked) => masked.mesh(),
        }
    }

    /// What a frame plan needs to know of it.
    pub fn facts(&self) -> MeshFacts {
        match self {
            Self::Uncut(topology) => mesh_facts(topology),
            Self::Masked(masked) => masked_mesh_facts(masked),
        }
    }

    pub fn add_to(&self, shadows: &mut Shadows) -> Result<MeshHandle, AddMeshError> {
        match self {
            Self::Uncut(topology) => shadows.add_mesh(Arc::clone(topology)),
            Self::Masked(masked) => shadows.add_masked_mesh(masked),
        }
    }
}

/// What a frame plan needs to know of all masks.
pub(crate) fn mask_facts_of(meshes: &[CasterMesh]) -> MaskFacts {
    mask_facts(meshes.iter().filter_map(|mesh| match mesh {
        CasterMesh::Masked(masked) => Some(masked),
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
            let masked = masked_mesh(mesh, part, (image, cutoff), deforming.is_some()).map_err(mask_error)?;
            made.push(CasterMesh::Masked(Arc::new(masked)));
        }
        Ok(made)
    }

    /// The alpha of a picture.
    fn image(&mut self, texture: &Arc<Texture>) -> Result<Result<Arc<MaskImage>, MaskImageError>, TextureError> {
        if let Some(known) = self.images.get(&Arc::as_ptr(texture)) {
            return Ok(Ok(Arc::clone(known)));
        }
        let picture = self.reader.read(&texture.image)?;
        let (width, height) = picture.dimensions();
        let alphas = picture.pixels().map(|pixel| pixel.0[3]).collect();
        let image = MaskImage::new([width, height], alphas, texture.wrap, texture.filter).map(Arc::new);
        if let Ok(image) = &image {
            self.images.insert(Arc::as_ptr(texture), Arc::clone(image));
        }
        Ok(image)
    }
}

/// A part of a mesh with its mask: vertices that only other parts have are left out, but where positions come from elsewhere.
fn masked_mesh(
    mesh: &TriangleMesh,
    part: &MaterialPart,
    (image, cutoff): (Arc<MaskImage>, f32),
    keeps_vertices: bool,
) -> Result<MaskedMesh, MaskedMeshError> {
    let triangles = &mesh.triangles[part.triangles.start as usize..part.triangles.end as usize];
    let mut vertices: Vec<u32> =
        if keeps_vertices { (0..mesh.positions.len() as u32).collect() } else { triangles.as_flattened().to_vec() };
    vertices.sort_unstable();
    vertices.dedup();
    let place = |vertex: u32| vertices.partition_point(|&known| known < vertex) as u32;
    let triangles: Vec<[u32; 3]> = triangles.iter().map(|corners| corners.map(place)).collect();
    let of_vertices = |value: &dyn Fn(usize) -> [f32; 3]| -> Vec<[f32; 3]> {
        vertices.iter().map(|&vertex| value(vertex as usize)).collect()
    };
    let coordinates = |vertex: &u32| mesh.texture_coordinates.get(*vertex as usize).copied().unwrap_or_default();
    let alpha = |vertex: &u32| mesh.alphas.get(*vertex as usize).copied().unwrap_or(1.0);
    let mask = AlphaMask {
        coordinates: vertices.iter().map(coordinates).collect(),
        alphas: vertices.iter().map(alpha).collect(),
        image,
        cutoff,
    };
    MaskedMesh::new(&of_vertices(&|vertex| mesh.positions[vertex]), &triangles, mask)
}

//! The meshes that the tests run on: tiny ones, generated shapes, and the files of the shared folder.

mod shared;
mod tiny;

use std::sync::{Arc, LazyLock};

use bytemuck::cast_slice;
use contrejour_mesh::{BuildOptions, MeshFile, TopologyAwareMesh, TriangleMesh};
use contrejour_scene::shapes::Shape;
use contrejour_scene::{Scene, SceneMesh};
use glam::{DMat4, DVec3};

pub use shared::{of_folder, shared, shared_folder, shared_named};
pub use tiny::{fan, tiny};

/// What one file or generator brings.
#[derive(Clone, Debug)]
pub struct TestMesh {
    /// Path below the shared folder, or what was generated.
    pub name: String,
    /// Its meshes where they stand.
    pub parts: Vec<TestPart>,
}

/// One mesh in its place.
#[derive(Clone, Debug)]
pub struct TestPart {
    /// The triangles with their topology.
    pub topology: Arc<TopologyAwareMesh>,
    /// The source triangles, for who builds a topology of their own.
    pub triangles: Arc<[[u32; 3]]>,
    /// World space from the mesh's object space.
    pub world_from_object: DMat4,
}

impl TestMesh {
    /// A mesh that stands at the origin.
    ///
    /// # Panics
    ///
    /// When the triangles are refused.
    pub fn generated(name: &str, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        let topology = TopologyAwareMesh::build(positions, triangles, &BuildOptions::default())
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let part =
            TestPart { topology: Arc::new(topology), triangles: triangles.into(), world_from_object: DMat4::IDENTITY };
        Self { name: name.into(), parts: vec![part] }
    }

    fn of_file(name: &str, file: &MeshFile) -> Result<Self, String> {
        let build = |mesh: &TriangleMesh| {
            let topology = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default())
                .map_err(|error| format!("{name}: {error}"))?;
            // Oracles are asked about the positions that the topology carries.
            if cast_slice::<_, u32>(&topology.positions) != cast_slice::<_, u32>(&mesh.positions) {
                return Err(format!("{name}: building moves vertices"));
            }
            Ok((Arc::new(topology), Arc::from(mesh.triangles.as_slice())))
        };
        let built = file.meshes.iter().map(build).collect::<Result<Vec<_>, _>>()?;
        let parts = file
            .nodes
            .iter()
            .map(|node| {
                let (topology, triangles): &(_, Arc<[[u32; 3]]>) = &built[node.mesh];
                TestPart {
                    topology: Arc::clone(topology),
                    triangles: Arc::clone(triangles),
                    world_from_object: node.world_from_object,
                }
            })
            .collect();
        Ok(Self { name: name.into(), parts })
    }

    /// What casts in a scene.
    ///
    /// # Panics
    ///
    /// When triangles are refused.
    pub fn of_scene(name: &str, scene: &Scene) -> Self {
        let part = |placed: &SceneMesh| {
            let mut part =
                Self::generated(&placed.name, &placed.mesh.positions, &placed.mesh.triangles).parts.remove(0);
            part.world_from_object = placed.world_from_object;
            part
        };
        Self { name: name.into(), parts: scene.meshes.iter().filter(|placed| placed.casts).map(part).collect() }
    }

    /// Number of faces of all parts.
    pub fn face_count(&self) -> usize {
        self.parts.iter().map(|part| part.topology.faces.len()).sum()
    }

    /// All corners of faces in world space.
    pub fn corners_world(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.parts.iter().flat_map(|part| {
            part.topology.faces.iter().flat_map(|face| {
                [face.a, face.b, face.c].map(|vertex| {
                    let position = part.topology.positions[vertex as usize].map(f64::from);
                    part.world_from_object.transform_point3(position.into())
                })
            })
        })
    }

    /// Middle and half the diagonal of the box around all faces in world space, kept where lights can still be placed
    /// around it; a unit around the origin without faces.
    pub fn middle_and_radius(&self) -> (DVec3, f64) {
        let corners = self.corners_world().map(|corner| (corner, corner));
        match corners.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))) {
            None => (DVec3::ZERO, 1.0),
            Some((min, max)) => {
                let radius = (max - min).length() / 2.0;
                ((min + max) / 2.0, if radius > 0.0 { radius.clamp(1e-30, 1e30) } else { 1.0 })
            }
        }
    }
}

/// The scene crate's shapes, coarse.
pub fn shapes() -> Vec<TestMesh> {
    let shapes = [
        Shape::Plane { size: [10.0, 10.0], segments: 4 },
        Shape::Box { size: [1.0, 2.0, 0.5] },
        Shape::Cylinder { radius: 0.5, height: 1.0, segments: 24 },
        Shape::Sphere { radius: 0.5, segments: 24 },
        Shape::Torus { radius: 1.0, tube_radius: 0.35, segments: 32, sides: 16 },
        Shape::Knot { radius: 1.0, tube_radius: 0.22, segments: 120, sides: 12 },
        Shape::Fence { size: [4.0, 2.0, 0.04], columns: 8, rows: 4, bar: 0.04 },
        Shape::Elephant { height: 2.0, segments: 32 },
    ];
    shapes
        .iter()
        .map(|shape| {
            let mesh = shape.generate().unwrap_or_else(|error| panic!("{}: {error}", shape.kind()));
            TestMesh::generated(shape.kind(), &mesh.positions, &mesh.triangles)
        })
        .collect()
}

/// Every mesh there is; the first who asks makes them all.
pub fn all() -> &'static [TestMesh] {
    static ALL: LazyLock<Vec<TestMesh>> = LazyLock::new(|| [tiny(), shapes(), shared()].concat());
    &ALL
}

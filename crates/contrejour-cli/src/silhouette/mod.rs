//! `contrejour silhouette`: the silhouette edges of a mesh as seen from a light.

mod find;
mod found;
mod json;
mod loops;
mod obj;
mod sight;
mod svg;

use std::sync::Arc;

use contrejour_mesh::{BuildOptions, MeshFile, TopologyAwareMesh};
use contrejour_plan::{Light, LightKind};
use glam::{DVec3, DVec4, Vec3};

use crate::args::{Finder, Format, LightArguments, SilhouetteArguments};
use crate::failure::Failure;
use crate::output::{warn, write_or_print};
use found::{PlacedMesh, found_edges};

pub fn run(arguments: &SilhouetteArguments) -> Result<(), Failure> {
    let light = light(&arguments.light)?;
    let file = contrejour_mesh::load(&arguments.mesh)?;
    file.warnings.iter().for_each(|warning| warn(warning));
    warn_of_masks(&file);
    let placed = placed_meshes(&file)?;
    let silhouettes = match arguments.on {
        Finder::Gpu => find::on_gpu(&placed, &light)?,
        Finder::Cpu => find::on_cpu(&placed, &light)?,
    };
    let edges = found_edges(&placed, &silhouettes);
    let name = arguments.mesh.file_name().unwrap_or_default().to_string_lossy();
    let text = match arguments.format {
        Format::Json => json::json(&edges)?,
        Format::Obj => obj::obj(&edges, &name),
        Format::Svg => {
            let bounds = file.bounds_world().unwrap_or((DVec3::ZERO, DVec3::ZERO));
            svg::svg(&edges, homogeneous(&light), bounds, &name)
        }
    };
    write_or_print(&text, arguments.output.as_deref())
}

/// The light that was asked for. What only maps need is set to anything that is allowed.
fn light(arguments: &LightArguments) -> Result<Light, Failure> {
    let double = |vector: [f32; 3]| Vec3::from_array(vector).as_dvec3();
    let kind = match (arguments.point, arguments.direction) {
        (Some(point), _) => {
            let position = double(point);
            // Along x and wide: even the farthest point that `f32` holds then has a view whose matrix `f32` holds.
            let target = DVec3 { x: if position.x == 0.0 { 1.0 } else { 0.0 }, ..position };
            LightKind::Spot { position, target, cone_angle: 2.5, radius: 0.0, near: 1.0, far: 1e30 }
        }
        (None, Some(direction)) => LightKind::Directional {
            towards_light: double(direction),
            center: DVec3::ZERO,
            half_extent: 1.0,
            half_depth: 1.0,
            angular_radius: 0.0,
        },
        (None, None) => return Err("give the light with --point x,y,z or --direction x,y,z".into()),
    };
    let light = Light { kind, color: [1.0; 3] };
    light.validate()?;
    Ok(light)
}

/// Position and 1, or direction towards the light and 0.
fn homogeneous(light: &Light) -> DVec4 {
    match light.kind {
        LightKind::Spot { position, .. } | LightKind::Point { position, .. } => position.extend(1.0),
        LightKind::Directional { towards_light, .. } | LightKind::Cascaded { towards_light, .. } => {
            towards_light.extend(0.0)
        }
    }
}

fn warn_of_masks(file: &MeshFile) {
    let count: usize = file.nodes.iter().map(|node| file.meshes[node.mesh].cut_triangle_count()).sum();
    if count > 0 {
        warn(&format!("{count} triangles are cut by alpha masks, so they have no silhouette"));
    }
}

fn placed_meshes(file: &MeshFile) -> Result<Vec<PlacedMesh<'_>>, Failure> {
    let placed = file.nodes.iter().map(|node| {
        let mesh = &file.meshes[node.mesh];
        let topology = TopologyAwareMesh::build(&mesh.positions, &mesh.uncut_triangles(), &BuildOptions::default())?;
        Ok(PlacedMesh { mesh, topology: Arc::new(topology), world_from_object: node.world_from_object })
    });
    placed.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_are_valid_wherever_they_are() {
        for point in [[0.0; 3], [1.0, 0.0, 0.0], [f32::MAX, f32::MIN, f32::MIN_POSITIVE], [1e-45, 0.0, 0.0]] {
            let light = light(&LightArguments { point: Some(point), direction: None }).expect("every point will do");
            assert_eq!(homogeneous(&light), Vec3::from(point).as_dvec3().extend(1.0));
        }
        let direction = [0.0, 1e-45, -f32::MAX];
        let light = light(&LightArguments { point: None, direction: Some(direction) }).expect("it is not zero");
        assert_eq!(homogeneous(&light), Vec3::from(direction).as_dvec3().extend(0.0));
    }

    #[test]
    fn no_direction_is_refused() {
        assert!(light(&LightArguments { point: None, direction: Some([0.0, -0.0, 0.0]) }).is_err());
    }
}

//! Rays from the eye through each pixel's centre, in 64-bit floats and against every face: what receivers are held to.

use std::f64::consts::FRAC_1_SQRT_2;

use contrejour_render::{LocalSpace, Receiver, Receivers};
use contrejour_scene::Scene;
use glam::{DMat4, DVec2, DVec3, Vec4Swizzles};

/// How far a receiver may be from the plane of its face, in local space, where the eye is at a distance near 1 from what
/// it looks at: 16 steps of an `f32` near 1.
pub const PLANE_DISTANCE: f64 = 2e-6;

/// How far a receiver may be from its pixel's centre, in pixels, were corners not rounded before they are drawn.
const PIXELS: f64 = 0.007;

/// How far a receiver's normal, which is found from differences between pixels, may be from its face's.
pub const NORMAL_DISTANCE: f64 = 0.02;

/// Faces that are as near to each other along a ray, relative to the camera's farthest depth, may hide each other.
const DEPTH_ROUNDING: f64 = 1e-6;

/// The scene's faces in local space, and the eye.
#[derive(Clone, Debug)]
pub struct RayCaster {
    meshes: Vec<Mesh>,
    eye: DVec3,
    near_over_far: f64,
    eye_clip_from_local: DMat4,
    size: [u32; 2],
    /// Corners are rounded to this part of a pixel before they are drawn. As near to a face's edge it may show or not, and
    /// along both axes by half of it all points of the face may be off.
    sub_pixel: f64,
}

#[derive(Clone, Debug)]
struct Mesh {
    faces: Vec<Face>,
    receives: bool,
}

#[derive(Clone, Copy, Debug)]
struct Face {
    corners: [DVec3; 3],
    /// Where the corners show, in pixels; `None` where one is behind the eye.
    pixels: Option<[DVec2; 3]>,
}

/// A face that shows in a pixel's centre, or next to it.
#[derive(Clone, Copy, Debug)]
struct Hit {
    mesh: usize,
    face: usize,
    /// Distance from the eye over that of the farthest point of the same ray.
    depth: f64,
    /// Whether the face shows however its corners are rounded.
    is_sure: bool,
}

/// The largest errors among receivers.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReceiverErrors {
    /// Distance from the face's plane, local space.
    pub plane: f64,
    /// Distance from the pixel's centre, in pixels.
    pub pixels: f64,
    /// Distance of the unit normals.
    pub normal: f64,
}

/// The part of a pixel to which an adapter rounds corners, which wgpu does not tell: Vulkan allows a 16th, and SwiftShader
/// takes it; all others have a 256th.
fn sub_pixel(adapter: &str) -> f64 {
    if adapter.contains("SwiftShader") { 1.0 / 16.0 } else { 1.0 / 256.0 }
}

impl RayCaster {
    /// Takes the faces of a scene that an adapter of a name draws.
    pub fn new(scene: &Scene, local: &LocalSpace, adapter: &str) -> Self {
        let camera = local.camera(&scene.camera);
        let mut caster = Self {
            meshes: Vec::new(),
            eye: camera.eye,
            near_over_far: camera.near / camera.far,
            eye_clip_from_local: camera.clip_from_world(scene.aspect()),
            size: scene.size,
            sub_pixel: sub_pixel(adapter),
        };
        for placed in &scene.meshes {
            let local_from_object = local.local_from_world() * placed.world_from_object;
            let face = |triangle: &[u32; 3]| {
                let corners = triangle.map(|vertex| {
                    let position = placed.mesh.positions[vertex as usize].map(f64::from);
                    local_from_object.transform_point3(position.into())
                });
                let [a, b, c] = corners.map(|corner| caster.pixel_of(corner));
                Face { corners, pixels: a.zip(b).zip(c).map(|((a, b), c)| [a, b, c]) }
            };
            let faces = placed.mesh.triangles.iter().map(face).collect();
            caster.meshes.push(Mesh { faces, receives: placed.receives });
        }
        caster
    }

    /// Where a position shows, in pixels from the top left; `None` behind the eye.
    fn pixel_of(&self, position: DVec3) -> Option<DVec2> {
        let clip = self.eye_clip_from_local * position.extend(1.0);
        let ndc = clip.xy() / clip.w;
        let of_size = DVec2::new(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y);
        (clip.w > 0.0).then(|| of_size * DVec2::from(self.size.map(f64::from)))
    }

    /// Every face that may show at a place, in pixels.
    fn hits(&self, pixel: DVec2) -> Vec<Hit> {
        let of_size = pixel / DVec2::from(self.size.map(f64::from));
        let far_ndc = DVec3::new(2.0 * of_size.x - 1.0, 1.0 - 2.0 * of_size.y, 1.0);
        let along = self.eye_clip_from_local.inverse().project_point3(far_ndc) - self.eye;
        let mut hits = Vec::new();
        for (mesh, faces) in self.meshes.iter().map(|mesh| &mesh.faces).enumerate() {
            for (face, shape) in faces.iter().enumerate() {
                let inside = shape.inside(pixel, self.eye, along);
                if inside > 2.0 * self.sub_pixel {
                    let depth = shape.meet(self.eye, along).depth;
                    if depth > self.near_over_far && depth < 1.0 {
                        hits.push(Hit { mesh, face, depth, is_sure: true });
                    }
                } else if inside >= -2.0 * self.sub_pixel {
                    // Next to a face its plane may be anywhere, so its nearest corner counts.
                    hits.push(Hit { mesh, face, depth: shape.nearest(self.eye, along), is_sure: false });
                }
            }
        }
        hits
    }

    /// Whether a receiver on a face of a mesh, or none, is what can be seen at a pixel's centre.
    fn may_show(&self, face: Option<(usize, usize)>, [x, y]: [u32; 2]) -> bool {
        let hits = self.hits(DVec2::new(x.into(), y.into()) + 0.5);
        let sure = hits.iter().filter(|hit| hit.is_sure).map(|hit| hit.depth).fold(f64::INFINITY, f64::min);
        let mut seen = hits.iter().filter(|hit| hit.depth <= sure + DEPTH_ROUNDING);
        match face {
            Some(face) => seen.any(|hit| (hit.mesh, hit.face) == face),
            None => sure.is_infinite() || seen.any(|hit| !self.meshes[hit.mesh].receives),
        }
    }
}

/// Where a ray meets the plane of a face.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    depth: f64,
    is_inside: bool,
}

impl Face {
    /// How far a place is from the nearest edge, in pixels; negative outside. Infinite where that is not known.
    fn inside(&self, pixel: DVec2, eye: DVec3, along: DVec3) -> f64 {
        let Some([a, b, c]) = self.pixels else {
            return if self.meet(eye, along).is_inside { f64::INFINITY } else { f64::NEG_INFINITY };
        };
        let side = (b - a).perp_dot(c - a).signum();
        let from_edge = |from: DVec2, to: DVec2| side * (to - from).normalize_or_zero().perp_dot(pixel - from);
        from_edge(a, b).min(from_edge(b, c)).min(from_edge(c, a))
    }

    /// Möller and Trumbore 1997.
    fn meet(&self, eye: DVec3, along: DVec3) -> Meeting {
        let [a, b, c] = self.corners;
        let (ab, ac) = (b - a, c - a);
        let across = along.cross(ac);
        let from_a = (eye - a) / ab.dot(across);
        let to_b = from_a.dot(across);
        let turned = from_a.cross(ab);
        let to_c = along.dot(turned);
        Meeting { depth: ac.dot(turned), is_inside: to_b >= 0.0 && to_c >= 0.0 && to_b + to_c <= 1.0 }
    }

    /// Depth of the nearest corner along a ray that passes next to the face.
    fn nearest(&self, eye: DVec3, along: DVec3) -> f64 {
        let depth = |corner: DVec3| (corner - eye).dot(along) / along.length_squared();
        self.corners.map(depth).into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// Compares receivers with what rays meet first.
///
/// # Errors
///
/// The first pixel whose receiver is not where its ray meets the scene.
pub fn check_receivers(caster: &RayCaster, receivers: &Receivers) -> Result<ReceiverErrors, String> {
    let [width, height] = receivers.size;
    let mut errors = ReceiverErrors::default();
    for (pixel, receiver) in (0u32..).zip(&receivers.points) {
        let place = [pixel % width, pixel / width];
        let found = match receiver {
            Some(receiver) => check_receiver(caster, receivers, receiver, place, &mut errors),
            None if caster.may_show(None, place) => Ok(()),
            None => Err("no receiver, and the ray meets one".into()),
        };
        found.map_err(|error| format!("pixel {place:?} of {width}x{height}: {error}"))?;
    }
    Ok(errors)
}

fn check_receiver(
    caster: &RayCaster,
    receivers: &Receivers,
    receiver: &Receiver,
    place: [u32; 2],
    errors: &mut ReceiverErrors,
) -> Result<(), String> {
    let Some((mesh, face)) = receivers.mesh_and_face(receiver.face_id) else {
        return Err(format!("no mesh has the face {}", receiver.face_id));
    };
    let Some(shape) = caster.meshes.get(mesh).filter(|mesh| mesh.receives).and_then(|mesh| mesh.faces.get(face)) else {
        return Err(format!("mesh {mesh} has no face {face} that receives"));
    };
    if !caster.may_show(Some((mesh, face)), place) {
        return Err(format!("face {face} of mesh {mesh} is not what the ray meets first"));
    }
    check_point(caster, receiver, shape, place, errors)
}

/// The receiver lies in its face's plane and shows in its pixel's centre, so it lies where the ray meets the face.
fn check_point(
    caster: &RayCaster,
    receiver: &Receiver,
    shape: &Face,
    [x, y]: [u32; 2],
    errors: &mut ReceiverErrors,
) -> Result<(), String> {
    let [a, b, c] = shape.corners;
    let position = receiver.position.as_dvec3();
    let normal = (b - a).normalize().cross((c - a).normalize()).normalize();
    let turned = if normal.dot(caster.eye - position) >= 0.0 { normal } else { -normal };
    let centre = DVec2::new(x.into(), y.into()) + 0.5;
    let found = ReceiverErrors {
        plane: normal.dot(position - a).abs(),
        pixels: caster.pixel_of(position).map_or(f64::INFINITY, |pixel| pixel.distance(centre)),
        normal: receiver.normal.as_dvec3().distance(turned),
    };
    errors.plane = errors.plane.max(found.plane);
    errors.pixels = errors.pixels.max(found.pixels);
    errors.normal = errors.normal.max(found.normal);
    let length_error = f64::from((receiver.normal.length() - 1.0).abs());
    // Positive, so that NaN is found.
    if found.plane <= PLANE_DISTANCE
        && found.pixels <= PIXELS + caster.sub_pixel * FRAC_1_SQRT_2
        && found.normal <= NORMAL_DISTANCE
        && length_error <= 1e-5
    {
        return Ok(());
    }
    Err(format!("{receiver:?} on {a}, {b}, {c} is wrong by {found:?}"))
}

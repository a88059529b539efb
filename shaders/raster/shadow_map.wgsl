// Fills the shadow map of a light view: hardware depth of every caster, and linear depth where it is read; nearest wins,
// both face sides.
// One vertex invocation = one corner of one face of one work item, so that one draw serves all casters.
// Reads face_items, casters, caster_lights, faces, positions.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> face_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> faces: array<Face>;
@group(0) @binding(5) var<storage, read> positions: array<u32>;

struct ShadowVertex {
    @builtin(position) clip: vec4f,
    // As a share of the farthest: rasterisers extrapolate what they interpolate, which may be too much for a float.
    @location(0) depth_share: f32,
}

// Where a corner goes that draws nothing: behind the far plane.
const NOWHERE = vec4f(0.0, 0.0, 2.0, 1.0);

@vertex
fn vertex_shadow_map(@builtin(vertex_index) index: u32) -> ShadowVertex {
    let item = face_items[index / (3u * BLOCK_SIZE)];
    let caster = casters[item.caster];
    let face_id = item.block * BLOCK_SIZE + index / 3u % BLOCK_SIZE;
    if face_id >= caster.face_count {
        return ShadowVertex(NOWHERE, 0.0);
    }
    let face = faces[caster.first_face + face_id];
    let vertices = vec3u(face.a, face.b, face.c);
    let position = scaled_position(caster, vertices[index % 3u]);
    let clip = caster_lights[item.caster].light_clip_from_object * vec4f(position, 1.0);
    // All of clip space may be scaled. Rasterisers divide by its w, which is the depth: near the ends of the type they fail.
    let clip_scale = select(1.0, reciprocal_power(view.far_depth), view.perspective == 1u);
    let depth_share = depth_of_clip(clip) / view.far_depth;
    if pancakes() {
        // Fragments write depth: nothing is cut off by it.
        return ShadowVertex(vec4f(clip.xy, 0.5, 1.0), depth_share);
    }
    return ShadowVertex(clip * clip_scale, depth_share);
}

@fragment
fn fragment_shadow_map(vertex: ShadowVertex) -> @location(0) f32 {
    return in_depth_units(share_in_view(vertex));
}

// Clip z of a view that casters in front cast into: they are as near as can be. Beyond the farthest depth it is 1, which
// is no nearer than nothing.
@fragment
fn fragment_pancaked_hardware_depth(vertex: ShadowVertex) -> @builtin(frag_depth) f32 {
    return saturate(share_in_view(vertex) * view.far_depth * view.ndc_scale + view.ndc_offset);
}

struct PancakedTexel {
    // Nobody reads it: the nearest wins by it, in front of the view too.
    @builtin(frag_depth) order: f32,
    @location(0) depth: f32,
}

@fragment
fn fragment_pancaked_shadow_map(vertex: ShadowVertex) -> PancakedTexel {
    let share = share_in_view(vertex);
    // From 0 to 1 / 2 in front of depth 0, up to 1 behind it; and nothing is drawn from 1 on.
    let order = select(0.5 / (1.0 - share), 0.5 + 0.5 * share, share > 0.0);
    return PancakedTexel(order, in_depth_units(share));
}

// What is drawn lies in the frustum or before it; what is interpolated between corners 2^250 apart may be infinite.
fn share_in_view(vertex: ShadowVertex) -> f32 {
    return clamp(vertex.depth_share, least_depth() / view.far_depth, 1.0);
}

fn in_depth_units(depth_share: f32) -> f32 {
    return depth_share * (view.far_depth / view.depth_unit);
}

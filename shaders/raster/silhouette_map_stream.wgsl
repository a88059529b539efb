// Fills the silhouette map of a light view from a topology-aware stream: each face brings the normals of its neighbours, and
// is drawn larger where it has an outline edge.
// One vertex invocation = one corner of one face of one work item.
// Reads face_items, casters, caster_lights, stream_faces, and the linear depth of the shadow map.
// Valient & Bujnak 2005, equation 1.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> face_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> stream_faces: array<u32>;
@group(1) @binding(0) var shadow_depth: texture_2d<f32>;

// Normals across are 1, 2 or 4 long. Above these squared lengths the face draws the edge also while it is unlit, and whatever
// the light.
const UNLIT_ABOVE = 2.0;
const ALWAYS_ABOVE = 8.0;

@vertex
fn vertex_silhouette_stream(@builtin(vertex_index) index: u32) -> SilhouetteVertex {
    let item = face_items[index / (3u * BLOCK_SIZE)];
    let caster = casters[item.caster];
    let face_id = item.block * BLOCK_SIZE + index / 3u % BLOCK_SIZE;
    // A stream holds the mesh as it is at rest.
    if face_id >= caster.face_count || item.kind == BLOCK_OF_CALLER {
        return nowhere_drawn();
    }
    // Corners, then the normals across the edges from each to the next.
    let vectors = stream_face(caster.first_face + face_id);
    let corners = array<vec3f, 3>(vectors[0], vectors[1], vectors[2]);
    let clip_from_object = caster_lights[item.caster].light_clip_from_object;
    let image_from_normal = cofactors(clip_from_object);

    let widest = widest_corner(corners[0], corners[1], corners[2]);
    let normal = cross(near_one(widest.to_next), near_one(widest.to_last));
    let own_facing = facing(clip_from_object, image_from_normal, corners[widest.index], normal);
    let is_lit = is_lit_at(own_facing);
    var outline: FaceOutline;
    for (var i = 0u; i < 3u; i++) {
        // Its length tells who draws the edge.
        let across = vectors[3u + i];
        let length_squared = dot(across, across);
        let draws = length_squared > UNLIT_ABOVE || (length_squared > 0.0 && own_facing > LEAST_FACING_DRAWN);
        let differs = is_lit != is_lit_at(facing(clip_from_object, image_from_normal, corners[i], across));
        if !draws || (length_squared < ALWAYS_ABOVE && !differs) {
            continue;
        }
        let begin = corners[i];
        let end = corners[(i + 1u) % 3u];
        let runs_up = is_lower(begin, end);
        let low = select(end, begin, runs_up);
        let high = select(begin, end, runs_up);
        add_edge(&outline, i, clip_from_object, low, high, is_lit == runs_up);
    }
    return silhouette_vertex(outline, clip_from_object, corners, index % 3u);
}

// Above zero where a plane shows the light its front.
fn facing(clip_from_object: mat4x4f, image_from_normal: mat3x3f, place: vec3f, normal: vec3f) -> f32 {
    let clip = clip_from_object * vec4f(place, 1.0);
    return dot(near_one(clip.xyw), image_from_normal * normal);
}

// Brings normals to where x, y and w of clip space are positions: the cross product of two sides goes there as the sides do.
fn cofactors(clip_from_object: mat4x4f) -> mat3x3f {
    let columns = mat3x3f(clip_from_object[0].xyw, clip_from_object[1].xyw, clip_from_object[2].xyw);
    let reach = max(max(abs(columns[0]), abs(columns[1])), abs(columns[2]));
    let near = columns * reciprocal_power(max(max(reach.x, reach.y), reach.z));
    return mat3x3f(cross(near[1], near[2]), cross(near[2], near[0]), cross(near[0], near[1]));
}

fn near_one(vector: vec3f) -> vec3f {
    return vector * reciprocal_power(max(max(abs(vector.x), abs(vector.y)), abs(vector.z)));
}

// An order of positions, alike for all faces that share them.
fn is_lower(one: vec3f, other: vec3f) -> bool {
    if one.x != other.x {
        return one.x < other.x;
    }
    if one.y != other.y {
        return one.y < other.y;
    }
    return one.z < other.z;
}

// Depth on the light's image plane. q is linear there: -1 / z in a perspective view, z in an orthographic one.

fn depth_of_clip(clip: vec4f) -> f32 {
    return select(mix(view.near_depth, view.far_depth, clip.z), clip.w, view.perspective == 1u);
}

fn q_of_depth(depth: f32) -> f32 {
    return select(depth, -1.0 / depth, view.perspective == 1u);
}

fn depth_of_q(q: f32) -> f32 {
    return select(q, -1.0 / q, view.perspective == 1u);
}

// The size of the largest q of a receiver.
fn q_unit() -> f32 {
    return select(view.far_depth, 1.0 / view.near_depth, view.perspective == 1u);
}

// Whether casters nearer to the light than the nearest depth cast too.
fn pancakes() -> bool {
    return (view.flags & VIEW_PANCAKES) != 0u;
}

// The largest 16-bit float: maps may hold depth as a share of the farthest in 16 bits.
const LARGEST_HALF = 65504.0;

// The nearest depth that a caster has. What is still nearer, in front of a cascade, is taken to be there.
fn least_depth() -> f32 {
    return select(view.near_depth, -LARGEST_HALF * view.far_depth, pancakes());
}

// World size of a texel at a depth.
fn texel_footprint(depth: f32) -> f32 {
    return view.texel_world * select(1.0, depth, view.perspective == 1u);
}

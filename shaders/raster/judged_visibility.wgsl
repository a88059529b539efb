// Fills a full-screen target with the visibility of the light from each pixel's receiver; 1 where there is none.
// One fragment invocation = one pixel; one triangle covers all.
// Reads points, normals, and through contrejour_visibility the light's maps.

@group(0) @binding(0) var points: texture_2d<u32>;
@group(0) @binding(1) var normals: texture_2d<f32>;

@vertex
fn vertex_judged_visibility(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_clip(index);
}

@fragment
fn fragment_judged_visibility(@builtin(position) pixel: vec4f) -> @location(0) f32 {
    let point = textureLoad(points, vec2u(pixel.xy), 0);
    if point.w == 0u {
        return 1.0;
    }
    return contrejour_visibility(bitcast<vec3f>(point.xyz), textureLoad(normals, vec2u(pixel.xy), 0).xyz);
}

// Turns the numbers of quads and corners into indirect draws, clamped to what the lists hold.
// One invocation = the whole stage.
// Reads counters; writes draw_args: of the quads, of the corners, behind that of the faces.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> counters: Counters;
@group(0) @binding(2) var<storage, read_write> draw_args: array<DrawArgs>;

@compute @workgroup_size(1)
fn write_draw_args() {
    draw_args[1] = DrawArgs(VERTICES_PER_QUAD * min(counters.quads, view.quad_capacity), 1u, 0u, 0u);
    draw_args[2] = DrawArgs(VERTICES_PER_CORNER * min(counters.corners, view.corner_capacity), 1u, 0u, 0u);
}

// Turns the number of silhouette edges into the dispatches of extrude_edges and build_corners.
// One invocation = the whole stage.
// Reads counters; writes extrude_args: for the edges, for their ends.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> counters: Counters;
@group(0) @binding(2) var<storage, read_write> extrude_args: array<DispatchArgs>;

@compute @workgroup_size(1)
fn write_extrude_args() {
    let edge_count = min(counters.silhouette_edges, view.silhouette_capacity);
    extrude_args[0] = groups_for(edge_count);
    extrude_args[1] = groups_for(2u * edge_count);
}

// The deformation gradient at each vertex of a body, and its position beside it. Twin of `vertex_gradients` in
// src/procdef/embedded_skin.rs: each vertex sums over its own cells, in the order in which the processor comes to them.

// Row 0: number of vertices, first row of the cells, first row of the list of cells, 0.
// A row a vertex: first and last entry of its cells in the list, one over their volume.
// Four rows a cell: its vertices, and the columns of its inverse edges, the first with the volume behind it.
// The list: four cells a row.
@group(0) @binding(0) var<storage, read> body: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read> positions: array<vec4<f32>>;
// Four rows a vertex: its position, and the columns of its gradient.
@group(0) @binding(2) var<storage, read_write> moved: array<vec4<f32>>;

fn rest_column(row: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(body[row].xyz);
}

@compute @workgroup_size(WORKGROUP)
fn vertex_gradients(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let vertex = id.x + id.y * groups.x * WORKGROUP;
    let header = body[0];
    if vertex >= header.x {
        return;
    }
    let own = body[1u + vertex];
    var gradient = mat3x3<f32>();
    for (var entry = own.x; entry < own.y; entry++) {
        let cell = header.y + 4u * body[header.z + entry / 4u][entry % 4u];
        let corners = body[cell];
        let a = positions[corners.x].xyz;
        let edges = mat3x3<f32>(positions[corners.y].xyz - a, positions[corners.z].xyz - a, positions[corners.w].xyz - a);
        let inverse = mat3x3<f32>(rest_column(cell + 1u), rest_column(cell + 2u), rest_column(cell + 3u));
        gradient += edges * inverse * bitcast<f32>(body[cell + 1u].w);
    }
    gradient *= bitcast<f32>(own.z);
    moved[4u * vertex] = vec4<f32>(positions[vertex].xyz, 1.0);
    moved[4u * vertex + 1u] = vec4<f32>(gradient[0], 0.0);
    moved[4u * vertex + 2u] = vec4<f32>(gradient[1], 0.0);
    moved[4u * vertex + 3u] = vec4<f32>(gradient[2], 0.0);
}

// A vertex of the skin goes with the cell that it lies in, and its normal with the cofactors of the deformation gradient. Twin of
// `embed_vertex` in src/procdef/embedded_skin.rs.

// Three rows a vertex of the skin: the vertices of its cell, its coordinates there, its normal at rest.
@group(0) @binding(0) var<storage, read> skin: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read> moved: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> skin_positions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> skin_normals: array<vec4<f32>>;

@compute @workgroup_size(WORKGROUP)
fn embed_vertex(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let vertex = id.x + id.y * groups.x * WORKGROUP;
    if vertex >= arrayLength(&skin) / 3u {
        return;
    }
    let corners = skin[3u * vertex];
    let weights = bitcast<vec4<f32>>(skin[3u * vertex + 1u]);
    let rest = bitcast<vec3<f32>>(skin[3u * vertex + 2u].xyz);
    var position = vec3<f32>();
    var f = mat3x3<f32>();
    for (var k = 0u; k < 4u; k++) {
        let row = 4u * corners[k];
        position += moved[row].xyz * weights[k];
        f += mat3x3<f32>(moved[row + 1u].xyz, moved[row + 2u].xyz, moved[row + 3u].xyz) * weights[k];
    }
    // The matrix of cofactors, det(F) F⁻ᵀ.
    let normal = mat3x3<f32>(cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1])) * rest;
    let length = length(normal);
    skin_positions[vertex] = vec4<f32>(position, 1.0);
    skin_normals[vertex] = vec4<f32>(select(rest, normal / length, length > 0.0), 0.0);
}

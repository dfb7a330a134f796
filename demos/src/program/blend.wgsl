// Vertices between two states of a body, one invocation a vertex.

@group(0) @binding(0) var<storage, read> positions_0: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> normals_0: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> positions_1: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> normals_1: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> positions: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> normals: array<vec4<f32>>;
// The share of state 1 in x.
@group(0) @binding(6) var<uniform> share: vec4<f32>;

@compute @workgroup_size(64)
fn blend(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let v = id.y * groups.x * 64u + id.x;
    if v >= arrayLength(&positions) {
        return;
    }
    positions[v] = mix(positions_0[v], positions_1[v], share.x);
    // Shorter than one by a hair where the surface turns; the fragment shader makes normals unit anyway.
    normals[v] = mix(normals_0[v], normals_1[v], share.x);
}

// Lays paint on the vertices of a skin, one invocation a vertex: the fourth part of a normal, whose bits are the colour.

@group(0) @binding(0) var<storage, read> paint: array<u32>;
// Bits, not numbers: a colour may look like no number.
@group(0) @binding(1) var<storage, read_write> normals: array<vec4<u32>>;

@compute @workgroup_size(64)
fn lay(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let v = id.y * groups.x * 64u + id.x;
    if v >= arrayLength(&paint) {
        return;
    }
    normals[v].w = paint[v];
}

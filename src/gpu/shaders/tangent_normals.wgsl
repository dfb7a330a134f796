// Position and normal of every vertex: the paper's two tangent points (section 5.3). The twin of
// `elastic/tangent_normals.rs`.

fn tangent(n: vec3<f32>) -> vec3<f32> {
    let sign = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (sign + n.z);
    return vec3<f32>(1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x);
}

@compute @workgroup_size(WORKGROUP)
fn deform_vertices(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = id.x + id.y * groups.x * WORKGROUP;
    if index >= arrayLength(&rest) {
        return;
    }
    let vertex = rest[index];
    let skin = skin_weights(vertex);
    let epsilon = reals(0u).w;
    let x = vertex.position;
    let first = tangent(vertex.normal);
    let second = cross(vertex.normal, first);
    let y = deform(x, skin);
    let y1 = deform(x + first * epsilon, skin);
    let y2 = deform(x + second * epsilon, skin);
    let normal = cross(y1 - y, y2 - y);
    let size = length(normal);
    positions[index] = vec4<f32>(y + reals(1u).xyz, 1.0);
    if size > 0.0 {
        normals[index] = vec4<f32>(normal / size, 0.0);
    } else {
        normals[index] = vec4<f32>(vertex.normal, 0.0);
    }
}

// One entry for each drawn item. Mirrors `uniforms::Instance`.

struct Instance {
    model: mat4x4f,
    normal_x: vec4f,       // columns of the inverse transpose
    normal_y: vec4f,
    normal_z: vec4f,
    colour: vec4f,         // base colour, alpha
    surface: vec4f,        // roughness, metallic, clearcoat, sheen
    depth: vec4f,          // subsurface
    wire: vec4f,           // colour of the wireframe
}

@group(0) @binding(1) var<storage, read> instances: array<Instance>;

fn world_position(instance: u32, p: vec4f) -> vec3f {
    return (instances[instance].model * vec4f(p.xyz, 1.0)).xyz;
}

fn world_normal(instance: u32, n: vec3f) -> vec3f {
    return mat3x3f(instances[instance].normal_x.xyz, instances[instance].normal_y.xyz,
                   instances[instance].normal_z.xyz) * n;
}

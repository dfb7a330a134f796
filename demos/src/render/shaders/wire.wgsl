// The edges of a mesh over its surface. Each triangle's corners are pulled from the mesh's buffers, so that a corner
// knows its place in the triangle; what is nearer to an edge than a line's width is drawn.

@group(1) @binding(0) var<storage, read> positions: array<vec4f>;
@group(1) @binding(1) var<storage, read> indices: array<u32>;

struct Wire {
    @builtin(position) clip: vec4f,
    @location(0) corner: vec3f,
    @location(1) @interpolate(flat) colour: vec4f,
}

@vertex
fn wire_vertex(@builtin(vertex_index) i: u32, @builtin(instance_index) instance: u32) -> Wire {
    let world = world_position(instance, positions[indices[i]]);
    let nearer = world + (view.eye.xyz - world) * 0.002;
    let k = i % 3u;
    let corner = vec3f(f32(k == 0u), f32(k == 1u), f32(k == 2u));
    return Wire(view.view_proj * vec4f(nearer, 1.0), corner, instances[instance].wire);
}

@fragment
fn wire_fragment(in: Wire) -> @location(0) vec4f {
    let rate = max(fwidth(in.corner), vec3f(1e-6));
    let pixels = in.corner / rate;
    let nearest = min(pixels.x, min(pixels.y, pixels.z));
    // Where triangles are only a few pixels high, their edges fade rather than paint everything over.
    let height = 1.0 / max(rate.x, max(rate.y, rate.z));
    let cover = in.colour.a * (1.0 - smoothstep(0.4, 1.2, nearest)) * clamp(height / 10.0, 0.15, 1.0);
    return vec4f(in.colour.rgb * cover, cover);
}

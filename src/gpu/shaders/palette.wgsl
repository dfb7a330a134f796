// What the shader reads and writes, and how numbers lie in the packed palette. `palette_bytes.rs` writes it; the
// strides and offsets (HEADER, SEGMENT, ...) are constants of that file, prepended to this text.

struct RestVertex {
    position: vec3<f32>,
    segments_01: u32,
    normal: vec3<f32>,
    segments_23: u32,
    weights: vec4<f32>,
}

struct SkinWeights {
    segments: vec4<u32>,
    weights: vec4<f32>,
}

@group(0) @binding(0) var<storage, read> rest: array<RestVertex>;
@group(0) @binding(1) var<storage, read> palette: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> positions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> normals: array<vec4<f32>>;

fn reals(index: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(palette[index]);
}

fn skin_weights(vertex: RestVertex) -> SkinWeights {
    let low = vec4<u32>(vertex.segments_01, vertex.segments_01 >> 16u, vertex.segments_23, vertex.segments_23 >> 16u);
    return SkinWeights(low & vec4<u32>(0xffffu), vertex.weights);
}

// The weight of a segment for this vertex, 0 where it has none.
fn weight_of(skin: SkinWeights, segment: u32) -> f32 {
    let own = select(vec4<f32>(0.0), skin.weights, skin.segments == vec4<u32>(segment));
    return own.x + own.y + own.z + own.w;
}

// The vertex's share in a field whose shares begin at row `first`, four segments a row: all of it where there are none.
fn share_of(skin: SkinWeights, first: u32) -> f32 {
    if first == 0u {
        return 1.0;
    }
    var sum = 0.0;
    for (var k = 0u; k < 4u; k++) {
        let segment = skin.segments[k];
        sum += skin.weights[k] * reals(first + segment / 4u)[segment % 4u];
    }
    return sum;
}

// Rotates v by a unit quaternion.
fn rotate(q: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    let u = 2.0 * cross(q.xyz, v);
    return v + q.w * u + cross(q.xyz, u);
}

// Ambient occlusion in screen space at half the resolution: how much of the hemisphere over each pixel is hidden by
// what the depth image shows near it. `gather` estimates it with few samples on a turned spiral (scalable ambient
// obscurance); `smooth_out` averages the 4x4 pixels between which the turns differ, but not across depth steps.

@group(1) @binding(0) var depth_image: texture_depth_2d;
@group(1) @binding(1) var gathered: texture_2d<f32>;

const SAMPLES: u32 = 14u;

@vertex
fn whole_screen(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// Camera-space position of a pixel: x right, y up, z the distance along the view direction.
fn position_at(pixel: vec2i) -> vec3f {
    let last = vec2i(view.size.zw) - 1;
    let at = clamp(pixel, vec2i(0), last);
    let z = view.eye.w / max(textureLoad(depth_image, at, 0), 1e-6);
    let ndc = (vec2f(at) + 0.5) / view.size.zw * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0);
    return vec3f(ndc * vec2f(view.right.w, view.up.w), 1.0) * z;
}

fn shorter(a: vec3f, b: vec3f) -> vec3f {
    return select(b, a, abs(a.z) < abs(b.z));
}

@fragment
fn gather(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(at.xy);
    let p = position_at(pixel);
    if p.z > 1e5 {
        return vec4f(1.0, 6e4, 0.0, 0.0);
    }
    let dx = shorter(position_at(pixel + vec2i(1, 0)) - p, p - position_at(pixel - vec2i(1, 0)));
    let dy = shorter(position_at(pixel + vec2i(0, 1)) - p, p - position_at(pixel - vec2i(0, 1)));
    var n = normalize(cross(dx, dy));
    n = select(n, -n, dot(n, p) > 0.0);

    let radius = view.occlusion.x;
    let reach = min(radius / p.z / view.up.w * 0.5 * view.size.w, 0.3 * view.size.w);
    let turn = f32((pixel.x & 3) * 4 + (pixel.y & 3)) / 16.0;
    let shuffled = fract(turn * 7.0 + f32(pixel.x & 3) * 0.25);
    var hidden = 0.0;
    for (var i = 0u; i < SAMPLES; i++) {
        let r = (f32(i) + 0.2 + 0.6 * shuffled) / f32(SAMPLES);
        let a = (f32(i) * 7.0 / f32(SAMPLES) + turn) * 2.0 * PI;
        let q = position_at(pixel + vec2i(round(r * reach * vec2f(cos(a), sin(a))))) - p;
        let d2 = dot(q, q);
        let window = max(1.0 - d2 / (radius * radius), 0.0);
        hidden += window * window * max(dot(q, n) - 0.004 * p.z, 0.0) * inverseSqrt(d2 + 1e-4 * radius * radius);
    }
    let open = saturate1(1.0 - view.occlusion.y * 3.2 * hidden / f32(SAMPLES));
    return vec4f(open, min(p.z, 6e4), 0.0, 0.0);
}

@fragment
fn smooth_out(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(at.xy);
    let last = vec2i(view.size.zw) - 1;
    let centre = textureLoad(gathered, pixel, 0).xy;
    var sum = vec2f(0.0);
    for (var y = -2; y < 2; y++) {
        for (var x = -2; x < 2; x++) {
            let s = textureLoad(gathered, clamp(pixel + vec2i(x, y), vec2i(0), last), 0).xy;
            let w = max(1.0 - abs(s.y - centre.y) / (0.04 * centre.y), 0.0) + 1e-4;
            sum += vec2f(s.x * w, w);
        }
    }
    return vec4f(sum.x / sum.y, centre.y, 0.0, 0.0);
}

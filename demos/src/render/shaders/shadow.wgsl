// Shadows whose edges soften with the distance to what casts them (percentage-closer soft shadows).
//
// A first handful of samples finds how far the blockers are; a second one, spread over the penumbra which that
// distance implies, compares depths. The disc is turned for each pixel, and the receiver is taken to be a plane, so
// that wide discs do not darken the surface that they lie on.

@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_compare: sampler_comparison;

const SEARCH_SAMPLES: u32 = 10u;
const FILTER_SAMPLES: u32 = 20u;

// The next direction on a spiral: a turn by the golden angle, which spreads any number of points evenly over a disc.
fn golden_turn(d: vec2f) -> vec2f {
    return vec2f(-0.737368878 * d.x - 0.675490294 * d.y, 0.675490294 * d.x - 0.737368878 * d.y);
}

// Share of the sun that reaches point p with geometric normal n, in 0..1.
fn sun_visibility(p: vec3f, n: vec3f, pixel: vec2f, lift: f32) -> f32 {
    let map_size = f32(textureDimensions(shadow_map).x);
    let half_extent = view.light_x.w;
    let range = view.light_y.w;
    let texel = 2.0 * half_extent / map_size;
    let facing = dot(n, view.sun.xyz);
    let start = p + n * (texel * (1.0 + 1.5 * sqrt(saturate1(1.0 - facing * facing))) * lift);
    let clip = view.light * vec4f(start, 1.0);
    let uv = clip.xy * vec2f(0.5, -0.5) + 0.5;
    let edge = max(abs(clip.x), abs(clip.y));
    if edge >= 1.0 || clip.z >= 1.0 {
        return 1.0;
    }
    // Depth change, in metres, for a metre along the map's axes: the plane of the receiver.
    let plane = clamp(vec2f(dot(n, view.light_x.xyz), dot(n, view.light_y.xyz)) / max(abs(facing), 0.2),
                      vec2f(-2.0), vec2f(2.0)) * sign(facing);
    let angle = gradient_noise(pixel) * 2.0 * PI;
    var turned = vec2f(cos(angle), sin(angle));
    let to_uv = vec2f(0.5, -0.5) / half_extent;

    let search = max(view.sun.w * min(clip.z * range, 0.7 * half_extent), 1.5 * texel);
    var blockers = 0.0;
    var blocker_depth = 0.0;
    for (var i = 0u; i < SEARCH_SAMPLES; i++) {
        turned = golden_turn(turned);
        let offset = turned * (search * sqrt((f32(i) + 0.5) / f32(SEARCH_SAMPLES)));
        let at = vec2i((uv + offset * to_uv) * map_size);
        let depth = textureLoad(shadow_map, clamp(at, vec2i(0), vec2i(i32(map_size) - 1)), 0);
        let receiver = clip.z + (dot(plane, offset) - texel) / range;
        if depth < receiver {
            blockers += 1.0;
            blocker_depth += depth;
        }
    }
    if blockers == 0.0 {
        return 1.0;
    }
    let faded = smoothstep(0.9, 1.0, edge);
    let dark = blockers == f32(SEARCH_SAMPLES);
    let gap = (clip.z - blocker_depth / blockers) * range;
    let penumbra = clamp(gap * view.sun.w, 1.2 * texel, search);
    var lit = 0.0;
    for (var i = 0u; i < FILTER_SAMPLES; i++) {
        turned = golden_turn(turned);
        let offset = turned * (penumbra * sqrt((f32(i) + 0.5) / f32(FILTER_SAMPLES)));
        let receiver = clip.z + (dot(plane, offset) - 0.5 * texel) / range;
        // Deep in a shadow, the first few are enough.
        if dark && i == 6u && lit == 0.0 {
            break;
        }
        lit += textureSampleCompareLevel(shadow_map, shadow_compare, uv + offset * to_uv, receiver);
    }
    return mix(lit / f32(FILTER_SAMPLES), 1.0, faded);
}

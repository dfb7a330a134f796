// From the light of the scene to the colours of a screen: AgX, a film-like curve under which bright colours fade to
// white without a change of hue, then a trace of noise against bands in smooth gradients.

@group(1) @binding(0) var scene: texture_2d<f32>;

@vertex
fn whole_screen(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

fn agx(light: vec3f) -> vec3f {
    let inset = mat3x3f(0.842479062253094, 0.0423282422610123, 0.0423756549057051,
                        0.0784335999999992, 0.878468636469772, 0.0784336,
                        0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    let outset = mat3x3f(1.19687900512017, -0.0528968517574562, -0.0529716355144438,
                         -0.0980208811401368, 1.15190312990417, -0.0980434501171241,
                         -0.0990297440797205, -0.0989611768448433, 1.15107367264116);
    let low = -12.47393;
    let high = 4.026069;
    let x = (clamp(log2(max(inset * light, vec3f(1e-10))), vec3f(low), vec3f(high)) - low) / (high - low);
    let x2 = x * x;
    let x4 = x2 * x2;
    let curve = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
    let punch = pow(max(curve, vec3f(0.0)), vec3f(1.6));
    let grey = dot(punch, vec3f(0.2126, 0.7152, 0.0722));
    return clamp(outset * (grey + 1.4 * (punch - grey)), vec3f(0.0), vec3f(1.0));
}

fn display(at: vec4f) -> vec3f {
    let light = textureLoad(scene, vec2i(at.xy), 0).rgb * view.occlusion.z * 1.45;
    return agx(light) + (gradient_noise(at.xy) - 0.5) / 255.0;
}

// For targets that store the bytes as they are.
@fragment
fn encoded(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return vec4f(display(at), 1.0);
}

// For sRGB targets, which encode on their own.
@fragment
fn linear(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let c = clamp(display(at), vec3f(0.0), vec3f(1.0));
    let low = c / 12.92;
    let high = pow((c + 0.055) / 1.055, vec3f(2.4));
    return vec4f(select(high, low, c <= vec3f(0.04045)), 1.0);
}

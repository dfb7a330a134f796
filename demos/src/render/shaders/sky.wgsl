// The studio: a light cyclorama without seams, and one large soft box overhead.

// Radiance that comes from direction d.
fn sky(d: vec3f) -> vec3f {
    let t = smoothstep(0.0, 0.75, d.y);
    let below = view.horizon.w * smoothstep(0.0, -0.6, d.y);
    return mix(mix(view.horizon.rgb, view.bounce.rgb, below), view.zenith.rgb, t);
}

// What a surface of the given roughness mirrors from direction d.
fn mirrored(d: vec3f, roughness: f32) -> vec3f {
    let blur = 0.06 + roughness;
    let below = mix(view.horizon.rgb * 0.7, view.bounce.rgb, smoothstep(0.0, -0.7, d.y));
    var c = mix(sky(d), below, smoothstep(blur * 0.6, -blur * 0.6, d.y));
    let box = normalize(vec3f(-0.45, 0.8, 0.4));
    let lobe = smoothstep(0.9 - 0.5 * roughness, 0.97, dot(d, box));
    c += vec3f(4.0) * lobe * (1.0 - 0.75 * roughness);
    return c * mix(view.zenith.w, 1.0, 0.35);
}

// Cosine-weighted mean of the light that reaches a surface with normal n.
fn irradiance(n: vec3f) -> vec3f {
    let up = n.y * 0.5 + 0.5;
    let sides = mix(view.bounce.rgb, view.horizon.rgb, 0.5);
    let low = mix(view.bounce.rgb, sides, saturate1(up * 2.0));
    let high = mix(view.horizon.rgb, view.zenith.rgb, 0.5);
    return mix(low, high, smoothstep(0.3, 1.0, up)) * view.zenith.w;
}

// Far things take the colour of the horizon behind them.
fn fogged(colour: vec3f, p: vec3f) -> vec3f {
    let offset = p - view.eye.xyz;
    let far = max(length(offset) - view.ground.z, 0.0) / view.ground.w;
    return mix(sky(normalize(offset)), colour, exp(-far * far * 1.5));
}

// The ground, a plane with fine lines every metre and every ten, and the sky behind everything.

struct Ground {
    @builtin(position) clip: vec4f,
    @location(0) position: vec3f,
}

@vertex
fn ground_vertex(@builtin(vertex_index) i: u32) -> Ground {
    let corner = vec2f(f32(i & 1u), f32(i >> 1u)) * 2.0 - 1.0;
    let p = vec3f(view.eye.x, view.ground.x, view.eye.z) + 4000.0 * vec3f(corner.x, 0.0, -corner.y);
    return Ground(view.view_proj * vec4f(p, 1.0), p);
}

// Coverage of lines of width `width` along the integer values of x, as wide as a pixel at least, fading instead.
fn lines(x: vec2f, width: f32) -> f32 {
    let pixel = max(fwidth(x), vec2f(1e-5));
    let drawn = max(vec2f(width), pixel);
    let distance = abs(fract(x + 0.5) - 0.5);
    let cover = smoothstep(drawn * 0.5 + pixel * 0.75, drawn * 0.5 - pixel * 0.75, distance) * width / drawn;
    let line = mix(cover, vec2f(width), smoothstep(vec2f(0.3), vec2f(0.7), pixel));
    return max(line.x, line.y);
}

@fragment
fn ground_fragment(in: Ground) -> @location(0) vec4f {
    let grid = max(lines(in.position.xz, 0.012) * 0.55, lines(in.position.xz * 0.1, 0.0025));
    let colour = view.ground_colour.rgb * (1.0 - view.ground.y * grid);
    let depth = dot(in.position - view.eye.xyz, view.forward.xyz);
    let open = openness_at(in.clip.xy, depth);
    let s = Surface(in.position, vec3f(0.0, 1.0, 0.0), colour, 0.6, 0.0, 0.0, 0.0, 0.0);
    let light = shade(s, in.clip.xy, open, true);
    return vec4f(fogged(light.diffuse + 0.35 * light.mirror, in.position), 1.0);
}

@fragment
fn depth_only() {
}

struct Backdrop {
    @builtin(position) clip: vec4f,
    @location(0) ray: vec3f,
}

@vertex
fn backdrop_vertex(@builtin(vertex_index) i: u32) -> Backdrop {
    let ndc = vec2f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0);
    let ray = view.forward.xyz + view.right.xyz * view.right.w * ndc.x + view.up.xyz * view.up.w * ndc.y;
    return Backdrop(vec4f(ndc, 0.0, 1.0), ray);
}

@fragment
fn backdrop_fragment(in: Backdrop) -> @location(0) vec4f {
    return vec4f(sky(normalize(in.ray)), 1.0);
}

// Lines of constant width on the screen, and small balls, for what the eye cannot see: springs, goals, outlines.

struct Stroke {
    @builtin(position) clip: vec4f,
    @location(0) across: vec2f,    // pixels from the middle, half the width in pixels
    @location(1) @interpolate(flat) colour: vec4f,
}

fn corner_of(i: u32) -> vec2f {
    return vec2f(f32(i & 1u), f32(i >> 1u)) * 2.0 - 1.0;
}

@vertex
fn line_vertex(@builtin(vertex_index) i: u32, @location(0) start: vec4f, @location(1) end: vec4f,
               @location(2) colour: vec4f) -> Stroke {
    let corner = corner_of(i);
    let near = view.eye.w;
    // A point behind the eye slides along the line to the near plane.
    var a = view.view_proj * vec4f(start.xyz, 1.0);
    var b = view.view_proj * vec4f(end.xyz, 1.0);
    let t = (near - a.w) / (b.w - a.w);
    let cut = mix(a, b, t);
    if a.w < near && b.w > near {
        a = cut;
    } else if b.w < near && a.w > near {
        b = cut;
    }
    let along = normalize((b.xy / b.w - a.xy / a.w) * view.size.xy + vec2f(1e-5, 0.0));
    let side = vec2f(-along.y, along.x) * corner.x;
    let half_width = 0.5 * start.w * view.size.y / 540.0;
    let reach = half_width + 1.0;
    var p = a;
    if corner.y > 0.0 {
        p = b;
    }
    p += vec4f((side + along * corner.y * 0.5) * reach / view.size.xy * 2.0 * p.w, 0.0, 0.0);
    return Stroke(p, vec2f(corner.x * reach, half_width), colour);
}

fn line_cover(in: Stroke) -> f32 {
    return in.colour.a * saturate1(in.across.y + 0.5 - abs(in.across.x));
}

@fragment
fn line_fragment(in: Stroke) -> @location(0) vec4f {
    let cover = line_cover(in);
    return vec4f(in.colour.rgb * cover, cover);
}

@fragment
fn hidden_line_fragment(in: Stroke) -> @location(0) vec4f {
    let cover = line_cover(in) * view.occlusion.w;
    return vec4f(in.colour.rgb * cover, cover);
}

struct Bead {
    @builtin(position) clip: vec4f,
    @location(0) place: vec2f,
    @location(1) @interpolate(flat) colour: vec4f,
}

@vertex
fn ball_vertex(@builtin(vertex_index) i: u32, @location(0) centre: vec4f, @location(1) colour: vec4f) -> Bead {
    let corner = corner_of(i) * 1.1;
    let p = centre.xyz + (view.right.xyz * corner.x + view.up.xyz * corner.y) * centre.w;
    return Bead(view.view_proj * vec4f(p, 1.0), corner, colour);
}

fn ball_colour(in: Bead) -> vec4f {
    let r = length(in.place);
    let edge = fwidth(r);
    let cover = in.colour.a * (1.0 - smoothstep(1.0 - edge, 1.0, r));
    let n = vec3f(in.place, sqrt(max(1.0 - r * r, 0.0)));
    let light = 0.55 + 0.5 * saturate1(dot(n, normalize(vec3f(-0.4, 0.7, 0.6))));
    return vec4f(in.colour.rgb * light * cover, cover);
}

@fragment
fn ball_fragment(in: Bead) -> @location(0) vec4f {
    return ball_colour(in);
}

@fragment
fn hidden_ball_fragment(in: Bead) -> @location(0) vec4f {
    return ball_colour(in) * view.occlusion.w;
}

// Light leaving a surface: microfacet highlights (GGX), diffuse light, sheen and a glow of light under the skin.

@group(1) @binding(2) var openness: texture_2d<f32>;

struct Surface {
    position: vec3f,
    normal: vec3f,
    colour: vec3f,
    roughness: f32,
    metallic: f32,
    clearcoat: f32,
    sheen: f32,
    subsurface: f32,
}

struct Light {
    diffuse: vec3f,
    mirror: vec3f,
}

// Ambient openness at a full-size pixel: the four half-size neighbours, weighted by how well their depth fits.
fn openness_at(pixel: vec2f, depth: f32) -> f32 {
    let last = vec2i(view.size.zw) - 1;
    let at = pixel * view.size.zw / view.size.xy - 0.5;
    let base = vec2i(floor(at));
    let f = fract(at);
    var sum = vec2f(0.0);
    for (var i = 0; i < 4; i++) {
        let o = vec2i(i & 1, i >> 1);
        let s = textureLoad(openness, clamp(base + o, vec2i(0), last), 0).xy;
        let near = mix(1.0 - f, f, vec2f(o));
        let fit = max(1.0 - abs(s.y - depth) / (0.05 * depth), 0.0);
        let w = (near.x * near.y + 0.02) * (fit + 1e-3);
        sum += vec2f(s.x * w, w);
    }
    return sum.x / sum.y;
}

fn ggx(n: vec3f, v: vec3f, l: vec3f, roughness: f32) -> f32 {
    let h = normalize(v + l);
    let a = max(roughness * roughness, 0.002);
    let a2 = a * a;
    let nh = saturate1(dot(n, h));
    let nv = saturate1(dot(n, v)) + 1e-4;
    let nl = saturate1(dot(n, l));
    let d = nh * nh * (a2 - 1.0) + 1.0;
    let smith = nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2);
    return a2 / (PI * d * d) * 0.5 / max(smith, 1e-4) * nl;
}

fn fresnel(f0: vec3f, cosine: f32) -> vec3f {
    return f0 + (1.0 - f0) * pow(saturate1(1.0 - cosine), 5.0);
}

// Share of the surroundings that a rough surface mirrors (Karis' fit of the split-sum integral).
fn mirrored_share(f0: vec3f, roughness: f32, nv: f32) -> vec3f {
    let r = roughness * vec4f(-1.0, -0.0275, -0.572, 0.022) + vec4f(1.0, 0.0425, 1.04, -0.04);
    let a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    let ab = vec2f(-1.04, 1.04) * a + r.zw;
    return f0 * ab.x + ab.y;
}

// A curved surface smaller than a pixel shines like a rough one: roughness grows by how much the normal varies in it.
fn roughened(roughness: f32, n: vec3f) -> f32 {
    let x = dpdx(n);
    let y = dpdy(n);
    let spread = min(0.5 * (dot(x, x) + dot(y, y)), 0.18);
    return sqrt(sqrt(pow(roughness, 4.0) + spread));
}

// Very bright samples would make edges jagged even at several samples a pixel.
fn limited(light: vec3f) -> vec3f {
    return min(light, vec3f(8.0));
}

fn shade(s: Surface, pixel: vec2f, open: f32, shadowed: bool) -> Light {
    let v = normalize(view.eye.xyz - s.position);
    let n = s.normal;
    let l = view.sun.xyz;
    let nl = dot(n, l);
    let nv = saturate1(dot(n, v));
    let f0 = mix(vec3f(0.04), s.colour, s.metallic);
    let albedo = s.colour * (1.0 - s.metallic);

    // Light under the skin goes past the terminator, red farthest.
    let wrap = s.subsurface * vec3f(0.42, 0.22, 0.13);
    let direct = clamp((vec3f(nl) + wrap) / ((1.0 + wrap) * (1.0 + wrap)), vec3f(0.0), vec3f(1.0));
    var visible = f32(nl > 0.0);
    if shadowed && nl > -0.5 * s.subsurface {
        // Creases too fine for the shadow map are dark where light grazes them.
        let crease = saturate1(abs(nl) + 2.0 * open * open - 0.9);
        visible = sun_visibility(s.position, n, pixel, 1.0 + 3.0 * s.subsurface) * crease;
    }
    let tinted = mix(vec3f(visible), sqrt(vec3f(visible)) * vec3f(1.0, 0.88, 0.8), 0.3 * s.subsurface);
    let sun = view.sun_colour.rgb;

    // Dark corners of bright things are lit by the things themselves.
    let closed = 1.0 - open;
    let ambient_open = vec3f(open) + albedo * closed * open * 0.7;
    let around = irradiance(n);

    var out: Light;
    out.diffuse = albedo * (sun * direct * tinted / PI + around * ambient_open);
    let fuzz = s.sheen * pow(1.0 - nv, 3.0);
    out.diffuse += fuzz * mix(vec3f(0.5), s.colour, 0.6) * (around * open + sun * saturate1(nl * 0.5 + 0.5) * visible * 0.12);

    let mirror_open = saturate1(pow(nv + open, exp2(-16.0 * s.roughness - 1.0)) - 1.0 + open);
    let h = normalize(v + l);
    out.mirror = sun * visible * ggx(n, v, l, s.roughness) * fresnel(f0, dot(v, h));
    let r = reflect(-v, n);
    out.mirror += mirrored(r, s.roughness) * mirrored_share(f0, s.roughness, nv) * mirror_open;
    if s.clearcoat > 0.0 {
        let coat = s.clearcoat * fresnel(vec3f(0.04), nv).x;
        out.diffuse *= 1.0 - coat;
        out.mirror = out.mirror * (1.0 - coat) + mirrored(r, 0.05) * coat * mirror_open
            + sun * visible * ggx(n, v, l, 0.12) * s.clearcoat * 0.04;
    }
    return out;
}

// What every shader knows: the camera, the light and the air. Mirrors `uniforms::View`.

struct View {
    view_proj: mat4x4f,
    light: mat4x4f,        // world -> shadow map clip space
    eye: vec4f,            // w: distance of the near plane
    right: vec4f,          // w: tan(fov/2) * aspect
    up: vec4f,             // w: tan(fov/2)
    forward: vec4f,
    sun: vec4f,            // unit vector towards the sun, w: tangent of its angular radius
    sun_colour: vec4f,
    light_x: vec4f,        // axes of the shadow map in the world, w: half extent in metres
    light_y: vec4f,        // w: depth range in metres
    zenith: vec4f,         // w: share of the sky's light that reaches surfaces
    horizon: vec4f,        // w: share of the light from below in the background straight down
    bounce: vec4f,
    ground: vec4f,         // height, grid strength, fog start, fog length
    ground_colour: vec4f,
    size: vec4f,           // pixels: width, height; of the half-size image: width, height
    occlusion: vec4f,      // radius in metres, strength, exposure, overlay opacity where hidden
}

@group(0) @binding(0) var<uniform> view: View;

const PI: f32 = 3.14159265;

fn saturate1(x: f32) -> f32 {
    return clamp(x, 0.0, 1.0);
}

// Interleaved gradient noise: a dither pattern whose 3x3 neighbourhoods are all well spread.
fn gradient_noise(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(floor(pixel), vec2f(0.06711056, 0.00583715))));
}

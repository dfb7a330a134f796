// Fills the shadow map, and the small depth image that ambient occlusion is computed from.

struct Caster {
    @builtin(position) clip: vec4f,
    @location(0) alpha: f32,
}

@vertex
fn caster_vertex(@builtin(instance_index) instance: u32, @location(0) p: vec4f) -> Caster {
    return Caster(view.light * vec4f(world_position(instance, p), 1.0), instances[instance].colour.a);
}

// What is translucent lets a share of the texels through; filtering turns the dots into a lighter shadow.
@fragment
fn caster_fragment(in: Caster) {
    if gradient_noise(in.clip.xy) >= in.alpha {
        discard;
    }
}

@vertex
fn depth_vertex(@builtin(instance_index) instance: u32, @location(0) p: vec4f) -> @builtin(position) vec4f {
    return view.view_proj * vec4f(world_position(instance, p), 1.0);
}

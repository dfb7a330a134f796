// Items, solid and translucent.

struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) @interpolate(flat) instance: u32,
    @location(3) paint: vec4f,     // premultiplied
}

// Paint over the colour of the item: roots of the colour's parts and opacity, a byte each. Mirrors `paint::Paint`.
fn unpacked(paint: u32) -> vec4f {
    let c = unpack4x8unorm(paint);
    return vec4f(c.rgb * c.rgb * c.a, c.a);
}

@vertex
fn surface_vertex(@builtin(instance_index) instance: u32, @location(0) p: vec4f, @location(1) n: vec3f,
                  @location(2) paint: u32) -> Vertex {
    let world = world_position(instance, p);
    return Vertex(view.view_proj * vec4f(world, 1.0), world, world_normal(instance, n), instance,
                  unpacked(paint));
}

fn surface_of(in: Vertex, front: bool) -> Surface {
    let item = instances[in.instance];
    let n = normalize(in.normal);
    let colour = item.colour.rgb * (1.0 - in.paint.a) + in.paint.rgb;
    return Surface(in.position, select(-n, n, front), colour, roughened(item.surface.x, n), item.surface.y,
                   item.surface.z, item.surface.w, item.depth.x);
}

@fragment
fn solid_fragment(in: Vertex) -> @location(0) vec4f {
    let depth = dot(in.position - view.eye.xyz, view.forward.xyz);
    let light = shade(surface_of(in, true), in.clip.xy, openness_at(in.clip.xy, depth), true);
    return vec4f(limited(fogged(light.diffuse + light.mirror, in.position)), 1.0);
}

// Premultiplied: what the pane mirrors stays, what it scatters fades, and its rim hides more than its middle. Faces
// turned away are faint, and on what is nearly clear shadows are not worth their price.
@fragment
fn translucent_fragment(in: Vertex, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let s = surface_of(in, front);
    let opacity = instances[in.instance].colour.a;
    let light = shade(s, in.clip.xy, 1.0, front && opacity > 0.3);
    let nv = saturate1(abs(dot(s.normal, normalize(view.eye.xyz - s.position))));
    let alpha = mix(opacity, 1.0, 0.7 * pow(1.0 - nv, 4.0));
    let colour = fogged(light.diffuse, in.position) * alpha + light.mirror * 0.4;
    return vec4f(limited(colour), alpha) * select(0.3, 1.0, front);
}

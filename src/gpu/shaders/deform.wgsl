// The deformation of one point: equation (18), then the draggers, then the collision passes. The twin of `elastic/deform.rs`.

fn deform(x: vec3<f32>, skin: SkinWeights) -> vec3<f32> {
    return collide(drag_flow(spring(x, skin), skin), skin);
}

fn spring(x: vec3<f32>, skin: SkinWeights) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    for (var k = 0u; k < 4u; k++) {
        let weight = skin.weights[k];
        if weight > 0.0 {
            let entry = HEADER + skin.segments[k] * SEGMENT;
            let moved = rotate(reals(entry), x) + reals(entry + 1u).xyz;
            let local = stage_flow(entry + 2u, moved, skin);
            sum += stage_flow(entry + 3u, local, skin) * weight;
        }
    }
    return sum;
}

// Carries x through a stage of mass-spring fields. A point that no field can reach is returned as it is.
fn stage_flow(stage: u32, x: vec3<f32>, skin: SkinWeights) -> vec3<f32> {
    let flow = Flow(SPRINGS, palette[stage].x, palette[stage].y, skin);
    for (var i = 0u; i < flow.count; i++) {
        if spring_reaches(flow.first + i * SPRING, x) {
            return path_line(x, palette[stage].z, flow);
        }
    }
    return x;
}

fn collide(start: vec3<f32>, skin: SkinWeights) -> vec3<f32> {
    var x = start;
    for (var pass_index = 0u; pass_index < palette[0].y; pass_index++) {
        x = pass_flow(palette[0].z + pass_index, x, skin);
    }
    return x;
}

// Carries x through a collision pass. A vertex that has no share in any of its segments stays.
fn pass_flow(at: u32, x: vec3<f32>, skin: SkinWeights) -> vec3<f32> {
    let flow = Flow(COLLISIONS, palette[at].x, palette[at].y, skin);
    for (var i = 0u; i < flow.count; i++) {
        if share_of(skin, palette[flow.first + i * COLLISION].y) > 0.0 {
            return path_line(x, palette[at].z, flow);
        }
    }
    return x;
}

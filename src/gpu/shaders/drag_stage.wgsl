// The stage of the draggers, after the blend. The twin of `elastic/drag_stage.rs`.

// The share of a vertex that the drag field at `field` moves. A vertex has no share in `NO_SEGMENT`.
fn drag_weight(field: u32, skin: SkinWeights) -> f32 {
    let held = palette[field + 2u];
    return weight_of(skin, held.x) + weight_of(skin, held.y) + weight_of(skin, held.z) + weight_of(skin, held.w);
}

// Carries x through the stage. A point that no field can reach is returned as it is.
fn drag_flow(x: vec3<f32>, skin: SkinWeights) -> vec3<f32> {
    let flow = Flow(DRAGS, palette[2].x, palette[2].y, skin);
    for (var i = 0u; i < flow.count; i++) {
        let field = flow.first + i * DRAG;
        if spring_reaches(field, x) && drag_weight(field, skin) > 0.0 {
            return path_line(x, palette[2].z, flow);
        }
    }
    return x;
}

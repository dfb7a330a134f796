// Velocities of the three kinds of fields, read from the palette. The twins of `field/spring.rs`, `field/sphere.rs`
// and `field/hugging.rs`.

fn spring_velocity(field: u32, x: vec3<f32>, t: f32) -> vec3<f32> {
    let p = reals(field);
    let a = reals(field + 1u).xyz - p.xyz;
    let b = x - (p.xyz + a * t);
    let weight = spring_weight(dot(b, b), p.w * p.w);
    return curl_of_weighted_rotation(weight.x, b * (2.0 * weight.y), a, b);
}

// True where a path line that starts at x may move at all.
fn spring_reaches(field: u32, x: vec3<f32>) -> bool {
    let p = reals(field);
    let v = x - closest_on_segment(p.xyz, reals(field + 1u).xyz, x);
    return dot(v, v) < p.w * p.w;
}

fn collision_velocity(field: u32, x: vec3<f32>, t: f32) -> vec3<f32> {
    if palette[field].x == FIELD_SPHERE {
        return sphere_velocity(field, x, t);
    }
    return hugging_velocity(field, x, t);
}

fn sphere_velocity(field: u32, x: vec3<f32>, t: f32) -> vec3<f32> {
    let d = reals(field + 1u);
    let centre = reals(field + 2u);
    let inner = centre.w;
    let outer = d.w;
    let b = x - (centre.xyz + d.xyz * t);
    let distance = length(b);
    let weight = collision_weight(distance - inner, outer - inner);
    var grad = vec3<f32>(0.0);
    if distance > 0.0 {
        grad = b * (weight.y / distance);
    }
    return curl_of_weighted_rotation(weight.x, grad, d.xyz, b);
}

fn hugging_velocity(field: u32, x: vec3<f32>, t: f32) -> vec3<f32> {
    let d = reals(field + 1u);
    let gauge = reals(field + 2u).xyz;
    let rotation = reals(field + 3u);
    let inverse = vec4<f32>(-rotation.xyz, rotation.w);
    let translation = reals(field + 4u);
    let shifted = x + d.xyz * (1.0 - t);
    let patch_ball = reals(field + 7u);
    let away_from_patch = shifted - patch_ball.xyz;
    let from_patch = length(away_from_patch);
    let beside = collision_weight(from_patch - patch_ball.w, translation.w);
    if beside.x <= 0.0 {
        return vec3<f32>(0.0);
    }
    let distance = part_distance(field, rotate(inverse, shifted - translation.xyz));
    if distance.value >= d.w {
        return vec3<f32>(0.0);
    }
    let weight = collision_weight(distance.value, d.w);
    var grad = rotate(rotation, distance.gradient) * (2.0 * beside.x * weight.y);
    if beside.y != 0.0 {
        grad += away_from_patch * (2.0 * weight.x * beside.y / from_patch);
    }
    let spread = reals(field + 8u);
    let b = x - gauge;
    let given_way = b * (1.0 - spread.w) + spread.xyz * (2.0 * spread.w * dot(spread.xyz, b));
    return curl_of_weighted_rotation(2.0 * beside.x * weight.x, grad, d.xyz, given_way);
}

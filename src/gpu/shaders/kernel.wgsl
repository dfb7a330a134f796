// Scalar weights: how a field fades out. The twin of `field/kernel.rs`.

// (phi, dphi/ds) of the spring field at the squared distance s.
fn spring_weight(s: f32, radius_squared: f32) -> vec2<f32> {
    let u = 1.0 - s / radius_squared;
    if u <= 0.0 {
        return vec2<f32>(0.0, 0.0);
    }
    let u3 = u * u * u;
    return vec2<f32>(0.5 * u3 * u, -2.0 * u3 / radius_squared);
}

// (phi, dphi/dr) of the collision fields at the distance r from the region of constant velocity.
fn collision_weight(r: f32, width: f32) -> vec2<f32> {
    let y = r / width;
    if y <= 0.0 {
        return vec2<f32>(0.5, 0.0);
    }
    if y >= 1.0 {
        return vec2<f32>(0.0, 0.0);
    }
    let y2 = y * y;
    let k = 1.0 - y2 * y * (4.0 - 3.0 * y);
    let dk = -12.0 * y2 * (1.0 - y) / width;
    return vec2<f32>(0.5 * k * k, k * dk);
}

// The one formula behind every field: the curl of A = phi (d x b). The twin of `field/curl.rs`.

fn curl_of_weighted_rotation(phi: f32, grad_phi: vec3<f32>, d: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return d * (2.0 * phi + dot(grad_phi, b)) - b * dot(grad_phi, d);
}

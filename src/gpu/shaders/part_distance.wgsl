// Exact distances to convex parts. The twin of `field/part_distance.rs`.

struct Distance {
    value: f32,
    gradient: vec3<f32>,
}

// Length and direction of a vector, both zero for the zero vector.
fn away(v: vec3<f32>) -> Distance {
    let size = length(v);
    if size > 0.0 {
        return Distance(size, v / size);
    }
    return Distance(0.0, vec3<f32>(0.0));
}

// Distance of x (in the part's frame) from the part of the collision field at `field`, and its gradient.
fn part_distance(field: u32, x: vec3<f32>) -> Distance {
    let shape = palette[field].z;
    let rounding = reals(field + 2u).w;
    let one = reals(field + 5u);
    let two = reals(field + 6u);
    var d: Distance;
    switch shape {
        case SHAPE_SEGMENT: { d = away(x - closest_on_segment(one.xyz, two.xyz, x)); }
        case SHAPE_CUBOID: { d = away(x - clamp(x, -one.xyz, one.xyz)); }
        case SHAPE_CYLINDER: { d = away(outside_cylinder(x, one.x, one.y)); }
        case SHAPE_CONE: { d = away(outside_cone(x, one.x, one.y)); }
        case SHAPE_HALF_SPACE: {
            let height = dot(one.xyz, x);
            d = Distance(max(height, 0.0), select(vec3<f32>(0.0), one.xyz, height > 0.0));
        }
        case SHAPE_HULL: { d = away(outside_hull(x, palette[field + 5u].x, palette[field + 5u].y, one.z)); }
        default: { d = away(x); }
    }
    if d.value > rounding {
        return Distance(d.value - rounding, d.gradient);
    }
    return Distance(0.0, vec3<f32>(0.0));
}

fn closest_on_segment(a: vec3<f32>, b: vec3<f32>, x: vec3<f32>) -> vec3<f32> {
    let ab = b - a;
    let length_squared = dot(ab, ab);
    if length_squared <= 0.0 {
        return a;
    }
    return a + ab * clamp(dot(x - a, ab) / length_squared, 0.0, 1.0);
}

fn outside_cylinder(x: vec3<f32>, half_height: f32, radius: f32) -> vec3<f32> {
    let around = x.xz;
    let rho = length(around);
    var side = vec2<f32>(0.0);
    if rho > radius {
        side = around * (1.0 - radius / rho);
    }
    return vec3<f32>(side.x, x.y - clamp(x.y, -half_height, half_height), side.y);
}

fn outside_cone(x: vec3<f32>, half_height: f32, radius: f32) -> vec3<f32> {
    let around = x.xz;
    let rho = length(around);
    let above = dot(vec2<f32>(2.0 * half_height, radius), vec2<f32>(rho, x.y - half_height)) > 0.0;
    if !above && x.y >= -half_height {
        return vec3<f32>(0.0);
    }
    let on_base = vec2<f32>(min(rho, radius), -half_height);
    let rim = vec2<f32>(radius, -half_height);
    let to_apex = vec2<f32>(-radius, 2.0 * half_height);
    let point = vec2<f32>(rho, x.y);
    let along = clamp(dot(point - rim, to_apex) / dot(to_apex, to_apex), 0.0, 1.0);
    let on_side = rim + to_apex * along;
    let to_side = point - on_side;
    let to_base = point - on_base;
    let nearest = select(on_base, on_side, dot(to_side, to_side) < dot(to_base, to_base));
    var radial = vec2<f32>(0.0);
    if rho > 0.0 {
        radial = around * ((rho - nearest.x) / rho);
    }
    return vec3<f32>(radial.x, x.y - nearest.y, radial.y);
}

// The nearest of all triangles that face x; `first` is where the hull's triangles begin, `count` how many there are.
// What is not above any plane by more than rounding counts as inside.
fn outside_hull(x: vec3<f32>, first: u32, count: u32, rounding_error: f32) -> vec3<f32> {
    var best = vec3<f32>(0.0);
    var best_squared = 3.4e38;
    var highest = 0.0;
    for (var i = 0u; i < count; i++) {
        let at = first + i * TRIANGLE;
        let plane = reals(at);
        let height = dot(plane.xyz, x) - plane.w;
        highest = max(highest, height);
        if height <= 0.0 || height * height >= best_squared {
            continue;
        }
        let v = x - closest_on_triangle(reals(at + 1u).xyz, reals(at + 2u).xyz, reals(at + 3u).xyz, x);
        let squared = dot(v, v);
        if squared < best_squared {
            best = v;
            best_squared = squared;
        }
    }
    return select(vec3<f32>(0.0), best, highest > rounding_error);
}

// By the Voronoi regions of corners and edges (Ericson, Real-Time Collision Detection, section 5.1.5).
fn closest_on_triangle(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, x: vec3<f32>) -> vec3<f32> {
    let ab = b - a;
    let ac = c - a;
    let ax = x - a;
    let d1 = dot(ab, ax);
    let d2 = dot(ac, ax);
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bx = x - b;
    let d3 = dot(ab, bx);
    let d4 = dot(ac, bx);
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cx = x - c;
    let d5 = dot(ab, cx);
    let d6 = dot(ac, cx);
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let denominator = 1.0 / (va + vb + vc);
    return a + ab * (vb * denominator) + ac * (vc * denominator);
}

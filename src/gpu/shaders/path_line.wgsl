// Path lines. The twin of `field/path_line.rs`; a flow stands in for the closure there.

// A sum of fields: `count` of them from `first` on, of the mass-spring sets, the draggers or one collision pass.
const SPRINGS = 0u;
const DRAGS = 1u;
const COLLISIONS = 2u;

struct Flow {
    kind: u32,
    first: u32,
    count: u32,
    skin: SkinWeights,
}

fn velocity(flow: Flow, x: vec3<f32>, t: f32) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < flow.count; i++) {
        if flow.kind == SPRINGS {
            sum += spring_velocity(flow.first + i * SPRING, x, t);
        } else if flow.kind == DRAGS {
            let field = flow.first + i * DRAG;
            sum += spring_velocity(field, x, t) * drag_weight(field, flow.skin);
        } else {
            let field = flow.first + i * COLLISION;
            let weight = share_of(flow.skin, palette[field].y);
            if weight > 0.0 {
                sum += collision_velocity(field, x, t) * weight;
            }
        }
    }
    return sum;
}

fn path_line(start: vec3<f32>, steps: u32, flow: Flow) -> vec3<f32> {
    let integrator = palette[0].x;
    let h = 1.0 / f32(steps);
    var x = start;
    for (var i = 0u; i < steps; i++) {
        let t = f32(i) * h;
        let k1 = velocity(flow, x, t);
        if integrator == EULER {
            x += h * k1;
            continue;
        }
        let k2 = velocity(flow, x + k1 * (0.5 * h), t + 0.5 * h);
        if integrator == MIDPOINT {
            x += h * k2;
            continue;
        }
        let k3 = velocity(flow, x + k2 * (0.5 * h), t + 0.5 * h);
        let k4 = velocity(flow, x + k3 * h, t + h);
        x += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
    }
    return x;
}

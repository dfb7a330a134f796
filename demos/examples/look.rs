//! Renders a test scene around a mesh to a PNG: `look mesh.obj out.png [width height]`.

use anyhow::{Context, Result};
use glam::{Mat4, Quat, Vec3};
use pliant_demos::render::{Camera, Frame, Gpu, Item, Material, MeshData, Picture, Region, Renderer, picture, shapes};

fn read_obj(path: &str) -> Result<MeshData> {
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {path}"))?;
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let v: Vec<f32> = words.take(3).map(str::parse).collect::<Result<_, _>>()?;
                positions.push(Vec3::from_slice(&v));
            }
            Some("f") => {
                let corners: Vec<u32> = words
                    .map(|w| w.split('/').next().unwrap_or("").parse::<u32>().map(|i| i - 1))
                    .collect::<Result<_, _>>()?;
                for i in 1..corners.len() - 1 {
                    indices.extend([corners[0], corners[i], corners[i + 1]]);
                }
            }
            _ => {}
        }
    }
    let low = positions.iter().copied().fold(Vec3::INFINITY, Vec3::min);
    let high = positions.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
    let scale = 2.0 / (high - low).max_element();
    let base = Vec3::new(0.5 * (low.x + high.x), low.y, 0.5 * (low.z + high.z));
    for p in &mut positions {
        *p = (*p - base) * scale;
    }
    Ok(MeshData::with_smooth_normals(positions, indices))
}

#[allow(clippy::print_stdout)]
fn main() -> Result<()> {
    let args: Vec<String> = std::env::args().collect();
    let number = |i: usize, other: u32| args.get(i).and_then(|a| a.parse().ok()).unwrap_or(other);
    let size = [number(3, 960), number(4, 540)];
    let gpu = Gpu::headless()?;
    let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, size);
    let animal = renderer.add_mesh(&read_obj(&args[1])?);
    let ball = renderer.add_mesh(&shapes::ball(0.35));
    let wall = renderer.add_mesh(&shapes::cuboid(Vec3::new(1.6, 0.12, 0.12), 0.03));
    let pane = renderer.add_mesh(&shapes::cuboid(Vec3::new(1.6, 1.6, 0.04), 0.01));
    let bar = renderer.add_mesh(&shapes::capsule(1.5, 0.08));
    let cylinder = renderer.add_mesh(&shapes::cylinder(0.3, 0.4, 0.03));
    let at = |x, y, z| Mat4::from_translation(Vec3::new(x, y, z));
    let lying = Mat4::from_quat(Quat::from_rotation_z(std::f32::consts::FRAC_PI_2));
    let mut frame = Frame {
        camera: Camera { fov: 0.55, ..Camera::looking(Vec3::new(3.4, 2.6, 9.0), Vec3::new(0.1, 1.25, 0.0)) },
        region: Region { centre: Vec3::new(0.0, 1.5, 0.0), radius: 6.0 },
        ..Frame::default()
    };
    let turn = Mat4::from_rotation_y(2.6);
    if std::env::var_os("TOWER").is_some() {
        frame.camera = Camera { fov: 0.6, ..Camera::looking(Vec3::new(9.0, 9.0, 15.0), Vec3::new(0.0, 4.2, 0.0)) };
        frame.region = Region { centre: Vec3::new(0.0, 4.5, 0.0), radius: 8.0 };
        let big = renderer.add_mesh(&shapes::cuboid(Vec3::new(1.8, 4.0, 0.08), 0.02));
        for (i, y) in [1.2f32, 2.9, 4.6, 6.3].into_iter().enumerate() {
            for k in 0..3 {
                let x = k as f32 - 1.0 + 0.5 * (i % 2) as f32;
                let r = Mat4::from_rotation_x(std::f32::consts::FRAC_PI_2);
                frame.items.push(Item::new(bar, at(x, y, 0.0) * r, Material::steel()));
            }
            let t = Mat4::from_rotation_y(i as f32 * 1.3) * Mat4::from_rotation_x(i as f32 * 0.7);
            frame.items.push(Item::new(animal, at(0.3 * (i as f32 - 1.5), y + 0.5, 0.2) * t, Material::skin()));
        }
        for k in 0..4 {
            let r = Mat4::from_rotation_y(k as f32 * std::f32::consts::FRAC_PI_2);
            let m = if k == 0 || k == 1 { Material::glass() } else { Material::slate() };
            frame.items.push(Item::new(big, r * at(0.0, 4.0, 1.75), m));
        }
        frame.items.push(Item::new(ball, at(3.0, 0.35, 2.0), Material::glossy(Vec3::new(0.55, 0.07, 0.05))));
        frame.items.push(Item::new(cylinder, at(-3.4, 0.3, 1.6), Material::slate()));
    } else {
        frame.items = vec![
            Item::new(animal, at(-0.6, 0.0, 0.6) * turn, Material::skin()),
            Item::new(animal, at(-0.4, 1.55, -1.6) * turn * Mat4::from_rotation_x(-0.5), Material::skin()),
            Item::new(ball, at(1.1, 0.35, 1.4), Material::glossy(Vec3::new(0.55, 0.07, 0.05))),
            Item::new(ball, at(2.1, 0.35, 0.9), Material::steel()),
            Item::new(cylinder, at(-2.3, 0.3, 1.3), Material::slate()),
            Item::new(bar, at(-0.4, 1.2, -1.2) * lying, Material::steel()),
            Item::new(bar, at(-0.4, 1.2, -2.2) * lying, Material::steel()),
            Item::new(wall, at(-0.4, 0.12, -2.6), Material::slate()),
            Item::new(wall, at(-0.4, 0.12, -0.8), Material::slate()),
            Item::new(pane, at(-0.4, 1.6, -0.6), Material::glass()),
            Item::new(pane, at(-0.4, 1.6, -2.8), Material::slate()),
            Item::new(
                pane,
                at(1.3, 1.6, -1.7)
                    * Mat4::from_rotation_y(std::f32::consts::FRAC_PI_2)
                    * Mat4::from_scale(Vec3::new(0.7, 1.0, 1.0)),
                Material::glass(),
            ),
        ];
    }
    if std::env::var_os("OVERLAY").is_some() {
        frame.items[0].wire = Some([0.02, 0.02, 0.03, 0.6]);
        let o = &mut frame.overlay;
        o.sphere(at(-0.6, 1.2, 0.6), 0.5, [0.05, 0.3, 0.9, 1.0]);
        o.cuboid(at(1.1, 0.35, 1.4), Vec3::splat(0.4), [0.9, 0.3, 0.05, 1.0]);
        o.capsule(Vec3::new(-2.3, 0.9, 1.3), Vec3::new(-2.3, 1.6, 1.3), 0.2, [0.0, 0.5, 0.2, 1.0]);
        for i in 0..12 {
            let a = i as f32 * std::f32::consts::FRAC_PI_6;
            let p = Vec3::new(-0.6 + 0.7 * a.cos(), 1.0 + 0.5 * a.sin(), 0.6);
            o.spring(p, p + Vec3::new(0.1, 0.15, 0.1), 0.04, [0.9, 0.05, 0.3, 1.0]);
        }
    }
    let picture = Picture::new(&gpu.device, size);
    let mut image = picture.take(&mut renderer, &frame)?;
    let start = std::time::Instant::now();
    for _ in 0..5 {
        image = picture.take(&mut renderer, &frame)?;
    }
    println!("{}: {:.1} ms a frame", gpu.name, start.elapsed().as_secs_f64() * 200.0);
    if std::env::var_os("FINE").is_some() {
        image = picture::still(&mut renderer, &frame, size, 2)?;
    }
    image.save(&args[2])?;
    Ok(())
}

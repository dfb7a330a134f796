//! Pictures of a ball over the ground, looked at pixel by pixel.

use glam::{Mat4, Vec3};
use image::RgbaImage;

use super::device::tests::device_or_skip;
use super::{Camera, Frame, Item, Material, Paint, Picture, Region, Renderer, picture, shapes};

const SIZE: [u32; 2] = [240, 160];

fn frame_with_ball(renderer: &mut Renderer) -> Frame {
    let ball = renderer.add_mesh(&shapes::ball(0.5));
    Frame {
        camera: Camera::looking(Vec3::new(0.0, 2.0, 6.0), Vec3::new(0.0, 0.6, 0.0)),
        region: Region { centre: Vec3::ZERO, radius: 4.0 },
        items: vec![Item::new(
            ball,
            Mat4::from_translation(Vec3::new(0.0, 1.0, 0.0)),
            Material::plain(Vec3::new(0.6, 0.1, 0.1)),
        )],
        ..Frame::default()
    }
}

fn pixel_of(frame: &Frame, p: Vec3) -> (u32, u32) {
    let clip = frame.camera.view_projection(SIZE[0] as f32 / SIZE[1] as f32) * p.extend(1.0);
    let ndc = clip.truncate() / clip.w;
    (((ndc.x + 1.0) * 0.5 * SIZE[0] as f32) as u32, ((1.0 - ndc.y) * 0.5 * SIZE[1] as f32) as u32)
}

/// Mean brightness around a point of the scene.
fn brightness(image: &RgbaImage, frame: &Frame, p: Vec3) -> f32 {
    let (x, y) = pixel_of(frame, p);
    let around = (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| (x, y)));
    around.map(|(x, y)| image.get_pixel(x, y).0[..3].iter().map(|c| f32::from(*c)).sum::<f32>() / 3.0).sum::<f32>()
        / 9.0
}

#[test]
fn a_ball_over_the_ground() {
    let Some(gpu) = device_or_skip("a_ball_over_the_ground") else { return };
    let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, SIZE);
    let target = Picture::new(&gpu.device, SIZE);
    let frame = frame_with_ball(&mut renderer);
    let image = target.take(&mut renderer, &frame).unwrap();

    let ball = image.get_pixel(SIZE[0] / 2, pixel_of(&frame, Vec3::Y).1);
    assert!(i32::from(ball[0]) > i32::from(ball[2]) + 30, "the ball is red: {ball:?}");
    let sky = image.get_pixel(4, 4);
    assert!(sky.0[..3].iter().all(|c| *c > 150), "the background is light: {sky:?}");

    assert!(image.pixels().all(|p| p[3] == 255 && p.0[..3].iter().any(|c| *c > 8)), "no pixel is black");

    let towards = frame.sun.direction;
    let shadow = Vec3::Y - towards / towards.y;
    let (dark, light) = (brightness(&image, &frame, shadow), brightness(&image, &frame, shadow + Vec3::X * 2.0));
    assert!(dark < light - 15.0, "shadow {dark}, ground {light}");
    assert!(dark > 20.0, "the sky lights the shadow: {dark}");

    let again = target.take(&mut renderer, &frame).unwrap();
    assert!(image == again, "equal frames give equal bytes");

    let fine = picture::still(&mut renderer, &frame, SIZE, 2).unwrap();
    let differences = image.as_raw().iter().zip(fine.as_raw()).map(|(a, b)| u64::from(a.abs_diff(*b)));
    assert!(differences.sum::<u64>() < 2 * image.as_raw().len() as u64, "a finer picture shows the same");
    assert_eq!(renderer.size(), SIZE);
}

#[test]
fn written_and_shared_meshes_look_like_still_ones() {
    let Some(gpu) = device_or_skip("written_and_shared_meshes_look_like_still_ones") else { return };
    let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, SIZE);
    let target = Picture::new(&gpu.device, SIZE);
    let mut frame = frame_with_ball(&mut renderer);
    let still = target.take(&mut renderer, &frame).unwrap();

    let data = shapes::ball(0.5);
    let buffer = || {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: data.positions.len() as u64 * 16,
            usage: super::mesh::VERTEX_USAGE,
            mapped_at_creation: false,
        })
    };
    let shared = renderer.add_shared_mesh(buffer(), buffer(), &data.indices);
    frame.items[0].mesh = shared;
    let missing = target.take(&mut renderer, &frame).unwrap();
    assert!(missing != still, "empty buffers draw nothing");
    let positions: Vec<_> = data.positions.iter().map(|p| p.extend(1.0)).collect();
    let normals: Vec<_> = data.normals.iter().map(|n| n.extend(0.0)).collect();
    renderer.write_mesh(shared, &positions, &normals);
    assert!(target.take(&mut renderer, &frame).unwrap() == still);
}

#[test]
fn resized_pictures_and_overlays() {
    let Some(gpu) = device_or_skip("resized_pictures_and_overlays") else { return };
    let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, [64, 64]);
    renderer.resize(SIZE);
    let target = Picture::new(&gpu.device, SIZE);
    let mut frame = frame_with_ball(&mut renderer);
    let plain = target.take(&mut renderer, &frame).unwrap();
    frame.overlay.spring(Vec3::new(1.5, 1.0, 0.0), Vec3::new(2.0, 1.5, 0.0), 0.1, [0.0, 0.1, 0.9, 1.0]);
    let overlaid = target.take(&mut renderer, &frame).unwrap();
    let at = pixel_of(&frame, Vec3::new(2.0, 1.5, 0.0));
    assert_ne!(plain.get_pixel(at.0, at.1), overlaid.get_pixel(at.0, at.1));
    frame.overlay = Default::default();
    frame.items[0].wire = Some([0.0, 0.0, 0.0, 1.0]);
    let wired = target.take(&mut renderer, &frame).unwrap();
    let changed = plain.pixels().zip(wired.pixels()).filter(|(a, b)| a != b).count();
    assert!(changed > 50 && changed < 6000, "{changed} pixels belong to edges");
}

#[test]
fn paint_covers_the_material_as_far_as_it_is_opaque() {
    let Some(gpu) = device_or_skip("paint_covers_the_material_as_far_as_it_is_opaque") else { return };
    let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, SIZE);
    let target = Picture::new(&gpu.device, SIZE);
    let mut frame = frame_with_ball(&mut renderer);
    let plain = target.take(&mut renderer, &frame).unwrap();
    let at = pixel_of(&frame, Vec3::Y);
    let data = shapes::ball(0.5);
    let mut painted = |paint: Paint| {
        let paint = vec![paint; data.positions.len()];
        renderer.write_painted_mesh(frame.items[0].mesh, &data.positions, &data.normals, &paint);
        target.take(&mut renderer, &frame).unwrap()
    };
    let blue = Vec3::new(0.02, 0.05, 0.7);
    assert!(painted(Paint::new(blue, 0.0)) == plain, "clear paint is none");
    let [half, full] = [0.5, 1.0].map(|opacity| painted(Paint::new(blue, opacity)).get_pixel(at.0, at.1).0);
    let before = plain.get_pixel(at.0, at.1).0;
    assert!(before[0] > before[2] && full[2] > full[0], "red, then blue: {before:?} {full:?}");
    assert!(half[2] > before[2] && half[2] < full[2] && half[0] < before[0] && half[0] > full[0], "{half:?}");
    // The same as a ball that is blue by itself.
    frame.items[0].material = Material::plain(blue);
    let itself = target.take(&mut renderer, &frame).unwrap();
    let itself = itself.get_pixel(at.0, at.1).0;
    assert!(full.iter().zip(itself).all(|(a, b)| a.abs_diff(b) <= 2), "{full:?} {itself:?}");
}

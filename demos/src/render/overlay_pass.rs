//! Draws an [`Overlay`](super::Overlay): what is before a surface in full, what is behind it faintly.

use bytemuck::{Pod, Zeroable};

use super::overlay::{Ball, Line, Overlay};
use super::pipeline::Recipe;
use super::shaders;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct RawLine {
    from: [f32; 3],
    width: f32,
    to: [f32; 4],
    colour: [f32; 4],
}

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct RawBall {
    centre: [f32; 3],
    radius: f32,
    colour: [f32; 4],
}

impl From<&Line> for RawLine {
    fn from(line: &Line) -> Self {
        Self { from: line.from.to_array(), width: line.width, to: line.to.extend(1.0).to_array(), colour: line.colour }
    }
}

impl From<&Ball> for RawBall {
    fn from(ball: &Ball) -> Self {
        Self { centre: ball.centre.to_array(), radius: ball.radius, colour: ball.colour }
    }
}

const LINE: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<RawLine>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x4, 2 => Float32x4],
};

const BALL: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<RawBall>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x4],
};

/// One kind of shape: hidden parts, visible parts, and the instances to draw.
struct Kind {
    hidden: wgpu::RenderPipeline,
    visible: wgpu::RenderPipeline,
    buffer: wgpu::Buffer,
    count: u32,
}

impl Kind {
    fn new(device: &wgpu::Device, hidden: &Recipe<'_>, visible: &Recipe<'_>) -> Self {
        let buffer = instance_buffer(device, 4096);
        Self { hidden: hidden.build(device), visible: visible.build(device), buffer, count: 0 }
    }

    fn upload<T: Pod>(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, instances: &[T]) {
        let bytes: &[u8] = bytemuck::cast_slice(instances);
        self.count = instances.len() as u32;
        if bytes.len() as u64 > self.buffer.size() {
            self.buffer = instance_buffer(device, (bytes.len() as u64).next_power_of_two());
        }
        if !bytes.is_empty() {
            queue.write_buffer(&self.buffer, 0, bytes);
        }
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, hidden: bool) {
        if self.count > 0 {
            pass.set_vertex_buffer(0, self.buffer.slice(..));
            pass.set_pipeline(if hidden { &self.hidden } else { &self.visible });
            pass.draw(0..4, 0..self.count);
        }
    }
}

fn instance_buffer(device: &wgpu::Device, size: u64) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("overlay"),
        size,
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

pub struct OverlayPass {
    lines: Kind,
    balls: Kind,
    show_hidden: bool,
}

impl OverlayPass {
    pub fn new(device: &wgpu::Device, frame_layout: &wgpu::BindGroupLayout) -> Self {
        let module = shaders::module(device, "overlay", shaders::OVERLAY);
        let groups = [frame_layout];
        let recipe = |vertex, buffers, fragment, compare| Recipe {
            vertex,
            buffers,
            fragment: Some(fragment),
            blend: true,
            depth: Some((compare, false)),
            strip: true,
            ..Recipe::scene(fragment, &module, &groups)
        };
        let (before, behind) = (wgpu::CompareFunction::GreaterEqual, wgpu::CompareFunction::Less);
        let lines = Kind::new(
            device,
            &recipe("line_vertex", &[LINE][..], "hidden_line_fragment", behind),
            &recipe("line_vertex", &[LINE][..], "line_fragment", before),
        );
        let balls = Kind::new(
            device,
            &recipe("ball_vertex", &[BALL][..], "hidden_ball_fragment", behind),
            &recipe("ball_vertex", &[BALL][..], "ball_fragment", before),
        );
        Self { lines, balls, show_hidden: false }
    }

    pub fn upload(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, overlay: &Overlay) {
        let lines: Vec<RawLine> = overlay.lines.iter().map(Into::into).collect();
        let balls: Vec<RawBall> = overlay.balls.iter().map(Into::into).collect();
        self.lines.upload(device, queue, &lines);
        self.balls.upload(device, queue, &balls);
        self.show_hidden = overlay.hidden > 0.0;
    }

    /// Group 0 is set.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        for hidden in [true, false] {
            if self.show_hidden || !hidden {
                self.lines.draw(pass, hidden);
                self.balls.draw(pass, hidden);
            }
        }
    }
}

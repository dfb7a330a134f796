//! The passes of a picture in their order.

use glam::{Vec3, Vec4};

use super::frame::Frame;
use super::list::DrawList;
use super::mesh::{MeshData, MeshId, Meshes};
use super::occlusion::Occlusion;
use super::overlay_pass::OverlayPass;
use super::paint::Paint;
use super::pipeline;
use super::shaders;
use super::shadow::ShadowMap;
use super::surface::Surfaces;
use super::targets::Targets;
use super::tone::Tone;
use super::uniforms::{Instance, View};
use super::wire::Wires;

/// Draws frames, and keeps the meshes that they show.
pub struct Renderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    format: wgpu::TextureFormat,
    targets: Targets,
    meshes: Meshes,
    frame_layout: wgpu::BindGroupLayout,
    view: wgpu::Buffer,
    instances: wgpu::Buffer,
    frame_group: wgpu::BindGroup,
    shadow: ShadowMap,
    occlusion: Occlusion,
    surfaces: Surfaces,
    wires: Wires,
    overlay: OverlayPass,
    tone: Tone,
}

impl Renderer {
    /// A renderer for targets of a format and a size in pixels.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, format: wgpu::TextureFormat, size: [u32; 2]) -> Self {
        let targets = Targets::new(device, size);
        let meshes = Meshes::new(device);
        let frame_layout = pipeline::layout(
            device,
            "frame",
            &[pipeline::uniform(), pipeline::storage(wgpu::ShaderStages::VERTEX_FRAGMENT)],
        );
        let view = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("view"),
            size: size_of::<View>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let instances = instance_buffer(device, 64);
        let frame_group = frame_group(device, &frame_layout, &view, &instances);
        let caster = shaders::module(device, "caster", shaders::CASTER);
        let ground = shaders::module(device, "ground", shaders::GROUND);
        let shadow = ShadowMap::new(device, &caster, &frame_layout);
        Self {
            occlusion: Occlusion::new(device, &caster, &ground, &frame_layout, &targets),
            surfaces: Surfaces::new(device, &ground, &frame_layout, &shadow, &targets),
            wires: Wires::new(device, &frame_layout, &meshes),
            overlay: OverlayPass::new(device, &frame_layout),
            tone: Tone::new(device, &frame_layout, &targets, format),
            device: device.clone(),
            queue: queue.clone(),
            format,
            targets,
            meshes,
            frame_layout,
            view,
            instances,
            frame_group,
            shadow,
        }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.targets.size
    }

    /// Format of the targets.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.format
    }

    /// The device that meshes live on.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The queue that pictures are drawn on.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// Changes the size of the pictures.
    pub fn resize(&mut self, size: [u32; 2]) {
        if size != self.targets.size {
            self.targets = Targets::new(&self.device, size);
            self.occlusion.resize(&self.device, &self.targets);
            self.surfaces.resize(&self.device, &self.shadow, &self.targets);
            self.tone.resize(&self.device, &self.targets);
        }
    }

    /// Copies a mesh to the device.
    pub fn add_mesh(&mut self, data: &MeshData) -> MeshId {
        self.meshes.add(&self.device, data)
    }

    /// Draws from buffers that somebody else fills: four floats a vertex, usable as vertices and as storage.
    pub fn add_shared_mesh(&mut self, positions: wgpu::Buffer, normals: wgpu::Buffer, indices: &[u32]) -> MeshId {
        self.meshes.add_shared(&self.device, positions, normals, indices)
    }

    /// Moves the vertices of a mesh.
    pub fn write_mesh(&self, id: MeshId, positions: &[Vec4], normals: &[Vec4]) {
        self.meshes.write(&self.queue, id, positions, normals);
    }

    /// Moves the vertices of a mesh and paints them.
    pub fn write_painted_mesh(&self, id: MeshId, positions: &[Vec3], normals: &[Vec3], paint: &[Paint]) {
        self.meshes.write_painted(&self.queue, id, positions, normals, paint);
    }

    /// Brings the triangles of a mesh into another order: translucent ones are drawn in it.
    pub fn write_indices(&self, id: MeshId, indices: &[u32]) {
        self.meshes.write_indices(&self.queue, id, indices);
    }

    /// Forgets a mesh.
    pub fn remove_mesh(&mut self, id: MeshId) {
        self.meshes.remove(id);
    }

    /// Forgets all meshes.
    pub fn clear_meshes(&mut self) {
        self.meshes.clear();
    }

    /// Draws a frame into a target of the renderer's format and size.
    pub fn draw(&mut self, frame: &Frame, target: &wgpu::TextureView) {
        let list = DrawList::new(frame, &self.meshes);
        self.upload(frame, &list);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let ground = frame.ground.is_some();
        self.shadow.draw(&mut encoder, &self.frame_group, &list, &self.meshes);
        self.occlusion.draw(&mut encoder, &self.targets, &self.frame_group, (&list, &self.meshes, ground));
        self.draw_scene(&mut encoder, &list, ground);
        self.tone.draw(&mut encoder, &self.frame_group, target);
        self.queue.submit([encoder.finish()]);
    }

    fn upload(&mut self, frame: &Frame, list: &DrawList) {
        if list.instances.len() as u64 * size_of::<Instance>() as u64 > self.instances.size() {
            self.instances = instance_buffer(&self.device, list.instances.len().next_power_of_two());
            self.frame_group = frame_group(&self.device, &self.frame_layout, &self.view, &self.instances);
        }
        self.queue.write_buffer(&self.instances, 0, bytemuck::cast_slice(&list.instances));
        let view = View::new(frame, self.targets.size, self.targets.half);
        self.queue.write_buffer(&self.view, 0, bytemuck::bytes_of(&view));
        self.overlay.upload(&self.device, &self.queue, &frame.overlay);
    }

    fn draw_scene(&self, encoder: &mut wgpu::CommandEncoder, list: &DrawList, ground: bool) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.targets.samples,
                depth_slice: None,
                resolve_target: Some(&self.targets.light),
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Discard },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.targets.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, &self.frame_group, &[]);
        self.surfaces.draw_solid(&mut pass, list, &self.meshes, ground);
        self.surfaces.draw_translucent(&mut pass, list, &self.meshes);
        self.wires.draw(&mut pass, list, &self.meshes);
        self.overlay.draw(&mut pass);
    }
}

fn instance_buffer(device: &wgpu::Device, count: usize) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("instances"),
        size: (count * size_of::<Instance>()) as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn frame_group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    view: &wgpu::Buffer,
    instances: &wgpu::Buffer,
) -> wgpu::BindGroup {
    pipeline::group(device, layout, &[view.as_entire_binding(), instances.as_entire_binding()])
}

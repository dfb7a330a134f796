//! A device of whatever kind there is, and the read-back that only tests need.

use std::sync::OnceLock;

use pliant::gpu::DeformPipeline;

/// A device, its queue and the pipeline, which a software driver takes seconds to compile.
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub pipeline: DeformPipeline,
}

impl Gpu {
    /// Any device, or none: then the test says so and passes, unless `PLIANT_REQUIRE_GPU` is 1.
    pub fn open() -> Option<&'static Self> {
        static SHARED: OnceLock<Result<Gpu, String>> = OnceLock::new();
        match SHARED.get_or_init(|| pollster::block_on(Self::request())) {
            Ok(gpu) => Some(gpu),
            Err(reason) => {
                let required = std::env::var("PLIANT_REQUIRE_GPU").is_ok_and(|value| value == "1");
                assert!(!required, "PLIANT_REQUIRE_GPU=1, but {reason}");
                eprintln!("skipped: {reason}");
                None
            }
        }
    }

    async fn request() -> Result<Self, String> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let options = wgpu::RequestAdapterOptions::default();
        let adapter = instance.request_adapter(&options).await.map_err(|e| format!("no adapter: {e}"))?;
        let descriptor =
            wgpu::DeviceDescriptor { required_limits: wgpu::Limits::downlevel_defaults(), ..Default::default() };
        let (device, queue) = adapter.request_device(&descriptor).await.map_err(|e| format!("no device: {e}"))?;
        let pipeline = DeformPipeline::new(&device);
        Ok(Self { device, queue, pipeline })
    }

    /// A new command encoder.
    pub fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    /// The contents of a buffer of `vec4<f32>`.
    pub fn read(&self, buffer: &wgpu::Buffer) -> Vec<[f32; 4]> {
        let copy = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: buffer.size(),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.encoder();
        encoder.copy_buffer_to_buffer(buffer, 0, &copy, 0, buffer.size());
        self.queue.submit([encoder.finish()]);
        copy.map_async(wgpu::MapMode::Read, .., |result| result.expect("the copy can be mapped"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device finishes");
        let view = copy.get_mapped_range(..).expect("mapped");
        bytemuck::cast_slice(&view).to_vec()
    }
}

//! A target without a window, whose pixels come back to memory.

use super::device::GpuError;
use super::{Frame, Renderer};

/// Of pictures that are read back.
pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// A texture to draw into and to read from.
pub struct Picture {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
}

impl Picture {
    /// A picture of a size in pixels, for a renderer of [`FORMAT`].
    pub fn new(device: &wgpu::Device, size: [u32; 2]) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&Default::default());
        Self { texture, view }
    }

    /// Where a renderer draws.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// Waits for what has been drawn and copies it to memory.
    pub fn read_pixels(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<image::RgbaImage, GpuError> {
        let (width, height) = (self.texture.width(), self.texture.height());
        let row = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("pixels"),
            size: u64::from(row) * u64::from(height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
            },
            self.texture.size(),
        );
        queue.submit([encoder.finish()]);
        let refused = |why: &dyn std::fmt::Display| GpuError::Refused(why.to_string());
        let (done, mapped) = std::sync::mpsc::channel();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver is gone only if waiting failed, which is told below.
            let _ = done.send(result);
        });
        device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| refused(&e))?;
        mapped.recv().map_err(|e| refused(&e))?.map_err(|e| refused(&e))?;
        let bytes = buffer.get_mapped_range(..).map_err(|e| refused(&e))?;
        let pixels = bytes.chunks_exact(row as usize).flat_map(|row| &row[..width as usize * 4]).copied().collect();
        Ok(image::RgbaImage::from_raw(width, height, pixels).expect("four bytes for each pixel"))
    }

    /// Draws a frame and reads it.
    pub fn take(&self, renderer: &mut Renderer, frame: &Frame) -> Result<image::RgbaImage, GpuError> {
        renderer.draw(frame, &self.view);
        self.read_pixels(renderer.device(), renderer.queue())
    }
}

/// A picture of a size in pixels whose every pixel is the mean of `fine` x `fine`: for stills that are looked at long.
/// The renderer keeps its size.
pub fn still(renderer: &mut Renderer, frame: &Frame, size: [u32; 2], fine: u32) -> Result<image::RgbaImage, GpuError> {
    let fine = fine.max(1);
    let before = renderer.size();
    let large = size.map(|side| side * fine);
    renderer.resize(large);
    let taken = Picture::new(renderer.device(), large).take(renderer, frame);
    renderer.resize(before);
    let taken = taken?;
    let count = fine * fine;
    Ok(image::RgbaImage::from_fn(size[0], size[1], |x, y| {
        let mut sum = [count / 2; 4];
        for i in 0..count {
            let pixel = taken.get_pixel(x * fine + i % fine, y * fine + i / fine);
            for (sum, channel) in sum.iter_mut().zip(pixel.0) {
                *sum += u32::from(channel);
            }
        }
        image::Rgba(sum.map(|sum| (sum / count) as u8))
    }))
}

//! The images that a picture passes through, made anew when its size changes.

/// Of linear light, before tone mapping.
pub const LIGHT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Of all depth images.
pub const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Of ambient openness and the depth that it belongs to.
pub const OPENNESS: wgpu::TextureFormat = wgpu::TextureFormat::Rg16Float;
/// Samples a pixel in the main pass.
pub const SAMPLES: u32 = 4;

/// Images of one size.
pub struct Targets {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Width and height of the half-size images.
    pub half: [u32; 2],
    /// Light, several samples a pixel.
    pub samples: wgpu::TextureView,
    /// Depth, several samples a pixel.
    pub depth: wgpu::TextureView,
    /// Light, one value a pixel.
    pub light: wgpu::TextureView,
    /// Depth at half the size.
    pub half_depth: wgpu::TextureView,
    /// Raw openness at half the size.
    pub gathered: wgpu::TextureView,
    /// Openness at half the size, smoothed.
    pub openness: wgpu::TextureView,
}

impl Targets {
    pub fn new(device: &wgpu::Device, size: [u32; 2]) -> Self {
        let size = size.map(|side| side.max(2));
        let half = size.map(|side| side.div_ceil(2));
        let image = |label, size: [u32; 2], format, sample_count| {
            let bound =
                if sample_count == 1 { wgpu::TextureUsages::TEXTURE_BINDING } else { wgpu::TextureUsages::empty() };
            device
                .create_texture(&wgpu::TextureDescriptor {
                    label: Some(label),
                    size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                    mip_level_count: 1,
                    sample_count,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage: wgpu::TextureUsages::RENDER_ATTACHMENT | bound,
                    view_formats: &[],
                })
                .create_view(&Default::default())
        };
        Self {
            size,
            half,
            samples: image("light samples", size, LIGHT, SAMPLES),
            depth: image("depth samples", size, DEPTH, SAMPLES),
            light: image("light", size, LIGHT, 1),
            half_depth: image("half-size depth", half, DEPTH, 1),
            gathered: image("gathered openness", half, OPENNESS, 1),
            openness: image("openness", half, OPENNESS, 1),
        }
    }
}

/// A pass that writes depth alone.
pub fn depth_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    view: &wgpu::TextureView,
    clear: f32,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}

/// A pass that fills every pixel of one image.
pub fn screen_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    view: &wgpu::TextureView,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    })
}

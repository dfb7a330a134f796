//! Finding a graphics device without a window.

/// A graphics device and the queue of its work.
pub struct Gpu {
    /// The library's entry, from which a window makes its surface.
    pub instance: wgpu::Instance,
    /// The physical device or the driver that stands in for one.
    pub adapter: wgpu::Adapter,
    /// The opened device.
    pub device: wgpu::Device,
    /// Where work for the device goes.
    pub queue: wgpu::Queue,
    /// The name that the driver gives, for reports.
    pub name: String,
}

/// Why there is no device to draw with.
#[derive(Debug)]
pub enum GpuError {
    /// No driver offers a device.
    Missing,
    /// A driver offers a device but does not open it.
    Refused(String),
}

impl std::fmt::Display for GpuError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Missing => f.write_str(
                "no Vulkan device was found; a driver in software is enough: apt-get install mesa-vulkan-drivers libvulkan1",
            ),
            Self::Refused(why) => write!(f, "the graphics driver does not open its device: {why}"),
        }
    }
}

impl std::error::Error for GpuError {}

impl Gpu {
    /// Opens the fastest device, with all that it allows for buffers of compute passes.
    pub fn headless() -> Result<Self, GpuError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::from_env().unwrap_or(wgpu::Backends::PRIMARY);
        let instance = wgpu::Instance::new(descriptor);
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options)).map_err(|_| GpuError::Missing)?;
        let (device, queue) = pollster::block_on(adapter.request_device(&device_descriptor(&adapter)))
            .map_err(|error| GpuError::Refused(error.to_string()))?;
        let name = adapter.get_info().name;
        Ok(Self { instance, adapter, device, queue, name })
    }
}

/// What is asked of a device: the usual limits, and the adapter's own where compute passes and large windows want more.
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    let offered = adapter.limits();
    let required_limits = wgpu::Limits {
        max_texture_dimension_2d: offered.max_texture_dimension_2d,
        max_buffer_size: offered.max_buffer_size,
        max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
        max_storage_buffers_per_shader_stage: offered.max_storage_buffers_per_shader_stage,
        max_compute_workgroup_storage_size: offered.max_compute_workgroup_storage_size,
        ..wgpu::Limits::default()
    };
    wgpu::DeviceDescriptor { label: Some("pliant"), required_limits, ..Default::default() }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::io::Write;

    use super::*;

    /// A device for a test; without one the test is skipped, unless `PLIANT_REQUIRE_GPU` is set to `1`.
    pub(crate) fn device_or_skip(test: &str) -> Option<Gpu> {
        match Gpu::headless() {
            Ok(gpu) => Some(gpu),
            Err(error) => {
                if std::env::var("PLIANT_REQUIRE_GPU").as_deref() == Ok("1") {
                    panic!("{test}: {error}");
                }
                // Straight to the stream: what is printed by macros shows only in failed tests.
                let _ = writeln!(std::io::stderr(), "skipped {test}: {error}");
                None
            }
        }
    }

    #[test]
    fn a_missing_device_is_told_in_one_line() {
        let text = GpuError::Missing.to_string();
        assert_eq!(text.lines().count(), 1);
        assert!(text.contains("apt-get install mesa-vulkan-drivers libvulkan1"));
    }
}

//! The pictures of a run without a window.

use std::path::{Path, PathBuf};

use anyhow::bail;

use super::args::RunArgs;
use super::moment::Moment;
use super::painter::Painter;
use super::tell;
use super::watch::Watch;
use crate::output::write_picture;
use crate::render::{Gpu, Picture, Renderer, picture};
use crate::simulation::Simulation;

/// Frames from one picture to the next where a driver draws in software.
const SOFTWARE_EVERY: u64 = 10;

/// Draws frames of a scene into files.
pub struct Pictures {
    renderer: Renderer,
    target: Picture,
    painter: Painter,
    folder: PathBuf,
    size: [u32; 2],
    every: u64,
    watch: Watch,
}

impl Pictures {
    /// Prepares to draw a scene on a device.
    pub fn open(gpu: &Gpu, args: &RunArgs, folder: &Path, simulation: &Simulation) -> anyhow::Result<Self> {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let [width, height] = args.size;
        if width.max(height) > limit {
            bail!("pictures of {width}x{height} are larger than {} can draw ({limit} a side)", gpu.name);
        }
        let software = gpu.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        let every = args.picture_every.unwrap_or(if software { SOFTWARE_EVERY } else { 1 });
        if software && args.picture_every.is_none() {
            let name = &gpu.name;
            tell(&format!("{name} draws in software: a picture of every {every}th frame (--picture-every 1: of all)"));
        }
        let watch = Watch::over(&gpu.device);
        let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, args.size);
        let painter = Painter::new(&mut renderer, simulation, !args.cpu);
        if let Some(trouble) = painter.trouble() {
            tell(&format!("the processor deforms the pictures' vertices: {trouble}"));
        }
        let target = Picture::new(&gpu.device, args.size);
        Ok(Self { renderer, target, painter, folder: folder.into(), size: args.size, every, watch })
    }

    /// Whether a frame gets a picture.
    pub fn wants(&self, frame: usize) -> bool {
        (frame as u64).is_multiple_of(self.every)
    }

    /// Draws and writes a frame. What the device complains about is returned; nothing is written then.
    pub fn draw(&mut self, frame: usize, simulation: &Simulation) -> anyhow::Result<Option<String>> {
        let now = Moment::of(simulation);
        let described = self.painter.frame(&mut self.renderer, simulation, [&now, &now], 1.0);
        let taken = self.target.take(&mut self.renderer, &described);
        if let Some(complaint) = self.watch.complaint() {
            return Ok(Some(complaint));
        }
        match taken {
            Ok(image) => write_picture(&self.folder, frame, self.size[0], self.size[1], image.as_raw())?,
            Err(error) => return Ok(Some(error.to_string())),
        };
        Ok(None)
    }
}

//! The pictures of a run without a window.

use std::path::{Path, PathBuf};

use anyhow::bail;

use super::args::RunArgs;
use super::looks;
use super::moment::Moment;
use super::painter::Painter;
use super::strip::Strip;
use super::tell;
use super::watch::Watch;
use crate::output::{picture_path, write_picture};
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
    /// None where only a strip is wanted.
    every: Option<u64>,
    strip: Option<Strip>,
    watch: Watch,
}

impl Pictures {
    /// Prepares to draw a scene on a device.
    pub fn open(
        gpu: &Gpu,
        args: &RunArgs,
        frames: u64,
        folder: &Path,
        simulation: &Simulation,
    ) -> anyhow::Result<Self> {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let [width, height] = args.size;
        if width.max(height) > limit {
            bail!("pictures of {width}x{height} are larger than {} can draw ({limit} a side)", gpu.name);
        }
        let software = gpu.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        let every = args.picture_every.unwrap_or(if software { SOFTWARE_EVERY } else { 1 });
        if software && args.picture_every.is_none() && !args.no_pictures {
            let name = &gpu.name;
            tell(&format!("{name} draws in software: a picture of every {every}th frame (--picture-every 1: of all)"));
        }
        let watch = Watch::over(&gpu.device);
        let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, args.size);
        let mut painter = Painter::new(&mut renderer, simulation, !args.cpu);
        if let Some(trouble) = painter.trouble() {
            tell(&format!("the processor deforms the pictures' vertices: {trouble}"));
        }
        painter.shown.field = args.show;
        painter.shown.cut = args.cut;
        let target = Picture::new(&gpu.device, args.size);
        let every = (!args.no_pictures).then_some(every);
        let strip = args.strip.map(|count| Strip::new(count, args.strip_rows, frames, args.size));
        Ok(Self { renderer, target, painter, folder: folder.into(), size: args.size, every, strip, watch })
    }

    /// Whether a frame gets a picture.
    pub fn wants(&self, frame: usize) -> bool {
        self.wants_file(frame) || self.strip.as_ref().is_some_and(|strip| strip.wants(frame))
    }

    fn wants_file(&self, frame: usize) -> bool {
        self.every.is_some_and(|every| (frame as u64).is_multiple_of(every))
    }

    /// Draws and writes a frame. What the device complains about is returned; nothing is written then.
    pub fn draw(&mut self, frame: usize, simulation: &Simulation) -> anyhow::Result<Option<String>> {
        let now = Moment::of(simulation);
        let camera = looks::camera(&simulation.scene.camera);
        let described = self.painter.frame(&mut self.renderer, simulation, [&now, &now], 1.0, camera);
        let taken = self.target.take(&mut self.renderer, &described);
        if let Some(complaint) = self.watch.complaint() {
            return Ok(Some(complaint));
        }
        let image = match taken {
            Ok(image) => image,
            Err(error) => return Ok(Some(error.to_string())),
        };
        if self.wants_file(frame) {
            write_picture(picture_path(&self.folder, frame), self.size, image.as_raw())?;
        }
        if let Some(strip) = &mut self.strip {
            strip.add(frame, &image);
        }
        Ok(None)
    }

    /// Writes the film strip, if one is wanted.
    pub fn finish(&self) -> anyhow::Result<()> {
        if let Some(strip) = self.strip.as_ref().map(Strip::picture) {
            write_picture(self.folder.join("strip.png"), strip.dimensions().into(), strip.as_raw())?;
        }
        Ok(())
    }
}

//! The window: a picture of the scene that can be looked around in and grabbed, and a panel beside it.
//!
//! What is shown and stepped is a [`Stage`]; the window knows neither physics nor files. Left drag grabs a body
//! or, with control, its skin, and turns the view where nothing is grabbed; a click touches what moves by itself; right drag turns, middle drag or shift and drag moves, the wheel comes
//! nearer. Space pauses, `.` or `N` makes one step, `R` restarts, `C` returns the camera.

mod app;
mod clock;
mod orbit;
mod stage;
mod view;

pub use stage::Stage;

use crate::render::Gpu;

/// Whether there is a display to open a window on.
pub fn display_available() -> bool {
    ["DISPLAY", "WAYLAND_DISPLAY"].into_iter().any(|name| std::env::var_os(name).is_some_and(|value| !value.is_empty()))
        || cfg!(any(target_os = "macos", target_os = "windows"))
}

/// Opens the window on the given device and returns when it is closed.
pub fn run(gpu: &Gpu, title: &str, stage: Box<dyn Stage>) -> anyhow::Result<()> {
    let setup = eframe::egui_wgpu::WgpuSetupExisting {
        instance: gpu.instance.clone(),
        adapter: gpu.adapter.clone(),
        device: gpu.device.clone(),
        queue: gpu.queue.clone(),
    };
    let mut options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default().with_title(title).with_inner_size([1280.0, 760.0]),
        ..Default::default()
    };
    options.wgpu_options.wgpu_setup = setup.into();
    eframe::run_native(title, options, Box::new(move |context| Ok(Box::new(app::App::new(context, stage)?))))
        .map_err(|error| anyhow::anyhow!("the window cannot be opened: {error}"))
}

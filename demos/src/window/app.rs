//! One round of the window: keys, steps, the panel, the pointer, the picture.

use std::time::{Duration, Instant};

use egui::{Key, PointerButton};
use glam::{Vec2, Vec3};

use super::clock::Clock;
use super::orbit::Orbit;
use super::stage::Stage;
use super::view::View;

/// Steps of one round stop after this long, so that the window stays usable.
const STEP_BUDGET: Duration = Duration::from_millis(60);

/// What a drag of the pointer does until the button is let go.
#[derive(Clone, Copy, PartialEq)]
enum Drag {
    None,
    Turn,
    Pan,
    Grab,
}

pub struct App {
    stage: Box<dyn Stage>,
    view: View,
    orbit: Orbit,
    clock: Clock,
    drag: Drag,
    last_round: Instant,
    /// Pixels of the picture for each pixel of the window.
    detail: f32,
    stale: bool,
    trouble: Option<String>,
    device_name: String,
    step_time: f32,
    round_time: f32,
}

impl App {
    pub fn new(context: &eframe::CreationContext<'_>, stage: Box<dyn Stage>) -> Result<Self, String> {
        let state = context.wgpu_render_state.as_ref().ok_or("the window has no graphics device")?;
        let info = state.adapter.get_info();
        // Drivers in software pay for each pixel.
        let detail = if info.device_type == wgpu::DeviceType::Cpu { 0.5 } else { 1.0 };
        context.egui_ctx.set_theme(egui::Theme::Light);
        Ok(Self {
            orbit: Orbit::new(stage.camera()),
            stage,
            view: View::new(state),
            clock: Clock::default(),
            drag: Drag::None,
            last_round: Instant::now(),
            detail,
            stale: true,
            trouble: None,
            device_name: info.name,
            step_time: 0.0,
            round_time: 0.0,
        })
    }

    fn restart(&mut self) {
        self.let_go();
        self.stage.restart();
        self.clock.reset();
    }

    fn load(&mut self, index: usize) {
        self.let_go();
        self.trouble = self.stage.load_scene(index).err();
        if self.trouble.is_none() {
            self.orbit = Orbit::new(self.stage.camera());
            self.clock.reset();
        }
    }

    fn let_go(&mut self) {
        if std::mem::replace(&mut self.drag, Drag::None) == Drag::Grab {
            self.stage.release();
        }
    }

    fn keys(&mut self, context: &egui::Context) {
        if context.egui_wants_keyboard_input() {
            return;
        }
        let pressed = |key| context.input(|input| input.key_pressed(key));
        if pressed(Key::Space) {
            self.clock.running = !self.clock.running;
        }
        if pressed(Key::Period) || pressed(Key::N) {
            self.clock.single_step();
        }
        if pressed(Key::R) {
            self.restart();
        }
        if pressed(Key::C) {
            self.orbit = Orbit::new(self.stage.camera());
        }
    }

    fn steps(&mut self) {
        let now = Instant::now();
        let elapsed = (now - self.last_round).as_secs_f32();
        self.last_round = now;
        blend(&mut self.round_time, elapsed);
        for _ in 0..self.clock.steps(elapsed, self.stage.dt()) {
            let before = Instant::now();
            self.stage.step();
            blend(&mut self.step_time, before.elapsed().as_secs_f32());
            self.stale = true;
            if now.elapsed() > STEP_BUDGET {
                break;
            }
        }
        self.stale |= self.clock.running;
    }

    fn panel(&mut self, ui: &mut egui::Ui) {
        let names = self.stage.scene_names();
        let mut chosen = self.stage.current_scene();
        ui.add_space(6.0);
        egui::ComboBox::from_id_salt("scene")
            .width(ui.available_width())
            .selected_text(names.get(chosen).cloned().unwrap_or_default())
            .show_ui(ui, |ui| {
                for (index, name) in names.iter().enumerate() {
                    ui.selectable_value(&mut chosen, index, name);
                }
            });
        if chosen != self.stage.current_scene() {
            self.load(chosen);
        }
        ui.horizontal(|ui| {
            let label = if self.clock.running { "Pause" } else { "Play" };
            if ui.button(label).on_hover_text("Space").clicked() {
                self.clock.running = !self.clock.running;
            }
            if ui.button("Step").on_hover_text(". or N").clicked() {
                self.clock.single_step();
            }
            if ui.button("Restart").on_hover_text("R").clicked() {
                self.restart();
            }
            if ui.button("Camera").on_hover_text("C: back to the scene's camera").clicked() {
                self.orbit = Orbit::new(self.stage.camera());
            }
        });
        if let Some(trouble) = &self.trouble {
            ui.colored_label(ui.visuals().error_fg_color, trouble);
        }
        ui.separator();
        egui::ScrollArea::vertical().auto_shrink([false, true]).show(ui, |ui| {
            self.stage.panel(ui);
            ui.separator();
            ui.add(egui::Slider::new(&mut self.detail, 0.25..=1.0).text("detail"));
            ui.small(format!(
                "{:.0} pictures a second, {:.2} ms a step",
                1.0 / self.round_time.max(1e-3),
                self.step_time * 1e3
            ));
            ui.small(&self.device_name);
        });
    }

    fn pointer(&mut self, ui: &egui::Ui, response: &egui::Response) {
        let rect = response.rect;
        let aspect = rect.aspect_ratio();
        let camera = self.orbit.camera();
        let ray = |at: egui::Pos2| -> (Vec3, Vec3) {
            let place = (at - rect.center()) / rect.size() * 2.0;
            camera.ray(Vec2::new(place.x, -place.y), aspect)
        };
        let (shift, other) = ui.input(|input| (input.modifiers.shift, input.modifiers.command));
        if let (true, Some(at)) = (response.drag_started(), response.interact_pointer_pos()) {
            let button = |button| response.drag_started_by(button);
            self.drag = if button(PointerButton::Middle) || shift {
                Drag::Pan
            } else if button(PointerButton::Secondary) {
                Drag::Turn
            } else {
                let (origin, direction) = ray(at);
                if self.stage.grab(origin, direction, other) { Drag::Grab } else { Drag::Turn }
            };
        }
        if let (true, Some(at)) = (response.clicked(), response.interact_pointer_pos()) {
            let (origin, direction) = ray(at);
            self.stage.touch(origin, direction);
        }
        let moved = response.drag_delta() / rect.height();
        let moved = Vec2::new(moved.x, moved.y);
        match (self.drag, response.interact_pointer_pos()) {
            (Drag::Turn, _) => self.orbit.turn(moved),
            (Drag::Pan, _) => self.orbit.pan(moved),
            (Drag::Grab, Some(at)) => {
                let (origin, direction) = ray(at);
                self.stage.drag(origin, direction);
            }
            _ => {}
        }
        if response.drag_stopped() {
            self.let_go();
        }
        if response.hovered() {
            self.orbit.zoom(ui.input(|input| input.smooth_scroll_delta().y) * 0.003);
        }
    }

    fn picture(&mut self, ui: &mut egui::Ui) {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), egui::Sense::click_and_drag());
        let before = self.orbit;
        self.pointer(ui, &response);
        let scale = ui.ctx().pixels_per_point() * self.detail;
        let resized = self.view.resize([rect.width(), rect.height()].map(|side| (side * scale).round() as u32));
        let touched = ui.input(|input| {
            let still =
                |event: &egui::Event| matches!(event, egui::Event::PointerMoved(_) | egui::Event::MouseMoved(_));
            input.pointer.any_down() || input.events.iter().any(|event| !still(event))
        });
        if resized || touched || before != self.orbit || std::mem::take(&mut self.stale) {
            let alpha = self.clock.alpha(self.stage.dt());
            let frame = self.stage.frame(&mut self.view.renderer, alpha, self.orbit.camera());
            self.view.draw(&frame);
        }
        let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
        ui.painter().image(self.view.texture(), rect, whole, egui::Color32::WHITE);
    }
}

/// Follows a value that jumps.
fn blend(mean: &mut f32, value: f32) {
    *mean = if *mean == 0.0 { value } else { 0.9 * *mean + 0.1 * value };
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let context = ui.ctx().clone();
        self.keys(&context);
        self.steps();
        egui::Panel::right("settings").default_size(270.0).show(ui, |ui| self.panel(ui));
        egui::CentralPanel::default().frame(egui::Frame::NONE).show(ui, |ui| self.picture(ui));
        if self.clock.running || self.drag != Drag::None {
            context.request_repaint();
        }
    }
}

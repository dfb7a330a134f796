//! The renderer's picture as a texture of the user interface.

use eframe::egui_wgpu::RenderState;

use crate::render::{Frame, Picture, Renderer, picture};

/// A picture that follows the size of its place in the window.
pub struct View {
    state: RenderState,
    /// Draws the picture.
    pub renderer: Renderer,
    picture: Picture,
    texture: egui::TextureId,
}

impl View {
    pub fn new(state: &RenderState) -> Self {
        let size = [640, 400];
        let renderer = Renderer::new(&state.device, &state.queue, picture::FORMAT, size);
        let picture = Picture::new(&state.device, size);
        let texture =
            state.renderer.write().register_native_texture(&state.device, picture.view(), wgpu::FilterMode::Linear);
        Self { state: state.clone(), renderer, picture, texture }
    }

    /// What the user interface shows.
    pub fn texture(&self) -> egui::TextureId {
        self.texture
    }

    /// Changes the size in pixels; tells whether it was another one.
    pub fn resize(&mut self, size: [u32; 2]) -> bool {
        let most = self.state.device.limits().max_texture_dimension_2d;
        let size = size.map(|side| side.clamp(16, most));
        if size == self.renderer.size() {
            return false;
        }
        self.renderer.resize(size);
        self.picture = Picture::new(&self.state.device, size);
        self.state.renderer.write().update_egui_texture_from_wgpu_texture(
            &self.state.device,
            self.picture.view(),
            wgpu::FilterMode::Linear,
            self.texture,
        );
        true
    }

    /// Draws.
    pub fn draw(&mut self, frame: &Frame) {
        self.renderer.draw(frame, self.picture.view());
    }
}

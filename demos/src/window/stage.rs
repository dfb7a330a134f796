//! What a window shows.

use glam::Vec3;

use crate::render::{Camera, Frame, Renderer};

/// A player of scenes. Its time goes in fixed steps; pictures are drawn between the last two of them.
pub trait Stage {
    /// Names to choose from.
    fn scene_names(&self) -> Vec<String>;
    /// Which of them is loaded.
    fn current_scene(&self) -> usize;
    /// Loads another one, or tells in one line why not.
    fn load_scene(&mut self, index: usize) -> Result<(), String>;
    /// Returns the scene to its beginning.
    fn restart(&mut self);
    /// Seconds that a step takes in the scene.
    fn dt(&self) -> f32;
    /// Makes one step.
    fn step(&mut self);
    /// The camera that suits the scene.
    fn camera(&self) -> Camera;
    /// Describes the picture between the last two steps (`alpha` is one at the last) as a camera sees it, with meshes of the
    /// renderer. After a change of scene, meshes have to be made anew.
    fn frame(&mut self, renderer: &mut Renderer, alpha: f32, camera: Camera) -> Frame;
    /// Grabs what a ray meets first, if it can be moved; the `other` way than usual if so asked.
    fn grab(&mut self, origin: Vec3, direction: Vec3, other: bool) -> bool;
    /// Moves what is grabbed so that it stays under the ray.
    fn drag(&mut self, origin: Vec3, direction: Vec3);
    /// Lets go.
    fn release(&mut self);
    /// Touches what a ray meets first: a click.
    fn touch(&mut self, origin: Vec3, direction: Vec3);
    /// Settings and figures of the scene.
    fn panel(&mut self, ui: &mut egui::Ui);
}

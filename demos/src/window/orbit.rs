//! A camera that moves around a point.

use glam::{Vec2, Vec3};

use crate::render::Camera;

/// Angles, distance and the point that is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    base: Camera,
    target: Vec3,
    yaw: f32,
    pitch: f32,
    distance: f32,
}

impl Orbit {
    /// The place of a given camera.
    pub fn new(camera: Camera) -> Self {
        let offset = camera.eye - camera.target;
        let distance = offset.length().max(0.01);
        Self {
            base: camera,
            target: camera.target,
            yaw: offset.x.atan2(offset.z),
            pitch: (offset.y / distance).clamp(-1.0, 1.0).asin(),
            distance,
        }
    }

    /// The camera at that place.
    pub fn camera(&self) -> Camera {
        let (sin, cos) = self.pitch.sin_cos();
        let out = Vec3::new(self.yaw.sin() * cos, sin, self.yaw.cos() * cos);
        Camera { eye: self.target + out * self.distance, target: self.target, ..self.base }
    }

    /// Turns by a drag, given as a share of the picture's height.
    pub fn turn(&mut self, drag: Vec2) {
        self.yaw -= drag.x * 3.0;
        self.pitch = (self.pitch + drag.y * 3.0).clamp(-1.5, 1.5);
    }

    /// Moves sidewards by a drag, given as a share of the picture's height: what is looked at stays under the pointer.
    pub fn pan(&mut self, drag: Vec2) {
        let [right, up, _] = self.camera().axes();
        let height = 2.0 * self.distance * (0.5 * self.base.fov).tan();
        self.target += (up * drag.y - right * drag.x) * height;
    }

    /// Comes nearer for positive amounts.
    pub fn zoom(&mut self, amount: f32) {
        self.distance = (self.distance * (-amount).exp()).clamp(0.1, 500.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_camera_is_kept() {
        let camera = Camera::looking(Vec3::new(3.0, 2.0, -5.0), Vec3::new(1.0, 0.5, 0.0));
        let kept = Orbit::new(camera).camera();
        assert!(kept.eye.distance(camera.eye) < 1e-5 && kept.target == camera.target);
    }

    #[test]
    fn panning_follows_the_pointer() {
        let mut orbit = Orbit::new(Camera::looking(Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO));
        let before = orbit.camera();
        orbit.pan(Vec2::new(0.25, 0.1));
        let clip = orbit.camera().view_projection(1.0) * before.target.extend(1.0);
        let place = clip.truncate().truncate() / clip.w;
        assert!((place - Vec2::new(0.5, -0.2)).length() < 1e-4, "{place}");
    }

    #[test]
    fn the_view_never_tips_over() {
        let mut orbit = Orbit::new(Camera::default());
        orbit.turn(Vec2::new(0.3, 50.0));
        orbit.zoom(1e3);
        let camera = orbit.camera();
        assert!(camera.eye.is_finite() && camera.axes()[1].y > 0.0);
    }
}

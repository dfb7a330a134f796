//! A ball that bounces, in the window: the smallest stage.

use glam::{Mat4, Vec3};
use pliant_demos::render::{Camera, Frame, Gpu, Item, Material, MeshId, Renderer, shapes};
use pliant_demos::window::{self, Stage};

#[derive(Default)]
struct Bounce {
    scene: usize,
    mesh: Option<MeshId>,
    now: (Vec3, Vec3),
    before: Vec3,
    held: Option<f32>,
    steps: u32,
    wire: bool,
}

impl Bounce {
    const RADIUS: f32 = 0.4;
}

impl Stage for Bounce {
    fn scene_names(&self) -> Vec<String> {
        vec!["bounce".into(), "roll".into(), "broken".into()]
    }
    fn current_scene(&self) -> usize {
        self.scene
    }
    fn load_scene(&mut self, index: usize) -> Result<(), String> {
        if index == 2 {
            return Err("this scene cannot be loaded".into());
        }
        self.scene = index;
        self.restart();
        Ok(())
    }
    fn restart(&mut self) {
        let start = if self.scene == 0 { Vec3::Y * 2.5 } else { Vec3::new(-2.0, Self::RADIUS, 0.0) };
        let speed = if self.scene == 0 { Vec3::ZERO } else { Vec3::X };
        (self.now, self.before, self.steps) = ((start, speed), start, 0);
    }
    fn dt(&self) -> f32 {
        1.0 / 120.0
    }
    fn step(&mut self) {
        self.steps += 1;
        self.before = self.now.0;
        if self.held.is_none() {
            self.now.1.y -= 9.81 * self.dt();
            self.now.0 += self.now.1 * self.dt();
            if self.now.0.y < Self::RADIUS {
                self.now.0.y = Self::RADIUS;
                self.now.1.y = self.now.1.y.abs() * 0.9;
            }
        }
    }
    fn camera(&self) -> Camera {
        Camera::looking(Vec3::new(2.5, 2.5, 6.5), Vec3::Y)
    }
    fn frame(&mut self, renderer: &mut Renderer, alpha: f32, camera: Camera) -> Frame {
        let mesh = *self.mesh.get_or_insert_with(|| renderer.add_mesh(&shapes::ball(Self::RADIUS)));
        let at = Mat4::from_translation(self.before.lerp(self.now.0, alpha));
        let mut item = Item::new(mesh, at, Material::glossy(Vec3::new(0.5, 0.1, 0.05)));
        item.wire = self.wire.then_some([0.0, 0.0, 0.0, 0.7]);
        Frame { camera, items: vec![item], ..Frame::default() }
    }
    fn grab(&mut self, origin: Vec3, direction: Vec3, _other: bool) -> bool {
        let to = self.now.0 - origin;
        let along = to.dot(direction);
        let hit = (to - direction * along).length() < Self::RADIUS;
        self.held = hit.then_some(along);
        hit
    }
    fn drag(&mut self, origin: Vec3, direction: Vec3) {
        if let Some(along) = self.held {
            self.now = (origin + direction * along, Vec3::ZERO);
        }
    }
    fn release(&mut self) {
        self.held = None;
    }
    fn touch(&mut self, origin: Vec3, direction: Vec3) {
        let to = self.now.0 - origin;
        if (to - direction * to.dot(direction)).length() < Self::RADIUS {
            self.now.1 += Vec3::Y * 3.0;
        }
    }
    fn panel(&mut self, ui: &mut egui::Ui) {
        ui.checkbox(&mut self.wire, "edges");
        ui.label(format!("{} steps, height {:.2} m", self.steps, self.now.0.y));
    }
}

fn main() -> anyhow::Result<()> {
    let mut stage = Bounce::default();
    stage.restart();
    window::run(&Gpu::headless()?, "bounce", Box::new(stage))
}

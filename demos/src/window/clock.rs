//! How many steps are due. The scene's time follows the clock on the wall as long as the machine keeps up, and falls
//! behind rather than piling up steps when it does not.

/// No more than this many seconds are made up for at once.
const LONGEST_LAG: f32 = 0.1;

/// Time of a scene in fixed steps.
#[derive(Debug)]
pub struct Clock {
    /// Whether time runs.
    pub running: bool,
    lag: f32,
    single: bool,
    at_last_step: bool,
}

impl Default for Clock {
    fn default() -> Self {
        Self { running: true, lag: 0.0, single: false, at_last_step: false }
    }
}

impl Clock {
    /// Pauses, and asks for one step.
    pub fn single_step(&mut self) {
        self.running = false;
        self.single = true;
    }

    /// Forgets what is due.
    pub fn reset(&mut self) {
        self.lag = 0.0;
        self.single = false;
        self.at_last_step = true;
    }

    /// Steps of length `dt` that are due after `elapsed` more seconds.
    pub fn steps(&mut self, elapsed: f32, dt: f32) -> u32 {
        if std::mem::take(&mut self.single) {
            self.at_last_step = true;
            return 1;
        }
        if !self.running {
            return 0;
        }
        self.at_last_step = false;
        self.lag = (self.lag + elapsed.max(0.0)).min(LONGEST_LAG.max(dt));
        let steps = (self.lag / dt) as u32;
        self.lag -= steps as f32 * dt;
        steps
    }

    /// Place of the picture between the last two steps.
    pub fn alpha(&self, dt: f32) -> f32 {
        if self.at_last_step { 1.0 } else { (self.lag / dt).clamp(0.0, 1.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 1.0 / 60.0;

    #[test]
    fn time_is_kept_over_uneven_frames() {
        let mut clock = Clock::default();
        let frames = [0.011, 0.023, 0.004, 0.032, 0.016];
        let steps: u32 = (0..200).map(|i| clock.steps(frames[i % 5], DT)).sum();
        let passed = frames.iter().sum::<f32>() * 40.0;
        assert!((steps as f32 + clock.alpha(DT) - passed / DT).abs() < 0.1);
    }

    #[test]
    fn a_slow_machine_falls_behind() {
        let mut clock = Clock::default();
        assert!((0..10).all(|_| clock.steps(3.0, DT) <= 6));
        assert_eq!(clock.steps(3.0, 0.5), 1, "but never stands still");
    }

    #[test]
    fn single_steps_pause() {
        let mut clock = Clock::default();
        clock.single_step();
        assert_eq!((clock.steps(1.0, DT), clock.alpha(DT)), (1, 1.0));
        assert_eq!((clock.steps(1.0, DT), clock.alpha(DT)), (0, 1.0));
    }
}

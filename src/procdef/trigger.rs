//! When a contact is a stimulus: a threshold, and a rest after each response.

/// How strong a contact must be, and how long the body rests after it answered one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriggerSettings {
    /// Least impulse of one step that is felt, in newton seconds.
    pub threshold: f32,
    /// Time after a response in which nothing is felt, in seconds.
    pub refractory: f32,
}

impl Default for TriggerSettings {
    fn default() -> Self {
        Self { threshold: 0.05, refractory: 0.5 }
    }
}

/// Watches the impulses on one body, or one place of it: impulses in, triggers out.
///
/// A contact that lasts is one stimulus: after a response, the impulse must fall below half the threshold once before
/// another is felt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactTrigger {
    /// Threshold and refractory time.
    pub settings: TriggerSettings,
    /// Seconds until it feels again.
    rest: f32,
    /// The contact that was answered still lasts.
    held: bool,
}

impl ContactTrigger {
    /// A trigger that feels at once.
    pub fn new(settings: TriggerSettings) -> Self {
        Self { settings, rest: 0.0, held: false }
    }

    /// One step of `dt` seconds with the largest impulse felt in it, in newton seconds (0 without contact): true when
    /// it triggers. What is not finite is not felt.
    pub fn step(&mut self, impulse: f32, dt: f32) -> bool {
        // Rounding of many steps must not prolong the rest by one more.
        self.rest = (self.rest - dt.max(0.0)).max(0.0);
        if self.rest < 1.0e-4 * self.settings.refractory {
            self.rest = 0.0;
        }
        let strong = impulse.is_finite() && impulse > 0.0 && impulse >= self.settings.threshold;
        if self.held && (!impulse.is_finite() || impulse < 0.5 * self.settings.threshold || impulse <= 0.0) {
            self.held = false;
        }
        if !strong || self.held || self.rest > 0.0 {
            return false;
        }
        self.rest = self.settings.refractory;
        self.held = true;
        true
    }
}

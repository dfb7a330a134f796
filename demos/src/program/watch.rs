//! What a graphics device complains about, as a text instead of the end of the program.

use std::sync::{Arc, Mutex, PoisonError};

/// Keeps the first complaint of a device: memory that is not there, or work that its driver cannot do.
pub struct Watch(Arc<Mutex<Option<String>>>);

impl Watch {
    /// Listens to a device from now on.
    pub fn over(device: &wgpu::Device) -> Self {
        let heard = Arc::new(Mutex::new(None));
        let first = heard.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            first.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_with(|| error.to_string());
        }));
        Self(heard)
    }

    /// The first complaint.
    pub fn complaint(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

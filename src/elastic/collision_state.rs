//! Going back: the skin and the collision passes as they were, where other passes turn out no better.

use super::body::ElasticBody;
use super::palette::CollisionPass;
use crate::math::Vec3;

/// The deformed skin of a body, and the collision passes that led to it.
#[derive(Clone, Debug)]
pub struct CollisionState {
    positions: Vec<Vec3>,
    passes: Vec<CollisionPass>,
}

impl CollisionState {
    /// The vertices of the skin.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// The passes that have led there.
    pub fn passes(&self) -> &[CollisionPass] {
        &self.passes
    }
}

impl ElasticBody {
    /// The skin and the collision passes as they are now.
    pub fn collision_state(&self) -> CollisionState {
        CollisionState { positions: self.positions.clone(), passes: self.palette.passes.clone() }
    }

    /// Goes back to a state of this body, taken since its palette was built. Nothing happens with the state of another skin.
    pub fn resume(&mut self, state: &CollisionState) {
        if state.positions.len() == self.positions.len() {
            self.positions.clone_from(&state.positions);
            self.palette.passes.clone_from(&state.passes);
        }
    }
}

//! Bodies that move by themselves, modelled as tetrahedral meshes: cross-sections swept along curves, with more grown
//! from their faces. Each is given in a coarse form, which is simulated, and a fine one, whose surface is drawn.

pub mod bar;
pub mod bowel;
pub mod cells;
pub mod disc;
pub mod heart;
pub mod jellyfish;
pub mod rigs;
pub mod rigs_animals;
pub mod rigs_organs;
pub mod shell;
pub mod snail;
pub mod worm;

//! The demos of pliant: scenes, measurements, drawing, the window and the files that the program writes.

pub mod bench;
pub mod modeller;
pub mod output;
pub mod program;
pub mod render;
pub mod scene;
pub mod simulation;
pub mod window;

//! The demos of pliant: scenes, drawing, the window and the files that the program writes.

pub mod render;
pub mod window;

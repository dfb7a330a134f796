//! Obstacles of every kind: their convex parts, how locally they are expanded, and soft bodies that meet them.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/random.rs"]
#[allow(dead_code)] // other tests use the rest of it
mod random;

mod cached;
mod kinds;
mod local;
mod parts;
mod soft_bodies;

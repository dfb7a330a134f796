//! Bodies that move by themselves in rapier's world: what they do, and how they meet others.

mod behaviour;
mod contacts;
mod heart;
mod scene;
mod world;

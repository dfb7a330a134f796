//! Bodies that move by themselves in rapier's world: what they do, and how they meet others.

mod behaviour;
mod bowel;
mod contacts;
mod crowds;
mod drops;
mod heart;
mod scene;
mod vertices;
mod world;

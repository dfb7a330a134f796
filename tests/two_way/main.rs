//! Elastic bodies and what they touch push each other: momentum, energy, restitution, rolling, rest.

#[path = "../common/mod.rs"]
mod common;
mod fast;
mod momentum;
mod pairs;
mod rest;
mod restitution;
mod rolling;
mod scene;

//! The program as a whole: what it writes, what it refuses, and how it says so.

mod bad_input;
mod common;
mod headless;
mod pictures;
mod soft_bodies;
mod threads;

//! Measurements of bodies that move by themselves: one row of numbers for each body in each frame.

use serde::Serialize;

/// What is measured of one body that moves by itself in one frame, in the order of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SoftMetricsRow {
    /// Number of the frame.
    pub frame: usize,
    /// Name of the body; commas and quotes are escaped.
    pub body: String,
    /// Centre of mass in metres.
    pub x: f32,
    /// Its height.
    pub y: f32,
    /// Its depth.
    pub z: f32,
    /// Volume of the cells as a part of that at rest.
    pub volume_ratio: f64,
    /// Cells that are inside out.
    pub inverted: usize,
    /// Edges of its boundary that go through another body's.
    pub crossings: usize,
    /// Vertices that were held back in the last substep, because contacts alone would have let them into another body.
    pub held: usize,
    /// Least excitation of all vertices, from -1 for full contraction.
    pub contraction: f32,
    /// Largest excitation of all vertices, to 1 for full expansion.
    pub expansion: f32,
    /// Signals of stimuli under way.
    pub stimuli: usize,
    /// Impulse of contacts that was felt in the last substep, in N s.
    pub felt: f32,
    /// Vertices on fixed bodies, counted where it matters.
    pub on_ground: usize,
    /// 1 where the body was left to rapier alone.
    pub frozen: usize,
    /// Time for rapier in milliseconds.
    pub ms_rapier: f64,
    /// Time for reading and writing particles in milliseconds.
    pub ms_exchange: f64,
    /// Time for contacts felt and ground found in milliseconds.
    pub ms_contact: f64,
    /// Time for charts, matching, water and friction in milliseconds.
    pub ms_drive: f64,
}

/// First line of the table.
pub const SOFT_METRICS_HEADER: &str = "frame,body,x,y,z,volume_ratio,inverted,crossings,held,contraction,expansion,stimuli,felt,on_ground,frozen,ms_rapier,ms_exchange,ms_contact,ms_drive";

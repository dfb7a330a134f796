//! Why a ProcDef body cannot be built.

/// What is wrong with what a builder was given.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProcDefRigError {
    /// The density is not a positive finite number.
    #[error("the density is {0} kg/m³; it must be positive and finite")]
    Density(f32),
    /// The masses are not one a vertex.
    #[error("{given} masses were given for a mesh of {expected} vertices")]
    MassCount {
        /// How many were given.
        given: usize,
        /// Number of vertices.
        expected: usize,
    },
    /// A mass is not a positive finite number.
    #[error("vertex {vertex} has the mass {mass} kg; it must be positive and finite")]
    Mass {
        /// The vertex, from 0.
        vertex: usize,
        /// Its mass.
        mass: f32,
    },
    /// Lengths whose cubes 32 bits cannot hold.
    #[error(
        "the mesh is smaller than numbers of 32 bits can tell from a point, or larger than they hold: its size is {0} m"
    )]
    Size(f32),
    /// A cell whose volume is nothing in 32 bits.
    #[error("cell {cell} has the volume {volume:e} m³, which is lost in numbers of 32 bits")]
    CellVolume {
        /// The cell, from 0.
        cell: usize,
        /// Its volume.
        volume: f32,
    },
}

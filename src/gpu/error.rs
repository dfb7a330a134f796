//! What can be wrong with a body or a palette that is meant for a device.

/// Why a skin, a body or a palette cannot go to the device.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    /// The mesh has no vertex.
    #[error("the mesh has no vertices: there is nothing to deform")]
    NoVertices,
    /// Positions, normals and weights differ in number.
    #[error("{positions} positions, {normals} normals and {weights} skin weights: each vertex needs one of each")]
    LengthMismatch {
        /// Number of positions.
        positions: usize,
        /// Number of normals.
        normals: usize,
        /// Number of index-weight entries.
        weights: usize,
    },
    /// The body does not fit into one storage buffer of the device.
    #[error(
        "{vertices} vertices, but the device's buffer limits allow {limit}: split the mesh or ask for higher limits"
    )]
    TooManyVertices {
        /// Number of vertices of the body.
        vertices: usize,
        /// Largest number for this device.
        limit: u64,
    },
    /// The palette does not fit into one storage buffer of the device.
    #[error("the palette takes {bytes} bytes, but the device's buffer limits allow {limit}")]
    PaletteTooLarge {
        /// Size of the packed palette.
        bytes: u64,
        /// Largest size for this device.
        limit: u64,
    },
    /// A vertex refers to a segment that the palette does not have.
    #[error("the skin refers to {needed} segments, but the palette has {given}")]
    MissingSegments {
        /// Segments that the skin needs.
        needed: usize,
        /// Segments of the palette.
        given: usize,
    },
    /// The body was created for a skin with another number of vertices.
    #[error("the body has {body} vertices, but the skin has {skin}")]
    OtherSkin {
        /// Vertices of the body.
        body: u32,
        /// Vertices of the skin.
        skin: u32,
    },
    /// Another number of positions than the body has vertices.
    #[error("{given} positions for a body of {needed} vertices")]
    BodyVertices {
        /// Vertices of the body.
        needed: usize,
        /// Positions that were given.
        given: usize,
    },
}

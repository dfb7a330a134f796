//! The shader's text: the twins of the CPU's files, put together, since WGSL has no includes.

use super::palette_bytes as layout;

/// Invocations of one workgroup.
pub(super) const WORKGROUP: u32 = 64;

/// The whole compute shader in WGSL; its entry point is `deform_vertices`.
pub fn deform_shader() -> String {
    let mut text = String::new();
    for (name, value) in [
        ("WORKGROUP", WORKGROUP),
        ("EULER", layout::EULER),
        ("MIDPOINT", layout::MIDPOINT),
        ("HEADER", layout::HEADER),
        ("SEGMENT", layout::SEGMENT),
        ("SPRING", layout::SPRING),
        ("DRAG", layout::DRAG),
        ("COLLISION", layout::COLLISION),
        ("TRIANGLE", layout::TRIANGLE),
        ("FIELD_SPHERE", layout::FIELD_SPHERE),
        ("SHAPE_SEGMENT", layout::SHAPE_SEGMENT),
        ("SHAPE_CUBOID", layout::SHAPE_CUBOID),
        ("SHAPE_CYLINDER", layout::SHAPE_CYLINDER),
        ("SHAPE_CONE", layout::SHAPE_CONE),
        ("SHAPE_HALF_SPACE", layout::SHAPE_HALF_SPACE),
        ("SHAPE_HULL", layout::SHAPE_HULL),
    ] {
        text += &format!("const {name} = {value}u;\n");
    }
    for file in [
        include_str!("shaders/palette.wgsl"),
        include_str!("shaders/kernel.wgsl"),
        include_str!("shaders/curl.wgsl"),
        include_str!("shaders/part_distance.wgsl"),
        include_str!("shaders/fields.wgsl"),
        include_str!("shaders/path_line.wgsl"),
        include_str!("shaders/drag_stage.wgsl"),
        include_str!("shaders/deform.wgsl"),
        include_str!("shaders/tangent_normals.wgsl"),
    ] {
        text.push('\n');
        text += file;
    }
    text
}

/// The shaders of embedded skins in WGSL, each with the name of its entry point, in the order in which they run.
pub fn embed_shaders() -> [(&'static str, String); 2] {
    [
        ("vertex_gradients", include_str!("shaders/vertex_gradients.wgsl")),
        ("embed_vertex", include_str!("shaders/embed_vertex.wgsl")),
    ]
    .map(|(name, text)| (name, format!("const WORKGROUP = {WORKGROUP}u;\n\n{text}")))
}

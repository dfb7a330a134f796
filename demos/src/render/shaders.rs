//! The shaders, each a file, put together from the parts that they share.

macro_rules! part {
    ($name:literal) => {
        include_str!(concat!("shaders/", $name, ".wgsl"))
    };
}

macro_rules! shader {
    ($($name:literal),+) => { concat!($(part!($name), "\n"),+) };
}

/// The sun's depth map and the small depth image.
pub const CASTER: &str = shader!("view", "scene", "caster");
/// Ambient occlusion.
pub const OCCLUSION: &str = shader!("view", "occlusion");
/// Items.
pub const SURFACE: &str = shader!("view", "scene", "sky", "shadow", "shading", "surface");
/// Ground and background.
pub const GROUND: &str = shader!("view", "sky", "shadow", "shading", "ground");
/// Edges.
pub const WIRE: &str = shader!("view", "scene", "wire");
/// Lines and balls.
pub const OVERLAY: &str = shader!("view", "overlay");
/// Screen colours.
pub const TONE: &str = shader!("view", "tone");

/// Compiles a shader for a device.
pub fn module(device: &wgpu::Device, label: &str, source: &str) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [(&str, &str); 7] = [
        ("caster", CASTER),
        ("occlusion", OCCLUSION),
        ("surface", SURFACE),
        ("ground", GROUND),
        ("wire", WIRE),
        ("overlay", OVERLAY),
        ("tone", TONE),
    ];

    #[test]
    fn every_shader_is_valid() {
        for (name, source) in ALL {
            let module =
                naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(source)));
            let mut validator =
                naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
            if let Err(error) = validator.validate(&module) {
                panic!("{name}: {}", error.emit_to_string(source));
            }
        }
    }

    #[test]
    fn every_compute_shader_of_the_program_is_valid() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/program");
        let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
        let shaders: Vec<_> = files.filter(|path| path.extension().is_some_and(|e| e == "wgsl")).collect();
        assert!(shaders.len() >= 2, "{shaders:?}");
        for path in shaders {
            let text = std::fs::read_to_string(&path).unwrap();
            let module = naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
            let mut validator =
                naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
            assert!(validator.validate(&module).is_ok(), "{}", path.display());
        }
    }

    #[test]
    fn no_shader_file_is_left_out() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/render/shaders");
        for file in std::fs::read_dir(folder).unwrap() {
            let path = file.unwrap().path();
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(ALL.iter().any(|(_, source)| source.contains(text.as_str())), "{} is unused", path.display());
        }
    }
}

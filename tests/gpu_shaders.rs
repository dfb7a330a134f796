//! The shader is valid WGSL; no device is needed to know it.
#![cfg(feature = "gpu")]

use naga::ShaderStage;
use naga::valid::{Capabilities, ValidationFlags, Validator};

fn parsed() -> naga::Module {
    let text = pliant::gpu::deform_shader();
    naga::front::wgsl::parse_str(&text).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)))
}

#[test]
fn gpu_shaders_are_valid() {
    let module = parsed();
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    validator.validate(&module).unwrap_or_else(|error| panic!("{error:?}"));
}

#[test]
fn the_shader_has_one_compute_entry_point_and_stays_within_eight_storage_buffers() {
    let module = parsed();
    assert_eq!(module.entry_points.len(), 1);
    assert_eq!(module.entry_points[0].stage, ShaderStage::Compute);
    let storage = |space: &naga::AddressSpace| matches!(space, naga::AddressSpace::Storage { .. });
    let buffers = module.global_variables.iter().filter(|(_, variable)| storage(&variable.space)).count();
    assert_eq!(buffers, 4);
}

#[test]
fn the_shaders_of_embedded_skins_are_valid_and_use_four_storage_buffers_at_most() {
    for (name, text) in pliant::gpu::embed_shaders() {
        let parsed = naga::front::wgsl::parse_str(&text);
        let module = parsed.unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)));
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        validator.validate(&module).unwrap_or_else(|error| panic!("{name}: {error:?}"));
        assert_eq!(module.entry_points.len(), 1);
        assert_eq!((module.entry_points[0].name.as_str(), module.entry_points[0].stage), (name, ShaderStage::Compute));
        let storage = |space: &naga::AddressSpace| matches!(space, naga::AddressSpace::Storage { .. });
        assert!(module.global_variables.iter().filter(|(_, variable)| storage(&variable.space)).count() <= 4);
    }
}

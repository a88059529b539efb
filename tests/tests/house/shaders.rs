//! Every shader is valid and can be written for Vulkan, Metal and Direct3D.

use naga::back::{hlsl, msl, pipeline_constants::process_overrides, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use crate::modules::{self, Module, parse};

/// Validates with what WebGPU's baseline has, and no optional capability.
fn validate(module: &Module) -> Result<(naga::Module, ModuleInfo), String> {
    let parsed = parse(module);
    // WGSL has `unpack2x16float` everywhere; naga asks for it by name, since old OpenGL has not.
    let info = Validator::new(ValidationFlags::all(), Capabilities::SHADER_FLOAT16_IN_FLOAT32)
        .validate(&parsed)
        .map_err(|error| format!("{}: {}", module.name, error.emit_to_string(&module.wgsl)))?;
    Ok((parsed, info))
}

/// Writes each entry point in the three languages.
fn write_out(name: &str, parsed: &naga::Module, info: &ModuleInfo) -> Result<(), String> {
    for entry_point in &parsed.entry_points {
        let (stage, entry) = (entry_point.stage, entry_point.name.as_str());
        let failed = |language: &str, error: &dyn std::fmt::Debug| format!("{name}, {entry}, {language}: {error:?}");
        let (module, info) = process_overrides(parsed, info, Some((stage, entry)), &Default::default())
            .map_err(|error| failed("overrides", &error))?;

        let pipeline = spv::PipelineOptions { shader_stage: stage, entry_point: entry.into() };
        let words = spv::write_vec(&module, &info, &spv::Options::default(), Some(&pipeline))
            .map_err(|error| failed("SPIR-V", &error))?;
        // 2.1, of macOS 10.14: the renderer asks for invariant positions.
        let options = msl::Options { lang_version: (2, 1), fake_missing_bindings: true, ..Default::default() };
        let (metal, _) = msl::write_string(&module, &info, &options, &msl::PipelineOptions::default())
            .map_err(|error| failed("MSL", &error))?;
        let mut direct3d = String::new();
        let options = hlsl::Options { fake_missing_bindings: true, ..Default::default() };
        let pipeline = hlsl::PipelineOptions { entry_point: Some((stage, entry.into())) };
        hlsl::Writer::new(&mut direct3d, &options, &pipeline)
            .write(&module, &info, None)
            .map_err(|error| failed("HLSL", &error))?;
        if words.is_empty() || metal.is_empty() || direct3d.is_empty() {
            return Err(format!("{name}, {entry}: something was written empty"));
        }
    }
    Ok(())
}

#[test]
fn every_shader_is_valid_and_is_written_out() {
    for module in modules::all() {
        let (parsed, info) = validate(&module).unwrap_or_else(|error| panic!("{error}"));
        assert!(!parsed.entry_points.is_empty(), "{} has no entry point", module.name);
        write_out(&module.name, &parsed, &info).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn each_stage_binds_what_the_plan_lists_and_writes_what_the_library_says() {
    for stage in contrejour_gpu::stages::ALL {
        let name = stage.stage.name();
        let module = parse(&Module { name: name.into(), wgsl: stage.wgsl.into() });
        let mut writable = Vec::new();
        let mut count = 0;
        for (_, variable) in module.global_variables.iter() {
            let Some(binding) = &variable.binding else { continue };
            count += 1;
            if let naga::AddressSpace::Storage { access } = variable.space
                && access.contains(naga::StorageAccess::STORE)
            {
                writable.push(stage.stage.buffers()[binding.binding as usize]);
            }
        }
        writable.sort();
        let mut writes = stage.writes.to_vec();
        writes.sort();
        assert_eq!(count, stage.stage.buffers().len(), "{name}");
        assert_eq!(writable, writes, "{name}");
    }
}

#[test]
fn validation_finds_a_planted_fault() {
    let wgsl = "@vertex fn main() -> @location(0) vec4f { return vec4f(0.0); }";
    assert!(validate(&Module { name: "planted".into(), wgsl: wgsl.into() }).is_err());
}

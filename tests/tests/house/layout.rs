//! Shared structs and constants mean the same bytes in Rust and in WGSL.

use contrejour_layout as layout;
use contrejour_layout::{SHARED_STRUCTS, SharedStruct};
use naga::{Expression, Literal, TypeInner};

use crate::modules::{self, Module, parse, workspace};

/// Constants of the layout crate by name.
const CONSTANTS: &[(&str, u32)] = &[
    ("BLOCK_SIZE", layout::BLOCK_SIZE),
    ("FACES_PER_WORD", layout::FACES_PER_WORD),
    ("LIT_WORDS_PER_BLOCK", layout::LIT_WORDS_PER_BLOCK),
    ("OUTLINE_WORDS_PER_BLOCK", layout::OUTLINE_WORDS_PER_BLOCK),
    ("MAX_GROUPS_X", layout::MAX_GROUPS_X),
    ("VERTICES_PER_QUAD", layout::VERTICES_PER_QUAD),
    ("VERTICES_PER_CORNER", layout::VERTICES_PER_CORNER),
    ("INCIDENCE_NONE", layout::INCIDENCE_NONE),
    ("ACROSS_NOTHING", layout::ACROSS_NOTHING),
    ("ACROSS_NEVER", layout::ACROSS_NEVER),
    ("ACROSS_FAN", layout::ACROSS_FAN),
    ("FAN_UNLIT", layout::FAN_UNLIT),
    ("ACROSS_ALONG", layout::ACROSS_ALONG),
    ("ACROSS_ALONE", layout::ACROSS_ALONE),
    ("STREAM_FACE_WORDS", layout::STREAM_FACE_WORDS),
    ("HALF_STREAM_FACE_WORDS", layout::HALF_STREAM_FACE_WORDS),
    ("INCIDENCE_LIST", layout::INCIDENCE_LIST),
    ("UNLIT_FACE", layout::UNLIT_FACE),
    ("NO_CASTER", layout::NO_CASTER),
    ("INCIDENCE_ALONG", layout::INCIDENCE_ALONG),
    ("OUTLINE_NONE", layout::OUTLINE_NONE),
    ("OUTLINE_BLOCKER_LEFT", layout::OUTLINE_BLOCKER_LEFT),
    ("OUTLINE_BLOCKER_RIGHT", layout::OUTLINE_BLOCKER_RIGHT),
    ("OWN_END_LOW", layout::OWN_END_LOW),
    ("OWN_END_HIGH", layout::OWN_END_HIGH),
    ("CORNER_WEDGE", layout::CORNER_WEDGE),
    ("CORNER_CAP", layout::CORNER_CAP),
    ("MAX_SEARCHED_VALENCE", layout::MAX_SEARCHED_VALENCE),
    ("CASTER_NEVER", layout::CASTER_NEVER),
    ("CASTER_ALWAYS", layout::CASTER_ALWAYS),
    ("CASTER_IN_VIEW", layout::CASTER_IN_VIEW),
    ("BLOCK_BY_PLANES", layout::BLOCK_BY_PLANES),
    ("BLOCK_BY_POSITIONS", layout::BLOCK_BY_POSITIONS),
    ("BLOCK_MASKED", layout::BLOCK_MASKED),
    ("BLOCK_OF_CALLER", layout::BLOCK_OF_CALLER),
    ("MASK_REPEAT", layout::MASK_REPEAT),
    ("MASK_MIRROR", layout::MASK_MIRROR),
    ("MASK_CLAMP", layout::MASK_CLAMP),
    ("VIEW_CULLS", layout::VIEW_CULLS),
    ("VIEW_PANCAKES", layout::VIEW_PANCAKES),
    ("VIEW_TESTS", layout::VIEW_TESTS),
    ("MAX_SEATS", layout::MAX_SEATS),
];

/// Compares the structs of a module with those of the same names in Rust; returns the names that it has.
fn compare_structs(module: &Module) -> Result<Vec<&'static str>, String> {
    let mut names = Vec::new();
    for (_, ty) in parse(module).types.iter() {
        let (Some(name), TypeInner::Struct { members, span }) = (&ty.name, &ty.inner) else { continue };
        // The stages that count see the counters as atomics.
        let name = name.strip_prefix("Atomic").unwrap_or(name);
        let Some(shared) = SHARED_STRUCTS.iter().find(|shared| shared.name == name) else { continue };
        let wgsl = members.iter().map(|member| (member.name.as_deref().unwrap_or_default(), member.offset as usize));
        compare_fields(shared, wgsl.collect(), *span as usize).map_err(|error| format!("{}: {error}", module.name))?;
        names.push(shared.name);
    }
    Ok(names)
}

fn compare_fields(shared: &SharedStruct, wgsl: Vec<(&str, usize)>, size: usize) -> Result<(), String> {
    let rust: Vec<_> = shared.fields.iter().map(|field| (field.name, field.offset)).collect();
    if rust != wgsl || shared.size != size {
        let SharedStruct { name, size: rust_size, .. } = shared;
        return Err(format!("{name} has {rust_size} bytes {rust:?} in Rust and {size} bytes {wgsl:?} in WGSL"));
    }
    Ok(())
}

/// Compares the constants of a module with those of the same names in Rust; returns the names that it has.
fn compare_constants(module: &Module) -> Result<Vec<&'static str>, String> {
    let parsed = parse(module);
    let mut names = Vec::new();
    for (_, constant) in parsed.constants.iter() {
        let Some(&(name, rust)) = CONSTANTS.iter().find(|(name, _)| constant.name.as_deref() == Some(name)) else {
            continue;
        };
        let wgsl = match parsed.global_expressions[constant.init] {
            Expression::Literal(Literal::U32(value)) => value,
            ref other => return Err(format!("{}: {name} is {other:?}, a u32 was expected", module.name)),
        };
        if wgsl != rust {
            return Err(format!("{}: {name} is {rust} in Rust and {wgsl} in WGSL", module.name));
        }
        names.push(name);
    }
    Ok(names)
}

#[test]
fn structs_have_the_same_fields_at_the_same_offsets() {
    let mut seen = Vec::new();
    for module in modules::all() {
        seen.extend(compare_structs(&module).unwrap_or_else(|error| panic!("{error}")));
    }
    for shared in SHARED_STRUCTS {
        assert!(seen.contains(&shared.name), "{} is in no shader", shared.name);
    }
}

#[test]
fn constants_have_the_same_values() {
    let mut seen = Vec::new();
    for module in modules::all() {
        seen.extend(compare_constants(&module).unwrap_or_else(|error| panic!("{error}")));
    }
    assert!(seen.contains(&"BLOCK_SIZE") && seen.contains(&"CORNER_CAP"), "only {seen:?} were compared");
}

#[test]
fn the_table_has_every_constant_of_the_layout_crate() {
    for stem in modules::stems("crates/contrejour-layout/src", ".rs") {
        let path = workspace().join(format!("crates/contrejour-layout/src/{stem}.rs"));
        let text = std::fs::read_to_string(path).expect("the file was just listed");
        for line in text.lines().filter_map(|line| line.strip_prefix("pub const ")) {
            let Some((name, _)) = line.split_once(": u32 =") else { continue };
            assert!(CONSTANTS.iter().any(|(known, _)| *known == name), "{name} of {stem}.rs is not compared");
        }
    }
}

#[test]
fn the_comparers_find_planted_faults() {
    let module = |wgsl: &str| Module { name: "planted".into(), wgsl: wgsl.into() };
    let good = "struct WorkItem { caster: u32, block: u32, kind: u32 } const BLOCK_SIZE = 64u;";
    assert_eq!(compare_structs(&module(good)), Ok(vec!["WorkItem"]));
    assert_eq!(compare_constants(&module(good)), Ok(vec!["BLOCK_SIZE"]));
    for faulty in [
        "struct WorkItem { block: u32, caster: u32, kind: u32 }",
        "struct WorkItem { caster: u32, block: u32 }",
        "struct WorkItem { caster: u32, block: u32, kind: u32, more: u32 }",
        "struct WorkItem { caster: vec4u, block: u32, kind: u32 }",
    ] {
        assert!(compare_structs(&module(faulty)).is_err_and(|text| text.contains("WorkItem")), "{faulty}");
    }
    assert!(compare_constants(&module("const BLOCK_SIZE = 32u;")).is_err());
    assert!(compare_constants(&module("const BLOCK_SIZE = 64.0f;")).is_err());
}

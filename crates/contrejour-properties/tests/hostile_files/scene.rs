//! Scene files.

use super::{is_scene, turn};

const EYE_AND_LIGHT: &str = "camera = { eye = [3, 2, 5], target = [0, 0, 0] }\n\
    light = { kind = \"directional\", towards_light = [0, 1, 0] }\n";

fn with_mesh(mesh: &str) -> String {
    format!("{EYE_AND_LIGHT}[[mesh]]\n{mesh}\n")
}

#[test]
fn values_that_are_nested_too_deep() {
    let _turn = turn();
    for count in [1_000, 100_000] {
        let nested = [
            format!("size = {}", "[".repeat(count)),
            format!("size = {}{}", "[".repeat(count), "]".repeat(count)),
            format!("size = {}", "{a=".repeat(count)),
            format!("size = {}1{}", "{a=".repeat(count), "}".repeat(count)),
            format!("{}a = 1", "a.".repeat(count)),
            format!("[{}a]", "a.".repeat(count)),
            format!("[[{}a]]", "a.".repeat(count)),
            format!("size = {{{}a = 1}}", "a.".repeat(count)),
        ];
        for text in nested {
            assert!(!is_scene("nested", &text));
        }
    }
}

#[test]
fn numbers_of_a_million_digits() {
    let _turn = turn();
    let digits = "3".repeat(1_000_000);
    assert!(is_scene("a share", &with_mesh(&format!("shape = {{ kind = \"box\" }}\nscale = 0.{digits}"))));
    for number in [digits.clone(), format!("{digits}.0"), format!("0x{digits}"), format!("1e{digits}")] {
        assert!(!is_scene("a large number", &with_mesh(&format!("shape = {{ kind = \"box\" }}\nscale = {number}"))));
    }
}

#[test]
fn as_many_meshes_as_a_scene_may_have_and_one_more() {
    let _turn = turn();
    let meshes = |count: usize| EYE_AND_LIGHT.to_owned() + &"[[mesh]]\nfile='a.stl'\n".repeat(count);
    assert!(is_scene("many meshes", &meshes(65_536)));
    assert!(!is_scene("one more", &meshes(65_537)));
}

/// Found by fuzzing: what a short text makes before its last line is refused.
#[test]
fn shapes_before_a_fault() {
    let _turn = turn();
    let refused = |what: &str, shapes: &str| {
        assert!(!is_scene(what, &format!("{EYE_AND_LIGHT}{shapes}[[mesh]]\nfile='missing.ply'")));
    };
    for kind in ["plane", "box", "cylinder", "sphere", "torus", "knot", "fence", "elephant"] {
        refused(kind, &format!("[[mesh]]\nshape.kind='{kind}'\n"));
    }
    let knot = |index| format!("[[mesh]]\nshape={{kind='knot',radius={index}}}\n");
    refused("knots of their own", &(1..=10).map(knot).collect::<String>());
}

#[test]
fn shapes_of_more_triangles_than_a_scene_may_have() {
    let _turn = turn();
    // Each has 4 192 704 triangles, under the most for one.
    let shape = "shape = { kind = \"torus\", segments = 65_000, sides = 32 }\n";
    let scene = EYE_AND_LIGHT.to_owned() + &format!("[[mesh]]\n{shape}").repeat(6);
    let error = contrejour_scene::Scene::from_toml(&scene, std::path::Path::new(""), "many.toml");
    let message = error.map(|_| ()).expect_err("is too much").to_string();
    assert!(message.contains("more than 16777216 triangles"), "{message}");
}

#[test]
fn text_that_is_none() {
    let _turn = turn();
    for text in ["\0", "size = \"\0\"", "\u{feff}", "a = '''", "a = \"\\uD800\"", "= 1", "[mesh", "\u{85}"] {
        assert!(!is_scene(text, text));
    }
    assert!(!is_scene("one long line", &format!("# {}", "x".repeat(10_000_000))));
}

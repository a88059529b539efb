//! The verifier must see what is wrong: each check is shown a fault.

use contrejour_plan::Light;
use contrejour_scene::Camera;

use super::pictures::{SIZE, differing_texels};
use super::*;
use crate::stress::StressOptions;
use crate::stress::pictures::PictureMoment;
use crate::stress::run::settle;
use crate::test_device::device;

#[test]
fn a_wrong_edge_a_missing_one_and_a_wrong_side_are_found() {
    let options = StressOptions { casters: 4, triangles_per_caster: 200, ..StressOptions::default() };
    let world = World::new(&options).expect("the options are good");
    let verifier = Verifier::new(&world);
    let light = CasterLight { light_object: [2.0_f32, 3.0, 0.5, 1.0].map(f32::to_bits), ..CasterLight::default() };
    let lit = verifier.rigid.lit_faces(light.light_object.map(f32::from_bits), false);
    let edge_id = |edge: &OracleEdge| {
        let is_it = |known: &contrejour_layout::Edge| [known.low_vertex, known.high_vertex] == [edge.low, edge.high];
        world.mesh.edges.iter().position(is_it).expect("the oracle knows the mesh's edges") as u32
    };
    let sound: Vec<_> = (verifier.rigid.silhouette(&lit).iter())
        .map(|edge| SilhouetteEdge {
            caster: 0,
            edge_id: edge_id(edge),
            left: edge.left.cast_unsigned(),
            right: edge.right.cast_unsigned(),
        })
        .collect();
    let passes = |edges: &[SilhouetteEdge]| verifier.has_silhouette(&verifier.rigid, &light, 0, edges);
    assert!(sound.len() > 10 && passes(&sound));

    let with = |fault: fn(&mut Vec<SilhouetteEdge>)| {
        let mut faulty = sound.clone();
        fault(&mut faulty);
        faulty
    };
    assert!(!passes(&with(|edges| edges.truncate(edges.len() - 1))));
    assert!(!passes(&with(|edges| edges.push(edges[0]))));
    assert!(!passes(&with(|edges| (edges[3].left, edges[3].right) = (edges[3].right, edges[3].left))));
    assert!(!passes(&with(|edges| edges[5].edge_id ^= 1)));
}

/// A light of each kind, the last one with cascades, over casters of which one deforms.
fn world() -> World {
    let settings = contrejour_plan::ShadowSettings { map_size: 48, ..Default::default() };
    let options =
        StressOptions { lights: 6, casters: 4, triangles_per_caster: 100, settings, ..StressOptions::default() };
    World::new(&options).expect("the options are good")
}

const FRAME: u64 = 40;

/// The world as it is in a frame but for what `tamper` does, drawn.
fn placed(gpu: &Gpu, world: &World, tamper: impl FnOnce(&mut Placed)) -> Placed {
    let mut placed = world.place(gpu, 0).expect("the device allows it");
    settle(gpu, &mut placed).expect("it can be drawn");
    placed.walk(gpu, &world.moment(FRAME)).expect("it can move");
    tamper(&mut placed);
    settle(gpu, &mut placed).expect("it can be drawn");
    placed
}

#[test]
fn a_sound_frame_has_no_difference() {
    let Some(gpu) = device() else { return };
    let world = world();
    let mut placed = placed(&gpu, &world, |_| ());
    let mut verifier = Verifier::new(&world);
    verifier.check(&gpu, &mut placed, FRAME).expect("the device works");
    assert_eq!((verifier.differences, &verifier.first_difference), (0, &None));
    assert_eq!((verifier.light_frames, verifier.texels), (6, 128 * 72));
}

#[test]
fn what_stands_elsewhere_is_found_in_maps_and_lists() {
    let Some(gpu) = device() else { return };
    let world = world();
    let later = world.moment(FRAME + 9);
    type Tamper<'a> = Box<dyn Fn(&mut Placed) + 'a>;
    let moved_light = |index: usize| -> Tamper<'_> {
        let light = world.lights(FRAME + 9).nth(index).expect("there are six lights");
        Box::new(move |placed| placed.shadows.set_light(placed.lights[index], &light).expect("it is good"))
    };
    let faults: [(&str, Tamper<'_>); 6] = [
        ("a spot", moved_light(0)),
        ("a lamp", moved_light(1)),
        ("a sun", moved_light(2)),
        ("a sun with cascades", moved_light(5)),
        (
            "the eye",
            Box::new(|placed| {
                let eye = world.eye(FRAME + 200);
                placed.shadows.set_eye(placed.lights[5], &eye).expect("it is good");
            }),
        ),
        (
            "a caster",
            Box::new(|placed| {
                let place = world.casters(FRAME + 9).next().expect("there are four");
                placed.shadows.place_caster(placed.casters[0], &place).expect("it is there");
            }),
        ),
    ];
    for (what, tamper) in faults {
        let mut placed = placed(&gpu, &world, tamper);
        let [mut of_maps, mut of_lists] = [(); 2].map(|()| Verifier::new(&world));
        of_maps.check_maps(&gpu, &placed, FRAME).expect("the device works");
        of_lists.check_lists(&gpu, &mut placed, FRAME).expect("the device works");
        assert!(of_maps.differences > 0, "{what} elsewhere leaves no trace in maps");
        // Where cascades are does not change which light a caster sees.
        assert!(of_lists.differences > 0 || what == "the eye", "{what} elsewhere leaves no trace in lists");
    }
    // Out of every view, and so culled.
    let mut placed_far = placed(&gpu, &world, |placed| {
        let far = DMat4::from_translation(DVec3::splat(1e4));
        placed.shadows.place_caster(placed.casters[0], &far).expect("it is there");
    });
    let mut verifier = Verifier::new(&world);
    verifier.check_lists(&gpu, &mut placed_far, FRAME).expect("the device works");
    assert_eq!(verifier.first_difference.as_deref().map(|told| told.contains("caster 0 is left out")), Some(true));
    // A pose of another frame.
    let placed = placed(&gpu, &world, |placed| placed.walk(&gpu, &later).expect("it can move"));
    let mut verifier = Verifier::new(&world);
    verifier.deformed(&gpu, &placed, FRAME).expect("the device works");
    assert_eq!(verifier.first_difference.as_deref().map(|told| told.contains("deformed position")), Some(true));
}

#[test]
fn what_is_elsewhere_is_found_in_pictures() {
    let Some(gpu) = device() else { return };
    let world = world();
    let now = PictureMoment::new(&world, FRAME);
    let later = PictureMoment::new(&world, FRAME + 9);
    let mut walked = Pictures::new(gpu.clone(), &world, 0, SIZE).expect("the device allows it");
    let mut differing = |tamper: &dyn Fn(&mut Pictures)| {
        walked.follow(&now).expect("it can move");
        tamper(&mut walked);
        differing_texels(&gpu, &world, &mut walked, FRAME).expect("the device works")
    };
    assert_eq!(differing(&|_| ()), 0);
    let set = |index: usize, light: Light| {
        move |pictures: &mut Pictures| pictures.renderer.set_light(index, &light).expect("it is good")
    };
    for index in 0..6 {
        assert!(differing(&set(index, later.lights[index])) > 0, "light {index} elsewhere");
        let dimmed = Light { color: now.lights[index].color.map(|x| 0.9 * x), ..now.lights[index] };
        assert!(differing(&set(index, dimmed)) > 0, "light {index} of another colour");
    }
    let camera = Camera { eye: now.camera.eye + 0.01 * DVec3::X, ..now.camera };
    assert!(differing(&|pictures| pictures.renderer.set_camera(&camera)) > 0, "another eye");
    assert!(differing(&|pictures| pictures.follow(&later).expect("it can move")) > 0, "a later frame");
    assert_eq!(differing(&|_| ()), 0);
}

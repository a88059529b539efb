//! Every technique on every scene.

use std::path::Path;

use contrejour_plan::{DepthPrecision, ShadowSettings, Technique};
use contrejour_scene::{BUILT_IN_SCENES, Scene};
use contrejour_tests::harness::Outcome;

use super::judged_scene::{Care, JudgedScene, plates, rmse, settings, text_of};

const SIZE: [u32; 2] = [120, 80];
const MAP_SIZE: u32 = 512;

/// The error of drawing no shadow at all is the measure. A shadow that is missing or in the wrong place has about as much;
/// techniques have at most 0.37 of it here.
const MOST_OF_NO_SHADOW: f64 = 0.5;

pub fn all_come_near_the_truth() -> Outcome {
    for built_in in BUILT_IN_SCENES {
        let scene = built_in.load().map_err(text_of)?;
        compare(built_in.name, scene, &Technique::NAMES)?;
    }
    // A shadow that a bias swallowed is found.
    let scene = BUILT_IN_SCENES[0].load().map_err(text_of)?;
    let scene = judged(scene)?;
    let mut swallowed = settings("pcf", &[], MAP_SIZE);
    swallowed.bias.constant_texels = 2000.0;
    let truth = scene.truth(scene.light(), Care::Coarse)?;
    match near(&scene, &truth, &swallowed) {
        Err(_) => Ok(()),
        Ok(()) => Err("no shadow at all passes".into()),
    }
}

pub fn real_meshes(folder: &Path) -> Outcome {
    for name in ["closed/kitten.obj", "closed/mengerSponge3.glb", "open/EZ_Control_valve.obj"] {
        compare(name, Scene::open(&folder.join(name)).map_err(text_of)?, &Technique::NAMES)?;
    }
    Ok(())
}

fn judged(mut scene: Scene) -> Result<JudgedScene, String> {
    scene.resize(SIZE);
    JudgedScene::new(scene)
}

fn compare(name: &str, scene: Scene, techniques: &[&str]) -> Outcome {
    let scene = judged(scene)?;
    let truth = scene.truth(scene.light(), Care::Coarse)?;
    for technique in techniques {
        near(&scene, &truth, &settings(technique, &[], MAP_SIZE)).map_err(|error| format!("{name}: {error}"))?;
    }
    Ok(())
}

fn near(scene: &JudgedScene, truth: &[f64], settings: &ShadowSettings) -> Outcome {
    let found = scene.visibility(settings)?;
    let (error, without) = (rmse(&found, truth), rmse(&vec![1.0; truth.len()], truth));
    println!("{}: {error:.3} of {without:.3}", settings.technique);
    if error < MOST_OF_NO_SHADOW * without {
        return Ok(());
    }
    Err(format!("{}: an error of {error:.3}, and {without:.3} without any shadow", settings.technique))
}

/// 16-bit depth is off by 2^-11 of itself, which moves a receiver's comparison by less than the bias.
pub fn halves_are_nearly_floats() -> Outcome {
    let mut scene = plates(&[("[1.4, 1.2]", "[0.1, 1.6, 0]")])?;
    scene.keep_floor();
    for technique in ["smoothies", "vsm", "evsm"] {
        let floats = settings(technique, &[], MAP_SIZE);
        let halves = ShadowSettings { depth_precision: DepthPrecision::Bits16, ..floats };
        let (floats, halves) = (scene.visibility(&floats)?, scene.visibility(&halves)?);
        let error = rmse(&halves, &floats);
        if error == 0.0 || error > 0.02 {
            return Err(format!("{technique}: 16 bits differ by {error:.4} from 32"));
        }
    }
    Ok(())
}

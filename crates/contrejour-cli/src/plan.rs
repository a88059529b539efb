//! `contrejour plan`: what a frame of a scene does, and what it leaves out and why.

use contrejour_plan::{DeviceFacts, FramePlan};
use contrejour_render::{Gpu, LightPlan, frame_plans};
use contrejour_scene::Scene;
use serde::Serialize;

use crate::args::PlanArguments;
use crate::failure::{Failure, one_line};
use crate::output::{print, warn};
use crate::scenes;

#[derive(Serialize)]
struct DevicePlan {
    /// `null` where there is no device.
    device: Option<String>,
    lights: Vec<PlanOfLight>,
}

#[derive(Serialize)]
struct PlanOfLight {
    /// Its place among the scene's lights, from 1.
    light: usize,
    name: String,
    plan: FramePlan,
}

pub fn run(arguments: &PlanArguments) -> Result<(), Failure> {
    let mut scene = scenes::open(arguments.scene.as_deref())?;
    arguments.shadow.apply_to_lights(&mut scene)?;
    let (device, facts) = match Gpu::open() {
        Ok(gpu) => (Some(gpu.description()), gpu.facts()),
        Err(error) => {
            warn(&format!("{}; the plan is for a device with WebGPU's defaults", one_line(&error)));
            (None, DeviceFacts::default())
        }
    };
    let lights: Vec<_> = frame_plans(&scene, &facts)?.into_iter().map(|plan| of_light(&scene, plan)).collect();
    print(&if arguments.json {
        serde_json::to_string_pretty(&DevicePlan { device, lights })?
    } else {
        told(&scene, device.as_deref().unwrap_or("none, WebGPU's defaults"), &lights)
    })
}

fn of_light(scene: &Scene, LightPlan { light, plan }: LightPlan) -> PlanOfLight {
    let name = scene.lights.get(light).map(|light| light.name.clone()).unwrap_or_default();
    PlanOfLight { light: light + 1, name, plan }
}

/// The plans one after the other, each under its light's name where there are several lights.
fn told(scene: &Scene, device: &str, lights: &[PlanOfLight]) -> String {
    let mut text = format!("device: {device}\n");
    for PlanOfLight { light, name, plan } in lights {
        if scene.lights.len() > 1 {
            text += &format!("\nlight {light}, {name}\n");
        }
        text += &plan.to_string();
    }
    let without_shadow = scene.lights.iter().zip(1..).filter(|(light, _)| !light.casts);
    for (light, number) in without_shadow {
        text += &format!("\nlight {number}, {}, throws no shadow\n", light.name);
    }
    text
}

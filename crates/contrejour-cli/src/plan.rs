//! `contrejour plan`: what a frame of a scene does, and what it leaves out and why.

use contrejour_plan::{DeviceFacts, FramePlan};
use contrejour_render::{Gpu, frame_plan};
use serde::Serialize;

use crate::args::PlanArguments;
use crate::failure::{Failure, one_line};
use crate::output::{print, warn};
use crate::scenes;

#[derive(Serialize)]
struct DevicePlan {
    /// `null` where there is no device.
    device: Option<String>,
    plan: FramePlan,
}

pub fn run(arguments: &PlanArguments) -> Result<(), Failure> {
    let scene = scenes::open(arguments.scene.as_deref())?;
    let settings = arguments.shadow.applied_to(scene.first_light()?.shadow)?;
    let (device, facts) = match Gpu::open() {
        Ok(gpu) => (Some(gpu.description()), gpu.facts()),
        Err(error) => {
            warn(&format!("{}; the plan is for a device with WebGPU's defaults", one_line(&error)));
            (None, DeviceFacts::default())
        }
    };
    let plan = frame_plan(&scene, &settings, &facts)?;
    print(&if arguments.json {
        serde_json::to_string_pretty(&DevicePlan { device, plan })?
    } else {
        format!("device: {}\n{plan}", device.as_deref().unwrap_or("none, WebGPU's defaults"))
    })
}

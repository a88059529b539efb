//! Nothing is created that the frame plan does not list; wgpu's own counters are the witness.

use contrejour_gpu::ShadowOptions;
use contrejour_plan::{
    BufferKind, EntryPoints, FramePlan, Light, LightKind, Outputs, PipelinePlan, ShadowSettings, Technique,
};
use contrejour_tests::gpu::{Gpu, gpu_alone};
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::point;
use contrejour_tests::meshes::{TestMesh, shapes, tiny};
use contrejour_tests::pipeline::Pipeline;
use glam::DVec3;
use libtest_mimic::Trial;

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("left_out::only_what_the_plan_lists_is_created", |_| only_what_the_plan_lists_is_created())]
}

/// What is on the device. Buffers are looked at one by one: wgpu makes and keeps some for uploads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Census {
    /// Memory of textures: of these themselves wgpu's Vulkan backend counts none.
    texture_bytes: u64,
    compute_pipelines: u64,
    render_pipelines: u64,
}

impl Census {
    fn of_device(gpu: &Gpu) -> Self {
        let counters = gpu.device.get_internal_counters().hal;
        let count = |counter: isize| u64::try_from(counter).expect("counters of what is there are not negative");
        Self {
            texture_bytes: count(counters.texture_memory.read()),
            compute_pipelines: count(counters.compute_pipelines.read()),
            render_pipelines: count(counters.render_pipelines.read()),
        }
    }

    fn of_plan(plan: &FramePlan) -> Self {
        let is_compute = |pipeline: &&PipelinePlan| matches!(pipeline.entry_points, EntryPoints::Compute(_));
        let compute_pipelines = plan.pipelines.iter().filter(is_compute).count() as u64;
        Self {
            texture_bytes: plan.textures.iter().map(|texture| texture.bytes).sum(),
            compute_pipelines,
            render_pipelines: plan.pipelines.len() as u64 - compute_pipelines,
        }
    }

    /// Without what wgpu made for itself.
    fn since(&self, before: &Self) -> Self {
        Self {
            texture_bytes: self.texture_bytes - before.texture_bytes,
            compute_pipelines: self.compute_pipelines - before.compute_pipelines,
            render_pipelines: self.render_pipelines - before.render_pipelines,
        }
    }

    /// The same pipelines, and textures as large as listed, up to what a driver adds to each.
    fn is_as_planned(&self, planned: &Self) -> bool {
        let extra = self.texture_bytes.checked_sub(planned.texture_bytes);
        extra.is_some_and(|extra| extra <= planned.texture_bytes / 4)
            && self.compute_pipelines == planned.compute_pipelines
            && self.render_pipelines == planned.render_pipelines
    }
}

fn only_what_the_plan_lists_is_created() -> Outcome {
    let with = |technique| ShadowOptions {
        settings: ShadowSettings { technique, ..Default::default() },
        ..Default::default()
    };
    let soft = light();
    let mut hard = soft;
    if let LightKind::Spot { radius, .. } = &mut hard.kind {
        *radius = 0.0;
    }
    let shape = shapes().swap_remove(1);
    let nothing = tiny().swap_remove(0);
    let silhouettes = ShadowOptions { outputs: Outputs::Silhouettes, ..Default::default() };
    let scenes: [(&str, &TestMesh, ShadowOptions, Light); 5] = [
        ("smoothies", &shape, ShadowOptions::default(), soft),
        ("a light of zero size", &shape, ShadowOptions::default(), hard),
        ("a shadow map", &shape, with(Technique::ShadowMap), soft),
        ("silhouettes alone", &shape, silhouettes, soft),
        ("no face", &nothing, ShadowOptions::default(), soft),
    ];
    let mut different = Vec::new();
    for (name, mesh, options, light) in scenes {
        let census = census(mesh, &options, &light).map_err(|error| format!("{name}: {error}"))?;
        if !different.contains(&census) {
            different.push(census);
        }
    }
    if different.len() >= 3 { Ok(()) } else { Err(format!("all scenes create the same: {different:?}")) }
}

fn light() -> Light {
    point(DVec3::new(3.0, 4.0, 2.0), DVec3::ZERO, 1.5)
}

/// What one scene creates, which is what its plan lists.
fn census(mesh: &TestMesh, options: &ShadowOptions, light: &Light) -> Result<Census, String> {
    let gpu = gpu_alone()?;
    let before = Census::of_device(&gpu);
    let mut pipeline = Pipeline::new(&gpu, mesh, options)?;
    pipeline.complete_frame(light)?;
    let created = Census::of_device(&gpu).since(&before);
    let plan = pipeline.plan().ok_or("a prepared frame has a plan")?;
    let planned = Census::of_plan(plan);
    if !created.is_as_planned(&planned) {
        return Err(format!("created {created:?}, planned {planned:?}"));
    }
    check_buffers(&pipeline, plan)?;
    Ok(created)
}

/// Each buffer that the plan lists is there in its size, and no other.
fn check_buffers(pipeline: &Pipeline<'_>, plan: &FramePlan) -> Outcome {
    for kind in BufferKind::ALL {
        let listed: Vec<_> =
            plan.buffers.iter().filter(|buffer| buffer.kind == kind).map(|buffer| buffer.bytes).collect();
        let made: Vec<_> = pipeline.shadows.buffers(kind).map(|part| part.buffer().size()).collect();
        if listed != made {
            return Err(format!("{kind:?} is listed with {listed:?} bytes and made with {made:?}"));
        }
    }
    Ok(())
}

//! `contrejour stress`: many moving lights over many moving casters.

use std::collections::BTreeMap;
use std::process::ExitCode;
use std::time::Duration;

use contrejour_lab::report::PlotUse;
use contrejour_lab::stress::{
    Event, LightMix, LightSummary, Motion, StressOptions, Summary, Variety, run as run_one, sweep,
};
use contrejour_plan::ShadowSettings;
use contrejour_render::{Gpu, check_folder, save_file};

use crate::failure::Failure;
use crate::output::{print, warn};
use crate::report_progress::Progress;
use crate::stress_args::StressArguments;

/// A difference is no bad input.
const DIFFERENCE_FOUND: u8 = 1;

pub fn run(arguments: &StressArguments) -> Result<ExitCode, Failure> {
    // Lights of all kinds have settings of their own, but for those that are given.
    let own = |is_given: bool| match arguments.kind {
        LightMix::Mixed if !is_given => Variety::Own,
        _ => Variety::Same,
    };
    let options = StressOptions {
        lights: arguments.lights,
        kind: arguments.kind,
        casters: arguments.casters,
        triangles_per_caster: arguments.triangles_per_caster,
        motion: if arguments.still { Motion::Still } else { Motion::Walking },
        duration: Duration::from_secs_f64(arguments.seconds),
        settings: arguments.shadow.applied_to(ShadowSettings::default())?,
        techniques: own(arguments.shadow.has_technique()),
        map_sizes: own(arguments.shadow.has_map_size()),
        softness: own(false),
        verify: arguments.verify,
        seed: arguments.seed,
        ..StressOptions::default()
    };
    #[cfg(feature = "window")]
    if arguments.window {
        print(&told(arguments, &[crate::stress_window::run(&options)?])?)?;
        return Ok(ExitCode::SUCCESS);
    }
    if arguments.sweep.is_some() {
        check_folder(&arguments.output)?;
    }
    let gpu = Gpu::open()?;
    let progress = Progress::new();
    let show = |event: Event| show(&progress, event);
    let runs = match arguments.sweep {
        None => run_one(&gpu, &options, &show).map(|summary| vec![summary]),
        Some(axis) => match sweep(&gpu, axis, &options, &show) {
            Ok(swept) => {
                let file = |ending: &str| arguments.output.join(format!("stress-{axis}.{ending}"));
                save_file(swept.csv().as_bytes(), &file("csv"))?;
                let svg = swept.plot().to_svg(&format!("Time of a frame against {axis}"), PlotUse::File)?;
                save_file(svg.as_bytes(), &file("svg"))?;
                Ok(swept.runs)
            }
            Err(error) => Err(error),
        },
    };
    progress.done();
    let runs = runs?;
    print(&told(arguments, &runs)?)?;
    let found = runs.iter().find_map(|run| run.first_difference.as_ref());
    if let Some(difference) = found {
        warn(difference);
    }
    Ok(if found.is_none() { ExitCode::SUCCESS } else { ExitCode::from(DIFFERENCE_FOUND) })
}

/// Steps of the bar of a run.
const PROGRESS_STEPS: u64 = 1000;

fn show(progress: &Progress, event: Event) {
    let Event::Frame { frames, cpu_ms, verified_light_frames, done } = event;
    if frames == 1 {
        progress.begin(String::new(), PROGRESS_STEPS);
    }
    progress.reach((done * PROGRESS_STEPS as f64) as u64);
    progress.say(format!("frame {frames}: CPU {cpu_ms:.3} ms, {verified_light_frames} light-frames verified"));
}

fn told(arguments: &StressArguments, runs: &[Summary]) -> Result<String, Failure> {
    if arguments.json {
        return Ok(match runs {
            [run] if arguments.sweep.is_none() => serde_json::to_string_pretty(run)?,
            runs => serde_json::to_string_pretty(runs)?,
        });
    }
    Ok(runs.iter().map(table).collect::<Vec<_>>().join("\n\n"))
}

/// A compact table of a run.
fn table(run: &Summary) -> String {
    let Summary { lights, views, casters, triangles_per_caster, seed, frames, .. } = run;
    let mut lines = vec![
        format!("device     {}", run.device),
        format!(
            "scene      {lights} lights ({views} views), {casters} casters of {triangles_per_caster} triangles, seed {seed}"
        ),
        format!("shadows    {}", shadows(&run.light_settings)),
        format!("frames     {frames}, {:.1} ms each on the wall", run.wall_ms_per_frame),
        format!(
            "CPU        {:.3} ms a frame: {:.3} upload, {:.3} record, {:.3} submit",
            run.cpu_ms_per_frame, run.cpu_upload_ms, run.cpu_record_ms, run.cpu_submit_ms
        ),
        format!(
            "commands   {} draws, {} dispatches, {} bytes uploaded",
            run.draws_recorded, run.dispatches_recorded, run.upload_bytes_per_frame
        ),
        format!(
            "work       {} faces, {} edges tested, {} in silhouettes",
            run.faces_tested, run.edges_tested, run.silhouette_edges
        ),
        format!("lights     {} redone, {} kept", run.lights_redone, run.lights_kept),
        format!(
            "memory     {:.1} MiB of maps and lists, {} overflows",
            mebibytes(run.memory_bytes),
            run.overflow_frames
        ),
    ];
    if let [Some(early), Some(late)] = [run.resident_bytes_early, run.resident_bytes_late] {
        lines.push(format!("program    {:.1} MiB early, {:.1} MiB late", mebibytes(early), mebibytes(late)));
    }
    if run.verified_light_frames > 0 {
        lines.push(format!(
            "verified   {} light-frames, {} texels of pictures, {} differences",
            run.verified_light_frames, run.verified_texels, run.differences
        ));
    }
    lines.extend(run.stages.iter().map(|stage| format!("  {:<34} {:.3} ms", stage.name, stage.gpu_ms)));
    lines.join("\n")
}

/// How many lights have which technique, and the sizes of their maps.
fn shadows(lights: &[LightSummary]) -> String {
    let mut counts = BTreeMap::new();
    for light in lights {
        *counts.entry(light.technique).or_insert(0) += 1;
    }
    let techniques: Vec<_> = counts.iter().map(|(technique, count)| format!("{count} {technique}")).collect();
    let sizes = || lights.iter().map(|light| light.map_size);
    match (sizes().min(), sizes().max()) {
        (Some(least), Some(most)) if least < most => {
            format!("{}; maps of {least} to {most} texels", techniques.join(", "))
        }
        (Some(size), _) => format!("{}; maps of {size} texels", techniques.join(", ")),
        (None, _) => "none".to_owned(),
    }
}

fn mebibytes(bytes: u64) -> f64 {
    bytes as f64 / 1_048_576.0
}

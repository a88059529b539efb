//! Trials for tests that need the GPU.

use std::path::Path;
use std::process::ExitCode;

use libtest_mimic::{Arguments, Completion, Failed, Trial};

use crate::gpu::{Gpu, gpu, gpu_blending_floats, is_required};
use crate::meshes::shared_folder;

/// What a test returns: the first difference, in words.
pub type Outcome = Result<(), String>;

/// A test that needs the device. Without one it is ignored with the reason, or fails where a device is required.
pub fn gpu_trial(name: impl Into<String>, test: impl FnOnce(&'static Gpu) -> Outcome + Send + 'static) -> Trial {
    Trial::ignorable_test(name, move || on_gpu(test))
}

/// A test that needs a device that blends 32-bit floats. Without the feature it is ignored with the reason.
pub fn float_blending_trial(
    name: impl Into<String>,
    test: impl FnOnce(&'static Gpu) -> Outcome + Send + 'static,
) -> Trial {
    Trial::ignorable_test(name, move || {
        on_gpu(|_| Ok(()))?;
        match gpu_blending_floats() {
            Ok(gpu) => test(gpu).map(|()| Completion::Completed).map_err(Failed::from),
            Err(reason) => Ok(Completion::ignored_with(reason)),
        }
    })
}

/// A test that needs the device and the folder of real meshes. Without the folder it is ignored with the reason.
pub fn mesh_trial(
    name: impl Into<String>,
    test: impl FnOnce(&'static Gpu, &Path) -> Outcome + Send + 'static,
) -> Trial {
    Trial::ignorable_test(name, move || on_folder(shared_folder().as_deref(), |folder| on_gpu(|gpu| test(gpu, folder))))
}

/// A test that needs no device, beside tests that do.
pub fn cpu_trial(name: impl Into<String>, test: impl FnOnce() -> Outcome + Send + 'static) -> Trial {
    Trial::test(name, move || test().map_err(Failed::from))
}

fn on_gpu(test: impl FnOnce(&'static Gpu) -> Outcome) -> Result<Completion, Failed> {
    match gpu() {
        Ok(gpu) => test(gpu).map(|()| Completion::Completed).map_err(Failed::from),
        Err(reason) => without_gpu(reason, is_required()),
    }
}

fn on_folder(
    folder: Option<&Path>,
    test: impl FnOnce(&Path) -> Result<Completion, Failed>,
) -> Result<Completion, Failed> {
    folder.map_or_else(|| Ok(Completion::ignored_with("no folder of real meshes")), test)
}

fn without_gpu(reason: &str, required: bool) -> Result<Completion, Failed> {
    if required {
        return Err(Failed::from(format!("a device is required, and there is {reason}")));
    }
    Ok(Completion::ignored_with(reason))
}

/// Runs the trials as `cargo test` expects; says on which adapter.
pub fn run(trials: Vec<Trial>) -> ExitCode {
    let arguments = Arguments::from_args();
    if !arguments.list {
        match gpu() {
            Ok(gpu) => eprintln!("adapter: {}", gpu.adapter),
            Err(reason) => eprintln!("GPU tests cannot run: {reason}"),
        }
    }
    libtest_mimic::run(&arguments, trials).exit_code()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_adapter_is_never_a_pass() {
        let ignored = without_gpu("no adapter", false).expect("ignored, and not failed");
        assert!(matches!(ignored, Completion::Ignored { reason: Some(reason) } if reason == "no adapter"));
        let failed = without_gpu("no adapter", true).err().expect("fails where a GPU is required");
        assert!(failed.message().is_some_and(|message| message.contains("no adapter")));
    }

    #[test]
    fn a_missing_folder_is_never_a_pass() {
        let ignored = on_folder(None, |_| Ok(Completion::Completed)).expect("ignored, and not failed");
        assert!(matches!(ignored, Completion::Ignored { reason: Some(reason) } if reason.contains("no folder")));
        let run = on_folder(Some(Path::new("meshes")), |_| Ok(Completion::Completed)).expect("is run");
        assert!(matches!(run, Completion::Completed));
    }
}

//! Files that are made to break a loader: refused with a reason or loaded, within a bound of memory and of time.

mod gltf;
mod obj;
mod picture;
mod ply_stl;
mod scene;

use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use contrejour_mesh::{LoadError, ReadFileError, load_bytes};
use contrejour_properties::{Format, check_mesh_file, check_scene_text, most_bytes_of_mesh_file, most_bytes_of_scene};
use peak_alloc::PeakAlloc;

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// All memory is counted, so each test waits for its turn.
fn turn() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What takes more time than a file's size deserves takes minutes on these files.
const MOST_TIME: Duration = Duration::from_secs(120);

fn measured<T>(what: &str, run: impl FnOnce() -> T) -> (T, usize) {
    HEAP.reset_peak_usage();
    let before = HEAP.current_usage();
    let start = Instant::now();
    let result = run();
    let time = start.elapsed();
    assert!(time < MOST_TIME, "{what} took {time:?}");
    (result, HEAP.peak_usage().saturating_sub(before))
}

/// Checks a file with its memory and its time; whether it loads.
fn loads(what: &str, format: Format, bytes: &[u8]) -> bool {
    let (loaded, held) = measured(what, || check_mesh_file(format, bytes));
    let most = most_bytes_of_mesh_file(format, bytes.len(), loaded);
    assert!(held <= most, "{what}: {} bytes held {held} bytes, the bound is {most}", bytes.len());
    loaded.is_some()
}

/// Why a file is refused, after checking it with its memory and its time.
fn refusal(what: &str, format: Format, bytes: &[u8]) -> LoadError {
    assert!(!loads(what, format, bytes), "{what} loads");
    let name = format!("hostile.{format:?}");
    let no_file = |path: &Path| Err(ReadFileError::NotAFile { path: path.into() }.into());
    load_bytes(bytes, Path::new(&name), &no_file).err().unwrap_or_else(|| panic!("{what} loads without its files"))
}

/// Checks a scene file with its memory and its time; whether it is a scene.
fn is_scene(what: &str, text: &str) -> bool {
    let (triangles, held) = measured(what, || check_scene_text(text));
    let most = most_bytes_of_scene(text.len(), triangles);
    assert!(held <= most, "{what}: {} bytes held {held} bytes, the bound is {most}", text.len());
    triangles.is_some()
}

//! Memory that an input takes, and one thread for all of it.

use contrejour_properties::{Format, check_mesh_file, most_bytes_of_mesh_file};
use peak_alloc::PeakAlloc;

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// Keeps rayon on this thread: a fuzzer counts what one thread covers, and memory must not hang on timing.
///
/// # Panics
///
/// When the thread pool is there already.
pub fn run_on_one_thread() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    pool.build_global().unwrap_or_else(|error| panic!("{error}"));
}

/// What `run` gives, and the most bytes that it held at once.
pub fn most_bytes_held<T>(run: impl FnOnce() -> T) -> (T, usize) {
    HEAP.reset_peak_usage();
    let before = HEAP.current_usage();
    let result = run();
    (result, HEAP.peak_usage().saturating_sub(before))
}

/// Checks bytes as a mesh file, its memory included.
///
/// # Panics
///
/// When the property does not hold, or when more memory was held than its bound.
pub fn check_file(format: Format, bytes: &[u8]) {
    let (loaded, held) = most_bytes_held(|| check_mesh_file(format, bytes));
    let most = most_bytes_of_mesh_file(format, bytes.len(), loaded);
    assert!(held <= most, "{} bytes of {format:?} held {held} bytes, the bound is {most}", bytes.len());
}

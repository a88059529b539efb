//! What the fuzz targets share.

mod measure;

pub use measure::{check_file, most_bytes_held, run_on_one_thread};

//! A scene file.
#![no_main]

use contrejour_fuzz::{most_bytes_held, run_on_one_thread};
use contrejour_properties::{check_scene_text, most_bytes_of_scene};
use libfuzzer_sys::{Corpus, fuzz_target};

/// Counts of more digits make shapes of millions of triangles; that these are bounded is a test of its own.
const MOST_DIGITS: usize = 2;

const COUNTS: [&str; 4] = ["segments", "sides", "columns", "rows"];

fuzz_target!(init: run_on_one_thread(), |text: &str| -> Corpus {
    if COUNTS.iter().any(|count| text.split(count).skip(1).any(starts_with_a_large_number)) {
        return Corpus::Reject;
    }
    let (triangles, held) = most_bytes_held(|| check_scene_text(text));
    let most = most_bytes_of_scene(text.len(), triangles);
    assert!(held <= most, "{} bytes of text held {held} bytes, the bound is {most}", text.len());
    Corpus::Keep
});

/// Whether the value that follows a key is long.
fn starts_with_a_large_number(rest: &str) -> bool {
    let value = rest.trim_start_matches([' ', '\t', '"', '\'', '=', '+']);
    value.find(|char: char| !char.is_ascii_alphanumeric() && char != '_').unwrap_or(value.len()) > MOST_DIGITS
}

//! File names with a frame number in them, such as `frame-%03d.png`.

use std::path::{Path, PathBuf};

/// A name with one place for a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameNames {
    before: String,
    /// Digits at least, filled up with zeros.
    digits: usize,
    after: String,
}

/// A name that gives every frame the same file, or cannot be read.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{name:?} does not say where the frame's number goes; put one place for it into the name, as in frame-%03d.png"
)]
pub struct FrameNameError {
    name: String,
}

impl FrameNames {
    /// Reads a name with exactly one `%d` or `%0Nd`; `%%` stands for a percent sign.
    pub fn parse(name: &Path) -> Result<Self, FrameNameError> {
        let error = || FrameNameError { name: name.display().to_string() };
        let mut rest = name.to_str().ok_or_else(error)?;
        let mut text = String::new();
        let mut number = None;
        while let Some((literal, place)) = rest.split_once('%') {
            text.push_str(literal);
            if let Some(after) = place.strip_prefix('%') {
                text.push('%');
                rest = after;
                continue;
            }
            let (digits, after) = place.split_once('d').ok_or_else(error)?;
            let digits = match digits {
                "" => 1,
                digits => (digits.strip_prefix('0').and_then(|digits| digits.parse().ok()))
                    .filter(|digits| (1..=9).contains(digits))
                    .ok_or_else(error)?,
            };
            if number.replace((std::mem::take(&mut text), digits)).is_some() {
                return Err(error());
            }
            rest = after;
        }
        text.push_str(rest);
        let (before, digits) = number.ok_or_else(error)?;
        Ok(Self { before, digits, after: text })
    }

    /// The file of a frame.
    pub fn of(&self, frame: u32) -> PathBuf {
        let Self { before, digits, after } = self;
        format!("{before}{frame:0digits$}{after}").into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name_of(pattern: &str, frame: u32) -> Option<String> {
        let names = FrameNames::parse(Path::new(pattern)).ok()?;
        Some(names.of(frame).display().to_string())
    }

    #[test]
    fn numbers_are_filled_up() {
        assert_eq!(name_of("out/frame-%03d.png", 7).as_deref(), Some("out/frame-007.png"));
        assert_eq!(name_of("%03d.png", 12345).as_deref(), Some("12345.png"));
        assert_eq!(name_of("%d.png", 7).as_deref(), Some("7.png"));
        assert_eq!(name_of("100%%-%02d%%.png", 3).as_deref(), Some("100%-03%.png"));
    }

    #[test]
    fn anything_but_one_place_is_refused() {
        for pattern in
            ["frame.png", "%d-%d.png", "%s.png", "%03.png", "%3d.png", "%0d.png", "%0999d.png", "%", "%%.png"]
        {
            assert_eq!(name_of(pattern, 0), None, "{pattern}");
        }
    }
}

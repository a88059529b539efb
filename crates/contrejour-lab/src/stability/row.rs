//! What a case came to.

use serde::Serialize;

/// Heads of the table, in its order.
pub const COLUMNS: [&str; 12] = [
    "family",
    "parameter",
    "faces_tested",
    "sign_errors_f32",
    "sign_errors",
    "open_cycles",
    "gaps",
    "non_finite",
    "width_error",
    "visibility_error",
    "time_ms",
    "degrades",
];

/// Above this, an error of a smoothie's width is more than rounding.
const WIDTH_ERROR_MAX: f64 = 1e-3;

/// One case. What a family can't say is `None`, an empty cell. The serialised fields are [`COLUMNS`].
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    /// Name of the family.
    pub family: &'static str,
    /// What is varied: its value, and what kind of light.
    pub parameter: String,
    /// Faces whose sign was compared with exact arithmetic.
    pub faces_tested: Option<u64>,
    /// Faces that a bare test in 32-bit floats takes for lit where they are not, or the other way round.
    pub sign_errors_f32: Option<u64>,
    /// Faces whose sign is wrong on the device or in its twin, and silhouette edges that either lost, invented or gave
    /// other faces.
    pub sign_errors: Option<u64>,
    /// Vertices at which the silhouette of the device or of its twin is no cycle.
    pub open_cycles: Option<u64>,
    /// Outline edges in view that the device or its twin gave no quad, and, where the family looks for them, points beside
    /// outline vertices that neither a blocker nor a smoothie covers; in silhouette maps, neighbouring texels between which a
    /// blocker ends though one of them knows no silhouette.
    pub gaps: Option<u64>,
    /// Numbers that are infinite or none: in quads, corners, planes, light records and all texels of all maps that the frame
    /// leaves, in the twin's quads and corners, and in the visibility and the shaded picture of what is looked at.
    pub non_finite: Option<u64>,
    /// The largest difference between a smoothie's width and its definition, as a share of the defined width.
    pub width_error: Option<f64>,
    /// RMSE of visibility against the ray-traced truth.
    pub visibility_error: Option<f64>,
    /// From submission of a whole frame to its completion, median of a few. Unit: milliseconds.
    pub time_ms: Option<f64>,
    /// Why the definition does not hold here, or what the library refused; empty where neither.
    pub degrades: String,
    /// Where the case is along the axis of its family's plots.
    #[serde(skip)]
    pub at: f64,
    /// What is seen: visibility in truth and by the technique, as addresses that hold PNG pictures.
    #[serde(skip)]
    pub pictures: Option<[String; 2]>,
    /// The largest error of visibility that is explained.
    #[serde(skip)]
    pub visibility_error_max: f64,
    /// Whether the library must refuse the case.
    #[serde(skip)]
    pub refusal_is_due: bool,
    /// Whether it did.
    #[serde(skip)]
    pub is_refused: bool,
    /// How long it takes to find the lit faces.
    #[serde(skip)]
    pub facing: Option<FacingTimes>,
}

/// Times to find the lit faces of a case on one core, by a bare test in 32-bit floats and by the twins of the stages.
/// Unit: nanoseconds a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacingTimes {
    /// The bare test.
    pub bare_ns: f64,
    /// The exact one.
    pub exact_ns: f64,
}

impl Row {
    /// What must never be: sign errors, open cycles, gaps and numbers that are not finite; an error of width or visibility
    /// beyond what its reasons allow; a refusal where none is due, and none where one is.
    pub fn faults(&self) -> u64 {
        let counts = [self.sign_errors, self.open_cycles, self.gaps, self.non_finite];
        counts.into_iter().flatten().sum::<u64>() + self.surprises().len() as u64
    }

    /// What is not as the family says it must be, each in a few words.
    pub(super) fn surprises(&self) -> Vec<String> {
        let errors = [
            ("width error", self.width_error, WIDTH_ERROR_MAX),
            ("visibility error", self.visibility_error, self.visibility_error_max),
        ];
        let large = errors.into_iter().filter_map(|(name, error, most)| {
            // NaN is no error that is small enough.
            let error = error.filter(|error| error.is_nan() || *error > most)?;
            Some(format!("{name} {error:.4}, at most {most} is explained"))
        });
        let wrongly = match (self.refusal_is_due, self.is_refused) {
            (false, true) => Some(format!("refused: {}", self.degrades)),
            (true, false) => Some("not refused".to_owned()),
            _ => None,
        };
        large.chain(wrongly).collect()
    }
}

/// Adds a reason to those why a definition does not hold.
pub(super) fn add_reason(degrades: &mut String, reason: &str) {
    if !degrades.is_empty() {
        *degrades += "; ";
    }
    *degrades += reason;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fields_are_the_columns() {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.serialize(Row { gaps: Some(3), ..Row::default() }).expect("memory can be written to");
        let text = String::from_utf8(writer.into_inner().expect("it is flushed")).expect("it is text");
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines, [COLUMNS.join(",").as_str(), ",,,,,,3,,,,,"]);
    }

    #[test]
    fn each_kind_of_fault_counts_and_the_bare_test_does_not() {
        let count = Some(2);
        for fault in [
            Row { sign_errors: count, ..Row::default() },
            Row { open_cycles: count, ..Row::default() },
            Row { gaps: count, ..Row::default() },
            Row { non_finite: count, ..Row::default() },
            Row { width_error: Some(0.01), visibility_error: Some(0.1), ..Row::default() },
            Row { width_error: Some(f64::NAN), visibility_error: Some(f64::NAN), ..Row::default() },
        ] {
            assert_eq!(fault.faults(), 2);
        }
        let small = Row {
            width_error: Some(1e-5),
            visibility_error: Some(0.25),
            visibility_error_max: 0.3,
            degrades: "the light is large".to_owned(),
            ..Row::default()
        };
        assert_eq!(small.faults(), 0);
        // A reason is no excuse for everything.
        assert_eq!(Row { visibility_error: Some(0.31), ..small.clone() }.faults(), 1);
        assert_eq!(Row { is_refused: true, ..small.clone() }.faults(), 1);
        assert_eq!(Row { refusal_is_due: true, ..small.clone() }.faults(), 1);
        assert_eq!(Row { refusal_is_due: true, is_refused: true, ..small }.faults(), 0);
        assert_eq!(Row { sign_errors_f32: count, ..Row::default() }.faults(), 0);
    }
}

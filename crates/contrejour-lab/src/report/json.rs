//! Reports as JSON.

use super::Report;

/// Why a report has no JSON.
#[derive(Debug, thiserror::Error)]
pub enum ToJsonError {
    /// What would be written does not read back as what was measured.
    #[error("a figure of the report is not a finite number; what measured it is broken")]
    NotFinite,
    /// A value that JSON can't hold.
    #[error("the report can't be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// Why JSON is no report.
#[derive(Debug, thiserror::Error)]
#[error(
    "this is not a report of contrejour {version}: {error}; make it again with this version",
    version = env!("CARGO_PKG_VERSION")
)]
pub struct FromJsonError {
    /// What is wrong, with line and column.
    #[from]
    error: serde_json::Error,
}

impl Report {
    /// The report as JSON, indented, fields in the order of their declaration.
    ///
    /// # Errors
    ///
    /// A figure that is infinite or no number.
    pub fn to_json(&self) -> Result<String, ToJsonError> {
        let mut text = serde_json::to_string_pretty(self)?;
        // JSON has no infinity and no NaN: serde_json writes null, which is no figure or another one.
        if !serde_json::from_str::<Self>(&text).is_ok_and(|read| read == *self) {
            return Err(ToJsonError::NotFinite);
        }
        text.push('\n');
        Ok(text)
    }

    /// Reads JSON, and settles the groups, so that what follows from the figures can't contradict them.
    ///
    /// # Errors
    ///
    /// Text that is not JSON, or not that of a report.
    pub fn from_json(text: &str) -> Result<Self, FromJsonError> {
        let mut report: Self = serde_json::from_str(text)?;
        report.settle();
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    fn report() -> Report {
        let contestants = vec![
            sample::contestant("plain", "plain", "shadow-map", 0.1 + 0.2, 1.0 / 3.0),
            sample::contestant("smoothies", "smoothies", "smoothies", 1e-300, 4.35),
        ];
        sample::report(vec![sample::group("square", 1024, contestants)])
    }

    #[test]
    fn what_is_written_reads_back_to_the_last_digit() {
        let report = report();
        let text = report.to_json().expect("all figures are finite");
        assert_eq!(Report::from_json(&text).expect("it was just written"), report);
        let planted = text.replace("0.30000000000000004", "0.3");
        assert_ne!(planted, text);
        assert_ne!(Report::from_json(&planted).expect("it is still a report"), report);
    }

    #[test]
    fn fields_keep_their_order() {
        let text = report().to_json().expect("all figures are finite");
        let places = ["\"header\"", "\"command\"", "\"groups\"", "\"scene\"", "\"contestants\"", "\"figures\""]
            .map(|field| text.find(field).expect("the field is there"));
        assert!(places.is_sorted(), "{text}");
    }

    #[test]
    fn what_follows_is_settled_again() {
        let report = report();
        let text = report.to_json().expect("all figures are finite").replace("\"stands\": true", "\"stands\": false");
        assert_eq!(Report::from_json(&text).expect("it is still a report"), report);
    }

    #[test]
    fn figures_that_are_no_numbers_are_refused() {
        for wrong in [f64::NAN, f64::INFINITY] {
            let mut report = report();
            report.groups[0].contestants[0].errors.flip = Some(wrong);
            assert!(matches!(report.to_json(), Err(ToJsonError::NotFinite)));
        }
    }

    #[test]
    fn other_text_is_refused_with_its_place() {
        let error = Report::from_json("{ \"header\": 3 }").expect_err("this is no report").to_string();
        assert!(error.contains("line 1 column"), "{error}");
    }
}

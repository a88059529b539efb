//! The sums over all rows.

use serde::Serialize;

use super::row::Row;
use super::run::Stability;

/// Sums over all rows of a run. Empty cells count as 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Findings {
    /// Families.
    pub families: usize,
    /// Rows.
    pub rows: usize,
    /// Faces whose sign was compared.
    pub faces_tested: u64,
    /// Wrong signs of the bare float test.
    pub sign_errors_f32: u64,
    /// Our wrong signs and silhouette edges.
    pub sign_errors: u64,
    /// Vertices at which a silhouette is open.
    pub open_cycles: u64,
    /// Gaps between smoothies.
    pub gaps: u64,
    /// Numbers that are not finite.
    pub non_finite: u64,
    /// Rows with a reason why the definition does not hold, or with a refusal.
    pub degraded: usize,
    /// Rows with an error beyond what their reasons allow, or with a refusal where none is due or none where one is.
    pub surprises: usize,
    /// Rows with a sign error, an open cycle, a gap, a number that is not finite or a surprise.
    pub faulty: usize,
}

impl Stability {
    /// All rows, family by family.
    pub fn rows(&self) -> impl Iterator<Item = &Row> {
        self.families.iter().flat_map(|family| &family.rows)
    }

    /// The sums over all rows.
    pub fn findings(&self) -> Findings {
        let sum = |cell: fn(&Row) -> Option<u64>| self.rows().filter_map(cell).sum();
        Findings {
            families: self.families.len(),
            rows: self.rows().count(),
            faces_tested: sum(|row| row.faces_tested),
            sign_errors_f32: sum(|row| row.sign_errors_f32),
            sign_errors: sum(|row| row.sign_errors),
            open_cycles: sum(|row| row.open_cycles),
            gaps: sum(|row| row.gaps),
            non_finite: sum(|row| row.non_finite),
            degraded: self.rows().filter(|row| !row.degrades.is_empty()).count(),
            surprises: self.rows().filter(|row| !row.surprises().is_empty()).count(),
            faulty: self.rows().filter(|row| row.faults() > 0).count(),
        }
    }

    /// The rows with a fault, each in a few words.
    pub fn faults(&self) -> Vec<String> {
        let told = |row: &Row| {
            let cells = [
                ("sign errors", row.sign_errors),
                ("open cycles", row.open_cycles),
                ("gaps", row.gaps),
                ("numbers that are not finite", row.non_finite),
            ];
            let cells = cells.into_iter().filter_map(|(name, count)| Some((name, count.filter(|count| *count > 0)?)));
            let counts = cells.map(|(name, count)| format!("{count} {name}"));
            let told: Vec<_> = counts.chain(row.surprises()).collect();
            format!("{} at {}: {}", row.family, row.parameter, told.join(", "))
        };
        self.rows().filter(|row| row.faults() > 0).map(told).collect()
    }
}

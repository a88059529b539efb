//! Measuring contrejour: benches and reports.

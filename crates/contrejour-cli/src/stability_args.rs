//! What can be said about stability.

use std::path::PathBuf;

use clap::Args;
use contrejour_lab::report::Extent;
use contrejour_lab::stability::{Effort, FAMILIES};

#[derive(Debug, Args)]
#[command(after_help = after_help())]
pub struct StabilityArguments {
    /// Families of cases, by name [default: all]
    #[arg(value_name = "FAMILY")]
    pub families: Vec<String>,

    /// Ends and middle of each sweep: done in a minute on two cores
    #[arg(long)]
    pub quick: bool,

    /// Seed of everything random
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,

    /// Where table and page go; made where it is missing
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,

    /// Print one JSON object: paths of what was written, and sums over all rows
    #[arg(long)]
    pub json: bool,
}

/// Names of all families, and what the exit status says.
fn after_help() -> String {
    let width = FAMILIES.iter().map(|family| family.name.len()).max().unwrap_or(0);
    let families = FAMILIES.map(|family| format!("  {:width$}  {}\n", family.name, family.stresses)).concat();
    format!(
        "Families:\n{families}\nExit status: 0 when no case has a sign error, an open cycle, a gap, a number that is not \
         finite, an error beyond what is explained, or a refusal that is not due; 1 when one has; 2 when something \
         is wrong. The last line that is printed is the path of the page."
    )
}

impl StabilityArguments {
    pub fn effort(&self) -> Effort {
        Effort::new(if self.quick { Extent::Quick } else { Extent::Full }, self.seed)
    }
}

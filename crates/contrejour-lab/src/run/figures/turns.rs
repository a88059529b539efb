//! Times of methods on one scene, measured taking turns as the report's own are.

use super::super::effort::Effort;
use super::super::error::RunError;
use super::super::lab::Lab;
use super::super::subject::Subject;
use super::super::timing::take_turns;
use super::methods::Method;
use crate::report::Cost;

/// What each method's frames cost.
pub(super) fn turns(
    lab: &Lab,
    subject: &Subject,
    methods: &[Method],
    map_size: u32,
    effort: &Effort,
) -> Result<Vec<Cost>, RunError> {
    let enter = |method: &Method| {
        let settings = method.settings(&subject.shadow, map_size);
        Ok((method.label.to_owned(), subject.judge.contestant(&settings)?))
    };
    let mut drawings = methods.iter().map(enter).collect::<Result<Vec<_>, RunError>>()?;
    let samples = take_turns(&mut drawings, &subject.light, effort, lab.options.seed, lab.tell)?;
    let costs = samples.iter().zip(&drawings);
    costs.map(|(samples, (_, drawing))| samples.cost(drawing, lab.gpu.is_software())).collect()
}

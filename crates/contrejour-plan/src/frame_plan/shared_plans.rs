//! The plans of lights that share a scene.

use std::collections::BTreeSet;

use super::{BufferKind, FramePlan};

/// The plans of all lights of a scene. They share pages and lists, so what one of them needs shapes all: `plans` makes them
/// with the [kinds that others need](super::PlanInput::shared), first with none.
///
/// # Errors
///
/// As `plans`.
pub fn shared_plans<E>(plans: impl Fn(&[BufferKind]) -> Result<Vec<FramePlan>, E>) -> Result<Vec<FramePlan>, E> {
    let alone = plans(&[])?;
    let kinds = alone.iter().flat_map(|plan| &plan.buffers).map(|buffer| buffer.kind);
    let shared: BTreeSet<BufferKind> = kinds.filter(|kind| !kind.is_of_light()).collect();
    // Lights that need the same need no second thought.
    let is_alike = |plan: &FramePlan| shared.iter().all(|kind| plan.buffer(*kind).is_some());
    if alone.iter().all(is_alike) { Ok(alone) } else { plans(&Vec::from_iter(shared)) }
}

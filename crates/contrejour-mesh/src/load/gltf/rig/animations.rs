//! Animations: keys and what follows them.

use gltf::animation::{Interpolation as GltfInterpolation, Property};
use gltf::{Accessor, Document};

use super::super::accessor::{Data, Integers};
use crate::LoadError;
use crate::rig::{Animation, Channel, ChannelTarget, Interpolation, NodeTransform, RigNode, Sampler};

pub(super) fn read_animations(
    document: &Document,
    nodes: &[RigNode],
    data: &Data,
) -> Result<Vec<Animation>, LoadError> {
    document.animations().map(|animation| read_animation(&animation, nodes, data)).collect()
}

fn read_animation(animation: &gltf::Animation, nodes: &[RigNode], data: &Data) -> Result<Animation, LoadError> {
    // The name, and a channel that shares its keys, take memory too.
    let name = animation.name().map_or_else(|| animation.index().to_string(), str::to_owned);
    let number_count = name.len() as u64 + 4 * animation.channels().count() as u64;
    data.count_numbers(number_count, || format!("animation {}", animation.index()))?;
    let mut samplers = Vec::new();
    for (index, sampler) in animation.samplers().enumerate() {
        let place = format!("animation {}, sampler {index}", animation.index());
        samplers.push(read_sampler(&sampler, data, place)?);
    }
    let mut channels = Vec::new();
    for (index, channel) in animation.channels().enumerate() {
        let place = || format!("animation {}, channel {index}", animation.index());
        let node = channel.target().node().index();
        let (target, width) = match channel.target().property() {
            Property::Translation => (ChannelTarget::Translation, 3),
            Property::Rotation => (ChannelTarget::Rotation, 4),
            Property::Scale => (ChannelTarget::Scale, 3),
            Property::MorphTargetWeights => (ChannelTarget::MorphWeights, nodes[node].morph_weights.len()),
        };
        let sampler = channel.sampler().index();
        if samplers[sampler].width() != width {
            return Err(data.malformed(
                place(),
                &format!(
                    "its keys are of {} numbers where node {node} needs {width}; export the file again",
                    samplers[sampler].width()
                ),
            ));
        }
        if target != ChannelTarget::MorphWeights && matches!(nodes[node].transform, NodeTransform::Matrix(_)) {
            let problem = format!("moves node {node}, which has a matrix; give it translation, rotation and scale");
            return Err(data.malformed(place(), &problem));
        }
        channels.push(Channel { node, target, sampler });
    }
    Ok(Animation::new(name, samplers, channels))
}

fn read_sampler(sampler: &gltf::animation::Sampler, data: &Data, place: String) -> Result<Sampler, LoadError> {
    let interpolation = match sampler.interpolation() {
        GltfInterpolation::Step => Interpolation::Step,
        GltfInterpolation::Linear => Interpolation::Linear,
        GltfInterpolation::CubicSpline => Interpolation::CubicSpline,
    };
    let times = numbers(&sampler.input(), data)?;
    let values = numbers(&sampler.output(), data)?;
    Sampler::new(interpolation, times, values).ok_or_else(|| {
        let problem =
            "its keys are not finite, not in order of time, or not as many as their values; export the file again";
        data.malformed(place, problem)
    })
}

/// All numbers of an accessor, whatever its elements.
fn numbers(accessor: &Accessor, data: &Data) -> Result<Vec<f64>, LoadError> {
    Ok(match accessor.dimensions().multiplicity() {
        3 => data.read::<3>(accessor, Integers::Normalized)?.into_flattened(),
        4 => data.read::<4>(accessor, Integers::Normalized)?.into_flattened(),
        _ => data.read::<1>(accessor, Integers::Normalized)?.into_flattened(),
    })
}

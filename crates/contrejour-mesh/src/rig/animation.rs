//! Animations: which number of which node follows which keys.

use super::Rig;
use super::sampler::Sampler;

/// Moves nodes and weights of morph targets over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    /// Name in the file; its index there where it has none.
    pub name: String,
    /// Time of the last key. Unit: seconds. The first frame is at 0.
    pub duration: f64,
    pub(super) samplers: Vec<Sampler>,
    pub(super) channels: Vec<Channel>,
}

/// What of a node follows a sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Channel {
    pub node: usize,
    pub target: ChannelTarget,
    /// Index of the sampler; as wide as the target.
    pub sampler: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ChannelTarget {
    Translation,
    Rotation,
    Scale,
    MorphWeights,
}

impl Animation {
    #[cfg(feature = "gltf")]
    pub(crate) fn new(name: String, samplers: Vec<Sampler>, channels: Vec<Channel>) -> Self {
        let ends = channels.iter().map(|channel| samplers[channel.sampler].end());
        let duration = ends.fold(0.0, f64::max);
        Self { name, duration, samplers, channels }
    }
}

/// No animation has the name.
#[derive(Debug, thiserror::Error)]
#[error("there is no animation {name:?}; {}", choice(known))]
pub struct UnknownAnimation {
    /// What was asked for.
    pub name: String,
    /// The names that there are.
    pub known: Vec<String>,
}

fn choice(names: &[String]) -> String {
    match names {
        [] => "the file has none".to_owned(),
        names => {
            let names: Vec<_> = names.iter().map(|name| format!("{name:?}")).collect();
            format!("give one of {}", names.join(", "))
        }
    }
}

impl Rig {
    /// The first animation of a name.
    ///
    /// # Errors
    ///
    /// No animation has it; the error lists those that there are.
    pub fn animation(&self, name: &str) -> Result<&Animation, UnknownAnimation> {
        self.animations.iter().find(|animation| animation.name == name).ok_or_else(|| UnknownAnimation {
            name: name.to_owned(),
            known: self.animations.iter().map(|animation| animation.name.clone()).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_name_is_told_the_known_ones() {
        let named =
            |name: &str| Animation { name: name.into(), duration: 0.0, samplers: Vec::new(), channels: Vec::new() };
        let rig = Rig { animations: vec![named("Walk"), named("Run\n")], ..Rig::default() };
        assert!(rig.animation("Walk").is_ok_and(|animation| animation.name == "Walk"));
        let text = rig.animation("walk").expect_err("names are compared exactly").to_string();
        assert_eq!(text, r#"there is no animation "walk"; give one of "Walk", "Run\n""#);
        assert!(Rig::default().animation("Walk").expect_err("it has none").to_string().ends_with("the file has none"));
    }
}
